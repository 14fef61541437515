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

#include "membrane_srd_collision.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

using namespace Membrane_NS;
using Eigen::Vector3d;

namespace {

struct Cubic {
  std::array<double, 4> c;    // c0 + c1 t + c2 t^2 + c3 t^3 on [0, 1]
  double operator()(double t) const { return c[0] + t * (c[1] + t * (c[2] + t * c[3])); }
  double slope(double t) const { return c[1] + t * (2.0 * c[2] + t * 3.0 * c[3]); }

  // bounds of the values on [0, 1], from Bernstein coefficients
  std::array<double, 2> bounds() const
  {
    const double b1 = c[0] + c[1] / 3.0, b2 = c[0] + (2.0 * c[1] + c[2]) / 3.0,
                 b3 = c[0] + c[1] + c[2] + c[3];
    return {std::min({c[0], b1, b2, b3}), std::max({c[0], b1, b2, b3})};
  }

  // 0, the extrema inside (0, 1) in order, 1: between them the cubic is monotone
  int pieces(std::array<double, 4> &t) const
  {
    int n = 0;
    t[n++] = 0.0;
    const double a = 3.0 * c[3], b = c[2], d = b * b - a * c[1];
    if (d > 0.0) {
      const double q = -(b + std::copysign(std::sqrt(d), b));
      double first = a != 0.0 ? q / a : -1.0, second = q != 0.0 ? c[1] / q : -1.0;
      if (first > second) std::swap(first, second);
      if (first > 0.0 && first < 1.0) t[n++] = first;
      if (second > 0.0 && second < 1.0 && second > first) t[n++] = second;
    }
    t[n++] = 1.0;
    return n;
  }

  // where it falls through `level`, between a (above) and b (not above): Newton within a bracket
  double fall(double level, double a, double b) const
  {
    double t = 0.5 * (a + b);
    for (int i = 0; i < 100; ++i) {
      const double value = (*this)(t) -level;
      (value > 0.0 ? a : b) = t;
      const double slope_here = slope(t);
      double next = slope_here < 0.0 ? t - value / slope_here : 0.5 * (a + b);
      if (!(next > a && next < b)) next = 0.5 * (a + b);
      if (std::fabs(next - t) <= 1.0e-16 || next == a || next == b) return next;
      t = next;
    }
    return t;
  }
};

}    // namespace

/* ----------------------------------------------------------------------
   with p = x - a, e = b - a, g = c - a linear in time the volume is p.(e x g)
------------------------------------------------------------------------- */

bool TriangleCollision::find(const MovingPoint &point, const std::array<MovingPoint, 3> &triangle,
                             int side, double begin, double end, bool touching,
                             TriangleHit &hit) const
{
  const double span = end - begin;
  const Vector3d a0 = triangle[0].at(begin), &a1 = triangle[0].velocity;
  const Vector3d p0 = point.at(begin) - a0, p1 = span * (point.velocity - a1);
  const Vector3d e0 = triangle[1].at(begin) - a0, e1 = span * (triangle[1].velocity - a1);
  const Vector3d g0 = triangle[2].at(begin) - a0, g1 = span * (triangle[2].velocity - a1);
  const Vector3d n0 = e0.cross(g0), n1 = e0.cross(g1) + e1.cross(g0), n2 = e1.cross(g1);
  const Cubic f = {{side * p0.dot(n0), side * (p0.dot(n1) + p1.dot(n0)),
                    side * (p0.dot(n2) + p1.dot(n1)), side * p1.dot(n2)}};

  const auto [lowest, highest] = f.bounds();
  const double tolerance = contact * n0.norm();
  if (lowest > 0.0 || highest < -2.0 * tolerance) return false;

  // at the start the point may be on the wrong side by rounding: then it hits a tolerance deeper

  const bool at_start = f.c[0] >= -2.0 * tolerance && f.c[0] <= (touching ? 2.0 * tolerance : 0.0);
  const double level = at_start ? -tolerance : 0.0;
  std::array<double, 4> t;
  const int n = f.pieces(t);
  for (int i = 0; i + 1 < n; ++i) {
    const double from = f(t[i]), to = f(t[i + 1]);
    if (to > level || to >= from || from < -2.0 * tolerance) continue;
    const double when = from > level ? f.fall(level, t[i], t[i + 1]) : t[i];

    const Vector3d p = p0 + when * p1, e = e0 + when * e1, g = g0 + when * g1;
    const Vector3d normal = e.cross(g);
    const double area = normal.squaredNorm();
    const double height = p.dot(normal);
    if (!(height * height <= 16.0 * contact * contact * area)) continue;    // degenerate
    const double b1 = p.cross(g).dot(normal) / area, b2 = e.cross(p).dot(normal) / area;
    const double b0 = 1.0 - b1 - b2;
    if (b0 < -edge_tolerance || b1 < -edge_tolerance || b2 < -edge_tolerance) continue;
    hit.time = begin + when * span;
    hit.weight = {b0, b1, b2};
    hit.normal = normal / std::sqrt(area);
    return true;
  }
  return false;
}

/* ---------------------------------------------------------------------- */

std::array<double, 3> Membrane_NS::nearest_on_triangle(const Vector3d &x, const Vector3d &a,
                                                       const Vector3d &b, const Vector3d &c)
{
  const Vector3d ab = b - a, ac = c - a, ax = x - a, bx = x - b, cx = x - c;
  const double d1 = ab.dot(ax), d2 = ac.dot(ax), d3 = ab.dot(bx), d4 = ac.dot(bx), d5 = ab.dot(cx),
               d6 = ac.dot(cx);
  if (d1 <= 0.0 && d2 <= 0.0) return {1.0, 0.0, 0.0};
  if (d3 >= 0.0 && d4 <= d3) return {0.0, 1.0, 0.0};
  if (d6 >= 0.0 && d5 <= d6) return {0.0, 0.0, 1.0};

  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    const double t = d1 / (d1 - d3);
    return {1.0 - t, t, 0.0};
  }
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    const double t = d2 / (d2 - d6);
    return {1.0 - t, 0.0, t};
  }
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double t = (d4 - d3) / (d4 - d3 + d5 - d6);
    return {0.0, 1.0 - t, t};
  }
  const double all = va + vb + vc;
  return {va / all, vb / all, vc / all};
}
