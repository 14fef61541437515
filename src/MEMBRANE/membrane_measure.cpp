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


#include "membrane_measure.h"

#include "membrane_corner_forces.h"

#include <cmath>

using namespace Membrane_NS;
using Eigen::Vector3d;

void Membrane_NS::measure_faces(const FaceGroup &group, const double (*x)[3],
                                const std::vector<double> &weight, double (*f)[3],
                                std::vector<double> &energy, std::vector<double> &virial)
{
  for (int s = 0; s < group.nfaces; ++s) {
    const int slot = group.first_slot + s;
    if (weight[slot] == 0.0) continue;
    const FaceCorners corners(group, s, x);
    const Vector3d *p = corners.place;
    const Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
    const double square = normal.squaredNorm();    // (2 A)^2
    if (!energy.empty()) energy[slot] += weight[slot] * 0.5 * std::log(0.25 * square);

    // dA/da = normal x (c - b)/(4 A)

    const double pull = -weight[slot] / square;
    const Vector3d force[2] = {pull * normal.cross(p[2] - p[1]), pull * normal.cross(p[0] - p[2])};
    corners.add(force, f, virial.empty() ? nullptr : &virial[6 * static_cast<size_t>(slot)]);
  }
}
