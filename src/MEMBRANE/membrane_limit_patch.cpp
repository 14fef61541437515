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

#include "membrane_limit_patch.h"

#include "membrane_box_spline.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace Membrane_NS;
using Eigen::MatrixXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/* ----------------------------------------------------------------------
   Stencils of faces with corner k first are those of the face itself, turned: where column c of
   the turned stencil of a regular face is in the stencil that has corner 0 first.
------------------------------------------------------------------------- */

static int turned_column(int k, int c)
{
  if (c < 3) return (c + k) % 3;
  return 3 + (c - 3 + 3 * k) % 9;
}

/* ---------------------------------------------------------------------- */

CornerTail::CornerTail(int valence) : size_(valence + 6)
{
  const LimitBasis basis({valence, 6, 6});
  const Eigen::RowVectorXd mask = basis.corner_mask(0);
  mask_.assign(mask.data(), mask.data() + size_);
  auto without_constant = [&mask](MatrixXd matrix) {
    matrix.rowwise() -= mask;
    return matrix;
  };
  const MatrixXd b = without_constant(basis.child_matrix(0));
  std::array<RowMajor, 3> child;
  for (int c = 0; c < 3; ++c) child[c] = without_constant(basis.child_matrix(c + 1));
  table_.reserve(static_cast<size_t>(LEVELS) * 3 * 12 * size_);
  for (int k = 0; k < LEVELS; ++k)
    for (RowMajor &matrix : child) {
      table_.insert(table_.end(), matrix.data(), matrix.data() + matrix.size());
      matrix = matrix * b;
    }
}

/* ---------------------------------------------------------------------- */

LimitPatch::LimitPatch(const Valences &valences, const std::array<const CornerTail *, 3> &tails) :
    valences_(valences), regular_(valences == Valences{6, 6, 6}), tails_(tails)
{
  const LimitBasis basis(valences);
  size_ = basis.size();
  auto append = [](Sparse &sparse, const Eigen::RowVectorXd &row) {
    if (sparse.start.empty()) sparse.start.push_back(0);
    for (int c = 0; c < row.size(); ++c)
      if (row[c] != 0.0) {
        sparse.column.push_back(c);
        sparse.weight.push_back(row[c]);
      }
    sparse.start.push_back(static_cast<int>(sparse.column.size()));
  };
  for (int k = 0; k < 3; ++k) append(mask_[k], basis.corner_mask(k));
  if (regular_) return;

  for (int child = 0; child < 4; ++child) {
    const MatrixXd matrix = basis.child_matrix(child);
    if (child == 3 || valences[child] == 6) {
      for (int row = 0; row < 12; ++row) append(cut_[child], matrix.row(row));
      continue;
    }
    const int lists = 6 + valences[child] - 3, first = 3 + 3 * child;
    for (int row = 0; row < 3; ++row) append(cut_[child], matrix.row((row + child) % 3));
    for (int row = 0; row < lists; ++row)
      append(cut_[child], matrix.row(3 + (first - 3 + row) % lists));
  }
}

int LimitPatch::extraordinary_at(double u, double v) const
{
  const double t[3] = {1.0 - u - v, u, v};
  for (int k = 0; k < 3; ++k)
    if (valences_[k] != 6 && t[k] >= 1.0 - LimitBasis::CORNER_RADIUS) return k;
  return -1;
}

void LimitPatch::move_inside(int corner, double &u, double &v)
{
  u = v = LimitBasis::INSIDE;
  if (corner == 1) u = 1.0 - 2.0 * LimitBasis::INSIDE;
  if (corner == 2) v = 1.0 - 2.0 * LimitBasis::INSIDE;
}

/* ----------------------------------------------------------------------
   towards corner k, with s = 1 - t_k: the corner child after d cuts has s <= 2^-d
------------------------------------------------------------------------- */

