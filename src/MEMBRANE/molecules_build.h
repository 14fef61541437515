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

#ifdef COMMAND_CLASS
// clang-format off
CommandStyle(membrane_build,MoleculesBuild);
// clang-format on
#else

#ifndef LMP_MOLECULES_BUILD_H
#define LMP_MOLECULES_BUILD_H

#include "command.h"
#include "membrane_molecule_build.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/// Builds a structure of molecules on the limit surface of membranes, and writes it to files.
class MoleculesBuild : public Command {
 public:
  explicit MoleculesBuild(class LAMMPS *lmp) : Command(lmp) {}
  void command(int, char **) override;

 private:
  // a PDB or mmCIF file, and the PSF file that goes with it
  struct Source {
    std::string path, psf;
  };
  Source patch, leaflets[Membrane_NS::LEAFLETS];
  struct Protein {
    std::string bind;
    Source source;
  };
  std::vector<Protein> proteins;
  bool flip = false, overwrite = false, from_lipids = false;
  uint64_t seed = 1;
  double clash = 0.0, neutral = 0.0;
  double angstrom = 0.0;            // in a unit of length of the simulation
  std::string name;
  std::vector<std::string> formats;
  std::vector<tagint> chosen;       // molecule IDs; all membranes if empty

  void parse(int, char **);
  void parse_formats(const std::string &);
  std::string path_of(const std::string &format) const;
  void check_paths() const;
  std::vector<Membrane_NS::MembranePart> membranes(const class DistributedMesh &) const;
  std::vector<Membrane_NS::PlacedProtein> place_proteins(const Membrane_NS::LimitSurface &) const;
  void agree(const std::string &message) const;
  Membrane_NS::FaceComposition face_composition(const class DistributedMesh &, const std::vector<Membrane_NS::MembranePart> &,
                                                const Membrane_NS::PatchLipids &) const;
  void report(const Membrane_NS::BuildReport &, const std::vector<Membrane_NS::MembranePart> &,
              const Membrane_NS::PatchLipids &, const Membrane_NS::LeafletPatches &) const;
  void write(const Membrane_NS::Structure &);
};

}    // namespace LAMMPS_NS

#endif
#endif
