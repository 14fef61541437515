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

#include "mesh_files.h"

#include "membrane_mesh_shapes.h"
#include "membrane_mesh_writer.h"

#include "gmock/gmock.h"

#include <cmath>
#include <cstdint>
#include <cstring>

using namespace Membrane_NS;
using Eigen::Vector3d;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

TEST(MeshWriter, WhatIsWrittenIsReadBackExactly)
{
  TriangleMesh mesh = icosphere(2, 1.0 / 3.0);
  mesh.points[0] = {1e-300, -0.1, 1e300};
  const PointFields fields = {{"mean curvature H", std::vector<double>(mesh.points.size(), 0.1)},
                              {"id", std::vector<double>(mesh.points.size(), 2.0)}};
  const std::string off = temp_path("w.off"), ply = temp_path("w.ply");
  auto expect_same = [&](const std::string &path) {
    const TriangleMesh read = read_mesh(path);
    EXPECT_EQ(read.points, mesh.points);
    EXPECT_EQ(read.faces, mesh.faces);
  };
  write_off(off, mesh, fields);
  expect_same(off);
  write_ply(ply, mesh, fields);
  expect_same(ply);
  EXPECT_THAT(content_of(ply), HasSubstr("property double mean_curvature_H\n"));
  write_ply(ply, mesh, fields, PlyFormat::TEXT);
  expect_same(ply);
  EXPECT_THAT(content_of(ply), HasSubstr(" 0.10000000000000001 2\n"));
}

