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
#include "fix_hd_base.h"
#include "force.h"
#include "group.h"
#include "membrane_random.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace LAMMPS_NS;
using Eigen::Vector3d;
using Membrane_NS::CounterRandom;

// of the largest eigenvalue by the power method: passes, and the change in one at which it is enough
static constexpr int MOST_PASSES = 30;
static constexpr double ENOUGH = 1.0e-3;

// === What one particle does to another through the membrane

void FixHDBound::clear_work()
{
  if (atom->nlocal + atom->nghost) std::fill_n(work[0], 3 * (atom->nlocal + atom->nghost), 0.0);
}

/* ----------------------------------------------------------------------
   to owned control points: sum over particles a of c_a n_a y_a, into work
------------------------------------------------------------------------- */

void FixHDBound::spread(const std::vector<double> &y)
{
  clear_work();
  for (size_t a = 0; a < feet.size(); ++a) {
    const Foot &foot = feet[a];
    const Vector3d along = y[a] * foot.normal;
    for (int k = foot.start; k < foot.start + foot.size; ++k)
      for (int d = 0; d < 3; ++d) work[points[k]][d] += weights[k] * along[d];
  }
  exchanged = work;
  comm->reverse_comm(this);
}

std::vector<FixHDBase *> FixHDBound::integrators(bool overdamped) const
{
  std::vector<FixHDBase *> found;
  for (auto &fix : modify->get_fix_list())
    if (auto *integrator = dynamic_cast<FixHDBase *>(fix))
      if ((integrator->drag_coefficient() > 0.0) == overdamped) found.push_back(integrator);
  return found;
}

/* ----------------------------------------------------------------------
   (1/m + S) y, or with mobilities in place of inverse masses; control points that nothing moves do not answer
------------------------------------------------------------------------- */

void FixHDBound::respond(const std::vector<double> &y, std::vector<double> &result, bool overdamped)
{
  spread(y);
  if (atom->nlocal) std::fill_n(answer[0], 3 * atom->nlocal, 0.0);
  for (FixHDBase *integrator : integrators(overdamped)) integrator->respond(work, answer);
  exchanged = answer;
  comm->forward_comm(this);
  result.resize(feet.size());
  for (size_t a = 0; a < feet.size(); ++a) {
    const Foot &foot = feet[a];
    double own = 0.0;
    if (overdamped == is_overdamped())
      own = overdamped ? diffusion / (force->boltz * temperature) / force->ftm2v : 1.0 / mass_of(foot.atom);
    double sum = own * y[a];
    for (int k = foot.start; k < foot.start + foot.size; ++k)
      for (int d = 0; d < 3; ++d) sum += weights[k] * foot.normal[d] * answer[points[k]][d];
    result[a] = sum;
  }
}

// by the power method: from below, within a few percent

double FixHDBound::largest(bool overdamped)
{
  std::vector<double> y(feet.size()), next;
  const CounterRandom random(1, 0);
  for (size_t a = 0; a < feet.size(); ++a) y[a] = random.normals(atom->tag[feet[a].atom])[0];
  double value = 0.0;
  for (int pass = 0; pass < MOST_PASSES; ++pass) {
    respond(y, next, overdamped);
    double mine[2] = {0.0, 0.0}, all[2];
    for (size_t a = 0; a < y.size(); ++a) {
      mine[0] += y[a] * y[a];
      mine[1] += next[a] * next[a];
    }
    MPI_Allreduce(mine, all, 2, MPI_DOUBLE, MPI_SUM, world);
    if (!(all[0] > 0.0 && all[1] > 0.0)) return 0.0;
    const double before = value;
    value = std::sqrt(all[1] / all[0]);
    const double scale = 1.0 / std::sqrt(all[1]);
    for (size_t a = 0; a < y.size(); ++a) y[a] = scale * next[a];
    if (std::fabs(value - before) < ENOUGH * value) break;
  }
  return value;
}

double FixHDBound::largest_response()
{
  return total > 0 ? largest(false) : 0.0;
}

double FixHDBound::largest_mobility()
{
  const bool any = is_overdamped() || !integrators(true).empty();
  return total > 0 && any ? force->ftm2v * largest(true) : 0.0;
}

// === Curvature

// in a direction at random, the same on any number of ranks

void FixHDBound::give_director(int i, const Vector3d &normal)
{
  const auto z = CounterRandom(turning_seed ^ 0x6469720000ULL, 0).normals(atom->tag[i]);
  const Vector3d any(z[0], z[1], z[2]);
  Vector3d::Map(sites[i].director) = (any - any.dot(normal) * normal).normalized();
}

void FixHDBound::couple()
{
  curvature.update();
  torque.assign(members.size(), 0.0);
  footprint_energy = 0.0;
  clear_work();

  // neighbours one after the other, since they share faces; as above not in LAMMPS' order

  std::vector<int> order(feet.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [this](int a, int b) {
    return sites[feet[a].atom].point.face < sites[feet[b].atom].point.face;
  });
  for (int a : order) {
    const int i = feet[a].atom;
    limit->look_from(i);
    auto director = Vector3d::Map(sites[i].director);
    if (curvature.has_director(atom->type[i]) && director.isZero()) give_director(i, feet[a].normal);
    Vector3d turn = Vector3d::Zero();
    footprint_energy += curvature.add(i, sites[i], atom->f[i], turn);
    torque[a] = director.cross(turn).dot(Vector3d::Map(sites[i].normal));
    if (vflag_atom) take_footprints(i);
  }
  energy += footprint_energy;
  if (!vflag_atom) take_footprints(-1);
  exchanged = work;
  comm->reverse_comm(this);
  for (int i = 0; i < atom->nlocal; ++i)
    for (int k = 0; k < 3; ++k) atom->f[i][k] += work[i][k];
}

