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

#include "membrane_sample_grid.h"

#include <algorithm>
#include <climits>
#include <cmath>

using namespace Membrane_NS;
using Eigen::Vector3d;

static constexpr int CUTS = 3;    // of a face's edges: samples are in the middles of the parts
static constexpr double MARGIN = 1.05;    // parts are a little curved
static constexpr double CELL = 0.75;      // of the mean edge
static constexpr double CELLS_A_SAMPLE = 4.0;
static constexpr double MOST_CELLS = 1024;    // in each direction

namespace {

// the parts of a face: where their corners and middles are

using Place = std::array<double, 2>;    // u, v

struct Cut {
  std::vector<Place> corner;
  struct Part {
    Place middle;
    std::array<int, 3> corner;
  };
  std::vector<Part> part;

  Cut()
  {
    std::array<std::array<int, CUTS + 1>, CUTS + 1> number;
    for (int j = 0; j <= CUTS; ++j)
      for (int i = 0; i + j <= CUTS; ++i) {
        number[i][j] = static_cast<int>(corner.size());
        corner.push_back({i / double(CUTS), j / double(CUTS)});
      }
    for (int j = 0; j < CUTS; ++j)
      for (int i = 0; i + j < CUTS; ++i) {
        add({number[i][j], number[i + 1][j], number[i][j + 1]});
        if (i + j + 1 < CUTS) add({number[i + 1][j], number[i + 1][j + 1], number[i][j + 1]});
      }
  }
  void add(const std::array<int, 3> &c)
  {
    Place middle;
    for (int k = 0; k < 2; ++k)
      middle[k] = (corner[c[0]][k] + corner[c[1]][k] + corner[c[2]][k]) / 3.0;
    part.push_back({middle, c});
  }
};

const Cut &cut_face()
{
  static const Cut cut;
  return cut;
}

}    // namespace

/* ---------------------------------------------------------------------- */

SampleGrid::SampleGrid(const LimitSurface &surface) : surface_(surface)
{
  for (int f = 0; f < surface.topology().num_faces(); ++f) {
    bool steep = false;
    for (int n : surface.topology().valences(f)) steep = steep || n == 3 || n > 6;
    steep_.push_back(steep);
  }
  update();
}

