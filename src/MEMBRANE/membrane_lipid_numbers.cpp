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

#include "membrane_lipid_numbers.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Membrane_NS {

FaceLipids::FaceLipids(int nkinds, const std::array<std::vector<int>, 2> &totals) : nkinds_(nkinds)
{
  for (int leaflet = 0; leaflet < 2; ++leaflet) {
    auto &start = start_[leaflet];
    for (int n : totals[leaflet]) start.push_back(start.back() + n);
    kinds_[leaflet].assign(start.back(), 0);
  }
}

void FaceLipids::count(int leaflet, int face, int *n) const
{
  for (int i = start_[leaflet][face]; i < start_[leaflet][face + 1]; ++i) ++n[kinds_[leaflet][i]];
}

std::vector<int> FaceLipids::count(int leaflet) const
{
  std::vector<int> n(nkinds_, 0);
  for (uint8_t kind : kinds_[leaflet]) ++n[kind];
  return n;
}

double FaceLipids::memory_usage() const
{
  double bytes = 0.0;
  for (int leaflet = 0; leaflet < 2; ++leaflet)
    bytes += sizeof(int) * start_[leaflet].capacity() + kinds_[leaflet].capacity();
  return bytes;
}

/* ---------------------------------------------------------------------- */

std::vector<int> largest_remainders(const std::vector<double> &weights, int sum)
{
  std::vector<int> shares(weights.size(), 0);
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (sum == 0 || all == 0.0) return shares;
  std::vector<double> remainders(weights.size());
  int left = sum;
  for (size_t i = 0; i < weights.size(); ++i) {
    const double exact = sum * (weights[i] / all);
    shares[i] = std::min(left, static_cast<int>(std::floor(exact)));
    remainders[i] = exact - shares[i];
    left -= shares[i];
  }
  std::vector<int> order(weights.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return remainders[a] > remainders[b]; });
  for (size_t k = 0; left > 0; ++k, --left) ++shares[order[k % order.size()]];
  return shares;
}

// of what kinds are behind by: others are decided by their order, not by rounding, which differs between numbers of ranks
static constexpr double SAME = 1.0e-6;

std::vector<int> fill_faces(const std::vector<double> &wanted, int nkinds)
{
  const size_t nfaces = wanted.size() / nkinds;
  std::vector<double> by_kind(nkinds, 0.0);
  for (size_t i = 0; i < wanted.size(); ++i) by_kind[i % nkinds] += wanted[i];
  const double all = std::accumulate(by_kind.begin(), by_kind.end(), 0.0);
  int undealt = static_cast<int>(std::lround(all));
  std::vector<int> left = largest_remainders(by_kind, undealt);

  std::vector<int> numbers(wanted.size(), 0);
  std::vector<double> behind(nkinds, 0.0);
  double asked = 0.0;
  for (size_t f = 0; f < nfaces; ++f) {
    for (int k = 0; k < nkinds; ++k) {
      behind[k] += wanted[f * nkinds + k];
      asked += wanted[f * nkinds + k];
    }
    for (const int after = static_cast<int>(std::lround(all - asked)); undealt > after; --undealt) {
      int next = -1;
      for (const bool asked_here : {true, false})    // others only where those are used up
        for (int k = 0; k < nkinds && (asked_here || next < 0); ++k)
          if ((wanted[f * nkinds + k] > 0.0) == asked_here && left[k] > 0 && (next < 0 || behind[k] > behind[next] + SAME)) next = k;
      --left[next];
      behind[next] -= 1.0;
      ++numbers[f * nkinds + next];
    }
  }
  return numbers;
}

}    // namespace Membrane_NS
