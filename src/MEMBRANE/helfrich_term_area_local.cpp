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
#include <array>
#include <iterator>

using namespace LAMMPS_NS;
using Membrane_NS::FaceGroup;
using Membrane_NS::FaceModel;

namespace {

struct Coefficients {
  double modulus = 0.0;

  bool active() const { return modulus != 0.0; }
  void archive(RestartArchive &file) { file(modulus); }
};

/// A face by the origins of its corners, increasing, and its area at the first step.
struct KeptArea {
  std::array<bigint, 3> corners;
  double area;

  bool operator<(const KeptArea &o) const { return corners < o.corners; }
  void archive(RestartArchive &file)
  {
    for (bigint &corner : corners) file(corner);
    file(area);
  }
};

/// KL/2 (a - a0)^2/a0 for each face; a0 is its area at the first step.
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
    needs.totals = needs.origins = true;
    return needs;
  }

  void archive_references(RestartArchive &file) override { file(kept); }
  void find_references(const HelfrichScene &, const std::vector<char> &anew) override;
  void localize(const std::vector<FaceGroup> &, FaceModel &) override;
  void take_references(HelfrichScene &) override;
  void act_on_faces(HelfrichScene &) override;
  void tally(const HelfrichScene &, HelfrichTally &) const override;
  void add_stiffness(const HelfrichScene &, HelfrichStiffness &stiffness) override
  {
    for (size_t slot = 0; slot < modulus.size(); ++slot) stiffness.stretch[slot] += modulus[slot];
  }

 protected:
  int read(const HelfrichWords &words, Coefficients &c) const override
  {
    c.modulus = words.modulus(1);
    return 2;
  }

 private:
  std::vector<KeptArea> kept;        // increasing
  std::vector<double> reference;     // by face of the mesh; 0 until it is taken
  std::vector<double> modulus;       // by slot
  bool complete = false;             // all references are taken

  int membrane_of(const HelfrichScene &, int face) const;
  bool acts_on_face(const HelfrichScene &, int face) const;
  void keep(const HelfrichScene &);
};

/* ---------------------------------------------------------------------- */

int LocalAreaTerm::membrane_of(const HelfrichScene &scene, int face) const
{
  const auto &topology = scene.mesh->topology();
  return scene.mesh->membrane(topology.component(topology.face(face)[0]));
}

bool LocalAreaTerm::acts_on_face(const HelfrichScene &scene, int face) const
{
  const int m = membrane_of(scene, face);
  return !scene.excluded[m] && acts_on(scene.types[m].front());
}

static std::array<bigint, 3> corners_of(const Membrane_NS::Face &face,
                                        const std::vector<bigint> &origins)
{
  std::array<bigint, 3> corners = {origins[face[0]], origins[face[1]], origins[face[2]]};
  std::sort(corners.begin(), corners.end());
  return corners;
}

/* ---------------------------------------------------------------------- */

void LocalAreaTerm::find_references(const HelfrichScene &scene, const std::vector<char> &anew)
{
  const auto &topology = scene.mesh->topology();
  reference.assign(topology.num_faces(), 0.0);
  complete = true;
  for (int f = 0; f < topology.num_faces(); ++f) {
    if (!acts_on_face(scene, f)) continue;
    const KeptArea wanted = {corners_of(topology.face(f), scene.origins.before()), 0.0};
    const auto found = std::lower_bound(kept.begin(), kept.end(), wanted);
    if (!anew[membrane_of(scene, f)] && found != kept.end() && found->corners == wanted.corners)
      reference[f] = found->area;
    else
      complete = false;
  }
  keep(scene);
}

// of faces that this term does not act on now, what was kept remains, as long as they exist

void LocalAreaTerm::keep(const HelfrichScene &scene)
{
  const auto &topology = scene.mesh->topology();
  std::vector<KeptArea> now, others;
  for (int f = 0; f < topology.num_faces(); ++f)
    if (acts_on_face(scene, f))
      now.push_back({corners_of(topology.face(f), scene.origins.now()), reference[f]});
  std::sort(now.begin(), now.end());
  for (const KeptArea &entry : kept) {
    const bool exists = std::all_of(entry.corners.begin(), entry.corners.end(),
                                    [&](bigint corner) { return scene.origins.exists(corner); });
    if (exists && !std::binary_search(now.begin(), now.end(), entry)) others.push_back(entry);
  }
  now.erase(std::remove_if(now.begin(), now.end(), [](const KeptArea &k) { return k.area == 0.0; }),
            now.end());
  kept.clear();
  std::merge(now.begin(), now.end(), others.begin(), others.end(), std::back_inserter(kept));
}

/* ---------------------------------------------------------------------- */

void LocalAreaTerm::localize(const std::vector<FaceGroup> &groups, FaceModel &)
{
  modulus.assign(count_slots(groups), 0.0);
  add_corner_means(groups, atom->type, modulus, [this](int type) { return by_type[type].modulus; });
}

/* ---------------------------------------------------------------------- */

void LocalAreaTerm::take_references(HelfrichScene &scene)
{
  if (complete) return;
  complete = true;
  std::vector<double> mine(reference.size(), 0.0), all(reference.size());
  for (const FaceGroup &group : scene.groups)
    for (int s = 0; s < group.nfaces; ++s)
      mine[group.face[s]] = scene.integrals.area[group.first_slot + s];
  MPI_Allreduce(mine.data(), all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM, world);
  for (size_t f = 0; f < all.size(); ++f)
    if (reference[f] == 0.0 && acts_on_face(scene, f)) reference[f] = all[f];
  keep(scene);
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