void SampleGrid::update()
{
  std::vector<Sample> samples;
  take_samples(samples);
  lay_axes(samples);

  // into the cells, and of periodic images the one in the box

  std::vector<size_t> cell(samples.size());
  start_.assign(static_cast<size_t>(cells_[0]) * cells_[1] * cells_[2] + 1, 0);
  for (size_t s = 0; s < samples.size(); ++s) {
    Vector3d fraction = to_fraction_ * (samples[s].position - low_);
    for (int k = 0; k < 3; ++k)
      if (surface_.periodic()[k]) {
        samples[s].position -= axes_.col(k) * std::floor(fraction[k]);
        fraction[k] -= std::floor(fraction[k]);
      }
    std::array<int, 3> at = cell_of(fraction);
    for (int k = 0; k < 3; ++k) at[k] = std::clamp(at[k], 0, cells_[k] - 1);
    cell[s] = index_of(at);
    ++start_[cell[s] + 1];
  }
  for (size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
  std::vector<int> next(start_.begin(), start_.end() - 1);
  samples_.resize(samples.size());
  for (size_t s = 0; s < samples.size(); ++s) samples_[next[cell[s]]++] = samples[s];
}

void SampleGrid::take_samples(std::vector<Sample> &samples)
{
  const Cut &cut = cut_face();
  samples.reserve(cut.part.size() * surface_.topology().num_faces());
  std::vector<Vector3d> corner(cut.corner.size());
  SurfacePiece piece;
  SurfaceJet jet;
  radius_ = 0.0;
  for (int f = 0; f < surface_.topology().num_faces(); ++f) {
    auto position = [&](const Place &uv) {
      surface_.evaluate<0>({f, uv[0], uv[1]}, piece, jet);
      return jet.position();
    };
    for (size_t c = 0; c < corner.size(); ++c) corner[c] = position(cut.corner[c]);
    for (size_t p = 0; p < cut.part.size(); ++p) {
      const Vector3d middle = position(cut.part[p].middle);
      samples.push_back({middle, f, static_cast<int>(p)});
      for (int c : cut.part[p].corner) radius_ = std::max(radius_, (corner[c] - middle).norm());
    }
  }
  radius_ *= MARGIN;
}

/* ----------------------------------------------------------------------
   The axes of the grid: box vectors where the box is periodic; the others at right angles to these and
   to one another, so that the point of the grid closest to one outside is found axis by axis.
------------------------------------------------------------------------- */

void SampleGrid::lay_axes(const std::vector<Sample> &samples)
{
  const auto &periodic = surface_.periodic();
  axes_ = surface_.lattice();
  const int count = periodic[0] + periodic[1] + periodic[2];
  if (count == 0)
    axes_.setIdentity();
  else if (count == 2) {
    const int k = periodic[0] ? (periodic[1] ? 2 : 1) : 0;
    axes_.col(k) = axes_.col((k + 1) % 3).cross(axes_.col((k + 2) % 3)).normalized();
  } else if (count == 1) {
    const int k = periodic[0] ? 0 : periodic[1] ? 1 : 2;
    const Vector3d along = axes_.col(k).normalized();
    axes_.col((k + 1) % 3) = along.unitOrthogonal();
    axes_.col((k + 2) % 3) = along.cross(axes_.col((k + 1) % 3));
  }

  // as long as the surface is where nothing repeats; a little longer, to have some length

  Eigen::Matrix3d inverse = axes_.inverse();
  const double spare = 1.0e-6 * surface_.mean_edge();
  Vector3d low = Vector3d::Constant(INFINITY), high = Vector3d::Constant(-INFINITY);
  for (const Sample &sample : samples) {
    const Vector3d fraction = inverse * sample.position;
    low = low.cwiseMin(fraction);
    high = high.cwiseMax(fraction);
  }
  for (int k = 0; k < 3; ++k) {
    if (periodic[k] || samples.empty()) {
      low[k] = 0.0;
      continue;
    }
    low[k] -= spare;
    axes_.col(k) *= high[k] + spare - low[k];
  }
  low_ = inverse.inverse() * low;
  to_fraction_ = axes_.inverse();

  double wanted = CELL * surface_.mean_edge();
  const double most = std::max(64.0, CELLS_A_SAMPLE * samples.size());
  for (;;) {
    double number = 1.0;
    for (int k = 0; k < 3; ++k) {
      const double across = 1.0 / to_fraction_.row(k).norm();
      cells_[k] = static_cast<int>(std::clamp(across / wanted, 1.0, MOST_CELLS));
      width_[k] = across / cells_[k];
      number *= cells_[k];
    }
    if (number <= most || !(wanted > 0.0)) break;
    wanted *= 1.25;
  }
}

std::array<int, 3> SampleGrid::cell_of(const Vector3d &fraction) const
{
  std::array<int, 3> cell;
  for (int k = 0; k < 3; ++k) cell[k] = static_cast<int>(std::floor(fraction[k] * cells_[k]));
  return cell;
}

/* ----------------------------------------------------------------------
   the nearest sample of each part of the surface, in no order until the end
------------------------------------------------------------------------- */

class SampleGrid::Collector {
 public:
  Collector(const SampleGrid &grid, Nearby &nearby) : grid_(grid), nearby_(nearby) {}

  /// Samples beyond are of no interest any more.
  double reach() const { return nearest_ + grid_.radius_; }

  void take(const Sample &sample, const Vector3d &offset)
  {
    const double distance2 = offset.squaredNorm(), reach = this->reach();
    if (!(distance2 < reach * reach)) return;
    const double distance = std::sqrt(distance2);
    nearest_ = std::min(nearest_, distance);
    int place = 0;
    while (place < count_ && !same_part(nearby_[place], sample.face, offset)) ++place;
    if (place == count_) {
      if (count_ < MOST_NEAR)
        ++count_;
      else {
        for (int i = place = 0; i < count_; ++i)
          if (nearby_[i].distance > nearby_[place].distance) place = i;
        if (distance >= nearby_[place].distance) return;
      }
    } else if (distance >= nearby_[place].distance)
      return;
    const auto &uv = cut_face().part[sample.which].middle;
    nearby_[place] = {{sample.face, uv[0], uv[1]}, offset, distance};
  }

  int finish()
  {
    std::sort(nearby_.begin(), nearby_.begin() + count_, [](const Near &a, const Near &b) {
      return a.distance < b.distance;
    });
    while (count_ > 1 && nearby_[count_ - 1].distance > reach()) --count_;
    return count_;
  }

 private:
  const SampleGrid &grid_;
  Nearby &nearby_;
  int count_ = 0;
  double nearest_ = INFINITY;

  bool same_part(const Near &known, int face, const Vector3d &offset) const
  {
    if (grid_.steep_[face] || grid_.steep_[known.point.face]) return face == known.point.face;
    const double far = 8.0 * grid_.radius_;    // else another image
    if ((known.offset - offset).squaredNorm() > far * far) return false;
    const Face &a = grid_.surface_.topology().face(known.point.face);
    const Face &b = grid_.surface_.topology().face(face);
    for (int v : a)
      if (corner_of(b, v) >= 0) return true;
    return false;
  }
};

void SampleGrid::visit(const std::array<int, 3> &cell, const Vector3d &x,
                       Collector &collector) const
{
  std::array<int, 3> inside = cell;
  Vector3d shift = -x;
  for (int k = 0; k < 3; ++k) {
    if (cell[k] >= 0 && cell[k] < cells_[k]) continue;
    if (!surface_.periodic()[k]) return;
    const int image = static_cast<int>(std::floor(cell[k] / double(cells_[k])));
    inside[k] -= image * cells_[k];
    shift += image * axes_.col(k);
  }
  const size_t c = index_of(inside);
  for (int s = start_[c]; s < start_[c + 1]; ++s)
    collector.take(samples_[s], samples_[s].position + shift);
}

/* ----------------------------------------------------------------------
   Shells of cells around that of x, until the next one is too far away. Where the grid ends, that of
   the closest point of the grid: from it no cell is further than from x.
------------------------------------------------------------------------- */

int SampleGrid::near(const Vector3d &x, Nearby &nearby) const
{
  Collector collector(*this, nearby);
  if (samples_.empty() || !x.allFinite()) return 0;
  Vector3d fraction = to_fraction_ * (x - low_);
  int shells = 0;
  for (int k = 0; k < 3; ++k) {
    if (surface_.periodic()[k])
      shells = INT_MAX - 1;
    else {
      fraction[k] = std::clamp(fraction[k], 0.0, 1.0 - 1.0e-12);
      shells = std::max(shells, cells_[k]);
    }
  }
  const std::array<int, 3> home = cell_of(fraction);
  double edge = INFINITY;    // from the point to the nearest side of its cell
  for (int k = 0; k < 3; ++k) {
    const double in_cell = fraction[k] * cells_[k] - home[k];
    edge = std::min(edge, std::min(in_cell, 1.0 - in_cell) * width_[k]);
  }
  const double step = width_.minCoeff();

  for (int shell = 0; shell <= shells; ++shell) {
    if (shell > 0 && edge + (shell - 1) * step > collector.reach()) break;
    for (int l = -shell; l <= shell; ++l)
      for (int j = -shell; j <= shell; ++j) {
        const bool side = std::abs(l) == shell || std::abs(j) == shell;
        for (int i = -shell; i <= shell; i += side ? 1 : std::max(2 * shell, 1))
          visit({home[0] + i, home[1] + j, home[2] + l}, x, collector);
      }
  }
  return collector.finish();
}

double SampleGrid::memory_usage() const
{
  return sizeof(Sample) * samples_.capacity() + sizeof(int) * start_.capacity();
}
