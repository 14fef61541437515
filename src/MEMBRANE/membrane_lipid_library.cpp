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

#include "membrane_lipid_library.h"

#include "membrane_mesh_text.h"

#include <algorithm>
#include <cmath>

using namespace Membrane_NS;

/* ---------------------------------------------------------------------- */

static std::string in_words(const LipidKind &kind)
{
  std::string text = "area ";
  append_number(text, kind.area);
  text += " and curvature ";
  append_number(text, kind.c0);
  return text;
}

int LipidLibrary::add(const LipidKind &kind)
{
  if (!(kind.area > 0.0 && std::isfinite(kind.area)))
    throw LipidError("the area of lipid " + kind.name + " must be positive");
  if (!std::isfinite(kind.c0)) throw LipidError("the curvature of lipid " + kind.name + " must be finite");
  const int there = find(kind.name);
  if (there < 0) {
    kinds.push_back(kind);
    return size() - 1;
  }
  if (!kinds[there].same(kind))
    throw LipidError("lipid " + kind.name + " has " + in_words(kind) + " here but " + in_words(kinds[there]) +
                     " elsewhere: give it the same numbers, or another name");
  return there;
}

void LipidLibrary::read(const std::string &text, const std::string &path, double length)
{
  MeshText lines(path, text, '#');
  while (lines.next_line()) {
    const std::string where = "Lipid file " + path + ", line " + std::to_string(lines.line()) + ": ";
    LipidKind kind;
    if (lines.size() != 3 || !parse_number(lines[1], kind.area) || !parse_number(lines[2], kind.c0))
      throw LipidError(where + "a line has the name of a lipid, its area and its curvature");
    kind.name = std::string(lines[0]);
    kind.area *= length * length;
    kind.c0 /= length;
    try {
      add(kind);
    } catch (const LipidError &err) {
      throw LipidError(where + err.what());
    }
  }
}

int LipidLibrary::find(const std::string &name) const
{
  const auto found =
      std::find_if(kinds.begin(), kinds.end(), [&](const LipidKind &kind) { return kind.name == name; });
  return found == kinds.end() ? -1 : static_cast<int>(found - kinds.begin());
}

std::string LipidLibrary::names() const
{
  std::string all;
  for (const LipidKind &kind : kinds) all += (all.empty() ? "" : ", ") + kind.name;
  return all.empty() ? "none" : all;
}

/* ---------------------------------------------------------------------- */

void LeafletComposition::add(const LipidKind &named, int kind, double more)
{
  if (!(more >= 0.0 && std::isfinite(more)))
    throw LipidError("the parts of lipid " + named.name + " must not be negative");
  const auto found =
      std::find_if(parts.begin(), parts.end(), [&](const auto &part) { return part.first == kind; });
  if (found == parts.end())
    parts.push_back({kind, more});
  else
    found->second += more;
}

void LeafletComposition::normalize()
{
  double sum = 0.0;
  for (const auto &part : parts) sum += part.second;
  if (!(sum > 0.0 && std::isfinite(sum))) throw LipidError("the parts of a leaflet are all zero");
  for (auto &part : parts) part.second /= sum;
}

double LeafletComposition::area(const LipidLibrary &library) const
{
  double sum = 0.0;
  for (const auto &[kind, fraction] : parts) sum += fraction * library[kind].area;
  return sum;
}

double LeafletComposition::curvature(const LipidLibrary &library) const
{
  double sum = 0.0;
  for (const auto &[kind, fraction] : parts) sum += fraction * library[kind].area * library[kind].c0;
  return sum / area(library);
}
