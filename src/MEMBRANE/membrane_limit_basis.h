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

#ifndef LMP_MEMBRANE_LIMIT_BASIS_H
#define LMP_MEMBRANE_LIMIT_BASIS_H

#include "membrane_quartic.h"
#include "membrane_topology.h"

#include <Eigen/Core>
#include <array>

namespace Membrane_NS {

// === Loop's subdivision rule

/// Loop's own vertex weight: a vertex of valence n moves to (1 - n beta) v + beta sum(ring).
double loop_beta(int n);
/// The limit mask: limit position = c v + (1 - c)/n sum(ring); c = 0.5 at valence 6.
double limit_mask_centre(int n);
/// The factor by which a neighbourhood of valence n shrinks in one subdivision, 1/2 at valence 6.
double subdominant_eigenvalue(int n);
/// The factor by which the bending energy of a ring of patches shrinks in one subdivision.
double energy_decay(int n);

/** The limit surface over one face as a linear combination of control points, for any valences.

    A point on the face is corner0 (1-u-v) + corner1 u + corner2 v, 0 <= u, v, u+v <= 1. Weights
    come as rows VALUE, DU, DV, DUU, DUV, DVV, a column for each point of Topology::stencil().
    Exact to rounding everywhere but within 1e-9 of an extraordinary corner, where derivatives of
    the parametrisation do not exist: there the derivative rows are those 1/64 inside the face.

    Method: regular faces (valences 6, 6, 6) are quartic box splines; others are subdivided until
    the point lies in a regular child [J. Stam, Evaluation of Loop Subdivision Surfaces, SIGGRAPH
    1998], by recursion, since at valence 3 the subdivision matrix cannot be diagonalised. */
class LimitBasis {
 public:
  enum Row { VALUE, DU, DV, DUU, DUV, DVV, ROWS };
  static constexpr double CORNER_RADIUS = 1.0e-9;    ///< closer than this is at the corner
  static constexpr double INSIDE = 1.0 / 64.0;       ///< where derivatives are then taken
  using Weights = Eigen::Matrix<double, ROWS, Eigen::Dynamic, Eigen::RowMajor>;

  explicit LimitBasis(const Valences &valences);

  const Valences &valences() const { return valences_; }
  bool is_regular() const { return valences_ == Valences{6, 6, 6}; }
  /// Number of control points that shape the face.
  int size() const { return size_; }

  /// Weights at (u, v); derivatives are with respect to the u, v of this face.
  Weights evaluate(double u, double v) const;

  // === Subdivision into four children: 0, 1, 2 keep that corner, 3 lies in the middle

  /// Valences of a child; corner child k keeps valence k in slot k, all new vertices have 6.
  Valences child_valences(int child) const;
  /// The child's control points from this face's: a (child size) x size matrix.
  Eigen::MatrixXd child_matrix(int child) const;
  /// The limit position of a corner: a row of size() weights that sum to 1.
  Eigen::RowVectorXd corner_mask(int corner) const;

 private:
  Valences valences_;
  int size_;
  std::array<int, 3> list_start_;    // where each corner's part of the ring begins in the stencil
  std::array<Eigen::VectorXi, 3> ring_;

  Eigen::RowVectorXd vertex_point(int corner) const;
  Eigen::RowVectorXd edge_point(int corner, int i) const;
};

/// Weights of the regular face (12 control points) at (u, v).
LimitBasis::Weights box_spline(double u, double v);
/// The same weights as polynomials in u and v, a lane for each control point.
const Quartics<12> &box_spline_quartics();

}    // namespace Membrane_NS

#endif
