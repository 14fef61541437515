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

#ifdef FIX_CLASS
// clang-format off
FixStyle(hd/nve,FixHDNVE);
// clang-format on
#else

#ifndef LMP_FIX_HD_NVE_H
#define LMP_FIX_HD_NVE_H

#include "fix_hd_base.h"

namespace LAMMPS_NS {

/// Hamiltonian dynamics of control points by velocity Verlet with the mass matrix.
class FixHDNVE : public FixHDBase {
 public:
  FixHDNVE(class LAMMPS *, int, char **);

  int setmask() override;
  void init() override;
  void initial_integrate(int) override;
  void final_integrate() override;
  void initial_integrate_respa(int, int, int) override;
  void final_integrate_respa(int, int) override;
  void reset_dt() override;

 private:
  double dtv, dtf;
};

}    // namespace LAMMPS_NS

#endif
#endif
