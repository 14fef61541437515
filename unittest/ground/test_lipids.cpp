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

#include "membrane_lipid_library.h"

#include "scene.h"

#include <gtest/gtest.h>

using namespace Membrane_TEST;

namespace {

constexpr double KC = 1.7, OUTER = 0.4, INNER = -0.9;

LipidLibrary library()
{
  LipidLibrary all;
  all.read("# DATE: 2000-01-01 UNITS: real\nA 70 0.01\nB 31 -0.04  # of something\n\nC 60 0\n", "some.file", 1.0);
  return all;
}

LeafletComposition mixture(const LipidLibrary &of, const std::vector<std::pair<std::string, double>> &parts)
{
  LeafletComposition leaflet;
  for (const auto &[name, more] : parts) leaflet.add(of[of.find(name)], of.find(name), more);
  leaflet.normalize();
  return leaflet;
}

std::string problem(const std::function<void()> &act)
{
  try {
    act();
  } catch (const LipidError &err) {
    return err.what();
  }
  return "";
}

double energy(const TriangleMesh &mesh, double distance, double outer = OUTER, double inner = INNER)
{
  Moduli moduli;
  moduli.kc = KC;
  moduli.leaflet = distance;
  moduli.outer = outer;
  moduli.inner = inner;
  return Scene(mesh, Quadrature::TWELVE, {moduli}).evaluate().bending;
}

// both leaflets of a sphere, each kc/4 (c - c0)^2 on its own surface: `curvature` is 2 or 1 of a cylinder
double exact(double distance, double radius, double curvature, const std::function<double(double)> &area)
{
  const double r = radius + distance, s = radius - distance;
  return 0.25 * KC *
      (std::pow(curvature / r - OUTER, 2) * area(r) + std::pow(-curvature / s - INNER, 2) * area(s));
}

}    // namespace

// === Library and composition

TEST(LipidLibrary, ReadsNamesAreasAndCurvaturesInAnyUnitOfLength)
{
  LipidLibrary nano;
  nano.read("A 70 0.01\n", "some.file", 0.1);
  EXPECT_DOUBLE_EQ(nano[0].area, 0.7);
  EXPECT_DOUBLE_EQ(nano[0].c0, 0.1);
  EXPECT_EQ(library().size(), 3);
  EXPECT_EQ(library().names(), "A, B, C");
  EXPECT_EQ(library().find("D"), -1);
}

TEST(LipidLibrary, SaysWhatIsWrong)
{
  LipidLibrary all = library();
  EXPECT_EQ(all.add({"A", 70.0, 0.01}), 0);
  EXPECT_NE(problem([&] { all.add({"A", 71.0, 0.01}); }).find("lipid A has area 71"), std::string::npos);
  EXPECT_NE(problem([&] { all.add({"D", 0.0, 0.01}); }).find("area of lipid D"), std::string::npos);
  EXPECT_NE(problem([&] { all.add({"D", 1.0, NAN}); }).find("curvature of lipid D"), std::string::npos);
  EXPECT_NE(problem([&] { all.read("\nD 1.0\n", "some.file", 1.0); }).find("some.file, line 2"), std::string::npos);
  LeafletComposition leaflet;
  EXPECT_NE(problem([&] { leaflet.add(all[0], 0, -1.0); }).find("lipid A must not be negative"), std::string::npos);
  leaflet.add(all[0], 0, 0.0);
  EXPECT_NE(problem([&] { leaflet.normalize(); }).find("all zero"), std::string::npos);
}

TEST(Composition, IsTheMeanByNumberOfAreasAndByAreaOfCurvatures)
{
  const LipidLibrary all = library();
  const LeafletComposition one = mixture(all, {{"A", 30.0}, {"B", 10.0}}), other = mixture(all, {{"B", 0.5}, {"A", 1.5}});
  EXPECT_DOUBLE_EQ(one.area(all), 0.75 * 70.0 + 0.25 * 31.0);
  EXPECT_DOUBLE_EQ(one.curvature(all), (3.0 * 70.0 * 0.01 - 31.0 * 0.04) / (3.0 * 70.0 + 31.0));
  EXPECT_DOUBLE_EQ(other.curvature(all), one.curvature(all));
  const LeafletComposition twice = mixture(all, {{"A", 1.0}, {"A", 2.0}, {"B", 1.0}});
  EXPECT_EQ(twice.parts.size(), 2u);
  EXPECT_DOUBLE_EQ(twice.curvature(all), one.curvature(all));
}

// === Leaflets

