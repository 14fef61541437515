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

#ifndef LMP_MESH_EXCLUSION_H
#define LMP_MESH_EXCLUSION_H

#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {

class DistributedMesh;

/** What neigh_modify exclude group A A leaves out: what is within A does not matter, as for a frozen
    part, so faces that depend on points of A only are left out. A membrane with terms of its total
    area or volume is left out as a whole or not at all. */
class MeshExclusion : protected Pointers {
 public:
  explicit MeshExclusion(class LAMMPS *lmp) : Pointers(lmp) {}

  /// Collective: by membrane, whether all of it is left out. Stops if one of those that have terms of
  /// totals (by membrane, too) is left out in part.
  std::vector<char> find_membranes(const DistributedMesh &, const std::vector<char> &has_totals) const;
  /// The owned faces that are not left out.
  std::vector<int> remaining_faces(const DistributedMesh &) const;

 private:
  bool holds(int mask, int exclusion) const;
  bool excludes(const DistributedMesh &, int face, std::vector<int> &stencil) const;
};

}    // namespace LAMMPS_NS

#endif
