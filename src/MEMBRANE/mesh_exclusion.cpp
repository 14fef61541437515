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

#include "mesh_exclusion.h"

#include "atom.h"
#include "error.h"
#include "group.h"
#include "mesh_distributed.h"
#include "neighbor.h"

#include <algorithm>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

bool MeshExclusion::holds(int mask, int e) const
{
  return mask & group->bitmask[neighbor->ex1_group[e]] &&
      mask & group->bitmask[neighbor->ex2_group[e]];
}

std::vector<char> MeshExclusion::find_membranes(const DistributedMesh &mesh,
                                                const std::vector<char> &has_totals) const
{
  const int nmembranes = static_cast<int>(has_totals.size());
  std::vector<char> excluded(nmembranes, 0);
  std::vector<bigint> size(nmembranes, 0), mine(nmembranes), inside(nmembranes);
  for (int c = 0; c < mesh.topology().num_components(); ++c)
    size[mesh.membrane(c)] += mesh.topology().num_vertices(c);
  for (int e = 0; e < neighbor->nex_group; ++e) {
    std::fill(mine.begin(), mine.end(), 0);
    for (int i = 0; i < atom->nlocal; ++i) {
      const int v = mesh.vertex(atom->tag[i]);
      if (v >= 0 && holds(atom->mask[i], e)) ++mine[mesh.membrane(mesh.topology().component(v))];
    }
    MPI_Allreduce(mine.data(), inside.data(), nmembranes, MPI_LMP_BIGINT, MPI_SUM, world);
    for (int m = 0; m < nmembranes; ++m) {
      if (inside[m] == size[m]) excluded[m] = 1;
      if (inside[m] && inside[m] < size[m] && has_totals[m])
        error->all(FLERR,
                   "neigh_modify exclude group has {} of the {} control points of membrane {}, whose "
                   "area or volume terms need all of it: exclude the whole membrane or nothing",
                   inside[m], size[m], mesh.molecules()[m]);
    }
  }
  return excluded;
}

/* ---------------------------------------------------------------------- */

bool MeshExclusion::excludes(const DistributedMesh &mesh, int face, std::vector<int> &stencil) const
{
  mesh.topology().stencil(face, stencil);
  int common = ~0;
  for (int v : stencil) {
    const int i = atom->map(mesh.tag(v));
    if (i < 0) return false;    // local_groups() reports it
    common &= atom->mask[i];
  }
  for (int e = 0; e < neighbor->nex_group; ++e)
    if (holds(common, e)) return true;
  return false;
}

std::vector<int> MeshExclusion::remaining_faces(const DistributedMesh &mesh) const
{
  std::vector<int> faces(mesh.owned_faces()), stencil;
  if (neighbor->nex_group)
    faces.erase(std::remove_if(faces.begin(), faces.end(),
                               [&](int f) { return excludes(mesh, f, stencil); }),
                faces.end());
  return faces;
}
