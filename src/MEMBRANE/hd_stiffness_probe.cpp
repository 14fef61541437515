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

#include "hd_stiffness_probe.h"

#include "angle.h"
#include "atom.h"
#include "bond.h"
#include "comm.h"
#include "dihedral.h"
#include "domain.h"
#include "force.h"
#include "improper.h"
#include "kspace.h"
#include "neighbor.h"
#include "pair.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using Membrane_NS::Vector4;
using Membrane_NS::VertexField;

// furthest displacement of a difference, in edges: rounding over it and its square are both 1e-10
static constexpr double DISPLACEMENT = 1.0e-5;

// the start vector is always the same one
static constexpr uint64_t SEED = 20250204;

/* ---------------------------------------------------------------------- */

void StiffnessProbe::place_atoms(LAMMPS *lmp)
{
  lmp->init();
  Atom *atom = lmp->atom;
  Comm *comm = lmp->comm;
  Domain *domain = lmp->domain;
  Neighbor *neighbor = lmp->neighbor;
  atom->setup();
  if (domain->triclinic) domain->x2lamda(atom->nlocal);
  domain->pbc();
  domain->reset_box();
  comm->setup();
  if (neighbor->style) neighbor->setup_bins();
  comm->exchange();
  if (atom->sortfreq > 0) atom->sort();
  comm->borders();
  if (domain->triclinic) domain->lamda2x(atom->nlocal + atom->nghost);
  neighbor->build(1);
  lmp->force->setup();
  if (lmp->force->kspace) lmp->force->kspace->setup();
}

/* ---------------------------------------------------------------------- */

StiffnessProbe::StiffnessProbe(LAMMPS *lmp, HDMass &mass, Forces which) :
    Pointers(lmp), mass(mass), which(which), helfrich(force->pair_match("helfrich", 1, 1))
{
  mass.refresh();
  x_before.resize(atom->nlocal);
  f_before.resize(atom->nlocal);
  for (int i = 0; i < atom->nlocal; ++i) {
    std::copy_n(atom->x[i], 3, x_before[i].data());
    std::copy_n(atom->f[i], 3, f_before[i].data());
  }
}

bool StiffnessProbe::has_forces() const
{
  return which == Forces::MEMBRANE ? helfrich != nullptr : force->pair != nullptr;
}

// pair styles may remember where they were last, so that has to be the same as before, too

void StiffnessProbe::restore()
{
  for (int i = 0; i < atom->nlocal; ++i) std::copy_n(x_before[i].data(), 3, atom->x[i]);
  evaluate(false);
  for (int i = 0; i < atom->nlocal; ++i) std::copy_n(f_before[i].data(), 3, atom->f[i]);
}

/* ----------------------------------------------------------------------
   what Verlet::run() does between its two halves, without fixes
------------------------------------------------------------------------- */

double StiffnessProbe::evaluate(bool energy)
{
  comm->forward_comm();
  const int nall = atom->nlocal + atom->nghost;
  if (nall) memset(atom->f[0], 0, sizeof(double) * 3 * nall);
  const int eflag = energy ? ENERGY_GLOBAL : 0;

  double mine = 0.0, shared = 0.0;
  if (which == Forces::MEMBRANE) {
    helfrich->compute(eflag, 0);
    mine = helfrich->eng_vdwl;
  } else {
    if (force->pair && force->pair->compute_flag) {
      force->pair->compute(eflag, 0);
      mine += force->pair->eng_vdwl + force->pair->eng_coul;
    }
    auto add = [&](auto *style) {
      if (!style) return;
      style->compute(eflag, 0);
      mine += style->energy;
    };
    if (atom->molecular != Atom::ATOMIC) {
      add(force->bond);
      add(force->angle);
      add(force->dihedral);
      add(force->improper);
    }
    if (force->kspace && force->kspace->compute_flag) {
      force->kspace->compute(eflag, 0);
      shared = force->kspace->energy;
    }
  }
  if (force->newton) comm->reverse_comm();
  if (!energy) return 0.0;
  double sum;
  MPI_Allreduce(&mine, &sum, 1, MPI_DOUBLE, MPI_SUM, world);
  return sum + shared;
}

