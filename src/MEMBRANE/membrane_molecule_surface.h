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

#ifndef LMP_MEMBRANE_MOLECULE_SURFACE_H
#define LMP_MEMBRANE_MOLECULE_SURFACE_H

#include "membrane_limit_surface.h"
#include "membrane_random.h"

#include <vector>

namespace Membrane_NS {

/// A place on a surface that is parallel to the limit surface.
struct ParallelPlace {
  SurfacePoint point;       ///< its foot on the limit surface
  Eigen::Vector3d x;        ///< foot + height normal
  Eigen::Vector3d normal;   ///< outward, of both surfaces
};

/** The surfaces at all heights above one connected component of a limit surface: r + h n. With the
    principal curvatures k1 and k2 lengths along these directions are 1 + k h times those on the limit
    surface, and areas 1 + 2 H h + K h^2. */
class ParallelSurfaces {
 public:
  /// The surface must outlive this.
  ParallelSurfaces(const LimitSurface &surface, std::vector<int> faces);

  const LimitSurface &surface() const { return surface_; }
  const std::vector<int> &faces() const { return faces_; }

  /// The integral of 1 + 2 H h + K h^2 over a face, by its place in faces(), or over all.
  double area(int face, double height) const
  {
    return area_[face][0] + height * (area_[face][1] + height * area_[face][2]);
  }
  double area(double height) const;

  ParallelPlace lift(const SurfacePoint &point, double height) const;
  /// The place whose foot is the closest point to x, next to `start`; x gives the periodic image.
  ParallelPlace project(const Eigen::Vector3d &x, const SurfacePoint &start, double height) const;

  /// Places uniform in area; the same for the same number, height, label and random numbers.
  std::vector<ParallelPlace> random(int number, double height, const CounterRandom &random, uint32_t label) const;

  /// The smallest radius of curvature, in all directions, of all but a fraction of the area.
  double radius(double fraction) const;
  /// Whether it is a plane; then `normal` is its normal.
  bool is_plane(Eigen::Vector3d &normal) const;
  /// Where surfaces at this height come closest to a cusp: 1 + k h is least, and k there.
  struct Narrowest {
    double stretch, curvature;
    Eigen::Vector3d place;
  };
  Narrowest narrowest(double height) const;

 private:
  struct Sample {    // SAMPLES of a face
    double element, mean, gaussian;
    Eigen::Vector3d position, normal;
  };
  const LimitSurface &surface_;
  std::vector<int> faces_;
  std::vector<std::array<double, 3>> area_;
  std::vector<Sample> samples_;
  int samples_of_face_;
};

}    // namespace Membrane_NS

#endif
