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
#include "membrane_srd_inverse_mask.h"
#include "membrane_tessellation.h"

#include <algorithm>
#include <cmath>
#include <map>

using namespace Membrane_NS;

static constexpr double CUT_OFF = 1.0e-4;

namespace {

using Image = std::array<int, 3>;

/// Images of vertices next to one another, along the edges.
class Images {
 public:
  Images(const Topology &topology, const SurfaceCorners::Seams &seams) :
      topology_(topology), seams_(seams), image_(seams.size()), seen_(seams.size(), 0)
  {
  }

  /// From v to w, one of its ring.
  Image along(int v, int w) const
  {
    const IntSpan ring = topology_.ring(v);
    return seams_[v][std::find(ring.begin(), ring.end(), w) - ring.begin()];
  }

  /// Of the points of a stencil, as stencil_points() places them.
  void of_stencil(const std::vector<int> &stencil, std::vector<Image> &images) const
  {
    images.assign(stencil.size(), {0, 0, 0});
    topology_.along_stencil(stencil, [&](int column, int anchor) {
      images[column] = along(stencil[anchor], stencil[column]);
      for (int k = 0; k < 3; ++k) images[column][k] += images[anchor][k];
    });
  }

  /// Of `wanted`, seen from a vertex by the fewest edges; calls use(vertex, image) for each.
  template <typename Use> void from(int start, const int *wanted, size_t count, const Use &use)
  {
    std::vector<int> queue = {start};
    image_[start] = {0, 0, 0};
    seen_[start] = 1;
    size_t missing = 0;
    for (size_t i = 0; i < count; ++i) {
      missing += wanted[i] != start;
      seen_[wanted[i]] |= 2;
    }
    for (size_t i = 0; i < queue.size() && missing > 0; ++i) {
      const int v = queue[i];
      const IntSpan ring = topology_.ring(v);
      for (int j = 0; j < ring.size(); ++j) {
        const int w = ring[j];
        if (seen_[w] & 1) continue;
        for (int k = 0; k < 3; ++k) image_[w][k] = image_[v][k] + seams_[v][j][k];
        missing -= seen_[w] >> 1;
        seen_[w] |= 1;
        queue.push_back(w);
      }
    }
    for (size_t i = 0; i < count; ++i) {
      use(wanted[i], image_[wanted[i]]);
      seen_[wanted[i]] = 0;
    }
    for (int v : queue) seen_[v] = 0;
  }

 private:
  const Topology &topology_;
  const SurfaceCorners::Seams &seams_;
  std::vector<Image> image_;
  std::vector<char> seen_;    // 1: by from(), 2: wanted
};

Eigen::Vector3d as_vector(const Image &n)
{
  return {double(n[0]), double(n[1]), double(n[2])};
}

}    // namespace

/* ---------------------------------------------------------------------- */

SurfaceCorners::SurfaceCorners(const Topology &topology, int n, const Seams &seams) :
    num_masses_(topology.num_vertices())
{
  const bool periodic = !seams.empty();
  Images images(topology, seams);
  std::vector<Image> stencil_images;

  const FaceTessellation cut(n);
  const TessellationNumbering numbering(topology, n);
  InverseMask inverse(topology);
  const int num_corners = numbering.num_points();

  // each corner is worked out on the first face that has it

  std::vector<char> done(num_corners, 0);
  std::vector<std::vector<Entry>> rows(num_corners);
  std::map<Valences, std::vector<LimitBasis::Weights>> known;
  std::vector<double> sum(num_masses_, 0.0);
  shifts_.assign(num_corners, Eigen::Vector3d::Zero());
  std::vector<int> stencil, touched;
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
    if (periodic) images.of_stencil(stencil, stencil_images);

    std::vector<int> number(cut.num_points());
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i + j <= n; ++i) {
        const int p = cut.index(i, j), c = number[p] = numbering.number(f, i, j);
        if (done[c]) continue;
        done[c] = 1;
        if (c < num_masses_) {
          rows[c] = {{c, 1.0}};
          continue;
        }
        touched.clear();
        for (size_t k = 0; k < stencil.size(); ++k) {
          const double w = weights[p](LimitBasis::VALUE, k);
          const auto &row = inverse.row(stencil[k]);
          for (size_t a = 0; a < row.vertex.size(); ++a) {
            if (sum[row.vertex[a]] == 0.0) touched.push_back(row.vertex[a]);
            sum[row.vertex[a]] += w * row.weight[a];
          }
        }

        // with z of control points in box vectors, a mass is at L z + its own spokes to images, and
        // the corner at sum W (z + image)

        if (periodic) {
          for (size_t k = 0; k < stencil.size(); ++k)
            shifts_[c] += weights[p](LimitBasis::VALUE, k) * as_vector(stencil_images[k]);
          for (int a : touched) {
            const int valence = topology.valence(a);
            const double spoke = (1.0 - limit_mask_centre(valence)) / valence;
            for (const Image &image : seams[a]) shifts_[c] -= sum[a] * spoke * as_vector(image);
          }
        }

        // the smallest go, as long as they are little together; what they leave goes to the largest

        std::sort(touched.begin(), touched.end(), [&sum](int a, int b) {
          return std::make_pair(-std::fabs(sum[a]), a) < std::make_pair(-std::fabs(sum[b]), b);
        });
        touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
        size_t keep = touched.size();
        for (double left = 0.0; keep > 1; --keep) {
          left += std::fabs(sum[touched[keep - 1]]);
          if (left > CUT_OFF) break;
        }
        double total = 0.0;
        for (size_t k = 0; k < keep; ++k) {
          rows[c].emplace_back(touched[k], sum[touched[k]]);
          total += sum[touched[k]];
        }
        rows[c][0].second += 1.0 - total;
        if (periodic && keep < touched.size())
          images.from(touched[0], touched.data() + keep, touched.size() - keep,
                      [&](int a, const Image &image) {
                        shifts_[c] -= sum[a] * as_vector(image);
                      });
        for (int a : touched) sum[a] = 0.0;
      }
    for (const Face &t : cut.triangles())
      triangles_.push_back({number[t[0]], number[t[1]], number[t[2]]});
  }

  start_.push_back(0);
  for (const auto &row : rows) {
    entries_.insert(entries_.end(), row.begin(), row.end());
    start_.push_back(entries_.size());
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
  shifts_.assign(num_masses_, Eigen::Vector3d::Zero());
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
