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

#include "membrane_mesh_soup.h"

#include "membrane_mesh_orientation.h"
#include "membrane_mesh_text.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdio>
#include <tuple>

using namespace Membrane_NS;
using Eigen::Vector3d;

/* ---------------------------------------------------------------------- */

void PolygonSoup::add_triangle(int a, int b, int c)
{
  corners.insert(corners.end(), {a, b, c});
  end_polygon();
}

void PolygonSoup::add_strip(const std::vector<int> &strip)
{
  for (size_t i = 2; i < strip.size(); ++i) {
    const int a = strip[i - 2], b = strip[i - 1], c = strip[i];
    if (a == b || b == c || c == a) continue;
    if (i % 2 == 0)
      add_triangle(a, b, c);
    else
      add_triangle(b, a, c);
  }
}

IntSpan PolygonSoup::polygon(int i) const
{
  return {corners.data() + (i == 0 ? 0 : ends[i - 1]), corners.data() + ends[i]};
}

/* ---------------------------------------------------------------------- */

std::string MeshFileReport::summary() const
{
  auto counted = [](int n, const std::string &one, const std::string &many) {
    return std::to_string(n) + " " + (n == 1 ? one : many);
  };
  std::string text =
      counted(vertices, "vertex", "vertices") + ", " + counted(faces, "face", "faces");
  const char *separator = "; ";
  auto tell = [&](int n, const char *one, const char *many) {
    if (n == 0) return;
    text += separator + counted(n, one, many);
    separator = ", ";
  };
  tell(joined, "vertex joined with another at its place",
       "vertices joined with others at their place");
  tell(collapsed, "face without area left out", "faces without area left out");
  tell(cut, "polygon cut into triangles", "polygons cut into triangles");
  tell(separated, "vertex doubled where surfaces touch", "vertices doubled where surfaces touch");
  tell(turned, "face turned as the others of its surface",
       "faces turned as the others of their surface");
  return text;
}

namespace {

/// A half-edge is 3 * face + corner, from that corner to the next.
int other_end(int half_edge)
{
  return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}

/// The way from a soup to a mesh.
class Assembly {
 public:
  Assembly(const std::string &path, PolygonSoup &soup, const PeriodicBox &box,
           MeshFileReport &report) :
      path_(path),
      soup_(soup), report_(report)
  {
    mesh_.lattice = box.lattice;
    mesh_.periodic = box.periodic;
    mesh_.points = std::move(soup.points);
  }

  TriangleMesh mesh(const std::vector<int> &joined_with)
  {
    cut_polygons();
    check_box();
    match_edges();
    separate_fans();
    make_consistent();
    number_vertices(joined_with);
    choose_sides();
    return std::move(mesh_);
  }

 private:
  const std::string &path_;
  PolygonSoup &soup_;
  MeshFileReport &report_;
  TriangleMesh mesh_;
  std::vector<int> polygon_of_;    // in the file, of a face
  std::vector<int> vertex_of_;     // in the file, of a vertex
  std::vector<int> twin_;          // of a half-edge, that of the other face
  std::vector<bool> reversed_;     // of a face, against the first of its surface

  [[noreturn]] void fail(const std::string &problem) const { mesh_file_error(path_, 0, problem); }

  int &corner(int half_edge) { return mesh_.faces[half_edge / 3][half_edge % 3]; }
  int corner(int half_edge) const { return mesh_.faces[half_edge / 3][half_edge % 3]; }

  std::string vertex_name(int v) const
  {
    if (soup_.first_number >= 0)
      return "vertex " +
          std::to_string((vertex_of_.empty() ? v : vertex_of_[v]) + soup_.first_number);
    const Vector3d &x = mesh_.points[v];
    char place[80];
    std::snprintf(place, sizeof(place), "(%.6g, %.6g, %.6g)", x[0], x[1], x[2]);
    return place;
  }
  std::string face_name(int f) const { return polygon_name(polygon_of_[f]); }
  std::string polygon_name(int i) const
  {
    return "face " + std::to_string(i + std::max(0, soup_.first_number));
  }
  std::string edge_name(int half_edge) const
  {
    return "edge " + vertex_name(corner(half_edge)) + " - " +
        vertex_name(corner(other_end(half_edge)));
  }

