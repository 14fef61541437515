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

#include "membrane_mass_vertex.h"

#include "membrane_random.h"

#include <algorithm>

using namespace Membrane_NS;

/* ---------------------------------------------------------------------- */

VertexMass::VertexMass(const VertexMasses &vertices, const Settings &settings) :
    PointMasses(vertices), mask_(vertices.topology, part_, {settings.direct, settings.tolerance})
{
}

// noise this exact may travel along with a solution: other errors of a simulation are far larger
static constexpr double GOOD_NOISE = 1.0e-4;

// halo values of w are left to mask_

void VertexMass::to_points(const VertexField &v, VertexField &w)
{
  work_.resize(part_.size());
  std::copy_n(v.begin(), part_.owned, work_.begin());
  mask_.apply(work_, w);
}

/* ----------------------------------------------------------------------
   L^T D L v, with L^T x = (1/e) L (e x)
------------------------------------------------------------------------- */

void VertexMass::multiply(const VertexField &v, VertexField &p)
{
  scratch_.resize(part_.size());
  to_points(v, scratch_);
  for (int i = 0; i < part_.owned; ++i)
    for (int k = 0; k < 4; ++k) scratch_[i].c[k] *= mass_[i] * mask_.spoke(i);
  mask_.apply(scratch_, p);
  for (int i = 0; i < part_.owned; ++i)
    for (int k = 0; k < 4; ++k) p[i].c[k] /= mask_.spoke(i);
}

/* ----------------------------------------------------------------------
   L^-T p = (1/e) L^-1 (e p), then L^-1 D^-1
------------------------------------------------------------------------- */

void VertexMass::solve(const VertexField &p, VertexField &v)
{
  work_.resize(part_.size());
  for (int i = 0; i < part_.owned; ++i)
    for (int k = 0; k < 4; ++k) work_[i].c[k] = mask_.spoke(i) * p[i].c[k];
  mask_.solve(work_, v);
  for (int i = 0; i < part_.owned; ++i)
    for (int k = 0; k < 4; ++k) work_[i].c[k] = v[i].c[k] / (mask_.spoke(i) * mass_[i]);
  mask_.solve(work_, v);
  passes_ = 2 * mask_.passes();
}

/* ----------------------------------------------------------------------
   L^-1 D^-1/2 of normal numbers: x in the fourth number of the first solution, y and z in that of the second.
   Chebyshev's passes are a polynomial P of L, and in half of them |1 - L P| is below GOOD_NOISE, so what
   P D^-1 P^T has too much or too little is below twice as much
------------------------------------------------------------------------- */

void VertexMass::solve_with_noise(const VertexField &p, VertexField &v, uint64_t seed, uint64_t step,
                                  VertexField &z)
{
  if (mask_.is_direct() || mask_.tolerance_of_half() > GOOD_NOISE)
    return MassOperator::solve_with_noise(p, v, seed, step, z);
  const int n = part_.owned;
  work_.resize(part_.size());
  other_.resize(n);
  CounterRandom(seed, step).normals(label_, z);
  for (int i = 0; i < n; ++i) {
    quad(work_[i]) = mask_.spoke(i) * quad(p[i]);
    work_[i].c[3] = unit_speed_[i] * z[i].c[0];
  }
  mask_.solve(work_, v);
  for (int i = 0; i < n; ++i) {
    z[i].c[0] = v[i].c[3];
    quad(work_[i]) = quad(v[i]) / (mask_.spoke(i) * mass_[i]);
    work_[i].c[3] = unit_speed_[i] * z[i].c[1];
    other_[i] = unit_speed_[i] * z[i].c[2];
  }
  mask_.solve(work_, v, other_);
  for (int i = 0; i < n; ++i) {
    z[i].c[1] = other_[i];
    z[i].c[2] = v[i].c[3];
    v[i].c[3] = 0.0;
  }
  passes_ = 2 * mask_.passes();
}

double VertexMass::memory_usage() const
{
  return PointMasses::memory_usage() + mask_.memory_usage() +
      sizeof(Vector4) * (work_.capacity() + scratch_.capacity()) + sizeof(double) * other_.capacity();
}
