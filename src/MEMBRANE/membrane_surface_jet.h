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

#ifndef LMP_MEMBRANE_SURFACE_JET_H
#define LMP_MEMBRANE_SURFACE_JET_H

#include "membrane_limit_point.h"

#include <Eigen/Geometry>

namespace Membrane_NS {

/** Position and derivatives of the limit surface at a point with respect to the u, v of a face. Lengths
    are in the unit of the control points. */
class SurfaceJet {
 public:
  /// By Derivative::Row; rows beyond the order that was asked for are zero.
  Eigen::Vector3d row(int row) const { return rows_[row].head<3>().matrix(); }
  Eigen::Vector3d position() const { return row(Derivative::VALUE); }
  Eigen::Vector3d du() const { return row(Derivative::DU); }
  Eigen::Vector3d dv() const { return row(Derivative::DV); }

  // === What needs first derivatives

  /// du x dv, outward; its length is the area of the surface to that of the parameters.
  Eigen::Vector3d area_vector() const { return du().cross(dv()); }
  Eigen::Vector3d normal() const { return area_vector().normalized(); }
  /// du.du, du.dv, dv.dv
  Eigen::Matrix2d metric() const;
  /// The (u, v) of a vector in space: of its part along the surface.
  Eigen::Vector2d parameters_of(const Eigen::Vector3d &vector) const;
  /// The vector in space of (u, v).
  Eigen::Vector3d tangent(const Eigen::Vector2d &uv) const { return du() * uv[0] + dv() * uv[1]; }

  // === What needs second derivatives

  /// Position, normal, mean and Gaussian curvature.
  LimitPoint limit_point() const;
  /** The second derivatives with respect to x of the signed distance d of a place x in space from the
      surface, for the closest point here: (1 + d S)^-1 S with S = dn/dr, zero along the normal. Its
      first derivatives are the normal. */
  Eigen::Matrix3d distance_hessian(double distance) const;

  QuarticJet<4> &rows() { return rows_; }

 private:
  QuarticJet<4> rows_;
};

}    // namespace Membrane_NS

#endif
