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

#ifndef LMP_MESH_GAPS_H
#define LMP_MESH_GAPS_H

#include "pointers.h"

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

class DistributedMesh;

/** Other pair styles act on control points, not on the surface between them: atoms get through where
    their range is shorter than an edge. */
class MeshGaps : protected Pointers {
 public:
  explicit MeshGaps(class LAMMPS *lmp) : Pointers(lmp) {}

  /// Collective; call from setup(), when all cutoffs are known. Warns once of each two types.
  void warn(const DistributedMesh &);

 private:
  using Types = std::pair<int, int>;    // of control points, of other atoms
  std::set<Types> warned;

  std::string pair_styles(int type, int other) const;
  std::vector<int> types_of_others(const DistributedMesh &) const;
};

}    // namespace LAMMPS_NS

#endif
