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

#include "gmock/gmock.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <sstream>

using namespace Membrane_NS;
using Eigen::Vector3d;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

namespace {

/// The message about this content, checked to be one line that begins with the file.
std::string error_about(const std::string &name, const std::string &content)
{
  const std::string path = write_temp(name, content);
  try {
    read_mesh(path);
  } catch (const MeshError &error) {
    const std::string message = error.what();
    EXPECT_THAT(message, StartsWith("Mesh file " + path));
    EXPECT_THAT(message, Not(HasSubstr("\n")));
    EXPECT_THAT(message, HasSubstr(";")) << "no cure: " << message;
    return message;
  }
  return "no error";
}

// === The tetrahedron in every format

const std::string OFF = "OFF\n4 4 6\n1 1 1.5\n-1 -1 1\n-1 1 -1\n1 -1 -1\n"
                        "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

const std::string OBJ = "v 1 1 1.5\nv -1 -1 1\nv -1 1 -1\nv 1 -1 -1\n"
                        "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

const std::string PLY_TEXT = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                             "property float y\nproperty float z\nelement face 4\n"
                             "property list uchar int vertex_indices\nend_header\n"
                             "1 1 1.5\n-1 -1 1\n-1 1 -1\n1 -1 -1\n"
                             "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

template <typename T> void put(std::string &bytes, T value, bool big_endian)
{
  char data[sizeof(T)];
  std::memcpy(data, &value, sizeof(T));
  const uint16_t probe = 1;
  const bool machine_is_big = *reinterpret_cast<const unsigned char *>(&probe) == 0;
  if (machine_is_big != big_endian) std::reverse(data, data + sizeof(T));
  bytes.append(data, sizeof(T));
}

// properties in an odd order and of all types, lists to skip, an element before and one between

std::string ply_binary(bool big_endian)
{
  std::string ply = std::string("ply\r\nformat binary_") + (big_endian ? "big" : "little") +
      "_endian 1.0\r\ncomment made by hand\r\nobj_info nothing\r\n"
      "element camera 2\r\nproperty char a\r\nproperty list ushort double b\r\n"
      "element vertex 4\r\nproperty uint8 red\r\nproperty float64 z\r\n"
      "property list uint8 int16 extra\r\nproperty float x\r\nproperty short y\r\n"
      "element edge 1\r\nproperty int vertex1\r\nproperty uint32 vertex2\r\n"
      "element face 4\r\nproperty uint16 flags\r\nproperty list int8 uint vertex_index\r\n"
      "property list uchar float texcoord\r\nend_header\r\n";
  for (int i = 0; i < 2; ++i) {
    put<int8_t>(ply, -1, big_endian);
    put<uint16_t>(ply, 3, big_endian);
    for (int j = 0; j < 3; ++j) put<double>(ply, 0.1 * j, big_endian);
  }
  for (const Vector3d &p : POINTS) {
    put<uint8_t>(ply, 200, big_endian);
    put<double>(ply, p[2], big_endian);
    put<uint8_t>(ply, 2, big_endian);
    for (int j = 0; j < 2; ++j) put<int16_t>(ply, -300, big_endian);
    put<float>(ply, static_cast<float>(p[0]), big_endian);
    put<int16_t>(ply, static_cast<int16_t>(p[1]), big_endian);
  }
  put<int32_t>(ply, 0, big_endian);
  put<uint32_t>(ply, 1, big_endian);
  for (const Face &face : FACES) {
    put<uint16_t>(ply, 65535, big_endian);
    put<int8_t>(ply, 3, big_endian);
    for (int v : face) put<uint32_t>(ply, v, big_endian);
    put<uint8_t>(ply, 6, big_endian);
    for (int j = 0; j < 6; ++j) put<float>(ply, 0.5f, big_endian);
  }
  return ply;
}

std::string stl_text(const TriangleMesh &mesh)
{
  std::ostringstream stl;
  stl.precision(9);
  stl << "solid a name with facet in it\n";
  for (const Face &face : mesh.faces) {
    stl << "  facet normal nan nan nan\n    outer loop\n";
    for (int v : face) stl << "      vertex " << mesh.points[v].transpose() << "\n";
    stl << "    endloop\n  endfacet\n";
  }
  stl << "endsolid a name with facet in it\n";
  return stl.str();
}

std::string stl_binary(const TriangleMesh &mesh, const std::string &title)
{
  std::string stl = title;
  stl.resize(80, ' ');
  put<uint32_t>(stl, static_cast<uint32_t>(mesh.faces.size()), false);
  for (const Face &face : mesh.faces) {
    for (int k = 0; k < 3; ++k) put<float>(stl, std::numeric_limits<float>::quiet_NaN(), false);
    for (int v : face)
      for (int k = 0; k < 3; ++k) put<float>(stl, static_cast<float>(mesh.points[v][k]), false);
    put<uint16_t>(stl, 0, false);
  }
  return stl;
}

void expect_tetrahedron(const TriangleMesh &mesh)
{
  EXPECT_EQ(mesh.points, POINTS);
  EXPECT_EQ(mesh.faces, FACES);
  EXPECT_FALSE(mesh.is_periodic());
}

// STL numbers its vertices in the order of the facets: compare positions of corners

void expect_same_corners(const TriangleMesh &mesh, const TriangleMesh &expected, double tolerance)
{
  ASSERT_EQ(mesh.points.size(), expected.points.size());
  ASSERT_EQ(mesh.faces.size(), expected.faces.size());
  for (size_t f = 0; f < mesh.faces.size(); ++f)
    for (int k = 0; k < 3; ++k)
      ASSERT_LE((mesh.points[mesh.faces[f][k]] - expected.points[expected.faces[f][k]]).norm(),
                tolerance);
}

std::string with(std::string text, const std::string &old_text, const std::string &new_text)
{
  const size_t at = text.find(old_text);
  EXPECT_NE(at, std::string::npos) << old_text;
  return text.replace(at, old_text.size(), new_text);
}

}    // namespace

