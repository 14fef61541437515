/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

#ifndef LMP_MEMBRANE_CHOLESKY_H
#define LMP_MEMBRANE_CHOLESKY_H

#include "membrane_vertex_part.h"

#include <Eigen/SparseCore>

#include <array>
#include <vector>

namespace Membrane_NS {

/** A symmetric, positive definite sparse matrix A, factorized: P A P^T = G G^T with a permutation P
    that keeps G sparse, which Eigen finds. Solves for the four numbers of a vertex at once, or for one. */
class SparseCholesky {
 public:
  /// Both triangles of A, or the lower one. MeshError if it is not positive definite.
  explicit SparseCholesky(const Eigen::SparseMatrix<double> &a);
  int size() const { return static_cast<int>(place_.size()); }
  /// x = A^-1 x
  void solve(VertexField &x) { solve<1>({&x}); }
  /// The same for two, in less than the time of one after the other.
  void solve(VertexField &x, VertexField &y) { solve<2>({&x, &y}); }
  void solve(std::vector<double> &x);
  /// x = P^T G^-T x, so that white noise becomes noise with <x x^T> = A^-1
  void colour(VertexField &x);
  void colour(std::vector<double> &x);
  /// x = A^-1 x and z coloured, in less than the time of one after the other.
  void solve_and_colour(VertexField &x, VertexField &z);
  void solve_and_colour(std::vector<double> &x, std::vector<double> &z);
  /// Numbers of G that are stored.
  size_t fill() const { return value_.size(); }
  double memory_usage() const;

 private:
  std::vector<int> place_;    // of a row of A in G
  /** Columns of G side by side that are not zero in the same rows below, or nearly so: what is read
      of these rows serves all columns. */
  struct Panel {
    int first, width;     // columns
    int row, num_rows;    // the rows below, in row_
    size_t value;         // of value_: width^2 on the diagonal, there inverse, then the rows below
  };
  std::vector<Panel> panels_;
  std::vector<int> row_;
  std::vector<double> value_;
  VertexField work_;
  std::vector<double> scalar_work_;

  void make_panels(const Eigen::SparseMatrix<double> &g);
  template <class Number, int FIELDS> void forwards(Number *z) const;
  template <class Number, int FIELDS> void backwards(Number *z) const;
  template <int FIELDS> void solve(const std::array<VertexField *, FIELDS> &x);
  template <class Number, class Field>
  void solve_and_colour(std::vector<Field> &work, std::vector<Field> &x, std::vector<Field> &z);
};

/** A matrix over all vertices of a mesh, factorized, for fields on the part of a rank. Every rank holds
    all of it and does all the work. Solutions are collective. */
class PartCholesky {
 public:
  /// The part must outlive this.
  PartCholesky(VertexPart &part, const Eigen::SparseMatrix<double> &a);
  /// x = A^-1 x, of owned vertices
  void solve(VertexField &x);
  /// The same for two.
  void solve(VertexField &x, VertexField &y);
  double memory_usage() const;

 private:
  VertexPart &part_;
  SparseCholesky factor_;
  VertexField all_x_, all_y_;    // by vertex of the topology

  void scatter(const VertexField &all, VertexField &x) const;
};

}    // namespace Membrane_NS

#endif
