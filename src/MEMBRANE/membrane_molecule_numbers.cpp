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

// How many lipids of each kind, and which

#include "membrane_molecule_crowd.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

using namespace Membrane_NS;
using Eigen::Vector3d;

static constexpr double LARGEST_HOLE = 30.0;    // Angstrom: holes are not told apart beyond
static constexpr int CANDIDATES = 60;           // for each lipid that is missing
static constexpr int LEAST_CANDIDATES = 3000;
static constexpr int PURPOSE = 500;             // of random numbers

namespace {

using Ranking = std::set<std::pair<double, int>>;

/// Overlap of lipids with each other.
struct Overlap {
  std::vector<double> energy;
  std::vector<std::map<int, double>> with;
};

Overlap overlap_of(const LipidCrowd &crowd)
{
  const auto all = crowd.atoms();
  BeadGrid near = crowd.grid();
  near.fill(all.x, crowd.largest_soft());
  Overlap overlap;
  overlap.energy.assign(crowd.lipids.size(), 0.0);
  overlap.with.resize(crowd.lipids.size());
  for (size_t i = 0; i < all.x.size(); ++i) {
    const int a = all.owner[i];
    if (a < 0) break;
    near.near(all.x[i], [&](int j, const Vector3d &, double d2) {
      const double reach = crowd.soft(all.kind[i], all.kind[j]);
      if (all.owner[j] == a || d2 >= reach * reach) return;
      const double w = 1.0 - std::sqrt(d2) / reach;
      overlap.energy[a] += w * w;
      if (all.owner[j] >= 0) overlap.with[a][all.owner[j]] += w * w;
    });
  }
  return overlap;
}

/* ----------------------------------------------------------------------
   One leaflet of one surface
------------------------------------------------------------------------- */

class LeafletNumbers {
 public:
  LeafletNumbers(LipidCrowd &crowd, int part, int leaflet, const std::vector<int> &wanted, Overlap &overlap,
                 std::vector<char> &alive);
  void fit()
  {
    change_kinds();
    drop();
    fill();
  }

 private:
  LipidCrowd &crowd_;
  const int part_, leaflet_;
  Overlap &overlap_;
  std::vector<char> &alive_;
  std::vector<int> surplus_;                // by species
  std::vector<Ranking> ranking_;            // lipids by overlap, by species
  int species_of(int i) const { return crowd_.conformer_of(i).species; }
  int draw(int species, double random) const;
  int with_most_overlap() const;
  void change_kinds();
  void drop();
  void fill();
};

LeafletNumbers::LeafletNumbers(LipidCrowd &crowd, int part, int leaflet, const std::vector<int> &wanted, Overlap &overlap,
                               std::vector<char> &alive) :
    crowd_(crowd),
    part_(part), leaflet_(leaflet), overlap_(overlap), alive_(alive), surplus_(wanted.size()), ranking_(wanted.size())
{
  for (size_t s = 0; s < wanted.size(); ++s) surplus_[s] = -wanted[s];
  for (size_t i = 0; i < alive.size(); ++i) {
    const PlacedLipid &lipid = crowd.lipids[i];
    if (!alive[i] || lipid.part != part || lipid.leaflet != leaflet) continue;
    const int s = species_of(static_cast<int>(i));
    ++surplus_[s];
    ranking_[s].emplace(overlap.energy[i], static_cast<int>(i));
  }
}

int LeafletNumbers::draw(int species, double random) const
{
  const auto &like = crowd_.library().by_species[species];
  return like[std::min<size_t>(static_cast<size_t>(random * like.size()), like.size() - 1)];
}

// Of the species that have too many; -1: none has

int LeafletNumbers::with_most_overlap() const
{
  std::pair<double, int> most = {-1.0, -1};
  for (size_t s = 0; s < surplus_.size(); ++s)
    if (surplus_[s] > 0 && !ranking_[s].empty()) most = std::max(most, *ranking_[s].rbegin());
  return most.second;
}

void LeafletNumbers::change_kinds()
{
  const CounterRandom random = crowd_.random(PURPOSE + 2 * (2 * part_ + leaflet_));
  for (size_t t = 0; t < surplus_.size(); ++t)
    while (surplus_[t] < 0) {
      const int i = with_most_overlap();
      if (i < 0) return;
      const int s = species_of(i);
      PlacedLipid &lipid = crowd_.lipids[i];
      const auto a = random.uniforms(static_cast<uint64_t>(i), 0);
      const ParallelPlace place = crowd_.site_of(lipid);
      const Vector3d along = Eigen::AngleAxisd(2.0 * M_PI * a[0], place.normal) * (lipid.turn * Vector3d::UnitX());
      lipid = crowd_.stand(place, along, draw(static_cast<int>(t), a[1]), leaflet_, part_);
      ranking_[s].erase({overlap_.energy[i], i});
      ranking_[t].emplace(overlap_.energy[i], i);
      --surplus_[s];
      ++surplus_[t];
    }
}

void LeafletNumbers::drop()
{
  for (int i = with_most_overlap(); i >= 0; i = with_most_overlap()) {
    ranking_[species_of(i)].erase({overlap_.energy[i], i});
    --surplus_[species_of(i)];
    alive_[i] = 0;
    for (const auto &[j, energy] : overlap_.with[i]) {
      const PlacedLipid &other = crowd_.lipids[j];
      auto &ranking = ranking_[species_of(j)];
      const bool ranked = alive_[j] && other.part == part_ && other.leaflet == leaflet_;
      if (ranked) ranking.erase({overlap_.energy[j], j});
      overlap_.energy[j] = std::max(0.0, overlap_.energy[j] - energy);
      if (ranked) ranking.emplace(overlap_.energy[j], j);
    }
  }
}

// The candidate that is furthest from all lipids, again and again

void LeafletNumbers::fill()
{
  std::vector<int> missing;    // species
  for (size_t s = 0; s < surplus_.size(); ++s)
    for (int k = surplus_[s]; k < 0; ++k) missing.push_back(static_cast<int>(s));
  if (missing.empty()) return;

  const CounterRandom random = crowd_.random(PURPOSE + 2 * (2 * part_ + leaflet_) + 1);
  const double height = sign_of(leaflet_) * crowd_.neutral(leaflet_);
  const int number = std::max(LEAST_CANDIDATES, CANDIDATES * static_cast<int>(missing.size()));
  const auto places = crowd_.parts()[part_].random(number, height, random, 0);
  std::vector<Vector3d> occupied(crowd_.fixed().x), x;
  for (size_t i = 0; i < alive_.size(); ++i)
    if (alive_[i] && crowd_.lipids[i].part == part_ && crowd_.lipids[i].leaflet == leaflet_)
      occupied.push_back(crowd_.site_of(crowd_.lipids[i]).x);
  BeadGrid near = crowd_.grid();
  near.fill(occupied, LARGEST_HOLE);
  std::vector<double> room(number, LARGEST_HOLE);
  Ranking ranking;
  for (int c = 0; c < number; ++c) {
    near.near(places[c].x, [&](int, const Vector3d &, double d2) { room[c] = std::min(room[c], std::sqrt(d2)); });
    ranking.emplace(room[c], c);
    x.push_back(places[c].x);
  }
  near.fill(x, LARGEST_HOLE);
  for (size_t k = 0; k < missing.size(); ++k) {
    const int best = ranking.rbegin()->second;
    const auto a = random.uniforms(k, 1);
    const Vector3d normal = places[best].normal;
    const Vector3d axis = std::fabs(normal[0]) < 0.6 ? Vector3d::UnitX() : Vector3d::UnitY();
    const Vector3d along = Eigen::AngleAxisd(2.0 * M_PI * a[0], normal) * (axis - normal * normal.dot(axis)).normalized();
    crowd_.lipids.push_back(crowd_.stand(places[best], along, draw(missing[k], a[1]), leaflet_, part_));
    near.near(x[best], [&](int c, const Vector3d &, double d2) {
      if (d2 >= room[c] * room[c]) return;
      ranking.erase({room[c], c});
      room[c] = std::sqrt(d2);
      ranking.emplace(room[c], c);
    });
  }
}

}    // namespace

