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

#ifndef LMP_MESH_ORIGINS_H
#define LMP_MESH_ORIGINS_H

#include "mesh_distributed.h"
#include "pointers.h"
#include "restart_archive.h"

#include <vector>

namespace LAMMPS_NS {

/** Which control points are those of an earlier run. Atom and molecule IDs do not tell: commands renumber
    them, and new atoms get those of deleted ones. So whoever keeps something of a membrane gives its
    control points numbers, "origins", which atom style membrane_cp carries with the atoms, to other
    ranks and through restart files. A number is never given twice; copies that replicate makes have
    that of their original until numbers are given next. */
class MeshOrigins : protected Pointers {
 public:
  explicit MeshOrigins(class LAMMPS *lmp) : Pointers(lmp) {}

  /** Collective; call from init(), and again when the faces changed. Gives numbers to control points
      that have none, and new ones to all but the first of those that have the same. */
  void give(const DistributedMesh &);
  /// By vertex: what give() found, 0 for new control points, and what they have now.
  const std::vector<bigint> &before() const { return found; }
  const std::vector<bigint> &now() const { return given; }
  /// Whether a control point has this number now.
  bool exists(bigint origin) const;

  void archive(RestartArchive &file) { file(last); }

 private:
  bigint last = 0;
  std::vector<bigint> found, given, sorted;
};

}    // namespace LAMMPS_NS

#endif
