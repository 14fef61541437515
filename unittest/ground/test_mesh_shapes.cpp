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

#include "membrane_mesh_shapes.h"

#include "membrane_mesh_file.h"

#include "gmock/gmock.h"
#include "gtest/gtest.h"

#include <chrono>
#include <cmath>
#include <cstdlib>

using namespace Membrane_NS;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::HasSubstr;

namespace {

const double PI = std::acos(-1.0);

Matrix3d box(double lx, double ly, double lz, double xy = 0.0, double xz = 0.0, double yz = 0.0)
{
  Matrix3d lattice;
  lattice << lx, xy, xz, 0.0, ly, yz, 0.0, 0.0, lz;
  return lattice;
}

// a repeatable number in [-1, 1)

double jitter()
{
  static unsigned long long state = 88172645463325252ull;
  state ^= state << 13;
  state ^= state >> 7;
  state ^= state << 17;
  return static_cast<double>(state >> 11) / (1ull << 52) - 1.0;
}

TriangleMesh jittered(TriangleMesh mesh, double amplitude)
{
  for (Vector3d &p : mesh.points) p += amplitude * Vector3d(jitter(), jitter(), jitter());
  return mesh;
}

TriangleMesh tetrahedron()
{
  TriangleMesh mesh;
  mesh.points = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
  mesh.faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

// apexes of valence n over and under a belt of valence 4

TriangleMesh bipyramid(int n)
{
  TriangleMesh mesh;
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * PI * i / n;
    mesh.points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    mesh.faces.push_back({i, (i + 1) % n, n});
    mesh.faces.push_back({(i + 1) % n, i, n + 1});
  }
  mesh.points.emplace_back(0, 0, 1);
  mesh.points.emplace_back(0, 0, -1);
  return mesh;
}

// closed surfaces and periodic ones, with valences 3 to 20, all of extent near 1

std::vector<TriangleMesh> assorted_meshes()
{
  std::vector<TriangleMesh> meshes = {tetrahedron(), icosphere(0, 1.0),
                                      jittered(icosphere(2, 1.0), 0.02), torus(9, 6, 1.0, 0.4)};
  for (int n = 3; n <= 20; ++n) meshes.push_back(jittered(bipyramid(n), 0.1));
  meshes.push_back(jittered(sheet(6, 8, box(1.0, 1.1, 0.9, 0.3, 0.2, -0.1), 0.4), 0.01));
  meshes.push_back(jittered(tube(7, 6, 0.3, box(1.0, 1.1, 0.9, 0.3, 0.2, -0.1), 2), 0.01));
  return meshes;
}

Topology topology_of(const TriangleMesh &mesh)
{
  return Topology(static_cast<int>(mesh.points.size()), mesh.faces);
}

Vector3d area_vector(const TriangleMesh &mesh, const Face &face)
{
  return 0.5 * mesh.edge(face[0], face[1]).cross(mesh.edge(face[0], face[2]));
}

double enclosed_volume(const TriangleMesh &mesh)
{
  double volume = 0.0;
  for (const Face &face : mesh.faces)
    volume += area_vector(mesh, face).dot(mesh.points[face[0]]) / 3.0;
  return volume;
}

void expect_all_valences_are_six(const TriangleMesh &mesh)
{
  const Topology topology = topology_of(mesh);
  EXPECT_EQ(topology.num_components(), 1);
  EXPECT_EQ(topology.euler_characteristic(0), 0);
  for (int v = 0; v < topology.num_vertices(); ++v) ASSERT_EQ(topology.valence(v), 6);
}

template <typename Make> std::string error_of(Make make)
{
  try {
    make();
  } catch (const MeshError &error) {
    return error.what();
  }
  return "no error";
}

}    // namespace

// === Nearest images

TEST(TriangleMesh, EdgeOfAPlainMeshIsTheDifference)
{
  const TriangleMesh mesh = tetrahedron();
  EXPECT_EQ(mesh.edge(0, 3), Vector3d(0, -2, -2));
}

