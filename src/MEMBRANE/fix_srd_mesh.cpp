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
#include "domain.h"
#include "error.h"
#include "fix_hd_base.h"
#include "force.h"
#include "group.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;
using Inside = SRDMeshArguments::Inside;

// default modulus in kT that keeps faces from turning over among solvent
static constexpr double STIFF_MESH = 10.0;

// steps between looks for solvent on the wrong side: they do not depend on who reads the results
static constexpr int LOOK_EVERY = 100;

/* ---------------------------------------------------------------------- */

FixSRDMesh::FixSRDMesh(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), given(SRDMeshArguments::parse(lmp, narg, arg)), membrane(given.membranes),
    solvent(lmp, igroup), fluid(lmp, given), influences(lmp, this), streaming(lmp),
    observables(lmp), ghost_free(lmp, igroup, std::string("not_solvent_of_") + id),
    have_membranes(false), have_obstacle(false), running(false), membranes_join(false),
    velocities_set(false), clear_forces(false), stiffness(0.0), sampled(-1), natoms_after_run(-1),
    steps(0), measured{}, reported(false)
{
  time_integrate = 1;
  force_reneighbor = 1;
  next_reneighbor = -1;
  restart_global = 1;
  vector_flag = 1;
  size_vector = SRDObservables::NUM_VALUES;
  global_freq = 1;
  extvector = 0;

  nevery = given.every;
  streaming.walls = given.walls;
  if (domain->dimension != 3) error->all(FLERR, "Fix srd/mesh needs dimension 3");
  if (membrane < 0) return;
  create_attribute = 1;
  mass = std::make_unique<HDMass>(lmp, membrane, "Fix srd/mesh");
  SurfaceObstacle::Settings settings;
  settings.membranes = membrane;
  settings.seed = given.seed;
  settings.no_slip = given.noslip;
  settings.control = given.control;
  settings.level = given.level;
  settings.most_bounces = given.bounces;
  settings.spacing = given.search;
  settings.stray = given.cells.size;
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

/* ---------------------------------------------------------------------- */

void FixSRDMesh::init()
{
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix srd/mesh does not work with run_style respa");
  running = false;
  solvent.refresh();
  solvent.check(membrane >= 0 ? group->bitmask[membrane] : 0);
  influences.init(solvent);
  ghost_free.init(!given.ghosts);
  clear_forces = ghost_free.active();
  streaming.find_walls();
  have_membranes = membrane >= 0 && group->count(membrane) > 0;
  if (have_membranes)
    init_membranes();
  else
    have_obstacle = membranes_join = false;
  prepare_cells();
}

void FixSRDMesh::init_membranes()
{
  if (auto *integrator = FixHDBase::of_group(lmp, group->bitmask[membrane], "Fix srd/mesh"))
    mass->settings = integrator->mass_settings();
  mass->settings.solve_nothing();
  check_other_solvents();
  influences.check_box_movers(solvent, membrane);
  mass->init();
  obstacle->init();
  if (update->whichflag == 2 && comm->me == 0)    // which has no solvent
    error->warning(FLERR, "Fix srd/mesh: in a minimization membranes may pass over solvent, which is on their other side "
                          "then: minimize before there is solvent");
  if (stiffness > 0.0 && comm->me == 0)
    utils::logmesg(lmp, "Fix srd/mesh: meshes are kept in shape with regularize {:.6g} ({} kT) where pair_coeff has none\n",
                   stiffness, STIFF_MESH);
}

/* ----------------------------------------------------------------------
   impulses shake control points along the membrane, too: within a few hundred steps faces would turn over
------------------------------------------------------------------------- */

void *FixSRDMesh::extract(const char *name, int &dim)
{
  dim = 0;
  const bool mesh = strcmp(name, "default_regularize") == 0, measure = strcmp(name, "measure") == 0;
  if (!(mesh || measure) || membrane < 0 || group->count(membrane) == 0) return nullptr;
  solvent.refresh();
  fluid.measure(solvent);
  const double kT = force->boltz * fluid.temperature();
  sampling = {given.measure && kT > 0.0, kT, group->bitmask[membrane], false, 0.0};
  if (measure) return &sampling;
  stiffness = STIFF_MESH * kT;
  return &stiffness;
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
      error->all(FLERR, "Fix srd/mesh: membranes of group {} are also those of fix {}: one fix must have all solvent "
                        "around a membrane", group->names[membrane], other->id);
  }
}

