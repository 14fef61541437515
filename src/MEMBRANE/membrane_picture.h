/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

#ifndef LMP_MEMBRANE_PICTURE_H
#define LMP_MEMBRANE_PICTURE_H

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>

namespace Membrane_NS {

// === Colors: red, green, blue from 0 to 1

/// Blue over white to red as t goes from 0 to 1; t beyond these is cut off.
Eigen::Vector3d diverging_color(double t);
/// Eight colors that differ well from one another, over and over again.
Eigen::Vector3d distinct_color(int i);

// === Camera

/// Parallel projection onto a grid of pixels. (0, 0) is the lower left pixel.
struct Camera {
  Eigen::Vector3d right, up;    ///< of length 1, in the picture
  Eigen::Vector3d toward;       ///< of length 1, from the scene to the viewer
  Eigen::Vector3d centre;       ///< is seen at the centre of pixel (width/2, height/2)
  double pixel;                 ///< side of a pixel, in the unit of the scene
  int width, height;
};

/** View along -(sin theta cos phi, sin theta sin phi, cos theta) with `up` upward in the picture;
    angles in radians. The view is turned by 1e-6 if it goes along `up`. centre, pixel, width and
    height are left for the caller to fill in. */
Camera camera_from(double theta, double phi, const Eigen::Vector3d &up);

// === Triangles

struct Corner {
  Eigen::Vector3d position, normal, color;
};

/// What is seen of a triangle at one pixel.
struct Fragment {
  int ix, iy;
  Eigen::Vector3d position;    ///< where the ray through the centre of the pixel hits the triangle
  Eigen::Vector3d normal;      ///< of length 1, toward the viewer: a surface has two sides
  Eigen::Vector3d color;
};

/** Call draw(const Fragment &) for each pixel whose centre the triangle covers; normal and color
    vary linearly over it. Pixels on an edge are drawn for both neighbours, so that there are no
    cracks between triangles that share corners. What has no normal is left out. */
template <class Draw>
void rasterize(const Camera &camera, const std::array<Corner, 3> &corner, Draw &&draw)
{
  static constexpr double EDGE = 1.0e-9;     // of the triangle, against rounding
  static constexpr double GRAZING = 0.05;    // a normal is never farther from the viewer

  double x[3], y[3];
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d d = (corner[k].position - camera.centre) / camera.pixel;
    x[k] = camera.right.dot(d) + camera.width / 2;
    y[k] = camera.up.dot(d) + camera.height / 2;
  }
  const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  if (!std::isfinite(area) || std::abs(area) < 1.0e-9) return;

  const auto [xlo, xhi] = std::minmax({x[0], x[1], x[2]});
  const auto [ylo, yhi] = std::minmax({y[0], y[1], y[2]});
  if (xhi < 0.0 || yhi < 0.0 || xlo > camera.width || ylo > camera.height) return;
  const int ix_lo = int(std::ceil(std::max(xlo - EDGE, 0.0)));
  const int ix_hi = int(std::floor(std::min(xhi + EDGE, camera.width - 1.0)));
  const int iy_lo = int(std::ceil(std::max(ylo - EDGE, 0.0)));
  const int iy_hi = int(std::floor(std::min(yhi + EDGE, camera.height - 1.0)));

  for (int iy = iy_lo; iy <= iy_hi; ++iy)
    for (int ix = ix_lo; ix <= ix_hi; ++ix) {
      const double w1 = ((ix - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (iy - y[0])) / area;
      const double w2 = ((x[1] - x[0]) * (iy - y[0]) - (ix - x[0]) * (y[1] - y[0])) / area;
      const double w0 = 1.0 - w1 - w2;
      if (w0 < -EDGE || w1 < -EDGE || w2 < -EDGE) continue;

      Fragment fragment;
      fragment.ix = ix;
      fragment.iy = iy;
      auto mix = [&](Eigen::Vector3d Corner::*what) -> Eigen::Vector3d {
        return w0 * corner[0].*what + w1 * corner[1].*what + w2 * corner[2].*what;
      };
      fragment.position = mix(&Corner::position);
      fragment.color = mix(&Corner::color);
      Eigen::Vector3d normal = mix(&Corner::normal).normalized();
      if (!normal.allFinite()) continue;
      if (area < 0.0) normal = -normal;
      const double facing = normal.dot(camera.toward);
      if (facing < GRAZING) normal = (normal + (GRAZING - facing) * camera.toward).normalized();
      fragment.normal = normal;
      draw(fragment);
    }
}

}    // namespace Membrane_NS

#endif
