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

#include "helfrich_lipids.h"

#include "comm.h"
#include "error.h"
#include "update.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

using namespace LAMMPS_NS;
using Membrane_NS::LeafletComposition;
using Membrane_NS::LipidError;
using Membrane_NS::LipidKind;
using Membrane_NS::LipidLibrary;

// lengths of LAMMPS' units, in Angstrom; CODATA 2022 for Bohr's
static const std::map<std::string, double> LENGTHS = {
    {"real", 1.0},   {"metal", 1.0}, {"electron", 0.529177210544}, {"nano", 10.0},
    {"micro", 1.0e4}, {"cgs", 1.0e8}, {"si", 1.0e10}};

/* ---------------------------------------------------------------------- */

bool HelfrichLipids::any() const
{
  return std::any_of(by_type.begin(), by_type.end(), [](const Leaflets &l) { return l.given; });
}

double HelfrichLipids::outer_curvature(int type) const
{
  return by_type[type].given ? by_type[type].outer.curvature(used) : 0.0;
}

double HelfrichLipids::inner_curvature(int type) const
{
  return by_type[type].given ? by_type[type].inner.curvature(used) : 0.0;
}

void HelfrichLipids::resize(int n)
{
  by_type.assign(n, Leaflets());
  used = LipidLibrary();
}

void HelfrichLipids::clear(int type)
{
  by_type[type] = Leaflets();
  keep_used(used);
}

/* ----------------------------------------------------------------------
   first the library, then leaflets: in whatever order the words come
------------------------------------------------------------------------- */

int HelfrichLipids::parse(const std::vector<int> &types, const HelfrichWords &words)
{
  const std::string path = words.word(1);
  LipidLibrary library, from_file;
  struct Part {
    bool outer;
    std::string name;
    double parts;
  };
  std::vector<Part> said;
  int i = 2;
  try {
    while (words.is(i, "outer") || words.is(i, "inner") || words.is(i, "library")) {
      const std::string what = words.word(i++);
      if (what == "library") {
        library.add({words.word(i), words.number(i + 1), words.number(i + 2)});
        i += 3;
      } else {
        do {
          said.push_back({what == "outer", words.word(i), words.number(i + 1)});
          i += 2;
        } while (!words.at_end(i) && !words.is(i, "outer") && !words.is(i, "inner") &&
                 !words.is(i, "library"));
      }
    }
    if (path != "NULL") read(path, from_file);
    for (int k = 0; k < from_file.size(); ++k)
      if (library.find(from_file[k].name) < 0) library.add(from_file[k]);

    Leaflets leaflets;
    leaflets.given = true;
    for (const Part &part : said) {
      const int kind = library.find(part.name);
      if (kind < 0)
        error->all(FLERR,
                   "pair_coeff helfrich lipids: unknown lipid {}; known are: {}; add it with library "
                   "NAME area curvature",
                   part.name, library.names());
      (part.outer ? leaflets.outer : leaflets.inner).add(library[kind], kind, part.parts);
    }
    for (auto [leaflet, name] : {std::make_pair(&leaflets.outer, "outer"), {&leaflets.inner, "inner"}}) {
      if (leaflet->parts.empty())
        error->all(FLERR,
                   "pair_coeff helfrich lipids: the {} leaflet has no lipids: say {} and names of "
                   "lipids with their parts",
                   name, name);
      try {
        leaflet->normalize();
      } catch (const LipidError &err) {
        throw LipidError(fmt::format("{} leaflet: {}", name, err.what()));
      }
    }
    for (int type : types) by_type[type] = Leaflets();
    LipidLibrary all;
    keep_used(used);
    for (int k = 0; k < used.size(); ++k) all.add(used[k]);
    for (auto *leaflet : {&leaflets.outer, &leaflets.inner})
      for (auto &part : leaflet->parts) part.first = all.add(library[part.first]);
    for (int type : types) by_type[type] = leaflets;
    used = all;
  } catch (const LipidError &err) {
    error->all(FLERR, "pair_coeff helfrich lipids: {}", err.what());
  }
  return i;
}

