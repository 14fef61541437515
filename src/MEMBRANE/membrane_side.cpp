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

#include "membrane_side.h"

#include <algorithm>
#include <cmath>

using namespace Membrane_NS;
using Eigen::Vector3d;

static constexpr int MOST_COLUMNS = 2048;    // in each direction
static constexpr double FINER = 3.0;         // columns are narrower than triangles: few of these are over a point

static constexpr double INSIDE[2] = {0.3819660112501051, 0.5671432904097838};

/* ---------------------------------------------------------------------- */

SurfaceSide::SurfaceSide(const std::vector<Vector3d> &points, const std::vector<Face> &faces,
                         int axis, const std::array<bool, 3> &periodic) :
    axis_(axis),
    periodic_(periodic)
{
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  for (const Face &face : faces) {
    Triangle triangle;
    triangle.corner = face;
    for (int k = 0; k < 3; ++k) {
      Vector3d d = points[face[k]] - points[face[0]];
      for (int l = 0; l < 3; ++l)
        if (periodic[l]) d[l] -= std::round(d[l]);
      triangle.x[k] = points[face[0]] + d;
    }
    triangles_.push_back(triangle);
  }
  fill_columns();
  find_layers();

  // a ray through the middle of a triangle: through how many images in all, and what is behind it

  const Triangle *widest = nullptr;
  double most = -1.0;
  for (const Triangle &t : triangles_) {
    const Vector3d a = t.x[1] - t.x[0], b = t.x[2] - t.x[0];
    const double area = std::fabs(a[i] * b[j] - a[j] * b[i]);
    if (area > most) {
      most = area;
      widest = &t;
    }
  }
  if (!widest) return;
  const Vector3d middle = (widest->x[0] + widest->x[1] + widest->x[2]) / 3.0;
  const int index = static_cast<int>(widest - triangles_.data());
  degree_ = behind_ = 0;
  cross(middle, [&](const Entry &entry, double height, int sign) {
    degree_ += sign;
    if (entry.triangle != index)
      behind_ += sign * images_below(middle[axis_], height);
    else if (sign < 0)
      --behind_;    // behind it is above
  });
  if (!periodic_[axis_]) degree_ = 0;
}

/* ----------------------------------------------------------------------
   columns along the axis; sideways they cover the box where it is periodic, else the surface
------------------------------------------------------------------------- */

