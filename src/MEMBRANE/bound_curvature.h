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

#ifndef LMP_BOUND_CURVATURE_H
#define LMP_BOUND_CURVATURE_H

#include "bound_sites.h"
#include "membrane_footprint.h"
#include "mesh_surface.h"

#include <map>
#include <memory>

namespace LAMMPS_NS {

/** How bound particles couple to curvature, by their type: footprints, isotropic or with a director. The
    bare membrane that they stand in place of is that of pair style helfrich. */
class BoundCurvature : protected Pointers {
 public:
  explicit BoundCurvature(class LAMMPS *lmp) : Pointers(lmp) {}
  ~BoundCurvature() override = default;

  /// Words of fix hd/bind from `footprint` or `bar` on; returns how many.
  int parse(int narg, char **arg);
  bool any() const { return !coupling.empty(); }
  bool has_director(int type) const;
  /// Of the bilayer that a particle of this type stands in place of; 0 without footprint.
  double area(int type) const;
  /// The largest radius; 0 without any.
  double radius() const;

  /// Collective; call from init(): takes kc and c0 of the membranes of a group, and checks areas.
  void init(const class DistributedMesh &, int membranebit);
  /// Call when the topology has changed, with the new surface, or null; it must outlive the use of it.
  void set_surface(LocalSurface *);
  /// Call in each step, before add().
  void update();

  /** Energy and forces of the owned atom i: adds the force on it, and what its director feels to `turn`.
      Carries the director, if it has one. */
  double add(int i, BoundSite &site, double *f, Eigen::Vector3d &turn);
  /// Adds forces on control points, by local index, and to a virial xx yy zz xy xz yz.
  void take_forces(double **f, double *virial);

 private:
  std::map<int, Membrane_NS::CurvatureCoupling> coupling;    // by type
  LocalSurface *surface = nullptr;
  Membrane_NS::Quadrature quadrature = Membrane_NS::Quadrature::SIX;    // as that of the energy
  std::unique_ptr<Membrane_NS::Footprints> footprints;
};

}    // namespace LAMMPS_NS

#endif
