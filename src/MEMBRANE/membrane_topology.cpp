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

#include "membrane_topology.h"

#include <algorithm>

using namespace Membrane_NS;

namespace {

std::string name(const std::function<std::string(int)> &label, const char *what, int i)
{
  return label ? label(i) : std::string(what) + " " + std::to_string(i);
}

}    // namespace

/* ---------------------------------------------------------------------- */

Topology::Topology(int num_vertices, std::vector<Face> faces) :
    Topology(num_vertices, std::move(faces), Labels())
{
}

Topology::Topology(int num_vertices, std::vector<Face> faces, const Labels &labels) :
    faces_(std::move(faces))
{
  for (int f = 0; f < num_faces(); ++f) {
    const Face &face = faces_[f];
    for (int k = 0; k < 3; ++k) {
      if (face[k] < 0 || face[k] >= num_vertices)
        throw MeshError(name(labels.face, "face", f) + " has a corner " + std::to_string(face[k]) +
                        " that is not one of the " + std::to_string(num_vertices) +
                        " control points");
      if (face[k] == face[(k + 1) % 3])
        throw MeshError(name(labels.face, "face", f) + " uses " +
                        name(labels.vertex, "vertex", face[k]) +
                        " twice; remove this degenerate face");
    }
  }
  match_edges(num_vertices, labels);
  walk_fans(num_vertices, labels);
  find_components();
  find_squeezed();
}

/* ----------------------------------------------------------------------
   pair up the directed edges: edge a->b of one face is edge b->a of its neighbour.
   Directed edges are bucketed by their first vertex, so the cost is linear in the faces.
------------------------------------------------------------------------- */

