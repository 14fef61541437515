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

#ifndef LMP_MEMBRANE_MASS_VERTEX_H
#define LMP_MEMBRANE_MASS_VERTEX_H

#include "membrane_limit_mask.h"
#include "membrane_mass_points.h"

namespace Membrane_NS {

/** Mass vertex: point masses at the limit positions of the vertices, M = L^T D L with the limit mask
    L, and M^-1 = L^-1 D^-1 L^-T: two solutions with L. */
class VertexMass : public PointMasses {
 public:
  VertexMass(const VertexMasses &, const Settings &);
  void multiply(const VertexField &v, VertexField &p) override;
  void solve(const VertexField &p, VertexField &v) override;
  void solve_with_noise(const VertexField &p, VertexField &v, uint64_t seed, uint64_t step,
                        VertexField &z) override;
  double memory_usage() const override;

 private:
  LimitMask mask_;
  VertexField work_, scratch_;
  std::vector<double> other_;

  void to_points(const VertexField &v, VertexField &w) override;
  void from_points(const VertexField &w, VertexField &v) override { mask_.solve(w, v); }
};

}    // namespace Membrane_NS

#endif
