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

#ifndef LMP_SRD_SURFACE_MOVERS_H
#define LMP_SRD_SURFACE_MOVERS_H

#include "membrane_vertex_field.h"
#include "pointers.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace LAMMPS_NS {

/// What moves the membranes that solvent meets: the integrators of their control points, and the
/// box.
class SurfaceMovers : protected Pointers {
 public:
  /// `user` is named in errors.
  SurfaceMovers(class LAMMPS *, int igroup, std::string user);

  /// Collective; call from init(). Stops if membranes of the group are moved in a way that impulses
  /// cannot act on.
  void init();

  // === Integrators

  /// Whether one of them moves a local atom, which then yields to impulses.
  bool moves(int atom) const;
  /** What they do in the present step to control points, for those alone: to[place[atom]] becomes
      the displacement, or the acceleration at its start in units of velocity/time. */
  void load_displacements(const std::vector<int> &place, Membrane_NS::VertexField &to) const;
  void load_accelerations(const std::vector<int> &place, Membrane_NS::VertexField &to) const;

  // === The box

  /// A fix deform moves the atoms along with it.
  bool box_takes_atoms() const { return takes_atoms; }
  /// It deforms and does not: periodic images of atoms move relative to one another.
  bool images_move() const;
  /// The rate at which the box vectors, as columns, change for images.
  Eigen::Matrix3d lattice_rate() const;

 private:
  std::string user;
  int igroup, groupbit;
  std::vector<class FixHDBase *> integrators;
  bool takes_atoms;

  void find_integrators();
  void find_box_movers();
};

}    // namespace LAMMPS_NS

#endif
