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

#ifndef LMP_MEMBRANE_SRD_EVENTS_H
#define LMP_MEMBRANE_SRD_EVENTS_H

#include "membrane_srd_collision.h"
#include "membrane_srd_control_weights.h"
#include "membrane_srd_corners.h"
#include "membrane_srd_surface.h"
#include "membrane_srd_walls.h"

#include <cstdint>
#include <queue>
#include <vector>

namespace Membrane_NS {

/// An impulse that the surface received.
struct SurfaceImpulse {
  double time;
  int64_t tag;                     ///< of the point that it came from
  std::array<int, 3> vertex;       ///< of the triangle; -1 for others than those of the events
  std::array<double, 3> weight;    ///< barycentric, of the place where it was hit
  Eigen::Vector3d impulse;
  int control;    ///< the control point that took it, or -1: the three vertices

  bool operator==(const SurfaceImpulse &b) const
  {
    return time == b.time && tag == b.tag && vertex == b.vertex && weight == b.weight &&
        impulse == b.impulse && control == b.control;
  }
};

/** All collisions of one time step between points and a surface, in the order of time.

    Between collisions points and vertices move on straight lines. A collision turns the point and
    the three vertices of the triangle, or the masses that these are means of and all vertices that
    hang on those, and what was foreseen for points near these vertices is foreseen anew: the step
    is the exact motion of the system of point masses with hard contacts, so it keeps energy,
    momentum and angular momentum to rounding, is reversible, and preserves volume in phase space.

    That is the motion without forces, which an integrator lets act at the ends of a step. Half a
    step's kick at either end is as much as a force that acts all the time: its work on the way is
    then right for straight lines, not for those that turn at a time s after the middle of the step
    by some dw, and so end up s dw from where they would have been, had they turned in the middle.
    The energy that costs, -s a.dw of each mass, is what a collision has to give, too, and does if
    velocities in it are those of its time, w + s a.

    Fill with begin(), add_point() and add_pair(), then run(), as often as impulses from outside
    (from points of other ranks) become better known. */
class CollisionEvents {
 public:
  struct Settings {
    bool no_slip = false;
    /** If given, impulses act on the control point of the nearest corner (Eq. 44 of the theory):
        they are normal to the surface whatever no_slip says, and angular momentum is not kept.
        Where the point would not leave the surface, the impulse acts on the surface after all. */
    ControlWeights *control = nullptr;
    /// If given, vertices are the corners of a finer surface and these are its masses; not with
    /// control.
    const SurfaceCorners *corners = nullptr;
    const std::vector<double> *inverse_masses = nullptr;
    double contact = 1.0e-10;    ///< see TriangleCollision
    /// A point that bounces this often in one step is sent back where it came from, and after as
    /// many again left alone.
    int most_bounces = 5000;
  };

  CollisionEvents() = default;
  explicit CollisionEvents(const Settings &settings) : settings_(settings)
  {
    collision_.contact = settings.contact;
  }

  // === Input. Vertices and triangles must outlive the runs.

  /// vertex_slack: how much further than foreseen at the start a vertex may be found in the step.
  /// Points meet these walls, too. middle: when velocities are those of the paths.
  void begin(const std::vector<SurfaceVertex> &vertices,
             const std::vector<SurfaceTriangle> &triangles, double duration, double vertex_slack,
             const BoxWalls &walls = {}, double middle = 0.0);
  /// A point and how far from its start it may be found; returns its index.
  int add_point(const MovingPoint &path, double inverse_mass, int64_t tag, double reach);
  /// By forces on the last point.
  void accelerate_point(const Eigen::Vector3d &a) { points_.back().acceleration = a; }
  /// A triangle that the last point may meet, and the side it is on.
  void add_pair(int triangle, int side, MeetingNeeds needs = MeetingNeeds::NOTHING);

  // === The step

  enum class Outcome {
    DONE,
    POINT_STRAYED,    ///< a point came further than its reach: pairs are missing
    VERTEX_STRAYED    ///< a vertex did
  };
  Outcome run(const std::vector<SurfaceImpulse> &from_outside = {});

  // === Results at the end of the step

