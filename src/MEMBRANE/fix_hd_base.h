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

#ifndef LMP_FIX_HD_BASE_H
#define LMP_FIX_HD_BASE_H

#include "fix.h"
#include "mesh_part.h"

#include <memory>

namespace LAMMPS_NS {

/** What all integrators of control points share: the mass matrix and its keywords, the checks, and
    M^-1 f. LAMMPS' x holds the control points q, v holds qdot. */
class FixHDBase : public Fix {
 public:
  FixHDBase(class LAMMPS *, int, char **);

  void init() override;
  void setup(int) override;
  double memory_usage() override;

 protected:
  Membrane_NS::MassOperator::Settings settings;
  class DistributedMesh *mesh;
  std::unique_ptr<MeshPart> part;
  std::unique_ptr<Membrane_NS::MassOperator> mass;
  bigint epoch;    // reneighbouring that part and mass are for

  Membrane_NS::VertexField force, acceleration;

  /// One of the keywords mass, solver, tol; returns the number of words it took, 0 if none of them.
  int parse_mass_keyword(int iarg, int narg, char **arg);
  /// Follow LAMMPS' reneighbouring; call before using part or mass in a step.
  void refresh();
  /// acceleration = ftm2v M^-1 f from the atoms' forces.
  void accelerate();
  /// v += step * acceleration
  void kick(double step);
  /// x += step * v, with a check that no control point runs away
  void drift(double step);

 private:
  double most_drift;    // a fraction of an edge

  void check_group();
  void check_other_integrators();
};

}    // namespace LAMMPS_NS

#endif
