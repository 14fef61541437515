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

#include "membrane_helfrich.h"

#include "membrane_helfrich_point.h"

#include <algorithm>
#include <type_traits>

using namespace Membrane_NS;

// beyond MOST_VALENCE graded rules have thousands of points and their derivative rows overflow

namespace {

// control points of a regular face, of faces with one corner of valence 5 or 7, with two, and of those with one of 9 or 10
constexpr int REGULAR = 12, FIVE = 11, SEVEN = 13, TWO_FIVES = 10, TWO_SEVENS = 14, NINE = 15, TEN = 16;
constexpr int THREEFOLD = -1;

// === All rules: rows times control points

template <int SIZE, class Integrals>
void integrate_block(const PatchRule &rule, const Lane3 *x, Integrals &sum)
{
  const int size = SIZE ? SIZE : rule.size;
  for (int q = 0; q < rule.npoints; ++q) {
    LaneJet at;
    at.u = combine(rule.row(q, LimitBasis::DU), x, size);
    at.v = combine(rule.row(q, LimitBasis::DV), x, size);
    if (Integrals::HAS_PLACE) at.r = combine(rule.row(q, LimitBasis::VALUE), x, size);
    if (Integrals::HAS_CURVATURE) {
      at.uu = combine(rule.row(q, LimitBasis::DUU), x, size);
      at.uv = combine(rule.row(q, LimitBasis::DUV), x, size);
      at.vv = combine(rule.row(q, LimitBasis::DVV), x, size);
    }
    sum.add(at, rule.weight[q], rule.area_weight[q]);
  }
}

/* ----------------------------------------------------------------------
   g: the gradient with respect to the control points. A few points at a time, first all their jets, then all their
   energies: the square roots and divisions of one point do not wait for those of another.
------------------------------------------------------------------------- */

constexpr int AT_A_TIME = 3;

template <int SIZE, class Energies>
void force_block(const PatchRule &rule, const Lane3 *x, Energies &energies, Lane3 *g)
{
  const int size = SIZE ? SIZE : rule.size;
  LaneJet at[AT_A_TIME];
  LaneGradient by[AT_A_TIME];
  for (int k = 0; k < size; ++k) g[k] = Lane3{};
  for (int first = 0; first < rule.npoints; first += AT_A_TIME) {
    const int count = std::min(AT_A_TIME, rule.npoints - first);
    for (int n = 0; n < count; ++n) {
      const double *w = rule.row(first + n, 0);
      const double *wu = w + LimitBasis::DU * size, *wv = w + LimitBasis::DV * size;
      const double *wuu = w + LimitBasis::DUU * size, *wuv = w + LimitBasis::DUV * size;
      const double *wvv = w + LimitBasis::DVV * size;

      // in two loops, whose sums fit into 16 vector registers

      Lane3 r{}, u{}, v{}, uu{}, uv{}, vv{};
      for (int k = 0; k < size; ++k) {
        const Lane3 p = x[k];
        if (Energies::HAS_PLACE) r += w[k] * p;
        u += wu[k] * p;
        v += wv[k] * p;
      }
      if (Energies::HAS_PLACE) at[n].r = r;
      at[n].u = u;
      at[n].v = v;
      for (int k = 0; k < size; ++k) {
        const Lane3 p = x[k];
        uu += wuu[k] * p;
        uv += wuv[k] * p;
        vv += wvv[k] * p;
      }
      at[n].uu = uu;
      at[n].uv = uv;
      at[n].vv = vv;
    }
    for (int n = 0; n < count; ++n) find_normal(at[n], by[n]);
    for (int n = 0; n < count; ++n)
      energies.add(at[n], rule.weight[first + n], rule.area_weight[first + n], by[n]);
    for (int n = 0; n < count; ++n) {
      const double *w = rule.row(first + n, 0);
      const double *wu = w + LimitBasis::DU * size, *wv = w + LimitBasis::DV * size;
      const double *wuu = w + LimitBasis::DUU * size, *wuv = w + LimitBasis::DUV * size;
      const double *wvv = w + LimitBasis::DVV * size;
      const LaneGradient &e = by[n];
      for (int k = 0; k < size; ++k) {
        Lane along = wuu[k] * e.uu + wuv[k] * e.uv + wvv[k] * e.vv;
        if (Energies::HAS_PLACE) along += w[k] * e.r;
        Lane3 sum = g[k];
        sum += wu[k] * e.u;
        sum += wv[k] * e.v;
        sum += along * e.a;
        g[k] = sum;
      }
    }
  }
}

// === Threefold rules: see ThreefoldPoint

using Threefold::next, Threefold::prev;

/// The combinations of control points that rows are made of, by axis; or gradients with respect to them.
struct Combinations {
  Lane3 even[3][4], odd[3][4], sum[4];

