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

#ifndef LMP_MESH_LIPID_PLACES_H
#define LMP_MESH_LIPID_PLACES_H

#include "membrane_lipid_library.h"
#include "membrane_lipid_numbers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/// What fix->extract("places", dim) of fix hd/lipids is: the lipids on all faces, the same on all ranks.
struct LipidPlaces {
  const Membrane_NS::FaceLipids *lipids = nullptr;    ///< null before the first run
  std::vector<Membrane_NS::LipidKind> kinds;
  const class DistributedMesh *mesh = nullptr;        ///< whose faces they are on, and which generation of them
  int generation = 0;

  /// Those of the present faces of a mesh; null if there are none, or faces have changed since the last run.
  static const LipidPlaces *on(const class DistributedMesh &, class Modify *);
  /// The number of a kind, or -1.
  int kind(const std::string &name) const;
  /// So many of the lipids of a face and leaflet are of this kind.
  int count(int leaflet, int face, int kind) const;
};

}    // namespace LAMMPS_NS

#endif