/* ---------------------------------------------------------------------- */

double StiffnessProbe::dot(const VertexField &a, const VertexField &b)
{
  double sum = 0.0;
  for (int i = 0; i < mass.part().owned; ++i)
    for (int k = 0; k < 3; ++k) sum += a[i].c[k] * b[i].c[k];
  mass.part().sum(&sum, 1);
  return sum;
}

void StiffnessProbe::displace(const VertexField &v, double step)
{
  const MeshPart &part = mass.part();
  for (int i = 0; i < part.owned; ++i) {
    const int j = part.atom_of(i);
    for (int k = 0; k < 3; ++k) atom->x[j][k] = x_before[j][k] + step * v[i].c[k];
  }
}

// product = -ftm2v (f(x + step v) - f(x - step v)) / (2 step)

void StiffnessProbe::multiply(const VertexField &v, VertexField &product)
{
  const MeshPart &part = mass.part();
  double mine = 0.0, most;
  for (int i = 0; i < part.owned; ++i)
    for (int k = 0; k < 3; ++k) mine = std::max(mine, std::fabs(v[i].c[k]));
  MPI_Allreduce(&mine, &most, 1, MPI_DOUBLE, MPI_MAX, world);
  const double step = DISPLACEMENT * mass.mesh().longest_edge() / most;

  displace(v, -step);
  evaluate(false);
  part.load(atom->f, product);
  displace(v, step);
  evaluate(false);
  const double scale = 0.5 * force->ftm2v / step;
  for (int i = 0; i < part.owned; ++i)
    for (int k = 0; k < 3; ++k)
      product[i].c[k] = scale * (product[i].c[k] - atom->f[part.atom_of(i)][k]);
}

double StiffnessProbe::quotient(const VertexField &v)
{
  VertexField stiff, heavy(v.size());
  multiply(v, stiff);
  mass.matrix().multiply(v, heavy);
  return dot(v, stiff) / dot(v, heavy);
}

/* ----------------------------------------------------------------------
   Lanczos' method for M^-1 K, which is symmetric in the inner product of M, from a vector in which
   all modes have the same weight; with p = M v there is one solution with M a step. The largest
   Ritz value does not suffer from the loss of orthogonality.
------------------------------------------------------------------------- */

StiffnessProbe::Eigenvalue StiffnessProbe::largest(int most_steps, double tolerance)
{
  const size_t size = mass.part().size();
  VertexField v(size), p(size), p_last(size), stiff(size), u(size);
  mass.matrix().sample(1.0, SEED, 0, v);
  mass.matrix().multiply(v, p);
  double beta = std::sqrt(dot(v, p));

  std::vector<double> diagonal, beside;
  Eigenvalue result = {0.0, 0.0, 0};
  while ((int) diagonal.size() < most_steps) {
    for (size_t i = 0; i < size; ++i)
      for (int k = 0; k < 3; ++k) {
        v[i].c[k] /= beta;
        p[i].c[k] /= beta;
      }
    multiply(v, stiff);
    result.evaluations += 2;
    const double alpha = dot(v, stiff), before = beside.empty() ? 0.0 : beside.back();
    diagonal.push_back(alpha);
    for (size_t i = 0; i < size; ++i)
      for (int k = 0; k < 3; ++k) stiff[i].c[k] -= alpha * p[i].c[k] + before * p_last[i].c[k];
    mass.matrix().solve(stiff, u);
    beta = std::sqrt(std::max(0.0, dot(u, stiff)));

    const Eigen::Index n = diagonal.size();
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
    ritz.computeFromTridiagonal(Eigen::Map<Eigen::VectorXd>(diagonal.data(), n),
                                Eigen::Map<Eigen::VectorXd>(beside.data(), n - 1));
    result.value = ritz.eigenvalues()[n - 1];
    result.uncertainty = beta * std::fabs(ritz.eigenvectors()(n - 1, n - 1));
    if (result.uncertainty <= tolerance * std::fabs(result.value)) break;

    beside.push_back(beta);
    std::swap(p_last, p);
    std::swap(p, stiff);
    std::swap(v, u);
  }
  return result;
}
