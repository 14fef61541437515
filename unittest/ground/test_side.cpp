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

#include "membrane_mesh_shapes.h"
#include "membrane_side.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace Membrane_NS;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr std::array<bool, 3> PERIODIC = {true, true, true}, OPEN = {false, false, false};

std::vector<Vector3d> scaled(const TriangleMesh &mesh, double by, const Vector3d &shift)
{
  std::vector<Vector3d> points;
  for (const Vector3d &x : mesh.points) points.push_back(by * x + shift);
  return points;
}

}    // namespace

TEST(SurfaceSide, SphereHasAnInsideAndAnOutsideForEveryRay)
{
  const TriangleMesh mesh = icosphere(3, 1.0);
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> uniform(-1.0, 2.0);
  for (int axis = 0; axis < 3; ++axis)
    for (const Vector3d &centre : {Vector3d(0.5, 0.5, 0.5), Vector3d(0.05, 0.9, 1.02)}) {
      const SurfaceSide periodic(scaled(mesh, 0.3, centre), mesh.faces, axis, PERIODIC),
          open(scaled(mesh, 0.3, centre), mesh.faces, axis, OPEN);
      EXPECT_EQ(periodic.degree(), 0);
      EXPECT_EQ(periodic.level_behind(0), -1);
      EXPECT_EQ(open.level_behind(0), -1);
      for (int i = 0; i < 3000; ++i) {
        const Vector3d x(uniform(engine), uniform(engine), uniform(engine));
        Vector3d d = x - centre;
        const double far = d.norm();
        if (far < 0.29 || far > 0.31) {
          EXPECT_EQ(open.level(x), far < 0.3 ? -1 : 0);
        }
        for (int k = 0; k < 3; ++k) d[k] -= std::round(d[k]);
        const double near = d.norm();
        if (near < 0.29 || near > 0.31) {
          EXPECT_EQ(periodic.level(x), near < 0.3 ? -1 : 0);
        }
      }
      EXPECT_EQ(periodic.side(-1, 0), -1);
      EXPECT_EQ(periodic.side(0, 5), 1);
    }
}

TEST(SurfaceSide, RaysThroughVerticesAndEdgesCountOnce)
{
  // straight below and above every vertex, and every middle of an edge that is exact in binary

  TriangleMesh mesh;
  const int n = 8;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      mesh.points.emplace_back(i / 8.0, j / 8.0, 0.5 + 0.03125 * ((i * 3 + j * 5) % 4));
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      auto at = [&](int a, int b) { return a % n * n + b % n; };
      mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  const SurfaceSide side(mesh.points, mesh.faces, 2, PERIODIC);
  EXPECT_EQ(side.degree(), 1);
  for (int i = -16; i < 32; ++i)
    for (int j = -16; j < 32; ++j) {
      EXPECT_EQ(side.level({i / 16.0, j / 16.0, 0.25}), 0);
      EXPECT_EQ(side.level({i / 16.0, j / 16.0, 0.75}), 1);
    }
}

TEST(SurfaceSide, SheetSeparatesItsImages)
{
  const Matrix3d lattice = Vector3d(1.0, 1.0, 1.0).asDiagonal();
  TriangleMesh mesh = sheet(8, 8, lattice, 0.4);
  for (Vector3d &x : mesh.points) x[2] += 0.05 * std::sin(2 * M_PI * x[0]);
  for (bool flipped : {false, true}) {
    if (flipped)
      for (Face &face : mesh.faces) std::swap(face[1], face[2]);
    const SurfaceSide side(mesh.points, mesh.faces, 2, PERIODIC);
    EXPECT_EQ(side.degree(), flipped ? -1 : 1);
    for (int image = -3; image < 4; ++image) {
      const int above = flipped ? -image - 1 : image + 1, below = above - (flipped ? -1 : 1);
      EXPECT_EQ(side.level({0.3, 0.7, image + 0.5}), above);
      EXPECT_EQ(side.level({-1.7, 0.7, image + 0.3}), below);

      // in front of an image is where its normal points

      EXPECT_EQ(side.side(above, image), flipped ? -1 : 1);
      EXPECT_EQ(side.side(below, image), flipped ? 1 : -1);
      EXPECT_EQ(side.side(above, image + 1), flipped ? 1 : -1);
    }
    const SurfaceSide alone(mesh.points, mesh.faces, 2, {true, true, false});
    EXPECT_EQ(alone.level({0.3, 0.7, 5.0}), flipped ? -1 : 1);
    EXPECT_EQ(alone.level({0.3, 0.7, -5.0}), 0);
    EXPECT_EQ(alone.side(alone.level({0.3, 0.7, 5.0}), 0), flipped ? -1 : 1);
  }
}

TEST(SurfaceSide, TubeAlongAnAxisNeedsARayAcross)
{
  const Matrix3d lattice = Matrix3d::Identity();
  for (int along = 0; along < 3; ++along) {
    TriangleMesh mesh = tube(12, 8, 0.3, lattice, along);
    const int axis = (along + 1) % 3;
    const SurfaceSide side(mesh.points, mesh.faces, axis, PERIODIC);
    EXPECT_EQ(side.degree(), 0);
    std::mt19937 engine(3);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int i = 0; i < 2000; ++i) {
      const Vector3d x(uniform(engine), uniform(engine), uniform(engine));
      Vector3d d = x;
      for (int k = 0; k < 3; ++k) d[k] -= std::round(d[k]);
      d[along] = 0.0;
      const double r = d.norm();
      if (r < 0.28 || r > 0.31) {
        EXPECT_EQ(side.level(x), r < 0.3 ? -1 : 0);
      }
    }
  }
}

TEST(SurfaceSide, InsideOutSurfaceHasItsLevelsTheOtherWayRound)
{
  TriangleMesh mesh = icosphere(2, 1.0);
  for (Face &face : mesh.faces) std::swap(face[1], face[2]);
  const SurfaceSide side(scaled(mesh, 0.3, Vector3d(0.5, 0.5, 0.5)), mesh.faces, 2, PERIODIC);
  EXPECT_EQ(side.level({0.5, 0.5, 0.5}), 1);
  EXPECT_EQ(side.level({0.5, 0.5, 0.95}), 0);
  EXPECT_EQ(side.level_behind(0), 0);
  EXPECT_EQ(side.side(1, 0), 1);
}
