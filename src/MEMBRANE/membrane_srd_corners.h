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

#ifndef LMP_MEMBRANE_SRD_CORNERS_H
#define LMP_MEMBRANE_SRD_CORNERS_H

#include "membrane_topology.h"

#include <Eigen/Core>

#include <array>
#include <utility>
#include <vector>

namespace Membrane_NS {

/** The corners of a finer triangulation of the limit surface, as means of the limit positions of
    the vertices, which are the point masses of the surface.

    Faces are cut into n x n triangles with corners near the limit surface, numbered as in
    tessellate(): the vertices come first, and are on it. There r_c = W q with the weights W of
    LimitBasis, and r = L q with the limit mask L. L^-1 takes masses from far away, so in its place
    stands P = 1 + E + ... + E^d, E = 1 - L, which differs from it for short waves only, and what it
    does not give back at the vertices, 1 - L P = E^(d+1), is added, interpolated linearly:

      r_c = G r,   G = W P + B E^(d+1),   B = barycentric coordinates in the face.

    E is of the order of the curvature, and W - B of W E, so corners are off by the order of
    h^4 for an edge h. Rows of G sum to 1. Depends on the topology alone, and on which edges pass
    through the boundary of a periodic box. */
class SurfaceCorners {
 public:
  using Entry = std::pair<int, double>;
  struct Row {
    const Entry *first, *last;
    const Entry *begin() const { return first; }
    const Entry *end() const { return last; }
  };

  /// For each vertex v and each of ring(v): the box vectors from the place of that to its image
  /// next to v.
  using Seams = std::vector<std::vector<std::array<int, 3>>>;

  /// Without seams if no face passes through the boundary of the box.
  SurfaceCorners(const Topology &topology, int n, const Seams &seams = {});
  /** A part of them with numbers of its own: these masses, and after them these corners, both in
      ascending order and none of the former among the latter. All masses of the corners must be
      among these. Has no triangles. */
  SurfaceCorners(const SurfaceCorners &whole, const std::vector<int> &masses,
                 const std::vector<int> &corners);
  /// Another corner of the whole for such a part, for masses_of() alone, and with those masses only
  /// that it has; returns its number.
  int add(const SurfaceCorners &whole, const std::vector<int> &masses, int corner);

  int count() const { return static_cast<int>(start_.size()) - 1; }
  int num_masses() const { return num_masses_; }
  /// The masses that a corner depends on, and G.
  Row masses_of(int corner) const { return row(entries_, start_, corner); }
  /// The corners that depend on a mass, and G.
  Row corners_of(int mass) const { return row(dependents_, dependents_start_, mass); }

  /** In box vectors, from the mean of the masses to the corner, if masses are where their vertices
      are, and the corner is next to the place of the first vertex of the first face that has it. */
  const Eigen::Vector3d &shift(int corner) const { return shifts_[corner]; }

  /// The triangles, n^2 for each face of the mesh in turn.
  const std::vector<Face> &triangles() const { return triangles_; }
  double memory_usage() const;

 private:
  int num_masses_;
  std::vector<Face> triangles_;
  std::vector<Entry> entries_, dependents_;
  std::vector<size_t> start_, dependents_start_;
  std::vector<Eigen::Vector3d> shifts_;

  void find_dependents();
  static Row row(const std::vector<Entry> &entries, const std::vector<size_t> &start, int i)
  {
    return {entries.data() + start[i], entries.data() + start[i + 1]};
  }
};

}    // namespace Membrane_NS

#endif
