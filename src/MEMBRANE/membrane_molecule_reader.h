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

#ifndef LMP_MEMBRANE_MOLECULE_READER_H
#define LMP_MEMBRANE_MOLECULE_READER_H

#include "membrane_molecule.h"

namespace Membrane_NS {

/// Whether the package was compiled with gemmi (https://gemmi.readthedocs.io), which reads the files.
bool can_read_molecules();

/** Atoms, cell and bonds of a PDB file, or an mmCIF file if the name ends in .cif or .mmcif.

    PDB: of several models the first; of alternate places of an atom the first; hybrid-36 numbers; names of
    residues of four letters, which end in column 21; columns 73 to 76 are the segment. A residue ends where its
    name, number, insertion code, chain or segment changes, at TER, and where a name of an atom occurs
    again. CONECT gives bonds.
    Throws MoleculeError: no such file, no atoms, lines that end early or have no numbers. */
MoleculeFile read_molecules(const std::string &path);

/** Names, types, charges, masses and bonds of a PSF file (X-PLOR or CHARMM, EXT or not), which take precedence.
    Throws MoleculeError if the files disagree. */
void read_psf(const std::string &path, MoleculeFile &molecules);

}    // namespace Membrane_NS

#endif
