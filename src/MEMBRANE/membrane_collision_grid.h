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

#ifndef LMP_MEMBRANE_COLLISION_GRID_H
#define LMP_MEMBRANE_COLLISION_GRID_H

#include "membrane_collision_events.h"
#include "membrane_triangle_mesh.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace Membrane_NS {

/// What a triangulated surface is, apart from where its vertices are.
struct SurfaceFaces {
  std::vector<Face> faces;
  /// For each corner of a face the box vectors that bring its vertex next to the first corner; none
  /// for a surface in one piece that does not continue through the box.
  std::vector<std::array<std::array<int, 3>, 3>> seams;
};

/** Finds the triangles of a moving surface that a moving point may meet in a step.

    Space is cut into cubes; a cube knows the triangles, in whichever periodic image, that came
    within `pad` of it when the grid was built. A point far from the surface, which is nearly every
    one, costs a look into a table. The grid serves until a vertex has moved by more than `skin`. */
class SurfaceGrid {
 public:
  struct Settings {
    double skin;         ///< vertices may move so far before the grid is built anew
    double bulk_step;    ///< points that do not move further in a step need one look only
    double slack;        ///< vertices may be deflected so far in a step
    double spacing;      ///< of the cubes, at least
    int most_cubes = 1 << 22;
  };
  /// A triangle in a periodic image.
  struct Image {
    int face;
    std::array<int, 3> lattice;
  };

  /// For points between lo and hi. Lattice columns are the box vectors.
  void build(const SurfaceFaces &surface, const std::vector<SurfaceVertex> &vertices,
             const Eigen::Matrix3d &lattice, const std::array<bool, 3> &periodic,
             const Eigen::Vector3d &lo, const Eigen::Vector3d &hi, const Settings &settings);
  bool is_built() const { return !start_.empty(); }
  /// Whether vertices are, at the start and at the end of a step, where the grid can find them.
  bool serves(const std::vector<SurfaceVertex> &vertices, const Eigen::Matrix3d &lattice,
              double duration);

  /// Work out what the triangles do in this step; `slack` up to that of the settings.
  void begin(const SurfaceFaces &surface, const std::vector<SurfaceVertex> &vertices,
             const Eigen::Matrix3d &lattice, double duration, double slack);
  const std::vector<SurfaceTriangle> &triangles() const { return triangles_; }
  const std::vector<Image> &images() const { return images_; }
  /// Furthest that a point can move in a step without a closer look, squared.
  double bulk_step_squared() const { return settings_.bulk_step * settings_.bulk_step; }

  // === Where points are

  static constexpr int OUTSIDE = -1;
  /// The cube of a place, or OUTSIDE.
  int cube(const double *x) const
  {
    int at[3];
    for (int k = 0; k < 3; ++k) {
      const double s = (x[k] - lo_[k]) * inverse_spacing_;
      if (!(s >= 0.0 && s < size_[k])) return OUTSIDE;
      at[k] = static_cast<int>(s);
    }
    return (at[2] * size_[1] + at[1]) * size_[0] + at[0];
  }
  bool is_empty(int cube) const { return !marked_[cube]; }

  /** Triangles that may come within `reach` of x in this step, each once; false if that goes
      beyond the grid. gap: no triangle is nearer than that at the start of the step. */
  bool find(const Eigen::Vector3d &x, double reach, std::vector<int> &found, double &gap);

  double memory_usage() const;

 private:
  struct Plane {               // of a triangle at the start of the step
    Eigen::Vector3d normal, lo, hi;
    double offset, moves;      // moves: how far its corners come
  };
  Settings settings_;
  Eigen::Vector3d lo_;
  double spacing_ = 0.0, inverse_spacing_ = 0.0;
  std::array<int, 3> size_ = {0, 0, 0};
  std::vector<Eigen::Vector3d> built_at_;
  double listed_ = 0.0;    // cubes know all triangles that are nearer than that now
  Eigen::Matrix3d lattice_;
  std::vector<Image> images_;
  std::vector<uint8_t> marked_;
  std::vector<int> start_, list_;

  std::vector<SurfaceTriangle> triangles_;
  std::vector<Plane> planes_;
  std::vector<int> seen_;
  int clock_ = 0;

  void find_images(const SurfaceFaces &surface, const std::vector<SurfaceVertex> &vertices,
                   const Eigen::Matrix3d &lattice, const std::array<bool, 3> &periodic,
                   const Eigen::Vector3d &hi, double pad);
  void fill(double pad);
};

}    // namespace Membrane_NS

#endif
