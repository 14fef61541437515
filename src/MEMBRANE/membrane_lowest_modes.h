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

#ifndef LMP_MEMBRANE_LOWEST_MODES_H
#define LMP_MEMBRANE_LOWEST_MODES_H

#include "membrane_cholesky.h"
#include "membrane_limit_mask.h"
#include "membrane_triangle_mesh.h"

#include <Eigen/Dense>

#include <array>
#include <functional>
#include <vector>

namespace Membrane_NS {

/// A linear map on columns, [n][columns].
using ColumnMap = std::function<Eigen::MatrixXd(const Eigen::MatrixXd &)>;

/// A x = lambda B x
struct Eigenpairs {
  Eigen::VectorXd values;       ///< increasing
  Eigen::MatrixXd vectors;      ///< x^T B x = 1
  Eigen::VectorXd residuals;    ///< |A x - lambda B x|, less B times excluded columns, over the largest |A x| of these
  int products;                 ///< of A with a column
};

/** The lowest eigenpairs of symmetric A and positive definite B, where A need not be known but by its
    products: LOBPCG [A. Knyazev, SIAM J. Sci. Comput. 23, 517 (2001)] in an orthonormal basis [U. Hetmaniuk and
    R. Lehoucq, J. Comput. Phys. 218, 324 (2006)].

    start: [n][count or more]; more converge faster. precondition: about A^-1. excluded: [n][any], all
    eigenvectors are B-orthogonal to these columns. Stops at residuals below the tolerance or after so many
    passes; then residuals say how far it came. */
Eigenpairs lowest_eigenpairs(int count, const Eigen::MatrixXd &start, const Eigen::MatrixXd &excluded,
                             const ColumnMap &a, const ColumnMap &b, const ColumnMap &precondition, double tolerance,
                             int most_passes);

/** Motion of one membrane along its normals: phi, a number for each vertex, moves the limit position of the
    vertex by phi n, so control points by dq = L^-1 (n phi). What moves points within the surface is left
    out: it changes no shape. */
class NormalMotion {
 public:
  /// A mesh of one component. continues: along which box vectors it has no end.
  NormalMotion(const TriangleMesh &mesh, const std::array<bool, 3> &continues);

  int size() const { return topology_.num_vertices(); }
  /// Areas of the flat faces that vertices share.
  const Eigen::VectorXd &areas() const { return areas_; }
  /// dq
  VertexField displacement(const Eigen::VectorXd &phi);
  /// n L^-T f: forces on phi.
  Eigen::VectorXd force(const VertexField &f);
  /// phi of rigid motions: translations, and turns that the box allows.
  const Eigen::MatrixXd &rigid() const { return rigid_; }
  /// About the inverse of the stiffness of a membrane of bending modulus 1.
  Eigen::MatrixXd soften(const Eigen::MatrixXd &phi);

 private:
  Topology topology_;
  struct All : VertexPart {
    explicit All(const Topology &);
  } part_;
  LimitMask mask_;
  std::vector<Eigen::Vector3d> normals_;    // of the limit surface at vertices
  Eigen::VectorXd areas_;
  Eigen::MatrixXd rigid_;
  SparseCholesky laplacian_;    // and a little more, so that it has an inverse
};

}    // namespace Membrane_NS

#endif