  explicit Combinations(const Lane3 *x)
  {
    for (int i = 0; i < 3; ++i) {
      even[i][0] = x[Threefold::corner(i)];
      even[i][1] = x[Threefold::across(i)];
      even[i][2] = x[Threefold::p(i)] + x[Threefold::q(i)];
      odd[i][3] = x[Threefold::p(i)] - x[Threefold::q(i)];
    }
    for (int t = 0; t < 3; ++t) {
      sum[t] = even[0][t] + even[1][t] + even[2][t];
      for (int i = 0; i < 3; ++i) odd[i][t] = even[next(i)][t] - even[prev(i)][t];
    }
    sum[3] = odd[0][3] + odd[1][3] + odd[2][3];
    for (int i = 0; i < 3; ++i) even[i][3] = odd[next(i)][3] - odd[prev(i)][3];
  }

  Combinations() {}

  /// Of a gradient: that with respect to the control points.
  void to_points(Lane3 *g) const
  {
    for (int i = 0; i < 3; ++i) {
      Lane3 total[4];
      for (int t = 0; t < 3; ++t) total[t] = even[i][t] + sum[t] + odd[prev(i)][t] - odd[next(i)][t];
      total[3] = odd[i][3] + sum[3] + even[prev(i)][3] - even[next(i)][3];
      g[Threefold::corner(i)] = total[0];
      g[Threefold::across(i)] = total[1];
      g[Threefold::p(i)] = total[2] + total[3];
      g[Threefold::q(i)] = total[2] - total[3];
    }
  }
};

// what the sums over axes add to the rows of all three points

template <bool PLACE, bool CURVATURE> inline void add_sums(const ThreefoldPoint &point, const Combinations &c, LaneJet &at)
{
  using P = ThreefoldPoint;
  Lane3 r{}, u{}, uu{}, vv{};
  for (int t = 0; t < 3; ++t) {
    const Lane3 p = c.sum[t];
    if (PLACE) r += point.even_sum[t][P::VALUE] * p;
    u += point.even_sum[t][P::DA] * p;
    if (!CURVATURE) continue;
    uu += point.even_sum[t][P::DAA] * p;
    vv += point.even_sum[t][P::DBB] * p;
  }
  at.u = u;
  at.v = point.odd_sum[P::DB] * c.sum[3];
  if (PLACE) at.r = r;
  if (!CURVATURE) return;
  at.uu = uu;
  at.vv = vv;
  at.uv = point.odd_sum[P::DAB] * c.sum[3];
}

template <bool PLACE, bool CURVATURE>
inline void find_jet(const ThreefoldPoint &point, const Combinations &c, int axis, const LaneJet &sums, LaneJet &at)
{
  using P = ThreefoldPoint;
  Lane3 r, u = sums.u, uu, vv;
  if (PLACE) r = sums.r;
  if (CURVATURE) uu = sums.uu, vv = sums.vv;
  for (int t = 0; t < 4; ++t) {
    const Lane3 p = c.even[axis][t];
    if (PLACE) r += point.even[t][P::VALUE] * p;
    u += point.even[t][P::DA] * p;
    if (!CURVATURE) continue;
    uu += point.even[t][P::DAA] * p;
    vv += point.even[t][P::DBB] * p;
  }
  if (PLACE) at.r = r;
  at.u = u;
  if (CURVATURE) at.uu = uu, at.vv = vv;
  Lane3 v = sums.v, uv;
  if (CURVATURE) uv = sums.uv;
  for (int t = 0; t < 4; ++t) {
    const Lane3 p = c.odd[axis][t];
    v += point.odd[t][P::DB] * p;
    if (CURVATURE) uv += point.odd[t][P::DAB] * p;
  }
  at.v = v;
  if (CURVATURE) at.uv = uv;
}

template <class Integrals>
void integrate_threefold(const PatchRule &rule, const Lane3 *x, Integrals &sum)
{
  constexpr bool PLACE = Integrals::HAS_PLACE, CURVATURE = Integrals::HAS_CURVATURE;
  const Combinations c(x);
  LaneJet sums, at;
  for (const ThreefoldPoint &point : rule.threefold) {
    add_sums<PLACE, CURVATURE>(point, c, sums);
    for (int i = 0; i < 3; ++i) {
      find_jet<PLACE, CURVATURE>(point, c, i, sums, at);
      sum.add(at, point.weight, point.area_weight);
    }
  }
}

// what a gradient at the three points is for the combinations: theirs, or added to it

template <bool PLACE, bool FIRST>
inline void spread(const ThreefoldPoint &point, const LaneGradient (&by)[3], Combinations &c)
{
  using P = ThreefoldPoint;
  for (int i = 0; i < 3; ++i) {
    const LaneGradient &e = by[i];
    for (int t = 0; t < 4; ++t) {
      Lane along = point.even[t][P::DAA] * e.uu + point.even[t][P::DBB] * e.vv;
      if (PLACE) along += point.even[t][P::VALUE] * e.r;
      Lane3 even = along * e.a;
      even += point.even[t][P::DA] * e.u;
      if (!FIRST) even += c.even[i][t];
      c.even[i][t] = even;
    }
    const Lane3 along = e.uv * e.a;
    for (int t = 0; t < 4; ++t) {
      Lane3 odd = point.odd[t][P::DB] * e.v;
      odd += point.odd[t][P::DAB] * along;
      if (!FIRST) odd += c.odd[i][t];
      c.odd[i][t] = odd;
    }
  }
  for (int t = 0; t < 3; ++t) {
    Lane3 sum = point.even_sum[t][P::DA] * (by[0].u + by[1].u + by[2].u);
    for (int i = 0; i < 3; ++i) {
      Lane along = point.even_sum[t][P::DAA] * by[i].uu + point.even_sum[t][P::DBB] * by[i].vv;
      if (PLACE) along += point.even_sum[t][P::VALUE] * by[i].r;
      sum += along * by[i].a;
    }
    if (!FIRST) sum += c.sum[t];
    c.sum[t] = sum;
  }
  Lane3 sum = point.odd_sum[P::DB] * (by[0].v + by[1].v + by[2].v);
  sum += point.odd_sum[P::DAB] * (by[0].uv * by[0].a + by[1].uv * by[1].a + by[2].uv * by[2].a);
  if (!FIRST) sum += c.sum[3];
  c.sum[3] = sum;
}

template <class Energies>
void force_threefold(const PatchRule &rule, const Lane3 *x, Energies &energies, Lane3 *g)
{
  constexpr bool PLACE = Energies::HAS_PLACE;
  const Combinations c(x);
  Combinations by_c;
  LaneJet at[3], sums;
  LaneGradient by[3];
  bool first = true;
  for (const ThreefoldPoint &point : rule.threefold) {
    add_sums<PLACE, true>(point, c, sums);
    for (int i = 0; i < 3; ++i) find_jet<PLACE, true>(point, c, i, sums, at[i]);
    for (int i = 0; i < 3; ++i) find_normal(at[i], by[i]);
    for (int i = 0; i < 3; ++i) energies.add(at[i], point.weight, point.area_weight, by[i]);
    if (first)
      spread<PLACE, true>(point, by, by_c);
    else
      spread<PLACE, false>(point, by, by_c);
    first = false;
  }
  by_c.to_points(g);
}

// the compiler unrolls loops over frequent numbers of control points; 0 is any
template <class Choose> auto with_size(const PatchRule &rule, const Choose &choose)
{
  if (!rule.threefold.empty()) return choose(std::integral_constant<int, THREEFOLD>());
  switch (rule.size) {
    case REGULAR: return choose(std::integral_constant<int, REGULAR>());
    case FIVE: return choose(std::integral_constant<int, FIVE>());
    case SEVEN: return choose(std::integral_constant<int, SEVEN>());
    case TWO_FIVES: return choose(std::integral_constant<int, TWO_FIVES>());
    case TWO_SEVENS: return choose(std::integral_constant<int, TWO_SEVENS>());
    case NINE: return choose(std::integral_constant<int, NINE>());
    case TEN: return choose(std::integral_constant<int, TEN>());
    default: return choose(std::integral_constant<int, 0>());
  }
}

// choose the instance once per group, not in the loop
template <class Choose> auto with_flag(bool flag, const Choose &choose)
{
  return flag ? choose(std::true_type()) : choose(std::false_type());
}

template <int SIZE, class Integrals>
void integrate(const PatchRule &rule, const Lane3 *x, const FaceModel &model, const Slots &slots, BlockIntegrals &out)
{
  Integrals sum(model, slots);    // and not `out`: sums stay in registers
  if constexpr (SIZE == THREEFOLD)
    integrate_threefold(rule, x, sum);
  else
    integrate_block<SIZE>(rule, x, sum);
  out = sum;
}

template <int SIZE, class Energies>
void evaluate(const PatchRule &rule, const Lane3 *x, const FaceModel &model, const Slots &slots, Lane3 *g,
              BlockEnergies &out)
{
  Energies sum(model, slots);
  if constexpr (SIZE == THREEFOLD)
    force_threefold(rule, x, sum, g);
  else
    force_block<SIZE>(rule, x, sum, g);
  out = sum;
}

auto choose_integrate(const PatchRule &rule, bool volume, bool curvature)
{
  return with_size(rule, [&](auto n) {
    return with_flag(volume, [&](auto v) {
      return with_flag(curvature, [](auto c) {
        return integrate<decltype(n)::value, PointIntegrals<decltype(v)::value, decltype(c)::value>>;
      });
    });
  });
}

auto choose_evaluate(const PatchRule &rule, const FaceTerms &terms)
{
  return with_size(rule, [&](auto n) {
    return with_flag(terms.leaflets, [&](auto l) {
      return with_flag(terms.gauss, [&](auto g) {
        return with_flag(terms.volume, [&](auto v) {
          return with_flag(terms.moment, [](auto m) {
            constexpr bool leaflets = decltype(l)::value, gauss = leaflets || decltype(g)::value;
            return evaluate<decltype(n)::value, PointEnergies<gauss, decltype(v)::value, decltype(m)::value, leaflets>>;
          });
        });
      });
    });
  });
}

// === One number of each face for its slot, or its share for that of the face that it is a part of

struct Results {
  Slots slots;
  int count;    // of faces

