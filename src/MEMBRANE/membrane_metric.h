/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

#ifndef LMP_MEMBRANE_METRIC_H
#define LMP_MEMBRANE_METRIC_H

#include "membrane_triangle_mesh.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

namespace Membrane_NS {

/** An approximate Hessian of the bending energy, for use as a preconditioner.

    P = (K + a M) diag(kc/m) (K + a M), the same for x, y, z: K the cotangent Laplacian of the control mesh,
    M = diag(m) the areas of its vertices, a = 4 pi / area of the component. On a sphere of radius R
    its eigenvalues are kc m (l(l+1) + 1)^2/R^4 next to kc m (l-1)l(l+1)(l+2)/R^4 of the energy. Cotangents
    are bounded from below so that P is positive definite on any mesh.

    K is factorised once (sparse Cholesky); solve() then costs two pairs of triangular solves. */
class BendingMetric {
 public:
  using Vectors = Eigen::Matrix<double, Eigen::Dynamic, 3>;

  /// kc: bending modulus at each vertex, positive; any units. Linear in memory and time but for the
  /// fill-in of the factorisation.
  BendingMetric(const TriangleMesh &mesh, const Topology &topology, const Eigen::VectorXd &kc);

  /// P^-1 f for one vector per vertex.
  Vectors solve(const Vectors &f) const;

 private:
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> laplacian_;
  Eigen::VectorXd compliance_;    // m/kc
};

}    // namespace Membrane_NS

#endif
