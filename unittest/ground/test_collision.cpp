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

#include "membrane_srd_approach_list.h"
#include "membrane_srd_collision.h"
#include "how_many.h"
#include "membrane_srd_events.h"
#include "membrane_srd_surface_grid.h"
#include "membrane_srd_inverse_mask.h"
#include "membrane_limit_basis.h"
#include "membrane_mesh_shapes.h"
#include "membrane_side.h"
#include "membrane_srd_corners.h"
#include "membrane_tessellation.h"
#include "scene.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

using namespace Membrane_NS;
using Membrane_TEST::how_many;
using Membrane_TEST::SANITIZED;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

class Random {
 public:
  explicit Random(int seed) : engine_(seed) {}
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine_); }
  Vector3d vector(double a) { return {uniform(-a, a), uniform(-a, a), uniform(-a, a)}; }
  Vector3d normal(double s) { return s * Vector3d(normal_(engine_), normal_(engine_), normal_(engine_)); }

 private:
  std::mt19937 engine_;
  std::normal_distribution<double> normal_;
};

using Corners = std::array<MovingPoint, 3>;

// signed volume, from the definition

double volume(const MovingPoint &p, const Corners &c, double t)
{
  const Vector3d a = c[0].at(t);
  return (p.at(t) - a).dot((c[1].at(t) - a).cross(c[2].at(t) - a));
}

static void offer_all(ApproachList &list, const SurfaceGrid &grid, const std::vector<MovingPoint> &points)
{
  std::vector<Vector3d> x, v;
  for (const MovingPoint &point : points) {
    x.push_back(point.origin);
    v.push_back(point.velocity);
  }
  list.offer(grid, 0, static_cast<int>(points.size()), x[0].data(), v[0].data(), [](int) { return true; });
}

/** A surface of point masses and the points that fly beside it, in a periodic box; finer surfaces only
    where nothing is periodic. */
struct Gas {
  TriangleMesh mesh;
  std::unique_ptr<SurfaceCorners> corners;
  std::vector<double> inverse_masses;
  SurfaceFaces surface;
  std::vector<SurfaceVertex> vertices;
  std::vector<MovingPoint> points;
  std::vector<int> level;
  double point_mass = 1.0, time_step = 0.01, thickness = 0.1;
  CollisionEvents events;
  SurfaceGrid grid;
  static constexpr int HORIZON = 7;    // steps
  ApproachList list{0.02, 0.2};
  long collisions = 0, strayed = 0, lists = 0;

  Gas(TriangleMesh m, double vertex_mass, bool no_slip = false, int n = 1) : mesh(std::move(m))
  {
    surface.faces = mesh.faces;
    const Matrix3d to_fraction = mesh.lattice.inverse();
    for (const Face &face : mesh.faces) {
      std::array<std::array<int, 3>, 3> seam;
      for (int k = 0; k < 3; ++k) {
        const Vector3d there = mesh.points[face[0]] + mesh.edge(face[0], face[k]);
        const Vector3d n = to_fraction * (there - mesh.points[face[k]]);
        for (int j = 0; j < 3; ++j) seam[k][j] = static_cast<int>(std::lround(n[j]));
      }
      surface.seams.push_back(seam);
    }
    for (const Vector3d &x : mesh.points)
      vertices.push_back({{x, Vector3d::Zero()}, vertex_mass > 0 ? 1.0 / vertex_mass : 0.0});
    CollisionEvents::Settings settings;
    settings.no_slip = no_slip;
    if (n > 1) {
      corners = std::make_unique<SurfaceCorners>(Topology(mesh.points.size(), mesh.faces), n);
      surface = {corners->triangles(), {}};
      for (const SurfaceVertex &v : vertices) inverse_masses.push_back(v.inverse_mass);
      vertices.resize(corners->count());
      settings.corners = corners.get();
      settings.inverse_masses = &inverse_masses;
      place_corners();
    }
    events = CollisionEvents(settings);
  }

  void place_corners()
  {
    for (size_t v = mesh.points.size(); v < vertices.size(); ++v) {
      MovingPoint path = {Vector3d::Zero(), Vector3d::Zero()};
      for (const auto &[a, g] : corners->masses_of(v)) {
        path.origin += g * vertices[a].path.origin;
        path.velocity += g * vertices[a].path.velocity;
      }
      vertices[v].path = path;
    }
  }

  void shake(double speed, Random &random)
  {
    for (size_t v = 0; v < mesh.points.size(); ++v) vertices[v].path.velocity = random.normal(speed);
    place_corners();
  }

  Vector3d fraction(const Vector3d &x) const { return mesh.lattice.inverse() * x; }

  SurfaceSide side(int axis = 2) const
  {
    std::vector<Vector3d> s;
    for (const SurfaceVertex &v : vertices) s.push_back(fraction(v.path.origin));
    return SurfaceSide(s, surface.faces, axis, mesh.periodic);
  }

