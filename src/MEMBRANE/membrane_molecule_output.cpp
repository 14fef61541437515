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

#include "membrane_molecule_output.h"

#include <cerrno>
#include <cmath>
#include <cstdarg>
#include <cstring>

using namespace Membrane_NS;
using Eigen::Vector3d;

/* ---------------------------------------------------------------------- */

OutputFile::OutputFile(const std::string &path) :
    path_(path), temporary_(path + ".part"), file_(std::fopen(temporary_.c_str(), "wb"))
{
  if (!file_) fail();
}

OutputFile::~OutputFile()
{
  if (file_) std::fclose(file_);
  if (!ended_) std::remove(temporary_.c_str());
}

void OutputFile::fail() const
{
  throw MoleculeError("cannot write " + path_ + ": " + std::strerror(errno ? errno : EIO) +
                      "; nothing was written: check the folder and the room in it");
}

void OutputFile::print(const char *format, ...)
{
  va_list arguments;
  va_start(arguments, format);
  errno = 0;
  const int done = std::vfprintf(file_, format, arguments);
  va_end(arguments);
  if (done < 0) fail();
}

void OutputFile::finish()
{
  errno = 0;
  const bool full = std::fflush(file_) != 0 || std::ferror(file_);
  const int error = errno;
  const bool closed = std::fclose(file_) == 0;
  file_ = nullptr;
  if (full) errno = error;
  if (full || !closed) fail();
}

void OutputFile::take_name()
{
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail();
  ended_ = true;
}

/* ----------------------------------------------------------------------
   Hybrid-36 [cci.lbl.gov/hybrid_36]: decimal, then base 36 with upper-case letters, the first from A on, then with
   lower-case ones
------------------------------------------------------------------------- */

std::string Membrane_NS::hybrid36(long number, int columns)
{
  long decimal = 1, block = 26;
  for (int k = 0; k < columns; ++k) decimal *= 10;
  for (int k = 1; k < columns; ++k) block *= 36;
  char text[32];
  if (number < decimal) {
    std::snprintf(text, sizeof(text), "%*ld", columns, number);
    return text;
  }
  number -= decimal;
  if (number >= 2 * block) return std::string(columns, '*');
  const char *digits =
      number < block ? "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ" : "0123456789abcdefghijklmnopqrstuvwxyz";
  number = number % block + 10 * (block / 26);
  std::string word(columns, ' ');
  for (int k = columns - 1; k >= 0; --k, number /= 36) word[k] = digits[number % 36];
  return word;
}

namespace {

struct Cell {
  double length[3], angle[3];    // alpha, beta, gamma in degrees
};

Cell cell_of(const Structure &structure)
{
  Cell cell;
  const auto &lattice = structure.lattice;
  for (int k = 0; k < 3; ++k) {
    cell.length[k] = lattice.col(k).norm();
    const Vector3d a = lattice.col((k + 1) % 3).normalized(), b = lattice.col((k + 2) % 3).normalized();
    cell.angle[k] = a.dot(b) == 0.0 ? 90.0 : std::acos(a.dot(b)) * 180.0 / M_PI;
  }
  return cell;
}

std::string upper(std::string word)
{
  for (char &c : word) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return word;
}

// Names begin in the second of four columns, but for elements of two letters and names of four

std::string pdb_name(const MoleculeAtom &atom)
{
  const std::string name = atom.name.substr(0, 4);
  return name.size() < 4 && atom.element.size() < 2 ? " " + name : name;
}

}    // namespace

/* ---------------------------------------------------------------------- */

