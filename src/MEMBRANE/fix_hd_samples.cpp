/* -----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing author: MEMBRANE developers
------------------------------------------------------------------------- */

#include "fix_hd_samples.h"

#include "compute.h"
#include "error.h"
#include "hd_mode_averages.h"
#include "modify.h"

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

FixHDSamples::FixHDSamples(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), compute_id(narg == 5 ? arg[4] : ""), sampled(nullptr)
{
  if (narg != 5) error->all(FLERR, "Fix HD/SAMPLES is made by compute hd/modes ... average");
  nevery = utils::inumeric(FLERR, arg[3], false, lmp);
  if (nevery < 1) error->all(FLERR, "Fix HD/SAMPLES: {} is not a number of steps", arg[3]);
}

int FixHDSamples::setmask()
{
  return FixConst::END_OF_STEP | FixConst::POST_RUN;
}

void FixHDSamples::init()
{
  sampled = dynamic_cast<SampledCompute *>(modify->get_compute_by_id(compute_id));
  if (!sampled) error->all(FLERR, "Fix HD/SAMPLES: there is no compute {} that takes samples", compute_id);
}

void FixHDSamples::end_of_step()
{
  sampled->take_sample();
}

void FixHDSamples::post_run()
{
  sampled->finish_samples();
}