TEST(TriangleMesh, EdgeTakesTheNearestImageInPeriodicDirectionsOnly)
{
  TriangleMesh mesh;
  mesh.lattice = box(10, 10, 10, 2.0);
  mesh.periodic = {true, true, false};
  mesh.points = {{0.5, 0.5, 0.5}, {11.0, 9.5, 9.5}};
  // the difference (10.5, 9, 9) less the box vectors a = (10, 0, 0) and b = (2, 10, 0)
  EXPECT_LT((mesh.edge(0, 1) - Vector3d(-1.5, -1.0, 9.0)).norm(), 1e-14);
  EXPECT_LT((mesh.edge(1, 0) + mesh.edge(0, 1)).norm(), 1e-14);
}

// === Shapes

TEST(MeshShapes, IcosphereHasItsCountsAndLiesOnTheSphere)
{
  for (int level = 0; level <= 5; ++level) {
    const TriangleMesh mesh = icosphere(level, 2.5);
    const int faces = 20 << 2 * level;
    EXPECT_EQ(static_cast<int>(mesh.points.size()), faces / 2 + 2);
    EXPECT_EQ(static_cast<int>(mesh.faces.size()), faces);
    for (const Vector3d &p : mesh.points) ASSERT_NEAR(p.norm(), 2.5, 1e-15 * 4);
    for (const Face &face : mesh.faces)
      ASSERT_GT(area_vector(mesh, face).dot(mesh.points[face[0]]), 0.0);
    const Topology topology = topology_of(mesh);
    EXPECT_EQ(topology.euler_characteristic(0), 2);
    int fives = 0;
    for (int v = 0; v < topology.num_vertices(); ++v) fives += topology.valence(v) == 5;
    EXPECT_EQ(fives, 12);
  }
}

TEST(MeshShapes, LargestIcosphereTakesWellUnderASecond)
{
  const auto start = std::chrono::steady_clock::now();
  const TriangleMesh mesh = icosphere(7, 1.0);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(mesh.points.size(), 163842u);
  // 0.05 s when optimised; a quadratic algorithm takes hours
  EXPECT_LT(seconds.count(), 5.0);
}

TEST(MeshShapes, SheetIsFlatRegularAndFacesUp)
{
  const Matrix3d lattice = box(8.0, 10.0 * std::sqrt(3.0) / 2.0, 5.0);
  const TriangleMesh mesh = sheet(8, 10, lattice, 0.25);
  EXPECT_EQ(mesh.points.size(), 80u);
  EXPECT_TRUE(mesh.periodic[0] && mesh.periodic[1] && !mesh.periodic[2]);
  expect_all_valences_are_six(mesh);
  Vector3d area = Vector3d::Zero();
  for (const Face &face : mesh.faces) {
    area += area_vector(mesh, face);
    for (int k = 0; k < 3; ++k)    // equilateral in this box
      ASSERT_NEAR(mesh.edge(face[k], face[(k + 1) % 3]).norm(), 1.0, 1e-14);
  }
  EXPECT_LT((area - Vector3d(0, 0, lattice(0, 0) * lattice(1, 1))).norm(), 1e-12);
  for (const Vector3d &p : mesh.points) EXPECT_NEAR(p[2], 1.25, 1e-15);
}

TEST(MeshShapes, SheetFollowsATiltedBox)
{
  const Matrix3d lattice = box(6, 5, 4, 1.5, -1.0, 0.8);
  const TriangleMesh mesh = sheet(4, 4, lattice, 0.5);
  expect_all_valences_are_six(mesh);
  Vector3d area = Vector3d::Zero();
  for (const Face &face : mesh.faces) {
    area += area_vector(mesh, face);
    ASSERT_GT(area_vector(mesh, face).dot(lattice.col(2)), 0.0);
  }
  EXPECT_LT((area - Vector3d(lattice.col(0)).cross(Vector3d(lattice.col(1)))).norm(), 1e-13);
}

