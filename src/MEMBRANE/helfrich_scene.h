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

#ifndef LMP_HELFRICH_SCENE_H
#define LMP_HELFRICH_SCENE_H

#include "membrane_helfrich.h"
#include "mesh_local.h"
#include "mesh_origins.h"
#include "mesh_totals.h"

#include <vector>

namespace LAMMPS_NS {

/// Derivatives of an energy by totals of a membrane: what it does to its faces.
struct Conjugates {
  double tension = 0.0;     ///< dE/dA
  double pressure = 0.0;    ///< dE/dV
  double moment = 0.0;      ///< dE/dM, M the integral of 2H
};

/** What the terms of the energy read and write: the membranes, this rank's faces, and their
    integrals and energies in a step. HelfrichModel owns it and keeps it up to date. */
struct HelfrichScene {
  explicit HelfrichScene(class LAMMPS *lmp) :
      mesh(lmp, "Pair style helfrich"), totals(lmp, mesh), origins(lmp)
  {
  }

  LocalMesh mesh;
  MeshTotals totals;
  MeshOrigins origins;    ///< up to date if a term keeps references

  // === Membranes, in the order of DistributedMesh::molecules(); the same on all ranks

  std::vector<std::vector<int>> types;    ///< of control points each membrane has, increasing
  std::vector<char> excluded;             ///< by neigh_modify exclude; no term acts on these
  std::vector<Conjugates> conjugates;     ///< of the terms of totals, in this step

  // === Faces of this rank

  Membrane_NS::FaceGroups groups;
  Membrane_NS::FaceModel model;
  Membrane_NS::FaceIntegrals integrals;    ///< of the first pass, if there is one
  Membrane_NS::FaceEnergies energies;      ///< of the second

  int nslots() const { return count_slots(groups); }
  int membrane(const Membrane_NS::FaceGroup &group, int s) const
  {
    return mesh->membrane(totals.component_of(group, s));
  }
};

}    // namespace LAMMPS_NS

#endif
