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

#include "fix_hd_base.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fmt/format.h"
#include "force.h"
#include "hd_face_watch.h"
#include "hd_foreign_integrators.h"
#include "hd_stiffness_probe.h"
#include "membrane_mass_reference.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;
using Membrane_NS::Vector4;
using Membrane_NS::VertexField;

// a control point that moves further than this fraction of the longest edge in one step is lost
static constexpr double MOST_DRIFT = 0.25;

// mass sampling moves a membrane as a whole: so much of its radius, which is 0.26 edges times the root of its points
static constexpr double RADIUS = 0.26;

// steps between looks at whether a shape has left the reference of mass sampling
static constexpr int RENEW_EVERY = 100;

// longest over shortest edge at a point from which on the mesh is said to have lost its shape
static constexpr double SHORT_EDGE = 3.0;

// the limit of stability, to a few percent, takes two force evaluations for each of these steps; runs
// that are shorter would notice the cost and go without
static constexpr int LANCZOS_STEPS = 6;
static constexpr int WORTH_CHECKING = 250;

// steps between looks at the faces, so that these cost next to nothing; in between they move little
static constexpr int FACES_EVERY = 10;

/* ---------------------------------------------------------------------- */

FixHDBase::FixHDBase(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), mass(lmp, igroup, std::string("Fix ") + style),
    noise_steps(0), noise_seed(0), noise_step(-1), noise_numbering(-1), most_drift(0.0),
    moved_step(-1), drawn_for(-1), passes(0), forces_due(false), remembers(false), check(true), limit_due(false), limit(0.0),
    watching(false), held_reference(-1), taken_back(0), tried_with(0.0), tried_here(0),
    taken_back_here(0), faces(std::make_unique<FaceWatch>(lmp, groupbit, std::string("Fix ") + style)),
    settled_step(-1), measured_step(-1)
{
  time_integrate = 1;
  vector_flag = global_freq = 1;
  size_vector = 3;
  extvector = 0;
  measure.groupbit = groupbit;
}

FixHDBase::~FixHDBase() = default;

int FixHDBase::modify_param(int narg, char **arg)
{
  const std::string key = arg[0];
  if (key != "check" && key != "faces") return 0;
  if (narg < 2) utils::missing_cmd_args(FLERR, "fix_modify " + key, error);
  if (key == "faces") {
    faces->patience = utils::bnumeric(FLERR, arg[1], false, lmp);
    if (faces->patience < 0)
      error->all(FLERR, "Fix {} faces {}: the number of steps must not be negative", style, arg[1]);
    return 2;
  }
  check = utils::logical(FLERR, arg[1], false, lmp);
  if (!check) limit = 0.0;
  return 2;
}

void *FixHDBase::extract(const char *name, int &dim)
{
  dim = 0;
  return strcmp(name, "measure") == 0 ? &measure : nullptr;
}

void FixHDBase::init()
{
  mass.init();
  faces->init();
  check_other_integrators();
  check_fixes_of_points(lmp, this, mass.settings.kind != Membrane_NS::MassKind::LUMPED || modes(), sampling(), modes());
  if (modes()) check_box();
  most_drift = MOST_DRIFT * mass.mesh().longest_edge();
  if (sampling()) most_drift *= MAX(1.0, RADIUS * std::sqrt(mass.count()));
  moved_step = -1;
}

/* ---------------------------------------------------------------------- */

void FixHDBase::setup(int)
{
  if (modes() && modes()->has_friction() && modes()->friction.empty()) find_friction();
  accelerate();
  forces_due = true;

  // modes move many control points alike: by more than an edge of a fine mesh, and still little for the shortest wave

  for (int m = 0; modes() && m < static_cast<int>(modes()->now->membranes.size()); ++m) {
    const auto &membrane = modes()->now->membranes[m];
    const double most = *std::max_element(membrane.wave_number.begin(), membrane.wave_number.end());
    if (most > 0.0) most_drift = MAX(most_drift, MOST_DRIFT * membrane.length / most);
  }

  // r-RESPA has several timesteps: no limit is known for it

  const bool respa = utils::strmatch(update->integrate_style, "^respa");
  if (respa) limit = 0.0;
  limit_due = check && !respa && update->whichflag == 1 && update->nsteps >= WORTH_CHECKING;
  watching = check && !respa && update->whichflag == 1 && update->nsteps > 0;
  if (watching) faces->begin();
  if (update->dt != tried_with) tried_here = taken_back_here = 0;
  tried_with = update->dt;
}

