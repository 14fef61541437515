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

#include "membrane_srd_events.h"
#include "membrane_triangle_mesh.h"

#include <algorithm>
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

/** Finds the triangles of a moving surface that a moving point may meet.

    Space is cut into cubes; a cube knows the triangles, in whichever periodic image, that came
    within `skin` and `reach` of it when the grid was built, or if there are none, how many cubes away
    is one that does. The grid serves until a vertex has moved by more than `skin`. */
class SurfaceGrid {
  static constexpr int MOST_AWAY = 4;    // cubes are counted so far
  // what undeflected vertices do not need of the slack: the rest is far above the tolerance of contacts
  static constexpr double MOST_OF_IT = 0.999;

 public:
  struct Settings {
    double skin;       ///< vertices may move so far before the grid is built anew
    double reach;      ///< so far from a point one look is enough, and further it takes more
    double spacing;    ///< of the cubes, at least
    int most_cubes = 1 << 22;
  };
  /// A triangle in a periodic image.
  struct Image {
    int face;
    std::array<int, 3> lattice;

    bool operator==(const Image &b) const { return face == b.face && lattice == b.lattice; }
  };

  /// For points between lo and hi. Lattice columns are the box vectors.
  void build(const SurfaceFaces &surface, const std::vector<SurfaceVertex> &vertices,
             const Eigen::Matrix3d &lattice, const std::array<bool, 3> &periodic,
             const Eigen::Vector3d &lo, const Eigen::Vector3d &hi, const Settings &settings);
  bool is_built() const { return !start_.empty(); }
  /// As it was built for.
  const Eigen::Matrix3d &lattice() const { return lattice_; }
  /// Whether vertices are, at the start of a step, where the grid can find them.
  bool serves(const std::vector<SurfaceVertex> &vertices, const Eigen::Matrix3d &lattice);

  /// Work out what the triangles do in this step; vertices may be deflected by up to `slack`. rate: at
  /// which the lattice changes.
  void begin(const std::vector<SurfaceVertex> &vertices, double duration, double slack,
             const Eigen::Matrix3d &rate = Eigen::Matrix3d::Zero());
  const std::vector<SurfaceTriangle> &triangles() const { return triangles_; }
  const std::vector<Image> &images() const { return images_; }
  /// How far a corner comes in this step, at most; and one of that triangle.
  double most_moves() const { return most_moves_; }
  double moves(int triangle) const { return planes_[triangle].moves; }

  /// Triangles that may come within `reach` of x in this step, each once; false if that goes
  /// beyond the grid.
  bool find(const Eigen::Vector3d &x, double reach, std::vector<int> &found);
  /// Whether a triangle may.
  bool comes_within(int triangle, const double *x, double reach) const
  {
    return off(triangle, x) <= reach + planes_[triangle].moves;
  }
  /// Triangles that are now within `tube` of the straight line from x to `end`, and maybe others, each
  /// once, and how far away the nearest is, or less; false if that goes beyond the grid.
  bool find_along(const Eigen::Vector3d &x, const Eigen::Vector3d &end, double tube,
                  std::vector<int> &found, double &nearest);
  /// The triangles that a cube knows, in arrays by coordinate: for many points in it, one after the other.
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
  /// Whether a point that moves from x by `path` in this step, both known to within `extra`, can meet a
  /// triangle.
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
  CollisionEvents::Needs needs(int triangle, const double *x, const double *path) const
  {
    if (!can_meet(triangle, x, path)) return CollisionEvents::Needs::TURN;
    return can_meet(triangle, x, path, -MOST_OF_IT * slack_) ? CollisionEvents::Needs::NOTHING
                                                              : CollisionEvents::Needs::DEFLECTION;
  }
  /// How far from a triangle a place is at the start of the step, or less.
  double off(int triangle, const double *x) const
  {
    const Plane &p = planes_[triangle];
    double distance = std::fabs(height(p, x));
    for (int k = 0; k < 3; ++k) distance = std::max({distance, p.lo[k] - x[k], x[k] - p.hi[k]});
    return distance;
  }

