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

#include "membrane_mesh_file.h"

#include "membrane_mesh_text.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstring>
#include <memory>

using namespace Membrane_NS;

namespace {

std::string read_whole_file(const std::string &path)
{
  auto close = [](std::FILE *file) {
    std::fclose(file);
  };
  std::unique_ptr<std::FILE, decltype(close)> file(std::fopen(path.c_str(), "rb"), close);
  if (!file)
    mesh_file_error(path, 0,
                    std::string("cannot be opened: ") + std::strerror(errno) +
                        "; check its name and permissions");
  std::string content;
  char buffer[65536];
  while (const size_t n = std::fread(buffer, 1, sizeof(buffer), file.get()))
    content.append(buffer, n);
  if (std::ferror(file.get()))
    mesh_file_error(path, 0,
                    std::string("cannot be read: ") + std::strerror(errno) +
                        "; check that it is a file");
  return content;
}

/// The lower-case extension without the dot.
std::string extension(const std::string &path)
{
  const size_t name = path.find_last_of("/\\") + 1;    // npos + 1 = 0
  const size_t dot = path.find_last_of('.');
  if (dot == std::string::npos || dot < name) return "";
  std::string result = path.substr(dot + 1);
  std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) {
    return std::tolower(c);
  });
  return result;
}

/// The format that the first word of a text file gives away, or "".
std::string format_by_first_word(std::string_view content)
{
  const size_t end = content.find_first_of(" \t\r\n");
  const std::string_view word = content.substr(0, std::min<size_t>(end, 16));
  if (word == "ply") return "ply";
  if (word == "solid") return "stl";
  if (word.size() >= 3 && word.substr(word.size() - 3) == "OFF") return "off";
  return "";
}

int checked_corner(const MeshText &text, long long v, int num_points)
{
  if (v < 0 || v >= num_points)
    text.fail("corner " + std::to_string(v) + " is not one of the " + std::to_string(num_points) +
              " vertices, numbered from 0; correct the face");
  return static_cast<int>(v);
}

[[noreturn]] void fail_not_triangle(const MeshText &text, long long corners)
{
  text.fail("a face with " + std::to_string(corners) +
            " corners; only triangles are read: triangulate the mesh");
}

}    // namespace

/* ---------------------------------------------------------------------- */

TriangleMesh Membrane_NS::read_mesh(const std::string &path)
{
  using Reader = TriangleMesh (*)(const std::string &, std::string_view);
  struct Format {
    const char *name;
    Reader read;
  };
  constexpr Format formats[] = {
      {"off", read_off}, {"ply", read_ply}, {"obj", read_obj}, {"stl", read_stl}};

  const std::string wanted = extension(path);
  for (const Format &format : formats) {
    if (wanted != format.name) continue;
    const std::string file = read_whole_file(path);
    std::string_view content = file;
    if (content.empty()) mesh_file_error(path, 0, "the file is empty; export the mesh again");
    if (content.substr(0, 3) == "\xEF\xBB\xBF" && wanted != "stl")
      content.remove_prefix(3);    // UTF-8 mark at the beginning of a text
    const std::string found = format_by_first_word(content);
    if (!found.empty() && found != wanted && wanted != "stl")
      mesh_file_error(path, 0,
                      "the content looks like ." + found + ", not like ." + wanted +
                          "; rename the file");
    TriangleMesh mesh = format.read(path, content);
    check_read_mesh(path, mesh);
    return mesh;
  }
  mesh_file_error(path, 0,
                  "unknown extension " + quoted(wanted) +
                      "; a mesh file must be named *.off, *.ply, *.obj or *.stl");
}

/* ----------------------------------------------------------------------
   OFF as in the Geomview manual, each vertex and each face on a line of its own. Also taken: no
   edge count, counts on the line of the header or glued to it, anything after the coordinates.
------------------------------------------------------------------------- */

TriangleMesh Membrane_NS::read_off(const std::string &path, std::string_view content)
{
  MeshText text(path, content, '#');
  const bool has_header = text.next_line();
  const size_t keyword = has_header ? text[0].find("OFF") : std::string_view::npos;
  if (keyword == std::string_view::npos)
    text.fail("the word OFF is missing at the beginning; is this an OFF file?");
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
  const int num_points = text.count(0), num_faces = text.count(1);

  auto next_item = [&](const char *what, int done, int all) {
    if (!text.next_line())
      text.fail("the file ends after " + std::to_string(done) + " of " + std::to_string(all) + " " +
                what + ": it is truncated or its counts are wrong; export it again");
  };

  TriangleMesh mesh;
  for (int v = 0; v < num_points; ++v) {
    next_item("vertices", v, num_points);
    mesh.points.push_back(text.point(0));
  }
  for (int f = 0; f < num_faces; ++f) {
    next_item("faces", f, num_faces);
    const long long corners = text.integer(0);
    if (corners != 3) fail_not_triangle(text, corners);
    if (text.size() < 4) text.fail("a face needs 3 corners; correct the line");
    Face face;
    for (int k = 0; k < 3; ++k) face[k] = checked_corner(text, text.integer(k + 1), num_points);
    mesh.faces.push_back(face);
  }
  if (text.next_line())
    text.fail("more lines than the " + std::to_string(num_points) + " vertices and " +
              std::to_string(num_faces) + " faces of the counts; correct the counts");
  return mesh;
}

/* ----------------------------------------------------------------------
   OBJ: a corner is v, v/vt, v/vt/vn or v//vn; v counts from 1, or from -1 back from the last
   vertex so far. Faces may come before their vertices.
------------------------------------------------------------------------- */

TriangleMesh Membrane_NS::read_obj(const std::string &path, std::string_view content)
{
  MeshText text(path, content, '#');
  TriangleMesh mesh;
  std::vector<long> face_lines;
  while (text.next_line()) {
    if (text[0] == "v") {
      mesh.points.push_back(text.point(1));
    } else if (text[0] == "f") {
      if (text.size() != 4) fail_not_triangle(text, text.size() - 1);
      const long long points_so_far = mesh.points.size();
      Face face;
      for (int k = 0; k < 3; ++k) {
        const std::string_view corner = text[k + 1];
        long long v;
        if (!parse_number(corner.substr(0, corner.find('/')), v) || v == 0 || v > INT_MAX ||
            v < -points_so_far)
          text.fail("corner " + quoted(corner) +
                    " is not the number of a vertex, counted from 1, or from -1 backwards; "
                    "correct the face");
        face[k] = static_cast<int>(v > 0 ? v - 1 : points_so_far + v);
      }
      mesh.faces.push_back(face);
      face_lines.push_back(text.line());
    }
  }
  const long long num_points = mesh.points.size();
  for (size_t f = 0; f < mesh.faces.size(); ++f)
    for (int v : mesh.faces[f])
      if (v >= num_points)
        mesh_file_error(path, face_lines[f],
                        "corner " + std::to_string(v + 1LL) + " is not one of the " +
                            std::to_string(num_points) +
                            " vertices, counted from 1; correct the face");
  return mesh;
}
