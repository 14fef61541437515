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

#ifndef LMP_SRD_SURFACE_PART_H
#define LMP_SRD_SURFACE_PART_H

#include "membrane_srd_corners.h"
#include "membrane_srd_surface.h"
#include "mesh_copies.h"
#include "srd_surface.h"

#include <memory>
#include <vector>

namespace LAMMPS_NS {

/** What a rank has of the surface: some triangles, their corners, and the point masses that these are
    or are means of, its own and copies of others'. All of it is numbered as if it were a surface of
    its own, in the order of the whole surface. */
class SRDSurfacePart : protected Pointers {
 public:
  /** Collective. Triangles in ascending order. The masses are the owned vertices and what the
      triangles need; or if all_masses, all those of the surface. What is passed must outlive this. */
  SRDSurfacePart(class LAMMPS *, const SRDSurface &, const Membrane_NS::Topology &,
                 const class MeshPart &, std::vector<int> triangles, bool all_masses);

  // === What it has

  const Membrane_NS::SurfaceFaces &faces() const { return triangles; }
  int component(int face) const { return whole.component(whole_face[face]); }
  /// The numbers of the triangles in the whole surface.
  const std::vector<int> &whole_faces() const { return whole_face; }
  /// The masses, by their vertices in the mesh.
  const std::vector<int> &masses() const { return mass; }
  int num_masses() const { return static_cast<int>(mass.size()); }
  /// Masses, and after them the corners of a finer surface.
  int num_vertices() const { return num_masses() + static_cast<int>(finer.size()); }
  /// Of level 1 and above; else null.
  const Membrane_NS::SurfaceCorners *corners() const { return table; }

  // === Its numbers of vertices, and those of the whole surface

  /// Of an owned vertex of the mesh part.
  int place(int owned) const { return owned_place[owned]; }
  int to_whole(int vertex) const
  {
    return vertex < num_masses() ? mass[vertex] : finer[vertex - num_masses()];
  }
  /// -1 if it has none.
  int from_whole(int vertex) const;
  /// The same of a vertex that an impulse acts on: of one that it has not, the masses that it has.
  int hit_from_whole(int vertex);

  // === Exchange

  /// Collective: `width` numbers of each mass, here from the owners', in the order of their parts.
  void spread(const std::vector<double> &owned, int width, std::vector<double> &values);
  /// Collective: the triangles of the surface that come into the region between lo and hi, of all
  /// ranks' parts, in ascending order. Where vertices are: at the start of their paths.
  std::vector<int> find_in(const Eigen::Vector3d &lo, const Eigen::Vector3d &hi,
                           const Eigen::Matrix3d &lattice,
                           const std::vector<Membrane_NS::SurfaceVertex> &vertices) const;
  /// Collective; call before asking for sharers.
  void find_sharers();
  /// The other ranks that have a mass, between these.
  const int *first_sharer(int mass) const { return shared.begin(sharing[mass]); }
  const int *last_sharer(int mass) const { return shared.end(sharing[mass]); }

  double memory_usage() const;

 private:
  const SRDSurface &whole;
  std::vector<int> whole_face;
  Membrane_NS::SurfaceFaces triangles;
  std::vector<int> mass, finer;    // numbers in the whole surface
  std::unique_ptr<Membrane_NS::SurfaceCorners> part_of_table;
  const Membrane_NS::SurfaceCorners *table;
  std::unique_ptr<VertexCopies> copies;
  std::vector<int> owned_place, copy_place;
  std::vector<double> received;
  VertexCopies::Lists shared;
  std::vector<int> sharing;    // the list of a mass
  std::vector<std::pair<int, int>> hit;    // corners that others hit, and their numbers

  void find_masses(const Membrane_NS::Topology &, const MeshPart &, bool all_masses);
  void number_triangles();
};

}    // namespace LAMMPS_NS

#endif
