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

#ifndef LMP_MESH_COPIES_H
#define LMP_MESH_COPIES_H

#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {

/** Copies that ranks have of vertices which others own, and the way of values from the owners to
    them: messages between the ranks that have something in common, and nobody else. */
class VertexCopies : protected Pointers {
 public:
  /// Collective. The vertices that this rank owns, each of them nobody else's, and those of others
  /// that it wants copies of.
  VertexCopies(class LAMMPS *, const std::vector<int> &owned, std::vector<int> wanted);

  /// The copies, sorted by owner.
  const std::vector<int> &vertices() const { return copies; }

  /// Values, the first `width` of `stride` numbers a vertex, of the owned vertices in the order in
  /// which they were given, to all copies in the order of vertices(). In two halves: between them
  /// neither may change.
  void begin(const double *owned, double *copies, int width, int stride);
  void end();

  /// Lists, one for each vertex.
  struct Lists {
    std::vector<int> start = {0}, items;
    const int *begin(int i) const { return items.data() + start[i]; }
    const int *end(int i) const { return items.data() + start[i + 1]; }
    void add(const std::vector<int> &list);
  };
  /// Collective: of each owned vertex and then of each copy the other ranks that have it.
  Lists sharers() const;

  double memory_usage() const;

 private:
  struct Partner {
    int rank;
    std::vector<int> send;    // owned vertices that it has copies of
    int first, count;         // where its vertices are among the copies here
    std::vector<double> out, in;
  };
  int num_owned;
  double *values;       // of the copies, where they are to come
  int width, stride;    // of these
  std::vector<int> copies;
  std::vector<Partner> partners;
  std::vector<MPI_Request> requests;
  std::vector<MPI_Status> statuses;    // LAMMPS' stand-in for MPI cannot ignore them

  std::vector<int> find_owners(const std::vector<int> &owned, const std::vector<int> &wanted) const;
};

}    // namespace LAMMPS_NS

#endif
