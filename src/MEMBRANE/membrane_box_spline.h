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

#ifndef LMP_MEMBRANE_BOX_SPLINE_H
#define LMP_MEMBRANE_BOX_SPLINE_H

#include "membrane_quartic.h"

namespace Membrane_NS {

/** The twelve quartic box splines of a regular face in the order of Topology::stencil(), times 12, as
    polynomials in the barycentric coordinates t0 = 1-u-v, t1 = u, t2 = v [Stam 1998, appendix A].
    By symmetry there are three kinds; a, b, c below are the corner meant and the next two. */
namespace BoxSpline {

  struct Monomial {
    int coefficient, a, b, c;
  };
  template <std::size_t N> using Polynomial = std::array<Monomial, N>;

  /// A corner of the face.
  constexpr Polynomial<15> CORNER = {{{6, 4, 0, 0},
                                      {24, 3, 1, 0},
                                      {24, 3, 0, 1},
                                      {24, 2, 2, 0},
                                      {60, 2, 1, 1},
                                      {24, 2, 0, 2},
                                      {8, 1, 3, 0},
                                      {36, 1, 2, 1},
                                      {36, 1, 1, 2},
                                      {8, 1, 0, 3},
                                      {1, 0, 4, 0},
                                      {6, 0, 3, 1},
                                      {12, 0, 2, 2},
                                      {6, 0, 1, 3},
                                      {1, 0, 0, 4}}};

  /// The point across the edge from corner a to corner b.
  constexpr Polynomial<9> ACROSS = {{{1, 4, 0, 0},
                                     {6, 3, 1, 0},
                                     {12, 2, 2, 0},
                                     {6, 1, 3, 0},
                                     {1, 0, 4, 0},
                                     {2, 3, 0, 1},
                                     {6, 2, 1, 1},
                                     {6, 1, 2, 1},
                                     {2, 0, 3, 1}}};

  /// A point that only corner a touches, beyond the edge from a to b.
  constexpr Polynomial<2> BEYOND = {{{1, 4, 0, 0}, {2, 3, 1, 0}}};

  /// Coefficients of u^a v^b, see quartic_term(), for each of the twelve.
  using Table = std::array<std::array<int, 12>, QUARTIC_TERMS>;

  constexpr int choose(int n, int k)
  {
    return k == 0 ? 1 : choose(n - 1, k - 1) * n / k;
  }

  /// Adds a polynomial whose a, b, c are the corners a, b, c of the face, with t0 multiplied out:
  /// (1 - u - v)^n is the sum over i of choose(n, i) (-1)^i (u + v)^i.
  template <std::size_t N>
  constexpr void multiply_out(Table &table, int column, const Polynomial<N> &p, int a, int b, int c)
  {
    for (const Monomial &m : p) {
      int e[3] = {0, 0, 0};
      e[a] = m.a;
      e[b] = m.b;
      e[c] = m.c;
      for (int i = 0; i <= e[0]; ++i)
        for (int j = 0; j <= i; ++j)
          table[quartic_term(e[1] + j, e[2] + i - j)][column] +=
              (i % 2 ? -1 : 1) * m.coefficient * choose(e[0], i) * choose(i, j);
    }
  }

  constexpr Table multiplied_out()
  {
    Table table{};
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3, prev = (k + 2) % 3;
      multiply_out(table, k, CORNER, k, next, prev);
      multiply_out(table, 3 + 3 * k, ACROSS, prev, k, next);
      multiply_out(table, 4 + 3 * k, BEYOND, k, prev, next);
      multiply_out(table, 5 + 3 * k, BEYOND, k, next, prev);
    }
    return table;
  }

  constexpr Table TWELFTHS = multiplied_out();

  template <int TERM, int POINT>
  inline void add_point(const std::array<Lanes<4>, 12> &y, Lanes<4> &sum)
  {
    constexpr int coefficient = TWELFTHS[TERM][POINT];
    if constexpr (coefficient != 0) sum += (coefficient / 12.0) * y[POINT];
  }
  template <int TERM, int... POINT>
  inline void add_points(const std::array<Lanes<4>, 12> &y, Lanes<4> &out,
                         std::integer_sequence<int, POINT...>)
  {
    Lanes<4> sum = Lanes<4>::Zero();
    (add_point<TERM, POINT>(y, sum), ...);
    out = sum;
  }
  template <int... TERM>
  inline void add_terms(const std::array<Lanes<4>, 12> &y, Quartics<4> &out,
                        std::integer_sequence<int, TERM...>)
  {
    (add_points<TERM>(y, out[TERM], std::make_integer_sequence<int, 12>()), ...);
  }

  /// The polynomial of a regular face from its twelve control points. Close to half of the coefficients
  /// are zero: the compiler leaves them out.
  inline void polynomial(const std::array<Lanes<4>, 12> &y, Quartics<4> &out)
  {
    add_terms(y, out, std::make_integer_sequence<int, QUARTIC_TERMS>());
  }

}    // namespace BoxSpline

}    // namespace Membrane_NS

#endif
