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

#include "membrane_picture.h"

#include <array>

using namespace Membrane_NS;
using Eigen::Vector3d;

/* ----------------------------------------------------------------------
   "cool to warm": even steps of it look evenly far apart, and it is nowhere so dark that shading
   could not be told from color [K. Moreland, Diverging Color Maps for Scientific Visualization,
   ISVC 2009]
------------------------------------------------------------------------- */

static constexpr int STEPS = 16;
static constexpr double COOL_TO_WARM[STEPS + 1][3] = {
    {0.230, 0.299, 0.754}, {0.304, 0.407, 0.845}, {0.383, 0.510, 0.918}, {0.467, 0.605, 0.968},
    {0.553, 0.689, 0.995}, {0.639, 0.760, 0.998}, {0.722, 0.814, 0.977}, {0.799, 0.850, 0.932},
    {0.865, 0.865, 0.865}, {0.924, 0.827, 0.775}, {0.959, 0.770, 0.678}, {0.970, 0.694, 0.580},
    {0.958, 0.603, 0.482}, {0.924, 0.497, 0.388}, {0.870, 0.379, 0.300}, {0.796, 0.241, 0.220},
    {0.706, 0.016, 0.150}};

Vector3d Membrane_NS::diverging_color(double t)
{
  const double s = t > 0.0 ? STEPS * std::min(t, 1.0) : 0.0;    // 0 if t is not a number
  const int i = std::min(static_cast<int>(s), STEPS - 1);
  const Vector3d lo(COOL_TO_WARM[i]), hi(COOL_TO_WARM[i + 1]);
  return lo + (s - i) * (hi - lo);
}

// told apart by the color blind as well [M. Okabe and K. Ito, Color Universal Design, 2008]

static constexpr int DISTINCT = 8;
static constexpr double OKABE_ITO[DISTINCT][3] = {
    {0.34, 0.71, 0.91}, {0.90, 0.62, 0.00}, {0.00, 0.62, 0.45}, {0.80, 0.47, 0.65},
    {0.94, 0.89, 0.26}, {0.00, 0.45, 0.70}, {0.84, 0.37, 0.00}, {0.70, 0.70, 0.70}};

Vector3d Membrane_NS::distinct_color(int i)
{
  return Vector3d(OKABE_ITO[i % DISTINCT]);
}

/* ---------------------------------------------------------------------- */

Camera Membrane_NS::camera_from(double theta, double phi, const Vector3d &up)
{
  static constexpr double NUDGE = 1.0e-6;
  static constexpr double PI = 3.14159265358979323846;
  auto direction = [&](double angle) {
    return Vector3d(std::sin(angle) * std::cos(phi), std::sin(angle) * std::sin(phi),
                    std::cos(angle));
  };
  Camera camera;
  const Vector3d above = up.normalized();
  camera.toward = direction(theta);
  if (std::abs(above.dot(camera.toward)) > 1.0 - NUDGE)
    camera.toward = direction(theta == PI ? theta - NUDGE : theta + NUDGE);
  camera.right = above.cross(camera.toward).normalized();
  camera.up = camera.toward.cross(camera.right).normalized();
  return camera;
}
