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

#include "membrane_srd_surface_grid.h"

#include <algorithm>

using namespace Membrane_NS;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// in cubes
static constexpr double ROUNDING = 1.0e-9;

/* ---------------------------------------------------------------------- */

void SurfaceGrid::cut(const Vector3d &lo, const Vector3d &hi, const Settings &settings)
{
  settings_ = settings;
  lo_ = lo;
  const Vector3d extent = hi - lo;
  spacing_ = std::max(settings.spacing, std::cbrt(extent.prod() / settings.most_cubes));
  for (;; spacing_ *= 1.26) {
    double cubes = 1.0;
    for (int k = 0; k < 3; ++k) cubes *= std::floor(extent[k] / spacing_) + 1.0;
    if (cubes > settings.most_cubes) continue;
    for (int k = 0; k < 3; ++k) size_[k] = static_cast<int>(extent[k] / spacing_) + 1;
    break;
  }
  inverse_spacing_ = 1.0 / spacing_;
}

void SurfaceGrid::build(const SurfaceFaces &surface, const std::vector<SurfaceVertex> &vertices,
                        const Matrix3d &lattice, const std::array<bool, 3> &periodic)
{
  built_at_.resize(vertices.size());
  for (size_t v = 0; v < vertices.size(); ++v) built_at_[v] = vertices[v].path.origin;
  find_images(surface, vertices, lattice, periodic, lo_, end(), pad());
  begin(vertices, 0.0, 0.0);
  fill(pad());
  find_distances();
  listed_ = pad();
}

/* ----------------------------------------------------------------------
   list in each cube the triangles within `pad`: those whose box and whose plane come so near; the
   one nearest to its centre leads
------------------------------------------------------------------------- */

void SurfaceGrid::fill(double pad)
{
  const size_t num_cubes = (size_t) size_[0] * size_[1] * size_[2];
  start_.assign(num_cubes + 1, 0);
  visit_cubes(pad, [this](int, int first, int last, double, double) {
    for (int cube = first; cube <= last; ++cube) ++start_[cube + 1];
  });
  for (size_t c = 0; c < num_cubes; ++c) start_[c + 1] += start_[c];
  list_.resize(start_.back());
  std::vector<int> lead(num_cubes, -1);
  std::vector<double> nearest(num_cubes, INFINITY);
  std::vector<int> next(start_.begin(), start_.end() - 1);
  visit_cubes(pad, [&](int t, int first, int last, double height, double rise) {
    const Plane &plane = this->plane(t);
    const int row = first / size_[0];
    const double y = lo_[1] + spacing_ * (row % size_[1] + 0.5),
                 z = lo_[2] + spacing_ * (row / size_[1] + 0.5);
    const double beside =
        std::max({plane.lo[1] - y, y - plane.hi[1], plane.lo[2] - z, z - plane.hi[2]});
    for (int cube = first; cube <= last; ++cube, height += rise) {
      list_[next[cube]++] = t;
      const double x = lo_[0] + spacing_ * (cube - row * size_[0] + 0.5);
      const double distance =
          std::max({std::fabs(height), beside, plane.lo[0] - x, x - plane.hi[0]});
      if (distance >= nearest[cube]) continue;
      nearest[cube] = distance;
      lead[cube] = t;
    }
  });
  layers_.build(*this, start_, list_, std::move(lead));
}

/* ----------------------------------------------------------------------
   rows of cubes that a triangle is listed in: visit(triangle, first cube, last, height of the first
   one's centre over the plane, what it rises from each to the next)
------------------------------------------------------------------------- */

template <class Visit> void SurfaceGrid::visit_cubes(double pad, const Visit &visit)
{
  for (size_t t = 0; t < images().size(); ++t) {
    const Plane &plane = this->plane(t);
    std::array<int, 3> from, to;
    for (int k = 0; k < 3; ++k) {
      const double a = (plane.lo[k] - pad - lo_[k]) * inverse_spacing_,
                   b = (plane.hi[k] + pad - lo_[k]) * inverse_spacing_;
      from[k] = std::max(0, static_cast<int>(std::floor(a)));
      to[k] = std::min(size_[k] - 1, static_cast<int>(std::floor(b)));
    }
    const Vector3d normal = Vector3d::Map(plane.normal);
    const double within = pad + 0.5 * spacing_ * normal.lpNorm<1>(), rise = spacing_ * normal[0];
    for (int z = from[2]; z <= to[2]; ++z)
      for (int y = from[1]; y <= to[1]; ++y) {
        const Vector3d centre = lo_ + spacing_ * Vector3d(from[0] + 0.5, y + 0.5, z + 0.5);
        const double height = normal.dot(centre) + plane.offset;
        int first = 0, last = to[0] - from[0];    // of those with heights within bounds
        const double room = ROUNDING * spacing_;
        if (std::fabs(rise) > room) {
          double a = (-within - height) / rise, b = (within - height) / rise;
          if (rise < 0.0) std::swap(a, b);
          if (!(b >= -ROUNDING && a <= last + ROUNDING)) continue;
          first = static_cast<int>(std::max(0.0, std::ceil(a - ROUNDING)));
          last = static_cast<int>(std::min<double>(last, std::floor(b + ROUNDING)));
        } else if (std::fabs(height) > within + (last + 1) * room)
          continue;
        const int row = (z * size_[1] + y) * size_[0] + from[0];
        if (first <= last)
          visit(static_cast<int>(t), row + first, row + last, height + first * rise, rise);
      }
  }
}

