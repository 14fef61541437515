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

#include "fix_hd_bind.h"

#include "error.h"
#include "group.h"
#include "update.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

FixHDBind::FixHDBind(LAMMPS *lmp, int narg, char **arg) : FixHDBound(lmp, narg, arg)
{
  if (narg < 4) utils::missing_cmd_args(FLERR, "fix hd/bind", error);
  membrane_name = arg[3];
  const int imembrane = group->find(arg[3]);
  if (imembrane < 0) error->all(FLERR, "Could not find fix hd/bind membrane group ID {}", arg[3]);
  membranebit = group->bitmask[imembrane];
  for (int iarg = 4; iarg < narg;) iarg += parse(iarg, narg, arg);
  if (correct == Correct::YES && !rigid)
    error->all(FLERR, "Fix hd/bind correct is for hold rigid: springs need no correction");
  if (rigid && diffusion > 0.0)
    error->all(FLERR, "Fix hd/bind brownian needs hold spring: without inertia there is nothing rigid to conserve");
  if (carried && diffusion == 0.0)
    error->all(FLERR, "Fix hd/bind friction membrane is for atoms that it moves itself: add brownian");
  time_integrate = diffusion > 0.0;
}

int FixHDBind::parse(int iarg, int narg, char **arg)
{
  const std::string key = arg[iarg];
  auto need = [&](int words) {
    if (iarg + words > narg) utils::missing_cmd_args(FLERR, "fix hd/bind " + key, error);
  };
  if (key == "max") {
    need(2);
    max_distance = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
    if (!(max_distance > 0.0))
      error->all(FLERR, "Fix hd/bind max {} must be positive", arg[iarg + 1]);
    return 2;
  }
  if (key == "height") {
    need(2);
    height = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
    if (!std::isfinite(height) || height < 0.0)
      error->all(FLERR,
                 "Fix hd/bind height {} must not be negative: it is above the surface on the side of the "
                 "leaflet",
                 arg[iarg + 1]);
    return 2;
  }
  if (key == "leaflet") {
    need(2);
    const std::string word = arg[iarg + 1];
    if (word != "in" && word != "out" && word != "both")
      error->all(FLERR, "Fix hd/bind leaflet {} is not in, out or both", word);
    leaflet = word == "in" ? -1 : word == "out" ? 1 : 0;
    return 2;
  }
  if (key == "hold") {
    need(2);
    const std::string word = arg[iarg + 1];
    if (word != "spring" && word != "rigid")
      error->all(FLERR, "Fix hd/bind hold {} is not spring or rigid", word);
    rigid = word == "rigid";
    if (rigid) return 2;
    need(3);
    automatic = strcmp(arg[iarg + 2], "auto") == 0;
    if (!automatic) spring = utils::numeric(FLERR, arg[iarg + 2], false, lmp);
    if (!automatic && !(spring > 0.0 && std::isfinite(spring)))
      error->all(FLERR, "Fix hd/bind hold spring {} must be positive, or auto", arg[iarg + 2]);
    return 3;
  }
  if (key == "correct") {
    need(2);
    correct = utils::logical(FLERR, arg[iarg + 1], false, lmp) ? Correct::YES : Correct::NO;
    return 2;
  }
  if (key == "brownian") {
    need(4);
    temperature = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
    diffusion = parse_diffusion(arg[iarg + 2]);
    seed = utils::bnumeric(FLERR, arg[iarg + 3], false, lmp);
    if (!(temperature > 0.0))
      error->all(FLERR, "Fix hd/bind brownian temperature {} must be positive", arg[iarg + 1]);
    if (seed <= 0) error->all(FLERR, "Fix hd/bind brownian seed {} must be positive", arg[iarg + 3]);
    return 4;
  }
  if (key == "friction") {
    need(2);
    const std::string word = arg[iarg + 1];
    if (word != "bath" && word != "membrane")
      error->all(FLERR, "Fix hd/bind friction {} is not bath or membrane", word);
    carried = word == "membrane";
    return 2;
  }
  if (key == "sites") {
    need(2);
    site_path = arg[iarg + 1];
    given = BoundSiteFile::read(lmp, site_path);
    return 2;
  }
  if (key == "footprint" || key == "bar") return curvature.parse(narg - iarg, arg + iarg);
  if (key == "rotate") {
    need(4);
    turning_temperature = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
    turning = utils::numeric(FLERR, arg[iarg + 2], false, lmp);
    turning_seed = utils::bnumeric(FLERR, arg[iarg + 3], false, lmp);
    if (!(turning_temperature > 0.0 && turning > 0.0) || turning_seed <= 0)
      error->all(FLERR, "Fix hd/bind rotate: temperature {}, diffusion coefficient {} and seed {} must be positive",
                 arg[iarg + 1], arg[iarg + 2], arg[iarg + 3]);
    return 4;
  }
  error->all(FLERR,
             "Unknown fix hd/bind keyword {}; known are: max, leaflet, height, hold, correct, "
             "brownian, friction, sites, footprint, bar, rotate",
             key);
  return 0;
}

/* ----------------------------------------------------------------------
   a number in LAMMPS' units, or with the unit that diffusion in membranes is measured in
------------------------------------------------------------------------- */

double FixHDBind::parse_diffusion(const char *text) const
{
  std::string number = text;
  double unit = 1.0;
  const size_t at = number.find("um2/s");
  if (at != std::string::npos && at + 5 == number.size()) {
    number.resize(at);
    const std::string style = update->unit_style;
    const double metre = style == "real" || style == "metal" ? 1.0e10
        : style == "nano"                                     ? 1.0e9
        : style == "micro"                                    ? 1.0e6
        : style == "cgs"                                      ? 1.0e2
                                                              : 1.0;
    const double second = style == "real" ? 1.0e15
        : style == "metal"                ? 1.0e12
        : style == "nano"                 ? 1.0e9
        : style == "micro"                ? 1.0e6
                                          : 1.0;
    if (style == "lj" || style == "electron")
      error->all(FLERR, "Fix hd/bind brownian diffusion coefficient {}: units {} have no um2/s", text, style);
    unit = 1.0e-12 * metre * metre / second;
  }
  const double value = utils::numeric(FLERR, number, false, lmp) * unit;
  if (!(value > 0.0 && std::isfinite(value)))
    error->all(FLERR, "Fix hd/bind brownian diffusion coefficient {} must be positive", text);
  return value;
}
