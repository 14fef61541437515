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

#ifndef LMP_MESH_DISTRIBUTED_H
#define LMP_MESH_DISTRIBUTED_H

#include "membrane_helfrich.h"
#include "membrane_topology.h"
#include "membrane_triangle_mesh.h"
#include "pointers.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/** The mesh of all membranes of a simulation, as the ranks share it. Atom style membrane_cp owns
    the one instance. Styles hold on to it with a LocalMesh; commands, which are done before LAMMPS
    can replace the atom style, reach it with DistributedMesh::of().

    Vertices are the atoms that are corners of faces, numbered by increasing atom ID; faces are
    angles, numbered by their corners: the numbers do not depend on the decomposition. The topology
    is the same on every rank. Coordinates are LAMMPS' own, owned and ghost atoms. */
class DistributedMesh : protected Pointers {
 public:
  explicit DistributedMesh(class LAMMPS *);

  /// The mesh of this simulation; `user` is named in the error if the atom style has none.
  static DistributedMesh &of(class LAMMPS *lmp, const std::string &user) { return *shared(lmp, user); }
  /// The same, for one who outlives the atom style.
  static const std::shared_ptr<DistributedMesh> &shared(class LAMMPS *, const std::string &user);

  /// Angles of these types are faces; "*" for all.
  void set_face_types(const std::string &types) { face_types = types; }

  // === Life cycle

  /** Collective; call from init(). Collects the faces anew if any changed since the last call,
      checks them, makes image flags of closed membranes consistent, and raises LAMMPS' communication
      cutoff to what the stencils need. */
  void update();
  /// Counts topologies: differs after an update() that found changed faces. 0 before the first.
  int generation() const { return version; }
  /// Counts calls of update(): unwrapped() and all lengths are those of the last.
  bigint updates() const { return update_count; }

  // === The whole mesh, the same on every rank

  const Membrane_NS::Topology &topology() const { return topo; }
  tagint tag(int vertex) const { return tags[vertex]; }
  /// The vertex of an atom ID, or -1 if the atom is not a control point.
  int vertex(tagint id) const;
  /// Molecule ID: which membrane a connected component is part of.
  tagint molecule(int component) const { return component_molecule[component]; }
  /// Membranes: the distinct molecule IDs, increasing.
  const std::vector<tagint> &molecules() const { return membranes; }
  /// The index in molecules() of a component.
  int membrane(int component) const { return component_membrane[component]; }
  /// Whether a component encloses a volume, as opposed to one that continues through the box.
  bool is_closed(int component) const { return closed[component]; }
  bool is_closed_membrane(int membrane) const;
  /// How a face is named to the user: by the atom IDs of its corners.
  std::string face_name(int f) const;
  /// Longest edge at update().
  double longest_edge() const { return edge_max; }
  /// Unwrapped coordinates of all vertices at the last update(), [vertices][3]: each connected
  /// component in one piece.
  const std::vector<double> &unwrapped() const { return whole; }
  /// The same with faces and the present box; the corner of the box is not the origin.
  Membrane_NS::TriangleMesh triangle_mesh() const;

  // === This rank's part: the faces whose first corner it owns

  /// Call before using what follows in a time step; cheap unless LAMMPS has reneighboured since.
  void refresh();
  /// Counts reneighbourings: local indices are valid as long as this stays the same.
  bigint epoch() const { return local_epoch; }
  const std::vector<int> &owned_faces() const { return faces_here; }
  /// Owned control points, in the order of atoms.
  struct OwnedPoint {
    int atom, vertex;
  };
  const std::vector<OwnedPoint> &owned_points() const { return points_here; }
  /// Group owned faces for a set of rules; points are local atom indices (owned and ghost).
  std::vector<Membrane_NS::FaceGroup> local_groups(Membrane_NS::PatchRules &rules,
                                                   const std::vector<int> &faces);
  std::vector<Membrane_NS::FaceGroup> local_groups(Membrane_NS::PatchRules &rules)
  {
    refresh();
    return local_groups(rules, faces_here);
  }
  /// The local index of the image of `neighbor` that is nearest to local atom i; for edges.
  int local_neighbor(int i, int neighbor, int face);
  /// The same, or -1 if it is beyond the communication cutoff.
  int find_neighbor(int i, int neighbor);

  double memory_usage() const;

 private:
  std::string face_types = "*";
  int version = 0;
  bigint update_count = 0;
  bigint fingerprint = 0;    // of all faces

  Membrane_NS::Topology topo;
  std::vector<tagint> tags;
  std::vector<tagint> component_molecule, membranes;
  std::vector<int> component_membrane;
  std::vector<char> closed;
  std::vector<double> whole;
  double edge_max = 0.0, reach_max = 0.0;

  bool stale = true;
  bigint seen_ncalls = -1, seen_lastcall = -1, local_epoch = 0;
  int seen_nlocal = -1, seen_nghost = -1;
  std::vector<int> faces_here;
  std::vector<OwnedPoint> points_here;

  struct AngleList;
  void collect_angles(AngleList &);
  void rebuild(const AngleList &);
  void report_missing_atoms();
  void unwrap();
  bool moved_since_unwrap();
  void measure_reach();
};

/// What an atom style that has a mesh provides.
class MeshOwner {
 public:
  virtual ~MeshOwner() noexcept(false) = default;
  virtual const std::shared_ptr<DistributedMesh> &mesh() = 0;
};

}    // namespace LAMMPS_NS

#endif