void FixSRDMesh::prepare_cells()
{
  const bool first = !cells;
  fluid.measure(solvent);
  cells = std::make_unique<SRDCells>(lmp, fluid.cell_settings());
  cells->grid.setup(given.cells.size);
  fluid.fit(cells->grid, first);
}

// === Setup of a run

void FixSRDMesh::setup_pre_exchange()
{
  ghost_free.update();
}

void FixSRDMesh::setup_pre_neighbor()
{
  pre_neighbor();
  zero_forces();
}

void FixSRDMesh::setup_pre_force(int)
{
  zero_forces();
  if (update->whichflag == 2) return;
  if (!velocities_set && given.set_velocities) solvent.draw_velocities(given.seed, steps, fluid.kT());
  velocities_set = true;
}

void FixSRDMesh::setup(int)
{
  sampled = -1;
  have_obstacle = have_membranes;
  membranes_join = have_obstacle && given.noslip;
  running = true;
  if (have_obstacle) {
    obstacle->meetings.forces_on_solvent = influences.have_forces;
    obstacle->setup(solvent);
    measure_sides();
  }
  if (!reported) fluid.report(cells->grid);
  reported = true;
}

/* ----------------------------------------------------------------------
   volumes are those of the first run with these membranes and this solvent, kept in restart files: the
   filling of cells at walls depends on them, and a run is to continue as if it had not stopped
------------------------------------------------------------------------- */

void FixSRDMesh::measure_sides()
{
  sides();
  bigint mine[2] = {0, 0};
  SRDFluid::Sides now;
  for (int i = solvent.first(); i < solvent.last(); ++i)
    if (solvent.has(i)) ++mine[side[i]];
  MPI_Allreduce(mine, now.atoms, 2, MPI_LMP_BIGINT, MPI_SUM, world);
  const double scene[2] = {static_cast<double>(solvent.total()),
                           static_cast<double>(mass->mesh().topology().num_vertices())};
  if (scene[0] != measured.scene[0] || scene[1] != measured.scene[1]) {
    const auto volumes = obstacle->regions.volumes();
    measured = {{scene[0], scene[1]}, {volumes[0], volumes[1]}};
  }
  std::copy_n(measured.volume, 2, now.volume);
  fluid.fit_sides(cells->grid, now);
}

// === A step

bool FixSRDMesh::is_due() const
{
  return update->ntimestep % nevery == 0;
}

void FixSRDMesh::initial_integrate(int)
{
  if (influences.have_forces) kick();
}

void FixSRDMesh::final_integrate()
{
  if (influences.have_forces) kick();
  if (!have_obstacle) return;
  obstacle->remember();
  if (steps % LOOK_EVERY == 0) put_strays_back();
}

void FixSRDMesh::post_run()
{
  if (have_obstacle && running) put_strays_back();
  solvent_changed();    // after it anybody may change velocities, and run pre no
  natoms_after_run = atom->natoms;
}

void FixSRDMesh::kick()
{
  const double most = solvent.kick(0.5 * update->dt);
  if (obstacle) obstacle->meetings.velocities_changed_by(most);
}

// what is known of where it comes near the surface holds no more

void FixSRDMesh::solvent_changed()
{
  if (obstacle) obstacle->meetings.solvent_changed();
}

/* ----------------------------------------------------------------------
   Point masses take part in the collisions of cells in the middle of a step, where their velocities
   are those of their paths and have the variance kT/m: the place that noise has in fix hd/langevin.
   At the end of a step velocities are smaller, for a wave of frequency w by (w dt)^2/4 of its
   energy, and to meet solvent with the one in cells and with the other at the surface would pump
   energy into it.
------------------------------------------------------------------------- */

void FixSRDMesh::post_integrate()
{
  const double dt = update->dt;
  const bool due = is_due();
  ++steps;
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
  if (!influences.velocities_stay) solvent_changed();
  obstacle->stream({solvent, streaming, dt, influences.velocities_stay ? until_collision : dt});
}