  int num_points() const { return static_cast<int>(points_.size()); }
  const MovingPoint &path(int point) const { return points_[point].now; }
  /// Collisions of a point.
  int bounces(int point) const { return points_[point].bounces; }
  /// Points that were left alone because they bounced too often.
  int abandoned() const { return abandoned_; }
  /// What the points added here did to the surface, in the order of time.
  const std::vector<SurfaceImpulse> &impulses() const { return impulses_; }

  /// Changes of masses by all impulses, against straight motion from the start; zero for most.
  const std::vector<SurfaceChange> &changes() const { return changes_; }
  /// The masses with a change.
  const std::vector<int> &touched() const { return touched_; }
  /// Sum over collisions of the impulse normal to the surface, of points on side +1 and -1.
  const std::array<double, 2> &normal_impulse() const { return normal_impulse_; }
  /// Momentum that the surface took.
  const Eigen::Vector3d &impulse() const { return impulse_; }
  /// Momentum that the walls took.
  Eigen::Vector3d wall_impulse() const { return Eigen::Vector3d::Map(walls_.impulse); }

 private:
  struct Point {
    MovingPoint start, now;
    Eigen::Vector3d acceleration;
    double inverse_mass, reach;
    int64_t tag;
    int first_pair, last_pair;
    int bounces, version, touching;    // touching: the pair it hit last
    bool turned;
  };
  struct Pair {
    int point, triangle, side;
    MeetingNeeds needs;
    bool hits;
    TriangleHit hit;
  };
  struct Event {
    double time;
    int64_t tag;
    int point, version;    // point -1: impulse number `version` from outside
    int pair;              // -1 - f: wall f
    bool operator<(const Event &b) const
    {
      return time > b.time || (time == b.time && tag > b.tag);
    }
  };

  Settings settings_;
  TriangleCollision collision_;
  const std::vector<SurfaceVertex> *vertices_ = nullptr;
  const std::vector<SurfaceTriangle> *triangles_ = nullptr;
  double duration_ = 0.0, slack_ = 0.0, middle_ = 0.0;
  std::vector<Point> points_;
  std::vector<Pair> pairs_;
  std::vector<int> vertex_pairs_start_, vertex_pairs_;    // which pairs a vertex is part of
  bool indexed_ = false;

  std::vector<MovingPoint> paths_;    // of vertices, as they are turned
  std::vector<SurfaceChange> changes_;
  std::vector<int> touched_;
  std::vector<char> is_touched_;

  // of the impulse in hand: masses and their shares of it, vertices that it turns
  struct Shares {
    std::vector<int> who;
    std::vector<double> share;    // zero of all others
    std::vector<char> has;
    void resize(size_t n);
    void add(int i, double w);
    void clear();
  };
  Shares masses_, turned_;
  std::vector<Eigen::Vector3d> detour_;    // of vertices of a finer surface, at the end of the step
  std::vector<int> seen_, dirty_;
  int clock_ = 0;
  std::priority_queue<Event> queue_;
  BoxWalls walls_;
  bool have_walls_ = false;
  std::vector<SurfaceImpulse> impulses_;
  std::array<double, 2> normal_impulse_ = {};
  Eigen::Vector3d impulse_ = Eigen::Vector3d::Zero();
  int abandoned_ = 0;

  void index_pairs();
  void reset();
  void foresee(int pair, double now);
  void turn_point(Point &point, double now, const Eigen::Vector3d &change);
  void schedule(int point, double now);
  void collide(const Event &event, Outcome &outcome);
  void hit_wall(const Event &event, Outcome &outcome);
  bool in_reach(const Point &point) const;
  double inverse_mass(int mass) const
  {
    return settings_.corners ? (*settings_.inverse_masses)[mass] : (*vertices_)[mass].inverse_mass;
  }
  void share(const std::array<int, 3> &vertex, const std::array<double, 3> &weight);
  void share(int control);
  Eigen::Vector3d impulse_of(const Pair &pair, const Point &point, double now);
  bool hit_control(const Pair &pair, const Point &point, SurfaceImpulse &done);
  bool turn_vertices(const SurfaceImpulse &impulse);
  void foresee_around(double now);
};

}    // namespace Membrane_NS

#endif
