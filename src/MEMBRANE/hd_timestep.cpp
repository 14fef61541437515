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

#include "hd_timestep.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_hd_base.h"
#include "fix_hd_bound.h"
#include "fmt/format.h"
#include "force.h"
#include "group.h"
#include "hd_stiffness_probe.h"
#include "input.h"
#include "kspace.h"
#include "math_const.h"
#include "membrane_mass_kinds.h"
#include "membrane_tessellation.h"
#include "mesh_group.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>

using namespace LAMMPS_NS;
using MathConst::MY_2PI;
using Membrane_NS::TriangleMesh;
using Membrane_NS::VertexField;

// the largest eigenvalue to 1e-4 of itself, as a rule far better
static constexpr int MOST_STEPS = 400;
static constexpr double TOLERANCE = 1.0e-4;

// trial runs at these fractions of the limit; each lasts four periods of the fastest motion
static constexpr int FRACTIONS[] = {2, 3, 4, 8};
static constexpr int TRIAL_TIME = 12;

// nobody should go further, whatever the error
static constexpr double MOST_OF_LIMIT = 0.5;

// wavelengths that differ by less than this part are the same
static constexpr double SAME = 1.0e-3;

// motion of a membrane at rest: this part of an edge in the time of the limit
static constexpr double STIR = 1.0e-3;
static constexpr uint64_t SEED = 4711;

/* ---------------------------------------------------------------------- */

HDTimestep::HDTimestep(LAMMPS *lmp) :
    Command(lmp), wanted(1.0e-4), degree(0), wavelength(0.0), set(false)
{
}

/* ---------------------------------------------------------------------- */

