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

#include "membrane_mesh_writer.h"

#include "membrane_mesh_bytes.h"
#include "membrane_mesh_text.h"

#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <map>
#include <set>

using namespace Membrane_NS;
using Eigen::Vector3d;

namespace {

/* ---------------------------------------------------------------------- */

void check(const std::string &path, const TriangleMesh &mesh, const PointFields &fields)
{
  auto fail = [&](const std::string &problem) {
    mesh_file_error(path, 0, problem);
  };
  for (size_t v = 0; v < mesh.points.size(); ++v)
    if (!mesh.points[v].allFinite())
      fail("not written: a coordinate of vertex " + std::to_string(v) +
           " is not finite; check the run that made it");
  for (const auto &[name, values] : fields) {
    if (values.size() != mesh.points.size())
      fail("not written: field " + quoted(name) + " has " + std::to_string(values.size()) +
           " values for " + std::to_string(mesh.points.size()) +
           " vertices; it needs one a vertex");
    for (size_t v = 0; v < values.size(); ++v)
      if (!std::isfinite(values[v]))
        fail("not written: the value of field " + quoted(name) + " at vertex " + std::to_string(v) +
             " is not finite; check the run that made it");
  }
}

void write_whole_file(const std::string &path, const std::string &content)
{
  std::FILE *file = std::fopen(path.c_str(), "wb");
  if (!file)
    mesh_file_error(path, 0,
                    std::string("cannot be opened for writing: ") + std::strerror(errno) +
                        "; check the folder and its permissions");
  const size_t written = std::fwrite(content.data(), 1, content.size(), file);
  const int write_error = written == content.size() ? 0 : errno;
  const int close_error = std::fclose(file) == 0 ? 0 : errno;
  if (write_error || close_error || written != content.size())
    mesh_file_error(path, 0,
                    std::string("cannot be written in full: ") +
                        std::strerror(write_error ? write_error : close_error) +
                        "; make room and write it again");
}

void append_line(std::string &text, const Vector3d &point)
{
  for (int k = 0; k < 3; ++k) {
    if (k) text += ' ';
    append_number(text, point[k]);
  }
}

void append_line(std::string &text, const Face &face)
{
  text += '3';
  for (int v : face) text += ' ' + std::to_string(v);
  text += '\n';
}

// names of the fields as one word each, all different from one another and from x, y, z

std::vector<std::string> ply_names(const std::string &path, const PointFields &fields)
{
  std::vector<std::string> names;
  std::set<std::string> taken = {"x", "y", "z", ""};
  for (const auto &field : fields) {
    std::string word;
    for (char c : field.first) word += (c > ' ' && c <= '~') ? c : '_';
    if (!taken.insert(word).second)
      mesh_file_error(path, 0,
                      "not written: field " + quoted(field.first) +
                          " has the name of another vertex property; rename it");
    names.push_back(word);
  }
  return names;
}

// === VTK XML

std::string xml_escaped(const std::string &name)
{
  std::string text;
  for (char c : name) {
    switch (c) {
      case '&':
        text += "&amp;";
        break;
      case '<':
        text += "&lt;";
        break;
      case '>':
        text += "&gt;";
        break;
      case '"':
        text += "&quot;";
        break;
      default:
        text += (c >= 0 && c < ' ') ? '_' : c;
    }
  }
  return text;
}

std::string base64(const std::string &bytes)
{
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t group = 0;
    for (size_t j = 0; j < 3; ++j)
      group = group << 8 | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0);
    for (size_t j = 0; j < 4; ++j)
      text += i + j <= bytes.size() ? digits[group >> (18 - 6 * j) & 63] : '=';
  }
  return text;
}

// an array in base64, preceded by its length in bytes

