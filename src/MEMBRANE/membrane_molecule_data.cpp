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

// LAMMPS data files

#include "membrane_molecule_output.h"

#include <algorithm>
#include <cmath>
#include <map>

using namespace Membrane_NS;
using Eigen::Vector3d;

namespace {

using Key = std::vector<std::string>;

/// Numbers of types by the names of their atoms; those of bonds, angles and dihedrals read both ways.
class Types {
 public:
  int number(Key key, bool both_ways)
  {
    Key back(key.rbegin(), key.rend());
    if (both_ways && back < key) key = back;
    const auto [entry, is_new] = numbers_.try_emplace(key, static_cast<int>(names_.size()) + 1);
    if (is_new) names_.push_back(key);
    return entry->second;
  }
  const std::vector<Key> &names() const { return names_; }

 private:
  std::map<Key, int> numbers_;
  std::vector<Key> names_;
};

const std::string &type_of(const MoleculeAtom &atom)
{
  return atom.type.empty() ? atom.name : atom.type;
}

std::string joined(const Key &key)
{
  std::string text;
  for (const std::string &word : key) text += (text.empty() ? "" : " ") + word;
  return text;
}

constexpr struct {
  TermKind kind;
  const char *word, *plural, *title;
} KINDS[] = {{BOND, "bond", "bonds", "Bonds"},
             {ANGLE, "angle", "angles", "Angles"},
             {DIHEDRAL, "dihedral", "dihedrals", "Dihedrals"},
             {IMPROPER, "improper", "impropers", "Impropers"}};

}    // namespace

/* ----------------------------------------------------------------------
   Atoms are wrapped along periodic directions, with image flags. Along others the box has room for all.
------------------------------------------------------------------------- */

void Membrane_NS::write_lammps_data(OutputFile &file, const Structure &structure)
{
  // types of species, once each

  Types atom_types, types[TERM_KINDS];
  std::vector<double> mass;
  std::vector<std::vector<int>> atom_type(structure.species.size());
  std::vector<std::array<std::vector<int>, TERM_KINDS>> term_type(structure.species.size());
  std::vector<char> used(structure.species.size(), 0);
  for (const auto &molecule : structure.molecules) used[molecule.species] = 1;
  for (size_t s = 0; s < structure.species.size(); ++s) {
    if (!used[s]) continue;
    const LipidSpecies &species = structure.species[s];
    for (const MoleculeAtom &atom : species.atoms) {
      const int type = atom_types.number({type_of(atom)}, false);
      atom_type[s].push_back(type);
      mass.resize(std::max<size_t>(mass.size(), type), 0.0);
      if (atom.mass > 0.0) mass[type - 1] = atom.mass;
    }
    for (const auto &kind : KINDS) {
      const auto &terms = species.terms[kind.kind];
      for (size_t t = 0; t < terms.size(); t += TERM_ATOMS[kind.kind]) {
        Key key;
        for (int k = 0; k < TERM_ATOMS[kind.kind]; ++k) key.push_back(type_of(species.atoms[terms[t + k]]));
        term_type[s][kind.kind].push_back(types[kind.kind].number(key, kind.kind != IMPROPER));
      }
    }
  }
  long counts[TERM_KINDS] = {};
  for (const auto &molecule : structure.molecules)
    for (const auto &kind : KINDS)
      counts[kind.kind] += structure.species_of(molecule).terms[kind.kind].size() / TERM_ATOMS[kind.kind];

  // the box

  const Eigen::Matrix3d &h = structure.lattice, inverse = h.inverse();
  Vector3d low = structure.origin, high = low + Vector3d(h.diagonal());
  const bool tilted = h(0, 1) != 0.0 || h(0, 2) != 0.0 || h(1, 2) != 0.0;
  for (int k = 0; k < 3; ++k)
    for (const Vector3d &x : structure.x) {
      if (structure.periodic[k]) break;
      low[k] = std::min(low[k], x[k] - 1.0);
      high[k] = std::max(high[k], x[k] + 1.0);
    }

  file.print("LAMMPS data file: lipids on a membrane, lengths in Angstrom, atom style full\n\n%zu atoms\n", structure.x.size());
  for (const auto &kind : KINDS)
    if (counts[kind.kind]) file.print("%ld %s\n", counts[kind.kind], kind.plural);
  file.print("%zu atom types\n", atom_types.names().size());
  for (const auto &kind : KINDS)
    if (counts[kind.kind]) {
      file.print("%zu %s types", types[kind.kind].names().size(), kind.word);
      for (size_t t = 0; t < types[kind.kind].names().size(); ++t)
        file.print("%s%zu = %s", t ? ", " : " # ", t + 1, joined(types[kind.kind].names()[t]).c_str());
      file.print("\n");
    }
  file.print("\n");
  for (int k = 0; k < 3; ++k) file.print("%.10g %.10g %clo %chi\n", low[k], high[k], "xyz"[k], "xyz"[k]);
  if (tilted) file.print("%.10g %.10g %.10g xy xz yz\n", h(0, 1), h(0, 2), h(1, 2));
  file.print("\nMasses\n\n");
  for (size_t t = 0; t < mass.size(); ++t)
    file.print("%zu %.6g # %s\n", t + 1, mass[t] > 0.0 ? mass[t] : 1.0, atom_types.names()[t][0].c_str());

  file.print("\nAtoms # full\n\n");
  AtomNames(structure).each([&](int i, const MoleculeAtom &atom, int, char, int molecule) {
    const auto &one = structure.molecules[molecule];
    const Vector3d fraction = inverse * (structure.x[i] - structure.origin);
    Vector3d turns;
    for (int k = 0; k < 3; ++k) turns[k] = structure.periodic[k] ? std::floor(fraction[k]) : 0.0;
    const Vector3d x = structure.x[i] - h * turns;
    file.print("%d %d %d %.6g %.6f %.6f %.6f %d %d %d\n", i + 1, molecule + 1, atom_type[one.species][i - one.atom],
               atom.charge, x[0], x[1], x[2], (int) turns[0], (int) turns[1], (int) turns[2]);
  });

  for (const auto &kind : KINDS) {
    if (!counts[kind.kind]) continue;
    file.print("\n%s\n\n", kind.title);
    long number = 0;
    for (const auto &molecule : structure.molecules) {
      const auto &terms = structure.species_of(molecule).terms[kind.kind];
      for (size_t t = 0; t < terms.size(); t += TERM_ATOMS[kind.kind]) {
        file.print("%ld %d", ++number, term_type[molecule.species][kind.kind][t / TERM_ATOMS[kind.kind]]);
        for (int k = 0; k < TERM_ATOMS[kind.kind]; ++k) file.print(" %d", molecule.atom + terms[t + k] + 1);
        file.print("\n");
      }
    }
  }
}
