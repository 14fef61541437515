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

#ifndef LMP_MEMBRANE_CURVATURE_H
#define LMP_MEMBRANE_CURVATURE_H

#include "membrane_helfrich.h"
#include "membrane_limit_basis.h"
#include "membrane_limit_point.h"

#include <vector>

namespace Membrane_NS {

// === At a vertex

/** The limit surface at a vertex of valence n, a column for the vertex and each point of
    Topology::ring(). Rows as in LimitBasis::Row; DU and DV are two tangents, DU x DV outward. At
    valence 6 exact. At others the position and the direction of the normal are, by Loop's masks; second
    derivatives do not exist, and their rows are zero: use corner_weights(). */
LimitBasis::Weights vertex_weights(int n);

/** The limit surface at corner 0 of a face, a column for each point of Topology::stencil(). Where
    that corner is extraordinary, derivatives are those 1/64 inside the face. */
LimitBasis::Weights corner_weights(const Valences &valences);

// === Over a face

/// Integrals over each face, by slot.
struct CurvatureIntegrals {
  std::vector<double> mean;        ///< [slots] H dA
  std::vector<double> willmore;    ///< [slots] 1/2 (2H)^2 dA
  std::vector<double> moment;      ///< [slots][3] (r - origin) dA, origin from the model
  std::vector<double> inertia;     ///< [slots] (r - origin)^2 dA
  void resize(int nslots);
};

/// x is [points][3].
void curvature_integrals(const FaceGroup &group, const double (*x)[3], const FaceModel &model,
                         CurvatureIntegrals &out);

}    // namespace Membrane_NS

#endif
