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

#ifndef LMP_MEMBRANE_MOLECULE_TORSIONS_H
#define LMP_MEMBRANE_MOLECULE_TORSIONS_H

#include "membrane_molecule_patch.h"

#include <vector>

namespace Membrane_NS {

/// A bond about which a part of a lipid turns.
struct Torsion {
  int before, from, to, after;    ///< atoms of its dihedral angle; `from` and `to` are bonded
  std::vector<int> turning;       ///< atoms beyond `to`, no more than half of the lipid
  std::vector<double> seen;       ///< its angles in the patch, sorted, in (-pi, pi]

  double angle(const std::vector<Eigen::Vector3d> &x) const;
  /// Turns what is beyond the bond, so that angle() grows by `by`. Returns how far the farthest atom went.
  double turn(double by, std::vector<Eigen::Vector3d> &x) const;
  /// How far an angle is from the nearest that was seen, in (-pi, pi].
  double off(double angle) const;
};

/** What lipids of a species can do beside moving as a whole: turn about bonds that are in no ring. Lengths and angles
    of bonds and handedness stay. Bonds whose dihedral angle is much the same in all lipids of the patch (double
    bonds, esters) do not turn. */
struct LipidTorsions {
  std::vector<Torsion> torsions;
  std::vector<char> apart;    ///< [atoms, atoms]: more than three bonds from one another

  /// No torsions where no bonds are known.
  LipidTorsions(const PatchLipids &library, int species);
};

/// By pairs of kinds, the closest distance of two atoms of one lipid that are more than three bonds apart; infinite
/// for pairs not seen.
std::vector<double> closest_within(const PatchLipids &library, const std::vector<LipidTorsions> &torsions);

}    // namespace Membrane_NS

#endif
