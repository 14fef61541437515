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

#ifndef LMP_MEMBRANE_SRD_SURFACE_IMAGES_H
#define LMP_MEMBRANE_SRD_SURFACE_IMAGES_H

#include "membrane_srd_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace Membrane_NS {

/** The triangles of a moving surface in all their periodic images that come near a region of space,
    what they do in a step, and which points may meet one of them. */
class SurfaceImages {
  // what undeflected vertices do not need of the slack: the rest is far above the tolerance of
  // contacts
  static constexpr double MOST_OF_IT = 0.999;

 public:
  /// A triangle in a periodic image.
  struct Image {
    int face;
    std::array<int, 3> lattice;

    bool operator==(const Image &b) const { return face == b.face && lattice == b.lattice; }
  };

  /// Those that come within `pad` of the region between lo and hi. Lattice columns are the box
  /// vectors.
  void find_images(const SurfaceFaces &surface, const std::vector<SurfaceVertex> &vertices,
                   const Eigen::Matrix3d &lattice, const std::array<bool, 3> &periodic,
                   const Eigen::Vector3d &lo, const Eigen::Vector3d &hi, double pad);
  const std::vector<Image> &images() const { return images_; }
  /// As they were found for.
  const Eigen::Matrix3d &lattice() const { return lattice_; }

  // === A step

  /// Work out what the triangles do in this step; vertices may be deflected by up to `slack`. rate:
  /// at which the lattice changes.
  void begin(const std::vector<SurfaceVertex> &vertices, double duration, double slack,
             const Eigen::Matrix3d &rate = Eigen::Matrix3d::Zero());
  const std::vector<SurfaceTriangle> &triangles() const { return triangles_; }
  /// How far a corner comes in this step, at most; and one of that triangle.
  double most_moves() const { return most_moves_; }
  double moves(int triangle) const { return planes_[triangle].moves; }

  // === A point and a triangle

  /// How far from a triangle a place is at the start of the step, or less.
  double off(int triangle, const double *x) const
  {
    const Plane &p = planes_[triangle];
    double distance = std::fabs(height(p, x));
    for (int k = 0; k < 3; ++k) distance = std::max({distance, p.lo[k] - x[k], x[k] - p.hi[k]});
    return distance;
  }
  /// Whether it may come within `reach` of x in this step.
  bool comes_within(int triangle, const double *x, double reach) const
  {
    return off(triangle, x) <= reach + planes_[triangle].moves;
  }
  /// How far from a triangle the straight line from x to `end` is at the start of the step, or
  /// less: it is at least as far from it as from its plane, and as from the box around it along
  /// each axis.
  double off_line(int triangle, const double *x, const double *end) const
  {
    const Plane &p = planes_[triangle];
    const double a = height(p, x), b = height(p, end);
    double off = std::max(std::min(a, b), -std::max(a, b));
    for (int k = 0; k < 3; ++k)
      off = std::max({off, p.lo[k] - std::max(x[k], end[k]), std::min(x[k], end[k]) - p.hi[k]});
    return off;
  }
  /// Whether a point that moves from x by `path` in this step, both known to within `extra`, can
  /// meet a triangle.
  bool can_meet(int triangle, const double *x, const double *path, double extra = 0.0) const
  {
    const Plane &p = planes_[triangle];
    const double first = height(p, x);
    const double last =
        first + p.normal[0] * path[0] + p.normal[1] * path[1] + p.normal[2] * path[2];
    if ((first > slack_ + extra && last > p.up + extra) ||
        (first < -slack_ - extra && last < p.down - extra))
      return false;
    const double room = p.moves + extra;
    bool meets = true;
    for (int k = 0; k < 3; ++k)
      meets = meets && std::max(x[k], x[k] + path[k]) >= p.lo[k] - room &&
          std::min(x[k], x[k] + path[k]) <= p.hi[k] + room;
    return meets;
  }
  /// What it takes for a point that moves from x by `path` in this step to meet a triangle.
  MeetingNeeds needs(int triangle, const double *x, const double *path) const
  {
    if (!can_meet(triangle, x, path)) return MeetingNeeds::TURN;
    return can_meet(triangle, x, path, -MOST_OF_IT * slack_) ? MeetingNeeds::NOTHING
                                                             : MeetingNeeds::DEFLECTION;
  }

  // === Corners of the images: the first are the vertices themselves, then come images of some

  int num_corners() const { return static_cast<int>(corners_.size()); }
  const std::array<int, 3> &corners_of(int triangle) const { return corners_of_[triangle]; }
  /// At the start of the step.
  const Eigen::Vector3d &corner_at(int corner) const { return corner_at_[corner]; }

  // === Planes

  /// Of a triangle at the start of the step: its plane and the box around it. All of it is between
  /// two planes, at the start the slack to either side of that plane, at the end at heights of up
  /// and down over it.
  struct Plane {
    double normal[3], offset, lo[3], hi[3];
    double moves;    // how far its corners come
    double up, down;
  };
  const Plane &plane(int triangle) const { return planes_[triangle]; }

  double memory_usage() const;

 private:
  Eigen::Matrix3d lattice_ = Eigen::Matrix3d::Zero();
  std::vector<Image> images_;
  struct Corner {
    int vertex;
    std::array<int, 3> lattice;
  };
  std::vector<Corner> corners_;                                 // each once
  std::vector<std::array<int, 3>> corners_of_;                  // of a triangle
  std::vector<Eigen::Vector3d> corner_at_, corner_velocity_;    // in this step
  std::vector<double> corner_speed_;
  std::vector<SurfaceTriangle> triangles_;
  std::vector<Plane> planes_;
  double most_moves_ = 0.0;    // of all triangles in this step
  double slack_ = 0.0;

  static double height(const Plane &p, const double *x)
  {
    return p.normal[0] * x[0] + p.normal[1] * x[1] + p.normal[2] * x[2] + p.offset;
  }
  void list_images(const SurfaceFaces &surface, const std::vector<SurfaceVertex> &vertices,
                   const std::array<bool, 3> &periodic, const Eigen::Vector3d &lo,
                   const Eigen::Vector3d &hi, double pad);
  void list_corners(const SurfaceFaces &surface, int num_vertices);
};

}    // namespace Membrane_NS

#endif
