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

#include "membrane_lowest_modes.h"

#include "membrane_cotangent.h"
#include "membrane_curvature.h"

#include <algorithm>
#include <cmath>

using namespace Membrane_NS;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// a direction that others have but for this part of its square is none of its own
static constexpr double DEPENDENT = 1.0e-10;

// a translation or turn that moves a surface along its normals by less than this part of what one can does not move it
static constexpr double STILL = 1.0e-3;

namespace {

/// Columns that are orthonormal in B, with their products.
struct Basis {
  MatrixXd x, ax, bx;

  Basis combined(const MatrixXd &c) const { return {x * c, ax * c, bx * c}; }
};

MatrixXd beside(const MatrixXd &a, const MatrixXd &b)
{
  MatrixXd both(a.rows(), a.cols() + b.cols());
  both << a, b;
  return both;
}

Basis beside(const Basis &a, const Basis &b)
{
  return {beside(a.x, b.x), beside(a.ax, b.ax), beside(a.bx, b.bx)};
}

// columns that span the same and are orthonormal in a metric, fewer if they depend on one another

MatrixXd orthonormal(const MatrixXd &gram, double dependent)
{
  const VectorXd scale = gram.diagonal().cwiseMax(1.0e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scale.asDiagonal() * gram * scale.asDiagonal());
  const VectorXd &values = eigen.eigenvalues();
  const Eigen::Index first = (values.array() <= dependent * values.maxCoeff()).count(), n = values.size() - first;
  return scale.asDiagonal() * eigen.eigenvectors().rightCols(n) *
      values.tail(n).cwiseSqrt().cwiseInverse().asDiagonal();
}

// w less what lies in a space, made orthonormal; twice, since once leaves rounding errors of what was taken out

void separate(MatrixXd &w, MatrixXd &bw, const MatrixXd &from, const MatrixXd &b_from, const ColumnMap &b)
{
  for (int pass = 0; pass < 2 && w.cols() > 0; ++pass) {
    w -= from * (b_from.transpose() * w);
    bw = b(w);
    const MatrixXd turn = orthonormal(w.transpose() * bw, DEPENDENT);
    w = (w * turn).eval();
    bw = (bw * turn).eval();
  }
}

/// Rayleigh and Ritz: coefficients of eigenvectors in a basis, eigenvalues increasing.
Eigen::SelfAdjointEigenSolver<MatrixXd> ritz(const Basis &basis)
{
  const MatrixXd product = basis.x.transpose() * basis.ax;
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(0.5 * (product + product.transpose()));
}

}    // namespace

/* ----------------------------------------------------------------------
   Each pass looks for better vectors in the space of the present ones x, of preconditioned residuals w and of
   the last changes p. With S = [x p w] orthonormal the coefficients C of the new x are; those of the
   new p are the parts of C in p and w, less what of them lies in C.
------------------------------------------------------------------------- */

Eigenpairs Membrane_NS::lowest_eigenpairs(int count, const MatrixXd &start, const MatrixXd &excluded,
                                          const ColumnMap &a, const ColumnMap &b, const ColumnMap &precondition,
                                          double tolerance, int most_passes)
{
  Eigenpairs result;
  MatrixXd none(start.rows(), 0), kept_out = excluded, b_kept_out = none;
  separate(kept_out, b_kept_out, none, none, b);

  Basis now;
  now.x = start;
  separate(now.x, now.bx, kept_out, b_kept_out, b);
  now.ax = a(now.x);
  result.products = static_cast<int>(now.x.cols());
  auto eigen = ritz(now);
  now = now.combined(eigen.eigenvectors());
  Basis change = {none, none, none};
  const Eigen::Index m = now.x.cols();
  count = std::min<int>(count, static_cast<int>(m));

  for (int pass = 0;; ++pass) {
    result.values = eigen.eigenvalues().head(m);
    MatrixXd residual = now.ax - now.bx * result.values.asDiagonal();
    residual -= b_kept_out * (kept_out.transpose() * residual);    // there nothing can be done about it, if they are no eigenvectors
    const double largest = now.ax.leftCols(count).colwise().norm().maxCoeff();
    result.residuals = residual.leftCols(count).colwise().norm().transpose() / largest;
    if (pass == most_passes || result.residuals.maxCoeff() <= tolerance) break;

    const Basis known = beside(now, change);
    Basis next;
    next.x = precondition(residual);
    separate(next.x, next.bx, beside(known.x, kept_out), beside(known.bx, b_kept_out), b);
    if (next.x.cols() == 0) break;
    next.ax = a(next.x);
    result.products += static_cast<int>(next.x.cols());

    const Basis all = beside(known, next);
    eigen = ritz(all);
    const MatrixXd c = eigen.eigenvectors().leftCols(m);
    MatrixXd p = c;
    p.topRows(m).setZero();
    p -= c * (c.transpose() * p);
    p = (p * orthonormal(p.transpose() * p, DEPENDENT)).eval();
    now = all.combined(c);
    change = all.combined(p);
  }
  result.values.conservativeResize(count);
  result.vectors = now.x.leftCols(count);
  return result;
}

