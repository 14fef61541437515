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
#include "membrane_topology.h"
#include "scene.h"

#include "gmock/gmock.h"
#include "gtest/gtest.h"

#include <algorithm>
#include <set>

using namespace Membrane_NS;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

const std::vector<Face> TETRAHEDRON = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};

const std::vector<Face> OCTAHEDRON = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1},
                                      {5, 2, 1}, {5, 3, 2}, {5, 4, 3}, {5, 1, 4}};

// two apexes of valence n, numbers n and n+1, over and under a belt of n vertices of valence 4

std::vector<Face> bipyramid(int n)
{
  std::vector<Face> faces;
  for (int i = 0; i < n; ++i) {
    faces.push_back({i, (i + 1) % n, n});
    faces.push_back({(i + 1) % n, i, n + 1});
  }
  return faces;
}

// nx by ny vertices on a torus, all of valence 6; vertex (i, j) is number j*nx + i

std::vector<Face> regular_torus(int nx, int ny)
{
  std::vector<Face> faces;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int a = j * nx + i, b = j * nx + (i + 1) % nx;
      const int d = (j + 1) % ny * nx + i, c = (j + 1) % ny * nx + (i + 1) % nx;
      faces.push_back({a, b, c});
      faces.push_back({a, c, d});
    }
  return faces;
}

std::vector<Face> shifted(std::vector<Face> faces, int offset)
{
  for (Face &face : faces)
    for (int &v : face) v += offset;
  return faces;
}

std::vector<Face> joined(std::vector<Face> first, const std::vector<Face> &second)
{
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

std::vector<int> rotated_to_smallest(IntSpan ring)
{
  std::vector<int> result(ring.begin(), ring.end());
  std::rotate(result.begin(), std::min_element(result.begin(), result.end()), result.end());
  return result;
}

std::string error_of(int num_vertices, const std::vector<Face> &faces,
                     const Topology::Labels &labels = {})
{
  try {
    Topology(num_vertices, faces, labels);
  } catch (const MeshError &error) {
    return error.what();
  }
  return "no error";
}

}    // namespace

// === Counts and rings

TEST(Topology, CountsVerticesEdgesAndFaces)
{
  const Topology mesh(6, OCTAHEDRON);
  EXPECT_EQ(mesh.num_vertices(), 6);
  EXPECT_EQ(mesh.num_edges(), 12);
  EXPECT_EQ(mesh.num_faces(), 8);
  EXPECT_GT(mesh.memory_usage(), 8 * sizeof(Face));
}

