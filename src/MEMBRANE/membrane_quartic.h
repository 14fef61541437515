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

#ifndef LMP_MEMBRANE_QUARTIC_H
#define LMP_MEMBRANE_QUARTIC_H

#include <Eigen/Core>
#include <array>
#include <utility>

namespace Membrane_NS {

/// A function of (u, v) and its derivatives to third order. The first six are LimitBasis::Row.
struct Derivative {
  enum Row { VALUE, DU, DV, DUU, DUV, DVV, DUUU, DUUV, DUVV, DVVV, ROWS };

  /// How many of them there are up to an order from 0 to 3: 1, 3, 6, 10.
  static constexpr int rows(int order) { return (order + 1) * (order + 2) / 2; }
};

// === Polynomials of degree 4

constexpr int QUARTIC_TERMS = 15;

/// Where the coefficient of u^a v^b is, a + b <= 4: 1, v, v^2, v^3, v^4, u, u v, ..., u^4.
constexpr int quartic_term(int a, int b)
{
  return 5 * a - a * (a - 1) / 2 + b;
}

/// One number for each of several polynomials, side by side in the registers of the vector unit.
template <int LANES> using Lanes = Eigen::Array<double, LANES, 1>;
/// The coefficients of LANES polynomials.
template <int LANES> using Quartics = std::array<Lanes<LANES>, QUARTIC_TERMS>;
/// Values and derivatives of LANES polynomials, by Derivative::Row.
template <int LANES> using QuarticJet = std::array<Lanes<LANES>, Derivative::ROWS>;

/** Values and derivatives up to ORDER of polynomials of (scale u + u0, scale v + v0) with respect to
    u and v, where (x, y) is (scale u + u0, scale v + v0). Rows beyond ORDER are left alone. */
template <int ORDER, int LANES>
void evaluate_quartics(const Quartics<LANES> &c, double x, double y, double scale,
                       QuarticJet<LANES> &jet);

/* ----------------------------------------------------------------------
   everything below is unrolled by the compiler into one multiplication and addition a term and lane
------------------------------------------------------------------------- */

namespace Quartic_details {

  constexpr std::array<int, QUARTIC_TERMS> POWER_OF_U = {0, 0, 0, 0, 0, 1, 1, 1,
                                                         1, 2, 2, 2, 3, 3, 4};
  constexpr std::array<int, QUARTIC_TERMS> POWER_OF_V = {0, 1, 2, 3, 4, 0, 1, 2,
                                                         3, 0, 1, 2, 0, 1, 0};

  /// d^k/dx^k of x^n is falling(n, k) x^(n-k).
  constexpr int falling(int n, int k)
  {
    int product = 1;
    for (int i = 0; i < k; ++i) product *= n - i;
    return product;
  }

  template <int P, int Q, int TERM, int LANES>
  inline void add_term(const Quartics<LANES> &c, const std::array<double, QUARTIC_TERMS> &monomial,
                       Lanes<LANES> &sum)
  {
    constexpr int a = POWER_OF_U[TERM], b = POWER_OF_V[TERM];
    if constexpr (a >= P && b >= Q) {
      const double factor =
          double(falling(a, P) * falling(b, Q)) * monomial[quartic_term(a - P, b - Q)];
      sum += factor * c[TERM];
    }
  }

  /// The derivative P times by u and Q times by v.
  template <int P, int Q, int LANES, int... TERM>
  inline void derivative(const Quartics<LANES> &c,
                         const std::array<double, QUARTIC_TERMS> &monomial, double factor,
                         Lanes<LANES> &out, std::integer_sequence<int, TERM...>)
  {
    Lanes<LANES> sum = Lanes<LANES>::Zero();
    (add_term<P, Q, TERM, LANES>(c, monomial, sum), ...);
    out = factor * sum;
  }

}    // namespace Quartic_details

template <int ORDER, int LANES>
inline void evaluate_quartics(const Quartics<LANES> &c, double x, double y, double scale,
                              QuarticJet<LANES> &jet)
{
  using namespace Quartic_details;
  const double x2 = x * x, y2 = y * y;
  const std::array<double, QUARTIC_TERMS> monomial = {1.0,    y,       y2,     y2 * y,     y2 * y2,
                                                      x,      x * y,   x * y2, x * y2 * y, x2,
                                                      x2 * y, x2 * y2, x2 * x, x2 * x * y, x2 * x2};
  constexpr std::make_integer_sequence<int, QUARTIC_TERMS> terms;
  derivative<0, 0, LANES>(c, monomial, 1.0, jet[Derivative::VALUE], terms);
  if constexpr (ORDER >= 1) {
    derivative<1, 0, LANES>(c, monomial, scale, jet[Derivative::DU], terms);
    derivative<0, 1, LANES>(c, monomial, scale, jet[Derivative::DV], terms);
  }
  if constexpr (ORDER >= 2) {
    const double scale2 = scale * scale;
    derivative<2, 0, LANES>(c, monomial, scale2, jet[Derivative::DUU], terms);
    derivative<1, 1, LANES>(c, monomial, scale2, jet[Derivative::DUV], terms);
    derivative<0, 2, LANES>(c, monomial, scale2, jet[Derivative::DVV], terms);
  }
  if constexpr (ORDER >= 3) {
    const double scale3 = scale * scale * scale;
    derivative<3, 0, LANES>(c, monomial, scale3, jet[Derivative::DUUU], terms);
    derivative<2, 1, LANES>(c, monomial, scale3, jet[Derivative::DUUV], terms);
    derivative<1, 2, LANES>(c, monomial, scale3, jet[Derivative::DUVV], terms);
    derivative<0, 3, LANES>(c, monomial, scale3, jet[Derivative::DVVV], terms);
  }
}

}    // namespace Membrane_NS

#endif
