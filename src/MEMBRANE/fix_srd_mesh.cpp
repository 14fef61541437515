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

#include "fix_srd_mesh.h"

#include "atom.h"
#include "comm.h"
#include "mesh_distributed.h"
#include "domain.h"
#include "error.h"
#include "fix_deform.h"
#include "fix_hd_base.h"
#include "force.h"
#include "group.h"
#include "modify.h"
#include "pair.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;
using Membrane_NS::CollisionRule;
using Inside = SRDMeshArguments::Inside;
using Shift = SRDMeshArguments::Shift;

// with shorter free paths than these, in cells, solvent meets the same partners again and again
static constexpr double SHORT_PATH = 0.1, SHIFT_PATH = 0.6;

// default modulus in kT that keeps faces from turning over among solvent
static constexpr double STIFF_MESH = 10.0;

/* ---------------------------------------------------------------------- */

FixSRDMesh::FixSRDMesh(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), given(SRDMeshArguments::parse(lmp, narg, arg)), membrane(given.membranes),
    temperature(given.temperature), cell_settings(given.cells), solvent(lmp, igroup), streaming(lmp),
    have_obstacle(false), running(false), membranes_join(false),
    aside(lmp, igroup, std::string("not_solvent_of_") + id),
    num_solvent(0), solvent_mass(1.0), filling(0.0), velocities_set(false), have_forces(false),
    velocities_stay(false), clear_forces(false), values{}, carried{}, sampled(-1)
{
  time_integrate = 1;
  force_reneighbor = 1;
  next_reneighbor = -1;
  restart_global = 1;
  vector_flag = 1;
  size_vector = NUM_VALUES;
  global_freq = 1;
  extvector = 0;

  nevery = given.every;
  streaming.walls = given.walls;

  if (domain->dimension != 3) error->all(FLERR, "Fix srd/mesh needs dimension 3");
  if (membrane < 0) return;
  mass = std::make_unique<HDMass>(lmp, membrane, "Fix srd/mesh");
  SurfaceObstacle::Settings settings;
  settings.membranes = membrane;
  settings.seed = given.seed;
  settings.no_slip = given.noslip;
  settings.control = given.control;
  settings.level = given.level;
  settings.most_bounces = given.bounces;
  settings.spacing = given.search;
  settings.stray = cell_settings.size;
  settings.user = "Fix srd/mesh";
  obstacle = std::make_unique<SurfaceObstacle>(lmp, settings);
  grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
}

FixSRDMesh::~FixSRDMesh()
{
  if (obstacle) atom->delete_callback(id, Atom::GROW);
}

/* ---------------------------------------------------------------------- */

int FixSRDMesh::setmask()
{
  return INITIAL_INTEGRATE | POST_INTEGRATE | PRE_NEIGHBOR | PRE_FORCE | MIN_PRE_FORCE |
      FINAL_INTEGRATE | PRE_EXCHANGE | END_OF_STEP | POST_RUN;
}

double FixSRDMesh::kT() const
{
  return force->boltz * temperature / force->mvv2e;
}

/* ---------------------------------------------------------------------- */

void FixSRDMesh::init()
{
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix srd/mesh does not work with run_style respa");
  running = false;
  solvent.refresh();
  check_group();
  find_influences();
  aside.init(!given.ghosts);
  clear_forces = aside.active();
  streaming.find_walls();

  if (mass) {
    if (auto *integrator = FixHDBase::of_group(lmp, group->bitmask[membrane], "Fix srd/mesh"))
      mass->settings = integrator->mass_settings();
    mass->settings.direct = false;    // it solves nothing
    if (group->count(membrane) > 0) {
      check_other_solvents();
      check_box_movers();
      mass->init();
      obstacle->init();
      keep_meshes_in_shape();
    }
  }
  prepare_cells();
}

/* ----------------------------------------------------------------------
   impulses shake control points along the fluid membrane, too, where nothing holds them: within a few
   hundred steps faces would turn over
------------------------------------------------------------------------- */

