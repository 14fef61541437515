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
CommandStyle(create_membrane,CreateMembrane);
// clang-format on
#else

#ifndef LMP_CREATE_MEMBRANE_H
#define LMP_CREATE_MEMBRANE_H

#include "command.h"
#include "membrane_triangle_mesh.h"

#include <string>

namespace LAMMPS_NS {

/// Makes the control points and faces of a membrane from a shape, or of several from a mesh file.
class CreateMembrane : public Command {
 public:
  CreateMembrane(class LAMMPS *);
  void command(int, char **) override;

 private:
  int type, angle_type, refine;
  tagint molecule;    // of all surfaces; 0: each has its own, from one more than the largest on
  tagint first_molecule, last_molecule;    // of those that were made
  double mass;
  bool interpolated, flip;
  double centre[3], scale[3];
  bool centred;    // whether the shape is to be moved to `centre`
  int axis;        // along which it continues through the box, of a cylinder; -1: none
  std::string shape;
  std::string path;      // of a mesh file
  std::string report;    // on the first rank: what the file had

  int parse_shape(int, char **, Membrane_NS::TriangleMesh &);
  void parse_options(int, char **);
  void read_file(Membrane_NS::TriangleMesh &);
  std::string turn(Membrane_NS::TriangleMesh &);
  void check_edges(const Membrane_NS::TriangleMesh &);
  void check_inside_box(const Membrane_NS::TriangleMesh &);
  void reserve_angles(int);
  void add_atoms(const Membrane_NS::TriangleMesh &);
};

}    // namespace LAMMPS_NS

#endif
#endif