/* ----------------------------------------------------------------------
   also after reneighbouring, when stencils that have grown too large stop the run with another message
------------------------------------------------------------------------- */

void FixHDBase::pre_force(int)
{
  if (watching) faces->check(sampling() || update->ntimestep % FACES_EVERY == 0 || neighbor->ago == 0);
}

/* ----------------------------------------------------------------------
   velocity Verlet, and the splittings with friction, are stable up to 2/omega, the overdamped step
   up to 2/rate; of the largest eigenvalue this takes an estimate from below, so a timestep beyond
   this limit is beyond the true one
------------------------------------------------------------------------- */

void FixHDBase::find_limit()
{
  limit_due = false;
  StiffnessProbe probe(lmp, mass, StiffnessProbe::Forces::MEMBRANE);
  if (!probe.has_forces()) return;
  const double largest = probe.largest(LANCZOS_STEPS, 1.0e-2).value;
  probe.restore();
  if (!(largest > 0.0)) return;
  limit = 2.0 / (drag_coefficient() > 0.0 ? largest : std::sqrt(largest));
  if (update->dt > limit && comm->me == 0)
    error->warning(FLERR, "Fix {}: timestep {} is beyond the stability limit of about {:.3g}; hd_timestep finds it precisely",
                   style, update->dt, limit);
}

void FixHDBase::accelerate()
{
  forces_due = false;
  mass.refresh();
  mass.part().load(atom->f, force_field);
  if (sampling() && mass.matrix().lost_freedoms() > 0) {
    VertexField x(force_field.size());
    for (int i = 0; i < mass.part().owned; ++i) {
      const int j = mass.part().atom_of(i);
      domain->unmap(atom->x[j], atom->image[j], x[i].c);
    }
    mass.matrix().add_gauge_forces(measure.kT, x, force_field);
  }
  acceleration.resize(force_field.size());
  if (noise_seed) {
    noise.resize(force_field.size());
    mass.matrix().solve_with_noise(force_field, acceleration, noise_seed, noise_steps, noise);
    noise_step = noise_steps;
    noise_numbering = mass.numbering();
  } else
    mass.matrix().solve(force_field, acceleration);
  passes = mass.matrix().passes();
  mass.report_missed_tolerance();
}

double FixHDBase::compute_vector(int i)
{
  if (i == 2) return static_cast<double>(taken_back);
  if (passes == 0) return 0.0;    // before the first run
  return i == 0 ? passes : mass.matrix().residual(force_field, acceleration);
}

void FixHDBase::respond(const double *const *f, double **v)
{
  VertexField force_here, answer;
  mass.refresh();
  mass.part().load(f, force_here);
  answer.resize(force_here.size());
  mass.matrix().solve(force_here, answer);
  mass.part().store(answer, v);
}

std::array<double, 3> FixHDBase::twice_kinetic()
{
  double t[6];
  mass.kinetic(t);
  return {t[0], t[1], t[2]};
}

void FixHDBase::kick(double step)
{
  if (forces_due) accelerate();
  MeshPart &part = mass.part();
  const double scale = step * force->ftm2v;
  for (int i = 0; i < part.owned; ++i) {
    double *v = atom->v[part.atom_of(i)];
    for (int k = 0; k < 3; ++k) v[k] += scale * acceleration[i].c[k];
  }
}

void FixHDBase::drift(double step)
{
  move<false>(0.0, step);
}

// in one sweep over the atoms

void FixHDBase::kick_and_drift(double kick_step, double drift_step)
{
  if (forces_due) accelerate();
  move<true>(kick_step, drift_step);
}

