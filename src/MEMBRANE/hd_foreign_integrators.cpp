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
#include "mesh_group.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <initializer_list>

using namespace LAMMPS_NS;

static bool is_one_of(const char *style, std::initializer_list<const char *> patterns)
{
  return std::any_of(patterns.begin(), patterns.end(), [style](const char *pattern) { return utils::strmatch(style, pattern); });
}

/* ---------------------------------------------------------------------- */

void HDForeignIntegrators::warn(const DistributedMesh &mesh)
{
  for (auto &fix : modify->get_fix_list()) {
    if (!fix->time_integrate) continue;

    // rigid and prescribed motion is the same with any mass matrix

    if (is_one_of(fix->style, {"^hd/", "^move", "^rigid", "^nve/noforce"})) continue;
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

/* ---------------------------------------------------------------------- */

void LAMMPS_NS::check_fixes_of_points(LAMMPS *lmp, const Fix *user, bool coupled, bool sampling, bool modes)
{
  if (lmp->update->whichflag != 1) return;    // minimizations know no masses
  const Atom *atom = lmp->atom;
  for (auto &fix : lmp->modify->get_fix_list()) {
    const bool turns = is_one_of(fix->style, {"^wall/reflect", "^oneway"});
    const bool shifts = modes && is_one_of(fix->style, {"^recenter", "^momentum"});
    const bool takes = is_one_of(fix->style, {"^setforce", "^lineforce", "^planeforce", "^aveforce"});
    if (!(turns || shifts || takes) || !coupled || !groups_meet(lmp, user->groupbit, fix->groupbit)) continue;
    if (shifts)
      lmp->error->all(FLERR, "Fix {} modes: fix {} ({}) takes membranes out of their modes, which have no motion as a whole: "
                             "leave it out", user->style, fix->id, fix->style);
    if (turns && (sampling || modes))
      lmp->error->all(FLERR, "Fix {}: fix {} ({}) turns velocities of single points, and {} moves them together: use a wall "
                             "that acts by forces, such as fix wall/harmonic", user->style, fix->id, fix->style,
                      modes ? "a mode" : "mass sampling");
    int mine = 0, some;
    for (int i = 0; i < atom->nlocal; ++i)
      if (atom->mask[i] & user->groupbit && !(atom->mask[i] & fix->groupbit)) mine = 1;
    MPI_Allreduce(&mine, &some, 1, MPI_INT, MPI_MAX, lmp->world);
    if (lmp->comm->me != 0 || (takes && !some)) continue;
    if (turns)
      lmp->error->warning(FLERR, "Fix {} ({}) turns velocities of single points, which masses couple: energy is not kept; "
                                 "use a wall that acts by forces, such as fix wall/harmonic, or mass lumped", fix->id, fix->style);
    else
      lmp->error->warning(FLERR, "Fix {} ({}) takes forces from some of the points that fix {} ({}) moves, which masses couple: "
                                 "they move all the same, and energy grows; hold points with fix spring/self, or use mass lumped",
                          fix->id, fix->style, user->id, user->style);
  }
}
