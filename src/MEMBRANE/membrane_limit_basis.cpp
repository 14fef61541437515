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

#include "membrane_limit_basis.h"

#include "membrane_box_spline.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace Membrane_NS;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;

static constexpr double TWO_PI = 6.283185307179586476925;

/* ----------------------------------------------------------------------
   Loop's weights [C. Loop, Smooth Subdivision Surfaces Based on Triangles, 1987] and the
   eigenvalues of the subdivision matrix: 1, 3/8 + cos(2 pi m/n)/4 for the Fourier modes
   m = 1..n-1, the square of the first of these for m = 0 (that is what makes these weights
   bound the curvature at valence 4 and 5), and 1/8, 1/16 of the outer ring.
------------------------------------------------------------------------- */

double Membrane_NS::subdominant_eigenvalue(int n)
{
  return 0.375 + 0.25 * std::cos(TWO_PI / n);
}

double Membrane_NS::loop_beta(int n)
{
  const double lambda = subdominant_eigenvalue(n);
  return (0.625 - lambda * lambda) / n;
}

// the left eigenvector of eigenvalue 1: ring weight w each with n w = 8 n beta/(3 + 8 n beta)
// [H. Hoppe et al., Piecewise Smooth Surface Reconstruction, SIGGRAPH 1994]

double Membrane_NS::limit_mask_centre(int n)
{
  return 3.0 / (3.0 + 8.0 * n * loop_beta(n));
}

/* ----------------------------------------------------------------------
   Near an extraordinary vertex r = lambda^k (tangent) + mu^k (normal) at subdivision level k, with
   mu the largest eigenvalue that bends the surface. Area shrinks as lambda^2, curvature goes as
   mu/lambda^2, so the bending energy of a level goes as (mu/lambda)^2; never slower than the area.
------------------------------------------------------------------------- */

double Membrane_NS::energy_decay(int n)
{
  const double lambda = subdominant_eigenvalue(n);
  double mu = std::max(lambda * lambda, 0.125);
  if (n >= 4) mu = std::max(mu, 0.375 + 0.25 * std::cos(2.0 * TWO_PI / n));
  return std::max(lambda * lambda, mu * mu / (lambda * lambda));
}

namespace {

// value and barycentric derivatives d_i, d_ij of a polynomial in t[0..2]
template <size_t N>
void add_polynomial(const BoxSpline::Polynomial<N> &polynomial, const double t[3], double &value,
                    double d[3], double dd[3][3])
{
  value = 0.0;
  for (int i = 0; i < 3; ++i) d[i] = dd[i][0] = dd[i][1] = dd[i][2] = 0.0;
  auto power = [](double x, int n) {
    return n < 0 ? 0.0 : std::pow(x, n);
  };
  for (const BoxSpline::Monomial &m : polynomial) {
    const int e[3] = {m.a, m.b, m.c};
    double p[3], dp[3], ddp[3];
    for (int i = 0; i < 3; ++i) {
      p[i] = power(t[i], e[i]);
      dp[i] = e[i] * power(t[i], e[i] - 1);
      ddp[i] = e[i] * (e[i] - 1) * power(t[i], e[i] - 2);
    }
    const double k = m.coefficient / 12.0;
    value += k * p[0] * p[1] * p[2];
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, l = (i + 2) % 3;
      d[i] += k * dp[i] * p[j] * p[l];
      dd[i][i] += k * ddp[i] * p[j] * p[l];
      dd[i][j] += k * dp[i] * dp[j] * p[l];
      dd[j][i] = dd[i][j];
    }
  }
}

}    // namespace

