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

#ifndef LMP_MEMBRANE_SRD_H
#define LMP_MEMBRANE_SRD_H

#include <cmath>
#include <cstdint>
#include <vector>

namespace Membrane_NS {

// === What kinetic theory says of the solvent

/** Shear viscosity of solvent that collides by rotations about random axes: mass density times
    nu_kin + nu_col [E. Tuezel, M. Strauss, T. Ihle and D. M. Kroll, Phys. Rev. E 68, 036701 (2003),
    Eqs. 41 and 44; T. Ihle, E. Tuezel and D. M. Kroll, Phys. Rev. E 72, 046707 (2005)].
    particles: mean number in a cell of edge `cell`; angle in radians; step: time between
    collisions. */
double srd_viscosity(double particles, double angle, double kT, double mass, double cell,
                     double step);
/** The same for the rule at+a in three dimensions [H. Noguchi and G. Gompper, Phys. Rev. E 78,
    016706 (2008), Table I]. */
double at_viscosity(double particles, double kT, double mass, double cell, double step);
/// Mean distance between collisions, as fix srd defines it: step sqrt(kT/mass).
double mean_free_path(double kT, double mass, double step);

// === The collision

/** Particles as flat arrays. One with a negative cell takes no part. */
struct SRDParticles {
  int count = 0;
  double *velocity = nullptr;      ///< [count][3]; changed by the collision
  const double *mass = nullptr;    ///< [count]
  const int *cell = nullptr;       ///< [count]
  // rule AT_A only
  const double *offset = nullptr;     ///< [count][3], position less the centre of the cell
  const uint64_t *label = nullptr;    ///< [count], what random velocities are keyed by
  double *drawn = nullptr;            ///< [count][3], the random velocities: scratch
};

/** What happens to the particles of a cell at a collision, in three passes over flat arrays: add()
    particles to the moments of their cells, sum moments over ranks, prepare() what the cell does to
    a velocity, apply() it.

    SRD: velocities relative to the cell's mean turn by a fixed angle about an axis that is uniform
    on the sphere [A. Malevanets and R. Kapral, J. Chem. Phys. 110, 8605 (1999)]: momentum and
    energy are kept. With the thermostat the relative velocities are also scaled so that their
    energy is drawn from the canonical distribution, a Gamma distribution of 3(N - 1)/2 [C.-C.
    Huang, A. Chatterji, G. Sutmann, G. Gompper and R. G. Winkler, J. Comput. Phys. 229, 168
    (2010)].

    AT_A: velocities are drawn anew from the Maxwell distribution, less what changes the cell's
    momentum and its angular momentum [H. Noguchi, N. Kikuchi and G. Gompper, Europhys. Lett. 78,
    10005 (2007), Eq. 4]: a thermostat by itself.

    Random numbers depend on seed, step and the number of the cell (AT_A: the label of the particle)
    alone. Masses may differ. */
class CollisionRule {
 public:
  enum class Method { SRD, AT_A };
  struct Settings {
    Method method = Method::SRD;
    double angle = 1.5707963267948966;    ///< radians
    bool thermostat = false;              ///< SRD only
    double kT = 1.0;                      ///< mass times velocity squared
    uint64_t seed = 1;
  };

  explicit CollisionRule(const Settings &settings) :
      settings_(settings), cos_angle_(std::cos(settings.angle)), sin_angle_(std::sin(settings.angle))
  {
  }
  const Settings &settings() const { return settings_; }
  bool needs_offsets() const { return settings_.method == Method::AT_A; }

  /// Numbers a cell has in `moments`: first particles, mass and momentum.
  int num_moments() const;
  /// Numbers a cell has in `actions`.
  int num_actions() const { return settings_.method == Method::SRD ? 12 : 6; }

  /// moments += of these particles; moments[cells][num_moments()].
  void add(const SRDParticles &particles, uint64_t step, double *moments) const;
  /** actions[cells][num_actions()] from the sums; numbers: of the cells, which random numbers are
      keyed by. */
  void prepare(int cells, const int64_t *numbers, uint64_t step, const double *moments,
               double *actions) const;
  void apply(const SRDParticles &particles, const double *actions) const;

 private:
  Settings settings_;
  double cos_angle_, sin_angle_;

  void draw(const SRDParticles &particles, uint64_t step) const;
  double thermal_scale(int64_t number, uint64_t step, const double *moments) const;
  void prepare_rotation(int64_t number, uint64_t step, const double *moments, const double (&axis)[3], double *action) const;
  void prepare_andersen(const double *moments, double *action) const;
};

// === Thermal energy relative to the cells' mean velocities

/** m v^2 less that of the mean motion, and three degrees of freedom for each particle but one:
    their ratio is kT. `moments` as of add_energy(), five numbers a cell: particles, mass, momentum,
    then m v^2: six. */
class CellEnergy {
 public:
  static constexpr int NUM_MOMENTS = 6;
  static void add(const SRDParticles &particles, double *moments);
  double energy = 0.0;     ///< sum over cells of sum m (v - mean)^2
  double freedom = 0.0;    ///< sum over cells of 3 (N - 1)
  void count(const double *moments);
};

// === Random numbers of the solvent

/// Where the grid begins, in cells: three numbers uniform in (0, 1).
void random_shift(uint64_t seed, uint64_t step, double *shift);
/// Maxwell's distribution.
void thermal_velocity(uint64_t seed, uint64_t step, uint64_t label, double kT, double mass,
                      double *velocity);

}    // namespace Membrane_NS

#endif
