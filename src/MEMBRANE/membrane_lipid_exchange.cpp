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

#include "membrane_lipid_exchange.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Membrane_NS {

// of an equilateral mesh it is 1.73; beyond this the lipids of two faces mix in no time anyway
static constexpr double LARGEST_CONDUCTANCE = 10.0;

// === Bending

FaceBending bilayer_bending(double kc, double area, double curvature)
{
  FaceBending e;
  e.linear = {-0.5 * kc * curvature, 0.5 * kc * curvature};
  e.quadratic = {0.25 * kc * area, 0.25 * kc * area};
  e.cross = -0.25 * kc * area;
  return e;
}

FaceBending leaflet_bending(double kc, const std::array<double, 2> &area, const std::array<double, 2> &curvature)
{
  FaceBending e;
  e.linear = {-0.5 * kc * curvature[0], -0.5 * kc * curvature[1]};
  e.quadratic = {0.5 * kc * area[0], 0.5 * kc * area[1]};
  return e;
}

// === Random choices

namespace {

/// Index below n, from a word of 32 bits.
int below(int n, uint32_t word)
{
  return static_cast<int>((static_cast<uint64_t>(word) * n) >> 32);
}

/// Draws indices with given weights [A. J. Walker, Electron. Lett. 10, 127 (1974)].
class AliasTable {
 public:
  explicit AliasTable(const std::vector<double> &weights) : entries(weights.size())
  {
    const double mean = std::accumulate(weights.begin(), weights.end(), 0.0) / weights.size();
    std::vector<int> small, large;
    std::vector<double> left(weights.size());
    for (size_t i = 0; i < weights.size(); ++i) {
      left[i] = weights[i] / mean;
      (left[i] < 1.0 ? small : large).push_back(static_cast<int>(i));
      entries[i] = {1.0F, static_cast<int>(i)};
    }
    while (!small.empty() && !large.empty()) {
      const int poor = small.back(), rich = large.back();
      small.pop_back();
      entries[poor] = {static_cast<float>(left[poor]), rich};
      left[rich] -= 1.0 - left[poor];
      if (left[rich] < 1.0) {
        large.pop_back();
        small.push_back(rich);
      }
    }
  }

  int draw(uint32_t word) const
  {
    const uint64_t scaled = static_cast<uint64_t>(word) * entries.size();
    const size_t i = scaled >> 32;
    const float rest = static_cast<float>(static_cast<uint32_t>(scaled)) * 0x1.0p-32F;
    return rest < entries[i].keep ? static_cast<int>(i) : entries[i].other;
  }

 private:
  struct Entry {
    float keep;
    int other;
  };
  std::vector<Entry> entries;
};

}    // namespace

// === Set-up

LipidExchange::LipidExchange(std::vector<ExchangedKind> kinds, FaceLipids lipids, std::vector<LipidEdge> edges,
                             std::vector<int> membrane, std::array<std::vector<double>, 2> empty) :
    kinds_(std::move(kinds)), lipids_(std::move(lipids)), edges_(std::move(edges)), membrane_(std::move(membrane)),
    empty_(std::move(empty)), bending_(lipids_.num_faces())
{
  add_up();
}

void LipidExchange::set_interaction(std::vector<double> w)
{
  w_ = std::move(w);
  const int nkinds = lipids_.num_kinds(), nfaces = lipids_.num_faces();
  around_.assign(nfaces, {-1, -1, -1});
  for (const LipidEdge &edge : edges_)
    for (int side = 0; side < 2; ++side) {
      auto &faces = around_[edge.face[side]];
      *std::find(faces.begin(), faces.end(), -1) = edge.face[1 - side];
    }
  for (int l = 0; l < 2; ++l) {
    numbers_[l].assign(static_cast<size_t>(nfaces) * nkinds, 0);
    contacts_[l].assign(nfaces, {0.0, 0.0, 0.0});
    inside_[l].assign(nfaces, 0.0);
    for (int f = 0; f < nfaces; ++f) {
      lipids_.count(l, f, &numbers_[l][static_cast<size_t>(f) * nkinds]);
      const double n = lipids_.size(l, f);
      if (n == 0.0) continue;
      inside_[l][f] = 3.0 / (n + std::sqrt(n));
      for (int k = 0; k < 3; ++k)
        if (around_[f][k] >= 0)
          if (const double m = lipids_.size(l, around_[f][k]); m > 0.0) contacts_[l][f][k] = std::pow(n * m, -0.75);
    }
  }
}