void HDTimestep::command(int narg, char **arg)
{
  if (!domain->box_exist)
    error->all(FLERR,
               "hd_timestep needs control points: use it after create_membrane or read_data");
  if (narg < 1) utils::missing_cmd_args(FLERR, "hd_timestep", error);
  const int igroup = group->find(arg[0]);
  if (igroup < 0) error->all(FLERR, "Could not find hd_timestep group ID {}", arg[0]);
  HDMass mass(lmp, igroup, "hd_timestep");
  parse(narg, arg, mass, group->bitmask[igroup]);
  const bool overdamped = mass.drag_coefficient() > 0.0;

  StiffnessProbe::place_atoms(lmp);
  FixHDBase::atoms_renumbered(lmp);
  mass.init(true);
  if (mass.count() == 0) error->all(FLERR, "hd_timestep: group {} has no control points", arg[0]);

  // the first forces are those of the present configuration: "init" of pair_coeff is taken here

  StiffnessProbe probe(lmp, mass, StiffnessProbe::Forces::ALL);
  if (!probe.has_forces()) error->all(FLERR, "hd_timestep needs forces: use pair_style helfrich");
  probe.evaluate(true);
  auto largest = probe.largest(MOST_STEPS, TOLERANCE);
  if (!(largest.value > 0.0) || !std::isfinite(largest.value))
    error->all(FLERR,
               "hd_timestep: nothing resists displacements of the control points: are the "
               "coefficients of pair_style helfrich zero?");
  const double springs = largest_of_springs(overdamped);
  largest.value += springs;
  const double fastest = overdamped ? largest.value : std::sqrt(largest.value);
  const double limit = 2.0 / fastest;

  print(fmt::format("Timestep for {} control points, mass {}:\n", mass.count(),
                    Membrane_NS::mass_kind_name(mass.settings.kind)));
  print(fmt::format("  {:<36}{:.6g}\n",
                    overdamped ? "largest relaxation rate" : "largest frequency", fastest));
  if (largest.uncertainty > TOLERANCE * largest.value)
    print(fmt::format("  (Lanczos' method did not converge: true to {:.1g} only)\n",
                      largest.uncertainty / largest.value));
  if (springs > 0.0)
    print(fmt::format("  {:<36}{:.6g}\n", overdamped ? "of these, of bound particles" : "of bound particles alone",
                      overdamped ? springs : std::sqrt(springs)));
  std::string others;
  for (int i = 0; i < modify->nfix; ++i) {
    const Fix *fix = modify->fix[i];
    const bool ours = utils::strmatch(fix->style, "^hd/") || utils::strmatch(fix->style, "^srd");
    if (!(modify->fmask[i] & FixConst::POST_FORCE) || ours || utils::strmatch(fix->style, "^langevin")) continue;
    if (groups_meet(lmp, group->bitmask[igroup], fix->groupbit)) others += fmt::format(" {} ({})", fix->id, fix->style);
  }
  if (!others.empty()) print(fmt::format("  (without the forces of fixes:{})\n", others));
  print(fmt::format("  {:<36}{:.6g}\n", "stability limit", limit));

  double period = 0.0;
  if (degree || wavelength > 0.0) {
    double fits = 0.0;
    const double value = probe.quotient(mode_shape(mass, fits));
    const std::string name = degree ? fmt::format("period of degree {}", degree)
                                    : fmt::format("period of wavelength {:.4g}", fits);
    if (!degree && std::fabs(fits / wavelength - 1.0) > SAME)
      print(fmt::format("  (of the waves in this box the one of {:.4g} is nearest to {:.4g})\n", fits, wavelength));
    if (value > 0.0) period = overdamped ? 1.0 / value : MY_2PI / std::sqrt(value);
    if (value > 0.0)
      print(fmt::format("  {:<36}{:.6g}\n", overdamped ? "relaxation time" + name.substr(6) : name,
                        period));
    else
      print(fmt::format("  {:<36}none: nothing restores this mode\n", name));
  }

  // an error of energies matters to dynamics, which mass sampling has not

  double dt = MOST_OF_LIMIT * limit;
  if (!overdamped && mass.settings.kind != Membrane_NS::MassKind::SAMPLING) {
    const auto trials = run_trials(mass, probe, limit);

    // error = a dt^2; the longest step is still off this law

    double log_a = 0.0, least = HUGE_VAL, most = -HUGE_VAL;
    int n = 0;
    print("  trial step      of limit    relative energy error\n");
    for (const Trial &trial : trials) {
      print(fmt::format("  {:<16.6g}{:<12.4g}{:.3g}\n", trial.dt, trial.dt / limit, trial.error));
      if (&trial == &trials.front() || !(trial.error > 0.0)) continue;
      const double one = std::log(trial.error / (trial.dt * trial.dt));
      log_a += one;
      least = std::min(least, one);
      most = std::max(most, one);
      ++n;
    }
    if (n == 0 || !std::isfinite(log_a))
      error->all(FLERR, "hd_timestep: trial runs gave no energy error; is the state sensible?");
    if (most - least > std::log(2.0))
      print("  (not proportional to dt^2: this state changes much within the trial runs)\n");
    dt = std::min(dt, std::sqrt(wanted / std::exp(log_a / n)));
  }
  probe.restore();
  probe.evaluate(true);
  mass.report_missed_tolerance();

  // two digits, rounded down

  const double unit = std::pow(10.0, std::floor(std::log10(dt)) - 1.0);
  dt = std::floor(dt / unit * (1.0 + 1.0e-12)) * unit;
  print(fmt::format("  {:<36}{:.2g}\n", "recommended timestep", dt));
  print(fmt::format("  {:<36}{:.4g}{}\n", "present timestep", update->dt,
                    update->dt > limit ? "  (beyond the stability limit)" : ""));
  if (period > 0.0)
    print(fmt::format("  {:<36}{:.0f}\n", "recommended steps in this time", period / dt));
  if (set) input->one(fmt::format("timestep {:.2g}", dt));
}

/* ----------------------------------------------------------------------
   squares of frequencies, or rates, add up at most. Springs that follow the timestep do not limit it
------------------------------------------------------------------------- */

double HDTimestep::largest_of_springs(bool overdamped) const
{
  double sum = 0.0;
  for (auto &fix : modify->get_fix_by_style("^hd/bind$")) {
    auto *bind = dynamic_cast<FixHDBound *>(fix);
    if (bind->follows_timestep()) continue;
    bind->update_feet();
    sum += bind->stiffness() *
        (overdamped ? bind->largest_mobility() : force->ftm2v * bind->largest_response());
  }
  return sum;
}

void HDTimestep::print(const std::string &text) const
{
  if (comm->me == 0) utils::logmesg(lmp, text);
}

/* ---------------------------------------------------------------------- */

