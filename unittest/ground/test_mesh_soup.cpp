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

// From what a file has to a mesh: vertices that occur twice, polygons, orientations, several surfaces.

#include "mesh_files.h"

#include "membrane_mesh_orientation.h"
#include "membrane_mesh_shapes.h"
#include "membrane_mesh_writer.h"

#include "gmock/gmock.h"

#include <cmath>
#include <cstdlib>

using namespace Membrane_NS;
using Eigen::Vector3d;
using testing::AllOf;
using testing::HasSubstr;

namespace {

// === Meshes as soups

PolygonSoup soup_of(const TriangleMesh &mesh)
{
  PolygonSoup soup;
  soup.points = mesh.points;
  for (const Face &face : mesh.faces) soup.add_triangle(face[0], face[1], face[2]);
  return soup;
}

/// Each face with points of its own.
PolygonSoup torn(const TriangleMesh &mesh)
{
  PolygonSoup soup;
  for (const Face &face : mesh.faces) {
    const int n = static_cast<int>(soup.points.size());
    for (int v : face) soup.points.push_back(mesh.points[v]);
    soup.add_triangle(n, n + 1, n + 2);
  }
  return soup;
}

TriangleMesh moved(TriangleMesh mesh, const Vector3d &by)
{
  for (Vector3d &p : mesh.points) p += by;
  return mesh;
}

TriangleMesh together(TriangleMesh a, const TriangleMesh &b)
{
  const int n = static_cast<int>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const Face &face : b.faces) a.faces.push_back({face[0] + n, face[1] + n, face[2] + n});
  return a;
}

TriangleMesh reversed(TriangleMesh mesh)
{
  for (Face &face : mesh.faces) std::swap(face[1], face[2]);
  return mesh;
}

/// Points (+-1, 0, 0) and so on: corners of the faces are one of each pair.
TriangleMesh octahedron()
{
  TriangleMesh mesh;
  mesh.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < 8; ++i) {
    const int x = i & 1, y = 2 + (i >> 1 & 1), z = 4 + (i >> 2);
    if ((x + y + z) % 2 == 0)
      mesh.faces.push_back({x, y, z});
    else
      mesh.faces.push_back({x, z, y});
  }
  return mesh;
}

TriangleMesh mesh_of(const PolygonSoup &soup, MeshFileReport &report, const PeriodicBox &box = {})
{
  return assemble("x.off", soup, box, report);
}

std::string error_of(const PolygonSoup &soup, const PeriodicBox &box = {})
{
  try {
    MeshFileReport report;
    mesh_of(soup, report, box);
  } catch (const MeshError &error) {
    return error.what();
  }
  return "no error";
}

PeriodicBox cube(double length)
{
  PeriodicBox box;
  box.lattice = length * Eigen::Matrix3d::Identity();
  box.periodic = {true, true, true};
  return box;
}

std::vector<double> volumes(const TriangleMesh &mesh)
{
  return enclosed_volumes(Topology(static_cast<int>(mesh.points.size()), mesh.faces), mesh);
}

double next_random(unsigned long long &state)    // -1 to 1
{
  state = state * 6364136223846793005ull + 1442695040888963407ull;
  return static_cast<double>(state >> 11) / (1ull << 52) - 1.0;
}

}    // namespace

// === Vertices that occur twice

TEST(MeshSoup, TornFacesAreJoinedIntoTheMeshTheyWere)
{
  MeshFileReport report;
  const TriangleMesh sphere = icosphere(2, 1.0), mesh = mesh_of(torn(sphere), report);
  EXPECT_EQ(mesh.points.size(), sphere.points.size());
  EXPECT_EQ(report.joined, 3 * 320 - 162);
  EXPECT_EQ(report.turned, 0);
  for (int f = 0; f < 320; ++f)
    for (int k = 0; k < 3; ++k)
      ASSERT_EQ(mesh.points[mesh.faces[f][k]], sphere.points[sphere.faces[f][k]]);
  EXPECT_THAT(report.summary(), HasSubstr("960 vertices, 320 faces; 798 vertices joined"));
}

TEST(MeshSoup, WhatIsClosedIsLeftAsItIs)
{
  MeshFileReport report;
  const TriangleMesh sphere = icosphere(2, 1.0), mesh = mesh_of(soup_of(sphere), report);
  EXPECT_EQ(mesh.points, sphere.points);
  EXPECT_EQ(mesh.faces, sphere.faces);
  EXPECT_EQ(report.summary(), "162 vertices, 320 faces");
}

