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

#include "membrane_mesh_writer.h"
#include "membrane_tessellation.h"
#include "scene.h"

#include "gtest/gtest.h"

using namespace Membrane_TEST;

namespace {

TriangleMesh sphere(int level, double radius)
{
  return interpolate(icosphere(level, radius));
}

TriangleMesh flat_sheet()
{
  const Matrix3d lattice = Eigen::Vector3d(6.0, 5.2, 4.0).asDiagonal();
  TriangleMesh mesh = sheet(8, 8, lattice, 0.5);
  mesh.lattice = lattice;
  mesh.periodic = {true, true, true};
  return mesh;
}

TriangleMesh straight_tube()
{
  const Matrix3d lattice = Eigen::Vector3d(8.0, 8.0, 5.0).asDiagonal();
  TriangleMesh mesh = tube(24, 12, 1.0, lattice, 2);
  mesh.lattice = lattice;
  mesh.periodic = {true, true, true};
  return mesh;
}

TessellatedSurface cut(const TriangleMesh &mesh, int n)
{
  return tessellate(topology_of(mesh), mesh, n);
}

double area_of(const TriangleMesh &mesh)
{
  double area = 0.0;
  for (const Face &f : mesh.faces)
    area += 0.5 * mesh.edge(f[0], f[1]).cross(mesh.edge(f[0], f[2])).norm();
  return area;
}

double exact_area(const TriangleMesh &mesh)
{
  return Scene(mesh, Quadrature::CAREFUL).evaluate().area;
}

// the largest difference from H and K as functions of the position

template <class MeanCurvature, class GaussianCurvature>
std::pair<double, double> curvature_error(const TessellatedSurface &surface, MeanCurvature &&H,
                                          GaussianCurvature &&K)
{
  std::pair<double, double> worst = {0.0, 0.0};
  for (size_t p = 0; p < surface.mesh.points.size(); ++p) {
    const Vector3d &r = surface.mesh.points[p];
    worst.first = std::max(worst.first, std::abs(surface.mean_curvature[p] - H(r)));
    worst.second = std::max(worst.second, std::abs(surface.gaussian_curvature[p] - K(r)));
  }
  return worst;
}

double order(double coarse, double fine)
{
  return std::log2(coarse / fine);
}

// === Points

TEST(Tessellation, EveryPointOccursOnce)
{
  const TriangleMesh meshes[] = {sphere(1, 1.0), torus(12, 8, 2.0, 0.7), tetrahedron(),
                                 bipyramid(9), flat_sheet()};
  for (const TriangleMesh &mesh : meshes)
    for (int n : {1, 2, 3, 5}) {
      const Topology topology = topology_of(mesh);
      const TessellatedSurface surface = cut(mesh, n);
      const int points = topology.num_vertices() + topology.num_edges() * (n - 1) +
          topology.num_faces() * (n - 1) * (n - 2) / 2;
      EXPECT_EQ(surface.mesh.points.size(), size_t(points));
      EXPECT_EQ(surface.mesh.faces.size(), size_t(topology.num_faces() * n * n));
      EXPECT_EQ(surface.normals.size(), size_t(points));
      EXPECT_EQ(surface.mean_curvature.size(), size_t(points));
      EXPECT_EQ(surface.gaussian_curvature.size(), size_t(points));
      EXPECT_EQ(surface.face.size(), size_t(points));
    }
}

TEST(Tessellation, IsWatertightAndHasTheTopologyOfTheMesh)
{
  const TriangleMesh two = together(sphere(1, 1.0), torus(12, 8, 2.0, 0.7), {9.0, 0.0, 0.0});
  for (const TriangleMesh &mesh : {two, tetrahedron(), bipyramid(9), flat_sheet(), straight_tube()})
    for (int n : {1, 2, 5}) {
      const Topology coarse = topology_of(mesh);
      const Topology fine = topology_of(cut(mesh, n).mesh);    // throws unless watertight
      ASSERT_EQ(fine.num_components(), coarse.num_components());
      for (int c = 0; c < fine.num_components(); ++c)
        EXPECT_EQ(fine.euler_characteristic(c), coarse.euler_characteristic(c));
    }
}

TEST(Tessellation, PointsOnEdgesAreTheSameFromBothFaces)
{
  const TriangleMesh mesh = perturbed(flipped(icosphere(2, 1.0), 60, 9, 5), 0.02, 6);
  const Topology topology = topology_of(mesh);
  const int n = 4;
  const TessellatedSurface surface = cut(mesh, n);
  FaceTessellation one(n);
  StencilPoints stencil;
  std::vector<LimitPoint> points;
  double worst = 0.0;
  for (int f = 0; f < topology.num_faces(); ++f) {
    stencil_points(topology, mesh, f, stencil);
    one.evaluate(topology.valences(f), stencil, points);
    for (size_t t = 0; t < one.triangles().size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const int p = surface.mesh.faces[f * n * n + t][k];
        const Vector3d here = points[one.triangles()[t][k]].position;
        worst = std::max(worst, (surface.mesh.points[p] - here).norm());
      }
  }
  EXPECT_LT(worst, 1.0e-13);
}

TEST(Tessellation, VerticesComeFirstAndAreAtTheirLimitPositions)
{
  for (const TriangleMesh &mesh : {bipyramid(11), icosphere(2, 1.0), straight_tube()}) {
    const TessellatedSurface surface = cut(mesh, 3);
    const std::vector<Vector3d> limit = limit_positions(mesh);
    for (size_t v = 0; v < limit.size(); ++v)
      EXPECT_LT(mesh.nearest_image(surface.mesh.points[v] - limit[v]).norm(), 1.0e-13);
  }
}

TEST(Tessellation, EveryPointLiesOnTheFaceNamed)
{
  const TriangleMesh mesh = together(icosphere(0, 1.0), icosphere(0, 1.0), {5.0, 0.0, 0.0});
  const Topology topology = topology_of(mesh);
  const TessellatedSurface surface = cut(mesh, 3);
  for (size_t p = 0; p < surface.mesh.points.size(); ++p)
    EXPECT_EQ(topology.component(topology.face(surface.face[p])[0]),
              surface.mesh.points[p][0] > 2.5 ? 1 : 0);
}

TEST(Tessellation, AreaConvergesToThatOfTheLimitSurfaceWithOrderTwo)
{
  for (const TriangleMesh &mesh : {icosphere(1, 1.0), torus(12, 8, 2.0, 0.7), straight_tube()}) {
    const double exact = exact_area(mesh);
    const double coarse = exact - area_of(cut(mesh, 4).mesh);
    const double fine = exact - area_of(cut(mesh, 8).mesh);
    EXPECT_NEAR(order(coarse, fine), 2.0, 0.05);
    EXPECT_LT(std::abs(fine), 2.0e-3 * exact);
  }
}

// === Normals and curvatures

TEST(Tessellation, NormalsPointOutwardAndAgreeWithTheTriangles)
{
  const TessellatedSurface surface = cut(icosphere(2, 1.5), 4);
  for (size_t p = 0; p < surface.normals.size(); ++p) {
    EXPECT_NEAR(surface.normals[p].norm(), 1.0, 1.0e-14);
    EXPECT_GT(surface.normals[p].dot(surface.mesh.points[p].normalized()), 0.9995);
  }
  for (const Face &f : surface.mesh.faces) {
    const Vector3d normal = surface.mesh.edge(f[0], f[1]).cross(surface.mesh.edge(f[0], f[2]));
    for (int v : f) EXPECT_GT(normal.normalized().dot(surface.normals[v]), 0.998);
  }
}

// an icosphere is a little less round at its twelve points of valence 5 and between them: the finer
// it is, the smaller a part of the surface that is

double spread(const std::vector<double> &values, double expected)
{
  double sum = 0.0;
  for (double value : values) sum += (value / expected - 1.0) * (value / expected - 1.0);
  return std::sqrt(sum / values.size());
}

TEST(Tessellation, SphereHasMeanCurvatureOneOverRadius)
{
  double before_H = 0.1, before_K = 0.2;
  for (int level : {2, 3, 4}) {
    const TessellatedSurface surface = cut(icosphere(level, 2.5), 6);
    double R = 0.0;
    for (const Vector3d &p : surface.mesh.points) R += p.norm() / surface.mesh.points.size();
    const double H = spread(surface.mean_curvature, 1.0 / R);
    const double K = spread(surface.gaussian_curvature, 1.0 / (R * R));
    EXPECT_LT(H, 0.75 * before_H);
    EXPECT_LT(K, 0.75 * before_K);
    before_H = H;
    before_K = K;
  }
  EXPECT_LT(before_H, 0.025);
  EXPECT_LT(before_K, 0.05);
}

TEST(Tessellation, TurnedInsideOutTheMeanCurvatureChangesSign)
{
  TriangleMesh mesh = icosphere(2, 1.0);
  const TessellatedSurface before = cut(mesh, 1);
  for (Face &f : mesh.faces) std::swap(f[1], f[2]);
  const TessellatedSurface after = cut(mesh, 1);
  for (size_t v = 0; v < mesh.points.size(); ++v) {
    EXPECT_NEAR(after.mean_curvature[v], -before.mean_curvature[v], 1.0e-12);
    EXPECT_NEAR(after.gaussian_curvature[v], before.gaussian_curvature[v], 1.0e-12);
    EXPECT_LT((after.normals[v] + before.normals[v]).norm(), 1.0e-12);
  }
}

// Gauss and Bonnet: the integral of K is 2 pi (V - E + F)

TEST(Tessellation, GaussianCurvatureAddsUpToTheEulerCharacteristic)
{
  const std::pair<TriangleMesh, int> meshes[] = {{perturbed(icosphere(2, 1.0), 0.01, 4), 2},
                                                 {torus(24, 12, 2.0, 0.8), 0},
                                                 {perturbed(straight_tube(), 0.02, 5), 0}};
  for (const auto &[mesh, characteristic] : meshes) {
    const TessellatedSurface surface = cut(mesh, 12);
    double total = 0.0, most = 0.0;
    for (const Face &f : surface.mesh.faces) {
      const double area =
          0.5 * surface.mesh.edge(f[0], f[1]).cross(surface.mesh.edge(f[0], f[2])).norm();
      for (int v : f) {
        total += area / 3.0 * surface.gaussian_curvature[v];
        most += area / 3.0 * std::abs(surface.gaussian_curvature[v]);
      }
    }
    EXPECT_NEAR(total, 2.0 * PI * characteristic, 3.0e-3 * most);
  }
}

TEST(Tessellation, TorusAndTubeHaveTheirCurvatures)
{
  const double R = 2.0, r = 0.8;
  auto cosine = [&](const Vector3d &p) {
    return (std::hypot(p[0], p[1]) - R) / r;
  };
  auto H = [&](const Vector3d &p) {
    return (R + 2.0 * r * cosine(p)) / (2.0 * r * (R + r * cosine(p)));
  };
  auto K = [&](const Vector3d &p) {
    return cosine(p) / (r * (R + r * cosine(p)));
  };
  const auto coarse = curvature_error(cut(interpolate(torus(40, 20, R, r)), 3), H, K);
  const auto fine = curvature_error(cut(interpolate(torus(80, 40, R, r)), 3), H, K);
  EXPECT_LT(fine.first, 0.01);
  EXPECT_LT(fine.second, 0.01);
  EXPECT_GT(order(coarse.first, fine.first), 1.8);
  EXPECT_GT(order(coarse.second, fine.second), 1.8);

  const auto tube = curvature_error(
      cut(interpolate(straight_tube()), 3),
      [](const Vector3d &) {
        return 0.5;
      },
      [](const Vector3d &) {
        return 0.0;
      });
  EXPECT_LT(tube.first, 0.01);
  EXPECT_LT(tube.second, 0.01);
}

TEST(Tessellation, AnExtraordinaryVertexHasTheMeanOverItsFaces)
{
  const TriangleMesh mesh = perturbed(bipyramid(7), 0.05, 3);
  const Topology topology = topology_of(mesh);
  const TessellatedSurface surface = cut(mesh, 2);
  for (int v = 0; v < topology.num_vertices(); ++v) {
    double mean = 0.0;
    for (int f : topology.faces_around(v)) {
      const Face &face = topology.face(f);
      StencilPoints stencil;
      stencil_points(topology, mesh, f, stencil);
      std::vector<LimitPoint> points;
      FaceTessellation one(1);
      one.evaluate(topology.valences(f), stencil, points);
      const int corner[3] = {one.index(0, 0), one.index(1, 0), one.index(0, 1)};
      mean += points[corner[corner_of(face, v)]].mean_curvature / topology.valence(v);
    }
    EXPECT_NEAR(surface.mean_curvature[v], mean, 1.0e-12);
  }
}

TEST(Tessellation, EveryValenceHasFiniteCurvatures)
{
  for (int n = 3; n <= 16; ++n) {
    const TessellatedSurface surface = cut(bipyramid(n), 4);
    for (size_t p = 0; p < surface.normals.size(); ++p) {
      EXPECT_TRUE(std::isfinite(surface.mean_curvature[p]));
      EXPECT_TRUE(std::isfinite(surface.gaussian_curvature[p]));
      EXPECT_TRUE(surface.normals[p].allFinite());
    }
  }
}

// === Periodic membranes

TEST(Tessellation, APeriodicSheetIsFlatAndCoversItsBox)
{
  const TriangleMesh mesh = flat_sheet();
  const TessellatedSurface surface = cut(mesh, 3);
  for (size_t p = 0; p < surface.normals.size(); ++p) {
    EXPECT_NEAR(surface.mean_curvature[p], 0.0, 1.0e-12);
    EXPECT_NEAR(surface.normals[p][2], 1.0, 1.0e-12);
  }
  EXPECT_NEAR(area_of(surface.mesh), 6.0 * 5.2, 1.0e-12);
}

TEST(Tessellation, CutOpenNothingIsDrawnAcrossTheBox)
{
  for (const TriangleMesh &mesh : {flat_sheet(), straight_tube()}) {
    const TessellatedSurface surface = cut(mesh, 3);
    MeshDrawing drawing = cut_open(surface.mesh);
    drawing.mesh.periodic = {false, false, false};
    EXPECT_NEAR(area_of(drawing.mesh), area_of(surface.mesh), 1.0e-11);
    EXPECT_GT(drawing.mesh.points.size(), surface.mesh.points.size());
    for (const Face &f : drawing.mesh.faces)
      for (int k = 0; k < 3; ++k) EXPECT_LT(drawing.mesh.edge(f[k], f[(k + 1) % 3]).norm(), 0.5);
  }
}

TEST(Tessellation, KnowsWhereAComponentContinuesThroughTheBox)
{
  using Directions = std::vector<std::array<bool, 3>>;
  auto directions = [](const TriangleMesh &mesh) {
    return continuing_directions(topology_of(mesh), mesh);
  };
  const TriangleMesh plane = flat_sheet();
  EXPECT_EQ(directions(plane), (Directions{{true, true, false}}));
  EXPECT_EQ(directions(straight_tube()), (Directions{{false, false, true}}));
  EXPECT_EQ(directions(together(plane, icosphere(1, 0.5), {3.0, 2.0, 3.5})),
            (Directions{{true, true, false}, {false, false, false}}));
  EXPECT_EQ(directions(icosphere(1, 0.5)), (Directions{{false, false, false}}));
}

// === Bad input

TEST(Tessellation, RefusesNumbersOfPartsThatItCannotCut)
{
  for (int n : {-1, 0, FaceTessellation::MOST + 1}) EXPECT_THROW(FaceTessellation{n}, MeshError);
}

}    // namespace
