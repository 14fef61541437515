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
#include "membrane_mesh_shapes.h"
#include "one_rank.h"
#include "scene.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace Membrane_NS;
using namespace Membrane_TEST;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

MatrixXd numbers(int rows, int columns, unsigned seed)
{
  Random random(seed);
  MatrixXd result(rows, columns);
  for (int i = 0; i < rows; ++i)
    for (int k = 0; k < columns; ++k) result(i, k) = random.symmetric();
  return result;
}

ColumnMap times(const MatrixXd &matrix)
{
  return [&matrix](const MatrixXd &x) -> MatrixXd { return matrix * x; };
}

// eigenvalues 1, 2, 2, 2, 5, 6, ... in a metric that is not 1

struct Problem {
  MatrixXd a, b, vectors;

  explicit Problem(int n)
  {
    const MatrixXd g = numbers(n, n, 1) + 4.0 * MatrixXd::Identity(n, n);
    b = g * g.transpose() / n;
    const Eigen::HouseholderQR<MatrixXd> qr(numbers(n, n, 2));
    const MatrixXd q = qr.householderQ();
    const Eigen::LLT<MatrixXd> root(b);
    VectorXd values = VectorXd::LinSpaced(n, 1.0, n);
    values[2] = values[3] = 2.0;
    const MatrixXd l = root.matrixL();
    a = l * q * values.asDiagonal() * q.transpose() * l.transpose();
    a = (0.5 * (a + a.transpose())).eval();
    vectors = l.transpose().triangularView<Eigen::Upper>().solve(q);
  }
};

}    // namespace

