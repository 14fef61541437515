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
  work_.resize(place_.size());
}

/* ----------------------------------------------------------------------
   G y = P x by columns, G^T z = y by rows of G^T, which are columns of G, too; the latter in four sums, so
   that one does not wait for the other
------------------------------------------------------------------------- */

void SparseCholesky::solve(VertexField &x)
{
  const int n = size();
  const int *start = start_.data(), *row = row_.data();
  const double *value = value_.data();
  Vector4 *z = work_.data();
  for (int i = 0; i < n; ++i) z[place_[i]] = x[i];
  for (int j = 0; j < n; ++j) {
    const Quad here = inverse_diagonal_[j] * quad(z[j]);
    quad(z[j]) = here;
    for (int k = start[j]; k < start[j + 1]; ++k) quad(z[row[k]]) -= value[k] * here;
  }
  for (int j = n - 1; j >= 0; --j) {
    Quad sum[4] = {quad(z[j]), Quad{}, Quad{}, Quad{}};
    int k = start[j];
    for (; k + 4 <= start[j + 1]; k += 4)
      for (int i = 0; i < 4; ++i) sum[i] -= value[k + i] * quad(z[row[k + i]]);
    for (; k < start[j + 1]; ++k) sum[0] -= value[k] * quad(z[row[k]]);
    quad(z[j]) = inverse_diagonal_[j] * ((sum[0] + sum[1]) + (sum[2] + sum[3]));
  }
  for (int i = 0; i < n; ++i) x[i] = z[place_[i]];
}

double SparseCholesky::memory_usage() const
{
  return sizeof(int) * (place_.capacity() + start_.capacity() + row_.capacity()) +
      sizeof(double) * (value_.capacity() + inverse_diagonal_.capacity()) +
      sizeof(Vector4) * work_.capacity();
}
