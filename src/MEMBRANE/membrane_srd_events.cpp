/* -----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing author: MEMBRANE developers
------------------------------------------------------------------------- */

#include "membrane_srd_events.h"

#include <algorithm>

using namespace Membrane_NS;
using Eigen::Vector3d;

// barycentric: far more than TriangleCollision::edge_tolerance, and few collisions are so close
static constexpr double AT_EDGE = 1.0e-4;

/* ---------------------------------------------------------------------- */

void CollisionEvents::begin(const std::vector<SurfaceVertex> &vertices,
                            const std::vector<SurfaceTriangle> &triangles, double duration,
                            double vertex_slack, const BoxWalls &walls, double middle)
{
  vertices_ = &vertices;
  triangles_ = &triangles;
  duration_ = duration;
  slack_ = vertex_slack;
  middle_ = middle;
  walls_ = walls;
  have_walls_ = walls.any();
  points_.clear();
  pairs_.clear();
  touched_.clear();
  const size_t num_masses = settings_.corners ? settings_.corners->num_masses() : vertices.size();
  changes_.assign(num_masses, {Vector3d::Zero(), Vector3d::Zero()});
  is_touched_.assign(num_masses, 0);
  masses_.resize(num_masses);
  turned_.resize(vertices.size());
  if (settings_.corners) detour_.assign(vertices.size(), Vector3d::Zero());
  paths_.resize(vertices.size());
  for (size_t v = 0; v < vertices.size(); ++v) paths_[v] = vertices[v].path;
  indexed_ = false;
}

int CollisionEvents::add_point(const MovingPoint &path, double inverse_mass, int64_t tag,
                               double reach)
{
  const int pair = static_cast<int>(pairs_.size());
  points_.push_back(
      {path, path, Vector3d::Zero(), inverse_mass, reach, tag, pair, pair, 0, 0, -1, false});
  return static_cast<int>(points_.size()) - 1;
}

void CollisionEvents::add_pair(int triangle, int side, MeetingNeeds needs)
{
  pairs_.push_back({static_cast<int>(points_.size()) - 1, triangle, side, needs, false, {}});
  ++points_.back().last_pair;
}

void CollisionEvents::index_pairs()
{
  const int n = static_cast<int>(vertices_->size());
  vertex_pairs_start_.assign(n + 1, 0);
  for (const Pair &pair : pairs_)
    for (int v : (*triangles_)[pair.triangle].vertex) ++vertex_pairs_start_[v + 1];
  for (int v = 0; v < n; ++v) vertex_pairs_start_[v + 1] += vertex_pairs_start_[v];
  vertex_pairs_.resize(3 * pairs_.size());
  std::vector<int> next(vertex_pairs_start_.begin(), vertex_pairs_start_.end() - 1);
  for (size_t p = 0; p < pairs_.size(); ++p)
    for (int v : (*triangles_)[pairs_[p].triangle].vertex) vertex_pairs_[next[v]++] = p;
  seen_.assign(pairs_.size() + points_.size(), 0);
  clock_ = 0;
  indexed_ = true;
}

void CollisionEvents::reset()
{
  for (int a : touched_) {
    if (settings_.corners)
      for (const auto &[v, w] : settings_.corners->corners_of(a)) {
        paths_[v] = (*vertices_)[v].path;
        detour_[v].setZero();
      }
    else
      paths_[a] = (*vertices_)[a].path;
    changes_[a] = {Vector3d::Zero(), Vector3d::Zero()};
    is_touched_[a] = 0;
  }
  touched_.clear();
  impulses_.clear();
  normal_impulse_ = {0.0, 0.0};
  impulse_.setZero();
  abandoned_ = 0;
  std::fill_n(walls_.impulse, 3, 0.0);
  queue_ = {};
  for (Point &point : points_) {
    point.now = point.start;
    point.bounces = point.version = 0;
    point.touching = -1;
    point.turned = false;
  }
}

/* ---------------------------------------------------------------------- */