template <typename T>
void append_array(std::string &xml, const std::string &type, const std::string &name,
                  int components, const std::vector<T> &values)
{
  std::string bytes;
  bytes.reserve(8 + sizeof(T) * values.size());
  append_little_endian(bytes, static_cast<uint64_t>(sizeof(T) * values.size()));
  for (const T &value : values) append_little_endian(bytes, value);
  xml += "        <DataArray type=\"" + type + "\" Name=\"" + xml_escaped(name) +
      "\" NumberOfComponents=\"" + std::to_string(components) + "\" format=\"binary\">\n" +
      base64(bytes) + "\n        </DataArray>\n";
}

}    // namespace

/* ---------------------------------------------------------------------- */

MeshDrawing Membrane_NS::cut_open(const TriangleMesh &mesh)
{
  MeshDrawing drawing;
  drawing.mesh = mesh;
  for (size_t v = 0; v < mesh.points.size(); ++v) drawing.source.push_back(static_cast<int>(v));
  if (!mesh.is_periodic()) return drawing;

  const Eigen::Matrix3d to_fraction = mesh.lattice.inverse();
  std::map<std::array<int, 4>, int> images;    // point and box shifts -> its image
  for (Face &face : drawing.mesh.faces) {
    const int anchor = face[0];
    for (int k = 1; k < 3; ++k) {
      const int v = face[k];
      const Vector3d position = mesh.points[anchor] + mesh.edge(anchor, v);
      const Vector3d shift = to_fraction * (position - mesh.points[v]);
      const std::array<int, 4> key = {v, static_cast<int>(std::lround(shift[0])),
                                      static_cast<int>(std::lround(shift[1])),
                                      static_cast<int>(std::lround(shift[2]))};
      if (key[1] == 0 && key[2] == 0 && key[3] == 0) continue;
      const auto [image, is_new] =
          images.try_emplace(key, static_cast<int>(drawing.mesh.points.size()));
      if (is_new) {
        drawing.mesh.points.push_back(position);
        drawing.source.push_back(v);
      }
      face[k] = image->second;
    }
  }
  return drawing;
}

/* ---------------------------------------------------------------------- */

void Membrane_NS::write_off(const std::string &path, const TriangleMesh &mesh,
                            const PointFields &fields)
{
  check(path, mesh, fields);
  std::string text = "OFF\n" + std::to_string(mesh.points.size()) + " " +
      std::to_string(mesh.faces.size()) + " 0\n";
  for (const Vector3d &point : mesh.points) {
    append_line(text, point);
    text += '\n';
  }
  for (const Face &face : mesh.faces) append_line(text, face);
  write_whole_file(path, text);
}

/* ---------------------------------------------------------------------- */

void Membrane_NS::write_tsi(const std::string &path, const TriangleMesh &mesh,
                            const PointFields &fields, const TsiVertices &vertices)
{
  check(path, mesh, fields);
  const Vector3d box = mesh.lattice.diagonal();
  if (Eigen::Matrix3d(box.asDiagonal()) != mesh.lattice)
    mesh_file_error(
        path, 0,
        "not written: a TSI file has a box with right angles, and this one is triclinic; "
        "write another format");
  std::string text = "version 1.1\nbox ";
  append_line(text, box);
  text += "\nvertex " + std::to_string(mesh.points.size()) + "\n";
  for (size_t v = 0; v < mesh.points.size(); ++v) {
    Vector3d x = mesh.points[v];
    for (int k = 0; k < 3; ++k) {
      if (mesh.periodic[k]) x[k] -= box[k] * std::floor(x[k] / box[k]);
      if (mesh.periodic[k] && x[k] >= box[k]) x[k] = 0.0;    // by rounding
    }
    text += std::to_string(v) + " ";
    append_line(text, x);
    if (!vertices.domains.empty()) text += " " + std::to_string(vertices.domains[v]);
    text += "\n";
  }
  text += "triangle " + std::to_string(mesh.faces.size()) + "\n";
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    text += std::to_string(f);
    for (int v : mesh.faces[f]) text += ' ' + std::to_string(v);
    text += '\n';
  }
  text += "inclusion " + std::to_string(vertices.inclusions.size()) + "\n";
  for (size_t i = 0; i < vertices.inclusions.size(); ++i)
    text += std::to_string(i) + " " + std::to_string(vertices.inclusions[i].type) + " " +
        std::to_string(vertices.inclusions[i].vertex) + " 1 0\n";
  write_whole_file(path, text);
}

