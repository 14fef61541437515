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

#include "membrane_picture.h"
#include "membrane_tessellation.h"
#include "scene.h"

#include "gtest/gtest.h"

using namespace Membrane_TEST;

namespace {

constexpr int SIZE = 120;

Camera camera_at(double theta, double phi)
{
  Camera camera = camera_from(theta, phi, {0.0, 0.0, 1.0});
  camera.centre.setZero();
  camera.pixel = 3.0 / SIZE;
  camera.width = camera.height = SIZE;
  return camera;
}

struct Picture {
  std::vector<int> covered = std::vector<int>(SIZE * SIZE, 0);
  double worst_depth = 0.0, worst_normal = 0.0;
};

// a unit sphere to within half a percent, cut into triangles

Picture picture_of_sphere(const Camera &camera, int n)
{
  const TriangleMesh mesh = interpolate(icosphere(2, 1.0));
  const TessellatedSurface surface = tessellate(topology_of(mesh), mesh, n);
  Picture picture;
  for (const Face &f : surface.mesh.faces) {
    std::array<Corner, 3> corner;
    for (int k = 0; k < 3; ++k)
      corner[k] = {surface.mesh.points[f[k]], surface.normals[f[k]], Vector3d::Ones()};
    rasterize(camera, corner, [&](const Fragment &fragment) {
      ++picture.covered[fragment.iy * SIZE + fragment.ix];
      const Vector3d outward = fragment.position.normalized();
      picture.worst_depth = std::max(picture.worst_depth, 1.0 - fragment.position.norm());
      const double side = outward.dot(camera.toward);
      if (std::abs(side) > 0.1)
        picture.worst_normal = std::max(
            picture.worst_normal, (fragment.normal - (side > 0.0 ? 1.0 : -1.0) * outward).norm());
    });
  }
  return picture;
}

TEST(Picture, ASphereCoversEveryPixelOfItsDiscAndNoOther)
{
  for (int n : {1, 3, 12})
    for (double theta : {0.0, 1.1, 2.5})
      for (double phi : {0.0, 0.7}) {
        const Camera camera = camera_at(theta, phi);
        const Picture picture = picture_of_sphere(camera, n);
        for (int iy = 0; iy < SIZE; ++iy)
          for (int ix = 0; ix < SIZE; ++ix) {
            const double r = std::hypot(ix - SIZE / 2, iy - SIZE / 2) * camera.pixel;
            if (r < 0.97) {
              ASSERT_GE(picture.covered[iy * SIZE + ix], 2) << "front and back at " << ix << iy;
            }
            if (r > 1.01) { ASSERT_EQ(picture.covered[iy * SIZE + ix], 0); }
          }
      }
}

TEST(Picture, PixelsLieOnTheSurfaceWithItsNormalTowardTheViewer)
{
  const Picture picture = picture_of_sphere(camera_at(1.0, 0.5), 4);
  EXPECT_LT(picture.worst_depth, 6.0e-3);
  EXPECT_LT(picture.worst_normal, 4.0e-2);
}

TEST(Picture, TrianglesThatMeetLeaveNoCrackEvenIfSmallerThanAPixel)
{
  const Camera camera = camera_at(0.0, 0.0);
  for (double size : {0.003, 0.01, 0.024, 0.1}) {
    std::vector<int> covered(SIZE * SIZE, 0);
    auto at = [&](int i, int j) {
      return Corner{(i + 0.37) * size * camera.right + (j + 0.21) * size * camera.up, camera.toward,
                    Vector3d::Ones()};
    };
    const int n = int(1.0 / size);
    for (int i = -n; i < n; ++i)
      for (int j = -n; j < n; ++j)
        for (const auto &triangle :
             {std::array<Corner, 3>{at(i, j), at(i + 1, j), at(i, j + 1)},
              std::array<Corner, 3>{at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)}})
          rasterize(camera, triangle, [&](const Fragment &f) {
            ++covered[f.iy * SIZE + f.ix];
          });
    for (int iy = 30; iy < 90; ++iy)
      for (int ix = 30; ix < 90; ++ix) ASSERT_GE(covered[iy * SIZE + ix], 1) << size;
  }
}

TEST(Picture, WhatIsOutsideOrHasNoNormalIsLeftOut)
{
  const Camera camera = camera_at(1.0, 0.5);
  auto count = [&](const Vector3d &shift, const Vector3d &normal) {
    const std::array<Corner, 3> triangle = {Corner{shift, normal, Vector3d::Ones()},
                                            Corner{shift + camera.up, normal, Vector3d::Ones()},
                                            Corner{shift + camera.right, normal, Vector3d::Ones()}};
    int pixels = 0;
    rasterize(camera, triangle, [&](const Fragment &) {
      ++pixels;
    });
    return pixels;
  };
  const Vector3d none = Vector3d::Zero(), far = 1.0e9 * camera.right;
  EXPECT_NEAR(count(none, camera.toward), 0.5 / (camera.pixel * camera.pixel),
              70.0);    // edges too
  EXPECT_EQ(count(far, camera.toward), 0);
  EXPECT_EQ(count(-far, camera.toward), 0);
  EXPECT_EQ(count(Vector3d::Constant(NAN), camera.toward), 0);
  EXPECT_EQ(count(none, Vector3d::Constant(NAN)), 0);
}

TEST(Picture, TheCameraIsRightHandedFromEverywhere)
{
  for (double theta : {0.0, 1.0e-7, 0.4, 1.5, PI})
    for (double phi : {0.0, 1.0, 4.0}) {
      const Camera camera = camera_at(theta, phi);
      EXPECT_NEAR((camera.right.cross(camera.up) - camera.toward).norm(), 0.0, 1.0e-12);
      EXPECT_NEAR(camera.right.norm(), 1.0, 1.0e-12);
      EXPECT_GE(camera.up[2], 0.0);
    }
}

TEST(Picture, ColorsGoFromBlueOverGrayToRed)
{
  const Vector3d blue = diverging_color(0.0), gray = diverging_color(0.5),
                 red = diverging_color(1.0);
  EXPECT_GT(blue[2], 3.0 * blue[0]);
  EXPECT_GT(red[0], 3.0 * red[2]);
  EXPECT_NEAR(gray.maxCoeff() - gray.minCoeff(), 0.0, 1.0e-12);
  EXPECT_EQ(diverging_color(-5.0), blue);
  EXPECT_EQ(diverging_color(7.0), red);
  EXPECT_EQ(diverging_color(NAN), blue);
  for (double t = 0.0; t < 1.0; t += 0.01)
    EXPECT_LT((diverging_color(t + 0.01) - diverging_color(t)).norm(), 0.05);
  EXPECT_EQ(distinct_color(1), distinct_color(9));
  EXPECT_NE(distinct_color(1), distinct_color(2));
}

}    // namespace
