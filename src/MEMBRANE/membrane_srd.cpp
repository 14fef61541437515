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

#include "membrane_srd.h"

#include "membrane_random.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace Membrane_NS {

// numbers for different uses must differ even if a user gives all commands the same seed
static constexpr uint64_t CELL_NUMBERS = 0x63656c6c73000000ULL;
static constexpr uint64_t SHIFT_NUMBERS = 0x7368696674000000ULL;
static constexpr uint64_t VELOCITY_NUMBERS = 0x76656c6f63000000ULL;

// moments that all rules have
enum { COUNT, MASS, MOMENTUM };
// SRD with thermostat: sum m v^2
static constexpr int ENERGY = MOMENTUM + 3;
// AT_A, with d the offset and r the random velocity: sums of m r, m d, m d d, m d x (v - r)
static constexpr int DRAWN = MOMENTUM + 3, FIRST = DRAWN + 3, SECOND = FIRST + 3,
                     ANGULAR = SECOND + 6;

// === Kinetic theory

double srd_viscosity(double particles, double angle, double kT, double mass, double cell,
                     double step)
{
  const double M = particles, f = M - 1.0 + std::exp(-M);
  if (!(f > 0.0)) return 0.0;
  const double kinetic = kT * step / (2.0 * mass) *
      (5.0 * M / (f * (2.0 - std::cos(angle) - std::cos(2.0 * angle))) - 1.0);
  const double collisional = cell * cell / (18.0 * step) * (f / M) * (1.0 - std::cos(angle));
  return M * mass / (cell * cell * cell) * (kinetic + collisional);
}

double at_viscosity(double particles, double kT, double mass, double cell, double step)
{
  const double M = particles;
  if (!(M > 1.4)) return 0.0;
  const double kinetic = M * kT * step / (cell * cell * cell) * (M / (M - 1.25) - 0.5);
  const double collisional = mass / (24.0 * cell * step) * (M - 1.4);
  return kinetic + collisional;
}

double mean_free_path(double kT, double mass, double step)
{
  return step * std::sqrt(kT / mass);
}

// === Sums over the particles of a cell

int CollisionRule::num_moments() const
{
  if (settings_.method == Method::AT_A) return ANGULAR + 3;
  return settings_.thermostat ? ENERGY + 1 : MOMENTUM + 3;
}

// cells are all over the memory: what the particles ahead need is asked for in time

static constexpr int AHEAD = 16;

static void fetch_ahead(const SRDParticles &p, int i, const double *values, int width)
{
  const int cell = i + AHEAD < p.count ? p.cell[i + AHEAD] : -1;
  if (cell < 0) return;
  const double *first = values + (size_t) width * cell;
  __builtin_prefetch(first, 1);
  __builtin_prefetch(first + width - 1, 1);
}

template <bool WITH_ENERGY> static void add_momenta(const SRDParticles &p, double *moments)
{
  constexpr int WIDTH = WITH_ENERGY ? ENERGY + 1 : MOMENTUM + 3;
  for (int i = 0; i < p.count; ++i) {
    fetch_ahead(p, i, moments, WIDTH);
    if (p.cell[i] < 0) continue;
    double *a = moments + (size_t) WIDTH * p.cell[i];
    const double *v = p.velocity + 3 * (size_t) i, m = p.mass[i];
    a[COUNT] += 1.0;
    a[MASS] += m;
    a[MOMENTUM] += m * v[0];
    a[MOMENTUM + 1] += m * v[1];
    a[MOMENTUM + 2] += m * v[2];
    if (WITH_ENERGY) a[ENERGY] += m * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  }
}

void CollisionRule::add(const SRDParticles &p, uint64_t step, double *moments) const
{
  if (settings_.method == Method::SRD) {
    if (settings_.thermostat)
      add_momenta<true>(p, moments);
    else
      add_momenta<false>(p, moments);
    return;
  }

  draw(p, step);
  for (int i = 0; i < p.count; ++i) {
    if (p.cell[i] < 0) continue;
    double *a = moments + (size_t) (ANGULAR + 3) * p.cell[i];
    const double *v = p.velocity + 3 * (size_t) i, *d = p.offset + 3 * (size_t) i,
                 *r = p.drawn + 3 * (size_t) i;
    const double m = p.mass[i];
    const double w[3] = {v[0] - r[0], v[1] - r[1], v[2] - r[2]};
    a[COUNT] += 1.0;
    a[MASS] += m;
    for (int k = 0; k < 3; ++k) {
      a[MOMENTUM + k] += m * v[k];
      a[DRAWN + k] += m * r[k];
      a[FIRST + k] += m * d[k];
      a[SECOND + k] += m * d[k] * d[k];
    }
    a[SECOND + 3] += m * d[0] * d[1];
    a[SECOND + 4] += m * d[0] * d[2];
    a[SECOND + 5] += m * d[1] * d[2];
    a[ANGULAR] += m * (d[1] * w[2] - d[2] * w[1]);
    a[ANGULAR + 1] += m * (d[2] * w[0] - d[0] * w[2]);
    a[ANGULAR + 2] += m * (d[0] * w[1] - d[1] * w[0]);
  }
}

