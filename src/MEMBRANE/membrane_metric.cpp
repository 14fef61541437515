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

#include "membrane_metric.h"

#include <algorithm>
#include <cmath>

using namespace Membrane_NS;
using Eigen::Vector3d;

static constexpr double LEAST_COTANGENT = 0.05;

BendingMetric::BendingMetric(const TriangleMesh &mesh, const Topology &topology,
                             const Eigen::VectorXd &kc)
{
  const int n = topology.num_vertices();
  Eigen::VectorXd area = Eigen::VectorXd::Zero(n);
  std::vector<double> component_area(topology.num_components(), 0.0);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(12 * static_cast<size_t>(topology.num_faces()) + n);

  for (const Face &face : topology.faces())
    for (int k = 0; k < 3; ++k) {
      // the edge from a to b, seen from the corner c opposite to it

      const int c = face[k], a = face[(k + 1) % 3], b = face[(k + 2) % 3];
      const Vector3d ca = mesh.edge(c, a), cb = mesh.edge(c, b);
      const double twice_area = std::max(ca.cross(cb).norm(), 1.0e-12 * (ca - cb).squaredNorm());
      const double weight = 0.5 * std::max(ca.dot(cb) / twice_area, LEAST_COTANGENT);
      for (auto [i, j, w] : {std::tuple(a, b, -weight), std::tuple(b, a, -weight),
                             std::tuple(a, a, weight), std::tuple(b, b, weight)})
        entries.emplace_back(i, j, w);
      area[c] += twice_area / 6.0;
      component_area[topology.component(c)] += twice_area / 6.0;
    }
  for (int v = 0; v < n; ++v)
    entries.emplace_back(v, v, 4.0 * M_PI * area[v] / component_area[topology.component(v)]);

  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  laplacian_.compute(matrix);
  compliance_ = area.cwiseQuotient(kc);
}

BendingMetric::Vectors BendingMetric::solve(const Vectors &f) const
{
  Vectors first = laplacian_.solve(f);
  first.array().colwise() *= compliance_.array();
  return laplacian_.solve(first);
}
