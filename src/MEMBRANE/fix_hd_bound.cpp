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

#include "fix_hd_bound.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_hd_base.h"
#include "group.h"
#include "memory.h"
#include "modify.h"
#include "respa.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;
using Eigen::Vector3d;
using Membrane_NS::ClosestPoint;

// how much further than its radius a footprint looks, in longest edges
static constexpr double REACH = 5.0;

// of closest points, in mean edges: energies are then right to its square
static constexpr double PRECISION = 1.0e-10;

// particles between one look at memory and the next, see look_ahead()
static constexpr size_t AHEAD = 4;

/* ---------------------------------------------------------------------- */

FixHDBound::FixHDBound(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), membranebit(0), max_distance(0.0), leaflet(0), height(0.0), rigid(false),
    automatic(true), correct(Correct::DEFAULT), spring(0.0), diffusion(0.0), temperature(0.0), seed(0), carried(false),
    turning(0.0), turning_temperature(0.0), turning_seed(0), curvature(lmp), correcting(false), migrating(false), mover(nullptr), noise_steps(0),
    mesh(lmp, "Fix hd/bind"), footprint_energy(0.0), total(0), precision(0.0), chosen_for(0.0), chosen_count(0),
    energy(0.0), squares(0.0), farthest(0.0), phase(0.0), work(nullptr), answer(nullptr), exchanged(nullptr),
    allocated(0)
{
  mesh.require();
  scalar_flag = vector_flag = 1;
  global_freq = 1;
  extscalar = 1;
  extvector = 0;
  size_vector = NUM_OUTPUT;
  energy_global_flag = virial_global_flag = virial_peratom_flag = 1;
  thermo_energy = thermo_virial = 1;
  respa_level_support = 1;
  restart_global = restart_peratom = 1;
  create_attribute = 1;
  comm_forward = comm_reverse = 3;
  dynamic_group_allow = 0;
  dof_flag = 1;

  FixHDBound::grow_arrays(atom->nmax);
  for (int i = 0; i < atom->nlocal; ++i) sites.clear(i);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
}

FixHDBound::~FixHDBound()
{
  if (copymode) return;
  if (modify->get_fix_by_id(id) == this) {    // and not a word of the command that stopped its making
    atom->delete_callback(id, Atom::GROW);
    atom->delete_callback(id, Atom::RESTART);
  }
  memory->destroy(work);
  memory->destroy(answer);
}

int FixHDBound::setmask()
{
  // of exchanges it is asked before the first one of a run only

  return INITIAL_INTEGRATE | POST_FORCE | POST_FORCE_RESPA | MIN_POST_FORCE | FINAL_INTEGRATE | PRE_EXCHANGE |
      MIN_PRE_EXCHANGE;
}

// === Before a run

void FixHDBound::init()
{
  if (utils::strmatch(update->integrate_style, "^respa")) {
    const int levels = dynamic_cast<Respa *>(update->integrate)->nlevels;
    if (rigid || diffusion > 0.0)
      error->all(FLERR, "Fix hd/bind with run_style respa needs hold spring, and no brownian");
    if (respa_level > levels)
      error->all(FLERR, "Fix hd/bind respa level {} does not exist", respa_level);
  }
  if (mesh.init() == MeshChange::TOPOLOGY || !limit)
    make_surface();
  curvature.init(*mesh, membranebit);
  if (precision == 0.0) precision = PRECISION * limit->mean_edge();
  mover = FixHDBase::of_group(lmp, membranebit, "Fix hd/bind");
  if (carried && mover && !(mover->drag_coefficient() > 0.0))
    error->all(FLERR,
               "Fix hd/bind friction membrane needs a membrane without inertia, and fix {} ({}) moves it: use fix "
               "hd/brownian",
               mover->id, mover->style);
  check_group();
  bind_free_atoms();
  if (rigid && update->nsteps > 0) return_strays();
  check_inside_box();
  check_integrators();
  correcting = rigid && correct != Correct::NO && bath_kT() > 0.0 && update->whichflag == 1;
  if (rigid && correct == Correct::YES && update->whichflag == 1 && !correcting)
    error->all(FLERR, "Fix hd/bind correct yes needs a temperature, and the fix that moves the membrane has none: "
                      "leave it out, or use fix hd/langevin, without mass sampling, or fix hd/nve measure");
  if (rigid && update->whichflag == 2)
    error->all(FLERR, "Fix hd/bind hold rigid does not hold in a minimization: use hold spring");
  comm->cutghostuser =
      MAX(comm->cutghostuser, mesh->ghost_cutoff() + height + FARTHEST * mesh->longest_edge());
  if (curvature.any())
    comm->cutghostuser = MAX(comm->cutghostuser, curvature.radius() + REACH * mesh->longest_edge());
}

void FixHDBound::reset_dt()
{
  if (update->whichflag == 1 && automatic && !rigid && update->dt != chosen_for) choose_spring();
}

