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

#ifndef LMP_MEMBRANE_LIMIT_POINT_H
#define LMP_MEMBRANE_LIMIT_POINT_H

#include "membrane_limit_basis.h"

namespace Membrane_NS {

/// A point of the limit surface and how the surface bends there.
struct LimitPoint {
  Eigen::Vector3d position;
  Eigen::Vector3d normal;       ///< of length 1, outward
  double mean_curvature;        ///< H = (k1 + k2)/2: +1/R on a sphere with outward normals
  double gaussian_curvature;    ///< K = k1 k2: 1/R^2
};

/// Position and derivatives of the limit surface, a row for each LimitBasis::Row.
using LimitValues = Eigen::Matrix<double, LimitBasis::ROWS, 3>;

/// Normal and curvatures from the first and second fundamental form.
LimitPoint limit_point(const LimitValues &values);

}    // namespace Membrane_NS

#endif
