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

#ifndef LMP_MEMBRANE_FOOTPRINT_H
#define LMP_MEMBRANE_FOOTPRINT_H

#include "membrane_limit_surface.h"
#include "membrane_quadrature.h"

#include <memory>
#include <vector>

namespace Membrane_NS {

// How a particle that is bound to a membrane couples to its curvature (doc/src/Derivation_footprint.rst).

/** What a particle is made of. It stands in place of the bare membrane over its area a; its energy is

      a [ kp/2 (2Hbar - c0p)^2 + k_par/2 (c_t - c_par)^2 + k_perp/2 (c_s - c_perp)^2
          - kc/2 (2Hbar - c0)^2 ]

    with the curvature 2Hbar of its footprint, and in it those along the director, c_t, and across, c_s;
    c_t + c_s = 2Hbar. Any consistent units; curvatures are positive where a sphere is seen from outside. */
struct CurvatureCoupling {
  double area = 0.0;
  double radius = 0.0;                  ///< rho, how far the footprint reaches
  double kp = 0.0, c0p = 0.0;           ///< whatever the direction
  double k_par = 0.0, c_par = 0.0;      ///< along the director
  double k_perp = 0.0, c_perp = 0.0;    ///< across, in the surface
  double kc = 0.0, c0 = 0.0;            ///< of the bare membrane

  bool has_director() const { return k_par != 0.0 || k_perp != 0.0; }
};

/** A direction in the surface: the vector t in space, of length 1, and the normal nbar of the footprint where
    it was last, across which it is. Without a normal (zero) it is any vector, to be projected. */
struct Director {
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

/** Carries a director to where the normal is another: turned by the smallest rotation that does it, in small
    steps parallel transport; or, if it has no normal, projected. Of length 1. MeshError for one along the
    normal (to 1e-6), or a normal that has turned over. */
Director carry(const Director &director, const Eigen::Vector3d &normal);

/** The surface under a particle: means over the quadrature points r_k within rho of its place x, with
    the weights A_k W_k, W_k = (1 - |x - r_k|^2/rho^2)^3. All zero if there is none. */
struct FootprintAverage {
  double area = 0.0;         ///< sum of A_k W_k: a quarter of that of a disc of radius rho
  double curvature = 0.0;    ///< 2Hbar: 2/R on a sphere
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();    ///< nbar, of length 1
  /** Sbar, the mean of the curvature tensors, each turned into the plane across nbar by the smallest
      rotation. Symmetric, nothing along nbar, its trace is 2Hbar; t.Sbar.t is the curvature along t. */
  Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
};

/// One particle. All zero, and the director as it was, if there is no quadrature point in reach.
struct FootprintForces {
  double energy = 0.0;
  double area = 0.0, curvature = 0.0;                 ///< see FootprintAverage
  double along = 0.0, across = 0.0;                   ///< c_t and c_s
  Director director;                                  ///< carried to here
  Eigen::Vector3d force = Eigen::Vector3d::Zero();    ///< on the particle
  /// Minus the derivative by t, in the surface across t; the torque is t x this, about nbar.
  Eigen::Vector3d director_force = Eigen::Vector3d::Zero();
};

/** The footprints of particles on one surface.

    A face counts if it is within reach and joined to the face of the foot, across edges, through faces
    within reach: other parts of the surface that come close in space alone do not. Within reach is a face
    that may be closer than rho by a bound on where it is, 1.2 edges around its middle at most: all of the
    piece of surface around the foot that a ball of radius rho around x cuts out counts, and nothing
    that could only be reached from there by leaving the ball by more than that.

    Energies are functions of x, control points and director in space alone; of the foot only the face is
    looked at. A director is carried to the nbar of here first. Then forces are the exact derivatives, with
    t held in space: that nbar leaves it behind as x and control points move costs nothing to first order.

    What is known of a face is kept until the surface moves, so particles that share faces share the cost,
    and forces on control points are worked out once for all particles. Allocates memory only if more faces
    are in reach than ever before. */
class Footprints {
 public:
  /** The same few points on every face, whatever its valences, which is enough for a mean: a graded rule
      has 10 to 50 times as many on faces that are not regular, and costs as many times more. The surface
      must outlive this; when its topology changes, make another. */
  Footprints(const LimitSurface &surface, Quadrature quadrature);
  /// The points of the energy's own rules. These must outlive this, too.
  Footprints(const LimitSurface &surface, PatchRules &graded);
  ~Footprints();

  /// Call when the surface or its box has moved. Forgets forces that were not taken.
  void update();

  /** What is under a place x. Looks at control points up to radius + 4 edges away. MeshError if in a
      periodic direction the footprint and a face on each side are wider than the box. */
  FootprintAverage average(const Eigen::Vector3d &x, const SurfacePoint &foot, double radius);

  /** Energy and forces of a particle. Any periodic image of x will do. Errors of average() and
      of carry(); without has_director() the director is not looked at. */
  FootprintForces add(const CurvatureCoupling &particle, const Eigen::Vector3d &x,
                      const SurfacePoint &foot, const Director &director = {});

  /** Hands out the forces on control points by all particles added since update() or since the last
      call: give(face, force) for each face that has any, force[k] on control point k of stencil(face), a
      Lane4. Returns the virial of these particles, the sum of r f^T over them and control points, in images
      in which they are neighbours; its antisymmetric part is that of the torques on directors. */
  template <class Give> Eigen::Matrix3d take_forces(Give &&give);
  /// The same, added to an array [vertices].
  Eigen::Matrix3d take_forces(std::vector<Eigen::Vector3d> &force);

  /// Bytes held; graded rules are not counted.
  double memory_usage() const;

 private:
  struct Sums {
    double area = 0.0, curvature = 0.0;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  };

  const LimitSurface &surface_;
  std::unique_ptr<class FootprintPoints> points_;
  int visit_ = 0;                       // of particles
  std::vector<int> visited_;            // [faces] by which of them last
  double half_width_;                   // of the box
  std::vector<int> queue_, reached_;    // faces of a particle: looked at, with points in reach
  std::vector<int> touched_;            // faces with forces to be taken
  std::vector<struct NearBlock> near_;
  Eigen::Matrix3d virial_;
  Lane4 force_[MOST_STENCIL];    // on the control points of a face

  Footprints(const LimitSurface &surface, std::unique_ptr<class FootprintPoints> points);
  Sums look(const Eigen::Vector3d &x, const SurfacePoint &foot, double radius, bool directed);
  bool look_at_points(int face, const Eigen::Vector3d &from, double radius, bool directed);
  void pull_face(int face);
};

/* ---------------------------------------------------------------------- */

template <class Give> Eigen::Matrix3d Footprints::take_forces(Give &&give)
{
  for (int face : touched_) {
    pull_face(face);
    give(face, static_cast<const Lane4 *>(force_));
  }
  touched_.clear();
  const Eigen::Matrix3d sum = virial_;
  virial_.setZero();
  return sum;
}

}    // namespace Membrane_NS

#endif
