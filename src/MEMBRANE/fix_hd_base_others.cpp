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

// What FixHDBase has to do with other fixes, and they with it.

#include "fix_hd_base.h"

#include "error.h"
#include "force.h"
#include "mesh_group.h"
#include "modify.h"

#include <cmath>

using namespace LAMMPS_NS;

// two fixes have the same temperature if they differ by less than this part of it
static constexpr double SAME = 1.0e-9;

/* ---------------------------------------------------------------------- */

void FixHDBase::check_other_integrators()
{
  for (auto &other : modify->get_fix_list()) {
    if (other != this && other->time_integrate && groups_meet(lmp, groupbit, other->groupbit))
      error->all(FLERR, "Control points of fix {} are also moved by fix {} ({}): use groups without common atoms", id,
                 other->id, other->style);
  }
}

/* ---------------------------------------------------------------------- */

FixHDBase *FixHDBase::of_group(LAMMPS *lmp, int groupbit, const std::string &user)
{
  FixHDBase *found = nullptr;
  for (auto &fix : lmp->modify->get_fix_list()) {
    auto *integrator = dynamic_cast<FixHDBase *>(fix);
    if (!integrator || !groups_meet(lmp, groupbit, integrator->groupbit)) continue;
    if (found &&
        (found->mass_settings().kind != integrator->mass_settings().kind || found->modes() != integrator->modes() ||
         found->drag_coefficient() != integrator->drag_coefficient()))
      lmp->error->all(FLERR, "{}: fixes {} and {} move atoms of the group with different mass matrices; "
                      "use a group of one of them", user, found->id, integrator->id);
    if (!found) found = integrator;
  }
  return found;
}

std::string FixHDBase::other_temperature(LAMMPS *lmp, const Fix *user, double temperature)
{
  for (auto &fix : lmp->modify->get_fix_list()) {
    const auto *integrator = dynamic_cast<FixHDBase *>(fix);
    if (!integrator || !groups_meet(lmp, user->groupbit, integrator->groupbit)) continue;
    const double other = integrator->sampled_kT() / lmp->force->boltz;
    if (other > 0.0 && std::fabs(other - temperature) > SAME * temperature)
      return fmt::format("Fix {} has the temperature {:.6g}, and fix {} ({}) samples at {:.6g}: they need one temperature, "
                         "all the time", user->style, temperature, fix->id, fix->style, other);
  }
  return "";
}

void FixHDBase::atoms_renumbered(LAMMPS *lmp)
{
  for (auto &fix : lmp->modify->get_fix_list())
    if (auto *integrator = dynamic_cast<FixHDBase *>(fix)) integrator->forces_changed();
}