// sums change by differences during a sweep and are found anew before each, which keeps them exact

void LipidExchange::add_up()
{
  for (int l = 0; l < 2; ++l) {
    sums_[l].resize(lipids_.num_faces());
    for (int f = 0; f < lipids_.num_faces(); ++f) {
      Sums sums{0.0, 0.0, empty_[l][f]};
      for (int i = 0; i < lipids_.size(l, f); ++i) {
        const ExchangedKind &kind = kinds_[lipids_.kind(l, lipids_.first(l, f) + i)];
        sums.area += kind.area;
        sums.curvature += kind.area * kind.curvature;
      }
      if (lipids_.size(l, f) > 0) sums.mean = sums.curvature / sums.area;
      sums_[l][f] = sums;
    }
  }
}

// lipids in the order of their membranes: first_[m] to first_[m + 1] are those of m

void LipidExchange::list_lipids()
{
  const int nmembranes = membrane_.empty() ? 0 : *std::max_element(membrane_.begin(), membrane_.end()) + 1;
  for (int l = 0; l < 2; ++l) {
    face_of_[l].resize(lipids_.size(l));
    first_[l].assign(nmembranes + 1, 0);
    for (int f = 0; f < lipids_.num_faces(); ++f) {
      std::fill_n(face_of_[l].begin() + lipids_.first(l, f), lipids_.size(l, f), f);
      first_[l][membrane_[f] + 1] += lipids_.size(l, f);
    }
    std::partial_sum(first_[l].begin(), first_[l].end(), first_[l].begin());
    std::vector<int> next = first_[l];
    order_[l].resize(lipids_.size(l));
    for (int i = 0; i < lipids_.size(l); ++i) order_[l][next[membrane_[face_of_[l][i]]]++] = i;
  }
}

// === Energies

static double bending_energy(const FaceBending &e, double outer, double inner)
{
  return outer * (e.linear[0] + 0.5 * e.quadratic[0] * outer + e.cross * inner) +
      inner * (e.linear[1] + 0.5 * e.quadratic[1] * inner);
}

double LipidExchange::leaflet_change(int face, double outer, double inner) const
{
  return bending_energy(bending_[face], outer, inner) -
      bending_energy(bending_[face], curvature(0, face), curvature(1, face));
}

static double curvature_after(double area, double curvature, const ExchangedKind &to, const ExchangedKind &from)
{
  return (curvature + to.area * to.curvature - from.area * from.curvature) / (area + to.area - from.area);
}

double LipidExchange::bending_change(const Place &p, const ExchangedKind &to, const ExchangedKind &from) const
{
  const Sums &sums = sums_[p.leaflet][p.face];
  const FaceBending &e = bending_[p.face];
  const double before = sums.mean, other = curvature(1 - p.leaflet, p.face);
  const double after = curvature_after(sums.area, sums.curvature, to, from);
  return (after - before) *
      (e.linear[p.leaflet] + e.cross * other + 0.5 * e.quadratic[p.leaflet] * (after + before));
}

// of one lipid that becomes another while all others stay

double LipidExchange::interaction_change(const Place &p, int to, int from) const
{
  const int nkinds = lipids_.num_kinds();
  const double *w_to = &w_[to * nkinds], *w_from = &w_[from * nkinds];
  const auto field = [&](int face) {
    const int *n = &numbers_[p.leaflet][static_cast<size_t>(face) * nkinds];
    double sum = 0.0;
    for (int k = 0; k < nkinds; ++k) sum += (w_to[k] - w_from[k]) * n[k];
    return sum;
  };
  double change = inside_[p.leaflet][p.face] * (field(p.face) + w_from[from] - w_from[to]);
  for (int k = 0; k < 3; ++k)
    if (around_[p.face][k] >= 0) change += contacts_[p.leaflet][p.face][k] * field(around_[p.face][k]);
  return change;
}

