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

#include "mesh_copies.h"

#include "comm.h"
#include "error.h"
#include "mesh_gather.h"

#include <algorithm>
#include <unordered_map>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   each rank asks the owners for what it wants
------------------------------------------------------------------------- */

VertexCopies::VertexCopies(LAMMPS *lmp, const std::vector<int> &owned, std::vector<int> wanted) :
    Pointers(lmp), num_owned(static_cast<int>(owned.size())), values(nullptr), width(0),
    stride(0)
{
  const int nprocs = comm->nprocs;
  if (nprocs == 1) return;
  const std::vector<int> owner = find_owners(owned, wanted);
  std::vector<std::vector<int>> ask(nprocs);
  for (size_t i = 0; i < wanted.size(); ++i) ask[owner[i]].push_back(wanted[i]);
  for (auto &list : ask) std::sort(list.begin(), list.end());
  const auto asked = exchange_lists(ask, world);

  std::unordered_map<int, int> number;
  for (int i = 0; i < num_owned; ++i) number.emplace(owned[i], i);
  for (int p = 0; p < nprocs; ++p) {
    if (ask[p].empty() && asked[p].empty()) continue;
    Partner partner;
    partner.rank = p;
    partner.first = static_cast<int>(copies.size());
    partner.count = static_cast<int>(ask[p].size());
    for (int v : asked[p]) partner.send.push_back(number.at(v));
    copies.insert(copies.end(), ask[p].begin(), ask[p].end());
    partners.push_back(std::move(partner));
  }
  requests.resize(2 * partners.size());
  statuses.resize(2 * partners.size());
}

/* ----------------------------------------------------------------------
   who owns what is known in parts: of vertex v, to rank v modulo their number
------------------------------------------------------------------------- */

std::vector<int> VertexCopies::find_owners(const std::vector<int> &owned,
                                           const std::vector<int> &wanted) const
{
  const int nprocs = comm->nprocs;
  std::vector<std::vector<int>> tell(nprocs), ask(nprocs), answer(nprocs);
  for (int v : owned) tell[v % nprocs].push_back(v);
  for (int v : wanted) ask[v % nprocs].push_back(v);
  const auto told = exchange_lists(tell, world), asked = exchange_lists(ask, world);
  std::unordered_map<int, int> owner;
  for (int p = 0; p < nprocs; ++p)
    for (int v : told[p]) owner.emplace(v, p);
  for (int p = 0; p < nprocs; ++p)
    for (int v : asked[p]) {
      const auto found = owner.find(v);
      answer[p].push_back(found == owner.end() ? -1 : found->second);
    }
  const auto answers = exchange_lists(answer, world);

  std::vector<int> result, next(nprocs, 0);
  for (int v : wanted) {
    const int p = v % nprocs;
    result.push_back(answers[p][next[p]++]);
    if (result.back() < 0) error->one(FLERR, "A control point is lost: no rank owns it");
  }
  return result;
}

/* ---------------------------------------------------------------------- */

void VertexCopies::begin(const double *owned, double *to, int w, int of)
{
  values = to;
  width = w;
  stride = of;
  int n = 0;
  for (Partner &p : partners) {
    p.in.resize(width * p.count);
    MPI_Irecv(p.in.data(), width * p.count, MPI_DOUBLE, p.rank, 0, world, &requests[n++]);
  }
  for (Partner &p : partners) {
    p.out.resize(width * p.send.size());
    double *out = p.out.data();
    for (int i : p.send) out = std::copy_n(owned + (size_t) stride * i, width, out);
    MPI_Isend(p.out.data(), static_cast<int>(p.out.size()), MPI_DOUBLE, p.rank, 0, world,
              &requests[n++]);
  }
}

void VertexCopies::end()
{
  if (requests.empty()) return;
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), statuses.data());
  for (const Partner &p : partners)
    for (int i = 0; i < p.count; ++i)
      std::copy_n(&p.in[(size_t) width * i], width, values + (size_t) stride * (p.first + i));
}

/* ----------------------------------------------------------------------
   owners know who has asked them, and tell it those
------------------------------------------------------------------------- */

VertexCopies::Lists VertexCopies::sharers() const
{
  std::vector<std::vector<int>> have(num_owned);
  for (const Partner &p : partners)
    for (int i : p.send) have[i].push_back(p.rank);
  Lists lists;
  for (const auto &ranks : have) lists.add(ranks);
  if (comm->nprocs == 1) return lists;

  std::vector<std::vector<int>> tell(comm->nprocs);
  for (const Partner &p : partners)
    for (int i : p.send) {
      tell[p.rank].push_back(static_cast<int>(have[i].size()));
      for (int rank : have[i]) tell[p.rank].push_back(rank == p.rank ? comm->me : rank);
    }
  const auto told = exchange_lists(tell, world);
  for (const Partner &p : partners) {
    const int *at = told[p.rank].data();
    for (int i = 0; i < p.count; ++i) {
      const int n = *at++;
      lists.add({at, at + n});
      at += n;
    }
  }
  return lists;
}

void VertexCopies::Lists::add(const std::vector<int> &list)
{
  items.insert(items.end(), list.begin(), list.end());
  start.push_back(static_cast<int>(items.size()));
}

double VertexCopies::memory_usage() const
{
  double bytes = sizeof(int) * copies.capacity();
  for (const Partner &p : partners)
    bytes += sizeof(int) * p.send.capacity() + sizeof(double) * (p.out.capacity() + p.in.capacity());
  return bytes;
}
