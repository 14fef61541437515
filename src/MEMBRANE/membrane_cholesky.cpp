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

#include "membrane_cholesky.h"

#include "membrane_topology.h"

#include <Eigen/SparseCholesky>

#include <type_traits>

using namespace Membrane_NS;

static constexpr int MOST = 6;              // columns of a panel, whose numbers stay in registers
static constexpr double ZEROS = 0.25;       // stored for each number that is not, at most

/* ---------------------------------------------------------------------- */

SparseCholesky::SparseCholesky(const Eigen::SparseMatrix<double> &a)
{
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor(a);
  if (factor.info() != Eigen::Success)
    throw MeshError("the mass matrix cannot be factorized: its masses differ too much");
  const auto &permutation = factor.permutationP().indices();
  place_.assign(permutation.data(), permutation.data() + permutation.size());
  make_panels(factor.matrixL());
}

/* ----------------------------------------------------------------------
   A column whose first row below the diagonal is that of the next column has all its other rows there,
   too. So the next one joins its panel if that stores few zeros
------------------------------------------------------------------------- */

void SparseCholesky::make_panels(const Eigen::SparseMatrix<double> &g)
{
  const int n = static_cast<int>(g.cols()), *start = g.outerIndexPtr(), *row = g.innerIndexPtr();
  const auto below = [start](int j) { return start[j + 1] - start[j] - 1; };
  std::vector<int> place(n);    // of a row in a panel, from its first column on
  for (int first = 0; first < n;) {
    int last = first;
    size_t numbers = 1 + below(first);
    while (last + 1 < n && last + 1 < first + MOST && below(last) > 0 && row[start[last] + 1] == last + 1) {
      const size_t width = last + 2 - first, more = numbers + 1 + below(last + 1);
      const size_t stored = width * (width + 1) / 2 + width * below(last + 1);
      if (stored - more > ZEROS * more) break;
      numbers = more;
      ++last;
    }
    const Panel panel = {first, last + 1 - first, static_cast<int>(row_.size()), below(last), value_.size()};
    panels_.push_back(panel);
    for (int j = first; j <= last; ++j) place[j] = j - first;
    for (int k = start[last] + 1; k < start[last + 1]; ++k) {
      place[row[k]] = panel.width + k - start[last] - 1;
      row_.push_back(row[k]);
    }
    value_.resize(panel.value + (size_t) panel.width * (panel.width + panel.num_rows), 0.0);
    for (int j = first; j <= last; ++j)
      for (int k = start[j]; k < start[j + 1]; ++k) {
        const double value = g.valuePtr()[k];
        value_[panel.value + (size_t) panel.width * place[row[k]] + (j - first)] =
            row[k] == j ? 1.0 / value : value;
      }
    first = last + 1;
  }
}

/* ----------------------------------------------------------------------
   G y = P x panel by panel from the first to the last, each of which takes what is then known off the
   rows below; G^T z = y from the last to the first, from which what is known of the rows below is taken
   off. Fields of a vertex are side by side in z
------------------------------------------------------------------------- */

namespace {

template <int WIDTH, class Number, int FIELDS>
void forwards(const double *value, const int *row, int num_rows, Number *first, Number *z)
{
  Number y[WIDTH][FIELDS];
  for (int k = 0; k < WIDTH; ++k)
    for (int f = 0; f < FIELDS; ++f) {
      Number sum = first[FIELDS * k + f];
      for (int l = 0; l < k; ++l) sum -= value[WIDTH * k + l] * y[l][f];
      first[FIELDS * k + f] = y[k][f] = value[WIDTH * k + k] * sum;
    }
  value += WIDTH * WIDTH;
  for (int i = 0; i < num_rows; ++i, value += WIDTH) {
    Number *below = z + (size_t) FIELDS * row[i];
    for (int f = 0; f < FIELDS; ++f) {
      Number sum = below[f];
      for (int k = 0; k < WIDTH; ++k) sum -= value[k] * y[k][f];
      below[f] = sum;
    }
  }
}

template <int WIDTH, class Number, int FIELDS>
void backwards(const double *value, const int *row, int num_rows, Number *first, const Number *z)
{
  constexpr int SUMS = WIDTH * FIELDS < 3 ? 4 : WIDTH * FIELDS < 6 ? 2 : 1;    // that need not wait for each other
  Number sum[SUMS][WIDTH][FIELDS] = {};
  for (int k = 0; k < WIDTH; ++k)
    for (int f = 0; f < FIELDS; ++f) sum[0][k][f] = first[FIELDS * k + f];
  const double *rest = value + WIDTH * WIDTH;
  int i = 0;
  for (; i + SUMS <= num_rows; i += SUMS)
    for (int s = 0; s < SUMS; ++s, rest += WIDTH) {
      const Number *below = z + (size_t) FIELDS * row[i + s];
      for (int k = 0; k < WIDTH; ++k)
        for (int f = 0; f < FIELDS; ++f) sum[s][k][f] -= rest[k] * below[f];
    }
  for (; i < num_rows; ++i, rest += WIDTH)
    for (int k = 0; k < WIDTH; ++k)
      for (int f = 0; f < FIELDS; ++f) sum[0][k][f] -= rest[k] * z[(size_t) FIELDS * row[i] + f];
  for (int s = 1; s < SUMS; ++s)
    for (int k = 0; k < WIDTH; ++k)
      for (int f = 0; f < FIELDS; ++f) sum[0][k][f] += sum[s][k][f];
  for (int k = WIDTH - 1; k >= 0; --k)
    for (int f = 0; f < FIELDS; ++f) {
      Number &one = sum[0][k][f];
      for (int l = k + 1; l < WIDTH; ++l) one -= value[WIDTH * l + k] * sum[0][l][f];
      first[FIELDS * k + f] = one *= value[WIDTH * k + k];
    }
}

/// Calls use(std::integral_constant<int, width>).
template <int MOST_WIDTH, class Use> void with_width(int width, const Use &use)
{
  if constexpr (MOST_WIDTH > 1)
    if (width < MOST_WIDTH) return with_width<MOST_WIDTH - 1>(width, use);
  use(std::integral_constant<int, MOST_WIDTH>());
}

}    // namespace

