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
CommandStyle(create_solvent,CreateSolvent);
// clang-format on
#else

#ifndef LMP_CREATE_SOLVENT_H
#define LMP_CREATE_SOLVENT_H

#include "command.h"
#include "membrane_side.h"
#include "membrane_srd_clearance.h"
#include "membrane_triangle_mesh.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace LAMMPS_NS {

/** Fills the space inside or outside of closed membranes, or both, with atoms at random. The same
    atoms on any number of ranks. */
class CreateSolvent : public Command {
 public:
  explicit CreateSolvent(class LAMMPS *lmp) : Command(lmp) {}
  void command(int, char **) override;

 private:
  enum class Side { INSIDE, OUTSIDE, BOTH };
  int type = 0;
  Side side = Side::BOTH;
  double density = 0.0, mass = 0.0, distance = 0.0;    // mass 0: that of the atom style
  uint64_t seed = 0;
  tagint molecule = 0;
  class Region *region = nullptr;

  // closed membranes: the triangles between limit positions; a connected surface each
  Membrane_NS::TriangleMesh surface;
  std::vector<Membrane_NS::SurfaceSide> closed;
  double enclosed = 0.0;    // volume
  std::unique_ptr<Membrane_NS::SurfaceClearance> clearance;

  void parse(int, char **);
  void find_membranes();
  double find_enclosed(const std::vector<std::vector<Membrane_NS::Face>> &faces);
  bool is_inside(const Eigen::Vector3d &fraction) const;
  bool is_wanted(const double *x, const double *fraction) const;
  bigint add_atoms(bigint n);
  bool is_here(const double *x);
  void add_atom(const double *x, tagint id);
  void finish(bigint before);
};

}    // namespace LAMMPS_NS

#endif
#endif
