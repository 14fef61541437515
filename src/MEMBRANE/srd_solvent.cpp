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

#include "srd_solvent.h"

#include "atom.h"
#include "group.h"

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

SRDSolvent::SRDSolvent(LAMMPS *lmp, int igroup) : Pointers(lmp), groupbit(group->bitmask[igroup]) {}

/* ----------------------------------------------------------------------
   LAMMPS keeps the atoms of its first group in front, so solvent is often one range
------------------------------------------------------------------------- */

void SRDSolvent::refresh()
{
  mask = atom->mask;
  begin = end = mine = 0;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!has(i)) continue;
    if (mine++ == 0) begin = i;
    end = i + 1;
  }
  masses = atom->rmass;
  if (masses) return;
  by_type.resize(atom->nlocal);
  for (int i = 0; i < atom->nlocal; ++i) by_type[i] = atom->mass[atom->type[i]];
  masses = by_type.data();
}

/* ---------------------------------------------------------------------- */

bigint SRDSolvent::total() const
{
  bigint n = mine, all;
  MPI_Allreduce(&n, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  return all;
}

void SRDSolvent::momentum(double *p) const
{
  double sum[4] = {0.0, 0.0, 0.0, 0.0};
  for (int i = begin; i < end; ++i) {
    if (!has(i)) continue;
    for (int k = 0; k < 3; ++k) sum[k] += masses[i] * atom->v[i][k];
    sum[3] += masses[i];
  }
  MPI_Allreduce(sum, p, 4, MPI_DOUBLE, MPI_SUM, world);
}
