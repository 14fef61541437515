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

#ifndef LMP_MEMBRANE_MOLECULE_COMPOSITION_H
#define LMP_MEMBRANE_MOLECULE_COMPOSITION_H

#include "membrane_molecule_crowd.h"

namespace Membrane_NS {

/// A connected membrane, to be built of lipids.
struct MembranePart {
  std::vector<int> faces;    ///< of the limit surface
  long long membrane;        ///< what it is called
};

/// What lipids there are to be on each face, in place of those of the patch.
struct FaceComposition {
  std::vector<double> area;    ///< [species] of one lipid
  /// [faces of the surface][species] for either leaflet: how many, whole or not. Only proportions matter.
  std::array<std::vector<double>, LEAFLETS> number;

  /// By species, of the faces of a membrane.
  std::vector<double> sum(const MembranePart &, int leaflet) const;
  /// Mean area of a lipid of these.
  double area_per_lipid(const std::vector<double> &sum) const;
  /// Those of a face, or if it has none, of the faces around it, as far as needed.
  std::vector<double> near(const Topology &, int face, int leaflet) const;
};

/** Changes the kinds of lipids, whose total numbers become those in proportion to `wanted`, [part][leaflet][species],
    so that each face has the composition that it should have. `purpose` tells random numbers of one call from another's. */
void follow_faces(LipidCrowd &crowd, const std::vector<MembranePart> &membranes, const FaceComposition &composition,
                  const std::vector<std::array<std::vector<int>, LEAFLETS>> &wanted, int purpose);

}    // namespace Membrane_NS

#endif
