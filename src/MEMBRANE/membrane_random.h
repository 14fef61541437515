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

#ifndef LMP_MEMBRANE_RANDOM_H
#define LMP_MEMBRANE_RANDOM_H

#include "membrane_vertex_field.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace Membrane_NS {

/** Random numbers as a function of what they are for, instead of a sequence: Philox4x32-10
    [J. Salmon et al., Parallel random numbers: as easy as 1, 2, 3, SC11]. The same seed, step and
    label give the same numbers on any number of ranks and after any restart. */
class CounterRandom {
 public:
  CounterRandom(uint64_t seed, uint64_t step) :
      key_{static_cast<uint32_t>(seed), static_cast<uint32_t>(seed >> 32)}, step_(step)
  {
  }

  /** Four independent standard normal numbers for a label; block 0, 1, ... gives further ones. By Box and
      Muller's method from 32-bit numbers: the tail ends at 6.8 standard deviations, beyond which
      one in 10^11 would be. */
  std::array<double, 4> normals(uint64_t label, uint32_t block = 0) const
  {
    const auto word = philox(counter(label, block), key_);
    constexpr double SCALE = 0x1.0p-32, TWO_PI = 6.283185307179586476925;
    std::array<double, 4> z;
    for (int k = 0; k < 4; k += 2) {
      const double radius = std::sqrt(-2.0 * std::log(SCALE * (word[k] + 0.5)));
      const double angle = TWO_PI * SCALE * (word[k + 1] + 0.5);
      z[k] = radius * std::cos(angle);
      z[k + 1] = radius * std::sin(angle);
    }
    return z;
  }

  /// The same for each of the labels, to 1e-14, and several times as fast.
  void normals(const std::vector<uint64_t> &labels, VertexField &z) const;

  /// A vector of length 1, uniform on the sphere, for each label, from two numbers of 32 bits of its block 0: n [count][3].
  void unit_vectors(const int64_t *labels, int count, double (*n)[3]) const;

  /// Two independent numbers uniform in (0, 1), of 53 bits. Steps count modulo 2^48.
  std::array<double, 2> uniforms(uint64_t label, uint32_t block) const
  {
    const auto word = philox(counter(label, block), key_);
    auto unit = [](uint32_t hi, uint32_t lo) {
      const uint64_t bits = (static_cast<uint64_t>(hi) << 32 | lo) >> 11;
      return (static_cast<double>(bits) + 0.5) * 0x1.0p-53;
    };
    return {unit(word[0], word[1]), unit(word[2], word[3])};
  }

  /// Four independent words of 32 random bits.
  std::array<uint32_t, 4> words(uint64_t label, uint32_t block) const { return philox(counter(label, block), key_); }

  /// Of this many labels at once, several times as fast: word [4][labels] of `first` and the labels that follow, block 0.
  static constexpr int MANY = 16 * sizeof(Quad) / sizeof(double);
  void words(uint64_t first, uint32_t (&word)[4][MANY]) const;

  /// The bare generator: ten rounds on a counter of four words with a key of two.
  static std::array<uint32_t, 4> philox(std::array<uint32_t, 4> c, std::array<uint32_t, 2> k)
  {
    for (int round = 0; round < ROUNDS; ++round, advance(k)) philox_round(c[0], c[1], c[2], c[3], k);
    return c;
  }

  /// Four 32-bit numbers in 64 bits each.
  typedef uint64_t Words __attribute__((vector_size(sizeof(Quad))));
  /// Box and Muller's method for four labels at once: normal numbers from the four words of each.
  static void box_muller(const Words (&word)[4], Quad (&z)[4]);

 private:
  std::array<uint32_t, 2> key_;
  uint64_t step_;
  static constexpr int ROUNDS = 10;

  // of up to MANY labels, block 0; words of further ones are those of the last
  template <class Label> void words(const Label *labels, int count, uint32_t (&word)[4][MANY]) const
  {
    for (int l = 0; l < MANY; ++l) {
      const auto start = counter(static_cast<uint64_t>(labels[l < count ? l : count - 1]), 0);
      for (int j = 0; j < 4; ++j) word[j][l] = start[j];
    }
    philox(word, key_);
  }

  // a size that the compiler makes vector loops of
  static void philox(uint32_t (&c)[4][MANY], std::array<uint32_t, 2> k)
  {
    for (int round = 0; round < ROUNDS; ++round, advance(k))
      for (int l = 0; l < MANY; ++l) philox_round(c[0][l], c[1][l], c[2][l], c[3][l], k);
  }

  static void philox_round(uint32_t &c0, uint32_t &c1, uint32_t &c2, uint32_t &c3,
                           const std::array<uint32_t, 2> &k)
  {
    const uint64_t p0 = 0xD2511F53ULL * c0, p1 = 0xCD9E8D57ULL * c2;
    c0 = static_cast<uint32_t>(p1 >> 32) ^ c1 ^ k[0];
    c1 = static_cast<uint32_t>(p1);
    c2 = static_cast<uint32_t>(p0 >> 32) ^ c3 ^ k[1];
    c3 = static_cast<uint32_t>(p0);
  }

  static void advance(std::array<uint32_t, 2> &k)
  {
    k[0] += 0x9E3779B9U;
    k[1] += 0xBB67AE85U;
  }

  std::array<uint32_t, 4> counter(uint64_t label, uint32_t block) const
  {
    return {static_cast<uint32_t>(label), static_cast<uint32_t>(label >> 32),
            static_cast<uint32_t>(step_), static_cast<uint32_t>(step_ >> 32) << 16 ^ block};
  }
};

}    // namespace Membrane_NS

#endif