void FixHDBound::setup(int vflag)
{
  follow();
  find_feet();
  choose_spring();
  if (!utils::strmatch(update->integrate_style, "^respa")) {
    post_force(vflag);
    if (rigid) constrain_velocities();
    return;
  }
  auto *respa = dynamic_cast<Respa *>(update->integrate);
  const int level = respa_level > 0 ? respa_level - 1 : respa->nlevels - 1;
  respa->copy_flevel_f(level);
  post_force_respa(vflag, level, 0);
  respa->copy_f_flevel(level);
}

void FixHDBound::min_setup(int vflag)
{
  follow();
  find_feet();
  choose_spring();
  post_force(vflag);
}

void FixHDBound::make_surface()
{
  limit = std::make_unique<LocalSurface>(lmp, *mesh);
  curvature.set_surface(limit.get());
}

// === In a step

void FixHDBound::follow()
{
  const MeshChange change = mesh.follow();
  if (change == MeshChange::NOTHING && allocated >= atom->nlocal + atom->nghost) {
    limit->follow_box();
    return;
  }
  if (change == MeshChange::TOPOLOGY) {
    make_surface();
    for (int i = 0; i < atom->nlocal; ++i)
      if (sites[i].bound()) find_again(*mesh, sites[i]);
  }
  limit->forget_atoms();
  limit->follow_box();
  followed = false;
  if (atom->nlocal + atom->nghost > allocated) {
    allocated = atom->nmax;
    memory->grow(work, allocated, 3, "hd/bind:work");
    memory->grow(answer, allocated, 3, "hd/bind:answer");
  }
  find_members();
}