/* ----------------------------------------------------------------------
   Cubes to the next one with triangles, diagonally, too: those with triangles spread out by one
   cube in each direction, and who has not been reached counts. From a place n cubes away, a
   straight line to a triangle passes n - 1 cubes before it comes to one within `pad` of that
   triangle.
------------------------------------------------------------------------- */

void SurfaceGrid::find_distances()
{
  const size_t row = size_[0], layer = row * size_[1], n = layer * size_[2];
  away_.assign(n, 0);
  std::vector<uint8_t> reached(n), last(n);
  for (size_t c = 0; c < n; ++c) reached[c] = start_[c + 1] > start_[c];

  // in lines of `length` cubes at distances of `stride`, of which `stride` lie side by side

  auto spread = [&](size_t length, size_t stride) {
    last = reached;
    for (size_t first = 0; first < n; first += length * stride) {
      uint8_t *to = reached.data() + first;
      const uint8_t *from = last.data() + first;
      const size_t inner = (length - 1) * stride;
      for (size_t c = 0; c < inner; ++c) to[c] |= from[c + stride];
      for (size_t c = 0; c < inner; ++c) to[c + stride] |= from[c];
    }
  };
  for (int k = 0; k < MOST_AWAY; ++k) {
    size_t missing = 0;
    for (size_t c = 0; c < n; ++c) {
      away_[c] += 1 - reached[c];
      missing += 1 - reached[c];
    }
    if (missing == 0) break;
    spread(size_[0], 1);
    spread(size_[1], row);
    spread(size_[2], layer);
  }

  // nothing is known beyond the grid, which in the first cubes is next to them

  size_t c = 0;
  std::array<int, 3> i;
  for (i[2] = 0; i[2] < size_[2]; ++i[2])
    for (i[1] = 0; i[1] < size_[1]; ++i[1])
      for (i[0] = 0; i[0] < size_[0]; ++i[0], ++c)
        for (int k = 0; k < 3; ++k)
          away_[c] = std::min<int>(away_[c], 1 + std::min(i[k], size_[k] - 1 - i[k]));
}

/* ---------------------------------------------------------------------- */

bool SurfaceGrid::is_valid_for(const std::vector<SurfaceVertex> &vertices, const Matrix3d &lattice)
{
  if (!is_built() || vertices.size() != built_at_.size() || lattice != this->lattice())
    return false;
  const double skin_squared = settings_.skin * settings_.skin;
  double most_squared = 0.0;
  for (size_t v = 0; v < vertices.size(); ++v) {
    const double squared = (vertices[v].path.origin - built_at_[v]).squaredNorm();
    if (!(squared <= skin_squared)) return false;
    most_squared = std::max(most_squared, squared);
  }
  listed_ = settings_.skin + settings_.reach - std::sqrt(most_squared);
  return true;
}

void SurfaceGrid::begin(const std::vector<SurfaceVertex> &vertices, double duration, double slack,
                        const Matrix3d &rate)
{
  SurfaceImages::begin(vertices, duration, slack, rate);
  seen_.assign(images().size(), 0);
  clock_ = 0;
}

/* ---------------------------------------------------------------------- */

bool SurfaceGrid::cubes_of(const Vector3d &lo, const Vector3d &hi, Range &range) const
{
  for (int k = 0; k < 3; ++k) {
    const double a = (lo[k] - lo_[k]) * inverse_spacing_, b = (hi[k] - lo_[k]) * inverse_spacing_;
    if (!(a >= 0.0 && b < size_[k])) return false;
    range.from[k] = static_cast<int>(a);
    range.to[k] = static_cast<int>(b);
  }
  return true;
}

template <class Near>
void SurfaceGrid::collect(const Range &range, std::vector<int> &found, const Near &near)
{
  ++clock_;
  std::array<int, 3> i;
  for (i[2] = range.from[2]; i[2] <= range.to[2]; ++i[2])
    for (i[1] = range.from[1]; i[1] <= range.to[1]; ++i[1])
      for (i[0] = range.from[0]; i[0] <= range.to[0]; ++i[0]) {
        const int cube = (i[2] * size_[1] + i[1]) * size_[0] + i[0];
        for (int j = start_[cube]; j < start_[cube + 1]; ++j) {
          const int t = list_[j];
          if (seen_[t] == clock_) continue;
          seen_[t] = clock_;
          if (!near(t)) continue;
          found.push_back(t);
        }
      }
}

// without branches, so that compilers turn it into vectors; what is not a number is not inside

