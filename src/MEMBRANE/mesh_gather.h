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

#ifndef LMP_MESH_GATHER_H
#define LMP_MESH_GATHER_H

#include <mpi.h>

#include <numeric>
#include <vector>

namespace LAMMPS_NS {

/// Collective: the vectors of all ranks, in rank order, on all ranks. T is plain data.
template <typename T> std::vector<T> gather_all(const std::vector<T> &mine, MPI_Comm world)
{
  int nprocs;
  MPI_Comm_size(world, &nprocs);
  int bytes = static_cast<int>(mine.size() * sizeof(T));    // LAMMPS' stand-in for MPI wants it writable
  std::vector<int> counts(nprocs), starts(nprocs, 0);
  MPI_Allgather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  std::partial_sum(counts.begin(), counts.end() - 1, starts.begin() + 1);
  std::vector<T> all((starts.back() + counts.back()) / sizeof(T));
  MPI_Allgatherv(const_cast<T *>(mine.data()), bytes, MPI_BYTE, all.data(), counts.data(),
                 starts.data(), MPI_BYTE, world);
  return all;
}

/// Collective: each rank has a list for each other one, by rank; returns those for this one. Few
/// ranks may have something for each other.
template <typename T>
std::vector<std::vector<T>> exchange_lists(const std::vector<std::vector<T>> &to, MPI_Comm world)
{
  const int nprocs = static_cast<int>(to.size());
  if (nprocs == 1) return to;
  std::vector<int> sent(nprocs), received(nprocs), sent_start(nprocs + 1, 0),
      received_start(nprocs + 1, 0);
  for (int p = 0; p < nprocs; ++p) sent[p] = static_cast<int>(to[p].size() * sizeof(T));
  MPI_Alltoall(sent.data(), 1, MPI_INT, received.data(), 1, MPI_INT, world);
  std::partial_sum(sent.begin(), sent.end(), sent_start.begin() + 1);
  std::partial_sum(received.begin(), received.end(), received_start.begin() + 1);
  std::vector<T> out, in(received_start[nprocs] / sizeof(T));
  for (const auto &list : to) out.insert(out.end(), list.begin(), list.end());
  MPI_Alltoallv(out.data(), sent.data(), sent_start.data(), MPI_BYTE, in.data(), received.data(),
                received_start.data(), MPI_BYTE, world);
  std::vector<std::vector<T>> from;
  for (int p = 0; p < nprocs; ++p)
    from.emplace_back(in.begin() + received_start[p] / sizeof(T),
                      in.begin() + received_start[p + 1] / sizeof(T));
  return from;
}

}    // namespace LAMMPS_NS

#endif
