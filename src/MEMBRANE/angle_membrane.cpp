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

#include "angle_membrane.h"

#include "atom.h"
#include "error.h"
#include "math_const.h"
#include "memory.h"

#include <algorithm>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

AngleMembrane::AngleMembrane(LAMMPS *lmp) : Angle(lmp)
{
  writedata = 0;
}

AngleMembrane::~AngleMembrane()
{
  if (!copymode) memory->destroy(setflag);
}

void AngleMembrane::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
}

// angle_style hybrid wants to hear which types are faces, and reads setflag

void AngleMembrane::coeff(int narg, char **arg)
{
  if (narg > 1)
    error->all(FLERR,
               "Angles are faces of membranes, which have no coefficients, so {} is one word too many; "
               "for other angles use angle_style first, with faces hybrid and angle_coeff TYPE membrane",
               arg[1]);
  int lo, hi;
  utils::bounds(FLERR, arg[0], 1, atom->nangletypes, lo, hi, error);
  if (!setflag) {
    memory->create(setflag, atom->nangletypes + 1, "angle:setflag");
    std::fill_n(setflag, atom->nangletypes + 1, 0);
  }
  for (int i = lo; i <= hi; ++i) setflag[i] = 1;
}

double AngleMembrane::equilibrium_angle(int)
{
  return MathConst::MY_PI / 3.0;
}
