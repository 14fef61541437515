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

#include "membrane_srd_approach_list.h"

#include <algorithm>
#include <cmath>

using namespace Membrane_NS;
using Eigen::Vector3d;

// times are sums of steps
static constexpr double ROUNDING = 1.0e-9;

// far above rounding of floats
static constexpr double FLOATS = 1.0e-6;

// of the margin: more after a list that did not last, less after one that had enough to spare; and
// of the horizon
static constexpr double MORE = 1.25, LESS = 0.98, ENOUGH = 0.8;
static constexpr double LONGER = 1.1;

/* ---------------------------------------------------------------------- */

void ApproachList::begin(SurfaceGrid &grid, const std::vector<SurfaceVertex> &vertices,
                         int num_points, double horizon, double step, double room)
{
  if (used_ > margin_) {
    if (margin_ < most_)
      margin_ *= MORE;
    else
      lasts_ = std::max(passed_, step);
  } else if (left_ < step) {
    lasts_ *= LONGER;
    if (used_ < ENOUGH * margin_) margin_ *= LESS;
  }
  margin_ = std::max(std::min(margin_, most_), (1.0 + ROUNDING) * grid.most_moves());
  made_ = true;
  left_ = std::min(horizon, std::max(lasts_, step));
  passed_ = moved_ = bent_ = off_ = used_ = 0.0;
  step_ = step;
  room_ = room;
  find_far(grid);
  grid.measure_layers();
  candidates_.clear();
  made_at_.resize(vertices.size());
  for (size_t v = 0; v < vertices.size(); ++v) made_at_[v] = vertices[v].path.origin;
  for (const Entry &entry : entries_)
    if (entry.point >= 0) entry_of_[entry.point] = -1;
  entry_of_.resize(num_points, -1);
  entries_.clear();
  watched_.clear();
  triangles_.clear();
  travelled_ = 0.0;
  last_at_ = made_at_;
}

void ApproachList::find_far(const SurfaceGrid &grid)
{
  const auto squares = grid.distances(margin_ + room_);
  std::array<float, squares.size()> rounded;
  for (size_t n = 0; n < squares.size(); ++n)
    rounded[n] = static_cast<float>((1.0 - FLOATS) * squares[n]);
  far_.resize(grid.num_cubes() + 1);
  far_[0] = 0.0;
  for (int c = 0; c < grid.num_cubes(); ++c) far_[c + 1] = rounded[grid.away(c)];
}

/* ----------------------------------------------------------------------
   Two loops that compilers turn into vectors leave one point of six, and the layers of cubes one of
   these in four
------------------------------------------------------------------------- */

void ApproachList::offer(const SurfaceGrid &grid, int first, int last, const double *x,
                         const double *velocity, const std::function<bool(int)> &has)
{
  constexpr int BLOCK = SurfaceGrid::BLOCK;
  int cubes[BLOCK], near[BLOCK];
  float flight[BLOCK];
  const double reach = (left_ + step_) * (left_ + step_);
  for (int start = first; start < last; start += BLOCK) {
    const int n = std::min(BLOCK, last - start);
    const double *xs = x + 3 * (size_t) start, *vs = velocity + 3 * (size_t) start;
    grid.find_cubes(xs, n, cubes);
    for (int i = 0; i < n; ++i)
      flight[i] = static_cast<float>(
          reach *
          (vs[3 * i] * vs[3 * i] + vs[3 * i + 1] * vs[3 * i + 1] + vs[3 * i + 2] * vs[3 * i + 2]));
    int num_near = 0;
    for (int i = 0; i < n; ++i) {
      near[num_near] = i;
      num_near += !(flight[i] < far_[cubes[i] + 1]);
    }
    num_near = grid.keep_passing(xs, vs, cubes, left_, margin_, near, num_near);
    for (int j = 0; j < num_near; ++j) {
      const int i = near[j];
      if (has && !has(start + i)) continue;
      __builtin_prefetch(&entry_of_[start + i]);
      candidates_.push_back({{xs[3 * i], xs[3 * i + 1], xs[3 * i + 2]},
                             {vs[3 * i], vs[3 * i + 1], vs[3 * i + 2]},
                             start + i,
                             cubes[i]});
    }
  }
}

/* ----------------------------------------------------------------------
   what is near is looked at cube by cube, so that the triangles of one are at hand for all its
   points
------------------------------------------------------------------------- */

