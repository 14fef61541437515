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

#include "hd_mass.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "group.h"
#include "membrane_mass_kinds.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using Membrane_NS::MassKind;
using Membrane_NS::MassOperator;
using Membrane_NS::VertexField;

/* ---------------------------------------------------------------------- */

HDMass::HDMass(LAMMPS *lmp, int igroup, std::string user) :
    Pointers(lmp), groupbit(group->bitmask[igroup]), user(std::move(user)),
    points(lmp, igroup, this->user), drag(0.0), reported(false)
{
}

int HDMass::parse(int iarg, int narg, char **arg)
{
  const std::string key = arg[iarg];
  if (key != "mass" && key != "solver" && key != "tol") return 0;
  if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, user + " " + key, error);
  const std::string value = arg[iarg + 1];
  if (key == "mass") {
    if (!Membrane_NS::find_mass_kind(value, settings.kind))
      error->all(FLERR, "{} mass {} is not vertex, consistent or lumped", user, value);
  } else if (key == "solver") {
    if (value != "direct" && value != "iterative")
      error->all(FLERR, "{} solver {} is not iterative or direct", user, value);
    settings.direct = value == "direct";
  } else {
    settings.tolerance = utils::numeric(FLERR, value, false, lmp);
    if (!(settings.tolerance >= 1.0e-14 && settings.tolerance <= 1.0e-2))
      error->all(FLERR, "{} tol {} must be between 1e-14 and 1e-2", user, value);
  }
  return 2;
}

/* ---------------------------------------------------------------------- */

void HDMass::init(bool other_atoms)
{
  if (settings.direct && settings.kind == MassKind::LUMPED)
    error->all(FLERR, "{} solver direct: mass lumped needs no solver", user);
  points.init(other_atoms);
  if (drag == 0.0) check_masses();
  reported = false;
}

void HDMass::check_masses()
{
  tagint mine = 0, bad;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit) || mesh().vertex(atom->tag[i]) < 0) continue;
    if (!(atom->rmass[i] > 0.0) || !std::isfinite(atom->rmass[i])) mine = MAX(mine, atom->tag[i]);
  }
  MPI_Allreduce(&mine, &bad, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  if (bad)
    error->all(FLERR, "{}: control point {} has no positive mass: use set ... mass", user, bad);
}

/* ---------------------------------------------------------------------- */

void HDMass::refresh()
{
  if (!points.follow(Membrane_NS::mass_halo_rings(settings.kind))) return;

  const int n = mesh().topology().num_vertices();
  std::vector<double> masses(n, 0.0);
  std::vector<uint64_t> labels(n);
  for (int i = 0; i < part().owned; ++i)
    masses[part().vertices[i]] = drag > 0.0 ? drag : atom->rmass[part().atom_of(i)];
  part().sum(masses.data(), n);
  for (int v = 0; v < n; ++v) labels[v] = mesh().tag(v);
  try {
    mass = Membrane_NS::make_mass({mesh().topology(), part(), masses, labels}, settings);
  } catch (const Membrane_NS::MeshError &err) {
    error->all(FLERR, "{}: {}", user, err.what());
  }
}

void HDMass::report_missed_tolerance()
{
  if (reported || mass->missed_residual() == 0.0) return;
  reported = true;
  if (comm->me == 0)
    error->warning(FLERR,
                   "{}: mass {} was solved in {} passes to a residual of {:.2g} only, not {:.2g}: "
                   "use solver direct, a larger tol, or masses that differ less",
                   user, mass_kind_name(settings.kind), settings.most_passes,
                   mass->missed_residual(), settings.tolerance);
}

/* ---------------------------------------------------------------------- */

void HDMass::kinetic(double *t)
{
  refresh();
  VertexField v;
  part().load(atom->v, v);
  const auto sums = mass->kinetic(v);
  std::copy(sums.begin(), sums.end(), t);
}
