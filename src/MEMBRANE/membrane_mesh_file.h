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

#include "membrane_mesh_soup.h"

#include <string>
#include <string_view>

namespace Membrane_NS {

/** Read a mesh file; its extension names the format.

    .off   OFF, text, with or without its first word; colours and normals (COFF, NOFF, CNOFF) are
           left out
    .ply   PLY, text or binary of either byte order, faces and triangle strips; other elements and
           properties are left out
    .obj   Wavefront OBJ; `v` and `f` lines, with negative indices; all other lines are left out
    .stl   STL, text or binary
    .vtp   VTK XML PolyData, text or base64 without compression, polygons and strips
    .tsi   FreeDTS and TS2CG: vertices and triangles; inclusions are read_inclusions()'
    .mesh  the program hd: vertices and triangles; lists of neighbours are left out

    assemble() in membrane_mesh_soup.h makes a mesh of what the file has, and says what it did. The
    mesh lives in the box given, and its faces pass Topology; vertices keep the order of the file.

    Throws MeshError, one line that names the file, the line where there is one, and the cure: for
    a file that cannot be read, is truncated or has wrong counts, bad numbers, no faces at all, or
    surfaces that are none. */
TriangleMesh read_mesh(const std::string &path, const PeriodicBox &box, MeshFileReport &report);

/// The same outside of a box, without a report.
TriangleMesh read_mesh(const std::string &path);

/// The same of a file that has been read: `path` names the format, and the file in messages.
TriangleMesh parse_mesh(const std::string &path, std::string_view content, const PeriodicBox &box,
                        MeshFileReport &report);

/// Vertices of a .tsi file with inclusions of a type; MeshError likewise, and if the file is another.
std::vector<Eigen::Vector3d> read_inclusions(const std::string &path, int type);

}    // namespace Membrane_NS

#endif