double LipidExchange::energy() const
{
  double energy = 0.0;
  for (int f = 0; f < lipids_.num_faces(); ++f) energy += bending_energy(bending_[f], curvature(0, f), curvature(1, f));
  return energy + interaction_energy();
}

double LipidExchange::interaction_energy() const
{
  double energy = 0.0;
  if (w_.empty()) return energy;
  const int nkinds = lipids_.num_kinds();
  for (int l = 0; l < 2; ++l)
    for (int f = 0; f < lipids_.num_faces(); ++f) {
      const int *n = &numbers_[l][static_cast<size_t>(f) * nkinds];
      for (int a = 0; a < nkinds; ++a)
        for (int b = 0; b < nkinds; ++b) {
          const double w = 0.5 * w_[a * nkinds + b];
          energy += w * inside_[l][f] * n[a] * (n[b] - (a == b));
          for (int k = 0; k < 3; ++k)
            if (around_[f][k] >= 0)
              energy += w * contacts_[l][f][k] * n[a] * numbers_[l][static_cast<size_t>(around_[f][k]) * nkinds + b];
        }
    }
  return energy;
}

// === Attempts

void LipidExchange::move(const Place &p, int to, int from)
{
  lipids_.kind(p.leaflet, p.lipid) = static_cast<uint8_t>(to);
  Sums &sums = sums_[p.leaflet][p.face];
  sums.area += kinds_[to].area - kinds_[from].area;
  sums.curvature += kinds_[to].area * kinds_[to].curvature - kinds_[from].area * kinds_[from].curvature;
  sums.mean = sums.curvature / sums.area;
  if (w_.empty()) return;
  int *n = &numbers_[p.leaflet][static_cast<size_t>(p.face) * lipids_.num_kinds()];
  ++n[to];
  --n[from];
}

bool LipidExchange::attempt(const Place &p, const Place &q, double kT, double random, double &change)
{
  const int a = lipids_.kind(p.leaflet, p.lipid), b = lipids_.kind(q.leaflet, q.lipid);
  if (a == b || (p.face == q.face && p.leaflet == q.leaflet)) return false;
  ++attempted_;

  if (p.face == q.face) {
    const Place &outer = p.leaflet == 0 ? p : q;
    const int was = outer.leaflet == p.leaflet ? a : b, other = a + b - was;
    const Sums &up = sums_[0][p.face], &down = sums_[1][p.face];
    change = leaflet_change(p.face, curvature_after(up.area, up.curvature, kinds_[other], kinds_[was]),
                            curvature_after(down.area, down.curvature, kinds_[was], kinds_[other]));
  } else
    change = bending_change(p, kinds_[b], kinds_[a]) + bending_change(q, kinds_[a], kinds_[b]);

  if (!w_.empty()) {
    change += interaction_change(p, b, a) + interaction_change(q, a, b);
    const int nkinds = lipids_.num_kinds();
    if (p.face != q.face)
      for (int k = 0; k < 3; ++k)    // each saw the other unchanged
        if (around_[p.face][k] == q.face)
          change -= contacts_[p.leaflet][p.face][k] *
              (w_[a * nkinds + a] - 2.0 * w_[a * nkinds + b] + w_[b * nkinds + b]);
  }
  if (change > 0.0 && !(random < std::exp(-change / kT))) return false;
  move(p, b, a);
  move(q, a, b);
  ++accepted_;
  return true;
}

// what an attempt reads, on its way from memory while others are made

void LipidExchange::fetch(const Place &p) const
{
  __builtin_prefetch(&sums_[0][p.face]);
  __builtin_prefetch(&sums_[1][p.face]);
  __builtin_prefetch(&bending_[p.face]);
}

// which lipids are drawn does not depend on what came of earlier attempts: many are drawn at once

