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

#ifndef LMP_MEMBRANE_THREEFOLD_H
#define LMP_MEMBRANE_THREEFOLD_H

#include <vector>

namespace Membrane_NS {

/** Three points of a regular face, one on each axis of its symmetry, at the same place of it.

    Axis i goes from corner i to the middle of the edge across; there the parameters a along it and b to its left, of
    determinant 1 to u and v, take the place of these. The twelve control points are, for i = 0, 1, 2, corner a_i, the point
    b_i across the edge that faces it, and p_i and q_i, which only that corner touches and which the mirror of axis i
    exchanges. With s_i = p_i + q_i and d_i = p_i - q_i, and as long as the rule is symmetric, each row is made of four
    of eight combinations, even or odd under that mirror, and sums over the three axes, since for any t
      t_i+1 + t_i+2 = (t_0 + t_1 + t_2) - t_i:
      even rows (value, a, aa, bb): a_i, b_i, s_i, d_i+1 - d_i+2, and sums of a, b, s;
      odd rows (b, ab): a_i+1 - a_i+2, b_i+1 - b_i+2, s_i+1 - s_i+2, d_i, and the sum of d.
    24 multiplications for the six rows at a point, and 11 for three of them, where the rows themselves take 72. */
struct ThreefoldPoint {
  enum EvenRow { VALUE, DA, DAA, DBB, EVEN_ROWS };
  enum OddRow { DB, DAB, ODD_ROWS };
  double weight, area_weight;
  double even[4][EVEN_ROWS], even_sum[3][EVEN_ROWS];    ///< [combination][row]
  double odd[4][ODD_ROWS], odd_sum[ODD_ROWS];
};

/// The columns of control points in the stencil of a regular face.
namespace Threefold {
  constexpr int next(int i) { return (i + 1) % 3; }
  constexpr int prev(int i) { return (i + 2) % 3; }
  constexpr int corner(int i) { return i; }
  constexpr int across(int i) { return 3 + 3 * prev(i); }
  constexpr int p(int i) { return 4 + 3 * i; }
  constexpr int q(int i) { return 5 + 3 * i; }
}

/** The points of a rule of a regular face in threes; none if there are others besides. weight and area_weight: [points];
    rows: [points][LimitBasis::ROWS][12]. */
std::vector<ThreefoldPoint> threefold_points(const std::vector<double> &weight, const std::vector<double> &area_weight,
                                             const std::vector<double> &rows);

}    // namespace Membrane_NS

#endif