  void cut_polygons();
  void check_box() const;
  void match_edges();
  void check_edge(const std::vector<int> &half_edges) const;
  void separate_fans();
  void make_consistent();
  void number_vertices(const std::vector<int> &joined_with);
  void choose_sides();
};

/* ---------------------------------------------------------------------- */

void Assembly::cut_polygons()
{
  auto add = [this](int polygon, const Face &face) {
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) return;
    mesh_.faces.push_back(face);
    polygon_of_.push_back(polygon);
  };
  std::vector<int> corners;
  std::vector<Vector3d> x;
  for (int i = 0; i < soup_.size(); ++i) {
    corners.clear();
    for (int v : soup_.polygon(i))
      if (corners.empty() || corners.back() != v) corners.push_back(v);
    while (corners.size() > 1 && corners.back() == corners.front()) corners.pop_back();
    const int n = static_cast<int>(corners.size());
    if (n < 3) {
      ++report_.collapsed;
      continue;
    }
    if (n == 3) {
      add(i, {corners[0], corners[1], corners[2]});
      continue;
    }
    if (n > MOST_CORNERS)
      fail(polygon_name(i) + " has " + std::to_string(n) + " corners, and no more than " +
           std::to_string(MOST_CORNERS) + " are cut into triangles; triangulate the mesh");
    ++report_.cut;
    x.assign(1, mesh_.points[corners[0]]);
    for (int k = 1; k < n; ++k) x.push_back(x.back() + mesh_.edge(corners[k - 1], corners[k]));
    for (const Face &t : cut_polygon(x)) add(i, {corners[t[0]], corners[t[1]], corners[t[2]]});
  }
  if (mesh_.faces.empty()) fail("the mesh has no faces with an area; export it as a triangle mesh");
  if (mesh_.faces.size() > INT_MAX / 3) fail("the mesh has too many faces; use a coarser one");
}

/* ----------------------------------------------------------------------
   what crosses the box of the file is in one piece in that box only
------------------------------------------------------------------------- */

void Assembly::check_box() const
{
  if (!soup_.lattice) return;
  const Eigen::Matrix3d to_fraction = soup_.lattice->inverse();
  bool crosses[3] = {false, false, false};
  for (const Face &face : mesh_.faces)
    for (int i = 0; i < 3; ++i) {
      const Vector3d edge = to_fraction * (mesh_.points[face[(i + 1) % 3]] - mesh_.points[face[i]]);
      for (int k = 0; k < 3; ++k) crosses[k] = crosses[k] || std::fabs(edge[k]) > 0.5;
    }
  constexpr double SAME = 1e-5;    // programs print six digits after the point
  for (int k = 0; k < 3; ++k) {
    if (!crosses[k]) continue;
    const Vector3d theirs = soup_.lattice->col(k), ours = mesh_.lattice.col(k);
    if (mesh_.periodic[k] && (theirs - ours).norm() <= SAME * theirs.norm()) continue;
    char lengths[160];
    std::snprintf(lengths, sizeof(lengths), "%.8g long, and the simulation box %s %.8g there",
                  theirs.norm(), mesh_.periodic[k] ? "is" : "is not periodic and", ours.norm());
    fail(std::string("the mesh continues through the sides of its periodic box in ") + "xyz"[k] +
         ", which is " + lengths + "; make a simulation box of that length");
  }
}

/* ----------------------------------------------------------------------
   two faces at each edge, in whatever orientation
------------------------------------------------------------------------- */

