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

#include "fix_hd_base.h"

#include "atom.h"
#include "distributed_mesh.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;
using namespace FixConst;

// a control point that moves further than this fraction of the longest edge in one step is lost
static constexpr double MOST_DRIFT = 0.25;

/* ---------------------------------------------------------------------- */

FixHDBase::FixHDBase(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), mass(lmp, igroup, std::string("Fix ") + style), most_drift(0.0)
{
  time_integrate = 1;
}

void FixHDBase::init()
{
  mass.init();
  check_other_integrators();
  most_drift = MOST_DRIFT * mass.mesh().longest_edge();
}

void FixHDBase::check_other_integrators()
{
  for (auto &other : modify->get_fix_list()) {
    if (other == this || !other->time_integrate) continue;
    int mine = 0, any;
    for (int i = 0; i < atom->nlocal; ++i)
      if (atom->mask[i] & groupbit && atom->mask[i] & other->groupbit) mine = 1;
    MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, world);
    if (any)
      error->all(FLERR,
                 "Control points of fix {} are also moved by fix {} ({}): use groups without common "
                 "atoms",
                 id, other->id, other->style);
  }
}

/* ---------------------------------------------------------------------- */

void FixHDBase::setup(int)
{
  accelerate();
}

void FixHDBase::accelerate()
{
  mass.refresh();
  mass.part().load(atom->f, force_field);
  acceleration.resize(force_field.size());
  mass.matrix().solve(force_field, acceleration);
}

void FixHDBase::kick(double step)
{
  MeshPart &part = mass.part();
  const double scale = step * force->ftm2v;
  for (int i = 0; i < part.owned; ++i) {
    double *v = atom->v[part.atom_of(i)];
    for (int k = 0; k < 3; ++k) v[k] += scale * acceleration[i].c[k];
  }
}

void FixHDBase::drift(double step)
{
  MeshPart &part = mass.part();
  int runaway = -1;
  for (int i = 0; i < part.owned; ++i) {
    const int j = part.atom_of(i);
    double *x = atom->x[j];
    const double *v = atom->v[j];
    for (int k = 0; k < 3; ++k) x[k] += step * v[k];
    const double moved = step * std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    if (!(moved < most_drift)) runaway = j;
  }
  if (runaway >= 0)
    error->one(FLERR,
               "Fix {}: control point {} moved further than {} of an edge in one step: the timestep "
               "{} is too long; hd_timestep finds the limit",
               style, atom->tag[runaway], MOST_DRIFT, update->dt);
}

double FixHDBase::memory_usage()
{
  return mass.memory_usage() +
      sizeof(Membrane_NS::Vector4) * (force_field.capacity() + acceleration.capacity());
}
