/* -----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing author: MEMBRANE developers
------------------------------------------------------------------------- */

#include "mesh_local.h"

#include "error.h"

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

LocalMesh::LocalMesh(LAMMPS *lmp, std::string user) :
    Pointers(lmp), user(std::move(user)), generation(0), epoch(-1), inits(0)
{
}

void LocalMesh::require() const
{
  DistributedMesh::of(lmp, user);
}

MeshChange LocalMesh::init()
{
  const auto before = mesh;
  mesh = DistributedMesh::shared(lmp, user);
  mesh->update();
  const bool same = mesh == before && generation == mesh->generation();
  generation = mesh->generation();
  epoch = -1;
  ++inits;
  return same ? MeshChange::NUMBERS : MeshChange::TOPOLOGY;
}

MeshChange LocalMesh::follow()
{
  if (mesh != DistributedMesh::shared(lmp, user) || mesh->generation() == 0)
    error->all(FLERR, "{}: atoms were replaced since the last run: use run 0", user);
  mesh->refresh();
  if (generation == mesh->generation() && epoch == mesh->epoch()) return MeshChange::NOTHING;
  const bool same = generation == mesh->generation();
  generation = mesh->generation();
  epoch = mesh->epoch();
  return same ? MeshChange::NUMBERS : MeshChange::TOPOLOGY;
}
