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

// Energies of the flat faces: the measure, and regularize conformal.

#include "membrane_measure.h"
#include "membrane_regularization.h"
#include "scene.h"

#include <gtest/gtest.h>

#include <functional>

using namespace Membrane_NS;
using namespace Membrane_TEST;

namespace {

// One of these energies on a closed mesh

struct FlatScene {
  Topology topology;
  std::vector<FaceGroup> groups;
  std::vector<double> modulus;
  std::vector<int> across;
  std::function<void(const FlatScene &, const FaceGroup &, const double (*)[3], double (*)[3],
                     std::vector<double> &, std::vector<double> &)>
      kernel;
  Points force;
  Eigen::Matrix<double, 6, 1> virial;

  explicit FlatScene(const TriangleMesh &mesh) : topology(topology_of(mesh))
  {
    std::vector<int> faces(mesh.faces.size());
    for (size_t f = 0; f < faces.size(); ++f) faces[f] = static_cast<int>(f);
    groups = group_faces(topology, shared_rules(Quadrature::THREE), faces);
    modulus.assign(count_slots(groups), 1.7);
    across.assign(3 * modulus.size(), 0);
    for (const FaceGroup &group : groups)
      for (int s = 0; s < group.nfaces; ++s)
        for (int k = 0; k < 3; ++k) {
          const Face &face = topology.face(group.face[s]);
          const auto corner = std::find(face.begin(), face.end(), group.point(s, k)) - face.begin();
          across[3 * (group.first_slot + s) + k] =
              topology.opposite(group.face[s], static_cast<int>(corner));
        }
  }

  double energy(const Points &points)
  {
    force.assign(points.size(), Vector3d::Zero());
    virial.setZero();
    std::vector<double> e(modulus.size(), 0.0), v(6 * modulus.size(), 0.0);
    double sum = 0.0;
    for (const FaceGroup &group : groups)
      kernel(*this, group, reinterpret_cast<const double(*)[3]>(points.data()),
             reinterpret_cast<double(*)[3]>(force.data()), e, v);
    for (size_t i = 0; i < e.size(); ++i) {
      sum += e[i];
      virial += Eigen::Map<const Eigen::Matrix<double, 6, 1>>(&v[6 * i]);
    }
    return sum;
  }
};

FlatScene measure(const TriangleMesh &mesh)
{
  FlatScene scene(mesh);
  scene.kernel = [](const FlatScene &s, const FaceGroup &group, auto x, auto f, auto &e, auto &v) {
    measure_faces(group, x, s.modulus, f, e, v);
  };
  return scene;
}

FlatScene conformal(const TriangleMesh &mesh)
{
  FlatScene scene(mesh);
  scene.kernel = [](const FlatScene &s, const FaceGroup &group, auto x, auto f, auto &e, auto &v) {
    std::vector<double> logs(3 * s.modulus.size(), 0.0);
    cross_ratios(group, x, s.modulus, s.across, logs);
    conformal_faces(group, x, s.modulus, s.across, logs, f, e, v);
  };
  return scene;
}

FlatScene plain(const TriangleMesh &mesh)
{
  FlatScene scene(mesh);
  scene.kernel = [](const FlatScene &s, const FaceGroup &group, auto x, auto f, auto &e, auto &v) {
    regularize_faces(group, x, s.modulus, f, e, v);
  };
  return scene;
}

// regularize conformal on one component: where its points gather

FlatScene dipole(const TriangleMesh &mesh)
{
  FlatScene scene(mesh);
  scene.kernel = [](const FlatScene &s, const FaceGroup &group, auto x, auto f, auto &e, auto &v) {
    const std::vector<int> component(s.modulus.size(), 0);
    std::vector<double> origin;
    for (size_t slot = 0; slot < s.modulus.size(); ++slot) origin.insert(origin.end(), {0.3, -5.0, 2.0});
    std::vector<PointDipole> dipoles(1);
    for (const FaceGroup &each : s.groups) add_dipoles(each, x, origin, s.modulus, component, dipoles);
    hold_dipoles(group, x, origin, component, dipoles, f, e, v);
  };
  return scene;
}

// A map of the sphere onto itself that moves it towards a pole: x -> conformal, another scale in every place

Points boosted(Points points, double boost)
{
  for (Vector3d &p : points) {
    const double g = std::cosh(boost) + std::sinh(boost) * p.z();
    p = Vector3d(p.x(), p.y(), std::sinh(boost) + std::cosh(boost) * p.z()) / g;
  }
  return points;
}

const auto MESHES = {tetrahedron(), bipyramid(7), flipped(icosphere(2, 1.0), 200, 10, 3)};

// a relative displacement of the mesh, and its virial, against differences of the energy

void compare_with_differences(FlatScene scene, const Points &points)
{
  Random random(7);
  Points way(points.size());
  for (Vector3d &w : way) w = random.vector();
  const double step = 1e-6;
  Points ahead = points, back = points;
  for (size_t i = 0; i < points.size(); ++i) {
    ahead[i] += step * way[i];
    back[i] -= step * way[i];
  }
  const double slope = (scene.energy(ahead) - scene.energy(back)) / (2.0 * step);
  scene.energy(points);
  double work = 0.0, size = 0.0;
  Vector3d total = Vector3d::Zero();
  Eigen::Matrix<double, 6, 1> virial = Eigen::Matrix<double, 6, 1>::Zero();
  for (size_t i = 0; i < points.size(); ++i) {
    const Vector3d &f = scene.force[i], &r = points[i];
    work += f.dot(way[i]);
    size += f.norm();
    total += f;
    const double terms[6] = {r[0] * f[0], r[1] * f[1], r[2] * f[2],
                             r[0] * f[1], r[0] * f[2], r[1] * f[2]};
    for (int k = 0; k < 6; ++k) virial[k] += terms[k];
  }
  EXPECT_NEAR(work, -slope, 1e-8 * size);
  EXPECT_LT(total.norm(), 1e-12 * size);
  EXPECT_LT((virial - scene.virial).norm(), 1e-12 * size);
}

}    // namespace

