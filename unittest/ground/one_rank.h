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

#ifndef MEMBRANE_TEST_ONE_RANK_H
#define MEMBRANE_TEST_ONE_RANK_H

// Meshes all of whose vertices are on one rank, and fields on them.

#include "membrane_vertex_part.h"

#include <cmath>

namespace Membrane_TEST {

struct OneRank : Membrane_NS::VertexPart {
  explicit OneRank(const Membrane_NS::Topology &topology)
  {
    owned = topology.num_vertices();
    for (int i = 0; i < owned; ++i) vertices.push_back(i);
    order(topology);
  }
};

/// Numbers between -1 and 1 without any pattern.
inline Membrane_NS::VertexField rough(int n)
{
  Membrane_NS::VertexField f(n);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) f[i].c[k] = std::sin(1.7 * i * i + k);
  return f;
}

}    // namespace Membrane_TEST

#endif
