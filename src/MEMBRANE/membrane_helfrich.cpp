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

#include "membrane_lanes.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

using namespace Membrane_NS;

// beyond MOST_VALENCE graded rules have thousands of points and their derivative rows overflow
static constexpr int MOST_POINTS = 3 * MOST_VALENCE - 6;    // control points of one face

namespace {

// control points of a regular face, of faces with one corner of valence 5 or 7, and with two
constexpr int REGULAR = 12, FIVE = 11, SEVEN = 13, TWO_FIVES = 10, TWO_SEVENS = 14;

// fetch the control points of a block, relative to its first ones
inline void gather(const int *points, int size, const double (*x)[3], Lane3 *out)
{
  for (int k = 0; k < size; ++k)
    for (int l = 0; l < LANES; ++l) {
      const double *p = x[points[k * LANES + l]];
      out[k].x[l] = p[0];
      out[k].y[l] = p[1];
      out[k].z[l] = p[2];
    }
}

/* ----------------------------------------------------------------------
   first pass on one block
------------------------------------------------------------------------- */

struct BlockIntegrals {
  Lane area, volume, curvature, curved_area, bending;
  Lane3 vector_area;
};

template <int SIZE, bool VOLUME, bool CURVATURE>
void integrate_block(const PatchRule &rule, const Lane3 *x, const FaceModel &model, int slot,
                     BlockIntegrals &out)
{
  const int size = SIZE ? SIZE : rule.size;
  const Lane3 origin = VOLUME ? load3(model.origin, slot) : Lane3{};
  const Lane kc = CURVATURE ? load(model.kc, slot) : Lane{};
  const Lane c0 = CURVATURE ? load(model.c0, slot) : Lane{};
  BlockIntegrals sum{};    // not `out`: sums stay in registers
  for (int q = 0; q < rule.npoints; ++q) {
    const double weight = rule.weight[q], area_weight = rule.area_weight[q];
    const Lane3 ru = combine(rule.row(q, LimitBasis::DU), x, size);
    const Lane3 rv = combine(rule.row(q, LimitBasis::DV), x, size);
    const Lane3 a = cross(ru, rv);
    const Lane J = sqrt(dot(a, a));
    sum.area += area_weight * J;
    if (VOLUME) {
      const Lane3 r = combine(rule.row(q, LimitBasis::VALUE), x, size) - origin;
      sum.volume += (area_weight / 3.0) * dot(r, a);
      sum.vector_area += area_weight * a;
    }
    if (CURVATURE) {
      const Lane uu = dot(combine(rule.row(q, LimitBasis::DUU), x, size), a);
      const Lane uv = dot(combine(rule.row(q, LimitBasis::DUV), x, size), a);
      const Lane vv = dot(combine(rule.row(q, LimitBasis::DVV), x, size), a);
      const Lane s = dot(rv, rv) * uu - 2.0 * dot(ru, rv) * uv + dot(ru, ru) * vv;
      const Lane inverse = 1.0 / J, curvature = -s * inverse * inverse * inverse;    // 2H
      const Lane excess = curvature - c0;
      sum.curvature += weight * curvature * J;
      sum.curved_area += weight * J;
      sum.bending += (0.5 * weight) * kc * excess * excess * J;
    }
  }
  out = sum;
}

/* ----------------------------------------------------------------------
   energy of the leaflets of a block, per area of the mid-plane, with the areas A = 1 +- 2H D + K D^2 and integrated
   curvatures n = 2H +- 2 K D of parallel surfaces and the curvature m each wants:
     kc/4 sum [n^2/A - 2 m n + m^2 A],   n^2/A = (2H)^2 + w (n^2/A - (2H)^2).
   w is 1 but where a radius of curvature nears D, as next to control points of irregular valence, and 0 before A is:
   there it falls with x = D^2 (k1^2 + k2^2) = D^2 ((2H)^2 - 2 K) as 1 - t^3 (10 - 15 t + 6 t^2)
------------------------------------------------------------------------- */

class Leaflets {
 public:
  Leaflets() = default;
  Leaflets(const FaceModel &model, int slot) :
      quarter(0.25 * load(model.kc, slot)), D(load(model.leaflet, slot)), outer(load(model.outer, slot)),
      inner(load(model.inner, slot))
  {
  }

