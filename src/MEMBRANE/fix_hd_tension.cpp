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

#include "fix_hd_tension.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_hd_base.h"
#include "fix_hd_bound.h"
#include "force.h"
#include "group.h"
#include "membrane_random.h"
#include "mesh_box.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using Membrane_NS::CounterRandom;

// of the logarithm of an area or a volume, before the burn-in has found a better one
static constexpr double FIRST_STEP = 1.0e-3;
static constexpr double SMALLEST_STEP = 1.0e-12;

// steps follow the acceptance with gains of 1 at first that fall with this power of attempts over TUNE
static constexpr double FALL = 0.6, TUNE = 10.0;

// a box that has come to this factor of its length when the fix was made, or its inverse, will not stop there
static constexpr double RUNAWAY = 10.0;

// trials at one visit, if they go on until one is accepted
static constexpr int MOST_TRIALS = 1000;

static constexpr const char *KEYWORDS =
    "x, y, z, xy, xz, yz, xyz, tension, pressure, volume, momenta, step, accept, burn, attempts";

/* ---------------------------------------------------------------------- */

FixHDTension::FixHDTension(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), temperature(0.0), tension(0.0), pressure(0.0), has_tension(false), keep_volume(false),
    scale_momenta(false), until_accepted(false), compensating(2), trials(1), seed(0), burn(200), wanted(0.4),
    trial(lmp, "Fix hd/tension"), scaling(lmp, groupbit), has_points(false), plane{0, 1}, longest_step(0.0), movers(0),
    attempts(0), energy(0.0), origin{0.0, 0.0}, averages(NUM_SERIES)
{
  if (narg < 7) utils::missing_cmd_args(FLERR, "fix hd/tension", error);
  nevery = utils::inumeric(FLERR, arg[3], false, lmp);
  temperature = utils::numeric(FLERR, arg[4], false, lmp);
  seed = utils::bnumeric(FLERR, arg[5], false, lmp);
  if (nevery <= 0) error->all(FLERR, "Fix hd/tension: N {} must be a number of steps, 1 or more", arg[3]);
  if (!(temperature > 0.0))
    error->all(FLERR, "Fix hd/tension temperature {} must be positive: without one there is no Monte Carlo; use fix "
                      "press/berendsen or box/relax", arg[4]);
  if (seed <= 0) error->all(FLERR, "Fix hd/tension seed {} must be positive", arg[5]);

  double first_step = FIRST_STEP;
  int iarg = 6;
  while (iarg < narg) {
    const std::string key = arg[iarg];
    if (parse_directions(key)) {
      ++iarg;
      continue;
    }
    static constexpr const char *WITH_VALUE[] = {"tension", "pressure", "volume", "momenta",
                                                 "step",    "accept",   "burn",   "attempts"};
    if (std::find(std::begin(WITH_VALUE), std::end(WITH_VALUE), key) == std::end(WITH_VALUE))
      error->all(FLERR, "Unknown fix hd/tension keyword {}; known are: {}", key, KEYWORDS);
    if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "fix hd/tension " + key, error);
    const std::string value = arg[iarg + 1];
    const auto one_of = [&](const char *yes, const char *no) {
      if (value != yes && value != no)
        error->all(FLERR, "Fix hd/tension {} {}: say {} or {}", key, value, yes, no);
      return value == yes;
    };
    if (key == "volume")
      keep_volume = one_of("keep", "free");
    else if (key == "momenta")
      scale_momenta = one_of("scale", "keep");
    else if (key == "burn")
      burn = utils::bnumeric(FLERR, arg[iarg + 1], false, lmp);
    else if (key == "attempts") {
      until_accepted = value == "accepted";
      trials = until_accepted ? MOST_TRIALS : utils::inumeric(FLERR, arg[iarg + 1], false, lmp);
    } else {
      const double number = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
      if (key == "tension") {
        tension = number;
        has_tension = true;
      } else if (key == "pressure")
        pressure = number;
      else if (key == "accept")
        wanted = number;
      else {
        if (!(number > 0.0)) error->all(FLERR, "Fix hd/tension step {} must be positive", value);
        first_step = number;
      }
    }
    iarg += 2;
  }
  for (Freedom &freedom : freedoms) freedom.step = first_step;
  check_words();

  scalar_flag = vector_flag = 1;
  global_freq = 1;
  extscalar = 1;
  extvector = 0;
  size_vector = NUM_OUTPUT + static_cast<int>(freedoms.size());
  ecouple_flag = 1;
  restart_global = 1;
  dynamic_group_allow = 0;
  for (int k = 0; k < 3; ++k) lengths[k] = domain->prd[k];
}

int FixHDTension::setmask()
{
  return FixConst::END_OF_STEP;
}

