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

#include "membrane_mesh_text.h"

#include "membrane_mesh_bytes.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <unordered_map>

using namespace Membrane_NS;
using Eigen::Vector3d;

namespace {

// a binary file is 80 bytes of anything, a count, and 50 bytes a facet: normal, corners, colour

constexpr size_t BINARY_HEADER = 84, BINARY_FACET = 50;

constexpr double WELD_TOLERANCE = 1e-6;    // of the diagonal of the bounding box

/* ----------------------------------------------------------------------
   finds the vertex at a position, or makes one: first by equality, then within the tolerance,
   by cells of that size, so that a vertex closer than it lies in the same or a neighbouring cell
------------------------------------------------------------------------- */

class Welder {
 public:
  Welder(const Vector3d &origin, double tolerance, std::vector<Vector3d> &points) :
      origin_(origin), tolerance_(tolerance), points_(points)
  {
  }

  int vertex_at(const Vector3d &corner)
  {
    const Key exact = {corner[0] + 0.0, corner[1] + 0.0, corner[2] + 0.0};    // -0 is 0
    const auto known = exact_.find(exact);
    if (known != exact_.end()) return known->second;
    int v = find_near(corner);
    if (v < 0) {
      v = static_cast<int>(points_.size());
      points_.push_back(corner);
      cells_.emplace(cell(corner, 0, 0, 0), v);
    }
    exact_.emplace(exact, v);
    return v;
  }

 private:
  using Key = std::array<double, 3>;
  struct Hash {
    size_t operator()(const Key &key) const
    {
      size_t sum = 0;
      for (double x : key) sum = sum * 1000003u + std::hash<double>()(x);
      return sum;
    }
  };

  Vector3d origin_;
  double tolerance_;
  std::vector<Vector3d> &points_;
  std::unordered_map<Key, int, Hash> exact_;
  std::unordered_multimap<uint64_t, int> cells_;

  // cell numbers stay below 1/WELD_TOLERANCE + 2, which is less than 2^21

  uint64_t cell(const Vector3d &point, int dx, int dy, int dz) const
  {
    const Vector3d scaled = (point - origin_) / tolerance_;
    auto index = [](double x, int d) {
      return static_cast<uint64_t>(x + 1.0) + d;
    };
    return index(scaled[0], dx) << 42 ^ index(scaled[1], dy) << 21 ^ index(scaled[2], dz);
  }

  int find_near(const Vector3d &corner) const
  {
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dz = -1; dz <= 1; ++dz) {
          const auto range = cells_.equal_range(cell(corner, dx, dy, dz));
          for (auto it = range.first; it != range.second; ++it)
            if ((points_[it->second] - corner).norm() <= tolerance_) return it->second;
        }
    return -1;
  }
};

/// Corners in threes to vertices and faces; facets whose corners are not distinct are left out.
TriangleMesh weld(const std::string &path, const std::vector<Vector3d> &corners)
{
  TriangleMesh mesh;
  if (corners.empty()) return mesh;
  Vector3d low = corners[0], high = corners[0];
  for (const Vector3d &corner : corners) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const double tolerance = WELD_TOLERANCE * (high - low).norm();
  if (!std::isnormal(tolerance))
    mesh_file_error(path, 0, "the corners all coincide or lie too far apart; rescale the mesh");

  Welder welder(low, tolerance, mesh.points);
  for (size_t i = 0; i < corners.size(); i += 3) {
    Face face;
    for (int k = 0; k < 3; ++k) face[k] = welder.vertex_at(corners[i + k]);
    if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) mesh.faces.push_back(face);
  }
  return mesh;
}

/* ---------------------------------------------------------------------- */

std::vector<Vector3d> read_binary(const std::string &path, std::string_view content)
{
  const size_t num_facets = load<uint32_t>(&content[80], false);
  std::vector<Vector3d> corners;
  corners.reserve(3 * num_facets);
  for (size_t f = 0; f < num_facets; ++f)
    for (int k = 1; k <= 3; ++k) {
      const char *data = &content[BINARY_HEADER + BINARY_FACET * f + 12 * k];
      corners.emplace_back(load<float>(data, false), load<float>(data + 4, false),
                           load<float>(data + 8, false));
      if (!corners.back().allFinite())
        mesh_file_error(path, 0,
                        "a coordinate of facet " + std::to_string(f) +
                            " is not finite; correct it or export the mesh again");
    }
  return corners;
}

/* ----------------------------------------------------------------------
   solid NAME / facet normal x y z / outer loop / vertex x y z (three times) / endloop / endfacet /
   endsolid NAME; in any case of letters, any number of solids. Normals follow from the corners.
------------------------------------------------------------------------- */

std::vector<Vector3d> read_text(const std::string &path, std::string_view content)
{
  static const char *const order[] = {"facet",  "outer",   "vertex",  "vertex",
                                      "vertex", "endloop", "endfacet"};
  constexpr int OUTSIDE = -1, NEXT_FACET = 0, THIRD_CORNER_DONE = 5, LAST = 6;

  MeshText text(path, content, '\0');
  std::vector<Vector3d> corners;
  int expected = OUTSIDE;
  while (text.next_line()) {
    std::string word(text[0]);
    std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) {
      return std::tolower(c);
    });
    if (expected == OUTSIDE && word == "solid") {
      expected = NEXT_FACET;
    } else if (expected == NEXT_FACET && word == "endsolid") {
      expected = OUTSIDE;
    } else if (expected == THIRD_CORNER_DONE && word == "vertex") {
      text.fail("a facet with more than 3 corners; triangulate the mesh");
    } else if (expected == OUTSIDE || word != order[expected]) {
      text.fail("found " + quoted(text[0]) + " where " +
                quoted(expected == OUTSIDE ? "solid" : order[expected]) +
                " should be; export the mesh again");
    } else {
      if (word == "vertex") corners.push_back(text.point(1));
      expected = expected == LAST ? NEXT_FACET : expected + 1;
    }
  }
  if (expected != OUTSIDE)
    text.fail("the file ends without endsolid: it is truncated; export it again");
  return corners;
}

}    // namespace

/* ----------------------------------------------------------------------
   binary files may begin with the word solid too, but the length of the file tells: in a text
   file the four bytes of the count would be text, and announce more than 8 gigabytes
------------------------------------------------------------------------- */

TriangleMesh Membrane_NS::read_stl(const std::string &path, std::string_view content)
{
  size_t binary_size = 0;
  if (content.size() >= BINARY_HEADER)
    binary_size = BINARY_HEADER + BINARY_FACET * size_t(load<uint32_t>(&content[80], false));
  if (content.size() == binary_size) return weld(path, read_binary(path, content));

  const size_t first = content.find_first_not_of(" \t\r\n");
  const std::string_view start = content.substr(std::min(first, content.size()), 5);
  const bool is_text = (start == "solid" || start == "SOLID" || start == "Solid") &&
      content.find('\0') == std::string_view::npos;
  if (is_text) return weld(path, read_text(path, content));

  if (binary_size == 0)
    mesh_file_error(path, 0,
                    "neither begins with solid nor has the 84 bytes of a binary header: it is "
                    "truncated or no STL file; export it again");
  mesh_file_error(path, 0,
                  "its facet count announces " + std::to_string(binary_size) +
                      " bytes, but it has " + std::to_string(content.size()) +
                      ": it is truncated or no STL file; export it again");
}
