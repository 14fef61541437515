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

#include "fix_hd_brownian.h"

#include "atom.h"
#include "error.h"
#include "force.h"
#include "update.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ---------------------------------------------------------------------- */

FixHDBrownian::FixHDBrownian(LAMMPS *lmp, int narg, char **arg) :
    FixHDBase(lmp, narg, arg), gamma_t(0.0), dt(0.0), with_measure(true)
{
  restart_global = 1;
  if (narg < 5) utils::missing_cmd_args(FLERR, "fix hd/brownian", error);
  temperature = utils::numeric(FLERR, arg[3], false, lmp);
  noise_seed = utils::bnumeric(FLERR, arg[4], false, lmp);
  if (temperature < 0.0)
    error->all(FLERR, "Fix hd/brownian temperature {} must not be negative", arg[3]);
  if (noise_seed <= 0) error->all(FLERR, "Fix hd/brownian seed {} must be positive", arg[4]);

  bool measure_asked = false;
  int iarg = 5;
  while (iarg < narg) {
    if (const int used = mass.parse(iarg, narg, arg, true)) {
      iarg += used;
    } else if (strcmp(arg[iarg], "gamma_t") == 0) {
      if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "fix hd/brownian gamma_t", error);
      gamma_t = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
      if (gamma_t <= 0.0)
        error->all(FLERR, "Fix hd/brownian gamma_t {} must be positive", arg[iarg + 1]);
      iarg += 2;
    } else if (strcmp(arg[iarg], "measure") == 0) {
      if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "fix hd/brownian measure", error);
      with_measure = measure_asked = utils::logical(FLERR, arg[iarg + 1], false, lmp);
      if (with_measure && temperature == 0.0)
        error->all(FLERR, "Fix hd/brownian measure yes needs a temperature: there is no measure at 0, "
                          "leave it out");
      iarg += 2;
    } else
      error->all(FLERR,
                 "Unknown fix hd/brownian keyword {}; known are: gamma_t, mass, solver, tol, measure, "
                 "modes, relax",
                 arg[iarg]);
  }
  const bool own_friction = modes() && modes()->has_friction();
  if (own_friction && gamma_t > 0.0)
    error->all(FLERR, "Fix hd/brownian relax has the friction of each mode: leave gamma_t out");
  if (modes() && measure_asked)
    error->all(FLERR, "Fix hd/brownian measure yes is that of control points that move freely: leave it out with "
                      "modes");
  if (modes()) with_measure = false;
  set_measure();
  if (gamma_t == 0.0 && (sampling() || own_friction)) gamma_t = 1.0;
  if (gamma_t == 0.0)
    error->all(FLERR, "Fix hd/brownian needs gamma_t, the drag coefficient of a vertex");
  mass.set_drag(gamma_t);
}

int FixHDBrownian::setmask()
{
  return INITIAL_INTEGRATE | PRE_FORCE;
}

void FixHDBrownian::init()
{
  FixHDBase::init();
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix hd/brownian does not work with run_style respa");
  reset_dt();
}

void FixHDBrownian::reset_dt()
{
  dt = update->dt;
}

/* ----------------------------------------------------------------------
   Z qdot = f + noise with the drag matrix Z = gamma_t L^T L (mass vertex; the mass matrix with
   gamma_t in place of masses for the others), so with constant mobility
     dq = Z^-1 f dt + sqrt(2 kT dt) Z^-1/2 (xi_n + xi_n+1)/2,
   which samples equilibrium to second order in dt where plain Euler noise xi_n is first-order
   [B. Leimkuhler and C. Matthews, Appl. Math. Res. Express 2013, 34]
------------------------------------------------------------------------- */

void FixHDBrownian::initial_integrate(int)
{
  mass.refresh();
  hold_on();
  renew();
  std::swap(noise, unit_noise());
  ++noise_steps;
  accelerate();

  // gamma_t is mass over time, as in fix brownian

  const double kT = force->boltz * temperature / force->mvv2e;
  balance(std::sqrt(0.5 * kT / dt), noise, unit_noise());
  drift(dt);
  step_back(0.0);
}

void FixHDBrownian::reset_target(double t_new)
{
  temperature = t_new;
  set_measure();
}

void FixHDBrownian::set_measure()
{
  measure.kT = force->boltz * temperature;
  measure.on = with_measure && temperature > 0.0;
}
