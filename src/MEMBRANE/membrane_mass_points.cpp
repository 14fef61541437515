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
    unit_speed_.push_back(1.0 / std::sqrt(mass_.back()));
    label_.push_back(vertices.labels[part_.vertices[i]]);
  }
}

void PointMasses::sample(double kT, uint64_t seed, uint64_t step, VertexField &v)
{
  const double root = std::sqrt(kT);
  w_.resize(part_.size());
  CounterRandom(seed, step).normals(label_, w_);
  for (int i = 0; i < part_.owned; ++i) {
    quad(w_[i]) *= root * unit_speed_[i];
    w_[i].c[3] = 0.0;
  }
  from_points(w_, v);
}

void PointMasses::relax(const std::vector<double> &keep, double kT, uint64_t seed, uint64_t step,
                        VertexField &v)
{
  w_.resize(part_.size());
  noise_.resize(part_.size());
  CounterRandom(seed, step).normals(label_, noise_);
  to_points(v, w_);
  for (int i = 0; i < part_.owned; ++i) {
    const double spread = std::sqrt((1.0 - keep[i] * keep[i]) * kT) * unit_speed_[i];
    for (int k = 0; k < 3; ++k) w_[i].c[k] = keep[i] * w_[i].c[k] + spread * noise_[i].c[k];
  }
  from_points(w_, v);
}

double PointMasses::memory_usage() const
{
  return MassOperator::memory_usage() + sizeof(double) * (mass_.capacity() + unit_speed_.capacity()) +
      sizeof(uint64_t) * label_.capacity() + sizeof(Vector4) * (w_.capacity() + noise_.capacity());
}
