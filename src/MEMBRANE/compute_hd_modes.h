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
#include "membrane_modes.h"
#include "mesh_totals.h"

#include <vector>

namespace LAMMPS_NS {

/// Fourier amplitudes of a periodic sheet, or spherical-harmonic amplitudes of a closed membrane.
class ComputeHDModes : public Compute {
 public:
  ComputeHDModes(class LAMMPS *, int, char **);
  ~ComputeHDModes() override;

  void init() override;
  void setup() override;
  void compute_vector() override;
  void compute_array() override;
  double memory_usage() override;

 private:
  enum class Shape { PLANE, SPHERE };
  Shape shape;
  int highest;    // NMAX or LMAX

  LocalMesh mesh;
  Membrane_NS::PatchRules rules;
  MeshTotals totals;
  int component;
  std::vector<int> heights;    // by vertex: box lengths in z from its image flag to a whole sheet

  std::vector<Membrane_NS::FaceGroup> groups;
  Membrane_NS::FaceModel model;
  Membrane_NS::FaceIntegrals integrals;
  std::vector<double> mine, sums;

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
