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

#include "membrane_helfrich.h"

#include "membrane_helfrich_point.h"
#include "scene.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

using namespace Membrane_TEST;

namespace {

const Moduli BENDING = {1.0, 0.0, 0.0, 0.0, 0.0};
const Moduli GAUSS = {0.0, 0.0, 1.0, 0.0, 0.0};
const Moduli SPONTANEOUS = {1.0, 0.8, 0.0, 0.0, 0.0};
const Moduli TENSION = {0.0, 0.0, 0.0, 1.0, 0.0};
const Moduli PRESSURE = {0.0, 0.0, 0.0, 0.0, 1.0};
const Moduli MOMENT = {0.0, 0.0, 0.0, 0.0, 0.0, 1.0};
const Moduli EVERYTHING = {1.3, -0.7, 0.6, 0.9, -1.1, 0.4};
const Moduli LEAFLETS = {1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1e-6, 0.7, -0.4};    // thin: curvature at a corner may be without bound
const Moduli WITH_LEAFLETS = {1.3, -0.7, 0.6, 0.9, -1.1, 0.4, 1e-6, -0.5, 0.8};
constexpr double STEP = 1e-3;    // of numerical derivatives, lengths being of order 1

const std::vector<std::pair<std::string, Moduli>> TERMS = {
    {"bending", BENDING}, {"bending with c0", SPONTANEOUS}, {"gauss", GAUSS},
    {"tension", TENSION}, {"pressure", PRESSURE},           {"moment", MOMENT},
    {"everything", EVERYTHING}, {"leaflets", LEAFLETS}, {"everything with leaflets", WITH_LEAFLETS}};

double bending(const TriangleMesh &mesh, Quadrature quadrature, double c0 = 0.0)
{
  return Scene(mesh, quadrature, {{1.0, c0}}).evaluate().bending;
}

double relative(double value, double reference)
{
  return std::fabs(value / reference - 1.0);
}

double largest(const Points &force)
{
  double most = 0.0;
  for (const Vector3d &f : force) most = std::max(most, f.norm());
  return most;
}

Points moved(Points points, const Points &direction, double step)
{
  for (size_t i = 0; i < points.size(); ++i) points[i] += step * direction[i];
  return points;
}

// The largest difference between force and minus the gradient along a random displacement of all
// points and along each coordinate of the vertices listed, in units of the largest force, or of 1
// (modulus over length) where the exact force is zero and all there is is rounding.
double force_error(Scene &scene, const std::vector<int> &vertices, double step = STEP)
{
  const Points &points = scene.mesh().points;
  const Points force = scene.evaluate().force;
  std::vector<Points> directions;
  Random random(99);
  directions.emplace_back();
  for (size_t i = 0; i < points.size(); ++i) directions.back().push_back(random.vector());
  for (int v : vertices)
    for (int d = 0; d < 3; ++d) {
      directions.emplace_back(points.size(), Vector3d::Zero());
      directions.back()[v][d] = 1.0;
    }

  const double unit = std::max(largest(force), 1.0);
  double worst = 0.0;
  for (const Points &direction : directions) {
    double expected = 0.0, length = 0.0;
    for (size_t i = 0; i < points.size(); ++i) {
      expected -= force[i].dot(direction[i]);
      length += direction[i].squaredNorm();
    }
    const double slope = derivative(
        [&](double s) {
          return scene.evaluate(moved(points, direction, s)).energy();
        },
        step / std::sqrt(length));
    worst = std::max(worst, std::fabs(slope - expected) / (unit * std::sqrt(length)));
  }
  return worst;
}

// a closed mesh with two vertices of valence n, without symmetry
TriangleMesh valence_mesh(int n)
{
  return perturbed(bipyramid(n), 0.1, 1000 + n);
}

struct Reference {
  std::string name;
  double area, volume, bending, gauss, c0, bending_c0;
};

// independent results, all digits converged: recursive refinement to depth 26 around
// extraordinary vertices and 100-point rules on regular patches
const Reference REFERENCES[] = {
    {"icosphere_1", 10.48116254, 3.189728044, 25.25117293, 12.56637061, 1, 7.536243034},
    {"icosphere_2", 12.00468707, 3.910857721, 25.18922129, 12.56637061, 1, 6.626411535},
    {"octasphere_2", 11.150311, 3.494691309, 25.53033217, 12.56637061, 1, 7.415845501},
    {"torus_24x12", 13.03023509, 2.168826136, 62.44326346, 0, 2, 10.2207469},
    {"bumpy_icosphere_2", 12.59008037, 4.002431217, 29.36923906, 12.56637061, 1, 10.08007744}};

// the slope of log(error) over log(1/h) from three meshes, each twice as fine as the one before
double fitted_order(const std::vector<double> &errors)
{
  return 0.5 * std::log2(std::fabs(errors.front() / errors.back()));
}

}    // namespace

// === Against independent numbers

TEST(ReferenceSurfaces, CarefulAgrees)
{
  double worst = 0.0;
  for (const Reference &r : REFERENCES) {
    const TriangleMesh mesh = test_mesh(r.name);
    if (SANITIZED && mesh.points.size() > 100) continue;
    const Totals t = Scene(mesh, Quadrature::CAREFUL, {{1.0, 0.0, 1.0}}).evaluate();
    const double errors[] = {relative(t.area, r.area), relative(t.volume, r.volume),
                             relative(t.bending, r.bending),
                             relative(bending(mesh, Quadrature::CAREFUL, r.c0), r.bending_c0),
                             r.gauss == 0.0 ? std::fabs(t.gauss) : relative(t.gauss, r.gauss)};
    for (double error : errors) {
      EXPECT_LT(error, 1e-8) << r.name;
      worst = std::max(worst, error);
    }
  }
  RecordProperty("worst_error", scientific(worst));
}

TEST(ReferenceSurfaces, DefaultQuadratureBendsWithinTwoThousandths)
{
  for (const Reference &r : REFERENCES) {
    const TriangleMesh mesh = test_mesh(r.name);
    EXPECT_LT(relative(bending(mesh, Quadrature::SIX), r.bending), 2e-3) << r.name;
    EXPECT_LT(relative(bending(mesh, Quadrature::SIX, r.c0), r.bending_c0), 2e-3) << r.name;
  }
}