CollisionEvents::Outcome CollisionEvents::run(const std::vector<SurfaceImpulse> &from_outside)
{
  if (!indexed_) index_pairs();
  reset();
  for (size_t i = 0; i < from_outside.size(); ++i)
    queue_.push({from_outside[i].time, from_outside[i].tag, -1, static_cast<int>(i), 0});
  for (int i = 0; i < num_points(); ++i) {
    for (int p = points_[i].first_pair; p < points_[i].last_pair; ++p)
      if (pairs_[p].needs == MeetingNeeds::NOTHING)
        foresee(p, 0.0);
      else
        pairs_[p].hits = false;
    schedule(i, 0.0);
  }

  Outcome outcome = Outcome::DONE;
  while (!queue_.empty() && outcome == Outcome::DONE) {
    const Event event = queue_.top();
    queue_.pop();
    if (event.point < 0) {
      if (!turn_vertices(from_outside[event.version])) outcome = Outcome::VERTEX_STRAYED;
      foresee_around(event.time);
    } else if (event.version == points_[event.point].version) {
      if (event.pair < 0)
        hit_wall(event, outcome);
      else
        collide(event, outcome);
    }
  }
  return outcome;
}

void CollisionEvents::foresee(int p, double now)
{
  Pair &pair = pairs_[p];
  const Point &point = points_[pair.point];
  pair.hits = false;
  if (pair.needs == MeetingNeeds::TURN && !point.turned) return;
  const SurfaceTriangle &triangle = (*triangles_)[pair.triangle];
  std::array<MovingPoint, 3> corners;
  for (int k = 0; k < 3; ++k) {
    corners[k] = paths_[triangle.vertex[k]];
    corners[k].origin += triangle.shift[k];
    corners[k].velocity += triangle.drift[k];
  }
  pair.hits =
      collision_.find(point.now, corners, pair.side, now, duration_, point.touching == p, pair.hit);
}

// the first of what is foreseen for a point counts

void CollisionEvents::schedule(int i, double now)
{
  Point &point = points_[i];
  ++point.version;
  Event first = {duration_, point.tag, i, point.version, 0};
  bool any = false;
  for (int p = point.first_pair; p < point.last_pair; ++p)
    if (pairs_[p].hits && (!any || pairs_[p].hit.time < first.time)) {
      first.time = pairs_[p].hit.time;
      first.pair = p;
      any = true;
    }
  if (have_walls_) {
    int face;
    const Vector3d x = point.now.at(now);
    const double wait =
        walls_.first_hit(x.data(), point.now.velocity.data(), first.time - now, face);
    if (face >= 0) {
      first.time = now + wait;
      first.pair = -1 - face;
      any = true;
    }
  }
  if (any) queue_.push(first);
}

void CollisionEvents::turn_point(Point &point, double now, const Vector3d &change)
{
  point.now.turn(now, change);
  point.turned = true;
}

bool CollisionEvents::in_reach(const Point &point) const
{
  return (point.now.at(duration_) - point.start.origin).norm() <= point.reach;
}

void CollisionEvents::hit_wall(const Event &event, Outcome &outcome)
{
  Point &point = points_[event.point];
  Vector3d v = point.now.velocity;
  walls_.bounce(v.data(), 1.0 / point.inverse_mass, -1 - event.pair);
  turn_point(point, event.time, v - point.now.velocity);
  if (!in_reach(point)) outcome = Outcome::POINT_STRAYED;
  for (int p = point.first_pair; p < point.last_pair; ++p) foresee(p, event.time);
  schedule(event.point, event.time);
}

/* ---------------------------------------------------------------------- */