TEST(MeshSoup, ASeamIsJoinedWithinTheErrorOfSixDigits)
{
  // the half with x > 0 has vertices of its own

  const TriangleMesh sphere = icosphere(2, 1.0);
  for (double error : {0.0, 5e-7}) {
    PolygonSoup soup;
    soup.points = sphere.points;
    unsigned long long state = 1;
    for (Vector3d p : sphere.points) {
      for (int k = 0; k < 3; ++k) p[k] += error * next_random(state);
      soup.points.push_back(p);
    }
    for (const Face &face : sphere.faces) {
      double x = 0.0;
      for (int v : face) x += sphere.points[v][0];
      const int n = x > 0.0 ? 162 : 0;
      soup.add_triangle(face[0] + n, face[1] + n, face[2] + n);
    }
    MeshFileReport report;
    const TriangleMesh mesh = mesh_of(soup, report);
    EXPECT_EQ(mesh.points.size(), 162u);
    EXPECT_EQ(report.joined, 162);    // copies that no face uses too
  }
}

TEST(MeshSoup, MembranesThatTouchStayApart)
{
  const TriangleMesh left = octahedron(), right = moved(left, {2.0, 0.0, 0.0});
  MeshFileReport report;
  EXPECT_EQ(mesh_of(soup_of(together(left, right)), report).points.size(), 12u);
  EXPECT_EQ(report.joined, 0);

  // also if each face has its own vertices, or they share the one in which they touch

  EXPECT_EQ(mesh_of(torn(together(left, right)), report).points.size(), 12u);
  EXPECT_EQ(report.separated, 1);
  TriangleMesh shared = together(left, right);
  for (Face &face : shared.faces)
    for (int &v : face)
      if (v == 7) v = 0;    // (-1, 0, 0) of the right one
  shared.points.erase(shared.points.begin() + 7);
  for (Face &face : shared.faces)
    for (int &v : face)
      if (v > 7) --v;
  const TriangleMesh mesh = mesh_of(soup_of(shared), report);
  EXPECT_EQ(mesh.points.size(), 12u);
  EXPECT_EQ(report.separated, 1);
  EXPECT_THAT(report.summary(), HasSubstr("1 vertex doubled where surfaces touch"));
  EXPECT_EQ(volumes(mesh).size(), 2u);
}

TEST(MeshSoup, MembranesThatTouchAlongAnEdgeAreAnErrorThatNamesIt)
{
  const TriangleMesh left = octahedron(),
                     right = moved(left, {1.0, 1.0, 0.0});    // share two vertices
  MeshFileReport report;
  EXPECT_EQ(mesh_of(soup_of(together(left, right)), report).points.size(), 12u);
  EXPECT_THAT(error_of(torn(together(left, right))),
              AllOf(HasSubstr("belongs to 4 faces"), HasSubstr("not a manifold; split")));
}

TEST(MeshSoup, APlaneWithBothItsEndsInTheFileContinuesThroughTheBox)
{
  // 5 x 5 points over a box of 4: what lies on one side lies on the opposite one too

  PolygonSoup soup;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) soup.points.emplace_back(i - 2.0, j - 2.0, 0.1);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      soup.corners.insert(soup.corners.end(),
                          {5 * i + j, 5 * i + j + 5, 5 * i + j + 6, 5 * i + j + 1});
      soup.end_polygon();
    }
  MeshFileReport report;
  const TriangleMesh mesh = mesh_of(soup, report, cube(4.0));
  EXPECT_EQ(mesh.points.size(), 16u);
  EXPECT_EQ(mesh.faces.size(), 32u);
  EXPECT_EQ(report.joined, 9);
  EXPECT_TRUE(std::isnan(volumes(mesh)[0]));
  EXPECT_THAT(
      error_of(soup),
      AllOf(HasSubstr("is a boundary, one of 16 such edges"), HasSubstr("close the holes")));
}

TEST(MeshSoup, AClosedSurfaceThatTouchesItsImagesStaysOne)
{
  MeshFileReport report;
  EXPECT_EQ(mesh_of(torn(octahedron()), report, cube(2.0)).points.size(), 6u);
}

TEST(MeshSoup, DoublesThatNoFaceUsesAreJoinedOthersAreAnError)
{
  PolygonSoup soup = soup_of(octahedron());
  soup.points.push_back(soup.points[2]);
  MeshFileReport report;
  EXPECT_EQ(mesh_of(soup, report).points.size(), 6u);
  EXPECT_EQ(report.joined, 1);
  soup.points.emplace_back(0.5, 0.5, 0.5);
  EXPECT_THAT(error_of(soup), HasSubstr("vertex 7 is in no face; remove it"));
}

// === Polygons

