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

#include "membrane_limit_basis.h"
#include "membrane_limit_mask.h"
#include "one_rank.h"
#include "scene.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

using namespace Membrane_NS;
using namespace Membrane_TEST;

namespace {

struct Surface {
  Topology topology;
  OneRank part;
  LimitMask mask;

  explicit Surface(const TriangleMesh &mesh, bool direct = false, double tolerance = 1.0e-10) :
      topology(mesh.points.size(), mesh.faces), part(topology),
      mask(topology, part, {direct, tolerance})
  {
  }
  int size() const { return part.owned; }
};

}    // namespace

TEST(LimitMask, GivesTheLimitPositionsOfVertices)
{
  const TriangleMesh mesh = loop_refine(bipyramid(7));
  Surface surface(mesh);
  VertexField q(surface.size()), r(surface.size());
  for (int i = 0; i < surface.size(); ++i)
    for (int k = 0; k < 3; ++k) q[i].c[k] = mesh.points[surface.part.vertices[i]][k];
  surface.mask.apply(q, r);
  for (int i = 0; i < surface.size(); ++i) {
    const int v = surface.part.vertices[i], n = surface.topology.valence(v);
    const double c = limit_mask_centre(n);
    Vector3d limit = c * mesh.points[v];
    for (int w : surface.topology.ring(v)) limit += (1.0 - c) / n * mesh.points[w];
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(r[i].c[k], limit[k], 1e-14);
    EXPECT_EQ(surface.mask.centre(i), c);
    EXPECT_EQ(surface.mask.spoke(i), (1.0 - c) / n);
  }
}

TEST(LimitMask, SolvesToTheToleranceInThePassesItNames)
{
  for (int n : {3, 4, 5, 8, 12, 16})
    for (double tolerance : {1e-4, 1e-10}) {
      Surface surface(loop_refine(bipyramid(n)), false, tolerance);
      const VertexField b = rough(surface.size());
      VertexField x, product(surface.size());
      surface.mask.solve(b, x);
      surface.mask.apply(x, product);
      double square = 0.0, norm = 0.0;
      for (int i = 0; i < surface.size(); ++i)
        for (int k = 0; k < 3; ++k) {
          square += std::pow(product[i].c[k] - b[i].c[k], 2);
          norm += std::pow(b[i].c[k], 2);
        }
      EXPECT_LT(std::sqrt(square / norm), 3.0 * tolerance) << "valence " << n;
      EXPECT_LE(surface.mask.passes(), tolerance < 1e-5 ? 40 : 20) << "valence " << n;
    }
}

TEST(LimitMask, DirectSolverInvertsIt)
{
  Surface surface(icosphere(3, 1.0), true);
  const VertexField b = rough(surface.size());
  VertexField x, product(surface.size());
  surface.mask.solve(b, x);
  surface.mask.apply(x, product);
  for (int i = 0; i < surface.size(); ++i)
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(product[i].c[k], b[i].c[k], 1e-14);
}

TEST(LimitMask, TwoSolvesAtOnceAreTheSameAsOneAfterTheOther)
{
  for (bool direct : {true, false}) {
    Surface surface(loop_refine(bipyramid(9)), direct);
    const VertexField b = rough(surface.size());
    const VertexField c(b.rbegin(), b.rend());
    VertexField x(surface.size()), y(surface.size()), xs, ys;
    surface.mask.solve(b, x);
    surface.mask.solve(c, y);
    surface.mask.solve(b, c, xs, ys);
    for (int i = 0; i < surface.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(x[i].c[k], xs[i].c[k], 1e-14);
        EXPECT_NEAR(y[i].c[k], ys[i].c[k], 1e-14);
      }
  }
}

TEST(LimitMask, TheFourthNumberIsSolvedForTwiceInHalfOfThePassesEach)
{
  for (double tolerance : {1e-10, 1e-11, 1e-4})    // an odd number of passes and an even one
    for (int n : {3, 5, 6, 12}) {
      const TriangleMesh mesh = loop_refine(bipyramid(n));
      Surface surface(mesh, false, tolerance), direct(mesh, true);
      const int size = surface.size();
      VertexField b = rough(size), y(size), z(size), x, xs;
      std::vector<double> other(size);
      for (int i = 0; i < size; ++i) {
        b[i].c[3] = std::sin(3.0 * i);
        other[i] = std::cos(5.0 * i);
        y[i] = {{b[i].c[3], other[i], 0.0, 0.0}};
      }
      direct.mask.solve(y, z);
      surface.mask.solve(b, xs);
      surface.mask.solve(b, x, other);

      // the same as alone in as many passes

      const double root = std::sqrt(surface.mask.spectrum()[0]), rate = (1.0 - root) / (1.0 + root);
      const int passes = surface.mask.passes(), half = (passes + 1) / 2;
      VertexField first, second;
      Surface alone(mesh, false, 2.001 * std::pow(rate, half)), after(mesh, false, 2.001 * std::pow(rate, passes + 1 - half));
      alone.mask.solve(y, first);
      after.mask.solve(y, second);
      EXPECT_EQ(alone.mask.passes(), half);
      for (int i = 0; i < size; ++i) {
        EXPECT_NEAR(other[i], first[i].c[0], 1e-14);
        EXPECT_NEAR(x[i].c[3], second[i].c[1], 1e-14);
      }

      double error = 0.0, square = 0.0;
      for (int i = 0; i < size; ++i) {
        for (int k = 0; k < 3; ++k) EXPECT_EQ(x[i].c[k], xs[i].c[k]);
        error += std::pow(other[i] - z[i].c[0], 2) + std::pow(x[i].c[3] - z[i].c[1], 2);
        square += std::pow(z[i].c[0], 2) + std::pow(z[i].c[1], 2);
      }
      EXPECT_LT(std::sqrt(error / square), 4.0 * surface.mask.tolerance_of_half()) << "valence " << n;
      EXPECT_LT(surface.mask.tolerance_of_half(), 2.0 * std::sqrt(tolerance));
    }
}

TEST(LimitMask, BoundsOfTheSpectrumHoldAtEveryValence)
{
  for (int n = 3; n <= 16; ++n) {
    Surface surface(loop_refine(bipyramid(n)));
    const int size = surface.size();
    Eigen::MatrixXd mask = Eigen::MatrixXd::Zero(size, size);
    for (int v = 0; v < size; ++v) {
      const int valence = surface.topology.valence(v);
      mask(v, v) = limit_mask_centre(valence);
      for (int w : surface.topology.ring(v)) mask(v, w) += (1.0 - mask(v, v)) / valence;
    }
    const auto values = Eigen::EigenSolver<Eigen::MatrixXd>(mask, false).eigenvalues();
    EXPECT_LT(values.imag().cwiseAbs().maxCoeff(), 1e-7);
    EXPECT_GE(values.real().minCoeff(), surface.mask.spectrum()[0] - 1e-9);
    EXPECT_LE(values.real().maxCoeff(), surface.mask.spectrum()[1] + 1e-9);
  }
}