void HDTimestep::parse(int narg, char **arg, HDMass &mass, int groupbit)
{
  // the matrix of the integrator of these atoms, unless the user chooses one

  const FixHDBase *integrator = FixHDBase::of_group(lmp, groupbit, "hd_timestep");
  if (integrator) {
    mass.settings = integrator->mass_settings();
    if (integrator->drag_coefficient() > 0.0) mass.set_drag(integrator->drag_coefficient());
  }

  int iarg = 1;
  while (iarg < narg) {
    if (const int used = mass.parse(iarg, narg, arg)) {
      iarg += used;
      continue;
    }
    const std::string key = arg[iarg];
    if (key != "error" && key != "mode" && key != "set")
      error->all(FLERR,
                 "Unknown hd_timestep keyword {}; known are: mass, solver, tol, error, mode, set",
                 key);
    const int words = key == "mode" ? 3 : 2;
    if (iarg + words > narg) utils::missing_cmd_args(FLERR, "hd_timestep " + key, error);
    const char *value = arg[iarg + words - 1];
    if (key == "error") {
      wanted = utils::numeric(FLERR, value, false, lmp);
      if (!(wanted > 0.0 && wanted < 1.0))
        error->all(FLERR, "hd_timestep error {} must be between 0 and 1", value);
    } else if (key == "set") {
      set = utils::logical(FLERR, value, false, lmp);
    } else {
      const std::string kind = arg[iarg + 1];
      degree = 0;
      wavelength = 0.0;
      if (kind == "degree") {
        degree = utils::inumeric(FLERR, value, false, lmp);
        if (degree < 2) error->all(FLERR, "hd_timestep mode degree {} must be 2 or more", value);
      } else if (kind == "wavelength") {
        wavelength = utils::numeric(FLERR, value, false, lmp);
        if (!(wavelength > 0.0))
          error->all(FLERR, "hd_timestep mode wavelength {} must be positive", value);
      } else
        error->all(FLERR, "hd_timestep mode {} is not degree or wavelength", kind);
    }
    iarg += words;
  }
}

/* ----------------------------------------------------------------------
   displacement along normals: a zonal harmonic of each closed membrane about its middle, or a wave
   along the box vector in which the wavelength fits best
------------------------------------------------------------------------- */

// Legendre's polynomial
static double legendre(int degree, double x)
{
  double p = 1.0, before = 0.0;
  for (int l = 1; l <= degree; ++l) {
    const double next = ((2 * l - 1) * x * p - (l - 1) * before) / l;
    before = p;
    p = next;
  }
  return p;
}

VertexField HDTimestep::mode_shape(HDMass &mass, double &fits) const
{
  const DistributedMesh &mesh = mass.mesh();
  const auto &topology = mesh.topology();
  const int ncomponents = topology.num_components();
  const TriangleMesh control = mesh.triangle_mesh();

  std::vector<Eigen::Vector3d> middle(ncomponents, Eigen::Vector3d::Zero());
  for (int v = 0; v < topology.num_vertices(); ++v)
    middle[topology.component(v)] +=
        control.points[v] / topology.num_vertices(topology.component(v));

  // fractional coordinate to a phase; zero where there is nothing to do

  std::vector<Eigen::RowVector3d> wave(ncomponents, Eigen::RowVector3d::Zero());
  if (wavelength > 0.0) {
    if (wavelength < 2.0 * mesh.longest_edge())
      error->all(FLERR, "hd_timestep mode wavelength {} is shorter than two edges, {:.4g}",
                 wavelength, 2.0 * mesh.longest_edge());
    const Eigen::Matrix3d inverse = control.lattice.inverse();
    const auto continues = continuing_directions(topology, control);
    for (int c = 0; c < ncomponents; ++c) {
      double best = HUGE_VAL;
      for (int k = 0; k < 3; ++k) {
        if (!continues[c][k]) continue;
        const double length = 1.0 / inverse.row(k).norm();
        const double n = std::max(1.0, std::round(length / wavelength));
        const double off = std::fabs(std::log(length / n / wavelength));
        if (off > best) continue;
        best = off;
        fits = length / n;
        wave[c] = MY_2PI * n * inverse.row(k);
      }
    }
  }

  MeshPart &part = mass.part();
  VertexField shape(part.size());
  double size = 0.0;
  for (int i = 0; i < part.owned; ++i) {
    const int v = part.vertices[i], c = topology.component(v);
    if (degree ? !mesh.is_closed(c) : wave[c].isZero()) continue;
    const Eigen::Vector3d r = control.points[v] - middle[c];
    const double height = degree ? legendre(degree, r.normalized().z()) : std::cos(wave[c].dot(r));
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    const auto ring = topology.ring(v);
    const int n = topology.valence(v);
    for (int k = 0; k < n; ++k)
      normal += control.edge(v, ring[k]).cross(control.edge(v, ring[(k + 1) % n]));
    Eigen::Map<Eigen::Vector3d>(shape[i].c) = height * normal.normalized();
    size += 1.0;
  }
  part.sum(&size, 1);
  if (size == 0.0)
    error->all(FLERR, "hd_timestep mode: group has no membrane that {}",
               degree ? "is closed; use mode wavelength"
                      : "continues through the box; use mode degree");
  return shape;
}

