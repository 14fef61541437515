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
  const Eigen::SparseMatrix<double> g = factor.matrixL();
  start_.assign(1, 0);
  for (int j = 0; j < g.cols(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(g, j); entry; ++entry) {
      if (entry.row() == j) {
        inverse_diagonal_.push_back(1.0 / entry.value());
        continue;
      }
      row_.push_back(static_cast<int>(entry.row()));
      value_.push_back(entry.value());
    }
    start_.push_back(static_cast<int>(row_.size()));
  }
}

/* ----------------------------------------------------------------------
   G y = P x by columns, G^T z = y by rows of G^T, which are columns of G, too; the latter in four sums, so
   that one does not wait for the other
------------------------------------------------------------------------- */

template <int FIELDS> void SparseCholesky::solve(const std::array<VertexField *, FIELDS> &x)
{
  const int n = size();
  const int *start = start_.data(), *row = row_.data();
  const double *value = value_.data();
  work_.resize((size_t) FIELDS * n);
  Vector4 *z = work_.data();    // fields of a vertex side by side
  for (int i = 0; i < n; ++i)
    for (int f = 0; f < FIELDS; ++f) z[FIELDS * place_[i] + f] = (*x[f])[i];
  for (int j = 0; j < n; ++j) {
    Quad here[FIELDS];
    for (int f = 0; f < FIELDS; ++f)
      quad(z[FIELDS * j + f]) = here[f] = inverse_diagonal_[j] * quad(z[FIELDS * j + f]);
    for (int k = start[j]; k < start[j + 1]; ++k)
      for (int f = 0; f < FIELDS; ++f) quad(z[FIELDS * row[k] + f]) -= value[k] * here[f];
  }
  constexpr int SUMS = 4;
  for (int j = n - 1; j >= 0; --j) {
    Quad sum[SUMS][FIELDS] = {};
    for (int f = 0; f < FIELDS; ++f) sum[0][f] = quad(z[FIELDS * j + f]);
    int k = start[j];
    for (; k + SUMS <= start[j + 1]; k += SUMS)
      for (int i = 0; i < SUMS; ++i)
        for (int f = 0; f < FIELDS; ++f)
          sum[i][f] -= value[k + i] * quad(z[FIELDS * row[k + i] + f]);
    for (; k < start[j + 1]; ++k)
      for (int f = 0; f < FIELDS; ++f) sum[0][f] -= value[k] * quad(z[FIELDS * row[k] + f]);
    for (int f = 0; f < FIELDS; ++f)
      quad(z[FIELDS * j + f]) = inverse_diagonal_[j] * ((sum[0][f] + sum[1][f]) + (sum[2][f] + sum[3][f]));
  }
  for (int i = 0; i < n; ++i)
    for (int f = 0; f < FIELDS; ++f) (*x[f])[i] = z[FIELDS * place_[i] + f];
}

template void SparseCholesky::solve<1>(const std::array<VertexField *, 1> &);
template void SparseCholesky::solve<2>(const std::array<VertexField *, 2> &);

double SparseCholesky::memory_usage() const
{
  return sizeof(int) * (place_.capacity() + start_.capacity() + row_.capacity()) +
      sizeof(double) * (value_.capacity() + inverse_diagonal_.capacity()) +
      sizeof(Vector4) * work_.capacity();
}
