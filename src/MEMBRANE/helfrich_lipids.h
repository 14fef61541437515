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

#ifndef LMP_HELFRICH_LIPIDS_H
#define LMP_HELFRICH_LIPIDS_H

#include "helfrich_words.h"
#include "membrane_lipid_library.h"
#include "pointers.h"
#include "restart_archive.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/** The lipids of membranes as pair_coeff says them, by type of control points from 1. Other styles reach it by
    pair->extract("lipids", dim) of pair style helfrich, which is null if no type has any. */
class HelfrichLipids : protected Pointers {
 public:
  using Pointers::Pointers;

  struct Leaflets {
    bool given = false;
    Membrane_NS::LeafletComposition outer, inner;
  };

  /// The kinds that some type has.
  const Membrane_NS::LipidLibrary &library() const { return used; }
  const Leaflets &of(int type) const { return by_type[type]; }
  bool any() const;
  /// Spontaneous curvatures of the monolayers, 0 of types without lipids.
  double outer_curvature(int type) const;
  double inner_curvature(int type) const;
  /// (outer - inner)/2: of the bilayer, as kc/2 (2H - c0)^2 has it.
  double bilayer_curvature(int type) const
  {
    return 0.5 * (outer_curvature(type) - inner_curvature(type));
  }

  // === What the user says

  void resize(int n);
  void clear(int type);
  /// Words: lipids FILE|NULL [outer|inner NAME parts ...] [library NAME area c0]; returns how many.
  int parse(const std::vector<int> &types, const HelfrichWords &);
  /// A line for the log: fractions, areas and curvatures of a leaflet.
  std::string describe(const Membrane_NS::LeafletComposition &) const;

  void archive(RestartArchive &);

 private:
  Membrane_NS::LipidLibrary used;
  std::vector<Leaflets> by_type;

  void read(const std::string &path, Membrane_NS::LipidLibrary &) const;
  void keep_used(const Membrane_NS::LipidLibrary &);
};

}    // namespace LAMMPS_NS

#endif