TEST(Topology, RingsRunCounterClockwise)
{
  const Topology mesh(6, OCTAHEDRON);
  EXPECT_THAT(rotated_to_smallest(mesh.ring(0)), ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(rotated_to_smallest(mesh.ring(5)), ElementsAre(1, 4, 3, 2));
  EXPECT_THAT(rotated_to_smallest(mesh.ring(1)), ElementsAre(0, 4, 5, 2));
}

TEST(Topology, FacesAroundAVertexFollowItsRing)
{
  for (int n : {3, 5, 6, 9, 20}) {
    const Topology mesh(n + 2, bipyramid(n));
    EXPECT_EQ(mesh.valence(n), n);
    EXPECT_EQ(mesh.valence(0), 4);
    for (int v = 0; v < mesh.num_vertices(); ++v)
      for (int i = 0; i < mesh.valence(v); ++i) {
        const Face &face = mesh.face(mesh.faces_around(v)[i]);
        const int k = corner_of(face, v);
        ASSERT_GE(k, 0);
        EXPECT_EQ(face[(k + 1) % 3], mesh.ring(v)[i]);
        EXPECT_EQ(face[(k + 2) % 3], mesh.ring(v)[(i + 1) % mesh.valence(v)]);
      }
  }
}

TEST(Topology, NeighborsShareTheEdgeTheyAreNamedFor)
{
  const Topology mesh(11, bipyramid(9));
  for (int f = 0; f < mesh.num_faces(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Face &face = mesh.face(f), &other = mesh.face(mesh.neighbor(f, k));
      const int a = face[k], b = face[(k + 1) % 3];
      EXPECT_EQ(other[(corner_of(other, b) + 1) % 3], a);
      EXPECT_EQ(mesh.neighbor(mesh.neighbor(f, k), corner_of(other, b)), f);
      const std::set<int> corners(other.begin(), other.end());
      EXPECT_EQ(corners, (std::set<int>{a, b, mesh.opposite(f, k)}));
    }
}

TEST(Topology, CornerOfAVertexNotInTheFaceIsMinusOne)
{
  EXPECT_EQ(corner_of({4, 7, 9}, 9), 2);
  EXPECT_EQ(corner_of({4, 7, 9}, 5), -1);
}

// edges between a vertex and each other
std::vector<int> edges_from(const Topology &mesh, int vertex)
{
  std::vector<int> edges(mesh.num_vertices(), -1), reached = {vertex};
  edges[vertex] = 0;
  for (size_t i = 0; i < reached.size(); ++i)
    for (int w : mesh.ring(reached[i]))
      if (edges[w] < 0) {
        edges[w] = edges[reached[i]] + 1;
        reached.push_back(w);
      }
  return edges;
}

TEST(Topology, VerticesOfLargeValenceSqueezeRegularFacesAroundThem)
{
  std::vector<std::vector<Face>> meshes = {bipyramid(10), bipyramid(11), bipyramid(13),
                                           Membrane_TEST::flipped(icosphere(2, 1.0), 500, 16, 1).faces};
  for (const auto &coarse : meshes) {
    TriangleMesh shape;
    shape.faces = coarse;
    for (const Face &face : coarse)
      for (int v : face) shape.points.resize(std::max<size_t>(shape.points.size(), v + 1));
    for (int level = 0; level < 3; ++level) shape = loop_refine(shape);
    const Topology mesh(static_cast<int>(shape.points.size()), shape.faces);

    std::set<int> large;
    std::vector<bool> near(mesh.num_faces(), false);
    for (int v = 0; v < mesh.num_vertices(); ++v) {
      const int n = mesh.valence(v);
      if (n <= 10) continue;
      large.insert(n);
      const auto edges = edges_from(mesh, v);
      for (int f = 0; f < mesh.num_faces(); ++f)
        for (int corner : mesh.face(f))
          if (edges[corner] <= n - 10) near[f] = true;
    }
    int squeezed = 0;
    for (int f = 0; f < mesh.num_faces(); ++f) {
      EXPECT_EQ(mesh.is_squeezed(f), mesh.is_regular(f) && near[f]);
      squeezed += mesh.is_squeezed(f);
    }
    EXPECT_EQ(squeezed > 0, !large.empty());
    EXPECT_LT(squeezed, mesh.num_faces());
    if (&coarse == &meshes.back()) {
      EXPECT_GT(large.size(), 1u);
    }
  }
}

// === Components

TEST(Topology, EulerCharacteristicTellsSphereFromTorus)
{
  const std::vector<Face> faces =
      joined(OCTAHEDRON, joined(shifted(regular_torus(5, 4), 6), shifted(TETRAHEDRON, 26)));
  const Topology mesh(30, faces);
  ASSERT_EQ(mesh.num_components(), 3);
  EXPECT_EQ(mesh.component(0), 0);
  EXPECT_EQ(mesh.component(6), 1);
  EXPECT_EQ(mesh.component(25), 1);
  EXPECT_EQ(mesh.component(29), 2);
  EXPECT_EQ(mesh.euler_characteristic(0), 2);
  EXPECT_EQ(mesh.euler_characteristic(1), 0);
  EXPECT_EQ(mesh.euler_characteristic(2), 2);
}

TEST(Topology, AMeshWithoutVerticesIsEmpty)
{
  EXPECT_EQ(Topology().num_vertices(), 0);
  EXPECT_EQ(Topology(0, {}).num_components(), 0);
}

// === Stencils

TEST(Topology, RegularStencilHasTwelvePointsInOrder)
{
  const int nx = 6;
  const Topology mesh(nx * nx, regular_torus(nx, nx));
  int f = 0;
  while (mesh.face(f) != Face{13, 14, 20}) ++f;
  EXPECT_TRUE(mesh.is_regular(f));
  std::vector<int> points;
  mesh.stencil(f, points);
  // around 13 from the vertex across edge 20-13, around 14 from across 13-14, around 20 from
  // across 14-20, each counter-clockwise and without the last
  EXPECT_THAT(points, ElementsAre(13, 14, 20, 19, 12, 6, 7, 8, 15, 21, 27, 26));
}

TEST(Topology, StencilOfATetrahedronIsItsFourVertices)
{
  const Topology mesh(4, TETRAHEDRON);
  std::vector<int> points;
  for (int f = 0; f < 4; ++f) {
    mesh.stencil(f, points);
    ASSERT_EQ(points.size(), 4u);
    EXPECT_EQ(std::set<int>(points.begin(), points.end()).size(), 4u);
    EXPECT_FALSE(mesh.is_regular(f));
  }
}

TEST(Topology, StencilHoldsTheRingsOfAllCorners)
{
  for (int n : {3, 4, 5, 6, 7, 12}) {
    const Topology mesh(n + 2, bipyramid(n));
    std::vector<int> points;
    for (int f = 0; f < mesh.num_faces(); ++f) {
      mesh.stencil(f, points);
      int valences = 0;
      std::set<int> rings(mesh.face(f).begin(), mesh.face(f).end());
      for (int v : mesh.face(f)) {
        valences += mesh.valence(v);
        rings.insert(mesh.ring(v).begin(), mesh.ring(v).end());
      }
      EXPECT_EQ(static_cast<int>(points.size()), valences - 6);
      EXPECT_EQ(std::set<int>(points.begin(), points.end()), rings);
    }
  }
}

// === Meshes that carry no limit surface

TEST(Topology, RejectsACornerOutOfRange)
{
  EXPECT_THAT(error_of(3, TETRAHEDRON),
              AllOf(HasSubstr("face 1 has a corner 3"), HasSubstr("3 control points")));
  EXPECT_THAT(error_of(4, {{0, 1, -2}}), HasSubstr("face 0 has a corner -2"));
}

TEST(Topology, RejectsADegenerateFace)
{
  EXPECT_THAT(error_of(4, {{0, 1, 2}, {3, 2, 3}}),
              AllOf(HasSubstr("face 1 uses vertex 3 twice"), HasSubstr("remove")));
}

TEST(Topology, RejectsAnEdgeOfThreeFaces)
{
  EXPECT_THAT(error_of(5, {{0, 1, 2}, {1, 0, 3}, {1, 0, 4}}),
              AllOf(HasSubstr("edge vertex 0 - vertex 1 belongs to more than two faces"),
                    HasSubstr("face 1, face 2"), HasSubstr("not a manifold")));
}

TEST(Topology, RejectsADuplicateFace)
{
  EXPECT_THAT(error_of(4, joined({{1, 2, 0}}, TETRAHEDRON)),
              HasSubstr("face 0 and face 1 are duplicates; remove one"));
}

TEST(Topology, RejectsAFlippedFace)
{
  std::vector<Face> faces = OCTAHEDRON;
  std::swap(faces[3][0], faces[3][1]);
  const std::string message = error_of(6, faces);
  EXPECT_THAT(message,
              AllOf(HasSubstr("face 3"), HasSubstr("same direction"),
                    HasSubstr("reverse the order of its corners")));
}

TEST(Topology, RejectsABoundary)
{
  std::vector<Face> faces = OCTAHEDRON;
  faces.pop_back();
  EXPECT_THAT(
      error_of(6, faces),
      AllOf(HasSubstr("is a boundary"), HasSubstr("edge vertex"), HasSubstr("close the hole")));
}

TEST(Topology, RejectsTwoFacesBackToBack)
{
  EXPECT_THAT(error_of(3, {{0, 1, 2}, {0, 2, 1}}),
              HasSubstr("face 0 and face 1 share all three corners"));
}

TEST(Topology, RejectsAnUnusedVertex)
{
  EXPECT_THAT(error_of(5, TETRAHEDRON), HasSubstr("vertex 4 is in no face"));
}

TEST(Topology, RejectsSurfacesThatTouchInAPoint)
{
  std::vector<Face> second = shifted(TETRAHEDRON, 3);    // both have vertex 3
  EXPECT_THAT(
      error_of(7, joined(TETRAHEDRON, second)),
      AllOf(HasSubstr("around vertex 3 form more than one fan"), HasSubstr("its own vertex")));
}

TEST(Topology, MessagesUseTheLabelsGiven)
{
  Topology::Labels labels;
  labels.vertex = [](int v) {
    return "control point " + std::to_string(v + 1);
  };
  labels.face = [](int f) {
    return "angle " + std::to_string(f + 1);
  };
  EXPECT_THAT(error_of(5, TETRAHEDRON, labels), HasSubstr("control point 5 is in no face"));
  EXPECT_THAT(error_of(4, {{0, 1, 2}, {3, 2, 3}}, labels),
              HasSubstr("angle 2 uses control point 4 twice"));
}
