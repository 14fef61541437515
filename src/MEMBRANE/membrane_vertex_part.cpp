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

#include "membrane_vertex_part.h"

#include <algorithm>

using namespace Membrane_NS;

/* ---------------------------------------------------------------------- */

std::unordered_map<int, int> VertexPart::local_numbers() const
{
  std::unordered_map<int, int> local;
  local.reserve(2 * size());
  for (int i = 0; i < size(); ++i) local.emplace(vertices[i], i);
  return local;
}

void VertexPart::gather(const VertexField &owned_values, VertexField &all)
{
  for (int i = 0; i < owned; ++i) all[vertices[i]] = owned_values[i];
}

/* ----------------------------------------------------------------------
   breadth first from the vertices next to the halo; without a halo, and for what cannot be reached
   from it, from the lowest vertex left
------------------------------------------------------------------------- */

void VertexPart::order(const Topology &topology)
{
  std::vector<char> waiting(topology.num_vertices(), 0);
  std::vector<int> lowest(vertices.begin(), vertices.begin() + owned), sorted;
  std::sort(lowest.begin(), lowest.end());
  for (int v : lowest) waiting[v] = 1;
  auto visit = [&](int v) {
    if (!waiting[v]) return;
    waiting[v] = 0;
    sorted.push_back(v);
  };

  const std::vector<char> mine(waiting);
  layers.assign(1, 0);
  for (int v : lowest)
    for (int w : topology.ring(v))
      if (!mine[w]) visit(v);
  auto seed = lowest.begin();
  while ((int) sorted.size() < owned || layers.back() < owned) {
    if (layers.back() == (int) sorted.size()) {
      while (!waiting[*seed]) ++seed;
      visit(*seed);
    }
    const int first = layers.back(), last = static_cast<int>(sorted.size());
    layers.push_back(last);
    for (int i = first; i < last; ++i)
      for (int w : topology.ring(sorted[i])) visit(w);
  }
  std::copy(sorted.begin(), sorted.end(), vertices.begin());
}
