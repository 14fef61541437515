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

#ifndef LMP_MEMBRANE_MESH_WRITER_H
#define LMP_MEMBRANE_MESH_WRITER_H

#include "membrane_triangle_mesh.h"

#include <string>
#include <utility>
#include <vector>

namespace Membrane_NS {

/// Named scalars at the points of a mesh, one value a point: mean curvature, membrane id, ...
using PointFields = std::vector<std::pair<std::string, std::vector<double>>>;

/// A mesh as it is drawn; source[v] is the point of the mesh it came from that v is an image of.
struct MeshDrawing {
  TriangleMesh mesh;
  std::vector<int> source;
};

/** Cut a periodic mesh open: a face that crosses the box stands by its corner 0, and a corner of it
    that lies elsewhere is doubled, so that nothing is drawn across the box. */
MeshDrawing cut_open(const TriangleMesh &mesh);

/// How the body of a PLY file is stored.
enum class PlyFormat { TEXT, BINARY };    // binary: little endian

// === Writers
// Each replaces the file at path. Text carries 17 digits, so that reading gives the same numbers.
// All throw MeshError if the file cannot be written in full, if a field does not have one value a
// point, or if a coordinate or value is not finite.

/// OFF has no place for fields: the argument is checked and left out.
void write_off(const std::string &path, const TriangleMesh &mesh, const PointFields &fields = {});

/// Fields become extra vertex properties, as doubles; blanks in their names become underscores.
/// Names must differ from one another and from x, y, z.
void write_ply(const std::string &path, const TriangleMesh &mesh, const PointFields &fields = {},
               PlyFormat format = PlyFormat::BINARY);

/// What a TSI file tells of vertices: proteins that sit on them, and the domain that each is in.
struct TsiVertices {
  struct Inclusion {
    int type, vertex;
  };
  std::vector<Inclusion> inclusions;
  std::vector<int> domains;    ///< one a vertex, or none
};

/** TSI of FreeDTS and TS2CG, which has no place for fields either, see write_off(). Its box has the
    lattice vectors of the mesh, which must be along x, y and z, and begins at 0: points are moved
    into it where it is periodic. The direction of all inclusions is 1, 0 in the frame of their vertex. */
void write_tsi(const std::string &path, const TriangleMesh &mesh, const PointFields &fields = {},
               const TsiVertices &vertices = {});

/// VTK XML PolyData for ParaView and OVITO, for drawing: the first field is the active scalar, and
/// a periodic mesh is cut open.
void write_vtp(const std::string &path, const TriangleMesh &mesh, const PointFields &fields = {});

}    // namespace Membrane_NS

#endif