template <bool KICKS> void FixHDBase::move(double kick_step, double step)
{
  // here rather than in setup(), so that neither run 0 nor rerun pays for it
  if (limit_due) find_limit();
  if (modes()) settle(false);

  MeshPart &part = mass.part();
  const double fastest = most_drift / step, most = fastest * fastest;
  const double scale = kick_step * force->ftm2v;
  int runaway = -1;
  for (int i = 0; i < part.owned; ++i) {
    const int j = part.atom_of(i);
    double *x = atom->x[j];
    double *v = atom->v[j];
    for (int k = 0; k < 3; ++k) {
      if (KICKS) v[k] += scale * acceleration[i].c[k];
      x[k] += step * v[k];
    }
    if (!(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] < most)) runaway = j;
  }
  if (runaway >= 0 && !(watching && sampling())) report_runaway(atom->tag[runaway]);
  if (!remembers) return;

  if (moved_step != update->ntimestep) moved.assign(part.owned, Vector4{});
  moved_step = update->ntimestep;
  for (int i = 0; i < part.owned; ++i) {
    const double *v = atom->v[part.atom_of(i)];
    for (int k = 0; k < 3; ++k) moved[i].c[k] += step * v[k];
  }
}

/* ---------------------------------------------------------------------- */

VertexField &FixHDBase::unit_noise()
{
  if (noise_step != noise_steps || noise_numbering != mass.numbering()) accelerate();
  return noise;
}

void FixHDBase::relax(double keep, double kT)
{
  if (renew()) keep = 0.0;
  const VertexField &z = unit_noise();
  const double spread = std::sqrt((1.0 - keep * keep) * kT);
  MeshPart &part = mass.part();
  for (int i = 0; i < part.owned; ++i) {
    double *v = atom->v[part.atom_of(i)];
    for (int k = 0; k < 3; ++k) v[k] = keep * v[k] + spread * z[i].c[k];
  }
  ++noise_steps;
}

void FixHDBase::relax(const std::vector<double> &keep, double kT, bigint seed)
{
  mass.part().load(atom->v, velocity);
  mass.matrix().relax(keep, kT, seed, noise_steps++, velocity);
  mass.part().store(velocity, atom->v);
}

void FixHDBase::relax_modes(double time, double kT, bigint seed)
{
  mass.part().load(atom->v, velocity);
  mass.matrix().relax_own(time, kT, seed, noise_steps++, velocity);
  mass.part().store(velocity, atom->v);
}

void FixHDBase::balance(double spread, const VertexField &noise1, const VertexField &noise2)
{
  MeshPart &part = mass.part();
  for (int i = 0; i < part.owned; ++i) {
    double *v = atom->v[part.atom_of(i)];
    for (int k = 0; k < 3; ++k)
      v[k] = force->ftm2v * acceleration[i].c[k] + spread * (noise1[i].c[k] + noise2[i].c[k]);
  }
}

/* ---------------------------------------------------------------------- */

// on the rank that sees it: others may be anywhere in their step, so nothing can be computed now

void FixHDBase::report_runaway(tagint id_of_point)
{
  std::string reason = fmt::format("the timestep {} is too long", update->dt);
  if (limit > 0.0 && update->dt > limit)
    reason =
        fmt::format("timestep {} is beyond the stability limit of about {:.3g}", update->dt, limit);
  else if (limit > 0.0)
    reason += fmt::format(", though the stability limit was about {:.3g} when the run began{}",
                          limit, shape_lost_at(id_of_point));
  error->one(FLERR,
             "Fix {}: control point {} moved further than {} in one step: {}; "
             "hd_timestep finds the limit precisely, forces of fixes apart",
             style, id_of_point,
             sampling() ? "a quarter of a membrane's radius"
                        : fmt::format("{} of an edge{}", MOST_DRIFT, modes() ? ", and of 1/q of the shortest wave," : ""), reason);
}

// a mesh that has lost its shape is stable for shorter timesteps only

