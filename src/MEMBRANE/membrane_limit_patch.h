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

#ifndef LMP_MEMBRANE_LIMIT_PATCH_H
#define LMP_MEMBRANE_LIMIT_PATCH_H

#include "membrane_limit_basis.h"

#include <map>
#include <vector>

namespace Membrane_NS {

/// x, y, z and 0: a register of the vector unit.
using Lane4 = Lanes<4>;

/// Weights by Derivative::Row, a column for each point of Topology::stencil(). Never allocates.
using SurfaceWeights = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor,
                                     Derivative::ROWS, MOST_STENCIL>;

/** A part of a face on which the limit surface is one polynomial of degree 4: the face itself if it is
    regular, else the part of it that a number of cuts in four leaves. In the part's own parameters
    x = scale u + u0, y = scale v + v0 it is the triangle 0 <= x, y, x + y <= 1. */
struct RegularPart {
  int corner = -1;    ///< the extraordinary corner that it is cut towards, or -1
  int level = 0;      ///< number of cuts
  int child = 0;      ///< which child of the last cut, see LimitBasis
  double scale = 1.0, u0 = 0.0, v0 = 0.0;

  bool contains(double u, double v) const
  {
    const double x = scale * u + u0, y = scale * v + v0;
    return x >= 0.0 && y >= 0.0 && x + y <= 1.0;
  }
};

/** The powers of the subdivision matrix around a corner of valence n, which are the same for all faces
    that have such a corner.

    Let A be the child matrix of corner 0 of a face (n, 6, 6), m its limit mask and 1 a column of
    ones; A 1 = 1 and m A = m. Then A^k = 1 m + B^k with B = A - 1 m, whose powers fall as those of the
    subdominant eigenvalue and keep their relative accuracy, while in those of A they would drown in
    rounding. */
class CornerTail {
 public:
  static constexpr int LEVELS = 30;    // 2^-30 is less than the radius of a corner

  explicit CornerTail(int valence);

  int size() const { return size_; }
  /// The limit mask of the corner. Length size().
  const double *mask() const { return mask_.data(); }
  /// Child 1, 2 or 3 after k cuts: P_child B^k (of k = 0: P_child (1 - 1 m)), [12][size()].
  const double *child(int k, int child) const
  {
    return table_.data() + (static_cast<size_t>(k) * 3 + child - 1) * 12 * size_;
  }
  double memory_usage() const { return sizeof(double) * (mask_.capacity() + table_.capacity()); }

 private:
  int size_;
  std::vector<double> mask_, table_;
};

/** The limit surface over a face of given valences, for evaluation at single points: what LimitBasis
    works out anew for each point is a table here. Nothing allocates but the constructor. */
class LimitPatch {
 public:
  /// The tails of the corners that are not regular; they must outlive this.
  LimitPatch(const Valences &valences, const std::array<const CornerTail *, 3> &tails);

  int size() const { return size_; }
  bool is_regular() const { return regular_; }

  /// The extraordinary corner that (u, v) is at, in the sense of LimitBasis, or -1.
  int corner_at(double u, double v) const { return regular_ ? -1 : extraordinary_at(u, v); }
  /// (u, v) moved from a corner to where LimitBasis takes derivatives instead.
  static void move_inside(int corner, double &u, double &v);

  RegularPart part_at(double u, double v) const;

  /** The polynomial of a part, relative to `origin`: that and the coefficients have x, y, z, 0.
      x: the control points, length size(). */
  void polynomial(const RegularPart &part, const Lane4 *x, Lane4 &origin, Quartics<4> &out) const;
  /// The limit position of a corner.
  Lane4 corner_position(int corner, const Lane4 *x) const;

  /// Rows up to ORDER, size() columns.
  template <int ORDER> void weights(double u, double v, SurfaceWeights &out) const;

  double memory_usage() const;

 private:
  // a matrix with few entries in a row
  struct Sparse {
    std::vector<int> start, column;
    std::vector<double> weight;
    int rows() const { return static_cast<int>(start.size()) - 1; }
  };

  int extraordinary_at(double u, double v) const;

  Valences valences_;
  int size_;
  bool regular_;
  std::array<const CornerTail *, 3> tails_;
  std::array<Sparse, 4> cut_;     // the four children; a corner child's own corner comes first
  std::array<Sparse, 3> mask_;    // of the corners

  void part_points(const RegularPart &part, const Lane4 *x, Lane4 &origin, Lane4 *y) const;
};

/// Makes the patches of a mesh and keeps them; references stay valid.
class LimitPatches {
 public:
  /// MeshError for a valence beyond MOST_VALENCE.
  const LimitPatch &get(const Valences &valences);
  double memory_usage() const;

 private:
  std::map<int, CornerTail> tails_;
  std::map<Valences, LimitPatch> patches_;
};

}    // namespace Membrane_NS

#endif
