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
FixStyle(hd/langevin,FixHDLangevin);
// clang-format on
#else

#ifndef LMP_FIX_HD_LANGEVIN_H
#define LMP_FIX_HD_LANGEVIN_H

#include "fix_hd_base.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/// Langevin dynamics of control points by the BAOAB splitting.
class FixHDLangevin : public FixHDBase {
 public:
  FixHDLangevin(class LAMMPS *, int, char **);

  int setmask() override;
  void init() override;
  void setup(int) override;
  void initial_integrate(int) override;
  void final_integrate() override;
  void reset_dt() override;
  void reset_target(double) override;
  double compute_scalar() override;

 protected:
  void archive(RestartArchive &) override;

 private:
  double t_start, t_stop, damp;
  bigint seed;
  std::vector<double> ratio;    // by type: damping time over damp
  bool scaled, tally, with_measure;
  double energy;    // taken out of the membrane so far
  double dt;

  double kT() const;
  void set_measure();
  void thermalize();
  void stop_points();
  double kinetic();
};

}    // namespace LAMMPS_NS

#endif
#endif
