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

#include "membrane_approach_list.h"

#include <algorithm>
#include <cmath>

using namespace Membrane_NS;
using Eigen::Vector3d;

// times are sums of steps
static constexpr double ROUNDING = 1.0e-9;

// of the margin: more after a list that did not last, less after one that had enough to spare; and of
// the horizon
static constexpr double MORE = 1.25, LESS = 0.98, ENOUGH = 0.8;
static constexpr double LONGER = 1.1;

/* ---------------------------------------------------------------------- */

void ApproachList::begin(const SurfaceGrid &grid, const std::vector<SurfaceVertex> &vertices,
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
  far_ = grid.distances(margin_ + room_);
  candidates_.clear();
  made_at_.resize(vertices.size());
  for (size_t v = 0; v < vertices.size(); ++v) made_at_[v] = vertices[v].path.origin;
  entries_.clear();
  triangles_.clear();
  entry_of_.assign(num_points, -1);
}

/* ----------------------------------------------------------------------
   what is near is looked at cube by cube, so that the triangles of one are at hand for all its points
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
    const int n = static_cast<int>(batch_.triangle.size());
    const double nearest = *std::min_element(batch_.off.begin(), batch_.off.begin() + n);
    if (nearest > margin_) continue;
    const int first = static_cast<int>(triangles_.size());
    for (int i = 0; i < n; ++i)
      if (batch_.off[i] <= wide) triangles_.push_back(batch_.triangle[i]);
    enter(c.point, x, v, first);
  }
}

void ApproachList::add(SurfaceGrid &grid, int point, const Vector3d &x, const Vector3d &velocity)
{
  int &entry = entry_of_[point];
  if (entry >= 0) entries_[entry].point = -1;
  entry = -1;
  list(grid, point, x, velocity);
}

/* ----------------------------------------------------------------------
   Triangles are found where they are at the start of the step, up to `moved_` from where they were. Those
   that the point may meet on its line, and for the case that it does, those that it may meet later in
   the same step
------------------------------------------------------------------------- */

void ApproachList::list(SurfaceGrid &grid, int point, const Vector3d &x, const Vector3d &velocity)
{
  const double tube = margin_ + moved_;
  const Vector3d end = x + left_ * velocity;
  const bool inside = grid.find_along(x, end, tube + step_ * velocity.norm() + room_, found_);
  if (inside && std::none_of(found_.begin(), found_.end(), [&](int t) {
        return grid.off_line(t, x.data(), end.data()) <= tube;
      }))
    return;
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

bool ApproachList::serves(const SurfaceGrid &grid, const std::vector<SurfaceVertex> &vertices,
                          double duration)
{
  if (!made_ || duration > (1.0 + ROUNDING) * left_) return false;
  double most = 0.0;
  for (size_t v = 0; v < vertices.size(); ++v)
    most = std::max(most, (vertices[v].path.origin - made_at_[v]).squaredNorm());
  moved_ = std::sqrt(most);
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
  return sizeof(Vector3d) * made_at_.capacity() + sizeof(Entry) * entries_.capacity() +
      sizeof(int) * (triangles_.capacity() + entry_of_.capacity() + starts_.capacity()) +
      sizeof(Candidate) * (candidates_.capacity() + sorted_.capacity());
}