/* ----------------------------------------------------------------------
   The last step of the chain rule, once for all particles that share faces; or for one alone, whose virial it then is
------------------------------------------------------------------------- */

void FixHDBound::take_footprints(int i)
{
  double v[6] = {};
  curvature.take_forces(work, v);
  if (!evflag) return;
  if (i >= 0)
    v_tally(1, &i, 1.0, v);
  else if (vflag_global)
    for (int k = 0; k < 6; ++k) virial[k] += v[k];
}

// d angle = D/kT torque dt + sqrt(2 D dt) (xi_n + xi_n+1)/2, about the normal

void FixHDBound::turn_directors()
{
  const double dt = update->dt, noise = 0.5 * std::sqrt(2.0 * turning * dt);
  const double mobility = turning / (force->boltz * turning_temperature);
  const CounterRandom now(turning_seed, noise_steps), next(turning_seed, noise_steps + 1);
  if (diffusion == 0.0) ++noise_steps;
  for (size_t a = 0; a < feet.size() && a < torque.size(); ++a) {
    const int i = feet[a].atom;
    if (!curvature.has_director(atom->type[i])) continue;
    const double angle = mobility * torque[a] * dt +
        noise * (now.normals(atom->tag[i], 1)[0] + next.normals(atom->tag[i], 1)[0]);
    auto t = Vector3d::Map(sites[i].director);
    t = (std::cos(angle) * t + std::sin(angle) * Vector3d::Map(sites[i].normal).cross(t)).eval();
  }
}

// === Motion

void FixHDBound::initial_integrate(int)
{
  if (turning > 0.0 && curvature.any()) turn_directors();
  if (diffusion > 0.0) diffuse();
  if (rigid) constrain_positions();
}

void FixHDBound::final_integrate()
{
  if (rigid) constrain_velocities();
}

/* ----------------------------------------------------------------------
   With drag against the membrane, friction -zeta (dx/dt - c dq/dt) on x and c times the opposite on q, so
     dq/dt = Z^-1 (f_q + c f_x),  dx/dt = mu f_x + c dq/dt:
   what pulls a particle pulls the membrane, and this carries it along. Since c depends on where x is, the control
   points feel kT dc/dx besides, the pressure of an ideal gas (doc/src/Derivation_bound.rst)
------------------------------------------------------------------------- */

void FixHDBound::drag_membrane()
{
  const double kT = force->boltz * temperature;
  Membrane_NS::SurfaceWeights row;
  clear_work();
  for (const Foot &foot : feet) {
    const auto &point = sites[foot.atom].point;
    limit->look_from(foot.atom);
    const auto jet = limit->evaluate<1>(point);
    limit->weights<1>(point, row);
    const Eigen::Matrix2d inverse = jet.metric().inverse();
    const Vector3d up[2] = {inverse(0, 0) * jet.du() + inverse(0, 1) * jet.dv(),
                            inverse(1, 0) * jet.du() + inverse(1, 1) * jet.dv()};
    for (int k = 0; k < foot.size; ++k)
      for (int d = 0; d < 3; ++d)
        work[points[foot.start + k]][d] += weights[foot.start + k] * atom->f[foot.atom][d] +
            kT * (row(Membrane_NS::Derivative::DU, k) * up[0][d] + row(Membrane_NS::Derivative::DV, k) * up[1][d]);
    if (!evflag) continue;
    const Vector3d &n = foot.normal;
    double v[6] = {kT * (1.0 - n[0] * n[0]), kT * (1.0 - n[1] * n[1]), kT * (1.0 - n[2] * n[2]),
                   -kT * n[0] * n[1], -kT * n[0] * n[2], -kT * n[1] * n[2]};
    int list = foot.atom;
    v_tally(1, &list, 1.0, v);
  }
  exchanged = work;
  comm->reverse_comm(this);
  for (int i = 0; i < atom->nlocal; ++i)
    for (int k = 0; k < 3; ++k) atom->f[i][k] += work[i][k];
}

Vector3d FixHDBound::place_of(const Foot &foot) const
{
  Vector3d sum = Vector3d::Zero();
  for (int k = foot.start; k < foot.start + foot.size; ++k) sum += weights[k] * Vector3d::Map(atom->x[points[k]]);
  return sum;
}

/* ----------------------------------------------------------------------
   dx = mu f dt + sqrt(2 kT mu dt) (xi_n + xi_n+1)/2, second order in dt for equilibrium
   [B. Leimkuhler and C. Matthews, Appl. Math. Res. Express 2013, 34]; mu = D/kT
------------------------------------------------------------------------- */

void FixHDBound::diffuse()
{
  const double dt = update->dt, mobility = diffusion / (force->boltz * temperature);
  const double noise = 0.5 * std::sqrt(2.0 * diffusion * dt);
  const CounterRandom now(seed, noise_steps), next(seed, noise_steps + 1);
  ++noise_steps;
  if (carried) comm->forward_comm();
  for (const Foot &foot : feet) {
    const int i = foot.atom;
    const Vector3d carry = carried ? Vector3d(place_of(foot) - foot.place) : Vector3d(Vector3d::Zero());
    const auto a = now.normals(atom->tag[i]), b = next.normals(atom->tag[i]);
    double *x = atom->x[i], *v = atom->v[i];
    for (int k = 0; k < 3; ++k) {
      const double step = carry[k] + mobility * dt * atom->f[i][k] + noise * (a[k] + b[k]);
      x[k] += step;
      v[k] = step / dt;
    }
  }
}
