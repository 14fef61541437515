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

#ifndef LMP_SRD_INFLUENCES_H
#define LMP_SRD_INFLUENCES_H

#include "pointers.h"

namespace LAMMPS_NS {

/// What else acts on the solvent of a fix, and on membranes among it.
class SRDInfluences : protected Pointers {
 public:
  /// self: the fix, which all others are compared with.
  SRDInfluences(class LAMMPS *lmp, const class Fix *self) : Pointers(lmp), self(self) {}

  bool have_forces = false;        ///< some fix or pair style acts on solvent
  bool velocities_stay = false;    ///< but for forces and what the fix itself does

  /// Collective; from init(): stops if other fixes move solvent, and finds the two above.
  void init(const class SRDSolvent &);
  /// Collective: stops if what a fix deform takes along with the box would pass through what it
  /// does not.
  void check_box_movers(const SRDSolvent &, int membranes);

 private:
  const Fix *self;

  void check_integrators(const SRDSolvent &);
  void find(const SRDSolvent &);
};

}    // namespace LAMMPS_NS

#endif
