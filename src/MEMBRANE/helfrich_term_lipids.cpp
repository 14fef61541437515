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

#include "helfrich_term_lipids.h"

#include "atom.h"
#include "comm.h"
#include "membrane_helfrich.h"

#include <algorithm>

using namespace LAMMPS_NS;
using Membrane_NS::FaceGroup;
using Membrane_NS::FaceModel;

/* ---------------------------------------------------------------------- */

HelfrichTermLipids::HelfrichTermLipids(LAMMPS *lmp) :
    HelfrichTerm(lmp, "lipids", HelfrichOutput::BENDING), said(lmp), on_faces(nullptr), nfaces(0)
{
}

void HelfrichTermLipids::clear(int type)
{
  said.clear(type);
}

int HelfrichTermLipids::parse(const std::vector<int> &types, const HelfrichWords &words)
{
  unlogged.resize(atom->ntypes + 1, 0);
  for (int type : types) unlogged[type] = 1;
  return said.parse(types, words);
}

void HelfrichTermLipids::choose(const HelfrichScene &scene)
{
  on_faces = &scene.mesh->lipids();
  nfaces = scene.mesh->topology().num_faces();
}

/* ----------------------------------------------------------------------
   bending, leaflets and tension have written to the model before
------------------------------------------------------------------------- */

void HelfrichTermLipids::localize(const std::vector<FaceGroup> &groups, FaceModel &model)
{
  const int nslots = count_slots(groups);
  std::vector<double> share(nslots, 0.0), outer(nslots, 0.0), inner(nslots, 0.0);
  add_corner_means(groups, atom->type, share, [this](int type) { return acts_on(type) ? 1.0 : 0.0; });
  add_corner_means(groups, atom->type, outer, [this](int type) { return said.outer_curvature(type); });
  add_corner_means(groups, atom->type, inner, [this](int type) { return said.inner_curvature(type); });
  for (int slot = 0; slot < nslots; ++slot) model.add_curvatures(slot, outer[slot], inner[slot]);

  flat.resize(nslots);
  for (int slot = 0; slot < nslots; ++slot) {
    flat[slot] = share[slot] * model.flat_energy(slot);
    model.tension[slot] -= flat[slot];
  }
  if (on_faces->active && on_faces->outer.size() == (size_t) nfaces)
    for (const FaceGroup &group : groups)
      for (int s = 0; s < group.nslots(); ++s) {
        const int slot = group.first_slot + s, face = group.face[std::min(s, group.nfaces - 1)];
        model.add_curvatures(slot, on_faces->outer[face] - outer[slot], on_faces->inner[face] - inner[slot]);
      }
  if (std::count(unlogged.begin(), unlogged.end(), 1)) log(groups, model);
}

/* ----------------------------------------------------------------------
   once after pair_coeff: what each type has, and how many lipids that is
------------------------------------------------------------------------- */

void HelfrichTermLipids::log(const std::vector<FaceGroup> &groups, const FaceModel &model)
{
  Membrane_NS::FaceIntegrals found;
  found.area.resize(count_slots(groups));
  const int n = static_cast<int>(unlogged.size());
  const auto x = atom->nlocal ? reinterpret_cast<const double(*)[3]>(atom->x[0]) : nullptr;
  std::vector<double> mine(n, 0.0), area(n);
  Membrane_NS::FaceGroups faces = std::vector<FaceGroup>(groups);
  face_integrals(faces, x, model, found);
  for (const FaceGroup &group : groups)
    for (int s = 0; s < group.nfaces; ++s)
      for (int k = 0; k < 3; ++k) mine[atom->type[group.point(s, k)]] += found.area[group.first_slot + s] / 3.0;
  MPI_Allreduce(mine.data(), area.data(), n, MPI_DOUBLE, MPI_SUM, world);
  for (int t = 1; t < n; ++t) {
    if (!unlogged[t] || !acts_on(t)) continue;
    const auto &leaflets = said.of(t);
    std::string text = fmt::format("Lipids of type {} on area {:.6g}, bilayer c0 {:.6g}:\n", t, area[t],
                                   said.bilayer_curvature(t));
    for (auto [leaflet, name] : {std::make_pair(&leaflets.outer, "outer"), {&leaflets.inner, "inner"}})
      text += fmt::format("  {} {}, {:.0f} lipids\n", name, said.describe(*leaflet),
                          area[t] / leaflet->area(said.library()));
    if (comm->me == 0) utils::logmesg(lmp, text);
  }
  std::fill(unlogged.begin(), unlogged.end(), 0);
}

// terms of total area have set the model's tension anew

void HelfrichTermLipids::act_on_faces(HelfrichScene &scene)
{
  for (size_t slot = 0; slot < flat.size(); ++slot) scene.model.tension[slot] -= flat[slot];
}

void HelfrichTermLipids::tally(const HelfrichScene &scene, HelfrichTally &tally) const
{
  for (const FaceGroup &group : scene.groups)
    for (int s = 0; s < group.nfaces; ++s) {
      const int slot = group.first_slot + s;
      tally.add(slot, output, -flat[slot] * scene.energies.area[slot]);
    }
}

/* ---------------------------------------------------------------------- */

std::unique_ptr<HelfrichTerm> LAMMPS_NS::make_lipids_term(LAMMPS *lmp)
{
  return std::make_unique<HelfrichTermLipids>(lmp);
}
