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

#include "compute_hd_temp.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "fix_hd_base.h"
#include "fix_hd_bound.h"
#include "force.h"
#include "modify.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

ComputeHDTemp::ComputeHDTemp(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), tfactor(0.0), mass(lmp, igroup, "Compute hd/temp"),
    settings_given(false), lost(0), bound(0)
{
  scalar_flag = vector_flag = 1;
  size_vector = 6;
  extscalar = 0;
  extvector = 1;
  tempflag = 1;
  vector = new double[size_vector];

  int iarg = 3;
  while (iarg < narg) {
    const int used = mass.parse(iarg, narg, arg);
    if (!used)
      error->all(FLERR, "Unknown compute hd/temp keyword {}; known are: mass, solver, tol",
                 arg[iarg]);
    settings_given = true;
    iarg += used;
  }
}

ComputeHDTemp::~ComputeHDTemp()
{
  if (!copymode) delete[] vector;
}

/* ----------------------------------------------------------------------
   the mass matrix of the integrator of these atoms, unless the user chose one
------------------------------------------------------------------------- */

void ComputeHDTemp::init()
{
  overdamped = nullptr;
  if (!settings_given)
    if (auto *integrator = FixHDBase::of_group(lmp, groupbit, "Compute hd/temp")) {
      mass.settings = integrator->mass_settings();
      if (integrator->drag_coefficient() > 0.0) overdamped = integrator;
    }
  mass.settings.solve_nothing();
  mass.init(true);
  binds.clear();
  for (auto &fix : modify->get_fix_by_style("^hd/bind$")) {
    auto *bind = dynamic_cast<FixHDBound *>(fix);
    if (!bind->is_overdamped()) binds.push_back(bind);
  }
}

void ComputeHDTemp::setup()
{
  dynamic = 0;
  if (dynamic_user) dynamic = 1;
  dof_compute();
}

/* ----------------------------------------------------------------------
   extra/dof is 3 by default, as for the momentum of an isolated system, and fixes take their own
------------------------------------------------------------------------- */

void ComputeHDTemp::dof_compute()
{
  adjust_dof_fix();
  bigint mine = 0;
  for (const FixHDBound *bind : binds)
    for (int i = 0; i < atom->nlocal; ++i)
      if (atom->mask[i] & groupbit && atom->mask[i] & bind->groupbit) ++mine;
  MPI_Allreduce(&mine, &bound, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  const double fixed = mass.settings.modes || overdamped ? 0.0 : extra_dof;    // these keep no momentum of the whole
  dof = 3.0 * (mass.count() + bound) - lost - fixed - fix_dof;
  tfactor = dof > 0.0 ? force->mvv2e / (dof * force->boltz) : 0.0;
}

/* ---------------------------------------------------------------------- */

// twice the kinetic energy, xx yy zz xy xz yz; of points that move without inertia what their momenta would have

void ComputeHDTemp::kinetic(double *t)
{
  if (overdamped) {
    std::fill_n(t, 6, 0.0);
    std::fill_n(t, 3, (dof / 3.0 - bound) * overdamped->sampled_kT() / force->mvv2e);
  } else
    mass.kinetic(t);
  if (bound == 0) return;
  double mine[6] = {}, all[6];
  for (const FixHDBound *bind : binds)
    for (int i = 0; i < atom->nlocal; ++i) {
      if (!(atom->mask[i] & groupbit && atom->mask[i] & bind->groupbit)) continue;
      const double m = bind->mass_of(i), *v = atom->v[i];
      const double product[6] = {v[0] * v[0], v[1] * v[1], v[2] * v[2], v[0] * v[1], v[0] * v[2], v[1] * v[2]};
      for (int k = 0; k < 6; ++k) mine[k] += m * product[k];
    }
  MPI_Allreduce(mine, all, 6, MPI_DOUBLE, MPI_SUM, world);
  for (int k = 0; k < 6; ++k) t[k] += all[k];
}

double ComputeHDTemp::compute_scalar()
{
  invoked_scalar = update->ntimestep;
  double t[6];
  kinetic(t);
  const int now = overdamped ? 0 : mass.matrix().lost_freedoms();
  if (dynamic || now != lost) {
    lost = now;
    dof_compute();
  }
  return scalar = tfactor * (t[0] + t[1] + t[2]);
}

void ComputeHDTemp::compute_vector()
{
  invoked_vector = update->ntimestep;
  kinetic(vector);
  for (int i = 0; i < 6; ++i) vector[i] *= force->mvv2e;
}