  void fill(int n, double speed, Random &random, int axis = 2)
  {
    const SurfaceSide where = side(axis);
    for (int i = 0; i < n; ++i) {
      const Vector3d s(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
      points.push_back({mesh.lattice * s, random.normal(speed)});
      level.push_back(where.level(s));
    }
  }

  double energy() const
  {
    double e = 0.0;
    for (const MovingPoint &p : points) e += 0.5 * point_mass * p.velocity.squaredNorm();
    for (const SurfaceVertex &v : vertices)
      if (v.inverse_mass > 0) e += 0.5 / v.inverse_mass * v.path.velocity.squaredNorm();
    return e;
  }
  Vector3d momentum() const
  {
    Vector3d p = Vector3d::Zero();
    for (const MovingPoint &q : points) p += point_mass * q.velocity;
    for (const SurfaceVertex &v : vertices)
      if (v.inverse_mass > 0) p += v.path.velocity / v.inverse_mass;
    return p;
  }
  Vector3d angular_momentum() const
  {
    Vector3d l = Vector3d::Zero();
    for (const MovingPoint &q : points) l += point_mass * q.origin.cross(q.velocity);
    for (const SurfaceVertex &v : vertices)
      if (v.inverse_mass > 0) l += v.path.origin.cross(v.path.velocity) / v.inverse_mass;
    return l;
  }

  void build(const SurfaceGrid::Settings &settings)
  {
    Vector3d lo = Vector3d::Constant(INFINITY), hi = -lo;
    for (const MovingPoint &p : points) {
      const Vector3d room = Vector3d::Constant(thickness + 2.0 * time_step * p.velocity.norm());
      lo = lo.cwiseMin(p.origin - room);
      hi = hi.cwiseMax(p.origin + room);
    }
    grid.cut(lo, hi, settings);
    grid.build(surface, vertices, mesh.lattice, mesh.periodic);
  }

  // one step; `wrap` brings points back into the box as LAMMPS does now and then

  void stream(const SurfaceSide &where, int axis = 2)
  {
    const SurfaceGrid::Settings settings{thickness, 3.0 * time_step + thickness, 2.0 * thickness};
    if (!grid.is_valid_for(vertices, mesh.lattice)) {
      build(settings);
      list.clear();
    }
    double slack = 0.1 * thickness, more = slack;
    std::vector<int> found, near;
    auto outcome = CollisionEvents::Outcome::VERTEX_STRAYED;
    for (int attempt = 0; outcome != CollisionEvents::Outcome::DONE; ++attempt) {
      ASSERT_LT(attempt, 20);
      grid.begin(vertices, time_step, slack);
      events.begin(vertices, grid.triangles(), time_step, slack);
      near.clear();
      if (!list.is_valid_for(grid, vertices, time_step)) {
        list.begin(grid, vertices, points.size(), HORIZON * time_step, time_step, 2.0 * more);
        offer_all(list, grid, points);
        list.end(grid);
        ++lists;
      }
      bool all_found = true;
      auto take = [&](int i, const std::vector<int> *triangles) {
        const MovingPoint &p = points[i];
        const double step = time_step * p.velocity.norm();
        if (triangles)
          found = *triangles;
        else if (!grid.find(p.origin, step + more, found))
          all_found = false;
        if (found.empty()) return;
        near.push_back(i);
        events.add_point(p, 1.0 / point_mass, i, step + more);
        const Vector3d way = time_step * p.velocity;
        for (int t : found)
          events.add_pair(t, where.side(level[i], grid.images()[t].lattice[axis]),
                          grid.needs(t, p.origin.data(), way.data()));
      };
      list.for_each_meeting(grid, time_step, more, [](int) {}, take);
      if (!all_found) {
        build(settings);
        list.clear();
        continue;
      }
      outcome = events.run();
      strayed += outcome != CollisionEvents::Outcome::DONE;
      if (outcome == CollisionEvents::Outcome::VERTEX_STRAYED) slack *= 2.0;
      if (outcome == CollisionEvents::Outcome::POINT_STRAYED) more *= 2.0;
    }
    ASSERT_EQ(events.abandoned(), 0);
    collisions += events.impulses().size();

    std::vector<char> turned(points.size(), 0);
    list.pass(time_step);
    for (size_t n = 0; n < near.size(); ++n) {
      const int i = near[n];
      turned[i] = events.path(n).velocity != points[i].velocity;
      if (!turned[i]) continue;
      points[i] = {events.path(n).at(time_step), events.path(n).velocity};
      list.add(grid, i, points[i].origin, points[i].velocity);
    }
    for (size_t i = 0; i < points.size(); ++i)
      if (!turned[i]) points[i].origin = points[i].at(time_step);
    for (SurfaceVertex &v : vertices) v.path.origin = v.path.at(time_step);
    for (int v : events.touched()) {
      vertices[v].path.velocity += events.changes()[v].velocity;
      vertices[v].path.origin += events.changes()[v].position;
    }
    place_corners();
  }

  // points that are not where they belong

  int crossings(int axis = 2) const
  {
    const SurfaceSide where = side(axis);
    int n = 0;
    for (size_t i = 0; i < points.size(); ++i)
      n += where.level(fraction(points[i].origin)) != level[i];
    return n;
  }
};

}    // namespace

/* ----------------------------------------------------------------------
   one point, one triangle
------------------------------------------------------------------------- */

TEST(TriangleCollision, AgreesWithDenseSampling)
{
  Random random(1);
  const TriangleCollision collision;
  int hits = 0, agree = 0;
  for (int trial = 0; trial < how_many(4000); ++trial) {
    Corners corners;
    for (MovingPoint &c : corners) c = {random.vector(1.0), random.vector(1.0)};
    const MovingPoint point = {random.vector(0.7), random.vector(1.5)};
    for (int side : {1, -1}) {
      TriangleHit hit;
      const bool found = collision.find(point, corners, side, 0.0, 1.0, false, hit);

      // the first fall through zero inside the triangle, on 2000 samples

      bool expected = false;
      double when = 0.0, margin = 1.0;
      for (int i = 0; i < 2000 && !expected; ++i) {
        const double a = i / 2000.0, b = (i + 1) / 2000.0;
        if (!(side * volume(point, corners, a) > 0.0 && side * volume(point, corners, b) <= 0.0))
          continue;
        when = 0.5 * (a + b);
        const Vector3d p = point.at(when) - corners[0].at(when),
                       e = corners[1].at(when) - corners[0].at(when),
                       g = corners[2].at(when) - corners[0].at(when), n = e.cross(g);
        const double u = p.cross(g).dot(n) / n.squaredNorm(), v = e.cross(p).dot(n) / n.squaredNorm();
        margin = std::min(margin, std::min({std::fabs(u), std::fabs(v), std::fabs(1 - u - v)}));
        expected = u > 0 && v > 0 && u + v < 1;
      }
      if (margin < 0.02) continue;    // sampling cannot tell
      hits += expected;
      agree += expected && found && std::fabs(hit.time - when) < 5e-4;
      EXPECT_EQ(found, expected) << trial;
      if (found) {
        Vector3d x = Vector3d::Zero();
        for (int k = 0; k < 3; ++k) x += hit.weight[k] * corners[k].at(hit.time);
        EXPECT_LT((x - point.at(hit.time)).norm(), 1e-13);
      }
    }
  }
  EXPECT_GT(hits, how_many(200));
  EXPECT_EQ(agree, hits);
}

TEST(TriangleCollision, MissesNothingBetweenTriangles)
{
  // a fan of triangles around a vertex, with points that fly exactly at its edges and its middle

  Random random(2);
  const TriangleCollision collision;
  for (int trial = 0; trial < 2000; ++trial) {
    const int n = 3 + trial % 6;
    MovingPoint centre = {random.vector(0.3), random.vector(0.5)};
    std::vector<MovingPoint> ring;
    for (int i = 0; i < n; ++i)
      ring.push_back({Vector3d(std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n),
                               random.uniform(-0.4, 0.4)),
                      random.vector(0.2)});
    const double when = random.uniform(0.1, 0.9), along = trial % 2 ? 0.0 : random.uniform(0, 0.9);
    const int spoke = trial % n;
    const Vector3d target =
        centre.at(when) + along * (ring[spoke].at(when) - centre.at(when));
    MovingPoint point;
    point.velocity = Vector3d(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), -20.0);
    point.origin = target - when * point.velocity;
    bool found = false;
    for (int i = 0; i < n; ++i) {
      TriangleHit hit;
      found |= collision.find(point, {centre, ring[i], ring[(i + 1) % n]}, 1, 0.0, 1.0, false, hit);
    }
    EXPECT_TRUE(found) << trial;
  }
}

