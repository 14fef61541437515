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

#ifndef LMP_MEMBRANE_CORNER_FORCES_H
#define LMP_MEMBRANE_CORNER_FORCES_H


#include "membrane_face_groups.h"

#include <Eigen/Dense>

namespace Membrane_NS {

/// The flat triangle of a face's control points, for energies of it.
struct FaceCorners {
  int point[3];
  Eigen::Vector3d place[3];

  /// The s-th face of the group; x is [points][3].
  FaceCorners(const FaceGroup &group, int s, const double (*x)[3])
  {
    for (int k = 0; k < 3; ++k) {
      point[k] = group.point(s, k);
      place[k] = Eigen::Vector3d(x[point[k]]);
    }
  }

  /// Adds forces on the first two corners, and on the third what makes their sum zero, to f, [points][3],
  /// and their virial (xx yy zz xy xz yz) to `virial` unless that is null.
  void add(const Eigen::Vector3d (&force)[2], double (*f)[3], double *virial) const
  {
    const Eigen::Vector3d on[3] = {force[0], force[1], -force[0] - force[1]};
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) f[point[k]][i] += on[k][i];
    if (!virial) return;
    for (int k = 1; k < 3; ++k) {
      const Eigen::Vector3d r = place[k] - place[0];
      virial[0] += r[0] * on[k][0];
      virial[1] += r[1] * on[k][1];
      virial[2] += r[2] * on[k][2];
      virial[3] += r[0] * on[k][1];
      virial[4] += r[0] * on[k][2];
      virial[5] += r[1] * on[k][2];
    }
  }
};

}    // namespace Membrane_NS

#endif
