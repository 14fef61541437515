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
FixStyle(HD/SAMPLES,FixHDSamples);
// clang-format on
#else

#ifndef LMP_FIX_HD_SAMPLES_H
#define LMP_FIX_HD_SAMPLES_H

#include "fix.h"

#include <string>

namespace LAMMPS_NS {

/** Made by a compute that takes samples of its own, not by users: fix ID group HD/SAMPLES N compute-ID has
    it take one every N steps of runs, never of the shape that a run begins with. */
class FixHDSamples : public Fix {
 public:
  FixHDSamples(class LAMMPS *, int, char **);

  int setmask() override;
  void init() override;
  void end_of_step() override;
  void post_run() override;

 private:
  const std::string compute_id;
  class SampledCompute *sampled;
};

}    // namespace LAMMPS_NS

#endif
#endif
