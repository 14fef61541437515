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

#include "membrane_mesh_soup.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

using namespace Membrane_NS;
using Eigen::Vector3d;

namespace {

constexpr double TOLERANCE = 1e-6;    // of the diagonal of the bounding box

template <typename Number> using Triple = std::array<Number, 3>;

struct HashTriple {
  template <typename Number> size_t operator()(const Triple<Number> &key) const
  {
    size_t sum = 0;
    for (Number x : key) sum = (sum ^ std::hash<Number>()(x)) * 0x9e3779b97f4a7c15ull;
    return sum;
  }
};

/* ----------------------------------------------------------------------
   vertices at which the surface ends: in an edge of a single polygon, or in no polygon
------------------------------------------------------------------------- */

std::vector<bool> find_open(const PolygonSoup &soup)
{
  std::vector<std::pair<int, int>> edges;
  edges.reserve(soup.corners.size());
  std::vector<bool> open(soup.points.size(), true);
  for (int i = 0; i < soup.size(); ++i) {
    const IntSpan polygon = soup.polygon(i);
    for (int k = 0; k < polygon.size(); ++k) {
      const int v = polygon[k], w = polygon[k + 1 == polygon.size() ? 0 : k + 1];
      if (v != w) edges.emplace_back(std::min(v, w), std::max(v, w));
      open[v] = false;
    }
  }
  std::sort(edges.begin(), edges.end());
  for (size_t i = 0, j; i < edges.size(); i = j) {
    for (j = i + 1; j < edges.size() && edges[j] == edges[i];) ++j;
    if (j == i + 1) open[edges[i].first] = open[edges[i].second] = true;
  }
  return open;
}

// === Who is at the same place: each gives the first vertex there, or that vertex itself

class SameNumbers {
 public:
  int first_at(const Vector3d &x, int v)
  {
    return first_.try_emplace({x[0] + 0.0, x[1] + 0.0, x[2] + 0.0}, v).first->second;    // -0 is 0
  }

 private:
  std::unordered_map<Triple<double>, int, HashTriple> first_;
};

/// By cells of the size of the tolerance: what is closer is in the same or a neighbouring cell.
class Nearby {
 public:
  Nearby(const Vector3d &origin, double tolerance, const PeriodicBox &box, bool images) :
      origin_(origin), tolerance_(tolerance), box_(box), images_(images)
  {
    if (images_) to_fraction_ = box.lattice.inverse();
  }

  int first_at(const Vector3d &point, int v)
  {
    const Vector3d x = images_ ? wrapped(point) : Vector3d(point - origin_);
    int found = -1;
    try_images(x, 0, found);
    if (found >= 0) return found;
    cells_.emplace(cell(x), Entry{x, v});
    return v;
  }

 private:
  struct Entry {
    Vector3d x;
    int vertex;
  };
  Vector3d origin_;
  double tolerance_;
  const PeriodicBox &box_;
  bool images_;
  Eigen::Matrix3d to_fraction_;
  std::unordered_multimap<Triple<int64_t>, Entry, HashTriple> cells_;

  Triple<int64_t> cell(const Vector3d &x) const
  {
    Triple<int64_t> key;
    for (int k = 0; k < 3; ++k) key[k] = static_cast<int64_t>(std::floor(x[k] / tolerance_));
    return key;
  }

  Vector3d wrapped(const Vector3d &point) const
  {
    const Vector3d x = point - origin_;
    Vector3d shift = to_fraction_ * x;
    for (int k = 0; k < 3; ++k) shift[k] = box_.periodic[k] ? std::floor(shift[k]) : 0.0;
    return x - box_.lattice * shift;
  }

  // beside a side of the box there are images of what is beside the opposite side

  void try_images(const Vector3d &x, int k, int &found) const
  {
    if (k == 3) {
      find(x, found);
      return;
    }
    try_images(x, k + 1, found);
    if (!images_ || !box_.periodic[k]) return;
    const double fraction = to_fraction_.row(k).dot(x);
    const double close = 2.0 * tolerance_ * to_fraction_.row(k).norm();
    if (fraction < close) try_images(x + box_.lattice.col(k), k + 1, found);
    if (fraction > 1.0 - close) try_images(x - box_.lattice.col(k), k + 1, found);
  }

  void find(const Vector3d &x, int &found) const
  {
    const Triple<int64_t> centre = cell(x);
    for (int i = 0; i < 27 && found < 0; ++i) {
      const auto range = cells_.equal_range(
          {centre[0] + i / 9 - 1, centre[1] + i / 3 % 3 - 1, centre[2] + i % 3 - 1});
      for (auto it = range.first; it != range.second; ++it)
        if ((it->second.x - x).norm() <= tolerance_) found = it->second.vertex;
    }
  }
};

}    // namespace

/* ----------------------------------------------------------------------
   each pass takes what the one before left open; in the end, doubles that no polygon uses are joined
   with what is used, open or not
------------------------------------------------------------------------- */

std::vector<int> Membrane_NS::join_open_vertices(PolygonSoup &soup, const PeriodicBox &box)
{
  const int num_points = static_cast<int>(soup.points.size());
  std::vector<int> joined_with(num_points);
  for (int v = 0; v < num_points; ++v) joined_with[v] = v;

  // the places of open vertices; false if there are none

  auto pass = [&](auto places) {
    const std::vector<bool> open = find_open(soup);
    bool any = false;
    std::vector<int> now(num_points);
    for (int v = 0; v < num_points; ++v) {
      now[v] = v;
      if (!open[v] || joined_with[v] != v) continue;
      now[v] = places.first_at(soup.points[v], v);
      any = true;
    }
    for (int &v : joined_with) v = now[v];
    for (int &v : soup.corners) v = now[v];
    return any;
  };

  if (!pass(SameNumbers())) return joined_with;
  Vector3d low = soup.points[0], high = low;
  for (const Vector3d &point : soup.points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const double tolerance = TOLERANCE * (high - low).norm();
  if (!std::isnormal(tolerance)) return joined_with;
  bool any = pass(Nearby(low, tolerance, box, false));
  const bool periodic = box.periodic[0] || box.periodic[1] || box.periodic[2];
  constexpr double MOST_CELLS = 1e15;    // exact as double, and as integer
  if (any && periodic && box.lattice.norm() / tolerance < MOST_CELLS)
    any = pass(Nearby(low, tolerance, box, true));
  if (!any) return joined_with;

  std::vector<bool> used(num_points, false);
  for (int v : soup.corners) used[v] = true;
  Nearby places(low, tolerance, box, false);
  for (int v = 0; v < num_points; ++v)
    if (used[v]) places.first_at(soup.points[v], v);
  for (int v = 0; v < num_points; ++v)
    if (!used[v] && joined_with[v] == v) joined_with[v] = places.first_at(soup.points[v], v);
  return joined_with;
}
