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

#ifndef LMP_HD_FOREIGN_INTEGRATORS_H
#define LMP_HD_FOREIGN_INTEGRATORS_H

#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class DistributedMesh;

/** Integrators for plain atoms that move control points do so as if these were particles of their
    own. That is allowed, and said once for each fix. */
class HDForeignIntegrators : protected Pointers {
 public:
  explicit HDForeignIntegrators(class LAMMPS *lmp) : Pointers(lmp) {}
  /// Collective; call before a run.
  void warn(const DistributedMesh &);

 private:
  std::vector<std::string> warned;    // IDs of fixes
};

/** Collective; call from init() of a fix that moves control points. Fixes that turn velocities of single points,
    or take forces from some of a membrane's, do not know that masses couple them: a warning, an error where points
    have no freedom of their own. coupled: the mass matrix is not diagonal. */
void check_fixes_of_points(class LAMMPS *, const class Fix *user, bool coupled, bool sampling, bool modes);

}    // namespace LAMMPS_NS

#endif