void FixSRDMesh::keep_meshes_in_shape()
{
  int dim;
  Pair *helfrich = force->pair_match("helfrich", 1);
  auto *regularize =
      helfrich ? static_cast<double *>(helfrich->extract("default_regularize", dim)) : nullptr;
  if (!regularize || mass->count() == 0) return;
  *regularize = STIFF_MESH * force->boltz * temperature;
  if (comm->me == 0)
    utils::logmesg(lmp,
                   "Fix srd/mesh: meshes are kept in shape with regularize {:.6g} ({} kT) where pair_coeff "
                   "has none\n",
                   *regularize, STIFF_MESH);
}

/* ----------------------------------------------------------------------
   solvent: some, no control points among it, moved by this fix alone
------------------------------------------------------------------------- */

void FixSRDMesh::check_group()
{
  num_solvent = solvent.total();
  if (num_solvent == 0)
    error->all(FLERR,
               "Fix srd/mesh: there is no solvent in group {}: use create_atoms or "
               "create_solvent",
               group->names[igroup]);

  tagint bad[2] = {0, 0}, any[2];    // no mass, in both groups
  const int membrane_bit = membrane >= 0 ? group->bitmask[membrane] : 0;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!solvent.has(i)) continue;
    if (!(solvent.mass()[i] > 0.0)) bad[0] = MAX(bad[0], atom->tag[i]);
    if (atom->mask[i] & membrane_bit) bad[1] = MAX(bad[1], atom->tag[i]);
  }
  MPI_Allreduce(bad, any, 2, MPI_LMP_TAGINT, MPI_MAX, world);
  if (any[0]) error->all(FLERR, "Fix srd/mesh: solvent atom {} has no positive mass", any[0]);
  if (any[1])
    error->all(FLERR, "Fix srd/mesh: atom {} is both solvent and in the group of membranes",
               any[1]);

  for (auto &other : modify->get_fix_list()) {
    if (other == this || !other->time_integrate) continue;
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

/* ----------------------------------------------------------------------
   two fixes would each take the other's impulses for motion of the membrane without solvent
------------------------------------------------------------------------- */

void FixSRDMesh::check_other_solvents()
{
  for (auto &fix : modify->get_fix_by_style("^srd/mesh$")) {
    auto *other = dynamic_cast<FixSRDMesh *>(fix);
    if (!other || other == this || other->membrane < 0) continue;
    int mine = 0, any;
    const int both = group->bitmask[membrane] | group->bitmask[other->membrane];
    for (int i = 0; i < atom->nlocal; ++i)
      if ((atom->mask[i] & both) == both) mine = 1;
    MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, world);
    if (any)
      error->all(FLERR,
                 "Fix srd/mesh: membranes of group {} are also those of fix {}: one fix must have all "
                 "solvent around a membrane",
                 group->names[membrane], other->id);
  }
}

// what one of them takes along with the box and the other does not would pass through it

void FixSRDMesh::check_box_movers()
{
  for (auto &fix : modify->get_fix_by_style("^deform")) {
    const auto *deform = dynamic_cast<FixDeform *>(fix);
    if (!deform || deform->remapflag != Domain::X_REMAP) continue;
    int mine[2] = {0, 0}, any[2];    // not in its group, in it
    for (int i = 0; i < atom->nlocal; ++i)
      if (solvent.has(i) || atom->mask[i] & group->bitmask[membrane])
        mine[(atom->mask[i] & fix->groupbit) != 0] = 1;
    MPI_Allreduce(mine, any, 2, MPI_INT, MPI_MAX, world);
    if (any[0] && any[1])
      error->all(FLERR,
                 "Fix srd/mesh: fix {} (deform) with remap x needs all solvent and all membranes of group {} in "
                 "its group {}",
                 fix->id, group->names[membrane], group->names[fix->igroup]);
  }
}

/* ----------------------------------------------------------------------
   Most solvent feels no force: then there is none to read, nor to clear. And where no fix that has
   solvent in its group acts at other points of a step than forces do, only this fix changes its velocities
   and places, so they are known in advance. Some fixes act on more than their group
------------------------------------------------------------------------- */

