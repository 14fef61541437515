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

#ifndef LMP_MEMBRANE_MESH_FILE_H
#define LMP_MEMBRANE_MESH_FILE_H

#include "membrane_triangle_mesh.h"

#include <string>

namespace Membrane_NS {

/** Read the triangles of a mesh file; its extension names the format.

    .off  OFF, text; colours and normals (COFF, NOFF, CNOFF) are left out
    .ply  PLY, text or binary of either byte order; other elements and properties are left out
    .obj  Wavefront OBJ; `v` and `f` lines, with negative indices; all other lines are left out
    .stl  STL, text or binary; corners closer than 1e-6 of the diagonal of the bounding box are
          welded into one vertex, and facets that collapse by this are left out

    The result is not periodic; vertices keep the order of the file. Corner indices are checked to
    be in range and coordinates to be finite, the rest is for Topology to check.

    Throws MeshError, one line that names the file, the line where there is one, and the cure: for
    a file that cannot be read, is truncated or has wrong counts, bad numbers, faces that are not
    triangles, or no faces at all. */
TriangleMesh read_mesh(const std::string &path);

}    // namespace Membrane_NS

#endif