void SurfaceGrid::find_cubes(const double *x, int n, int *cubes) const
{
  const double lo0 = lo_[0], lo1 = lo_[1], lo2 = lo_[2], scale = inverse_spacing_;
  const double size0 = size_[0], size1 = size_[1], size2 = size_[2];
  const int row = size_[0], layer = size_[0] * size_[1];
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double s0 = (x[3 * i] - lo0) * scale, s1 = (x[3 * i + 1] - lo1) * scale,
                 s2 = (x[3 * i + 2] - lo2) * scale;
    const bool inside =
        (s0 >= 0.0) & (s0 < size0) & (s1 >= 0.0) & (s1 < size1) & (s2 >= 0.0) & (s2 < size2);
    const int at0 = static_cast<int>(inside ? s0 : 0.0), at1 = static_cast<int>(inside ? s1 : 0.0),
              at2 = static_cast<int>(inside ? s2 : 0.0);
    cubes[i] = inside ? at2 * layer + at1 * row + at0 : -1;
  }
}

SurfaceGrid::Distances SurfaceGrid::distances(double tube) const
{
  Distances squares;
  for (int n = 0; n <= MOST_AWAY; ++n) squares[n] = std::pow(std::max(0.0, clear(n) - tube), 2);
  return squares;
}

bool SurfaceGrid::find(const Vector3d &x, double reach, std::vector<int> &found)
{
  found.clear();
  Range range;
  const Vector3d beyond = Vector3d::Constant(std::max(0.0, reach + most_moves() - listed_));
  if (!cubes_of(x - beyond, x + beyond, range)) return false;
  collect(range, found, [&](int t) {
    return comes_within(t, x.data(), reach);
  });
  return true;
}

bool SurfaceGrid::find_along(const Vector3d &x, const Vector3d &end, double tube,
                             std::vector<int> &found, double &nearest)
{
  found.clear();
  nearest = INFINITY;
  Range range;
  if (knows_all(tube, (end - x).squaredNorm())) {
    if (!cubes_of(x, x, range)) return false;
  } else {
    const Vector3d beyond = Vector3d::Constant(std::max(0.0, tube - listed_));
    if (!cubes_of(x.cwiseMin(end) - beyond, x.cwiseMax(end) + beyond, range)) return false;
  }
  collect(range, found, [&](int t) {
    const double off = off_line(t, x.data(), end.data());
    nearest = std::min(nearest, off);
    return off <= tube;
  });
  return true;
}

/* ---------------------------------------------------------------------- */

void SurfaceGrid::load(int cube, Batch &batch) const
{
  const int first = start_[cube], n = start_[cube + 1] - first;
  batch.triangle.assign(list_.begin() + first, list_.begin() + first + n);
  batch.offset.resize(n);
  batch.off.resize(n);
  for (int k = 0; k < 3; ++k)
    for (auto *array : {&batch.normal[k], &batch.lo[k], &batch.hi[k]}) array->resize(n);
  for (int i = 0; i < n; ++i) {
    const Plane &p = plane(batch.triangle[i]);
    batch.offset[i] = p.offset;
    for (int k = 0; k < 3; ++k) {
      batch.normal[k][i] = p.normal[k];
      batch.lo[k][i] = p.lo[k];
      batch.hi[k][i] = p.hi[k];
    }
  }
}

// as off_line(), in a loop that compilers turn into vectors

void SurfaceGrid::measure_along(Batch &batch, const double *x, const double *end)
{
  const int n = static_cast<int>(batch.triangle.size());
  const double x0 = x[0], x1 = x[1], x2 = x[2], e0 = end[0], e1 = end[1], e2 = end[2];
  const double low0 = std::min(x0, e0), low1 = std::min(x1, e1), low2 = std::min(x2, e2),
               high0 = std::max(x0, e0), high1 = std::max(x1, e1), high2 = std::max(x2, e2);
  const double *n0 = batch.normal[0].data(), *n1 = batch.normal[1].data(),
               *n2 = batch.normal[2].data(), *offset = batch.offset.data();
  const double *lo0 = batch.lo[0].data(), *lo1 = batch.lo[1].data(), *lo2 = batch.lo[2].data();
  const double *hi0 = batch.hi[0].data(), *hi1 = batch.hi[1].data(), *hi2 = batch.hi[2].data();
  double *off = batch.off.data();
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double a = n0[i] * x0 + n1[i] * x1 + n2[i] * x2 + offset[i];
    const double b = n0[i] * e0 + n1[i] * e1 + n2[i] * e2 + offset[i];
    const double plane = std::max(std::min(a, b), -std::max(a, b));
    const double box0 = std::max(lo0[i] - high0, low0 - hi0[i]);
    const double box1 = std::max(lo1[i] - high1, low1 - hi1[i]);
    const double box2 = std::max(lo2[i] - high2, low2 - hi2[i]);
    off[i] = std::max(std::max(plane, box0), std::max(box1, box2));
  }
}

double SurfaceGrid::memory_usage() const
{
  return SurfaceImages::memory_usage() + layers_.memory_usage() + away_.capacity() +
      sizeof(int) * (start_.capacity() + list_.capacity()) +
      sizeof(Vector3d) * built_at_.capacity();
}
