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
CommandStyle(hd_velocity,HDVelocity);
// clang-format on
#else

#ifndef LMP_HD_VELOCITY_H
#define LMP_HD_VELOCITY_H

#include "command.h"
#include "membrane_mass.h"

namespace LAMMPS_NS {

/// Draws the velocities of control points from thermal equilibrium: <qdot qdot^T> = kT M^-1.
class HDVelocity : public Command {
 public:
  HDVelocity(class LAMMPS *);
  void command(int, char **) override;

 private:
  double temperature;
  bigint seed;
  bool momentum, rotation, scale;    // what is removed, and whether T is made exact

  void parse(int, char **, class HDMass &, int groupbit);
  double remove_rigid_motion(HDMass &, Membrane_NS::VertexField &v);
};

}    // namespace LAMMPS_NS

#endif
#endif
