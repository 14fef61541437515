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

#ifndef LMP_MEMBRANE_SIDE_H
#define LMP_MEMBRANE_SIDE_H

#include "membrane_triangle_mesh.h"

#include <vector>

namespace Membrane_NS {

/** On which side of one connected oriented surface a point is, in a box with periodic images.

    All coordinates are fractional: box vectors have length 1 and are orthogonal, unwrapped. The
    level of a point is the number of times that a ray from it down along `axis` passes through the
    surface against its normal, less the times it does so along its normal, in all periodic images:
    going through the surface in the direction of its normal raises the level by 1. A closed surface
    with outward normals has level 0 outside and -1 inside. A sheet that continues through the box
    sideways has level n + 1 between its images n and n + 1, counted from the sheet itself as image
    0 (the other way round if its normal points down the axis); without images, 0 and 1.

    The axis must be one along which the surface does not continue. A ray through an edge counts
    once: which triangle has it depends on the edge alone, as if the point were moved by a tiny
    amount. */
class SurfaceSide {
 public:
  SurfaceSide() = default;
  /// points: of the whole mesh; faces: of this surface, joining nearest images of their corners.
  SurfaceSide(const std::vector<Eigen::Vector3d> &points, const std::vector<Face> &faces, int axis,
              const std::array<bool, 3> &periodic);

  int level(const Eigen::Vector3d &x) const;
  /// Frees nearly all memory: then only what follows may be asked.
  void forget_triangles()
  {
    std::vector<Triangle>().swap(triangles_);
    std::vector<Entry>().swap(entries_);
    std::vector<int>().swap(start_);
    std::vector<Layer>().swap(layers_);
    std::vector<int>().swap(first_layer_);
  }

  // === Images

  int axis() const { return axis_; }
  /// By how much the level rises from one image to the next along the axis: 0 unless it is a sheet.
  int degree() const { return degree_; }
  /// The level just behind (against the normal) image n of the surface.
  int level_behind(int image) const { return behind_ + degree_ * image; }
  /// +1 if a point of this level is in front of image n, where the normal points, else -1.
  int side(int level, int image) const { return level > level_behind(image) ? 1 : -1; }

 private:
  struct Triangle {
    std::array<int, 3> corner;
    std::array<Eigen::Vector3d, 3> x;
  };
  struct Entry {    // a triangle in a column, moved sideways
    int triangle;
    double shift[2];
  };
  /// The triangles in a column that overlap along the axis: who is not among them passes through
  /// all of them on the way down, or through none.
  struct Layer {
    double lo, width;
    int rise;    // of the level from below to above
  };
  int axis_ = 2, degree_ = 0, behind_ = 0;
  std::array<bool, 3> periodic_ = {false, false, false};
  std::vector<Triangle> triangles_;
  double lo_[2] = {0.0, 0.0}, inverse_width_[2] = {1.0, 1.0};
  int columns_[2] = {0, 0};
  std::vector<int> start_;
  std::vector<Entry> entries_;
  std::vector<int> first_layer_;    // of each column
  std::vector<Layer> layers_;

  void fill_columns();
  void find_layers();
  int column(const Eigen::Vector3d &x, double (&p)[2]) const;
  template <typename Crossing> void cross(const Eigen::Vector3d &x, const Crossing &crossing) const;
  int images_below(double height, double surface) const;
};

}    // namespace Membrane_NS

#endif