template <class Number, int FIELDS> void SparseCholesky::forwards(Number *z) const
{
  for (const Panel &p : panels_)
    with_width<MOST>(p.width, [&](auto width) {
      ::forwards<width.value, Number, FIELDS>(&value_[p.value], row_.data() + p.row, p.num_rows,
                                              z + (size_t) FIELDS * p.first, z);
    });
}

template <class Number, int FIELDS> void SparseCholesky::backwards(Number *z) const
{
  for (size_t i = panels_.size(); i-- > 0;) {
    const Panel &p = panels_[i];
    with_width<MOST>(p.width, [&](auto width) {
      ::backwards<width.value, Number, FIELDS>(&value_[p.value], row_.data() + p.row, p.num_rows,
                                               z + (size_t) FIELDS * p.first, z);
    });
  }
}

template <int FIELDS> void SparseCholesky::solve(const std::array<VertexField *, FIELDS> &x)
{
  const int n = size();
  work_.resize((size_t) FIELDS * n);
  for (int i = 0; i < n; ++i)
    for (int f = 0; f < FIELDS; ++f) work_[FIELDS * place_[i] + f] = (*x[f])[i];
  Quad *z = reinterpret_cast<Quad *>(work_.data());
  forwards<Quad, FIELDS>(z);
  backwards<Quad, FIELDS>(z);
  for (int i = 0; i < n; ++i)
    for (int f = 0; f < FIELDS; ++f) (*x[f])[i] = work_[FIELDS * place_[i] + f];
}

template void SparseCholesky::solve<1>(const std::array<VertexField *, 1> &);
template void SparseCholesky::solve<2>(const std::array<VertexField *, 2> &);

void SparseCholesky::solve(std::vector<double> &x)
{
  const int n = size();
  scalar_work_.resize(n);
  for (int i = 0; i < n; ++i) scalar_work_[place_[i]] = x[i];
  forwards<double, 1>(scalar_work_.data());
  backwards<double, 1>(scalar_work_.data());
  for (int i = 0; i < n; ++i) x[i] = scalar_work_[place_[i]];
}

void SparseCholesky::colour(VertexField &x)
{
  const int n = size();
  work_.resize(n);
  for (int i = 0; i < n; ++i) work_[place_[i]] = x[i];
  backwards<Quad, 1>(reinterpret_cast<Quad *>(work_.data()));
  for (int i = 0; i < n; ++i) x[i] = work_[place_[i]];
}

void SparseCholesky::colour(std::vector<double> &x)
{
  const int n = size();
  scalar_work_.resize(n);
  for (int i = 0; i < n; ++i) scalar_work_[place_[i]] = x[i];
  backwards<double, 1>(scalar_work_.data());
  for (int i = 0; i < n; ++i) x[i] = scalar_work_[place_[i]];
}

// forwards for x alone, then back for both side by side: G is read twice and not three times

template <class Number, class Field>
void SparseCholesky::solve_and_colour(std::vector<Field> &work, std::vector<Field> &x, std::vector<Field> &z)
{
  const int n = size();
  work.resize(3 * (size_t) n);
  Field *alone = work.data(), *both = alone + n;
  for (int i = 0; i < n; ++i) alone[place_[i]] = x[i];
  forwards<Number, 1>(reinterpret_cast<Number *>(alone));
  for (int i = 0; i < n; ++i) {
    both[2 * place_[i]] = alone[place_[i]];
    both[2 * place_[i] + 1] = z[i];
  }
  backwards<Number, 2>(reinterpret_cast<Number *>(both));
  for (int i = 0; i < n; ++i) {
    x[i] = both[2 * place_[i]];
    z[i] = both[2 * place_[i] + 1];
  }
}

void SparseCholesky::solve_and_colour(VertexField &x, VertexField &z)
{
  solve_and_colour<Quad>(work_, x, z);
}

void SparseCholesky::solve_and_colour(std::vector<double> &x, std::vector<double> &z)
{
  solve_and_colour<double>(scalar_work_, x, z);
}

double SparseCholesky::memory_usage() const
{
  return sizeof(int) * (place_.capacity() + row_.capacity()) + sizeof(Panel) * panels_.capacity() +
      sizeof(double) * (value_.capacity() + scalar_work_.capacity()) +
      sizeof(Vector4) * work_.capacity();
}

/* ---------------------------------------------------------------------- */

PartCholesky::PartCholesky(VertexPart &part, const Eigen::SparseMatrix<double> &a) :
    part_(part), factor_(a), all_x_(a.rows(), Vector4{}), all_y_(all_x_)
{
}

void PartCholesky::scatter(const VertexField &all, VertexField &x) const
{
  for (int i = 0; i < part_.owned; ++i) x[i] = all[part_.vertices[i]];
}

void PartCholesky::solve(VertexField &x)
{
  part_.gather(x, all_x_);
  factor_.solve(all_x_);
  scatter(all_x_, x);
}

void PartCholesky::solve(VertexField &x, VertexField &y)
{
  part_.gather(x, all_x_);
  part_.gather(y, all_y_);
  factor_.solve(all_x_, all_y_);
  scatter(all_x_, x);
  scatter(all_y_, y);
}

double PartCholesky::memory_usage() const
{
  return factor_.memory_usage() + sizeof(Vector4) * (all_x_.capacity() + all_y_.capacity());
}
