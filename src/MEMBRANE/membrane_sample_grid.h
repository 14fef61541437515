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

#ifndef LMP_MEMBRANE_SAMPLE_GRID_H
#define LMP_MEMBRANE_SAMPLE_GRID_H

#include "membrane_limit_surface.h"

#include <array>
#include <vector>

namespace Membrane_NS {

/** Points of the limit surface, nine to a face, in the cells of a grid: where to start looking for the
    closest point. Periodic along the box vectors along which the box is; elsewhere it covers the
    surface, and asks nothing of the place that is looked at. */
class SampleGrid {
 public:
  /// The surface must outlive this.
  explicit SampleGrid(const LimitSurface &surface);
  /// To be called when the surface has moved.
  void update();

  /// A sample near a place.
  struct Near {
    SurfacePoint point;
    Eigen::Vector3d offset;    ///< from the place to the sample, an image near it
    double distance;
  };
  static constexpr int MOST_NEAR = 12;
  using Nearby = std::array<Near, MOST_NEAR>;

  /** The nearest sample to x; then, of other parts of the surface that may have a point closer than the
      nearest sample, the nearest sample of each, nearest first. Samples are of one part if their faces
      share a vertex; but faces at a vertex where the curvature has no bound (valence 3, 7 and more)
      are parts of their own, since there the distance may have a minimum on each of them. Returns
      how many; at most MOST_NEAR are kept. */
  int near(const Eigen::Vector3d &x, Nearby &nearby) const;

  /// No point of the surface is further from a sample.
  double radius() const { return radius_; }
  double memory_usage() const;

 private:
  struct Sample {
    Eigen::Vector3d position;    // in the box
    int face, which;
  };
  const LimitSurface &surface_;
  std::vector<Sample> samples_;    // cell by cell
  std::vector<int> start_;         // [cells + 1]
  Eigen::Matrix3d axes_, to_fraction_;
  Eigen::Vector3d low_;    // fraction 0
  std::array<int, 3> cells_ = {1, 1, 1};
  Eigen::Vector3d width_;    // of a cell, across
  double radius_ = 0.0;
  std::vector<char> steep_;    // [faces] whether the curvature has no bound at some corner

  class Collector;

  void take_samples(std::vector<Sample> &samples);
  void lay_axes(const std::vector<Sample> &samples);
  std::array<int, 3> cell_of(const Eigen::Vector3d &fraction) const;
  size_t index_of(const std::array<int, 3> &cell) const
  {
    return (static_cast<size_t>(cell[2]) * cells_[1] + cell[1]) * cells_[0] + cell[0];
  }
  void visit(const std::array<int, 3> &cell, const Eigen::Vector3d &x, Collector &collector) const;
};

}    // namespace Membrane_NS

#endif