TEST(MeshSoup, QuadsAreCutAlongTheShorterDiagonalWithinThem)
{
  auto first_cut = [](std::vector<Vector3d> x) {
    const std::vector<Face> t = cut_polygon(x);
    EXPECT_EQ(t.size(), x.size() - 2);
    std::vector<int> uses(x.size(), 0);
    for (const Face &face : t)
      for (int v : face) ++uses[v];
    return uses;    // two for the ends of the diagonal
  };
  EXPECT_EQ(first_cut({{0, 0, 0}, {3, 1, 0}, {4, 4, 0}, {1, 3, 0}}),
            (std::vector<int>{1, 2, 1, 2}));
  EXPECT_EQ(first_cut({{3, 1, 0}, {4, 4, 0}, {1, 3, 0}, {0, 0, 0}}),
            (std::vector<int>{2, 1, 2, 1}));
  // concave at (0, 0.1): the shorter diagonal is outside
  EXPECT_EQ(first_cut({{1, 0, 0}, {0, 3, 0}, {-1, 0, 0}, {0, 0.1, 0}}),
            (std::vector<int>{1, 2, 1, 2}));
}

TEST(MeshSoup, PolygonsKeepTheirAreaAndOrientation)
{
  // a star: every other corner is concave

  std::vector<Vector3d> star;
  for (int i = 0; i < 10; ++i) {
    const double r = i % 2 ? 0.4 : 1.0, angle = 2.0 * M_PI * i / 10;
    star.emplace_back(r * std::cos(angle), r * std::sin(angle), 2.0);
  }
  double area = 0.0;
  for (const Face &t : cut_polygon(star)) {
    const double piece = 0.5 * (star[t[1]] - star[t[0]]).cross(star[t[2]] - star[t[0]])[2];
    EXPECT_GT(piece, 0.0);
    area += piece;
  }
  EXPECT_NEAR(area, 5.0 * 0.4 * std::sin(M_PI / 5.0), 1e-14);
}

TEST(MeshSoup, FacesWithoutAreaAreLeftOutAndTooManyCornersAreAnError)
{
  PolygonSoup soup = soup_of(octahedron());
  soup.add_triangle(0, 2, 2);
  MeshFileReport report;
  EXPECT_EQ(mesh_of(soup, report).faces.size(), 8u);
  EXPECT_THAT(report.summary(), HasSubstr("1 face without area left out"));
  for (int k = 0; k < 300; ++k) soup.corners.push_back(k % 6);
  soup.end_polygon();
  EXPECT_THAT(error_of(soup), AllOf(HasSubstr("face 9 has 300 corners"), HasSubstr("triangulate")));
}

TEST(MeshSoup, StripsAlternate)
{
  PolygonSoup soup;
  soup.add_strip({0, 1, 2, 3, 3, 4, 5});
  EXPECT_EQ(soup.corners, (std::vector<int>{0, 1, 2, 2, 1, 3, 3, 4, 5}));
}

// === Orientation

TEST(MeshSoup, FacesInMixedOrientationAreTurnedOutward)
{
  const TriangleMesh sphere = icosphere(2, 1.0);
  for (int every : {2, 3, 50}) {
    TriangleMesh mixed = sphere;
    int n = 0;
    for (size_t f = 1; f < mixed.faces.size(); f += every, ++n)
      std::swap(mixed.faces[f][1], mixed.faces[f][2]);
    for (bool start_inward : {false, true}) {
      MeshFileReport report;
      const TriangleMesh mesh = mesh_of(soup_of(start_inward ? reversed(mixed) : mixed), report);
      EXPECT_GT(volumes(mesh)[0], 4.0);
      EXPECT_EQ(report.turned, start_inward ? 320 - n : n);
    }
  }
}

TEST(MeshSoup, AConsistentOrientationIsThatOfTheFile)
{
  MeshFileReport report;
  const TriangleMesh inward = reversed(icosphere(1, 1.0));
  const TriangleMesh mesh = mesh_of(soup_of(inward), report);
  EXPECT_EQ(mesh.faces, inward.faces);
  EXPECT_EQ(report.turned, 0);
  EXPECT_LT(volumes(mesh)[0], -3.0);
}

TEST(MeshSoup, EachSurfaceIsOrientedByItself)
{
  TriangleMesh mixed = octahedron();
  std::swap(mixed.faces[3][0], mixed.faces[3][1]);
  const TriangleMesh three =
      together(together(mixed, moved(reversed(octahedron()), {3, 0, 0})), moved(mixed, {6, 0, 0}));
  MeshFileReport report;
  const std::vector<double> v = volumes(mesh_of(soup_of(three), report));
  ASSERT_EQ(v.size(), 3u);
  EXPECT_EQ(report.turned, 2);
  EXPECT_NEAR(v[0], 4.0 / 3.0, 1e-14);
  EXPECT_NEAR(v[1], -4.0 / 3.0, 1e-14);
  EXPECT_NEAR(v[2], 4.0 / 3.0, 1e-14);
}

