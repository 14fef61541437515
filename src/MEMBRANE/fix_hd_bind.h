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
FixStyle(hd/bind,FixHDBind);
// clang-format on
#else

#ifndef LMP_FIX_HD_BIND_H
#define LMP_FIX_HD_BIND_H

#include "fix_hd_bound.h"

namespace LAMMPS_NS {

/// Binds atoms to membranes: what the words of the command say of FixHDBound.
class FixHDBind : public FixHDBound {
 public:
  FixHDBind(class LAMMPS *, int, char **);

 private:
  int parse(int, int, char **);
  double parse_diffusion(const char *) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
