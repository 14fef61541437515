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

#include "fix_hd_bound.h"

#include "atom.h"
#include "comm.h"
#include "error.h"

#include <algorithm>

using namespace LAMMPS_NS;

// === Sites follow their atoms

void FixHDBound::grow_arrays(int nmax)
{
  sites.grow(nmax);
}

void FixHDBound::copy_arrays(int i, int j, int)
{
  sites.copy(i, j);
}

void FixHDBound::set_arrays(int i)
{
  sites.clear(i);
}

int FixHDBound::pack_exchange(int i, double *buf)
{
  return sites.pack(i, buf);
}

int FixHDBound::unpack_exchange(int i, double *buf)
{
  return sites.unpack(i, buf);
}

// === Restart

int FixHDBound::pack_restart(int i, double *buf)
{
  buf[0] = BoundSites::SIZE + 1;
  return sites.pack(i, buf + 1) + 1;
}

void FixHDBound::unpack_restart(int i, int nth)
{
  const double *extra = atom->extra[i];
  int start = 0;
  for (int k = 0; k < nth; ++k) start += static_cast<int>(extra[start]);
  sites.unpack(i, extra + start + 1);
}

int FixHDBound::size_restart(int)
{
  return BoundSites::SIZE + 1;
}

int FixHDBound::maxsize_restart()
{
  return BoundSites::SIZE + 1;
}

void FixHDBound::archive(RestartArchive &file)
{
  file(noise_steps);
  file(precision);
  double kept = spring;
  file(kept);
  file(chosen_for);
  file(chosen_count);
  if (file.is_reading() && automatic) spring = kept;
}

void FixHDBound::write_restart(FILE *fp)
{
  if (comm->me) return;
  RestartArchive file;
  archive(file);
  file.write_of_fix(fp);
}

void FixHDBound::restart(char *buf)
{
  RestartArchive file = RestartArchive::of_fix(buf);
  archive(file);
  if (!file.ok() || !file.at_end())
    error->all(FLERR, "The restart file is damaged, or of another version: fix {} ({})", id, style);
}

// === Exchange of an array [atoms][3]

int FixHDBound::pack_reverse_comm(int n, int first, double *buf)
{
  std::copy_n(exchanged[first], 3 * n, buf);
  return 3 * n;
}

void FixHDBound::unpack_reverse_comm(int n, int *list, double *buf)
{
  for (int j = 0; j < n; ++j)
    for (int k = 0; k < 3; ++k) exchanged[list[j]][k] += buf[3 * j + k];
}

int FixHDBound::pack_forward_comm(int n, int *list, double *buf, int, int *)
{
  for (int j = 0; j < n; ++j) std::copy_n(exchanged[list[j]], 3, buf + 3 * j);
  return 3 * n;
}

void FixHDBound::unpack_forward_comm(int n, int first, double *buf)
{
  std::copy_n(buf, 3 * n, exchanged[first]);
}
