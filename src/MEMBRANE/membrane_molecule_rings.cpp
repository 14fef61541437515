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

#include "membrane_molecule_rings.h"

#include <algorithm>
#include <cmath>

using namespace Membrane_NS;
using Eigen::Vector3d;

static constexpr int ROUNDS = 10, TRIALS = 300;
static constexpr double SLIDE = 3.0;       // Angstrom
static constexpr int PURPOSE = 9000;       // of random numbers

namespace {

bool goes_through(const Vector3d &from, const Vector3d &to, const Vector3d &a, const Vector3d &b, const Vector3d &c)
{
  const Vector3d normal = (b - a).cross(c - a);
  const double s = (from - a).dot(normal), t = (to - a).dot(normal);
  if ((s > 0.0) == (t > 0.0)) return false;
  const Vector3d x = from + (to - from) * (s / (s - t));
  return (b - a).cross(x - a).dot(normal) > 0.0 && (c - b).cross(x - b).dot(normal) > 0.0 &&
      (a - c).cross(x - c).dot(normal) > 0.0;
}

/// Rings and bonds of all lipids, to be asked about a few.
class Bonds {
 public:
  explicit Bonds(const LipidCrowd &crowd) : crowd_(crowd), near_(crowd.grid())
  {
    double longest = 0.0, widest = 0.0;
    for (const Conformer &conformer : crowd.library().conformers) {
      const LipidSpecies &species = crowd.library().species[conformer.species];
      const auto &bonds = species.terms[BOND];
      for (size_t b = 0; b < bonds.size(); b += 2)
        longest = std::max(longest, (conformer.x[bonds[b]] - conformer.x[bonds[b + 1]]).norm());
      for (const auto &ring : species.rings)
        for (int i : ring) widest = std::max(widest, (conformer.x[i] - conformer.x[ring[0]]).norm());
    }
    for (size_t i = 0; i < crowd.lipids.size(); ++i) {
      const auto &bonds = crowd.species_of(static_cast<int>(i)).terms[BOND];
      for (size_t b = 0; b < bonds.size(); b += 2) {
        owner_.push_back(static_cast<int>(i));
        bond_.push_back(static_cast<int>(b));
        middle_.push_back(0.5 * (crowd.atom(crowd.lipids[i], bonds[b]) + crowd.atom(crowd.lipids[i], bonds[b + 1])));
      }
    }
    near_.fill(middle_, widest + 0.5 * longest + 0.1);
  }

  /// Calls f(lipid) of bonds of others through rings of lipid i, placed anywhere.
  template <class F> void through_rings(int i, const PlacedLipid &lipid, F &&f) const
  {
    for (const auto &ring : crowd_.library().species[crowd_.conformer(lipid).species].rings) {
      std::vector<Vector3d> corner;
      Vector3d centre = Vector3d::Zero();
      for (int k : ring) {
        corner.push_back(crowd_.atom(lipid, k));
        centre += corner.back() / ring.size();
      }
      near_.near(centre, [&](int b, const Vector3d &difference, double) {
        const int other = owner_[b];
        if (other == i) return;
        const auto &bonds = crowd_.species_of(other).terms[BOND];
        const PlacedLipid &by = crowd_.lipids[other];
        const Vector3d half = 0.5 * (crowd_.atom(by, bonds[bond_[b] + 1]) - crowd_.atom(by, bonds[bond_[b]]));
        const Vector3d middle = centre + difference;
        for (size_t k = 0; k < corner.size(); ++k)
          if (goes_through(middle - half, middle + half, centre, corner[k], corner[(k + 1) % corner.size()])) {
            f(other);
            break;
          }
      });
    }
  }

 private:
  const LipidCrowd &crowd_;
  BeadGrid near_;
  std::vector<Vector3d> middle_;
  std::vector<int> owner_, bond_;
};

}    // namespace

/* ---------------------------------------------------------------------- */

