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

#include "fix_hd_bind.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
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

/* ---------------------------------------------------------------------- */

FixHDBind::FixHDBind(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), max_distance(0.0), leaflet(0), height(0.0), rigid(false), automatic(true),
    correct(Correct::DEFAULT), correcting(false),
    spring(0.0), diffusion(0.0), temperature(0.0), seed(0), noise_steps(0), turning(0.0),
    turning_temperature(0.0), turning_seed(0), mesh(lmp, "Fix hd/bind"), curvature(lmp),
    footprint_energy(0.0), total(0), precision(0.0), chosen_for(0.0), chosen_count(0), energy(0.0), squares(0.0), farthest(0.0), phase(0.0),
    work(nullptr), answer(nullptr), exchanged(nullptr), allocated(0)
{
  mesh.require();
  if (narg < 4) utils::missing_cmd_args(FLERR, "fix hd/bind", error);
  scalar_flag = vector_flag = 1;
  global_freq = 1;
  extscalar = 1;
  extvector = 0;
  size_vector = NUM_OUTPUT;
  energy_global_flag = virial_global_flag = 1;
  thermo_energy = thermo_virial = 1;
  respa_level_support = 1;
  restart_global = restart_peratom = 1;
  create_attribute = 1;
  comm_forward = comm_reverse = 3;
  dynamic_group_allow = 0;

  membrane_name = arg[3];
  const int imembrane = group->find(arg[3]);
  if (imembrane < 0) error->all(FLERR, "Could not find fix hd/bind membrane group ID {}", arg[3]);
  membranebit = group->bitmask[imembrane];
  for (int iarg = 4; iarg < narg;) iarg += parse(iarg, narg, arg);
  if (correct == Correct::YES && !rigid)
    error->all(FLERR, "Fix hd/bind correct is for hold rigid: springs need no correction");
  if (rigid && diffusion > 0.0)
    error->all(FLERR, "Fix hd/bind brownian needs hold spring: without inertia there is nothing rigid to conserve");
  time_integrate = diffusion > 0.0;

  FixHDBind::grow_arrays(atom->nmax);
  for (int i = 0; i < atom->nlocal; ++i) sites.clear(i);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
}

FixHDBind::~FixHDBind()
{
  if (copymode) return;
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
  memory->destroy(work);
  memory->destroy(answer);
}

int FixHDBind::parse(int iarg, int narg, char **arg)
{
  const std::string key = arg[iarg];
  auto need = [&](int words) {
    if (iarg + words > narg) utils::missing_cmd_args(FLERR, "fix hd/bind " + key, error);
  };
  if (key == "max") {
    need(2);
    max_distance = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
    if (!(max_distance > 0.0))
      error->all(FLERR, "Fix hd/bind max {} must be positive", arg[iarg + 1]);
    return 2;
  }
  if (key == "height") {
    need(2);
    height = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
    if (!std::isfinite(height) || height < 0.0)
      error->all(FLERR,
                 "Fix hd/bind height {} must not be negative: it is above the surface on the side of the "
                 "leaflet",
                 arg[iarg + 1]);
    return 2;
  }
  if (key == "leaflet") {
    need(2);
    const std::string word = arg[iarg + 1];
    if (word != "in" && word != "out" && word != "both")
      error->all(FLERR, "Fix hd/bind leaflet {} is not in, out or both", word);
    leaflet = word == "in" ? -1 : word == "out" ? 1 : 0;
    return 2;
  }
  if (key == "hold") {
    need(2);
    const std::string word = arg[iarg + 1];
    if (word != "spring" && word != "rigid")
      error->all(FLERR, "Fix hd/bind hold {} is not spring or rigid", word);
    rigid = word == "rigid";
    if (rigid) return 2;
    need(3);
    automatic = strcmp(arg[iarg + 2], "auto") == 0;
    if (!automatic) spring = utils::numeric(FLERR, arg[iarg + 2], false, lmp);
    if (!automatic && !(spring > 0.0 && std::isfinite(spring)))
      error->all(FLERR, "Fix hd/bind hold spring {} must be positive, or auto", arg[iarg + 2]);
    return 3;
  }
  if (key == "correct") {
    need(2);
    correct = utils::logical(FLERR, arg[iarg + 1], false, lmp) ? Correct::YES : Correct::NO;
    return 2;
  }
  if (key == "brownian") {
    need(4);
    temperature = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
    diffusion = parse_diffusion(arg[iarg + 2]);
    seed = utils::bnumeric(FLERR, arg[iarg + 3], false, lmp);
    if (!(temperature > 0.0))
      error->all(FLERR, "Fix hd/bind brownian temperature {} must be positive", arg[iarg + 1]);
    if (seed <= 0) error->all(FLERR, "Fix hd/bind brownian seed {} must be positive", arg[iarg + 3]);
    return 4;
  }
  if (key == "footprint" || key == "bar") return curvature.parse(narg - iarg, arg + iarg);
  if (key == "rotate") {
    need(4);
    turning_temperature = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
    turning = utils::numeric(FLERR, arg[iarg + 2], false, lmp);
    turning_seed = utils::bnumeric(FLERR, arg[iarg + 3], false, lmp);
    if (!(turning_temperature > 0.0 && turning > 0.0) || turning_seed <= 0)
      error->all(FLERR, "Fix hd/bind rotate: temperature {}, diffusion coefficient {} and seed {} must be positive",
                 arg[iarg + 1], arg[iarg + 2], arg[iarg + 3]);
    return 4;
  }
  error->all(FLERR,
             "Unknown fix hd/bind keyword {}; known are: max, leaflet, height, hold, correct, "
             "brownian, footprint, bar, rotate",
             key);
  return 0;
}

