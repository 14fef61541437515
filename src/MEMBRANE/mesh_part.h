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

#ifndef LMP_MESH_PART_H
#define LMP_MESH_PART_H

#include "membrane_vertex_part.h"
#include "mesh_copies.h"

#include <memory>
#include <vector>

namespace LAMMPS_NS {

/** The control points of this rank and a halo of neighbours, numbered compactly, with their own
    communication: solvers exchange a few numbers per vertex and pass, far less than LAMMPS'
    exchange of all ghost atoms. */
class MeshPart : public Membrane_NS::VertexPart, protected Pointers {
 public:
  /// Collective. Of the control points in a group, which must be all points of its membranes; the
  /// halo reaches `rings` edges beyond the owned ones. Here and below the mesh is up to date.
  MeshPart(class LAMMPS *, const class DistributedMesh &, int groupbit, int rings);

  /** Collective; call when LAMMPS has reneighboured. Whether each rank still owns its vertices,
      so that all numbers but those of atoms stay; if not, make a new part. */
  bool find_atoms_again(const class DistributedMesh &);

  /// The owned atom of an owned vertex.
  int atom_of(int i) const { return atoms[i]; }

  void begin_halo(Membrane_NS::VertexField &) override;
  void end_halo(Membrane_NS::VertexField &) override;
  void sum(double *, int) override;
  void gather(const Membrane_NS::VertexField &, Membrane_NS::VertexField &) override;

  // === Owned atoms' arrays to fields and back

  void load(const double *const *peratom, Membrane_NS::VertexField &field) const;
  void store(const Membrane_NS::VertexField &field, double **peratom) const;

 private:
  int groupbit;
  std::vector<int> atoms;
  std::unique_ptr<VertexCopies> halo;    // on several ranks

  bool find_atoms(const class DistributedMesh &);
  void find_halo(const class DistributedMesh &, int rings);
};

}    // namespace LAMMPS_NS

#endif
