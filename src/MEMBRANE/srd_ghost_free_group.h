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

#ifndef LMP_SRD_GHOST_FREE_GROUP_H
#define LMP_SRD_GHOST_FREE_GROUP_H

#include "pointers.h"

#include <string>

namespace LAMMPS_NS {

/** Keeps the atoms of a group out of LAMMPS' ghost exchange, neighbor lists and checks for
    reneighbouring, by what the commands atom_modify first, comm_modify group and neigh_modify
    include do for the group of all other atoms, which this makes. What the user has set with these
    commands goes before. LAMMPS then no longer sets forces of the group to zero. */
class GhostFreeGroup : protected Pointers {
 public:
  /// name: of the group that is made.
  GhostFreeGroup(class LAMMPS *, int igroup, std::string name);
  ~GhostFreeGroup() override;

  /// Collective; call from init(). Does nothing if force styles act on atoms of the group.
  void init(bool wanted);
  /// New atoms may have come between runs: call from setup_pre_exchange().
  void update();
  bool active() const { return made; }

 private:
  int groupbit;
  std::string name;
  bool made = false;
  int sortfreq_before = 0;

  void exchange_only(std::string);
  bool possible();
  void restore();
};

}    // namespace LAMMPS_NS

#endif
