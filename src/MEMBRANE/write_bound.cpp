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

#include "write_bound.h"

#include "atom.h"
#include "bound_site_file.h"
#include "comm.h"
#include "error.h"
#include "fix_hd_bound.h"
#include "mesh_gather.h"

#include <algorithm>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

void WriteBound::command(int narg, char **arg)
{
  if (narg < 2) utils::missing_cmd_args(FLERR, "write_bound", error);
  if (narg > 2) error->all(FLERR, "write_bound takes the ID of a fix hd/bind and a file, and no more: {}", arg[2]);
  const auto *fix = FixHDBound::named(lmp, arg[0], "write_bound");
  std::vector<SiteOfAtom> mine;
  tagint free = 0, any;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & fix->groupbit)) continue;
    SiteOfAtom one;
    one.atom = atom->tag[i];
    one.site = fix->site(i);
    if (!one.site.bound()) free = std::max(free, one.atom);
    mine.push_back(one);
  }
  MPI_Allreduce(&free, &any, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  if (any)
    error->all(FLERR, "write_bound: atom {} is not bound yet: atoms are bound when a run begins, run 0 will do", any);
  std::vector<SiteOfAtom> all = gather_all(mine, world);
  if (comm->me) return;
  std::sort(all.begin(), all.end(), [](const SiteOfAtom &a, const SiteOfAtom &b) { return a.atom < b.atom; });
  BoundSiteFile::write(lmp, arg[1], all);
  utils::logmesg(lmp, "Wrote the sites of {} atoms to {}\n", all.size(), arg[1]);
}
