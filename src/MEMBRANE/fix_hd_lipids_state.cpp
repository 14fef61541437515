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

// which lipids faces have: as pair_coeff says, or as they had before

#include "fix_hd_lipids.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_hd_bound.h"
#include "helfrich_model.h"
#include "mesh_gather.h"
#include "modify.h"

#include <algorithm>
#include <numeric>

using namespace LAMMPS_NS;
using Membrane_NS::FaceLipids;
using Membrane_NS::LipidExchange;
using Membrane_NS::LipidLibrary;

/* ---------------------------------------------------------------------- */

// what a type is made of: another composition is dealt out anew

std::string FixHDLipids::words_of(int type) const
{
  const auto &leaflets = composition->of(type);
  std::string words;
  if (!leaflets.given) return words;
  for (const auto *leaflet : {&leaflets.outer, &leaflets.inner}) {
    for (const auto &[kind, fraction] : leaflet->parts)
      words += fmt::format("{} {:a} ", composition->library()[kind].name, fraction);
    words += "/ ";
  }
  return words;
}

std::array<int, 3> FixHDLipids::sorted_corners(int face, const std::vector<bigint> &origins) const
{
  auto corners = mesh->topology().face(face);
  std::sort(corners.begin(), corners.end(), [&](int v, int w) { return origins[v] < origins[w]; });
  return corners;
}

FixHDLipids::KeptFace FixHDLipids::key_of(int face, const std::vector<bigint> &origins) const
{
  const auto corners = sorted_corners(face, origins);
  KeptFace key;
  for (int k = 0; k < 3; ++k) {
    key.corners[k] = origins[corners[k]];
    key.types[k] = types[corners[k]];
  }
  return key;
}

/* ----------------------------------------------------------------------
   areas of faces by leaflet, without what footprints of bound particles take on membranes that are being filled: of the face that a particle stands on,
   and once this is full of those around it
------------------------------------------------------------------------- */

std::array<std::vector<double>, 2> FixHDLipids::free_areas() const
{
  struct Taken {
    tagint tag;
    int face;
    double area;
  };
  std::vector<Taken> mine;
  for (auto &fix : modify->get_fix_by_style("^hd/bind$")) {
    const auto *bound = dynamic_cast<FixHDBound *>(fix);
    for (int i = 0; i < atom->nlocal; ++i)
      if ((atom->mask[i] & fix->groupbit) && bound->footprint_area(i) > 0.0)
        mine.push_back({atom->tag[i], bound->site(i).point.face, bound->footprint_area(i)});
  }
  std::vector<Taken> taken = gather_all(mine, world);
  std::sort(taken.begin(), taken.end(), [](const Taken &a, const Taken &b) { return a.tag < b.tag; });

  const auto &topology = mesh->topology();
  const int nfaces = topology.num_faces();
  std::array<std::vector<double>, 2> areas;
  for (int l = 0; l < 2; ++l) {
    for (int f = 0; f < nfaces; ++f) areas[l].push_back(shapes[f].area[l]);
    std::vector<int> reached(nfaces, -1);
    for (size_t p = 0; p < taken.size(); ++p) {
      const int m = membrane_of[taken[p].face];
      if (!anew[m]) continue;
      double left = taken[p].area;
      std::vector<int> around = {taken[p].face};
      reached[taken[p].face] = static_cast<int>(p);
      for (size_t i = 0; i < around.size() && left > 0.0; ++i) {
        double &area = areas[l][around[i]];
        const double part = std::min(left, area);
        left -= part;
        area -= part;
        for (int k = 0; k < 3; ++k) {
          const int beyond = topology.neighbor(around[i], k);
          if (beyond < 0 || reached[beyond] == static_cast<int>(p)) continue;
          reached[beyond] = static_cast<int>(p);
          around.push_back(beyond);
        }
      }
      if (left > 0.0)
        error->all(FLERR, "Fix hd/lipids: the footprints of bound particles leave no room for lipids on the membrane of atom {}",
                   taken[p].tag);
    }
  }
  return areas;
}

/* ----------------------------------------------------------------------
   which lipids that were kept are those of a face now: on membranes whose faces were there before, with corners
   whose composition is the same
------------------------------------------------------------------------- */

