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

#ifndef LMP_MEMBRANE_MASS_POINTS_H
#define LMP_MEMBRANE_MASS_POINTS_H

#include "membrane_mass.h"

namespace Membrane_NS {

/** Point masses, one for each vertex, that move with velocities w = A v: M = A^T D A with D the
    masses. Their noise and friction are local, so both may differ between vertices. */
class PointMasses : public MassOperator {
 public:
  /// A^-1 D^-1/2 z
  void sample(double kT, uint64_t seed, uint64_t step, VertexField &v) override;
  bool has_vertex_friction() const override { return true; }
  using MassOperator::relax;
  void relax(const std::vector<double> &keep, double kT, uint64_t seed, uint64_t step,
             VertexField &v) override;
  double memory_usage() const override;

 protected:
  explicit PointMasses(const VertexMasses &);

  std::vector<double> mass_, unit_speed_;    // of owned vertices, and 1/sqrt(mass)
  std::vector<uint64_t> label_;
  /// w = A v and v = A^-1 w; w has an entry for each vertex of the part.
  virtual void to_points(const VertexField &v, VertexField &w) = 0;
  virtual void from_points(const VertexField &w, VertexField &v) = 0;

 private:
  VertexField w_, noise_;
};

}    // namespace Membrane_NS

#endif
