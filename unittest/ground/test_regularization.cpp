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

#include "membrane_regularization.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>

using Eigen::Vector3d;
using namespace Membrane_NS;

namespace {

// a triangle and the far corners of its three neighbours

struct Patch {
  Vector3d corner[3] = {{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}};
  Vector3d across[3] = {{0.5, -std::sqrt(0.75), 0}, {1.5, std::sqrt(0.75), 0}, {-0.5, std::sqrt(0.75), 0}};
  double uprightness() const
  {
    const double *const p[3] = {corner[0].data(), corner[1].data(), corner[2].data()};
    const double *const q[3] = {across[0].data(), across[1].data(), across[2].data()};
    return face_uprightness(p, q);
  }
  double distortion() const
  {
    return face_distortion(corner[0].data(), corner[1].data(), corner[2].data());
  }
};

}    // namespace

TEST(Regularization, UprightnessIsOneForAnEquilateralTriangleOfAnySizeAndAttitude)
{
  Patch patch;
  EXPECT_NEAR(patch.uprightness(), 1.0, 1e-14);
  const Eigen::Matrix3d turn =
      1e3 * Eigen::AngleAxisd(1.0, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for (auto *points : {patch.corner, patch.across})
    for (int k = 0; k < 3; ++k) points[k] = turn * points[k] + Vector3d(5, -7, 11);
  EXPECT_NEAR(patch.uprightness(), 1.0, 1e-12);
}

TEST(Regularization, UprightnessIsTheInverseOfTheDistortionUntilTheFaceTurnsOver)
{
  Patch patch;
  for (double height : {2.0, 0.5, 0.1, 1e-3}) {
    patch.corner[2][1] = height;
    EXPECT_NEAR(patch.uprightness() * patch.distortion(), 1.0, 1e-12) << height;
  }
  patch.corner[2][1] = 0.0;
  EXPECT_NEAR(patch.uprightness(), 0.0, 1e-14);
  for (double height : {-1e-3, -0.1, -0.5}) {
    patch.corner[2][1] = height;
    EXPECT_NEAR(patch.uprightness() * patch.distortion(), -1.0, 1e-12) << height;
  }
}

TEST(Regularization, AFaceIsUprightOnASharpRidgeButNotWhenFoldedUponItsNeighbours)
{
  Patch patch;
  for (int k = 0; k < 3; ++k) patch.across[k] += Vector3d(0, 0, -0.8);
  EXPECT_GT(patch.uprightness(), 0.99);
  const Vector3d centre = (patch.corner[0] + patch.corner[1] + patch.corner[2]) / 3.0;
  for (int k = 0; k < 3; ++k) {
    const Vector3d middle = 0.5 * (patch.corner[k] + patch.corner[(k + 1) % 3]);
    patch.across[k] = middle + 1.5 * (centre - middle);    // flaps folded over the face
  }
  EXPECT_LT(patch.uprightness(), -0.99);
}