LimitBasis::Weights Membrane_NS::box_spline(double u, double v)
{
  const double bary[3] = {1.0 - u - v, u, v};
  LimitBasis::Weights w(LimitBasis::ROWS, 12);

  // place one basis function: polynomial p with its a, b, c being corners a, b, c of the face
  auto place = [&](int column, const auto &p, int a, int b, int c) {
    const int corner[3] = {a, b, c};
    const double t[3] = {bary[a], bary[b], bary[c]};
    double value, local[3], local2[3][3], d[3], dd[3][3];
    add_polynomial(p, t, value, local, local2);
    for (int i = 0; i < 3; ++i) {
      d[corner[i]] = local[i];
      for (int j = 0; j < 3; ++j) dd[corner[i]][corner[j]] = local2[i][j];
    }
    w(LimitBasis::VALUE, column) = value;
    w(LimitBasis::DU, column) = d[1] - d[0];
    w(LimitBasis::DV, column) = d[2] - d[0];
    w(LimitBasis::DUU, column) = dd[1][1] - 2.0 * dd[0][1] + dd[0][0];
    w(LimitBasis::DUV, column) = dd[1][2] - dd[0][1] - dd[0][2] + dd[0][0];
    w(LimitBasis::DVV, column) = dd[2][2] - 2.0 * dd[0][2] + dd[0][0];
  };

  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3, prev = (k + 2) % 3;
    place(k, BoxSpline::CORNER, k, next, prev);
    place(3 + 3 * k, BoxSpline::ACROSS, prev, k, next);
    place(4 + 3 * k, BoxSpline::BEYOND, k, prev, next);
    place(5 + 3 * k, BoxSpline::BEYOND, k, next, prev);
  }
  return w;
}

const Quartics<12> &Membrane_NS::box_spline_quartics()
{
  static const Quartics<12> quartics = [] {
    Quartics<12> q;
    for (int term = 0; term < QUARTIC_TERMS; ++term)
      for (int i = 0; i < 12; ++i) q[term][i] = BoxSpline::TWELFTHS[term][i] / 12.0;
    return q;
  }();
  return quartics;
}

/* ----------------------------------------------------------------------
   Layout of a face's control points, see Topology::stencil(). The ring of corner k runs: next
   corner, previous corner, its own list of n-3 points, and the point across the edge to the next
   corner, which is the first of the next corner's list, or, if that corner has valence 3 and hence
   no list, the first of the one after.
------------------------------------------------------------------------- */

LimitBasis::LimitBasis(const Valences &valences) : valences_(valences), size_(3)
{
  for (int k = 0; k < 3; ++k) {
    list_start_[k] = size_;
    size_ += valences_[k] - 3;
  }
  if (size_ == 3) size_ = 4;    // tetrahedron: one point across all edges

  for (int k = 0; k < 3; ++k) {
    const int n = valences_[k], next = (k + 1) % 3, prev = (k + 2) % 3;
    ring_[k].resize(n);
    ring_[k][0] = next;
    ring_[k][1] = prev;
    for (int i = 0; i < n - 3; ++i) ring_[k][2 + i] = list_start_[k] + i;
    int across = 3;
    for (int c : {next, prev, k})
      if (valences_[c] > 3) {
        across = list_start_[c];
        break;
      }
    ring_[k][n - 1] = across;
  }
}

RowVectorXd LimitBasis::vertex_point(int k) const
{
  const int n = valences_[k];
  const double beta = loop_beta(n);
  RowVectorXd row = RowVectorXd::Zero(size_);
  row[k] = 1.0 - n * beta;
  for (int v : ring_[k]) row[v] += beta;
  return row;
}

RowVectorXd LimitBasis::edge_point(int k, int i) const
{
  const int n = valences_[k];
  RowVectorXd row = RowVectorXd::Zero(size_);
  row[k] += 0.375;
  row[ring_[k][i]] += 0.375;
  row[ring_[k][(i + 1) % n]] += 0.125;
  row[ring_[k][(i + n - 1) % n]] += 0.125;
  return row;
}

RowVectorXd LimitBasis::corner_mask(int k) const
{
  const int n = valences_[k];
  const double c = limit_mask_centre(n);
  RowVectorXd row = RowVectorXd::Zero(size_);
  row[k] = c;
  for (int v : ring_[k]) row[v] += (1.0 - c) / n;
  return row;
}

