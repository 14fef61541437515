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

#ifndef LMP_MEMBRANE_MASS_LUMPED_H
#define LMP_MEMBRANE_MASS_LUMPED_H

#include "membrane_mass_points.h"

namespace Membrane_NS {

/// Mass lumped: the masses are the control points' own, M = D.
class LumpedMass : public PointMasses {
 public:
  LumpedMass(const VertexMasses &vertices, const Settings &) : PointMasses(vertices) {}
  void multiply(const VertexField &v, VertexField &p) override;
  void solve(const VertexField &p, VertexField &v) override;

 private:
  void to_points(const VertexField &v, VertexField &w) override { copy(v, w); }
  void from_points(const VertexField &w, VertexField &v) override { copy(w, v); }
  void copy(const VertexField &from, VertexField &to) const;
};

}    // namespace Membrane_NS

#endif
