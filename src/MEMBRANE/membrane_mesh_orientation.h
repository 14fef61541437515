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

#ifndef LMP_MEMBRANE_MESH_ORIENTATION_H
#define LMP_MEMBRANE_MESH_ORIENTATION_H

#include "membrane_triangle_mesh.h"

#include <vector>

namespace Membrane_NS {

/** The volume inside each connected component, by its flat faces: negative if it is inside out, NaN if
    it continues through the periodic box and has no inside. */
std::vector<double> enclosed_volumes(const Topology &topology, const TriangleMesh &mesh);

/// Reverse the faces of the components for which `which` is true; returns how many faces.
int turn_components(TriangleMesh &mesh, const Topology &topology, const std::vector<bool> &which);

}    // namespace Membrane_NS

#endif
