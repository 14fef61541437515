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

// halo vertices are sorted by the rank that owns them

void MeshPart::find_halo(const DistributedMesh &mesh, int rings)
{
  const auto &topology = mesh.topology();
  std::vector<char> reached(topology.num_vertices(), 0);
  for (int v : vertices) reached[v] = 1;
  std::vector<int> front(vertices), around;
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<int> beyond;
    for (int v : front)
      for (int w : topology.ring(v))
        if (!reached[w]) {
          reached[w] = 1;
          beyond.push_back(w);
        }
    around.insert(around.end(), beyond.begin(), beyond.end());
    front.swap(beyond);
  }
  halo = std::make_unique<VertexCopies>(lmp, vertices, std::move(around));
  vertices.insert(vertices.end(), halo->vertices().begin(), halo->vertices().end());
}

void MeshPart::begin_halo(VertexField &field)
{
  auto *values = reinterpret_cast<double *>(field.data());
  if (halo) halo->begin(values, values + 4 * (size_t) owned, 4, 4);
}

void MeshPart::end_halo(VertexField &)
{
  if (halo) halo->end();
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