void Assembly::match_edges()
{
  struct Edge {
    int v, w, half_edge;
    bool operator<(const Edge &other) const
    {
      return std::tie(v, w, half_edge) < std::tie(other.v, other.w, other.half_edge);
    }
  };
  std::vector<Edge> edges;
  edges.reserve(3 * mesh_.faces.size());
  for (int h = 0; h < static_cast<int>(3 * mesh_.faces.size()); ++h) {
    const int v = corner(h), w = corner(other_end(h));
    edges.push_back({std::min(v, w), std::max(v, w), h});
  }
  std::sort(edges.begin(), edges.end());

  twin_.assign(edges.size(), -1);
  std::vector<int> open;    // the first open edge, and how many
  for (size_t i = 0, j; i < edges.size(); i = j) {
    std::vector<int> half_edges;
    for (j = i; j < edges.size() && edges[j].v == edges[i].v && edges[j].w == edges[i].w; ++j)
      half_edges.push_back(edges[j].half_edge);
    if (half_edges.size() == 1) {
      open.push_back(half_edges[0]);
      continue;
    }
    check_edge(half_edges);
    twin_[half_edges[0]] = half_edges[1];
    twin_[half_edges[1]] = half_edges[0];
  }
  if (!open.empty())
    fail(edge_name(open[0]) + " of " + face_name(open[0] / 3) + " is a boundary" +
         (open.size() > 1 ? ", one of " + std::to_string(open.size()) + " such edges" : "") +
         ": a membrane must be closed or continue through the periodic box; close the hole" +
         (open.size() > 1 ? "s" : ""));
}

void Assembly::check_edge(const std::vector<int> &half_edges) const
{
  const int f = half_edges[0] / 3, g = half_edges[1] / 3;
  const size_t looked_at = std::min<size_t>(half_edges.size(), 8);
  for (size_t i = 0; i < looked_at; ++i)
    for (size_t j = i + 1; j < looked_at; ++j) {
      const int h = half_edges[i], other = half_edges[j];
      if (corner(other_end(other_end(h))) == corner(other_end(other_end(other))))
        fail(face_name(h / 3) + " and " + face_name(other / 3) +
             " are duplicates; remove one, or both if nothing else is there");
    }
  if (half_edges.size() > 2)
    fail(edge_name(half_edges[0]) + " belongs to " + std::to_string(half_edges.size()) +
         " faces (" + face_name(f) + ", " + face_name(g) +
         " among them): the mesh is not a manifold; split or remove faces there");
}

/* ----------------------------------------------------------------------
   a vertex for each closed fan of faces
------------------------------------------------------------------------- */

void Assembly::separate_fans()
{
  const int num_points = static_cast<int>(mesh_.points.size());
  for (int v = 0; v < num_points; ++v) vertex_of_.push_back(v);
  std::vector<bool> has_fan(num_points, false), seen(twin_.size(), false);
  std::vector<int> stack;
  for (int start = 0; start < static_cast<int>(twin_.size()); ++start) {
    if (seen[start]) continue;
    const int v = corner(start);    // of the corners before this one only
    int number = v;
    if (has_fan[v]) {
      number = static_cast<int>(mesh_.points.size());
      const Vector3d place = mesh_.points[v];
      mesh_.points.push_back(place);
      vertex_of_.push_back(v);
      ++report_.separated;
    }
    has_fan[v] = true;
    seen[start] = true;
    stack.push_back(start);
    while (!stack.empty()) {
      const int h = stack.back();
      stack.pop_back();
      for (int edge : {h, other_end(other_end(h))}) {
        const int twin = twin_[edge];
        const int next = corner(twin) == v && !seen[twin] ? twin : other_end(twin);
        if (corner(next) != v || seen[next]) continue;
        seen[next] = true;
        stack.push_back(next);
      }
      corner(h) = number;
    }
  }
}

/* ----------------------------------------------------------------------
   neighbours run through their edge in opposite directions
------------------------------------------------------------------------- */