TEST(ReferenceSurfaces, ErrorsOfTheCheapRulesAreOnRecord)
{
  // the largest errors over the five meshes: area, volume, bending, bending with c0
  const std::map<Quadrature, std::array<double, 4>> bounds = {
      {Quadrature::ONE, {5e-3, 5e-3, 2e-2, 4e-2}},
      {Quadrature::THREE, {1e-4, 1e-4, 4e-4, 1.5e-3}},
      {Quadrature::SIX, {4e-7, 4e-7, 2e-5, 5e-5}},
      {Quadrature::TWELVE, {3e-8, 3e-8, 5e-7, 1.5e-6}}};
  for (const auto &[quadrature, bound] : bounds) {
    std::array<double, 4> most = {0.0, 0.0, 0.0, 0.0};
    for (const Reference &r : REFERENCES) {
      const TriangleMesh mesh = test_mesh(r.name);
      const Totals t = Scene(mesh, quadrature).evaluate();
      const double signed_errors[] = {t.area / r.area - 1.0, t.volume / r.volume - 1.0,
                                      t.bending / r.bending - 1.0,
                                      bending(mesh, quadrature, r.c0) / r.bending_c0 - 1.0};
      std::string record;
      for (int i = 0; i < 4; ++i) {
        most[i] = std::max(most[i], std::fabs(signed_errors[i]));
        record += (i ? " " : "") + scientific(signed_errors[i]);
      }
      RecordProperty(name(quadrature) + "_" + r.name, record);
    }
    for (int i = 0; i < 4; ++i) EXPECT_LT(most[i], bound[i]) << name(quadrature) << " " << i;
  }
}

// === Gauss-Bonnet

namespace {

// points moved over the unit sphere to the middle of their neighbours
TriangleMesh evened(TriangleMesh mesh)
{
  const Topology topology = topology_of(mesh);
  for (int sweep = 0; sweep < 3; ++sweep)
    for (int v = 0; v < topology.num_vertices(); ++v) {
      Vector3d sum = Vector3d::Zero();
      for (int w : topology.ring(v)) sum += mesh.points[w];
      mesh.points[v] = sum.normalized();
    }
  return mesh;
}

// integral of K dA less its exact value, for all components together
double gauss_bonnet(const TriangleMesh &mesh)
{
  Scene scene(mesh, Quadrature::CAREFUL, {GAUSS});
  double exact = 0.0;
  for (int c = 0; c < scene.topology().num_components(); ++c)
    exact += 2.0 * PI * scene.topology().euler_characteristic(c);
  return scene.evaluate().gauss - exact;
}

}    // namespace

TEST(GaussBonnet, HoldsForEveryValenceFrom3To16)
{
  double worst = 0.0;
  for (int n = 3; n <= 16; n += STRIDE) {
    const double error = std::fabs(gauss_bonnet(bipyramid(n)));
    EXPECT_LT(error, 1e-8) << "valence " << n;
    worst = std::max(worst, error);
  }
  RecordProperty("worst_error", scientific(worst));
}

TEST(GaussBonnet, HoldsOnPlatonicSolids)
{
  EXPECT_LT(std::fabs(gauss_bonnet(tetrahedron())), 1e-8);
  EXPECT_LT(std::fabs(gauss_bonnet(bipyramid(4))), 1e-8);
  EXPECT_LT(std::fabs(gauss_bonnet(icosphere(0, 1.0))), 1e-8);
  RecordProperty("tetrahedron", scientific(gauss_bonnet(tetrahedron())));
  RecordProperty("octahedron", scientific(gauss_bonnet(bipyramid(4))));
  RecordProperty("icosahedron", scientific(gauss_bonnet(icosphere(0, 1.0))));
}

TEST(GaussBonnet, HoldsOnIrregularSpheres)
{
  for (int seed = 1; seed <= how_many(3); ++seed) {
    const TriangleMesh mesh = loop_refine(evened(flipped(icosphere(1, 1.0), 20, 9, seed)));
    EXPECT_GE(valences_of(mesh).size(), 6u);
    const double error = gauss_bonnet(mesh);
    EXPECT_LT(std::fabs(error), 1e-8) << "seed " << seed;
    RecordProperty("seed" + std::to_string(seed), scientific(error));
  }
}

TEST(GaussBonnet, IsZeroOnATorusOfAnyValences)
{
  const double regular = gauss_bonnet(torus(12, 8, 2.0, 1.0));
  EXPECT_LT(std::fabs(regular), 1e-8);
  const TriangleMesh mesh = loop_refine(flipped(torus(12, 8, 2.0, 1.0), 15, 8, 5));
  EXPECT_GE(valences_of(mesh).size(), 4u);
  const double irregular = gauss_bonnet(mesh);
  EXPECT_LT(std::fabs(irregular), 1e-8);
  RecordProperty("regular", scientific(regular));
  RecordProperty("irregular", scientific(irregular));
}

TEST(GaussBonnet, AddsUpOverComponents)
{
  const TriangleMesh two = together(icosphere(0, 1.0), torus(12, 8, 2.0, 1.0), {5.0, 0.0, 0.0});
  ASSERT_EQ(topology_of(two).num_components(), 2);
  EXPECT_LT(std::fabs(gauss_bonnet(two)), 1e-8);
  EXPECT_LT(std::fabs(gauss_bonnet(together(two, tetrahedron(), {-5.0, 0.0, 0.0}))), 1e-8);
}

TEST(ClosedSurface, HasNoVectorArea)
{
  for (const TriangleMesh &mesh : {valence_mesh(3), valence_mesh(5), valence_mesh(11)}) {
    const Totals t = Scene(mesh, Quadrature::CAREFUL).evaluate();
    EXPECT_LT(t.vector_area.norm(), 1e-12 * t.area);
  }
}

TEST(PeriodicSheet, HasTheVectorAreaOfItsBox)
{
  Matrix3d box;
  box << 3.0, 0.7, 0.2, -0.4, 2.5, 0.3, 0.5, -0.6, 4.0;    // no component is zero
  const TriangleMesh mesh = perturbed(sheet(6, 6, box, 0.4), 0.05, 3);
  const Totals t = Scene(mesh, Quadrature::CAREFUL, {{0, 0, 1, 0, 0}}).evaluate();
  EXPECT_LT((t.vector_area - box.col(0).cross(box.col(1))).norm(), 1e-12);
  EXPECT_LT(std::fabs(t.gauss), 1e-8);
  EXPECT_GT(t.area, t.vector_area.norm());
}

// === Forces

TEST(Forces, OfThickLeafletsAreMinusTheGradient)
{
  double worst = 0.0;
  for (Moduli moduli : {LEAFLETS, WITH_LEAFLETS})
    for (double distance : {0.02, 0.05}) {
      moduli.leaflet = distance;
      Scene scene(test_mesh("bumpy_icosphere_2"), Quadrature::SIX, {moduli});
      worst = std::max(worst, force_error(scene, {0, 17, 80}));
      for (int valence : {3, 4, 5, 7, 9, 16}) {
        if (SANITIZED && valence != 9) continue;
        Scene corners(loop_refine(loop_refine(perturbed(bipyramid(valence), 0.05, valence))), Quadrature::SIX,
                      {moduli});
        worst = std::max(worst, force_error(corners, {0, 5, 30}, STEP / 20.0));
      }
    }
  EXPECT_LT(worst, 1e-7);
  RecordProperty("worst_error", scientific(worst));
}