// on icospheres and tubes that are refined, with the radius that their area has: of a sphere the faces around twelve
// extraordinary vertices have a curvature of their own whatever their size, so errors fall with their area and slower
TEST(Leaflets, OfASphereAndACylinderHaveTheirClosedForms)
{
  constexpr double LENGTH = 4.0;
  const Matrix3d box = Vector3d(5.0, 5.0, LENGTH).asDiagonal();
  const auto sphere = [](double r) { return 4.0 * PI * r * r; };
  const auto cylinder = [](double r) { return 2.0 * PI * r * LENGTH; };
  for (double distance : {0.05, 0.1, 0.2, 0.3}) {
    std::vector<double> spheres, cylinders;
    for (int level : {2, 3, 4}) {
      const TriangleMesh round = icosphere(level, 1.0), tubular = tube(4 << level, 4 << level, 1.0, box, 2);
      const double R = std::sqrt(Scene(round, Quadrature::TWELVE).evaluate().area / (4.0 * PI));
      const double r = Scene(tubular, Quadrature::TWELVE).evaluate().area / (2.0 * PI * LENGTH);
      spheres.push_back(energy(round, distance) / exact(distance, R, 2.0, sphere) - 1.0);
      cylinders.push_back(energy(tubular, distance) / exact(distance, r, 1.0, cylinder) - 1.0);
    }
    EXPECT_LT(std::fabs(spheres[2]), 2e-3) << distance;
    EXPECT_LT(std::fabs(cylinders[2]), 1e-5) << distance;
    EXPECT_GT(std::fabs(spheres[0]), 1.8 * std::fabs(spheres[1])) << distance;
    EXPECT_GT(std::fabs(spheres[1]), 1.8 * std::fabs(spheres[2])) << distance;
    EXPECT_GT(std::fabs(cylinders[1]), 8.0 * std::fabs(cylinders[2])) << distance;
    RecordProperty("sphere " + std::to_string(distance), scientific(spheres[2]));
    RecordProperty("cylinder " + std::to_string(distance), scientific(cylinders[2]));
  }
}

TEST(Leaflets, AreTheBilayerToTheOrderOfTheirDistance)
{
  const TriangleMesh mesh = test_mesh("bumpy_icosphere_2");
  Moduli bilayer = {KC, 0.5 * (OUTER - INNER)};
  const Totals flat = Scene(mesh, Quadrature::TWELVE, {bilayer}).evaluate();
  const double constant = KC / 8.0 * std::pow(OUTER + INNER, 2) * flat.area;
  std::vector<double> differences;
  for (double distance : {4e-4, 2e-4, 1e-4}) differences.push_back(energy(mesh, distance) - flat.bending - constant);
  EXPECT_LT(std::fabs(differences[2]), 0.01 * flat.bending);
  for (int i : {0, 1}) EXPECT_NEAR(differences[i] / differences[i + 1], 2.0, 0.02);
  // c0 outside and -c0 inside is the bilayer with c0, without a constant
  EXPECT_NEAR(energy(mesh, 1e-12, 0.6, -0.6),
              Scene(mesh, Quadrature::TWELVE, {Moduli{KC, 0.6}}).evaluate().bending, 1e-9 * flat.bending);
}

TEST(Leaflets, SayHowMuchTheyAreBent)
{
  Moduli moduli = {KC};
  for (double distance : {0.1, 0.5, 0.9, 1.2}) {
    moduli.leaflet = distance;
    const Matrix3d box = Vector3d(5.0, 5.0, 4.0).asDiagonal();
    Scene scene(tube(40, 40, 1.0, box, 2), Quadrature::SIX, {moduli});
    scene.last_energies().leaflet_bend.assign(count_slots(scene.groups()), 0.0);
    scene.evaluate();
    const auto &bend = scene.last_energies().leaflet_bend;
    for (const FaceGroup &group : scene.groups())
      for (int s = 0; s < group.nfaces; ++s)
        EXPECT_NEAR(bend[group.first_slot + s], distance * distance, 0.01 * distance * distance);
  }
}

// where a leaflet's surface would have a cusp the energy goes over to its expansion, and below it is exact to the end

TEST(Leaflets, AreExactWhereTheyFitAndExpandedWhereTheyDoNot)
{
  constexpr double LENGTH = 4.0;
  const Matrix3d box = Vector3d(5.0, 5.0, LENGTH).asDiagonal();
  const TriangleMesh tubular = tube(64, 64, 1.0, box, 2);
  const Totals bare = Scene(tubular, Quadrature::TWELVE, {Moduli{KC}}).evaluate();
  const double r = bare.area / (2.0 * PI * LENGTH);
  const auto cylinder = [](double radius) { return 2.0 * PI * radius * LENGTH; };
  EXPECT_NEAR(energy(tubular, 0.7 * r) / exact(0.7 * r, r, 1.0, cylinder), 1.0, 1e-4);
  for (double distance : {0.95 * r, 1.0 * r, 1.7 * r}) {
    const double expanded = bare.bending +
        0.25 * KC * (-2.0 * (OUTER - INNER) * (2.0 * PI * LENGTH) + OUTER * OUTER * cylinder(r + distance) +
                     INNER * INNER * cylinder(r - distance));
    EXPECT_NEAR(energy(tubular, distance) / expanded, 1.0, 1e-4) << distance;
  }
}

// === Flat membranes

TEST(FaceModel, HasTheEnergyOfTheFlatMembrane)
{
  FaceModel model;
  model.resize(1);
  model.kc[0] = KC;
  model.add_curvatures(0, OUTER, INNER);
  EXPECT_DOUBLE_EQ(model.c0[0], 0.5 * (OUTER - INNER));
  EXPECT_DOUBLE_EQ(model.flat_energy(0), 0.5 * KC * model.c0[0] * model.c0[0]);
  for (double distance : {0.0, 0.1}) {
    model.resize(1);
    model.kc[0] = KC;
    model.leaflet = {distance};
    model.outer = model.inner = {0.0};
    model.add_curvatures(0, OUTER, INNER);
    const double mean = 0.5 * (OUTER - INNER);
    EXPECT_DOUBLE_EQ(model.flat_energy(0), distance > 0.0 ? 0.25 * KC * (OUTER * OUTER + INNER * INNER)
                                                          : 0.5 * KC * mean * mean);
  }
}
