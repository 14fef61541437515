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
ComputeStyle(membrane/shape,ComputeMembraneShape);
// clang-format on
#else

#ifndef LMP_COMPUTE_MEMBRANE_SHAPE_H
#define LMP_COMPUTE_MEMBRANE_SHAPE_H

#include "compute.h"
#include "membrane_curvature.h"
#include "mesh_totals.h"

#include <vector>

namespace LAMMPS_NS {

/// Area, volume, integrals of curvature, and mesh quality of each membrane.
class ComputeMembraneShape : public Compute {
 public:
  ComputeMembraneShape(class LAMMPS *, int, char **);
  ~ComputeMembraneShape() override;

  void init() override;
  void compute_vector() override;
  void compute_array() override;
  int lock_length() override { return size_array_rows; }
  double memory_usage() override;

 private:
  LocalMesh mesh;
  Membrane_NS::PatchRules rules;
  MeshTotals totals;
  std::vector<int> members;    // membranes of the group, one to a row

  Membrane_NS::FaceGroups groups;
  std::vector<int>
      beyond;    // [slots][3] local index of the point across the edge from each corner
  Membrane_NS::FaceModel model;
  Membrane_NS::FaceIntegrals integrals;
  Membrane_NS::CurvatureIntegrals curvature;

  void choose_membranes();
  void localize();
  void measure();
  void combine_components(const std::vector<double> &);
  void measure_quality(const Membrane_NS::FaceGroup &, int, double *) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
