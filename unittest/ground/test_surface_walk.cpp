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

#include "surface_scene.h"

#include "gtest/gtest.h"

#include <memory>

using namespace Membrane_TEST;

namespace {

double inside(const SurfacePoint &p)
{
  return std::min({p.u, p.v, 1.0 - p.u - p.v});
}

// forth and back: how far from the start, in space

double missed(const SurfaceScene &scene, const SurfacePoint &start, const SurfaceWalk &forth,
              const Vector2d &step)
{
  const SurfaceWalk back = walk(scene.topology, forth.end, -(forth.turn * step));
  return scene.between(start, back.end).norm();
}

// === Across edges

TEST(SurfaceWalk, WithinAFaceItIsASum)
{
  const SurfaceScene scene(tetrahedron());
  const SurfaceWalk gone = walk(scene.topology, {2, 0.2, 0.3}, {0.1, 0.15});
  EXPECT_EQ(gone.end.face, 2);
  EXPECT_DOUBLE_EQ(gone.end.u, 0.2 + 0.1);
  EXPECT_DOUBLE_EQ(gone.end.v, 0.3 + 0.15);
  EXPECT_EQ(gone.edges, 0);
  EXPECT_TRUE(gone.turn.isIdentity());
}

// a flat regular sheet is the parameter plane itself: whatever edges and vertices are crossed, a straight
// line in parameters is one in space

TEST(SurfaceWalk, OnAFlatSheetItIsAStraightLine)
{
  const SurfaceScene scene(tilted_sheet(8, 8, 0.0));
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const SurfacePoint start = random_point(scene.topology, random);
    const Vector2d step(9.0 * random.symmetric(), 9.0 * random.symmetric());
    const SurfaceWalk gone = walk(scene.topology, start, step);
    const Vector3d straight = scene.surface.evaluate<1>(start).tangent(step);
    EXPECT_LT(scene.surface.nearest_image(scene.between(start, gone.end) - straight).norm(), 1e-12);
    const Vector3d turned = scene.surface.evaluate<1>(gone.end).tangent(gone.turn * step);
    EXPECT_LT((turned - straight).norm(), 1e-12);
  }
}

// With (du', dv') = T (du, dv): r_u = T_11 r_u' + T_21 r_v', and so on. The same place on an edge seen
// from the faces at both of its sides, for valences 3 to 20 at its ends.

TEST(SurfaceWalk, AcrossAnyEdgeTheSurfaceIsTwiceContinuouslyDifferentiable)
{
  double worst[3] = {};
  for (const TriangleMesh &mesh : rough_meshes()) {
    const SurfaceScene scene(mesh);
    Random random(2);
    for (int i = 0; i < 300; ++i) {
      const int f = random.below(scene.topology.num_faces()), k = random.below(3);
      const int g = scene.topology.neighbor(f, k);
      const double along = 0.02 + 0.96 * random.uniform();
      double t[3] = {0.0, 0.0, 0.0};
      t[k] = 1.0 - along;
      t[(k + 1) % 3] = along;
      const SurfacePoint here = {f, t[1], t[2]};
      double s[3] = {0.0, 0.0, 0.0};
      for (int c : {k, (k + 1) % 3})
        s[corner_of(scene.topology.face(g), scene.topology.face(f)[c])] = t[c];
      const SurfacePoint there = {g, s[1], s[2]};

      // the map from one face to the other, by a walk over the middle of the edge

      const Vector2d centre(1.0 / 3.0, 1.0 / 3.0);
      const Vector2d middle(k == 2 ? 0.0 : 0.5, k == 0 ? 0.0 : 0.5);
      const SurfaceWalk over =
          walk(scene.topology, {f, centre[0], centre[1]}, 1.2 * (middle - centre));
      ASSERT_EQ(over.edges, 1);
      ASSERT_EQ(over.end.face, g);
      const Eigen::Matrix2d &T = over.turn;

      const SurfaceJet a = scene.surface.evaluate<2>(here), b = scene.surface.evaluate<2>(there);
      worst[0] = std::max(worst[0], scene.between(here, there).norm());
      for (int c = 0; c < 2; ++c) {
        Vector2d unit = Vector2d::Zero();
        unit[c] = 1.0;
        worst[1] = std::max(worst[1], (a.tangent(unit) - b.tangent(T * unit)).norm());
      }
      auto second = [](const SurfaceJet &jet, const Vector2d &x, const Vector2d &y) -> Vector3d {
        return x[0] * y[0] * jet.row(Derivative::DUU) +
            (x[0] * y[1] + x[1] * y[0]) * jet.row(Derivative::DUV) +
            x[1] * y[1] * jet.row(Derivative::DVV);
      };
      for (const auto &[x, y] : {std::pair<Vector2d, Vector2d>({1, 0}, {1, 0}),
                                 std::pair<Vector2d, Vector2d>({1, 0}, {0, 1}),
                                 std::pair<Vector2d, Vector2d>({0, 1}, {0, 1})})
        worst[2] = std::max(worst[2],
                            (second(a, x, y) - second(b, T * x, T * y)).norm() /
                                (1.0 + second(a, x, y).norm()));
    }
  }
  for (int order : {0, 1, 2})
    RecordProperty("worst_" + std::to_string(order), scientific(worst[order]));
  EXPECT_LT(worst[0], 1e-13);
  EXPECT_LT(worst[1], 1e-12);
  EXPECT_LT(worst[2], 1e-11);
}

