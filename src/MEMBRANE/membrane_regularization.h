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

#ifndef LMP_MEMBRANE_REGULARIZATION_H
#define LMP_MEMBRANE_REGULARIZATION_H

#include "membrane_helfrich.h"

namespace Membrane_NS {

/** Keeps the control mesh of a fluid membrane well shaped: each face has the energy

      K (D/A - 1),   D = sum of squared edges / (4 sqrt(3)),   A = area of the flat triangle,

    which is 0 for an equilateral triangle of any size and grows without bound as a face collapses
    [K. Hormann and G. Greiner, MIPS: an efficient global parametrization method, 2000]. It knows
    shapes but not sizes, so it has no tension; a sheet with slopes s changes it by O(s^4) only.

    Adds minus the gradient to f, [points][3]; energy [slots] and virial [slots][6] (xx yy zz xy xz
    yz) are added to where not empty. modulus: K by slot, in energy. Returns the worst face's D/A. */
double regularize_faces(const FaceGroup &group, const double (*x)[3],
                        const std::vector<double> &modulus, double (*f)[3],
                        std::vector<double> &energy, std::vector<double> &virial);

/// D/A of a triangle: 1 if equilateral, infinite if it has no area.
double face_distortion(const double *a, const double *b, const double *c);

/** A/D of the face p among its neighbours: 1 if equilateral, 0 if it has no area, less if it has
    turned over, so that its normal is opposed to the sum of the normals, by area, of the three faces
    across its edges. across[k] is the far corner of the face across the edge from p[k] to p[k+1]. */
double face_uprightness(const double *const (&p)[3], const double *const (&across)[3]);

}    // namespace Membrane_NS

#endif