template <class Draw>
double LipidExchange::sweep(int64_t attempts, double kT, const CounterRandom &random, const Draw &draw)
{
  add_up();
  double sum = 0.0;
  uint32_t word[4][CounterRandom::MANY];
  std::array<Attempt, CounterRandom::MANY> drawn;
  for (int64_t first = 0; first < attempts; first += CounterRandom::MANY) {
    random.words(first, word);
    const int n = static_cast<int>(std::min<int64_t>(CounterRandom::MANY, attempts - first));
    int count = 0;
    for (int i = 0; i < n; ++i) {
      Attempt &next = drawn[count];
      if (!draw({word[0][i], word[1][i], word[2][i]}, next.p, next.q)) continue;
      next.random = (word[3][i] + 0.5) * 0x1.0p-32;
      fetch(next.p);
      fetch(next.q);
      ++count;
    }
    for (int i = 0; i < count; ++i) {
      double change;
      if (attempt(drawn[i].p, drawn[i].q, kT, drawn[i].random, change)) sum += change;
    }
  }
  add_up();
  return sum;
}

double LipidExchange::swap_neighbors(int leaflet, int64_t attempts, const std::vector<double> &weights, double kT,
                                     const CounterRandom &random)
{
  if (attempts == 0) return 0.0;
  const AliasTable table(weights);
  return sweep(attempts, kT, random, [&](const std::array<uint32_t, 3> &word, Place &p, Place &q) {
    const LipidEdge &edge = edges_[table.draw(word[0])];
    const int n = lipids_.size(leaflet, edge.face[0]), m = lipids_.size(leaflet, edge.face[1]);
    if (n == 0 || m == 0) return false;
    p = {leaflet, edge.face[0], lipids_.first(leaflet, edge.face[0]) + below(n, word[1])};
    q = {leaflet, edge.face[1], lipids_.first(leaflet, edge.face[1]) + below(m, word[2])};
    return true;
  });
}

double LipidExchange::swap_anywhere(int leaflet, int64_t attempts, double kT, const CounterRandom &random)
{
  if (attempts == 0 || lipids_.size(leaflet) == 0) return 0.0;
  if (order_[leaflet].empty()) list_lipids();
  return sweep(attempts, kT, random, [&](const std::array<uint32_t, 3> &word, Place &p, Place &q) {
    const int i = below(lipids_.size(leaflet), word[1]), m = membrane_[face_of_[leaflet][i]];
    const int first = first_[leaflet][m], n = first_[leaflet][m + 1] - first;
    const int j = order_[leaflet][first + below(n, word[2])];
    p = {leaflet, face_of_[leaflet][i], i};
    q = {leaflet, face_of_[leaflet][j], j};
    return true;
  });
}

double LipidExchange::swap_leaflets(int64_t attempts, const std::vector<double> &weights, double kT,
                                    const CounterRandom &random)
{
  if (attempts == 0) return 0.0;
  const AliasTable table(weights);
  return sweep(attempts, kT, random, [&](const std::array<uint32_t, 3> &word, Place &p, Place &q) {
    const int face = table.draw(word[0]), n = lipids_.size(0, face), m = lipids_.size(1, face);
    if (n == 0 || m == 0) return false;
    p = {0, face, lipids_.first(0, face) + below(n, word[1])};
    q = {1, face, lipids_.first(1, face) + below(m, word[2])};
    return true;
  });
}

// === Meshes

std::vector<LipidEdge> face_edges(const Topology &topology)
{
  std::vector<LipidEdge> edges;
  for (int f = 0; f < topology.num_faces(); ++f)
    for (int k = 0; k < 3; ++k)
      if (const int g = topology.neighbor(f, k); f < g) edges.push_back({{f, g}});
  return edges;
}

std::vector<double> edge_conductances(const Topology &topology, const std::vector<std::array<double, 3>> &cotangents)
{
  std::vector<double> conductances;
  for (int f = 0; f < topology.num_faces(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int g = topology.neighbor(f, k);
      if (f >= g) continue;
      const int back = Membrane_NS::corner_of(topology.face(g), topology.face(f)[(k + 1) % 3]);
      const double sum = cotangents[f][k] + cotangents[g][back];
      conductances.push_back(2.0 / std::max(sum, 2.0 / LARGEST_CONDUCTANCE));
    }
  return conductances;
}

}    // namespace Membrane_NS