void ApproachList::end(SurfaceGrid &grid)
{
  starts_.assign(grid.num_cubes() + 2, 0);
  for (const Candidate &c : candidates_) ++starts_[c.cube + 2];
  for (size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  sorted_.resize(candidates_.size());
  for (const Candidate &c : candidates_) sorted_[starts_[c.cube + 1]++] = c;
  int loaded = -1;
  for (const Candidate &c : sorted_) {
    const Vector3d x = Vector3d::Map(c.x), v = Vector3d::Map(c.velocity), way = left_ * v;
    const double wide = margin_ + step_ * v.norm() + room_;
    if (c.cube < 0 || !grid.knows_all(wide, way.squaredNorm())) {
      list(grid, c.point, x, v);
      continue;
    }
    if (loaded != c.cube) grid.load(c.cube, batch_);
    loaded = c.cube;
    if (batch_.triangle.empty()) continue;
    const Vector3d end = x + way;
    SurfaceGrid::measure_along(batch_, x.data(), end.data());
    const int first = static_cast<int>(triangles_.size()),
              n = static_cast<int>(batch_.triangle.size());
    triangles_.resize(first + n);
    int *listed = triangles_.data() + first, num_listed = 0, num_near = 0;
    for (int i = 0; i < n; ++i) {
      listed[num_listed] = batch_.triangle[i];
      num_listed += batch_.off[i] <= wide;
      num_near += batch_.off[i] <= margin_;
    }
    triangles_.resize(first + (num_near > 0 ? num_listed : 0));
    if (num_near == 0) continue;
    enter(c.point, x, v, first);
  }
}

void ApproachList::add(SurfaceGrid &grid, int point, const Vector3d &x, const Vector3d &velocity)
{
  int &entry = entry_of_[point];
  if (entry >= 0) {
    entries_[entry].point = -1;
    watched_[entry].clear = INFINITY;
  }
  entry = -1;
  list(grid, point, x, velocity);
}

/* ----------------------------------------------------------------------
   Triangles are found where they are at the start of the step, up to `moved_` from where they were.
   Those that the point may meet on its line, and for the case that it does, those that it may meet
   later in the same step
------------------------------------------------------------------------- */

void ApproachList::list(SurfaceGrid &grid, int point, const Vector3d &x, const Vector3d &velocity)
{
  const double tube = margin_ + moved_;
  const Vector3d end = x + left_ * velocity;
  double nearest;
  const bool inside =
      grid.find_along(x, end, tube + step_ * velocity.norm() + room_, found_, nearest);
  if (inside && nearest > tube) return;
  const int first = static_cast<int>(triangles_.size());
  if (inside) triangles_.insert(triangles_.end(), found_.begin(), found_.end());
  enter(point, x, velocity, first);
}

// with the last triangles, from `first` on

void ApproachList::enter(int point, const Vector3d &x, const Vector3d &velocity, int first)
{
  entry_of_[point] = static_cast<int>(entries_.size());
  const Vector3d origin = x - passed_ * velocity;
  entries_.push_back({{origin[0], origin[1], origin[2]},
                      {velocity[0], velocity[1], velocity[2]},
                      point,
                      first,
                      static_cast<int>(triangles_.size())});
  watched_.push_back({-INFINITY, velocity.norm()});
}

/* ----------------------------------------------------------------------
   If it may not meet a triangle in this step, neither will it until it and they have come as far as
   it now is away from them
------------------------------------------------------------------------- */

bool ApproachList::look(const SurfaceGrid &grid, int e, double duration, double extra)
{
  const Entry &entry = entries_[e];
  Watched &watched = watched_[e];
  const Way way = way_of(entry, duration);
  const double reach = duration * watched.speed + extra;
  double off = INFINITY;
  for (int j = entry.first; j < entry.last; ++j) {
    const double away = grid.off(triangles_[j], way.x);
    if (away <= reach + grid.moves(triangles_[j]) &&
        grid.can_meet(triangles_[j], way.x, way.path, extra))
      return true;
    off = std::min(off, away);
  }
  if (entry.first == entry.last) return true;
  watched.clear = off + passed_ * watched.speed + travelled_;
  return false;
}

void ApproachList::find_around(const SurfaceGrid &grid, const Entry &entry, const Way &way,
                               double room)
{
  const double reach = Vector3d::Map(way.path).norm() + room;
  found_.clear();
  for (int j = entry.first; j < entry.last; ++j)
    if (grid.comes_within(triangles_[j], way.x, reach)) found_.push_back(triangles_[j]);
}

int ApproachList::count() const
{
  int n = 0;
  for (const Entry &entry : entries_) n += entry.point >= 0;
  return n;
}

bool ApproachList::is_valid_for(const SurfaceGrid &grid, const std::vector<SurfaceVertex> &vertices,
                                double duration)
{
  if (!made_ || duration > (1.0 + ROUNDING) * left_) return false;
  double most = 0.0, most_since = 0.0;
  for (size_t v = 0; v < vertices.size(); ++v) {
    const Vector3d &now = vertices[v].path.origin;
    most = std::max(most, (now - made_at_[v]).squaredNorm());
    most_since = std::max(most_since, (now - last_at_[v]).squaredNorm());
    last_at_[v] = now;
  }
  moved_ = std::sqrt(most);
  travelled_ += std::sqrt(most_since);
  used_ = moved_ + grid.most_moves() + off_ + duration * bent_;
  return used_ <= margin_;
}

void ApproachList::pass(double duration)
{
  passed_ += duration;
  left_ -= duration;
  if (left_ <= ROUNDING * duration) left_ = 0.0;
  off_ += duration * bent_;
}

double ApproachList::memory_usage() const
{
  return sizeof(float) * far_.capacity() + 2 * sizeof(Vector3d) * made_at_.capacity() +
      sizeof(Watched) * watched_.capacity() + sizeof(Entry) * entries_.capacity() +
      sizeof(int) * (triangles_.capacity() + entry_of_.capacity() + starts_.capacity()) +
      sizeof(Candidate) * (candidates_.capacity() + sorted_.capacity());
}