void FixHDBound::find_members()
{
  members.clear();
  tagint mine = 0, any;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    if (sites[i].bound() && sites[i].point.face >= 0)
      members.push_back(i);
    else
      mine = MAX(mine, atom->tag[i]);
  }
  // in an order that does not depend on how LAMMPS has sorted atoms, so that sums do not either

  std::sort(members.begin(), members.end(), [this](int i, int j) { return atom->tag[i] < atom->tag[j]; });
  MPI_Allreduce(&mine, &any, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  if (any)
    error->all(FLERR,
               "Fix hd/bind: atom {} of its group is not bound: atoms that come in a run or lose their "
               "membrane are bound when the next run begins",
               any);
  const bigint before = total;
  bigint count = static_cast<bigint>(members.size());    // LAMMPS without MPI takes no const
  MPI_Allreduce(&count, &total, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (!update->setupflag && update->whichflag && total != before)
    error->all(FLERR, "Fix hd/bind: {} of {} bound atoms are left in the middle of a run: do others overlap, or is the timestep "
               "too long?",
               total, before);
}

// sites and control points are all over memory: waiting for it would be half the time

void FixHDBound::look_ahead(size_t a) const
{
  if (a + 2 * AHEAD < members.size()) {
    const int i = members[a + 2 * AHEAD];
    sites.prefetch(i);
    __builtin_prefetch(atom->x[0] + 3 * static_cast<size_t>(i));
  }
  if (!followed || a + AHEAD >= members.size()) return;
  const Foot &later = feet[a + AHEAD];
  limit->prefetch(later.face);
  for (int k = later.start; k < later.start + later.size; ++k)
    __builtin_prefetch(atom->x[0] + 3 * static_cast<size_t>(last_points[k]));
}

void FixHDBound::find_feet()
{
  feet.resize(members.size());
  weights.clear();
  last_points.swap(points);
  points.clear();
  Membrane_NS::SurfaceWeights row;
  const double most = FARTHEST * limit->mean_edge();
  squares = farthest = 0.0;
  for (size_t a = 0; a < members.size(); ++a) {
    const int i = members[a];
    look_ahead(a);
    BoundSite &site = sites[i];
    limit->look_from(i);
    if (followed && feet[a].face == site.point.face) limit->expect(site.point.face, &last_points[feet[a].start]);
    const Vector3d x = Vector3d::Map(atom->x[i]);
    const ClosestPoint closest = closest_point(*limit, x, site.point, precision);
    const int face = closest.point.face, size = limit->stencil_size(face);
    remember(i, closest);
    const double off = closest.distance - height * site.leaflet;
    if (!(std::fabs(off) <= most))
      error->one(FLERR,
                 "Bound atom {} is {:.4g} off its place on the membrane, more than half an edge: use a "
                 "shorter timestep or a stiffer spring",
                 atom->tag[i], std::fabs(off));
    squares += off * off;
    farthest = MAX(farthest, std::fabs(off));
    limit->weights<0>(closest.point, row);
    feet[a] = {i, face, closest.normal, off, static_cast<int>(weights.size()), size, Vector3d::Zero()};
    const int *local = limit->atoms(face);
    weights.insert(weights.end(), row.data(), row.data() + size);
    points.insert(points.end(), local, local + size);
    if (carried) feet[a].place = place_of(feet[a]);
  }
  limit->expect(-1, nullptr);
  followed = true;
}

void FixHDBound::update_feet()
{
  follow();
  find_feet();
}

void FixHDBound::post_force(int vflag)
{
  follow();
  if (total > 0) hold(vflag);
}

void FixHDBound::post_force_respa(int vflag, int level, int)
{
  auto *respa = dynamic_cast<Respa *>(update->integrate);
  if (level == (respa_level > 0 ? respa_level - 1 : respa->nlevels - 1)) post_force(vflag);
}

void FixHDBound::min_post_force(int vflag)
{
  post_force(vflag);
}

/* ----------------------------------------------------------------------
   U = K/2 (d - z)^2. The forces on control points are minus that on the atom, shared by the weights at
   the foot, which sums to the virial d n times the force
------------------------------------------------------------------------- */

void FixHDBound::hold(int vflag)
{
  v_init(vflag);
  energy = 0.0;
  find_feet();
  if (curvature.any()) couple();
  if (rigid) {
    for (const Foot &foot : feet) tally_pull(foot, sites[foot.atom].pull);
    if (correcting) correct_metric();
    return;
  }
  const bool dragging = carried && update->whichflag == 1;    // a minimization has energies alone
  if (dragging) drag_membrane();
  double **f = atom->f;
  if (atom->nghost && !dragging) std::fill_n(f[atom->nlocal], 3 * atom->nghost, 0.0);    // they have been sent already
  for (size_t a = 0; a < feet.size(); ++a) {
    const Foot &foot = feet[a];
    if (a + AHEAD < feet.size()) {
      const Foot &later = feet[a + AHEAD];
      __builtin_prefetch(f[0] + 3 * static_cast<size_t>(later.atom), 1);
      for (int k = later.start; k < later.start + later.size && !dragging; ++k)
        __builtin_prefetch(f[0] + 3 * static_cast<size_t>(points[k]), 1);
    }
    const double pull = -spring * foot.off;
    energy += 0.5 * spring * foot.off * foot.off;
    const Vector3d force_on_atom = pull * foot.normal;
    Vector3d::Map(f[foot.atom]) += force_on_atom;
    tally_pull(foot, pull);
    if (dragging) continue;    // what holds an atom moves it alone, and what pulls it pulls the membrane
    for (int k = foot.start; k < foot.start + foot.size; ++k) Vector3d::Map(f[points[k]]) -= weights[k] * force_on_atom;
  }
  if (dragging) return;
  exchanged = f;
  comm->reverse_comm(this);
}

void FixHDBound::tally_pull(const Foot &foot, double pull)
{
  if (!evflag) return;
  const Vector3d &n = foot.normal;
  const double w = pull * sites[foot.atom].distance;
  double v[6] = {w * n[0] * n[0], w * n[1] * n[1], w * n[2] * n[2],
                 w * n[0] * n[1], w * n[0] * n[2], w * n[1] * n[2]};
  int list = foot.atom;
  v_tally(1, &list, 1.0, v);
}

double FixHDBound::compute_scalar()
{
  double all;
  MPI_Allreduce(&energy, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

double FixHDBound::compute_vector(int which)
{
  double all;
  switch (which) {
    case STIFFNESS: return stiffness();
    case COUNT: return static_cast<double>(total);
    case RMS:
      MPI_Allreduce(&squares, &all, 1, MPI_DOUBLE, MPI_SUM, world);
      return total > 0 ? std::sqrt(all / total) : 0.0;
    case LARGEST: MPI_Allreduce(&farthest, &all, 1, MPI_DOUBLE, MPI_MAX, world); return all;
    case FOOTPRINTS: MPI_Allreduce(&footprint_energy, &all, 1, MPI_DOUBLE, MPI_SUM, world); return all;
    default: return phase;
  }
}

double FixHDBound::mass_of(int i) const
{
  return atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]];
}

std::vector<int> FixHDBound::owned_faces() const
{
  std::vector<int> faces;
  for (int f : mesh->owned_faces()) {
    const int i = atom->map(mesh->tag(mesh->topology().face(f)[0]));
    if (atom->mask[i] & membranebit) faces.push_back(f);
  }
  return faces;
}

double FixHDBound::footprint_area(int i) const
{
  return sites[i].bound() ? curvature.area(atom->type[i]) : 0.0;
}

FixHDBound *FixHDBound::named(LAMMPS *lmp, const std::string &id, const std::string &user)
{
  auto *fix = dynamic_cast<FixHDBound *>(lmp->modify->get_fix_by_id(id));
  if (!fix) lmp->error->all(FLERR, "{}: there is no fix hd/bind of ID {}", user, id);
  return fix;
}

double FixHDBound::memory_usage()
{
  return sites.memory_usage() + 6.0 * sizeof(double) * allocated + sizeof(Foot) * feet.capacity() +
      sizeof(int) * (points.capacity() + last_points.capacity()) + sizeof(double) * weights.capacity() +
      (limit ? limit->memory_usage() : 0.0);
}
