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

#include "membrane_mass.h"

#include <cmath>
#include <stdexcept>

using namespace Membrane_NS;

/* ---------------------------------------------------------------------- */

std::array<double, 6> MassOperator::kinetic(const VertexField &v)
{
  momentum_.resize(part_.size());
  multiply(v, momentum_);
  std::array<double, 6> sums = {};
  for (int i = 0; i < part_.owned; ++i) {
    const double *a = v[i].c, *b = momentum_[i].c;
    sums[0] += a[0] * b[0];
    sums[1] += a[1] * b[1];
    sums[2] += a[2] * b[2];
    sums[3] += a[0] * b[1];
    sums[4] += a[0] * b[2];
    sums[5] += a[1] * b[2];
  }
  part_.sum(sums.data(), 6);
  return sums;
}

/* ---------------------------------------------------------------------- */

void MassOperator::solve_with_noise(const VertexField &p, VertexField &v, uint64_t seed, uint64_t step,
                                    VertexField &z)
{
  sample(1.0, seed, step, z);
  solve(p, v);    // last, so that passes() are its own
}

void MassOperator::relax(const std::vector<double> &, double, uint64_t, uint64_t, VertexField &)
{
  throw std::logic_error("this mass has no friction per vertex");
}

void MassOperator::relax_own(double, double, uint64_t, uint64_t, VertexField &)
{
  throw std::logic_error("this mass has no friction of its own");
}

/* ---------------------------------------------------------------------- */

double MassOperator::residual(const VertexField &p, const VertexField &v)
{
  VertexField product(part_.size());
  multiply(v, product);
  double sums[2] = {0.0, 0.0};
  for (int i = 0; i < part_.owned; ++i)
    for (int k = 0; k < 3; ++k) {
      const double d = p[i].c[k] - product[i].c[k];
      sums[0] += d * d;
      sums[1] += p[i].c[k] * p[i].c[k];
    }
  part_.sum(sums, 2);
  return sums[1] > 0.0 ? std::sqrt(sums[0] / sums[1]) : std::sqrt(sums[0]);
}

double MassOperator::memory_usage() const
{
  return sizeof(Vector4) * momentum_.capacity();
}