void FixSRDMesh::wrap()
{
  if (!ghost_free.active() || domain->deform_vremap) return;    // LAMMPS changes velocities, too
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
   solvent that has strayed too far goes to its new owner in this step: cells have to find it when
   it collides next, at the end of a step or in the middle of the next
------------------------------------------------------------------------- */

bool FixSRDMesh::any_strayed()
{
  constexpr int BLOCK = SRDGrid::BLOCK;
  int which[BLOCK], mine = 0, any;
  const double ahead = membranes_join ? 0.5 * update->dt : 0.0;
  for (int first = solvent.first(); first < solvent.last() && !mine; first += BLOCK) {
    const int n = cells->grid.find_strayed(atom->x[first], atom->v[first], ahead, MIN(BLOCK, solvent.last() - first), which);
    for (int j = 0; j < n && !mine; ++j) mine = solvent.has(first + which[j]);
  }
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, world);
  return any;
}

void FixSRDMesh::pre_neighbor()
{
  solvent.refresh();
  solvent_changed();
  cells->grid.setup(given.cells.size);
  if (!influences.have_forces) zero_forces();
}

void FixSRDMesh::pre_force(int)
{
  if (influences.have_forces) zero_forces();
}

void FixSRDMesh::end_of_step()
{
  if (!membranes_join) collide();
}

void FixSRDMesh::collide()
{
  if (domain->box_change) cells->grid.setup(given.cells.size);
  if (membranes_join) obstacle->join_cells(*cells, steps, fluid.kT());
  cells->collide(solvent, steps, streaming.walls, fluid.filling(), fluid.mass(),
                 sides());
  if (membranes_join) obstacle->leave_cells(*cells);
  solvent_changed();
}

void FixSRDMesh::min_pre_force(int)
{
  zero_forces();
}

void FixSRDMesh::zero_forces()
{
  if (clear_forces) solvent.zero_forces();
}

// === Output

double FixSRDMesh::compute_vector(int i)
{
  if (!cells) return 0.0;
  if (update->whichflag == 0 && natoms_after_run >= 0 && atom->natoms != natoms_after_run)
    error->all(FLERR, "Fix srd/mesh: there are other atoms than in the last run: use run 0");
  if (sampled != update->ntimestep) sample();
  return observables[i];
}

void FixSRDMesh::sample()
{
  sampled = update->ntimestep;
  solvent.refresh();
  const bigint strays = have_obstacle && running ? obstacle->count_strays(solvent) : 0;
  if (strays && given.inside == Inside::ERROR) report_strays(strays);
  observables.sample({solvent, fluid, *cells, sides(), have_membranes ? mass.get() : nullptr,
                      obstacle.get(), have_obstacle, strays, streaming.walls.impulse});
}

// solvent on the two sides of a membrane does not collide with each other

const int *FixSRDMesh::sides()
{
  if (!have_obstacle) return nullptr;
  const SurfaceRegions &regions = obstacle->regions;
  side.resize(MAX(1, atom->nlocal));    // null would mean no sides, on ranks without atoms
  regions.find_parities(solvent, side.data());
  for (int k = 0; k < 3; ++k) cells->flips[k] = regions.flips(k);
  return side.data();
}

void FixSRDMesh::put_strays_back()
{
  solvent.refresh();
  const bigint strays = obstacle->put_back(solvent, steps);
  if (strays && given.inside != Inside::IGNORE) report_strays(strays);
}

void FixSRDMesh::report_strays(bigint count)
{
  const std::string text =
      fmt::format("Fix srd/mesh: {} solvent atoms were on the wrong side of a membrane", count);
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
  double list[SRDObservables::NUM_VALUES + 6] = {
      double(velocities_set), double(steps),      measured.scene[0],
      measured.scene[1],      measured.volume[0], measured.volume[1]};
  observables.store(list + 6);
  if (comm->me != 0) return;
  const int size = sizeof(list);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(list, sizeof(list), 1, fp);
}

void FixSRDMesh::restart(char *buf)
{
  double list[SRDObservables::NUM_VALUES + 6];
  memcpy(list, buf, sizeof(list));
  velocities_set = list[0] != 0.0;
  steps = static_cast<bigint>(list[1]);
  measured = {{list[2], list[3]}, {list[4], list[5]}};
  observables.restore(list + 6);
}

double FixSRDMesh::memory_usage()
{
  return (cells ? cells->memory_usage() : 0.0) + (obstacle ? obstacle->memory_usage() : 0.0);
}
