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
#include "membrane_footprint.h"
#include "membrane_stencil.h"
#include "surface_scene.h"

#include "gtest/gtest.h"

using namespace Membrane_TEST;

namespace {

constexpr Quadrature RULE = Quadrature::SIX;

CurvatureCoupling isotropic(double radius)
{
  CurvatureCoupling particle;
  particle.area = 0.8;
  particle.radius = radius;
  particle.kp = 30.0;
  particle.c0p = 0.9;
  particle.kc = 10.0;
  particle.c0 = -0.1;
  return particle;
}

CurvatureCoupling anisotropic(double radius)
{
  CurvatureCoupling particle = isotropic(radius);
  particle.kp = 5.0;
  particle.k_par = 20.0;
  particle.c_par = 0.8;
  particle.k_perp = 7.0;
  particle.c_perp = -0.2;
  return particle;
}

/// A surface with particles.
struct FootprintScene : SurfaceScene {
  Footprints footprints;
  explicit FootprintScene(const TriangleMesh &m) :
      SurfaceScene(m), footprints(surface, shared_rules(RULE))
  {
  }
  /// With the same few points on every face.
  FootprintScene(const TriangleMesh &m, Quadrature plain) :
      SurfaceScene(m), footprints(surface, plain)
  {
  }
  void move(const Points &points, const Matrix3d &lattice)
  {
    surface.move(points, lattice);
    footprints.update();
  }
  void move(const Points &points) { move(points, mesh.lattice); }
  Points no_forces() const { return Points(mesh.points.size(), Vector3d::Zero()); }
  double energy(const CurvatureCoupling &particle, const Vector3d &x, const SurfacePoint &foot,
                const Director &director)
  {
    return footprints.add(particle, x, foot, director).energy;
  }
};

/// A particle above its foot, with a vector along the surface there for a director.
struct Where {
  SurfacePoint foot;
  Vector3d x;
  Director director;
};

Where above(const SurfaceScene &scene, const SurfacePoint &foot, double height, Random &random)
{
  const SurfaceJet jet = scene.surface.evaluate<1>(foot);
  const Vector3d n = jet.normal();
  return {foot,
          jet.position() + height * n,
          {carry({random.vector(), Vector3d::Zero()}, n).along, Vector3d::Zero()}};
}

std::vector<TriangleMesh> force_meshes()
{
  return {perturbed(icosphere(2, 3.0), 0.15, 31),
          perturbed(torus(16, 8, 3.0, 1.3), 0.1, 32),
          tilted_sheet(8, 8, 0.2),
          tilted_tube(0.1),
          perturbed(flipped(icosphere(2, 3.0), 200, 9, 1), 0.05, 2),
          tetrahedron()};
}

/// Places all over, and next to a vertex of each valence.
std::vector<SurfacePoint> feet_on(const SurfaceScene &scene, int number, Random &random)
{
  std::vector<SurfacePoint> feet;
  for (int i = 0; i < number; ++i) feet.push_back(random_point(scene.topology, random));
  std::set<int> seen = {6};
  for (int v = 0; v < scene.topology.num_vertices(); ++v) {
    if (!seen.insert(scene.topology.valence(v)).second) continue;
    const int face = scene.topology.faces_around(v)[0];
    const int k = corner_of(scene.topology.face(face), v);
    double t[3] = {0.07, 0.05, 0.06};
    t[k] = 1.0 - t[(k + 1) % 3] - t[(k + 2) % 3];
    feet.push_back({face, t[1], t[2]});
  }
  return feet;
}

// === Forces

void expect_forces_are_derivatives(const CurvatureCoupling &particle)
{
  constexpr double H = 1.0e-4;    // W has jumps in its third derivative, which are errors of H^2
  double worst[3] = {};
  std::set<int> valences;
  for (const TriangleMesh &mesh : force_meshes()) {
    FootprintScene scene(mesh, RULE);
    Random random(41);
    for (const SurfacePoint &foot : feet_on(scene, how_many(3), random)) {
      for (int k = 0; k < 3; ++k)
        valences.insert(scene.topology.valence(scene.topology.face(foot.face)[k]));
      Where at = above(scene, foot, 0.2 * random.symmetric(), random);
      scene.footprints.update();
      Points force = scene.no_forces();
      const FootprintForces out = scene.footprints.add(particle, at.x, foot, at.director);
      scene.footprints.take_forces(force);
      at.director = out.director;
      ASSERT_GT(out.area, 0.0);
      double largest = out.force.norm();    // the unit of errors
      std::vector<size_t> shaped;           // vertices with a force
      for (size_t v = 0; v < force.size(); ++v) {
        largest = std::max(largest, force[v].norm());
        if (!force[v].isZero(0.0)) shaped.push_back(v);
      }

      for (int k = 0; k < 3; ++k) {
        const Vector3d e = Vector3d::Unit(k);
        const double by_x = derivative(
            [&](double s) {
              return scene.energy(particle, at.x + s * e, foot, at.director);
            },
            H);
        worst[0] = std::max(worst[0], std::fabs(by_x + out.force[k]) / largest);
        if (!particle.has_director()) continue;
        // where the surface bends alike in all directions, that force is left over by others
        const double twist = std::max(out.director_force.norm(), 0.01 * largest);
        const double by_t = derivative(
            [&](double s) {
              return scene.energy(particle, at.x, foot,
                                  {at.director.along + s * e, Vector3d::Zero()});
            },
            H);
        worst[1] = std::max(worst[1], std::fabs(by_t + out.director_force[k]) / twist);
      }
      // one control point at a time, then all at once, each in a random direction

      const size_t number = force.size(), some = how_many(20), together = 4;
      for (size_t i = 0; i < some + together; ++i) {
        Points step(number, Vector3d::Zero());
        const size_t v = shaped[random.below(static_cast<int>(shaped.size()))];
        double expected = 0.0;
        for (size_t w = 0; w < number; ++w) {
          if (i < some && w != v) continue;
          step[w] = random.vector();
          expected -= force[w].dot(step[w]);
        }
        const double by_q = derivative(
            [&](double s) {
              Points points = mesh.points;
              for (size_t w = 0; w < number; ++w) points[w] += s * step[w];
              scene.move(points);
              return scene.energy(particle, at.x, foot, at.director);
            },
            H);
        worst[2] = std::max(worst[2], std::fabs(by_q - expected) / largest);
      }
      scene.move(mesh.points);
    }
  }
  const char *names[] = {"by_x", "by_director", "by_control_points"};
  for (int i = 0; i < 3; ++i) {
    testing::Test::RecordProperty(names[i], scientific(worst[i]));
    EXPECT_LT(worst[i], 1.0e-7) << names[i];
  }
  for (int n = 3; n <= 9; ++n) EXPECT_EQ(valences.count(n), 1u) << n;
}

TEST(Footprint, ForcesAreDerivativesOfTheEnergy)
{
  expect_forces_are_derivatives(isotropic(1.5));
}

TEST(Footprint, ForcesWithADirectorAreDerivativesOfTheEnergy)
{
  expect_forces_are_derivatives(anisotropic(1.5));
}

TEST(Footprint, ForcesAndTorquesAddUpToZero)
{
  for (const CurvatureCoupling &particle : {isotropic(1.4), anisotropic(1.4)})
    for (const TriangleMesh &mesh : force_meshes()) {
      FootprintScene scene(mesh);
      Random random(42);
      for (const SurfacePoint &foot : feet_on(scene, how_many(20), random)) {
        const Where at = above(scene, foot, 0.2 * random.symmetric(), random);
        Points force = scene.no_forces();
        const FootprintForces out = scene.footprints.add(particle, at.x, foot, at.director);
        const Matrix3d virial = scene.footprints.take_forces(force);
        Vector3d sum = out.force, torque = out.director.along.cross(out.director_force);
        Matrix3d outer = Matrix3d::Zero();
        double size = out.force.norm();
        for (size_t v = 0; v < force.size(); ++v) {
          const Vector3d arm = scene.surface.nearest_image(mesh.points[v] - at.x);
          sum += force[v];
          torque += arm.cross(force[v]);
          outer += arm * force[v].transpose();
          size = std::max(size, force[v].norm());
        }
        EXPECT_LT(sum.norm(), 1.0e-12 * size);
        EXPECT_LT(torque.norm(), 1.0e-11 * size);
        EXPECT_LT((outer - virial).norm(), 1.0e-11 * size);
      }
    }
}

TEST(Footprint, TheVirialIsTheDerivativeByStrain)
{
  for (const CurvatureCoupling &particle : {isotropic(1.4), anisotropic(1.4)})
    for (const TriangleMesh &mesh : force_meshes()) {
      FootprintScene scene(mesh);
      Random random(43);
      for (const SurfacePoint &foot : feet_on(scene, how_many(4), random)) {
        Where at = above(scene, foot, 0.2 * random.symmetric(), random);
        scene.footprints.update();
        at.director = scene.footprints.add(particle, at.x, foot, at.director).director;
        Points force = scene.no_forces();
        const Matrix3d virial = scene.footprints.take_forces(force);
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) {
            if ((3 * i + j + foot.face) % (2 * STRIDE - 1)) continue;
            const double by_strain = derivative(
                [&](double s) {
                  Matrix3d stretch = Matrix3d::Identity();
                  stretch(j, i) += s;    // coordinate j grows by that in i: r_i f_j
                  Points points;
                  for (const Vector3d &p : mesh.points) points.push_back(stretch * p);
                  scene.move(points, stretch * mesh.lattice);
                  return scene.energy(particle, stretch * at.x, foot, at.director);
                },
                1.0e-4);
            EXPECT_NEAR(virial(i, j), -by_strain, 1.0e-7 * virial.norm());
          }
        scene.move(mesh.points, mesh.lattice);
      }
    }
}