TEST(Measure, ForcesAndVirialAreThoseOfTheEnergyOnAnyMesh)
{
  for (const TriangleMesh &mesh : MESHES)
    compare_with_differences(measure(mesh), perturbed(mesh, 0.05, 2).points);
}

TEST(Measure, IsTheSumOfLogarithmsOfAreas)
{
  // a tetrahedron with edges of sqrt(8) has faces of 2 sqrt(3)
  FlatScene scene = measure(tetrahedron());
  EXPECT_NEAR(scene.energy(tetrahedron().points), 4.0 * 1.7 * std::log(2.0 * std::sqrt(3.0)), 1e-13);
}

TEST(Measure, TheVirialIsThatOfAnAreaWhateverTheShape)
{
  for (const TriangleMesh &mesh : MESHES) {
    FlatScene scene = measure(mesh);
    scene.energy(perturbed(mesh, 0.05, 2).points);
    EXPECT_NEAR(scene.virial.head<3>().sum(), -2.0 * 1.7 * mesh.faces.size(), 1e-9);
  }
}

TEST(Conformal, ForcesAndVirialAreThoseOfTheEnergyOnAnyMesh)
{
  for (const TriangleMesh &mesh : MESHES)
    compare_with_differences(conformal(mesh), perturbed(mesh, 0.05, 2).points);
}

TEST(Conformal, DoesNotKnowSizes)
{
  for (const TriangleMesh &mesh : MESHES) {
    FlatScene scene = conformal(mesh);
    Points points = perturbed(mesh, 0.05, 2).points;
    const double before = scene.energy(points);
    EXPECT_NEAR(scene.virial.head<3>().sum(), 0.0, 1e-11 * before);
    for (Vector3d &p : points) p *= 3.0;
    EXPECT_NEAR(scene.energy(points), before, 1e-12 * before);
  }
}

TEST(Conformal, AMoebiusTransformationOfASphereCostsATenthOfWhatItDoesWithoutConformal)
{
  const TriangleMesh mesh = icosphere(3, 1.0);
  const auto cost = [&](FlatScene scene) {
    const double before = scene.energy(mesh.points);
    return scene.energy(boosted(mesh.points, 0.2)) - before;
  };
  const double with = cost(conformal(mesh)), without = cost(plain(mesh));
  EXPECT_GT(without, 0.1);
  EXPECT_NEAR(with / without, 0.1, 0.02);
}

TEST(Dipole, ForcesAndVirialAreThoseOfTheEnergyOnAnyMesh)
{
  for (const TriangleMesh &mesh : MESHES)
    compare_with_differences(dipole(mesh), perturbed(mesh, 0.05, 2).points);
}

TEST(Dipole, DoesNotKnowSizesAndAttitudes)
{
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.0, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for (const TriangleMesh &mesh : MESHES) {
    FlatScene scene = dipole(mesh);
    Points points = perturbed(mesh, 0.05, 2).points;
    const double before = scene.energy(points);
    EXPECT_GT(before, 0.0);
    EXPECT_NEAR(scene.virial.head<3>().sum(), 0.0, 1e-11 * before);
    for (Vector3d &p : points) p = 3.0 * turn * p + Vector3d(5, -7, 11);
    EXPECT_NEAR(scene.energy(points), before, 1e-11 * before);
  }
}

// x -> x + b (1 - x x).e moves the mean of the points by 2b/3, and areas do not change where their centre is

TEST(Dipole, AMoebiusTransformationCostsWhatTheSphereSays)
{
  const TriangleMesh mesh = icosphere(4, 1.0);
  FlatScene scene = dipole(mesh);
  EXPECT_NEAR(scene.energy(mesh.points), 0.0, 1e-12);
  const double boost = 0.05;
  EXPECT_NEAR(scene.energy(boosted(mesh.points, boost)) / (10.0 * 1.7 * 4.0 / 9.0 * boost * boost), 1.0, 0.01);
  EXPECT_GT(scene.energy(boosted(mesh.points, 0.2)), 10.0 * (conformal(mesh).energy(boosted(mesh.points, 0.2)) -
                                                            conformal(mesh).energy(mesh.points)));
}

