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

#ifndef LMP_MEMBRANE_MEASURE_H
#define LMP_MEMBRANE_MEASURE_H

#include "membrane_face_groups.h"

namespace Membrane_NS {

/** The energy that takes the measure of the mesh out of what is sampled: each face has

      c ln A,   A = area of the flat triangle of its control points, in the square of the unit of length,

    with c = (3/4) kT, see doc/src/Derivation_measure.rst.

    Adds minus the gradient to f, [points][3]; energy [slots] and virial [slots][6] (xx yy zz xy xz
    yz) are added to where not empty. weight: c by slot, in energy; faces with 0 are passed over. */
void measure_faces(const FaceGroup &group, const double (*x)[3], const std::vector<double> &weight,
                   double (*f)[3], std::vector<double> &energy, std::vector<double> &virial);

}    // namespace Membrane_NS

#endif