/* ----------------------------------------------------------------------
   a number in LAMMPS' units, or with the unit that diffusion in membranes is measured in
------------------------------------------------------------------------- */

double FixHDBind::parse_diffusion(const char *text) const
{
  std::string number = text;
  double unit = 1.0;
  const size_t at = number.find("um2/s");
  if (at != std::string::npos && at + 5 == number.size()) {
    number.resize(at);
    const std::string style = update->unit_style;
    const double metre = style == "real" || style == "metal" ? 1.0e10
        : style == "nano"                                     ? 1.0e9
        : style == "micro"                                    ? 1.0e6
        : style == "cgs"                                      ? 1.0e2
                                                              : 1.0;
    const double second = style == "real" ? 1.0e15
        : style == "metal"                ? 1.0e12
        : style == "nano"                 ? 1.0e9
        : style == "micro"                ? 1.0e6
                                          : 1.0;
    if (style == "lj" || style == "electron")
      error->all(FLERR, "Fix hd/bind brownian diffusion coefficient {}: units {} have no um2/s", text, style);
    unit = 1.0e-12 * metre * metre / second;
  }
  const double value = utils::numeric(FLERR, number, false, lmp) * unit;
  if (!(value > 0.0 && std::isfinite(value)))
    error->all(FLERR, "Fix hd/bind brownian diffusion coefficient {} must be positive", text);
  return value;
}

int FixHDBind::setmask()
{
  return INITIAL_INTEGRATE | POST_FORCE | POST_FORCE_RESPA | MIN_POST_FORCE | FINAL_INTEGRATE;
}

// === Before a run

void FixHDBind::init()
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
  check_group();
  bind_free_atoms();
  check_integrators();
  correcting = rigid && correct != Correct::NO && bath_kT() > 0.0 && update->whichflag == 1;
  if (rigid && correct == Correct::YES && update->whichflag == 1 && !correcting)
    error->all(FLERR, "Fix hd/bind correct yes needs a temperature, and the fix that moves the membrane has none: "
                      "leave it out, or use fix hd/langevin or fix hd/nve measure");
  comm->cutghostuser =
      MAX(comm->cutghostuser, mesh->ghost_cutoff() + height + FARTHEST * mesh->longest_edge());
  if (curvature.any())
    comm->cutghostuser = MAX(comm->cutghostuser, curvature.radius() + REACH * mesh->longest_edge());
}

void FixHDBind::reset_dt()
{
  if (update->whichflag == 1 && automatic && !rigid && update->dt != chosen_for) choose_spring();
}

void FixHDBind::setup(int vflag)
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

void FixHDBind::min_setup(int vflag)
{
  follow();
  find_feet();
  choose_spring();
  post_force(vflag);
}

void FixHDBind::make_surface()
{
  limit = std::make_unique<LocalSurface>(lmp, *mesh);
  curvature.set_surface(limit.get());
}

// === In a step

void FixHDBind::follow()
{
  const MeshChange change = mesh.follow();
  if (change == MeshChange::NOTHING && allocated >= atom->nlocal + atom->nghost) {
    limit->follow_box();
    return;
  }
  if (change == MeshChange::TOPOLOGY) {
    make_surface();
    for (int i = 0; i < atom->nlocal; ++i)
      if (sites[i].bound()) sites[i].point = find_again(*mesh, sites[i]);
  }
  limit->forget_atoms();
  limit->follow_box();
  if (atom->nlocal + atom->nghost > allocated) {
    allocated = atom->nmax;
    memory->grow(work, allocated, 3, "hd/bind:work");
    memory->grow(answer, allocated, 3, "hd/bind:answer");
  }
  find_members();
}

