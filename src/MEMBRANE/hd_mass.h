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

#include "membrane_mass_modes.h"
#include "mesh_group.h"
#include "restart_archive.h"

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

  // === Settings, before init()

  struct Settings : Membrane_NS::MassOperator::Settings {
    /// Direct if that is faster. Not where noise is drawn, which the solvers do to different
    /// tolerances: a run is to be the same on any number of ranks.
    bool quickest = false;
    void solve_nothing() { direct = quickest = false; }
  };
  Settings settings;
  /// One of the keywords mass, solver, tol and, for integrators, modes, relax: how many words it took; 0 if it is another keyword.
  int parse(int iarg, int narg, char **arg, bool integrates = false);
  /// Use this number for all vertices instead of the atoms' masses: a matrix of drag coefficients.
  void set_drag(double coefficient) { drag = coefficient; }
  /// That number, or 0 for masses.
  double drag_coefficient() const { return drag; }

  // === Life cycle

  /// Collective; call from init(). The group must hold all control points of its membranes and,
  /// unless other_atoms, nothing else; masses must be positive.
  void init(bool other_atoms = false);
  /// Collective; call before using part() or matrix() in a time step.
  void refresh();
  /** Collective, for mass sampling: whether the shape has left the reference, which is then taken anew, with
      a message. Velocities of the old mass are not those of the new one. False for other masses. */
  bool renew();
  /// Collective: warn, once a run, if a solution has missed the tolerance.
  void report_missed_tolerance();

  // === The control points and their matrix

  DistributedMesh &mesh() { return points.mesh(); }
  MeshPart &part() { return points.part(); }
  Membrane_NS::MassOperator &matrix() { return *mass; }
  /// Collective: modes about the shape that the mesh has had in the last init().
  void take_modes_anew();
  /// The same as matrix(), if modes are all the motion there is, or nullptr.
  Membrane_NS::ModalMass *modal() const;
  /// Differs after a refresh() that made the matrix anew.
  bigint numbering() const { return numberings; }
  /// Counts the references of mass sampling: velocities of one are not those of another.
  int64_t references() const { return renewals; }
  /// Control points of the group, on all ranks.
  bigint count() const { return points.count(); }
  /// v^T M v of the atoms' velocities, xx yy zz xy xz yz; summed over ranks.
  void kinetic(double *);
  double memory_usage() const { return mass ? mass->memory_usage() : 0.0; }
  /// What restart files keep: the reference of mass sampling.
  void archive(RestartArchive &);

 private:
  int groupbit;
  std::string user;
  MeshGroup points;
  std::unique_ptr<Membrane_NS::MassOperator> mass;
  double drag;
  bool reported;    // a missed tolerance, in this run
  bigint numberings;
  int64_t renewals;    // of the reference or the modes that the matrix is for
  Eigen::MatrixXd gram;    // of these modes; masses are those of init()

  void check_masses();
  void take_reference();
  double measured_kT();
  void archive_reference(RestartArchive &);
};

}    // namespace LAMMPS_NS

#endif