TEST(TriangleCollision, CountsFromThePointsOwnSideOnly)
{
  const Corners flat = {MovingPoint{{0, 0, 0}, {0, 0, 0}}, MovingPoint{{1, 0, 0}, {0, 0, 0}},
                        MovingPoint{{0, 1, 0}, {0, 0, 0}}};
  const TriangleCollision collision;
  const MovingPoint down = {{0.2, 0.2, 0.5}, {0, 0, -1}}, up = {{0.2, 0.2, -0.5}, {0, 0, 1}},
                    along = {{-1, 0.2, 0}, {2, 0, 0}}, beside = {{0.2, 0.2, 0.5}, {1, 0, 0}};
  TriangleHit hit;
  EXPECT_TRUE(collision.find(down, flat, 1, 0, 1, false, hit));
  EXPECT_NEAR(hit.time, 0.5, 1e-15);
  EXPECT_FALSE(collision.find(down, flat, -1, 0, 1, false, hit));
  EXPECT_TRUE(collision.find(up, flat, -1, 0, 1, false, hit));
  EXPECT_FALSE(collision.find(up, flat, 1, 0, 1, false, hit));
  EXPECT_FALSE(collision.find(along, flat, 1, 0, 1, false, hit));
  EXPECT_FALSE(collision.find(beside, flat, 1, 0, 1, false, hit));

  // on the wrong side by rounding: turned back if it goes on, let through if it comes back

  const MovingPoint on = {{0.2, 0.2, -1e-15}, {0, 0, -1}}, back = {{0.2, 0.2, -1e-15}, {0, 0, 1}};
  EXPECT_TRUE(collision.find(on, flat, 1, 0, 1, false, hit));
  EXPECT_LT(hit.time, 2e-10);
  EXPECT_FALSE(collision.find(back, flat, 1, 0, 1, false, hit));
}

TEST(CollisionImpulse, KeepsEnergyMomentumAndAngularMomentum)
{
  Random random(3);
  const TriangleCollision collision;
  int n = 0;
  double energy_error = 0.0, momentum_error = 0.0, angular_error = 0.0;
  while (n < 2000) {
    Corners corners;
    std::array<double, 3> inverse_masses;
    for (int k = 0; k < 3; ++k) {
      corners[k] = {random.vector(1.0), random.vector(1.0)};
      inverse_masses[k] = 1.0 / random.uniform(0.1, 5.0);
    }
    MovingPoint point = {random.vector(1.0), random.vector(2.0)};
    const double mass = random.uniform(0.1, 3.0);
    const int side = n % 2 ? 1 : -1;
    TriangleHit hit;
    if (!collision.find(point, corners, side, 0.0, 1.0, false, hit)) continue;
    ++n;
    std::array<Vector3d, 3> w = {corners[0].velocity, corners[1].velocity, corners[2].velocity};
    const Vector3d x = point.at(hit.time);
    auto sums = [&] {
      double e = 0.5 * mass * point.velocity.squaredNorm();
      Vector3d p = mass * point.velocity, l = x.cross(p);
      for (int k = 0; k < 3; ++k) {
        const Vector3d q = w[k] / inverse_masses[k];
        e += 0.5 * q.dot(w[k]);
        p += q;
        l += corners[k].at(hit.time).cross(q);
      }
      return std::tuple(e, p, l);
    };
    auto relative = [&] {
      Vector3d u = point.velocity;
      for (int k = 0; k < 3; ++k) u -= hit.weight[k] * w[k];
      return u;
    };
    const auto [e0, p0, l0] = sums();
    const Vector3d before = relative();
    const bool no_slip = n % 3 == 0;
    double inverse = 1.0 / mass;
    for (int k = 0; k < 3; ++k) inverse += hit.weight[k] * hit.weight[k] * inverse_masses[k];
    const Vector3d impulse = collision_impulse(before, hit.normal, inverse, no_slip);
    point.velocity += impulse / mass;
    for (int k = 0; k < 3; ++k) w[k] -= hit.weight[k] * inverse_masses[k] * impulse;
    const auto [e1, p1, l1] = sums();
    const Vector3d after = relative();

    energy_error = std::max(energy_error, std::fabs(e1 - e0) / e0);
    momentum_error = std::max(momentum_error, (p1 - p0).norm());
    angular_error = std::max(angular_error, (l1 - l0).norm());
    const Vector3d expected =
        no_slip ? Vector3d(-before) : Vector3d(before - 2 * before.dot(hit.normal) * hit.normal);
    EXPECT_NEAR(after.dot(hit.normal), expected.dot(hit.normal), 1e-13);
    if (no_slip) {
      EXPECT_LT((after - expected).norm(), 1e-13);
    }
    EXPECT_LT(side * before.dot(hit.normal), 0.0);
  }
  EXPECT_LT(energy_error, 1e-12);
  EXPECT_LT(momentum_error, 1e-12);
  EXPECT_LT(angular_error, 1e-12);
}

TEST(NearestOnTriangle, IsNearerThanAnyOtherPoint)
{
  Random random(4);
  for (int trial = 0; trial < 1000; ++trial) {
    const Vector3d a = random.vector(1), b = random.vector(1), c = random.vector(1),
                   x = random.vector(2);
    const auto w = nearest_on_triangle(x, a, b, c);
    const double d = (x - w[0] * a - w[1] * b - w[2] * c).norm();
    EXPECT_NEAR(w[0] + w[1] + w[2], 1.0, 1e-14);
    EXPECT_GE(std::min({w[0], w[1], w[2]}), -1e-12);
    for (int i = 0; i < 30; ++i) {
      double u = random.uniform(0, 1), v = random.uniform(0, 1);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      EXPECT_LE(d, (x - (1 - u - v) * a - u * b - v * c).norm() + 1e-12);
    }
  }
}

/* ----------------------------------------------------------------------
   steps with many points
------------------------------------------------------------------------- */

TEST(CollisionEvents, KeepEnergyMomentumAndAngularMomentumOfAStep)
{
  for (auto [no_slip, n] : {std::pair(false, 1), {true, 1}, {false, 2}, {true, 4}}) {
    Random random(5);
    TriangleMesh mesh = icosphere(n == 4 ? 1 : 2, 1.0);
    Gas gas(mesh, 0.2, no_slip, n);
    gas.shake(0.1, random);
    const SurfaceSide where = gas.side();
    for (int i = 0; i < std::max(how_many(3000), 600); ++i) {
      gas.points.push_back({random.vector(1.3), random.normal(1.0)});
      gas.level.push_back(where.level(gas.points.back().origin));
    }
    const double e = gas.energy();
    const Vector3d p = gas.momentum(), l = gas.angular_momentum();
    for (int step = 0; step < 10; ++step) gas.stream(where);
    EXPECT_GT(gas.collisions, how_many(300));
    EXPECT_NEAR(gas.energy() / e, 1.0, 1e-13);
    EXPECT_LT((gas.momentum() - p).norm(), 1e-11);
    EXPECT_LT((gas.angular_momentum() - l).norm(), 1e-11);
    EXPECT_EQ(gas.crossings(), 0);
  }
}