// === OFF

TEST(MeshFile, ReadsOff)
{
  expect_tetrahedron(read_content("a.off", OFF));
}

TEST(MeshFile, ReadsOffHoweverItsHeaderIsWritten)
{
  expect_tetrahedron(read_content("a.off", with(OFF, "OFF\n4 4 6", "OFF 4 4 6")));
  expect_tetrahedron(read_content("a.off", with(OFF, "OFF\n4 4 6", "OFF4 4 6")));
  expect_tetrahedron(read_content("a.off", with(OFF, "4 4 6", "4 4")));
  expect_tetrahedron(read_content(
      "a.OFF", with(OFF, "OFF\n4 4 6", "# a\n\n  OFF # b\n\n# c\n 4\t4 0 # d\n\n# e")));
  expect_tetrahedron(read_content("a.off", "\xEF\xBB\xBF" + OFF));
  expect_tetrahedron(read_content("a.off", with(OFF, "OFF\n", "")));
  expect_tetrahedron(read_content("a.off", with(OFF, "OFF\n4 4 6", "# a\n4 4")));
}

TEST(MeshFile, ReadsOffWithDosLinesAndNoLastNewline)
{
  std::string dos;
  for (char c : OFF) dos += c == '\n' ? std::string("\r\n") : std::string(1, c);
  dos.resize(dos.size() - 2);
  expect_tetrahedron(read_content("a.off", dos));
}

TEST(MeshFile, LeavesOutColoursAndNormalsOfOff)
{
  std::string coff = with(OFF, "OFF", "COFF");
  coff = with(coff, "1 1 1.5\n", "1 1 1.5 255 0 0 255\n");
  coff = with(coff, "3 0 2 1\n", "3 0 2 1 0.5 0.5 0.5\n");
  expect_tetrahedron(read_content("a.off", coff));
  expect_tetrahedron(read_content("a.off", with(with(OFF, "OFF", "NOFF"), "1.5\n", "1.5 0 0 1\n")));
}

