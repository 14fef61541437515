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

#include "membrane_molecule_reader.h"

#if defined(MEMBRANE_GEMMI)
#include <gemmi/cif.hpp>
#include <gemmi/mmcif.hpp>
#include <gemmi/pdb.hpp>
#endif

#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

using namespace Membrane_NS;

#if defined(MEMBRANE_GEMMI)
namespace {

std::string content_of(const std::string &path)
{
  std::ifstream file(path, std::ios::binary);
  std::stringstream content;
  if (!file || !(content << file.rdbuf()))
    throw MoleculeError("cannot read " + path + ": check its name, or whether it is empty");
  return content.str();
}

std::string trimmed(const std::string &line, size_t first, size_t length)
{
  if (line.size() <= first) return "";
  std::string word = line.substr(first, length);
  const size_t begin = word.find_first_not_of(" \t"), end = word.find_last_not_of(" \t");
  return begin == std::string::npos ? "" : word.substr(begin, end - begin + 1);
}

bool is_number(const std::string &word)
{
  char *end;
  const double value = std::strtod(word.c_str(), &end);
  return !word.empty() && *end == '\0' && std::isfinite(value);
}

/* ----------------------------------------------------------------------
   Lines of a PDB file on their way to gemmi. This takes names of residues as three letters, the column
   after them as the chain, and residues with the same number as one. Files of lipids have names of four
   letters, and far more residues than numbers. So residues are counted here, gemmi gets the count, and
   what stood there is kept beside it.
------------------------------------------------------------------------- */

class ResidueCounter {
 public:
  ResidueCounter(const std::string &path, const std::string &content) : path_(path), in_(content) {}

  struct Residue {
    std::string name, segment;
    int number;
    char chain, insertion;
  };
  std::vector<Residue> residues;
  std::vector<std::vector<std::string>> conect;    // serials, in the words of the file
  std::vector<std::string> serials;                // of the atoms of the first model
  std::vector<char> has_element;                   // in columns 77 and 78
  int models = 0;
  bool has_cell = false;

  // what gemmi calls

  char *gets(char *line, int size)
  {
    std::string text;
    do {
      if (!std::getline(in_, text)) return nullptr;
      ++number_;
      if (!text.empty() && text.back() == '\r') text.pop_back();
    } while (!pass(text));
    std::snprintf(line, size, "%.*s\n", size - 2, text.c_str());
    return line;
  }
  int getc() { return EOF; }

 private:
  const std::string path_;
  std::istringstream in_;
  long number_ = 0;
  bool first_model_ = true;
  std::string last_;                // what tells residues apart
  std::set<std::string> names_;     // atoms of this residue

  [[noreturn]] void fail(const std::string &problem) const
  {
    throw MoleculeError(path_ + ", line " + std::to_string(number_) + ": " + problem);
  }

  // whether gemmi is to see the line, which may be changed

  bool pass(std::string &text)
  {
    std::string record = trimmed(text, 0, 6);
    for (char &c : record) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    if (record == "MODEL") ++models;
    if (record == "ENDMDL") first_model_ = false;
    if (record == "TER") last_.clear();
    if (record == "CRYST1") {
      has_cell = true;
      for (int k = 0; k < 3; ++k)
        if (!is_number(trimmed(text, 6 + 9 * k, 9)) || !is_number(trimmed(text, 33 + 7 * k, 7)))
          fail("CRYST1 needs three lengths and three angles; the line may be cut short");
    }
    if (record == "CONECT") {
      std::vector<std::string> numbers;
      for (size_t c = 6; c < 31 && c < text.size(); c += 5)
        if (const std::string word = trimmed(text, c, 5); !word.empty()) numbers.push_back(word);
      conect.push_back(numbers);
    }
    if (record == "ATOM" || record == "HETATM") {
      if (!first_model_) return false;
      count(text);
      return true;
    }
    // a residue goes on over lines of other kinds; of these gemmi need not know but the cell
    return record == "CRYST1" || record == "END";
  }

