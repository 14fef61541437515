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

#ifndef LMP_MESH_BOX_H
#define LMP_MESH_BOX_H

#include "domain.h"

#include <Eigen/Core>

#include <array>
#include <cmath>

namespace LAMMPS_NS {

/// The vectors of the simulation box as columns, of length; from Domain::h (xx yy zz yz xz xy).
inline Eigen::Matrix3d box_vectors(const double *h)
{
  Eigen::Matrix3d columns;
  columns << h[0], h[5], h[4], 0.0, h[1], h[3], 0.0, 0.0, h[2];
  return columns;
}
inline Eigen::Matrix3d box_vectors(const Domain &domain) { return box_vectors(domain.h); }

/// Which of them the box is periodic along.
inline std::array<bool, 3> periodic_directions(const Domain &domain)
{
  return {domain.periodicity[0] != 0, domain.periodicity[1] != 0, domain.periodicity[2] != 0};
}

/// A difference in box lengths, each from the box vectors.
inline std::array<double, 3> in_box_lengths(const Domain &domain, const double *d)
{
  const double *inv = domain.h_inv;
  return {inv[0] * d[0] + inv[5] * d[1] + inv[4] * d[2], inv[1] * d[1] + inv[3] * d[2],
          inv[2] * d[2]};
}

/// Turns a difference into its nearest image; returns by how many box vectors that moved it.
inline std::array<int, 3> nearest_image(const Domain &domain, double *d)
{
  std::array<int, 3> moved = {0, 0, 0};
  const double *h = domain.h;
  const auto s = in_box_lengths(domain, d);
  for (int k = 0; k < 3; ++k)
    if (domain.periodicity[k]) moved[k] = -static_cast<int>(std::round(s[k]));
  d[0] += h[0] * moved[0] + h[5] * moved[1] + h[4] * moved[2];
  d[1] += h[1] * moved[1] + h[3] * moved[2];
  d[2] += h[2] * moved[2];
  return moved;
}

/// The direction in which x is beyond a side of the box that neither is periodic nor moves; -1: it is inside.
inline int beyond_fixed_side(const Domain &domain, const double *x)
{
  constexpr int FIXED = 1;
  constexpr double ROUNDING = 1.0e-12;
  const double d[3] = {x[0] - domain.boxlo[0], x[1] - domain.boxlo[1], x[2] - domain.boxlo[2]};
  const auto s = in_box_lengths(domain, d);
  for (int k = 0; k < 3; ++k)
    if ((domain.boundary[k][0] == FIXED && s[k] < -ROUNDING) || (domain.boundary[k][1] == FIXED && s[k] > 1.0 + ROUNDING))
      return k;
  return -1;
}

/// A difference with a smaller square is its nearest image, also after box edges have shrunk by a tenth.
inline double surely_nearest_square(const Domain &domain)
{
  const double *inv = domain.h_inv;
  const double rows[3] = {inv[0] * inv[0] + inv[5] * inv[5] + inv[4] * inv[4], inv[1] * inv[1] + inv[3] * inv[3],
                          inv[2] * inv[2]};
  double most = 0.0;
  for (int k = 0; k < 3; ++k)
    if (domain.periodicity[k] && rows[k] > most) most = rows[k];
  return 0.2 / most;
}

}    // namespace LAMMPS_NS

#endif
