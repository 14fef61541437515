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

// control points of a regular face, and of faces with one corner of valence 5 or 7
constexpr int REGULAR = 12, FIVE = 11, SEVEN = 13;

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
  Lane area, volume, curvature, bending;
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
    const double weight = rule.weight[q];
    const Lane3 ru = combine(rule.row(q, LimitBasis::DU), x, size);
    const Lane3 rv = combine(rule.row(q, LimitBasis::DV), x, size);
    const Lane3 a = cross(ru, rv);
    const Lane J = sqrt(dot(a, a));
    sum.area += weight * J;
    if (VOLUME) {
      const Lane3 r = combine(rule.row(q, LimitBasis::VALUE), x, size) - origin;
      sum.volume += (weight / 3.0) * dot(r, a);
      sum.vector_area += weight * a;
    }
    if (CURVATURE) {
      const Lane uu = dot(combine(rule.row(q, LimitBasis::DUU), x, size), a);
      const Lane uv = dot(combine(rule.row(q, LimitBasis::DUV), x, size), a);
      const Lane vv = dot(combine(rule.row(q, LimitBasis::DVV), x, size), a);
      const Lane s = dot(rv, rv) * uu - 2.0 * dot(ru, rv) * uv + dot(ru, ru) * vv;
      const Lane inverse = 1.0 / J, curvature = -s * inverse * inverse * inverse;    // 2H
      const Lane excess = curvature - c0;
      sum.curvature += weight * curvature * J;
      sum.bending += (0.5 * weight) * kc * excess * excess * J;
    }
  }
  out = sum;
}

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
   (1/3) (r - origin).a.
------------------------------------------------------------------------- */

template <int SIZE, bool GAUSS, bool VOLUME, bool MOMENT>
void force_block(const PatchRule &rule, const Lane3 *x, const FaceModel &model, int slot, Lane3 *g,
                 Lane &bending, Lane &gauss, Lane &area)
{
  const int size = SIZE ? SIZE : rule.size;
  const Lane kc = load(model.kc, slot), c0 = load(model.c0, slot);
  const Lane tension = load(model.tension, slot);
  const Lane kg = GAUSS ? load(model.kg, slot) : Lane{};
  const Lane pressure = VOLUME ? load(model.pressure, slot) : Lane{};
  const Lane bend = MOMENT ? load(model.moment, slot) : Lane{};
  const Lane3 origin = VOLUME ? load3(model.origin, slot) : Lane3{};

  bending = gauss = area = Lane{};
  for (int k = 0; k < size; ++k) g[k] = Lane3{};

  for (int q = 0; q < rule.npoints; ++q) {
    const double weight = rule.weight[q];
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
    const Lane excess = curvature - c0;

    area += weight * J;
    bending += (0.5 * weight) * kc * excess * excess * J;

    const Lane moment = weight * kc * excess * inverse;
    Lane e_s = -moment * inverse;
    Lane e_W = moment * (0.25 * excess - 1.5 * curvature) + (0.5 * weight) * tension * inverse;
    if (MOMENT) {
      e_s -= weight * bend * inverse * inverse;
      e_W -= weight * bend * curvature * inverse;
    }

    const Lane3 gB = e_s * a;
    const Lane gE = dot(rvv, gB), gF = -2.0 * dot(ruv, gB), gG = dot(ruu, gB);
    Lane3 guu = G * gB, guv = -2.0 * F * gB, gvv = E * gB;
    Lane3 ga = e_s * B;

    if (GAUSS) {
      const Lane L = dot(ruu, a), M = dot(ruv, a), N = dot(rvv, a);
      const Lane factor = weight * kg * inverse * inverse * inverse;
      const Lane density = factor * (L * N - M * M);
      gauss += density;
      guu += factor * N * a;
      guv += -2.0 * factor * M * a;
      gvv += factor * L * a;
      ga += factor * (N * ruu - 2.0 * M * ruv + L * rvv);
      e_W += -1.5 * density * inverse * inverse;
    }

    ga += 2.0 * e_W * a;
    Lane3 gr;
    if (VOLUME) {
      const Lane third = (weight / 3.0) * pressure;
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
}

// the compiler unrolls loops over frequent numbers of control points; 0 is any
template <class Choose> auto with_size(int size, const Choose &choose)
{
  switch (size) {
    case REGULAR: return choose(std::integral_constant<int, REGULAR>());
    case FIVE: return choose(std::integral_constant<int, FIVE>());
    case SEVEN: return choose(std::integral_constant<int, SEVEN>());
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
    return with_flag(terms.gauss, [&](auto g) {
      return with_flag(terms.volume, [&](auto v) {
        return with_flag(terms.moment, [](auto m) {
          return force_block<decltype(n)::value, decltype(g)::value, decltype(v)::value,
                             decltype(m)::value>;
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
  Lane bending, gauss, area;
  for (int block = 0; block < group.nblocks(); ++block) {
    const int slot = group.first_slot + block * LANES;
    const int *points = &group.points[(size_t) block * rule.size * LANES];
    gather(points, rule.size, x, p);
    evaluate(rule, p, model, slot, g, bending, gauss, area);

    if (!out.bending.empty()) store(out.bending, slot, bending);
    if (!out.gauss.empty()) store(out.gauss, slot, gauss);
    if (!out.area.empty()) store(out.area, slot, area);
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