TEST(Footprint, ParticlesTogetherAreTheSumOfEachAlone)
{
  const TriangleMesh mesh = perturbed(flipped(icosphere(2, 3.0), 200, 9, 1), 0.05, 2);
  FootprintScene together(mesh), alone(mesh);
  Random random(44);
  Points sum = alone.no_forces(), force = sum;
  Matrix3d virials = Matrix3d::Zero();
  for (int i = 0; i < how_many(30); ++i) {
    const Where at = above(together, random_point(together.topology, random), 0.1, random);
    const CurvatureCoupling particle = i % 2 ? isotropic(1.2) : anisotropic(1.7);
    const FootprintForces a = together.footprints.add(particle, at.x, at.foot, at.director);
    alone.footprints.update();
    const FootprintForces b = alone.footprints.add(particle, at.x, at.foot, at.director);
    virials += alone.footprints.take_forces(sum);
    EXPECT_EQ(a.energy, b.energy);
    EXPECT_EQ(a.force, b.force);
  }
  const Matrix3d virial = together.footprints.take_forces(force);
  EXPECT_LT((virial - virials).norm(), 1.0e-12 * virials.norm());
  for (size_t v = 0; v < force.size(); ++v)
    EXPECT_LT((force[v] - sum[v]).norm(), 1.0e-11 * virials.norm());

  // taken is taken
  Points again = alone.no_forces();
  EXPECT_EQ(together.footprints.take_forces(again).norm(), 0.0);
  for (const Vector3d &f : again) EXPECT_EQ(f.norm(), 0.0);
}