// through the band in which the energy goes over to its expansion, and beyond; the band is narrow, and so are steps

TEST(Forces, OfLeafletsAtAnyCurvatureAreMinusTheGradient)
{
  double worst = 0.0;
  for (double distance : {0.6, 0.72, 0.76, 0.8, 0.85, 1.0, 1.5}) {
    Moduli moduli = LEAFLETS;
    moduli.leaflet = distance;
    Scene scene(tube(12, 12, 1.0, Vector3d(5.0, 5.0, 4.0).asDiagonal(), 2), Quadrature::SIX, {moduli});
    worst = std::max(worst, force_error(scene, {0, 7}, STEP / 20.0));
  }
  EXPECT_LT(worst, 1e-7);
  RecordProperty("worst_error", scientific(worst));
}

TEST(Forces, AreMinusTheGradientOfEachTermForEveryValence)
{
  std::map<std::string, double> worst;
  for (int n = 3; n <= 16; n += STRIDE)
    for (Quadrature quadrature : {Quadrature::ONE, Quadrature::SIX})
      for (const auto &[term, moduli] : TERMS) {
        // an apex, and faces of both kinds around it
        Scene scene(valence_mesh(n), quadrature, {moduli}, {0, 1, 2, 3, 4, 5});
        const double error = force_error(scene, {n});
        EXPECT_LT(error, 1e-7) << term << ", valence " << n << ", rule " << name(quadrature);
        worst[term] = std::max(worst[term], error);
      }
  for (const auto &[term, error] : worst) RecordProperty(term, scientific(error));
}

TEST(Forces, AreMinusTheGradientOnWholeMeshesOfManyValences)
{
  for (const TriangleMesh &mesh :
       {valence_mesh(3), valence_mesh(4), valence_mesh(16), perturbed(tetrahedron(), 0.2, 2),
        flipped(icosphere(1, 1.0), 30, 12, 7)}) {
    Scene scene(mesh, Quadrature::SIX, {EVERYTHING});
    EXPECT_LT(force_error(scene, {0, 3}), 1e-7);
  }
}

TEST(Forces, AreMinusTheGradientOfEachTermOnRegularFaces)
{
  const TriangleMesh mesh = perturbed(torus(7, 6, 2.0, 0.8), 0.1, 4);
  ASSERT_EQ(valences_of(mesh), std::set<int>{6});
  for (Quadrature quadrature : ALL_QUADRATURES)
    for (const auto &[term, moduli] : TERMS) {
      if (SANITIZED && quadrature == Quadrature::CAREFUL) continue;
      Scene scene(mesh, quadrature, {moduli});
      EXPECT_LT(force_error(scene, {0, 17}), 1e-7) << term << ", rule " << name(quadrature);
    }
}

TEST(Forces, AreMinusTheGradientWithTheCarefulRule)
{
  double worst = 0.0;
  for (int n = 3; n <= 16; n += 2 * STRIDE - 1) {
    Scene scene(valence_mesh(n), Quadrature::CAREFUL, {EVERYTHING}, {0, 1});
    const double error = force_error(scene, {});
    EXPECT_LT(error, 1e-7) << "valence " << n;
    worst = std::max(worst, error);
  }
  RecordProperty("worst_error", scientific(worst));
}

TEST(Forces, AreMinusTheGradientForTwoMembranesOfDifferentMaterial)
{
  const TriangleMesh mesh =
      together(valence_mesh(5), perturbed(icosphere(1, 1.5), 0.1, 8), {0.5, 0.0, 0.0});
  const Moduli other = {20.0, 0.3, -5.0, 2.0, 4.0};
  Scene scene(mesh, Quadrature::SIX, {EVERYTHING, other});
  ASSERT_EQ(scene.topology().num_components(), 2);
  EXPECT_LT(force_error(scene, {0, 3, 10, 40}), 1e-7);

  // each as if it were alone
  const Totals both = scene.evaluate();
  const Totals one = Scene(valence_mesh(5), Quadrature::SIX, {EVERYTHING}).evaluate();
  Scene second(perturbed(icosphere(1, 1.5), 0.1, 8), Quadrature::SIX, {other});
  second.set_origin({-0.5, 0.0, 0.0});
  const Totals two = second.evaluate();
  EXPECT_LT(relative(both.energy(), one.energy() + two.energy()), 1e-13);
  for (size_t i = 0; i < both.force.size(); ++i) {
    const bool first = i < one.force.size();
    const Vector3d alone = first ? one.force[i] : two.force[i - one.force.size()];
    EXPECT_LT((both.force[i] - alone).norm(), 1e-12 * largest(both.force));
  }
}

TEST(Forces, AreMinusTheGradientAcrossPeriodicBoundaries)
{
  Matrix3d box;
  box << 3.0, 0.7, 0.2, 0.0, 2.5, 0.3, 0.0, 0.0, 4.0;
  const Moduli moduli = {1.3, -0.7, 0.6, 0.9, 0.0};
  TriangleMesh mesh = perturbed(sheet(4, 4, box, 0.4), 0.1, 6);
  for (int nx : {4, 5}) {
    mesh = perturbed(sheet(nx, 4, box, 0.4), 0.1, 6);
    Scene scene(mesh, Quadrature::SIX, {moduli});
    EXPECT_LT(force_error(scene, {0, 3, 9, 15}), 1e-7);
  }

  // points may be given in any periodic image
  const Totals before = Scene(mesh, Quadrature::SIX, {moduli}).evaluate();
  Random random(12);
  for (Vector3d &p : mesh.points)
    p += box * Vector3d(random.below(5) - 2, random.below(5) - 2, 0.0);
  const Totals after = Scene(mesh, Quadrature::SIX, {moduli}).evaluate();
  EXPECT_LT(relative(after.energy(), before.energy()), 1e-12);
  for (size_t i = 0; i < mesh.points.size(); ++i)
    EXPECT_LT((after.force[i] - before.force[i]).norm(), 1e-11 * largest(before.force));
}

