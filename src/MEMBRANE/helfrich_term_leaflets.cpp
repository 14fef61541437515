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

using namespace LAMMPS_NS;
using Membrane_NS::FaceGroup;
using Membrane_NS::FaceModel;

namespace {

struct Coefficients {
  double distance = 0.0;

  bool active() const { return distance > 0.0; }
  void archive(RestartArchive &file) { file(distance); }
};

/// Monolayers at a distance to both sides, each with half of kc: the energy that stands in place of bending and
/// counts as such, see doc/src/Derivation_leaflets.rst.
class LeafletsTerm : public TermWith<Coefficients> {
 public:
  explicit LeafletsTerm(LAMMPS *lmp) : TermWith(lmp, "leaflets", HelfrichOutput::BENDING) {}

  // after bending, whose c0 the outer leaflet has, and the inner one the opposite

  void localize(const std::vector<FaceGroup> &groups, FaceModel &model) override
  {
    model.leaflet.assign(count_slots(groups), 0.0);
    add_corner_means(groups, atom->type, model.leaflet, [this](int type) { return by_type[type].distance; });
    model.outer = model.inner = model.c0;
    for (double &curvature : model.inner) curvature = -curvature;
  }

  // single points may be curved more, as those next to control points of irregular valence

  void add_forces(HelfrichScene &scene, const double (*x)[3], double (*)[3]) override
  {
    for (const FaceGroup &group : scene.groups)
      for (int s = 0; s < group.nfaces; ++s) {
        const int slot = group.first_slot + s;
        if (scene.energies.leaflet_bend[slot] <= Membrane_NS::LEAFLETS_EXACT) continue;
        const double *corner = x[group.point(s, 0)];
        error->one(FLERR,
                   "pair_coeff helfrich leaflets {:.6g}: {} at {:.6g} {:.6g} {:.6g} is curved with a radius near "
                   "this distance or below: use a smaller one, or a smoother or finer mesh",
                   scene.model.leaflet[slot], scene.mesh->face_name(group.face[s]), corner[0],
                   corner[1], corner[2]);
      }
  }

 protected:
  int read(const HelfrichWords &words, Coefficients &c) const override
  {
    c.distance = words.number(1);
    if (!(c.distance > 0.0))
      error->all(FLERR, "pair_coeff helfrich leaflets {}: the distance from the mid-plane must be positive",
                 words.word(1));
    return 2;
  }
};

}    // namespace

/* ---------------------------------------------------------------------- */

std::unique_ptr<HelfrichTerm> LAMMPS_NS::make_leaflets_term(LAMMPS *lmp)
{
  return std::make_unique<LeafletsTerm>(lmp);
}
