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

}    // namespace LAMMPS_NS

#endif
