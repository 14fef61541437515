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
#include "comm.h"
#include "distributed_mesh.h"
#include "error.h"
#include "force.h"
#include "group.h"
#include "modify.h"
#include "update.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;
using Membrane_NS::MassKind;
using Membrane_NS::MassOperator;
using Membrane_NS::VertexField;

// a control point that moves further than this fraction of the longest edge in one step is lost
static constexpr double MOST_DRIFT = 0.25;

/* ---------------------------------------------------------------------- */

FixHDBase::FixHDBase(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), mesh(nullptr), epoch(-1), most_drift(0.0)
{
  time_integrate = 1;
  DistributedMesh::of(lmp, std::string("Fix ") + style);
}

int FixHDBase::parse_mass_keyword(int iarg, int narg, char **arg)
{
  const std::string key = arg[iarg];
  if (key != "mass" && key != "solver" && key != "tol") return 0;
  if (iarg + 2 > narg)
    utils::missing_cmd_args(FLERR, fmt::format("fix {} {}", style, key), error);
  const std::string value = arg[iarg + 1];
  if (key == "mass") {
    if (value == "vertex")
      settings.kind = MassKind::VERTEX;
    else if (value == "consistent")
      settings.kind = MassKind::CONSISTENT;
    else if (value == "lumped")
      settings.kind = MassKind::LUMPED;
    else
      error->all(FLERR, "Fix {} mass {} is not vertex, consistent or lumped", style, value);
  } else if (key == "solver") {
    if (value != "direct" && value != "iterative")
      error->all(FLERR, "Fix {} solver {} is not iterative or direct", style, value);
    settings.direct = value == "direct";
  } else {
    settings.tolerance = utils::numeric(FLERR, value, false, lmp);
    if (!(settings.tolerance >= 1.0e-14 && settings.tolerance <= 1.0e-2))
      error->all(FLERR, "Fix {} tol {} must be between 1e-14 and 1e-2", style, value);
  }
  return 2;
}

/* ---------------------------------------------------------------------- */

void FixHDBase::init()
{
  if (settings.direct && settings.kind != MassKind::CONSISTENT)
    error->all(FLERR, "Fix {} solver direct belongs to mass consistent; the others need none",
               style);
  mesh = &DistributedMesh::of(lmp, std::string("Fix ") + style);
  mesh->update();
  check_group();
  check_other_integrators();
  epoch = -1;
  most_drift = MOST_DRIFT * mesh->longest_edge();
}

/* ----------------------------------------------------------------------
   the group holds control points only, whole membranes, with masses
------------------------------------------------------------------------- */

void FixHDBase::check_group()
{
  const auto &topology = mesh->topology();
  const int ncomponents = topology.num_components();
  tagint bad[2] = {0, 0};
  std::vector<int> inside(ncomponents, 0), all(ncomponents);
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    const int v = mesh->vertex(atom->tag[i]);
    if (v < 0) {
      bad[0] = MAX(bad[0], atom->tag[i]);
      continue;
    }
    ++inside[topology.component(v)];
    if (!(atom->rmass[i] > 0.0) || !std::isfinite(atom->rmass[i]))
      bad[1] = MAX(bad[1], atom->tag[i]);
  }
  tagint any[2];
  MPI_Allreduce(bad, any, 2, MPI_LMP_TAGINT, MPI_MAX, world);
  MPI_Allreduce(inside.data(), all.data(), ncomponents, MPI_INT, MPI_SUM, world);
  if (any[0])
    error->all(FLERR,
               "Fix {} moves control points, and atom {} of its group is none: integrate plain "
               "atoms with a fix of their own, such as fix nve",
               style, any[0]);
  if (any[1])
    error->all(FLERR, "Fix {}: control point {} has no positive mass: use set ... mass", style,
               any[1]);
  for (int c = 0; c < ncomponents; ++c)
    if (all[c] && all[c] != topology.num_vertices(c))
      error->all(FLERR,
                 "Fix {}: group {} has {} of the {} control points of membrane {}; a surface moves "
                 "as a whole: use a group of whole membranes (group ... molecule)",
                 style, group->names[igroup], all[c], topology.num_vertices(c), mesh->molecule(c));
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

void FixHDBase::refresh()
{
  mesh->refresh();
  if (epoch == mesh->epoch()) return;
  epoch = mesh->epoch();

  static constexpr int RINGS[] = {1, 3, 0};    // vertex, consistent, lumped
  part = std::make_unique<MeshPart>(lmp, *mesh, groupbit, RINGS[(int) settings.kind]);

  const int n = mesh->topology().num_vertices();
  std::vector<double> masses(n, 0.0);
  std::vector<uint64_t> labels(n);
  for (int i = 0; i < part->owned; ++i)
    masses[part->vertices[i]] = atom->rmass[part->atom_of(i)];
  part->sum(masses.data(), n);
  for (int v = 0; v < n; ++v) labels[v] = mesh->tag(v);
  mass = std::make_unique<MassOperator>(mesh->topology(), *part, masses, labels, settings);
}

void FixHDBase::setup(int)
{
  refresh();
  accelerate();
}

/* ---------------------------------------------------------------------- */

void FixHDBase::accelerate()
{
  refresh();
  part->load(atom->f, force);
  acceleration.resize(part->size());
  mass->solve(force, acceleration);
}

void FixHDBase::kick(double step)
{
  const double scale = step * lmp->force->ftm2v;
  for (int i = 0; i < part->owned; ++i) {
    double *v = atom->v[part->atom_of(i)];
    for (int k = 0; k < 3; ++k) v[k] += scale * acceleration[i].c[k];
  }
}

void FixHDBase::drift(double step)
{
  int runaway = -1;
  for (int i = 0; i < part->owned; ++i) {
    const int j = part->atom_of(i);
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
  return (mass ? mass->memory_usage() : 0.0) +
      sizeof(Membrane_NS::Vector4) * (force.capacity() + acceleration.capacity());
}
