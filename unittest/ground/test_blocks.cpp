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

#include "membrane_blocks.h"
#include "membrane_random.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace Membrane_NS;

namespace {

// x_i = keep x_i-1 + noise, variance 1: the correlation time of its sum is (1 + keep)/(1 - keep)/2
std::vector<BlockAverages> processes(double keep, int length, int replicas)
{
  std::vector<BlockAverages> all;
  for (int r = 0; r < replicas; ++r) {
    BlockAverages blocks(1);
    const CounterRandom random(4711 + r, 0);
    double x = random.normals(1 << 30)[0];
    for (int i = 0; i < length; ++i) {
      x = keep * x + std::sqrt(1.0 - keep * keep) * random.normals(i)[0];
      blocks.add({x});
    }
    all.push_back(blocks);
  }
  return all;
}

TEST(BlockAverages, HaveTheMeanOfAllSamplesWhateverTheirNumber)
{
  for (int n : {1, 2, 3, 7, 64, 100}) {
    BlockAverages blocks(2);
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
      sum += i * i;
      blocks.add({1e9 + i, static_cast<double>(i * i)});
    }
    EXPECT_EQ(blocks.count(), n);
    EXPECT_NEAR(blocks.mean(0), 1e9 + 0.5 * (n - 1), 1e-6);
    EXPECT_NEAR(blocks.mean(1), sum / n, 1e-9);
  }
  EXPECT_EQ(BlockAverages(1).mean(0), 0.0);
  EXPECT_EQ(BlockAverages(1).error(0), 0.0);
}

TEST(BlockAverages, HaveNoErrorOfAConstant)
{
  BlockAverages blocks(1);
  for (int i = 0; i < 1000; ++i) blocks.add({0.1});
  EXPECT_EQ(blocks.error(0), 0.0);
  EXPECT_EQ(blocks.correlation(0), 0.5);
}

// against the exact error, and against the scatter of the means
TEST(BlockAverages, HaveTheErrorOfCorrelatedSamples)
{
  constexpr int LENGTH = 20000, REPLICAS = 60;
  for (double keep : {0.0, 0.5, 0.9, 0.98}) {
    const double tau = 0.5 * (1.0 + keep) / (1.0 - keep), exact = std::sqrt(2.0 * tau / LENGTH);
    double error = 0.0, correlation = 0.0, square = 0.0;
    for (const BlockAverages &blocks : processes(keep, LENGTH, REPLICAS)) {
      error += blocks.error(0) / REPLICAS;
      correlation += blocks.correlation(0) / REPLICAS;
      square += blocks.mean(0) * blocks.mean(0) / REPLICAS;
    }
    EXPECT_NEAR(error / exact, 1.0, 0.06) << keep;
    EXPECT_NEAR(correlation / tau, 1.0, 0.12) << keep;
    EXPECT_NEAR(std::sqrt(square) / exact, 1.0, 0.3) << keep;
  }
}

// no block is longer than the correlations: the error is too small, but as large as can be told
TEST(BlockAverages, TakeTheLargestErrorOfASeriesThatIsTooShort)
{
  double error = 0.0;
  for (const BlockAverages &blocks : processes(0.999, 1000, 20)) error += blocks.error(0) / 20;
  EXPECT_GT(error, 0.1);    // exact: 1 or so; of independent samples: 0.02
}

}    // namespace
