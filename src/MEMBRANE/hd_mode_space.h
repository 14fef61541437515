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

#ifndef LMP_HD_MODE_SPACE_H
#define LMP_HD_MODE_SPACE_H

#include "membrane_mass_modes.h"
#include "pointers.h"
#include "restart_archive.h"

#include <string>

namespace LAMMPS_NS {

/// What users say of modes, and the space that follows from it and from the membranes there are.
class HDModeSpace : protected Pointers {
 public:
  /// `user` is named in errors.
  HDModeSpace(class LAMMPS *lmp, std::string user) : Pointers(lmp), user(std::move(user)) {}

  /// One of the keywords modes, relax: how many words it took; 0 if it is another keyword.
  int parse(int iarg, int narg, char **arg, Membrane_NS::MassOperator::Settings &);
  /// What does not go together.
  void check(const Membrane_NS::MassOperator::Settings &) const;
  /// Collective: how many rows a table of the modes of a group has; one of a wave.
  int count_rows(const Membrane_NS::SharedModes &, int groupbit) const;

  /** Collective: the space about the shape that is remembered, if it is still that of these control points, or else
      about the present one. The mesh is up to date. */
  void follow(class DistributedMesh &, class MeshPart &, Membrane_NS::SharedModes &) const;
  /// What restart files keep.
  static void archive(RestartArchive &, Membrane_NS::SharedModes &);

 private:
  std::string user;
  using Choice = Membrane_NS::ModeChoice;

  int parse_modes(int iarg, int narg, char **arg, Membrane_NS::SharedModes &);
  int parse_relax(int iarg, int narg, char **arg, Membrane_NS::SharedModes &);
  std::vector<std::vector<double>> read_table(const std::string &file, const std::string &what) const;
  int count_membranes(int groupbit) const;
  std::vector<int> components_of(const class DistributedMesh &, const class MeshPart &) const;
  void check_membrane(const class DistributedMesh &, int component, const Choice &) const;
  void build(const class DistributedMesh &, const std::vector<int> &components, Membrane_NS::SharedModes &) const;
  void read_vectors(const class DistributedMesh &, const std::vector<int> &components,
                    const Membrane_NS::SharedModes &, Membrane_NS::ModeSpace &) const;
  void set_friction(Membrane_NS::SharedModes &) const;
};

}    // namespace LAMMPS_NS

#endif