/* ----------------------------------------------------------------------
   velocities of equilibrium, so slow that nothing but the linear response matters, if there are none
------------------------------------------------------------------------- */

bool HDTimestep::start_moving(HDMass &mass, double limit) const
{
  double t[6];
  mass.kinetic(t);
  if (t[0] + t[1] + t[2] > 0.0) return false;
  double heaviest = 0.0, mine = 0.0;
  for (int i = 0; i < mass.part().owned; ++i)
    mine = std::max(mine, atom->rmass[mass.part().atom_of(i)]);
  MPI_Allreduce(&mine, &heaviest, 1, MPI_DOUBLE, MPI_MAX, world);
  const double speed = STIR * mass.mesh().longest_edge() / limit;
  VertexField v(mass.part().size());
  mass.matrix().sample(heaviest * speed * speed, SEED, 0, v);
  mass.part().store(v, atom->v);
  return true;
}

/* ----------------------------------------------------------------------
   spread (root mean square deviation) of the energy in a run of velocity Verlet, relative to the
   mean kinetic energy
------------------------------------------------------------------------- */

double HDTimestep::energy_error(HDMass &mass, StiffnessProbe &probe, double dt, int nsteps) const
{
  MeshPart &part = mass.part();
  VertexField f, a(part.size());
  auto kinetic = [&] {
    double t[6];
    mass.kinetic(t);
    return 0.5 * force->mvv2e * (t[0] + t[1] + t[2]);
  };
  auto kick = [&] {
    part.load(atom->f, f);
    mass.matrix().solve(f, a);
    for (int i = 0; i < part.owned; ++i)
      for (int k = 0; k < 3; ++k)
        atom->v[part.atom_of(i)][k] += 0.5 * dt * force->ftm2v * a[i].c[k];
  };

  const double start = probe.evaluate(true) + kinetic();
  double moving = 0.0, first = 0.0, second = 0.0;    // sums of kinetic and change of energy
  int step = 0;
  for (; step < nsteps; ++step) {
    kick();
    for (int i = 0; i < part.owned; ++i)
      for (int k = 0; k < 3; ++k) atom->x[part.atom_of(i)][k] += dt * atom->v[part.atom_of(i)][k];
    const double potential = probe.evaluate(true);
    kick();
    const double ke = kinetic(), change = potential + ke - start;
    moving += ke;
    first += change;
    second += change * change;
    if (!has_other_atoms(mass) || !neighbor->dist_check || !neighbor->check_distance()) continue;
    renew_lists(mass);
    a.resize(part.size());
  }
  return std::sqrt(std::max(0.0, second / step - first * first / (step * step))) * step / moving;
}

// ghosts and neighbor lists, while owned atoms keep their indices

void HDTimestep::renew_lists(HDMass &mass) const
{
  if (atom->map_style != Atom::MAP_NONE) atom->map_clear();
  atom->nghost = 0;
  atom->avec->clear_bonus();
  if (domain->triclinic) domain->x2lamda(atom->nlocal);
  comm->borders();
  if (domain->triclinic) domain->lamda2x(atom->nlocal + atom->nghost);
  neighbor->build(1);
  mass.refresh();
}

bool HDTimestep::has_other_atoms(HDMass &mass) const
{
  return atom->natoms > mass.mesh().topology().num_vertices();
}

std::vector<HDTimestep::Trial> HDTimestep::run_trials(HDMass &mass, StiffnessProbe &probe,
                                                      double limit) const
{
  std::vector<std::array<double, 3>> v_before(atom->nlocal);
  auto put_back = [&] {
    for (int i = 0; i < atom->nlocal; ++i) std::copy_n(v_before[i].data(), 3, atom->v[i]);
    probe.restore();
    if (has_other_atoms(mass)) renew_lists(mass);
  };
  for (int i = 0; i < atom->nlocal; ++i) std::copy_n(atom->v[i], 3, v_before[i].data());

  std::vector<Trial> trials;
  for (int fraction : FRACTIONS) {
    put_back();
    if (start_moving(mass, limit) && trials.empty())
      print("  (the membrane is at rest: trial runs start with small random velocities)\n");
    const double dt = limit / fraction;
    trials.push_back({dt, energy_error(mass, probe, dt, TRIAL_TIME * fraction)});
  }
  put_back();
  return trials;
}
