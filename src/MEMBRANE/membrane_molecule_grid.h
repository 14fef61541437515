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

#ifndef LMP_MEMBRANE_MOLECULE_GRID_H
#define LMP_MEMBRANE_MOLECULE_GRID_H

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <vector>

namespace Membrane_NS {

/** Points in the cells of a grid, to find those near a place. In a box that is periodic along any of its
    vectors, also those in other images, and a point in as many images as there are. The order in
    which points are found depends on the points alone. */
class BeadGrid {
 public:
  BeadGrid(const Eigen::Matrix3d &lattice, const std::array<bool, 3> &periodic) :
      lattice_(lattice), to_fraction_(lattice.inverse()), periodic_(periodic)
  {
  }

  void fill(const std::vector<Eigen::Vector3d> &points, double cutoff);

  /// Calls f(index, difference, distance^2) of all points within the cutoff of x, difference from x to the
  /// image of the point.
  template <class F> void near(const Eigen::Vector3d &x, F &&f) const;

  /// The image of x in the box, along periodic directions.
  Eigen::Vector3d fold(const Eigen::Vector3d &x) const;

 private:
  Eigen::Matrix3d lattice_, to_fraction_;
  std::array<bool, 3> periodic_;
  double cutoff2_ = 0.0;
  Eigen::Vector3d low_ = Eigen::Vector3d::Zero(), scale_ = Eigen::Vector3d::Ones();
  std::array<int, 3> cells_ = {1, 1, 1}, reach_ = {1, 1, 1};
  std::vector<int> start_, index_;             // [cells + 1], [points] by cell
  std::vector<Eigen::Vector3d> position_;      // folded, by cell

  int coordinate(const Eigen::Vector3d &fraction, int k) const
  {
    return static_cast<int>(std::floor((fraction[k] - low_[k]) * scale_[k]));
  }
};

/* ---------------------------------------------------------------------- */

inline Eigen::Vector3d BeadGrid::fold(const Eigen::Vector3d &x) const
{
  if (!periodic_[0] && !periodic_[1] && !periodic_[2]) return x;
  Eigen::Vector3d turns = to_fraction_ * x;
  for (int k = 0; k < 3; ++k) turns[k] = periodic_[k] ? std::floor(turns[k]) : 0.0;
  return x - lattice_ * turns;
}

template <class F> void BeadGrid::near(const Eigen::Vector3d &x, F &&f) const
{
  const Eigen::Vector3d place = fold(x), fraction = to_fraction_ * place;
  int first[3], last[3];
  for (int k = 0; k < 3; ++k) {
    const int c = coordinate(fraction, k);
    first[k] = c - reach_[k];
    last[k] = c + reach_[k];
    if (periodic_[k]) continue;
    first[k] = std::max(first[k], 0);
    last[k] = std::min(last[k], cells_[k] - 1);
  }
  auto turn = [&](int c, int k) {
    return periodic_[k] ? (c >= 0 ? c / cells_[k] : -((cells_[k] - 1 - c) / cells_[k])) : 0;
  };
  for (int a = first[0]; a <= last[0]; ++a) {
    const int ta = turn(a, 0);
    for (int b = first[1]; b <= last[1]; ++b) {
      const int tb = turn(b, 1);
      for (int c = first[2]; c <= last[2]; ++c) {
        const int tc = turn(c, 2);
        const int cell = ((a - ta * cells_[0]) * cells_[1] + b - tb * cells_[1]) * cells_[2] + c - tc * cells_[2];
        if (start_[cell] == start_[cell + 1]) continue;
        Eigen::Vector3d from = place;
        if (ta || tb || tc) from -= lattice_ * Eigen::Vector3d(ta, tb, tc);
        for (int i = start_[cell]; i < start_[cell + 1]; ++i) {
          const Eigen::Vector3d difference = position_[i] - from;
          const double d2 = difference.squaredNorm();
          if (d2 < cutoff2_) f(index_[i], difference, d2);
        }
      }
    }
  }
}

}    // namespace Membrane_NS

#endif