void CollisionRule::draw(const SRDParticles &p, uint64_t step) const
{
  const CounterRandom random(settings_.seed ^ CELL_NUMBERS, step);
  for (int i = 0; i < p.count; ++i) {
    if (p.cell[i] < 0) continue;
    const auto z = random.normals(p.label[i]);
    const double scale = std::sqrt(settings_.kT / p.mass[i]);
    for (int k = 0; k < 3; ++k) p.drawn[3 * (size_t) i + k] = scale * z[k];
  }
}

// === What a cell does

void CollisionRule::prepare(int cells, const int64_t *numbers, uint64_t step, const double *moments,
                            double *actions) const
{
  const CounterRandom random(settings_.seed ^ CELL_NUMBERS, step);
  double axis[CounterRandom::MANY][3];
  for (int c = 0; c < cells; ++c, moments += num_moments(), actions += num_actions()) {
    const int k = c % CounterRandom::MANY;
    if (settings_.method == Method::SRD && k == 0)
      random.unit_vectors(numbers + c, std::min(cells - c, CounterRandom::MANY), axis);
    if (moments[COUNT] == 0.0) continue;
    if (settings_.method == Method::SRD)
      prepare_rotation(numbers[c], step, moments, axis[k], actions);
    else
      prepare_andersen(moments, actions);
  }
}

/* ----------------------------------------------------------------------
   action: mean velocity, and the matrix that acts on velocities relative to it, a rotation about the axis
------------------------------------------------------------------------- */

void CollisionRule::prepare_rotation(int64_t number, uint64_t step, const double *moments,
                                     const double (&n)[3], double *action) const
{
  for (int k = 0; k < 3; ++k) action[k] = moments[MOMENTUM + k] / moments[MASS];
  double *r = action + 3;
  if (moments[COUNT] < 1.5) {
    std::fill_n(r, 9, 0.0);
    r[0] = r[4] = r[8] = 1.0;
    return;
  }

  const double scale = settings_.thermostat ? thermal_scale(number, step, moments) : 1.0;
  const double c = scale * cos_angle_, s = scale * sin_angle_, e = scale - c;
  r[0] = e * n[0] * n[0] + c;
  r[1] = e * n[0] * n[1] - s * n[2];
  r[2] = e * n[0] * n[2] + s * n[1];
  r[3] = e * n[1] * n[0] + s * n[2];
  r[4] = e * n[1] * n[1] + c;
  r[5] = e * n[1] * n[2] - s * n[0];
  r[6] = e * n[2] * n[0] - s * n[1];
  r[7] = e * n[2] * n[1] + s * n[0];
  r[8] = e * n[2] * n[2] + c;
}

/* ----------------------------------------------------------------------
   the square root of (energy drawn)/(energy had); the Gamma distribution is sampled by
   [G. Marsaglia and W. W. Tsang, ACM Trans. Math. Softw. 26, 363 (2000)]
------------------------------------------------------------------------- */

