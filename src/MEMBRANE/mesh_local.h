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

#ifndef LMP_MESH_LOCAL_H
#define LMP_MESH_LOCAL_H

#include "mesh_distributed.h"

#include <memory>
#include <string>
#include <utility>

namespace LAMMPS_NS {

/** A style's hold on the mesh: it owns one of these, asks it in init() and in each step, and derives
    anew what has changed. Between runs LAMMPS may replace the atom style and with it the mesh
    (replicate, read_restart), delete, add or renumber atoms; within a run atoms move between ranks.

      init():      mesh.init();                    // then what follows from the topology
      each step:   switch (mesh.follow()) {
                     case MeshChange::TOPOLOGY: ...    // the same again
                     case MeshChange::NUMBERS: ...     // what follows from local indices
                     case MeshChange::NOTHING: ;
                   } */
enum class MeshChange {
  NOTHING,
  NUMBERS,    ///< which points and faces this rank owns, local indices of atoms
  TOPOLOGY    ///< faces, membranes, and the numbers
};

class LocalMesh : protected Pointers {
 public:
  /// `user` is named in errors.
  LocalMesh(class LAMMPS *, std::string user);
  /// Stops if the atom style has no mesh: for constructors of styles that are made after it.
  void require() const;

  /** Collective; call from init(). Takes hold of the mesh of the present atom style and brings it up
      to date: TOPOLOGY if it is another than this held, or its faces are, else NUMBERS. The next
      follow() reports NUMBERS at least. */
  MeshChange init();
  /** Collective; call in each step before the mesh is used. What has changed since the last call or
      init(). Stops if atoms were replaced since init(), as a compute asked between runs finds. */
  MeshChange follow();

  /// Differs whenever init() of this, or update() of the mesh by another style, was called.
  std::pair<bigint, bigint> stamp() const { return {inits, mesh->updates()}; }

  DistributedMesh *operator->() const { return mesh.get(); }
  DistributedMesh &operator*() const { return *mesh; }

 private:
  std::string user;
  std::shared_ptr<DistributedMesh> mesh;
  int generation;
  bigint epoch, inits;
};

}    // namespace LAMMPS_NS

#endif