/* ----------------------------------------------------------------------
   the library is left with what types have; their numbers are of `library`
------------------------------------------------------------------------- */

void HelfrichLipids::keep_used(const LipidLibrary &library)
{
  LipidLibrary kept;
  for (Leaflets &leaflets : by_type)
    for (auto *leaflet : {&leaflets.outer, &leaflets.inner})
      for (auto &part : leaflet->parts) part.first = kept.add(library[part.first]);
  used = kept;
}

/* ----------------------------------------------------------------------
   a potential file as LAMMPS has them: where it finds them, with UNITS in the first line
------------------------------------------------------------------------- */

void HelfrichLipids::read(const std::string &path, LipidLibrary &library) const
{
  std::string text, units;
  int size = -1;
  if (comm->me == 0) {
    const std::string found = utils::get_potential_file_path(path);
    std::ifstream file(found);
    if (!found.empty() && file) {
      std::stringstream content;
      content << file.rdbuf();
      text = content.str();
      units = utils::get_potential_units(found, "lipids");
      text = units + "\n" + text;
      size = static_cast<int>(text.size());
    }
  }
  MPI_Bcast(&size, 1, MPI_INT, 0, world);
  if (size < 0)
    error->all(FLERR,
               "pair_coeff helfrich lipids: cannot open file {}: put it into this folder or into one "
               "of the environment variable LAMMPS_POTENTIALS",
               path);
  text.resize(size);
  MPI_Bcast(&text[0], size, MPI_CHAR, 0, world);
  const auto first = text.find('\n');
  units = text.substr(0, first);
  text.erase(0, first + 1);

  const std::string here = update->unit_style;
  const auto theirs = LENGTHS.find(units), ours = LENGTHS.find(here);
  if (units != here && theirs == LENGTHS.end())
    error->all(FLERR,
               "pair_coeff helfrich lipids: the first line of {} must have UNITS: and one of LAMMPS' "
               "units, not {}",
               path, units.empty() ? "nothing" : units);
  if (units != here && ours == LENGTHS.end())
    error->all(FLERR,
               "pair_coeff helfrich lipids: file {} is in units {}, which units {} cannot be compared "
               "with: say NULL in place of the file, and library NAME area curvature for each lipid",
               path, units, here);
  library.read(text, path, units == here ? 1.0 : theirs->second / ours->second);
}

/* ---------------------------------------------------------------------- */

std::string HelfrichLipids::describe(const LeafletComposition &leaflet) const
{
  std::string text;
  for (const auto &[kind, fraction] : leaflet.parts)
    text += fmt::format("{} {:.6g}, ", used[kind].name, fraction);
  return text +
      fmt::format("area/lipid {:.6g}, curvature {:.6g}", leaflet.area(used), leaflet.curvature(used));
}

/* ---------------------------------------------------------------------- */

void HelfrichLipids::archive(RestartArchive &file)
{
  std::vector<LipidKind> kinds;
  for (int k = 0; k < used.size(); ++k) kinds.push_back(used[k]);
  bigint count = kinds.size();
  file(count);
  if (file.is_reading()) kinds.resize(file.ok() && count >= 0 ? count : 0);
  for (LipidKind &kind : kinds) {
    file(kind.name);
    file(kind.area);
    file(kind.c0);
  }
  for (Leaflets &leaflets : by_type) {
    file(leaflets.given);
    for (auto *leaflet : {&leaflets.outer, &leaflets.inner}) {
      bigint n = leaflet->parts.size();
      file(n);
      if (file.is_reading()) leaflet->parts.resize(file.ok() && n >= 0 && n <= count ? n : 0);
      for (auto &part : leaflet->parts) {
        file(part.first);
        file(part.second);
      }
    }
  }
  if (!file.is_reading() || !file.ok()) return;
  used = LipidLibrary();
  for (const LipidKind &kind : kinds) used.add(kind);
}