namespace {

// the bytes of the first array of this name in a VTP file, without the length before them

std::string vtp_array(const std::string &xml, const std::string &name)
{
  const size_t tag = xml.find("Name=\"" + name + "\"");
  if (tag == std::string::npos) return "no array " + name;
  const size_t start = xml.find('\n', tag) + 1;
  const std::string text = xml.substr(start, xml.find('\n', start) - start);
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  for (size_t i = 0; i < text.size(); i += 4) {
    uint32_t group = 0;
    int valid = 0;
    for (size_t j = 0; j < 4; ++j) {
      const size_t digit = digits.find(text[i + j]);
      group = group << 6 | (digit == std::string::npos ? 0 : static_cast<uint32_t>(digit));
      valid += digit != std::string::npos;
    }
    for (int j = 0; j < valid - 1; ++j) bytes += static_cast<char>(group >> (16 - 8 * j));
  }
  uint64_t length = 0;
  for (int i = 7; i >= 0; --i) length = length << 8 | static_cast<unsigned char>(bytes[i]);
  EXPECT_EQ(length, bytes.size() - 8);
  return bytes.substr(8);
}

template <typename T> std::vector<T> numbers(const std::string &bytes)
{
  std::vector<T> values(bytes.size() / sizeof(T));    // of a little-endian machine
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

}    // namespace

TEST(MeshWriter, VtpHoldsPointsTrianglesAndFields)
{
  const TriangleMesh mesh = icosphere(1, 1.5);
  std::vector<double> height;
  for (const Vector3d &p : mesh.points) height.push_back(p[2]);
  const std::string path = temp_path("w.vtp");
  write_vtp(path, mesh, {{"a<b & \"c\"", height}, {"H", height}});
  const std::string xml = content_of(path);
  EXPECT_THAT(xml, StartsWith("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\""));
  EXPECT_THAT(xml, HasSubstr("NumberOfPoints=\"42\""));
  EXPECT_THAT(xml, HasSubstr("NumberOfPolys=\"80\""));
  EXPECT_THAT(xml, HasSubstr("<PointData Scalars=\"a&lt;b &amp; &quot;c&quot;\">"));
  EXPECT_EQ(numbers<double>(vtp_array(xml, "H")), height);
  const std::vector<double> points = numbers<double>(vtp_array(xml, "Points"));
  const std::vector<int32_t> corners = numbers<int32_t>(vtp_array(xml, "connectivity"));
  const std::vector<int32_t> offsets = numbers<int32_t>(vtp_array(xml, "offsets"));
  ASSERT_EQ(points.size(), 3 * 42u);
  ASSERT_EQ(corners.size(), 3 * 80u);
  ASSERT_EQ(offsets.size(), 80u);
  for (int i = 0; i < 126; ++i) EXPECT_EQ(points[i], mesh.points[i / 3][i % 3]);
  for (int i = 0; i < 240; ++i) EXPECT_EQ(corners[i], mesh.faces[i / 3][i % 3]);
  for (int f = 0; f < 80; ++f) EXPECT_EQ(offsets[f], 3 * (f + 1));
}

TEST(MeshWriter, VtpDrawsNothingAcrossAPeriodicBox)
{
  Eigen::Matrix3d lattice = Eigen::Vector3d(6.0, 5.0, 4.0).asDiagonal();
  lattice(0, 1) = 1.0;
  const TriangleMesh mesh = sheet(6, 6, lattice, 0.5);
  std::vector<double> number;
  for (size_t v = 0; v < mesh.points.size(); ++v) number.push_back(static_cast<double>(v));
  const std::string path = temp_path("p.vtp");
  write_vtp(path, mesh, {{"number", number}});
  const std::string xml = content_of(path);
  const std::vector<double> points = numbers<double>(vtp_array(xml, "Points"));
  const std::vector<double> field = numbers<double>(vtp_array(xml, "number"));
  const std::vector<int32_t> corners = numbers<int32_t>(vtp_array(xml, "connectivity"));
  ASSERT_EQ(points.size(), 3 * field.size());
  EXPECT_GT(field.size(), 36u);
  EXPECT_LT(field.size(), 72u);    // images are shared by the faces around them
  for (size_t i = 0; i < corners.size(); ++i) {
    const int v = corners[i], w = corners[i % 3 == 2 ? i - 2 : i + 1];
    EXPECT_EQ(static_cast<int>(field[v]), mesh.faces[i / 3][i % 3]);
    const Vector3d p(&points[3 * v]), q(&points[3 * w]);
    const int a = static_cast<int>(field[v]), b = static_cast<int>(field[w]);
    EXPECT_LT((q - p - mesh.edge(a, b)).norm(), 1e-14);
  }
}

TEST(MeshWriter, RejectsFieldsThatDoNotFit)
{
  auto error_of = [](const TriangleMesh &mesh, const PointFields &fields) -> std::string {
    try {
      write_ply(temp_path("bad.ply"), mesh, fields);
    } catch (const MeshError &error) {
      return error.what();
    }
    return "no error";
  };
  TriangleMesh mesh = tetrahedron();
  EXPECT_THAT(error_of(mesh, {{"H", {1, 2, 3}}}), HasSubstr("'H' has 3 values for 4 vertices"));
  EXPECT_THAT(error_of(mesh, {{"H", {1, 2, std::nan(""), 4}}}), HasSubstr("at vertex 2"));
  EXPECT_THAT(error_of(mesh, {{"x", {1, 2, 3, 4}}}), HasSubstr("name of another"));
  mesh.points[3][0] = std::nan("");
  EXPECT_THAT(error_of(mesh, {}), HasSubstr("vertex 3 is not finite"));
}

TEST(MeshWriter, ReportsFilesItCannotWrite)
{
  const std::string nowhere = temp_path("no/such/folder/a.off");
  for (auto write : {&write_off, &write_vtp}) {
    try {
      write(nowhere, tetrahedron(), {});
      ADD_FAILURE();
    } catch (const MeshError &error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr(nowhere), HasSubstr("cannot be opened")));
    }
  }
}

TEST(MeshWriter, ReportsAFullDisk)
{
  const std::string full = "/dev/full";
  if (!std::ifstream(full)) GTEST_SKIP() << "this system has no " << full;
  for (int level : {0, 4}) {    // small ones fail when closed, large ones when written
    try {
      write_off(full, icosphere(level, 1.0));
      ADD_FAILURE();
    } catch (const MeshError &error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr(full), HasSubstr("No space left")));
    }
  }
}
