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

#include "membrane_molecule_grid.h"

#include <algorithm>
#include <cstdint>

using namespace Membrane_NS;
using Eigen::Vector3d;

// Cells are no narrower than the cutoff; in a box that is narrower than that, several images are visited.

void BeadGrid::fill(const std::vector<Vector3d> &points, double cutoff)
{
  cutoff2_ = cutoff * cutoff;
  const size_t n = points.size();
  std::vector<Vector3d> folded(n);
  Vector3d low = Vector3d::Constant(INFINITY), high = -low;
  for (size_t i = 0; i < n; ++i) {
    folded[i] = fold(points[i]);
    const Vector3d fraction = to_fraction_ * folded[i];
    low = low.cwiseMin(fraction);
    high = high.cwiseMax(fraction);
  }
  double wanted[3];
  for (int k = 0; k < 3; ++k) {
    const double width = 1.0 / to_fraction_.row(k).norm();    // of the box, across
    const double range = periodic_[k] ? 1.0 : n ? high[k] - low[k] + 1.0e-9 : 1.0;
    low_[k] = periodic_[k] || !n ? 0.0 : low[k];
    wanted[k] = std::max(1.0, std::floor(range * width / cutoff));
  }
  while (wanted[0] * wanted[1] * wanted[2] > 4.0 * n + 1000.0)
    for (double &cells : wanted) cells = std::max(1.0, std::floor(0.9 * cells));
  for (int k = 0; k < 3; ++k) {
    const double width = 1.0 / to_fraction_.row(k).norm();
    const double range = periodic_[k] ? 1.0 : n ? high[k] - low[k] + 1.0e-9 : 1.0;
    cells_[k] = static_cast<int>(wanted[k]);
    scale_[k] = cells_[k] / range;
    reach_[k] = std::max(1, static_cast<int>(std::ceil(cutoff * scale_[k] / width - 1.0e-9)));
  }

  const size_t cells = static_cast<size_t>(cells_[0]) * cells_[1] * cells_[2];
  std::vector<int> cell(n);
  start_.assign(cells + 1, 0);
  for (size_t i = 0; i < n; ++i) {
    const Vector3d fraction = to_fraction_ * folded[i];
    int c[3];
    for (int k = 0; k < 3; ++k) c[k] = std::clamp(coordinate(fraction, k), 0, cells_[k] - 1);
    cell[i] = (c[0] * cells_[1] + c[1]) * cells_[2] + c[2];
    ++start_[cell[i] + 1];
  }
  for (size_t c = 0; c < cells; ++c) start_[c + 1] += start_[c];
  index_.resize(n);
  position_.resize(n);
  std::vector<int> next(start_.begin(), start_.end() - 1);
  for (size_t i = 0; i < n; ++i) {
    const int to = next[cell[i]]++;
    index_[to] = static_cast<int>(i);
    position_[to] = folded[i];
  }
}
