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

#include "membrane_lipid_exchange.h"

#include "scene.h"

#include <gtest/gtest.h>

#include <iostream>
#include <numeric>
#include <tuple>

using namespace Membrane_TEST;

namespace {

// === Numbers

// swaps are drawn with these, and must not depend on how many are drawn at once

TEST(RandomWords, OfManyLabelsAreThoseOfEach)
{
  const CounterRandom random(4711, 42);
  uint32_t many[4][CounterRandom::MANY];
  for (uint64_t first : {uint64_t(0), uint64_t(1000), (uint64_t(1) << 32) - 5}) {
    random.words(first, many);
    for (int l = 0; l < CounterRandom::MANY; ++l) {
      const auto one = random.words(first + l, 0);
      for (int j = 0; j < 4; ++j) EXPECT_EQ(many[j][l], one[j]) << "label " << first + l;
    }
  }
}

TEST(LipidNumbers, LargestRemaindersKeepTheSumAndGiveTiesToTheFirst)
{
  EXPECT_EQ(largest_remainders({1.0, 1.0, 1.0}, 10), (std::vector<int>{4, 3, 3}));
  EXPECT_EQ(largest_remainders({0.0, 2.6, 1.4}, 4), (std::vector<int>{0, 3, 1}));
  EXPECT_EQ(largest_remainders({0.5, 0.25, 0.25}, 0), (std::vector<int>{0, 0, 0}));
  EXPECT_EQ(largest_remainders({0.0, 0.0}, 0), (std::vector<int>{0, 0}));
}

TEST(LipidNumbers, FillingKeepsNumbersOfKindsOverTheMembraneAndOfFaces)
{
  Random random(1);
  for (int kinds : {1, 2, 5})
    for (double per_face : {0.3, 4.0, 37.2}) {
      std::vector<double> wanted, by_kind(kinds, 0.0);
      for (int f = 0; f < 1000; ++f) {
        const double size = per_face * random.uniform();
        for (int k = 0; k < kinds; ++k) {
          wanted.push_back(size * (k + 1.0) / (0.5 * kinds * (kinds + 1.0)));
          by_kind[k] += wanted.back();
        }
      }
      const std::vector<int> numbers = fill_faces(wanted, kinds);
      double most = 0.0;
      std::vector<int> sums(kinds, 0);
      for (int f = 0; f < 1000; ++f) {
        double size = 0.0;
        int n = 0;
        for (int k = 0; k < kinds; ++k) {
          EXPECT_GE(numbers[f * kinds + k], 0);
          sums[k] += numbers[f * kinds + k];
          n += numbers[f * kinds + k];
          size += wanted[f * kinds + k];
          most = std::max(most, std::fabs(numbers[f * kinds + k] - wanted[f * kinds + k]));
        }
        EXPECT_LE(std::fabs(n - size), 1.0);
      }
      EXPECT_LE(most, 2.5);
      for (int k = 0; k < kinds; ++k) EXPECT_LE(std::fabs(sums[k] - by_kind[k]), 1.0);
    }
}

TEST(LipidNumbers, FillingFollowsPlacesAlsoWhereAFaceAsksForLessThanALipid)
{
  for (double per_face : {0.3, 0.7, 1.0, 2.5}) {
    std::vector<double> wanted;    // 500 faces of one mixture, then 500 of another, a fifth smaller
    for (int f = 0; f < 1000; ++f)
      for (double part : {f < 500 ? 0.25 : 0.0, f < 500 ? 0.75 : 1.0}) wanted.push_back(part * per_face * (f < 500 ? 1.0 : 0.8));
    const std::vector<int> numbers = fill_faces(wanted, 2);
    for (int first = 0; first < 1000; first += 100)
      for (int k = 0; k < 2; ++k) {
        double asked = 0.0;
        int got = 0;
        for (int f = first; f < first + 100; ++f) {
          asked += wanted[2 * f + k];
          got += numbers[2 * f + k];
        }
        EXPECT_NEAR(got, asked, 2.0) << per_face << " lipids a face, kind " << k << ", faces from " << first;
      }
  }
}

// === A small system that can be enumerated: faces in a row

FaceLipids in_order(int nkinds, const std::array<std::vector<int>, 2> &totals, const std::vector<uint8_t> &outer,
                    const std::vector<uint8_t> &inner)
{
  FaceLipids lipids(nkinds, totals);
  for (size_t i = 0; i < outer.size(); ++i) lipids.kind(0, i) = outer[i];
  for (size_t i = 0; i < inner.size(); ++i) lipids.kind(1, i) = inner[i];
  return lipids;
}

std::array<std::vector<double>, 2> no_curvature(int nfaces)
{
  return {std::vector<double>(nfaces, 0.0), std::vector<double>(nfaces, 0.0)};
}

LipidExchange toy(const FaceLipids &lipids)
{
  LipidExchange exchange({{1.0, 0.8}, {1.4, -0.7}, {0.7, 0.1}}, lipids, {{{0, 1}}}, {0, 0}, no_curvature(2));
  exchange.set_bending({bilayer_bending(2.0, 1.0, 0.9), bilayer_bending(2.5, 1.3, -0.6)});
  exchange.set_interaction({0.0, 0.9, 0.4, 0.9, 0.0, -0.5, 0.4, -0.5, 0.3});
  return exchange;
}

// the arrangement as a number, which is the same for orders of lipids in a face that mean nothing

using State = std::vector<int>;
State state_of(const FaceLipids &lipids)
{
  State n(2 * lipids.num_faces() * lipids.num_kinds(), 0);
  for (int l = 0; l < 2; ++l)
    for (int f = 0; f < lipids.num_faces(); ++f)
      lipids.count(l, f, &n[(l * lipids.num_faces() + f) * lipids.num_kinds()]);
  return n;
}

/// Probabilities of all states that permutations within leaflets reach, or of both leaflets.
std::map<State, double> enumerate(const FaceLipids &lipids, bool across, double kT)
{
  std::vector<uint8_t> outer, inner;
  for (int i = 0; i < lipids.size(0); ++i) outer.push_back(lipids.kind(0, i));
  for (int i = 0; i < lipids.size(1); ++i) (across ? outer : inner).push_back(lipids.kind(1, i));
  std::sort(outer.begin(), outer.end());
  std::sort(inner.begin(), inner.end());
  std::map<State, double> weights;
  double sum = 0.0;
  do {    // arrangements of single lipids: equal ones are met equally often
    const auto first = inner;
    do {
      FaceLipids now = lipids;
      for (int i = 0; i < lipids.size(0); ++i) now.kind(0, i) = outer[i];
      for (int i = 0; i < lipids.size(1); ++i) now.kind(1, i) = across ? outer[lipids.size(0) + i] : inner[i];
      const double weight = std::exp(-toy(now).energy() / kT);
      weights[state_of(now)] += weight;
      sum += weight;
    } while (std::next_permutation(inner.begin(), inner.end()));
    inner = first;
  } while (std::next_permutation(outer.begin(), outer.end()));
  for (auto &[state, weight] : weights) weight /= sum;
  return weights;
}

/// Chi-square per degree of freedom, less 1, in its standard deviations; states rarer than 10 go together.
double surprise(const std::map<State, double> &expected, const std::map<State, int> &seen, int samples)
{
  double chi2 = 0.0, rare = 0.0;
  int rare_seen = 0, cells = 0;
  for (const auto &[state, p] : expected) {
    const auto found = seen.find(state);
    const int n = found == seen.end() ? 0 : found->second;
    if (p * samples < 10.0) {
      rare += p * samples;
      rare_seen += n;
      continue;
    }
    chi2 += (n - p * samples) * (n - p * samples) / (p * samples);
    ++cells;
  }
  if (rare >= 1.0) {
    chi2 += (rare_seen - rare) * (rare_seen - rare) / rare;
    ++cells;
  }
  return (chi2 - (cells - 1)) / std::sqrt(2.0 * (cells - 1));
}

enum class Moves { NEIGHBORS, ANYWHERE, LEAFLETS };

void expect_canonical(Moves moves)
{
  const double kT = 0.8;
  LipidExchange exchange = toy(in_order(3, {{{4, 3}, {3, 2}}}, {0, 0, 1, 2, 1, 0, 2}, {0, 1, 2, 1, 0}));
  const auto expected = enumerate(exchange.lipids(), moves == Moves::LEAFLETS, kT);
  std::map<State, int> seen;
  const int samples = 40000, gap = moves == Moves::ANYWHERE ? 60 : 40;
  for (int i = -100; i < samples; ++i) {
    int64_t step = 8 * (i + 100);
    for (int l = 0; l < 2; ++l, ++step)
      if (moves == Moves::ANYWHERE)
        exchange.swap_anywhere(l, gap, kT, CounterRandom(17, step));
      else
        exchange.swap_neighbors(l, gap, {1.0}, kT, CounterRandom(17, step));
    if (moves == Moves::LEAFLETS) exchange.swap_leaflets(gap, {1.0, 0.5}, kT, CounterRandom(17, step));
    if (i >= 0) ++seen[state_of(exchange.lipids())];
  }
  for (const auto &[state, n] : seen) EXPECT_TRUE(expected.count(state));
  EXPECT_GT(expected.size(), 30U);
  std::cout << expected.size() << " states, surprise " << surprise(expected, seen, samples) << "\n";
  EXPECT_LT(std::fabs(surprise(expected, seen, samples)), 4.0);
}

TEST(LipidExchange, NeighborsComeToTheCanonicalDistribution) { expect_canonical(Moves::NEIGHBORS); }
TEST(LipidExchange, SwapsAnywhereComeToTheSame) { expect_canonical(Moves::ANYWHERE); }
TEST(LipidExchange, LeafletsComeToThatOfBothLeaflets) { expect_canonical(Moves::LEAFLETS); }

// === Meshes

std::vector<std::array<double, 3>> cotangents_of(const TriangleMesh &mesh)
{
  std::vector<std::array<double, 3>> cotangents;
  for (const Face &face : mesh.faces) {
    cotangents.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const Vector3d a = mesh.edge(face[(k + 2) % 3], face[k]), b = mesh.edge(face[(k + 2) % 3], face[(k + 1) % 3]);
      cotangents.back()[k] = a.dot(b) / a.cross(b).norm();
    }
  }
  return cotangents;
}

