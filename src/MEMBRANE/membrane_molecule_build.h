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

#ifndef LMP_MEMBRANE_MOLECULE_BUILD_H
#define LMP_MEMBRANE_MOLECULE_BUILD_H

#include "membrane_molecule_composition.h"

#include <memory>
#include <string>
#include <vector>

namespace Membrane_NS {

/// A molecule that is put where it is told, under which there are no lipids.
struct PlacedProtein {
  std::shared_ptr<const MoleculeFile> molecule;
  Eigen::Vector3d origin;    ///< where the origin of its file goes
  Eigen::Matrix3d frame;     ///< columns are where the axes of its file go, a rotation
};

/// Numbers of lipids, [part][leaflet][species].
using LipidNumbers = std::vector<std::array<std::vector<int>, LEAFLETS>>;

/** round(area / area per lipid) on the neutral surface of each leaflet, in the proportions of its patch; what
    does not come out whole goes to the largest remainders. */
LipidNumbers numbers_from_patch(const std::vector<ParallelSurfaces> &parts, const LeafletPatches &patches,
                                const PatchLipids &library);

/// The same with the proportions and areas of lipids on faces.
LipidNumbers numbers_from_faces(const std::vector<ParallelSurfaces> &parts, const std::vector<MembranePart> &membranes,
                                const LeafletPatches &patches, const FaceComposition &composition);

/// All molecules of a structure, in the order in which they are written.
struct Structure {
  std::vector<LipidSpecies> species;    ///< of lipids and proteins
  struct Molecule {
    int species, group, atom;    ///< atom: its first
  };
  struct Group {                 ///< a leaflet of a membrane, or a protein
    std::string what;
    long long membrane;
  };
  std::vector<Molecule> molecules;
  std::vector<Group> groups;
  std::vector<Eigen::Vector3d> x;    ///< molecules whole, centres in the box
  Eigen::Matrix3d lattice;
  Eigen::Vector3d origin;            ///< a corner of the box
  std::array<bool, 3> periodic;
  bool has_terms = false;            ///< from PSF files

  const LipidSpecies &species_of(const Molecule &molecule) const { return species[molecule.species]; }
  double charge() const;
};

/// What came of it.
struct BuildReport {
  LipidNumbers numbers;
  std::vector<std::array<double, LEAFLETS>> areas;    ///< of neutral surfaces, by part
  std::vector<std::array<double, LEAFLETS>> asked;    ///< lipids that these have room for
  bool exact = false;                                 ///< copies of the patch on planes: nothing was moved
  int clashes_before = 0, clashes = 0;                ///< lipids, see LipidCrowd::Report
  double closest = 0.0;
  int pierced = 0, freed = 0;                         ///< rings
  int displaced = 0;                                  ///< lipids by proteins
  std::vector<std::string> clashing;                  ///< some of them, by name and place
};

/** Lays lipids on the surfaces, brings them to the numbers, and relaxes them. All is the same for any team.
    origin: the corner of the box, which the limit surface does not know.
    composition: if given, which lipids there are where, in place of those of the patch.
    Throws MoleculeError where the surface is curved too much for the thickness of a patch. */
Structure build_structure(const LimitSurface &surface, const Eigen::Vector3d &origin,
                          const std::vector<MembranePart> &membranes, const LeafletPatches &patches, PatchLipids &library,
                          const std::vector<PlacedProtein> &proteins, const FaceComposition *composition, uint64_t seed,
                          Team &team, BuildReport &report);

}    // namespace Membrane_NS

#endif
