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

#include "mesh_origins.h"

#include "atom.h"
#include "atom_vec.h"

#include <algorithm>
#include <numeric>
#include <tuple>

using namespace LAMMPS_NS;

void MeshOrigins::give(const DistributedMesh &mesh)
{
  bigint *origin = dynamic_cast<MeshOwner *>(atom->style_match("membrane_cp"))->origins();
  std::vector<bigint> mine(mesh.topology().num_vertices(), 0);
  for (int i = 0; i < atom->nlocal; ++i) {
    const int v = mesh.vertex(atom->tag[i]);
    if (v >= 0) mine[v] = origin[i];
  }
  found.resize(mine.size());
  MPI_Allreduce(mine.data(), found.data(), static_cast<int>(mine.size()), MPI_LMP_BIGINT, MPI_MAX, world);

  for (bigint number : found) last = std::max(last, number);
  std::vector<int> order(found.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return std::tie(found[a], a) < std::tie(found[b], b); });
  given = found;
  bigint previous = 0;
  for (int v : order) {
    if (found[v] == previous) given[v] = ++last;
    previous = found[v];
  }

  for (int i = 0; i < atom->nlocal; ++i) {
    const int v = mesh.vertex(atom->tag[i]);
    if (v >= 0) origin[i] = given[v];
  }
  sorted = given;
  std::sort(sorted.begin(), sorted.end());
}

bool MeshOrigins::exists(bigint origin) const
{
  return std::binary_search(sorted.begin(), sorted.end(), origin);
}
