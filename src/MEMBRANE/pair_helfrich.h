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

#ifdef PAIR_CLASS
// clang-format off
PairStyle(helfrich,PairHelfrich);
// clang-format on
#else

#ifndef LMP_PAIR_HELFRICH_H
#define LMP_PAIR_HELFRICH_H

#include "hd_foreign_integrators.h"
#include "helfrich_model.h"
#include "mesh_gaps.h"
#include "pair.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/// Helfrich energy of the limit surface, with coefficients per control-point type: the energy is that of
/// a HelfrichModel, this connects it with LAMMPS.
class PairHelfrich : public Pair {
 public:
  PairHelfrich(class LAMMPS *);
  ~PairHelfrich() override;

  void compute(int, int) override;
  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  void setup() override;
  void finish() override;
  double init_one(int, int) override;

  void write_restart(FILE *) override;
  void read_restart(FILE *) override;
  void write_restart_settings(FILE *) override;
  void read_restart_settings(FILE *) override;

  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;
  /// "kc": bending moduli by type, from 1; "model"; "lipids": a const HelfrichLipids, or null if there are none.
  void *extract(const char *, int &) override;
  double memory_usage() override;

 private:
  HelfrichModel model;
  HDForeignIntegrators foreign_integrators;
  MeshGaps gaps;
  std::vector<double> moduli;    // kc by type, for extract()

  void allocate();
  void tally();
  void clear_ghost_tallies();
  void write_block(FILE *, const std::string &);
  std::string read_block(FILE *);
};

}    // namespace LAMMPS_NS

#endif
#endif