/* ---------------------------------------------------------------------- */

void Membrane_NS::write_ply(const std::string &path, const TriangleMesh &mesh,
                            const PointFields &fields, PlyFormat format)
{
  check(path, mesh, fields);
  const bool is_text = format == PlyFormat::TEXT;
  std::string content = std::string("ply\nformat ") + (is_text ? "ascii" : "binary_little_endian") +
      " 1.0\nelement vertex " + std::to_string(mesh.points.size()) +
      "\nproperty double x\nproperty double y\nproperty double z\n";
  for (const std::string &name : ply_names(path, fields))
    content += "property double " + name + "\n";
  content += "element face " + std::to_string(mesh.faces.size()) +
      "\nproperty list uchar int vertex_indices\nend_header\n";

  for (size_t v = 0; v < mesh.points.size(); ++v) {
    if (is_text) {
      append_line(content, mesh.points[v]);
      for (const auto &[name, values] : fields) {
        content += ' ';
        append_number(content, values[v]);
      }
      content += '\n';
    } else {
      for (int k = 0; k < 3; ++k) append_little_endian(content, mesh.points[v][k]);
      for (const auto &[name, values] : fields) append_little_endian(content, values[v]);
    }
  }
  for (const Face &face : mesh.faces) {
    if (is_text) {
      append_line(content, face);
    } else {
      content += '\3';
      for (int v : face) append_little_endian(content, static_cast<int32_t>(v));
    }
  }
  write_whole_file(path, content);
}

/* ----------------------------------------------------------------------
   Base64 rather than text, appended or compressed data: the one encoding that all versions of
   ParaView and OVITO read, and exact. OVITO wants the elements in this order.
------------------------------------------------------------------------- */

void Membrane_NS::write_vtp(const std::string &path, const TriangleMesh &mesh,
                            const PointFields &fields)
{
  check(path, mesh, fields);
  const MeshDrawing drawing = cut_open(mesh);

  std::vector<double> coordinates;
  coordinates.reserve(3 * drawing.mesh.points.size());
  for (const Vector3d &point : drawing.mesh.points)
    coordinates.insert(coordinates.end(), point.data(), point.data() + 3);
  std::vector<int32_t> connectivity, offsets;
  for (const Face &face : drawing.mesh.faces) {
    connectivity.insert(connectivity.end(), face.begin(), face.end());
    offsets.push_back(static_cast<int32_t>(connectivity.size()));
  }

  std::string xml = "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
                    "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  <PolyData>\n"
                    "    <Piece NumberOfPoints=\"" +
      std::to_string(drawing.mesh.points.size()) +
      "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
      std::to_string(drawing.mesh.faces.size()) + "\">\n";
  xml += fields.empty() ? "      <PointData>\n"
                        : "      <PointData Scalars=\"" + xml_escaped(fields[0].first) + "\">\n";
  for (const auto &[name, values] : fields) {
    std::vector<double> drawn;
    drawn.reserve(drawing.source.size());
    for (int v : drawing.source) drawn.push_back(values[v]);
    append_array(xml, "Float64", name, 1, drawn);
  }
  xml += "      </PointData>\n      <Points>\n";
  append_array(xml, "Float64", "Points", 3, coordinates);
  xml += "      </Points>\n      <Polys>\n";
  append_array(xml, "Int32", "connectivity", 1, connectivity);
  append_array(xml, "Int32", "offsets", 1, offsets);
  xml += "      </Polys>\n    </Piece>\n  </PolyData>\n</VTKFile>\n";
  write_whole_file(path, xml);
}