void FixSRDMesh::find_influences()
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
    if (fixes[f] == this) continue;
    const int mask = modify->fmask[f];
    const bool observes = is_one_of(fixes[f], OBSERVERS);
    const int acts[2] = {mask & BY_FORCES, observes ? 0 : mask & OTHERWISE};
    if (is_one_of(fixes[f], UNKNOWN)) mine[1] = 1;
    for (int what = 0; what < 2; ++what)
      for (int i = 0; i < atom->nlocal && acts[what] && !mine[what]; ++i)
        if (solvent.has(i) && (group->dynamic[fixes[f]->igroup] || atom->mask[i] & fixes[f]->groupbit))
          mine[what] = 1;
  }
  if (force->pair && force->pair->cutsq)
    for (int i = 0; i < atom->nlocal && !mine[0]; ++i)
      for (int t = 1; t <= atom->ntypes && solvent.has(i); ++t)
        if (force->pair->cutsq[atom->type[i]][t] > 0.0) mine[0] = 1;
  MPI_Allreduce(mine, any, 2, MPI_INT, MPI_MAX, world);
  have_forces = any[0];
  velocities_stay = !any[1];
}

/* ----------------------------------------------------------------------
   cells, free path and what follows from them
------------------------------------------------------------------------- */

void FixSRDMesh::prepare_cells()
{
  double p[4];
  solvent.momentum(p);
  solvent_mass = p[3] / num_solvent;
  const double step = nevery * update->dt;
  if (given.lamda > 0.0)
    temperature = std::pow(given.lamda / step, 2) * solvent_mass * force->mvv2e / force->boltz;
  cell_settings.rule.kT = kT();
  values[FREE_PATH] = Membrane_NS::mean_free_path(kT(), solvent_mass, step);

  const double path = values[FREE_PATH] / cell_settings.size;
  cell_settings.shift = given.shift == Shift::YES || (given.shift == Shift::POSSIBLE && path < SHIFT_PATH);
  if (!cell_settings.shift && path < SHORT_PATH)
    error->all(FLERR,
               "Fix srd/mesh: a mean free path of {:.4g} cells is too short for a grid that stays: "
               "use shift yes, or a longer time between collisions",
               path);
  if (!cell_settings.shift && path < SHIFT_PATH && comm->me == 0)
    error->warning(FLERR,
                   "Fix srd/mesh: with a mean free path of {:.4g} cells and no shift, flow depends "
                   "on the velocity of the grid",
                   path);

  const bool first = !cells;
  cells = std::make_unique<SRDCells>(lmp, cell_settings);
  cells->grid.setup(cell_settings.size);
  SRDGrid &grid = cells->grid;
  filling = num_solvent * grid.cell_volume() / (domain->xprd * domain->yprd * domain->zprd);
  if (grid.deviation() > given.cubic_tolerance) {
    const std::string text = fmt::format(
        "Fix srd/mesh: cells of {:.6g} x {:.6g} x {:.6g} that fit the box differ from hgrid {} by "
        "more than {}: change the box or hgrid, or allow it with cubic warn {:.2g}",
        grid.edge(0), grid.edge(1), grid.edge(2), cell_settings.size, given.cubic_tolerance,
        std::ceil(100.0 * grid.deviation()) / 100.0);
    if (given.cubic_error) error->all(FLERR, text);
    if (comm->me == 0 && first) error->warning(FLERR, text);
  }

  const double edge = std::cbrt(grid.cell_volume());
  values[VISCOSITY] = cell_settings.rule.method == CollisionRule::Method::SRD
      ? Membrane_NS::srd_viscosity(filling, cell_settings.rule.angle, kT(), solvent_mass, edge,
                                   step)
      : Membrane_NS::at_viscosity(filling, kT(), solvent_mass, edge, step);
  if (first) report();
}

void FixSRDMesh::report()
{
  if (comm->me != 0) return;
  const SRDGrid &grid = cells->grid;
  utils::logmesg(
      lmp,
      "Fix srd/mesh: {} solvent atoms in {} x {} x {} cells of {:.6g} x {:.6g} x {:.6g}\n"
      "  atoms per cell = {:.6g}, mean free path = {:.6g}, viscosity = {:.6g}\n",
      num_solvent, grid.divisions(0), grid.divisions(1), grid.divisions(2), grid.edge(0),
      grid.edge(1), grid.edge(2), filling, values[FREE_PATH], values[VISCOSITY]);
}

// === Setup of a run

void FixSRDMesh::setup_pre_exchange()
{
  aside.update();
}