TEST(Dipole, ShapesThatAreTheSameOnBothSidesCostNothing)
{
  const TriangleMesh mesh = icosphere(3, 1.0);
  Points points = mesh.points;
  for (Vector3d &p : points) p *= 1.0 + 0.2 * p.z() * p.z() + 0.1 * p.x() * p.y();
  EXPECT_NEAR(dipole(mesh).energy(points), 0.0, 1e-12);
}

// A pure shear: both moduli are the same, and a tenth is added

TEST(Conformal, ResistsShearAsMuchAsWithoutConformal)
{
  const double shear = 1e-3;
  Eigen::Matrix3d lattice = Eigen::Matrix3d::Identity();
  lattice.diagonal() << 6.0, 3.0 * std::sqrt(3.0), 10.0;
  const TriangleMesh mesh = sheet(6, 6, lattice, 0.0);
  const auto cost = [&](FlatScene scene, bool sheared) {
    // faces by their own coordinates: the sheet is periodic
    double sum = 0.0;
    for (const FaceGroup &group : scene.groups)
      for (int s = 0; s < group.nfaces; ++s) {
        const Face &face = scene.topology.face(group.face[s]);
        Points p = {Vector3d::Zero(), mesh.edge(face[0], face[1]), mesh.edge(face[0], face[2])};
        Vector3d out[3];
        for (int k = 0; k < 3; ++k) {
          const int a = face[k], d = scene.topology.opposite(group.face[s], k);
          out[k] = p[k] + mesh.edge(a, d);
        }
        for (auto *x : {&p[0], &p[1], &p[2], &out[0], &out[1], &out[2]})
          if (sheared) *x = Vector3d(x->x() * (1.0 + 0.5 * shear), x->y() * (1.0 - 0.5 * shear), 0.0);
        FaceGroup one;
        one.rule = group.rule;
        one.nfaces = 1;
        one.face = {0};
        one.points.assign(group.rule->size * LANES, 0);
        for (int k = 0; k < 3; ++k) one.point(0, k) = k;
        Points x = {p[0], p[1], p[2], out[0], out[1], out[2]}, f(6, Vector3d::Zero());
        std::vector<double> e(one.nslots(), 0.0), none;
        scene.modulus.assign(one.nslots(), 1.0);
        scene.across = {3, 4, 5};
        scene.kernel(scene, one, reinterpret_cast<const double(*)[3]>(x.data()),
                     reinterpret_cast<double(*)[3]>(f.data()), e, none);
        sum += e[0];
      }
    return sum;
  };
  const double with = cost(conformal(mesh), true) - cost(conformal(mesh), false),
               without = cost(plain(mesh), true) - cost(plain(mesh), false);
  EXPECT_NEAR(without, 0.5 * shear * shear * mesh.faces.size(), 1e-3 * without);
  EXPECT_NEAR(with / without, 1.1, 1e-3);
}

// Edges of the three families of a sheet run in three directions, whatever the order of faces and corners

TEST(Conformal, FamiliesOfEdgesAreThoseOfADirection)
{
  Eigen::Matrix3d lattice = Eigen::Matrix3d::Identity();
  lattice.diagonal() << 6.0, 3.0 * std::sqrt(3.0), 10.0;
  TriangleMesh mesh = sheet(6, 6, lattice, 0.0);
  Random random(11);
  for (size_t i = mesh.faces.size() - 1; i > 0; --i)
    std::swap(mesh.faces[i], mesh.faces[static_cast<size_t>(0.5 * (1.0 + random.symmetric()) * (i + 1)) % (i + 1)]);
  for (size_t i = 0; i < mesh.faces.size(); ++i)
    std::rotate(mesh.faces[i].begin(), mesh.faces[i].begin() + i % 3, mesh.faces[i].end());
  const Topology topology = topology_of(mesh);
  const std::vector<int> family = edge_families(topology);
  std::vector<Vector3d> direction(3, Vector3d::Zero());
  for (int f = 0; f < topology.num_faces(); ++f)
    for (int k = 0; k < 3; ++k) {
      ASSERT_GE(family[f], 0);
      const Face &face = topology.face(f);
      const Vector3d edge = mesh.edge(face[k], face[(k + 1) % 3]).normalized();
      Vector3d &known = direction[(family[f] + k) % 3];
      if (known.isZero()) known = edge;
      EXPECT_NEAR(std::fabs(known.dot(edge)), 1.0, 1e-12);
    }
  EXPECT_NEAR(std::fabs(direction[0].dot(direction[1])), 0.5, 1e-12);
  EXPECT_NEAR(std::fabs(direction[1].dot(direction[2])), 0.5, 1e-12);

  for (int f : edge_families(topology_of(icosphere(2, 1.0)))) EXPECT_EQ(f, -1);
}
