/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

#ifndef LMP_MEMBRANE_HELFRICH_POINT_H
#define LMP_MEMBRANE_HELFRICH_POINT_H

#include "membrane_lanes.h"

namespace Membrane_NS {

/// A point of each face of a block and its derivatives by two parameters.
struct LaneJet {
  Lane3 r, u, v, uu, uv, vv;
};
/// What energies are made of, in the names of the derivation, and their gradient with respect to a LaneJet: for all but
/// first derivatives it is along the normal.
struct LaneGradient {
  Lane3 a;
  Lane J, inverse, E, F, G, L, M, N;    // |a|, 1/|a|, ...

  Lane3 u, v;
  Lane r, uu, uv, vv;    // times a
};

/// The first part, apart from what needs it: so several points' roots and divisions go on at once.
__attribute__((always_inline)) inline void find_normal(const LaneJet &at, LaneGradient &by)
{
  const Lane3 a = cross(at.u, at.v);
  const Lane J = sqrt(dot(a, a));
  by.a = a;
  by.E = dot(at.u, at.u);
  by.F = dot(at.u, at.v);
  by.G = dot(at.v, at.v);
  by.L = dot(at.uu, a);
  by.M = dot(at.uv, a);
  by.N = dot(at.vv, a);
  by.J = J;
  by.inverse = 1.0 / J;
}

/// LANES slots in a row, or where each of these is to be looked for.
struct Slots {
  int first;
  const int *of = nullptr;

  Lane operator()(const std::vector<double> &array) const
  {
    if (!of) return load(array, first);
    Lane lane;
    for (int l = 0; l < LANES; ++l) lane[l] = array[of[first + l]];
    return lane;
  }
  Lane3 place(const std::vector<double> &array) const
  {
    if (!of) return load3(array, first);
    Lane3 lane;
    for (int l = 0; l < LANES; ++l) {
      const double *x = &array[3 * (size_t) of[first + l]];
      lane.x[l] = x[0];
      lane.y[l] = x[1];
      lane.z[l] = x[2];
    }
    return lane;
  }
};

/// Of the faces of a block.
struct BlockIntegrals {
  Lane area{}, volume{}, curvature{}, curved_area{}, bending{};
  Lane3 vector_area{};

  void operator+=(const BlockIntegrals &more)
  {
    area += more.area;
    volume += more.volume;
    curvature += more.curvature;
    curved_area += more.curved_area;
    bending += more.bending;
    vector_area += more.vector_area;
  }
};
struct BlockEnergies {
  Lane bending{}, gauss{}, area{}, bend{};    // bend: of leaflets

  void operator+=(const BlockEnergies &more)
  {
    bending += more.bending;
    gauss += more.gauss;
    area += more.area;
    bend += more.bend;
  }
};

/// Integrals of a block, and what a point adds to them.
template <bool VOLUME, bool CURVATURE> class PointIntegrals : public BlockIntegrals {
 public:
  static constexpr bool HAS_PLACE = VOLUME, HAS_CURVATURE = CURVATURE;    // else r and second derivatives are not looked at

  PointIntegrals(const FaceModel &model, const Slots &slots)
  {
    if (VOLUME) origin = slots.place(model.origin);
    if (!CURVATURE) return;
    kc = slots(model.kc);
    c0 = slots(model.c0);
  }

  __attribute__((always_inline)) void add(const LaneJet &at, double weight, double area_weight)
  {
    const Lane3 a = cross(at.u, at.v);
    const Lane J = sqrt(dot(a, a));
    area += area_weight * J;
    if (VOLUME) {
      volume += (area_weight / 3.0) * dot(at.r - origin, a);
      vector_area += area_weight * a;
    }
    if (CURVATURE) {
      const Lane s = dot(at.v, at.v) * dot(at.uu, a) - 2.0 * dot(at.u, at.v) * dot(at.uv, a) + dot(at.u, at.u) * dot(at.vv, a);
      const Lane inverse = 1.0 / J, twice_H = -s * inverse * inverse * inverse;
      const Lane excess = twice_H - c0;
      curvature += weight * twice_H * J;
      curved_area += weight * J;
      bending += (0.5 * weight) * kc * excess * excess * J;
    }
  }

 private:
  Lane kc{}, c0{};
  Lane3 origin{};
};

/** Energy of the leaflets of a block, per area of the mid-plane, with the areas A = 1 +- 2H D + K D^2 and integrated
    curvatures n = 2H +- 2 K D of parallel surfaces and the curvature m each wants:
      kc/4 sum [n^2/A - 2 m n + m^2 A],   n^2/A = (2H)^2 + w (n^2/A - (2H)^2).
    w is 1 but where a radius of curvature nears D, as next to control points of irregular valence, and 0 before A is:
    there it falls with x = D^2 (k1^2 + k2^2) = D^2 ((2H)^2 - 2 K) as 1 - t^3 (10 - 15 t + 6 t^2) */
class Leaflets {
 public:
  Leaflets() = default;
  Leaflets(const FaceModel &model, const Slots &slots) :
      quarter(0.25 * slots(model.kc)), D(slots(model.leaflet)), outer(slots(model.outer)), inner(slots(model.inner))
  {
  }

