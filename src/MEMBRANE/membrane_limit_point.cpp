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

#include "membrane_limit_point.h"

#include <Eigen/Geometry>

using namespace Membrane_NS;
using Eigen::Vector3d;

/* ----------------------------------------------------------------------
   the second fundamental form has the sign that makes the curvatures of a sphere positive
------------------------------------------------------------------------- */

LimitPoint Membrane_NS::limit_point(const LimitValues &values)
{
  const Vector3d ru = values.row(LimitBasis::DU), rv = values.row(LimitBasis::DV);
  const Vector3d cross = ru.cross(rv);
  LimitPoint point;
  point.position = values.row(LimitBasis::VALUE);
  point.normal = cross.normalized();

  const double E = ru.dot(ru), F = ru.dot(rv), G = rv.dot(rv), det = cross.squaredNorm();
  const double L = -values.row(LimitBasis::DUU).dot(point.normal);
  const double M = -values.row(LimitBasis::DUV).dot(point.normal);
  const double N = -values.row(LimitBasis::DVV).dot(point.normal);
  point.mean_curvature = (E * N - 2.0 * F * M + G * L) / (2.0 * det);
  point.gaussian_curvature = (L * N - M * M) / det;
  return point;
}
