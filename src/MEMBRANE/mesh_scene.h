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

#ifndef LMP_MESH_SCENE_H
#define LMP_MESH_SCENE_H

#include "membrane_tessellation.h"
#include "membrane_triangle_mesh.h"
#include "pointers.h"

#include <array>
#include <functional>
#include <vector>

namespace LAMMPS_NS {

/// The membranes as they are drawn: where in the box, which faces, and by which rank.
class MeshScene : protected Pointers {
 public:
  /// Collective. Of the faces whose corners are all in the group. Closed membranes are in one
  /// piece, beyond the box if need be, or else cut at the box, as what continues through it always
  /// is. The mesh must be up to date and outlive this.
  MeshScene(class LAMMPS *, const class DistributedMesh &mesh, int groupbit, bool in_one_piece);

  /// For this rank to draw; all ranks have about equally many.
  const std::vector<int> &faces() const { return my_faces; }
  /// Atom type of a vertex; 0 if it is not in the group.
  int type(int vertex) const { return types[vertex]; }
  /// The box vectors along which the component of a face is cut at the box.
  const std::array<bool, 3> &cut_along(int face) const;
  /// The points of a face where it is drawn.
  void evaluate(int face, Membrane_NS::FaceTessellation &, std::vector<Membrane_NS::LimitPoint> &);

  /// Collective: mean and standard deviation over the area of all faces of a finite number, as far
  /// as it is finite; false if there is no area.
  bool statistics(const std::function<double(const Membrane_NS::LimitPoint &)> &value, double &mean,
                  double &deviation);

 private:
  const DistributedMesh &mesh;
  Membrane_NS::TriangleMesh control;
  std::vector<int> types, my_faces;
  std::vector<std::array<bool, 3>> cuts;    // by component
  Membrane_NS::StencilPoints stencil;

  void place_components(bool in_one_piece);
  void deal_faces(int groupbit);
};

}    // namespace LAMMPS_NS

#endif
