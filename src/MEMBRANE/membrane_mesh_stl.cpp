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

#include "membrane_mesh_readers.h"
#include "membrane_mesh_text.h"

#include "membrane_mesh_bytes.h"

#include <algorithm>
#include <cctype>
#include <cstdint>

using namespace Membrane_NS;

namespace {

// a binary file is 80 bytes of anything, a count, and 50 bytes a facet: normal, corners, colour

constexpr size_t BINARY_HEADER = 84, BINARY_FACET = 50;

/// A facet of the last points: each one has its own.
void add_facet(PolygonSoup &soup, int corners)
{
  for (int k = corners; k > 0; --k)
    soup.corners.push_back(static_cast<int>(soup.points.size()) - k);
  soup.end_polygon();
}

/* ---------------------------------------------------------------------- */

PolygonSoup read_binary(const std::string &path, std::string_view content)
{
  const size_t num_facets = load<uint32_t>(&content[80], false);
  PolygonSoup soup;
  soup.first_number = -1;
  for (size_t f = 0; f < num_facets; ++f) {
    for (int k = 1; k <= 3; ++k) {
      const char *data = &content[BINARY_HEADER + BINARY_FACET * f + 12 * k];
      soup.points.emplace_back(load<float>(data, false), load<float>(data + 4, false),
                               load<float>(data + 8, false));
      if (!soup.points.back().allFinite())
        mesh_file_error(path, 0,
                        "a coordinate of facet " + std::to_string(f) +
                            " is not finite; correct it or export the mesh again");
    }
    add_facet(soup, 3);
  }
  return soup;
}

std::string lower_case(std::string_view word)
{
  std::string result(word);
  std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) {
    return std::tolower(c);
  });
  return result;
}

/* ----------------------------------------------------------------------
   solid NAME / facet normal x y z / outer loop / vertex x y z (three times or more) / endloop /
   endfacet / endsolid NAME; in any case of letters, any number of solids, also `end loop` for
   endloop. Normals follow from the corners.
------------------------------------------------------------------------- */

PolygonSoup read_text(const std::string &path, std::string_view content)
{
  static const char *const order[] = {"solid", "facet", "outer", "vertex", "endloop", "endfacet"};
  enum { SOLID, FACET, OUTER, VERTEX, END_LOOP, END_FACET };

  MeshText text(path, content, '\0');
  PolygonSoup soup;
  soup.first_number = -1;
  int expected = SOLID, corners = 0;
  while (text.next_line()) {
    std::string word = lower_case(text[0]);
    if (word == "end" && text.size() > 1) word += lower_case(text[1]);
    if (expected == FACET && word == "endsolid") {
      expected = SOLID;
    } else if (expected == VERTEX && corners >= 3 && word == "endloop") {
      add_facet(soup, corners);
      expected = END_FACET;
    } else if (word != order[expected]) {
      text.fail("found " + quoted(text[0]) + " where " + quoted(order[expected]) +
                (expected == VERTEX && corners >= 3 ? " or 'endloop'" : "") +
                " should be; export the mesh again");
    } else if (word == "vertex") {
      soup.points.push_back(text.point(1));
      ++corners;
    } else {
      corners = 0;
      expected = expected == END_FACET ? FACET : expected + 1;
    }
  }
  if (expected != SOLID)
    text.fail("the file ends without endsolid: it is truncated; export it again");
  return soup;
}

}    // namespace

/* ----------------------------------------------------------------------
   binary files may begin with the word solid too, but the length of the file tells: in a text
   file the four bytes of the count would be text, and announce more than 8 gigabytes
------------------------------------------------------------------------- */

PolygonSoup Membrane_NS::read_stl(const std::string &path, std::string_view content)
{
  size_t binary_size = 0;
  if (content.size() >= BINARY_HEADER)
    binary_size = BINARY_HEADER + BINARY_FACET * size_t(load<uint32_t>(&content[80], false));
  if (content.size() == binary_size) return read_binary(path, content);

  if (content.substr(0, 3) == "\xEF\xBB\xBF") content.remove_prefix(3);    // UTF-8 mark
  const size_t first = content.find_first_not_of(" \t\r\n");
  const std::string start = lower_case(content.substr(std::min(first, content.size()), 5));
  const bool is_text = start == "solid" && content.find('\0') == std::string_view::npos;
  if (is_text) return read_text(path, content);

  if (binary_size == 0)
    mesh_file_error(path, 0,
                    "neither begins with solid nor has the 84 bytes of a binary header: it is "
                    "truncated or no STL file; export it again");
  mesh_file_error(path, 0,
                  "its facet count announces " + std::to_string(binary_size) +
                      " bytes, but it has " + std::to_string(content.size()) +
                      ": it is truncated or no STL file; export it again");
}
