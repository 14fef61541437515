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
#include "mesh_distributed.h"
#include "error.h"
#include "group.h"

#include <cmath>

using namespace LAMMPS_NS;
using Membrane_NS::MassKind;
using Membrane_NS::MassOperator;
using Membrane_NS::VertexField;

/* ---------------------------------------------------------------------- */

HDMass::HDMass(LAMMPS *lmp, int igroup, std::string user) :
    Pointers(lmp), igroup(igroup), groupbit(group->bitmask[igroup]), user(std::move(user)),
    surface(&DistributedMesh::of(lmp, this->user)), epoch(-1), renumbered(0),
    npoints(0), drag(0.0)
{
}

int HDMass::parse(int iarg, int narg, char **arg)
{
  const std::string key = arg[iarg];
  if (key != "mass" && key != "solver" && key != "tol") return 0;
  if (iarg + 2 > narg)
    utils::missing_cmd_args(FLERR, user + " " + key, error);
  const std::string value = arg[iarg + 1];
  if (key == "mass") {
    if (value == "vertex")
      settings.kind = MassKind::VERTEX;
    else if (value == "consistent")
      settings.kind = MassKind::CONSISTENT;
    else if (value == "lumped")
      settings.kind = MassKind::LUMPED;
    else
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
  surface->update();
  check_group(other_atoms);
  epoch = -1;
}

/* ----------------------------------------------------------------------
   the group holds control points only, whole membranes, with masses
------------------------------------------------------------------------- */

void HDMass::check_group(bool other_atoms)
{
  const auto &topology = surface->topology();
  const int ncomponents = topology.num_components();
  tagint bad[2] = {0, 0};
  std::vector<int> inside(ncomponents, 0), all(ncomponents);
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    const int v = surface->vertex(atom->tag[i]);
    if (v < 0) {
      if (!other_atoms) bad[0] = MAX(bad[0], atom->tag[i]);
      continue;
    }
    ++inside[topology.component(v)];
    if (drag > 0.0) continue;
    if (!(atom->rmass[i] > 0.0) || !std::isfinite(atom->rmass[i]))
      bad[1] = MAX(bad[1], atom->tag[i]);
  }
  tagint any[2];
  MPI_Allreduce(bad, any, 2, MPI_LMP_TAGINT, MPI_MAX, world);
  MPI_Allreduce(inside.data(), all.data(), ncomponents, MPI_INT, MPI_SUM, world);
  if (any[0])
    error->all(FLERR,
               "{} moves control points, and atom {} of its group is none: integrate plain "
               "atoms with a fix of their own, such as fix nve",
               user, any[0]);
  if (any[1])
    error->all(FLERR, "{}: control point {} has no positive mass: use set ... mass", user,
               any[1]);
  npoints = 0;
  for (int n : all) npoints += n;
  for (int c = 0; c < ncomponents; ++c)
    if (all[c] && all[c] != topology.num_vertices(c))
      error->all(FLERR,
                 "{}: group {} has {} of the {} control points of membrane {}; a surface moves "
                 "as a whole: use a group of whole membranes (group ... molecule)",
                 user, group->names[igroup], all[c], topology.num_vertices(c), surface->molecule(c));
}

/* ---------------------------------------------------------------------- */

void HDMass::refresh()
{
  surface->refresh();
  if (epoch == surface->epoch()) return;
  const bool first = epoch < 0;
  epoch = surface->epoch();
  if (!first && vertices->follow(*surface)) return;

  ++renumbered;
  static constexpr int RINGS[] = {1, 3, 0};    // vertex, consistent, lumped
  vertices = std::make_unique<MeshPart>(lmp, *surface, groupbit, RINGS[(int) settings.kind]);

  const int n = surface->topology().num_vertices();
  std::vector<double> masses(n, 0.0);
  std::vector<uint64_t> labels(n);
  for (int i = 0; i < vertices->owned; ++i)
    masses[vertices->vertices[i]] =
        drag > 0.0 ? drag : atom->rmass[vertices->atom_of(i)];
  vertices->sum(masses.data(), n);
  for (int v = 0; v < n; ++v) labels[v] = surface->tag(v);
  try {
    mass = std::make_unique<MassOperator>(surface->topology(), *vertices, masses, labels, settings);
  } catch (const Membrane_NS::MeshError &err) {
    error->all(FLERR, "{}: {}", user, err.what());
  }
}

/* ---------------------------------------------------------------------- */

void HDMass::kinetic(double *t)
{
  refresh();
  VertexField v, p;
  vertices->load(atom->v, v);
  p.resize(v.size());
  mass->multiply(v, p);
  std::fill_n(t, 6, 0.0);
  for (int i = 0; i < vertices->owned; ++i) {
    const double *a = v[i].c, *b = p[i].c;
    t[0] += a[0] * b[0];
    t[1] += a[1] * b[1];
    t[2] += a[2] * b[2];
    t[3] += a[0] * b[1];
    t[4] += a[0] * b[2];
    t[5] += a[1] * b[2];
  }
  vertices->sum(t, 6);
}
