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

#ifdef COMMAND_CLASS
// clang-format off
CommandStyle(write_membrane,WriteMembrane);
// clang-format on
#else

#ifndef LMP_WRITE_MEMBRANE_H
#define LMP_WRITE_MEMBRANE_H

#include "command.h"
#include "membrane_mesh_writer.h"
#include "membrane_tessellation.h"

#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

/// Writes the limit surface, or the control mesh, of the membranes to a mesh file.
class WriteMembrane : public Command {
 public:
  WriteMembrane(class LAMMPS *);
  void command(int, char **) override;

 private:
  std::string path;
  enum class Format { OFF, PLY, TSI, VTP } format;
  int subdivide;
  bool fields, domains;
  std::vector<std::pair<std::string, int>> inclusions;    // fixes hd/bind, and the type in the file
  std::vector<tagint> chosen;    // molecule IDs; all membranes if empty

  // what goes into the file
  struct Surface {
    Membrane_NS::TriangleMesh mesh;
    Membrane_NS::PointFields fields;
    Membrane_NS::TsiVertices vertices;
  };

  // of all ranks, for a file that tells them
  struct Bound {
    tagint id;
    int type;
    double x[3];
  };
  std::vector<Bound> bound;
  std::vector<int> types;    // of control points, by vertex

  void parse(int, char **);
  void parse_format();
  bool format_has_fields() const { return format == Format::PLY || format == Format::VTP; }
  Membrane_NS::TriangleMesh control_mesh(const class DistributedMesh &,
                                         std::vector<double> &labels, std::vector<int> &vertices,
                                         std::vector<int> &faces) const;
  void gather_vertices(const DistributedMesh &);
  Surface surface(const DistributedMesh &) const;
  void set_vertices(const Membrane_NS::Topology &, const Membrane_NS::TessellatedSurface &, const std::vector<int> &of,
                    Surface &) const;
  void add_lipids(const class DistributedMesh &, const Membrane_NS::Topology &, const std::vector<int> &faces,
                  int points, Membrane_NS::PointFields &) const;
  void write(const Surface &) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