TEST(LowestEigenpairs, AreThoseOfADenseSolver)
{
  const int n = 120;
  const Problem problem(n);
  const MatrixXd rough = (problem.a + 3.0 * problem.b).inverse();
  const auto found = lowest_eigenpairs(6, numbers(n, 9, 3), MatrixXd(n, 0), times(problem.a), times(problem.b), times(rough),
                                       1e-9, 200);
  const double expected[] = {1, 2, 2, 2, 5, 6};
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(found.values[k], expected[k], 1e-10 * expected[k]) << k;
  EXPECT_LE(found.residuals.maxCoeff(), 1e-9);
  const MatrixXd unit = found.vectors.transpose() * problem.b * found.vectors;
  EXPECT_LT((unit - MatrixXd::Identity(6, 6)).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_LT(found.products, 600);
}

TEST(LowestEigenpairs, LeaveOutWhatIsExcluded)
{
  const int n = 80;
  const Problem problem(n);
  MatrixXd excluded(n, 3);    // the lowest, one of the three that are the same, and the first again
  excluded << problem.vectors.col(0), problem.vectors.col(2), 2.0 * problem.vectors.col(0);
  const MatrixXd rough = (problem.a + 3.0 * problem.b).inverse();
  const auto found = lowest_eigenpairs(3, numbers(n, 6, 3), excluded, times(problem.a), times(problem.b), times(rough),
                                       1e-9, 200);
  EXPECT_NEAR(found.values[0], 2.0, 1e-9);
  EXPECT_NEAR(found.values[1], 2.0, 1e-9);
  EXPECT_NEAR(found.values[2], 5.0, 1e-9);
  EXPECT_LT((excluded.transpose() * problem.b * found.vectors).cwiseAbs().maxCoeff(), 1e-9);
}

// as rigid motions along normals are, where displacements along a surface have a stiffness, too
TEST(LowestEigenpairs, LeaveOutWhatIsNoEigenvector)
{
  const int n = 80;
  const Problem problem(n);
  const MatrixXd excluded = numbers(n, 2, 5) + 3.0 * problem.vectors.leftCols(2);
  const MatrixXd rough = (problem.a + 3.0 * problem.b).inverse();
  const auto found = lowest_eigenpairs(4, numbers(n, 8, 3), excluded, times(problem.a), times(problem.b), times(rough),
                                       1e-9, 200);
  EXPECT_LE(found.residuals.maxCoeff(), 1e-9);

  // the same within the B-complement of the columns
  const MatrixXd q = Eigen::HouseholderQR<MatrixXd>(problem.b * excluded).householderQ();
  const MatrixXd rest = q.rightCols(n - 2);
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(rest.transpose() * problem.a * rest,
                                                                  rest.transpose() * problem.b * rest);
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(found.values[k], eigen.eigenvalues()[k], 1e-9 * found.values[k]) << k;
  EXPECT_LT((excluded.transpose() * problem.b * found.vectors).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(LowestEigenpairs, SayHowFarTheyCame)
{
  const int n = 60;
  const Problem problem(n);
  const MatrixXd one = MatrixXd::Identity(n, n);
  const auto found =
      lowest_eigenpairs(4, numbers(n, 6, 3), MatrixXd(n, 0), times(problem.a), times(problem.b), times(one), 1e-12, 3);
  EXPECT_GT(found.residuals.maxCoeff(), 1e-6);
  EXPECT_EQ(found.products, 6 + 3 * 6);
}

TEST(NormalMotion, MovesLimitPositionsAlongNormals)
{
  for (const TriangleMesh &mesh : {interpolate(icosphere(2, 1.0)), torus(12, 8, 2.0, 0.7)}) {
    NormalMotion motion(mesh, {false, false, false});
    const VectorXd phi = numbers(motion.size(), 1, 5);
    const VertexField dq = motion.displacement(phi);
    TriangleMesh moved = mesh;
    for (int i = 0; i < motion.size(); ++i) moved.points[i] += 1e-3 * Vector3d(dq[i].c);
    const auto before = limit_positions(mesh), after = limit_positions(moved);
    for (int i = 0; i < motion.size(); ++i) {
      const Vector3d along = (after[i] - before[i]) / 1e-3;
      EXPECT_NEAR(along.norm(), std::fabs(phi[i]), 1e-10);
      const bool sphere = mesh.points.size() == 162;
      EXPECT_TRUE(!sphere || std::fabs(along.dot(before[i]) - phi[i]) < 2e-3);
    }
  }
}

TEST(NormalMotion, HasForcesThatDoTheSameWork)
{
  NormalMotion motion(torus(12, 8, 2.0, 0.7), {false, false, false});
  const VectorXd phi = numbers(motion.size(), 1, 5);
  const VertexField f = rough(motion.size()), dq = motion.displacement(phi);
  double work = 0.0;
  for (int i = 0; i < motion.size(); ++i)
    for (int k = 0; k < 3; ++k) work += f[i].c[k] * dq[i].c[k];
  EXPECT_NEAR(motion.force(f).dot(phi), work, 1e-11);
}

// a sphere may turn as it likes, a torus about its axis

TEST(NormalMotion, KnowsRigidMotions)
{
  EXPECT_EQ(NormalMotion(interpolate(icosphere(3, 1.0)), {false, false, false}).rigid().cols(), 3);
  EXPECT_EQ(NormalMotion(torus(24, 16, 2.0, 0.7), {false, false, false}).rigid().cols(), 5);
  TriangleMesh egg = icosphere(2, 1.0);
  for (auto &point : egg.points) point = point.cwiseProduct(Vector3d(1.0, 1.3, 1.7));
  EXPECT_EQ(NormalMotion(egg, {false, false, false}).rigid().cols(), 6);
}

// what goes along itself through the box is where it was, also where rounding or a minimization has left it uneven

TEST(NormalMotion, HasNoTranslationsAlongSheetsAndTubes)
{
  Eigen::Matrix3d lattice = Eigen::Vector3d(8.0, 4.0 * std::sqrt(3.0), 8.0).asDiagonal();
  TriangleMesh flat = sheet(16, 16, lattice, 0.5), pipe = tube(16, 20, 1.5, lattice, 2);
  for (TriangleMesh *mesh : {&flat, &pipe}) {
    mesh->lattice = lattice;
    mesh->periodic = {mesh == &flat, mesh == &flat, mesh == &pipe};
  }
  const VectorXd noise = numbers(static_cast<int>(flat.points.size()), 1, 7);
  for (double uneven : {0.0, 1e-12, 1e-4}) {
    TriangleMesh mesh = flat;
    for (size_t v = 0; v < mesh.points.size(); ++v) mesh.points[v][2] += uneven * noise[v];
    EXPECT_EQ(NormalMotion(mesh, {true, true, false}).rigid().cols(), 1) << uneven;
  }
  EXPECT_EQ(NormalMotion(pipe, {false, false, true}).rigid().cols(), 2);
}

TEST(NormalMotion, PreconditionsByThePlatesOwnStiffness)
{
  // harmonics of a unit sphere: about 1/(l (l + 1))^2 for each area

  const TriangleMesh mesh = interpolate(icosphere(3, 1.0));
  NormalMotion motion(mesh, {false, false, false});
  MatrixXd phi(motion.size(), 2);
  for (int i = 0; i < motion.size(); ++i) {
    const Vector3d r = mesh.points[i].normalized();
    phi.row(i) << r.x() * r.y(), r.x() * r.y() * r.z();
  }
  const MatrixXd soft = motion.soften(motion.areas().asDiagonal() * phi);
  const double shift = 1.0 / motion.areas().sum();
  for (int k = 0; k < 2; ++k) {
    const int l = k + 2;
    const double expected = 1.0 / std::pow(l * (l + 1) + shift, 2);
    const double measured = soft.col(k).dot(phi.col(k)) / phi.col(k).squaredNorm();
    EXPECT_NEAR(measured / expected, 1.0, 0.06);
  }
}