TEST(MeshShapes, TubeIsRegularAndFacesOutwardAlongEachAxis)
{
  const Matrix3d lattice = box(6, 7, 8, 1.5, -1.0, 0.8);
  for (int axis = 0; axis < 3; ++axis) {
    const TriangleMesh mesh = tube(9, 10, 1.2, lattice, axis);
    EXPECT_EQ(mesh.points.size(), 90u);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(mesh.periodic[k], k == axis);
    expect_all_valences_are_six(mesh);
    const Vector3d along = lattice.col(axis).normalized();
    double area = 0.0;
    for (const Face &face : mesh.faces) {
      const Vector3d &p = mesh.points[face[0]];
      const Vector3d radial = p - along * along.dot(p);
      ASSERT_NEAR(radial.norm(), 1.2, 1e-14);
      ASSERT_GT(area_vector(mesh, face).dot(radial), 0.0);
      area += area_vector(mesh, face).norm();
    }
    EXPECT_NEAR(area / (2.0 * PI * 1.2 * lattice.col(axis).norm()), 1.0, 0.05);
  }
}

TEST(MeshShapes, TorusIsRegularAndFacesOutward)
{
  const TriangleMesh mesh = torus(24, 12, 1.0, 0.35);
  EXPECT_EQ(mesh.points.size(), 288u);
  EXPECT_EQ(mesh.faces.size(), 576u);
  expect_all_valences_are_six(mesh);
  for (const Vector3d &p : mesh.points)
    ASSERT_NEAR(std::hypot(std::hypot(p[0], p[1]) - 1.0, p[2]), 0.35, 1e-15);
  // the inscribed polyhedron of a torus of volume 2 pi^2 R r^2
  EXPECT_NEAR(enclosed_volume(mesh) / (2.0 * PI * PI * 0.35 * 0.35), 0.93, 0.02);
}

TEST(MeshShapes, TorusCloses)
{
  for (int nu = 3; nu <= 9; ++nu)
    for (int nv = 4; nv <= 14; nv += 2) {
      const TriangleMesh mesh = torus(nu, nv, 1.0, 0.3);
      expect_all_valences_are_six(mesh);
      EXPECT_GT(enclosed_volume(mesh), 0.0) << nu << " " << nv;
      // a wrong seam would join far points: no step is longer than one around plus one across
      const double longest = 2.6 * std::sin(PI / nu) + 0.6 * std::sin(PI / nv);
      for (const Face &face : mesh.faces)
        for (int k = 0; k < 3; ++k)
          ASSERT_LT(mesh.edge(face[k], face[(k + 1) % 3]).norm(), longest) << nu << " " << nv;
    }
}

TEST(MeshShapes, AreTheReferenceMeshes)
{
  const char *folder = std::getenv("REFERENCE");
  if (!folder) GTEST_SKIP() << "set REFERENCE to the folder of reference meshes";
  const std::pair<const char *, TriangleMesh> shapes[] = {
      {"icosphere_1.off", icosphere(1, 1.0)},
      {"icosphere_2.off", icosphere(2, 1.0)},
      {"torus_24x12.off", torus(24, 12, 1.0, 0.35)}};
  for (const auto &[name, mesh] : shapes) {
    const TriangleMesh reference = read_mesh(std::string(folder) + "/" + name);
    EXPECT_EQ(mesh.faces, reference.faces) << name;
    ASSERT_EQ(mesh.points.size(), reference.points.size()) << name;
    for (size_t v = 0; v < mesh.points.size(); ++v)
      ASSERT_LT((mesh.points[v] - reference.points[v]).norm(), 1e-14) << name;
  }
}

TEST(MeshShapes, SmallestShapesAreValid)
{
  const Matrix3d lattice = box(1, 1, 1);
  expect_all_valences_are_six(sheet(4, 4, lattice, 0.0));
  expect_all_valences_are_six(tube(3, 4, 0.2, lattice, 1));
  EXPECT_EQ(icosphere(0, 1.0).points.size(), 12u);
}

