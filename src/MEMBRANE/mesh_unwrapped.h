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

#ifndef LMP_MESH_UNWRAPPED_H
#define LMP_MESH_UNWRAPPED_H

#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {

class MeshFaces;

/** Coordinates of all control points with each connected component in one piece, found by walking over
    edges, and what follows from them: which components are closed, and lengths. A component that comes
    back to where it started in another image of the box is periodic, others are closed and get image
    flags that agree with the walk, for volumes are measured in unwrapped coordinates. */
class MeshUnwrapped : protected Pointers {
 public:
  /// The mesh must outlive this.
  MeshUnwrapped(class LAMMPS *lmp, const MeshFaces &mesh) : Pointers(lmp), mesh(mesh) {}

  /// Collective. Stops at atoms that are missing or lost, and at edges that span half the box.
  void update();
  /// Collective: whether atoms have moved since, other than by wrapping.
  bool has_moved() const;

  /// [vertices][3]
  const std::vector<double> &points() const { return coordinates; }
  bool is_closed(int component) const { return closed[component]; }
  double longest_edge() const { return edge_max; }
  /// From a corner of a face to the furthest point that shapes the face.
  double reach() const;
  double memory_usage() const;

 private:
  const MeshFaces &mesh;
  std::vector<double> coordinates;
  std::vector<char> closed;
  double edge_max = 0.0;

  std::vector<tagint> gather_points();
  void walk(const std::vector<tagint> &molecule);
  void check_edges() const;
  void correct_images();
};

}    // namespace LAMMPS_NS

#endif
