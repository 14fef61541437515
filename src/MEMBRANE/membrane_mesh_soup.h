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

#ifndef LMP_MEMBRANE_MESH_SOUP_H
#define LMP_MEMBRANE_MESH_SOUP_H

#include "membrane_triangle_mesh.h"

#include <optional>
#include <string>
#include <vector>

namespace Membrane_NS {

/// The periodic box that a mesh is to live in, in the unit of its file. Columns are box vectors.
struct PeriodicBox {
  Eigen::Matrix3d lattice = Eigen::Matrix3d::Identity();
  std::array<bool, 3> periodic = {false, false, false};
};

/** What the reader of a format finds in a file: points, and polygons in any order, orientation and
    number of pieces. */
struct PolygonSoup {
  std::vector<Eigen::Vector3d> points;
  std::vector<int> corners;                  ///< of all polygons, one after the other
  std::vector<size_t> ends;                  ///< polygon i ends before corner ends[i]
  std::optional<Eigen::Matrix3d> lattice;    ///< the periodic box that the file states
  /// How users of the format number vertices and faces; -1: they do not, a message tells the place.
  int first_number = 0;

  int size() const { return static_cast<int>(ends.size()); }
  /// The corners added since the last polygon become one.
  void end_polygon() { ends.push_back(corners.size()); }
  void add_triangle(int a, int b, int c);
  /// The triangles of a strip: each new corner makes one with the two before it, in turning
  /// orientation; those with a corner twice only move the strip, and are left out.
  void add_strip(const std::vector<int> &strip);
  IntSpan polygon(int i) const;
};

/// What a file had, and what was done to make a mesh of it.
struct MeshFileReport {
  int vertices = 0, faces = 0;    // in the file
  int joined = 0;                 // vertices that were another one's double
  int cut = 0;                    // faces with more than 3 corners
  int collapsed = 0;              // faces left out since they have no area: a corner twice
  int separated = 0;              // doubles made of vertices in which surfaces touch
  int turned = 0;                 // faces whose orientation was not that of their surface

  /// One line without the name of the file.
  std::string summary() const;
};

/** The mesh in a soup.

    1. Vertices at the same place are joined, but only those at which the surface ends, that is in
       an edge of one face: surfaces that are closed and merely touch stay apart. Places are the
       same when the coordinates are; of what is open then, when they are within 1e-6 of the
       diagonal of the bounding box, the error of six printed digits; of what is open then, when
       they are so up to periodic images. Vertices in no face are joined with any at their place.
    2. Faces with a corner twice are left out, those with more than 3 corners are cut, see cut_polygon().
    3. Surfaces that share a vertex only get one each.
    4. The faces of a connected surface that are not all in one orientation are turned: outward if it
       is closed, else as most of them are. A surface in one orientation is left as it is.

    Throws MeshError, one line that begins with the file, for what is no mesh that Topology takes, and
    for surfaces with one side only. */
TriangleMesh assemble(const std::string &path, PolygonSoup soup, const PeriodicBox &box,
                      MeshFileReport &report);

// === The steps

/// Step 1: the vertex that each one is joined with, itself if none; corners are renumbered.
std::vector<int> join_open_vertices(PolygonSoup &soup, const PeriodicBox &box);

/** Step 2: cuts a polygon with these corners into triangles by their numbers. Ears are cut off, the
    one with the shortest diagonal first, so a quad is cut along the shorter diagonal unless it is
    concave. An ear is convex seen along the polygon's normal, and holds no other corner. */
std::vector<Face> cut_polygon(const std::vector<Eigen::Vector3d> &x);
/// The most corners it is given.
constexpr int MOST_CORNERS = 256;

}    // namespace Membrane_NS

#endif
