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

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(hd/temp,ComputeHDTemp);
// clang-format on
#else

#ifndef LMP_COMPUTE_HD_TEMP_H
#define LMP_COMPUTE_HD_TEMP_H

#include "compute.h"
#include "hd_mass.h"

#include <vector>

namespace LAMMPS_NS {

/// Temperature of control points, from the kinetic energy qdot^T M qdot / 2, and of atoms bound to them; that of the bath for
/// points that move without inertia.
class ComputeHDTemp : public Compute {
 public:
  ComputeHDTemp(class LAMMPS *, int, char **);
  ~ComputeHDTemp() override;

  void init() override;
  void setup() override;
  double compute_scalar() override;
  void compute_vector() override;

 private:
  double tfactor;
  HDMass mass;
  bool settings_given;
  class FixHDBase *overdamped = nullptr;    // the integrator, if its points have no momenta
  int lost;    // degrees of freedom that the mass does not have
  std::vector<class FixHDBound *> binds;
  bigint bound;    // atoms of the group that they hold and others move

  void dof_compute();
  void kinetic(double *);
};

}    // namespace LAMMPS_NS

#endif
#endif