std::string FixHDBase::shape_lost_at(tagint id_of_point)
{
  DistributedMesh &mesh = mass.mesh();
  const auto &topology = mesh.topology();
  const int v = mesh.vertex(id_of_point), i = atom->map(id_of_point);
  if (v < 0 || i < 0) return "";
  double shortest = INFINITY, longest = 0.0;
  for (int w : topology.ring(v)) {
    const int j = mesh.find_neighbor(i, w);
    if (j < 0) continue;
    double square = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double d = atom->x[j][k] - atom->x[i][k];
      square += d * d;
    }
    shortest = MIN(shortest, square);
    longest = MAX(longest, square);
  }
  if (!(longest > SHORT_EDGE * SHORT_EDGE * shortest)) return "";
  return fmt::format(
      ", and the mesh has lost its shape since: edges of the point measure {:.3g} to "
      "{:.3g}; keep it with regularize in pair_coeff",
      std::sqrt(shortest), std::sqrt(longest));
}

/* ----------------------------------------------------------------------
   A face that turns over passes an infinite energy, across which a finite step may jump, and next to it forces are
   such that the next step goes anywhere. Such steps are refused, as in Monte Carlo: the state is the old one with its
   velocities reversed, and the distribution that all other steps keep is kept, less the forbidden part
   [A. Horowitz, Phys. Lett. B 268, 247 (1991)]. What is refused is refused on the way back, too.
------------------------------------------------------------------------- */

void FixHDBase::hold_on()
{
  if (!watching || !sampling()) return;
  const MeshPart &part = mass.part();
  held.resize(part.owned);
  for (int i = 0; i < part.owned; ++i) {
    const int j = part.atom_of(i);
    std::copy_n(atom->x[j], 3, held[i].data());
    std::copy_n(atom->v[j], 3, held[i].data() + 3);
  }
  held_reference = mass.references();
  faces->hold();
}

bool FixHDBase::step_back(double half_kick)
{
  if (!watching || !sampling()) return false;
  if (++tried_here > 4 * WORTH_CHECKING) tried_here /= 2, taken_back_here /= 2;    // what was long ago counts for less
  if (!faces->torn()) return false;
  ++taken_back;
  ++taken_back_here;
  if (10 * taken_back_here > MAX(tried_here, WORTH_CHECKING))
    error->all(FLERR,
               "Fix {}: {} of {} steps of this timestep would have torn the mesh and were taken back: the timestep {} is too "
               "long; hd_timestep finds the limit, forces of fixes apart", style, taken_back_here, tried_here, update->dt);
  const MeshPart &part = mass.part();
  const double kick = half_kick * force->ftm2v;
  for (int i = 0; i < part.owned; ++i) {
    const int j = part.atom_of(i);
    std::copy_n(held[i].data(), 3, atom->x[j]);
    if (held_reference != mass.references()) continue;    // velocities have been drawn for another mass
    for (int k = 0; k < 3; ++k) atom->v[j][k] = -held[i][3 + k] - kick * acceleration[i].c[k];
  }
  if (remembers) moved.assign(part.owned, Vector4{});
  return true;
}

bool FixHDBase::renew()
{
  if (!sampling()) return false;
  if (noise_steps % RENEW_EVERY == 0 && !(watching && faces->torn())) mass.renew();    // not for a step that is taken back
  const bool another = drawn_for != mass.references();
  drawn_for = mass.references();
  return another;
}

// === Restart

void FixHDBase::archive(RestartArchive &file)
{
  file(noise_steps);
  mass.archive(file);
  bool drawn = sampling() && drawn_for == mass.references();
  file(drawn);
  if (file.is_reading() && sampling() && drawn) drawn_for = mass.settings.reference->renewals;
}

void FixHDBase::write_restart(FILE *fp)
{
  if (comm->me) return;
  RestartArchive file;
  archive(file);
  file.write_of_fix(fp);
}

void FixHDBase::restart(char *buf)
{
  RestartArchive file = RestartArchive::of_fix(buf);
  archive(file);
  if (!file.ok() || !file.at_end())
    error->all(FLERR, "The restart file is damaged, or of another version: fix {} ({})", id, style);
}

/* ---------------------------------------------------------------------- */

double FixHDBase::memory_usage()
{
  return mass.memory_usage() + faces->memory_usage() +
      sizeof(Vector4) *
      (force_field.capacity() + acceleration.capacity() + noise.capacity() + velocity.capacity() +
       moved.capacity());
}