TEST(MeshFile, ReadsNumbersInEveryNotation)
{
  const std::string off = with(with(OFF, "1 1 1.5", "+1 10.0E-1 +.15e1"), "3 0 2 1", "+3 0 +2 1");
  expect_tetrahedron(read_content("a.off", off));
}

TEST(MeshFile, RejectsOffThatIsNotOff)
{
  EXPECT_THAT(error_about("a.off", with(OFF, "OFF\n4 4 6", "4 points")),
              AllOf(HasSubstr("begins with '4'"), HasSubstr("neither with the word OFF")));
  EXPECT_THAT(error_about("a.off", with(OFF, "OFF", "4OFF")), HasSubstr("three dimensions"));
  EXPECT_THAT(error_about("a.off", with(OFF, "OFF", "OFF BINARY")), HasSubstr("binary OFF"));
  EXPECT_THAT(error_about("a.off", "# only a comment\n"), HasSubstr("comments only"));
}

TEST(MeshFile, RejectsTruncatedOff)
{
  EXPECT_THAT(error_about("a.off", "OFF\n"), HasSubstr("counts"));
  EXPECT_THAT(error_about("a.off", "OFF\n4\n"), AllOf(HasSubstr("line 2"), HasSubstr("counts")));
  EXPECT_THAT(error_about("a.off", OFF.substr(0, OFF.find("1 -1 -1"))),
              HasSubstr("ends after 3 of 4 vertices"));
  EXPECT_THAT(error_about("a.off", OFF.substr(0, OFF.find("3 1 2 3"))),
              HasSubstr("ends after 3 of 4 faces"));
}

TEST(MeshFile, RejectsOffWithWrongCounts)
{
  EXPECT_THAT(error_about("a.off", with(OFF, "4 4 6", "4 3 6")),
              AllOf(HasSubstr("line 10"), HasSubstr("correct the counts")));
  EXPECT_THAT(error_about("a.off", with(OFF, "4 4 6", "3 5 6")),
              AllOf(HasSubstr("line 6"), HasSubstr("1 corners")));
  EXPECT_THAT(error_about("a.off", with(OFF, "4 4 6", "-4 4 6")), HasSubstr("'-4'"));
  EXPECT_THAT(error_about("a.off", with(OFF, "4 4 6", "4 4294967297 6")),
              HasSubstr("'4294967297'"));
  EXPECT_THAT(error_about("a.off", with(OFF, "4 4 6", "2147483647 4 6")),
              AllOf(HasSubstr("of 2147483647 vertices"), HasSubstr("truncated")));
}

TEST(MeshFile, RejectsBadNumbersInOff)
{
  EXPECT_THAT(error_about("a.off", with(OFF, "1.5", "1,5")),
              AllOf(HasSubstr("line 3"), HasSubstr("'1,5' is not a number")));
  EXPECT_THAT(error_about("a.off", with(OFF, "1.5", "nan")), HasSubstr("'nan' is not finite"));
  EXPECT_THAT(error_about("a.off", with(OFF, "1.5", "-inf")), HasSubstr("'-inf' is not finite"));
  EXPECT_THAT(error_about("a.off", with(OFF, "1.5", "")), HasSubstr("needs 3 coordinates"));
  EXPECT_THAT(error_about("a.off", with(OFF, "3 0 2 1", "3 0 2.5 1")),
              AllOf(HasSubstr("line 7"), HasSubstr("'2.5' is not an integer")));
  EXPECT_THAT(error_about("a.off", with(OFF, "1.5", std::string(1, '\1') + "x")),
              HasSubstr("'?x'"));
}

