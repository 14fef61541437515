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
CommandStyle(hd_modes,HDModes);
// clang-format on
#else

#ifndef LMP_HD_MODES_H
#define LMP_HD_MODES_H

#include "command.h"
#include "membrane_lowest_modes.h"

#include <string>

namespace LAMMPS_NS {

/// Finds the softest modes of the present state of a membrane and writes them for "modes file" of fix hd.
class HDModes : public Command {
 public:
  HDModes(class LAMMPS *);
  void command(int, char **) override;

 private:
  int count;
  std::string file;
  double tolerance;
  bool rigid;    // are among the modes

  void parse(int, char **, class HDMass &, int groupbit);
  int component_of(class HDMass &) const;
  Membrane_NS::Eigenpairs solve(HDMass &, class StiffnessProbe &, Membrane_NS::NormalMotion &,
                                const std::vector<int> &vertices) const;
  void write(HDMass &, Membrane_NS::NormalMotion &, const Membrane_NS::Eigenpairs &, const std::vector<int> &vertices,
             double stiffness_unit) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
