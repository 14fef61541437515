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

void Membrane_NS::measure_faces(const FaceGroup &group, const double (*x)[3],
                                const std::vector<double> &weight, double (*f)[3],
                                std::vector<double> &energy, std::vector<double> &virial)
{
  for (int block = 0; block < group.nblocks(); ++block) {
    CornerBlock corners(group, block);
    const Lane w = load(weight, corners.slot);
    if (!corners.any(w)) continue;
    corners.look(x);
    const Lane square = dot(corners.normal, corners.normal);    // (2 A)^2
    for (int l = 0; l < corners.faces && !energy.empty(); ++l)
      if (w[l] != 0.0) energy[corners.slot + l] += w[l] * 0.5 * std::log(0.25 * square[l]);
    const Lane over = where(w, w / square);
    corners.subtract_gradients(where(w, over * corners.area_gradient(0)), where(w, over * corners.area_gradient(1)), f, virial);
  }
}