TEST(Forces, SumToNothingAndExertNoTorque)
{
  for (const auto &[term, moduli] : TERMS)
    for (const TriangleMesh &mesh :
         {valence_mesh(3), valence_mesh(8), test_mesh("bumpy_icosphere_2")}) {
      if (SANITIZED && mesh.points.size() > 100) continue;
      Scene scene(mesh, Quadrature::CAREFUL, {moduli});
      const Totals t = scene.evaluate();
      Vector3d force = Vector3d::Zero(), torque = Vector3d::Zero();
      double sum = 0.0;
      for (size_t i = 0; i < t.force.size(); ++i) {
        force += t.force[i];
        torque += mesh.points[i].cross(t.force[i]);
        sum += t.force[i].norm();
      }
      // on the Gauss term every force is rounding
      if (term == "gauss") sum = 4.0 * PI;
      EXPECT_LT(force.norm(), 1e-12 * sum) << term;
      EXPECT_LT(torque.norm(), 1e-12 * sum) << term;
    }
}

TEST(Forces, OfTheGaussTermVanishOnAClosedSurface)
{
  for (int n : {3, 5, 7, 12}) {
    const Totals t = Scene(valence_mesh(n), Quadrature::CAREFUL, {GAUSS}).evaluate();
    EXPECT_LT(largest(t.force), 1e-6) << "valence " << n;
    EXPECT_GT(largest(Scene(valence_mesh(n), Quadrature::CAREFUL, {GAUSS}, {0}).evaluate().force),
              1e-2);
  }
}

TEST(Forces, AreAddedToWhatIsThere)
{
  Scene scene(tetrahedron(), Quadrature::SIX, {EVERYTHING});
  const Totals once = scene.evaluate();
  const auto x = reinterpret_cast<const double(*)[3]>(scene.mesh().points.data());
  Points force(4, Vector3d(1.0, 2.0, 3.0));
  FaceEnergies nothing;    // empty arrays are not computed
  face_forces(scene.groups(), x, scene.model(), scene.terms(), reinterpret_cast<double(*)[3]>(force.data()), nothing);
  for (int i = 0; i < 4; ++i)
    EXPECT_LT((force[i] - Vector3d(1.0, 2.0, 3.0) - once.force[i]).norm(), 1e-13);
  EXPECT_TRUE(nothing.bending.empty() && nothing.virial.empty());
}

// === Virial

namespace {

// dE/d(strain) of x_i += strain x_j, and of the box, for xx yy zz xy xz yz
double virial_error(Scene &scene)
{
  const Points &points = scene.mesh().points;
  const Totals t = scene.evaluate();
  const int row[6] = {0, 1, 2, 1, 2, 2}, column[6] = {0, 1, 2, 0, 0, 1};
  double worst = 0.0;
  for (int i = 0; i < 6; ++i) {
    auto energy = [&](double strain) {
      Matrix3d map = Matrix3d::Identity();
      map(row[i], column[i]) += strain;
      Points strained = points;
      for (Vector3d &p : strained) p = map * p;
      return scene.evaluate(strained, map * scene.mesh().lattice).energy();
    };
    worst = std::max(worst, std::fabs(derivative(energy, STEP) + t.virial[i]));
  }
  return worst / t.virial.cwiseAbs().maxCoeff();
}

}    // namespace

TEST(Virial, IsTheDerivativeUnderStrainInEachComponent)
{
  double worst = 0.0;
  for (const TriangleMesh &mesh :
       {valence_mesh(3), valence_mesh(5), valence_mesh(9), test_mesh("bumpy_icosphere_2")})
    for (const auto &[term, moduli] : TERMS) {
      if (term == "gauss") continue;    // 4 pi whatever the strain
      if (SANITIZED && mesh.points.size() > 100) continue;
      Scene scene(mesh, Quadrature::SIX, {moduli});
      const double error = virial_error(scene);
      EXPECT_LT(error, 1e-6) << term;
      worst = std::max(worst, error);
    }
  // the Gauss term alone, on a part of a surface
  Scene part(valence_mesh(7), Quadrature::SIX, {GAUSS}, {0, 1, 2, 3});
  EXPECT_LT(virial_error(part), 1e-6);
  RecordProperty("worst_error", scientific(worst));
}

TEST(Virial, IsTheDerivativeUnderStrainOfAPeriodicBox)
{
  Matrix3d box;
  box << 3.0, 0.7, 0.2, 0.0, 2.5, 0.3, 0.0, 0.0, 4.0;
  Scene flat(perturbed(sheet(5, 4, box, 0.4), 0.1, 6), Quadrature::SIX, {{1.3, -0.7, 0.6, 0.9}});
  EXPECT_LT(virial_error(flat), 1e-6);
  Scene round(perturbed(tube(5, 4, 0.6, box, 0), 0.05, 6), Quadrature::SIX,
              {{1.3, -0.7, 0.6, 0.9}});
  EXPECT_LT(virial_error(round), 1e-6);
}

// === Invariance

TEST(Energy, IsTheSameWhereverTheMembraneIsAndWhicheverWayItTurns)
{
  const TriangleMesh mesh = test_mesh("bumpy_icosphere_2");
  const Matrix3d turn = Eigen::AngleAxisd(1.234, Vector3d(1, 2, -3).normalized()).matrix();
  const Vector3d shift(1.0, -2.0, 0.5);
  TriangleMesh elsewhere = mesh;
  for (Vector3d &p : elsewhere.points) p = turn * p + shift;
  for (Quadrature quadrature : {Quadrature::ONE, Quadrature::SIX}) {
    Scene scene(mesh, quadrature, {EVERYTHING}), other(elsewhere, quadrature, {EVERYTHING});
    other.set_origin(shift);
    const Totals a = scene.evaluate(), b = other.evaluate();
    EXPECT_LT(relative(a.bending, b.bending), 1e-12);
    EXPECT_LT(relative(a.gauss, b.gauss), 1e-12);
    EXPECT_LT(relative(a.area, b.area), 1e-12);
    EXPECT_LT(relative(a.volume, b.volume), 1e-12);
    for (size_t i = 0; i < a.force.size(); ++i)
      EXPECT_LT((turn * a.force[i] - b.force[i]).norm(), 1e-11 * largest(a.force));
  }
}

// with a rule that integrates the flux of a constant field exactly
TEST(Volume, DoesNotDependOnTheOriginOfAClosedMembrane)
{
  Scene scene(valence_mesh(5), Quadrature::CAREFUL, {EVERYTHING});
  const Totals here = scene.evaluate();
  scene.set_origin({3.0, -1.0, 2.0});
  const Totals there = scene.evaluate();
  EXPECT_LT(relative(here.volume, there.volume), 1e-11);
  EXPECT_GT(here.volume, 0.0);
  for (size_t i = 0; i < here.force.size(); ++i)
    EXPECT_LT((here.force[i] - there.force[i]).norm(), 1e-11 * largest(here.force));
}