std::vector<PiercedRing> Membrane_NS::find_pierced_rings(const LipidCrowd &crowd)
{
  std::vector<PiercedRing> found;
  bool any = false;
  for (const LipidSpecies &species : crowd.library().species) any |= !species.rings.empty();
  if (!any) return found;
  const Bonds bonds(crowd);
  for (size_t i = 0; i < crowd.lipids.size(); ++i)
    bonds.through_rings(static_cast<int>(i), crowd.lipids[i],
                        [&](int other) { found.push_back({static_cast<int>(i), other}); });
  return found;
}

/* ----------------------------------------------------------------------
   The owner of the ring is moved, which no bond of others may go through then, and which may put no bond of its own through
   the rings of others; of the places found the one with the least overlap.
------------------------------------------------------------------------- */

std::vector<PiercedRing> Membrane_NS::free_rings(LipidCrowd &crowd)
{
  std::vector<PiercedRing> pierced = find_pierced_rings(crowd);
  for (int round = 0; round < ROUNDS && !pierced.empty(); ++round) {
    std::vector<int> seen;
    for (const PiercedRing &pair : pierced) {
      if (std::find(seen.begin(), seen.end(), pair.ring_of) != seen.end()) continue;
      seen.push_back(pair.ring_of);
      const int i = round % 2 ? pair.bond_of : pair.ring_of;
      const PlacedLipid before = crowd.lipids[i];
      const auto all = crowd.atoms();
      BeadGrid near = crowd.grid();
      near.fill(all.x, crowd.largest_soft());
      const Bonds bonds(crowd);
      const CounterRandom random = crowd.random(PURPOSE + round);
      const ParallelPlace home = crowd.site_of(before);
      const auto &like = crowd.library().by_species[crowd.conformer(before).species];
      double best = INFINITY;
      PlacedLipid chosen = before;
      for (int t = 0; t < TRIALS; ++t) {
        const auto a = random.uniforms(i, 4 * t), b = random.uniforms(i, 4 * t + 1), c = random.uniforms(i, 4 * t + 2);
        const Vector3d step = SLIDE * Vector3d(2.0 * a[0] - 1.0, 2.0 * a[1] - 1.0, 2.0 * b[0] - 1.0);
        const ParallelPlace place = crowd.parts()[before.part].project(
            home.x + step, home.point, sign_of(before.leaflet) * crowd.neutral(before.leaflet));
        const Vector3d along = Eigen::AngleAxisd(2.0 * M_PI * c[0], place.normal) * (before.turn * Vector3d::UnitX());
        const int conformer = like[std::min<size_t>(static_cast<size_t>(c[1] * like.size()), like.size() - 1)];
        const PlacedLipid trial = crowd.stand(place, along, conformer, before.leaflet, before.part);
        double energy = 0.0;
        const auto &kinds = crowd.species_of(i).kinds;
        for (size_t k = 0; k < kinds.size(); ++k)
          near.near(crowd.atom(trial, static_cast<int>(k)), [&](int j, const Vector3d &, double d2) {
            const double reach = crowd.soft(kinds[k], all.kind[j]);
            if (all.owner[j] == i || d2 >= reach * reach) return;
            const double w = 1.0 - std::sqrt(d2) / reach;
            energy += w * w;
          });
        if (energy >= best) continue;
        bool through = false;
        bonds.through_rings(i, trial, [&](int) { through = true; });
        if (through) continue;
        crowd.lipids[i] = trial;
        const Bonds own(crowd);
        for (const PiercedRing &other : pierced) {
          const int owner = other.ring_of == i ? other.bond_of : other.ring_of;
          own.through_rings(owner, crowd.lipids[owner], [&](int by) { through |= by == i; });
        }
        crowd.lipids[i] = before;
        if (through) continue;
        best = energy;
        chosen = trial;
      }
      crowd.lipids[i] = chosen;
    }
    pierced = find_pierced_rings(crowd);
  }
  return pierced;
}
