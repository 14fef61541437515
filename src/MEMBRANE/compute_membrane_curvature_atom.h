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
ComputeStyle(membrane/curvature/atom,ComputeMembraneCurvatureAtom);
// clang-format on
#else

#ifndef LMP_COMPUTE_MEMBRANE_CURVATURE_ATOM_H
#define LMP_COMPUTE_MEMBRANE_CURVATURE_ATOM_H

#include "compute.h"
#include "membrane_curvature.h"
#include "mesh_local.h"

#include <map>
#include <vector>

namespace LAMMPS_NS {

/// Curvatures, position and normal of the limit surface at each control point.
class ComputeMembraneCurvatureAtom : public Compute {
 public:
  ComputeMembraneCurvatureAtom(class LAMMPS *, int, char **);
  ~ComputeMembraneCurvatureAtom() override;

  void init() override;
  void compute_peratom() override;
  double memory_usage() override;

 private:
  using Weights = Membrane_NS::LimitBasis::Weights;

  // weights, and where the local indices of their control points begin in `points`

  struct Patch {
    const Weights *weights;
    size_t first;
  };

  // a control point of this rank: the patch that gives position and normal, followed by those over
  // which curvatures are averaged; if there are none, the first gives these too

  struct Site {
    int atom;
    int npatches;
    size_t first;
  };

  LocalMesh mesh;
  std::map<int, Weights> vertex_weights;    // by valence
  std::map<Membrane_NS::Valences, Weights> corner_weights;

  std::vector<Site> sites;
  std::vector<Patch> patches;
  std::vector<int> points;

  int nmax;

  void localize();
  void add_corner(int, int, int, int, int);
  Membrane_NS::LimitPoint evaluate(const Patch &, const double *) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
