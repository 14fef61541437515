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

#include "min_membrane.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_minimize.h"
#include "force.h"
#include "output.h"
#include "pair.h"
#include "thermo.h"
#include "timer.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;
using Membrane_NS::BendingMetric;

static constexpr double EPS_ENERGY = 1.0e-8;
static constexpr int SMALL_GAINS = 9;         // in short steps, one after another, end the search
static constexpr int FULL_STEP = 3;           // as many as these counts a small gain in a full one
static constexpr double MOST_STRAIN = 0.3;    // of an edge, in one iteration

/* ---------------------------------------------------------------------- */

MinMembrane::MinMembrane(LAMMPS *lmp) :
    MinLineSearch(lmp), mesh(lmp, "Min style membrane"), s{}, y{}, rho{}, pairs(0), newest(0)
{
}

void MinMembrane::init()
{
  MinLineSearch::init();
  mesh.require();
  if (nextra_global || nextra_atom)
    error->all(FLERR, "Min style membrane moves atoms only: use another min_style with fix "
                      "box/relax and with pair styles that have extra degrees of freedom");
}

void MinMembrane::setup_style()
{
  MinLineSearch::setup_style();
  for (int i = 0; i < 2 * MEMORY; ++i) fix_minimize->add_vector(3);
  build_metric();
}

void MinMembrane::reset_vectors()
{
  MinLineSearch::reset_vectors();
  for (int i = 0; i < MEMORY; ++i) {
    s[i] = fix_minimize->request_vector(3 + 2 * i);
    y[i] = fix_minimize->request_vector(4 + 2 * i);
  }
}

/* ---------------------------------------------------------------------- */

void MinMembrane::build_metric()
{
  mesh.init();
  const auto &topology = mesh->topology();
  const int n = topology.num_vertices();
  if (n == 0) error->all(FLERR, "Min style membrane finds no membrane");

  shape = mesh->triangle_mesh();

  // bending moduli of the control points, from the pair style

  Pair *pair = force->pair_match("^helfrich", 0);
  int dim;
  const auto *modulus = pair ? static_cast<double *>(pair->extract("kc", dim)) : nullptr;
  if (!modulus) error->all(FLERR, "Min style membrane needs pair style helfrich");
  Eigen::VectorXd mine = Eigen::VectorXd::Zero(n), kc(n);
  for (int i = 0; i < atom->nlocal; ++i)
    if (const int v = mesh->vertex(atom->tag[i]); v >= 0) mine[v] = modulus[atom->type[i]];
  MPI_Allreduce(mine.data(), kc.data(), n, MPI_DOUBLE, MPI_SUM, world);
  const double most = kc.maxCoeff();
  if (most <= 0.0) error->all(FLERR, "Min style membrane needs a membrane with bending modulus");
  metric = std::make_unique<BendingMetric>(shape, topology, kc.cwiseMax(1.0e-3 * most));
}

/* ---------------------------------------------------------------------- */