  // numbers of an array for each slot, of which lanes are one
  void put(const Lane &lanes, std::vector<double> &array, int width = 1, int which = 0) const
  {
    if (array.empty()) return;
    if (!slots.of && width == 1) return store(array, slots.first, lanes);
    for (int l = 0; l < count; ++l) {
      const int slot = slots.first + l;
      if (slots.of)
        array[(size_t) width * slots.of[slot] + which] += lanes[l];
      else
        array[(size_t) width * slot + which] = lanes[l];
    }
  }
  void put(const Lane3 &lanes, std::vector<double> &array) const
  {
    put(lanes.x, array, 3, 0);
    put(lanes.y, array, 3, 1);
    put(lanes.z, array, 3, 2);
  }
};

void clear(const FaceGroup &group, std::vector<double> &array, int width = 1)
{
  if (array.empty()) return;
  const auto first = array.begin() + (size_t) width * (group.first_slot + group.nwhole() * LANES);
  std::fill(first, first + (size_t) width * LANES, 0.0);
}

// parts: null, or by slot of the group the slot of the face

void integrate_group(const FaceGroup &group, const int *parts, const double (*x)[3], const FaceModel &model, FaceIntegrals &out)
{
  const PatchRule &rule = *group.rule;
  const bool volume = !out.volume.empty(), curved = !out.curvature.empty() || !out.bending.empty();
  const auto integrate_these = choose_integrate(rule, volume, curved);

  Lane3 p[MOST_STENCIL];
  BlockIntegrals sum;
  for (int block = 0; block < group.nwhole(); ++block) {
    const Slots slots = {group.first_slot + block * LANES, parts};
    gather(&group.points[(size_t) block * rule.size * LANES], rule.size, x, p);
    integrate_these(rule, p, model, slots, sum);
    const Results results = {slots, std::min(LANES, group.nfaces - block * LANES)};
    results.put(sum.area, out.area);
    results.put(sum.curvature, out.curvature);
    results.put(sum.curved_area, out.curved_area);
    results.put(sum.bending, out.bending);
    results.put(sum.volume, out.volume);
    results.put(sum.vector_area, out.vector_area);
  }
}

void force_group(const FaceGroup &group, const int *parts, const double (*x)[3], const FaceModel &model,
                 const FaceTerms &terms, double (*f)[3], FaceEnergies &out)
{
  const PatchRule &rule = *group.rule;
  const auto evaluate_these = choose_evaluate(rule, terms);

  Lane3 p[MOST_STENCIL], g[MOST_STENCIL];
  BlockEnergies sum;
  for (int block = 0; block < group.nwhole(); ++block) {
    const Slots slots = {group.first_slot + block * LANES, parts};
    const int *points = &group.points[(size_t) block * rule.size * LANES];
    gather(points, rule.size, x, p);
    evaluate_these(rule, p, model, slots, g, sum);

    const Results results = {slots, std::min(LANES, group.nfaces - block * LANES)};
    results.put(sum.bending, out.bending);
    results.put(sum.gauss, out.gauss);
    results.put(sum.area, out.area);
    results.put(sum.bend, out.leaflet_bend);
    if (!out.virial.empty()) {
      const Lane3 origin = terms.volume ? slots.place(model.origin) : p[0];
      Lane v[6] = {};
      for (int k = 0; k < rule.size; ++k) add_virial(p[k] - origin, g[k], v);
      for (int i = 0; i < 6; ++i) results.put(v[i], out.virial, 6, i);
    }

    subtract(points, rule.size, results.count, g, f);
  }
}

}    // namespace

