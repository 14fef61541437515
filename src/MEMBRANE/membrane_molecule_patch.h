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

#ifndef LMP_MEMBRANE_MOLECULE_PATCH_H
#define LMP_MEMBRANE_MOLECULE_PATCH_H

#include "membrane_molecule.h"

#include <map>
#include <utility>

namespace Membrane_NS {

enum Leaflet { OUTER, INNER, LEAFLETS };    ///< of a patch: upper and lower
inline int sign_of(int leaflet) { return leaflet == OUTER ? 1 : -1; }

/// A kind of lipid: which atoms it has, and how they are bonded.
struct LipidSpecies {
  std::string name;                     ///< of its residues
  std::vector<MoleculeAtom> atoms;      ///< residue_index from 0
  MoleculeTerms terms;                  ///< in indices of these atoms
  std::vector<std::vector<int>> rings;  ///< of up to 8 bonds
  std::vector<int> kinds;               ///< of its atoms, see Contacts
};

/** A lipid as it stood in a patch, whole. Coordinates are from its centre, the mean of its atoms, in
    the frame of its leaflet: z outward; of the lower leaflet turned by 180 degrees about x, so that
    its handedness is kept. */
struct Conformer {
  int species;
  double lift;    ///< height of its centre above the neutral surface of its leaflet
  std::vector<Eigen::Vector3d> x;
};

/// How close atoms of different molecules come in the patches, by pairs of kinds: elements, or what atoms are called.
class Contacts {
 public:
  /// The number of a kind, by its name.
  int kind(const MoleculeAtom &);
  int kinds() const { return static_cast<int>(names_.size()); }
  const std::string &name(int kind) const { return names_[kind]; }
  /// The closest distance of two kinds; of pairs that never meet that of all.
  double closest(int a, int b) const { return closest_[a * kinds() + b]; }
  double closest() const { return least_; }
  double largest() const;
  void observe(int a, int b, double distance);
  /// To be called when all is observed. all > 0: what the closest distance is taken to be for all pairs.
  void settle(double all);

 private:
  std::vector<std::string> names_;
  std::map<std::pair<int, int>, double> seen_;
  std::vector<double> closest_;
  double least_ = 0.0;
};

/// The lipids that a structure is made of, of one patch or two.
struct PatchLipids {
  std::vector<LipidSpecies> species;
  std::vector<Conformer> conformers;
  std::vector<std::vector<int>> by_species;    ///< conformers
  Contacts contacts;
  double clash = 0.0;    ///< what the closest distance of all pairs is taken to be, in place of the patch's own
};

/// Where the lipids of a patch stand; its middle plane is at height 0.
struct Patch {
  std::string path;
  Eigen::Matrix2d cell;    ///< columns are its sides, the first along x
  /// For each leaflet: conformers, and their centres along the patch.
  std::vector<int> conformers[LEAFLETS];
  std::vector<Eigen::Vector2d> centres[LEAFLETS];
  double neutral[LEAFLETS];    ///< height of the neutral surface, positive: mean of the centres of lipids
  double head[LEAFLETS];       ///< mean height of the outermost atoms of lipids
  double charge = 0.0;
  std::vector<std::string> notes;

  double area() const { return cell.determinant(); }
  double area_per_lipid(int leaflet) const { return area() / conformers[leaflet].size(); }
  double edge() const { return std::min(cell.col(0).norm(), cell.col(1).norm()); }
};

/** Finds the lipids of a file and makes them whole across the box. What is bonded or in one residue is a
    molecule; water and ions are left out. Which leaflet a lipid is in is told by its height, and
    confirmed by its direction. flip: the patch is turned over, by 180 degrees about x.
    neutral > 0: the height of the neutral surfaces.
    Throws MoleculeError: no cell, an oblique one, a protein, lipids of one leaflet only. */
Patch make_patch(const MoleculeFile &file, bool flip, double neutral, PatchLipids &library);

/// Puts the atoms of one molecule next to each other, in images of a cell: along bonds, given as pairs of
/// indices, and what these do not reach next to the nearest atom.
void make_whole(const Eigen::Matrix3d &cell, const std::vector<int> &bonds, std::vector<Eigen::Vector3d> &x);

/// Rings of up to 8 bonds, the shortest through each bond; bonds in pairs of indices below natoms.
std::vector<std::vector<int>> find_rings(int natoms, const std::vector<int> &bonds);

}    // namespace Membrane_NS

#endif