std::vector<double> areas_of(const TriangleMesh &mesh)
{
  std::vector<double> areas;
  for (const Face &face : mesh.faces)
    areas.push_back(0.5 * mesh.edge(face[0], face[1]).cross(mesh.edge(face[0], face[2])).norm());
  return areas;
}

FaceLipids two_kinds(int nfaces, int outer, int inner, double first)
{
  FaceLipids lipids(2, {std::vector<int>(nfaces, outer), std::vector<int>(nfaces, inner)});
  for (int l = 0; l < 2; ++l)
    for (int i = 0; i < lipids.size(l); ++i) lipids.kind(l, i) = i >= first * lipids.size(l);
  return lipids;
}

TriangleMesh flat(int n, double edge)
{
  Matrix3d box = Matrix3d::Identity();
  box(0, 0) = n * edge;
  box(1, 1) = n * edge * std::sqrt(0.75);
  return sheet(n, n, box, 0.5);
}

LipidExchange on_mesh(const TriangleMesh &mesh, std::vector<ExchangedKind> kinds, FaceLipids lipids)
{
  const int nfaces = static_cast<int>(mesh.faces.size());
  return {std::move(kinds), std::move(lipids), face_edges(topology_of(mesh)), std::vector<int>(nfaces, 0),
          no_curvature(nfaces)};
}

