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

#include "membrane_mass_lumped.h"

#include <algorithm>

using namespace Membrane_NS;

/* ---------------------------------------------------------------------- */

void LumpedMass::multiply(const VertexField &v, VertexField &p)
{
  for (int i = 0; i < part_.owned; ++i)
    for (int k = 0; k < 4; ++k) p[i].c[k] = mass_[i] * v[i].c[k];
}

void LumpedMass::solve(const VertexField &p, VertexField &v)
{
  for (int i = 0; i < part_.owned; ++i)
    for (int k = 0; k < 4; ++k) v[i].c[k] = p[i].c[k] / mass_[i];
  passes_ = 1;
}

void LumpedMass::copy(const VertexField &from, VertexField &to) const
{
  to.resize(part_.size());
  std::copy_n(from.begin(), part_.owned, to.begin());
}