TEST(MeshSoup, AMixedPlaneIsTurnedAsMostOfItsFaces)
{
  const PeriodicBox box = cube(6.0);
  TriangleMesh plane = sheet(6, 6, box.lattice, 0.5), mixed = plane;
  for (size_t f = 0; f < 20; ++f) std::swap(mixed.faces[f][1], mixed.faces[f][2]);
  MeshFileReport report;
  const TriangleMesh mesh = mesh_of(soup_of(mixed), report, box);
  EXPECT_EQ(report.turned, 20);
  for (const Face &face : mesh.faces)
    EXPECT_GT(mesh.edge(face[0], face[1]).cross(mesh.edge(face[0], face[2]))[2], 0.0);
}

TEST(MeshSoup, ASurfaceWithOneSideIsAnError)
{
  // a Klein bottle: a torus whose rings are joined the wrong way round

  PolygonSoup soup;
  const int n = 8;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) soup.points.emplace_back(i, j, 0.1 * i * j);
  auto at = [n](int i, int j) {
    return i == n ? (2 * n - j) % n : n * i + j % n;
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      soup.add_triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      soup.add_triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  EXPECT_THAT(error_of(soup), AllOf(HasSubstr("one side only"), HasSubstr("; cut it open")));
}

TEST(MeshSoup, EnclosedVolumesKnowImages)
{
  TriangleMesh sphere = icosphere(2, 1.0);
  const double volume = volumes(sphere)[0];
  const PeriodicBox box = cube(2.5);
  sphere.lattice = box.lattice;
  sphere.periodic = box.periodic;
  for (Vector3d &p : sphere.points)
    for (int k = 0; k < 3; ++k) p[k] -= 2.5 * std::floor((p[k] + 0.3) / 2.5);
  EXPECT_NEAR(volumes(sphere)[0], volume, 1e-13);
  EXPECT_NEAR(volumes(reversed(sphere))[0], -volume, 1e-13);
  const TriangleMesh cylinder = tube(8, 8, 0.5, box.lattice, 2);
  EXPECT_TRUE(std::isnan(volumes(cylinder)[0]));
}

// === The formats of other programs

TEST(MeshSoup, EveryFormatGivesTheSameBox)
{
  const char *folder = std::getenv("REFERENCE");
  ASSERT_NE(folder, nullptr);
  for (const char *name :
       {"box.off", "box.obj", "box_text.ply", "box_little.ply", "box_big.ply", "box_text.stl",
        "box_binary.stl", "box_ascii.vtp", "box_binary.vtp", "box.tsi", "box.mesh"}) {
    PeriodicBox box = cube(8.0);
    MeshFileReport report;
    const TriangleMesh mesh = read_mesh(std::string(folder) + "/seeds/" + name, box, report);
    EXPECT_EQ(mesh.points.size(), 8u) << name;
    EXPECT_EQ(mesh.faces.size(), 12u) << name;
    EXPECT_NEAR(volumes(mesh)[0], 9.0, 1e-12) << name;
  }
}

TEST(MeshSoup, WhatIsWrittenForOtherProgramsIsReadAgain)
{
  const PeriodicBox box = cube(3.0);
  TriangleMesh sphere = icosphere(2, 1.0), plane = sheet(6, 8, box.lattice, 0.99);
  sphere.lattice = box.lattice;
  sphere.periodic = plane.periodic = box.periodic;
  for (const TriangleMesh &mesh : {sphere, plane})
    for (const std::string end : {"vtp", "tsi"}) {
      const std::string path = temp_path("again." + end);
      if (end == "vtp")
        write_vtp(path, mesh);
      else
        write_tsi(path, mesh);
      MeshFileReport report;
      const TriangleMesh again = read_mesh(path, box, report);
      ASSERT_EQ(again.points.size(), mesh.points.size()) << end;
      ASSERT_EQ(again.faces.size(), mesh.faces.size()) << end;
      EXPECT_EQ(report.turned, 0);
      for (size_t f = 0; f < mesh.faces.size(); ++f)
        for (int k = 0; k < 3; ++k)
          ASSERT_LT(
              again.nearest_image(again.points[again.faces[f][k]] - mesh.points[mesh.faces[f][k]])
                  .norm(),
              1e-14);
    }
}

TEST(MeshSoup, AMeshThatCrossesTheBoxOfItsFileNeedsThatBox)
{
  const PeriodicBox box = cube(3.0);
  TriangleMesh sphere = icosphere(2, 1.0);    // around a corner of the box
  sphere.lattice = box.lattice;
  sphere.periodic = box.periodic;
  const std::string path = temp_path("wrapped.tsi");
  write_tsi(path, sphere);
  auto message = [&](const PeriodicBox &in) -> std::string {
    try {
      MeshFileReport report;
      read_mesh(path, in, report);
    } catch (const MeshError &error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(message(box), "no error");
  EXPECT_THAT(message(cube(4.0)),
              AllOf(HasSubstr("periodic box in x, which is 3 long"), HasSubstr("is 4 there")));
  EXPECT_THAT(message(PeriodicBox()), HasSubstr("is not periodic"));
}