void FixSRDMesh::setup_pre_neighbor()
{
  pre_neighbor();
  zero_forces();
}

void FixSRDMesh::setup_pre_force(int)
{
  zero_forces();
  if (!velocities_set && given.set_velocities) maxwell();
  velocities_set = true;
}

void FixSRDMesh::setup(int)
{
  sampled = -1;
  have_obstacle = obstacle && group->count(membrane) > 0;
  membranes_join = have_obstacle && given.noslip;
  running = true;
  if (!have_obstacle) return;
  obstacle->forces_on_solvent = have_forces;
  obstacle->setup(solvent);
}

/* ----------------------------------------------------------------------
   Maxwell's distribution less its momentum, then scaled to the temperature
------------------------------------------------------------------------- */

void FixSRDMesh::maxwell()
{
  double **v = atom->v;
  for (int i = solvent.first(); i < solvent.last(); ++i)
    if (solvent.has(i))
      Membrane_NS::thermal_velocity(given.seed, update->ntimestep, atom->tag[i], kT(), solvent.mass()[i],
                                    v[i]);
  double p[4];
  solvent.momentum(p);
  double mine = 0.0, twice_energy;
  for (int i = solvent.first(); i < solvent.last(); ++i) {
    if (!solvent.has(i)) continue;
    for (int k = 0; k < 3; ++k) {
      v[i][k] -= p[k] / p[3];
      mine += solvent.mass()[i] * v[i][k] * v[i][k];
    }
  }
  MPI_Allreduce(&mine, &twice_energy, 1, MPI_DOUBLE, MPI_SUM, world);
  if (num_solvent < 2) return;
  const double scale = std::sqrt(3.0 * (num_solvent - 1) * kT() / twice_energy);
  for (int i = solvent.first(); i < solvent.last(); ++i)
    if (solvent.has(i))
      for (int k = 0; k < 3; ++k) v[i][k] *= scale;
}

// === A step

bool FixSRDMesh::is_due() const
{
  return update->ntimestep % nevery == 0;
}

void FixSRDMesh::initial_integrate(int)
{
  if (have_forces) kick();
}

void FixSRDMesh::final_integrate()
{
  if (have_forces) kick();
  if (have_obstacle) obstacle->remember();
}

void FixSRDMesh::post_run()
{
  if (have_obstacle && running) check_sides();
  if (obstacle) obstacle->forget();    // after it anybody may change velocities, and run pre no
}

void FixSRDMesh::kick()
{
  const double half = 0.5 * update->dt * force->ftm2v;
  double most = 0.0;
  for (int i = solvent.first(); i < solvent.last(); ++i) {
    if (!solvent.has(i)) continue;
    const double scale = half / solvent.mass()[i];
    double squared = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double change = scale * atom->f[i][k];
      atom->v[i][k] += change;
      squared += change * change;
    }
    most = MAX(most, squared);
  }
  if (obstacle) obstacle->kicked(std::sqrt(most));
}

/* ----------------------------------------------------------------------
   Point masses take part in the collisions of cells in the middle of a step, where their velocities
   are those of their paths and have the variance kT/m: the place that noise has in fix hd/langevin. At
   the end of a step velocities are smaller, for a wave of frequency w by (w dt)^2/4 of its energy, and
   to meet solvent with the one in cells and with the other at the surface would pump energy into it.
------------------------------------------------------------------------- */

void FixSRDMesh::post_integrate()
{
  const double dt = update->dt;
  const bool due = is_due();
  if (have_obstacle) {
    streaming.place_walls();
    obstacle->begin_step(dt);
    if (membranes_join && due) {
      stream_past_membranes(0.5 * dt, 0.5 * dt);
      wrap();
      collide();
      stream_past_membranes(0.5 * dt, nevery * dt);
    } else {
      const double wait = dt * (nevery - 1 - (update->ntimestep - 1) % nevery);
      stream_past_membranes(dt, wait + (membranes_join ? 0.5 : 1.0) * dt);
      if (due) wrap();
    }
  } else {
    streaming.stream(solvent, dt);
    if (due) wrap();
  }
  sampled = -1;
  if ((due && domain->deform_vremap) || (comm->nprocs > 1 && any_strayed()))
    next_reneighbor = update->ntimestep;
}

