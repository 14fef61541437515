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
ComputeStyle(hd/surface/atom,ComputeHDSurfaceAtom);
// clang-format on
#else

#ifndef LMP_COMPUTE_HD_SURFACE_ATOM_H
#define LMP_COMPUTE_HD_SURFACE_ATOM_H

#include "compute.h"

#include <string>

namespace LAMMPS_NS {

/// Where the atoms of a fix hd/bind are on their membrane, and its curvature there.
class ComputeHDSurfaceAtom : public Compute {
 public:
  ComputeHDSurfaceAtom(class LAMMPS *, int, char **);
  ~ComputeHDSurfaceAtom() override;
  void init() override;
  void compute_peratom() override;
  double memory_usage() override;

 private:
  std::string bind_id;
  class FixHDBound *bind;
  int nmax;
};

}    // namespace LAMMPS_NS

#endif
#endif
