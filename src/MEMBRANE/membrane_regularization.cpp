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

#include "membrane_regularization.h"

#include "membrane_corner_forces.h"

#include <algorithm>
#include <cmath>

using namespace Membrane_NS;
using Eigen::Map;
using Eigen::Vector3d;

static const double INVERSE_4_SQRT_3 = 0.25 / std::sqrt(3.0);

double Membrane_NS::face_distortion(const double *pa, const double *pb, const double *pc)
{
  const Map<const Vector3d> a(pa), b(pb), c(pc);
  const double edges = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return INVERSE_4_SQRT_3 * edges / (0.5 * (b - a).cross(c - a).norm());
}

double Membrane_NS::face_uprightness(const double *const (&p)[3], const double *const (&across)[3])
{
  const Vector3d corner[3] = {Vector3d(p[0]), Vector3d(p[1]), Vector3d(p[2])};
  Vector3d around = Vector3d::Zero();
  double edges = 0.0;
  for (int k = 0; k < 3; ++k) {
    const Vector3d &next = corner[(k + 1) % 3], edge = corner[k] - next;
    around += edge.cross(Map<const Vector3d>(across[k]) - next);
    edges += edge.squaredNorm();
  }
  const Vector3d normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  const double upright = 0.5 * normal.norm() / (INVERSE_4_SQRT_3 * edges);
  return normal.dot(around) < 0.0 ? -upright : upright;
}

double Membrane_NS::regularize_faces(const FaceGroup &group, const double (*x)[3],
                                     const std::vector<double> &modulus, double (*f)[3],
                                     std::vector<double> &energy, std::vector<double> &virial)
{
  double worst = 1.0;
  for (int s = 0; s < group.nfaces; ++s) {
    const int slot = group.first_slot + s;
    if (modulus[slot] == 0.0) continue;
    const FaceCorners corners(group, s, x);
    const Vector3d *p = corners.place;
    const Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
    const double twice_area = normal.norm(), area = 0.5 * twice_area;
    const double edges = (p[1] - p[0]).squaredNorm() + (p[2] - p[1]).squaredNorm() +
        (p[0] - p[2]).squaredNorm();
    const double dirichlet = INVERSE_4_SQRT_3 * edges;
    const double ratio = dirichlet / area;
    worst = std::max(worst, std::isfinite(ratio) ? ratio : INFINITY);
    if (!energy.empty()) energy[slot] += modulus[slot] * (ratio - 1.0);

    // -modulus/area (d dirichlet - ratio d area); what the three corners feel sums to zero

    const double stretch = 2.0 * INVERSE_4_SQRT_3 * modulus[slot] / area,
                 spread = 0.25 * modulus[slot] * ratio / (area * area);
    Vector3d force[2];
    for (int k = 0; k < 2; ++k) {
      const Vector3d &a = p[k], &b = p[(k + 1) % 3], &c = p[(k + 2) % 3];
      force[k] = spread * normal.cross(c - b) - stretch * (2.0 * a - b - c);
    }
    corners.add(force, f, virial.empty() ? nullptr : &virial[6 * static_cast<size_t>(slot)]);
  }
  return worst;
}
