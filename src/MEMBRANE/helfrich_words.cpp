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

#include "helfrich_words.h"

#include "error.h"

#include <algorithm>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

std::string HelfrichWords::word(int i) const
{
  if (i >= narg) utils::missing_cmd_args(FLERR, "pair_coeff helfrich " + keyword(), error);
  return arg[i];
}

bool HelfrichWords::at_end(int i) const
{
  return i >= narg || std::count(keywords.begin(), keywords.end(), arg[i]);
}

double HelfrichWords::number(int i) const
{
  return utils::numeric(FLERR, word(i), false, lmp);
}

double HelfrichWords::modulus(int i) const
{
  const double value = number(i);
  if (value < 0.0)
    error->all(FLERR, "pair_coeff helfrich {} modulus {} is negative", keyword(), word(i));
  return value;
}

bool HelfrichWords::number_or_init(int i, double &value) const
{
  if (word(i) == "init") return false;
  value = number(i);
  return true;
}
