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

#ifndef LMP_MEMBRANE_SRD_SURFACE_GRID_H
#define LMP_MEMBRANE_SRD_SURFACE_GRID_H

#include "membrane_srd_surface_images.h"
#include "membrane_srd_surface_layers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace Membrane_NS {

/** Finds the triangles of a moving surface that a moving point may meet.

    Space is cut into cubes; a cube knows the triangles, in whichever periodic image, that came
    within `skin` and `reach` of it when the grid was built, or if there are none, how many cubes
    away is one that does. The grid is valid until a vertex has moved by more than `skin`. */
class SurfaceGrid : public SurfaceImages {
  static constexpr int MOST_AWAY = 4;    // cubes are counted so far

 public:
  struct Settings {
    double skin;       ///< vertices may move so far before the grid is built anew
    double reach;      ///< so far from a point one look is enough, and further it takes more
    double spacing;    ///< of the cubes, at least
    int most_cubes = 1 << 22;
  };

  /// Cuts the space for points between lo and hi into cubes, to build the grid anew.
  void cut(const Eigen::Vector3d &lo, const Eigen::Vector3d &hi, const Settings &settings);
  /// What the cubes are to know: all triangles that come into the region between these.
  Eigen::Vector3d region_lo() const { return lo_.array() - pad(); }
  Eigen::Vector3d region_hi() const { return end().array() + pad(); }
  /// After cut(). Lattice columns are the box vectors.
  void build(const SurfaceFaces &surface, const std::vector<SurfaceVertex> &vertices,
             const Eigen::Matrix3d &lattice, const std::array<bool, 3> &periodic);
  bool is_built() const { return !start_.empty(); }
  /// Whether vertices are, at the start of a step, where the grid can find them.
  bool is_valid_for(const std::vector<SurfaceVertex> &vertices, const Eigen::Matrix3d &lattice);
  /// See SurfaceImages.
  void begin(const std::vector<SurfaceVertex> &vertices, double duration, double slack,
             const Eigen::Matrix3d &rate = Eigen::Matrix3d::Zero());

  // === One point

  /// Triangles that may come within `reach` of x in this step, each once; false if that goes
  /// beyond the grid.
  bool find(const Eigen::Vector3d &x, double reach, std::vector<int> &found);
  /// Triangles that are now within `tube` of the straight line from x to `end`, and maybe others,
  /// each once, and how far away the nearest is, or less; false if that goes beyond the grid.
  bool find_along(const Eigen::Vector3d &x, const Eigen::Vector3d &end, double tube,
                  std::vector<int> &found, double &nearest);

  // === Many points, cube by cube

  int num_cubes() const { return size_[0] * size_[1] * size_[2]; }
  int away(int cube) const { return away_[cube]; }
  /// Squares of lengths, by how many cubes away the next triangles are.
  using Distances = std::array<double, MOST_AWAY + 1>;
  /// Of what is clear around a place, less `tube`.
  Distances distances(double tube) const;
  /// The cubes of n places, three numbers each; -1 for those beyond the grid.
  void find_cubes(const double *x, int n, int *cubes) const;
  /// See SurfaceLayers: of the triangles where they are now; then points that pass them by are left
  /// out.
  void measure_layers() { layers_.measure(*this); }
  static constexpr int BLOCK = SurfaceLayers::BLOCK;
  int keep_passing(const double *x, const double *velocity, const int *cubes, double time,
                   double margin, int *which, int n) const
  {
    return layers_.keep_passing(x, velocity, cubes, time, margin, listed_, which, n);
  }
  /// The triangles that a cube knows, in arrays by coordinate: for many points in it, one after the
  /// other.
  struct Batch {
    std::vector<int> triangle;
    std::array<std::vector<double>, 3> normal, lo, hi;
    std::vector<double> offset, off;
  };
  /// Whether these are all within `tube` of a line of that squared length that starts in the cube.
  bool knows_all(double tube, double squared_length) const
  {
    const double spare = listed_ - tube;
    return spare > 0.0 && spare * spare > squared_length;
  }
  void load(int cube, Batch &batch) const;
  /// off: how far away from that line each is, or less.
  static void measure_along(Batch &batch, const double *x, const double *end);

  double memory_usage() const;

 private:
  Settings settings_ = {};
  Eigen::Vector3d lo_ = Eigen::Vector3d::Zero();
  double spacing_ = 0.0, inverse_spacing_ = 0.0;
  std::array<int, 3> size_ = {0, 0, 0};
  std::vector<Eigen::Vector3d> built_at_;
  double listed_ = 0.0;    // cubes know all triangles that are nearer than that now
  // of a cube: how many cubes to one with triangles or beyond the grid, or more
  std::vector<uint8_t> away_;
  std::vector<int> start_, list_;
  SurfaceLayers layers_;
  std::vector<int> seen_;
  int clock_ = 0;

  double pad() const { return settings_.skin + settings_.reach; }
  Eigen::Vector3d end() const
  {
    return lo_ + spacing_ * Eigen::Vector3d(size_[0], size_[1], size_[2]);
  }
  void fill(double pad);
  template <class Visit> void visit_cubes(double pad, const Visit &visit);
  // the cubes that a box comes to; false if it leaves the grid
  struct Range {
    std::array<int, 3> from, to;
  };
  bool cubes_of(const Eigen::Vector3d &lo, const Eigen::Vector3d &hi, Range &range) const;
  // the triangles of these cubes that `near` takes, each once
  template <class Near> void collect(const Range &range, std::vector<int> &found, const Near &near);
  // no triangle is nearer to a place, as far as is known without looking at any
  double clear(int away) const { return away == 0 ? 0.0 : listed_ + (away - 1.0) * spacing_; }
  void find_distances();
};

}    // namespace Membrane_NS

#endif
