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

#include "membrane_face_quarters.h"

#include "membrane_lanes.h"

#include <algorithm>
#include <map>
#include <utility>

using namespace Membrane_NS;

FaceQuarters::FaceQuarters(const std::vector<FaceGroup> &groups)
{
  struct Member {
    int face_slot, first_point;    // of the point with number 0 in the lane of the face
    const std::vector<int> *points;
  };
  struct Kind {
    const PatchRule *rule;
    std::vector<Member> members;
  };
  std::map<std::pair<int, int>, Kind> kinds;    // by numbers of control points and of points of quadrature, which no two rules of a mesh share
  size_t num_points = 0;
  for (const FaceGroup &group : groups) {
    const FaceCut &cut = group.rule->cut;
    if (group.nwhole() == group.nblocks()) continue;
    for (int i = group.nwhole() * LANES; i < group.nfaces; ++i) {
      const int first = static_cast<int>(num_points) + i % LANES;
      for (const FaceCut::Quarter &quarter : cut.quarters) {
        Kind &kind = kinds[{quarter.rule->size, quarter.rule->npoints}];
        kind.rule = quarter.rule;
        kind.members.push_back({group.first_slot + i, first, &quarter.points});
      }
    }
    num_points += static_cast<size_t>(LANES) * cut.size();
  }

  for (const auto &[numbers, kind] : kinds) {
    FaceGroup group;
    group.rule = kind.rule;
    group.first_slot = count_slots(groups_);
    group.nfaces = static_cast<int>(kind.members.size());
    group.points.resize(static_cast<size_t>(group.nslots()) * kind.rule->size);
    for (int i = 0; i < group.nslots(); ++i) {
      const Member &member = kind.members[std::min(i, group.nfaces - 1)];
      faces_.push_back(member.face_slot);
      for (int k = 0; k < kind.rule->size; ++k) group.point(i, k) = member.first_point + (*member.points)[k] * LANES;
    }
    groups_.push_back(std::move(group));
  }
  x_.resize(3 * num_points);
  f_.resize(3 * num_points);
}

/* ---------------------------------------------------------------------- */

void FaceQuarters::place(const std::vector<FaceGroup> &groups, const double (*x)[3])
{
  Lane3 p[MOST_STENCIL];
  int slot = 0;
  for (const FaceGroup &group : groups) {
    const FaceCut &cut = group.rule->cut;
    const int size = group.rule->size;
    for (int block = group.nwhole(); block < group.nblocks(); ++block) {
      gather(&group.points[(size_t) block * size * LANES], size, x, p);
      for (int i = 0; i < cut.size(); ++i, slot += LANES) {
        Lane3 point{};
        for (int j = cut.start[i]; j < cut.start[i + 1]; ++j) point += cut.weight[j] * p[cut.from[j]];
        store3(x_, slot, point);
      }
    }
  }
  std::fill(f_.begin(), f_.end(), 0.0);
}

void FaceQuarters::pull(const std::vector<FaceGroup> &groups, double (*f)[3]) const
{
  Lane3 g[MOST_STENCIL];
  int slot = 0;
  for (const FaceGroup &group : groups) {
    const FaceCut &cut = group.rule->cut;
    const int size = group.rule->size;
    for (int block = group.nwhole(); block < group.nblocks(); ++block) {
      std::fill(g, g + size, Lane3{});
      for (int i = 0; i < cut.size(); ++i, slot += LANES) {
        const Lane3 force = load3(f_, slot);
        for (int j = cut.start[i]; j < cut.start[i + 1]; ++j) g[cut.from[j]] += -cut.weight[j] * force;
      }
      subtract(&group.points[(size_t) block * size * LANES], size, std::min(LANES, group.nfaces - block * LANES), g, f);
    }
  }
}

// === Memory

static double bytes_of(const std::vector<FaceGroup> &groups)
{
  double bytes = 0.0;
  for (const FaceGroup &group : groups) bytes += sizeof(int) * (group.points.capacity() + group.face.capacity());
  return bytes;
}

double FaceQuarters::memory_usage() const
{
  return bytes_of(groups_) + sizeof(int) * faces_.capacity() + sizeof(double) * (x_.capacity() + f_.capacity());
}

double FaceGroups::memory_usage() const
{
  return bytes_of(*this) + quarters.memory_usage();
}
