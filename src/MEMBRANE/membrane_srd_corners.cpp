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

#include "membrane_srd_corners.h"

#include "membrane_limit_basis.h"
#include "membrane_tessellation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

using namespace Membrane_NS;
using Eigen::Vector3d;

// what is left of weights that cancel
static constexpr double ROUNDING = 1.0e-14;

namespace {

using Image = std::array<int, 3>;
constexpr Image HERE = {0, 0, 0};

Vector3d as_vector(const Image &n)
{
  return {double(n[0]), double(n[1]), double(n[2])};
}

/// A sum of weighted positions of masses near some place.
struct Mean {
  std::vector<SurfaceCorners::Entry> entries;    // ascending
  double total;                                  // of the weights
  Vector3d shift;    // in box vectors, if masses are where their vertices are
};

/// Adds up such sums.
class MeanSum {
 public:
  explicit MeanSum(int num_masses) : weight_(num_masses, 0.0), has_(num_masses, 0) {}

  /// Near the image of its place that is given, as seen from the place of the sum.
  void add(double weight, const Mean &mean, const Image &image = HERE)
  {
    for (const auto &[a, g] : mean.entries) {
      if (!has_[a]) who_.push_back(a);
      has_[a] = 1;
      weight_[a] += weight * g;
    }
    total_ += weight * mean.total;
    shift_ += weight * (mean.shift + mean.total * as_vector(image));
  }
  /// The sum, and it is nothing again.
  Mean take()
  {
    Mean sum = {{}, std::exchange(total_, 0.0), std::exchange(shift_, Vector3d::Zero())};
    std::sort(who_.begin(), who_.end());
    for (int a : who_) {
      if (std::fabs(weight_[a]) > ROUNDING) sum.entries.emplace_back(a, weight_[a]);
      weight_[a] = 0.0;
      has_[a] = 0;
    }
    who_.clear();
    return sum;
  }

 private:
  std::vector<double> weight_;
  std::vector<char> has_;
  std::vector<int> who_;
  double total_ = 0.0;
  Vector3d shift_ = Vector3d::Zero();
};

/// For each vertex P and 1 - L P, see SurfaceCorners.
struct NearInverse {
  std::vector<Mean> inverse, rest;

  NearInverse(const Topology &topology, int degree, const SurfaceCorners::Seams &seams)
  {
    const int n = topology.num_vertices();
    MeanSum sum(n);
    for (int v = 0; v < n; ++v) rest.push_back({{{v, 1.0}}, 1.0, Vector3d::Zero()});
    inverse.assign(n, sum.take());
    std::vector<Mean> next(n);
    for (int power = 0; power <= degree; ++power) {
      for (int v = 0; v < n; ++v) {
        sum.add(1.0, inverse[v]);
        sum.add(1.0, rest[v]);
        inverse[v] = sum.take();

        const IntSpan ring = topology.ring(v);
        const double spokes = 1.0 - limit_mask_centre(ring.size());
        sum.add(spokes, rest[v]);
        for (int j = 0; j < ring.size(); ++j)
          sum.add(-spokes / ring.size(), rest[ring[j]], seams.empty() ? HERE : seams[v][j]);
        next[v] = sum.take();
      }
      std::swap(rest, next);
    }
  }
};

/// As many powers as levels, for corners as near to the surface as triangles are.
int degree(int n)
{
  return static_cast<int>(std::floor(std::log2(n)));
}

/// Of the points of a stencil, as stencil_points() places them.
void find_images(const Topology &topology, const SurfaceCorners::Seams &seams,
                 const std::vector<int> &stencil, std::vector<Image> &images)
{
  images.assign(stencil.size(), HERE);
  if (seams.empty()) return;
  topology.along_stencil(stencil, [&](int column, int anchor) {
    const int v = stencil[anchor];
    const IntSpan ring = topology.ring(v);
    images[column] = seams[v][std::find(ring.begin(), ring.end(), stencil[column]) - ring.begin()];
    for (int k = 0; k < 3; ++k) images[column][k] += images[anchor][k];
  });
}

}    // namespace

/* ---------------------------------------------------------------------- */