void SurfaceSide::fill_columns()
{
  const int side[2] = {(axis_ + 1) % 3, (axis_ + 2) % 3};
  double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY}, width[2] = {0.0, 0.0};
  for (const Triangle &t : triangles_)
    for (int m = 0; m < 2; ++m) {
      const int k = side[m];
      const double a = std::min({t.x[0][k], t.x[1][k], t.x[2][k]}),
                   b = std::max({t.x[0][k], t.x[1][k], t.x[2][k]});
      lo[m] = std::min(lo[m], a);
      hi[m] = std::max(hi[m], b);
      width[m] += (b - a) / triangles_.size();
    }
  for (int m = 0; m < 2; ++m) {
    const bool wrap = periodic_[side[m]];
    lo_[m] = wrap ? 0.0 : lo[m];
    const double extent = wrap ? 1.0 : hi[m] - lo[m];
    const double wanted = width[m] > 0.0 ? FINER * extent / width[m] : 1.0;
    columns_[m] = std::clamp(static_cast<int>(std::min(wanted, 1.0e6)), 1, MOST_COLUMNS);
    inverse_width_[m] = extent > 0.0 ? columns_[m] / extent : 1.0;
  }

  std::vector<std::pair<int, Entry>> all;
  for (size_t n = 0; n < triangles_.size(); ++n) {
    const Triangle &t = triangles_[n];
    int from[2], to[2];
    double first[2], last[2];
    for (int m = 0; m < 2; ++m) {
      const int k = side[m];
      first[m] = std::min({t.x[0][k], t.x[1][k], t.x[2][k]});
      last[m] = std::max({t.x[0][k], t.x[1][k], t.x[2][k]});
      from[m] = to[m] = 0;
      if (periodic_[k]) {    // all moves that bring some of it into [0, 1]
        from[m] = static_cast<int>(std::ceil(-last[m]));
        to[m] = static_cast<int>(std::floor(1.0 - first[m]));
      }
    }
    for (int p = from[0]; p <= to[0]; ++p)
      for (int q = from[1]; q <= to[1]; ++q) {
        const double move[2] = {double(p), double(q)};
        int a[2], b[2];
        for (int m = 0; m < 2; ++m) {
          a[m] = std::clamp(
              static_cast<int>(std::floor((first[m] + move[m] - lo_[m]) * inverse_width_[m] - 1e-9)),
              0, columns_[m] - 1);
          b[m] = std::clamp(
              static_cast<int>(std::floor((last[m] + move[m] - lo_[m]) * inverse_width_[m] + 1e-9)),
              0, columns_[m] - 1);
        }
        for (int c = a[0]; c <= b[0]; ++c)
          for (int d = a[1]; d <= b[1]; ++d)
            all.push_back({d * columns_[0] + c, {static_cast<int>(n), {move[0], move[1]}}});
      }
  }
  start_.assign(columns_[0] * columns_[1] + 1, 0);
  for (const auto &[column, entry] : all) ++start_[column + 1];
  for (size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
  entries_.resize(all.size());
  std::vector<int> next(start_.begin(), start_.end() - 1);
  for (const auto &[column, entry] : all) entries_[next[column]++] = entry;
}

/* ----------------------------------------------------------------------
   Within a column the surface enters and leaves a layer through the sides only, so what a line along
   the axis gains from below to above is the same everywhere, and one line tells it: not that in the
   middle, which the edges of a symmetric mesh may meet
------------------------------------------------------------------------- */

void SurfaceSide::find_layers()
{
  std::vector<Layer> found;
  first_layer_.assign(1, 0);
  layers_.clear();
  const int side[2] = {(axis_ + 1) % 3, (axis_ + 2) % 3};
  for (int c = 0; c < columns_[0] * columns_[1]; ++c) {
    found.clear();
    for (int n = start_[c]; n < start_[c + 1]; ++n) {
      const auto &x = triangles_[entries_[n].triangle].x;
      const auto [lo, hi] = std::minmax({x[0][axis_], x[1][axis_], x[2][axis_]});
      found.push_back({lo, hi - lo, 0});
    }
    std::sort(found.begin(), found.end(), [](const Layer &a, const Layer &b) { return a.lo < b.lo; });
    for (const Layer &one : found) {
      const bool joins = static_cast<int>(layers_.size()) > first_layer_.back() &&
          one.lo <= layers_.back().lo + layers_.back().width;
      if (!joins)
        layers_.push_back(one);
      else
        layers_.back().width =
            std::max(layers_.back().width, one.lo + one.width - layers_.back().lo);
    }
    Vector3d line = Vector3d::Zero();
    line[side[0]] = lo_[0] + (c % columns_[0] + INSIDE[0]) / inverse_width_[0];
    line[side[1]] = lo_[1] + (c / columns_[0] + INSIDE[1]) / inverse_width_[1];
    cross(line, [&](const Entry &entry, double, int sign) {
      const auto &x = triangles_[entry.triangle].x;
      const double lo = std::min({x[0][axis_], x[1][axis_], x[2][axis_]});
      int l = static_cast<int>(layers_.size()) - 1;
      while (lo < layers_[l].lo) --l;
      layers_[l].rise += sign;
    });
    first_layer_.push_back(static_cast<int>(layers_.size()));
  }
}

/* ----------------------------------------------------------------------
   on which side of the line from a to b a point is; where it is on the line, as if it were moved by
   (e, e^2) with a tiny e. The lesser vertex first, so that both triangles of an edge agree.
------------------------------------------------------------------------- */

