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

#ifndef LMP_SRD_RESCUE_H
#define LMP_SRD_RESCUE_H

#include "pointers.h"
#include "srd_regions.h"

#include <Eigen/Core>

namespace LAMMPS_NS {

/// Puts solvent that is on the wrong side of a surface back on its own, with the velocity it has.
class SurfaceRescue : protected Pointers {
 public:
  SurfaceRescue(class LAMMPS *, SurfaceMotion &, SurfaceRegions &);

  struct Counts {
    bigint crossed = 0;    ///< were on the wrong side
    bigint rescued = 0;    ///< and are not any more
  };
  /// Of this rank's solvent: how many are on the wrong side.
  bigint count(const class SRDSolvent &, double contact) const;
  /// Collective: of this rank's solvent. What is closer than `contact` to the surface is on it, by
  /// rounding. Random numbers depend on `step`.
  Counts put_back(const class SRDSolvent &, double contact, bigint step);

 private:
  SurfaceMotion &motion;
  SurfaceRegions &regions;

  Eigen::Vector3d nearest_point(const SurfaceRegions::Crossing &) const;
  bool put_beside(const SurfaceRegions::Crossing &, const Eigen::Vector3d &nearest);
  bool put_anywhere(const SurfaceRegions::Crossing &, bigint step);
};

}    // namespace LAMMPS_NS

#endif
