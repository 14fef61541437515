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

#include "fix_hd_langevin.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

// of mass sampling: both together bias averages, see Howto_membrane_accuracy
static constexpr double LONG_STEP = 0.4, LITTLE_FRICTION = 2.0;

/* ---------------------------------------------------------------------- */

FixHDLangevin::FixHDLangevin(LAMMPS *lmp, int narg, char **arg) :
    FixHDBase(lmp, narg, arg), ratio(atom->ntypes + 1, 1.0), scaled(false), tally(false),
    with_measure(true), energy(0.0), dt(0.0)
{
  if (narg < 7) utils::missing_cmd_args(FLERR, "fix hd/langevin", error);
  scalar_flag = global_freq = extscalar = 1;
  energy_global_flag = ecouple_flag = 1;
  restart_global = 1;

  t_start = utils::numeric(FLERR, arg[3], false, lmp);
  t_stop = utils::numeric(FLERR, arg[4], false, lmp);
  const bool no_damp = strcmp(arg[5], "NULL") == 0;
  damp = no_damp ? 0.0 : utils::numeric(FLERR, arg[5], false, lmp);
  seed = utils::bnumeric(FLERR, arg[6], false, lmp);
  if (t_start < 0.0 || t_stop < 0.0)
    error->all(FLERR, "Fix hd/langevin temperatures {} and {} must not be negative", arg[3],
               arg[4]);
  if (!no_damp && damp <= 0.0) error->all(FLERR, "Fix hd/langevin damping time {} must be positive", arg[5]);
  if (seed <= 0) error->all(FLERR, "Fix hd/langevin seed {} must be positive", arg[6]);

  bool measure_asked = false;
  int iarg = 7;
  while (iarg < narg) {
    if (const int used = mass.parse(iarg, narg, arg, true)) {
      iarg += used;
    } else if (strcmp(arg[iarg], "scale") == 0) {
      if (iarg + 3 > narg) utils::missing_cmd_args(FLERR, "fix hd/langevin scale", error);
      const int itype = utils::expand_type_int(FLERR, arg[iarg + 1], Atom::ATOM, lmp);
      if (itype < 1 || itype > atom->ntypes)
        error->all(FLERR, "Fix hd/langevin scale type {} does not exist", arg[iarg + 1]);
      ratio[itype] = utils::numeric(FLERR, arg[iarg + 2], false, lmp);
      if (ratio[itype] <= 0.0)
        error->all(FLERR, "Fix hd/langevin scale ratio {} must be positive", arg[iarg + 2]);
      scaled = true;
      iarg += 3;
    } else if (strcmp(arg[iarg], "tally") == 0) {
      if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "fix hd/langevin tally", error);
      tally = utils::logical(FLERR, arg[iarg + 1], false, lmp);
      iarg += 2;
    } else if (strcmp(arg[iarg], "measure") == 0) {
      if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "fix hd/langevin measure", error);
      with_measure = measure_asked = utils::logical(FLERR, arg[iarg + 1], false, lmp);
      if (with_measure && t_start == 0.0 && t_stop == 0.0)
        error->all(FLERR, "Fix hd/langevin measure yes needs a temperature: there is no measure at 0, "
                          "leave it out");
      iarg += 2;
    } else
      error->all(FLERR,
                 "Unknown fix hd/langevin keyword {}; known are: mass, solver, tol, scale, tally, "
                 "measure, modes, relax",
                 arg[iarg]);
  }
  if (no_damp != (modes() && modes()->has_friction()))
    error->all(FLERR, no_damp ? "Fix hd/langevin damping time NULL: without relax it must be a number"
                              : "Fix hd/langevin relax has the friction of each mode: say NULL for the damping time");
  if (modes() && scaled) error->all(FLERR, "Fix hd/langevin scale is friction of points: use relax with modes");
  if (modes() && measure_asked)
    error->all(FLERR, "Fix hd/langevin measure yes is that of control points that move freely: leave it out with "
                      "modes");
  if (modes()) with_measure = false;
  measure.on = with_measure && (t_start > 0.0 || t_stop > 0.0);
  measure.tally = tally;
  if (!scaled && !no_damp) noise_seed = seed;
}

int FixHDLangevin::setmask()
{
  return INITIAL_INTEGRATE | PRE_FORCE | FINAL_INTEGRATE;
}

