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

}    // namespace LAMMPS_NS

#endif