void Membrane_NS::write_pdb(OutputFile &file, const Structure &structure)
{
  const Cell cell = cell_of(structure);
  file.print("CRYST1%9.3f%9.3f%9.3f%7.2f%7.2f%7.2f P 1           1\n", cell.length[0], cell.length[1], cell.length[2],
             cell.angle[0], cell.angle[1], cell.angle[2]);
  for (const Vector3d &x : structure.x)
    for (int k = 0; k < 3; ++k)
      if (const double at = x[k] - structure.origin[k]; !(at < 9999.9995 && at > -999.9995))
        throw MoleculeError("a coordinate, " + std::to_string(at) +
                            ", does not fit into a PDB file: write cif, gro or data in its place");
  long serial = 0;
  int last = -1;
  char last_chain = ' ';
  AtomNames(structure).each([&](int i, const MoleculeAtom &atom, int residue, char chain, int molecule) {
    const bool next_group = last >= 0 && structure.molecules[last].group != structure.molecules[molecule].group;
    if (next_group) file.print("TER\n");
    last = molecule;
    last_chain = chain;
    const Vector3d x = structure.x[i] - structure.origin;
    std::string name = atom.residue.substr(0, 4);
    if (name.size() < 4) name = std::string(3 - std::min<size_t>(3, name.size()), ' ') + name;
    file.print("ATOM  %s %-4s %-4s%c%s%c   %8.3f%8.3f%8.3f  1.00  0.00      %-4s%2s\n", hybrid36(++serial, 5).c_str(),
               pdb_name(atom).c_str(), name.c_str(), chain, hybrid36(residue, 4).c_str(), atom.insertion, x[0], x[1], x[2],
               atom.segment.substr(0, 4).c_str(), upper(atom.element).c_str());
  });
  file.print("TER\n");
  if (!structure.has_terms)
    for (const auto &molecule : structure.molecules) {
      const auto &bonds = structure.species_of(molecule).terms[BOND];
      for (size_t b = 0; b < bonds.size(); b += 2)
        file.print("CONECT%s%s\n", hybrid36(molecule.atom + bonds[b] + 1, 5).c_str(),
                   hybrid36(molecule.atom + bonds[b + 1] + 1, 5).c_str());
    }
  file.print("END\n");
}

void Membrane_NS::write_mmcif(OutputFile &file, const Structure &structure)
{
  const Cell cell = cell_of(structure);
  file.print("data_membrane\n#\n");
  const char *axis[3] = {"a", "b", "c"}, *angle[3] = {"alpha", "beta", "gamma"};
  for (int k = 0; k < 3; ++k) file.print("_cell.length_%s %.4f\n", axis[k], cell.length[k]);
  for (int k = 0; k < 3; ++k) file.print("_cell.angle_%s %.4f\n", angle[k], cell.angle[k]);
  file.print("_symmetry.space_group_name_H-M 'P 1'\n#\nloop_\n");
  for (const char *column : {"group_PDB", "id", "type_symbol", "label_atom_id", "label_alt_id", "label_comp_id", "label_asym_id",
                             "label_entity_id", "label_seq_id", "Cartn_x", "Cartn_y", "Cartn_z", "occupancy", "B_iso_or_equiv",
                             "auth_seq_id", "auth_asym_id", "pdbx_PDB_model_num"})
    file.print("_atom_site.%s\n", column);
  auto word = [](const std::string &name) -> std::string {
    if (name.empty()) return ".";
    if (name.find_first_of("'\"#;_[]$ ") == std::string::npos) return name;
    return name.find('"') == std::string::npos ? '"' + name + '"' : '\'' + name + '\'';
  };
  AtomNames(structure).each([&](int i, const MoleculeAtom &atom, int residue, char chain, int molecule) {
    const Vector3d x = structure.x[i] - structure.origin;
    const char chain_of = chain == ' ' ? 'X' : chain;
    file.print("HETATM %d %s %s . %s %c %d . %.4f %.4f %.4f 1.00 0.00 %d %c 1\n", i + 1,
               atom.element.empty() ? "X" : upper(atom.element).c_str(), word(atom.name).c_str(), word(atom.residue).c_str(),
               chain_of, structure.molecules[molecule].species + 1, x[0], x[1], x[2], residue, chain_of);
  });
  file.print("#\n");
}

