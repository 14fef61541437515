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

#include <vector>

namespace LAMMPS_NS {

/// What fix->extract("places", dim) of fix hd/lipids is: the lipids on all faces, the same on all ranks.
struct LipidPlaces {
  const Membrane_NS::FaceLipids *lipids = nullptr;    ///< null before the first run
  std::vector<Membrane_NS::LipidKind> kinds;
};

}    // namespace LAMMPS_NS

#endif
