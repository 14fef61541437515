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

#include "membrane_mass.h"
#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {

/** The control points of this rank and a halo of neighbours, numbered compactly, with their own
    communication: solvers exchange a few numbers per vertex and pass, far less than LAMMPS'
    exchange of all ghost atoms. */
class MeshPart : public Membrane_NS::VertexPart, protected Pointers {
 public:
  /// Collective. Of the control points in a group, which must be whole membranes; the halo reaches
  /// `rings` edges beyond the owned ones.
  MeshPart(class LAMMPS *, class DistributedMesh &, int groupbit, int rings);

  /** Collective; call when LAMMPS has reneighboured. Whether each rank still owns the same vertices,
      and so all numbers but those of atoms stay; if not, this part is of no more use. */
  bool follow(class DistributedMesh &);

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
  struct Partner {
    int rank;
    std::vector<int> send;         // owned vertices that are in the partner's halo
    int first, count;              // where its vertices are in the halo
    std::vector<Membrane_NS::Vector4> buffer;
  };
  int groupbit;
  std::vector<int> atoms;
  std::vector<Partner> partners;
  std::vector<MPI_Request> requests;
  std::vector<MPI_Status> statuses;    // LAMMPS' stand-in for MPI cannot ignore them

  bool find_atoms(class DistributedMesh &);
  void find_halo(class DistributedMesh &, int rings);
};

}    // namespace LAMMPS_NS

#endif
