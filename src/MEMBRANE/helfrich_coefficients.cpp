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

#include "helfrich_coefficients.h"

#include "error.h"

#include <cstring>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

HelfrichCoefficients HelfrichCoefficients::parse(LAMMPS *lmp, int narg, char **arg)
{
  Error *error = lmp->error;
  HelfrichCoefficients c;
  c.set = true;
  c.kc = utils::numeric(FLERR, arg[0], false, lmp);
  c.c0 = utils::numeric(FLERR, arg[1], false, lmp);
  if (c.kc < 0.0) error->all(FLERR, "pair_coeff helfrich bending modulus {} is negative", arg[0]);

  auto value = [&](int iarg, int offset) {
    if (iarg + offset >= narg)
      utils::missing_cmd_args(FLERR, std::string("pair_coeff helfrich ") + arg[iarg], error);
    return arg[iarg + offset];
  };
  auto modulus = [&](int iarg) {
    const double k = utils::numeric(FLERR, value(iarg, 1), false, lmp);
    if (k < 0.0)
      error->all(FLERR, "pair_coeff helfrich {} modulus {} is negative", arg[iarg], arg[iarg + 1]);
    return k;
  };
  auto reference = [&](int iarg, double &target, bool &init) {
    init = strcmp(value(iarg, 2), "init") == 0;
    if (init) return;
    target = utils::numeric(FLERR, arg[iarg + 2], false, lmp);
    if (target <= 0.0)
      error->all(FLERR, "pair_coeff helfrich reference {} {} must be positive or init", arg[iarg],
                 arg[iarg + 2]);
  };

  int iarg = 2;
  while (iarg < narg) {
    const std::string key = arg[iarg];
    if (key == "kg") {
      c.kg = utils::numeric(FLERR, value(iarg, 1), false, lmp);
      iarg += 2;
    } else if (key == "tension") {
      c.tension = utils::numeric(FLERR, value(iarg, 1), false, lmp);
      iarg += 2;
    } else if (key == "area") {
      c.area_modulus = modulus(iarg);
      reference(iarg, c.area, c.area_init);
      iarg += 3;
    } else if (key == "area/local") {
      c.local_area_modulus = modulus(iarg);
      iarg += 2;
    } else if (key == "volume") {
      c.volume_modulus = modulus(iarg);
      reference(iarg, c.volume, c.volume_init);
      iarg += 3;
    } else if (key == "pressure") {
      c.pressure = utils::numeric(FLERR, value(iarg, 1), false, lmp);
      iarg += 2;
    } else if (key == "regularize") {
      c.regularize = modulus(iarg);
      c.regularize_given = true;
      iarg += 2;
    } else
      error->all(FLERR,
                 "Unknown pair_coeff helfrich keyword {}; known are: kg, tension, area, area/local, "
                 "volume, pressure, regularize",
                 key);
  }
  return c;
}

bool HelfrichCoefficients::same_global_terms(const HelfrichCoefficients &o) const
{
  return area_modulus == o.area_modulus && area == o.area && area_init == o.area_init &&
      volume_modulus == o.volume_modulus && volume == o.volume && volume_init == o.volume_init &&
      pressure == o.pressure && local_area_modulus == o.local_area_modulus;
}
