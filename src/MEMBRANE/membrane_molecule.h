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

#ifndef LMP_MEMBRANE_MOLECULE_H
#define LMP_MEMBRANE_MOLECULE_H

#include <Eigen/Dense>

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

namespace Membrane_NS {

/// Molecules, or a file of them, that cannot be used; what() names the thing and the cure.
class MoleculeError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An atom, or a bead of a coarse-grained model, as files name it.
struct MoleculeAtom {
  std::string name, residue, segment;
  std::string type;       ///< of a force field; empty if no PSF said it
  std::string element;    ///< as in the periodic table; empty if unknown
  int residue_index = 0;  ///< counts residues from 0, in the file or in the molecule
  int number = 0;         ///< of the residue in the file
  char chain = ' ', insertion = ' ';
  double charge = 0.0;    ///< elementary charges
  double mass = 0.0;      ///< g/mol; 0 if unknown
};

// === Bonds and what a force field makes of them

enum TermKind { BOND, ANGLE, DIHEDRAL, IMPROPER, CROSSTERM, TERM_KINDS };
constexpr int TERM_ATOMS[TERM_KINDS] = {2, 3, 4, 4, 8};

/// For each kind the indices of atoms, TERM_ATOMS[kind] of them a term.
using MoleculeTerms = std::array<std::vector<int>, TERM_KINDS>;

/// What a file of molecules says; lengths in Angstrom.
struct MoleculeFile {
  std::string path;
  std::vector<MoleculeAtom> atoms;
  std::vector<Eigen::Vector3d> x;
  MoleculeTerms terms;
  bool has_terms = false;    ///< a PSF gave them
  double lengths[3] = {0.0, 0.0, 0.0}, angles[3] = {90.0, 90.0, 90.0};    ///< of the cell; 0: none
  std::vector<std::string> notes;    ///< what was left out or taken in place of something
};

}    // namespace Membrane_NS

#endif
