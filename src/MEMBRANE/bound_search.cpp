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

#include "bound_search.h"

using namespace LAMMPS_NS;
using Eigen::Vector3d;
using Membrane_NS::ClosestPoint;
using Membrane_NS::ClosestPointFinder;
using Membrane_NS::Face;
using Membrane_NS::LimitSurfaceOfMesh;
using Membrane_NS::Topology;
using Membrane_NS::TriangleMesh;

/* ---------------------------------------------------------------------- */

BoundSearch::BoundSearch(const DistributedMesh &mesh, const std::vector<int> &components)
{
  const Topology &whole = mesh.topology();
  const TriangleMesh all = mesh.triangle_mesh();
  std::vector<int> number(whole.num_vertices());
  for (int c : components) {
    auto part = std::make_unique<Part>();
    TriangleMesh control;
    control.lattice = all.lattice;
    control.periodic = all.periodic;
    for (int v = 0; v < whole.num_vertices(); ++v) {
      if (whole.component(v) != c) continue;
      number[v] = static_cast<int>(control.points.size());
      control.points.push_back(all.points[v]);
    }
    for (int f = 0; f < whole.num_faces(); ++f) {
      const Face &face = whole.face(f);
      if (whole.component(face[0]) != c) continue;
      part->face.push_back(f);
      control.faces.push_back({number[face[0]], number[face[1]], number[face[2]]});
    }
    part->component = c;
    part->topology = Topology(static_cast<int>(control.points.size()), control.faces);
    part->surface = std::make_unique<LimitSurfaceOfMesh>(part->topology, control);
    part->finder = std::make_unique<ClosestPointFinder>(*part->surface);
    parts.push_back(std::move(part));
  }
}

BoundSearch::Found BoundSearch::find(const Vector3d &x) const
{
  Found found;
  double least = INFINITY;
  for (const auto &part : parts) {
    ClosestPoint closest = part->finder->find(x);
    const double away = (closest.foot - x).norm();
    if (away >= least) {
      if (away < found.next) {
        found.next = away;
        found.next_component = part->component;
      }
      continue;
    }
    closest.point.face = part->face[closest.point.face];
    found.next = least;
    found.next_component = found.component;
    least = away;
    found.closest = closest;
    found.component = part->component;
  }
  return found;
}
