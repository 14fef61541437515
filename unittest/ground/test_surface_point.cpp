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

#include "count_allocations.h"
#include "membrane_closest_point.h"
#include "membrane_stencil.h"
#include "surface_scene.h"

#include "gtest/gtest.h"

using namespace Membrane_TEST;

namespace {

// === Values and derivatives

TEST(SurfacePoint, AgreesWithTheLimitBasisToSecondOrder)
{
  double worst[LimitBasis::ROWS] = {};
  for (const TriangleMesh &mesh : rough_meshes()) {
    const SurfaceScene scene(mesh);
    Random random(11);
    for (int i = 0; i < how_many(300, 3000); ++i) {
      const SurfacePoint p = random_point(scene.topology, random, true);
      StencilPoints control;
      stencil_points(scene.topology, mesh, p.face, control);
      const LimitBasis::Weights weights =
          LimitBasis(scene.topology.valences(p.face)).evaluate(p.u, p.v);
      const SurfaceJet jet = scene.surface.evaluate<3>(p);
      for (int row = 0; row < LimitBasis::ROWS; ++row) {
        const Vector3d expected = (weights.row(row) * control).transpose();
        const double size = std::max(1.0, expected.norm());
        worst[row] = std::max(worst[row], (jet.row(row) - expected).norm() / size);
      }
    }
  }
  for (int row = 0; row < LimitBasis::ROWS; ++row)
    RecordProperty("worst_" + std::to_string(row), scientific(worst[row]));
  EXPECT_LT(worst[LimitBasis::VALUE], 1.0e-13);
  for (int row : {LimitBasis::DU, LimitBasis::DV}) EXPECT_LT(worst[row], 1.0e-12);
  for (int row : {LimitBasis::DUU, LimitBasis::DUV, LimitBasis::DVV})
    EXPECT_LT(worst[row], 1.0e-11);
}

// the derivative of a row by u or v from differences of the row; exact for polynomials of degree 4

Vector3d difference(const LimitSurface &surface, const SurfacePoint &p, int row, bool by_u,
                    double h)
{
  auto value = [&](double steps) {
    return surface
        .evaluate<3>({p.face, p.u + (by_u ? steps * h : 0.0), p.v + (by_u ? 0.0 : steps * h)})
        .row(row);
  };
  return (8.0 * (value(1) - value(-1)) - (value(2) - value(-2))) / (12.0 * h);
}

struct Slope {
  Derivative::Row of;
  bool by_u;
  Derivative::Row is;
  int order;
};

const Slope SLOPES[] = {
    {Derivative::VALUE, true, Derivative::DU, 1}, {Derivative::VALUE, false, Derivative::DV, 1},
    {Derivative::DU, true, Derivative::DUU, 2},   {Derivative::DU, false, Derivative::DUV, 2},
    {Derivative::DV, true, Derivative::DUV, 2},   {Derivative::DV, false, Derivative::DVV, 2},
    {Derivative::DUU, true, Derivative::DUUU, 3}, {Derivative::DUU, false, Derivative::DUUV, 3},
    {Derivative::DUV, true, Derivative::DUUV, 3}, {Derivative::DUV, false, Derivative::DUVV, 3},
    {Derivative::DVV, true, Derivative::DUVV, 3}, {Derivative::DVV, false, Derivative::DVVV, 3},
};

// Near an extraordinary corner a derivative of order m is what rounding leaves of numbers that
// are as large as the mesh times scale^m, scale being 2 to the number of cuts: that is the unit of errors.

TEST(SurfacePoint, DerivativesToThirdOrderAreThoseOfDifferences)
{
  double worst[4] = {};
  int close = 0;
  for (const TriangleMesh &mesh : rough_meshes()) {
    const SurfaceScene scene(mesh);
    LimitPatches patches;
    Random random(12);
    for (int i = 0; i < how_many(200, 4000); ++i) {
      const SurfacePoint p = random_point(scene.topology, random, true);
      const RegularPart part = patches.get(scene.topology.valences(p.face)).part_at(p.u, p.v);
      const double scale = std::fabs(part.scale), h = 1.0 / 64.0 / scale;
      bool inside = true;    // of one polynomial
      for (double s : {-2.0 * h, 2.0 * h})
        inside = inside && part.contains(p.u + s, p.v) && part.contains(p.u, p.v + s);
      if (!inside) continue;
      close += scale > 1000.0;
      const SurfaceJet jet = scene.surface.evaluate<3>(p);
      for (const Slope &slope : SLOPES) {
        const Vector3d expected = difference(scene.surface, p, slope.of, slope.by_u, h);
        const double unit = std::pow(scale, slope.order) + expected.norm();
        worst[slope.order] =
            std::max(worst[slope.order], (jet.row(slope.is) - expected).norm() / unit);
      }
    }
  }
  for (int order : {1, 2, 3})
    RecordProperty("worst_" + std::to_string(order), scientific(worst[order]));
  EXPECT_GT(close, 100);
  for (int order : {1, 2, 3}) EXPECT_LT(worst[order], 2.0e-12) << "order " << order;
}

TEST(SurfacePoint, RowsBeyondTheOrderAreZeroAndTheOthersTheSame)
{
  const SurfaceScene scene(perturbed(bipyramid(5), 0.1, 1));
  const SurfacePoint p = {3, 0.3, 0.25};
  const SurfaceJet full = scene.surface.evaluate<3>(p), first = scene.surface.evaluate<1>(p);
  for (int row = 0; row < Derivative::ROWS; ++row)
    EXPECT_LT((first.row(row) - (row < 3 ? full.row(row) : Vector3d::Zero())).norm(), 1.0e-15);
}

TEST(SurfacePoint, CurvaturesAreThoseOfATorus)
{
  const double R = 2.0, r = 0.8;
  const SurfaceScene scene(interpolate(torus(80, 40, R, r)));
  Random random(13);
  for (int i = 0; i < 300; ++i) {
    const LimitPoint point =
        scene.surface.evaluate<2>(random_point(scene.topology, random)).limit_point();
    const double ring = std::hypot(point.position[0], point.position[1]), cosine = (ring - R) / r;
    EXPECT_NEAR(point.mean_curvature, (R + 2.0 * r * cosine) / (2.0 * r * (R + r * cosine)), 0.01);
    EXPECT_NEAR(point.gaussian_curvature, cosine / (r * (R + r * cosine)), 0.01);
    const Vector3d out(point.position[0] / ring * cosine, point.position[1] / ring * cosine,
                       point.position[2] / r);
    EXPECT_GT(point.normal.dot(out), 0.999);
  }
}

TEST(SurfacePoint, AtAnExtraordinaryCornerItDoesAsTheLimitBasis)
{
  for (int n : {3, 4, 5, 7, 12, 20}) {
    const SurfaceScene scene(perturbed(bipyramid(n), 0.1, 7));
    for (int f = 0; f < scene.topology.num_faces(); ++f)
      for (int k = 0; k < 3; ++k) {
        if (scene.topology.valence(scene.topology.face(f)[k]) == 6) continue;
        StencilPoints control;
        stencil_points(scene.topology, scene.mesh, f, control);
        const SurfacePoint p = SurfacePoint::at_corner(f, k);
        const Eigen::MatrixXd expected =
            LimitBasis(scene.topology.valences(f)).evaluate(p.u, p.v) * control;
        const SurfaceJet jet = scene.surface.evaluate<2>(p);
        EXPECT_EQ(scene.surface.corner_at(p), k);
        for (int row = 0; row < LimitBasis::ROWS; ++row)
          EXPECT_LT((jet.row(row) - expected.row(row).transpose()).norm(), 1.0e-12);
        const Matrix3d frame = scene.surface.vertex_frame(f, k);
        EXPECT_LT((jet.position() - frame.col(0)).norm(), 1.0e-14);
      }
  }
}

TEST(SurfacePoint, TheFrameOfAnExtraordinaryVertexIsTangentToTheSurface)
{
  for (int n = 3; n <= 20; ++n) {
    const SurfaceScene scene(perturbed(bipyramid(n), 0.1, 8));
    const int vertex = n, face = scene.topology.faces_around(vertex)[0];
    const int k = corner_of(scene.topology.face(face), vertex);
    const Matrix3d frame = scene.surface.vertex_frame(face, k);
    const Vector3d normal = frame.col(1).cross(frame.col(2)).normalized();
    for (int i = 0; i < n; ++i) {
      const int f = scene.topology.faces_around(vertex)[i];
      const int c = corner_of(scene.topology.face(f), vertex);
      double t[3] = {3.0e-7, 3.0e-7, 3.0e-7};
      t[c] = 1.0 - 6.0e-7;
      const SurfaceJet jet = scene.surface.evaluate<1>({f, t[1], t[2]});
      EXPECT_GT(jet.normal().dot(normal), n > 12 ? 0.99 : 0.9999) << "valence " << n;
      const double angle = 2.0 * PI * (i + 0.5) / n;
      const Vector3d there = std::cos(angle) * frame.col(1) + std::sin(angle) * frame.col(2);
      EXPECT_GT((jet.position() - frame.col(0)).normalized().dot(there.normalized()), 0.999);
    }
  }
}

// === Weights

TEST(SurfacePoint, WeightsOfTheControlPointsGiveTheDerivatives)
{
  SurfaceWeights weights;
  LimitPatches patches;
  double worst[4] = {};
  for (const TriangleMesh &mesh : rough_meshes()) {
    const SurfaceScene scene(mesh);
    Random random(14);
    for (int i = 0; i < how_many(100); ++i) {
      const SurfacePoint p = random_point(scene.topology, random, true);
      StencilPoints control;
      stencil_points(scene.topology, mesh, p.face, control);
      scene.surface.weights<3>(p, weights);
      ASSERT_EQ(weights.cols(), control.rows());
      ASSERT_EQ(weights.cols(), scene.surface.stencil(p.face).size());
      EXPECT_NEAR(weights.row(0).sum(), 1.0, 1.0e-14);
      const double scale =
          std::fabs(patches.get(scene.topology.valences(p.face)).part_at(p.u, p.v).scale);
      const SurfaceJet jet = scene.surface.evaluate<3>(p);
      for (int row = 0; row < Derivative::ROWS; ++row) {
        const int order = row == 0 ? 0 : row < 3 ? 1 : row < 6 ? 2 : 3;
        const Vector3d sum = (weights.row(row) * control).transpose();
        const double unit = std::pow(scale, order);
        worst[order] = std::max(worst[order], (sum - jet.row(row)).norm() / unit);
      }
    }
  }
  for (double error : worst) EXPECT_LT(error, 1.0e-12);
}

TEST(SurfacePoint, WeightsAreTheDerivativesByControlPoints)
{
  SurfaceScene scene(perturbed(flipped(icosphere(1, 2.0), 30, 9, 4), 0.05, 5));
  const SurfacePoint p = {17, 0.31, 0.42};
  SurfaceWeights weights;
  scene.surface.weights<0>(p, weights);
  const IntSpan stencil = scene.surface.stencil(p.face);
  const Vector3d before = scene.position(p), shift(0.1, -0.2, 0.3);
  for (int k = 0; k < stencil.size(); ++k) {
    double weight = 0.0;    // a vertex may occur more than once
    for (int l = 0; l < stencil.size(); ++l)
      if (stencil[l] == stencil[k]) weight += weights(0, l);
    std::vector<Vector3d> points = scene.mesh.points;
    points[stencil[k]] += shift;
    scene.surface.move(points);
    EXPECT_LT((scene.position(p) - before - weight * shift).norm(), 1.0e-14);
  }
}

// === Moving, periodic boxes

TEST(SurfacePoint, MovedThroughThePeriodicBoxTheSurfaceIsTheSame)
{
  SurfaceScene scene(tilted_sheet(8, 8, 0.2));
  const Vector3d drift(0.7, 1.1, 1.3);
  std::vector<Vector3d> points = scene.mesh.points;
  const SurfacePoint p = {30, 0.2, 0.5};
  const SurfaceJet before = scene.surface.evaluate<3>(p);
  for (int step = 1; step <= 40; ++step) {
    for (size_t v = 0; v < points.size(); ++v) {
      const Vector3d fraction = scene.mesh.lattice.inverse() * (points[v] + drift);
      for (int k = 0; k < 3; ++k)
        points[v] = scene.mesh.lattice * (fraction - fraction.unaryExpr([](double x) {
                      return std::floor(x);
                    }));
    }
    scene.surface.move(points);
    const SurfaceJet now = scene.surface.evaluate<3>(p);
    for (int row = 1; row < Derivative::ROWS; ++row)
      EXPECT_LT((now.row(row) - before.row(row)).norm(), 1.0e-11);
    const Vector3d moved = now.position() - before.position() - step * drift;
    EXPECT_LT(scene.surface.nearest_image(moved).norm(), 1.0e-11);
  }
}

TEST(SurfacePoint, StretchedWithTheBoxTheSurfaceIsStretched)
{
  SurfaceScene scene(tilted_sheet(8, 8, 0.2));
  const SurfacePoint p = {77, 0.2, 0.5};
  const Vector3d before = scene.position(p);
  const Matrix3d stretch = Eigen::Vector3d(1.3, 0.8, 1.1).asDiagonal();
  std::vector<Vector3d> points;
  for (const Vector3d &x : scene.mesh.points) points.push_back(stretch * x);
  scene.surface.move(points, stretch * scene.mesh.lattice);
  EXPECT_LT((scene.position(p) - stretch * before).norm(), 1.0e-13);
}

TEST(SurfacePoint, RefusesValencesThatItHasNoRoomFor)
{
  const TriangleMesh mesh = bipyramid(33);
  const Topology topology = topology_of(mesh);
  EXPECT_THROW(LimitSurfaceOfMesh(topology, mesh), MeshError);
}

// === Memory

TEST(SurfacePoint, EvaluatingWalkingAndProjectingDoNotAllocate)
{
  if (!counts_allocations) GTEST_SKIP() << "cannot count allocations here";
  {
    const std::vector<int> one(1);
  }
  ASSERT_GT(allocations, 0);
  const SurfaceScene scene(perturbed(flipped(icosphere(2, 3.0), 200, 12, 1), 0.05, 2));
  const ClosestPointFinder finder(scene.surface);
  Random random(15);
  SurfaceWeights weights;
  Vector3d sum = Vector3d::Zero();
  const long before = allocations;
  for (int i = 0; i < 500; ++i) {
    const SurfacePoint p = random_point(scene.topology, random, true);
    const SurfaceJet jet = scene.surface.evaluate<3>(p);
    scene.surface.weights<2>(p, weights);
    const SurfaceWalk gone =
        walk(scene.topology, p, {3.0 * random.symmetric(), random.symmetric()});
    const Vector3d x = jet.position() + 0.2 * jet.normal();
    const ClosestPoint near = closest_point(scene.surface, x, gone.end);
    const ClosestPoint found = finder.find(x);
    sum += near.foot + found.foot + jet.limit_point().normal * weights(0, 0);
  }
  EXPECT_EQ(allocations, before);
  EXPECT_TRUE(sum.allFinite());
}

}    // namespace
