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
#include "compute_membrane_curvature_atom.h"

#include "atom.h"
#include "error.h"
#include "fmt/format.h"
#include "memory.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;
using Membrane_NS::IntSpan;
using Membrane_NS::LimitPoint;
using Membrane_NS::LimitValues;
using Membrane_NS::Valences;

enum { MEAN, GAUSSIAN, POSITION, NORMAL = POSITION + 3, NCOLUMNS = NORMAL + 3 };

/* ---------------------------------------------------------------------- */

ComputeMembraneCurvatureAtom::ComputeMembraneCurvatureAtom(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), mesh(lmp, fmt::format("Compute {} membrane/curvature/atom", id)), nmax(0)
{
  mesh.require();
  if (narg != 3)
    error->all(FLERR, "Compute membrane/curvature/atom has no arguments, but got: {}", arg[3]);
  peratom_flag = 1;
  size_peratom_cols = NCOLUMNS;
}

ComputeMembraneCurvatureAtom::~ComputeMembraneCurvatureAtom()
{
  memory->destroy(array_atom);
}

/* ---------------------------------------------------------------------- */

void ComputeMembraneCurvatureAtom::init()
{
  mesh.init();
}

/* ----------------------------------------------------------------------
   after reneighbouring: the control points that shape the surface at each one of this rank.
   The surface at a regular one depends on its neighbours only; just off an extraordinary one it
   depends on all control points of the faces around it.
------------------------------------------------------------------------- */

void ComputeMembraneCurvatureAtom::localize()
{
  sites.clear();
  patches.clear();
  points.clear();

  const auto &topology = mesh->topology();
  for (const auto &[i, v] : mesh->owned_points()) {
    const IntSpan ring = topology.ring(v), faces = topology.faces_around(v);
    const int n = ring.size();

    auto [known, is_new] = vertex_weights.try_emplace(n);
    if (is_new) known->second = Membrane_NS::vertex_weights(n);
    const size_t first = points.size();
    Site site = {i, 1, patches.size()};
    patches.push_back({&known->second, first});
    points.push_back(i);
    for (int k = 0; k < n; ++k) points.push_back(mesh->local_neighbor(i, ring[k], faces[k]));

    if (n != 6)
      for (int k = 0; k < n; ++k)
        add_corner(faces[k], v, i, points[first + 1 + k], points[first + 1 + (k + 1) % n]);
    site.npatches = patches.size() - site.first;
    sites.push_back(site);
  }
}

/* ----------------------------------------------------------------------
   the patch of face f at its corner v, whose corners from v on are local atoms a, b, c; each point
   is the image nearest to the corner that it shares an edge with
------------------------------------------------------------------------- */

void ComputeMembraneCurvatureAtom::add_corner(int f, int v, int a, int b, int c)
{
  const auto &topology = mesh->topology();
  std::vector<int> stencil;
  topology.stencil(f, stencil, Membrane_NS::corner_of(topology.face(f), v));
  const Valences n = {topology.valence(stencil[0]), topology.valence(stencil[1]),
                      topology.valence(stencil[2])};
  auto [known, is_new] = corner_weights.try_emplace(n);
  if (is_new) known->second = Membrane_NS::corner_weights(n);

  patches.push_back({&known->second, points.size()});
  const int corner[3] = {a, b, c};
  points.insert(points.end(), corner, corner + 3);
  size_t column = 3;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < n[k] - 3; ++i)
      points.push_back(mesh->local_neighbor(corner[k], stencil[column++], f));
  if (column < stencil.size()) points.push_back(mesh->local_neighbor(a, stencil[column], f));
}

/* ----------------------------------------------------------------------
   the surface relative to a point nearby, against rounding
------------------------------------------------------------------------- */

LimitPoint ComputeMembraneCurvatureAtom::evaluate(const Patch &patch, const double *origin) const
{
  LimitValues values = LimitValues::Zero();
  const Weights &weights = *patch.weights;
  for (int k = 0; k < weights.cols(); ++k) {
    const double *x = atom->x[points[patch.first + k]];
    values +=
        weights.col(k) * Eigen::RowVector3d(x[0] - origin[0], x[1] - origin[1], x[2] - origin[2]);
  }
  return Membrane_NS::limit_point(values);
}

/* ---------------------------------------------------------------------- */

void ComputeMembraneCurvatureAtom::compute_peratom()
{
  invoked_peratom = update->ntimestep;
  if (mesh.follow() != MeshChange::NOTHING) localize();

  if (atom->nmax > nmax) {
    nmax = atom->nmax;
    memory->destroy(array_atom);
    memory->create(array_atom, nmax, NCOLUMNS, "membrane/curvature/atom:array_atom");
  }
  for (int i = 0; i < atom->nlocal; ++i) std::fill_n(array_atom[i], NCOLUMNS, 0.0);

  for (const Site &site : sites) {
    if (!(atom->mask[site.atom] & groupbit)) continue;
    const double *x = atom->x[site.atom];
    double *row = array_atom[site.atom];
    const LimitPoint point = evaluate(patches[site.first], x);
    for (int k = 0; k < 3; ++k) {
      row[POSITION + k] = x[k] + point.position[k];
      row[NORMAL + k] = point.normal[k];
    }
    if (site.npatches == 1) {
      row[MEAN] = point.mean_curvature;
      row[GAUSSIAN] = point.gaussian_curvature;
      continue;
    }
    const int nfaces = site.npatches - 1;
    for (int k = 1; k <= nfaces; ++k) {
      const LimitPoint inside = evaluate(patches[site.first + k], x);
      row[MEAN] += inside.mean_curvature / nfaces;
      row[GAUSSIAN] += inside.gaussian_curvature / nfaces;
    }
  }
}

/* ---------------------------------------------------------------------- */

double ComputeMembraneCurvatureAtom::memory_usage()
{
  return sizeof(double) * (double) nmax * NCOLUMNS + sizeof(Site) * sites.capacity() +
      sizeof(Patch) * patches.capacity() + sizeof(int) * points.capacity();
}
