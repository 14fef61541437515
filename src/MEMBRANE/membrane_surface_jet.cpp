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

#include "membrane_surface_jet.h"

#include <Eigen/Dense>

using namespace Membrane_NS;
using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/* ---------------------------------------------------------------------- */

Matrix2d SurfaceJet::metric() const
{
  const Vector3d a = du(), b = dv();
  const double mixed = a.dot(b);
  Matrix2d g;
  g << a.squaredNorm(), mixed, mixed, b.squaredNorm();
  return g;
}

Vector2d SurfaceJet::parameters_of(const Vector3d &vector) const
{
  return metric().inverse() * Vector2d(du().dot(vector), dv().dot(vector));
}

LimitPoint SurfaceJet::limit_point() const
{
  LimitValues values;
  for (int row = 0; row < LimitBasis::ROWS; ++row)
    values.row(row) = rows_[row].head<3>().matrix().transpose();
  return Membrane_NS::limit_point(values);
}

/* ----------------------------------------------------------------------
   With T = (r_u, r_v), G = T^T T and b_ab = -r_ab.n, positive on a sphere: S = T G^-1 b G^-1 T^T, and
   (1 + d S)^-1 S = T (G + d b)^-1 b G^-1 T^T.
------------------------------------------------------------------------- */

Matrix3d SurfaceJet::distance_hessian(double distance) const
{
  const Vector3d n = normal();
  Eigen::Matrix<double, 3, 2> t;
  t << du(), dv();
  const double mixed = -row(Derivative::DUV).dot(n);
  Matrix2d b;
  b << -row(Derivative::DUU).dot(n), mixed, mixed, -row(Derivative::DVV).dot(n);
  const Matrix2d g = metric();
  return t * (g + distance * b).inverse() * b * g.inverse() * t.transpose();
}
