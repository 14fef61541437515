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

#ifndef LMP_HD_MODE_AVERAGES_H
#define LMP_HD_MODE_AVERAGES_H

#include "membrane_blocks.h"
#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/// A compute that takes samples of its own in a run; HD/SAMPLES, a fix that it makes, tells it when.
class SampledCompute {
 public:
  /// Collective, at the end of a step.
  virtual void take_sample() = 0;
  /// Collective, after a run.
  virtual void finish_samples() = 0;

 protected:
  ~SampledCompute() = default;
};

/// What a compute is told of averages.
struct ModeSampling {
  int every = 0;    ///< steps between samples; 0: no averages
  std::string file;
  double kT = 0.0, kc = 0.0, tension = 0.0;    ///< of theory; kT = 0: none

  /// One of the keywords average, theory, file: how many words it took; 0 if it is another.
  int parse(class LAMMPS *, const std::string &user, int iarg, int narg, char **arg);
  /// Stops if one of them lacks another.
  void check(class LAMMPS *, const std::string &user) const;

  /// <|h_q|^2> of a sheet over this area and <u_lm^2> of a vesicle of this radius; 0 without theory.
  double wave_power(double q, double area) const;
  double harmonic_power(double l, double radius) const;
};

/** Mean powers of groups of modes that theory takes for one: those of a degree, or waves of the same
    length. A row is: mean wave number or degree, modes, power, its error, power over theory, its error,
    integrated autocorrelation time in samples. All ranks have the same. */
class ModeAverages : protected Pointers {
 public:
  static constexpr int NCOLUMNS = 7;

  /// number[mode]: modes are of one row if this differs by less than a part of it; of none if it is 0.
  ModeAverages(class LAMMPS *, const std::vector<double> &number, double part);
  int num_rows() const { return static_cast<int>(modes.size()); }

  /// By mode: wave numbers, powers, and what theory expects; 0 if there is none
  void add(const std::vector<double> &number, const std::vector<double> &power,
           const std::vector<double> &theory);
  /// As if there had been no samples.
  void begin_anew();
  bigint count() const { return blocks.count(); }
  /// [num_rows()][NCOLUMNS]
  void fill(double **table) const;
  /// The table as text, on rank 0.
  void write(const ModeSampling &, const std::string &user) const;

 private:
  std::vector<int> row, modes;    // by mode, or -1; by row: how many
  Membrane_NS::BlockAverages blocks;    // series: powers of all rows, ratios, wave numbers
};

}    // namespace LAMMPS_NS

#endif