static void expect_reversible(int n)
{
  Random random(6);
  Gas gas(icosphere(2, 1.0), 0.2, false, n);
  gas.shake(0.1, random);
  const SurfaceSide where = gas.side();
  for (int i = 0; i < 3000; ++i) {
    gas.points.push_back({random.vector(1.3), random.normal(1.0)});
    gas.level.push_back(where.level(gas.points.back().origin));
  }
  const auto points = gas.points;
  const auto vertices = gas.vertices;
  auto turn_back = [&] {
    for (MovingPoint &p : gas.points) p.velocity *= -1;
    for (SurfaceVertex &v : gas.vertices) v.path.velocity *= -1;
    gas.list.clear();
  };
  for (int step = 0; step < 5; ++step) gas.stream(where);
  const long there = gas.collisions;
  turn_back();
  for (int step = 0; step < 5; ++step) gas.stream(where);
  turn_back();
  EXPECT_EQ(gas.collisions, 2 * there);
  EXPECT_GT(there, 50);
  double worst = 0.0;
  for (size_t i = 0; i < points.size(); ++i)
    worst = std::max({worst, (gas.points[i].origin - points[i].origin).norm(),
                      (gas.points[i].velocity - points[i].velocity).norm()});
  for (size_t v = 0; v < vertices.size(); ++v)
    worst = std::max({worst, (gas.vertices[v].path.origin - vertices[v].path.origin).norm(),
                      (gas.vertices[v].path.velocity - vertices[v].path.velocity).norm()});
  EXPECT_LT(worst, 1e-9);
}

TEST(CollisionEvents, AStepIsReversible)
{
  expect_reversible(1);
}

TEST(CollisionEvents, AStepIsReversibleOnAFinerSurface)
{
  expect_reversible(2);
}