bool FixHDTension::parse_directions(const std::string &word)
{
  static constexpr const char *KNOWN[] = {"x", "y", "z", "xy", "xz", "yz", "xyz"};
  if (std::find(std::begin(KNOWN), std::end(KNOWN), word) == std::end(KNOWN)) return false;
  Freedom freedom = {{false, false, false}, 0.0, 0, 0};
  for (char c : word) freedom.along[c - 'x'] = true;
  freedoms.push_back(freedom);
  return true;
}

void FixHDTension::check_words()
{
  if (freedoms.empty())
    error->all(FLERR, "Fix hd/tension: say which directions of the box move: x, y, z, xy, xz, yz or xyz");
  std::array<int, 3> times = {0, 0, 0};
  for (const Freedom &freedom : freedoms)
    for (int k = 0; k < 3; ++k) times[k] += freedom.along[k];
  compensating = -1;
  for (int k = 0; k < 3; ++k) {
    if (times[k] > 1) error->all(FLERR, "Fix hd/tension: {} is said twice", "xyz"[k]);
    if (times[k] == 0) compensating = k;
  }
  if (keep_volume && compensating < 0)
    error->all(FLERR, "Fix hd/tension volume keep: leave one direction out, which keeps the volume when the others move");
  if (keep_volume && pressure != 0.0)
    error->all(FLERR, "Fix hd/tension: pressure does nothing with volume keep, leave one of them out");
  for (int k = 0; k < 3; ++k) {
    if (times[k] == 0 && !(keep_volume && k == compensating)) continue;
    box_change |= k == 0 ? BOX_CHANGE_X : k == 1 ? BOX_CHANGE_Y : BOX_CHANGE_Z;
  }
  check_periodic();
  if (trials < 1) error->all(FLERR, "Fix hd/tension attempts {} must be 1 or more, or accepted", trials);
  if (burn < 0) error->all(FLERR, "Fix hd/tension burn {} must not be negative", burn);
  if (!(wanted > 0.0 && wanted < 1.0))
    error->all(FLERR, "Fix hd/tension accept {} must be between 0 and 1", wanted);
  if (until_accepted && comm->me == 0)
    error->warning(FLERR, "Fix hd/tension attempts accepted leaves states that are hard to leave too soon: means are "
                          "biased, use it to find a box and not to measure one");
}

// === Visits

bigint FixHDTension::next_visit() const
{
  return (update->ntimestep / nevery + 1) * nevery;
}

void FixHDTension::end_of_step()
{
  trial.expect(next_visit());
  check_temperature();
  for (int k = 0; k < trials; ++k)
    if (attempt() && until_accepted) break;
  sample();
  if (next_reneighbor >= 0) next_reneighbor = next_visit();
}

double FixHDTension::kT() const
{
  return force->boltz * temperature;
}

double FixHDTension::area() const
{
  const Eigen::Matrix3d box = box_vectors(*domain);
  return box.col(plane[0]).cross(box.col(plane[1])).norm();
}

double FixHDTension::volume() const
{
  return domain->prd[0] * domain->prd[1] * domain->prd[2];
}

std::array<double, 3> FixHDTension::factors(const Freedom &freedom, double change) const
{
  const int together = static_cast<int>(std::count(freedom.along.begin(), freedom.along.end(), true));
  std::array<double, 3> a = {1.0, 1.0, 1.0};
  for (int k = 0; k < 3; ++k)
    if (freedom.along[k]) a[k] = std::exp(change / together);
  if (keep_volume) a[compensating] = std::exp(-change);
  return a;
}

/* ----------------------------------------------------------------------
   of membranes that are not in the group, and of atoms that are bound to them. Image flags of a closed membrane
   agree with its edges, those of bound atoms need not; a membrane begins where these are least
------------------------------------------------------------------------- */

