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

#ifndef LMP_MESH_FACES_H
#define LMP_MESH_FACES_H

#include "membrane_topology.h"
#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/** Faces are LAMMPS angles: the topology that they make, the same on every rank. Vertices are the atoms
    that are corners of faces, numbered by increasing atom ID; faces are numbered by their corners: the
    numbers do not depend on the decomposition. No coordinates. */
class MeshFaces : protected Pointers {
 public:
  explicit MeshFaces(class LAMMPS *lmp) : Pointers(lmp) {}

  /// Angles of these types are faces; "*" for all.
  void set_face_types(const std::string &types) { face_types = types; }
  /// Collective. Collects the faces anew if any changed since the last call, and checks them.
  void update_faces();
  /// Counts topologies: differs after an update that found changed faces. 0 before the first.
  int generation() const { return version; }

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
  /// How a face is named to the user: by the atom IDs of its corners.
  std::string face_name(int f) const;
  /// Collective: stops if a corner of a face is no atom.
  void report_missing_atoms() const;

 protected:
  Membrane_NS::Topology topo;
  std::vector<tagint> tags;

 private:
  std::string face_types = "*";
  int version = 0;
  bigint fingerprint = 0;    // of all faces
  std::vector<tagint> component_molecule, membranes;
  std::vector<int> component_membrane;

  struct AngleList;
  void collect_angles(AngleList &);
  void rebuild(const AngleList &);
};

}    // namespace LAMMPS_NS

#endif