// velocities stay the same until the next collision in cells, if that is all that changes them

void FixSRDMesh::stream_past_membranes(double dt, double until_collision)
{
  if (!velocities_stay) obstacle->forget();
  obstacle->stream(solvent, streaming, dt, velocities_stay ? until_collision : dt);
}

void FixSRDMesh::wrap()
{
  if (!aside.active() || domain->deform_vremap) return;    // LAMMPS changes velocities, too
  constexpr int BLOCK = SRDGrid::BLOCK;
  int outside[BLOCK];
  for (int first = solvent.first(); first < solvent.last(); first += BLOCK) {
    const int count = MIN(BLOCK, solvent.last() - first);
    const int n = cells->grid.find_outside(atom->x[first], count, outside);
    for (int j = 0; j < n; ++j) {
      const int i = first + outside[j];
      if (solvent.has(i)) cells->grid.wrap(atom->x[i], atom->image[i]);
    }
  }
}

/* ----------------------------------------------------------------------
   solvent that has strayed too far goes to its new owner in this step: cells have to find it when it
   collides next, at the end of a step or in the middle of the next
------------------------------------------------------------------------- */

bool FixSRDMesh::any_strayed()
{
  int mine = 0, any;
  const double ahead = membranes_join ? 0.5 * update->dt : 0.0;
  for (int i = solvent.first(); i < solvent.last() && !mine; ++i) {
    double x[3];
    for (int k = 0; k < 3; ++k) x[k] = atom->x[i][k] + ahead * atom->v[i][k];
    mine = cells->grid.strayed(x) && solvent.has(i);
  }
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, world);
  return any;
}

void FixSRDMesh::pre_neighbor()
{
  solvent.refresh();
  if (obstacle) obstacle->forget();
  cells->grid.setup(cell_settings.size);
  if (!have_forces) zero_forces();
}

void FixSRDMesh::pre_force(int)
{
  if (have_forces) zero_forces();
}

void FixSRDMesh::end_of_step()
{
  if (!membranes_join) collide();
}

void FixSRDMesh::collide()
{
  if (domain->box_change) cells->grid.setup(cell_settings.size);
  if (membranes_join) obstacle->join_cells(*cells, update->ntimestep, kT());
  cells->collide(solvent, update->ntimestep, streaming.walls, filling, solvent_mass, sides());
  if (membranes_join) obstacle->leave_cells(*cells);
  if (have_obstacle) obstacle->forget();
}

void FixSRDMesh::min_pre_force(int)
{
  zero_forces();
}

void FixSRDMesh::zero_forces()
{
  if (!clear_forces) return;
  for (int i = solvent.first(); i < solvent.last(); ++i)
    if (solvent.has(i)) std::fill_n(atom->f[i], 3, 0.0);
}

// === Output

double FixSRDMesh::compute_vector(int i)
{
  if (!cells) return 0.0;
  if (sampled != update->ntimestep) sample();
  return values[i];
}

void FixSRDMesh::sample()
{
  sampled = update->ntimestep;
  solvent.refresh();
  if (have_obstacle && running) check_sides();
  const double unit = force->mvv2e / force->boltz;
  const auto thermal = cells->measure(solvent, sides());
  auto temperature_of = [unit](const Membrane_NS::CellEnergy &e) {
    return e.freedom > 0.0 ? unit * e.energy / e.freedom : 0.0;
  };
  values[TEMPERATURE] = temperature_of(thermal.all);
  values[TEMPERATURE_IN] = temperature_of(thermal.inside);
  values[TEMPERATURE_OUT] = temperature_of(thermal.outside);

  double p[4];
  solvent.momentum(p);
  std::copy_n(p, 3, values + MOMENTUM);
  if (mass && mass->count() > 0) {
    mass->refresh();
    Membrane_NS::VertexField v, pv;
    mass->part().load(atom->v, v);
    pv.resize(v.size());
    mass->matrix().multiply(v, pv);
    double sum[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < mass->part().owned; ++i)
      for (int k = 0; k < 3; ++k) sum[k] += pv[i].c[k];
    mass->part().sum(sum, 3);
    for (int k = 0; k < 3; ++k) values[MOMENTUM + k] += sum[k];
  }

  sample_obstacle();
  MPI_Allreduce(streaming.walls.impulse, values + WALLS, 3, MPI_DOUBLE, MPI_SUM, world);
  for (int i = 0; i < NUM_VALUES; ++i) values[i] += carried[i];
}

