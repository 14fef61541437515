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

#ifndef LMP_SRD_MESH_ARGUMENTS_H
#define LMP_SRD_MESH_ARGUMENTS_H

#include "membrane_srd_walls.h"
#include "srd_cells.h"

#include <cstdint>

namespace LAMMPS_NS {

/// What a fix srd/mesh command says.
struct SRDMeshArguments {
  int every = 0;         ///< steps from collision to collision in cells
  int membranes = -1;    ///< their group, or none
  double temperature = 0.0;
  double lamda = 0.0;    ///< mean free path, instead of the temperature, if positive
  uint64_t seed = 0;
  SRDCells::Settings cells;
  enum class Shift { NO, YES, POSSIBLE } shift = Shift::NO;
  bool cubic_error = true;
  double cubic_tolerance = 0.01;
  enum class Inside { ERROR, WARN, IGNORE } inside = Inside::WARN;
  bool noslip = true, control = false, set_velocities = true, ghosts = false;
  bool measure = true;    ///< membranes are sampled at the solvent's temperature
  int level = 0, bounces = 0;
  double search = 0.0;
  Membrane_NS::BoxWalls walls;    ///< how they collide and move

  /// All words of the command; stops with an error that names what is wrong.
  static SRDMeshArguments parse(class LAMMPS *, int narg, char **arg);
};

}    // namespace LAMMPS_NS

#endif