void FixHDLipids::find_kept()
{
  const int nfaces = mesh->topology().num_faces();
  found.assign(nfaces, nullptr);
  anew.assign(takes_part.size(), 0);
  std::vector<std::string> words(1);
  for (int type = 1; type <= atom->ntypes; ++type) words.push_back(words_of(type));
  const auto same_words = [&](int before, int now) {
    return static_cast<size_t>(before) < kept_words.size() && kept_words[before] == words[now];
  };
  for (int f = 0; f < nfaces; ++f) {
    if (!takes_part[membrane_of[f]]) continue;
    const KeptFace wanted = key_of(f, model->origins().now());
    const auto face = std::lower_bound(kept.begin(), kept.end(), wanted);
    const bool there = face != kept.end() && face->corners == wanted.corners;
    if (there && std::equal(face->types.begin(), face->types.end(), wanted.types.begin(), same_words))
      found[f] = &*face;
    else
      anew[membrane_of[f]] = 1;
  }
}

/* ----------------------------------------------------------------------
   what find_kept() has found, and on other membranes what pair_coeff says
------------------------------------------------------------------------- */

void FixHDLipids::take_up()
{
  const auto &topology = mesh->topology();
  const LipidLibrary &library = composition->library();
  const int nfaces = topology.num_faces(), nkinds = library.size();
  const int nmembranes = static_cast<int>(takes_part.size());
  std::vector<int> kind_now;
  for (const std::string &name : kept_kinds) kind_now.push_back(library.find(name));

  // new membranes: whole numbers from areas, leaflet by leaflet

  std::array<std::vector<int>, 2> numbers;    // [faces][kinds], of new membranes
  std::array<std::vector<int>, 2> totals;
  std::array<std::vector<double>, 2> areas;
  if (std::count(anew.begin(), anew.end(), 1)) areas = free_areas();
  for (int l = 0; l < 2; ++l) {
    numbers[l].assign(static_cast<size_t>(nfaces) * nkinds, 0);
    totals[l].assign(nfaces, 0);
    for (int m = 0; m < nmembranes; ++m) {
      if (!anew[m]) continue;
      std::vector<int> faces;
      for (int f = 0; f < nfaces; ++f)
        if (membrane_of[f] == m) faces.push_back(f);
      std::vector<double> wanted(faces.size() * nkinds, 0.0);
      for (size_t i = 0; i < faces.size(); ++i)
        for (int v : topology.face(faces[i])) {
          const auto &leaflets = composition->of(types[v]);
          const auto &leaflet = l == 0 ? leaflets.outer : leaflets.inner;
          for (const auto &[kind, fraction] : leaflet.parts)
            wanted[i * nkinds + kind] += fraction * areas[l][faces[i]] / leaflet.area(library) / 3.0;
        }
      const std::vector<int> dealt = Membrane_NS::fill_faces(wanted, nkinds);
      for (size_t i = 0; i < faces.size(); ++i)
        std::copy_n(dealt.begin() + i * nkinds, nkinds, numbers[l].begin() + static_cast<size_t>(faces[i]) * nkinds);
    }
    for (int f = 0; f < nfaces; ++f)
      if (takes_part[membrane_of[f]])
        totals[l][f] = anew[membrane_of[f]]
            ? std::accumulate(&numbers[l][static_cast<size_t>(f) * nkinds],
                              &numbers[l][static_cast<size_t>(f) * nkinds] + nkinds, 0)
            : static_cast<int>(found[f]->lipids[l].size());
  }

  FaceLipids lipids(nkinds, totals);
  for (int l = 0; l < 2; ++l)
    for (int f = 0; f < nfaces; ++f) {
      if (!takes_part[membrane_of[f]]) continue;
      int i = lipids.first(l, f);
      if (!anew[membrane_of[f]])
        for (char kind : found[f]->lipids[l]) lipids.kind(l, i++) = kind_now[static_cast<unsigned char>(kind)];
      else
        for (int k = 0; k < nkinds; ++k)
          for (int n = numbers[l][static_cast<size_t>(f) * nkinds + k]; n > 0; --n) lipids.kind(l, i++) = k;
    }
  start(std::move(lipids));
}

