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
#include "membrane_triangle_mesh.h"
#include "mesh_faces.h"
#include "mesh_lipids.h"
#include "mesh_unwrapped.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/** The mesh of all membranes of a simulation, as the ranks share it: its faces, where its control points
    are, and the part of this rank. Atom style membrane_cp owns the one instance. Styles hold on to it
    with a LocalMesh; commands, which are done before LAMMPS can replace the atom style, reach it with
    DistributedMesh::of(). Coordinates are LAMMPS' own, of owned and ghost atoms. */
class DistributedMesh : public MeshFaces {
 public:
  explicit DistributedMesh(class LAMMPS *);

  /// The mesh of this simulation; `user` is named in the error if the atom style has none.
  static DistributedMesh &of(class LAMMPS *lmp, const std::string &user) { return *shared(lmp, user); }
  /// The same, for one who outlives the atom style.
  static const std::shared_ptr<DistributedMesh> &shared(class LAMMPS *, const std::string &user);

  // === Life cycle

  /** Collective; call from init(). Brings faces and unwrapped coordinates up to date, and raises LAMMPS'
      communication cutoff to what the stencils need. */
  void update();
  /// Counts calls of update(): unwrapped() and all lengths are those of the last.
  bigint updates() const { return update_count; }

  // === The whole mesh, the same on every rank

  /// Whether a component encloses a volume, as opposed to one that continues through the box.
  bool is_closed(int component) const { return pieces.is_closed(component); }
  bool is_closed_membrane(int m) const;
  /// Warns of components that are wider than the periodic box.
  void warn_of_overlap() const;
  /// Longest edge at update().
  double longest_edge() const { return pieces.longest_edge(); }
  /// How far from an owned control point its stencils reach, until the next update().
  double ghost_cutoff() const;
  /// Unwrapped coordinates of all vertices at the last update(), [vertices][3]: each connected
  /// component in one piece.
  const std::vector<double> &unwrapped() const { return pieces.points(); }
  /// The same with faces and the present box; the corner of the box is not the origin.
  Membrane_NS::TriangleMesh triangle_mesh() const;

  /// What lipids are on faces, if some style keeps count of them.
  MeshLipids &lipids() { return lipids_here; }

  // === This rank's part: the faces whose first corner it owns

  /// Collective; call before using what follows in a time step; cheap unless LAMMPS has reneighboured
  /// since.
  void refresh();
  /// Counts reneighbourings that changed the order of atoms here: local indices are valid as long as this stays the same.
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
  bool is_arranged_as_before();

  bigint update_count = 0;
  MeshUnwrapped pieces;
  MeshLipids lipids_here;

  bool stale = true;
  bigint seen_ncalls = -1, seen_lastcall = -1, local_epoch = 0;
  int seen_nlocal = -1, seen_nghost = -1;
  double near2 = 0.0;    // of differences that are surely of nearest images
  struct Seen {
    tagint tag;
    int type, mask;
    double x[3];
  };
  std::vector<Seen> seen;    // atoms at the last reneighbouring
  std::vector<int> faces_here;
  std::vector<OwnedPoint> points_here;
};

/// What an atom style that has a mesh provides.
class MeshOwner {
 public:
  virtual ~MeshOwner() noexcept(false) = default;
  virtual const std::shared_ptr<DistributedMesh> &mesh() = 0;
  /// By owned atom: see MeshOrigins, which alone reads and writes them.
  virtual bigint *origins() = 0;
};

}    // namespace LAMMPS_NS

#endif