TEST(MeshFile, RejectsBadFacesInOff)
{
  EXPECT_THAT(error_about("a.off", with(OFF, "3 0 2 1", "2 0 2")),
              AllOf(HasSubstr("line 7"), HasSubstr("2 corners"), HasSubstr("3 or more")));
  EXPECT_THAT(error_about("a.off", with(OFF, "3 0 2 1", "2147483647 0 2 1")),
              AllOf(HasSubstr("line 7"), HasSubstr("needs 2147483647 corners")));
  EXPECT_THAT(error_about("a.off", with(OFF, "3 0 2 1", "3 0 2 4")),
              AllOf(HasSubstr("line 7"), HasSubstr("corner 4 is not one of the 4 vertices")));
  EXPECT_THAT(error_about("a.off", with(OFF, "3 0 2 1", "3 0 2 -1")), HasSubstr("corner -1"));
  EXPECT_THAT(error_about("a.off", with(OFF, "3 0 2 1", "3 0 2")), HasSubstr("needs 3 corners"));
}

// === PLY

TEST(MeshFile, ReadsTextPly)
{
  expect_tetrahedron(read_content("a.ply", PLY_TEXT));
}

TEST(MeshFile, ReadsTextPlyWithExtraElementsAndProperties)
{
  std::string ply = with(PLY_TEXT, "element vertex 4\nproperty float x\n",
                         "comment no\nelement camera 1\nproperty list uchar int a\n"
                         "property float b\nelement nothing 5\n"
                         "element vertex 4\nproperty list int float w\nproperty double x\n");
  ply = with(ply, "end_header\n1 1 1.5\n-1 -1 1\n-1 1 -1\n1 -1 -1\n",
             "element user 1\nproperty int u\nend_header\n2 7 8 0.5\n1 9 1 1 1.5\n0 -1 -1 1\n"
             "2 1 2 -1 1 -1\n0 1 -1 -1\n");
  expect_tetrahedron(read_content("a.ply", ply + "17\n"));
}

TEST(MeshFile, ReadsBinaryPlyOfBothByteOrders)
{
  expect_tetrahedron(read_content("a.ply", ply_binary(false)));
  expect_tetrahedron(read_content("a.ply", ply_binary(true)));
}

TEST(MeshFile, RejectsTruncatedPly)
{
  EXPECT_THAT(error_about("a.ply", PLY_TEXT.substr(0, PLY_TEXT.find("end_header"))),
              HasSubstr("no end_header"));
  EXPECT_THAT(error_about("a.ply", PLY_TEXT.substr(0, PLY_TEXT.find("1 -1 -1"))),
              HasSubstr("ends in 'vertex' 3 of 4"));
  EXPECT_THAT(error_about("a.ply", PLY_TEXT.substr(0, PLY_TEXT.find("3 1 2 3"))),
              HasSubstr("ends in 'face' 3 of 4"));
  const std::string binary = ply_binary(true);
  EXPECT_THAT(error_about("a.ply", binary.substr(0, binary.size() - 1)),
              HasSubstr("ends in 'face' 3 of 4"));
}

TEST(MeshFile, RejectsPlyWithWrongCounts)
{
  EXPECT_THAT(error_about("a.ply", with(PLY_TEXT, "face 4", "face 3")),
              AllOf(HasSubstr("line 17"), HasSubstr("counts of the header")));
  EXPECT_THAT(error_about("a.ply", with(PLY_TEXT, "vertex 4", "vertex 3")),
              AllOf(HasSubstr("line 13"), HasSubstr("face 0 has 1 corners")));
  EXPECT_THAT(error_about("a.ply", with(PLY_TEXT, "vertex 4", "vertex -4")), HasSubstr("'-4'"));
  EXPECT_THAT(error_about("a.ply", with(ply_binary(false), "vertex 4", "vertex 2147483647")),
              HasSubstr("of 2147483647"));
  EXPECT_THAT(error_about("a.ply", ply_binary(false) + '\0'), HasSubstr("more after the last"));
}

