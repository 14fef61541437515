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

#ifndef LMP_MEMBRANE_MOLECULE_CROWD_H
#define LMP_MEMBRANE_MOLECULE_CROWD_H

#include "membrane_molecule_grid.h"
#include "membrane_molecule_layout.h"
#include "membrane_molecule_torsions.h"

#include <cstdint>
#include <string>
#include <vector>

namespace Membrane_NS {

/// A lipid in the structure: its atom k is at x + turn conformer.x[k].
struct PlacedLipid {
  Eigen::Vector3d x;            ///< of its centre
  Eigen::Quaterniond turn;
  SurfacePoint point;           ///< of the limit surface, near it
  int conformer;                ///< of the library, or a shape of its own, see LipidCrowd::conformer()
  int leaflet;
  int part;                     ///< which connected surface
};

/// Atoms that stay where they are, of proteins.
struct FixedAtoms {
  std::vector<Eigen::Vector3d> x;
  std::vector<int> kinds;
};

/** All lipids of a structure, and where they get into each other's way. Two atoms of different lipids at a
    distance d less than d_c = SOFT times the closest of their kinds in the patch have the energy (1 - d/d_c)^2. Lipids
    that bend have it within themselves, too: of atoms more than three bonds apart, with d_c their closest distance
    in lipids of the patch.

    Work is shared by a team; each has all lipids, and all do the same. */
class LipidCrowd {
 public:
  static constexpr double SOFT = 1.03;
  static constexpr double CLASH = 0.8;    ///< of the closest distance of the patch

  /// `parts` are the connected surfaces, `neutral` the heights of the neutral surfaces, positive. All must
  /// outlive this.
  LipidCrowd(const PatchLipids &library, const std::vector<ParallelSurfaces> &parts, const std::array<double, LEAFLETS> &neutral,
             const FixedAtoms &fixed, uint64_t seed, Team &team);

  std::vector<PlacedLipid> lipids;

  const PatchLipids &library() const { return library_; }
  const std::vector<ParallelSurfaces> &parts() const { return parts_; }
  /// Random numbers for one purpose.
  CounterRandom random(int purpose) const { return {seed_, static_cast<uint64_t>(purpose)}; }
  Team &team() const { return team_; }
  double neutral(int leaflet) const { return neutral_[leaflet]; }
  const Conformer &conformer(const PlacedLipid &lipid) const { return conformers_[lipid.conformer]; }
  const Conformer &conformer_of(int lipid) const { return conformer(lipids[lipid]); }
  const LipidSpecies &species_of(int lipid) const { return library_.species[conformer_of(lipid).species]; }
  const FixedAtoms &fixed() const { return fixed_; }

  /// A lipid upright at a place of its neutral surface; `along` is where the x axis of the patch goes.
  PlacedLipid stand(const ParallelPlace &place, const Eigen::Vector3d &along, int conformer, int leaflet, int part) const;
  /// Atom k of a lipid that is placed.
  Eigen::Vector3d atom(const PlacedLipid &lipid, int k) const
  {
    return lipid.x + lipid.turn * conformer(lipid).x[k];
  }
  /// The place of the neutral surface where a lipid stands.
  ParallelPlace site_of(const PlacedLipid &lipid) const;
  /// d_c of two kinds.
  double soft(int a, int b) const { return soft_[a * kinds_ + b]; }
  double largest_soft() const { return largest_soft_; }

  // === Pairs

  /// The atoms of all lipids and then the fixed ones; owner -1 for these.
  struct Atoms {
    std::vector<Eigen::Vector3d> x;
    std::vector<int> owner, kind;
    std::vector<int> index;     ///< in the molecule
  };
  Atoms atoms() const;
  BeadGrid grid() const;
  /// The energy of each lipid, with others and within itself.
  std::vector<double> energies() const;

  /// What is left of clashes.
  struct Report {
    int lipids = 0;             ///< with a pair closer than CLASH times the closest of its kinds in the patch
    double closest = 0.0;       ///< of all pairs of different lipids, a length
    std::vector<int> which;     ///< lipids with such a pair
  };
  Report report() const;

  // === Relaxation

  /** Motion of all lipids down the energy, for so many steps: as rigid bodies, and those of a shape of their own about
      their torsions, too, up to LIBRATION from angles that were seen in the patch. A lipid is drawn back to its height above
      the neutral surface. Returns the energy before the last step. */
  double relax(int steps);

  /** Monte Carlo of the lipids whose energy is more than `least`: turns about the normal, other
      conformers of the species, and slides of up to `slide`; from a temperature down to 0. Lipids that are too
      near to one another take turns. `purpose` tells random numbers of one call from those of others. */
  void shuffle(double least, int trials, double temperature, double slide, int purpose);

  /** Monte Carlo of the shapes of lipids whose energy is more than `least`, which get shapes of their own: a torsion takes
      an angle that another lipid of the patch has; two about parallel bonds turn against one another; the lipid moves a
      little as a whole. Temperature and purpose as in shuffle(). Returns how many lipids these were. */
  int bend(double least, int trials, double temperature, int purpose);

  static constexpr double LIBRATION = 0.26;    ///< radian

 private:
  const PatchLipids &library_;
  const std::vector<ParallelSurfaces> &parts_;
  const std::array<double, LEAFLETS> neutral_;
  const FixedAtoms &fixed_;
  const uint64_t seed_;
  Team &team_;
  int kinds_;
  double largest_soft_ = 0.0;
  std::vector<double> soft_;
  std::vector<Conformer> conformers_;       // those of the library, then shapes of lipids' own
  std::vector<LipidTorsions> torsions_;     // by species, once lipids bend
  std::vector<double> soft_within_;         // as soft_, of one lipid

  double reach(const Atoms &all, int a, int b) const;
  bool has_own_shape(int lipid) const { return lipids[lipid].conformer >= static_cast<int>(library_.conformers.size()); }
  void give_own_shape(int lipid);
  void prepare_torsions();
  double reach_of_lipids() const;
};

/// (1 - d/reach)^2 where d < reach.
inline double overlap(double d2, double reach)
{
  if (d2 >= reach * reach) return 0.0;
  const double w = 1.0 - std::sqrt(d2) / reach;
  return w * w;
}

// d_c of two atoms of different lipids, or of one that bends; 0 of others

inline double LipidCrowd::reach(const Atoms &all, int a, int b) const
{
  const int owner = all.owner[a];
  if (owner != all.owner[b]) return soft(all.kind[a], all.kind[b]);
  if (!has_own_shape(owner)) return 0.0;
  const Conformer &shape = conformer_of(owner);
  return torsions_[shape.species].apart[all.index[a] * shape.x.size() + all.index[b]]
      ? soft_within_[all.kind[a] * kinds_ + all.kind[b]]
      : 0.0;
}

/** Brings the numbers of lipids to what is wanted, [part][leaflet][species]: where there are too many, those
    with the most overlap go; where too few, the largest holes are filled; and where both, lipids change
    their kind. Fixed atoms first drive out lipids that touch them, which are no longer wanted; returned is how many by leaflet. */
std::array<int, LEAFLETS> fit_numbers(LipidCrowd &crowd, std::vector<std::array<std::vector<int>, LEAFLETS>> wanted);

}    // namespace Membrane_NS

#endif