void FixHDBind::find_members()
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
  const bigint count = static_cast<bigint>(members.size()), before = total;
  MPI_Allreduce(&count, &total, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (!update->setupflag && update->whichflag && total != before)
    error->all(FLERR, "Fix hd/bind: {} of {} bound atoms are left in the middle of a run", total, before);
}

void FixHDBind::find_feet()
{
  feet.resize(members.size());
  weights.clear();
  points.clear();
  Membrane_NS::SurfaceWeights row;
  const double most = FARTHEST * limit->mean_edge();
  squares = farthest = 0.0;
  for (size_t a = 0; a < members.size(); ++a) {
    const int i = members[a];
    BoundSite &site = sites[i];
    limit->look_from(i);
    const Vector3d x = Vector3d::Map(atom->x[i]);
    const ClosestPoint closest = closest_point(*limit, x, site.point, precision);
    const int face = closest.point.face, size = limit->stencil(face).size();
    if (face != site.point.face || closest.point.u != site.point.u || closest.point.v != site.point.v)
      remember(i, closest);
    site.distance = closest.distance;
    const double off = closest.distance - height * site.leaflet;
    if (!(std::fabs(off) <= most))
      error->one(FLERR,
                 "Bound atom {} is {:.4g} off its place on the membrane, more than half an edge: use a "
                 "shorter timestep or a stiffer spring",
                 atom->tag[i], std::fabs(off));
    squares += off * off;
    farthest = MAX(farthest, std::fabs(off));
    limit->weights<0>(closest.point, row);
    feet[a] = {i, closest.normal, static_cast<int>(weights.size()), size};
    const int *local = limit->atoms(face);
    weights.insert(weights.end(), row.data(), row.data() + size);
    points.insert(points.end(), local, local + size);
  }
}

void FixHDBind::update_feet()
{
  follow();
  find_feet();
}

void FixHDBind::post_force(int vflag)
{
  follow();
  if (total > 0) hold(vflag);
}

void FixHDBind::post_force_respa(int vflag, int level, int)
{
  auto *respa = dynamic_cast<Respa *>(update->integrate);
  if (level == (respa_level > 0 ? respa_level - 1 : respa->nlevels - 1)) post_force(vflag);
}

void FixHDBind::min_post_force(int vflag)
{
  post_force(vflag);
}

/* ----------------------------------------------------------------------
   U = K/2 (d - z)^2. The forces on control points are minus that on the atom, shared by the weights at
   the foot, which sums to the virial d n times the force
------------------------------------------------------------------------- */

void FixHDBind::hold(int vflag)
{
  v_init(vflag);
  energy = 0.0;
  find_feet();
  if (curvature.any()) couple();
  if (rigid) {
    if (correcting) correct_metric();
    return;
  }
  std::vector<double> pull(feet.size());
  for (size_t a = 0; a < feet.size(); ++a) {
    const int i = feet[a].atom;
    const double distance = sites[i].distance, off = distance - height * sites[i].leaflet;
    pull[a] = -spring * off;
    energy += 0.5 * spring * off * off;
    const Vector3d &n = feet[a].normal;
    for (int k = 0; k < 3; ++k) atom->f[i][k] += pull[a] * n[k];
    if (!evflag) continue;
    const double w = pull[a] * distance;
    double v[6] = {w * n[0] * n[0], w * n[1] * n[1], w * n[2] * n[2],
                   w * n[0] * n[1], w * n[0] * n[2], w * n[1] * n[2]};
    int list = i;
    v_tally(1, &list, 1.0, v);
  }
  spread(pull);
  for (int i = 0; i < atom->nlocal; ++i)
    for (int k = 0; k < 3; ++k) atom->f[i][k] -= work[i][k];
}

double FixHDBind::compute_scalar()
{
  double all;
  MPI_Allreduce(&energy, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

double FixHDBind::compute_vector(int which)
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

double FixHDBind::mass_of(int i) const
{
  return atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]];
}

std::vector<int> FixHDBind::owned_faces() const
{
  std::vector<int> faces;
  for (int f : mesh->owned_faces()) {
    const int i = atom->map(mesh->tag(mesh->topology().face(f)[0]));
    if (atom->mask[i] & membranebit) faces.push_back(f);
  }
  return faces;
}

FixHDBind *FixHDBind::named(LAMMPS *lmp, const std::string &id, const std::string &user)
{
  auto *fix = dynamic_cast<FixHDBind *>(lmp->modify->get_fix_by_id(id));
  if (!fix) lmp->error->all(FLERR, "{}: there is no fix hd/bind of ID {}", user, id);
  return fix;
}

double FixHDBind::memory_usage()
{
  return sites.memory_usage() + 6.0 * sizeof(double) * allocated +
      (limit ? limit->memory_usage() : 0.0);
}