  struct Density {
    Lane value, by_curvature, by_gaussian;
    Lane bend;    // x
  };
  Density at(const Lane &curvature, const Lane &K) const
  {
    const Lane KD = K * D, hD = curvature * D, sum = 1.0 + KD * D, square = curvature * curvature;

    // of A no less than where w is 0

    Lane up = sum + hD, down = sum - hD;
    const Lane grown = up, shrunk = down;
    up = up < LEAST_AREA ? Lane{} + LEAST_AREA : up;
    down = down < LEAST_AREA ? Lane{} + LEAST_AREA : down;
    const Lane inverse = 1.0 / (up * down);
    const Lane n_up = curvature + 2.0 * KD, n_down = curvature - 2.0 * KD;
    const Lane above = n_up * down * inverse, below = n_down * up * inverse;    // 2H of the leaflets

    Density e;
    e.bend = D * (hD * curvature - 2.0 * KD);
    Lane t = (e.bend - LEAFLETS_EXACT) * (1.0 / (LEAFLETS_THIN - LEAFLETS_EXACT));
    t = t < 0.0 ? Lane{} : t;
    t = t > 1.0 ? Lane{} + 1.0 : t;
    const Lane w = 1.0 - t * t * t * (10.0 - t * (15.0 - 6.0 * t));
    const Lane more = n_up * above + n_down * below - 2.0 * square;
    const Lane slope = (-30.0 / (LEAFLETS_THIN - LEAFLETS_EXACT)) * t * t * (1.0 - t) * (1.0 - t) * more * D;    // by x, times D

    e.value = 2.0 * square + w * more - 2.0 * (outer * n_up - inner * n_down) + outer * outer * grown + inner * inner * shrunk;
    e.by_curvature = 4.0 * (1.0 - w) * curvature + w * (above * (2.0 - above * D) + below * (2.0 + below * D)) +
        2.0 * slope * hD - 2.0 * (outer - inner) + D * (outer * outer - inner * inner);
    e.by_gaussian = D * (w * (above * (4.0 - above * D) - below * (4.0 + below * D)) - 2.0 * slope - 4.0 * (outer + inner) +
                         D * (outer * outer + inner * inner));
    e.value *= quarter;
    e.by_curvature *= quarter;
    e.by_gaussian *= quarter;
    return e;
  }

