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

#include "srd_force_styles.h"

#include "atom.h"
#include "force.h"
#include "lammps.h"
#include "pair.h"

#include <cstring>
#include <vector>

using namespace LAMMPS_NS;

// types that some pair force acts on

static std::vector<char> types_with_pairs(const LAMMPS *lmp)
{
  const int ntypes = lmp->atom->ntypes;
  std::vector<char> acts(ntypes + 1, 0);
  const Pair *pair = lmp->force->pair;
  if (!pair || !pair->cutsq) return acts;
  for (int t = 1; t <= ntypes; ++t)
    for (int other = 1; other <= ntypes; ++other)
      if (pair->cutsq[t][other] > 0.0) acts[t] = 1;
  return acts;
}

static bool exists(const void *style, const char *name)
{
  if (!style || !name) return false;
  for (const char *without_force : {"none", "zero", "membrane"})
    if (strcmp(name, without_force) == 0) return false;
  return true;
}

// special neighbors know a bond on both sides; three- and four-body terms without bonds, on one

static bool is_in_molecule(const Atom &atom, int i)
{
  if (atom.molecular == Atom::TEMPLATE) return atom.molindex[i] >= 0;
  if (atom.nspecial && atom.nspecial[i][2] > 0) return true;
  for (const int *count : {atom.num_bond, atom.num_angle, atom.num_dihedral, atom.num_improper})
    if (count && count[i] > 0) return true;
  return false;
}

bool LAMMPS_NS::feel_force_styles(LAMMPS *lmp, int groupbit)
{
  const Atom &atom = *lmp->atom;
  const Force &force = *lmp->force;
  const std::vector<char> paired = types_with_pairs(lmp);
  const bool bonded = atom.molecular != Atom::ATOMIC &&
      (exists(force.bond, force.bond_style) || exists(force.angle, force.angle_style) ||
       exists(force.dihedral, force.dihedral_style) || exists(force.improper, force.improper_style));
  const bool charged = force.kspace && atom.q;
  int mine = 0, any;
  for (int i = 0; i < atom.nlocal && !mine; ++i)
    if (atom.mask[i] & groupbit)
      mine = paired[atom.type[i]] || (charged && atom.q[i] != 0.0) ||
          (bonded && is_in_molecule(atom, i));
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, lmp->world);
  return any;
}