static bool left_of(const double *p, const double *a, const double *b)
{
  const double area = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
  if (area != 0.0) return area > 0.0;
  if (b[1] != a[1]) return b[1] < a[1];
  return b[0] > a[0];
}

// the column of a point, and where it is sideways; -1 if beyond the surface

int SurfaceSide::column(const Vector3d &x, double (&p)[2]) const
{
  int at[2];
  for (int m = 0; m < 2; ++m) {
    const int k = (axis_ + 1 + m) % 3;
    p[m] = x[k];
    if (periodic_[k]) p[m] -= std::floor(p[m]);
    const double column = (p[m] - lo_[m]) * inverse_width_[m];
    if (!(column >= 0.0 && column <= columns_[m])) return -1;
    at[m] = std::min(static_cast<int>(column), columns_[m] - 1);
  }
  return at[1] * columns_[0] + at[0];
}

template <typename Crossing> void SurfaceSide::cross(const Vector3d &x, const Crossing &crossing) const
{
  const int side[2] = {(axis_ + 1) % 3, (axis_ + 2) % 3};
  double p[2];
  const int c = column(x, p);
  if (c < 0) return;
  for (int n = start_[c]; n < start_[c + 1]; ++n) {
    const Entry &entry = entries_[n];
    const Triangle &t = triangles_[entry.triangle];
    double corner[3][2];
    for (int k = 0; k < 3; ++k)
      for (int m = 0; m < 2; ++m) corner[k][m] = t.x[k][side[m]] + entry.shift[m];
    bool left[3] = {false, false, false};
    for (int k = 0; k < 3 && !(k == 2 && left[0] != left[1]); ++k) {
      const int l = (k + 1) % 3;
      left[k] = t.corner[k] < t.corner[l] ? left_of(p, corner[k], corner[l])
                                          : !left_of(p, corner[l], corner[k]);
    }
    if (left[0] != left[1] || left[1] != left[2]) continue;

    const double ax = corner[1][0] - corner[0][0], ay = corner[1][1] - corner[0][1],
                 bx = corner[2][0] - corner[0][0], by = corner[2][1] - corner[0][1],
                 px = p[0] - corner[0][0], py = p[1] - corner[0][1];
    const double area = ax * by - ay * bx;
    double u = 0.0, v = 0.0;
    if (area != 0.0) {
      u = std::clamp((px * by - py * bx) / area, 0.0, 1.0);
      v = std::clamp((ax * py - ay * px) / area, 0.0, 1.0);
    }
    const double z0 = t.x[0][axis_], z1 = t.x[1][axis_], z2 = t.x[2][axis_];
    crossing(entry, z0 + u * (z1 - z0) + v * (z2 - z0), left[0] ? 1 : -1);
  }
}

// of the images of a piece of surface, those below a height: from 0 up, less the ones that are
// missing down to -1

int SurfaceSide::images_below(double height, double surface) const
{
  if (!periodic_[axis_]) return surface < height ? 1 : 0;
  return static_cast<int>(std::ceil(height - surface));
}

int SurfaceSide::level(const Vector3d &x) const
{
  double p[2];
  const int c = column(x, p);
  if (c < 0) return 0;
  int n = 0;
  bool among = false;
  for (int l = first_layer_[c]; l < first_layer_[c + 1]; ++l) {
    const Layer &layer = layers_[l];
    const double above = x[axis_] - layer.lo;
    const double height = periodic_[axis_] ? above - std::floor(above) : above;
    among = among || !(height > layer.width || height < 0.0);
    n += layer.rise * images_below(x[axis_], layer.lo);
  }
  if (!among) return n;
  n = 0;
  cross(x, [&](const Entry &, double height, int sign) {
    n += sign * images_below(x[axis_], height);
  });
  return n;
}