std::vector<BoxScaling::Cell> FixHDTension::cells_outside() const
{
  if (!has_points || std::count(goes_along.begin(), goes_along.end(), 0) == 0) return {};
  const auto &topology = (*mesh)->topology();
  const int n = 3 * topology.num_vertices();
  std::vector<int> my_image(n, 0), image(n);
  std::vector<double> my_place(n, 0.0), place(n);
  for (int i = 0; i < atom->nlocal; ++i) {
    const int v = (*mesh)->vertex(atom->tag[i]);
    if (v < 0) continue;
    const imageint flags = atom->image[i];
    const imageint its[3] = {flags & IMGMASK, flags >> IMGBITS & IMGMASK, flags >> IMG2BITS};
    for (int k = 0; k < 3; ++k) {
      my_image[3 * v + k] = static_cast<int>(its[k] - IMGMAX);
      my_place[3 * v + k] = atom->x[i][k];
    }
  }
  MPI_Allreduce(my_image.data(), image.data(), n, MPI_INT, MPI_SUM, world);
  MPI_Allreduce(my_place.data(), place.data(), n, MPI_DOUBLE, MPI_SUM, world);
  std::vector<BoxScaling::Cell> least(topology.num_components(), {IMGMAX, IMGMAX, IMGMAX}), cells(atom->nlocal, {0, 0, 0});
  for (int v = 0; v < topology.num_vertices(); ++v)
    for (int k = 0; k < 3; ++k) {
      int &first = least[topology.component(v)][k];
      first = MIN(first, image[3 * v + k]);
    }
  const auto cell = [&](int v, int k) { return image[3 * v + k] - least[topology.component(v)][k]; };
  for (int i = 0; i < atom->nlocal; ++i)
    if (const int v = (*mesh)->vertex(atom->tag[i]); v >= 0)
      for (int k = 0; k < 3; ++k) cells[i][k] = cell(v, k);
  for (auto &fix : modify->get_fix_list()) {
    const auto *bound = dynamic_cast<FixHDBound *>(fix);
    for (int i = 0; i < atom->nlocal && bound; ++i) {
      if (!(atom->mask[i] & bound->groupbit) || !bound->site(i).bound()) continue;
      const int v = (*mesh)->vertex(bound->site(i).corner[0]);
      if (v < 0) continue;
      double d[3];
      for (int k = 0; k < 3; ++k) d[k] = place[3 * v + k] - atom->x[i][k];
      const auto moved = nearest_image(*domain, d);
      for (int k = 0; k < 3; ++k) cells[i][k] = cell(v, k) - moved[k];
    }
  }
  return cells;
}

/* ----------------------------------------------------------------------
   Metropolis. The logarithm of X, a length, area or volume of the box, moves by u; X is sampled uniformly but
   for the weight, hence exp(u). Positions in the box hold, hence what volumes of coordinates do; and momenta
   or velocities.
------------------------------------------------------------------------- */

bool FixHDTension::attempt()
{
  Freedom &freedom = freedoms[attempts % freedoms.size()];
  const auto random = CounterRandom(seed, attempts).uniforms(0, 0);
  const double u = freedom.step * (2.0 * random[0] - 1.0);
  const auto a = factors(freedom, u);

  const double before = trial.begin(), area_before = area(), volume_before = volume();
  double exponent = u;
  for (FixHDBound *fix : held) exponent -= fix->log_areas();
  if (has_points) check_edges(a);
  scaling.begin(cells_outside());
  scaling.apply(a);
  if (!held.empty()) {
    comm->forward_comm();
    for (FixHDBound *fix : held) fix->return_to_sites();
    for (FixHDBound *fix : held) exponent += fix->log_areas();
  }
  double change = trial.evaluate() - before;
  if (scale_momenta)
    change += kinetic_change(a);
  else
    exponent += log_jacobian(a);
  const double work = tension * (area() - area_before) - pressure * (volume() - volume_before) / force->nktv2p;
  exponent -= (change - work) / kT();

  const bool accepted = std::log(random[1]) < exponent;
  if (accepted) {
    trial.keep();
    if (scale_momenta) scale_velocities(a);
    energy += change;
    check_box();
  } else {
    scaling.put_back();
    trial.put_back();
  }
  ++attempts;
  tune(freedom, std::isfinite(exponent) ? std::min(1.0, std::exp(exponent)) : 0.0);
  if (++freedom.attempts > burn && accepted) ++freedom.accepted;
  return accepted;
}

// such as of a gas in a box of any shape: a thin box is as good as a cube

void FixHDTension::check_box()
{
  for (int k = 0; k < 3; ++k) {
    const double factor = domain->prd[k] / lengths[k];
    if (factor > 1.0 / RUNAWAY && factor < RUNAWAY) continue;
    error->all(FLERR,
               "Fix hd/tension: the box has come to {:.3g} of its length in {}: nothing holds it at this tension and "
               "pressure; couple directions, as in xy, or give the membrane an area",
               factor, "xyz"[k]);
  }
}

void FixHDTension::tune(Freedom &freedom, double acceptance)
{
  if (freedom.attempts >= burn) return;
  const double gain = std::pow(1.0 + static_cast<double>(freedom.attempts) / TUNE, -FALL);
  freedom.step *= std::exp(gain * (acceptance - wanted));
  freedom.step = std::clamp(freedom.step, SMALLEST_STEP, longest_step);
}

/* ----------------------------------------------------------------------
   only what is integrated is a coordinate that is sampled: others are where the box puts them
------------------------------------------------------------------------- */

bool FixHDTension::is_sampled(int i) const
{
  if (!(atom->mask[i] & groupbit) || !(atom->mask[i] & movers)) return false;
  return std::none_of(held.begin(), held.end(),
                      [this, i](const FixHDBound *fix) { return atom->mask[i] & fix->groupbit; });
}

