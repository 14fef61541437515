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

#ifndef LMP_TRIAL_ENERGY_H
#define LMP_TRIAL_ENERGY_H

#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/** The potential energy of the whole system, as compute pe has it, after a trial move within a step, and forces
    that are right whether it is accepted or not: what a Monte Carlo move asks.

      trial.init();                                // in init()
      trial.expect(step);                          // for each step with moves, in an earlier one or in setup()
      at the end of a step:
        const double before = trial.begin();
        ... move what is to be moved ...
        const double after = trial.evaluate();
        if (accepted) trial.keep();
        else { ... move it back ...; trial.put_back(); }

    Between begin() and the end no atom changes its rank. Neighbor lists are not made anew: moves are shorter
    than they allow for. All calls are collective. */
class TrialEnergy : protected Pointers {
 public:
  /// `user` is named in errors.
  TrialEnergy(class LAMMPS *, std::string user);
  /// Stops at fixes whose energy cannot be asked for, and warns of those whose energy does not count.
  void init();
  /// LAMMPS will tally energies in this step.
  void expect(bigint step);

  /// Remembers forces. The energy now; of an expected step, unless a move was kept or put back in it.
  double begin();
  /// The energy where atoms are, with forces and all tallies of the step; brings ghost atoms up to date.
  double evaluate();
  /// The trial is the state now: forces are those of evaluate(), and of noise as before.
  void keep();
  /// All is back where begin() found it: forces as they were, tallies found anew.
  void put_back();

 private:
  std::string user;
  class Compute *pe;
  bool with_noise;    // some fix adds forces that must not be drawn twice in a step
  double last;        // energy of the present state, if
  bigint last_step;   // it is of this step
  std::vector<double> forces, rest;

  double forces_and_energy();
  void resume();
};

}    // namespace LAMMPS_NS

#endif