/* ---------------------------------------------------------------------- */

std::array<int, LEAFLETS> Membrane_NS::fit_numbers(LipidCrowd &crowd,
                                                   std::vector<std::array<std::vector<int>, LEAFLETS>> wanted)
{
  std::array<int, LEAFLETS> displaced = {0, 0};
  std::vector<char> alive(crowd.lipids.size(), 1);
  if (!crowd.fixed().x.empty()) {
    const auto all = crowd.atoms();
    BeadGrid near = crowd.grid();
    near.fill(crowd.fixed().x, crowd.largest_soft());
    for (size_t i = 0; i < all.x.size() && all.owner[i] >= 0; ++i)
      near.near(all.x[i], [&](int j, const Vector3d &, double d2) {
        const double reach = LipidCrowd::CLASH * crowd.library().contacts.closest(all.kind[i], crowd.fixed().kinds[j]);
        if (d2 < reach * reach) alive[all.owner[i]] = 0;
      });
    for (size_t i = 0; i < alive.size(); ++i) {
      const PlacedLipid &lipid = crowd.lipids[i];
      if (alive[i]) continue;
      ++displaced[lipid.leaflet];
      int &number = wanted[lipid.part][lipid.leaflet][crowd.conformer_of(static_cast<int>(i)).species];
      number = std::max(0, number - 1);
    }
  }
  Overlap overlap = overlap_of(crowd);
  for (size_t i = 0; i < alive.size(); ++i)
    if (!alive[i])
      for (const auto &[j, energy] : overlap.with[i]) overlap.energy[j] = std::max(0.0, overlap.energy[j] - energy);
  for (size_t part = 0; part < wanted.size(); ++part)
    for (int leaflet = 0; leaflet < LEAFLETS; ++leaflet)
      LeafletNumbers(crowd, static_cast<int>(part), leaflet, wanted[part][leaflet], overlap, alive).fit();

  // those that were added come after those that were there

  const std::vector<PlacedLipid> before = std::move(crowd.lipids);
  crowd.lipids.clear();
  for (size_t i = 0; i < before.size(); ++i)
    if (i >= alive.size() || alive[i]) crowd.lipids.push_back(before[i]);
  return displaced;
}