TEST(BendingEnergy, DoesNotDependOnScale)
{
  for (const TriangleMesh &mesh : {valence_mesh(7), test_mesh("octasphere_2")})
    for (Quadrature quadrature : {Quadrature::ONE, Quadrature::SIX}) {
      TriangleMesh large = mesh;
      for (Vector3d &p : large.points) p *= 1234.5;
      EXPECT_LT(relative(bending(large, quadrature), bending(mesh, quadrature)), 1e-12);
      // c0 goes as one over length
      EXPECT_LT(relative(bending(large, quadrature, 0.5 / 1234.5), bending(mesh, quadrature, 0.5)),
                1e-12);
    }
}

TEST(BendingEnergy, DoesNotDependOnSphereInversion)
{
  std::vector<double> errors;
  for (int n : {24, 48, 96}) {
    const TriangleMesh original = torus(n, 2 * n / 3, std::sqrt(2.0), 1.0);
    TriangleMesh inverted = original;
    for (Vector3d &p : inverted.points) {
      const Vector3d d = p - Vector3d(3.5, 1.0, 1.0);
      p = d / d.squaredNorm();
    }
    for (Face &face : inverted.faces) std::swap(face[1], face[2]);    // inside out
    const Totals t = Scene(interpolate(inverted), Quadrature::SIX).evaluate();
    EXPECT_GT(t.volume, 0.0);
    errors.push_back(t.bending / (4.0 * PI * PI) - 1.0);
    RecordProperty("inverted_" + std::to_string(n), scientific(errors.back()));
  }
  EXPECT_LT(std::fabs(errors.back()), 1e-5);
  EXPECT_GT(fitted_order(errors), 3.5);
}

TEST(BendingEnergy, ChangesSignOfItsC0TermWithTheOrientation)
{
  TriangleMesh mesh = test_mesh("icosphere_2");
  const double outward = bending(mesh, Quadrature::SIX, 1.0);
  for (Face &face : mesh.faces) std::swap(face[1], face[2]);
  EXPECT_LT(relative(bending(mesh, Quadrature::SIX, -1.0), outward), 1e-12);
  EXPECT_GT(bending(mesh, Quadrature::SIX, 1.0), 2.0 * outward);    // 2H = +2/R outward
}

// === Closed forms

namespace {

// a torus whose points form a straight grid, each square of which a diagonal cuts in two
TriangleMesh straight_torus(int nu, int nv, double R, double r)
{
  TriangleMesh mesh;
  auto number = [&](int i, int j) {
    return i % nu * nv + j % nv;
  };
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const double u = 2.0 * PI * i / nu, v = 2.0 * PI * j / nv, rho = R + r * std::cos(v);
      mesh.points.emplace_back(rho * std::cos(u), rho * std::sin(u), r * std::sin(v));
      mesh.faces.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1)});
      mesh.faces.push_back({number(i, j), number(i + 1, j + 1), number(i, j + 1)});
    }
  return mesh;
}

// E/exact - 1 of the torus of radii c and 1 on three meshes
std::vector<double> torus_errors(double c, Quadrature quadrature,
                                 TriangleMesh (*shape)(int, int, double, double))
{
  const double exact = 2.0 * PI * PI * c * c / std::sqrt(c * c - 1.0);
  std::vector<double> errors;
  for (int n : {24, 48, 96})
    errors.push_back(bending(interpolate(shape(n, 2 * n / 3, c, 1.0)), quadrature) / exact - 1.0);
  return errors;
}

}    // namespace

TEST(ClosedForms, CliffordTorusConvergesAsInTheReference)
{
  const std::map<Quadrature, std::vector<double>> reference = {
      {Quadrature::ONE, {-7.9e-3, -1.95e-3, -4.9e-4}},
      {Quadrature::THREE, {7.1e-5, 4.3e-6, 2.7e-7}},
      {Quadrature::SIX, {1.0e-4, 5.9e-6, 3.6e-7}}};
  for (const auto &[quadrature, expected] : reference) {
    const std::vector<double> errors = torus_errors(std::sqrt(2.0), quadrature, straight_torus);
    for (int i = 0; i < 3; ++i)    // the reference has two digits
      EXPECT_NEAR(errors[i], expected[i], 0.06 * std::fabs(expected[i]))
          << name(quadrature) << ", mesh " << i;
    const double order = fitted_order(errors);
    EXPECT_GE(order, quadrature == Quadrature::ONE ? 1.9 : 3.7) << name(quadrature);
    RecordProperty(name(quadrature),
                   scientific(errors[0]) + " " + scientific(errors[1]) + " " +
                       scientific(errors[2]) + " order " + std::to_string(order));
  }
}

TEST(ClosedForms, TorusConvergesWithOrderFour)
{
  for (double c : {std::sqrt(2.0), 3.0})
    for (Quadrature quadrature : {Quadrature::THREE, Quadrature::SIX, Quadrature::TWELVE}) {
      const std::vector<double> errors = torus_errors(c, quadrature, torus);
      EXPECT_GE(fitted_order(errors), 3.7) << name(quadrature) << ", c = " << c;
      EXPECT_LT(std::fabs(errors.back()), 1e-5);
      RecordProperty(name(quadrature) + (c < 2.0 ? "_clifford" : "_slender"),
                     scientific(errors[0]) + " " + scientific(errors[1]) + " " +
                         scientific(errors[2]) + " order " + std::to_string(fitted_order(errors)));
    }
}

TEST(ClosedForms, TorusAreaAndVolumeConvergeWithOrderFour)
{
  std::vector<double> area, volume;
  for (int n : {12, 24, 48}) {
    const Totals t = Scene(interpolate(torus(n, 2 * n / 3, 2.0, 1.0)), Quadrature::SIX).evaluate();
    area.push_back(t.area / (8.0 * PI * PI) - 1.0);
    volume.push_back(t.volume / (4.0 * PI * PI) - 1.0);
  }
  EXPECT_GE(fitted_order(area), 3.7);
  EXPECT_GE(fitted_order(volume), 3.7);
  EXPECT_LT(std::fabs(area.back()) + std::fabs(volume.back()), 1e-4);
  RecordProperty("area", scientific(area.back()));
  RecordProperty("volume", scientific(volume.back()));
}

TEST(ClosedForms, CylinderConvergesWithOrderFour)
{
  const double R = 0.8, L = 3.0, c0 = 0.5;
  const double exact = PI * L * R * (1.0 / R - c0) * (1.0 / R - c0);
  Matrix3d box = 4.0 * Matrix3d::Identity();
  box(2, 2) = L;
  std::vector<double> errors;
  for (int n : {12, 24, 48})
    errors.push_back(bending(interpolate(tube(n, n, R, box, 2)), Quadrature::SIX, c0) / exact -
                     1.0);
  EXPECT_GE(fitted_order(errors), 3.7);
  EXPECT_LT(std::fabs(errors.back()), 1e-5);
  RecordProperty("errors",
                 scientific(errors[0]) + " " + scientific(errors[1]) + " " + scientific(errors[2]));
}