  void count(std::string &text)
  {
    if (text.size() < 54) fail("the line ends before column 54, where coordinates end; the file may be cut short");
    for (int k = 0; k < 3; ++k)
      if (!is_number(trimmed(text, 30 + 8 * k, 8)))
        fail("there is no number for " + std::string(1, "xyz"[k]) + " in columns " + std::to_string(31 + 8 * k) + " to " +
             std::to_string(38 + 8 * k) + "; the line may be cut short");
    text.resize(std::max<size_t>(text.size(), 80), ' ');
    const std::string segment = trimmed(text, 72, 4);
    const std::string key = text.substr(17, 10) + segment, name = text.substr(12, 5);
    if (key != last_ || residues.empty() || !names_.insert(name).second) {
      last_ = key;
      names_ = {name};
      const std::string digits = trimmed(text, 22, 4);
      const bool plain = digits.find_first_not_of("-0123456789") == std::string::npos;
      if (digits.empty() || (!plain && digits.size() < 4))
        fail("the number of the residue, " + (digits.empty() ? "which is missing," : digits) + " is none");
      const int value = plain ? std::atoi(digits.c_str())
                              : static_cast<int>(std::strtol(digits.c_str(), nullptr, 36)) - 466560 + 10000;
      residues.push_back({trimmed(text, 17, 4), segment, value, text[21], text[26]});
      if (residues.back().name.empty()) fail("the residue has no name in columns 18 to 21");
    }
    serials.push_back(trimmed(text, 6, 5));
    has_element.push_back(std::isalpha(static_cast<unsigned char>(text[76])) ||
                          std::isalpha(static_cast<unsigned char>(text[77])));

    // hybrid-36 is what gemmi reads; all in one chain

    std::string tag = "LIP A0000 ";
    long n = static_cast<long>(residues.size());
    const int base = n > 9999 ? 36 : 10;
    if (n > 9999) n += 466560 - 10000;
    for (int k = 8; k > 4; --k, n /= base) tag[k] = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ"[n % base];
    text.replace(17, 10, tag);
    text.replace(72, 4, "    ");
  }
};

/* ----------------------------------------------------------------------
   The first of alternate places of an atom. gemmi makes an element of any name, of beads as well: only what the
   file says counts. taken: for each atom of the file its index, or -1.
------------------------------------------------------------------------- */

void take_atoms(const gemmi::Residue &residue, MoleculeFile &file, const MoleculeAtom &as,
                std::vector<int> *taken = nullptr, const std::vector<char> *has_element = nullptr)
{
  std::set<std::string> seen;
  for (const gemmi::Atom &atom : residue.atoms) {
    if (atom.altloc != '\0' && !seen.insert(atom.name).second) {
      if (taken) taken->push_back(-1);
      continue;
    }
    MoleculeAtom one = as;
    one.name = atom.name;
    if ((!has_element || (*has_element)[taken->size()]) && atom.element != gemmi::El::X) {
      one.element = atom.element.name();
      one.mass = atom.element.weight();
    }
    if (taken) taken->push_back(static_cast<int>(file.atoms.size()));
    file.atoms.push_back(one);
    file.x.emplace_back(atom.pos.x, atom.pos.y, atom.pos.z);
  }
}

void take_cell(const gemmi::UnitCell &cell, MoleculeFile &file)
{
  const double lengths[3] = {cell.a, cell.b, cell.c}, angles[3] = {cell.alpha, cell.beta, cell.gamma};
  for (int k = 0; k < 3; ++k) {
    file.lengths[k] = lengths[k];
    file.angles[k] = angles[k];
  }
}

MoleculeFile read_pdb(const std::string &path)
{
  ResidueCounter lines(path, content_of(path));
  gemmi::Structure structure;
  try {
    structure = gemmi::pdb_impl::read_pdb_from_stream(lines, path, gemmi::PdbReadOptions());
  } catch (const MoleculeError &) {
    throw;
  } catch (const std::exception &err) {
    throw MoleculeError(path + ": " + std::string(err.what()).substr(0, 120));
  }
  MoleculeFile file;
  file.path = path;
  std::vector<int> taken;
  for (const auto &chain : structure.models[0].chains)
    for (const auto &residue : chain.residues) {
      const auto &said = lines.residues.at(*residue.seqid.num - 1);
      MoleculeAtom as;
      as.residue = said.name;
      as.segment = said.segment;
      as.number = said.number;
      as.chain = said.chain;
      as.insertion = said.insertion;
      as.residue_index = *residue.seqid.num - 1;
      take_atoms(residue, file, as, &taken, &lines.has_element);
    }
  if (file.atoms.size() < taken.size())
    file.notes.push_back("of atoms with alternate places the first is taken");
  if (lines.models > 1) file.notes.push_back("of " + std::to_string(lines.models) + " models the first is taken");
  if (lines.has_cell) take_cell(structure.cell, file);

  // serials that occur twice do not tell which atoms are bonded

  std::map<std::string, int> atom_of;
  bool unique = true;
  for (size_t i = 0; i < taken.size(); ++i) unique &= atom_of.try_emplace(lines.serials[i], taken[i]).second;
  if (!unique && !lines.conect.empty()) {
    file.notes.push_back("CONECT is left out, since numbers of atoms occur twice");
    return file;
  }
  std::set<std::pair<int, int>> bonds;
  for (const auto &numbers : lines.conect) {
    const auto first = numbers.empty() ? atom_of.end() : atom_of.find(numbers[0]);
    if (first == atom_of.end() || first->second < 0) continue;
    for (size_t k = 1; k < numbers.size(); ++k) {
      const auto other = atom_of.find(numbers[k]);
      if (other != atom_of.end() && other->second >= 0 && other->second != first->second)
        bonds.insert(std::minmax(first->second, other->second));
    }
  }
  for (const auto &bond : bonds) {
    file.terms[BOND].push_back(bond.first);
    file.terms[BOND].push_back(bond.second);
  }
  return file;
}

MoleculeFile read_mmcif(const std::string &path)
{
  gemmi::Structure structure;
  try {
    const std::string content = content_of(path);
    auto document = gemmi::cif::read_memory(content.c_str(), content.size(), path.c_str());
    structure = gemmi::make_structure_from_block(document.sole_block());
  } catch (const MoleculeError &) {
    throw;
  } catch (const std::exception &err) {
    throw MoleculeError(path + ": " + std::string(err.what()).substr(0, 120));
  }
  MoleculeFile file;
  file.path = path;
  if (structure.models.empty()) return file;
  if (structure.models.size() > 1)
    file.notes.push_back("of " + std::to_string(structure.models.size()) + " models the first is taken");
  take_cell(structure.cell, file);
  int count = 0;
  for (const auto &chain : structure.models[0].chains)
    for (const auto &residue : chain.residues) {
      MoleculeAtom as;
      as.residue = residue.name;
      as.segment = residue.segment;
      as.number = residue.seqid.num.has_value() ? *residue.seqid.num : count;
      as.chain = chain.name.empty() ? ' ' : chain.name[0];
      as.residue_index = count++;
      take_atoms(residue, file, as);
    }
  return file;
}

}    // namespace
#endif

/* ---------------------------------------------------------------------- */

#if defined(MEMBRANE_GEMMI)

bool Membrane_NS::can_read_molecules()
{
  return true;
}

MoleculeFile Membrane_NS::read_molecules(const std::string &path)
{
  std::string ending = path.substr(path.find_last_of("./") == std::string::npos ? 0 : path.find_last_of("./"));
  for (char &c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  MoleculeFile file = ending == ".cif" || ending == ".mmcif" ? read_mmcif(path) : read_pdb(path);
  if (file.atoms.empty()) throw MoleculeError(path + " has no atoms: is it a PDB or mmCIF file?");
  if (file.lengths[0] == 1.0 && file.lengths[1] == 1.0 && file.lengths[2] == 1.0)
    for (double &length : file.lengths) length = 0.0;    // what stands for "no crystal"
  return file;
}

#else

bool Membrane_NS::can_read_molecules()
{
  return false;
}

MoleculeFile Membrane_NS::read_molecules(const std::string &path)
{
  throw MoleculeError("cannot read " + path +
                      ": the package was compiled without gemmi; install gemmi-dev and tao-pegtl-dev, and compile it again");
}

#endif
