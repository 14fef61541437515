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

#include "srd_surface_movers.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "fix_deform.h"
#include "fix_hd_base.h"
#include "force.h"
#include "group.h"
#include "mesh_box.h"
#include "mesh_group.h"
#include "modify.h"

#include <cstring>

using namespace LAMMPS_NS;
using Eigen::Matrix3d;
using Membrane_NS::MassKind;
using Membrane_NS::VertexField;

/* ---------------------------------------------------------------------- */

SurfaceMovers::SurfaceMovers(LAMMPS *lmp, int igroup, std::string user) :
    Pointers(lmp), user(std::move(user)), igroup(igroup), groupbit(group->bitmask[igroup]),
    takes_atoms(false)
{
}

void SurfaceMovers::init()
{
  find_integrators();
  find_box_movers();
}

/* ----------------------------------------------------------------------
   impulses act on momenta of point masses, or on something that never yields
------------------------------------------------------------------------- */

void SurfaceMovers::find_integrators()
{
  integrators.clear();
  for (auto &fix : modify->get_fix_list()) {
    auto *integrator = dynamic_cast<FixHDBase *>(fix);
    if (!integrator && !fix->time_integrate) continue;
    if (!groups_meet(lmp, groupbit, fix->groupbit)) continue;
    if (!integrator) {
      if (strcmp(fix->style, "move") == 0) continue;
      error->all(
          FLERR,
          "{}: the membranes of group {} are moved by fix {} ({}), which impulses of solvent "
          "cannot act on: use fix hd/nve or hd/langevin",
          user, group->names[igroup], fix->id, fix->style);
    }
    if (integrator->drag_coefficient() > 0.0)
      error->all(FLERR,
                 "{}: fix {} ({}) knows no momenta that solvent could change: use fix hd/nve or "
                 "hd/langevin",
                 user, fix->id, fix->style);
    if (integrator->mass_settings().kind != MassKind::VERTEX)
      error->all(FLERR, "{} needs point masses on the surface: use mass vertex in fix {} ({})",
                 user, fix->id, fix->style);
    if (integrator->modes())
      error->all(FLERR,
                 "{}: fix {} ({}) moves modes, and an impulse of solvent at a point would move all of them: move all "
                 "control points, or have relax eta in place of solvent",
                 user, fix->id, fix->style);
    integrator->remember_displacement();
    integrators.push_back(integrator);
  }
}

// === Integrators

bool SurfaceMovers::moves(int i) const
{
  for (const FixHDBase *integrator : integrators)
    if (atom->mask[i] & integrator->groupbit) return true;
  return false;
}

void SurfaceMovers::load_displacements(const std::vector<int> &place, VertexField &to) const
{
  for (FixHDBase *integrator : integrators) {
    const MeshPart &theirs = integrator->part();
    for (int i = 0; i < theirs.owned; ++i) {
      const int here = place[theirs.atom_of(i)];
      if (here >= 0) to[here] = integrator->displacement()[i];
    }
  }
}

void SurfaceMovers::load_accelerations(const std::vector<int> &place, VertexField &to) const
{
  for (FixHDBase *integrator : integrators) {
    const MeshPart &theirs = integrator->part();
    for (int i = 0; i < theirs.owned; ++i) {
      const int here = place[theirs.atom_of(i)];
      if (here >= 0)
        for (int k = 0; k < 3; ++k)
          to[here].c[k] = force->ftm2v * integrator->last_acceleration()[i].c[k];
    }
  }
}

/* ----------------------------------------------------------------------
   fix deform takes either all atoms along at the end of a step, or none: then images of atoms move; fix
   hd/tension takes them along
------------------------------------------------------------------------- */

void SurfaceMovers::find_box_movers()
{
  takes_atoms = false;
  for (auto &fix : modify->get_fix_by_style("^deform")) {
    const auto *deform = dynamic_cast<FixDeform *>(fix);
    if (!deform || deform->remapflag != Domain::X_REMAP) continue;
    const bool takes_membranes = groups_meet(lmp, groupbit, fix->groupbit);
    takes_atoms = takes_atoms || takes_membranes;
  }
  for (auto &fix : modify->get_fix_by_style("^hd/tension"))
    if (groups_meet(lmp, groupbit, fix->groupbit)) takes_atoms = true;
}

bool SurfaceMovers::images_move() const
{
  return domain->deform_flag && !takes_atoms;
}

Matrix3d SurfaceMovers::lattice_rate() const
{
  if (!images_move()) return Matrix3d::Zero();
  return box_vectors(domain->h_rate);
}