Valences LimitBasis::child_valences(int child) const
{
  Valences v{6, 6, 6};
  if (child < 3) v[child] = valences_[child];
  return v;
}

/* ----------------------------------------------------------------------
   Write P_k for the new vertex at corner k, E_k for the midpoint of the edge from k to k+1.
   Corner child k is (P_k, E_k, E_k+2) in slots k, k+1, k+2; the middle child has E_j+1 in slot j.
   Around the midpoint of an edge from a to b, counter-clockwise from b: P_b, the midpoints
   E_a+1 and E_a+2 of this face, P_a, and the midpoints of a - across and b - across.
------------------------------------------------------------------------- */

MatrixXd LimitBasis::child_matrix(int child) const
{
  std::array<std::vector<RowVectorXd>, 3> list;
  std::array<RowVectorXd, 3> corner;
  auto midpoint = [&](int a) {
    return edge_point(a, 0);
  };
  auto to_across = [&](int a) {
    return edge_point(a, valences_[a] - 1);
  };
  auto from_across = [&](int a) {
    return edge_point((a + 1) % 3, 2);
  };

  if (child < 3) {
    const int k = child, next = (k + 1) % 3, prev = (k + 2) % 3;
    corner[k] = vertex_point(k);
    corner[next] = midpoint(k);
    corner[prev] = midpoint(prev);
    for (int i = 2; i <= valences_[k] - 2; ++i) list[k].push_back(edge_point(k, i));
    list[next] = {to_across(k), from_across(k), vertex_point(next)};
    list[prev] = {midpoint(next), vertex_point(prev), to_across(prev)};
  } else {
    for (int j = 0; j < 3; ++j) {
      const int a = (j + 1) % 3;
      corner[j] = midpoint(a);
      list[j] = {vertex_point(a), to_across(a), from_across(a)};
    }
  }

  std::vector<RowVectorXd> rows(corner.begin(), corner.end());
  for (const auto &part : list) rows.insert(rows.end(), part.begin(), part.end());
  MatrixXd matrix(rows.size(), size_);
  for (size_t i = 0; i < rows.size(); ++i) matrix.row(i) = rows[i];
  return matrix;
}

/* ---------------------------------------------------------------------- */

LimitBasis::Weights LimitBasis::evaluate(double u, double v) const
{
  if (is_regular()) return box_spline(u, v);

  // at an extraordinary corner: its limit position, and derivatives from just inside the face

  for (int k = 0; k < 3; ++k) {
    const double t[3] = {1.0 - u - v, u, v};
    if (valences_[k] == 6 || t[k] < 1.0 - CORNER_RADIUS) continue;
    double inside[3] = {INSIDE, INSIDE, INSIDE};
    inside[k] = 1.0 - 2.0 * INSIDE;
    Weights w = evaluate(inside[1], inside[2]);
    w.row(VALUE) = corner_mask(k);
    return w;
  }

  int child = 3;
  double scale = 2.0;
  if (1.0 - u - v >= 0.5) {
    child = 0;
    u = 2.0 * u;
    v = 2.0 * v;
  } else if (u >= 0.5) {
    child = 1;
    u = 2.0 * u - 1.0;
    v = 2.0 * v;
  } else if (v >= 0.5) {
    child = 2;
    u = 2.0 * u;
    v = 2.0 * v - 1.0;
  } else {
    scale = -2.0;
    u = 1.0 - 2.0 * u;
    v = 1.0 - 2.0 * v;
  }

  const LimitBasis sub(child_valences(child));
  Weights w = sub.evaluate(u, v) * child_matrix(child);

  // Derivative rows sum to zero. Rounding breaks that by an amount that subdivision does not
  // shrink as it shrinks the rows; take it out along the eigenvector of eigenvalue 1.

  const RowVectorXd mask = corner_mask(child % 3);
  for (int row = DU; row <= DVV; ++row) w.row(row) -= w.row(row).sum() * mask;

  w.middleRows(DU, 2) *= scale;
  w.middleRows(DUU, 3) *= 4.0;
  return w;
}