TEST(SurfaceWalk, ForthAndBackReturnsToTheStart)
{
  double worst = 0.0;
  long edges = 0, vertices = 0;
  const auto meshes = rough_meshes();
  const int walks = how_many(100000, 400000);
  std::vector<std::unique_ptr<SurfaceScene>> scenes;
  for (const TriangleMesh &mesh : meshes) scenes.push_back(std::make_unique<SurfaceScene>(mesh));
  Random random(3);
  for (int i = 0; i < walks; ++i) {
    const SurfaceScene &scene = *scenes[i % scenes.size()];
    const SurfacePoint start = random_point(scene.topology, random, i % 4 == 0);
    const Vector2d step(3.0 * random.symmetric(), 3.0 * random.symmetric());
    const SurfaceWalk gone = walk(scene.topology, start, step);
    ASSERT_GE(inside(gone.end), -1e-15);
    ASSERT_LE(gone.edges + gone.vertices, 16 + 4.0 * step.lpNorm<1>());
    edges += gone.edges;
    vertices += gone.vertices;
    worst = std::max(worst, missed(scene, start, gone, step));
  }
  RecordProperty("edges", std::to_string(edges));
  RecordProperty("worst", scientific(worst));
  EXPECT_GT(edges, 2 * walks);
  EXPECT_LT(worst, 1e-10);
}

TEST(SurfaceWalk, TwoHalvesAreAWhole)
{
  const SurfaceScene scene(perturbed(flipped(icosphere(2, 3.0), 200, 12, 1), 0.1, 2));
  Random random(4);
  for (int i = 0; i < 5000; ++i) {
    const SurfacePoint start = random_point(scene.topology, random);
    const Vector2d step(2.0 * random.symmetric(), 2.0 * random.symmetric());
    const SurfaceWalk whole = walk(scene.topology, start, step);
    const SurfaceWalk half = walk(scene.topology, start, 0.5 * step);
    const SurfaceWalk rest = walk(scene.topology, half.end, half.turn * (0.5 * step));
    EXPECT_LT(scene.between(whole.end, rest.end).norm(), 1e-11);
    EXPECT_LT((rest.turn * half.turn - whole.turn).norm(), 1e-11);
  }
}

// === At extraordinary vertices

// from a point near a vertex straight to it, then `beyond` times as far again, with the aim off by a bit

struct Shot {
  SurfacePoint start;
  Vector2d step;
};

Shot aim(const Topology &topology, int vertex, Random &random, double beyond, double off)
{
  const IntSpan faces = topology.faces_around(vertex);
  const int f = faces[random.below(faces.size())], k = corner_of(topology.face(f), vertex);
  const double a = random.uniform(), b = (1.0 - a) * random.uniform();
  double t[3];
  t[k] = 1.0 - a - b;
  t[(k + 1) % 3] = a;
  t[(k + 2) % 3] = b;
  const SurfacePoint corner = SurfacePoint::at_corner(f, k);
  const Vector2d straight(corner.u - t[1], corner.v - t[2]);
  return {{f, t[1], t[2]}, (1.0 + beyond) * straight + off * Vector2d(-straight[1], straight[0])};
}

TEST(SurfaceWalk, PastVerticesOfAnyValenceForthAndBackReturnsToTheStart)
{
  for (int n = 3; n <= 20; ++n) {
    const SurfaceScene scene(perturbed(bipyramid(n), 0.1, 9));
    Random random(5);
    double worst = 0.0;
    int through = 0;
    for (double off : {0.0, 1e-15, 1e-13, 1e-9, -1e-9, 1e-6, -1e-6, 1e-3, 0.1})
      for (int i = 0; i < how_many(200, 6000); ++i) {
        const Shot shot = aim(scene.topology, n, random, 1.5 * random.uniform(), off);
        const SurfaceWalk gone = walk(scene.topology, shot.start, shot.step);
        ASSERT_GE(inside(gone.end), -1e-15);
        through += gone.vertices > 0;
        ASSERT_TRUE(gone.vertices > 0 || off != 0.0 || n == 6);
        worst = std::max(worst, missed(scene, shot.start, gone, shot.step));
      }
    RecordProperty("valence_" + std::to_string(n), scientific(worst));
    EXPECT_LT(worst, 1e-8) << "valence " << n;    // what is left of an offset of 1e-12 or so
  }
}