/* ---------------------------------------------------------------------- */

void FixHDLipids::start(FaceLipids lipids)
{
  const LipidLibrary &library = composition->library();
  const int nkinds = library.size(), nfaces = lipids.num_faces();
  if (nkinds > 256) error->all(FLERR, "Fix hd/lipids: there are {} kinds of lipids, and 256 at most", nkinds);
  std::array<std::vector<double>, 2> empty;
  for (int l = 0; l < 2; ++l)
    for (int f = 0; f < nfaces; ++f) empty[l].push_back(composed(f, l));
  std::vector<Membrane_NS::ExchangedKind> kinds;
  for (int k = 0; k < nkinds; ++k) kinds.push_back({library[k].area, library[k].c0});
  exchange = std::make_unique<LipidExchange>(std::move(kinds), std::move(lipids),
                                             Membrane_NS::face_edges(mesh->topology()), membrane_of, std::move(empty));
  if (!interactions.empty()) {
    std::vector<double> w(static_cast<size_t>(nkinds) * nkinds, 0.0);
    for (const Interaction &said : interactions) {
      const int a = library.find(said.first), b = library.find(said.second);
      w[a * nkinds + b] = w[b * nkinds + a] = said.energy;
    }
    exchange->set_interaction(std::move(w));
  }
  filled = true;

  keys.resize(nfaces);
  for (int f = 0; f < nfaces; ++f) keys[f] = key_of(f, model->origins().now());
  kept_kinds.clear();
  places.lipids = &exchange->lipids();
  places.mesh = &*mesh;
  places.generation = mesh->generation();
  places.kinds.clear();
  for (int k = 0; k < nkinds; ++k) {
    kept_kinds.push_back(library[k].name);
    places.kinds.push_back(library[k]);
  }
  kept_words.assign(1, "");
  for (int type = 1; type <= atom->ntypes; ++type) kept_words.push_back(words_of(type));
  publish();
}

/* ----------------------------------------------------------------------
   lipids by the origins of faces
------------------------------------------------------------------------- */

void FixHDLipids::keep()
{
  const FaceLipids &lipids = exchange->lipids();
  std::vector<KeptFace> now;
  for (int f = 0; f < lipids.num_faces(); ++f) {
    if (!takes_part[membrane_of[f]]) continue;
    KeptFace face = keys[f];
    for (int l = 0; l < 2; ++l)
      for (int i = 0; i < lipids.size(l, f); ++i)
        face.lipids[l].push_back(static_cast<char>(lipids.kind(l, lipids.first(l, f) + i)));
    now.push_back(std::move(face));
  }
  std::sort(now.begin(), now.end());
  kept = std::move(now);
}

// in init(), which commands such as write_restart call as well: control points may have other numbers after it

void FixHDLipids::follow_origins()
{
  std::vector<KeptFace> now;
  for (int f = 0; f < mesh->topology().num_faces(); ++f) {
    const auto &before = model->origins().before(), &after = model->origins().now();
    KeptFace face = key_of(f, before);
    const auto its = std::lower_bound(kept.begin(), kept.end(), face);
    if (its == kept.end() || its->corners != face.corners) continue;
    face = key_of(f, after);

    // types are those that corners had

    const auto had = sorted_corners(f, before), have = sorted_corners(f, after);
    for (int k = 0; k < 3; ++k) face.types[k] = its->types[std::find(had.begin(), had.end(), have[k]) - had.begin()];
    face.lipids = its->lipids;
    now.push_back(std::move(face));
  }
  std::sort(now.begin(), now.end());
  kept = std::move(now);
}

void FixHDLipids::archive(RestartArchive &file)
{
  file(visits);
  file(attempted);
  file(accepted);
  file(energy);
  file(kept_kinds);
  file(kept_words);
  file(kept);
}

void FixHDLipids::write_restart(FILE *fp)
{
  if (exchange) keep();
  RestartArchive file;
  archive(file);
  if (comm->me == 0) file.write_of_fix(fp);
}

void FixHDLipids::restart(char *buf)
{
  RestartArchive file = RestartArchive::of_fix(buf);
  archive(file);
  if (!file.ok()) error->all(FLERR, "The restart file is damaged: fix hd/lipids");
}
