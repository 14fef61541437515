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

#include "membrane_cotangent.h"

#include <algorithm>
#include <tuple>

using namespace Membrane_NS;
using Eigen::Vector3d;

static constexpr double LEAST_COTANGENT = 0.05;

// of twice the area, over the square of an edge
static constexpr double LEAST_AREA = 1.0e-12;

FlatAreas::FlatAreas(const TriangleMesh &mesh, const Topology &topology) :
    components(topology.num_components(), 0.0),
    vertices(Eigen::VectorXd::Zero(topology.num_vertices())),
    normals(topology.num_vertices(), Vector3d::Zero())
{
  faces.reserve(topology.num_faces());
  for (const Face &face : topology.faces()) {
    const Vector3d ab = mesh.edge(face[0], face[1]), ac = mesh.edge(face[0], face[2]);
    const Vector3d twice = ab.cross(ac);
    faces.push_back(0.5 * std::max(twice.norm(), LEAST_AREA * (ab - ac).squaredNorm()));
    components[topology.component(face[0])] += faces.back();
    for (int v : face) {
      vertices[v] += faces.back() / 3.0;
      normals[v] += twice;
    }
  }
  for (Vector3d &normal : normals) normal.normalize();
}

Eigen::SparseMatrix<double> Membrane_NS::cotangent_laplacian(const TriangleMesh &mesh,
                                                             const Topology &topology,
                                                             const std::vector<double> &weights)
{
  const int n = topology.num_vertices();
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(12 * static_cast<size_t>(topology.num_faces()));
  for (int f = 0; f < topology.num_faces(); ++f)
    for (int k = 0; k < 3; ++k) {
      // the edge from a to b, seen from the corner c opposite to it

      const Face &face = topology.face(f);
      const int c = face[k], a = face[(k + 1) % 3], b = face[(k + 2) % 3];
      const Vector3d ca = mesh.edge(c, a), cb = mesh.edge(c, b);
      const double twice_area = std::max(ca.cross(cb).norm(), LEAST_AREA * (ca - cb).squaredNorm());
      const double weight = 0.5 * weights[f] * std::max(ca.dot(cb) / twice_area, LEAST_COTANGENT);
      for (auto [i, j, w] : {std::tuple(a, b, -weight), std::tuple(b, a, -weight),
                             std::tuple(a, a, weight), std::tuple(b, b, weight)})
        entries.emplace_back(i, j, w);
    }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}
