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
CommandStyle(create_bound,CreateBound);
// clang-format on
#else

#ifndef LMP_CREATE_BOUND_H
#define LMP_CREATE_BOUND_H

#include "command.h"
#include "membrane_limit_surface.h"

#include <cstdint>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/** Places atoms on membranes, uniform in area or where a file has inclusions, for fix hd/bind to hold. The same atoms on any number of
    ranks. */
class CreateBound : public Command {
 public:
  explicit CreateBound(class LAMMPS *lmp) : Command(lmp) {}
  void command(int, char **) override;

 private:
  int type = 0, leaflet = 1, membranebit = 0;    // leaflet 0: one half on each
  bigint count = 0;
  double height = 0.0, least = 0.0, mass = 0.0;
  uint64_t seed = 0;
  tagint molecule = 0;
  std::string file;    // with inclusions, if any
  int inclusion = 0;
  double scale = 1.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();

  void parse(int, char **);
  std::vector<int> components() const;
  std::vector<Eigen::Vector3d> find_places();
  std::vector<Eigen::Vector3d> find_inclusions();
  std::vector<Eigen::Vector3d> other_atoms(const class DistributedMesh &) const;
  void add_atoms(const std::vector<Eigen::Vector3d> &);
};

}    // namespace LAMMPS_NS

#endif
#endif
