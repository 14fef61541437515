/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

#ifndef MEMBRANE_TEST_MESH_FILES_H
#define MEMBRANE_TEST_MESH_FILES_H

// what the tests of the mesh readers and writers share

#include "membrane_mesh_file.h"

#include "gtest/gtest.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <unistd.h>

namespace Membrane_NS {

// === Files

// a folder of this process alone, removed in the end

class TempFolder : public testing::Environment {
 public:
  TempFolder() :
      path_(std::filesystem::path(testing::TempDir()) / ("mesh_file_" + std::to_string(getpid())))
  {
  }
  void SetUp() override { std::filesystem::create_directories(path_); }
  void TearDown() override { std::filesystem::remove_all(path_); }
  std::string file(const std::string &name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

inline const auto *const temp_folder =
    static_cast<TempFolder *>(testing::AddGlobalTestEnvironment(new TempFolder));

inline std::string temp_path(const std::string &name)
{
  return temp_folder->file(name);
}

inline std::string write_temp(const std::string &name, const std::string &content)
{
  const std::string path = temp_path(name);
  std::ofstream(path, std::ios::binary) << content;
  return path;
}

inline std::string content_of(const std::string &path)
{
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  content << file.rdbuf();
  return content.str();
}

inline TriangleMesh read_content(const std::string &name, const std::string &content)
{
  return read_mesh(write_temp(name, content));
}

// === A tetrahedron

inline const std::vector<Eigen::Vector3d> POINTS = {
    {1, 1, 1.5}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
inline const std::vector<Face> FACES = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

inline TriangleMesh tetrahedron()
{
  TriangleMesh mesh;
  mesh.points = POINTS;
  mesh.faces = FACES;
  return mesh;
}

}    // namespace Membrane_NS

#endif
