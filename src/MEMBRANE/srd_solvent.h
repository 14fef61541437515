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

#ifndef LMP_SRD_SOLVENT_H
#define LMP_SRD_SOLVENT_H

#include "pointers.h"

#include <cstdint>
#include <vector>

namespace LAMMPS_NS {

/// Which owned atoms are solvent, their masses, and what is done to them all.
class SRDSolvent : protected Pointers {
 public:
  SRDSolvent(class LAMMPS *, int igroup);

  /// Call after reneighbouring.
  void refresh();

  /// Solvent atoms are in [first, last); all atoms of the range if dense().
  int first() const { return begin; }
  int last() const { return end; }
  bool dense() const { return end - begin == mine; }
  bool has(int i) const { return mask[i] & groupbit; }
  /// Solvent atoms of this rank.
  int count() const { return mine; }
  /// Mass of owned atom i, by index.
  const double *mass() const { return masses; }

  /// Collective; call from init(). Stops if there is none, if atoms have no mass, or if some are of the group
  /// of membranes.
  void check(int membrane_bit) const;

  // === Velocities and forces

  /// Collective: velocities drawn from Maxwell's distribution of kT (mass times velocity squared),
  /// less their momentum, then scaled to the temperature.
  void draw_velocities(uint64_t seed, bigint step, double kT) const;
  /// Forces act for a time; returns by how much they have changed a velocity of this rank at most.
  double kick(double time) const;
  void zero_forces() const;

  // === Sums over all ranks; collective

  bigint total() const;
  /// Momentum, and mass as the fourth number.
  void momentum(double *) const;

 private:
  int igroup, groupbit;
  int begin = 0, end = 0, mine = 0;
  const int *mask = nullptr;
  const double *masses = nullptr;
  std::vector<double> by_type;    // for atom styles without masses of their own
};

}    // namespace LAMMPS_NS

#endif
