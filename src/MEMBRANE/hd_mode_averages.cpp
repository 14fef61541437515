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

#include "hd_mode_averages.h"

#include "comm.h"
#include "error.h"
#include "force.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

using namespace LAMMPS_NS;
using Membrane_NS::BlockAverages;

/* ---------------------------------------------------------------------- */

int ModeSampling::parse(LAMMPS *lmp, const std::string &user, int iarg, int narg, char **arg)
{
  const std::string key = arg[iarg], what = user + " " + key;
  if (key != "average" && key != "theory" && key != "file") return 0;
  const int words = key == "theory" ? 4 : 2;
  if (iarg + words > narg) utils::missing_cmd_args(FLERR, what, lmp->error);
  if (key == "average") {
    every = utils::inumeric(FLERR, arg[iarg + 1], false, lmp);
    if (every < 1) lmp->error->all(FLERR, "{} {}: a sample every so many steps, 1 or more", what, every);
  } else if (key == "theory") {
    kT = lmp->force->boltz * utils::numeric(FLERR, arg[iarg + 1], false, lmp);
    kc = utils::numeric(FLERR, arg[iarg + 2], false, lmp);
    tension = utils::numeric(FLERR, arg[iarg + 3], false, lmp);
    if (!(kT > 0.0 && kc > 0.0))
      lmp->error->all(FLERR, "{} {} {}: temperature and bending modulus must be positive", what,
                      arg[iarg + 1], arg[iarg + 2]);
  } else {
    file = arg[iarg + 1];
  }
  return words;
}

void ModeSampling::check(LAMMPS *lmp, const std::string &user) const
{
  if (every > 0 && !file.empty() && lmp->comm->me == 0) {
    FILE *out = fopen(file.c_str(), "a");
    if (!out) lmp->error->one(FLERR, "{}: cannot open file {}: {}", user, file, utils::getsyserror());
    fclose(out);
  }
  if (every > 0 || (kT == 0.0 && file.empty())) return;
  lmp->error->all(FLERR, "{} {} is of averages: use average N", user, file.empty() ? "theory" : "file");
}

double ModeSampling::wave_power(double q, double area) const
{
  return kT == 0.0 ? 0.0 : kT / (area * q * q * (kc * q * q + tension));
}

double ModeSampling::harmonic_power(double l, double radius) const
{
  if (kT == 0.0) return 0.0;
  return kT / ((l - 1.0) * (l + 2.0) * (kc * l * (l + 1.0) + tension * radius * radius));
}

/* ---------------------------------------------------------------------- */

ModeAverages::ModeAverages(LAMMPS *lmp, const std::vector<double> &number, double part) :
    Pointers(lmp), row(number.size(), -1)
{
  std::vector<std::pair<double, size_t>> sorted;
  for (size_t i = 0; i < number.size(); ++i)
    if (number[i] > 0.0) sorted.emplace_back(number[i], i);
  std::sort(sorted.begin(), sorted.end());
  double first = -1.0;
  for (const auto &[value, i] : sorted) {
    if (first < 0.0 || value > (1.0 + part) * first) {
      modes.push_back(0);
      first = value;
    }
    row[i] = num_rows() - 1;
    ++modes.back();
  }
  begin_anew();
}

void ModeAverages::begin_anew()
{
  blocks = BlockAverages(3 * num_rows());
}

/* ---------------------------------------------------------------------- */

void ModeAverages::add(const std::vector<double> &number, const std::vector<double> &power,
                       const std::vector<double> &theory)
{
  const int n = num_rows();
  std::vector<double> sample(3 * (size_t) n, 0.0);
  for (size_t i = 0; i < row.size(); ++i) {
    const int r = row[i];
    if (r < 0) continue;
    sample[r] += power[i] / modes[r];
    if (theory[i] != 0.0) sample[n + r] += theory[i] > 0.0 ? power[i] / theory[i] / modes[r] : NAN;
    sample[2 * n + r] += number[i] / modes[r];
  }
  blocks.add(sample);
}

/* ---------------------------------------------------------------------- */

void ModeAverages::fill(double **table) const
{
  const int n = num_rows();
  for (int r = 0; r < n; ++r) {
    const double values[NCOLUMNS] = {blocks.mean(2 * n + r), static_cast<double>(modes[r]),
                                     blocks.mean(r),         blocks.error(r),
                                     blocks.mean(n + r),     blocks.error(n + r),
                                     blocks.correlation(r)};
    std::copy_n(values, NCOLUMNS, table[r]);
  }
}

/* ---------------------------------------------------------------------- */

void ModeAverages::write(const ModeSampling &sampling, const std::string &user) const
{
  if (comm->me != 0) return;
  FILE *out = fopen(sampling.file.c_str(), "w");
  if (!out) error->one(FLERR, "{}: cannot open file {}: {}", user, sampling.file, utils::getsyserror());
  utils::print(out, "# {}: {} samples, one every {} steps\n", user, count(), sampling.every);
  utils::print(out, "# number modes power error ratio error correlation(steps)\n");
  const int n = num_rows();
  for (int r = 0; r < n; ++r)
    utils::print(out, "{:.6g} {} {:.6g} {:.2g} {:.5f} {:.5f} {:.3g}\n", blocks.mean(2 * n + r), modes[r],
                 blocks.mean(r), blocks.error(r), blocks.mean(n + r), blocks.error(n + r),
                 blocks.correlation(r) * sampling.every);
  fclose(out);
}