TEST(MeshFile, RejectsBadPlyHeaders)
{
  EXPECT_THAT(error_about("a.ply", "#" + PLY_TEXT), HasSubstr("word ply is missing"));
  EXPECT_THAT(error_about("a.ply", with(PLY_TEXT, "float x", "quad x")), HasSubstr("'quad'"));
  EXPECT_THAT(error_about("a.ply", with(PLY_TEXT, "ascii", "zip")), HasSubstr("'zip'"));
  EXPECT_THAT(error_about("a.ply", with(PLY_TEXT, "format ascii 1.0\n", "")),
              HasSubstr("no format line"));
  EXPECT_THAT(error_about("a.ply", with(PLY_TEXT, "float y", "float why")),
              HasSubstr("vertex property y"));
  EXPECT_THAT(error_about("a.ply", with(PLY_TEXT, "float y", "float x")),
              HasSubstr("vertex property x once"));
  EXPECT_THAT(error_about("a.ply", with(PLY_TEXT, "vertex_indices", "corners")),
              HasSubstr("face property vertex_indices"));
  EXPECT_THAT(error_about("a.ply", with(PLY_TEXT, "element face", "element vertex")),
              HasSubstr("second element 'vertex'"));
  EXPECT_THAT(error_about("a.ply", with(PLY_TEXT, "property float x", "property x")),
              AllOf(HasSubstr("line 4"), HasSubstr("'property'")));
}

TEST(MeshFile, RejectsBadValuesInPly)
{
  EXPECT_THAT(error_about("a.ply", with(PLY_TEXT, "1 1 1.5", "1 1 one")),
              AllOf(HasSubstr("line 10"), HasSubstr("vertex 0 has 'one'")));
  EXPECT_THAT(error_about("a.ply", with(PLY_TEXT, "1 1 1.5", "1 1 inf")),
              HasSubstr("vertex 0 has a coordinate that is not finite"));
  EXPECT_THAT(error_about("a.ply", with(PLY_TEXT, "1 1 1.5", "1 1")),
              HasSubstr("vertex 0 has too few values"));
  EXPECT_THAT(error_about("a.ply", with(PLY_TEXT, "1 1 1.5", "1 1 1.5 2")),
              HasSubstr("vertex 0 has more values"));
  EXPECT_THAT(error_about("a.ply", with(PLY_TEXT, "3 0 2 1", "2 0 2")),
              AllOf(HasSubstr("line 14"), HasSubstr("2 corners"), HasSubstr("3 or more")));
  EXPECT_THAT(error_about("a.ply", with(PLY_TEXT, "3 0 2 1", "3 0 2 4")),
              AllOf(HasSubstr("face 0"), HasSubstr("corner 4"), HasSubstr("below 4")));
  EXPECT_THAT(error_about("a.ply", with(PLY_TEXT, "3 0 2 1", "3 0 2 -1")), HasSubstr("corner -1"));
  EXPECT_THAT(error_about("a.ply", with(PLY_TEXT, "3 0 2 1", "3 0 2 nan")), HasSubstr("corner"));
  EXPECT_THAT(error_about("a.ply", with(PLY_TEXT, "3 0 2 1", "-3 0 2 1")),
              HasSubstr("corner count -3"));
}

// === OBJ

TEST(MeshFile, ReadsObj)
{
  expect_tetrahedron(read_content("a.obj", OBJ));
}

TEST(MeshFile, ReadsObjWithEverythingElseInIt)
{
  expect_tetrahedron(read_content(
      "a.obj",
      "# comment\nmtllib a.mtl\no thing\nv 1 1 1.5 1.0\nv -1 -1 1 0.5 0.5 0.5\nvt 0 0\nvn 0 0 1\n"
      "f 1 3 2\nv -1 1 -1 # a comment\nv 1 -1 -1\nusemtl x\ns off\nf 1/1 2/1 4/1\n"
      "f 1/1/1 4/1/1 3/1/1\nl 1 2\nf -3//1 -2//1 -1//1\n"));
}

