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

#include "membrane_mesh_readers.h"
#include "membrane_mesh_text.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
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
  if (word == "<?xml" || word == "<VTKFile") return "vtp";
  if (word.size() >= 3 && word.substr(word.size() - 3) == "OFF") return "off";
  return "";
}

struct Format {
  const char *name;
  PolygonSoup (*read)(const std::string &, std::string_view);
};

const Format &format_named(const std::string &path, const std::string &name)
{
  static const Format formats[] = {{"off", read_off}, {"ply", read_ply}, {"obj", read_obj},
                                   {"stl", read_stl}, {"vtp", read_vtp}, {"tsi", read_tsi},
                                   {"mesh", read_hd}};
  for (const Format &format : formats)
    if (name == format.name) return format;
  mesh_file_error(
      path, 0,
      "unknown extension " + quoted(name) +
          "; a mesh file must be named *.off, *.ply, *.obj, *.stl, *.vtp, *.tsi or *.mesh");
}

}    // namespace

/* ---------------------------------------------------------------------- */

TriangleMesh Membrane_NS::parse_mesh(const std::string &path, std::string_view content,
                                     const PeriodicBox &box, MeshFileReport &report)
{
  const std::string name = extension(path);
  const Format &format = format_named(path, name);
  if (content.empty()) mesh_file_error(path, 0, "the file is empty; export the mesh again");
  if (content.substr(0, 3) == "\xEF\xBB\xBF" && name != "stl")
    content.remove_prefix(3);    // UTF-8 mark at the beginning of a text
  const std::string found = format_by_first_word(content);
  if (!found.empty() && found != name && name != "stl")
    mesh_file_error(
        path, 0, "the content looks like ." + found + ", not like ." + name + "; rename the file");
  return assemble(path, format.read(path, content), box, report);
}

TriangleMesh Membrane_NS::read_mesh(const std::string &path, const PeriodicBox &box,
                                    MeshFileReport &report)
{
  format_named(path, extension(path));    // before anything large is read in vain
  return parse_mesh(path, read_whole_file(path), box, report);
}

TriangleMesh Membrane_NS::read_mesh(const std::string &path)
{
  MeshFileReport report;
  return read_mesh(path, PeriodicBox(), report);
}

std::vector<Eigen::Vector3d> Membrane_NS::read_inclusions(const std::string &path, int type)
{
  if (extension(path) != "tsi")
    mesh_file_error(path, 0, "only files of FreeDTS and TS2CG, *.tsi, have inclusions");
  std::vector<Eigen::Vector3d> places;
  std::string others;
  for (const TsiInclusion &inclusion : read_tsi_inclusions(path, read_whole_file(path)))
    if (inclusion.type == type)
      places.push_back(inclusion.place);
    else if ((others + ' ').find(' ' + std::to_string(inclusion.type) + ' ') == std::string::npos)
      others += ' ' + std::to_string(inclusion.type);
  if (places.empty())
    mesh_file_error(path, 0, "it has no inclusions of type " + std::to_string(type) +
                                 (others.empty() ? "" : ", but of" + others));
  return places;
}