double CollisionRule::thermal_scale(int64_t number, uint64_t step, const double *moments) const
{
  const double *p = moments + MOMENTUM;
  const double had =
      0.5 * (moments[ENERGY] - (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / moments[MASS]);
  if (!(had > 0.0)) return 1.0;

  const CounterRandom random(settings_.seed ^ CELL_NUMBERS, step);
  const double d = 1.5 * (moments[COUNT] - 1.0) - 1.0 / 3.0, c = 1.0 / std::sqrt(9.0 * d);
  for (uint32_t block = 1;; ++block) {    // one try in a hundred or fewer fails
    const auto x = random.normals(number, 2 * block)[0];
    const double v = std::pow(1.0 + c * x, 3);
    if (!(v > 0.0)) continue;
    const double u = random.uniforms(number, 2 * block + 1)[0];
    if (std::log(u) < 0.5 * x * x + d - d * v + d * std::log(v))
      return std::sqrt(settings_.kT * d * v / had);
  }
}

/* ----------------------------------------------------------------------
   v' = u + r - <r> + omega x (d - <d>) with I omega = sum m (d - <d>) x (v - r): action: what is
   added to r, and omega
------------------------------------------------------------------------- */

void CollisionRule::prepare_andersen(const double *a, double *action) const
{
  const double M = a[MASS];
  const Eigen::Vector3d first = Eigen::Map<const Eigen::Vector3d>(a + FIRST) / M,
                        gain = (Eigen::Map<const Eigen::Vector3d>(a + MOMENTUM) -
                                Eigen::Map<const Eigen::Vector3d>(a + DRAWN)) /
      M;
  Eigen::Vector3d omega = Eigen::Vector3d::Zero();
  if (a[COUNT] > 1.5) {
    const double *q = a + SECOND;
    Eigen::Matrix3d second;
    second << q[0], q[3], q[4], q[3], q[1], q[5], q[4], q[5], q[2];
    second -= M * first * first.transpose();
    const Eigen::Vector3d angular =
        Eigen::Map<const Eigen::Vector3d>(a + ANGULAR) - M * first.cross(gain);

    // particles on a line, always so with two, have no inertia about it

    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(second);
    const double trace = second.trace();
    constexpr double ROUNDING = 1.0e-13;
    for (int k = 0; k < 3; ++k) {
      const double inertia = trace - axes.eigenvalues()[k];
      if (inertia <= ROUNDING * trace) continue;
      const Eigen::Vector3d axis = axes.eigenvectors().col(k);
      omega += axis.dot(angular) / inertia * axis;
    }
  }
  Eigen::Map<Eigen::Vector3d>(action, 3) = gain - omega.cross(first);
  Eigen::Map<Eigen::Vector3d>(action + 3, 3) = omega;
}

// === Back to the particles

void CollisionRule::apply(const SRDParticles &p, const double *actions) const
{
  if (settings_.method == Method::SRD) {
    for (int i = 0; i < p.count; ++i) {
      fetch_ahead(p, i, actions, 12);
      if (p.cell[i] < 0) continue;
      const double *u = actions + 12 * (size_t) p.cell[i], *r = u + 3;
      double *v = p.velocity + 3 * (size_t) i;
      const double x = v[0] - u[0], y = v[1] - u[1], z = v[2] - u[2];
      v[0] = u[0] + (r[0] * x + r[1] * y + r[2] * z);
      v[1] = u[1] + (r[3] * x + r[4] * y + r[5] * z);
      v[2] = u[2] + (r[6] * x + r[7] * y + r[8] * z);
    }
    return;
  }
  for (int i = 0; i < p.count; ++i) {
    if (p.cell[i] < 0) continue;
    const double *gain = actions + 6 * (size_t) p.cell[i], *w = gain + 3;
    const double *d = p.offset + 3 * (size_t) i, *r = p.drawn + 3 * (size_t) i;
    double *v = p.velocity + 3 * (size_t) i;
    v[0] = gain[0] + r[0] + (w[1] * d[2] - w[2] * d[1]);
    v[1] = gain[1] + r[1] + (w[2] * d[0] - w[0] * d[2]);
    v[2] = gain[2] + r[2] + (w[0] * d[1] - w[1] * d[0]);
  }
}

// === Thermal energy

void CellEnergy::add(const SRDParticles &particles, double *moments)
{
  add_momenta<true>(particles, moments);
}

void CellEnergy::count(const double *a)
{
  if (a[COUNT] < 1.5) return;
  const double *p = a + MOMENTUM;
  energy += a[ENERGY] - (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / a[MASS];
  freedom += 3.0 * (a[COUNT] - 1.0);
}

// === Random numbers

void random_shift(uint64_t seed, uint64_t step, double *shift)
{
  const CounterRandom random(seed ^ SHIFT_NUMBERS, step);
  const auto a = random.uniforms(0, 0), b = random.uniforms(0, 1);
  shift[0] = a[0];
  shift[1] = a[1];
  shift[2] = b[0];
}

void thermal_velocity(uint64_t seed, uint64_t step, uint64_t label, double kT, double mass,
                      double *velocity)
{
  const auto z = CounterRandom(seed ^ VELOCITY_NUMBERS, step).normals(label);
  const double scale = std::sqrt(kT / mass);
  for (int k = 0; k < 3; ++k) velocity[k] = scale * z[k];
}

}    // namespace Membrane_NS
