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

#include "mesh_faces.h"

#include "atom.h"
#include "error.h"
#include "fmt/format.h"
#include "mesh_gather.h"

#include <algorithm>
#include <cstdint>

using namespace LAMMPS_NS;
using Membrane_NS::Face;
using Membrane_NS::MeshError;
using Membrane_NS::Topology;

static constexpr char MISSING_ATOM[] =
    "Control point {} is used by a face but is not an atom: delete whole membranes only, with "
    "delete_atoms ... bond yes mol yes";

/* ---------------------------------------------------------------------- */

// faces of this rank: the three atom IDs and the molecule ID of the middle atom

struct MeshFaces::AngleList {
  static constexpr int WIDTH = 4;
  std::vector<tagint> data;
};

void MeshFaces::collect_angles(AngleList &angles)
{
  int lo = 1, hi = atom->nangletypes;
  if (face_types != "*")
    utils::bounds(FLERR, face_types, 1, MAX(1, atom->nangletypes), lo, hi, error);

  // with newton_bond off each of the three atoms has a copy: the middle one counts

  for (int i = 0; i < atom->nlocal; ++i)
    for (int m = 0; m < atom->num_angle[i]; ++m) {
      const int type = std::abs(atom->angle_type[i][m]);
      if (atom->angle_atom2[i][m] != atom->tag[i] || type < lo || type > hi) continue;
      angles.data.insert(angles.data.end(),
                         {atom->angle_atom1[i][m], atom->angle_atom2[i][m],
                          atom->angle_atom3[i][m], atom->molecule[i]});
    }
}

/* ---------------------------------------------------------------------- */

void MeshFaces::update_faces()
{
  AngleList angles;
  collect_angles(angles);

  // a sum of hashes does not depend on which rank holds which face

  uint64_t sum = 0;
  auto mix = [](uint64_t h) {
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9ULL;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebULL;
    return h ^ (h >> 31);
  };
  for (size_t i = 0; i < angles.data.size(); i += AngleList::WIDTH) {
    uint64_t h = 1;
    for (int k = 0; k < AngleList::WIDTH; ++k) h = mix(h + (uint64_t) angles.data[i + k]);
    sum += h;
  }
  bigint mine = static_cast<bigint>(sum), total;
  MPI_Allreduce(&mine, &total, 1, MPI_LMP_BIGINT, MPI_SUM, world);

  if (version == 0 || total != fingerprint) {
    rebuild(angles);
    fingerprint = total;
    ++version;
  }
}

/* ----------------------------------------------------------------------
   number vertices and faces, and build the topology
------------------------------------------------------------------------- */

void MeshFaces::rebuild(const AngleList &mine)
{
  const std::vector<tagint> all = gather_all(mine.data, world);
  const size_t nfaces = all.size() / AngleList::WIDTH;

  tags.clear();
  tags.reserve(3 * nfaces);
  for (size_t f = 0; f < nfaces; ++f)
    for (int k = 0; k < 3; ++k) tags.push_back(all[AngleList::WIDTH * f + k]);
  std::sort(tags.begin(), tags.end());
  tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
  tags.shrink_to_fit();

  // the lowest corner comes first and owns the face

  struct Record {
    Face face;
    tagint molecule;
  };
  std::vector<Record> records(nfaces);
  for (size_t f = 0; f < nfaces; ++f) {
    const tagint *a = &all[AngleList::WIDTH * f];
    Face face = {vertex(a[0]), vertex(a[1]), vertex(a[2])};
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    records[f] = {face, a[3]};
  }
  std::sort(records.begin(), records.end(),
            [](const Record &a, const Record &b) { return a.face < b.face; });
  std::vector<Face> faces(nfaces);
  for (size_t f = 0; f < nfaces; ++f) faces[f] = records[f].face;

  Topology::Labels labels;
  labels.vertex = [this](int v) { return fmt::format("control point {}", tags[v]); };
  labels.face = [this, &records](int f) {
    const Face &face = records[f].face;
    return fmt::format("face {}-{}-{}", tags[face[0]], tags[face[1]], tags[face[2]]);
  };
  try {
    topo = Topology(static_cast<int>(tags.size()), std::move(faces), labels);
  } catch (const MeshError &err) {
    version = 0;
    report_missing_atoms();
    error->all(FLERR, "Membrane mesh: {}", err.what());
  }

  // membranes; unwrap() checks that control points agree

  component_molecule.resize(topo.num_components());
  for (size_t f = 0; f < nfaces; ++f)
    component_molecule[topo.component(topo.face(f)[0])] = records[f].molecule;
  membranes = component_molecule;
  std::sort(membranes.begin(), membranes.end());
  membranes.erase(std::unique(membranes.begin(), membranes.end()), membranes.end());
  component_membrane.clear();
  for (tagint molecule : component_molecule)
    component_membrane.push_back(
        std::lower_bound(membranes.begin(), membranes.end(), molecule) - membranes.begin());
}

/* ----------------------------------------------------------------------
   a hole where atoms were deleted: better named by what is missing
------------------------------------------------------------------------- */

void MeshFaces::report_missing_atoms() const
{
  std::vector<int> mine(tags.size(), 0), exists(tags.size());
  for (int i = 0; i < atom->nlocal; ++i) {
    const int v = vertex(atom->tag[i]);
    if (v >= 0) mine[v] = 1;
  }
  MPI_Allreduce(mine.data(), exists.data(), mine.size(), MPI_INT, MPI_MAX, world);
  const auto missing = std::find(exists.begin(), exists.end(), 0);
  if (missing != exists.end()) error->all(FLERR, MISSING_ATOM, tags[missing - exists.begin()]);
}

/* ---------------------------------------------------------------------- */

int MeshFaces::vertex(tagint id) const
{
  if (tags.empty() || id < tags.front() || id > tags.back()) return -1;
  if (tags.back() - tags.front() + 1 == (tagint) tags.size()) return id - tags.front();
  const auto found = std::lower_bound(tags.begin(), tags.end(), id);
  return *found == id ? found - tags.begin() : -1;
}

std::string MeshFaces::face_name(int f) const
{
  const Face &face = topo.face(f);
  return fmt::format("face {}-{}-{}", tags[face[0]], tags[face[1]], tags[face[2]]);
}