void FixHDLangevin::init()
{
  FixHDBase::init();
  measure.kT = kT();
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix hd/langevin does not work with run_style respa");
  reset_dt();
}

void FixHDLangevin::setup(int vflag)
{
  FixHDBase::setup(vflag);
  if (scaled && !mass.matrix().has_vertex_friction())
    error->all(FLERR, "Fix hd/langevin scale needs mass vertex or lumped");
  if (sampling() && dt > LONG_STEP && damp > LITTLE_FRICTION && comm->me == 0)
    error->warning(FLERR,
                   "Fix hd/langevin mass sampling: with the timestep {} and damp {} long waves lose some "
                   "percent of their power: use damp 1, or a timestep of {}",
                   dt, damp, LONG_STEP);
}

void FixHDLangevin::reset_dt()
{
  dt = update->dt;
}

/* ----------------------------------------------------------------------
   B A O A B [B. Leimkuhler and C. Matthews, Appl. Math. Res. Express 2013, 34]:
   half a kick, half a drift, exact friction and noise, half a drift, and after the new forces
   half a kick. Momenta p = M v and, since M is constant, velocities are the same integrator.
------------------------------------------------------------------------- */

void FixHDLangevin::initial_integrate(int)
{
  set_measure();
  if (has_foreign_velocities()) stop_points();
  hold_on();
  const double bath = energy;
  kick_and_drift(0.5 * dt, 0.5 * dt);
  thermalize();
  drift(0.5 * dt);
  if (step_back(0.5 * dt)) energy = bath;
}

void FixHDLangevin::final_integrate()
{
  accelerate();
  kick(0.5 * dt);
}

double FixHDLangevin::kT() const
{
  const bigint length = update->endstep - update->beginstep;    // 0 outside of runs
  const double done =
      length > 0 ? static_cast<double>(update->ntimestep - update->beginstep) / length : 1.0;
  return force->boltz * (t_start + done * (t_stop - t_start));
}

/* ----------------------------------------------------------------------
   the energy of the measure is proportional to kT: what a change of kT gives to it comes from the bath
------------------------------------------------------------------------- */

void FixHDLangevin::set_measure()
{
  const double before = measure.kT;
  measure.kT = kT();
  if (!tally || !measure.on || measure.kT == before) return;
  double logs;
  MPI_Allreduce(&measure.logs, &logs, 1, MPI_DOUBLE, MPI_SUM, world);
  energy -= (measure.kT - before) * logs;
}

/* ----------------------------------------------------------------------
   friction gamma M with gamma = 1/damp: p' = -gamma p + noise, so v -> exp(-gamma dt) v + noise
   with <noise noise> = (1 - exp(-2 gamma dt)) kT M^-1
------------------------------------------------------------------------- */

void FixHDLangevin::thermalize()
{
  const double kT_mass = kT() / force->mvv2e;
  const double before = tally ? kinetic() : 0.0;
  if (scaled) {
    const MeshPart &part = mass.part();
    std::vector<double> keep(part.owned);
    for (int i = 0; i < part.owned; ++i)
      keep[i] = std::exp(-dt / (damp * ratio[atom->type[part.atom_of(i)]]));
    relax(keep, kT_mass, seed);
  } else if (mass.matrix().has_own_friction()) {
    relax_modes(dt, kT_mass, seed);
  } else
    relax(std::exp(-dt / damp), kT_mass);
  if (tally) energy += before - kinetic();
}

// so that the first motion is that of velocities of its own

void FixHDLangevin::stop_points()
{
  if (tally) energy += kinetic();
  const MeshPart &part = mass.part();
  for (int i = 0; i < part.owned; ++i) std::fill_n(atom->v[part.atom_of(i)], 3, 0.0);
}

double FixHDLangevin::kinetic()
{
  double t[6];
  mass.kinetic(t);
  return 0.5 * force->mvv2e * (t[0] + t[1] + t[2]);
}

void FixHDLangevin::reset_target(double t_new)
{
  t_start = t_stop = t_new;
  measure.on = with_measure && t_new > 0.0;
}

/* ----------------------------------------------------------------------
   energy the bath has taken: pe + ke + this is conserved up to the timestep error
------------------------------------------------------------------------- */

double FixHDLangevin::compute_scalar()
{
  return tally ? energy : 0.0;
}

void FixHDLangevin::archive(RestartArchive &file)
{
  FixHDBase::archive(file);
  file(energy);
}