/* ---------------------------------------------------------------------- */

void FixSRDMesh::sample_obstacle()
{
  values[INSIDE] = 0.0;
  values[OUTSIDE] = static_cast<double>(num_solvent);
  if (!obstacle) return;
  constexpr int N = SurfaceObstacle::NUM_TALLIES;
  double sum[N];
  MPI_Allreduce(obstacle->tally, sum, N, MPI_DOUBLE, MPI_SUM, world);
  values[COLLISIONS] = sum[SurfaceObstacle::COLLISIONS];
  values[CROSSINGS] = sum[SurfaceObstacle::CROSSINGS];
  values[RESCUES] = sum[SurfaceObstacle::RESCUES];
  std::copy_n(sum + SurfaceObstacle::HANDED, 3, values + HANDED);
  values[NORMAL_IMPULSE] = sum[SurfaceObstacle::INNER] - sum[SurfaceObstacle::OUTER];

  if (!have_obstacle) return;
  const SurfaceRegions &regions = obstacle->regions;
  bigint mine = 0, all;
  for (int i = solvent.first(); i < solvent.last(); ++i)
    mine += solvent.has(i) && regions.is_inside(regions.region[i]);
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  values[INSIDE] = static_cast<double>(all);
  values[OUTSIDE] = static_cast<double>(num_solvent - all);
}

// solvent on the two sides of a membrane does not collide with each other

const int *FixSRDMesh::sides()
{
  if (!have_obstacle) return nullptr;
  const SurfaceRegions &regions = obstacle->regions;
  side.resize(atom->nlocal);
  regions.find_parities(solvent, side.data());
  for (int k = 0; k < 3; ++k) cells->flips[k] = regions.flips(k);
  return side.data();
}

void FixSRDMesh::check_sides()
{
  solvent.refresh();
  const bigint crossed = obstacle->check(solvent);
  if (!crossed || given.inside == Inside::IGNORE) return;
  const std::string text = fmt::format(
      "Fix srd/mesh: {} solvent atoms were on the wrong side of a membrane", crossed);
  if (given.inside == Inside::ERROR) error->all(FLERR, text);
  if (comm->me == 0) error->warning(FLERR, text + ", and were put back");
}

// === Per-atom data: the region of each solvent atom

void FixSRDMesh::grow_arrays(int nmax)
{
  obstacle->grow(nmax);
}

void FixSRDMesh::copy_arrays(int i, int j, int)
{
  obstacle->copy(i, j);
}

void FixSRDMesh::set_arrays(int i)
{
  obstacle->regions.region[i] = 0;
}

int FixSRDMesh::pack_exchange(int i, double *buf)
{
  buf[0] = obstacle->regions.region[i];
  return 1;
}

int FixSRDMesh::unpack_exchange(int i, double *buf)
{
  obstacle->regions.region[i] = static_cast<int>(buf[0]);
  return 1;
}

// === Restart

void FixSRDMesh::write_restart(FILE *fp)
{
  if (cells) sample();
  double list[NUM_VALUES + 1] = {};
  list[0] = velocities_set;
  for (int i : {(int) COLLISIONS, (int) CROSSINGS, (int) RESCUES, (int) HANDED, HANDED + 1,
                HANDED + 2, (int) NORMAL_IMPULSE, (int) WALLS, WALLS + 1, WALLS + 2})
    list[1 + i] = cells ? values[i] : carried[i];
  if (comm->me != 0) return;
  const int size = sizeof(list);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(list, sizeof(list), 1, fp);
}

void FixSRDMesh::restart(char *buf)
{
  double list[NUM_VALUES + 1];
  memcpy(list, buf, sizeof(list));
  velocities_set = list[0] != 0.0;
  std::copy_n(list + 1, (int) NUM_VALUES, carried);
}

double FixSRDMesh::memory_usage()
{
  return (cells ? cells->memory_usage() : 0.0) + (obstacle ? obstacle->memory_usage() : 0.0);
}
