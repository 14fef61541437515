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

#ifndef LMP_SRD_SURFACE_H
#define LMP_SRD_SURFACE_H

#include "membrane_srd_corners.h"
#include "membrane_srd_surface.h"
#include "membrane_triangle_mesh.h"
#include "pointers.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/** The surface that solvent meets, apart from where it is in a step: triangles between the limit
    positions of the control points of a group of membranes, or finer ones, and in which periodic
    images their corners belong together. Stays valid from a setup() to the next, as LAMMPS counts
    image flags. */
class SRDSurface : protected Pointers {
 public:
  /// Faces are cut in 2^level x 2^level, see SurfaceCorners. `user` is named in messages.
  SRDSurface(class LAMMPS *, int groupbit, int level, std::string user);

  /// Collective; call from setup(), when the mesh is unwrapped.
  void setup(const class DistributedMesh &);

  // === Triangles

  const Membrane_NS::SurfaceFaces &faces() const { return triangles; }
  /// Those of the mesh, which are point masses, and after them the corners of a finer surface.
  int num_vertices() const { return finer ? finer->count() : num_masses; }
  /// Of level 1 and above; else null.
  const Membrane_NS::SurfaceCorners *corners() const { return finer.get(); }
  /// Vertices that are means of masses, from these, by corners() or a part of them; if null, none
  /// are.
  void place_corners(const Membrane_NS::SurfaceCorners *,
                     std::vector<Membrane_NS::SurfaceVertex> &) const;
  /// Appends the triangles that a face of the mesh is, or is cut into; none if it is not of the
  /// group.
  void add_triangles(int mesh_face, std::vector<int> &) const;

  /// The component of the mesh that a face is part of; components without faces here belong to
  /// other groups.
  int component(int face) const { return face_component[face]; }
  /// Components of the group.
  const std::vector<int> &components() const { return group_components; }
  /// Mean length of an edge of the mesh at setup(), and of an edge of the surface.
  double mesh_edge() const { return mean_edge; }
  double edge() const { return mean_edge / (1 << level); }

  // === Images, in box vectors

  /// From where LAMMPS unwraps the atom of a vertex to its place with its component in one piece.
  const std::array<int, 3> &to_one_piece(int vertex) const { return offset[vertex]; }
  /// Sum over the ring of a vertex, from the place of each neighbour to its image next to the
  /// vertex.
  const std::array<int, 3> &ring_images(int vertex) const { return ring_seam[vertex]; }

  double memory_usage() const;

 private:
  int groupbit, level;
  std::string user;
  int num_masses;
  Membrane_NS::SurfaceFaces triangles;
  std::unique_ptr<Membrane_NS::SurfaceCorners> finer;
  std::vector<Membrane_NS::Face> finer_faces;    // what it was made for
  Membrane_NS::SurfaceCorners::Seams finer_seams;
  std::vector<int> face_component, group_components;
  std::vector<int> group_faces;    // of the mesh
  double mean_edge;
  std::vector<std::array<int, 3>> offset, ring_seam;

  void find_components(const DistributedMesh &);
  void find_offsets(const DistributedMesh &, const Membrane_NS::TriangleMesh &);
  Membrane_NS::SurfaceCorners::Seams find_seams(const Membrane_NS::Topology &,
                                                const Membrane_NS::TriangleMesh &);
  void cut_faces(const Membrane_NS::Topology &, Membrane_NS::SurfaceCorners::Seams);
  void make_triangles(const Membrane_NS::Topology &, const Membrane_NS::TriangleMesh &);
};

}    // namespace LAMMPS_NS

#endif
