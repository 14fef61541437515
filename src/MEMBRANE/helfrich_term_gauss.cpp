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

#include "helfrich_term.h"

#include "atom.h"

using namespace LAMMPS_NS;
using Membrane_NS::FaceGroup;
using Membrane_NS::FaceModel;

namespace {

struct Coefficients {
  double modulus = 0.0;

  bool active() const { return modulus != 0.0; }
  void archive(RestartArchive &file) { file(modulus); }
};

/// kg K per area
class GaussTerm : public TermWith<Coefficients> {
 public:
  explicit GaussTerm(LAMMPS *lmp) : TermWith(lmp, "kg", HelfrichOutput::GAUSSIAN) {}

  Needs needs() const override
  {
    Needs needs;
    needs.gauss = true;
    return needs;
  }
  void localize(const std::vector<FaceGroup> &groups, FaceModel &model) override
  {
    add_corner_means(groups, atom->type, model.kg, [this](int type) { return by_type[type].modulus; });
  }
  void tally(const HelfrichScene &scene, HelfrichTally &tally) const override
  {
    for (const FaceGroup &group : scene.groups)
      for (int s = 0; s < group.nfaces; ++s)
        tally.add(group.first_slot + s, output, scene.energies.gauss[group.first_slot + s]);
  }

 protected:
  int read(const HelfrichWords &words, Coefficients &c) const override
  {
    c.modulus = words.number(1);
    return 2;
  }
};

}    // namespace

/* ---------------------------------------------------------------------- */

std::unique_ptr<HelfrichTerm> LAMMPS_NS::make_gauss_term(LAMMPS *lmp)
{
  return std::make_unique<GaussTerm>(lmp);
}