RegularPart LimitPatch::part_at(double u, double v) const
{
  RegularPart part;
  if (regular_) return part;
  double t[3] = {1.0 - u - v, u, v};
  int cuts = 0, corner = -1;
  for (int k = 0; k < 3; ++k) {
    if (valences_[k] == 6 || t[k] < 0.5) continue;
    corner = k;
    const double s = t[(k + 1) % 3] + t[(k + 2) % 3];
    int exponent;
    const double fraction = std::frexp(std::max(s, LimitBasis::CORNER_RADIUS), &exponent);
    cuts = std::clamp(fraction == 0.5 ? 1 - exponent : -exponent, 1, CornerTail::LEVELS);
  }

  // in the corner child: t_j' = 2^cuts t_j at the other corners, t_k' = 1 - 2^cuts s

  const double zoom = std::ldexp(1.0, cuts);
  double shift[3] = {0.0, 0.0, 0.0};
  if (corner >= 0) shift[corner] = 1.0 - zoom;
  part.corner = corner;
  part.level = cuts + 1;
  part.child = 3;
  for (int j = 0; j < 3; ++j)
    if (j != corner && zoom * t[j] + shift[j] >= 0.5) part.child = j;
  if (part.child == 3) {    // t_j'' = 1 - 2 t_j'
    part.scale = -2.0 * zoom;
    part.u0 = 1.0 - 2.0 * shift[1];
    part.v0 = 1.0 - 2.0 * shift[2];
  } else {    // t_j'' = 2 t_j', less 1 at the child's corner
    part.scale = 2.0 * zoom;
    part.u0 = 2.0 * shift[1] - (part.child == 1 ? 1.0 : 0.0);
    part.v0 = 2.0 * shift[2] - (part.child == 2 ? 1.0 : 0.0);
  }
  return part;
}

/* ----------------------------------------------------------------------
   The twelve control points of a part, relative to an origin nearby: the first corner, or the limit
   position of the corner that the part is cut towards.
------------------------------------------------------------------------- */

void LimitPatch::part_points(const RegularPart &part, const Lane4 *x, Lane4 &origin, Lane4 *y) const
{
  origin = x[0];
  auto apply = [&](const Sparse &matrix, Lane4 *out) {
    for (int row = 0; row < matrix.rows(); ++row) {
      Lane4 sum = Lane4::Zero();
      for (int e = matrix.start[row]; e < matrix.start[row + 1]; ++e)
        sum += matrix.weight[e] * (x[matrix.column[e]] - origin);
      out[row] = sum;
    }
  };
  if (part.corner < 0) {
    apply(cut_[part.child], y);
    return;
  }
  const CornerTail &tail = *tails_[part.corner];
  const int k = part.corner, size = tail.size();
  Lane4 around[MOST_VALENCE + 6];
  apply(cut_[k], around);
  const double *matrix = tail.child(part.level - 2, part.child == 3 ? 3 : (part.child - k + 3) % 3);
  for (int row = 0; row < 12; ++row, matrix += size) {
    Lane4 sum = Lane4::Zero();
    for (int c = 0; c < size; ++c) sum += matrix[c] * around[c];
    y[turned_column(k, row)] = sum;
  }
  for (int c = 0; c < size; ++c) origin += tail.mask()[c] * around[c];
}

void LimitPatch::polynomial(const RegularPart &part, const Lane4 *x, Lane4 &origin,
                            Quartics<4> &out) const
{
  std::array<Lane4, 12> y;
  if (regular_) {
    origin = x[0];
    for (int i = 0; i < 12; ++i) y[i] = x[i] - origin;
  } else
    part_points(part, x, origin, y.data());
  BoxSpline::polynomial(y, out);
}

Lane4 LimitPatch::corner_position(int corner, const Lane4 *x) const
{
  const Sparse &mask = mask_[corner];
  Lane4 sum = x[corner];
  for (size_t e = 0; e < mask.column.size(); ++e)
    sum += mask.weight[e] * (x[mask.column[e]] - x[corner]);
  return sum;
}

/* ----------------------------------------------------------------------
   the weights of the part's twelve points, times the matrices that part_points() applies
------------------------------------------------------------------------- */