TEST(MeshFile, RejectsBadObj)
{
  EXPECT_THAT(error_about("a.obj", with(OBJ, "f 1 3 2", "f 1 3")),
              AllOf(HasSubstr("line 5"), HasSubstr("2 corners"), HasSubstr("3 or more")));
  for (const char *corner : {"0", "-5", "x", "/1", "1.5", "2147483648"})
    EXPECT_THAT(error_about("a.obj", with(OBJ, "f 1 3 2", std::string("f 1 3 ") + corner)),
                AllOf(HasSubstr("line 5"), HasSubstr(std::string("corner '") + corner)));
  EXPECT_THAT(error_about("a.obj", with(OBJ, "f 1 3 2", "f 1 3 5")),
              AllOf(HasSubstr("line 5"), HasSubstr("corner 5 is not one of the 4 vertices")));
  EXPECT_THAT(error_about("a.obj", with(OBJ, "1.5", "abc")),
              AllOf(HasSubstr("line 1"), HasSubstr("'abc'")));
  EXPECT_THAT(error_about("a.obj", with(OBJ, " 1.5", "")), HasSubstr("needs 3 coordinates"));
  EXPECT_THAT(error_about("a.obj", with(OBJ, "1.5", "1e999")), HasSubstr("1e999"));
}

// === STL

TEST(MeshFile, ReadsTextAndBinaryStl)
{
  const TriangleMesh mesh = icosphere(2, 3.0);
  expect_same_corners(read_content("a.stl", stl_text(mesh)), mesh, 1e-8);
  expect_same_corners(read_content("a.stl", stl_binary(mesh, "some program")), mesh, 1e-6);
}

TEST(MeshFile, TellsBinaryStlByItsLengthEvenIfItBeginsWithSolid)
{
  expect_same_corners(read_content("a.stl", stl_binary(tetrahedron(), "solid facet normal")),
                      tetrahedron(), 0.0);
}

TEST(MeshFile, StlMayHoldSeveralSolidsInCapitals)
{
  std::string stl = stl_text(tetrahedron());
  for (char &c : stl) c = static_cast<char>(std::toupper(c));
  stl = with(stl, "NORMAL", "normal");
  TriangleMesh far = tetrahedron(), both = tetrahedron();
  for (Vector3d &p : far.points) p[0] += 10.0;
  for (const Vector3d &p : far.points) both.points.push_back(p);
  for (const Face &face : FACES) both.faces.push_back({face[0] + 4, face[1] + 4, face[2] + 4});
  expect_same_corners(read_content("a.stl", stl + stl_text(far)), both, 0.0);
}

TEST(MeshFile, WeldsStlCornersThatRoundingSetApart)
{
  const TriangleMesh mesh = icosphere(3, 1.0);
  std::string stl = "solid\n";
  unsigned long long state = 1;
  for (const Face &face : mesh.faces) {
    stl += "facet normal 0 0 0\nouter loop\n";
    for (int v : face) {
      stl += "vertex";
      for (int k = 0; k < 3; ++k) {
        state = state * 6364136223846793005ull + 1442695040888963407ull;
        const double error = 1e-7 * (static_cast<double>(state >> 11) / (1ull << 52) - 1.0);
        char number[32];
        std::snprintf(number, sizeof(number), " %.12f", mesh.points[v][k] + error);
        stl += number;
      }
      stl += "\n";
    }
    stl += "endloop\nendfacet\n";
  }
  const TriangleMesh read = read_content("a.stl", stl + "endsolid\n");
  expect_same_corners(read, mesh, 1e-6);
  EXPECT_NO_THROW(Topology(static_cast<int>(read.points.size()), read.faces));
}

TEST(MeshFile, LeavesOutStlFacetsThatCollapse)
{
  TriangleMesh mesh = tetrahedron();
  mesh.faces.push_back({0, 1, 1});
  EXPECT_EQ(read_content("a.stl", stl_text(mesh)).faces,
            read_content("b.stl", stl_text(tetrahedron())).faces);
}

TEST(MeshFile, RejectsTruncatedStl)
{
  const std::string text = stl_text(tetrahedron()), binary = stl_binary(tetrahedron(), "x");
  EXPECT_THAT(error_about("a.stl", text.substr(0, text.find("endsolid"))),
              HasSubstr("without endsolid"));
  EXPECT_THAT(error_about("a.stl", text.substr(0, text.rfind("vertex"))),
              HasSubstr("without endsolid"));
  EXPECT_THAT(error_about("a.stl", binary.substr(0, binary.size() - 1)),
              AllOf(HasSubstr("announces 284 bytes"), HasSubstr("has 283")));
  EXPECT_THAT(error_about("a.stl", binary.substr(0, 60)), HasSubstr("84 bytes"));
  EXPECT_THAT(error_about("a.stl", with(binary, std::string("\4\0\0\0", 4), "\xff\xff\xff\xff")),
              HasSubstr("announces 214748364834 bytes"));
}