 private:
  static constexpr double LEAST_AREA = 0.1;    // (1 - sqrt(LEAFLETS_THIN)) = 0.106
  Lane quarter, D, outer, inner;
};

struct BlockEnergies {
  Lane bending, gauss, area, bend;    // bend: of leaflets
};

/* ----------------------------------------------------------------------
   second pass on one block: energies, and the gradient g on the control points.

   With a = r_u x r_v, J = |a|, E = r_u.r_u, F = r_u.r_v, G = r_v.r_v and
   B = G r_uu - 2 F r_uv + E r_vv:
     2H = -B.a/J^3,   K J = [(r_uu.a)(r_vv.a) - (r_uv.a)^2]/J^3,
   so the energy density per (u, v) is a function of s = B.a and W = J^2 alone,
     e = kc/2 (2H - c0)^2 J + moment 2H J + tension J,
     de/ds = -[kc (2H - c0) + moment]/W,
     de/dW = kc (2H - c0)/J [(2H - c0)/4 - 3/2 2H] - moment 2H/J + tension/(2 J),
   and the chain rule runs back through B, E, F, G and a to the derivatives of r. The volume is
   (1/3) (r - origin).a. With leaflets, of density e(2H, K), the terms of kc become
     de/ds = -e_2H/W,   de/dW = -3/2 2H e_2H/J + (e - K e_K)/(2 J),
   and e_K comes to kg.
------------------------------------------------------------------------- */

template <int SIZE, bool GAUSS, bool VOLUME, bool MOMENT, bool LEAFLETS>
void force_block(const PatchRule &rule, const Lane3 *x, const FaceModel &model, int slot, Lane3 *g,
                 BlockEnergies &out)
{
  static_assert(GAUSS || !LEAFLETS, "leaflets need the Gaussian curvature");
  const int size = SIZE ? SIZE : rule.size;
  const Lane kc = load(model.kc, slot), c0 = load(model.c0, slot);
  const Leaflets leaflets = LEAFLETS ? Leaflets(model, slot) : Leaflets();
  const Lane tension = load(model.tension, slot);
  const Lane kg = GAUSS ? load(model.kg, slot) : Lane{};
  const Lane pressure = VOLUME ? load(model.pressure, slot) : Lane{};
  const Lane bend = MOMENT ? load(model.moment, slot) : Lane{};
  const Lane3 origin = VOLUME ? load3(model.origin, slot) : Lane3{};

  Lane bending{}, gauss{}, area{}, bent{};
  for (int k = 0; k < size; ++k) g[k] = Lane3{};

  for (int q = 0; q < rule.npoints; ++q) {
    const double weight = rule.weight[q], area_weight = rule.area_weight[q];
    const double *w = rule.row(q, 0);
    const double *wu = w + LimitBasis::DU * size, *wv = w + LimitBasis::DV * size;
    const double *wuu = w + LimitBasis::DUU * size, *wuv = w + LimitBasis::DUV * size;
    const double *wvv = w + LimitBasis::DVV * size;

    // in two loops, whose sums fit into 16 vector registers

    Lane3 r{}, ru{}, rv{}, ruu{}, ruv{}, rvv{};
    for (int k = 0; k < size; ++k) {
      const Lane3 p = x[k];
      if (VOLUME) r += w[k] * p;
      ru += wu[k] * p;
      rv += wv[k] * p;
    }
    for (int k = 0; k < size; ++k) {
      const Lane3 p = x[k];
      ruu += wuu[k] * p;
      ruv += wuv[k] * p;
      rvv += wvv[k] * p;
    }

    const Lane3 a = cross(ru, rv);
    const Lane J = sqrt(dot(a, a)), inverse = 1.0 / J;
    const Lane E = dot(ru, ru), F = dot(ru, rv), G = dot(rv, rv);
    const Lane3 B = G * ruu - 2.0 * F * ruv + E * rvv;
    const Lane curvature = -dot(B, a) * inverse * inverse * inverse;    // 2H
    area += area_weight * J;

    Lane L, M, N, gaussian, kg_here = kg;    // gaussian: K J
    if (GAUSS) {
      L = dot(ruu, a), M = dot(ruv, a), N = dot(rvv, a);
      gaussian = (L * N - M * M) * inverse * inverse * inverse;
      gauss += weight * kg * gaussian;
    }
    Lane moment, e_W;
    if (LEAFLETS) {
      const Lane K = gaussian * inverse;
      const Leaflets::Density e = leaflets.at(curvature, K);
      bent += weight * e.bend * J;
      bending += weight * e.value * J;
      moment = weight * e.by_curvature * inverse;
      e_W = (0.5 * weight) * (e.value - K * e.by_gaussian) * inverse - 1.5 * curvature * moment;
      kg_here += e.by_gaussian;
    } else {
      const Lane excess = curvature - c0;
      bending += (0.5 * weight) * kc * excess * excess * J;
      moment = weight * kc * excess * inverse;
      e_W = moment * (0.25 * excess - 1.5 * curvature);
    }
    e_W += (0.5 * area_weight) * tension * inverse;
    Lane e_s = -moment * inverse;
    if (MOMENT) {
      e_s -= weight * bend * inverse * inverse;
      e_W -= weight * bend * curvature * inverse;
    }

    const Lane3 gB = e_s * a;
    const Lane gE = dot(rvv, gB), gF = -2.0 * dot(ruv, gB), gG = dot(ruu, gB);
    Lane3 guu = G * gB, guv = -2.0 * F * gB, gvv = E * gB;
    Lane3 ga = e_s * B;

    if (GAUSS) {
      const Lane factor = weight * kg_here * inverse * inverse * inverse;
      guu += factor * N * a;
      guv += -2.0 * factor * M * a;
      gvv += factor * L * a;
      ga += factor * (N * ruu - 2.0 * M * ruv + L * rvv);
      e_W += (-1.5 * weight) * kg_here * gaussian * inverse * inverse;
    }

    ga += 2.0 * e_W * a;
    Lane3 gr;
    if (VOLUME) {
      const Lane third = (area_weight / 3.0) * pressure;
      ga += third * (r - origin);
      gr = third * a;
    }
    const Lane3 gu = cross(rv, ga) + 2.0 * gE * ru + gF * rv;
    const Lane3 gv = cross(ga, ru) + 2.0 * gG * rv + gF * ru;

    for (int k = 0; k < size; ++k) {
      Lane3 sum = g[k];
      if (VOLUME) sum += w[k] * gr;
      sum += wu[k] * gu;
      sum += wv[k] * gv;
      sum += wuu[k] * guu;
      sum += wuv[k] * guv;
      sum += wvv[k] * gvv;
      g[k] = sum;
    }
  }
  out = {bending, gauss, area, bent};
}

// the compiler unrolls loops over frequent numbers of control points; 0 is any
template <class Choose> auto with_size(int size, const Choose &choose)
{
  switch (size) {
    case REGULAR: return choose(std::integral_constant<int, REGULAR>());
    case FIVE: return choose(std::integral_constant<int, FIVE>());
    case SEVEN: return choose(std::integral_constant<int, SEVEN>());
    case TWO_FIVES: return choose(std::integral_constant<int, TWO_FIVES>());
    case TWO_SEVENS: return choose(std::integral_constant<int, TWO_SEVENS>());
    default: return choose(std::integral_constant<int, 0>());
  }
}

// choose the instance once per group, not in the loop
template <class Choose> auto with_flag(bool flag, const Choose &choose)
{
  return flag ? choose(std::true_type()) : choose(std::false_type());
}

auto choose_integrate_block(int size, bool volume, bool curvature)
{
  return with_size(size, [&](auto n) {
    return with_flag(volume, [&](auto v) {
      return with_flag(curvature, [](auto c) {
        return integrate_block<decltype(n)::value, decltype(v)::value, decltype(c)::value>;
      });
    });
  });
}

auto choose_force_block(int size, const FaceTerms &terms)
{
  return with_size(size, [&](auto n) {
    return with_flag(terms.leaflets, [&](auto l) {
      return with_flag(terms.gauss, [&](auto g) {
        return with_flag(terms.volume, [&](auto v) {
          return with_flag(terms.moment, [](auto m) {
            constexpr bool leaflets = decltype(l)::value, gauss = leaflets || decltype(g)::value;
            return force_block<decltype(n)::value, gauss, decltype(v)::value, decltype(m)::value,
                               leaflets>;
          });
        });
      });
    });
  });
}

}    // namespace