TEST(CollisionEvents, ImpulsesFromOutsideActAtTheirTime)
{
  // a point at rest above a triangle that an impulse throws upwards halfway through the step

  std::vector<SurfaceVertex> vertices(3);
  const Vector3d corner[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (int k = 0; k < 3; ++k) vertices[k] = {{corner[k], Vector3d::Zero()}, 1.0};
  const std::vector<SurfaceTriangle> triangles = {
      {{0, 1, 2},
       {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()},
       {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()}}};
  CollisionEvents events;
  events.begin(vertices, triangles, 1.0, 10.0);
  events.add_point({{0.3, 0.3, 0.1}, Vector3d::Zero()}, 1.0, 1, 10.0);
  events.add_pair(0, 1);
  EXPECT_EQ(events.run(), CollisionEvents::Outcome::DONE);
  EXPECT_TRUE(events.impulses().empty());

  // J/3 on each of three masses of 1

  const Vector3d up(0, 0, 1);
  auto lift = [&](double time) {
    return SurfaceImpulse{time, 2, {0, 1, 2}, {1 / 3.0, 1 / 3.0, 1 / 3.0}, 3 * up, -1};
  };
  EXPECT_EQ(events.run({lift(0.5)}), CollisionEvents::Outcome::DONE);
  ASSERT_EQ(events.impulses().size(), 1u);
  EXPECT_NEAR(events.impulses()[0].time, 0.6, 1e-15);
  EXPECT_GT(events.path(0).velocity[2], 1.0);

  EXPECT_EQ(events.run({lift(0.95)}), CollisionEvents::Outcome::DONE);
  EXPECT_TRUE(events.impulses().empty());
  EXPECT_EQ(events.changes()[1].velocity, up);
  EXPECT_NEAR(events.changes()[1].position[2], 0.05, 1e-15);

  // less room than the impulse takes

  events.begin(vertices, triangles, 1.0, 0.1);
  events.add_point({{0.3, 0.3, 0.1}, Vector3d::Zero()}, 1.0, 1, 10.0);
  events.add_pair(0, 1);
  EXPECT_EQ(events.run({lift(0.5)}), CollisionEvents::Outcome::VERTEX_STRAYED);
}

// the shape must stay one without self-intersections: vertices are tied to where they began

static void tie(Gas &gas, const TriangleMesh &shape, double strength)
{
  for (size_t v = 0; v < shape.points.size(); ++v)
    gas.vertices[v].path.velocity -=
        gas.time_step * strength * (gas.vertices[v].path.origin - shape.points[v]);
  gas.place_corners();
}

TEST(CollisionEvents, NothingLeaksThroughAMovingVesicle)
{
  // 4,000 points: across the corner of the box, surface hot and light

  for (bool no_slip : {false, true}) {
    Random random(7);
    TriangleMesh mesh = icosphere(2, 1.0);
    mesh.lattice = 3.0 * Matrix3d::Identity();
    mesh.lattice(0, 1) = 0.4;
    mesh.periodic = {true, true, true};
    for (Vector3d &x : mesh.points) x += Vector3d(0.2, -0.1, 3.0);
    Gas gas(mesh, 0.5, no_slip);
    gas.fill(how_many(4000), 1.0, random);
    gas.shake(0.3, random);
    const SurfaceSide where = gas.side();
    int leaks = 0;
    const int steps = SANITIZED ? 100 : 300;
    for (int step = 0; step < steps; ++step) {
      gas.stream(where);
      tie(gas, mesh, 1600.0);
      if (step % 10 == 0) {
        for (MovingPoint &p : gas.points) {    // into the box
          const Vector3d s = gas.fraction(p.origin);
          p.origin -= mesh.lattice * Vector3d(std::floor(s[0]), std::floor(s[1]), std::floor(s[2]));
          p.velocity = random.normal(1.0);
        }
        gas.list.clear();
      }
      if (step % 20 == 19) leaks += gas.crossings();
    }
    EXPECT_EQ(leaks, 0);
    EXPECT_GT(gas.collisions, how_many(5000) * steps / 300);
    EXPECT_LT(gas.lists, 0.83 * steps);    // though vertices stray often
  }
}

TEST(CollisionEvents, NothingLeaksThroughAFinerVesicle)
{
  for (bool no_slip : {false, true}) {
    Random random(8);
    const TriangleMesh mesh = icosphere(1, 1.0);
    Gas gas(mesh, 5.0, no_slip, 4);    // lighter, and triangles would turn over
    for (int i = 0; i < how_many(2000); ++i) {
      gas.points.push_back({random.vector(1.2), random.normal(1.0)});
      gas.level.push_back(0);
    }
    const SurfaceSide where = gas.side();
    for (size_t i = 0; i < gas.points.size(); ++i)
      gas.level[i] = where.level(gas.points[i].origin);
    gas.shake(1.0, random);
    int leaks = 0;
    for (int step = 0; step < 100; ++step) {
      gas.stream(where);
      tie(gas, mesh, 1600.0);
      for (size_t i = 0; i < gas.points.size(); ++i) {    // back to where the surface is
        MovingPoint &p = gas.points[i];
        const Vector3d before = p.velocity;
        for (int k = 0; k < 3; ++k)
          if (std::fabs(p.origin[k]) > 1.2) p.velocity[k] = -std::copysign(p.velocity[k], p.origin[k]);
        if (p.velocity != before) gas.list.add(gas.grid, i, p.origin, p.velocity);
      }
      if (step % 20 == 19) leaks += gas.crossings();
    }
    EXPECT_EQ(leaks, 0);
    EXPECT_GT(gas.collisions, how_many(1000));
  }
}

TEST(SurfaceGrid, CubesKnowAllTrianglesWithinTheirReach)
{
  // as far as one look reaches, from places all over a surface that has moved within the skin, in several
  // images; of all directions, with some triangles in planes of the cubes' faces

  Random random(15);
  TriangleMesh mesh = icosphere(2, 1.0);
  for (Vector3d &x : mesh.points)
    if (std::fabs(x[0]) < 0.35) x[0] = 0.1;
  mesh.lattice = 2.6 * Matrix3d::Identity();
  mesh.periodic = {true, true, false};
  Gas gas(mesh, 1.0);
  gas.points = {{Vector3d::Constant(-2.0), Vector3d::Zero()}, {Vector3d::Constant(2.0), Vector3d::Zero()}};
  const double skin = 0.1, reach = 0.25;
  for (double spacing : {0.1, 0.17, 0.5}) {
    gas.build({skin, reach, spacing});
    for (SurfaceVertex &v : gas.vertices) v.path.origin += 0.99 * skin * random.vector(1.0).normalized();
    ASSERT_TRUE(gas.grid.is_valid_for(gas.vertices, mesh.lattice));
    gas.grid.begin(gas.vertices, 0.0, 0.0);
    std::vector<int> found;
    int num_found = 0, missing = 0;
    const int places = how_many(SANITIZED ? 1000 : 4000);
    for (int i = 0; i < places; ++i) {
      const Vector3d x = random.vector(1.8);
      ASSERT_TRUE(gas.grid.find(x, reach, found));
      num_found += found.size();
      std::vector<char> is_found(gas.grid.images().size(), 0);
      for (int t : found) is_found[t] = 1;
      for (size_t t = 0; t < is_found.size(); ++t) {
        if (is_found[t]) continue;
        const SurfaceTriangle &triangle = gas.grid.triangles()[t];
        Vector3d corner[3];
        for (int k = 0; k < 3; ++k)
          corner[k] = gas.vertices[triangle.vertex[k]].path.origin + triangle.shift[k];
        const auto b = nearest_on_triangle(x, corner[0], corner[1], corner[2]);
        missing += (b[0] * corner[0] + b[1] * corner[1] + b[2] * corner[2] - x).norm() <= reach;
      }
    }
    EXPECT_EQ(missing, 0) << "cubes of " << spacing;
    EXPECT_GT(num_found, places);
    for (size_t v = 0; v < mesh.points.size(); ++v) gas.vertices[v].path.origin = mesh.points[v];
  }
}

TEST(ApproachList, WhoIsNotListedMeetsNothing)
{
  // points fly through a surface that is shaken, are kicked a little, and now and then turned, while the
  // surface also drifts as a whole; who meets a triangle must be among those that the list takes

  Random random(14);
  const TriangleMesh mesh = icosphere(2, 1.0);
  const double dt = 0.01, kick = 0.05;
  Gas gas(mesh, 1.0);
  gas.thickness = 0.3;
  for (int i = 0; i < std::max(how_many(2000), 500); ++i)
    gas.points.push_back({random.vector(1.3), random.normal(1.0)});
  gas.build({0.15, 0.1, 0.2});
  ApproachList list(0.02, 0.2);
  const TriangleCollision collision;
  const int steps = 40, horizon = 8;
  int hits = 0, missed = 0, taken = 0, listed = 0, lists = 0, incomplete = 0;
  for (int step = 0; step < steps; ++step) {
    gas.shake(0.3, random);
    for (SurfaceVertex &v : gas.vertices) v.path.velocity[0] += 0.5;
    if (!gas.grid.is_valid_for(gas.vertices, mesh.lattice)) {
      gas.build({0.15, 0.1, 0.2});
      list.clear();
    }
    gas.grid.begin(gas.vertices, dt, 0.002);
    if (!list.is_valid_for(gas.grid, gas.vertices, dt)) {
      list.begin(gas.grid, gas.vertices, gas.points.size(), horizon * dt, dt, 0.01);
      offer_all(list, gas.grid, gas.points);
      list.end(gas.grid);
      ++lists;
    }
    std::vector<char> noted(gas.points.size(), 0);
    listed += list.count();
    // who is taken has all triangles that come within its way and some slack

    std::vector<int> all;
    auto take = [&](int i, const std::vector<int> *triangles) {
      ++taken, noted[i] = 1;
      if (!triangles || i % 8) return;
      const MovingPoint &p = gas.points[i];
      ASSERT_TRUE(gas.grid.find(p.origin, dt * p.velocity.norm() + 0.005, all));
      for (int t : all)
        incomplete += std::find(triangles->begin(), triangles->end(), t) == triangles->end();
    };
    list.for_each_meeting(gas.grid, dt, 0.005, [](int) {}, take);
    for (size_t i = step % 4; i < gas.points.size(); i += 4) {
      const MovingPoint &p = gas.points[i];
      if (std::fabs(p.origin.norm() - 1.0) > 0.5) continue;
      bool hit = false;
      for (const SurfaceTriangle &t : gas.grid.triangles()) {
        Corners c;
        for (int k = 0; k < 3; ++k) c[k] = gas.vertices[t.vertex[k]].path;
        TriangleHit where;
        for (int side : {1, -1}) hit = hit || collision.find(p, c, side, 0.0, dt, false, where);
      }
      hits += hit;
      missed += hit && !noted[i];
    }
    list.pass(dt);
    for (SurfaceVertex &v : gas.vertices) v.path.origin = v.path.at(dt);
    for (size_t i = 0; i < gas.points.size(); ++i) {
      MovingPoint &p = gas.points[i];
      p.origin = p.at(dt);
      if ((i + step) % 37 == 0) {
        p.velocity = random.normal(1.5);
        list.add(gas.grid, i, p.origin, p.velocity);
      } else
        p.velocity += kick * random.vector(1.0).normalized();
    }
    list.bend(kick);
  }
  EXPECT_EQ(missed, 0);
  EXPECT_EQ(incomplete, 0);
  EXPECT_GT(hits, how_many(100));
  EXPECT_LT(taken, 10 * 4 * hits);
  EXPECT_LT(listed, 0.3 * steps * gas.points.size());
  EXPECT_LT(lists, steps / 2);
}

namespace {

// points above a flat sheet at the height z(step), which rises and falls; what happens to a point between steps
// is up to `between`, which may turn it

struct Sheet {
  static constexpr double DT = 0.01, MARGIN = 0.05;
  SurfaceFaces surface;
  std::vector<SurfaceVertex> vertices;
  SurfaceGrid grid;
  ApproachList list{MARGIN, MARGIN};
  MovingPoint point;
  int hits = 0, missed = 0, lists = 0;

  Sheet()
  {
    const int n = 7;
    for (int i = 0; i < n * n; ++i)
      vertices.push_back({{Vector3d(0.5 * (i % n) - 1.5, 0.5 * (i / n) - 1.5, 0.0), Vector3d::Zero()}});
    for (int i = 0; i + 1 < n; ++i)
      for (int j = 0; j + 1 < n; ++j) {
        const int a = i * n + j;
        surface.faces.push_back({a, a + 1, a + n + 1});
        surface.faces.push_back({a, a + n + 1, a + n});
      }
  }

  template <class Height, class Between>
  void fly(int steps, int horizon, const Height &height, const Between &between)
  {
    const Matrix3d lattice = 10.0 * Matrix3d::Identity();
    for (int step = 0; step < steps; ++step) {
      for (SurfaceVertex &v : vertices) {
        v.path.origin[2] = height(step);
        v.path.velocity[2] = (height(step + 1) - height(step)) / DT;
      }
      if (!grid.is_built()) {    // cubes from z = -1.995 on, of 0.2
        grid.cut(Vector3d(-2, -2, -1.995), Vector3d(2, 2, 2), {0.1, 0.1, 0.2});
        grid.build(surface, vertices, lattice, {false, false, false});
      }
      ASSERT_TRUE(grid.is_valid_for(vertices, lattice));
      grid.begin(vertices, DT, 1.0e-6);
      if (!list.is_valid_for(grid, vertices, DT)) {
        list.begin(grid, vertices, 1, horizon * DT, DT, 0.0);
        offer_all(list, grid, {point});
        list.end(grid);
        ++lists;
      }
      bool noted = false, hit = false;
      list.for_each_meeting(grid, DT, 0.0, [](int) {}, [&](int, const std::vector<int> *) { noted = true; });
      const double before = point.origin[2] - height(step),
                   after = point.at(DT)[2] - height(step + 1);
      hit = (before > 0.0) != (after > 0.0);
      hits += hit;
      missed += hit && !noted;
      list.pass(DT);
      point.origin = point.at(DT);
      between(step);
    }
  }
};

}    // namespace

TEST(ApproachList, LinesThatBendUseUpTheMargin)
{
  Sheet sheet;
  sheet.point = {{0.1, 0.1, 0.15}, {0.2, 0.0, 0.0}};
  sheet.fly(30, 30, [](int) { return 0.0; }, [&](int) {
    sheet.point.velocity[2] -= 0.04;
    sheet.list.bend(0.04);
  });
  EXPECT_EQ(sheet.hits, 1);
  EXPECT_EQ(sheet.missed, 0);
  EXPECT_GT(sheet.lists, 1);
}

TEST(ApproachList, WhoTurnsIsListedForWhereTheSurfaceWasToo)
{
  // the sheet has risen by 0.04 when the point comes to rest 0.06 below it, and falls by 0.08

  Sheet sheet;
  sheet.point = {{0.1, 0.1, -1.0}, {0.0, 0.0, 0.0}};
  auto height = [](int step) { return step < 5 ? 0.008 * step : 0.04 - 0.008 * (step - 5); };
  sheet.fly(15, 15, height, [&](int step) {
    if (step != 4) return;
    sheet.point = {{0.1, 0.1, -0.02}, {0.0, 0.0, 0.0}};
    sheet.list.add(sheet.grid, 0, sheet.point.origin, sheet.point.velocity);
  });
  EXPECT_EQ(sheet.hits, 1);
  EXPECT_EQ(sheet.missed, 0);
  EXPECT_EQ(sheet.lists, 1);
}

TEST(ApproachList, WhoFliesFromAnEmptyCubeMayMeetWhatComesTowardsIt)
{
  // from 0.215, in a cube that begins at 0.205, to 0.029 in 20 steps, while the sheet rises to 0.04

  Sheet sheet;
  sheet.point = {{0.1, 0.1, 0.215}, {0.0, 0.0, -0.93}};
  sheet.fly(20, 20, [](int step) { return 0.002 * step; }, [](int) {});
  EXPECT_EQ(sheet.hits, 1);
  EXPECT_EQ(sheet.missed, 0);
  EXPECT_EQ(sheet.lists, 1);
}

/// Limit positions of the vertices.
std::vector<Vector3d> limit_positions(const Topology &topology, const TriangleMesh &mesh)
{
  std::vector<Vector3d> limit;
  for (size_t v = 0; v < mesh.points.size(); ++v) {
    const double c = limit_mask_centre(topology.valence(v));
    Vector3d r = c * mesh.points[v];
    for (int u : topology.ring(v)) r += (1 - c) / topology.valence(v) * mesh.points[u];
    limit.push_back(r);
  }
  return limit;
}

/// How far corners are from the limit surface, and the middles of edges of the triangles between
/// corners on it.
struct Distances {
  double corners = 0.0, most = 0.0, triangles = 0.0;    // root mean squares, but for most
};

Distances distances(const TriangleMesh &mesh, int n)
{
  const Topology topology(mesh.points.size(), mesh.faces);
  const std::vector<Vector3d> limit = limit_positions(topology, mesh);
  const SurfaceCorners corners(topology, n);
  const TessellatedSurface surface = tessellate(topology, mesh, n), finer = tessellate(topology, mesh, 2 * n);
  EXPECT_EQ(corners.count(), (int) surface.mesh.points.size());
  EXPECT_EQ(corners.triangles(), surface.mesh.faces);
  Distances found;
  for (int c = 0; c < corners.count(); ++c) {
    Vector3d r = Vector3d::Zero();
    double sum = 0.0;
    for (const auto &[a, g] : corners.masses_of(c)) {
      r += g * limit[a];
      sum += g;
    }
    EXPECT_NEAR(sum, 1.0, 1e-14);
    const Vector3d off = r - surface.mesh.points[c];
    if (c < corners.num_masses()) {
      EXPECT_LT(off.norm(), 1e-13);
    }
    const double distance = std::fabs(off.dot(surface.normals[c]));
    found.corners += distance * distance / (corners.count() - corners.num_masses());
    found.most = std::max(found.most, distance);
  }
  const TessellationNumbering number(topology, n), number_finer(topology, 2 * n);
  const auto middle = [&](int f, int i, int j, int k, int l) {
    const Vector3d flat = 0.5 * (surface.mesh.points[number.number(f, i, j)] +
                                 surface.mesh.points[number.number(f, k, l)]);
    const int p = number_finer.number(f, i + k, j + l);
    const double distance = (flat - finer.mesh.points[p]).dot(finer.normals[p]);
    found.triangles += distance * distance / (topology.num_faces() * 1.5 * n * (n + 1));
  };
  for (int f = 0; f < topology.num_faces(); ++f)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i + j < n; ++i) {
        middle(f, i, j, i + 1, j);
        middle(f, i, j, i, j + 1);
        middle(f, i + 1, j, i, j + 1);
      }
  found.corners = std::sqrt(found.corners);
  found.triangles = std::sqrt(found.triangles);
  return found;
}

