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

#ifndef LMP_MEMBRANE_SURFACE_CORNERS_H
#define LMP_MEMBRANE_SURFACE_CORNERS_H

#include "membrane_topology.h"

#include <utility>
#include <vector>

namespace Membrane_NS {

/** The corners of a finer triangulation of the limit surface, as means of the limit positions of the
    vertices, which are the point masses of the surface.

    Faces are cut into n x n triangles with corners on the limit surface, numbered as in tessellate():
    the vertices come first. A corner is r_c = sum_i W_ci q_i with the weights of LimitBasis, and q =
    L^-1 r with the limit mask L, so r_c = sum_a G_ca r_a, G = W L^-1. Rows of G sum to 1 and fall
    off exponentially; they are cut off where 1e-8 of them is left, so the corners are off the limit
    surface by as much of an edge. Depends on the topology alone; box vectors that lie between the masses
    and the corner in a periodic box are the user's matter. */
class SurfaceCorners {
 public:
  using Entry = std::pair<int, double>;
  struct Row {
    const Entry *first, *last;
    const Entry *begin() const { return first; }
    const Entry *end() const { return last; }
  };

  SurfaceCorners(const Topology &topology, int n);

  int count() const { return static_cast<int>(start_.size()) - 1; }
  int num_masses() const { return num_masses_; }
  /// The masses that a corner depends on, and G.
  Row masses_of(int corner) const { return row(entries_, start_, corner); }
  /// The corners that depend on a mass, and G.
  Row corners_of(int mass) const { return row(dependents_, dependents_start_, mass); }

  /// The triangles, n^2 for each face of the mesh in turn.
  const std::vector<Face> &triangles() const { return triangles_; }
  double memory_usage() const;

 private:
  int num_masses_;
  std::vector<Face> triangles_;
  std::vector<Entry> entries_, dependents_;
  std::vector<int> start_, dependents_start_;

  static Row row(const std::vector<Entry> &entries, const std::vector<int> &start, int i)
  {
    return {entries.data() + start[i], entries.data() + start[i + 1]};
  }
};

}    // namespace Membrane_NS

#endif
