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

#include "membrane_threefold.h"

#include "membrane_limit_basis.h"

#include <cmath>

using namespace Membrane_NS;
using namespace Membrane_NS::Threefold;

static constexpr int CONTROL_POINTS = 12;
static constexpr double SAME = 1.0e-12;    // of weights

namespace {

using Coefficients = double[LimitBasis::ROWS][CONTROL_POINTS];

/* ----------------------------------------------------------------------
   the rows of a point with respect to a and b of an axis, columns in the order corner, across, p, q, each of the axis
   itself, the next one and the one before
------------------------------------------------------------------------- */

void look_along(int axis, const double *rows, Coefficients &out)
{
  // the directions of a and b in u and v: of axis 0 (1, 1) and (-1, 1), and turned from corner to corner

  static const double A[3][2] = {{1, 1}, {-2, 1}, {1, -2}}, B[3][2] = {{-1, 1}, {0, -1}, {1, 0}};
  const double *a = A[axis], *b = B[axis];
  for (int j = 0; j < 3; ++j) {
    const int i = (axis + j) % 3, columns[4] = {corner(i), across(i), p(i), q(i)};
    for (int k = 0; k < 4; ++k) {
      double row[LimitBasis::ROWS];
      for (int r = 0; r < LimitBasis::ROWS; ++r) row[r] = rows[r * CONTROL_POINTS + columns[k]];
      const double u = row[LimitBasis::DU], v = row[LimitBasis::DV];
      const double uu = row[LimitBasis::DUU], uv = row[LimitBasis::DUV], vv = row[LimitBasis::DVV];
      const int c = 3 * k + j;
      out[LimitBasis::VALUE][c] = row[LimitBasis::VALUE];
      out[LimitBasis::DU][c] = std::sqrt(0.5) * (a[0] * u + a[1] * v);
      out[LimitBasis::DV][c] = std::sqrt(0.5) * (b[0] * u + b[1] * v);
      out[LimitBasis::DUU][c] = 0.5 * (a[0] * a[0] * uu + 2.0 * a[0] * a[1] * uv + a[1] * a[1] * vv);
      out[LimitBasis::DUV][c] = 0.5 * (a[0] * b[0] * uu + (a[0] * b[1] + a[1] * b[0]) * uv + a[1] * b[1] * vv);
      out[LimitBasis::DVV][c] = 0.5 * (b[0] * b[0] * uu + 2.0 * b[0] * b[1] * uv + b[1] * b[1] * vv);
    }
  }
}

// whether a point is on the axis along which it is looked at

bool is_symmetric(const Coefficients &rows)
{
  static const int MIRROR[CONTROL_POINTS] = {0, 2, 1, 3, 5, 4, 9, 11, 10, 6, 8, 7};
  for (int r = 0; r < LimitBasis::ROWS; ++r) {
    const double sign = r == LimitBasis::DV || r == LimitBasis::DUV ? -1.0 : 1.0;
    for (int c = 0; c < CONTROL_POINTS; ++c)
      if (std::fabs(rows[r][c] - sign * rows[r][MIRROR[c]]) > SAME) return false;
  }
  return true;
}

bool are_same(const Coefficients &one, const Coefficients &other)
{
  for (int r = 0; r < LimitBasis::ROWS; ++r)
    for (int c = 0; c < CONTROL_POINTS; ++c)
      if (std::fabs(one[r][c] - other[r][c]) > SAME) return false;
  return true;
}

ThreefoldPoint combine(const Coefficients &rows)
{
  constexpr int P = 6, Q = 9;    // columns of p and q
  ThreefoldPoint out;
  static const int EVEN[] = {LimitBasis::VALUE, LimitBasis::DU, LimitBasis::DUU, LimitBasis::DVV};
  for (int r = 0; r < ThreefoldPoint::EVEN_ROWS; ++r) {
    const double *row = rows[EVEN[r]];
    const double own[3] = {row[0], row[3], row[P]};
    const double others[3] = {row[1], row[4], 0.5 * (row[P + 1] + row[Q + 1])};
    for (int t = 0; t < 3; ++t) {
      out.even[t][r] = own[t] - others[t];
      out.even_sum[t][r] = others[t];
    }
    out.even[3][r] = 0.5 * (row[P + 1] - row[Q + 1]);
  }
  static const int ODD[] = {LimitBasis::DV, LimitBasis::DUV};
  for (int r = 0; r < ThreefoldPoint::ODD_ROWS; ++r) {
    const double *row = rows[ODD[r]];
    const double others = 0.5 * (row[P + 1] - row[Q + 1]);
    out.odd[0][r] = row[1];
    out.odd[1][r] = row[4];
    out.odd[2][r] = 0.5 * (row[P + 1] + row[Q + 1]);
    out.odd[3][r] = row[P] - others;
    out.odd_sum[r] = others;
  }
  return out;
}

}    // namespace

/* ---------------------------------------------------------------------- */

std::vector<ThreefoldPoint> Membrane_NS::threefold_points(const std::vector<double> &weight,
                                                          const std::vector<double> &area_weight,
                                                          const std::vector<double> &rows)
{
  std::vector<ThreefoldPoint> points;
  const int npoints = static_cast<int>(weight.size());
  const auto rows_of = [&](int q) { return rows.data() + static_cast<size_t>(q) * LimitBasis::ROWS * CONTROL_POINTS; };
  Coefficients first, other;
  int found = 0;
  for (int q = 0; q < npoints; ++q) {
    look_along(0, rows_of(q), first);
    if (!is_symmetric(first)) continue;
    ++found;
    for (int axis : {1, 2})
      for (int o = 0; o < npoints; ++o) {
        if (o == q) continue;    // the middle is on all axes
        look_along(axis, rows_of(o), other);
        found += are_same(first, other) && weight[o] == weight[q] && area_weight[o] == area_weight[q];
      }
    points.push_back(combine(first));
    points.back().weight = weight[q];
    points.back().area_weight = area_weight[q];
  }
  if (found != npoints || 3 * static_cast<int>(points.size()) != npoints) points.clear();
  return points;
}