/** Faces of a tube beside those of a plane, few lipids with a curvature c of their own: there is a factor of
    exp(kc a c 2H/(2 kT)) more of them for each of the others where the surface has the curvature 2H. */
TEST(LipidExchange, RareLipidsPreferTheTubeByTheirBoltzmannFactor)
{
  const int half = 200, n = 10;
  const double kc = 20.0, H2 = 0.5, area = n * 1.0, c = 0.1, kT = 1.0;
  FaceLipids lipids(2, {std::vector<int>(2 * half, n), std::vector<int>(2 * half, 0)});
  for (int i = 0; i < lipids.size(0); i += 20) lipids.kind(0, i) = 1;
  LipidExchange exchange({{1.0, 0.0}, {1.0, c}}, std::move(lipids), {}, std::vector<int>(2 * half, 0),
                         no_curvature(2 * half));
  std::vector<FaceBending> bending(half, bilayer_bending(kc, area, H2 * area));
  bending.resize(2 * half, bilayer_bending(kc, area, 0.0));
  exchange.set_bending(bending);
  double sum[2][2] = {};
  const int samples = how_many(1000, 10000);
  for (int i = -20; i < samples; ++i) {
    exchange.swap_anywhere(0, 20000, kT, CounterRandom(23, i + 20));
    if (i < 0) continue;
    for (int f = 0; f < 2 * half; ++f) {
      int numbers[2] = {};
      exchange.lipids().count(0, f, numbers);
      for (int k = 0; k < 2; ++k) sum[f < half][k] += numbers[k];
    }
  }
  const double ratio = (sum[1][1] / sum[1][0]) / (sum[0][1] / sum[0][0]), expected = std::exp(kc * c * H2 / (2.0 * kT));
  std::cout << "tube over plane " << ratio << ", expected " << expected << "\n";
  EXPECT_NEAR(ratio / expected, 1.0, 0.02);
}