void Assembly::make_consistent()
{
  const int num_faces = static_cast<int>(mesh_.faces.size());
  std::vector<bool> reached(num_faces, false);
  reversed_.assign(num_faces, false);
  std::vector<int> stack;
  for (int seed = 0; seed < num_faces; ++seed) {
    if (reached[seed]) continue;
    reached[seed] = true;
    stack.push_back(seed);
    while (!stack.empty()) {
      const int f = stack.back();
      stack.pop_back();
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        const int g = twin_[h] / 3;
        const bool reversed = reversed_[f] != (corner(h) == corner(twin_[h]));
        if (!reached[g]) {
          reached[g] = true;
          reversed_[g] = reversed;
          stack.push_back(g);
        } else if (reversed_[g] != reversed) {
          fail("the surface with " + face_name(g) +
               " has one side only, as a Moebius strip: its faces cannot be oriented; cut it open "
               "and "
               "join it without the twist");
        }
      }
    }
  }
  for (int f = 0; f < num_faces; ++f)
    if (reversed_[f]) std::swap(mesh_.faces[f][1], mesh_.faces[f][2]);
}

/* ----------------------------------------------------------------------
   what is left of the vertices, in the order of the file
------------------------------------------------------------------------- */

void Assembly::number_vertices(const std::vector<int> &joined_with)
{
  std::vector<int> number(mesh_.points.size(), -1);
  int n = 0;
  for (int v = 0; v < static_cast<int>(mesh_.points.size()); ++v) {
    if (v < static_cast<int>(joined_with.size()) && joined_with[v] != v) {
      ++report_.joined;
      continue;
    }
    number[v] = n;
    mesh_.points[n] = mesh_.points[v];
    vertex_of_[n++] = vertex_of_[v];
  }
  mesh_.points.resize(n);
  for (Face &face : mesh_.faces)
    for (int &v : face) v = number[v];
}

/* ---------------------------------------------------------------------- */

void Assembly::choose_sides()
{
  Topology::Labels labels;
  labels.vertex = [this](int v) {
    return vertex_name(v);
  };
  labels.face = [this](int f) {
    return face_name(f);
  };
  Topology topology;
  try {
    topology = Topology(static_cast<int>(mesh_.points.size()), mesh_.faces, labels);
  } catch (const MeshError &error) {
    fail(error.what());
  }

  std::vector<int> faces(topology.num_components(), 0), reversed(topology.num_components(), 0);
  for (size_t f = 0; f < mesh_.faces.size(); ++f) {
    const int c = topology.component(mesh_.faces[f][0]);
    ++faces[c];
    reversed[c] += reversed_[f];
  }
  const std::vector<double> volumes = enclosed_volumes(topology, mesh_);
  std::vector<bool> turn(topology.num_components(), false);
  for (int c = 0; c < topology.num_components(); ++c) {
    if (reversed[c] == 0) continue;    // as the file has it
    turn[c] = std::isnan(volumes[c]) ? 2 * reversed[c] > faces[c] : volumes[c] < 0.0;
    report_.turned += turn[c] ? faces[c] - reversed[c] : reversed[c];
  }
  turn_components(mesh_, topology, turn);
}

}    // namespace

/* ---------------------------------------------------------------------- */

TriangleMesh Membrane_NS::assemble(const std::string &path, PolygonSoup soup,
                                   const PeriodicBox &box, MeshFileReport &report)
{
  if (soup.points.size() > INT_MAX || soup.corners.size() > INT_MAX)
    mesh_file_error(path, 0, "the mesh has too many vertices or faces; use a coarser one");
  const int num_points = static_cast<int>(soup.points.size());
  report = MeshFileReport();
  report.vertices = num_points;
  report.faces = soup.size();
  if (soup.size() == 0)
    mesh_file_error(path, 0, "the mesh has no faces; export it as a triangle mesh");
  for (int i = 0; i < soup.size(); ++i)
    for (int v : soup.polygon(i))
      if (v < 0 || v >= num_points)    // a reader that did not look
        mesh_file_error(path, 0,
                        "face " + std::to_string(i) + " has the corner " + std::to_string(v) +
                            ", but the file has " + std::to_string(num_points) +
                            " vertices; correct the face");
  const std::vector<int> joined_with = join_open_vertices(soup, box);
  return Assembly(path, soup, box, report).mesh(joined_with);
}
