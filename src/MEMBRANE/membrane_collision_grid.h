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

/** Finds the triangles of a moving surface that a moving point may meet in a step, or how far away
    they are.

    Space is cut into cubes; a cube knows the triangles, in whichever periodic image, that came
    within `skin` and `reach` of it when the grid was built, or if there are none, how many cubes away
    is one that does. The grid serves until a vertex has moved by more than `skin`. */
class SurfaceGrid {
 public:
  struct Settings {
    double skin;       ///< vertices may move so far before the grid is built anew
    double reach;      ///< of a point, so far one look is enough, and further it takes more
    double spacing;    ///< of the cubes, at least
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
  /// Whether vertices are, at the start of a step, where the grid can find them.
  bool serves(const std::vector<SurfaceVertex> &vertices, const Eigen::Matrix3d &lattice);

  /// Work out what the triangles do in this step; vertices may be deflected by up to `slack`. rate: at
  /// which the lattice changes.
  void begin(const SurfaceFaces &surface, const std::vector<SurfaceVertex> &vertices,
             const Eigen::Matrix3d &lattice, double duration, double slack,
             const Eigen::Matrix3d &rate = Eigen::Matrix3d::Zero());
  const std::vector<SurfaceTriangle> &triangles() const { return triangles_; }
  const std::vector<Image> &images() const { return images_; }

  /** Triangles that may come within `reach` of x in this step, each once; false if that goes
      beyond the grid. gap: no triangle is nearer than that at the start of the step; known up to some
      distance, which is less near triangles. */
  bool find(const Eigen::Vector3d &x, double reach, std::vector<int> &found, double &gap);

  double memory_usage() const;

 private:
  // of a triangle at the start of the step: its plane as normal and -offset, and the box around it
  struct Plane {
    Eigen::Array4d plane, lo, hi;    // last of lo and hi: 1
    double moves;                    // how far its corners come
  };
  Settings settings_ = {};
  Eigen::Vector3d lo_;
  double spacing_ = 0.0, inverse_spacing_ = 0.0;
  std::array<int, 3> size_ = {0, 0, 0};
  std::vector<Eigen::Vector3d> built_at_;
  double listed_ = 0.0;        // cubes know all triangles that are nearer than that now
  double most_moves_ = 0.0;    // of all triangles in this step
  Eigen::Matrix3d lattice_;
  std::vector<Image> images_;
  std::vector<uint8_t> away_;    // of a cube: how many cubes to one with triangles, or more
  std::vector<int> start_, list_;

  std::vector<SurfaceTriangle> triangles_;
  std::vector<Plane> planes_;
  std::vector<int> seen_;
  int clock_ = 0;

  void find_images(const SurfaceFaces &surface, const std::vector<SurfaceVertex> &vertices,
                   const Eigen::Matrix3d &lattice, const std::array<bool, 3> &periodic,
                   const Eigen::Vector3d &hi, double pad);
  void fill(double pad);
  void find_distances();
};

}    // namespace Membrane_NS

#endif