TEST(MeshFile, RejectsBadStl)
{
  const std::string text = stl_text(tetrahedron());
  EXPECT_THAT(error_about("a.stl", with(text, "    endloop\n", "")),
              AllOf(HasSubstr("line 7"), HasSubstr("'vertex' or 'endloop' should be")));
  EXPECT_THAT(error_about("a.stl", with(text, "      vertex", "      facet")),
              AllOf(HasSubstr("line 4"), HasSubstr("'vertex' should be")));
  EXPECT_THAT(error_about("a.stl", with(text, "1.5", "x")), HasSubstr("'x' is not a number"));
  EXPECT_THAT(error_about("a.stl", with(text, "1.5", "inf")), HasSubstr("not finite"));
  EXPECT_THAT(error_about("a.stl", text + "facet normal 0 0 0\n"), HasSubstr("'solid' should be"));
  TriangleMesh mesh = tetrahedron();
  mesh.points[1][2] = std::numeric_limits<double>::infinity();
  EXPECT_THAT(error_about("a.stl", stl_binary(mesh, "x")), HasSubstr("facet 0 is not finite"));
  for (Vector3d &p : mesh.points) p = Vector3d(1, 2, 3);
  EXPECT_THAT(error_about("a.stl", stl_binary(mesh, "x")), HasSubstr("no faces with an area"));
}

// === Any format

TEST(MeshFile, RejectsMeshesWithoutFaces)
{
  EXPECT_THAT(error_about("a.off", "OFF\n0 0 0\n"), HasSubstr("no faces"));
  EXPECT_THAT(error_about("a.off", "OFF\n1 0 0\n0 0 0\n"), HasSubstr("no faces"));
  EXPECT_THAT(error_about("a.obj", "# nothing\n"), HasSubstr("no faces"));
  EXPECT_THAT(error_about("a.stl", "solid\nendsolid\n"), HasSubstr("no faces"));
  EXPECT_THAT(error_about("a.ply", "ply\nformat ascii 1.0\nend_header\n"), HasSubstr("no faces"));
  for (const char *name : {"a.off", "a.ply", "a.obj", "a.stl"})
    EXPECT_THAT(error_about(name, ""), HasSubstr("empty"));
}

TEST(MeshFile, RejectsFilesItCannotOpen)
{
  const std::string path = temp_path("does_not_exist.off");
  try {
    read_mesh(path);
    FAIL();
  } catch (const MeshError &error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr(path), HasSubstr("cannot be opened"), HasSubstr("No such file")));
  }
}

TEST(MeshFile, RejectsAFolder)
{
  const std::string path = temp_path("folder.ply");
  std::filesystem::create_directories(path);
  EXPECT_THROW(read_mesh(path), MeshError);
}

TEST(MeshFile, RejectsUnknownExtensions)
{
  EXPECT_THAT(error_about("a.vtk", OFF), AllOf(HasSubstr("'vtk'"), HasSubstr("*.off"), HasSubstr("*.mesh")));
  EXPECT_THAT(error_about("no_extension", OFF), HasSubstr("''"));
}

TEST(MeshFile, RejectsContentOfAnotherFormat)
{
  EXPECT_THAT(error_about("a.off", PLY_TEXT), AllOf(HasSubstr("like .ply"), HasSubstr("rename")));
  EXPECT_THAT(error_about("a.obj", with(OFF, "OFF", "COFF")), HasSubstr("like .off"));
  EXPECT_THAT(error_about("a.ply", stl_text(tetrahedron())), HasSubstr("like .stl"));
  EXPECT_THAT(error_about("a.stl", OFF), HasSubstr("no STL file"));
}