double MinMembrane::dot(const double *a, const double *b) const
{
  double mine = 0.0, all;
  for (int i = 0; i < nvec; ++i) mine += a[i] * b[i];
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

// a vector per owned atom becomes one per vertex, on all ranks

BendingMetric::Vectors MinMembrane::gather(const double *f)
{
  const int n = mesh->topology().num_vertices();
  BendingMetric::Vectors mine = BendingMetric::Vectors::Zero(n, 3), all(n, 3);
  mesh->refresh();
  for (const auto &[i, v] : mesh->owned_points())
    for (int k = 0; k < 3; ++k) mine(v, k) = f[3 * i + k];
  MPI_Allreduce(mine.data(), all.data(), 3 * n, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

void MinMembrane::precondition(double *f)
{
  const BendingMetric::Vectors solved = metric->solve(gather(f));
  for (const auto &[i, v] : mesh->owned_points())
    for (int k = 0; k < 3; ++k) f[3 * i + k] = solved(v, k);
}

/* ----------------------------------------------------------------------
   the longest step along h: no edge of the mesh may change by more than a fraction of its length,
   however far the membrane moves as a whole; other atoms move by at most dmax
------------------------------------------------------------------------- */

double MinMembrane::longest_step()
{
  const auto &topology = mesh->topology();
  const BendingMetric::Vectors move = gather(h), x = gather(xvec);
  double strain = 0.0;
  for (const auto &face : topology.faces())
    for (int k = 0; k < 3; ++k) {
      const int a = face[k], b = face[(k + 1) % 3];
      if (a > b) continue;
      const Eigen::Vector3d edge = shape.nearest_image((x.row(b) - x.row(a)).transpose());
      strain = MAX(strain, (move.row(b) - move.row(a)).norm() / edge.norm());
    }

  double mine = 0.0, most;
  for (int i = 0; i < atom->nlocal; ++i)
    if (mesh->vertex(atom->tag[i]) < 0)
      for (int k = 0; k < 3; ++k) mine = MAX(mine, std::fabs(h[3 * i + k]));
  MPI_Allreduce(&mine, &most, 1, MPI_DOUBLE, MPI_MAX, world);

  double step = 1.0;
  if (strain > 0.0) step = MIN(step, MOST_STRAIN / strain);
  if (most > 0.0) step = MIN(step, dmax / most);
  return step;
}

/* ----------------------------------------------------------------------
   two-loop recursion [J. Nocedal, Math. Comp. 35, 773, 1980]
------------------------------------------------------------------------- */

void MinMembrane::direction()
{
  double a[MEMORY];
  for (int i = 0; i < nvec; ++i) h[i] = fvec[i];
  for (int j = 0; j < pairs; ++j) {
    const int i = (newest - j + MEMORY) % MEMORY;
    a[i] = rho[i] * dot(s[i], h);
    for (int k = 0; k < nvec; ++k) h[k] -= a[i] * y[i][k];
  }
  precondition(h);
  for (int j = pairs - 1; j >= 0; --j) {
    const int i = (newest - j + MEMORY) % MEMORY;
    const double b = rho[i] * dot(y[i], h);
    for (int k = 0; k < nvec; ++k) h[k] += (a[i] - b) * s[i][k];
  }

  // what fixes such as setforce hold has no force at all; it must not follow its neighbors

  for (int k = 0; k < nvec; ++k)
    if (fvec[k] == 0.0) h[k] = 0.0;
}

/* ---------------------------------------------------------------------- */

int MinMembrane::search(double &alpha)
{
  const double norm = output->thermo->normflag ? atom->natoms : 1.0;
  const double slope0 = -dot(fvec, h) / norm, e0 = ecurrent;
  if (slope0 >= 0.0) return DOWNHILL;

  fix_minimize->store_box();
  for (int i = 0; i < nvec; ++i) x0[i] = xvec[i];

  alpha = longest_step();
  for (int trial = 0; trial < 40; ++trial) {
    ecurrent = alpha_step(alpha, 1);
    const double slope = -dot(fvec, h) / norm;
    const double rounding = 1.0e-12 * std::fabs(e0);
    if (ecurrent <= e0 + 1.0e-4 * alpha * slope0) return 0;
    if (ecurrent <= e0 + rounding && std::fabs(slope) <= 0.9 * std::fabs(slope0)) return 0;

    // minimum of the parabola through both ends with the slope at the start, kept within bounds

    const double curvature = ecurrent - e0 - slope0 * alpha;
    double next = std::isfinite(curvature) && curvature > 0.0
        ? -0.5 * slope0 * alpha * alpha / curvature
        : 0.1 * alpha;
    alpha = MIN(MAX(next, 0.1 * alpha), 0.5 * alpha);
  }
  ecurrent = alpha_step(0.0, 0);
  return ZEROALPHA;
}

/* ---------------------------------------------------------------------- */

int MinMembrane::iterate(int maxiter)
{
  pairs = newest = 0;
  int small_gains = 0;
  for (int iter = 0; iter < maxiter; ++iter) {
    if (timer->check_timeout(niter)) return TIMEOUT;
    const bigint ntimestep = ++update->ntimestep;
    ++niter;

    direction();
    if (dot(fvec, h) <= 0.0) {
      pairs = 0;
      direction();
    }
    for (int i = 0; i < nvec; ++i) g[i] = fvec[i];

    eprevious = ecurrent;
    int fail = search(alpha_final);
    if (fail && pairs) {
      pairs = 0;
      direction();
      fail = search(alpha_final);
    }
    if (fail) return fail;

    // the pair of this step, if it shows positive curvature

    const int slot = (newest + 1) % MEMORY;
    for (int i = 0; i < nvec; ++i) {
      s[slot][i] = alpha_final * h[i];
      y[slot][i] = g[i] - fvec[i];
    }
    const double sy = dot(s[slot], y[slot]);
    if (sy > 1.0e-10 * std::sqrt(dot(s[slot], s[slot]) * dot(y[slot], y[slot]))) {
      rho[slot] = 1.0 / sy;
      newest = slot;
      pairs = MIN(pairs + 1, MEMORY);
    }

    if (neval >= update->max_eval) return MAXEVAL;

    // small gains in a row end the search: a few, or several if steps were short, which gain little
    // anywhere

    if (std::fabs(ecurrent - eprevious) <
        update->etol * 0.5 * (std::fabs(ecurrent) + std::fabs(eprevious) + EPS_ENERGY)) {
      small_gains += alpha_final >= 0.5 ? FULL_STEP : 1;
      if (small_gains >= SMALL_GAINS) return ETOL;
    } else
      small_gains = 0;
    if (update->ftol > 0.0) {
      const double fdotf = normstyle == MAX ? fnorm_max() : normstyle == INF ? fnorm_inf()
                                                                            : fnorm_sqr();
      if (fdotf < update->ftol * update->ftol) return FTOL;
    }

    if (output->next == ntimestep) {
      timer->stamp();
      output->write(ntimestep);
      timer->stamp(Timer::OUTPUT);
    }
  }
  return MAXITER;
}
