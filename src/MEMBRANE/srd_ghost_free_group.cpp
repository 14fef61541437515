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

#include "srd_ghost_free_group.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "group.h"
#include "neighbor.h"
#include "srd_force_styles.h"

#include <vector>

using namespace LAMMPS_NS;

// of LAMMPS' group command
static constexpr int MOST_GROUPS = 32;

/* ---------------------------------------------------------------------- */

GhostFreeGroup::GhostFreeGroup(LAMMPS *lmp, int igroup, std::string name) :
    Pointers(lmp), groupbit(group->bitmask[igroup]), name(std::move(name))
{
}

GhostFreeGroup::~GhostFreeGroup()
{
  restore();
}

void GhostFreeGroup::init(bool wanted)
{
  if (made && !(wanted && !feel_force_styles(lmp, groupbit))) restore();
  if (!made && wanted && possible()) {
    const int rest = group->find_or_create(name.c_str());
    atom->firstgroupname = utils::strdup(name);
    atom->firstgroup = rest;
    sortfreq_before = atom->sortfreq;
    atom->sortfreq = 0;    // sorting would undo the order of groups
    neighbor->includegroup = rest;
    made = true;
  }
  if (made) exchange_only(name);    // again, for the user may have changed the comm_style
  update();
}

void GhostFreeGroup::update()
{
  if (!made) return;
  const int bit = group->bitmask[atom->firstgroup];
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit)
      atom->mask[i] &= ~bit;
    else
      atom->mask[i] |= bit;
}

void GhostFreeGroup::exchange_only(std::string whose)
{
  char key[] = "group";
  char *arg[2] = {key, whose.data()};
  comm->modify_params(2, arg);
}

bool GhostFreeGroup::possible()
{
  if (atom->firstgroupname || neighbor->includegroup) return false;
  if (group->find(name) < 0 && group->ngroup >= MOST_GROUPS) {
    if (comm->me == 0)
      error->warning(FLERR, "There are too many groups to keep solvent out of the ghost exchange");
    return false;
  }
  return !feel_force_styles(lmp, groupbit);
}

/* ----------------------------------------------------------------------
   the group stays, for the user may have come to use it. At LAMMPS' end some of these are gone
------------------------------------------------------------------------- */

void GhostFreeGroup::restore()
{
  if (!made) return;
  made = false;
  if (comm && group) exchange_only("all");
  if (neighbor) neighbor->includegroup = 0;
  if (!atom) return;
  delete[] atom->firstgroupname;
  atom->firstgroupname = nullptr;
  atom->firstgroup = -1;
  atom->sortfreq = sortfreq_before;
}
