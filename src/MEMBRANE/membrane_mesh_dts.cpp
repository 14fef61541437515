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

// Files of programs that move triangulated surfaces by Monte Carlo steps: FreeDTS and TS2CG, hd

#include "membrane_mesh_readers.h"
#include "membrane_mesh_text.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

using namespace Membrane_NS;

namespace {

/// Vertices with numbers of their own, which faces use.
class NumberedVertices {
 public:
  explicit NumberedVertices(PolygonSoup &soup) : soup_(soup) {}

  /// The line begins with a number and three coordinates.
  void add(const MeshText &text)
  {
    const long long number = text.integer(0);
    soup_.points.push_back(text.point(1));
    if (!index_.try_emplace(number, static_cast<int>(soup_.points.size()) - 1).second)
      text.fail("there is a vertex " + std::to_string(number) +
                " already; correct the number or export the mesh again");
  }

  /// The line has three corners from word `first` on.
  void add_triangle(const MeshText &text, int first)
  {
    if (text.size() < first + 3)
      text.fail("a triangle needs 3 corners, there are " +
                std::to_string(std::max(0, text.size() - first)) +
                "; correct the line or export the mesh again");
    for (int k = first; k < first + 3; ++k) soup_.corners.push_back(index(text, k));
    soup_.end_polygon();
  }

  /// Which vertex word k of the line names.
  int index(const MeshText &text, int k) const
  {
    const auto vertex = index_.find(text.integer(k));
    if (vertex == index_.end())
      text.fail("corner " + quoted(text[k]) + " is not the number of one of the " +
                std::to_string(soup_.points.size()) + " vertices; correct the face");
    return vertex->second;
  }

 private:
  PolygonSoup &soup_;
  std::unordered_map<long long, int> index_;
};

void next_item(MeshText &text, const char *what, int done, int all)
{
  if (!text.next_line())
    text.fail("the file ends after " + std::to_string(done) + " of " + std::to_string(all) + " " +
              what + ": it is truncated or its counts are wrong; export it again");
}

/// The box is used to tell whether the mesh continues through it.
void set_lattice(const MeshText &text, const Eigen::Matrix3d &lattice, PolygonSoup &soup)
{
  if (!(std::abs(lattice.determinant()) > 0.0) || !lattice.inverse().allFinite())
    text.fail("its box has no volume; correct it or export the mesh again");
  soup.lattice = lattice;
}

}    // namespace

/* ----------------------------------------------------------------------
   FreeDTS [W. Pezeshkian and J. H. Ipsen, Nat. Commun. 15, 548 (2024)]: sections that begin with a
   word and, but for version and box, a count. Vertices: number x y z, and the domain; triangles:
   number and corners. A vector field has a line for each vertex.
------------------------------------------------------------------------- */

static PolygonSoup read_tsi(const std::string &path, std::string_view content, std::vector<TsiInclusion> *inclusions)
{
  MeshText text(path, content, '\0');
  PolygonSoup soup;
  NumberedVertices vertices(soup);
  bool begun = false;
  while (text.next_line()) {
    const std::string section(text[0]);
    if (section == "version") {
      begun = true;
      continue;
    }
    if (section == "box") {
      if (text.size() < 4) text.fail("the box needs 3 lengths; correct the line");
      set_lattice(text, text.point(1).asDiagonal(), soup);
      continue;
    }
    const bool is_vertex = section == "vertex", is_triangle = section == "triangle";
    const bool is_field = section == "vector_fields";
    if (!is_vertex && !is_triangle && !is_field && section != "inclusion" && section != "exclusion")
      text.fail(
          begun ? "found " + quoted(section) +
                  " where a section vertex, triangle, inclusion or exclusion should begin: the "
                  "count of the section before may be wrong; export it again"
                : "it does not begin with the word version; is this a file of FreeDTS or TS2CG?");
    if (text.size() < 2)
      text.fail("the count after " + quoted(section) + " is missing; export it again");
    int count = text.count(1);
    if (is_field && count > 0) count = static_cast<int>(soup.points.size());
    const std::string items = is_vertex ? "vertices" : is_triangle ? "triangles" : section + "s";
    for (int i = 0; i < count; ++i) {
      next_item(text, items.c_str(), i, count);
      if (is_vertex) vertices.add(text);
      if (is_triangle) vertices.add_triangle(text, 1);
      if (!inclusions || section != "inclusion") continue;
      if (text.size() < 3) text.fail("an inclusion needs a number, a type and a vertex; correct the line");
      inclusions->push_back({text.count(1), soup.points[vertices.index(text, 2)]});
    }
  }
  return soup;
}

PolygonSoup Membrane_NS::read_tsi(const std::string &path, std::string_view content)
{
  return ::read_tsi(path, content, nullptr);
}

std::vector<TsiInclusion> Membrane_NS::read_tsi_inclusions(const std::string &path, std::string_view content)
{
  std::vector<TsiInclusion> inclusions;
  ::read_tsi(path, content, &inclusions);
  return inclusions;
}

/* ----------------------------------------------------------------------
   hd: a title; three lines of box vectors; a line for each vertex with its number, coordinates,
   valence and neighbours; ntri and a count; a line of corners for each triangle
------------------------------------------------------------------------- */

PolygonSoup Membrane_NS::read_hd(const std::string &path, std::string_view content)
{
  MeshText text(path, content, '\0');
  if (!text.next_line() || text[0] != "3D" || text.size() < 3 || text[1] != "saved" ||
      text[2] != "surface")
    text.fail(
        "it does not begin with the words 3D saved surface, as .mesh files of the program hd do; "
        "export other meshes as OFF or PLY");
  PolygonSoup soup;
  NumberedVertices vertices(soup);
  Eigen::Matrix3d lattice;
  for (int k = 0; k < 3; ++k) {
    next_item(text, "box vectors", k, 3);
    if (text.size() < 3) text.fail("a box vector needs 3 numbers; correct the line");
    lattice.col(k) = text.point(0);
  }
  set_lattice(text, lattice, soup);
  while (true) {
    if (!text.next_line())
      text.fail("the file ends without ntri and the triangles: it is truncated; export it again");
    if (text[0] == "ntri") break;
    vertices.add(text);
  }
  if (text.size() < 2) text.fail("the count after 'ntri' is missing; export it again");
  const int count = text.count(1);
  for (int f = 0; f < count; ++f) {
    next_item(text, "triangles", f, count);
    vertices.add_triangle(text, 0);
  }
  if (text.next_line())
    text.fail("more lines than the " + std::to_string(count) +
              " triangles of the count; correct the count");
  return soup;
}
