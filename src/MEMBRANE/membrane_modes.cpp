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

#include "membrane_modes.h"

#include <algorithm>
#include <cmath>

using namespace Membrane_NS;

static constexpr double TWO_PI = 6.283185307179586476925;

namespace {

struct LaneComplex {
  Lane re, im;
};

inline LaneComplex operator*(const LaneComplex &a, const LaneComplex &b)
{
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

inline LaneComplex conjugate(const LaneComplex &a)
{
  return {a.re, -a.im};
}

// exp(-2 pi i s)
inline LaneComplex wave(const Lane &s)
{
  LaneComplex e;
  for (int l = 0; l < LANES; ++l) {
    e.re[l] = std::cos(TWO_PI * s[l]);
    e.im[l] = -std::sin(TWO_PI * s[l]);
  }
  return e;
}

inline double total(const Lane &a)
{
  double sum = 0.0;
  for (int l = 0; l < LANES; ++l) sum += a[l];
  return sum;
}

// many numbers, with what rounding takes from each added to the next [W. Kahan, CACM 8, 40 (1965)]
struct LaneSum {
  Lane sum{}, lost{};
  void add(const Lane &value)
  {
    const Lane next = value - lost, more = sum + next;
    lost = (more - sum) - next;
    sum = more;
  }
};

}    // namespace

/* ---------------------------------------------------------------------- */

void SurfacePoints::take(const std::vector<FaceGroup> &groups, const double (*x)[3],
                         const FaceModel &model)
{
  r.clear();
  area.clear();
  std::vector<Lane3> p;
  for (const FaceGroup &group : groups) {
    const PatchRule &rule = *group.rule;
    p.resize(rule.size);
    for (int block = 0; block < group.nblocks(); ++block) {
      const double *origin = &model.origin[3 * ((size_t) group.first_slot + block * LANES)];
      const int *points = &group.points[(size_t) block * rule.size * LANES];
      for (int k = 0; k < rule.size; ++k)
        for (int l = 0; l < LANES; ++l) {
          const double *point = x[points[k * LANES + l]];
          p[k].x[l] = point[0] - origin[3 * l];
          p[k].y[l] = point[1] - origin[3 * l + 1];
          p[k].z[l] = point[2] - origin[3 * l + 2];
        }

      Lane counted{};
      const int faces = std::min(LANES, group.nfaces - block * LANES);
      for (int l = 0; l < faces; ++l) counted[l] = 1.0;
      for (int q = 0; q < rule.npoints; ++q) {
        const Lane3 u = combine(rule.row(q, LimitBasis::DU), p.data(), rule.size);
        const Lane3 v = combine(rule.row(q, LimitBasis::DV), p.data(), rule.size);
        r.push_back(combine(rule.row(q, LimitBasis::VALUE), p.data(), rule.size));
        area.push_back((rule.area_weight[q] * counted) * cross(u, v));
      }
    }
  }
}

/* ---------------------------------------------------------------------- */

void Membrane_NS::sheet_moments(const SurfacePoints &points, double (&sums)[2])
{
  LaneSum area, first;
  for (size_t i = 0; i < points.r.size(); ++i) {
    area.add(points.area[i].z);
    first.add(points.r[i].z * points.area[i].z);
  }
  sums[0] += total(area.sum);
  sums[1] += total(first.sum);
}

/* ----------------------------------------------------------------------
   powers of exp(-2 pi i s) and exp(-2 pi i t) by multiplication: no sines or cosines per wave
------------------------------------------------------------------------- */

void Membrane_NS::sheet_waves(const SurfacePoints &points, const SheetFrame &frame, int nmax,
                              double *sums)
{
  std::vector<LaneComplex> lanes(1 + count_waves(nmax), LaneComplex{});
  for (size_t i = 0; i < points.r.size(); ++i) {
    const Lane3 &r = points.r[i], &n = points.area[i];
    const LaneComplex s = wave(frame.s_x * r.x + frame.s_y * r.y);
    const LaneComplex t = wave(frame.t_y * r.y), t_back = conjugate(t);
    const Lane h = r.z - frame.height;
    LaneComplex middle = {h * n.z, Lane{}};    // h exp(-i q.r) n_z dA of the waves (nx, 0)
    lanes[0].re += h * middle.re;
    for (int nx = 0; nx <= nmax; ++nx) {
      LaneComplex *row = &lanes[nx * (2 * nmax + 1)];
      LaneComplex forth = middle, back = middle;
      if (nx > 0) {
        row[0].re += middle.re;
        row[0].im += middle.im;
        for (int ny = 1; ny <= nmax; ++ny) {
          back = back * t_back;
          row[-ny].re += back.re;
          row[-ny].im += back.im;
        }
      }
      for (int ny = 1; ny <= nmax; ++ny) {
        forth = forth * t;
        row[ny].re += forth.re;
        row[ny].im += forth.im;
      }
      middle = middle * s;
    }
  }
  for (size_t i = 0; i < lanes.size(); ++i) {
    sums[2 * i] += total(lanes[i].re);
    sums[2 * i + 1] += total(lanes[i].im);
  }
}

/* ---------------------------------------------------------------------- */

void Membrane_NS::sphere_moments(const SurfacePoints &points, double (&sums)[4])
{
  Lane volume{};
  Lane3 first{};
  for (size_t i = 0; i < points.r.size(); ++i) {
    const Lane3 &r = points.r[i];
    const Lane cone = dot(r, points.area[i]);
    volume += cone;
    first.x += cone * r.x;
    first.y += cone * r.y;
    first.z += cone * r.z;
  }
  sums[0] += total(volume) / 3.0;
  sums[1] += total(first.x) / 4.0;
  sums[2] += total(first.y) / 4.0;
  sums[3] += total(first.z) / 4.0;
}

/* ----------------------------------------------------------------------
   With z = cos(theta), P_lm / sin^m(theta) is a polynomial in z, here times N and called Q_lm, and
   sin^m(theta) exp(i m phi) = (x + i y)^m:
     Q_00 = 1/sqrt(4 pi),  Q_mm = sqrt((2m+1)/2m) Q_m-1,m-1,
     Q_lm = a_lm (z Q_l-1,m - Q_l-2,m / a_l-1,m),  a_lm = sqrt((4 l^2 - 1)/(l^2 - m^2))
------------------------------------------------------------------------- */

void Membrane_NS::sphere_harmonics(const SurfacePoints &points, const double (&middle)[3],
                                   double radius, int lmax, double *sums)
{
  const int n = lmax + 1;
  std::vector<double> diagonal(n), a((size_t) n * n, 0.0), inverse((size_t) n * n, 0.0);
  for (int m = 0; m <= lmax; ++m) {
    diagonal[m] = m == 0 ? 1.0 / std::sqrt(2.0 * TWO_PI)
                         : diagonal[m - 1] * std::sqrt((2.0 * m + 1.0) / (2.0 * m));
    for (int l = m + 1; l <= lmax; ++l) {
      a[m * n + l] = std::sqrt((4.0 * l * l - 1.0) / ((double) l * l - (double) m * m));
      inverse[m * n + l] = 1.0 / a[m * n + l];
    }
  }

  // several blocks of points at a time: one alone would wait for its recurrence

  constexpr int BATCH = 8;
  std::vector<Lane> lanes(count_harmonics(lmax) + 1, Lane{});
  for (size_t first = 0; first < points.r.size(); first += BATCH) {
    Lane z[BATCH];
    LaneComplex turn[BATCH], turned[BATCH];
    for (int b = 0; b < BATCH; ++b) {
      const size_t i = std::min(first + b, points.r.size() - 1);
      const Lane3 &at = points.r[i], &area = points.area[i];
      const Lane3 p = {at.x - middle[0], at.y - middle[1], at.z - middle[2]};
      const Lane r = sqrt(dot(p, p)), over_r = 1.0 / r;
      const double counted = first + b < points.r.size() ? 1.0 : 0.0;
      const Lane solid = counted * dot(p, area) * over_r * over_r * over_r;
      z[b] = p.z * over_r;
      turn[b] = {p.x * over_r, p.y * over_r};
      turned[b] = {(r / radius - 1.0) * solid, Lane{}};
      lanes.back() += solid;
    }
    for (int m = 0; m <= lmax; ++m) {
      Lane previous[BATCH] = {}, Q[BATCH];
      for (Lane &q : Q) q = diagonal[m] + Lane{};
      for (int l = m; l <= lmax; ++l) {
        Lane re{}, im{};
        if (l > m) {
          const double forth = a[m * n + l], back = forth * inverse[m * n + l - 1];
          for (int b = 0; b < BATCH; ++b) {
            const Lane next = forth * z[b] * Q[b] - back * previous[b];
            previous[b] = Q[b];
            Q[b] = next;
          }
        }
        for (int b = 0; b < BATCH; ++b) {
          re += Q[b] * turned[b].re;
          im += Q[b] * turned[b].im;
        }
        const int zonal = l * l + l;
        lanes[zonal + m] += re;
        if (m > 0) lanes[zonal - m] += im;
      }
      for (int b = 0; b < BATCH; ++b) {
        turned[b] = turned[b] * turn[b];
        if (m > 0) continue;
        turned[b].re *= std::sqrt(2.0);
        turned[b].im *= std::sqrt(2.0);
      }
    }
  }
  for (size_t i = 0; i < lanes.size(); ++i) sums[i] += total(lanes[i]);
}
