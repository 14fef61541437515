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
  double tension = 0.0;

  bool active() const { return tension != 0.0; }
  void archive(RestartArchive &file) { file(tension); }
};

/// S per area
class TensionTerm : public TermWith<Coefficients> {
 public:
  explicit TensionTerm(LAMMPS *lmp) : TermWith(lmp, "tension", HelfrichOutput::AREA) {}

  void localize(const std::vector<FaceGroup> &groups, FaceModel &model) override
  {
    tension.assign(count_slots(groups), 0.0);
    add_corner_means(groups, atom->type, tension, [this](int type) { return by_type[type].tension; });
    model.tension = tension;
  }

  // terms of total area have set the model's tension anew

  void act_on_faces(HelfrichScene &scene) override
  {
    for (size_t slot = 0; slot < tension.size(); ++slot) scene.model.tension[slot] += tension[slot];
  }
  void tally(const HelfrichScene &scene, HelfrichTally &tally) const override
  {
    for (const FaceGroup &group : scene.groups)
      for (int s = 0; s < group.nfaces; ++s) {
        const int slot = group.first_slot + s;
        tally.add(slot, output, tension[slot] * scene.energies.area[slot]);
      }
  }

 protected:
  int read(const HelfrichWords &words, Coefficients &c) const override
  {
    c.tension = words.number(1);
    return 2;
  }

 private:
  std::vector<double> tension;    // by slot
};

}    // namespace

/* ---------------------------------------------------------------------- */

std::unique_ptr<HelfrichTerm> LAMMPS_NS::make_tension_term(LAMMPS *lmp)
{
  return std::make_unique<TensionTerm>(lmp);
}