/* ---------------------------------------------------------------------- */

void Membrane_NS::face_integrals(FaceGroups &groups, const double (*x)[3], const FaceModel &model, FaceIntegrals &out)
{
  for (const FaceGroup &group : groups) {
    integrate_group(group, nullptr, x, model, out);
    if (group.nwhole() == group.nblocks()) continue;
    for (auto *array : {&out.area, &out.volume, &out.curvature, &out.curved_area, &out.bending}) clear(group, *array);
    clear(group, out.vector_area, 3);
  }
  FaceQuarters &quarters = groups.quarters;
  if (quarters.groups().empty()) return;
  quarters.place(groups, x);
  for (const FaceGroup &group : quarters.groups()) integrate_group(group, quarters.faces().data(), quarters.x(), model, out);
}

/* ---------------------------------------------------------------------- */

void Membrane_NS::face_forces(FaceGroups &groups, const double (*x)[3], const FaceModel &model, const FaceTerms &terms,
                              double (*f)[3], FaceEnergies &out)
{
  const bool lacks_area = !out.leaflet_bend.empty() && out.area.empty();    // which means over faces need
  if (lacks_area) out.area.resize(out.leaflet_bend.size());
  for (const FaceGroup &group : groups) {
    force_group(group, nullptr, x, model, terms, f, out);
    if (group.nwhole() == group.nblocks()) continue;
    for (auto *array : {&out.bending, &out.gauss, &out.area, &out.leaflet_bend}) clear(group, *array);
    clear(group, out.virial, 6);
  }
  FaceQuarters &quarters = groups.quarters;
  if (!quarters.groups().empty()) {
    quarters.place(groups, x);
    for (const FaceGroup &group : quarters.groups())
      force_group(group, quarters.faces().data(), quarters.x(), model, terms, quarters.f(), out);
    quarters.pull(groups, f);
  }
  if (out.leaflet_bend.empty()) return;
  for (const FaceGroup &group : groups)
    for (int slot = group.first_slot; slot < group.first_slot + group.nfaces; ++slot) out.leaflet_bend[slot] /= out.area[slot];
  if (lacks_area) out.area.clear();
}