// the integral of 2H: 2 pi L of a cylinder, 8 pi R of a sphere
TEST(ClosedForms, IntegratedMeanCurvatureOfCylinderAndSphere)
{
  const double R = 0.8, L = 3.0;
  Matrix3d box = 4.0 * Matrix3d::Identity();
  box(2, 2) = L;
  std::vector<double> errors;
  for (int n : {12, 24, 48})
    errors.push_back(
        Scene(interpolate(tube(n, n, R, box, 2)), Quadrature::SIX).evaluate().curvature /
            (2.0 * PI * L) - 1.0);
  EXPECT_GE(fitted_order(errors), 3.7);
  EXPECT_LT(std::fabs(errors.back()), 1e-5);

  const Totals t = Scene(interpolate(icosphere(4, R)), Quadrature::SIX).evaluate();
  EXPECT_LT(relative(t.curvature, 8.0 * PI * R), 1e-4);
  RecordProperty("cylinder", scientific(errors.back()));
  RecordProperty("sphere", scientific(relative(t.curvature, 8.0 * PI * R)));
}

// the valence-5 vertices limit an interpolated sphere
TEST(ClosedForms, InterpolatedIcospheresBendAsInTheReference)
{
  const double expected[] = {3.12e-4, 1.581e-2, 5.338e-3, 2.290e-3};    // 42, 162, 642, 2562
  for (int level = 1; level <= 4; ++level) {
    const double error =
        bending(interpolate(icosphere(level, 2.5)), Quadrature::CAREFUL) / (8.0 * PI) - 1.0;
    EXPECT_NEAR(error, expected[level - 1], 2e-3 * expected[level - 1]) << "level " << level;
    RecordProperty("level_" + std::to_string(level), scientific(error));
  }
}

TEST(ClosedForms, SphereWithSpontaneousCurvatureAndGaussTerm)
{
  const double R = 2.5, c0 = 0.3;
  const Totals t =
      Scene(interpolate(icosphere(3, R)), Quadrature::SIX, {{10.0, c0, 3.0, 0.5, 2.0}}).evaluate();
  EXPECT_LT(relative(t.bending, 20.0 * PI * (2.0 - c0 * R) * (2.0 - c0 * R)), 2e-2);
  EXPECT_LT(relative(t.gauss, 12.0 * PI), 1e-4);
  EXPECT_LT(relative(t.tension, 0.5 * 4.0 * PI * R * R), 1e-3);
  EXPECT_LT(relative(t.pressure, 2.0 * 4.0 / 3.0 * PI * R * R * R), 1e-3);
}

TEST(ClosedForms, AFlatSheetHasAreaAndNothingElse)
{
  Matrix3d box;
  box << 3.0, 0.7, 0.0, 0.0, 2.5, 0.0, 0.0, 0.0, 4.0;
  for (Quadrature quadrature : ALL_QUADRATURES) {
    const Totals t = Scene(sheet(6, 4, box, 0.25), quadrature, {{1, 0, 1, 1, 0}}).evaluate();
    EXPECT_LT(relative(t.area, 7.5), 1e-13);
    EXPECT_LT(t.bending, 1e-24);
    EXPECT_LT(std::fabs(t.gauss), 1e-24);
    EXPECT_LT(largest(t.force), 1e-13);
  }
}

// === Points by threes

TEST(Threefold, PointsAreFoundInTheRulesOfThreeAndSixPointsOfARegularFace)
{
  const std::map<Quadrature, size_t> expected = {
      {Quadrature::ONE, 0}, {Quadrature::THREE, 1}, {Quadrature::SIX, 2}, {Quadrature::TWELVE, 0}};
  for (const auto &[quadrature, threes] : expected)
    EXPECT_EQ(shared_rules(quadrature).get({6, 6, 6}).threefold.size(), threes) << name(quadrature);
  for (const Valences &valences : {Valences{5, 6, 6}, Valences{5, 6, 7}, Valences{7, 7, 7}})    // the second with 12 points, too
    EXPECT_TRUE(shared_rules(Quadrature::SIX).get(valences).threefold.empty());
  PatchRule lopsided = shared_rules(Quadrature::SIX).get({6, 6, 6});
  lopsided.weight[2] *= 1.0 + 1e-6;
  EXPECT_TRUE(threefold_points(lopsided.weight, lopsided.area_weight, lopsided.rows).empty());
}

// what a scene gives, compared with what rows times control points do: rules without points by threes and quarters
static void expect_rows(Scene &scene, const std::string &where)
{
  const Totals found = scene.evaluate();
  std::vector<PatchRule> plain;
  plain.reserve(scene.groups().size());
  std::vector<FaceGroup> groups = scene.groups();
  for (FaceGroup &group : groups) {
    plain.push_back(*group.rule);
    plain.back().threefold.clear();
    plain.back().cut = FaceCut();
    group.rule = &plain.back();
  }
  const FaceEnergies faces = scene.last_energies();
  scene.groups() = std::move(groups);
  const Totals rows = scene.evaluate();
  for (auto number : {&Totals::bending, &Totals::gauss, &Totals::tension, &Totals::pressure, &Totals::moment, &Totals::area,
                      &Totals::volume, &Totals::curvature, &Totals::first_pass_bending})
    EXPECT_LE(std::fabs(found.*number - rows.*number), 1e-13 * std::max(1.0, std::fabs(rows.*number))) << where;
  EXPECT_LE((found.vector_area - rows.vector_area).norm(), 1e-13) << where;
  EXPECT_LE((found.virial - rows.virial).norm(), 1e-11 * std::max(1.0, rows.virial.norm())) << where;
  double worst = 0.0;
  for (size_t i = 0; i < rows.force.size(); ++i) worst = std::max(worst, (found.force[i] - rows.force[i]).norm());
  EXPECT_LE(worst, 1e-12 * std::max(1.0, largest(rows.force))) << where;
  for (const FaceGroup &group : scene.groups())
    for (int slot = group.first_slot; slot < group.first_slot + group.nfaces; ++slot)
      EXPECT_NEAR(faces.bending[slot], scene.last_energies().bending[slot], 1e-12 * rows.bending) << where;
}

