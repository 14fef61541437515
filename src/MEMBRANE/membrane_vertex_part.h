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

#ifndef LMP_MEMBRANE_VERTEX_PART_H
#define LMP_MEMBRANE_VERTEX_PART_H

#include "membrane_topology.h"
#include "membrane_vertex_field.h"

#include <unordered_map>
#include <vector>

namespace Membrane_NS {

/** The vertices of one rank, numbered compactly: first those it owns, then copies of neighbours
    that other ranks own, its halo. On one rank there is no halo. */
class VertexPart {
 public:
  virtual ~VertexPart() noexcept(false) = default;

  // === Numbers

  /// For each local number the vertex of the topology; the first `owned` are this rank's.
  std::vector<int> vertices;
  int owned = 0;
  int size() const { return static_cast<int>(vertices.size()); }
  /// The local number of each vertex of the part.
  std::unordered_map<int, int> local_numbers() const;

  /** Where the layers of owned vertices start, and the end of the last: the neighbours of a vertex
      are in its own layer, the one before or the one after. If there is a halo, the first layer
      holds all vertices next to it. */
  std::vector<int> layers;
  /// Number the owned vertices by layers, in an order that depends on which they are alone.
  void order(const Topology &topology);

  // === What ranks exchange

  /// Collective: copy the four numbers of owned vertices to where they are halo.
  void fill_halo(VertexField &field)
  {
    begin_halo(field);
    end_halo(field);
  }
  /// The same in two halves; between them neither owned nor halo values may change.
  virtual void begin_halo(VertexField &) {}
  virtual void end_halo(VertexField &) {}
  /// Collective: the sum over all ranks.
  virtual void sum(double *, int) {}
  /// Collective: a field on all vertices of the topology, from the owned parts of all ranks.
  virtual void gather(const VertexField &owned_values, VertexField &all);
};

}    // namespace Membrane_NS

#endif
