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

#ifndef LMP_SRD_SURFACE_IN_CELLS_H
#define LMP_SRD_SURFACE_IN_CELLS_H

#include "membrane_vertex_field.h"
#include "pointers.h"

#include <cstdint>

namespace LAMMPS_NS {

/** The point masses of a surface as they take part in the collisions of cells.

    Solvent that bounces back at a surface still slips where cells are cut by it, unless the surface
    itself has mass in these cells. Each mass collides with the solvent on one of its sides, drawn
    anew for each step. What is held is a wall: it has thermal velocities. */
class SurfaceInCells : protected Pointers {
 public:
  /// seed: of sides and velocities.
  SurfaceInCells(class LAMMPS *, class SurfaceMotion &, uint64_t seed);

  /// Collective; before a collision in cells between two parts of a step.
  void join(class SRDCells &, bigint step, double kT);
  /// Collective; after it. Adds the momentum that this rank's masses were given to `momentum`, 3
  /// numbers.
  void leave(SRDCells &, double *momentum);

 private:
  SurfaceMotion &motion;
  uint64_t seed;
  Membrane_NS::VertexField joined;    // velocities of owned masses as they joined
};

}    // namespace LAMMPS_NS

#endif
