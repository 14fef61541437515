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
FixStyle(hd/brownian,FixHDBrownian);
// clang-format on
#else

#ifndef LMP_FIX_HD_BROWNIAN_H
#define LMP_FIX_HD_BROWNIAN_H

#include "fix_hd_base.h"

namespace LAMMPS_NS {

/// Overdamped dynamics of control points; drift and noise have the same mobility matrix.
class FixHDBrownian : public FixHDBase {
 public:
  FixHDBrownian(class LAMMPS *, int, char **);

  int setmask() override;
  void init() override;
  void initial_integrate(int) override;
  void reset_dt() override;
  void reset_target(double) override;

 private:
  double temperature, gamma_t, dt;
  bool with_measure;
  Membrane_NS::VertexField noise;    // of the present step; unit_noise() is that of the next

  void set_measure();
};

}    // namespace LAMMPS_NS

#endif
#endif
