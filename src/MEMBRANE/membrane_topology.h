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

#ifndef LMP_MEMBRANE_TOPOLOGY_H
#define LMP_MEMBRANE_TOPOLOGY_H

#include <array>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace Membrane_NS {

/// A mesh that cannot carry a limit surface; what() names the element and the cure.
class MeshError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Three corner vertices, counter-clockwise seen from outside.
using Face = std::array<int, 3>;

/// The valences of the three corners of a face.
using Valences = std::array<int, 3>;

/// What works in arrays of fixed size has room for this valence, and says so of larger ones.
constexpr int MOST_VALENCE = 32;
/// Likewise: the largest number of control points of one face.
constexpr int MOST_STENCIL = 3 * MOST_VALENCE - 6;

/// From this valence on faces around a vertex are so narrow that they take finer quadrature; around vertices of smaller
/// valence a minimiser hides less than 1e-5 of a sphere's energy from the default rule, see ground_relaxation.
constexpr int SQUEEZING_VALENCE = 11;

/// A contiguous run of ints owned by somebody else.
struct IntSpan {
  const int *first, *last;
  const int *begin() const { return first; }
  const int *end() const { return last; }
  int size() const { return static_cast<int>(last - first); }
  int operator[](int i) const { return first[i]; }
};

/** Connectivity of an oriented triangle mesh without boundary; no coordinates.

    Vertices are 0..num_vertices()-1, faces 0..num_faces()-1 in the order given. The mesh may have
    several connected components, each closed or made boundaryless by periodic images. Immutable.

    The constructor checks that every edge joins exactly two faces that run through it in opposite
    directions, that the faces around each vertex form one fan, that every vertex is used and has a
    valence of at least 3, and that no two faces share all three corners, as MeshError otherwise. */
class Topology {
 public:
  /// How messages name a vertex or a face; by default by index.
  struct Labels {
    std::function<std::string(int)> vertex, face;
  };

  Topology() = default;
  Topology(int num_vertices, std::vector<Face> faces);
  Topology(int num_vertices, std::vector<Face> faces, const Labels &labels);

  // === Counts

  int num_vertices() const { return static_cast<int>(ring_start_.size()) - 1; }
  int num_vertices(int component) const { return component_vertices_[component]; }
  int num_faces() const { return static_cast<int>(faces_.size()); }
  int num_edges() const { return 3 * num_faces() / 2; }

  // === Faces

  const std::vector<Face> &faces() const { return faces_; }
  const Face &face(int f) const { return faces_[f]; }
  /// The face beyond the edge from corner k to corner (k+1)%3 of face f.
  int neighbor(int f, int k) const { return neighbors_[f][k]; }
  /// The vertex of that face that is not on the edge.
  int opposite(int f, int k) const;
  Valences valences(int f) const;
  /// All three corners have valence 6.
  bool is_regular(int f) const;
  /** The face is regular, but has a corner no more than n - 10 edges from a vertex of valence n > 10. On a smooth surface all faces
      around such a vertex are about n/6 times as long as wide, until vertices of small valence make up for it. */
  bool is_squeezed(int f) const;

  // === Vertices

  int valence(int v) const { return ring_start_[v + 1] - ring_start_[v]; }
  /// The neighbours of v, counter-clockwise seen from outside. Length valence(v).
  IntSpan ring(int v) const { return span(ring_, v); }
  /// The faces around v; the i-th has corners v, ring(v)[i], ring(v)[i+1].
  IntSpan faces_around(int v) const { return span(ring_faces_, v); }

  // === Components

  int num_components() const { return static_cast<int>(component_faces_.size()); }
  int component(int v) const { return component_[v]; }
  /// V - E + F: 2 for a sphere, 0 for a torus and for a periodic plane.
  int euler_characteristic(int c) const;

  // === Stencils

  /** The control points that shape face f, in the order that limit-surface weights use:
      the corners 0, 1, 2; then for each corner its ring counter-clockwise from the vertex across
      the edge that ends in the corner, leaving out the last. For three corners of valence 6 these
      are 12 points; in general the sum of the valences less 6, and 4 on a tetrahedron. A vertex
      may occur more than once on a coarse mesh. `first` turns the face: that corner comes first. */
  void stencil(int f, std::vector<int> &points, int first = 0) const;

  /** Calls place(column, anchor) for columns 1, 2, ... of a stencil: an edge joins the point in that
      column to the one in column `anchor`, a corner, which is 0 or was placed before. So what is
      known along edges, as periodic images are, becomes known of the stencil. */
  template <class Place> void along_stencil(const std::vector<int> &points, Place &&place) const;

  /// Bytes held.
  double memory_usage() const;

 private:
  std::vector<Face> faces_;
  std::vector<std::array<int, 3>> neighbors_;
  std::vector<int> ring_start_{0}, ring_, ring_faces_;
  std::vector<int> component_, component_faces_, component_vertices_;
  std::vector<int> squeezes_;    // by vertex: of faces there if positive; empty if there are none

  IntSpan span(const std::vector<int> &data, int v) const
  {
    return {data.data() + ring_start_[v], data.data() + ring_start_[v + 1]};
  }
  void match_edges(int num_vertices, const Labels &labels);
  void walk_fans(int num_vertices, const Labels &labels);
  void find_components();
  void find_squeezed();
};

/* ---------------------------------------------------------------------- */

template <class Place>
void Topology::along_stencil(const std::vector<int> &points, Place &&place) const
{
  const int size = static_cast<int>(points.size());
  place(1, 0);
  place(2, 0);
  int column = 3;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < valence(points[k]) - 3; ++i) place(column++, k);
  if (column < size) place(column, 0);    // tetrahedron
}

/// The corner of a face at which vertex v sits, or -1.
inline int corner_of(const Face &face, int v)
{
  for (int k = 0; k < 3; ++k)
    if (face[k] == v) return k;
  return -1;
}

}    // namespace Membrane_NS

#endif