TEST(SurfaceCorners, AreNearerToTheLimitSurfaceThanTriangles)
{
  for (int level : {1, 2, 3})
    for (int n : {2, 4, 8}) {
      const Distances d = distances(icosphere(level, 1.0), n);
      EXPECT_LT(d.corners, 0.2 * d.triangles) << level << ' ' << n;
      EXPECT_LT(d.most, 0.7 * d.triangles) << level << ' ' << n;
    }

  // where all valences are 6, of sixth order with P = 1 + E

  const Distances coarse = distances(torus(12, 8, 2.0, 0.7), 2), fine = distances(torus(24, 16, 2.0, 0.7), 2);
  EXPECT_GT(coarse.corners, 40.0 * fine.corners);

  // rough surfaces: noise, and a mesh of valences from 4 to 11 at the temperature of a bilayer

  Random random(10);
  TriangleMesh rough = torus(12, 8, 2.0, 0.7);
  for (Vector3d &x : rough.points) x += random.vector(0.05);
  const TriangleMesh thermal = Membrane_TEST::test_mesh("thermal_1800");
  for (const TriangleMesh *mesh : {static_cast<const TriangleMesh *>(&rough), &thermal})
    for (int n : {2, 4}) {
      const Distances d = distances(*mesh, n);
      EXPECT_LT(d.corners, (n == 2 ? 0.3 : 0.6) * d.triangles);
    }
}

