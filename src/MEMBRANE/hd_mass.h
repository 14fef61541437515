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

#ifndef LMP_HD_MASS_H
#define LMP_HD_MASS_H

#include "mesh_part.h"

#include <memory>
#include <string>

namespace LAMMPS_NS {

/** The mass matrix of the control points of a group, kept up to date with LAMMPS' reneighbouring:
    what integrators, temperatures and velocity commands share. LAMMPS' x holds the control points
    q, v holds qdot, rmass the masses of the vertices. */
class HDMass : protected Pointers {
 public:
  /// `user` is named in errors.
  HDMass(class LAMMPS *, int igroup, std::string user);

  Membrane_NS::MassOperator::Settings settings;

  /// One of the keywords mass, solver, tol; returns the number of words it took, 0 if none of them.
  int parse(int iarg, int narg, char **arg);
  /// Use this number for all vertices instead of the atoms' masses: a matrix of drag coefficients.
  void set_drag(double coefficient) { drag = coefficient; }
  /// That number, or 0 for masses.
  double drag_coefficient() const { return drag; }
  /// Collective; call from init(). The group must hold whole membranes and nothing else, unless
  /// other_atoms; masses must be positive.
  void init(bool other_atoms = false);
  /// Collective; call before using part() or matrix() in a time step.
  void refresh();

  class DistributedMesh &mesh() { return *surface; }
  MeshPart &part() { return *vertices; }
  Membrane_NS::MassOperator &matrix() { return *mass; }
  /// Differs after a refresh() that numbered the vertices of the part anew.
  bigint numbering() const { return renumbered; }
  /// Control points of the group, on all ranks.
  bigint count() const { return npoints; }
  /// v^T M v of the atoms' velocities, xx yy zz xy xz yz; summed over ranks.
  void kinetic(double *);
  double memory_usage() const { return mass ? mass->memory_usage() : 0.0; }

 private:
  int igroup, groupbit;
  std::string user;
  class DistributedMesh *surface;
  std::unique_ptr<MeshPart> vertices;
  std::unique_ptr<Membrane_NS::MassOperator> mass;
  bigint epoch, renumbered, npoints;
  double drag;

  void check_group(bool other_atoms);
};

}    // namespace LAMMPS_NS

#endif
