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

#include "membrane_mass_reference.h"

#include "membrane_cholesky.h"
#include "membrane_cotangent.h"

#include <cmath>

using namespace Membrane_NS;
using Eigen::Map;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using SparseMatrix = Eigen::SparseMatrix<double>;

/* ---------------------------------------------------------------------- */

double StiffnessReference::distance(const TriangleMesh &now, const Topology &topology) const
{
  const FlatAreas before(shape, topology), after(now, topology);
  double sum = 0.0;
  for (int v = 0; v < topology.num_vertices(); ++v)
    sum += 1.0 - before.normals[v].dot(after.normals[v]);
  return sum / topology.num_vertices();
}

/* ----------------------------------------------------------------------
   (1 + (L/CUTOFF)^2) x = x0 with the Laplacian L of the graph of edges, for x - x0, which has no jumps
   at the box. On a regular mesh L is 3/2 (q h)^2, so waves of 11 edges are halved
------------------------------------------------------------------------- */

static constexpr double CUTOFF = 0.5;

static std::vector<Vector3d> without_short_waves(const TriangleMesh &shape, const Topology &topology)
{
  const int n = topology.num_vertices();
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<Vector3d> bent(n, Vector3d::Zero());
  for (int v = 0; v < n; ++v)
    for (int w : topology.ring(v)) {
      entries.emplace_back(v, v, 1.0 / CUTOFF);
      entries.emplace_back(v, w, -1.0 / CUTOFF);
      bent[v] -= shape.edge(v, w) / CUTOFF;
    }
  SparseMatrix laplacian(n, n), one(n, n);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  one.setIdentity();
  VertexField change(n, Vector4{});
  for (int v = 0; v < n; ++v)
    for (SparseMatrix::InnerIterator at(laplacian, v); at; ++at)
      Map<Vector3d>(change[v].c) -= at.value() * bent[at.row()];
  SparseCholesky(one + laplacian * laplacian).solve(change);

  std::vector<Vector3d> points = shape.points;
  for (int v = 0; v < n; ++v) points[v] += Map<Vector3d>(change[v].c);
  return points;
}

// across the box vectors along which a component continues

static std::vector<Matrix3d> free_directions(const TriangleMesh &shape, const Topology &topology)
{
  std::vector<Matrix3d> free(topology.num_components(), Matrix3d::Identity());
  if (!shape.is_periodic()) return free;
  const Matrix3d fractions = shape.lattice.inverse();
  for (int v = 0; v < topology.num_vertices(); ++v)
    for (int w : topology.ring(v)) {
      const Vector3d jump = shape.edge(v, w) - (shape.points[w] - shape.points[v]);
      const Vector3d boxes = fractions * jump;
      Matrix3d &across = free[topology.component(v)];
      for (int k = 0; k < 3; ++k) {
        if (std::fabs(boxes[k]) < 0.5) continue;
        const Vector3d along = across * shape.lattice.col(k);
        if (along.norm() > 1e-6 * shape.lattice.col(k).norm())
          across -= along * along.transpose() / along.squaredNorm();
      }
    }
  return free;
}

/* ----------------------------------------------------------------------
   a vesicle or tube as a whole has shrunk, the more the fewer its points: the linear map of the smooth
   shape that is nearest to the given one gives it back
------------------------------------------------------------------------- */

TriangleMesh Membrane_NS::long_waves(const TriangleMesh &shape, const Topology &topology)
{
  const int n = topology.num_vertices(), ncomponents = topology.num_components();
  TriangleMesh smooth = shape;
  smooth.points = without_short_waves(shape, topology);

  std::vector<Vector3d> middle(ncomponents, Vector3d::Zero());
  for (int v = 0; v < n; ++v) {
    const int c = topology.component(v);
    middle[c] += smooth.points[v] / topology.num_vertices(c);
  }
  const std::vector<Matrix3d> free = free_directions(shape, topology);
  std::vector<Matrix3d> moment(ncomponents, Matrix3d::Zero()), lost = moment;
  for (int v = 0; v < n; ++v) {
    const int c = topology.component(v);
    const Vector3d arm = free[c] * (smooth.points[v] - middle[c]);
    moment[c] += arm * arm.transpose();
    lost[c] += (shape.points[v] - smooth.points[v]) * arm.transpose();
  }
  for (int c = 0; c < ncomponents; ++c)
    if (free[c].trace() < 1.5)
      lost[c].setZero();    // a sheet
    else
      lost[c] *= moment[c].completeOrthogonalDecomposition().pseudoInverse() * free[c];
  for (int v = 0; v < n; ++v) {
    const int c = topology.component(v);
    smooth.points[v] += lost[c] * (smooth.points[v] - middle[c]);
  }
  return smooth;
}
