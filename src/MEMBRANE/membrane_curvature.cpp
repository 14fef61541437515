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
#include "membrane_curvature.h"

#include <Eigen/Geometry>
#include <cmath>

using namespace Membrane_NS;
using Eigen::Vector3d;

static constexpr double TWO_PI = 6.283185307179586476925;

/* ----------------------------------------------------------------------
   Tangent masks: the left eigenvectors of the subdominant eigenvalue [H. Hoppe et al., Piecewise
   Smooth Surface Reconstruction, SIGGRAPH 1994]. At a corner of a regular face only the vertex and
   its ring have weight; they are the first columns of the stencil, in the order of the ring.
------------------------------------------------------------------------- */

LimitBasis::Weights Membrane_NS::vertex_weights(int n)
{
  if (n == 6) return box_spline(0.0, 0.0).leftCols(7);

  LimitBasis::Weights w = LimitBasis::Weights::Zero(LimitBasis::ROWS, n + 1);
  const double centre = limit_mask_centre(n);
  w(LimitBasis::VALUE, 0) = centre;
  for (int i = 0; i < n; ++i) {
    w(LimitBasis::VALUE, 1 + i) = (1.0 - centre) / n;
    w(LimitBasis::DU, 1 + i) = std::cos(TWO_PI * i / n);
    w(LimitBasis::DV, 1 + i) = std::sin(TWO_PI * i / n);
  }
  return w;
}

LimitBasis::Weights Membrane_NS::corner_weights(const Valences &valences)
{
  return LimitBasis(valences).evaluate(0.0, 0.0);
}

/* ---------------------------------------------------------------------- */

void CurvatureIntegrals::resize(int nslots)
{
  mean.resize(nslots);
  willmore.resize(nslots);
  moment.resize(3 * static_cast<size_t>(nslots));
  inertia.resize(nslots);
}

void Membrane_NS::curvature_integrals(const FaceGroup &group, const double (*x)[3],
                                      const FaceModel &model, CurvatureIntegrals &out)
{
  const PatchRule &rule = *group.rule;
  Eigen::Matrix<double, 4, Eigen::Dynamic> control(4, rule.size);    // 4: a vector register
  for (int s = 0; s < group.nfaces; ++s) {
    const int slot = group.first_slot + s;
    const Vector3d origin(&model.origin[3 * static_cast<size_t>(slot)]);
    for (int k = 0; k < rule.size; ++k)
      control.col(k) << Eigen::Map<const Vector3d>(x[group.point(s, k)]) - origin, 0.0;

    double mean = 0.0, willmore = 0.0, inertia = 0.0;
    Vector3d moment = Vector3d::Zero();
    for (int q = 0; q < rule.npoints; ++q) {
      LimitValues values;
      for (int row = 0; row < LimitBasis::ROWS; ++row) {
        const double *weights = rule.row(q, row);
        Eigen::Vector4d sum = Eigen::Vector4d::Zero();
        for (int k = 0; k < rule.size; ++k) sum += weights[k] * control.col(k);
        values.row(row) = sum.head<3>();
      }
      const LimitPoint point = limit_point(values);
      const Vector3d ru = values.row(LimitBasis::DU), rv = values.row(LimitBasis::DV);
      const double J = ru.cross(rv).norm(), H = point.mean_curvature, area = rule.area_weight[q] * J;
      mean += rule.weight[q] * J * H;
      willmore += 2.0 * rule.weight[q] * J * H * H;
      moment += area * point.position;
      inertia += area * point.position.squaredNorm();
    }
    out.mean[slot] = mean;
    out.willmore[slot] = willmore;
    out.inertia[slot] = inertia;
    for (int k = 0; k < 3; ++k) out.moment[3 * static_cast<size_t>(slot) + k] = moment[k];
  }
}