  struct Density {
    Lane value, by_curvature, by_gaussian;
    Lane bend;    // x
  };
  Density at(const Lane &curvature, const Lane &K) const
  {
    const Lane KD = K * D, hD = curvature * D, sum = 1.0 + KD * D, square = curvature * curvature;

    Density e;
    e.bend = D * (hD * curvature - 2.0 * KD);
    Lane t = (e.bend - LEAFLETS_EXACT) * (1.0 / (LEAFLETS_THIN - LEAFLETS_EXACT));
    t = t < 0.0 ? Lane{} : t;
    t = t > 1.0 ? Lane{} + 1.0 : t;

    // A, which is 0.1 or more as long as w is not 0, and n; in their place 1 and 0 where it is, since curvatures may be so
    // large next to a point of large valence that their products are no numbers

    const Lane grown = sum + hD, shrunk = sum - hD, n_up = curvature + 2.0 * KD, n_down = curvature - 2.0 * KD;
    const Lane up = t < 1.0 ? grown : Lane{} + 1.0, down = t < 1.0 ? shrunk : Lane{} + 1.0;
    const Lane inverse = 1.0 / (up * down);
    const Lane bent_up = t < 1.0 ? n_up : Lane{}, bent_down = t < 1.0 ? n_down : Lane{};
    const Lane above = bent_up * down * inverse, below = bent_down * up * inverse;    // 2H of the leaflets
    const Lane w = 1.0 - t * t * t * (10.0 - t * (15.0 - 6.0 * t));
    const Lane more = bent_up * above + bent_down * below - 2.0 * square;
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
  Lane quarter, D, outer, inner;
};

/** Energies of a block, and the gradient of what a point adds to them.

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
    and e_K comes to kg. */
template <bool GAUSS, bool VOLUME, bool MOMENT, bool LEAFLETS> class PointEnergies : public BlockEnergies {
  static_assert(GAUSS || !LEAFLETS, "leaflets need the Gaussian curvature");

 public:
  static constexpr bool HAS_PLACE = VOLUME;    // else r is not looked at

  PointEnergies(const FaceModel &model, const Slots &slots) :
      kc(slots(model.kc)), c0(slots(model.c0)), tension(slots(model.tension))
  {
    if (LEAFLETS) leaflets = Leaflets(model, slots);
    if (GAUSS) kg = slots(model.kg);
    if (VOLUME) pressure = slots(model.pressure);
    if (MOMENT) moment = slots(model.moment);
    if (VOLUME) origin = slots.place(model.origin);
  }

  __attribute__((always_inline)) void add(const LaneJet &at, double weight, double area_weight, LaneGradient &by)
  {
    const Lane3 a = by.a;
    const Lane J = by.J, inverse = by.inverse;
    const Lane E = by.E, F = by.F, G = by.G, L = by.L, M = by.M, N = by.N;
    const Lane3 B = G * at.uu - 2.0 * F * at.uv + E * at.vv;
    const Lane curvature = -(G * L - 2.0 * F * M + E * N) * inverse * inverse * inverse;    // 2H
    area += area_weight * J;

    Lane gaussian, kg_here = kg;    // gaussian: K J
    if (GAUSS) {
      gaussian = (L * N - M * M) * inverse * inverse * inverse;
      gauss += weight * kg * gaussian;
    }
    Lane bent, e_W;    // kc (2H - c0)/J
    if (LEAFLETS) {
      const Lane K = gaussian * inverse;
      const Leaflets::Density e = leaflets.at(curvature, K);
      bend += weight * e.bend * J;
      bending += weight * e.value * J;
      bent = weight * e.by_curvature * inverse;
      e_W = (0.5 * weight) * (e.value - K * e.by_gaussian) * inverse - 1.5 * curvature * bent;
      kg_here += e.by_gaussian;
    } else {
      const Lane excess = curvature - c0;
      bending += (0.5 * weight) * kc * excess * excess * J;
      bent = weight * kc * excess * inverse;
      e_W = bent * (0.25 * excess - 1.5 * curvature);
    }
    e_W += (0.5 * area_weight) * tension * inverse;
    Lane e_s = -bent * inverse;
    if (MOMENT) {
      e_s -= weight * moment * inverse * inverse;
      e_W -= weight * moment * curvature * inverse;
    }

    const Lane gE = e_s * N, gF = -2.0 * e_s * M, gG = e_s * L;
    by.uu = e_s * G;
    by.uv = -2.0 * e_s * F;
    by.vv = e_s * E;
    Lane3 ga = e_s * B;

    if (GAUSS) {
      const Lane factor = weight * kg_here * inverse * inverse * inverse;
      by.uu += factor * N;
      by.uv -= 2.0 * factor * M;
      by.vv += factor * L;
      ga += factor * (N * at.uu - 2.0 * M * at.uv + L * at.vv);
      e_W += (-1.5 * weight) * kg_here * gaussian * inverse * inverse;
    }

    ga += 2.0 * e_W * a;
    if (VOLUME) {
      by.r = (area_weight / 3.0) * pressure;
      ga += by.r * (at.r - origin);
    }
    by.u = cross(at.v, ga) + 2.0 * gE * at.u + gF * at.v;
    by.v = cross(ga, at.u) + 2.0 * gG * at.v + gF * at.u;
  }

 private:
  Lane kc, c0, tension, kg{}, pressure{}, moment{};
  Leaflets leaflets;
  Lane3 origin{};
};

}    // namespace Membrane_NS

#endif
