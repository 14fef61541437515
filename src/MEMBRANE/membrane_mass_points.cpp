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

#include "membrane_mass_points.h"

#include "membrane_random.h"

#include <cmath>

using namespace Membrane_NS;

/* ---------------------------------------------------------------------- */

PointMasses::PointMasses(const VertexMasses &vertices) : MassOperator(vertices.part)
{
  for (int i = 0; i < part_.owned; ++i) {
    mass_.push_back(vertices.masses[part_.vertices[i]]);
    label_.push_back(vertices.labels[part_.vertices[i]]);
  }
}

void PointMasses::sample(double kT, uint64_t seed, uint64_t step, VertexField &v)
{
  const CounterRandom random(seed, step);
  const double root = std::sqrt(kT);
  w_.resize(part_.size());
  for (int i = 0; i < part_.owned; ++i) {
    const auto normal = random.normals(label_[i]);
    const double spread = root / std::sqrt(mass_[i]);
    for (int k = 0; k < 3; ++k) w_[i].c[k] = spread * normal[k];
    w_[i].c[3] = 0.0;
  }
  from_points(w_, v);
}

void PointMasses::relax(const std::vector<double> &keep, double kT, uint64_t seed, uint64_t step,
                        VertexField &v)
{
  const CounterRandom random(seed, step);
  w_.resize(part_.size());
  to_points(v, w_);
  for (int i = 0; i < part_.owned; ++i) {
    const auto normal = random.normals(label_[i]);
    const double spread = std::sqrt((1.0 - keep[i] * keep[i]) * kT / mass_[i]);
    for (int k = 0; k < 3; ++k) w_[i].c[k] = keep[i] * w_[i].c[k] + spread * normal[k];
  }
  from_points(w_, v);
}

double PointMasses::memory_usage() const
{
  return MassOperator::memory_usage() + sizeof(double) * mass_.capacity() +
      sizeof(uint64_t) * label_.capacity() + sizeof(Vector4) * w_.capacity();
}