TEST(Threefold, PointsGiveWhatRowsTimesControlPointsGive)
{
  const TriangleMesh mesh = perturbed(icosphere(2, 1.0), 0.05, 77);
  for (Quadrature quadrature : {Quadrature::THREE, Quadrature::SIX})
    for (const auto &[term, moduli] : TERMS) {
      Scene scene(mesh, quadrature, {moduli});
      EXPECT_TRUE(scene.groups().quarters.groups().empty());
      expect_rows(scene, name(quadrature) + ", " + term);
    }
}

// === Faces of rare kinds by quarters

TEST(Quarters, GiveWhatRowsTimesControlPointsGive)
{
  // around the valences 11 and 12 of the second mesh regular quarters take more points than elsewhere
  const TriangleMesh mesh = perturbed(
      together(flipped(icosphere(2, 1.0), 60, 10, 3), flipped(icosphere(1, 1.0), 60, 12, 3), {4.0, 0.0, 0.0}), 0.03, 78);
  for (Quadrature quadrature : {Quadrature::THREE, Quadrature::SIX, Quadrature::TWELVE})
    for (const auto &[term, moduli] : TERMS) {
      Scene scene(mesh, quadrature, {moduli});
      int regular = 0;
      for (const FaceGroup &group : scene.groups().quarters.groups()) regular += group.rule->size == 12;
      EXPECT_EQ(regular, quadrature == Quadrature::TWELVE ? 1 : 2);
      EXPECT_GT(scene.groups().quarters.groups().size(), 3u);
      expect_rows(scene, name(quadrature) + ", " + term);
    }
}

TEST(Quarters, MeanBendOfLeafletsNeedsNoOtherArray)
{
  Moduli moduli;
  moduli.leaflet = 0.1;
  Scene scene(flipped(icosphere(2, 1.0), 60, 10, 3), Quadrature::SIX, {moduli});
  const auto x = reinterpret_cast<const double(*)[3]>(scene.mesh().points.data());
  FaceEnergies with, without;
  with.leaflet_bend.resize(count_slots(scene.groups()));
  with.area = without.leaflet_bend = with.leaflet_bend;
  for (FaceEnergies *energies : {&with, &without}) {
    Points force(scene.mesh().points.size(), Vector3d::Zero());
    face_forces(scene.groups(), x, scene.model(), scene.terms(), reinterpret_cast<double(*)[3]>(force.data()), *energies);
  }
  EXPECT_TRUE(without.area.empty());
  for (const FaceGroup &group : scene.groups())
    for (int slot = group.first_slot; slot < group.first_slot + group.nfaces; ++slot) {
      EXPECT_EQ(without.leaflet_bend[slot], with.leaflet_bend[slot]);
      EXPECT_GT(with.leaflet_bend[slot], 0.0);
    }
}

// D^2 (k1^2 + k2^2) of a sphere, in the mean of all faces
TEST(Leaflets, MeanBendOfASphere)
{
  const double radius = 2.0;
  Moduli moduli;
  moduli.leaflet = 0.1;
  Scene scene(interpolate(icosphere(3, radius)), Quadrature::SIX, {moduli});
  FaceEnergies energies;
  energies.leaflet_bend.resize(count_slots(scene.groups()));
  energies.area = energies.leaflet_bend;
  Points force(scene.mesh().points.size(), Vector3d::Zero());
  face_forces(scene.groups(), reinterpret_cast<const double(*)[3]>(scene.mesh().points.data()), scene.model(), scene.terms(),
              reinterpret_cast<double(*)[3]>(force.data()), energies);
  double bend = 0.0, area = 0.0;
  for (const FaceGroup &group : scene.groups())
    for (int slot = group.first_slot; slot < group.first_slot + group.nfaces; ++slot) {
      bend += energies.area[slot] * energies.leaflet_bend[slot];
      area += energies.area[slot];
    }
  const double exact = 2.0 * std::pow(moduli.leaflet / radius, 2);
  EXPECT_NEAR(bend / area, exact, 0.03 * exact);
}

// careful rules come so near to a control point of valence 30 that curvatures are 1e94 there
TEST(Leaflets, AreFiniteWhereCurvaturesHaveNoBound)
{
  FaceModel model;
  model.resize(LANES);
  model.kc.assign(LANES, 2.0);
  model.leaflet.assign(LANES, 0.01);
  model.outer.assign(LANES, 0.2);
  model.inner.assign(LANES, -0.1);
  const Leaflets leaflets(model, Slots{0});
  for (double curvature : {1e2, 1e4, 1e94, -1e94, 1e120}) {
    const auto e = leaflets.at(Lane{} + curvature, Lane{} - 0.3 * curvature * curvature);
    for (const Lane &number : {e.value, e.by_curvature, e.by_gaussian, e.bend}) EXPECT_TRUE(std::isfinite(number[0])) << curvature;
    // 2H of the bilayer alone, as w is 0
    EXPECT_NEAR(e.by_curvature[0] / (2.0 * curvature), 1.0, std::fabs(1.0 / curvature)) << curvature;
  }
}

TEST(Quarters, TakeWhatIsLeftOfFullBlocks)
{
  const TriangleMesh mesh = flipped(icosphere(2, 1.0), 60, 10, 3);
  Scene scene(mesh, Quadrature::SIX, {TERMS.begin()->second});
  int left = 0, quarters = 0;
  for (const FaceGroup &group : scene.groups())
    if (!group.rule->cut.empty()) left += group.nfaces % LANES;
  for (const FaceGroup &group : scene.groups().quarters.groups()) quarters += group.nfaces;
  EXPECT_GT(left, 10);
  EXPECT_EQ(quarters, 4 * left);
}

TEST(Quarters, OfAFaceHaveItsPoints)
{
  PatchRules rules(Quadrature::SIX);
  for (const Valences &valences : {Valences{5, 6, 7}, Valences{8, 7, 6}, Valences{3, 12, 4}, Valences{9, 6, 6}}) {
    const PatchRule &rule = rules.get(valences);
    ASSERT_EQ(rule.cut.quarters.size(), 4u);
    EXPECT_EQ(rule.cut.size(), valences[0] + valences[1] + valences[2]);
    int points = 0;
    for (const FaceCut::Quarter &quarter : rule.cut.quarters) {
      ASSERT_EQ(static_cast<int>(quarter.points.size()), quarter.rule->size);
      points += quarter.rule->npoints;
    }
    EXPECT_EQ(points, rule.npoints);
    for (int i = 0; i < rule.cut.size(); ++i) {
      double sum = 0.0;
      for (int j = rule.cut.start[i]; j < rule.cut.start[i + 1]; ++j) sum += rule.cut.weight[j];
      EXPECT_NEAR(sum, 1.0, 1e-14);
    }
  }
  for (const Valences &valences : {Valences{6, 6, 6}, Valences{5, 6, 6}}) EXPECT_TRUE(rules.get(valences).cut.empty());
}