void CollisionEvents::collide(const Event &event, Outcome &outcome)
{
  const int i = event.point, first = event.pair;
  const double now = event.time;
  Point &point = points_[i];
  const Pair &pair = pairs_[first];
  const SurfaceTriangle &triangle = (*triangles_)[pair.triangle];
  const auto &b = pair.hit.weight;

  double approach = point.now.velocity.dot(pair.hit.normal);
  for (int k = 0; k < 3; ++k)
    approach -=
        b[k] * (paths_[triangle.vertex[k]].velocity + triangle.drift[k]).dot(pair.hit.normal);

  point.touching = first;
  ++point.bounces;
  const bool give_up = point.bounces > 2 * settings_.most_bounces;
  if (give_up) ++abandoned_;

  // a point that grazes approaches by rounding only, if at all

  if (!give_up && pair.side * approach < 0.0) {
    SurfaceImpulse done = {now, point.tag, triangle.vertex, b, Vector3d::Zero(), -1};
    if (!settings_.control || !hit_control(pair, point, done))
      done.impulse = impulse_of(pair, point, now);
    turn_point(point, now, -point.inverse_mass * done.impulse);
    if (!in_reach(point)) outcome = Outcome::POINT_STRAYED;
    impulse_ += done.impulse;
    normal_impulse_[pair.side > 0 ? 0 : 1] -= pair.side * done.impulse.dot(pair.hit.normal);

    impulses_.push_back(done);
    if (!turn_vertices(done)) outcome = Outcome::VERTEX_STRAYED;
    foresee_around(now);
  }
  for (int p = point.first_pair; p < point.last_pair; ++p)
    if (give_up)
      pairs_[p].hits = false;
    else
      foresee(p, now);
  schedule(i, now);
}

/* ----------------------------------------------------------------------
   which masses an impulse acts on, and with which part of it
------------------------------------------------------------------------- */

void CollisionEvents::Shares::resize(size_t n)
{
  who.clear();
  share.assign(n, 0.0);
  has.assign(n, 0);
}

void CollisionEvents::Shares::add(int i, double w)
{
  if (!has[i]) who.push_back(i);
  has[i] = 1;
  share[i] += w;
}

void CollisionEvents::Shares::clear()
{
  for (int i : who) {
    share[i] = 0.0;
    has[i] = 0;
  }
  who.clear();
}

void CollisionEvents::share(const std::array<int, 3> &vertex, const std::array<double, 3> &weight)
{
  masses_.clear();
  for (int k = 0; k < 3; ++k)
    if (vertex[k] < 0)
      continue;
    else if (settings_.corners)
      for (const auto &[a, g] : settings_.corners->masses_of(vertex[k]))
        masses_.add(a, weight[k] * g);
    else
      masses_.add(vertex[k], weight[k]);
}

void CollisionEvents::share(int control)
{
  masses_.clear();
  const ControlWeights::Row &row = settings_.control->row(control);
  for (size_t i = 0; i < row.vertex.size(); ++i) masses_.add(row.vertex[i], row.weight[i]);
}

/* ----------------------------------------------------------------------
   On the surface, with velocities of the time of the collision; where the point would not leave the
   surface for that, as when it grazes, with those of the paths, and also at an edge: to leave one
   triangle is not to leave the other then, and a velocity that is reversed at both would be so for
   ever. Seen backwards in time the choice is the same: it depends on where the collision is and on
   whether both the velocity before and that after point the right way.
------------------------------------------------------------------------- */

Vector3d CollisionEvents::impulse_of(const Pair &pair, const Point &point, double now)
{
  const SurfaceTriangle &triangle = (*triangles_)[pair.triangle];
  const auto &vertex = triangle.vertex;
  const auto &b = pair.hit.weight;
  const Vector3d &normal = pair.hit.normal;
  const bool no_slip = settings_.no_slip || point.bounces > settings_.most_bounces;
  Vector3d relative = point.now.velocity, later = point.acceleration;
  for (int k = 0; k < 3; ++k) {
    relative -= b[k] * (paths_[vertex[k]].velocity + triangle.drift[k]);
    later -= b[k] * (*vertices_)[vertex[k]].acceleration;
  }
  later = relative + (now - middle_) * later;
  share(vertex, b);
  double inverse = point.inverse_mass;
  for (int a : masses_.who) inverse += masses_.share[a] * masses_.share[a] * inverse_mass(a);

  const Vector3d impulse = collision_impulse(later, normal, inverse, no_slip);
  if (point.bounces <= settings_.most_bounces && *std::min_element(b.begin(), b.end()) > AT_EDGE &&
      pair.side * (relative + inverse * impulse).dot(normal) > 0.0)
    return -impulse;
  return -collision_impulse(relative, normal, inverse, no_slip);
}

