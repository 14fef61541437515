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

#ifndef LMP_MESH_GROUP_H
#define LMP_MESH_GROUP_H

#include "mesh_local.h"
#include "mesh_part.h"

#include <memory>
#include <string>

namespace LAMMPS_NS {

/// Collective: whether any atom is in both groups, which are given by their bits.
bool groups_meet(class LAMMPS *, int groupbit, int other);

/** The control points of a LAMMPS group of membranes: checked in init(), shared among ranks as a
    MeshPart, and followed when LAMMPS moves atoms between ranks or replaces them. */
class MeshGroup : protected Pointers {
 public:
  /// `user` is named in errors. Stops if the atom style has no mesh.
  MeshGroup(class LAMMPS *, int igroup, std::string user);

  /// Collective; call from init(). The group must hold all control points of its membranes and,
  /// unless other_atoms, nothing else.
  void init(bool other_atoms = false);
  /** Collective; call in each step before part() is used. True if the part is a new one, and all
      that depends on its numbers is to be made anew: after init(), and when vertices have new
      owners. Its halo reaches `rings` edges. */
  bool follow(int rings);

  DistributedMesh &mesh() const { return *surface; }
  MeshPart &part() { return *vertices; }
  /// Counts the parts made so far.
  bigint numbering() const { return nparts; }
  /// Control points of the group, on all ranks.
  bigint count() const { return npoints; }
  /// Whether sparse factors of a matrix over them solve faster than passes over the mesh do.
  bool suit_factors() const;

 private:
  int igroup, groupbit;
  std::string user;
  LocalMesh surface;
  std::unique_ptr<MeshPart> vertices;
  bool outdated;    // vertices, since init()
  bigint nparts, npoints;

  void check_group(bool other_atoms);
};

}    // namespace LAMMPS_NS

#endif