/* ---------------------------------------------------------------------- */

void Membrane_NS::face_integrals(const FaceGroup &group, const double (*x)[3],
                                 const FaceModel &model, FaceIntegrals &out)
{
  const PatchRule &rule = *group.rule;
  const bool volume = !out.volume.empty(), curved = !out.curvature.empty() || !out.bending.empty();
  const auto integrate = choose_integrate_block(rule.size, volume, curved);

  Lane3 p[MOST_POINTS];
  BlockIntegrals sum;
  for (int block = 0; block < group.nblocks(); ++block) {
    const int slot = group.first_slot + block * LANES;
    gather(&group.points[(size_t) block * rule.size * LANES], rule.size, x, p);
    integrate(rule, p, model, slot, sum);
    if (!out.area.empty()) store(out.area, slot, sum.area);
    if (!out.curvature.empty()) store(out.curvature, slot, sum.curvature);
    if (!out.curved_area.empty()) store(out.curved_area, slot, sum.curved_area);
    if (!out.bending.empty()) store(out.bending, slot, sum.bending);
    if (!volume) continue;
    store(out.volume, slot, sum.volume);
    if (!out.vector_area.empty()) store3(out.vector_area, slot, sum.vector_area);
  }
}

/* ---------------------------------------------------------------------- */

void Membrane_NS::face_forces(const FaceGroup &group, const double (*x)[3], const FaceModel &model,
                              const FaceTerms &terms, double (*f)[3], FaceEnergies &out)
{
  const PatchRule &rule = *group.rule;
  const auto evaluate = choose_force_block(rule.size, terms);

  Lane3 p[MOST_POINTS], g[MOST_POINTS];
  BlockEnergies sum;
  for (int block = 0; block < group.nblocks(); ++block) {
    const int slot = group.first_slot + block * LANES;
    const int *points = &group.points[(size_t) block * rule.size * LANES];
    gather(points, rule.size, x, p);
    evaluate(rule, p, model, slot, g, sum);

    if (!out.bending.empty()) store(out.bending, slot, sum.bending);
    if (!out.gauss.empty()) store(out.gauss, slot, sum.gauss);
    if (!out.area.empty()) store(out.area, slot, sum.area);
    if (!out.leaflet_bend.empty()) store(out.leaflet_bend, slot, sum.bend / sum.area);
    if (!out.virial.empty()) {
      const Lane3 origin = terms.volume ? load3(model.origin, slot) : p[0];
      Lane v[6] = {};
      for (int k = 0; k < rule.size; ++k) {
        const Lane3 d = p[k] - origin;
        v[0] -= d.x * g[k].x;
        v[1] -= d.y * g[k].y;
        v[2] -= d.z * g[k].z;
        v[3] -= d.x * g[k].y;
        v[4] -= d.x * g[k].z;
        v[5] -= d.y * g[k].z;
      }
      for (int l = 0; l < LANES; ++l)
        for (int i = 0; i < 6; ++i) out.virial[6 * (slot + l) + i] = v[i][l];
    }

    const int faces = std::min(LANES, group.nfaces - block * LANES);
    for (int k = 0; k < rule.size; ++k)
      for (int l = 0; l < faces; ++l) {
        double *force = f[points[k * LANES + l]];
        force[0] -= g[k].x[l];
        force[1] -= g[k].y[l];
        force[2] -= g[k].z[l];
      }
  }
}
