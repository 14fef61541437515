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

#include "mesh_part.h"

#include "atom.h"
#include "comm.h"
#include "mesh_distributed.h"

#include <algorithm>

using namespace LAMMPS_NS;
using Membrane_NS::Vector4;
using Membrane_NS::VertexField;

/* ---------------------------------------------------------------------- */

MeshPart::MeshPart(LAMMPS *lmp, const DistributedMesh &mesh, int groupbit, int rings) :
    Pointers(lmp), groupbit(groupbit)
{
  for (const auto &[i, v] : mesh.owned_points())
    if (atom->mask[i] & groupbit) vertices.push_back(v);
  owned = static_cast<int>(vertices.size());
  order(mesh.topology());
  find_atoms(mesh);
  if (comm->nprocs > 1) find_halo(mesh, rings);
}

bool MeshPart::find_atoms_again(const DistributedMesh &mesh)
{
  int mine = find_atoms(mesh), all;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MIN, world);
  return all;
}

// the atoms of the owned vertices; whether these are all of the group on this rank

bool MeshPart::find_atoms(const DistributedMesh &mesh)
{
  std::vector<int> atom_of_vertex(mesh.topology().num_vertices(), -1);
  int count = 0;
  for (const auto &[i, v] : mesh.owned_points()) {
    if (!(atom->mask[i] & groupbit)) continue;
    atom_of_vertex[v] = i;
    ++count;
  }
  atoms.resize(owned);
  bool found = count == owned;
  for (int i = 0; i < owned; ++i) {
    atoms[i] = atom_of_vertex[vertices[i]];
    found = found && atoms[i] >= 0;
  }
  return found;
}

/* ----------------------------------------------------------------------
   halo vertices sorted by the rank that owns them; each rank asks the owners for what it needs
------------------------------------------------------------------------- */

void MeshPart::find_halo(const DistributedMesh &mesh, int rings)
{
  const auto &topology = mesh.topology();
  const int n = topology.num_vertices(), nprocs = comm->nprocs;

  std::vector<int> mine(n, -1), owner(n);
  for (int i = 0; i < owned; ++i) mine[vertices[i]] = comm->me;
  MPI_Allreduce(mine.data(), owner.data(), n, MPI_INT, MPI_MAX, world);

  std::vector<char> reached(n, 0);
  for (int i = 0; i < owned; ++i) reached[vertices[i]] = 1;
  std::vector<int> front(vertices), halo;
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<int> beyond;
    for (int v : front)
      for (int w : topology.ring(v))
        if (!reached[w]) {
          reached[w] = 1;
          beyond.push_back(w);
        }
    halo.insert(halo.end(), beyond.begin(), beyond.end());
    front.swap(beyond);
  }
  std::sort(halo.begin(), halo.end(), [&owner](int a, int b) {
    return std::pair(owner[a], a) < std::pair(owner[b], b);
  });
  vertices.insert(vertices.end(), halo.begin(), halo.end());

  std::vector<int> wanted(nprocs, 0), asked(nprocs), wanted_start(nprocs + 1, 0),
      asked_start(nprocs + 1, 0);
  for (int v : halo) ++wanted[owner[v]];
  MPI_Alltoall(wanted.data(), 1, MPI_INT, asked.data(), 1, MPI_INT, world);
  for (int p = 0; p < nprocs; ++p) {
    wanted_start[p + 1] = wanted_start[p] + wanted[p];
    asked_start[p + 1] = asked_start[p] + asked[p];
  }
  std::vector<int> requested(asked_start[nprocs]);
  MPI_Alltoallv(halo.data(), wanted.data(), wanted_start.data(), MPI_INT, requested.data(),
                asked.data(), asked_start.data(), MPI_INT, world);

  std::vector<int> local(n, -1);
  for (int i = 0; i < owned; ++i) local[vertices[i]] = i;
  for (int p = 0; p < nprocs; ++p) {
    if (wanted[p] == 0 && asked[p] == 0) continue;
    Partner partner;
    partner.rank = p;
    partner.first = owned + wanted_start[p];
    partner.count = wanted[p];
    for (int i = asked_start[p]; i < asked_start[p + 1]; ++i)
      partner.send.push_back(local[requested[i]]);
    partner.buffer.resize(partner.send.size());
    partners.push_back(std::move(partner));
  }
  requests.resize(2 * partners.size());
  statuses.resize(2 * partners.size());
}

/* ---------------------------------------------------------------------- */

void MeshPart::begin_halo(VertexField &field)
{
  int n = 0;
  for (Partner &p : partners)
    MPI_Irecv(field.data() + p.first, 4 * p.count, MPI_DOUBLE, p.rank, 0, world, &requests[n++]);
  for (Partner &p : partners) {
    for (size_t i = 0; i < p.send.size(); ++i) p.buffer[i] = field[p.send[i]];
    MPI_Isend(p.buffer.data(), 4 * p.send.size(), MPI_DOUBLE, p.rank, 0, world, &requests[n++]);
  }
}

void MeshPart::end_halo(VertexField &)
{
  if (!requests.empty())
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), statuses.data());
}

void MeshPart::sum(double *values, int n)
{
  MPI_Allreduce(MPI_IN_PLACE, values, n, MPI_DOUBLE, MPI_SUM, world);
}

void MeshPart::gather(const VertexField &mine, VertexField &all)
{
  std::fill(all.begin(), all.end(), Vector4{});
  VertexPart::gather(mine, all);
  if (comm->nprocs > 1)
    MPI_Allreduce(MPI_IN_PLACE, all.data(), 4 * all.size(), MPI_DOUBLE, MPI_SUM, world);
}

/* ---------------------------------------------------------------------- */

void MeshPart::load(const double *const *peratom, VertexField &field) const
{
  field.resize(vertices.size());
  for (int i = 0; i < owned; ++i) {
    const double *a = peratom[atoms[i]];
    field[i] = {{a[0], a[1], a[2], 0.0}};
  }
}

void MeshPart::store(const VertexField &field, double **peratom) const
{
  for (int i = 0; i < owned; ++i)
    for (int k = 0; k < 3; ++k) peratom[atoms[i]][k] = field[i].c[k];
}