TEST(SurfaceCorners, AreFoundFromTheirMasses)
{
  const TriangleMesh mesh = icosphere(1, 1.0);
  const SurfaceCorners corners(Topology(mesh.points.size(), mesh.faces), 4);
  size_t found = 0;
  for (int a = 0; a < corners.num_masses(); ++a)
    for (const auto &[c, g] : corners.corners_of(a)) {
      double weight = 0.0;
      for (const auto &[b, w] : corners.masses_of(c)) weight += b == a ? w : 0.0;
      EXPECT_EQ(weight, g);
      ++found;
    }
  size_t entries = 0;
  for (int c = 0; c < corners.count(); ++c) entries += corners.masses_of(c).end() - corners.masses_of(c).begin();
  EXPECT_EQ(found, entries);
}

TEST(SurfaceSide, LevelsAreThoseOfALineThroughAllTriangles)
{
  // in fractional coordinates: a torus and a vesicle that stick out of the box, a rough sheet, all in
  // boxes with images and, the closed ones, without

  Random random(12);
  std::vector<std::pair<TriangleMesh, bool>> scenes;    // and whether it is closed
  for (TriangleMesh mesh : {torus(16, 8, 0.3, 0.12), icosphere(2, 0.35)}) {
    for (Vector3d &x : mesh.points) x += Vector3d(0.1, 0.2, 0.95) + random.vector(0.02);
    scenes.emplace_back(mesh, true);
  }
  TriangleMesh sheet;
  const int n = 8;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      sheet.points.push_back(Vector3d(double(i) / n, double(j) / n, 0.98) + random.vector(0.04));
      auto at = [&](int a, int b) { return (a % n) * n + b % n; };
      sheet.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      sheet.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  scenes.emplace_back(sheet, false);

  for (const auto &[mesh, closed] : scenes)
    for (bool periodic : {true, false}) {
      if (!closed && !periodic) continue;
      for (int axis = closed ? 0 : 2; axis < 3; ++axis) {
        const SurfaceSide side(mesh.points, mesh.faces, axis, {periodic, periodic, periodic});
        const int a = (axis + 1) % 3, b = (axis + 2) % 3;
        std::array<int, 4> met = {};
        for (int k = 0; k < how_many(2000); ++k) {
          const Vector3d x = Vector3d::Constant(0.5) + random.vector(1.0);
          int level = 0;
          for (const Face &face : mesh.faces) {
            Vector3d p[3];
            for (int c = 0; c < 3; ++c) {
              p[c] = mesh.points[face[c]] - mesh.points[face[0]];
              if (periodic)
                for (double &d : p[c]) d -= std::round(d);
              p[c] += mesh.points[face[0]];
            }
            const int images = periodic ? 2 : 0;
            for (int i = -images; i <= images; ++i)
              for (int j = -images; j <= images; ++j) {
                double area[3];
                for (int c = 0; c < 3; ++c) {
                  const Vector3d &from = p[c], &to = p[(c + 1) % 3];
                  area[c] = (to[a] - from[a]) * (x[b] - from[b] - j) - (to[b] - from[b]) * (x[a] - from[a] - i);
                }
                if (!(area[0] > 0 && area[1] > 0 && area[2] > 0) && !(area[0] < 0 && area[1] < 0 && area[2] < 0))
                  continue;
                const double sum = area[0] + area[1] + area[2];
                const double height =
                    (area[1] * p[0][axis] + area[2] * p[1][axis] + area[0] * p[2][axis]) / sum;
                const int below = periodic ? (int) std::ceil(x[axis] - height) : x[axis] > height;
                level += sum > 0 ? below : -below;
              }
          }
          ASSERT_EQ(side.level(x), level) << axis << ' ' << x.transpose();
          ++met[level + 2 > 3 ? 3 : std::max(0, level + 2)];
        }
        EXPECT_GT(std::count_if(met.begin(), met.end(), [](int m) { return m > 0; }), 1);
      }
    }
}

