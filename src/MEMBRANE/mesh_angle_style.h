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

#ifndef LMP_MESH_ANGLE_STYLE_H
#define LMP_MESH_ANGLE_STYLE_H

namespace LAMMPS_NS {

/** Faces are angles that need no force, and LAMMPS warns of angles without an angle style whenever it
    initializes. Sets angle style membrane if none is set, so that it does not. */
void set_angle_style_of_faces(class LAMMPS *);

/** Takes angle style membrane away. With an angle style, LAMMPS lists all angles at each reneighboring
    and stops at one that reaches too far before DistributedMesh can say what to do about it. */
void unset_angle_style_of_faces(class LAMMPS *);

}    // namespace LAMMPS_NS

#endif
