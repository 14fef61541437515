/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

#ifndef LMP_MEMBRANE_MOLECULE_OUTPUT_H
#define LMP_MEMBRANE_MOLECULE_OUTPUT_H

#include "membrane_molecule_build.h"

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace Membrane_NS {

/// A file that is written under another name until all is well.
class OutputFile {
 public:
  explicit OutputFile(const std::string &path);
  ~OutputFile();
  OutputFile(const OutputFile &) = delete;
  OutputFile &operator=(const OutputFile &) = delete;

  void print(const char *format, ...)
#if defined(__GNUC__)
      __attribute__((format(printf, 2, 3)))
#endif
      ;
  /// All is on disk, or MoleculeError.
  void finish();
  /// The file gets its name. After finish() of all files of a set.
  void take_name();
  const std::string &path() const { return path_; }

 private:
  const std::string path_, temporary_;
  std::FILE *file_;
  bool ended_ = false;
  [[noreturn]] void fail() const;
};

// === Writers
// Lengths in Angstrom, but in GRO files, where they are in nm. In PDB, mmCIF and GRO files the box begins at 0, as it
// does by definition; a LAMMPS data file has it where the simulation has it. Residues are numbered from 1
// through all lipids; proteins keep numbers and chains of their files.

/// Hybrid-36 numbers for serials beyond 99,999 and residues beyond 9,999. MoleculeError for coordinates that eight columns do
/// not hold. CONECT if there are bonds and no PSF file tells them.
void write_pdb(OutputFile &, const Structure &);
void write_mmcif(OutputFile &, const Structure &);
void write_gro(OutputFile &, const Structure &);
/// EXT, X-PLOR.
void write_psf(OutputFile &, const Structure &);
/// The molecules in their order, as the section [ molecules ] of a GROMACS topology.
void write_topology(OutputFile &, const Structure &);
/// Atom style full: bonds, angles, dihedrals and impropers of PSF files, or bonds of CONECT. Types are in comments.
void write_lammps_data(OutputFile &, const Structure &);

/// The number in hybrid-36 with so many columns (4 or 5); beyond what that holds, stars.
std::string hybrid36(long number, int columns);

/// What a structure's atoms are called, one after another.
class AtomNames {
 public:
  explicit AtomNames(const Structure &structure) : structure_(structure) {}
  /// Calls f(index of the atom, atom of its species, number of its residue, chain, molecule) in order.
  template <class F> void each(F &&f) const;

 private:
  const Structure &structure_;
};

/* ---------------------------------------------------------------------- */

template <class F> void AtomNames::each(F &&f) const
{
  int residue = 0;
  size_t leaflets = 0, last = structure_.groups.size();
  char chain = 'A';
  for (size_t m = 0; m < structure_.molecules.size(); ++m) {
    const auto &molecule = structure_.molecules[m];
    const auto &atoms = structure_.species_of(molecule).atoms;
    const bool is_protein = structure_.groups[molecule.group].membrane == 0;
    if (!is_protein && static_cast<size_t>(molecule.group) != last) {
      last = molecule.group;
      chain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"[leaflets++ % 52];
    }
    for (size_t k = 0; k < atoms.size(); ++k)
      f(molecule.atom + static_cast<int>(k), atoms[k],
        is_protein ? atoms[k].number : residue + 1 + atoms[k].residue_index, is_protein ? atoms[k].chain : chain,
        static_cast<int>(m));
    if (!is_protein) residue += 1 + atoms.back().residue_index;
  }
}

}    // namespace Membrane_NS

#endif
