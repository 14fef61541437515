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

#ifdef FIX_CLASS
// clang-format off
FixStyle(hd/tension,FixHDTension);
// clang-format on
#else

#ifndef LMP_FIX_HD_TENSION_H
#define LMP_FIX_HD_TENSION_H

#include "box_scaling.h"
#include "fix.h"
#include "membrane_blocks.h"
#include "mesh_local.h"
#include "restart_archive.h"
#include "trial_energy.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/** Monte Carlo moves of the periodic box at a frame tension and a pressure, between steps of dynamics. The
    weights are derived in doc/src/Derivation_tension.rst. */
class FixHDTension : public Fix {
 public:
  FixHDTension(class LAMMPS *, int, char **);

  int setmask() override;
  void init() override;
  void setup(int) override;
  void end_of_step() override;

  /// Minus the potential and kinetic energy that moves have given to the system.
  double compute_scalar() override;
  /// See the enum Output; then the step of each freedom.
  double compute_vector(int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;

 private:
  enum Output {
    ATTEMPTS, ACCEPTANCE, FACTOR_X, FACTOR_Y, FACTOR_Z,
    MEAN_AREA, ERROR_AREA, VARIANCE_AREA, MEAN_VOLUME, ERROR_VOLUME, VARIANCE_VOLUME, NUM_OUTPUT
  };
  enum Series { AREA, VOLUME, AREA_SQUARED, VOLUME_SQUARED, NUM_SERIES };

  /// Directions of the box that move together, and how far.
  struct Freedom {
    std::array<bool, 3> along;
    double step;                  // largest change of the logarithm of their product
    bigint attempts, accepted;    // accepted since the burn-in
    void archive(RestartArchive &file) { file(step); file(attempts); file(accepted); }
  };
  std::vector<Freedom> freedoms;
  double temperature, tension, pressure;
  bool has_tension, keep_volume, scale_momenta, until_accepted;
  int compensating;    // the direction that keeps the volume
  int trials;          // at a visit
  bigint seed, burn;
  double wanted;       // acceptance

  TrialEnergy trial;
  BoxScaling scaling;
  std::unique_ptr<LocalMesh> mesh;    // if the atom style has one
  bool has_points;                    // and some are there
  std::array<int, 2> plane;           // of the sheets
  double longest_step;                // that neighbor lists and stencils allow for
  std::vector<char> goes_along;       // by component: it is in the group
  int movers;                         // bits of the groups that are integrated
  std::vector<class FixHDBound *> held;    // fixes whose atoms stay over their place on the surface

  bigint attempts;
  double energy;
  std::array<double, 3> lengths;      // of the box when the fix was made
  std::array<double, 2> origin;       // area and volume that variances are measured from
  Membrane_NS::BlockAverages averages;

  // words
  bool parse_directions(const std::string &);
  void check_words();

  // before a run
  void check_periodic();
  void check_fixes();
  void check_outsiders();
  void check_membranes();
  void check_bound_atoms();
  void check_measure();
  void check_temperature();
  void limit_steps();

  // moves
  bool attempt();
  std::vector<BoxScaling::Cell> cells_outside() const;
  std::array<double, 3> factors(const Freedom &, double change) const;
  void check_box();
  void check_edges(const std::array<double, 3> &);
  bool is_sampled(int i) const;
  double log_jacobian(const std::array<double, 3> &);
  double kinetic_change(const std::array<double, 3> &);
  void scale_velocities(const std::array<double, 3> &);
  void tune(Freedom &, double acceptance);
  void sample();
  double area() const;
  double volume() const;
  double kT() const;
  bigint next_visit() const;
  void archive(RestartArchive &);
};

}    // namespace LAMMPS_NS

#endif
#endif
