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

#ifdef COMMAND_CLASS
// clang-format off
CommandStyle(hd_timestep,HDTimestep);
// clang-format on
#else

#ifndef LMP_HD_TIMESTEP_H
#define LMP_HD_TIMESTEP_H

#include "command.h"
#include "membrane_mass.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/// Finds the longest stable and a sufficiently accurate timestep for the present state.
class HDTimestep : public Command {
 public:
  HDTimestep(class LAMMPS *);
  void command(int, char **) override;

 private:
  double wanted;        // energy error, relative to the kinetic energy
  int degree;           // of the spherical harmonic of interest; 0 if none
  double wavelength;    // of the wave of interest; 0 if none
  bool set;             // the timestep

  struct Trial {
    double dt, error;
  };

  void parse(int, char **, class HDMass &, int groupbit);
  /// fits: the wavelength that it has, if it is a wave.
  Membrane_NS::VertexField mode_shape(HDMass &, double &fits) const;
  bool start_moving(HDMass &, double limit) const;
  double energy_error(HDMass &, class StiffnessProbe &, double dt, int nsteps) const;
  bool has_other_atoms(HDMass &) const;
  void renew_lists(HDMass &) const;
  std::vector<Trial> run_trials(HDMass &, StiffnessProbe &, double limit) const;
  double largest_of_springs(bool overdamped) const;
  void print(const std::string &) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
