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
#include "error.h"
#include "fix.h"
#include "membrane_regularization.h"
#include "modify.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;
using Membrane_NS::FaceGroup;
using Membrane_NS::FaceModel;

// a face whose D/A is beyond this is about to turn over
static constexpr double WORST_FACE = 50.0;

namespace {

struct Coefficients {
  double modulus = 0.0;
  bool given = false;    // else the default of the fixes holds

  bool active() const { return modulus != 0.0; }
  void archive(RestartArchive &file)
  {
    file(modulus);
    file(given);
  }
};

/** KR (D/A - 1) of each face of the control mesh, see regularize_faces(). Fixes that shake control
    points may ask for a modulus where pair_coeff has none, by Fix::extract("default_regularize"). */
class RegularizeTerm : public TermWith<Coefficients> {
 public:
  explicit RegularizeTerm(LAMMPS *lmp) :
      TermWith(lmp, "regularize", HelfrichOutput::REGULARIZATION)
  {
  }

  bool acts_on(int type) const override { return modulus_of(type) != 0.0; }
  void choose(const HelfrichScene &) override;
  void localize(const std::vector<FaceGroup> &, FaceModel &) override;
  void add_forces(HelfrichScene &, const double (*)[3], double (*)[3]) override;
  void tally(const HelfrichScene &, HelfrichTally &) const override;
  void add_stiffness(const HelfrichScene &, HelfrichStiffness &stiffness) override
  {
    for (size_t slot = 0; slot < modulus.size(); ++slot) stiffness.shear[slot] += modulus[slot];
  }

 protected:
  int read(const HelfrichWords &words, Coefficients &c) const override
  {
    c.modulus = words.modulus(1);
    c.given = true;
    return 2;
  }

 private:
  double unless_given = 0.0;
  std::vector<double> modulus, energy;    // by slot; energies only if the scene has any

  double modulus_of(int type) const
  {
    return by_type[type].given ? by_type[type].modulus : unless_given;
  }
};

/* ---------------------------------------------------------------------- */

void RegularizeTerm::choose(const HelfrichScene &)
{
  unless_given = 0.0;
  for (auto &fix : modify->get_fix_list()) {
    int dim;
    if (const void *wanted = fix->extract("default_regularize", dim))
      unless_given = MAX(unless_given, *static_cast<const double *>(wanted));
  }
}

void RegularizeTerm::localize(const std::vector<FaceGroup> &groups, FaceModel &)
{
  modulus.assign(count_slots(groups), 0.0);
  add_corner_means(groups, atom->type, modulus, [this](int type) { return modulus_of(type); });
}

/* ----------------------------------------------------------------------
   stops before a face collapses
------------------------------------------------------------------------- */

void RegularizeTerm::add_forces(HelfrichScene &scene, const double (*x)[3], double (*f)[3])
{
  energy.assign(scene.energies.area.size(), 0.0);
  for (const FaceGroup &group : scene.groups) {
    const double worst = Membrane_NS::regularize_faces(group, x, modulus, f, energy,
                                                       scene.energies.virial);
    if (worst < WORST_FACE || (update->whichflag == 2 && std::isfinite(worst))) continue;
    for (int s = 0; s < group.nfaces; ++s)
      if (!(Membrane_NS::face_distortion(x[group.point(s, 0)], x[group.point(s, 1)],
                                         x[group.point(s, 2)]) < WORST_FACE))
        error->one(FLERR,
                   "Membrane mesh: {} is about to collapse; use a larger regularize modulus in "
                   "pair_coeff or a smaller timestep",
                   scene.mesh->face_name(group.face[s]));
  }
}

void RegularizeTerm::tally(const HelfrichScene &scene, HelfrichTally &tally) const
{
  for (const FaceGroup &group : scene.groups)
    for (int s = 0; s < group.nfaces; ++s)
      tally.add(group.first_slot + s, output, energy[group.first_slot + s]);
}

}    // namespace

/* ---------------------------------------------------------------------- */

std::unique_ptr<HelfrichTerm> LAMMPS_NS::make_regularize_term(LAMMPS *lmp)
{
  return std::make_unique<RegularizeTerm>(lmp);
}
