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

using namespace Membrane_NS;

/* ---------------------------------------------------------------------- */

SparseCholesky::SparseCholesky(const Eigen::SparseMatrix<double> &a)
{
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor(a);
  if (factor.info() != Eigen::Success)
    throw MeshError("the mass matrix cannot be factorized: its masses differ too much");
  const auto &permutation = factor.permutationP().indices();
  place_.assign(permutation.data(), permutation.data() + permutation.size());
  const Eigen::SparseMatrix<double> columns = factor.matrixL();
  const Eigen::SparseMatrix<double, Eigen::RowMajor> rows = columns;
  const auto copy = [](const auto &g, Lines &lines, std::vector<double> *inverse_diagonal) {
    lines.start.assign(1, 0);
    for (int j = 0; j < g.outerSize(); ++j) {
      for (typename std::decay_t<decltype(g)>::InnerIterator entry(g, j); entry; ++entry) {
        if (entry.row() != entry.col()) {
          lines.place.push_back(static_cast<int>(entry.index()));
          lines.value.push_back(entry.value());
        } else if (inverse_diagonal)
          inverse_diagonal->push_back(1.0 / entry.value());
      }
      lines.start.push_back(static_cast<int>(lines.place.size()));
    }
  };
  copy(columns, columns_, &inverse_diagonal_);
  copy(rows, rows_, nullptr);
}

/* ----------------------------------------------------------------------
   G y = P x by rows of G, from the first to the last, G^T z = y by its columns, from the last to the
   first: each time what is known of the others is taken off, in four sums, so that one does not wait
   for the other. Fields of a vertex are side by side in z
------------------------------------------------------------------------- */

template <class Number, int FIELDS>
void SparseCholesky::eliminate(int j, const Lines &lines, Number *z) const
{
  constexpr int SUMS = 4;
  const int *place = lines.place.data(), last = lines.start[j + 1];
  const double *value = lines.value.data();
  Number sum[SUMS][FIELDS] = {};
  for (int f = 0; f < FIELDS; ++f) sum[0][f] = z[FIELDS * j + f];
  int k = lines.start[j];
  for (; k + SUMS <= last; k += SUMS)
    for (int i = 0; i < SUMS; ++i)
      for (int f = 0; f < FIELDS; ++f) sum[i][f] -= value[k + i] * z[FIELDS * place[k + i] + f];
  for (; k < last; ++k)
    for (int f = 0; f < FIELDS; ++f) sum[0][f] -= value[k] * z[FIELDS * place[k] + f];
  for (int f = 0; f < FIELDS; ++f)
    z[FIELDS * j + f] =
        inverse_diagonal_[j] * ((sum[0][f] + sum[1][f]) + (sum[2][f] + sum[3][f]));
}

template <int FIELDS> void SparseCholesky::solve(const std::array<VertexField *, FIELDS> &x)
{
  const int n = size();
  work_.resize((size_t) FIELDS * n);
  for (int i = 0; i < n; ++i)
    for (int f = 0; f < FIELDS; ++f) work_[FIELDS * place_[i] + f] = (*x[f])[i];
  Quad *z = reinterpret_cast<Quad *>(work_.data());
  for (int j = 0; j < n; ++j) eliminate<Quad, FIELDS>(j, rows_, z);
  for (int j = n - 1; j >= 0; --j) eliminate<Quad, FIELDS>(j, columns_, z);
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
  for (int j = 0; j < n; ++j) eliminate<double, 1>(j, rows_, scalar_work_.data());
  for (int j = n - 1; j >= 0; --j) eliminate<double, 1>(j, columns_, scalar_work_.data());
  for (int i = 0; i < n; ++i) x[i] = scalar_work_[place_[i]];
}

void SparseCholesky::colour(VertexField &x)
{
  const int n = size();
  work_.resize(n);
  for (int i = 0; i < n; ++i) work_[place_[i]] = x[i];
  Quad *z = reinterpret_cast<Quad *>(work_.data());
  for (int j = n - 1; j >= 0; --j) eliminate<Quad, 1>(j, columns_, z);
  for (int i = 0; i < n; ++i) x[i] = work_[place_[i]];
}

void SparseCholesky::colour(std::vector<double> &x)
{
  const int n = size();
  scalar_work_.resize(n);
  for (int i = 0; i < n; ++i) scalar_work_[place_[i]] = x[i];
  for (int j = n - 1; j >= 0; --j) eliminate<double, 1>(j, columns_, scalar_work_.data());
  for (int i = 0; i < n; ++i) x[i] = scalar_work_[place_[i]];
}

double SparseCholesky::memory_usage() const
{
  double bytes = sizeof(int) * place_.capacity() + sizeof(double) * inverse_diagonal_.capacity() +
      sizeof(Vector4) * work_.capacity() + sizeof(double) * scalar_work_.capacity();
  for (const Lines *lines : {&rows_, &columns_})
    bytes += sizeof(int) * (lines->start.capacity() + lines->place.capacity()) +
        sizeof(double) * lines->value.capacity();
  return bytes;
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