/* ---------------------------------------------------------------------- */

NormalMotion::All::All(const Topology &topology)
{
  owned = topology.num_vertices();
  for (int v = 0; v < owned; ++v) vertices.push_back(v);
  order(topology);
}

static std::vector<Vector3d> limit_normals(const TriangleMesh &mesh, const Topology &topology)
{
  std::vector<Vector3d> normals;
  for (int v = 0; v < topology.num_vertices(); ++v) {
    const auto weights = vertex_weights(topology.valence(v));
    Vector3d u = Vector3d::Zero(), w = Vector3d::Zero();
    for (int k = 0; k < topology.valence(v); ++k) {
      const Vector3d arm = mesh.edge(v, topology.ring(v)[k]);
      u += weights(LimitBasis::DU, k + 1) * arm;
      w += weights(LimitBasis::DV, k + 1) * arm;
    }
    normals.push_back(u.cross(w).normalized());
  }
  return normals;
}

// (cotangents + areas/A): stiffness of bending is about its square over areas

static Eigen::SparseMatrix<double> helmholtz(const TriangleMesh &mesh, const Topology &topology, const VectorXd &areas)
{
  Eigen::SparseMatrix<double> matrix =
      cotangent_laplacian(mesh, topology, std::vector<double>(topology.num_faces(), 1.0));
  for (int v = 0; v < topology.num_vertices(); ++v) matrix.coeffRef(v, v) += areas[v] / areas.sum();
  return matrix;
}

NormalMotion::NormalMotion(const TriangleMesh &mesh, const std::array<bool, 3> &continues) :
    topology_(static_cast<int>(mesh.points.size()), mesh.faces), part_(topology_),
    mask_(topology_, part_, {true, 1.0e-14}), normals_(limit_normals(mesh, topology_)),
    areas_(FlatAreas(mesh, topology_).vertices), laplacian_(helmholtz(mesh, topology_, areas_))
{
  const int n = size();
  MatrixXd moves(n, 3), turns(n, 3);
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d &point : mesh.points) middle += point / n;
  const auto open = std::count(continues.begin(), continues.end(), true);
  for (int v = 0; v < n; ++v) {
    moves.row(v) = normals_[v];
    const Vector3d turn = (mesh.points[v] - middle).cross(normals_[v]);
    for (int k = 0; k < 3; ++k)
      turns(v, k) = open == 0 ? turn[k] : open == 1 && continues[k] ? turn.dot(mesh.lattice.col(k).normalized()) : 0.0;
  }

  // those that are no symmetry of the shape: a sheet or tube that goes along itself through the box does not move

  rigid_.resize(n, 0);
  turns /= std::sqrt(areas_.sum());
  for (const MatrixXd *motions : {&moves, &turns}) {
    const MatrixXd weighted = areas_.asDiagonal() * *motions;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(motions->transpose() * weighted);
    for (int k = 0; k < 3; ++k)
      if (eigen.eigenvalues()[k] > STILL * areas_.sum()) {
        rigid_.conservativeResize(Eigen::NoChange, rigid_.cols() + 1);
        rigid_.rightCols(1) = *motions * eigen.eigenvectors().col(k);
      }
  }
}

VertexField NormalMotion::displacement(const VectorXd &phi)
{
  const int n = size();
  VertexField b(n), x(n), dq(n);
  for (int i = 0; i < n; ++i) {
    const Vector3d along = phi[part_.vertices[i]] * normals_[part_.vertices[i]];
    b[i] = {{along[0], along[1], along[2], 0.0}};
  }
  mask_.solve(b, x);
  for (int i = 0; i < n; ++i) dq[part_.vertices[i]] = x[i];
  return dq;
}

// L^-T f = (1/e) L^-1 (e f)

VectorXd NormalMotion::force(const VertexField &f)
{
  const int n = size();
  VertexField b(n), x(n);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < 4; ++k) b[i].c[k] = mask_.spoke(i) * f[part_.vertices[i]].c[k];
  mask_.solve(b, x);
  VectorXd along(n);
  for (int i = 0; i < n; ++i)
    along[part_.vertices[i]] = normals_[part_.vertices[i]].dot(Vector3d(x[i].c)) / mask_.spoke(i);
  return along;
}

MatrixXd NormalMotion::soften(const MatrixXd &phi)
{
  MatrixXd result(phi.rows(), phi.cols());
  std::vector<double> column(phi.rows());
  for (Eigen::Index k = 0; k < phi.cols(); ++k) {
    VectorXd::Map(column.data(), phi.rows()) = phi.col(k);
    laplacian_.solve(column);
    VectorXd::Map(column.data(), phi.rows()).array() *= areas_.array();
    laplacian_.solve(column);
    result.col(k) = VectorXd::Map(column.data(), phi.rows());
  }
  return result;
}
