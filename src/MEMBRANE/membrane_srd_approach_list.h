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

#ifndef LMP_MEMBRANE_SRD_APPROACH_LIST_H
#define LMP_MEMBRANE_SRD_APPROACH_LIST_H

#include "membrane_srd_surface_grid.h"

#include <functional>
#include <vector>

namespace Membrane_NS {

/** Which points come near a moving surface in the time ahead, and near which triangles: made for
    all points once, it leaves few to be looked at in each step.

    Points are taken to fly straight for the horizon, and those are listed whose line comes within a
    margin of a triangle where it is now. So for all that is not listed to miss the surface,
    vertices may come up to the margin away from here, and lines of points may bend, both together:
    the list is valid as long as they have not.

    A point that is turned has to be given to add() again; points are numbered from 0. The margin
    adapts itself so that nearly all lists last for their horizon; if it would have to be larger
    than the most, the horizon becomes shorter. */
class ApproachList {
 public:
  ApproachList() = default;
  /// margin: to begin with, and at most unless one step takes more.
  ApproachList(double margin, double most) : margin_(margin), most_(most) {}
  /// The list is not valid any more.
  void clear() { made_ = false; }
  /** A new, empty list, for the step that the grid has begun; vertices at the start of it. horizon:
      how long lines stay straight, of which the list may take less. Steps are up to `step` long,
      and in one a point comes at most by `room` further than its velocity takes it. */
  void begin(SurfaceGrid &grid, const std::vector<SurfaceVertex> &vertices, int num_points,
             double horizon, double step, double room);
  /** Call for all points, here those from first to last - 1; if `has` is given, those for which it
      is true. x, velocity: of all points, three numbers each. Most are far away, and most others
      fly past: that takes one look at the grid for each. */
  void offer(const SurfaceGrid &grid, int first, int last, const double *x, const double *velocity,
             const std::function<bool(int)> &has);
  /// All have been offered.
  void end(SurfaceGrid &grid);
  /** List a point, which is at x now, for the rest of the horizon, in place of what was known of
      it. The grid must be at the step in hand: that of begin(), or the last that is_valid_for() was
      asked for. */
  void add(SurfaceGrid &grid, int point, const Eigen::Vector3d &x, const Eigen::Vector3d &velocity);

  /// Whether it is valid for the step that the grid has begun.
  bool is_valid_for(const SurfaceGrid &grid, const std::vector<SurfaceVertex> &vertices,
                    double duration);
  /// The step is over.
  void pass(double duration);
  /// Velocities of points have changed by up to this.
  void bend(double change) { bent_ += change; }

  /** For all that may meet a triangle in the step that the grid has begun: take(point, triangles)
      with those within the length of its way and `slack`, or with null if the grid has to find
      them. Some time before that, fetch(point). */
  template <class Fetch, class Take>
  void for_each_meeting(const SurfaceGrid &grid, double duration, double slack, const Fetch &fetch,
                        const Take &take)
  {
    const double extra = off_ + duration * bent_;
    const double time = passed_ + duration, moves = travelled_ + grid.most_moves() + extra;
    const int n = static_cast<int>(watched_.size());
    meeting_.resize(n);
    int num_watched = 0;
    for (int e = 0; e < n; ++e) {
      meeting_[num_watched] = e;
      num_watched += !(watched_[e].clear > time * watched_[e].speed + moves);
    }
    int num_meeting = 0;
    for (int i = 0; i < num_watched; ++i) {
      const int e = meeting_[i];
      if (entries_[e].point >= 0 && look(grid, e, duration, extra)) meeting_[num_meeting++] = e;
    }
    constexpr int AHEAD = 8;
    for (int i = 0; i < num_meeting + AHEAD; ++i) {
      if (i < num_meeting) fetch(entries_[meeting_[i]].point);
      if (i < AHEAD) continue;
      const Entry &entry = entries_[meeting_[i - AHEAD]];
      const bool known = entry.first < entry.last && duration <= step_ && slack + extra <= room_;
      if (known) find_around(grid, entry, way_of(entry, duration), slack + 2.0 * extra);
      take(entry.point, known ? &found_ : nullptr);
    }
  }
  /// Points that are listed.
  int count() const;
  /// The rest of the horizon.
  double left() const { return left_; }
  double memory_usage() const;

 private:
  bool made_ = false;
  double left_ = 0.0, passed_ = 0.0, margin_ = 0.0, most_ = INFINITY;
  double lasts_ = INFINITY;          // a list, likely
  double used_ = 0.0;                // of the margin, so far
  double moved_ = 0.0;               // vertices at the start of the step, at most
  double bent_ = 0.0, off_ = 0.0;    // velocities of points, and points from their lines, at most
  std::vector<Eigen::Vector3d> made_at_;
  struct Entry {
    double origin[3], velocity[3];    // of its line, when the list was made
    int point;                        // or -1: not valid any more
    int first, last;    // of triangles_; none: its line leaves the grid, any triangle may be near
  };
  std::vector<Entry> entries_;
  struct Watched {
    double clear;    // of its triangles, plus what it and they had come when that was so
    double speed;
  };
  std::vector<Watched> watched_;    // of each entry
  double travelled_ = 0.0;          // by vertices from step to step, sum of the most of each
  std::vector<Eigen::Vector3d> last_at_;
  std::vector<int> triangles_, found_, meeting_;
  double step_ = 0.0, room_ = 0.0;
  // squared, from a cube: flights that are shorter meet nothing; 0 from beyond the grid
  std::vector<float> far_;
  struct Candidate {
    double x[3], velocity[3];
    int point, cube;
  };
  std::vector<Candidate> candidates_, sorted_;
  std::vector<int> starts_;    // of cubes in the latter
  SurfaceGrid::Batch batch_;
  std::vector<int> entry_of_;    // of a point, or -1

  void find_far(const SurfaceGrid &grid);
  void list(SurfaceGrid &grid, int point, const Eigen::Vector3d &x,
            const Eigen::Vector3d &velocity);
  void enter(int point, const Eigen::Vector3d &x, const Eigen::Vector3d &velocity, int first);
  struct Way {
    double x[3], path[3];
  };
  Way way_of(const Entry &entry, double duration) const
  {
    Way way;
    for (int k = 0; k < 3; ++k) {
      way.x[k] = entry.origin[k] + passed_ * entry.velocity[k];
      way.path[k] = duration * entry.velocity[k];
    }
    return way;
  }
  bool look(const SurfaceGrid &grid, int entry, double duration, double extra);
  void find_around(const SurfaceGrid &grid, const Entry &entry, const Way &way, double room);
};

}    // namespace Membrane_NS

#endif
