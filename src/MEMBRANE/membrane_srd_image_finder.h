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

#ifndef LMP_MEMBRANE_SRD_IMAGE_FINDER_H
#define LMP_MEMBRANE_SRD_IMAGE_FINDER_H

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>

namespace Membrane_NS {

/// Finds the periodic images in which triangles come into a region of space.
class ImageFinder {
 public:
  /// The region between lo and hi. Lattice columns are the box vectors.
  ImageFinder(const Eigen::Matrix3d &lattice, const std::array<bool, 3> &periodic,
              const Eigen::Vector3d &lo, const Eigen::Vector3d &hi) :
      lattice_(lattice),
      to_fraction_(lattice.inverse()), periodic_(periodic), lo_(lo), hi_(hi),
      first_(Eigen::Vector3d::Constant(INFINITY)), last_(-first_)
  {
    for (int corner = 0; corner < 8; ++corner) {
      Eigen::Vector3d x;
      for (int k = 0; k < 3; ++k) x[k] = corner >> k & 1 ? hi[k] : lo[k];
      const Eigen::Vector3d s = to_fraction_ * x;
      first_ = first_.cwiseMin(s);
      last_ = last_.cwiseMax(s);
    }
  }

  /// use(box vectors) for each image of the triangle whose box has something of the region.
  template <class Use> void for_each(const std::array<Eigen::Vector3d, 3> &x, const Use &use) const
  {
    const Eigen::Vector3d s[3] = {to_fraction_ * x[0], to_fraction_ * x[1], to_fraction_ * x[2]};
    std::array<int, 3> from = {0, 0, 0}, to = {0, 0, 0}, i;
    for (int k = 0; k < 3; ++k)
      if (periodic_[k]) {
        from[k] = static_cast<int>(std::ceil(first_[k] - std::max({s[0][k], s[1][k], s[2][k]})));
        to[k] = static_cast<int>(std::floor(last_[k] - std::min({s[0][k], s[1][k], s[2][k]})));
      }
    for (i[0] = from[0]; i[0] <= to[0]; ++i[0])
      for (i[1] = from[1]; i[1] <= to[1]; ++i[1])
        for (i[2] = from[2]; i[2] <= to[2]; ++i[2]) {
          const Eigen::Vector3d shift = lattice_ * Eigen::Vector3d(i[0], i[1], i[2]);
          bool near = true;
          for (int k = 0; k < 3 && near; ++k)
            near = std::min({x[0][k], x[1][k], x[2][k]}) + shift[k] <= hi_[k] &&
                std::max({x[0][k], x[1][k], x[2][k]}) + shift[k] >= lo_[k];
          if (near) use(i);
        }
  }
  bool any(const std::array<Eigen::Vector3d, 3> &x) const
  {
    bool found = false;
    for_each(x, [&found](const std::array<int, 3> &) { found = true; });
    return found;
  }

 private:
  Eigen::Matrix3d lattice_, to_fraction_;
  std::array<bool, 3> periodic_;
  Eigen::Vector3d lo_, hi_, first_, last_;    // the latter of the region in box vectors
};

}    // namespace Membrane_NS

#endif
