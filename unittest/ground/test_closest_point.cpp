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

#include "membrane_closest_point.h"
#include "membrane_surface_fan.h"
#include "surface_scene.h"

#include "gtest/gtest.h"

using namespace Membrane_TEST;

namespace {

/// A scene in which the closest points of places are looked for.
struct Search : SurfaceScene {
  ClosestPointFinder finder;
  explicit Search(const TriangleMesh &m) : SurfaceScene(m), finder(surface) {}
};

// Every face tried: the surface at many places of each, the nearest of them polished from the five best.

double brute_force(const Search &scene, const Vector3d &x)
{
  constexpr int CUT = 8;
  std::vector<std::pair<double, SurfacePoint>> all;
  for (int f = 0; f < scene.topology.num_faces(); ++f)
    for (int j = 0; j <= CUT; ++j)
      for (int i = 0; i + j <= CUT; ++i) {
        const SurfacePoint p = {f, i / double(CUT), j / double(CUT)};
        all.push_back({scene.surface.nearest_image(scene.position(p) - x).norm(), p});
      }
  auto closer = [](const auto &a, const auto &b) {
    return a.first < b.first;
  };
  std::partial_sort(all.begin(), all.begin() + 5, all.end(), closer);
  double best = all[0].first;
  for (int i = 0; i < 5; ++i)
    best = std::min(best, std::fabs(closest_point(scene.surface, x, all[i].second).distance));
  return best;
}

// meshes whose radii of curvature are more than half an edge: what is half an edge off the surface has
// one foot

std::vector<TriangleMesh> smooth_meshes()
{
  return {test_mesh("bumpy_icosphere_2"),
          test_mesh("torus_24x12"),
          icosphere(2, 3.0),
          interpolate(flipped(icosphere(3, 6.0), 150, 9, 1)),
          interpolate(flipped(torus(36, 18, 6.0, 2.5), 60, 8, 3)),
          tilted_sheet(10, 10, 0.05),
          tilted_tube(0.02),
          together(icosphere(2, 3.0), icosphere(2, 2.0), {7.0, 0.0, 0.0})};
}

// how far on each side of the surface the foot is the point itself: no further than half an edge, 0.7
// of the radius of curvature

double room(const SurfaceScene &scene, const SurfaceJet &jet, double side)
{
  const LimitPoint at = jet.limit_point();
  const double H = at.mean_curvature, K = at.gaussian_curvature;
  const double spread = std::sqrt(std::max(H * H - K, 0.0));
  const double bend = std::max(-side * (H - spread), -side * (H + spread));
  return std::min(0.5 * scene.surface.mean_edge(), 0.7 / std::max(bend, 1.0e-3));
}

// === Feet

TEST(ClosestPoint, APlaceOffTheSurfaceAlongTheNormalHasItsFootWhereItCameFrom)
{
  double worst_foot = 0.0, worst_distance = 0.0, worst_residual = 0.0;
  long lost = 0, evaluations = 0, count = 0, elsewhere = 0;
  const int places = how_many(SANITIZED ? 20000 : 100000, 1000000);
  const auto meshes = smooth_meshes();
  for (const TriangleMesh &mesh : meshes) {
    const Search scene(mesh);
    const double edge = scene.surface.mean_edge();
    Random random(31);
    for (size_t i = 0; i < places / meshes.size(); ++i) {
      const SurfacePoint p = random_point(scene.topology, random);
      const SurfaceJet jet = scene.surface.evaluate<2>(p);
      const double side = random.symmetric();
      const double distance = side * room(scene, jet, side > 0.0 ? 1.0 : -1.0);
      const Vector3d x = jet.position() + distance * jet.normal();
      const ClosestPoint found = scene.finder.find(x);
      lost += !found.converged;
      worst_residual = std::max(worst_residual, found.residual / edge);
      evaluations += found.evaluations;
      ++count;
      const double foot = scene.surface.nearest_image(found.foot - jet.position()).norm() / edge;
      if (std::fabs(found.distance) < std::fabs(distance) - 1e-9 * edge) {
        ++elsewhere;    // a bend further away: a closer point there is
        continue;
      }
      worst_foot = std::max(worst_foot, foot);
      worst_distance = std::max(worst_distance, std::fabs(found.distance - distance) / edge);
    }
  }
  RecordProperty("places", std::to_string(count));
  RecordProperty("closer_points_elsewhere", std::to_string(elsewhere));
  RecordProperty("worst_residual", scientific(worst_residual));
  RecordProperty("worst_foot", scientific(worst_foot));
  RecordProperty("worst_distance", scientific(worst_distance));
  RecordProperty("evaluations", std::to_string(double(evaluations) / count));
  EXPECT_EQ(lost, 0);
  EXPECT_LT(worst_residual, 1e-9);
  EXPECT_LT(worst_foot, 1e-8);
  EXPECT_LT(worst_distance, 1e-12);
  EXPECT_LT(elsewhere, 0.01 * count);
}

TEST(ClosestPoint, NothingIsCloserThanWhatIsFound)
{
  double worst = 0.0;
  for (const TriangleMesh &mesh : smooth_meshes()) {
    const Search scene(mesh);
    const double edge = scene.surface.mean_edge();
    Random random(32);
    for (int i = 0; i < how_many(8, 200); ++i) {
      const Vector3d x = scene.position(random_point(scene.topology, random)) +
          0.5 / std::sqrt(3.0) * edge * random.vector();
      const ClosestPoint found = scene.finder.find(x);
      EXPECT_TRUE(found.converged);
      worst = std::max(worst, (std::fabs(found.distance) - brute_force(scene, x)) / edge);
    }
  }
  RecordProperty("worst", scientific(worst));
  EXPECT_LT(worst, 1e-9);
}

// on meshes that bend more than that there may be several feet, one of which is found: nearly always the
// closest

TEST(ClosestPoint, BeyondTheRadiusOfCurvatureAFootIsFoundAndMostlyTheClosest)
{
  int count = 0, further = 0;
  double worst = 0.0;
  for (const TriangleMesh &mesh : rough_meshes()) {
    const Search scene(mesh);
    if (scene.topology.num_faces() > 400) continue;
    const double edge = scene.surface.mean_edge();
    Random random(32);
    for (int i = 0; i < how_many(8, 1000); ++i) {
      const Vector3d x =
          scene.position(random_point(scene.topology, random)) + 0.5 * edge * random.vector();
      const double excess =
          (std::fabs(scene.finder.find(x).distance) - brute_force(scene, x)) / edge;
      ++count;
      further += excess > 1e-9;
      worst = std::max(worst, excess);
    }
  }
  RecordProperty("places", std::to_string(count));
  RecordProperty("further", std::to_string(further));
  RecordProperty("worst", scientific(worst));
  EXPECT_LE(further, 0.05 * count);
  EXPECT_LT(worst, 0.2);
}

TEST(ClosestPoint, FromANeighbouringFaceItWalksToTheFoot)
{
  const SurfaceScene scene(test_mesh("octasphere_2"));
  const double edge = scene.surface.mean_edge();
  Random random(33);
  for (int i = 0; i < how_many(3000, 100000); ++i) {
    const SurfacePoint p = random_point(scene.topology, random);
    const SurfaceJet jet = scene.surface.evaluate<2>(p);
    const Vector3d x = jet.position() + 0.3 * edge * random.symmetric() * jet.normal();
    const SurfacePoint start =
        walk(scene.topology, p, {random.symmetric(), random.symmetric()}).end;
    const ClosestPoint found = closest_point(scene.surface, x, start);
    ASSERT_TRUE(found.converged);
    EXPECT_LT((found.foot - jet.position()).norm(), 1e-8 * edge);
  }
}

// === Extraordinary vertices

TEST(ClosestPoint, NextToVerticesOfAnyValenceTheFootIsFound)
{
  double worst = 0.0, worst_residual = 0.0;
  for (int n = 3; n <= 20; ++n) {
    const Search scene(perturbed(bipyramid(n), 0.03, 12));
    const double edge = scene.surface.mean_edge();
    Random random(34);
    int lost = 0;
    for (int i = 0; i < how_many(60, 5000); ++i) {
      const int f = scene.topology.faces_around(n)[random.below(n)];
      const int k = corner_of(scene.topology.face(f), n);
      const double s = std::pow(2.0, -28.0 * random.uniform()), a = random.uniform();
      double t[3];
      t[k] = 1.0 - s;
      t[(k + 1) % 3] = s * a;
      t[(k + 2) % 3] = s - s * a;
      const SurfaceJet jet = scene.surface.evaluate<2>({f, t[1], t[2]});
      const double side = random.symmetric();
      const double distance = 0.5 * side * room(scene, jet, side > 0.0 ? 1.0 : -1.0);
      const Vector3d x = jet.position() + distance * jet.normal();
      const ClosestPoint found = scene.finder.find(x);
      lost += !found.converged;
      if (scene.surface.corner_at(found.point) < 0)
        worst_residual = std::max(worst_residual, found.residual / edge);
      worst = std::max(worst, (std::fabs(found.distance) - std::fabs(distance)) / edge);
    }
    EXPECT_EQ(lost, 0) << "valence " << n;
  }
  EXPECT_LT(worst_residual, 1e-9);
  EXPECT_LT(worst, 1e-9);
}

TEST(ClosestPoint, AboveAnExtraordinaryVertexTheFootIsTheVertex)
{
  for (int n = 3; n <= 20; ++n) {
    const Search scene(bipyramid(n));
    const int f = scene.topology.faces_around(n)[1], k = corner_of(scene.topology.face(f), n);
    const Vector3d vertex = scene.surface.vertex_frame(f, k).col(0);
    const double height = n == 3 ? 1e-4 : 0.05;
    for (double side : {1.0, -1.0}) {
      const ClosestPoint found = scene.finder.find(vertex + side * height * Vector3d::UnitZ());
      EXPECT_TRUE(found.converged) << "valence " << n;
      EXPECT_NEAR(found.distance, side * height, 1e-9);
      EXPECT_LT((found.foot - vertex).norm(), 2e-6);
      EXPECT_GT(found.normal[2], 1.0 - 1e-5);
    }
  }
}

TEST(ClosestPoint, ThePlaneOfTheFanIsThereAndBackTheSame)
{
  for (int n = 3; n <= 20; ++n) {
    const SurfaceScene scene(bipyramid(n));
    Random random(35);
    for (int i = 0; i < 200; ++i) {
      const double radius = 0.5 * std::pow(2.0, -20.0 * random.uniform());
      const double angle = 2.0 * PI * random.uniform();
      const Vector2d place = radius * Vector2d(std::cos(angle), std::sin(angle));
      const SurfacePoint p = point_in_fan(scene.topology, n, place);
      const int k = corner_of(scene.topology.face(p.face), n);
      const FanPoint back = fan_point(scene.topology, p, k);
      EXPECT_LT((back.place - place).norm(), 1e-9 * radius) << "valence " << n;

      // the slope, by differences

      const double s = 1.0 - p.barycentric()[k], h = 1e-4 * s;
      if (std::min({p.u, p.v, 1.0 - p.u - p.v}) < 3.0 * h) continue;
      for (int c = 0; c < 2; ++c) {
        auto moved = [&](double by) {
          return fan_point(scene.topology, {p.face, p.u + (c ? 0.0 : by), p.v + (c ? by : 0.0)}, k)
              .place;
        };
        const Vector2d slope = (moved(h) - moved(-h)) / (2.0 * h);
        EXPECT_LT((slope - back.slope.col(c)).norm(), 1e-4 * back.slope.col(c).norm());
      }
    }
  }
}

// === The distance as a function

TEST(ClosestPoint, TheGradientOfTheDistanceIsTheNormalAndItsHessianThatOfTheJet)
{
  for (const TriangleMesh &mesh : {icosphere(2, 3.0), tilted_sheet(10, 10, 0.05)}) {
    const Search scene(mesh);
    Random random(36);
    for (int i = 0; i < 100; ++i) {
      const SurfaceJet jet = scene.surface.evaluate<2>(random_point(scene.topology, random));
      const Vector3d x = jet.position() + 0.4 * random.symmetric() * jet.normal();
      const ClosestPoint found = scene.finder.find(x, 1e-13);
      const Matrix3d hessian = found.jet.distance_hessian(found.distance);
      for (int k = 0; k < 3; ++k) {
        const Vector3d unit = Vector3d::Unit(k);
        auto distance = [&](double h) {
          return scene.finder.find(x + h * unit, 1e-13).distance;
        };
        EXPECT_NEAR(derivative(distance, 1e-3), found.normal[k], 1e-7);
        for (int l = 0; l < 3; ++l) {
          auto normal = [&](double h) {
            return scene.finder.find(x + h * unit, 1e-13).normal[l];
          };
          EXPECT_NEAR(derivative(normal, 1e-4), hessian(l, k), 1e-4);
        }
      }
    }
  }
}

TEST(ClosestPoint, TheGradientByControlPointsIsMinusTheWeightTimesTheNormal)
{
  Search scene(perturbed(flipped(icosphere(2, 3.0), 20, 8, 1), 0.05, 2));
  const SurfacePoint start = {77, 0.3, 0.4};
  const SurfaceJet jet = scene.surface.evaluate<2>(start);
  const Vector3d x = jet.position() + 0.3 * jet.normal();
  const ClosestPoint found = closest_point(scene.surface, x, start);
  SurfaceWeights weights;
  scene.surface.weights<0>(found.point, weights);
  const IntSpan stencil = scene.surface.stencil(found.point.face);
  for (int k = 0; k < stencil.size(); ++k)
    for (int c = 0; c < 3; ++c) {
      auto distance = [&](double h) {
        std::vector<Vector3d> points = scene.mesh.points;
        points[stencil[k]][c] += h;
        scene.surface.move(points);
        return closest_point(scene.surface, x, found.point, 1e-13).distance;
      };
      EXPECT_NEAR(derivative(distance, 1e-3), -weights(0, k) * found.normal[c], 1e-9);
    }
}

TEST(ClosestPoint, OutsideIsPositiveInsideNegative)
{
  const Search scene(icosphere(2, 3.0));
  Random random(37);
  for (int i = 0; i < 200; ++i) {
    const Vector3d direction = random.vector().normalized();
    EXPECT_GT(scene.finder.find(3.5 * direction).distance, 0.4);
    EXPECT_LT(scene.finder.find(2.0 * direction).distance, -0.4);
  }
}

// === Periodic boxes

TEST(ClosestPoint, AnyPeriodicImageOfAPlaceHasTheSameDistance)
{
  for (const TriangleMesh &mesh : {tilted_sheet(6, 6, 0.1), tilted_tube(0.05)}) {
    const Search scene(mesh);
    Random random(38);
    for (int i = 0; i < 300; ++i) {
      const SurfaceJet jet = scene.surface.evaluate<2>(random_point(scene.topology, random));
      const Vector3d x = jet.position() + 0.3 * random.symmetric() * jet.normal();
      const ClosestPoint here = scene.finder.find(x);
      Vector3d image;
      for (int k = 0; k < 3; ++k) image[k] = mesh.periodic[k] ? random.below(9) - 4 : 0;
      const Vector3d shift = mesh.lattice * image;
      const ClosestPoint there = scene.finder.find(x + shift);
      EXPECT_NEAR(there.distance, here.distance, 1e-11);
      EXPECT_LT((there.foot - here.foot - shift).norm(), 1e-8);
      EXPECT_LT((there.foot + there.distance * there.normal - x - shift).norm(), 1e-9);
      const ClosestPoint near = closest_point(scene.surface, x + shift, here.point);
      EXPECT_NEAR(near.distance, here.distance, 1e-11);
    }
  }
}

// sheets a third of the box apart, over the periodic boundary too

TEST(ClosestPoint, OfTwoSheetsTheCloserOneIsFound)
{
  TriangleMesh mesh = tilted_sheet(8, 8, 0.0);
  const Vector3d up = mesh.lattice.col(2) * 0.1;
  mesh = together(mesh, mesh, up);
  const Search scene(mesh);
  const double height = up[2];
  Random random(39);
  for (int i = 0; i < 500; ++i) {
    const double z = 0.97 * 9.0 + height * random.uniform();
    const Vector3d x(8.0 * random.uniform(), 8.0 * random.uniform(), z);
    const double above = z - 0.97 * 9.0, below = above - height;
    const double nearest = above < -below ? above : below;
    EXPECT_NEAR(scene.finder.find(x).distance, nearest, 1e-10);
  }
}

// === Beyond

TEST(ClosestPoint, FarAwayAndInTheMiddleThereIsAnAnswer)
{
  const Search scene(icosphere(2, 3.0));
  const double R = scene.finder.find({3.5, 0.2, 0.1}).foot.norm();
  EXPECT_NEAR(scene.finder.find({0.0, 0.0, 0.0}).distance, -R, 0.02 * R);
  for (double away : {30.0, 3000.0}) {
    const ClosestPoint found = scene.finder.find({away, 0.3 * away, 0.0});
    EXPECT_TRUE(found.converged);
    EXPECT_NEAR(found.distance, away * std::sqrt(1.09) - R, 0.02 * R);
  }
  EXPECT_THROW(scene.finder.find({NAN, 0.0, 0.0}), MeshError);
}

TEST(ClosestPoint, FollowsTheSurfaceWhenItMoves)
{
  Search scene(icosphere(2, 3.0));
  std::vector<Vector3d> points = scene.mesh.points;
  for (Vector3d &p : points) p = 1.2 * p + Vector3d(5.0, 0.0, 0.0);
  scene.surface.move(points);
  scene.finder.update();
  const ClosestPoint found = scene.finder.find({9.0, 0.1, 0.2});
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.distance, 4.0 - 3.6, 0.1);
}

}    // namespace
