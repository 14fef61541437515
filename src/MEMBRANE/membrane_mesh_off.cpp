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

#include <climits>

using namespace Membrane_NS;

namespace {

/// From the line with the word OFF to that with the counts.
void take_header(MeshText &text)
{
  const size_t keyword = text[0].find("OFF");
  if (keyword == std::string_view::npos)
    text.fail(
        "it begins with " + quoted(text[0]) +
        ", neither with the word OFF nor with the counts of vertices and faces; is this an OFF "
        "file?");
  const std::string_view prefix = text[0].substr(0, keyword);
  if (prefix.find_first_not_of("STCN") != std::string_view::npos)
    text.fail("cannot read the OFF variant " + quoted(text[0]) +
              "; only vertices in three dimensions are read: export as plain OFF");
  if (text.size() > 1 && text[1] == "BINARY")
    text.fail("cannot read binary OFF; export as text OFF or as binary PLY");
  text.drop_from_first_word(keyword + 3);
  if (text.size() == 0 && !text.next_line())
    text.fail("the counts of vertices and faces are missing: it is truncated; export it again");
  if (text.size() < 2)
    text.fail("expected the counts of vertices and faces on one line; correct the line");
}

}    // namespace

/* ----------------------------------------------------------------------
   OFF as in the Geomview manual, each vertex and each face on a line of its own. Also taken: no
   edge count, counts on the line of the header or glued to it, no header, anything after the
   coordinates and the corners.
------------------------------------------------------------------------- */

PolygonSoup Membrane_NS::read_off(const std::string &path, std::string_view content)
{
  MeshText text(path, content, '#');
  long long counts;
  if (!text.next_line()) text.fail("it has comments only; is this an OFF file?");
  if (text.size() < 2 || !parse_number(text[0], counts) || !parse_number(text[1], counts))
    take_header(text);
  const int num_points = text.count(0), num_faces = text.count(1);

  auto next_item = [&](const char *what, int done, int all) {
    if (!text.next_line())
      text.fail("the file ends after " + std::to_string(done) + " of " + std::to_string(all) + " " +
                what + ": it is truncated or its counts are wrong; export it again");
  };

  PolygonSoup soup;
  for (int v = 0; v < num_points; ++v) {
    next_item("vertices", v, num_points);
    soup.points.push_back(text.point(0));
  }
  for (int f = 0; f < num_faces; ++f) {
    next_item("faces", f, num_faces);
    const long long corners = text.integer(0);
    check_polygon(text, corners);
    if (text.size() <= corners)
      text.fail("a face needs " + std::to_string(corners) +
                " corners as its first number says, there are " + std::to_string(text.size() - 1) +
                "; correct the line");
    for (int k = 1; k <= corners; ++k)
      soup.corners.push_back(checked_corner(text, text.integer(k), num_points));
    soup.end_polygon();
  }
  if (text.next_line())
    text.fail("more lines than the " + std::to_string(num_points) + " vertices and " +
              std::to_string(num_faces) + " faces of the counts; correct the counts");
  return soup;
}

/* ----------------------------------------------------------------------
   OBJ: a corner is v, v/vt, v/vt/vn or v//vn; v counts from 1, or from -1 back from the last
   vertex so far. Faces may come before their vertices. A line that ends in a backslash goes on.
------------------------------------------------------------------------- */

PolygonSoup Membrane_NS::read_obj(const std::string &path, std::string_view content)
{
  MeshText text(path, content, '#', 0, 0, '\\');
  PolygonSoup soup;
  soup.first_number = 1;
  std::vector<long> face_lines;
  while (text.next_line()) {
    if (text[0] == "v") {
      soup.points.push_back(text.point(1));
    } else if (text[0] == "f") {
      check_polygon(text, text.size() - 1);
      const long long points_so_far = soup.points.size();
      for (int k = 1; k < text.size(); ++k) {
        const std::string_view corner = text[k];
        long long v;
        if (!parse_number(corner.substr(0, corner.find('/')), v) || v == 0 || v > INT_MAX ||
            v < -points_so_far)
          text.fail("corner " + quoted(corner) +
                    " is not the number of a vertex, counted from 1, or from -1 backwards; "
                    "correct the face");
        soup.corners.push_back(static_cast<int>(v > 0 ? v - 1 : points_so_far + v));
      }
      soup.end_polygon();
      face_lines.push_back(text.line());
    }
  }
  const long long num_points = soup.points.size();
  for (int f = 0; f < soup.size(); ++f)
    for (int v : soup.polygon(f))
      if (v >= num_points)
        mesh_file_error(path, face_lines[f],
                        "corner " + std::to_string(v + 1LL) + " is not one of the " +
                            std::to_string(num_points) +
                            " vertices, counted from 1; correct the face");
  return soup;
}