  /// Squares of lengths, by how many cubes away the next triangles are.
  using Distances = std::array<double, MOST_AWAY + 1>;
  /// Of what is clear around a place, less `tube`.
  Distances distances(double tube) const;
  /// The cubes of n places, three numbers each; -1 for those beyond the grid.
  void find_cubes(const double *x, int n, int *cubes) const;
  /** Find layers between two planes that hold all triangles known to a cube, where they are now: for
      keep_passing(), which tells from one look what a cube's triangles have in common. */
  void measure_layers();
  static constexpr int BLOCK = 512;
  /// Of the points numbered which[0] to which[n - 1], n <= BLOCK, leaves in front those that may come
  /// within `margin` of a triangle in that time, on straight lines, and returns how many they are. Three
  /// numbers a point; cubes: as from find_cubes().
  int keep_passing(const double *x, const double *velocity, const int *cubes, double time, double margin,
                   int *which, int n) const;

  int num_cubes() const { return size_[0] * size_[1] * size_[2]; }
  int away(int cube) const { return away_[cube]; }

  double memory_usage() const;

 private:
  // of a triangle at the start of the step: its plane and the box around it. All of it is between two
  // planes, at the start `slack_` to either side of that plane, at the end at heights of up and down over it
  struct Plane {
    double normal[3], offset, lo[3], hi[3];
    double moves;    // how far its corners come
    double up, down;
  };
  Settings settings_ = {};
  Eigen::Vector3d lo_;
  double spacing_ = 0.0, inverse_spacing_ = 0.0;
  std::array<int, 3> size_ = {0, 0, 0};
  std::vector<Eigen::Vector3d> built_at_;
  double listed_ = 0.0;        // cubes know all triangles that are nearer than that now
  double most_moves_ = 0.0;    // of all triangles in this step
  double slack_ = 0.0;
  Eigen::Matrix3d lattice_ = Eigen::Matrix3d::Zero();
  std::vector<Image> images_;
  std::vector<uint8_t> away_;    // of a cube: how many cubes to one with triangles or beyond the grid, or more
  std::vector<int> start_, list_;

  // Of the triangles that a cube knows, the nearest to its centre leads it. All corners known to the cubes
  // that a triangle leads lie between two planes with its normal: the layer.
  std::vector<int> lead_;    // by cube, or -1
  struct Corner {
    int vertex;
    std::array<int, 3> lattice;
  };
  std::vector<Corner> corners_;                    // each once: the first are the vertices themselves
  std::vector<std::array<int, 3>> corners_of_;    // of a triangle
  std::vector<int> led_start_, led_;              // corners, by leading triangle
  struct Layer {
    double normal[3], lo, hi;
  };
  // beyond the grid, of a cube without triangles, and then by leading triangle
  enum { OPEN, EMPTY, LED };
  std::vector<Layer> layers_;
  std::vector<Eigen::Vector3d> corner_at_, corner_velocity_;    // in this step
  std::vector<double> corner_speed_;

  std::vector<SurfaceTriangle> triangles_;
  std::vector<Plane> planes_;
  std::vector<int> seen_;
  int clock_ = 0;

  static double height(const Plane &p, const double *x)
  {
    return p.normal[0] * x[0] + p.normal[1] * x[1] + p.normal[2] * x[2] + p.offset;
  }
  void find_images(const SurfaceFaces &surface, const std::vector<SurfaceVertex> &vertices,
                   const Eigen::Matrix3d &lattice, const std::array<bool, 3> &periodic,
                   const Eigen::Vector3d &hi, double pad);
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
  void find_corners(const SurfaceFaces &surface, int num_vertices);
  void find_led();
  double off_line(int triangle, const double *x, const double *end) const;
};

}    // namespace Membrane_NS

#endif