SurfaceCorners::SurfaceCorners(const Topology &topology, int n, const Seams &seams) :
    num_masses_(topology.num_vertices())
{
  const FaceTessellation cut(n);
  const TessellationNumbering numbering(topology, n);
  const int num_corners = numbering.num_points();
  const NearInverse near(topology, degree(n), seams);

  // each corner is worked out on the first face that has it

  std::vector<Mean> rows(num_corners);
  std::map<Valences, std::vector<LimitBasis::Weights>> known;
  MeanSum sum(num_masses_);
  std::vector<int> stencil;
  std::vector<Image> images;
  for (int a = 0; a < num_masses_; ++a) rows[a] = {{{a, 1.0}}, 1.0, Vector3d::Zero()};
  for (int f = 0; f < topology.num_faces(); ++f) {
    const Valences valences = topology.valences(f);
    auto [entry, is_new] = known.try_emplace(valences);
    auto &weights = entry->second;
    if (is_new) {
      const LimitBasis basis(valences);
      weights.resize(cut.num_points());
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i + j <= n; ++i)
          weights[cut.index(i, j)] = basis.evaluate(double(i) / n, double(j) / n);
    }
    topology.stencil(f, stencil);
    find_images(topology, seams, stencil, images);

    std::vector<int> number(cut.num_points());
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i + j <= n; ++i) {
        const int p = cut.index(i, j), c = number[p] = numbering.number(f, i, j);
        if (!rows[c].entries.empty()) continue;
        for (size_t k = 0; k < stencil.size(); ++k)
          sum.add(weights[p](LimitBasis::VALUE, k), near.inverse[stencil[k]], images[k]);
        const double share[3] = {double(n - i - j) / n, double(i) / n, double(j) / n};
        for (int k = 0; k < 3; ++k)
          if (share[k] > 0.0) sum.add(share[k], near.rest[stencil[k]], images[k]);
        rows[c] = sum.take();
      }
    for (const Face &t : cut.triangles())
      triangles_.push_back({number[t[0]], number[t[1]], number[t[2]]});
  }

  start_.push_back(0);
  for (const Mean &row : rows) {
    entries_.insert(entries_.end(), row.entries.begin(), row.entries.end());
    start_.push_back(entries_.size());
    shifts_.push_back(row.shift);
  }
  find_dependents();
}

SurfaceCorners::SurfaceCorners(const SurfaceCorners &whole, const std::vector<int> &masses,
                               const std::vector<int> &corners) :
    num_masses_(static_cast<int>(masses.size()))
{
  start_.push_back(0);
  for (int a = 0; a < num_masses_; ++a) {
    entries_.emplace_back(a, 1.0);
    start_.push_back(entries_.size());
  }
  for (int c : corners) add(whole, masses, c);
  shifts_.assign(num_masses_, Vector3d::Zero());
  for (int c : corners) shifts_.push_back(whole.shift(c));
  find_dependents();
}

int SurfaceCorners::add(const SurfaceCorners &whole, const std::vector<int> &masses, int corner)
{
  for (const auto &[a, g] : whole.masses_of(corner)) {
    const auto at = std::lower_bound(masses.begin(), masses.end(), a);
    if (at != masses.end() && *at == a)
      entries_.emplace_back(static_cast<int>(at - masses.begin()), g);
  }
  start_.push_back(entries_.size());
  return count() - 1;
}

void SurfaceCorners::find_dependents()
{
  dependents_start_.assign(num_masses_ + 1, 0);
  for (const Entry &e : entries_) ++dependents_start_[e.first + 1];
  for (int a = 0; a < num_masses_; ++a) dependents_start_[a + 1] += dependents_start_[a];
  dependents_.resize(entries_.size());
  std::vector<size_t> next(dependents_start_.begin(), dependents_start_.end() - 1);
  for (int c = 0; c < count(); ++c)
    for (const Entry &e : masses_of(c)) dependents_[next[e.first]++] = {c, e.second};
}

double SurfaceCorners::memory_usage() const
{
  return sizeof(Entry) * (entries_.capacity() + dependents_.capacity()) +
      sizeof(size_t) * (start_.capacity() + dependents_start_.capacity()) +
      sizeof(Face) * triangles_.capacity() + sizeof(Eigen::Vector3d) * shifts_.capacity();
}