TEST(SurfaceWalk, ALineThatEndsInAVertexStaysThere)
{
  for (int n : {3, 5, 7, 20}) {
    const SurfaceScene scene(perturbed(bipyramid(n), 0.1, 9));
    Random random(6);
    for (int i = 0; i < 200; ++i) {
      const Shot shot = aim(scene.topology, n, random, 0.0, 0.0);
      const SurfaceWalk gone = walk(scene.topology, shot.start, shot.step);
      EXPECT_EQ(gone.end.face, shot.start.face);
      EXPECT_LT(missed(scene, shot.start, gone, shot.step), 1e-12);
    }
  }
}

TEST(SurfaceWalk, ThroughAVertexTheAnglesOnBothSidesAreEqual)
{
  for (int n = 3; n <= 20; ++n) {
    const SurfaceScene scene(bipyramid(n));
    const IntSpan faces = scene.topology.faces_around(n);
    const int f = faces[0], k = corner_of(scene.topology.face(f), n);
    ASSERT_GE(k, 0);

    // along an edge: out along the opposite edge, or, if there is none, through the middle of a face

    double t[3] = {0.0, 0.0, 0.0};
    t[k] = t[(k + 1) % 3] = 0.5;
    const SurfacePoint corner = SurfacePoint::at_corner(f, k);
    const Vector2d to_vertex(corner.u - t[1], corner.v - t[2]);
    const SurfaceWalk gone = walk(scene.topology, {f, t[1], t[2]}, 1.5 * to_vertex);
    const Vector3d from = scene.position({f, t[1], t[2]}), to = scene.position(gone.end);
    const Vector2d a(from[0], from[1]), b(to[0], to[1]);
    EXPECT_NEAR(a.dot(b) / (a.norm() * b.norm()), -1.0, 1e-12) << "valence " << n;
  }
}

TEST(SurfaceWalk, TurningKeepsTheAreaOfParameters)
{
  const SurfaceScene scene(perturbed(bipyramid(7), 0.1, 9));
  Random random(7);
  for (int i = 0; i < 500; ++i) {
    const Shot shot = aim(scene.topology, 7, random, 1.0, i % 2 ? 0.0 : 0.01);
    EXPECT_NEAR(walk(scene.topology, shot.start, shot.step).turn.determinant(), 1.0, 1e-12);
  }
}

TEST(SurfaceWalk, StartingInAVertexItLeavesIt)
{
  for (int n : {3, 4, 5, 6, 7, 12, 20}) {
    const SurfaceScene scene(perturbed(bipyramid(n), 0.1, 9));
    Random random(8);
    const int f = scene.topology.faces_around(n)[0], k = corner_of(scene.topology.face(f), n);
    const SurfacePoint start = SurfacePoint::at_corner(f, k);
    for (int i = 0; i < 500; ++i) {
      const Vector2d step(0.4 * random.symmetric(), 0.4 * random.symmetric());
      const SurfaceWalk gone = walk(scene.topology, start, step);
      EXPECT_GE(corner_of(scene.topology.face(gone.end.face), n), 0);
      EXPECT_GT(scene.between(start, gone.end).norm(), 0.01 * step.squaredNorm());
      EXPECT_LT(missed(scene, start, gone, step), 1e-12);
    }
  }
}

// === Steps that nobody should take

TEST(SurfaceWalk, LongWalksEndAndNonsenseIsRefused)
{
  const SurfaceScene scene(perturbed(flipped(icosphere(1, 2.0), 60, 12, 3), 0.05, 4));
  Random random(9);
  for (int i = 0; i < 20; ++i) {
    const SurfacePoint start = random_point(scene.topology, random);
    const Vector2d step(3000.0 * random.symmetric(), 3000.0 * random.symmetric());
    const SurfaceWalk gone = walk(scene.topology, start, step);
    EXPECT_GE(inside(gone.end), -1e-15);
    EXPECT_LE(gone.edges, 16 + 4.0 * step.lpNorm<1>());
  }
  for (double bad : {double(NAN), double(INFINITY), 2.0 * LONGEST_WALK})
    EXPECT_THROW(walk(scene.topology, {0, 0.3, 0.3}, {bad, 0.0}), MeshError);
}

}    // namespace
