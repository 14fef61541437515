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

// PSF files of CHARMM, NAMD and X-PLOR

#include "membrane_molecule_reader.h"

#include <cstdlib>
#include <fstream>
#include <sstream>

using namespace Membrane_NS;

namespace {

// Sections that are used, by the word that ends their first line; others are passed over.

struct Section {
  const char *word;
  TermKind kind;
};
constexpr Section SECTIONS[] = {{"!NBOND", BOND},
                                {"!NTHETA", ANGLE},
                                {"!NPHI", DIHEDRAL},
                                {"!NIMPHI", IMPROPER},
                                {"!NCRTERM", CROSSTERM}};

std::vector<std::string> words_of(const std::string &line)
{
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

bool number(const std::string &word, double &value)
{
  char *end;
  value = std::strtod(word.c_str(), &end);
  return !word.empty() && *end == '\0';
}

// A PDB file may have cut names short

bool agree(const std::string &psf, const std::string &pdb)
{
  return psf == pdb || (pdb.size() >= 3 && psf.compare(0, pdb.size(), pdb) == 0);
}

}    // namespace

/* ---------------------------------------------------------------------- */

void Membrane_NS::read_psf(const std::string &path, MoleculeFile &file)
{
  std::ifstream in(path);
  if (!in) throw MoleculeError("cannot read " + path + ": check its name");
  std::string line;
  long count = 0;
  auto next = [&]() {
    if (!std::getline(in, line)) return false;
    ++count;
    return true;
  };
  auto fail = [&](const std::string &problem) {
    throw MoleculeError(path + ", line " + std::to_string(count) + ": " + problem);
  };
  if (!next() || line.compare(0, 3, "PSF") != 0) fail("a PSF file begins with the word PSF");

  const int natoms = static_cast<int>(file.atoms.size());
  bool found = false;
  file.terms = MoleculeTerms();
  while (next()) {
    const auto head = words_of(line);
    if (head.size() < 2 || head[1][0] != '!') continue;
    std::string word = head[1];
    while (!word.empty() && word.back() == ':') word.pop_back();
    const int entries = std::atoi(head[0].c_str());
    if (word == "!NATOM") {
      found = true;
      if (entries != natoms)
        fail("it has " + std::to_string(entries) + " atoms, and " + file.path + " has " + std::to_string(natoms) +
             ": take the PSF of this structure");
      for (int i = 0; i < entries; ++i) {
        if (!next()) fail("the file ends after " + std::to_string(i) + " of " + std::to_string(entries) + " atoms");
        auto words = words_of(line);
        double value;
        if (words.size() == 8 && number(words[5], value) && number(words[6], value))
          words.insert(words.begin() + 1, "");    // no segment
        MoleculeAtom &atom = file.atoms[i];
        if (words.size() < 8 || !number(words[6], atom.charge) || !number(words[7], atom.mass))
          fail("an atom needs number, segment, residue number and name, name, type, charge and mass");
        if (!agree(words[4], atom.name) || !agree(words[3], atom.residue))
          fail("atom " + std::to_string(i + 1) + " is " + words[4] + " of " + words[3] + ", and in " + file.path + " " +
               atom.name + " of " + atom.residue + ": take the PSF of this structure");
        atom.segment = words[1];
        atom.residue = words[3];
        atom.name = words[4];
        atom.type = words[5];
      }
      continue;
    }
    for (const Section &section : SECTIONS) {
      if (word != section.word) continue;
      auto &terms = file.terms[section.kind];
      const size_t wanted = static_cast<size_t>(entries) * TERM_ATOMS[section.kind];
      while (terms.size() < wanted) {
        if (!next()) fail("the file ends within " + word.substr(1));
        for (const std::string &atom : words_of(line)) {
          const int i = std::atoi(atom.c_str()) - 1;
          if (i < 0 || i >= natoms) fail("there is no atom " + atom + " for " + word.substr(1));
          terms.push_back(i);
        }
      }
      if (terms.size() != wanted) fail("too many numbers for " + word.substr(1));
    }
  }
  if (!found) throw MoleculeError(path + " has no section !NATOM: is it a PSF file?");
  file.has_terms = true;
}
