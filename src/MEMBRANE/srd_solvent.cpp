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
#include "error.h"
#include "force.h"
#include "group.h"
#include "membrane_srd.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

SRDSolvent::SRDSolvent(LAMMPS *lmp, int igroup) :
    Pointers(lmp), igroup(igroup), groupbit(group->bitmask[igroup])
{
}

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

void SRDSolvent::check(int membrane_bit) const
{
  if (total() == 0)
    error->all(FLERR,
               "Fix srd/mesh: there is no solvent in group {}: use create_atoms or create_solvent",
               group->names[igroup]);
  tagint bad[2] = {0, 0}, any[2];    // no mass, in both groups
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!has(i)) continue;
    if (!(mass()[i] > 0.0)) bad[0] = MAX(bad[0], atom->tag[i]);
    if (atom->mask[i] & membrane_bit) bad[1] = MAX(bad[1], atom->tag[i]);
  }
  MPI_Allreduce(bad, any, 2, MPI_LMP_TAGINT, MPI_MAX, world);
  if (any[0]) error->all(FLERR, "Fix srd/mesh: solvent atom {} has no positive mass", any[0]);
  if (any[1])
    error->all(FLERR, "Fix srd/mesh: atom {} is both solvent and in the group of membranes",
               any[1]);
}

/* ----------------------------------------------------------------------
   Maxwell's distribution less its momentum, then scaled to the temperature
------------------------------------------------------------------------- */

void SRDSolvent::draw_velocities(uint64_t seed, bigint step, double kT) const
{
  double **v = atom->v;
  for (int i = begin; i < end; ++i)
    if (has(i)) Membrane_NS::thermal_velocity(seed, step, atom->tag[i], kT, masses[i], v[i]);
  double p[4];
  momentum(p);
  double mine = 0.0, twice_energy;
  for (int i = begin; i < end; ++i) {
    if (!has(i)) continue;
    for (int k = 0; k < 3; ++k) {
      v[i][k] -= p[k] / p[3];
      mine += masses[i] * v[i][k] * v[i][k];
    }
  }
  MPI_Allreduce(&mine, &twice_energy, 1, MPI_DOUBLE, MPI_SUM, world);
  const bigint count_all = total();
  if (count_all < 2) return;
  const double scale = std::sqrt(3.0 * (count_all - 1) * kT / twice_energy);
  for (int i = begin; i < end; ++i)
    if (has(i))
      for (int k = 0; k < 3; ++k) v[i][k] *= scale;
}

double SRDSolvent::kick(double time) const
{
  const double factor = time * force->ftm2v;
  double most = 0.0;
  for (int i = begin; i < end; ++i) {
    if (!has(i)) continue;
    const double scale = factor / masses[i];
    double squared = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double change = scale * atom->f[i][k];
      atom->v[i][k] += change;
      squared += change * change;
    }
    most = MAX(most, squared);
  }
  return std::sqrt(most);
}

void SRDSolvent::zero_forces() const
{
  for (int i = begin; i < end; ++i)
    if (has(i)) std::fill_n(atom->f[i], 3, 0.0);
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
