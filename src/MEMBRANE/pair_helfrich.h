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

#include "helfrich_coefficients.h"
#include "membrane_helfrich.h"
#include "mesh_totals.h"
#include "pair.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/// Helfrich energy of the limit surface, with coefficients per control-point type.
class PairHelfrich : public Pair {
 public:
  PairHelfrich(class LAMMPS *);
  ~PairHelfrich() override;

  void compute(int, int) override;
  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  void finish() override;
  double init_one(int, int) override;

  void write_restart(FILE *) override;
  void read_restart(FILE *) override;
  void write_restart_settings(FILE *) override;
  void read_restart_settings(FILE *) override;

  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;
  void *extract(const char *, int &) override;
  double memory_usage() override;

 private:
  // areas and volume a membrane is compared with, taken at the first step for "init"

  struct Reference {
    double area = 0.0, volume = 0.0;
    std::vector<double> face_area;    // in the order of the mesh; empty without area/local
  };

  Membrane_NS::Quadrature quadrature;
  std::unique_ptr<Membrane_NS::PatchRules> rules;
  std::vector<HelfrichCoefficients> coefficients;    // by type, from 1
  std::vector<double> moduli;                // kc by type, for extract()
  std::map<tagint, Reference> references;    // by molecule ID

  LocalMesh mesh;
  std::vector<const HelfrichCoefficients *> membrane_terms;    // whose global terms a membrane has
  std::vector<char> membrane_volume;                   // whether its volume is wanted
  std::vector<std::vector<int>> membrane_faces;        // for area/local only
  std::vector<double> reference_area;                  // by face, for area/local only
  bool first_pass, volumes, area_local, gauss, regularized, report;
  double default_regularize, terms_for_default;    // KR where pair_coeff says none; see extract()
  double points_evaluated;    // of quadrature, in this step on this rank
  bool restored;    // references come from a restart file and outlive the next pair_coeff

  std::vector<std::string> warned;    // of these fixes

  bool stale;    // what follows is to be derived anew
  std::vector<Membrane_NS::FaceGroup> groups;
  Membrane_NS::FaceModel model;
  Membrane_NS::FaceIntegrals integrals;
  Membrane_NS::FaceEnergies energies;
  std::vector<double> base_tension, local_modulus, regularization;    // by slot
  std::vector<double> distortion_energy;                              // by slot
  MeshTotals totals;

  void allocate();
  void check_integrators();
  double regularize_of(const HelfrichCoefficients &c) const
  {
    return c.regularize_given ? c.regularize : default_regularize;
  }
  void choose_terms();
  bool in_exclusion(int mask, int e) const;
  std::vector<char> find_excluded(const std::vector<char> &whole_terms) const;
  bool is_excluded(int face, std::vector<int> &stencil) const;
  void localize();
  void take_references();
  void apply_global_terms();
  void share_volume_recoil();
  void regularize();
  void tally();
  void clear_ghost_tallies();
  void read_all(FILE *, void *, size_t, size_t);
};

}    // namespace LAMMPS_NS

#endif
#endif