TEST(CollisionEvents, NothingLeaksBetweenClosingSheets)
{
  // two flat sheets of 8 x 8 squares that run into a gas between them until it stops them

  for (double mass : {0.0, 20.0}) {
    Random random(8);
    const int n = 8;
    TriangleMesh mesh;
    mesh.lattice = Vector3d(4.0, 4.0, 6.0).asDiagonal();
    mesh.periodic = {true, true, true};
    for (int sheet = 0; sheet < 2; ++sheet)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          mesh.points.emplace_back(4.0 * i / n, 4.0 * j / n, 2.0 + 0.5 * sheet);
    for (int sheet = 0; sheet < 2; ++sheet)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          auto at = [&](int a, int b) { return (sheet * n + a % n) * n + b % n; };
          mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
          mesh.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
          if (sheet == 0) continue;    // the upper one's normal points down
          std::swap(mesh.faces.back()[1], mesh.faces.back()[2]);
          std::swap(mesh.faces[mesh.faces.size() - 2][1], mesh.faces[mesh.faces.size() - 2][2]);
        }
    Gas gas(mesh, mass);
    gas.time_step = 0.02;
    for (int i = 0; i < 300; ++i) {
      gas.points.push_back({{random.uniform(0, 4), random.uniform(0, 4), random.uniform(2.02, 2.48)},
                            random.normal(0.5)});
      gas.level.push_back(1);
    }
    for (size_t v = 0; v < gas.vertices.size(); ++v)
      gas.vertices[v].path.velocity[2] = v < gas.vertices.size() / 2 ? 1.0 : -1.0;
    const SurfaceSide where = gas.side();
    const double e = gas.energy();
    EXPECT_EQ(gas.crossings(), 0);
    EXPECT_EQ(where.degree(), 0);
    int leaks = 0, most = 0;
    const int steps = mass == 0.0 ? 12 : 60;    // walls of infinite mass close to a gap of 0.02
    for (int step = 0; step < steps; ++step) {
      gas.stream(where);
      leaks += gas.crossings();
      for (int p = 0; p < gas.events.num_points(); ++p)
        most = std::max(most, gas.events.bounces(p));
    }
    EXPECT_EQ(leaks, 0);
    EXPECT_GE(most, mass == 0.0 ? 5 : 2);
    if (mass > 0.0) {
      EXPECT_NEAR(gas.energy() / e, 1.0, 1e-12);
    }
  }
}

/* ----------------------------------------------------------------------
   impulses on control points
------------------------------------------------------------------------- */

TEST(InverseMask, RowsInvertTheLimitMask)
{
  for (const TriangleMesh &mesh : {icosphere(2, 1.0), torus(24, 12, 1.0, 0.4), icosphere(0, 1.0)}) {
    const Topology topology(mesh.points.size(), mesh.faces);
    InverseMask inverse(topology);
    for (int v : {0, 5, topology.num_vertices() - 1}) {
      std::vector<double> product(topology.num_vertices(), 0.0);    // row times L
      double sum = 0.0;
      const auto &row = inverse.row(v);
      for (size_t i = 0; i < row.vertex.size(); ++i) {
        const int a = row.vertex[i], n = topology.valence(a);
        const double c = limit_mask_centre(n);
        product[a] += c * row.weight[i];
        for (int w : topology.ring(a)) product[w] += (1 - c) / n * row.weight[i];
        sum += row.weight[i];
      }
      product[v] -= 1.0;
      for (double p : product) EXPECT_NEAR(p, 0.0, 3e-15);
      EXPECT_NEAR(sum, 1.0, 1e-15);
    }
  }
}

TEST(CollisionEvents, ImpulseOnAControlPointIsEquation44)
{
  Random random(9);
  const TriangleMesh mesh = icosphere(2, 1.0);
  const Topology topology(mesh.points.size(), mesh.faces);
  InverseMask inverse(topology);
  int on_control = 0;
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<SurfaceVertex> vertices;
    for (const Vector3d &x : mesh.points)
      vertices.push_back({{x, random.normal(0.05)}, 1.0 / random.uniform(2.0, 4.0)});
    std::vector<SurfaceTriangle> triangles;
    for (const Face &f : mesh.faces)
      triangles.push_back({f,
                           {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()},
                           {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()}});
    CollisionEvents::Settings settings;
    settings.control = &inverse;
    CollisionEvents events(settings);
    events.begin(vertices, triangles, 1.0, 10.0);
    const double mass = random.uniform(0.2, 1.0);
    const Vector3d from = random.vector(0.3), v = random.normal(1.0).normalized() * 1.2;
    events.add_point({from, v}, 1.0 / mass, 1, 10.0);
    for (size_t t = 0; t < triangles.size(); ++t) events.add_pair(t, -1);
    ASSERT_EQ(events.run(), CollisionEvents::Outcome::DONE);
    if (events.impulses().size() != 1) continue;
    const SurfaceImpulse &hit = events.impulses()[0];
    if (hit.control < 0) continue;
    ++on_control;

    // M^-1 = L^-1 D^-1 L^-T and qdot = L^-1 w from a dense L

    const int n = topology.num_vertices();
    Eigen::MatrixXd mask = Eigen::MatrixXd::Zero(n, n), w(n, 3), inverse_masses(n, 1);
    for (int a = 0; a < n; ++a) {
      const double c = limit_mask_centre(topology.valence(a));
      mask(a, a) = c;
      for (int b : topology.ring(a)) mask(a, b) += (1 - c) / topology.valence(a);
      w.row(a) = vertices[a].path.velocity.transpose();
      inverse_masses(a) = vertices[a].inverse_mass;
    }
    const Eigen::MatrixXd l = mask.inverse();
    const Eigen::MatrixXd inverse_m = l * inverse_masses.asDiagonal() * l.transpose();
    const Eigen::MatrixXd qdot = l * w;
    const Vector3d normal = hit.impulse.normalized();
    const int i = hit.control;
    const double alpha =
        2.0 * (v - qdot.row(i).transpose()).dot(normal) / (1.0 / mass + inverse_m(i, i));
    EXPECT_NEAR(hit.impulse.norm() / std::fabs(alpha), 1.0, 1e-12);
    EXPECT_LT((events.path(0).velocity - (v - alpha / mass * normal)).norm(), 1e-12);

    Eigen::MatrixXd change(n, 3);
    for (int a = 0; a < n; ++a) change.row(a) = events.changes()[a].velocity.transpose();
    const Eigen::MatrixXd expected = inverse_m.col(i) * (alpha * normal).transpose();
    EXPECT_LT((l * change - expected).norm(), 1e-12);
  }
  EXPECT_GT(on_control, 10);
}