template <int ORDER> void LimitPatch::weights(double u, double v, SurfaceWeights &out) const
{
  constexpr int ROWS = Derivative::rows(ORDER);
  const int corner = corner_at(u, v);
  if (corner >= 0) move_inside(corner, u, v);
  const RegularPart part = part_at(u, v);
  QuarticJet<12> jet;
  evaluate_quartics<ORDER, 12>(box_spline_quartics(), part.scale * u + part.u0,
                               part.scale * v + part.v0, part.scale, jet);
  out.resize(ROWS, size_);
  if (regular_) {
    for (int row = 0; row < ROWS; ++row) out.row(row) = jet[row].matrix().transpose();
    return;
  }
  out.setZero();

  auto apply = [&](const Sparse &matrix, int i, const double *factor, int stride) {
    for (int e = matrix.start[i]; e < matrix.start[i + 1]; ++e)
      for (int row = 0; row < ROWS; ++row)
        out(row, matrix.column[e]) += factor[row * stride] * matrix.weight[e];
  };
  double factor[ROWS][MOST_VALENCE + 6];
  if (part.corner < 0) {
    for (int i = 0; i < 12; ++i) {
      for (int row = 0; row < ROWS; ++row) factor[row][0] = jet[row][i];
      apply(cut_[part.child], i, factor[0], MOST_VALENCE + 6);
    }
  } else {
    const int k = part.corner;
    const CornerTail &tail = *tails_[k];
    const double *matrix =
        tail.child(part.level - 2, part.child == 3 ? 3 : (part.child - k + 3) % 3);
    for (int row = 0; row < ROWS; ++row)
      for (int c = 0; c < tail.size(); ++c)
        factor[row][c] = row == Derivative::VALUE ? tail.mask()[c] : 0.0;
    for (int i = 0; i < 12; ++i, matrix += tail.size())
      for (int row = 0; row < ROWS; ++row) {
        const double w = jet[row][turned_column(k, i)];
        for (int c = 0; c < tail.size(); ++c) factor[row][c] += w * matrix[c];
      }
    for (int c = 0; c < tail.size(); ++c) apply(cut_[k], c, &factor[0][c], MOST_VALENCE + 6);
  }
  if (corner >= 0) {
    out.row(Derivative::VALUE).setZero();
    const Sparse &mask = mask_[corner];
    for (size_t e = 0; e < mask.column.size(); ++e)
      out(Derivative::VALUE, mask.column[e]) += mask.weight[e];
  }
}

template void LimitPatch::weights<0>(double, double, SurfaceWeights &) const;
template void LimitPatch::weights<1>(double, double, SurfaceWeights &) const;
template void LimitPatch::weights<2>(double, double, SurfaceWeights &) const;
template void LimitPatch::weights<3>(double, double, SurfaceWeights &) const;

double LimitPatch::memory_usage() const
{
  double bytes = sizeof(LimitPatch);
  auto add = [&bytes](const Sparse &sparse) {
    bytes += sizeof(int) * (sparse.start.capacity() + sparse.column.capacity()) +
        sizeof(double) * sparse.weight.capacity();
  };
  for (const Sparse &sparse : cut_) add(sparse);
  for (const Sparse &sparse : mask_) add(sparse);
  return bytes;
}

/* ---------------------------------------------------------------------- */

const LimitPatch &LimitPatches::get(const Valences &valences)
{
  const auto found = patches_.find(valences);
  if (found != patches_.end()) return found->second;
  std::array<const CornerTail *, 3> tails = {nullptr, nullptr, nullptr};
  for (int k = 0; k < 3; ++k) {
    const int n = valences[k];
    if (n > MOST_VALENCE)
      throw MeshError("a face has a corner of valence " + std::to_string(n) + "; at most " +
                      std::to_string(MOST_VALENCE) + " edges may meet in a vertex: remesh there");
    if (n != 6) tails[k] = &tails_.try_emplace(n, n).first->second;
  }
  return patches_.try_emplace(valences, valences, tails).first->second;
}

double LimitPatches::memory_usage() const
{
  double bytes = 0.0;
  for (const auto &entry : tails_) bytes += entry.second.memory_usage();
  for (const auto &entry : patches_) bytes += entry.second.memory_usage();
  return bytes;
}
