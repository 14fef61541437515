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

#ifdef ANGLE_CLASS
// clang-format off
AngleStyle(membrane,AngleMembrane);
// clang-format on
#else

#ifndef LMP_ANGLE_MEMBRANE_H
#define LMP_ANGLE_MEMBRANE_H

#include "angle.h"

namespace LAMMPS_NS {

/// Angles that are faces: no energy, no coefficients. See mesh_angle_style.h for when it is there.
class AngleMembrane : public Angle {
 public:
  explicit AngleMembrane(class LAMMPS *);
  ~AngleMembrane() override;

  void init() override {}
  void compute(int, int) override;
  void coeff(int, char **) override;
  double equilibrium_angle(int) override;
  void write_restart(FILE *) override {}
  void read_restart(FILE *) override {}
  double single(int, int, int, int) override { return 0.0; }
};

}    // namespace LAMMPS_NS

#endif
#endif