// === Groups

TEST(Groups, HoldEveryFaceOnceWithItsOwnStencil)
{
  const TriangleMesh mesh = together(flipped(icosphere(2, 1.0), 60, 10, 3), loop_refine(loop_refine(bipyramid(12))), {4.0, 0.0, 0.0});
  const Topology topology = topology_of(mesh);
  std::vector<int> faces;
  for (int f = 0; f < topology.num_faces(); f += 2) faces.push_back(f);    // not all of them
  PatchRules rules(Quadrature::SIX);
  const std::vector<FaceGroup> groups = group_faces(topology, rules, faces);

  std::vector<int> seen;
  int slot = 0;
  for (const FaceGroup &group : groups) {
    EXPECT_EQ(group.first_slot, slot);
    EXPECT_EQ(group.first_slot % LANES, 0);
    ASSERT_EQ(static_cast<int>(group.face.size()), group.nfaces);
    slot += group.nslots();
    for (int i = 0; i < group.nfaces; ++i) {
      const Face &face = topology.face(group.face[i]);
      seen.push_back(group.face[i]);
      std::vector<int> stencil;
      const int first = corner_of(face, group.point(i, 0));
      ASSERT_GE(first, 0);
      topology.stencil(group.face[i], stencil, first);
      ASSERT_EQ(static_cast<int>(stencil.size()), group.rule->size);
      for (int k = 0; k < group.rule->size; ++k) EXPECT_EQ(group.point(i, k), stencil[k]);
      const Valences n = {topology.valence(stencil[0]), topology.valence(stencil[1]),
                          topology.valence(stencil[2])};
      EXPECT_EQ(group.rule, topology.is_squeezed(group.face[i]) ? &rules.squeezed() : &rules.get(n));
    }
  }
  EXPECT_TRUE(std::any_of(groups.begin(), groups.end(), [&](const FaceGroup &group) { return group.rule == &rules.squeezed(); }));
  EXPECT_EQ(count_slots(groups), slot);
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(seen, faces);
}

TEST(Groups, TurnFacesOfOneKindTheSameWay)
{
  const TriangleMesh mesh = icosphere(2, 1.0);    // faces with no or one corner of valence 5
  PatchRules rules(Quadrature::ONE);
  std::vector<int> faces;
  for (size_t f = 0; f < mesh.faces.size(); ++f) faces.push_back(static_cast<int>(f));
  EXPECT_EQ(group_faces(topology_of(mesh), rules, faces).size(), 2u);
}

TEST(Groups, OfOneFaceAreEvaluatedWithoutTheirPadding)
{
  const TriangleMesh mesh = valence_mesh(5);
  Scene scene(mesh, Quadrature::SIX, {EVERYTHING});
  const Totals whole = scene.evaluate();
  double energy = 0.0, area = 0.0;
  Eigen::Matrix<double, 6, 1> virial = Eigen::Matrix<double, 6, 1>::Zero();
  Points force(mesh.points.size(), Vector3d::Zero());
  for (int f = 0; f < scene.topology().num_faces(); ++f) {
    Scene single(mesh, Quadrature::SIX, {EVERYTHING}, {f});
    ASSERT_EQ(single.groups().size(), 1u);
    EXPECT_EQ(single.groups()[0].nfaces, 1);
    EXPECT_EQ(count_slots(single.groups()), LANES);
    const Totals t = single.evaluate();
    energy += t.energy();
    area += t.area;
    virial += t.virial;
    for (size_t i = 0; i < force.size(); ++i) force[i] += t.force[i];
  }
  EXPECT_LT(relative(energy, whole.energy()), 1e-13);
  EXPECT_LT(relative(area, whole.area), 1e-13);
  EXPECT_LT((virial - whole.virial).norm(), 1e-12 * whole.virial.norm());
  for (size_t i = 0; i < force.size(); ++i)
    EXPECT_LT((force[i] - whole.force[i]).norm(), 1e-12 * largest(force));
}

TEST(Groups, DoNotReadTheMaterialOfTheirPadding)
{
  // an odd number of faces, so that some block is not full whatever LANES is

  const TriangleMesh mesh = valence_mesh(5);
  std::vector<int> faces(mesh.faces.size() - 1 + mesh.faces.size() % 2);
  std::iota(faces.begin(), faces.end(), 0);
  Scene scene(mesh, Quadrature::SIX, {EVERYTHING}, faces);
  const Totals before = scene.evaluate();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  int padding = 0;
  for (const FaceGroup &group : scene.groups())
    for (int i = group.nfaces; i < group.nslots(); ++i, ++padding)
      scene.model().kc[group.first_slot + i] = scene.model().tension[group.first_slot + i] =
          scene.model().pressure[group.first_slot + i] = nan;
  ASSERT_GT(padding, 0);
  const Totals after = scene.evaluate();
  EXPECT_EQ(before.energy(), after.energy());
  EXPECT_EQ(before.virial, after.virial);
  for (size_t i = 0; i < before.force.size(); ++i) EXPECT_EQ(before.force[i], after.force[i]);
}

TEST(Groups, OfNoFacesAreNone)
{
  const TriangleMesh mesh = icosphere(0, 1.0);
  PatchRules rules(Quadrature::SIX);
  const std::vector<FaceGroup> groups = group_faces(topology_of(mesh), rules, {});
  EXPECT_TRUE(groups.empty());
  EXPECT_EQ(count_slots(groups), 0);
  EXPECT_EQ(Scene(mesh, Quadrature::SIX, {EVERYTHING}, {}).evaluate().energy(), 0.0);
}

TEST(Groups, RefuseAValenceTheyHaveNoRoomFor)
{
  const TriangleMesh mesh = bipyramid(200);
  PatchRules rules(Quadrature::ONE);
  try {
    group_faces(topology_of(mesh), rules, {17});
    FAIL() << "a vertex of valence 200 was accepted";
  } catch (const MeshError &error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("face 17 "), std::string::npos) << what;
    EXPECT_NE(what.find("200"), std::string::npos) << what;
  }
}

// both passes see the same area and the same bending
TEST(Passes, AgreeOnAreaAndBending)
{
  Scene scene(test_mesh("bumpy_icosphere_2"), Quadrature::SIX, {EVERYTHING});
  const Totals t = scene.evaluate();
  double area = 0.0;
  for (const FaceGroup &group : scene.groups())
    for (int i = 0; i < group.nfaces; ++i) area += scene.last_energies().area[group.first_slot + i];
  EXPECT_LT(relative(area, t.area), 1e-14);
  EXPECT_LT(relative(t.first_pass_bending, t.bending), 1e-14);
}