/* ----------------------------------------------------------------------
   Eq. 44 of the theory: alpha = 2 (v - qdot_i).n / (1/m + (M^-1)_ii) on the nearest control point,
   with qdot_i = sum l_a w_a and (M^-1)_ii = sum l_a^2/d_a. Returns whether that makes the point
   leave the surface.
------------------------------------------------------------------------- */

bool CollisionEvents::hit_control(const Pair &pair, const Point &point, SurfaceImpulse &done)
{
  const auto &b = pair.hit.weight;
  const Vector3d &n = pair.hit.normal;
  const int nearest = done.vertex[std::max_element(b.begin(), b.end()) - b.begin()];
  if (inverse_mass(nearest) == 0.0) return false;
  share(nearest);
  Vector3d velocity = Vector3d::Zero();
  double inverse = point.inverse_mass;
  for (int a : masses_.who) {
    const double l = masses_.share[a];
    velocity += l * paths_[a].velocity;
    inverse += l * l * inverse_mass(a);
  }
  const double alpha = 2.0 * (point.now.velocity - velocity).dot(n) / inverse;

  double after = point.now.velocity.dot(n) - alpha * point.inverse_mass;
  for (int k = 0; k < 3; ++k) {
    const int a = done.vertex[k];
    after -= b[k] * (paths_[a].velocity.dot(n) + alpha * masses_.share[a] * inverse_mass(a));
  }
  if (!(pair.side * after > 0.0)) return false;
  done.impulse = alpha * n;
  done.control = nearest;
  return true;
}

// returns whether vertices stay where points were looked for

bool CollisionEvents::turn_vertices(const SurfaceImpulse &impulse)
{
  if (impulse.control < 0)
    share(impulse.vertex, impulse.weight);
  else
    share(impulse.control);
  turned_.clear();
  const double time = impulse.time, rest = duration_ - time;
  for (int a : masses_.who) {
    const double w = masses_.share[a] * inverse_mass(a);
    if (w == 0.0) continue;
    const Vector3d turn = w * impulse.impulse;
    if (!is_touched_[a]) touched_.push_back(a);
    is_touched_[a] = 1;
    changes_[a].velocity += turn;
    changes_[a].position += rest * turn;
    if (settings_.corners)
      for (const auto &[v, g] : settings_.corners->corners_of(a)) turned_.add(v, g * w);
    else {
      paths_[a].turn(time, turn);
      turned_.add(a, w);
    }
  }
  bool near = true;
  for (int v : turned_.who) {
    if (settings_.corners) {
      const Vector3d turn = turned_.share[v] * impulse.impulse;
      paths_[v].turn(time, turn);
      detour_[v] += rest * turn;
    }
    const Vector3d &detour = settings_.corners ? detour_[v] : changes_[v].position;
    near = near && detour.squaredNorm() <= slack_ * slack_;
  }
  return near;
}

void CollisionEvents::foresee_around(double now)
{
  ++clock_;
  dirty_.clear();
  const size_t num_pairs = pairs_.size();
  for (int v : turned_.who)
    for (int j = vertex_pairs_start_[v]; j < vertex_pairs_start_[v + 1]; ++j) {
      const int p = vertex_pairs_[j], point = pairs_[p].point;
      if (seen_[p] == clock_) continue;
      seen_[p] = clock_;
      if (points_[point].bounces > 2 * settings_.most_bounces) continue;
      foresee(p, now);
      if (seen_[num_pairs + point] == clock_) continue;
      seen_[num_pairs + point] = clock_;
      dirty_.push_back(point);
    }
  for (int point : dirty_) schedule(point, now);
}
