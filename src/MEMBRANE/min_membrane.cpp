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
#include "modify.h"
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
static constexpr double MOST_MOVE = 0.5;      // of a control point in one, by the mean edge
static constexpr double PLAIN_DMAX = 0.1;     // LAMMPS' default, for other atoms
static constexpr double OUTDATED = 1.25;      // an edge so much longer or shorter than in the metric
static constexpr int METRIC_STAYS = 10;       // iterations at least
static constexpr double POOR_ANGLE = 2.0;     // degrees

/* ---------------------------------------------------------------------- */

MinMembrane::MinMembrane(LAMMPS *lmp) :
    MinLineSearch(lmp), mesh(lmp, "Min style membrane"), angle_at_start(0.0), s{}, y{}, rho{},
    pairs(0), newest(0)
{
  dmax = 0.0;    // not given; min_modify comes later
}

void MinMembrane::init()
{
  MinLineSearch::init();
  mesh.require();
}

void MinMembrane::setup_style()
{
  MinLineSearch::setup_style();
  if (nextra_global || nextra_atom)
    error->all(FLERR, "Min style membrane moves atoms only: use another min_style with fix "
                      "box/relax and with pair styles that have extra degrees of freedom");
  for (const char *style : {"^lineforce", "^planeforce"})
    for (auto &fix : modify->get_fix_by_style(style))
      if (comm->me == 0)
        error->warning(FLERR, "Min style membrane keeps lines and planes that are parallel to axes, and others not: use "
                              "min_style cg where fix {} ({}) has another", fix->id, fix->style);
  for (int i = 0; i < 2 * MEMORY; ++i) fix_minimize->add_vector(3);
  mesh.init();
  shape = mesh->triangle_mesh();
  edges.clear();
  for (const auto &face : mesh->topology().faces())
    for (int k = 0; k < 3; ++k)
      if (const int a = face[k], b = face[(k + 1) % 3]; a < b) edges.push_back({a, b});
  measure_edges();
  find_moduli();
  build_metric();
  int face;
  angle_at_start = smallest_angle(face);
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

// bending moduli of the control points, from the pair style

void MinMembrane::find_moduli()
{
  const int n = mesh->topology().num_vertices();
  if (n == 0) error->all(FLERR, "Min style membrane finds no membrane");
  Pair *pair = force->pair_match("^helfrich", 0);
  int dim;
  const auto *modulus = pair ? static_cast<double *>(pair->extract("kc", dim)) : nullptr;
  if (!modulus) error->all(FLERR, "Min style membrane needs pair style helfrich");
  Eigen::VectorXd mine = Eigen::VectorXd::Zero(n);
  moduli.resize(n);
  for (int i = 0; i < atom->nlocal; ++i)
    if (const int v = mesh->vertex(atom->tag[i]); v >= 0) mine[v] = modulus[atom->type[i]];
  MPI_Allreduce(mine.data(), moduli.data(), n, MPI_DOUBLE, MPI_SUM, world);
  const double most = moduli.maxCoeff();
  if (most <= 0.0) error->all(FLERR, "Min style membrane needs a membrane with bending modulus");
  moduli = moduli.cwiseMax(1.0e-3 * most);
}

// the metric of the present shape, and how far its points may move

void MinMembrane::build_metric()
{
  const auto &topology = mesh->topology();
  metric = std::make_unique<BendingMetric>(shape, topology, moduli);
  lengths_of_metric = lengths;
  farthest.assign(topology.num_components(), 0.0);
  std::vector<int> count(topology.num_components(), 0);
  for (size_t e = 0; e < edges.size(); ++e) {
    const int component = topology.component(edges[e][0]);
    farthest[component] += MOST_MOVE * lengths[e];
    ++count[component];
  }
  for (size_t c = 0; c < count.size(); ++c) farthest[c] /= count[c];
}

// control points slide far at little cost; then the metric is one of triangles that are no more

bool MinMembrane::metric_outdated() const
{
  const auto change = lengths.array() / lengths_of_metric.array();
  return change.maxCoeff() > OUTDATED || change.minCoeff() < 1.0 / OUTDATED;
}

// in degrees, and the face that has it

double MinMembrane::smallest_angle(int &sharp) const
{
  double angle = INFINITY;
  const auto &topology = mesh->topology();
  for (int f = 0; f < topology.num_faces(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto &face = topology.face(f);
      const Eigen::Vector3d a = shape.edge(face[k], face[(k + 1) % 3]),
                            b = shape.edge(face[k], face[(k + 2) % 3]);
      const double here = std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / M_PI;
      if (here >= angle) continue;
      angle = here;
      sharp = f;
    }
  return angle;
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

void MinMembrane::read_shape()
{
  const BendingMetric::Vectors x = gather(xvec);
  for (int v = 0; v < x.rows(); ++v) shape.points[v] = x.row(v).transpose();
  measure_edges();
}

void MinMembrane::measure_edges()
{
  lengths.resize(edges.size());
  for (size_t e = 0; e < edges.size(); ++e)
    lengths[e] = shape.edge(edges[e][0], edges[e][1]).norm();
}

void MinMembrane::precondition(double *f)
{
  const BendingMetric::Vectors solved = metric->solve(gather(f));
  for (const auto &[i, v] : mesh->owned_points())
    for (int k = 0; k < 3; ++k) f[3 * i + k] = solved(v, k);
}

/* ----------------------------------------------------------------------
   the longest step along h. No edge of the mesh may change by more than a fraction of its length.
   That does not bound what leaves edges as they are, as when a wall pulls on a membrane as a whole:
   no coordinate may change by more than dmax, if not given by half an edge, so that whatever the mesh
   can resolve is not jumped over
------------------------------------------------------------------------- */

double MinMembrane::longest_step()
{
  const BendingMetric::Vectors move = gather(h);
  double strain = 0.0;
  for (size_t e = 0; e < edges.size(); ++e)
    strain = MAX(strain, (move.row(edges[e][1]) - move.row(edges[e][0])).norm() / lengths[e]);

  double mine = 0.0, most;
  for (int i = 0; i < atom->nlocal; ++i) {
    const int v = mesh->vertex(atom->tag[i]);
    const double limit = dmax > 0.0 ? dmax
        : v < 0                     ? PLAIN_DMAX
                                    : farthest[mesh->topology().component(v)];
    for (int k = 0; k < 3; ++k) mine = MAX(mine, std::fabs(h[3 * i + k]) / limit);
  }
  MPI_Allreduce(&mine, &most, 1, MPI_DOUBLE, MPI_MAX, world);

  double step = 1.0;
  if (strain > 0.0) step = MIN(step, MOST_STRAIN / strain);
  if (most > 0.0) step = MIN(step, 1.0 / most);
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
  const int stop = descend(maxiter);
  report_mesh();
  return stop;
}

void MinMembrane::report_mesh()
{
  read_shape();
  int face = 0;
  const double angle = smallest_angle(face);
  if (angle < POOR_ANGLE && comm->me == 0)
    error->warning(FLERR,
                   "Min style membrane: the mesh is poor, {} has an angle of {:.2g} degrees "
                   "(smallest at the start: {:.2g}), so the energy falls slowly and may be above "
                   "that of the shape; keep the mesh with regularize in pair_coeff, 1e-4 of kc for "
                   "a start, or begin with a better one",
                   mesh->face_name(face), angle, angle_at_start);
}

int MinMembrane::descend(int maxiter)
{
  pairs = newest = 0;
  int small_gains = 0, metric_since = 0;
  for (int iter = 0; iter < maxiter; ++iter) {
    if (timer->check_timeout(niter)) return TIMEOUT;
    const bigint ntimestep = ++update->ntimestep;
    ++niter;

    read_shape();
    if (iter - metric_since >= METRIC_STAYS && metric_outdated()) {
      metric_since = iter;
      build_metric();
      pairs = 0;
    }
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
