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

#ifndef LMP_MEMBRANE_HELFRICH_H
#define LMP_MEMBRANE_HELFRICH_H

#include "membrane_face_quarters.h"

#include <vector>

namespace Membrane_NS {

/// Terms a scene has; what is left out costs nothing.
struct FaceTerms {
  bool gauss = false;     ///< some kg is not zero
  bool volume = false;    ///< some pressure is not zero
  bool moment = false;    ///< some moment is not zero
  bool leaflets = false;    ///< the model has them
};

/// Integrals over each face, by slot. Empty arrays are not computed.
struct FaceIntegrals {
  std::vector<double> area;           ///< [slots] dA
  std::vector<double> volume;         ///< [slots] (1/3) (r - origin).n dA
  std::vector<double> vector_area;    ///< [slots][3] n dA; comes with the volume only
  std::vector<double> curvature;      ///< [slots] 2H dA
  std::vector<double> curved_area;    ///< [slots] dA with the weights of what depends on curvature; comes with curvature only
  std::vector<double> bending;        ///< [slots] kc/2 (2H - c0)^2 dA
};

/// Energies and virials of each face, by slot. Empty arrays are not computed.
struct FaceEnergies {
  std::vector<double> bending, gauss, area;    ///< [slots]
  std::vector<double> leaflet_bend;    ///< [slots] of leaflets: the mean of D^2 (k1^2 + k2^2), see LEAFLETS_EXACT
  std::vector<double> virial;    ///< [slots][6] xx yy zz xy xz yz of sum r f, r from the origin if
                                 ///< the scene has a volume term, else from the first corner
};

/// First pass, needed when a term depends on a total of the membrane. x is [points][3].
void face_integrals(FaceGroups &groups, const double (*x)[3], const FaceModel &model, FaceIntegrals &out);

/** Second pass: adds minus the gradient of the energy to f, [points][3]. The gradient of the
    volume is taken at fixed origin. */
void face_forces(FaceGroups &groups, const double (*x)[3], const FaceModel &model, const FaceTerms &terms,
                 double (*f)[3], FaceEnergies &out);

}    // namespace Membrane_NS

#endif