void Topology::match_edges(int num_vertices, const Labels &labels)
{
  std::vector<int> &start = ring_start_;
  start.assign(num_vertices + 1, 0);
  for (const Face &face : faces_)
    for (int v : face) ++start[v + 1];
  for (int v = 0; v < num_vertices; ++v) start[v + 1] += start[v];

  // outgoing half-edges of each vertex, as 3*face + corner

  std::vector<int> outgoing(3 * faces_.size()), fill(start.begin(), start.end() - 1);
  for (int f = 0; f < num_faces(); ++f)
    for (int k = 0; k < 3; ++k) outgoing[fill[faces_[f][k]]++] = 3 * f + k;

  auto edge_name = [&](int a, int b) {
    return "edge " + name(labels.vertex, "vertex", a) + " - " + name(labels.vertex, "vertex", b);
  };

  neighbors_.resize(faces_.size());
  for (int f = 0; f < num_faces(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int a = faces_[f][k], b = faces_[f][(k + 1) % 3];
      int match = -1;
      for (int i = start[b]; i < start[b + 1]; ++i) {
        const int g = outgoing[i] / 3, m = outgoing[i] % 3;
        if (faces_[g][(m + 1) % 3] != a) continue;
        if (match >= 0)
          throw MeshError(edge_name(a, b) + " belongs to more than two faces (" +
                          name(labels.face, "face", match) + ", " + name(labels.face, "face", g) +
                          " among them): the mesh is not a manifold; split or remove faces there");
        match = g;
      }
      for (int i = start[a]; i < start[a + 1]; ++i) {
        const int g = outgoing[i] / 3, m = outgoing[i] % 3;
        if (g == f || faces_[g][(m + 1) % 3] != b) continue;
        const int c = faces_[f][(k + 2) % 3], d = faces_[g][(m + 2) % 3];
        if (c == d)
          throw MeshError(name(labels.face, "face", f) + " and " + name(labels.face, "face", g) +
                          " are duplicates; remove one");
        throw MeshError(name(labels.face, "face", f) + " and " + name(labels.face, "face", g) +
                        " run through " + edge_name(a, b) +
                        " in the same direction: one of them is flipped (or the edge has more "
                        "than two faces); reverse the order of its corners");
      }
      if (match < 0)
        throw MeshError(edge_name(a, b) + " of " + name(labels.face, "face", f) +
                        " is a boundary: a membrane must be closed or continue through the "
                        "periodic box; close the hole");
      const int c = faces_[f][(k + 2) % 3];
      if (corner_of(faces_[match], c) >= 0)
        throw MeshError(name(labels.face, "face", f) + " and " + name(labels.face, "face", match) +
                        " share all three corners; remove both or refine the mesh");
      neighbors_[f][k] = match;
    }
}

/* ----------------------------------------------------------------------
   order the faces around each vertex into one counter-clockwise fan
------------------------------------------------------------------------- */

void Topology::walk_fans(int num_vertices, const Labels &labels)
{
  ring_.resize(3 * faces_.size());
  ring_faces_.resize(3 * faces_.size());
  std::vector<int> first_face(num_vertices, -1);
  for (int f = num_faces() - 1; f >= 0; --f)
    for (int v : faces_[f]) first_face[v] = f;

  for (int v = 0; v < num_vertices; ++v) {
    const int count = ring_start_[v + 1] - ring_start_[v];
    if (count == 0)
      throw MeshError(name(labels.vertex, "vertex", v) +
                      " is in no face; remove it or give it faces");
    int f = first_face[v], n = 0;
    do {
      const int k = corner_of(faces_[f], v);
      ring_faces_[ring_start_[v] + n] = f;
      ring_[ring_start_[v] + n] = faces_[f][(k + 1) % 3];
      ++n;
      f = neighbors_[f][(k + 2) % 3];    // across the edge that ends in v: the next face
    } while (f != first_face[v] && n < count);
    if (f != first_face[v] || n != count)
      throw MeshError("the faces around " + name(labels.vertex, "vertex", v) +
                      " form more than one fan: surfaces touch in a point there; "
                      "give each surface its own vertex");
    if (n < 3)
      throw MeshError(name(labels.vertex, "vertex", v) + " has valence " + std::to_string(n) +
                      "; a control point needs at least 3 neighbours");
  }
}

/* ---------------------------------------------------------------------- */

void Topology::find_components()
{
  component_.assign(num_vertices(), -1);
  std::vector<int> stack;
  for (int seed = 0; seed < num_vertices(); ++seed) {
    if (component_[seed] >= 0) continue;
    const int c = static_cast<int>(component_vertices_.size());
    int vertices = 0, corners = 0;
    component_[seed] = c;
    stack.push_back(seed);
    while (!stack.empty()) {
      const int v = stack.back();
      stack.pop_back();
      ++vertices;
      corners += valence(v);
      for (int w : ring(v))
        if (component_[w] < 0) {
          component_[w] = c;
          stack.push_back(w);
        }
    }
    component_vertices_.push_back(vertices);
    component_faces_.push_back(corners / 3);
  }
}

/* ---------------------------------------------------------------------- */

int Topology::euler_characteristic(int c) const
{
  return component_vertices_[c] - component_faces_[c] / 2;
}

int Topology::opposite(int f, int k) const
{
  const Face &other = faces_[neighbors_[f][k]];
  return other[(corner_of(other, faces_[f][k]) + 1) % 3];
}

Valences Topology::valences(int f) const
{
  const Face &face = faces_[f];
  return {valence(face[0]), valence(face[1]), valence(face[2])};
}

bool Topology::is_regular(int f) const
{
  return valences(f) == Valences{6, 6, 6};
}

/* ----------------------------------------------------------------------
   how many edges further some vertex of large valence squeezes faces, at most, and one more
------------------------------------------------------------------------- */

void Topology::find_squeezed()
{
  std::vector<int> reached;
  for (int v = 0; v < num_vertices(); ++v)
    if (valence(v) >= SQUEEZING_VALENCE) reached.push_back(v);
  if (reached.empty()) return;
  squeezes_.assign(num_vertices(), 0);
  for (int v : reached) squeezes_[v] = valence(v) - SQUEEZING_VALENCE + 2;
  for (size_t i = 0; i < reached.size(); ++i) {
    const int further = squeezes_[reached[i]] - 1;
    for (int w : ring(reached[i]))
      if (further > squeezes_[w]) {
        squeezes_[w] = further;
        reached.push_back(w);
      }
  }
}

bool Topology::is_squeezed(int f) const
{
  if (squeezes_.empty() || !is_regular(f)) return false;
  const Face &face = faces_[f];
  return std::any_of(face.begin(), face.end(), [this](int v) { return squeezes_[v] > 0; });
}

/* ----------------------------------------------------------------------
   stencil order: see the header; membrane_limit_basis.cpp lays out its patches alike
------------------------------------------------------------------------- */

void Topology::stencil(int f, std::vector<int> &points, int first) const
{
  const Face &face = faces_[f];
  points = {face[first], face[(first + 1) % 3], face[(first + 2) % 3]};
  for (int k = 0; k < 3; ++k) {
    const IntSpan around = ring(points[k]);
    const int n = around.size(), next = points[(k + 1) % 3];
    int start = 0;
    while (around[start] != next) ++start;
    for (int i = 2; i <= n - 2; ++i) points.push_back(around[(start + i) % n]);
  }
  if (points.size() == 3) points.push_back(opposite(f, 0));    // tetrahedron
}

/* ---------------------------------------------------------------------- */

double Topology::memory_usage() const
{
  auto bytes = [](const auto &v) { return static_cast<double>(v.capacity() * sizeof(v[0])); };
  return bytes(faces_) + bytes(neighbors_) + bytes(ring_start_) + bytes(ring_) +
      bytes(ring_faces_) + bytes(component_) + bytes(squeezes_);
}