TEST(LipidExchange, BendingOfTwoLeafletsIsTheirs)
{
  // kc/4 of each neutral surface, less what no lipid changes
  const double kc = 12.0, A[2] = {1.3, 0.8}, M[2] = {0.7, -0.4}, C[2] = {0.3, -0.6};
  LipidExchange exchange({{1.0, C[0]}, {1.0, C[1]}}, in_order(2, {{{1}, {1}}}, {0}, {1}), {}, {0}, no_curvature(1));
  exchange.set_bending({leaflet_bending(kc, {A[0], A[1]}, {M[0], M[1]})});
  double expected = 0.0;
  for (int l = 0; l < 2; ++l) expected += kc / 4.0 * (-2.0 * C[l] * M[l] + C[l] * C[l] * A[l]);
  EXPECT_NEAR(exchange.energy(), expected, 1e-14);
  // kc/2 (2H - c0)^2 with c0 = (C - C')/2
  exchange.set_bending({bilayer_bending(kc, A[0], M[0])});
  const double c0 = 0.5 * (C[0] - C[1]);
  EXPECT_NEAR(exchange.energy(), kc / 2.0 * (-2.0 * c0 * M[0] + c0 * c0 * A[0]), 1e-14);
}

TEST(LipidExchange, KeepsAllNumbersOverTenMillionAttemptsAndTheSumOfItsEnergies)
{
  const TriangleMesh mesh = icosphere(3, 1.0);
  const int nfaces = static_cast<int>(mesh.faces.size());
  LipidExchange exchange = on_mesh(mesh, {{0.5, 1.0}, {0.8, -2.0}}, two_kinds(nfaces, 7, 5, 0.3));
  Random random(5);
  std::vector<FaceBending> bending;
  for (int f = 0; f < nfaces; ++f) bending.push_back(bilayer_bending(20.0, 0.01 * random.uniform(), 0.1 * random.symmetric()));
  exchange.set_bending(bending);
  exchange.set_interaction({0.0, 0.4, 0.4, 0.0});
  std::array<std::vector<int>, 2> sizes;
  const std::vector<int> outer = exchange.lipids().count(0), inner = exchange.lipids().count(1);
  const std::vector<double> weights(exchange.edges().size(), 1.0);

  const double before = exchange.energy();
  double change = 0.0;
  const int64_t attempts = how_many(2'500'000, 100'000);
  for (int l = 0; l < 2; ++l) {
    change += exchange.swap_neighbors(l, attempts, weights, 1.0, CounterRandom(3, l));
    change += exchange.swap_anywhere(l, attempts, 1.0, CounterRandom(3, 2 + l));
  }
  EXPECT_EQ(exchange.lipids().count(0), outer);
  EXPECT_EQ(exchange.lipids().count(1), inner);
  change += exchange.swap_leaflets(1000, std::vector<double>(nfaces, 1.0), 1.0, CounterRandom(3, 4));
  EXPECT_GT(exchange.accepted(), attempts / 2);
  EXPECT_NEAR(exchange.energy() - before, change, 1e-9 * std::fabs(change));
  const std::vector<int> both = {outer[0] + inner[0], outer[1] + inner[1]};
  EXPECT_EQ(exchange.lipids().count(0)[0] + exchange.lipids().count(1)[0], both[0]);
}

TEST(LipidExchange, FacesWithoutLipidsAreOrdinary)
{
  LipidExchange exchange({{1.0, 0.5}, {1.0, -0.5}}, in_order(2, {{{2, 0, 1}, {0, 2, 0}}}, {0, 1, 1}, {1, 0}),
                         {{{0, 1}}, {{1, 2}}, {{2, 0}}}, {0, 0, 0}, {{{0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}}});
  exchange.set_bending(std::vector<FaceBending>(3, bilayer_bending(1.0, 1.0, 1.0)));
  exchange.set_interaction({0.0, 1.0, 1.0, 0.0});
  EXPECT_EQ(exchange.curvature(0, 1), 0.2);
  EXPECT_EQ(exchange.curvature(1, 0), 0.4);
  const double before = exchange.energy();
  double sum = 0.0;
  for (int l = 0; l < 2; ++l) {
    sum += exchange.swap_neighbors(l, 1000, {1.0, 1.0, 1.0}, 1.0, CounterRandom(1, l));
    sum += exchange.swap_anywhere(l, 1000, 1.0, CounterRandom(1, 2 + l));
  }
  sum += exchange.swap_leaflets(1000, {1.0, 1.0, 1.0}, 1.0, CounterRandom(1, 4));
  EXPECT_NEAR(exchange.energy() - before, sum, 1e-10);
}

// === Diffusion

/** Rate of decay of a pattern over D, for ideal mixing, by the mean of the exchange:
    dx_f/dt = sum over edges R (x_g - x_f)/n_f with R = D rho l/d. */
double decay(const TriangleMesh &mesh, const std::vector<double> &lipids, const std::vector<double> &pattern)
{
  const Topology topology = topology_of(mesh);
  const auto edges = face_edges(topology);
  const auto conductances = edge_conductances(topology, cotangents_of(mesh));
  const std::vector<double> areas = areas_of(mesh);
  const double rho = std::accumulate(lipids.begin(), lipids.end(), 0.0) / std::accumulate(areas.begin(), areas.end(), 0.0);
  double above = 0.0, below = 0.0;
  for (size_t e = 0; e < edges.size(); ++e) {
    const double difference = pattern[edges[e].face[0]] - pattern[edges[e].face[1]];
    above += rho * conductances[e] * difference * difference;
  }
  for (size_t f = 0; f < pattern.size(); ++f) below += lipids[f] * pattern[f] * pattern[f];
  return above / below;
}

std::vector<Vector3d> circumcentres(const TriangleMesh &mesh)
{
  std::vector<Vector3d> centres;
  for (const Face &face : mesh.faces) {
    const Vector3d a = mesh.edge(face[0], face[1]), b = mesh.edge(face[0], face[2]), n = a.cross(b);
    centres.push_back(mesh.points[face[0]] +
                      (a.squaredNorm() * b.cross(n) + b.squaredNorm() * n.cross(a)) / (2.0 * n.squaredNorm()));
  }
  return centres;
}

TEST(LipidDiffusion, ModesOfASheetDecayWithD)
{
  for (double stretch : {0.8, 1.0, 1.2}) {    // faces that are not equilateral
    TriangleMesh mesh = flat(32, 0.5);
    mesh.lattice.col(1) *= stretch;
    for (Vector3d &p : mesh.points) p[1] *= stretch;
    const std::vector<double> lipids(mesh.faces.size(), 10.0);
    const auto centres = circumcentres(mesh);
    for (int axis = 0; axis < 2; ++axis) {
      const double k = 2.0 * PI / mesh.lattice(axis, axis);
      std::vector<double> pattern;
      for (const Vector3d &p : centres) pattern.push_back(std::cos(k * p[axis]));
      EXPECT_NEAR(decay(mesh, lipids, pattern) / (k * k), 1.0, 0.01) << stretch << " " << axis;
    }
  }
}

TEST(LipidDiffusion, ModesOfASphereDecayWithD)
{
  const TriangleMesh mesh = icosphere(3, 2.0);
  const std::vector<double> areas = areas_of(mesh);
  std::vector<double> wanted;
  for (double a : areas) wanted.push_back(20.0 * a / areas[0]);
  const std::vector<int> n = fill_faces(wanted, 1);
  const std::vector<double> lipids(n.begin(), n.end());
  std::vector<double> first, second;
  for (const Vector3d &p : circumcentres(mesh)) {
    const double z = p.normalized()[2];
    first.push_back(z);
    second.push_back(1.5 * z * z - 0.5);
  }
  std::cout << "l=1 " << decay(mesh, lipids, first) / (2.0 / 4.0) << " l=2 " << decay(mesh, lipids, second) / (6.0 / 4.0) << "\n";
  EXPECT_NEAR(decay(mesh, lipids, first), 2.0 / 4.0, 0.02 * 2.0 / 4.0);
  EXPECT_NEAR(decay(mesh, lipids, second), 6.0 / 4.0, 0.02 * 6.0 / 4.0);
}

/// How fast the pattern decays in a simulation, in units of D k^2: the logarithm of its amplitude's ratio.
double measured_decay(const TriangleMesh &mesh, const std::vector<double> &pattern, double rate, double amplitude_time)
{
  const int nfaces = static_cast<int>(mesh.faces.size()), n = 40;
  const Topology topology = topology_of(mesh);
  std::vector<double> weights = edge_conductances(topology, cotangents_of(mesh));
  const std::vector<double> areas = areas_of(mesh);
  double area = 0.0, sum = 0.0, most = 0.0;
  for (double a : areas) area += a;
  const double rho = n * nfaces / area, D = 1.0, time = amplitude_time / rate;
  for (double &w : weights) sum += w *= D * rho;
  for (double p : pattern) most = std::max(most, std::fabs(p));

  double before = 0.0, after = 0.0;
  const auto amplitude = [&](const FaceLipids &lipids) {
    double sum = 0.0;
    for (int f = 0; f < nfaces; ++f) {
      int numbers[2] = {0, 0};
      lipids.count(0, f, numbers);
      sum += pattern[f] * (numbers[0] - numbers[1]);
    }
    return sum;
  };
  for (int run = 0; run < how_many(4, 1); ++run) {
    FaceLipids lipids(2, {std::vector<int>(nfaces, n), std::vector<int>(nfaces, 0)});
    for (int f = 0; f < nfaces; ++f)
      for (int i = 0; i < n; ++i) lipids.kind(0, n * f + i) = i >= 0.5 * n * (1.0 + pattern[f] / most);
    before += amplitude(lipids);
    LipidExchange exchange = on_mesh(mesh, {{1.0, 0.0}, {1.0, 0.0}}, lipids);
    const int visits = 50;
    for (int v = 0; v < visits; ++v)
      exchange.swap_neighbors(0, std::llround(sum * time / visits), weights, 1.0, CounterRandom(91 + run, v));
    after += amplitude(exchange.lipids());
  }
  return std::log(before / after) / amplitude_time;
}

TEST(LipidDiffusion, SwapsDecayWithDOnASheetAndOnASphere)
{
  const TriangleMesh plane = flat(12, 1.0), sphere = icosphere(2, 2.0);
  const double k = 2.0 * PI / plane.lattice(0, 0);
  std::vector<double> wave, first;
  for (const Vector3d &p : circumcentres(plane)) wave.push_back(std::cos(k * p[0]));
  for (const Vector3d &p : circumcentres(sphere)) first.push_back(p.normalized()[2]);
  const double on_plane = measured_decay(plane, wave, k * k, 0.7), on_sphere = measured_decay(sphere, first, 2.0 / 4.0, 0.7);
  std::cout << "D measured over D: plane " << on_plane << ", sphere " << on_sphere << "\n";
  EXPECT_NEAR(on_plane, 1.0, 0.05);
  EXPECT_NEAR(on_sphere, 1.0, 0.05);
}

// === Interaction

TEST(LipidInteraction, LineTensionOfAFlatDomainIsItsContactsSummedByHand)
{
  const double w = 1.3, edge = 0.9;
  for (int n : {1, 4, 10}) {
    const TriangleMesh mesh = flat(8, edge);
    const int nfaces = static_cast<int>(mesh.faces.size());
    FaceLipids lipids(2, {std::vector<int>(nfaces, n), std::vector<int>(nfaces, 0)});
    int bonds = 0;    // edges between the two halves, counted on the mesh
    const auto high = [&](int f) {
      double y = 0.0;
      for (int v : mesh.faces[f]) y += mesh.points[mesh.faces[f][0]][1] + mesh.edge(mesh.faces[f][0], v)[1];
      y /= 3.0;
      return std::fmod(y / mesh.lattice(1, 1) + 1.0, 1.0) >= 0.5;
    };
    for (int f = 0; f < nfaces; ++f)
      for (int i = 0; i < n; ++i) lipids.kind(0, n * f + i) = high(f);
    const auto edges = face_edges(topology_of(mesh));
    for (const LipidEdge &e : edges) bonds += high(e.face[0]) != high(e.face[1]);
    EXPECT_EQ(bonds, 2 * 8);
    LipidExchange exchange = on_mesh(mesh, {{1.0, 0.0}, {1.0, 0.0}}, lipids);
    exchange.set_interaction({0.0, w, w, 0.0});
    const double tension = exchange.energy() / (2.0 * mesh.lattice(0, 0)), lipid = std::sqrt(0.75) * edge * edge / 2.0 / n;
    EXPECT_NEAR(exchange.energy(), bonds * std::sqrt(n) * w, 1e-12 * exchange.energy());
    EXPECT_NEAR(tension, w / std::sqrt(4.0 * lipid / std::sqrt(3.0)), 1e-12);    // whatever the mesh
  }
}

TEST(LipidInteraction, ContactsWithinAFaceAreThreeHalvesOfALipidLessThoseAcrossItsEdges)
{
  LipidExchange exchange({{1.0, 0.0}, {1.0, 0.0}}, in_order(2, {{{9}, {0}}}, {0, 0, 0, 0, 1, 1, 1, 1, 1}, {}), {}, {0},
                         no_curvature(1));
  exchange.set_interaction({1.0, 1.0, 1.0, 1.0});
  EXPECT_NEAR(exchange.energy(), 1.5 * (9.0 - 3.0), 1e-12);
  exchange.set_interaction({0.0, 1.0, 1.0, 0.0});
  EXPECT_NEAR(exchange.energy(), 1.5 * (9.0 - 3.0) * 4.0 * 5.0 / 36.0, 1e-12);
}

/// A mean and its standard error, from twelve blocks of a run.
struct Measured {
  double mean, error;
};

Measured of_blocks(const std::vector<double> &samples)
{
  constexpr int BLOCKS = 12;
  const size_t length = samples.size() / BLOCKS;
  std::vector<double> means(BLOCKS);
  for (int b = 0; b < BLOCKS; ++b)
    means[b] = std::accumulate(&samples[b * length], &samples[b * length] + length, 0.0) / length;
  const double mean = std::accumulate(means.begin(), means.end(), 0.0) / BLOCKS;
  double squares = 0.0;
  for (const double m : means) squares += (m - mean) * (m - mean);
  return {mean, std::sqrt(squares / BLOCKS / (BLOCKS - 1))};
}

struct Honeycomb {
  Measured bonds;    // mean of s s' over edges
  Measured waves;    // structure factor of the longest waves
};

/// A sheet with one lipid a face, half of each kind.
Honeycomb honeycomb(double w, int size)
{
  const TriangleMesh mesh = flat(size, 1.0);
  const int nfaces = static_cast<int>(mesh.faces.size());
  FaceLipids lipids = two_kinds(nfaces, 1, 0, 0.5);
  LipidExchange exchange = on_mesh(mesh, {{1.0, 0.0}, {1.0, 0.0}}, lipids);
  exchange.set_interaction({0.0, w, w, 0.0});
  const std::vector<double> weights(exchange.edges().size(), 1.0);
  const auto centres = circumcentres(mesh);
  const int sweeps = how_many(3000, 30000);
  std::vector<double> bonds, waves;
  for (int i = 0; i < sweeps; ++i) {
    exchange.swap_anywhere(0, nfaces, 1.0, CounterRandom(7, 2 * i));
    exchange.swap_neighbors(0, nfaces, weights, 1.0, CounterRandom(7, 2 * i + 1));
    if (i < sweeps / 5) continue;
    const auto spin = [&](int f) { return 1.0 - 2.0 * exchange.lipids().kind(0, f); };
    double sum = 0.0;
    for (const LipidEdge &e : exchange.edges()) sum += spin(e.face[0]) * spin(e.face[1]);
    bonds.push_back(sum / exchange.edges().size());
    sum = 0.0;
    for (int axis = 0; axis < 2; ++axis) {
      double c = 0.0, s = 0.0;
      const double k = 2.0 * PI / mesh.lattice(axis, axis);
      for (int f = 0; f < nfaces; ++f) {
        c += spin(f) * std::cos(k * centres[f][axis]);
        s += spin(f) * std::sin(k * centres[f][axis]);
      }
      sum += (c * c + s * s) / nfaces / 2.0;
    }
    waves.push_back(sum);
  }
  return {of_blocks(bonds), of_blocks(waves)};
}

/** One lipid a face is the Ising model on the honeycomb lattice: w = 2 J, critical at J/kT = ln(2 + sqrt(3))/2
    = 0.658 [G. H. Wannier, Rev. Mod. Phys. 17, 50 (1945)], where neighbours have <s s'> = 4/(3 sqrt(3)). */
TEST(LipidInteraction, TwoKindsSeparateAboveTheCriticalStrengthOfTheHoneycombAndNotBelow)
{
  const double critical = std::log(2.0 + std::sqrt(3.0));
  const auto below = honeycomb(0.8 * critical, 24), small_below = honeycomb(0.8 * critical, 12);
  const auto at = honeycomb(critical, 24), small_at = honeycomb(critical, 12);
  const auto above = honeycomb(1.2 * critical, 24), small_above = honeycomb(1.2 * critical, 12);
  for (const auto &[name, small, large] : {std::tuple{"below", small_below.waves, below.waves},
                                           std::tuple{"above", small_above.waves, above.waves},
                                           std::tuple{"<s s'> at the critical strength", small_at.bonds, at.bonds}})
    std::cout << name << ": " << small.mean << "(" << small.error << ") " << large.mean << "(" << large.error << ")\n";

  // waves do not know the size of the sheet, domains do
  EXPECT_LT(below.waves.mean, 1.5 * small_below.waves.mean + 3.0 * std::hypot(below.waves.error, 1.5 * small_below.waves.error));
  EXPECT_GT(above.waves.mean, 2.5 * small_above.waves.mean);
  // equal numbers of both kinds: the deviation falls with the length of the sheet
  EXPECT_NEAR(2.0 * at.bonds.mean - small_at.bonds.mean, 4.0 / (3.0 * std::sqrt(3.0)),
              0.01 + 3.0 * std::hypot(2.0 * at.bonds.error, small_at.bonds.error));
}

}    // namespace
