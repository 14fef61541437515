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

#ifndef LMP_MEMBRANE_MESH_READERS_H
#define LMP_MEMBRANE_MESH_READERS_H

#include "membrane_mesh_soup.h"

#include <string>
#include <string_view>

namespace Membrane_NS {

// The readers of mesh files, one per format; read_mesh() in membrane_mesh_file.h is the way in.
// `content` is the whole file, `path` its name for messages. All throw MeshError. None asks for more
// memory than its content can fill, whatever counts that announces.

PolygonSoup read_off(const std::string &path, std::string_view content);
PolygonSoup read_ply(const std::string &path, std::string_view content);
PolygonSoup read_obj(const std::string &path, std::string_view content);
PolygonSoup read_stl(const std::string &path, std::string_view content);
PolygonSoup read_vtp(const std::string &path, std::string_view content);
PolygonSoup read_tsi(const std::string &path, std::string_view content);
/// Collected in a file of FreeDTS or TS2CG besides the mesh.
struct TsiInclusion {
  int type;
  Eigen::Vector3d place;    ///< of its vertex
};
std::vector<TsiInclusion> read_tsi_inclusions(const std::string &path, std::string_view content);
PolygonSoup read_hd(const std::string &path, std::string_view content);

}    // namespace Membrane_NS

#endif