// one line for each case
// clang-format off

TEST(MeshShapes, ImpossibleNumbersAreNamed)
{
  const Matrix3d lattice = box(1, 1, 1);
  const double nan = std::nan("");
  EXPECT_THAT(error_of([&] { icosphere(8, 1.0); }), HasSubstr("level 8"));
  EXPECT_THAT(error_of([&] { icosphere(-1, 1.0); }), HasSubstr("level -1"));
  EXPECT_THAT(error_of([&] { icosphere(1, 0.0); }), HasSubstr("icosphere radius"));
  EXPECT_THAT(error_of([&] { icosphere(1, nan); }), HasSubstr("icosphere radius"));
  EXPECT_THAT(error_of([&] { sheet(3, 4, lattice, 0.5); }), HasSubstr("not 3"));
  EXPECT_THAT(error_of([&] { sheet(4, 7, lattice, 0.5); }), HasSubstr("even number of rows"));
  EXPECT_THAT(error_of([&] { sheet(4, 4, lattice, nan); }), HasSubstr("height"));
  EXPECT_THAT(error_of([&] { sheet(4, 4, -lattice, 0.5); }), HasSubstr("right-handed"));
  EXPECT_THAT(error_of([&] { tube(2, 4, 0.1, lattice, 0); }), HasSubstr("not 2"));
  EXPECT_THAT(error_of([&] { tube(3, 5, 0.1, lattice, 0); }), HasSubstr("not 5"));
  EXPECT_THAT(error_of([&] { tube(3, 4, 0.1, lattice, 3); }), HasSubstr("axis"));
  EXPECT_THAT(error_of([&] { tube(3, 4, -0.1, lattice, 0); }), HasSubstr("tube radius"));
  EXPECT_THAT(error_of([&] { torus(2, 4, 1, 0.1); }), HasSubstr("not 2"));
  EXPECT_THAT(error_of([&] { torus(4, 5, 1, 0.1); }), HasSubstr("not 5"));
  EXPECT_THAT(error_of([&] { torus(4, 4, 1, 1); }), HasSubstr("smaller"));
}

// clang-format on

// === Refinement

TEST(LoopRefine, SplitsEachFaceInFourAndMakesRegularPoints)
{
  for (const TriangleMesh &mesh : assorted_meshes()) {
    const Topology coarse = topology_of(mesh);
    const TriangleMesh refined = loop_refine(mesh);
    const Topology fine = topology_of(refined);
    EXPECT_EQ(fine.num_faces(), 4 * coarse.num_faces());
    ASSERT_EQ(fine.num_vertices(), coarse.num_vertices() + coarse.num_edges());
    for (int v = 0; v < fine.num_vertices(); ++v)
      ASSERT_EQ(fine.valence(v), v < coarse.num_vertices() ? coarse.valence(v) : 6);
    EXPECT_EQ(refined.lattice, mesh.lattice);
    EXPECT_EQ(refined.periodic, mesh.periodic);
  }
}

TEST(LoopRefine, LeavesTheLimitSurfaceWhereItIs)
{
  for (const TriangleMesh &mesh : assorted_meshes()) {
    const std::vector<Vector3d> before = limit_positions(mesh);
    const TriangleMesh once = loop_refine(mesh);
    const std::vector<Vector3d> after = limit_positions(once),
                                twice = limit_positions(loop_refine(once));
    for (size_t v = 0; v < before.size(); ++v) ASSERT_LT((after[v] - before[v]).norm(), 1e-14 * 10);
    for (size_t v = 0; v < after.size(); ++v) ASSERT_LT((twice[v] - after[v]).norm(), 1e-14 * 10);
  }
}

