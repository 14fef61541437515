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

#include <algorithm>
#include <map>

using namespace LAMMPS_NS;
using Membrane_NS::FaceGroup;
using Membrane_NS::FaceModel;

namespace {

struct Coefficients {
  double modulus = 0.0;

  bool active() const { return modulus != 0.0; }
  void archive(RestartArchive &file) { file(modulus); }
};

/** KL/2 (a - a0)^2/a0 for each face; a0 is its area at the first step. These references are kept by
    membrane, for its faces in the order of the mesh. */
class LocalAreaTerm : public TermWith<Coefficients> {
 public:
  explicit LocalAreaTerm(LAMMPS *lmp) : TermWith(lmp, "area/local", HelfrichOutput::AREA) {}

  bool of_whole_membrane() const override { return true; }
  bool same(int type, int other) const override
  {
    return by_type[type].modulus == by_type[other].modulus;
  }
  Needs needs() const override
  {
    Needs needs;
    needs.totals = true;
    return needs;
  }

  void drop_reference(tagint molecule) override { kept.erase(molecule); }
  void archive_references(RestartArchive &file) override { file(kept); }
  void choose(const HelfrichScene &scene) override;
  void localize(const std::vector<FaceGroup> &, FaceModel &) override;
  void take_references(HelfrichScene &) override;
  void act_on_faces(HelfrichScene &) override;
  void tally(const HelfrichScene &, HelfrichTally &) const override;

 protected:
  int read(const HelfrichWords &words, Coefficients &c) const override
  {
    c.modulus = words.modulus(1);
    return 2;
  }

 private:
  std::map<tagint, std::vector<double>> kept;    // by molecule ID
  std::vector<double> reference;                 // by face of the mesh; empty until it is taken
  std::vector<double> modulus;                   // by slot
};

/* ---------------------------------------------------------------------- */

void LocalAreaTerm::choose(const HelfrichScene &)
{
  reference.clear();
}

void LocalAreaTerm::localize(const std::vector<FaceGroup> &groups, FaceModel &)
{
  modulus.assign(count_slots(groups), 0.0);
  add_corner_means(groups, atom->type, modulus, [this](int type) { return by_type[type].modulus; });
}

/* ---------------------------------------------------------------------- */

void LocalAreaTerm::take_references(HelfrichScene &scene)
{
  if (!reference.empty()) return;
  const DistributedMesh &mesh = *scene.mesh;
  const auto &topology = mesh.topology();
  const int nfaces = topology.num_faces();

  std::vector<std::vector<int>> faces(scene.types.size());    // of each membrane that has the term
  for (int f = 0; f < nfaces; ++f) {
    const int m = mesh.membrane(topology.component(topology.face(f)[0]));
    if (!scene.excluded[m] && acts_on(scene.types[m].front())) faces[m].push_back(f);
  }
  bool missing = false;
  for (size_t m = 0; m < faces.size(); ++m)
    if (!faces[m].empty()) missing = missing || kept[mesh.molecules()[m]].size() != faces[m].size();

  reference.assign(nfaces, 0.0);
  if (missing) {
    std::vector<double> mine(nfaces, 0.0);
    for (const FaceGroup &group : scene.groups)
      for (int s = 0; s < group.nfaces; ++s)
        mine[group.face[s]] = scene.integrals.area[group.first_slot + s];
    MPI_Allreduce(mine.data(), reference.data(), nfaces, MPI_DOUBLE, MPI_SUM, world);
  }
  for (size_t m = 0; m < faces.size(); ++m) {
    if (faces[m].empty()) continue;
    std::vector<double> &areas = kept[mesh.molecules()[m]];
    if (areas.size() != faces[m].size()) {
      areas.clear();
      for (int f : faces[m]) areas.push_back(reference[f]);
    }
    for (size_t i = 0; i < areas.size(); ++i) reference[faces[m][i]] = areas[i];
  }
}

/* ---------------------------------------------------------------------- */

void LocalAreaTerm::act_on_faces(HelfrichScene &scene)
{
  for (const FaceGroup &group : scene.groups)
    for (int s = 0; s < group.nslots(); ++s) {
      const int slot = group.first_slot + s;
      if (modulus[slot] == 0.0) continue;
      const double a0 = reference[group.face[std::min(s, group.nfaces - 1)]];
      scene.model.tension[slot] += modulus[slot] * (scene.integrals.area[slot] - a0) / a0;
    }
}

void LocalAreaTerm::tally(const HelfrichScene &scene, HelfrichTally &tally) const
{
  for (const FaceGroup &group : scene.groups)
    for (int s = 0; s < group.nfaces; ++s) {
      const int slot = group.first_slot + s;
      if (modulus[slot] == 0.0) continue;
      const double a0 = reference[group.face[s]], excess = scene.energies.area[slot] - a0;
      tally.add(slot, output, 0.5 * modulus[slot] * excess * excess / a0);
    }
}

}    // namespace

/* ---------------------------------------------------------------------- */

std::unique_ptr<HelfrichTerm> LAMMPS_NS::make_local_area_term(LAMMPS *lmp)
{
  return std::make_unique<LocalAreaTerm>(lmp);
}
