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

// Mutations of a valid file of each format: what comes out is a mesh or a MeshError of one line, soon,
// and without memory that the file has no content for.

#include "count_allocations.h"
#include "how_many.h"
#include "mesh_files.h"

#include "gmock/gmock.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

using namespace Membrane_NS;
using Membrane_TEST::how_many;
using Membrane_TEST::largest_piece;

namespace {

// === Mutations

class Mutator {
 public:
  explicit Mutator(unsigned long long seed) : state_(seed) {}

  std::string mutate(std::string text)
  {
    for (size_t n = 1 + below(4); n > 0 && !text.empty(); --n) one_step(text);
    return text;
  }

 private:
  unsigned long long state_;

  size_t below(size_t n)
  {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<size_t>((state_ >> 33) % n);
  }

  std::string number()
  {
    static const char *const numbers[] = {"0",
                                          "-1",
                                          "1",
                                          "2",
                                          "3",
                                          "255",
                                          "65536",
                                          "2147483647",
                                          "2147483648",
                                          "-2147483648",
                                          "4294967295",
                                          "1e9",
                                          "nan",
                                          "-nan",
                                          "inf",
                                          "-inf",
                                          "1e308",
                                          "-1e308",
                                          "1e-320",
                                          "0.5",
                                          "1e999",
                                          "9223372036854775807",
                                          "99999999999999999999999999",
                                          "0x10",
                                          "1,5",
                                          ""};
    return numbers[below(std::size(numbers))];
  }

  void one_step(std::string &text)
  {
    const size_t at = below(text.size());
    const size_t length = 1 + below(std::min<size_t>(text.size() - at, below(8) ? 8 : text.size()));
    switch (below(9)) {
      case 0:    // a bit
        text[at] = static_cast<char>(text[at] ^ 1 << below(8));
        break;
      case 1:    // a byte
        text[at] = static_cast<char>(below(256));
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(below(text.size()), text.substr(at, length));
        break;
      case 4:
        text.resize(at);
        break;
      case 5:    // an integer of a binary file
        for (size_t k = 0; k < 4 && at + k < text.size(); ++k)
          text[at + k] = static_cast<char>(below(3) ? 0xff : 0);
        break;
      case 6:
        swap_lines(text, at);
        break;
      default:
        replace_number(text, at);
    }
  }

  // the next one behind, if there is one

  void replace_number(std::string &text, size_t at)
  {
    constexpr const char *digits = "-+.0123456789";
    const size_t start = text.find_first_of(digits, at);
    if (start == std::string::npos) return;
    const size_t end = std::min(text.find_first_not_of(digits, start), text.size());
    text.replace(start, end - start, number());
  }

  void swap_lines(std::string &text, size_t at)
  {
    const size_t middle = text.find('\n', at) + 1;    // npos + 1 = 0
    const size_t end = middle ? text.find('\n', middle) + 1 : 0;
    if (!middle || !end) return;
    const size_t before = at ? text.rfind('\n', at - 1) : std::string::npos;
    const size_t start = before == std::string::npos ? 0 : before + 1;
    std::rotate(text.begin() + start, text.begin() + middle, text.begin() + end);
  }
};

// === What has to hold of each

void check_mesh(const TriangleMesh &mesh, const std::string &content)
{
  ASSERT_LE(mesh.points.size(), content.size());
  ASSERT_LE(mesh.faces.size(), content.size());
  for (const Eigen::Vector3d &p : mesh.points) ASSERT_TRUE(p.allFinite());
  ASSERT_NO_THROW(Topology(static_cast<int>(mesh.points.size()), mesh.faces));
}

void check_message(const std::string &message, const std::string &path)
{
  ASSERT_EQ(message.find("Mesh file " + path), 0u) << message;
  ASSERT_LT(message.size(), 500u) << message;
  ASSERT_NE(message.find(';'), std::string::npos) << "no cure: " << message;
  for (char c : message) ASSERT_TRUE(c >= ' ' && c <= '~') << message;
}

class MeshFuzz : public testing::TestWithParam<const char *> {};

std::string name_of(const testing::TestParamInfo<const char *> &info)
{
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

}    // namespace

// With MEMBRANE_LONG a million mutations a format; MEMBRANE_FUZZ_SEED begins elsewhere. The content
// that fails is kept.

TEST_P(MeshFuzz, MutationsGiveAMeshOrAMeshError)
{
  const char *folder = std::getenv("REFERENCE"), *begin = std::getenv("MEMBRANE_FUZZ_SEED");
  ASSERT_NE(folder, nullptr);
  const std::string path = GetParam(), seed = content_of(std::string(folder) + "/seeds/" + path);
  ASSERT_FALSE(seed.empty());
  PeriodicBox box;
  box.lattice = Eigen::Vector3d(8.0, 8.0, 8.0).asDiagonal();
  box.periodic = {true, true, false};

  Mutator mutator(begin ? std::strtoull(begin, nullptr, 10) : 4711);
  const int trials = how_many(20000, 1000000);
  int meshes = 0;
  largest_piece = 0;
  for (int trial = 0; trial < trials && !HasFailure(); ++trial) {
    const std::string content = trial ? mutator.mutate(seed) : seed;
    MeshFileReport report;
    try {
      check_mesh(parse_mesh(path, content, box, report), content);
      ++meshes;
    } catch (const MeshError &error) {
      check_message(error.what(), path);
    } catch (const std::exception &error) {
      ADD_FAILURE() << error.what();
    }
    if (HasFailure()) std::ofstream("failed_" + path, std::ios::binary) << content;
  }
  RecordProperty("meshes", meshes);
  std::printf("%d mutations of %s: %d meshes, %d errors; the largest piece of memory %zu bytes\n",
              trials, path.c_str(), meshes, trials - meshes, largest_piece);
  EXPECT_GT(meshes, trials / 200);
  EXPECT_LT(meshes, trials / 2);
  EXPECT_LT(largest_piece, 1000000u);    // the files have some 1000 bytes
}

INSTANTIATE_TEST_SUITE_P(AllFormats, MeshFuzz,
                         testing::Values("box.off", "box.obj", "box_text.ply", "box_little.ply",
                                         "box_big.ply", "box_text.stl", "box_binary.stl",
                                         "box_ascii.vtp", "box_binary.vtp", "box.tsi", "box.mesh"),
                         name_of);