void Membrane_NS::write_gro(OutputFile &file, const Structure &structure)
{
  file.print("membrane\n%zu\n", structure.x.size());
  AtomNames(structure).each([&](int i, const MoleculeAtom &atom, int residue, char, int) {
    const Vector3d x = 0.1 * (structure.x[i] - structure.origin);
    file.print("%5d%-5s%5s%5d%8.3f%8.3f%8.3f\n", residue % 100000, atom.residue.substr(0, 5).c_str(),
               atom.name.substr(0, 5).c_str(), (i + 1) % 100000, x[0], x[1], x[2]);
  });
  const Eigen::Matrix3d h = 0.1 * structure.lattice;
  file.print("%10.5f%10.5f%10.5f", h(0, 0), h(1, 1), h(2, 2));
  if (h(0, 1) != 0.0 || h(0, 2) != 0.0 || h(1, 2) != 0.0)
    file.print("%10.5f%10.5f%10.5f%10.5f%10.5f%10.5f", 0.0, 0.0, h(0, 1), 0.0, h(0, 2), h(1, 2));
  file.print("\n");
}

void Membrane_NS::write_psf(OutputFile &file, const Structure &structure)
{
  long counts[TERM_KINDS] = {};
  for (const auto &molecule : structure.molecules)
    for (int kind = 0; kind < TERM_KINDS; ++kind)
      counts[kind] += structure.species_of(molecule).terms[kind].size() / TERM_ATOMS[kind];
  file.print("PSF EXT%s XPLOR\n\n%10d !NTITLE\n REMARKS LIPIDS ON A MEMBRANE\n\n%10zu !NATOM\n", counts[CROSSTERM] ? " CMAP" : "", 1,
             structure.x.size());
  AtomNames(structure).each([&](int i, const MoleculeAtom &atom, int residue, char chain, int) {
    const std::string segment = atom.segment.empty() ? std::string(1, chain == ' ' ? 'X' : chain) : atom.segment;
    const std::string type = atom.type.empty() ? atom.name : atom.type;
    file.print("%10d %-8s %-8d %-8s %-8s %-6s %13.6f %13.4f %11d\n", i + 1, segment.c_str(), residue, atom.residue.c_str(),
               atom.name.c_str(), type.c_str(), atom.charge, atom.mass, 0);
  });
  struct Section {
    TermKind kind;
    const char *word;
    int in_a_line;
  };
  constexpr Section SECTIONS[] = {{BOND, "!NBOND: bonds", 4},
                                  {ANGLE, "!NTHETA: angles", 3},
                                  {DIHEDRAL, "!NPHI: dihedrals", 2},
                                  {IMPROPER, "!NIMPHI: impropers", 2}};
  auto print = [&](const Section &section) {
    file.print("\n%10ld %s\n", counts[section.kind], section.word);
    int column = 0;
    for (const auto &molecule : structure.molecules)
      for (int i : structure.species_of(molecule).terms[section.kind]) {
        file.print("%10d", molecule.atom + i + 1);
        if (++column == section.in_a_line * TERM_ATOMS[section.kind]) {
          file.print("\n");
          column = 0;
        }
      }
    if (column) file.print("\n");
  };
  for (const Section &section : SECTIONS) print(section);
  for (const char *none : {"!NDON: donors", "!NACC: acceptors", "!NNB"}) file.print("\n%10d %s\n\n", 0, none);
  file.print("\n%10d%10d !NGRP NST2\n%10d%10d%10d\n", 1, 0, 0, 0, 0);
  if (counts[CROSSTERM]) print({CROSSTERM, "!NCRTERM: cross-terms", 1});
}

void Membrane_NS::write_topology(OutputFile &file, const Structure &structure)
{
  file.print("; for a GROMACS topology: molecules in the order of the coordinates\n[ molecules ]\n");
  for (size_t m = 0; m < structure.molecules.size();) {
    const auto &first = structure.molecules[m];
    const auto &group = structure.groups[first.group];
    if (m == 0 || structure.molecules[m - 1].group != first.group) {
      if (group.membrane)
        file.print("; %s of membrane %lld\n", group.what.c_str(), group.membrane);
      else
        file.print("; %s\n", group.what.c_str());
    }
    size_t count = 0;
    while (m < structure.molecules.size() && structure.molecules[m].species == first.species &&
           structure.molecules[m].group == first.group) {
      ++m;
      ++count;
    }
    file.print("%-12s %zu\n", structure.species_of(first).name.c_str(), count);
  }
}
