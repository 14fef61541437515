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

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(hd/modes,ComputeHDModes);
// clang-format on
#else

#ifndef LMP_COMPUTE_HD_MODES_H
#define LMP_COMPUTE_HD_MODES_H

#include "compute.h"
#include "hd_mode_averages.h"
#include "membrane_modes.h"
#include "mesh_totals.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/** Fourier amplitudes of a periodic sheet, or spherical-harmonic amplitudes of a closed membrane; or mean
    powers of these over a run. */
class ComputeHDModes : public Compute, public SampledCompute {
 public:
  ComputeHDModes(class LAMMPS *, int, char **);
  ~ComputeHDModes() override;

  void take_sample() override;
  void finish_samples() override;

  void init() override;
  void setup() override;
  void compute_vector() override;
  void compute_array() override;
  double memory_usage() override;

 private:
  enum class Shape { PLANE, SPHERE };
  Shape shape;
  int highest;    // NMAX or LMAX
  Membrane_NS::Quadrature quadrature;

  ModeSampling sampling;
  std::unique_ptr<ModeAverages> averages;
  int nmodes;
  double **modes;    // [nmodes][NCOLUMNS] of the present shape: the array, without averages

  LocalMesh mesh;
  std::unique_ptr<Membrane_NS::PatchRules> rules;
  MeshTotals totals;
  int component;
  std::vector<int> heights;    // by vertex: box lengths in z from its image flag to a whole sheet

  std::vector<Membrane_NS::FaceGroup> groups;
  Membrane_NS::FaceModel model;
  Membrane_NS::SurfacePoints points;
  std::vector<double> mine, sums;

  void parse(int, char **);
  void number_modes();
  void begin_averages();
  double wave_number(int) const;
  void forget_samples();
  std::string name_of_averages() const;
  void choose_membrane();
  void join_heights();
  void localize();
  void measure();
  void measure_plane();
  void measure_sphere();
  void place_heights();
  void set_row(int, double, double, double);
};

}    // namespace LAMMPS_NS

#endif
#endif
