/* -----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing author: MEMBRANE developers
------------------------------------------------------------------------- */

#include "fix_hd_nve.h"

#include "error.h"
#include "force.h"
#include "respa.h"
#include "update.h"

#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ---------------------------------------------------------------------- */

FixHDNVE::FixHDNVE(LAMMPS *lmp, int narg, char **arg) :
    FixHDBase(lmp, narg, arg), dtv(0.0), dtf(0.0)
{
  dynamic_group_allow = 0;
  mass.settings.quickest = true;
  int iarg = 3;
  while (iarg < narg) {
    if (const int used = mass.parse(iarg, narg, arg, true)) {
      iarg += used;
    } else if (strcmp(arg[iarg], "measure") == 0) {
      if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "fix hd/nve measure", error);
      const double temperature = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
      if (!(temperature > 0.0))
        error->all(FLERR,
                   "Fix hd/nve measure {} must be a positive temperature; leave it out for motion "
                   "without one",
                   arg[iarg + 1]);
      measure.on = true;
      measure.kT = force->boltz * temperature;
      iarg += 2;
    } else
      error->all(FLERR, "Unknown fix hd/nve keyword {}; known are: mass, solver, tol, measure, modes",
                 arg[iarg]);
  }
  if (modes() && modes()->has_friction())
    error->all(FLERR, "Fix hd/nve has no friction: leave relax out, or use fix hd/langevin or hd/brownian");
  if (modes() && measure.on)
    error->all(FLERR, "Fix hd/nve measure is that of control points that move freely: leave it out with modes");
  if (sampling())
    error->all(FLERR, "Fix hd/nve mass sampling: its motion means nothing without a thermostat; use fix "
                      "hd/langevin, or another mass");
}

int FixHDNVE::setmask()
{
  return INITIAL_INTEGRATE | PRE_FORCE | FINAL_INTEGRATE | INITIAL_INTEGRATE_RESPA |
      FINAL_INTEGRATE_RESPA;
}

void FixHDNVE::init()
{
  FixHDBase::init();
  reset_dt();
}

void FixHDNVE::reset_dt()
{
  dtv = update->dt;
  dtf = 0.5 * update->dt;
}

/* ----------------------------------------------------------------------
   the acceleration of the last final_integrate (or setup) is still that of x
------------------------------------------------------------------------- */

void FixHDNVE::initial_integrate(int)
{
  kick_and_drift(dtf, dtv);
}

void FixHDNVE::final_integrate()
{
  accelerate();
  kick(dtf);
}

/* ----------------------------------------------------------------------
   with r-RESPA each level has forces of its own
------------------------------------------------------------------------- */

void FixHDNVE::initial_integrate_respa(int, int ilevel, int)
{
  const double *step = dynamic_cast<Respa *>(update->integrate)->step;
  accelerate();
  kick(0.5 * step[ilevel]);
  if (ilevel == 0) drift(step[0]);
}

void FixHDNVE::final_integrate_respa(int ilevel, int)
{
  const double *step = dynamic_cast<Respa *>(update->integrate)->step;
  accelerate();
  kick(0.5 * step[ilevel]);
}
