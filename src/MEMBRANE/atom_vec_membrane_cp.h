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

#ifdef ATOM_CLASS
// clang-format off
AtomStyle(membrane_cp,AtomVecMembraneCP);
// clang-format on
#else

#ifndef LMP_ATOM_VEC_MEMBRANE_CP_H
#define LMP_ATOM_VEC_MEMBRANE_CP_H

#include "atom_vec_angle.h"
#include "mesh_distributed.h"

namespace LAMMPS_NS {

/// Control points of membranes, with per-atom mass, and plain atoms beside them; angles are faces.
class AtomVecMembraneCP : public AtomVecAngle, public MeshOwner {
 public:
  AtomVecMembraneCP(class LAMMPS *);

  void process_args(int, char **) override;
  void init() override;
  void grow_pointers() override;
  void create_atom_post(int) override;
  void data_atom_post(int) override;
  const std::shared_ptr<DistributedMesh> &mesh() override { return surface; }
  bigint *origins() override { return origin; }

 private:
  double *rmass;
  bigint *&origin;
  std::shared_ptr<DistributedMesh> surface;
};

}    // namespace LAMMPS_NS

#endif
#endif
