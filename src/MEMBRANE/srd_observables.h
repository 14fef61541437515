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

#ifndef LMP_SRD_OBSERVABLES_H
#define LMP_SRD_OBSERVABLES_H

#include "pointers.h"

namespace LAMMPS_NS {

/// The numbers that a fix srd/mesh gives as its vector, and those that restart files carry on.
class SRDObservables : protected Pointers {
 public:
  explicit SRDObservables(class LAMMPS *lmp) : Pointers(lmp) {}

  enum {
    TEMPERATURE, COLLISIONS, CROSSINGS, RESCUES, MOMENTUM, INSIDE = MOMENTUM + 3, OUTSIDE,
    VISCOSITY, TEMPERATURE_IN, TEMPERATURE_OUT, HANDED, FREE_PATH = HANDED + 3,
    NORMAL_IMPULSE, WALLS, VISCOSITY_IN = WALLS + 3, VISCOSITY_OUT, NUM_VALUES
  };
  double operator[](int i) const { return values[i]; }

  /// What is looked at. Pointers may be null.
  struct Scene {
    const class SRDSolvent &solvent;
    const class SRDFluid &fluid;
    class SRDCells &cells;
    const int *sides;                        ///< by owned atom, see SRDCells
    class HDMass *mass;                      ///< of membranes
    const class SurfaceObstacle *obstacle;
    bool have_regions;                       ///< the obstacle has assigned them
    bigint strays;                           ///< on the wrong side, not yet among its crossings
    const double *wall_impulse;              ///< of this rank
  };
  /// Collective.
  void sample(const Scene &);

  // === Restart: sums up to a restart file are added to those after it

  void store(double *list) const;
  void restore(const double *list);

 private:
  double values[NUM_VALUES] = {}, carried[NUM_VALUES] = {};    // now; up to the restart file

  void sample_momentum(const Scene &);
  void sample_obstacle(const Scene &);
};

}    // namespace LAMMPS_NS

#endif
