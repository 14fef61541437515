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

#include "membrane_blocks.h"

#include <algorithm>
#include <cmath>

using namespace Membrane_NS;

// fewer blocks say too little about their scatter
static constexpr int64_t FEWEST_BLOCKS = 8;

void BlockAverages::add(const std::vector<double> &sample)
{
  if (first_.empty()) first_ = sample;
  std::vector<double> carried(nseries_);
  for (int i = 0; i < nseries_; ++i) carried[i] = sample[i] - first_[i];
  for (size_t k = 0;; ++k) {
    if (k == levels_.size()) {
      levels_.emplace_back();
      for (auto *numbers : {&levels_[k].sum, &levels_[k].square, &levels_[k].half})
        numbers->assign(nseries_, 0.0);
    }
    Level &level = levels_[k];
    ++level.count;
    for (int i = 0; i < nseries_; ++i) {
      level.sum[i] += carried[i];
      level.square[i] += carried[i] * carried[i];
    }
    level.waiting = !level.waiting;
    if (level.waiting) {
      level.half = carried;
      return;
    }
    for (int i = 0; i < nseries_; ++i) carried[i] = 0.5 * (carried[i] + level.half[i]);
  }
}

double BlockAverages::mean(int series) const
{
  return levels_.empty() ? 0.0 : first_[series] + levels_[0].sum[series] / levels_[0].count;
}

// the standard error of the mean if the blocks of a level were independent, squared

double BlockAverages::scatter(int k, int series) const
{
  const Level &level = levels_[k];
  if (level.count < 2) return 0.0;
  const auto n = static_cast<double>(level.count);
  const double mean = level.sum[series] / n;
  return std::max(0.0, level.square[series] / n - mean * mean) / (n - 1.0);
}

double BlockAverages::error(int series) const
{
  if (count() < 2) return 0.0;
  const double single = scatter(0, series);
  if (single == 0.0) return 0.0;
  double largest = single, length = 1.0;
  for (size_t k = 0; k < levels_.size() && (k == 0 || levels_[k].count >= FEWEST_BLOCKS); ++k, length *= 2.0) {
    const double square = scatter(static_cast<int>(k), series), ratio = square / single;
    if (length * length * length > 2.0 * count() * ratio * ratio) return std::sqrt(square);
    largest = std::max(largest, square);
  }
  return std::sqrt(largest);
}

double BlockAverages::correlation(int series) const
{
  const double single = count() < 2 ? 0.0 : scatter(0, series), found = error(series);
  return single > 0.0 ? 0.5 * found * found / single : 0.5;
}
