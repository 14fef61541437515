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

#ifndef LMP_SRD_STREAMING_H
#define LMP_SRD_STREAMING_H

#include "membrane_srd_walls.h"
#include "pointers.h"
#include "srd_solvent.h"

#include <vector>

namespace LAMMPS_NS {

/// Free flight of solvent between walls at the faces of the box.
class SRDStreaming : protected Pointers {
 public:
  explicit SRDStreaming(LAMMPS *lmp) : Pointers(lmp) {}

  Membrane_NS::BoxWalls walls;

  /// There are walls where the box is not periodic. Call from init().
  void find_walls();
  /// Walls follow the box. Call before using them in a time step.
  void place_walls();
  /// x and v of all solvent of this rank after dt. `turned` receives who has met a wall, and who is
  /// held stays where it is; with walls only.
  void stream(const SRDSolvent &, double dt, const std::vector<char> *held = nullptr,
              std::vector<int> *turned = nullptr);
};

}    // namespace LAMMPS_NS

#endif
