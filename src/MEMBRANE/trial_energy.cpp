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

#include "trial_energy.h"

#include "angle.h"
#include "atom.h"
#include "bond.h"
#include "comm.h"
#include "compute.h"
#include "dihedral.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "fix_hd_base.h"
#include "force.h"
#include "improper.h"
#include "integrate.h"
#include "kspace.h"
#include "modify.h"
#include "pair.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;

// their forces are noise, the same for the whole of a step
static constexpr const char *NOISE[] = {"^langevin", "^qtb", "^ttm"};

// they count steps by calls for their forces
static constexpr const char *STATEFUL[] = {"^colvars", "^plumed", "^imd", "^lb/", "^smd", "^flow/gauss", "^electron/stopping"};

template <class Patterns> static bool is_one_of(const Fix *fix, const Patterns &patterns)
{
  return std::any_of(std::begin(patterns), std::end(patterns),
                     [fix](const char *pattern) { return utils::strmatch(fix->style, pattern); });
}

/* ---------------------------------------------------------------------- */

TrialEnergy::TrialEnergy(LAMMPS *lmp, std::string user) :
    Pointers(lmp), user(std::move(user)), pe(nullptr), with_noise(false), last(0.0), last_step(-1)
{
}

void TrialEnergy::init()
{
  pe = modify->get_compute_by_id("thermo_pe");
  if (!pe) error->all(FLERR, "{}: compute thermo_pe is missing: it has the energy", user);
  with_noise = false;
  last_step = -1;
  const auto &fixes = modify->get_fix_list();
  for (size_t i = 0; i < fixes.size(); ++i) {
    const Fix *fix = fixes[i];
    if (!(modify->fmask[i] & FixConst::POST_FORCE)) continue;
    if (is_one_of(fix, STATEFUL))
      error->all(FLERR, "{}: the energy of fix {} ({}) after a trial move is not known: leave one of them out", user,
                 fix->id, fix->style);
    with_noise = with_noise || is_one_of(fix, NOISE);
    if (fix->energy_global_flag && !fix->thermo_energy && comm->me == 0)
      error->warning(FLERR, "{}: the energy of fix {} ({}) does not count in trial moves: say fix_modify {} energy yes",
                     user, fix->id, fix->style, fix->id);
  }
}

void TrialEnergy::expect(bigint step)
{
  pe->addstep(step);
}

/* ----------------------------------------------------------------------
   rest: forces now that a new evaluation would not give
------------------------------------------------------------------------- */

double TrialEnergy::begin()
{
  const int n = 3 * atom->nlocal;
  forces.assign(n ? atom->f[0] : nullptr, n ? atom->f[0] + n : nullptr);
  if (with_noise) {
    last = evaluate();
    rest.resize(n);
    for (int i = 0; i < n; ++i) rest[i] = forces[i] - atom->f[0][i];
  } else if (last_step != update->ntimestep)
    last = pe->compute_scalar();
  last_step = update->ntimestep;
  return last;
}

double TrialEnergy::evaluate()
{
  update->eflag_global = update->ntimestep;
  return forces_and_energy();
}

/* ----------------------------------------------------------------------
   as Verlet::run() has it, with what this step tallies
------------------------------------------------------------------------- */

double TrialEnergy::forces_and_energy()
{
  const auto due = [this](bigint step) { return step == update->ntimestep; };
  const int eflag = ENERGY_GLOBAL | (due(update->eflag_atom) ? ENERGY_ATOM : 0);
  const int vflag = (due(update->vflag_global) ? (force->newton_pair ? VIRIAL_FDOTR : VIRIAL_PAIR) : 0) |
      (due(update->vflag_atom) ? VIRIAL_ATOM | VIRIAL_CENTROID : 0);

  comm->forward_comm();
  update->integrate->force_clear();
  if (modify->n_pre_force) modify->pre_force(vflag);
  if (force->pair && force->pair->compute_flag) force->pair->compute(eflag, vflag);
  if (atom->molecular != Atom::ATOMIC) {
    if (force->bond) force->bond->compute(eflag, vflag);
    if (force->angle) force->angle->compute(eflag, vflag);
    if (force->dihedral) force->dihedral->compute(eflag, vflag);
    if (force->improper) force->improper->compute(eflag, vflag);
  }
  if (force->kspace && force->kspace->compute_flag) {
    if (domain->box_change) force->kspace->setup();
    force->kspace->compute(eflag, vflag);
  }
  if (modify->n_pre_reverse) modify->pre_reverse(eflag, vflag);
  if (force->newton) comm->reverse_comm();

  const auto &fixes = modify->get_fix_list();
  for (size_t i = 0; i < fixes.size(); ++i)
    if (modify->fmask[i] & FixConst::POST_FORCE && !is_one_of(fixes[i], NOISE)) fixes[i]->post_force(vflag);

  return pe->compute_scalar();
}

void TrialEnergy::keep()
{
  last = pe->scalar;
  if (with_noise)
    for (size_t i = 0; i < rest.size(); ++i) atom->f[0][i] += rest[i];
  resume();
}

void TrialEnergy::put_back()
{
  evaluate();
  std::copy(forces.begin(), forces.end(), atom->nlocal ? atom->f[0] : nullptr);
  resume();
}

// what others have worked out in this step is worth nothing now

void TrialEnergy::resume()
{
  modify->clearstep_compute();
  for (auto &fix : modify->get_fix_list())
    if (auto *integrator = dynamic_cast<FixHDBase *>(fix)) integrator->forces_changed();
}
