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
#include "force.h"
#include "group.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using Eigen::Vector3d;

// off the surface, in mean edges, and what Newton's method with one matrix may take for it
static constexpr double EXACT = 1.0e-12;
static constexpr int MOST_ROUNDS = 50;

// conjugate gradients for the multipliers
static constexpr double TOLERANCE = 1.0e-14;
static constexpr int MOST_PASSES = 500;

/* ----------------------------------------------------------------------
   RATTLE [H. C. Andersen, J. Comput. Phys. 52, 24 (1983)] for the constraints d(x_a, q) = z. With the
   gradients G of d by x and q, multipliers solve G (m^-1, M^-1) G^T y = r, where the matrix is 1/m + S
------------------------------------------------------------------------- */

double FixHDBound::dot(const std::vector<double> &a, const std::vector<double> &b) const
{
  double mine = 0.0, all;
  for (size_t i = 0; i < a.size(); ++i) mine += a[i] * b[i];
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

std::vector<double> FixHDBound::multipliers(const std::vector<double> &residual)
{
  std::vector<double> y(residual.size(), 0.0), r = residual, p = r, q;
  const double start = dot(r, r);
  double now = start;
  for (int pass = 0; now > TOLERANCE * TOLERANCE * start; ++pass) {
    if (pass == MOST_PASSES)
      error->all(FLERR, "Fix hd/bind hold rigid: constraints do not converge; are particles in the same place?");
    respond(p, q, false);
    const double step = now / dot(p, q);
    for (size_t a = 0; a < y.size(); ++a) {
      y[a] += step * p[a];
      r[a] -= step * q[a];
    }
    const double before = now;
    now = dot(r, r);
    for (size_t a = 0; a < y.size(); ++a) p[a] = r[a] + now / before * p[a];
  }
  return y;
}

/* ----------------------------------------------------------------------
   the impulses n y on particles and -c n y on control points: adds their changes of velocity, times
   `step`, to `by`, an array of x or v
------------------------------------------------------------------------- */

void FixHDBound::push(const std::vector<double> &y, double step, double **by)
{
  std::vector<double> unused;
  respond(y, unused, false);
  for (int i = 0; i < atom->nlocal; ++i)
    for (int k = 0; k < 3; ++k) by[i][k] -= step * answer[i][k];
  for (size_t a = 0; a < feet.size(); ++a)
    for (int k = 0; k < 3; ++k)
      by[feet[a].atom][k] += step * y[a] * feet[a].normal[k] / mass_of(feet[a].atom);
}

// along the normals of the step's beginning

void FixHDBound::constrain_positions()
{
  if (total == 0) return;
  const double dt = update->dt, exact = EXACT * limit->mean_edge();
  const FeetOfRank before = {feet, weights, points};
  for (const Foot &foot : feet) sites[foot.atom].pull = 0.0;
  for (int round = 0;; ++round) {
    comm->forward_comm();
    find_feet();
    double most;
    MPI_Allreduce(&farthest, &most, 1, MPI_DOUBLE, MPI_MAX, world);
    if (most <= exact) break;
    if (round == MOST_ROUNDS)
      error->all(FLERR, "Fix hd/bind hold rigid: particles do not come back to the surface: use a shorter timestep");
    std::vector<double> residual;
    for (const Foot &foot : feet)
      residual.push_back(height * sites[foot.atom].leaflet - sites[foot.atom].distance);
    const FeetOfRank now = {feet, weights, points};
    std::tie(feet, weights, points) = before;
    const auto y = multipliers(residual);
    for (size_t a = 0; a < feet.size(); ++a)
      sites[feet[a].atom].pull += 2.0 * y[a] / (dt * dt * force->ftm2v);
    push(y, 1.0, atom->x);
    push(y, 1.0 / dt, atom->v);
    std::tie(feet, weights, points) = now;
  }
}

void FixHDBound::constrain_velocities()
{
  if (total == 0) return;
  exchanged = atom->v;
  comm->forward_comm(this);
  std::vector<double> residual;
  for (const Foot &foot : feet) {
    Vector3d v = Vector3d::Map(atom->v[foot.atom]);
    for (int k = foot.start; k < foot.start + foot.size; ++k)
      v -= weights[k] * Vector3d::Map(atom->v[points[k]]);
    residual.push_back(-v.dot(foot.normal));
  }
  push(multipliers(residual), 1.0, atom->v);
}

// each rigid particle has two directions to go

bigint FixHDBound::dof(int igroup)
{
  if (!rigid) return 0;
  bigint mine = 0, all;
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit && atom->mask[i] & group->bitmask[igroup]) ++mine;
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  return all;
}
