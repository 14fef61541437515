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

#include "membrane_cholesky.h"

#include "membrane_mesh_shapes.h"
#include "membrane_topology.h"
#include "scene.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

using namespace Membrane_NS;
using namespace Membrane_TEST;

namespace {

/// Positive definite, with entries for vertices that are up to so many edges apart.
Eigen::SparseMatrix<double> matrix_of(const TriangleMesh &mesh, int edges, Random &random)
{
  const Topology topology = topology_of(mesh);
  const int n = topology.num_vertices();
  std::vector<Eigen::Triplet<double>> entries;
  for (int v = 0; v < n; ++v) {
    entries.emplace_back(v, v, 10.0 + random.uniform());
    for (int w : topology.ring(v))
      if (v < w) {
        const double value = random.symmetric();
        entries.emplace_back(v, w, value);
        entries.emplace_back(w, v, value);
      }
  }
  Eigen::SparseMatrix<double> a(n, n), b;
  a.setFromTriplets(entries.begin(), entries.end());
  b = a;
  for (int k = 1; k < edges; ++k) b = Eigen::SparseMatrix<double>(b * a);
  return b;
}

std::vector<Eigen::SparseMatrix<double>> matrices()
{
  // panels of all widths: none but the diagonal, chains, full ones, surfaces

  Random random(3);
  std::vector<Eigen::SparseMatrix<double>> list;
  Eigen::SparseMatrix<double> diagonal(5, 5), chain(40, 40);
  for (int i = 0; i < 5; ++i) diagonal.insert(i, i) = 1.0 + i;
  for (int i = 0; i < 40; ++i) {
    chain.insert(i, i) = 2.5;
    if (i > 0) chain.insert(i, i - 1) = chain.insert(i - 1, i) = -1.0;
  }
  list.push_back(diagonal);
  list.push_back(chain);
  for (int n : {1, 2, 5, 6, 7, 13, 20}) {
    Eigen::MatrixXd full = Eigen::MatrixXd::Identity(n, n) * 2.0 * n;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < i; ++j) full(i, j) = full(j, i) = random.symmetric();
    list.push_back(full.sparseView());
  }
  for (int edges : {1, 2, 3}) list.push_back(matrix_of(icosphere(2, 1.0), edges, random));
  return list;
}

}    // namespace

TEST(SparseCholesky, SolvesForOneTwoAndSingleNumbers)
{
  Random random(4);
  for (const auto &a : matrices()) {
    const int n = static_cast<int>(a.rows());
    const Eigen::MatrixXd inverse = Eigen::MatrixXd(a).inverse();
    SparseCholesky factor(a.triangularView<Eigen::Lower>());
    ASSERT_EQ(factor.size(), n);
    VertexField x(n), y(n);
    std::vector<double> s(n);
    Eigen::MatrixXd of_x(n, 4), of_y(n, 4);
    Eigen::VectorXd of_s(n);
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < 4; ++k) {
        x[i].c[k] = of_x(i, k) = random.symmetric();
        y[i].c[k] = of_y(i, k) = random.symmetric();
      }
      s[i] = of_s[i] = random.symmetric();
    }
    VertexField one = x;
    factor.solve(one);
    factor.solve(x, y);
    factor.solve(s);
    of_x = inverse * of_x;
    of_y = inverse * of_y;
    of_s = inverse * of_s;
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < 4; ++k) {
        EXPECT_NEAR(one[i].c[k], of_x(i, k), 1e-14);
        EXPECT_NEAR(x[i].c[k], of_x(i, k), 1e-14);
        EXPECT_NEAR(y[i].c[k], of_y(i, k), 1e-14);
      }
      EXPECT_NEAR(s[i], of_s[i], 1e-14);
    }
  }
}

TEST(SparseCholesky, ColoursNoiseByTheInverse)
{
  for (const auto &a : matrices()) {
    const int n = static_cast<int>(a.rows());
    SparseCholesky factor(a);
    Eigen::MatrixXd root(n, n);
    for (int j = 0; j < n; ++j) {
      VertexField x(n, Vector4{});
      std::vector<double> s(n, 0.0);
      x[j].c[1] = s[j] = 1.0;
      factor.colour(x);
      factor.colour(s);
      for (int i = 0; i < n; ++i) {
        root(i, j) = s[i];
        EXPECT_NEAR(x[i].c[1], s[i], 1e-14);
        EXPECT_EQ(x[i].c[0], 0.0);
      }
    }
    EXPECT_LT((root * root.transpose() - Eigen::MatrixXd(a).inverse()).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(SparseCholesky, SolvesAndColoursAtOnce)
{
  Random random(5);
  for (const auto &a : matrices()) {
    const int n = static_cast<int>(a.rows());
    SparseCholesky factor(a);
    VertexField x(n), z(n);
    std::vector<double> s(n), t(n);
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < 4; ++k) {
        x[i].c[k] = random.symmetric();
        z[i].c[k] = random.symmetric();
      }
      s[i] = random.symmetric();
      t[i] = random.symmetric();
    }
    VertexField solved = x, coloured = z;
    std::vector<double> solved_s = s, coloured_t = t;
    factor.solve(solved);
    factor.colour(coloured);
    factor.solve(solved_s);
    factor.colour(coloured_t);
    factor.solve_and_colour(x, z);
    factor.solve_and_colour(s, t);
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < 4; ++k) {
        EXPECT_NEAR(x[i].c[k], solved[i].c[k], 1e-14);
        EXPECT_NEAR(z[i].c[k], coloured[i].c[k], 1e-14);
      }
      EXPECT_NEAR(s[i], solved_s[i], 1e-14);
      EXPECT_NEAR(t[i], coloured_t[i], 1e-14);
    }
  }
}

TEST(SparseCholesky, StoresFewZeros)
{
  Random random(5);
  const auto a = matrix_of(icosphere(3, 1.0), 1, random);
  const SparseCholesky factor(a);
  EXPECT_LT(factor.fill(), 16500u);    // beside the 14,647 numbers of G
}

TEST(SparseCholesky, NotPositiveDefiniteIsAnError)
{
  Eigen::SparseMatrix<double> a(2, 2);
  a.insert(0, 0) = 1.0;
  a.insert(1, 1) = -1.0;
  EXPECT_THROW(SparseCholesky{a}, MeshError);
}
