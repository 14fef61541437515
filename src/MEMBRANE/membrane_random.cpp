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

#include "membrane_random.h"

#include <algorithm>

using namespace Membrane_NS;

namespace {

using Words = CounterRandom::Words;
constexpr int LANES = sizeof(Quad) / sizeof(double);

Words words(const Quad &x) { return (Words) x; }
Quad number(const Words &bits) { return (Quad) bits; }

// of an integer below 2^32, exact: it is put into the mantissa of 2^52
Quad to_double(const Words &integer)
{
  constexpr uint64_t EXPONENT = 0x4330000000000000ULL;
  return number(integer | EXPONENT) - 0x1.0p52;
}

template <int N> Quad polynomial(const double (&c)[N], const Quad &x)
{
  Quad sum = c[N - 1] + Quad{};
  for (int k = N - 2; k >= 0; --k) sum = sum * x + c[k];
  return sum;
}

/* ----------------------------------------------------------------------
   ln of 2^e m with m from sqrt(1/2) to sqrt(2): ln m = 2 artanh s, s = (m - 1)/(m + 1), |s| < 0.172, by its
   series, whose first term left out is below 1e-17 of the sum
------------------------------------------------------------------------- */

Quad logarithm(const Quad &x)
{
  constexpr double SERIES[] = {2.0 / 1,  2.0 / 3,  2.0 / 5,  2.0 / 7,  2.0 / 9, 2.0 / 11,
                               2.0 / 13, 2.0 / 15, 2.0 / 17, 2.0 / 19, 2.0 / 21};
  constexpr uint64_t MANTISSA = 0x000fffffffffffffULL, HALF_ROOT = 0x3fe6a09e667f3bcdULL;
  const Words shifted = words(x) - HALF_ROOT;    // its exponent is e, below 0
  const Quad e = to_double(((shifted >> 52) + 1024) & 0x7ff) - 1024.0;
  const Quad m = number((shifted & MANTISSA) + HALF_ROOT);
  const Quad s = (m - 1.0) / (m + 1.0);
  return e * 0.693147180559945309417 + s * polynomial(SERIES, s * s);
}

/* ----------------------------------------------------------------------
   cos and sin of 2 pi (n + 1/2)/2^32: the nearest quarter of a turn, and what is left of it, which is exact;
   series up to 1e-17
------------------------------------------------------------------------- */

void cosine_and_sine(const Words &n, Quad &cosine, Quad &sine)
{
  constexpr double UNIT = 6.283185307179586476925 * 0x1.0p-32;
  constexpr double SINE[] = {1.0, -1.0 / 6, 1.0 / 120, -1.0 / 5040, 1.0 / 362880, -1.0 / 39916800,
                             1.0 / 6227020800.0, -1.0 / 1307674368000.0};
  constexpr double COSINE[] = {1.0, -1.0 / 2, 1.0 / 24, -1.0 / 720, 1.0 / 40320, -1.0 / 3628800,
                               1.0 / 479001600.0, -1.0 / 87178291200.0, 1.0 / 20922789888000.0};
  constexpr uint64_t EIGHTH = 1ULL << 29;
  const Words moved = n + EIGHTH, quarter = moved >> 30;
  const Quad angle = (to_double(moved & (2 * EIGHTH - 1)) - (EIGHTH - 0.5)) * UNIT;
  const Quad square = angle * angle;
  const Words s = words(angle * polynomial(SINE, square)), c = words(polynomial(COSINE, square));
  const Words odd = -(quarter & 1);
  cosine = number(((s & odd) | (c & ~odd)) ^ (((quarter + 1) & 2) << 62));
  sine = number(((c & odd) | (s & ~odd)) ^ ((quarter & 2) << 62));
}

}    // namespace

/* ---------------------------------------------------------------------- */

void CounterRandom::box_muller(const Words (&word)[4], Quad (&z)[4])
{
  for (int k = 0; k < 4; k += 2) {
    const Quad square = -2.0 * logarithm((to_double(word[k]) + 0.5) * 0x1.0p-32);
    Quad radius;
    for (int l = 0; l < LANES; ++l) radius[l] = std::sqrt(square[l]);
    cosine_and_sine(word[k + 1], z[k], z[k + 1]);
    z[k] *= radius;
    z[k + 1] *= radius;
  }
}

void CounterRandom::words(uint64_t first, uint32_t (&word)[4][MANY]) const
{
  for (int l = 0; l < MANY; ++l) {
    const auto start = counter(first + l, 0);
    for (int j = 0; j < 4; ++j) word[j][l] = start[j];
  }
  philox(word, key_);
}

void CounterRandom::normals(const std::vector<uint64_t> &labels, VertexField &z) const
{
  const auto n = static_cast<int>(labels.size());
  for (int first = 0; first < n; first += MANY) {
    const int count = std::min(MANY, n - first);
    uint32_t c[4][MANY];
    words(&labels[first], count, c);
    for (int at = 0; at < count; at += LANES) {
      Words word[4];
      Quad normal[4];
      for (int j = 0; j < 4; ++j)
        for (int l = 0; l < LANES; ++l) word[j][l] = c[j][at + l];
      box_muller(word, normal);
      for (int l = 0; l < std::min(LANES, count - at); ++l)
        z[first + at + l] = {{normal[0][l], normal[1][l], normal[2][l], normal[3][l]}};
    }
  }
}

// the cosine of the angle to z is uniform, and so is the angle around it

void CounterRandom::unit_vectors(const int64_t *labels, int count, double (*n)[3]) const
{
  for (int first = 0; first < count; first += MANY) {
    const int here = std::min(MANY, count - first);
    uint32_t c[4][MANY];
    words(labels + first, here, c);
    for (int at = 0; at < here; at += LANES) {
      Words height, around;
      for (int l = 0; l < LANES; ++l) {
        height[l] = c[0][at + l];
        around[l] = c[1][at + l];
      }
      const Quad z = (to_double(height) + 0.5) * 0x1.0p-31 - 1.0, square = 1.0 - z * z;
      Quad flat, x, y;
      for (int l = 0; l < LANES; ++l) flat[l] = std::sqrt(square[l]);
      cosine_and_sine(around, x, y);
      x *= flat;
      y *= flat;
      for (int l = 0; l < std::min(LANES, here - at); ++l) {
        double *vector = n[first + at + l];
        vector[0] = x[l];
        vector[1] = y[l];
        vector[2] = z[l];
      }
    }
  }
}
