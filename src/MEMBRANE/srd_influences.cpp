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

#include "srd_influences.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "fix_deform.h"
#include "group.h"
#include "modify.h"
#include "srd_force_styles.h"
#include "srd_solvent.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ---------------------------------------------------------------------- */

void SRDInfluences::init(const SRDSolvent &solvent)
{
  check_integrators(solvent);
  find(solvent);
}

void SRDInfluences::check_integrators(const SRDSolvent &solvent)
{
  for (auto &other : modify->get_fix_list()) {
    if (other == self || !other->time_integrate) continue;
    int mine = 0, moved;
    for (int i = 0; i < atom->nlocal; ++i)
      if (solvent.has(i) && atom->mask[i] & other->groupbit) mine = 1;
    MPI_Allreduce(&mine, &moved, 1, MPI_INT, MPI_MAX, world);
    if (moved)
      error->all(
          FLERR,
          "Fix srd/mesh moves its solvent itself, and fix {} ({}) moves some of it, too: use "
          "groups without common atoms",
          other->id, other->style);
  }
}

// what one of them takes along with the box and the other does not would pass through it

void SRDInfluences::check_box_movers(const SRDSolvent &solvent, int membranes)
{
  for (auto &fix : modify->get_fix_list()) {
    const auto *deform = dynamic_cast<FixDeform *>(fix);
    if (!(deform && deform->remapflag == Domain::X_REMAP) && !utils::strmatch(fix->style, "^hd/tension")) continue;
    int mine[2] = {0, 0}, any[2];    // not in its group, in it
    for (int i = 0; i < atom->nlocal; ++i)
      if (solvent.has(i) || atom->mask[i] & group->bitmask[membranes])
        mine[(atom->mask[i] & fix->groupbit) != 0] = 1;
    MPI_Allreduce(mine, any, 2, MPI_INT, MPI_MAX, world);
    if (any[0] && any[1])
      error->all(
          FLERR,
          "Fix srd/mesh: fix {} ({}) stretches the box with the atoms in it, and needs all solvent and all "
          "membranes of group {} in its group {}",
          fix->id, fix->style, group->names[membranes], group->names[fix->igroup]);
  }
}

/* ----------------------------------------------------------------------
   Most solvent feels no force: then there is none to read, nor to clear. And where no fix that has
   solvent in its group acts at other points of a step than forces do, only this fix changes its
   velocities and places, so they are known in advance. Some fixes act on more than their group
------------------------------------------------------------------------- */

void SRDInfluences::find(const SRDSolvent &solvent)
{
  static constexpr const char *OBSERVERS[] = {"^ave/",   "^print$",  "^vector$", "^store/",
                                              "^STORE/", "^balance", "^halt$"};
  static constexpr const char *UNKNOWN[] = {"^recenter", "^python/", "^external"};
  const auto is_one_of = [](const Fix *fix, const auto &patterns) {
    return std::any_of(std::begin(patterns), std::end(patterns), [fix](const char *pattern) {
      return utils::strmatch(fix->style, pattern);
    });
  };
  constexpr int BY_FORCES = POST_FORCE | PRE_REVERSE;
  constexpr int OTHERWISE = INITIAL_INTEGRATE | POST_INTEGRATE | PRE_EXCHANGE | PRE_NEIGHBOR |
      POST_NEIGHBOR | PRE_FORCE | FINAL_INTEGRATE | END_OF_STEP;
  int mine[2] = {0, 0}, any[2];    // forces, velocities
  const auto &fixes = modify->get_fix_list();
  for (size_t f = 0; f < fixes.size(); ++f) {
    if (fixes[f] == self) continue;
    const int mask = modify->fmask[f];
    const bool observes = is_one_of(fixes[f], OBSERVERS);
    const int acts[2] = {mask & BY_FORCES, observes ? 0 : mask & OTHERWISE};
    if (is_one_of(fixes[f], UNKNOWN)) mine[1] = 1;
    for (int what = 0; what < 2; ++what)
      for (int i = 0; i < atom->nlocal && acts[what] && !mine[what]; ++i)
        if (solvent.has(i) &&
            (group->dynamic[fixes[f]->igroup] || atom->mask[i] & fixes[f]->groupbit))
          mine[what] = 1;
  }
  MPI_Allreduce(mine, any, 2, MPI_INT, MPI_MAX, world);
  have_forces = feel_force_styles(lmp, self->groupbit) || any[0];
  velocities_stay = !any[1];
}
