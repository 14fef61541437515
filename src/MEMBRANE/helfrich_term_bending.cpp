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

#include "helfrich_term_bending.h"

#include "atom.h"
#include "error.h"

using namespace LAMMPS_NS;
using Membrane_NS::FaceGroup;
using Membrane_NS::FaceModel;

/* ---------------------------------------------------------------------- */

HelfrichTermBending::HelfrichTermBending(LAMMPS *lmp) :
    TermWith(lmp, "bending", HelfrichOutput::BENDING)
{
}

// no keyword: kc is the first word

int HelfrichTermBending::read(const HelfrichWords &words, BendingCoefficients &c) const
{
  c.kc = utils::numeric(FLERR, words.keyword(), false, lmp);
  c.c0 = words.number(1);
  c.set = true;
  if (c.kc < 0.0)
    error->all(FLERR, "pair_coeff helfrich bending modulus {} is negative", words.keyword());
  return 2;
}

void HelfrichTermBending::localize(const std::vector<FaceGroup> &groups, FaceModel &model)
{
  add_corner_means(groups, atom->type, model.kc, [this](int type) { return by_type[type].kc; });
  add_corner_means(groups, atom->type, model.c0, [this](int type) { return by_type[type].c0; });
}

void HelfrichTermBending::tally(const HelfrichScene &scene, HelfrichTally &tally) const
{
  for (const FaceGroup &group : scene.groups)
    for (int s = 0; s < group.nfaces; ++s)
      tally.add(group.first_slot + s, output, scene.energies.bending[group.first_slot + s]);
}

std::vector<double> HelfrichTermBending::moduli() const
{
  std::vector<double> kc;
  for (const BendingCoefficients &c : by_type) kc.push_back(c.kc);
  return kc;
}
