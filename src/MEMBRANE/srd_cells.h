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

#ifndef LMP_SRD_CELLS_H
#define LMP_SRD_CELLS_H

#include "membrane_srd.h"
#include "membrane_srd_walls.h"
#include "srd_grid.h"
#include "srd_solvent.h"

#include <array>
#include <cstdint>
#include <vector>

namespace LAMMPS_NS {

/** The collisions of solvent in cells of a grid that is placed anew each time. */
class SRDCells : protected Pointers {
 public:
  struct Settings {
    Membrane_NS::CollisionRule::Settings rule;
    double size = 1.0;    ///< edge of a cell
    bool shift = false;
    uint64_t shift_seed = 1;
  };
  SRDCells(class LAMMPS *, const Settings &);

  SRDGrid grid;
  const Settings &settings() const { return given; }

  // === Others that take part in a collision: point masses of a membrane, for instance

  struct Participants {
    std::vector<double> position, velocity, mass;    ///< [][3], [][3], []
    std::vector<uint64_t> label;                     ///< distinct from atom IDs of solvent
    std::vector<int> side;                           ///< of solvent that they collide with
    int count() const { return static_cast<int>(mass.size()); }
    void clear();
    /// Returns its place in the arrays.
    int add(const double *x, const double *v, double m, uint64_t name, int which_side = 0);
  };
  /** Fill before collide(), which changes their velocities: on one rank each, within the reach of
      its sub-domain, positions in any periodic image. They stay until cleared. */
  Participants others;
  /// Solvent that passes through the periodic boundary in this direction changes its side.
  std::array<bool, 3> flips = {false, false, false};

  // === Collision

  /** Collective. Within walls that do not slip, the parts of cells beyond them hold particles at
      rest with the wall, of the mean number `filling` a cell and the mass of solvent; the walls
      take the momentum. side: if given, by owned atom, solvent with 0 and solvent with another
      number do not collide with each other. */
  void collide(const SRDSolvent &, bigint step, Membrane_NS::BoxWalls &walls, double filling,
               double solvent_mass, const int *side = nullptr);

  // === Measurement

  /** Collective. Thermal energies relative to the mean velocities of cells of an unshifted grid: of
      solvent with side 0, of that with another, and of all (cells count both). */
  struct Energies {
    Membrane_NS::CellEnergy outside, inside, all;
  };
  Energies measure(const SRDSolvent &, const int *side);

  double memory_usage() const;

 private:
  Settings given;
  Membrane_NS::CollisionRule rule;

  std::vector<double> moments, actions;
  std::vector<int64_t> numbers;    // of cells, those of the other side after those of side 0

  // of a set of particles while a collision lasts
  struct Binned {
    std::vector<int> cell;
    std::vector<double> offset, drawn;
    std::vector<uint64_t> label;
    void resize(int n);
  };
  Binned solvent_bins, other_bins, filler_bins;
  Participants fillers;

  int side_of(const double *x, int side) const;
  void change_frame(const SRDSolvent &, double sign);
  Membrane_NS::SRDParticles bin_solvent(const SRDSolvent &, const int *side, bool offsets);
  Membrane_NS::SRDParticles bin_others(bool layers, bool offsets);
  static Membrane_NS::SRDParticles particles_of(Participants &, Binned &);
  void fill(bigint step, const Membrane_NS::BoxWalls &, double filling, double mass, int layers);
  /// The fillers' momentum, of cells that this rank owns, to the walls.
  void hand_over(Membrane_NS::BoxWalls &, double sign) const;
};

}    // namespace LAMMPS_NS

#endif
