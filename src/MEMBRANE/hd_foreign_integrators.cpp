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

#include "hd_foreign_integrators.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix.h"
#include "mesh_distributed.h"
#include "modify.h"

#include <algorithm>

using namespace LAMMPS_NS;

// rigid and prescribed motion is the same with any mass matrix
static constexpr const char *FITTING[] = {"^hd/", "^move", "^rigid", "^nve/noforce"};

/* ---------------------------------------------------------------------- */

void HDForeignIntegrators::warn(const DistributedMesh &mesh)
{
  for (auto &fix : modify->get_fix_list()) {
    if (!fix->time_integrate) continue;
    const bool fits = std::any_of(std::begin(FITTING), std::end(FITTING), [&](const char *pattern) {
      return utils::strmatch(fix->style, pattern);
    });
    if (fits) continue;
    if (std::find(warned.begin(), warned.end(), fix->id) != warned.end()) continue;
    bigint mine = 0, all;
    for (int i = 0; i < atom->nlocal; ++i)
      if (atom->mask[i] & fix->groupbit && mesh.vertex(atom->tag[i]) >= 0) ++mine;
    MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
    if (all == 0) continue;
    if (fix->box_change)
      error->all(FLERR,
                 "Fix {} ({}) would move {} control points and the box as if they were independent particles, without "
                 "the mass matrix of the surface: use fix hd/langevin and fix hd/tension",
                 fix->id, fix->style, all);
    warned.emplace_back(fix->id);
    if (comm->me == 0)
      error->warning(FLERR,
                     "Fix {} ({}) moves {} control points as independent particles: it ignores the "
                     "mass matrix of the surface, and waves are too slow; use fix hd/nve, "
                     "hd/langevin or hd/brownian",
                     fix->id, fix->style, all);
  }
}