TEST(LoopRefine, RepeatedItConvergesToTheLimitPositions)
{
  TriangleMesh mesh = bipyramid(7);
  const std::vector<Vector3d> limit = limit_positions(mesh);
  for (int i = 0; i < 6; ++i) mesh = loop_refine(mesh);
  for (size_t v = 0; v < limit.size(); ++v) EXPECT_LT((mesh.points[v] - limit[v]).norm(), 2e-3);
}

TEST(LoopRefine, KeepsAPlaneAndItsOrientation)
{
  const TriangleMesh mesh = loop_refine(sheet(5, 6, box(3, 3, 3, 0.4), 0.5));
  for (const Face &face : mesh.faces) {
    const Vector3d area = area_vector(mesh, face);
    ASSERT_NEAR(area[2], 9.0 / mesh.faces.size(), 1e-14);
    ASSERT_NEAR(area.head<2>().norm(), 0.0, 1e-14);
  }
}

// one line for each case
// clang-format off

TEST(LoopRefine, RejectsAnOpenMesh)
{
  TriangleMesh mesh = tetrahedron();
  mesh.faces.pop_back();
  EXPECT_THAT(error_of([&] { loop_refine(mesh); }), HasSubstr("boundary"));
  EXPECT_THAT(error_of([&] { interpolate(mesh); }), HasSubstr("boundary"));
  EXPECT_THAT(error_of([&] { limit_positions(mesh); }), HasSubstr("boundary"));
}

// clang-format on

// === Interpolation

TEST(Interpolate, LimitSurfaceRunsThroughThePointsForAnyValence)
{
  for (const TriangleMesh &mesh : assorted_meshes()) {
    const TriangleMesh control = interpolate(mesh);
    EXPECT_EQ(control.faces, mesh.faces);
    const std::vector<Vector3d> limit = limit_positions(control);
    for (size_t v = 0; v < limit.size(); ++v)
      ASSERT_LT((limit[v] - mesh.points[v]).norm(), 1e-13) << "vertex " << v;
  }
}

TEST(Interpolate, UndoesTheLimitMask)
{
  for (const TriangleMesh &mesh : assorted_meshes()) {
    TriangleMesh on_surface = mesh;
    on_surface.points = limit_positions(mesh);
    const TriangleMesh back = interpolate(on_surface);
    for (size_t v = 0; v < mesh.points.size(); ++v)
      ASSERT_LT((back.points[v] - mesh.points[v]).norm(), 1e-12);
  }
}

TEST(Interpolate, PointsInAnyPeriodicImageMoveAlike)
{
  const TriangleMesh mesh = jittered(sheet(6, 8, box(1.0, 1.1, 0.9, 0.3, 0.2, -0.1), 0.4), 0.01);
  TriangleMesh scattered = mesh;
  for (size_t v = 0; v < mesh.points.size(); ++v)
    scattered.points[v] += mesh.lattice * Vector3d(v % 3 - 1.0, v % 5 - 2.0, 0.0);
  const TriangleMesh expected = interpolate(mesh), control = interpolate(scattered);
  for (size_t v = 0; v < mesh.points.size(); ++v)
    ASSERT_LT(
        (control.points[v] - scattered.points[v] - expected.points[v] + mesh.points[v]).norm(),
        1e-14);
}

TEST(Interpolate, LargeMeshConvergesAsTheSmallOneDoes)
{
  const TriangleMesh mesh = icosphere(5, 10.0);
  const std::vector<Vector3d> limit = limit_positions(interpolate(mesh));
  for (size_t v = 0; v < limit.size(); ++v)
    ASSERT_LT((limit[v] - mesh.points[v]).norm(), 10.0 * 1e-13);
}

// one line for each case
// clang-format off

TEST(Interpolate, RejectsCoordinatesThatAreNotFinite)
{
  TriangleMesh mesh = tetrahedron();
  mesh.points[2][1] = std::nan("");
  EXPECT_THAT(error_of([&] { interpolate(mesh); }), HasSubstr("not finite"));
}

// clang-format on
