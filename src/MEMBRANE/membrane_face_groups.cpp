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

#include "membrane_face_groups.h"

#include <algorithm>
#include <map>
#include <tuple>

using namespace Membrane_NS;

/* ---------------------------------------------------------------------- */

int FaceGroup::nblocks() const
{
  return (nfaces + LANES - 1) / LANES;
}

int FaceGroup::nslots() const
{
  return nblocks() * LANES;
}

int FaceGroup::nwhole() const
{
  return rule->cut.empty() ? nblocks() : nfaces / LANES;
}

int &FaceGroup::point(int i, int k)
{
  return points[(i / LANES * rule->size + k) * LANES + i % LANES];
}

int FaceGroup::point(int i, int k) const
{
  return points[(i / LANES * rule->size + k) * LANES + i % LANES];
}

std::vector<FaceGroup> Membrane_NS::group_faces(const Topology &topology, PatchRules &rules,
                                                const std::vector<int> &faces)
{
  // turn each face such that equal sets of valences give equal keys: fewer, fuller groups

  struct Member {
    int face, first;
  };
  struct Kind {
    Valences valences;
    bool is_squeezed;
    bool operator<(const Kind &other) const
    {
      return std::tie(valences, is_squeezed) < std::tie(other.valences, other.is_squeezed);
    }
  };
  std::map<Kind, std::vector<Member>> members;
  for (int f : faces) {
    const Valences n = topology.valences(f);
    auto rank = [](const Valences &v) {
      Valences r;
      for (int k = 0; k < 3; ++k) r[k] = v[k] == 6 ? 0 : v[k];
      return r;
    };
    int first = 0;
    Valences key = n;
    for (int k = 1; k < 3; ++k) {
      const Valences turned = {n[k], n[(k + 1) % 3], n[(k + 2) % 3]};
      if (rank(turned) > rank(key)) {
        key = turned;
        first = k;
      }
    }
    members[{key, topology.is_squeezed(f)}].push_back({f, first});
  }

  std::vector<FaceGroup> groups;
  std::vector<int> stencil;
  int slot = 0;
  for (const auto &[kind, list] : members) {
    FaceGroup group;
    for (int n : kind.valences)
      if (n > MOST_VALENCE)
        throw MeshError("face " + std::to_string(list[0].face) + " has a corner of valence " +
                        std::to_string(n) + "; at most " + std::to_string(MOST_VALENCE) +
                        " edges may meet in a vertex: remesh there");
    group.rule = kind.is_squeezed ? &rules.squeezed() : &rules.get(kind.valences);
    group.first_slot = slot;
    group.nfaces = static_cast<int>(list.size());
    group.points.resize(static_cast<size_t>(group.nslots()) * group.rule->size);
    for (int i = 0; i < group.nslots(); ++i) {
      const Member &member = list[std::min(i, group.nfaces - 1)];
      if (i < group.nfaces) group.face.push_back(member.face);
      topology.stencil(member.face, stencil, member.first);
      for (int k = 0; k < group.rule->size; ++k) group.point(i, k) = stencil[k];
    }
    slot += group.nslots();
    groups.push_back(std::move(group));
  }
  return groups;
}

int Membrane_NS::count_slots(const std::vector<FaceGroup> &groups)
{
  return groups.empty() ? 0 : groups.back().first_slot + groups.back().nslots();
}

void FaceModel::resize(int nslots)
{
  for (auto *array : {&kc, &c0, &kg, &tension, &moment, &pressure}) array->assign(nslots, 0.0);
  origin.assign(3 * static_cast<size_t>(nslots), 0.0);
  for (auto *array : {&leaflet, &outer, &inner}) array->clear();
}

// where leaflets have no distance they see the mean only, as the bilayer does

void FaceModel::add_curvatures(int slot, double more_outer, double more_inner)
{
  const double more = 0.5 * (more_outer - more_inner);
  c0[slot] += more;
  if (!has_leaflets()) return;
  const bool apart = leaflet[slot] > 0.0;
  outer[slot] += apart ? more_outer : more;
  inner[slot] += apart ? more_inner : -more;
}

double FaceModel::flat_energy(int slot) const
{
  if (!has_leaflets()) return 0.5 * kc[slot] * c0[slot] * c0[slot];
  return 0.25 * kc[slot] * (outer[slot] * outer[slot] + inner[slot] * inner[slot]);
}