// === Invariance

TEST(Footprint, MovedTurnedAndInAnyPeriodicImageTheEnergyIsTheSame)
{
  for (const TriangleMesh &mesh : force_meshes()) {
    FootprintScene scene(mesh);
    Random random(45);
    const Matrix3d turn =
        Eigen::AngleAxisd(1.1, Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
    const Vector3d shift(1.7, 0.3, -2.1);
    for (int i = 0; i < 10; ++i) {
      const SurfacePoint foot = random_point(scene.topology, random);
      const Where at = above(scene, foot, 0.1, random);
      scene.footprints.update();
      const FootprintForces before =
          scene.footprints.add(anisotropic(1.5), at.x, foot, at.director);
      if (mesh.is_periodic()) {
        Vector3d image;
        for (int k = 0; k < 3; ++k) image[k] = mesh.periodic[k] ? random.below(7) - 3 : 0;
        const FootprintForces other =
            scene.footprints.add(anisotropic(1.5), at.x + mesh.lattice * image, foot, at.director);
        EXPECT_NEAR(other.energy, before.energy, 1.0e-11 * std::fabs(before.energy));
        EXPECT_LT((other.force - before.force).norm(), 1.0e-11 * before.force.norm());
      }
      Points points;
      for (const Vector3d &p : mesh.points) points.push_back(turn * (p + shift));
      TriangleMesh turned = mesh;
      turned.points = points;
      turned.lattice = turn * mesh.lattice;
      FootprintScene other(turned);
      const FootprintForces after =
          other.footprints.add(anisotropic(1.5), turn * (at.x + shift), foot,
                               {turn * at.director.along, Vector3d::Zero()});
      EXPECT_NEAR(after.energy, before.energy, 1.0e-11 * std::fabs(before.energy));
      EXPECT_LT((after.force - turn * before.force).norm(), 1.0e-10 * before.force.norm());
      EXPECT_LT((after.director_force - turn * before.director_force).norm(),
                1.0e-10 * before.director_force.norm());
    }
  }
}

TEST(Footprint, ADirectorHasTwoEndsAndWhereItIsAlreadyItStays)
{
  FootprintScene scene(perturbed(icosphere(2, 3.0), 0.15, 31));
  Random random(46);
  for (int i = 0; i < 20; ++i) {
    const Where at = above(scene, random_point(scene.topology, random), 0.1, random);
    const FootprintForces out = scene.footprints.add(anisotropic(1.5), at.x, at.foot, at.director);
    const Vector3d t = out.director.along, n = out.director.normal;
    EXPECT_NEAR(t.norm(), 1.0, 1.0e-14);
    EXPECT_NEAR(t.dot(n), 0.0, 1.0e-14);
    EXPECT_NEAR(out.director_force.dot(t), 0.0, 1.0e-12 * out.director_force.norm());
    EXPECT_NEAR(out.director_force.dot(n), 0.0, 1.0e-12 * out.director_force.norm());
    for (const Director &same :
         {out.director, Director{-t, n}, Director{1.7 * t + 0.4 * n, Vector3d::Zero()}}) {
      const FootprintForces again = scene.footprints.add(anisotropic(1.5), at.x, at.foot, same);
      EXPECT_NEAR(again.energy, out.energy, 1.0e-12 * std::fabs(out.energy));
      EXPECT_LT((again.force - out.force).norm(), 1.0e-12 * out.force.norm());
    }
  }
}

// === Which faces count

struct BruteForce {
  double area = 0.0, curvature = 0.0;
  Vector3d normal = Vector3d::Zero();
};

BruteForce brute_force(const SurfaceScene &scene, const Vector3d &x, double radius)
{
  BruteForce sum;
  for (int f = 0; f < scene.topology.num_faces(); ++f) {
    const PatchRule &rule = shared_rules(RULE).get(scene.topology.valences(f));
    StencilPoints control;
    stencil_points(scene.topology, scene.mesh, f, control);
    for (int q = 0; q < rule.npoints; ++q) {
      LimitValues values;
      for (int row = 0; row < LimitBasis::ROWS; ++row)
        values.row(row) =
            Eigen::Map<const Eigen::RowVectorXd>(rule.row(q, row), rule.size) * control;
      const LimitPoint point = limit_point(values);
      const double r = scene.surface.nearest_image(point.position - x).norm() / radius;
      if (r >= 1.0) continue;
      const Vector3d ru = values.row(1), rv = values.row(2);
      const double weight = rule.weight[q] * ru.cross(rv).norm() * std::pow(1.0 - r * r, 3);
      sum.area += weight;
      sum.curvature += weight * 2.0 * point.mean_curvature;
      sum.normal += weight * point.normal;
    }
  }
  sum.curvature /= sum.area;
  sum.normal.normalize();
  return sum;
}

TEST(Footprint, NoFaceInReachIsMissed)
{
  double worst = 0.0;
  for (const TriangleMesh &mesh : force_meshes()) {
    FootprintScene scene(mesh);
    const bool small = mesh.points.size() == 4;
    Random random(47);
    for (double radius : {0.4, 0.9, 1.6, 2.1}) {
      if ((small && radius > 1.0) || (SANITIZED && radius != 0.9)) continue;
      for (const SurfacePoint &foot : feet_on(scene, how_many(30, 1000), random)) {
        const Where at = above(scene, foot, 0.15 * random.symmetric(), random);
        const BruteForce expected = brute_force(scene, at.x, radius);
        const FootprintAverage found = scene.footprints.average(at.x, foot, radius);
        worst = std::max(worst, std::fabs(found.area / expected.area - 1.0));
        EXPECT_NEAR(found.area, expected.area, 1.0e-12 * expected.area);
        EXPECT_NEAR(found.curvature, expected.curvature, 1.0e-10);
        EXPECT_LT((found.normal - expected.normal).norm(), 1.0e-12);
      }
    }
  }
  RecordProperty("worst", scientific(worst));
}

TEST(Footprint, PointsOfAStencilBeyondTheCornersWeighLessThanHalf)
{
  LimitPatches patches;
  SurfaceWeights weights;
  Random random(48);
  double most = 0.0;
  for (int n = 3; n <= MOST_VALENCE; ++n)
    for (const Valences &valences : {Valences{n, 6, 6}, Valences{6, n, n}, Valences{n, n, n},
                                     Valences{3, n, MOST_VALENCE}, Valences{4, 5, n}}) {
      const LimitPatch &patch = patches.get(valences);
      const int steps = 24;
      for (int i = 0; i <= steps; ++i)
        for (int j = 0; i + j <= steps; ++j) {
          patch.weights<0>(double(i) / steps, double(j) / steps, weights);
          EXPECT_GE(weights.row(0).minCoeff(), -1.0e-15);
          most = std::max(most, 1.0 - weights.row(0).head<3>().sum());
        }
    }
  RecordProperty("most", scientific(most));
  EXPECT_LT(most, 0.4);
}

TEST(Footprint, OutOfReachThereIsNothing)
{
  FootprintScene scene(perturbed(icosphere(2, 3.0), 0.1, 31));
  const SurfacePoint foot = {5, 0.3, 0.3};
  const Vector3d x = scene.position(foot) * 2.0;
  const FootprintForces out =
      scene.footprints.add(anisotropic(1.5), x, foot, {Vector3d::UnitX(), Vector3d::Zero()});
  EXPECT_EQ(out.energy, 0.0);
  EXPECT_EQ(out.area, 0.0);
  EXPECT_EQ(out.force, Vector3d::Zero());
  EXPECT_EQ(out.director_force, Vector3d::Zero());
  EXPECT_EQ(scene.footprints.average(x, foot, 1.5).area, 0.0);
  int faces = 0;
  const Matrix3d virial = scene.footprints.take_forces([&](int, const Lane4 *) {
    ++faces;
  });
  EXPECT_EQ(faces, 0);
  EXPECT_EQ(virial, Matrix3d::Zero());
}

TEST(Footprint, PartsOfTheSurfaceThatAreNearInSpaceAloneDoNotCount)
{
  // another sphere next to it

  const TriangleMesh ball = perturbed(icosphere(2, 3.0), 0.02, 31);
  FootprintScene one(ball), two(together(ball, ball, {6.1, 0.0, 0.0}));
  const SurfacePoint foot = ClosestPointFinder(one.surface).find({3.1, 0.0, 0.0}).point;
  const Vector3d x = one.position(foot);
  EXPECT_EQ(one.footprints.average(x, foot, 1.5).area, two.footprints.average(x, foot, 1.5).area);
  EXPECT_GT(brute_force(two, x, 1.5).area, 1.2 * brute_force(one, x, 1.5).area);

  // the other side of a pancake

  TriangleMesh pancake = icosphere(3, 6.0);
  for (Vector3d &p : pancake.points) p[2] *= 0.05;
  FootprintScene flat(pancake);
  const ClosestPoint top = ClosestPointFinder(flat.surface).find({0.3, 0.2, 0.3});
  const FootprintAverage upper = flat.footprints.average(top.foot, top.point, 1.5);
  EXPECT_GT(upper.normal[2], 0.99);
  EXPECT_NEAR(upper.area, PI * 1.5 * 1.5 / 4.0, 0.1);
  EXPECT_GT(brute_force(flat, top.foot, 1.5).area, 1.4 * upper.area);
}

TEST(Footprint, RefusesWhatIsWiderThanTheBox)
{
  FootprintScene scene(tilted_sheet(8, 8, 0.2));
  const SurfacePoint foot = {5, 0.3, 0.3};
  EXPECT_THROW(scene.footprints.average(scene.position(foot), foot, 3.5), MeshError);
  EXPECT_THROW(scene.footprints.add(anisotropic(1.0), scene.position(foot), foot), MeshError);
  EXPECT_THROW(carry({{0.0, 0.0, 2.0}, Vector3d::Zero()}, {0.0, 0.0, 1.0}), MeshError);
  EXPECT_THROW(carry({{1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}}, {0.0, 0.0, 1.0}), MeshError);
}

// === Closed forms

TEST(Footprint, OnASphereItIsTheCurvatureOfTheSphere)
{
  const double R = 2.0;
  double before = INFINITY;
  for (int level : {2, 3, 4}) {
    FootprintScene scene(interpolate(icosphere(level, R)));
    Random random(49);
    double worst = 0.0;
    for (int i = 0; i < how_many(200); ++i) {
      const Where at = above(scene, random_point(scene.topology, random), 0.1, random);
      const FootprintForces out =
          scene.footprints.add(anisotropic(1.0), at.x, at.foot, at.director);
      worst = std::max(worst, std::fabs(0.5 * R * out.curvature - 1.0));
      worst = std::max(worst, std::fabs(R * out.along - 1.0));
      worst = std::max(worst, std::fabs(R * out.across - 1.0));
      EXPECT_GT(out.director.normal.dot(at.x.normalized()), 0.9999);
    }
    RecordProperty("level_" + std::to_string(level), scientific(worst));
    EXPECT_LT(worst, before / 8.0);
    before = worst;
  }
  EXPECT_LT(before, 3.0e-4);
}

TEST(Footprint, AFewPointsOnEveryFaceAreEnoughForAMean)
{
  double worst = 0.0;
  const TriangleMesh mesh = perturbed(icosphere(3, 3.0), 0.03, 4);
  FootprintScene plain(mesh, RULE), graded(mesh);
  Random random(53);
  for (const SurfacePoint &foot : feet_on(plain, how_many(100), random)) {
    const Vector3d x = plain.position(foot);
    const FootprintAverage few = plain.footprints.average(x, foot, 0.5);
    const FootprintAverage many = graded.footprints.average(x, foot, 0.5);
    worst = std::max(worst, std::fabs(few.curvature / many.curvature - 1.0));
    EXPECT_NEAR(few.area, many.area, 0.01 * many.area);
  }
  RecordProperty("worst", scientific(worst));
  EXPECT_LT(worst, 0.005);
}

TEST(Footprint, OnATubeTheDirectorTellsTheAxisFromTheCircumference)
{
  const double R = 3.0;
  const Matrix3d lattice = Vector3d(30.0, 30.0, 12.0).asDiagonal();
  FootprintScene scene(interpolate(tube(24, 16, R, lattice, 2)));
  Random random(50);
  double worst = 0.0;
  for (int i = 0; i < how_many(100); ++i) {
    const Where at = above(scene, random_point(scene.topology, random), 0.1, random);
    const Vector3d axis(0.0, 0.0, 1.0),
        around = axis.cross(Vector3d(at.x[0], at.x[1], 0.0)).normalized();
    for (int degrees = 0; degrees < 180; degrees += 15) {
      const double angle = degrees * PI / 180.0, sine = std::sin(angle);
      const Director director = {std::cos(angle) * axis + sine * around, Vector3d::Zero()};
      const FootprintForces out = scene.footprints.add(anisotropic(1.5), at.x, at.foot, director);
      worst = std::max(worst, std::fabs(R * out.along - sine * sine));
      worst = std::max(worst, std::fabs(R * out.across - 1.0 + sine * sine));
    }
  }
  RecordProperty("worst", scientific(worst));
  EXPECT_LT(worst, 2.0e-5);
}

TEST(Footprint, TheTensorTellsTheCurvatureInEveryDirection)
{
  FootprintScene scene(perturbed(torus(16, 8, 3.0, 1.3), 0.1, 32));
  Random random(51);
  for (int i = 0; i < 20; ++i) {
    const Where at = above(scene, random_point(scene.topology, random), 0.1, random);
    const FootprintAverage under = scene.footprints.average(at.x, at.foot, 1.5);
    const FootprintForces out = scene.footprints.add(anisotropic(1.5), at.x, at.foot, at.director);
    const Vector3d t = carry(at.director, under.normal).along, s = under.normal.cross(t);
    EXPECT_NEAR(t.dot(under.tensor * t), out.along, 1.0e-13);
    EXPECT_NEAR(s.dot(under.tensor * s), out.across, 1.0e-13);
    EXPECT_NEAR(under.tensor.trace(), under.curvature, 1.0e-13);
    EXPECT_LT((under.tensor * under.normal).norm(), 1.0e-14);
    EXPECT_LT((under.tensor - under.tensor.transpose()).norm(), 1.0e-14);
    EXPECT_EQ(under.area, out.area);
    EXPECT_EQ(under.curvature, out.curvature);
    const CurvatureCoupling p = anisotropic(1.5);
    auto square = [](double k, double c) {
      return 0.5 * k * c * c;
    };
    EXPECT_NEAR(out.energy,
                p.area *
                    (square(p.kp, out.curvature - p.c0p) + square(p.k_par, out.along - p.c_par) +
                     square(p.k_perp, out.across - p.c_perp) - square(p.kc, out.curvature - p.c0)),
                1.0e-12);
  }
}

// === Motion

// The largest second difference on a way over faces and past vertices of all valences, over the
// square of the step, does not depend on the step: no jumps in energy or force.

TEST(Footprint, TheEnergyHasNoKinksWhereAParticleCrossesEdges)
{
  for (const TriangleMesh &mesh : {perturbed(icosphere(2, 3.0), 0.1, 31),
                                   perturbed(flipped(icosphere(2, 3.0), 200, 9, 1), 0.05, 2)})
    for (const CurvatureCoupling &particle : {isotropic(1.3), anisotropic(1.3)}) {
      FootprintScene scene(mesh);
      const ClosestPointFinder finder(scene.surface);
      double largest[2];
      int crossed = 0;
      for (int fine = 0; fine < 2; ++fine) {
        const double step = fine ? 0.001 : 0.004;
        SurfacePoint foot = finder.find({3.0, 0.0, 0.0}).point;
        const Director director = {{0.0, 1.0, 0.3}, Vector3d::Zero()};
        double a = 0.0, b = 0.0;
        largest[fine] = 0.0;
        for (int i = 0; i * step < (SANITIZED ? 0.2 : 3.0); ++i) {
          const double angle = i * step;
          const Vector3d x =
              3.0 * Vector3d(std::cos(angle), std::sin(angle), 0.3 * std::sin(2.0 * angle));
          const int face = foot.face;
          foot = closest_point(scene.surface, x, foot).point;
          crossed += foot.face != face;
          const double energy = scene.energy(particle, x, foot, director);
          if (i > 1)
            largest[fine] =
                std::max(largest[fine], std::fabs(energy - 2.0 * b + a) / (step * step));
          a = b;
          b = energy;
        }
      }
      EXPECT_GT(crossed, SANITIZED ? 1 : 20);
      EXPECT_NEAR(largest[1] / largest[0], 1.0, 0.1);
    }
}

// A particle on a spring to a rough surface that does not move, whose director turns about nbar with
// inertia and is carried in every step: the error of the energy is that of velocity Verlet.

TEST(Footprint, NoWorkIsDoneWhereADirectorIsCarried)
{
  FootprintScene scene(perturbed(flipped(icosphere(2, 3.0), 40, 8, 1), 0.1, 31));
  const CurvatureCoupling particle = anisotropic(1.4);
  const double spring = 30.0, inertia = 0.5;
  double before = 0.0;
  for (int fine = 1; fine <= 4; fine *= 2) {
    const double dt = 0.04 / fine;
    SurfacePoint foot = ClosestPointFinder(scene.surface).find({3.0, 0.2, 0.1}).point;
    Vector3d x = scene.position(foot), v(0.1, 1.0, 0.7), force;
    Director director = {{0.3, 0.5, 1.0}, Vector3d::Zero()};
    double spin = 0.8, torque = 0.0, first = 0.0, squares = 0.0, turned = 0.0;
    FootprintForces out;
    auto evaluate = [&] {
      const ClosestPoint near = closest_point(scene.surface, x, foot);
      foot = near.point;
      out = scene.footprints.add(particle, x, foot, director);
      director = out.director;
      force = out.force - spring * near.distance * near.normal;
      torque = director.normal.dot(director.along.cross(out.director_force));
      return out.energy + 0.5 * spring * near.distance * near.distance;
    };
    const int steps = (SANITIZED ? 50 : 250) * fine;
    double energy = evaluate();
    for (int i = 0; i <= steps; ++i) {
      const double total = energy + 0.5 * v.squaredNorm() + 0.5 * inertia * spin * spin;
      if (i == 0) first = total;
      squares += (total - first) * (total - first) / steps;
      v += 0.5 * dt * force;
      spin += 0.5 * dt * torque / inertia;
      x += dt * v;
      director.along = Eigen::AngleAxisd(dt * spin, director.normal) * director.along;
      turned += std::fabs(dt * spin);
      energy = evaluate();
      v += 0.5 * dt * force;
      spin += 0.5 * dt * torque / inertia;
    }
    const double error = std::sqrt(squares);
    RecordProperty("error_" + std::to_string(fine), scientific(error));
    if (fine > 1) {
      EXPECT_GT(before / error, 3.0);
      EXPECT_LT(before / error, 5.5);
    }
    EXPECT_GT(turned, 1.0);
    before = error;
  }
}

// Around a circle on a sphere at polar angle theta a vector turns by 2 pi cos(theta) against the meridian

TEST(Footprint, ADirectorIsCarriedInParallel)
{
  const double theta = 0.7;
  double before = INFINITY;
  for (int steps : {200, 400}) {
    auto normal = [&](int i) {
      const double phi = 2.0 * PI * i / steps;
      return Vector3d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                      std::cos(theta));
    };
    const Vector3d start = Vector3d(std::cos(theta), 0.0, -std::sin(theta));
    Vector3d t = start;
    for (int i = 1; i <= steps; ++i) t = carry({t, normal(i - 1)}, normal(i)).along;
    const double angle = std::atan2(t.dot(normal(0).cross(start)), t.dot(start));
    const double error = std::fabs(std::remainder(angle + 2.0 * PI * std::cos(theta), 2.0 * PI));
    EXPECT_LT(error, 10.0 / (steps * steps));
    EXPECT_LT(error, 0.3 * before);
    before = error;
  }
}

// === Memory

TEST(Footprint, DoesNotAllocateOnceItHasSeenAsMuch)
{
  if (!counts_allocations) GTEST_SKIP() << "cannot count allocations here";
  const TriangleMesh mesh = perturbed(flipped(icosphere(2, 3.0), 200, 9, 1), 0.05, 2);
  FootprintScene scene(mesh);
  Random random(52);
  std::vector<Where> places;
  for (int i = 0; i < how_many(50); ++i)
    places.push_back(above(scene, random_point(scene.topology, random), 0.1, random));
  Points force = scene.no_forces();
  auto run = [&] {
    scene.footprints.update();
    for (const Where &at : places) {
      scene.footprints.average(at.x, at.foot, 1.5);
      scene.footprints.add(anisotropic(1.5), at.x, at.foot, at.director);
    }
    return scene.footprints.take_forces(force);
  };
  run();
  const long before = allocations;
  ASSERT_GT(before, 0);
  run();
  EXPECT_EQ(allocations, before);
  EXPECT_GT(scene.footprints.memory_usage(), 1.0e4);
}

}    // namespace
