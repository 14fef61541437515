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

#include <algorithm>

using namespace Membrane_NS;

/* ---------------------------------------------------------------------- */

VertexMass::VertexMass(const VertexMasses &vertices, const Settings &settings) :
    PointMasses(vertices), mask_(vertices.topology, part_, {settings.direct, settings.tolerance})
{
}

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

double VertexMass::memory_usage() const
{
  return PointMasses::memory_usage() + mask_.memory_usage() +
      sizeof(Vector4) * (work_.capacity() + scratch_.capacity());
}
