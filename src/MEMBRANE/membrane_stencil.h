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

#ifndef LMP_MEMBRANE_STENCIL_H
#define LMP_MEMBRANE_STENCIL_H

#include "membrane_topology.h"
#include "membrane_triangle_mesh.h"

namespace Membrane_NS {

/// A row for each point of Topology::stencil().
using StencilPoints = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/** The control points of a face in the periodic image in which they belong together: corners
    nearest to the first, the points of a corner's ring nearest to that corner. */
void stencil_points(const Topology &topology, const TriangleMesh &control, int face,
                    StencilPoints &points);

}    // namespace Membrane_NS

#endif
