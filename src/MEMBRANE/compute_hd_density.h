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
ComputeStyle(hd/density,ComputeHDDensity);
// clang-format on
#else

#ifndef LMP_COMPUTE_HD_DENSITY_H
#define LMP_COMPUTE_HD_DENSITY_H

#include "compute.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/// Atoms of a fix hd/bind by leaflet and by the mean curvature of the membrane where they are, and its area.
class ComputeHDDensity : public Compute {
 public:
  ComputeHDDensity(class LAMMPS *, int, char **);
  ~ComputeHDDensity() override;
  void init() override;
  void compute_array() override;

 private:
  std::string bind_id;
  class FixHDBound *bind;
  int bins;
  double lowest, highest;
  std::vector<double> mine, all;    // [bins][3]: area, atoms of the outer and inner leaflet

  int bin_of(double curvature) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