double FixHDTension::log_jacobian(const std::array<double, 3> &a)
{
  bigint mine = 0, all;
  for (int i = 0; i < atom->nlocal; ++i) mine += is_sampled(i);
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  return static_cast<double>(all) * std::log(a[0] * a[1] * a[2]);
}

/* ----------------------------------------------------------------------
   p -> A^-1 p, and v the same, since masses are the same in all directions and do not depend on the box
------------------------------------------------------------------------- */

double FixHDTension::kinetic_change(const std::array<double, 3> &a)
{
  std::array<double, 3> twice = {0.0, 0.0, 0.0}, all;
  int surfaces = 0;
  for (auto &fix : modify->get_fix_list())
    if (const auto *integrator = dynamic_cast<FixHDBase *>(fix)) surfaces |= integrator->groupbit;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!is_sampled(i) || atom->mask[i] & surfaces) continue;
    const double m = atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]];
    for (int k = 0; k < 3; ++k) twice[k] += m * atom->v[i][k] * atom->v[i][k];
  }
  MPI_Allreduce(twice.data(), all.data(), 3, MPI_DOUBLE, MPI_SUM, world);
  for (auto &fix : modify->get_fix_list())
    if (auto *integrator = dynamic_cast<FixHDBase *>(fix))
      if (integrator->groupbit & movers) {
        const auto surface = integrator->twice_kinetic();
        for (int k = 0; k < 3; ++k) all[k] += surface[k];
      }
  double change = 0.0;
  for (int k = 0; k < 3; ++k) change += 0.5 * force->mvv2e * all[k] * (1.0 / (a[k] * a[k]) - 1.0);
  return change;
}

void FixHDTension::scale_velocities(const std::array<double, 3> &a)
{
  for (int i = 0; i < atom->nlocal; ++i)
    for (int k = 0; k < 3 && is_sampled(i); ++k) atom->v[i][k] /= a[k];
}

// === Output

void FixHDTension::sample()
{
  for (const Freedom &freedom : freedoms)
    if (freedom.attempts < burn) return;
  if (averages.count() == 0) origin = {area(), volume()};
  const double a = area() - origin[0], v = volume() - origin[1];
  averages.add({a, v, a * a, v * v});
}

double FixHDTension::compute_scalar()
{
  return -energy;
}

double FixHDTension::compute_vector(int which)
{
  const auto variance = [this](int series, int squared) {
    const double mean = averages.mean(series);
    return averages.mean(squared) - mean * mean;
  };
  switch (which) {
    case ATTEMPTS: return static_cast<double>(attempts);
    case ACCEPTANCE: {
      bigint accepted = 0, counted = 0;
      for (const Freedom &freedom : freedoms) {
        accepted += freedom.accepted;
        counted += std::max<bigint>(0, freedom.attempts - burn);
      }
      return counted > 0 ? static_cast<double>(accepted) / counted : 0.0;
    }
    case FACTOR_X:
    case FACTOR_Y:
    case FACTOR_Z: return domain->prd[which - FACTOR_X] / lengths[which - FACTOR_X];
    case MEAN_AREA: return averages.count() ? origin[0] + averages.mean(AREA) : 0.0;
    case ERROR_AREA: return averages.error(AREA);
    case VARIANCE_AREA: return variance(AREA, AREA_SQUARED);
    case MEAN_VOLUME: return averages.count() ? origin[1] + averages.mean(VOLUME) : 0.0;
    case ERROR_VOLUME: return averages.error(VOLUME);
    case VARIANCE_VOLUME: return variance(VOLUME, VOLUME_SQUARED);
    default: return freedoms[which - NUM_OUTPUT].step;
  }
}

// === Restart

void FixHDTension::archive(RestartArchive &file)
{
  file(attempts);
  file(energy);
  for (double &length : lengths) file(length);
  for (double &value : origin) file(value);
  auto directions = static_cast<int>(freedoms.size());
  file(directions);
  if (file.is_reading() && directions != static_cast<int>(freedoms.size()))
    error->all(FLERR, "Fix {} (hd/tension): the restart file has {} directions of the box that move, and the command {}",
               id, directions, freedoms.size());
  for (Freedom &freedom : freedoms) file(freedom);
  file(averages);
}

void FixHDTension::write_restart(FILE *fp)
{
  if (comm->me) return;
  RestartArchive file;
  archive(file);
  file.write_of_fix(fp);
}

void FixHDTension::restart(char *buf)
{
  RestartArchive file = RestartArchive::of_fix(buf);
  archive(file);
  if (!file.ok() || !file.at_end())
    error->all(FLERR, "The restart file is damaged, or of another version: fix {} ({})", id, style);
}
