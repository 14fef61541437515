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

#ifndef LMP_MEMBRANE_COLLISION_H
#define LMP_MEMBRANE_COLLISION_H

#include <Eigen/Core>

#include <array>

namespace Membrane_NS {

/// A point on a straight path: at time t of the step at origin + velocity t.
struct MovingPoint {
  Eigen::Vector3d origin, velocity;
  Eigen::Vector3d at(double t) const { return origin + velocity * t; }
  /// A new velocity from time t on: the place at t stays the same.
  void turn(double t, const Eigen::Vector3d &change)
  {
    velocity += change;
    origin -= change * t;
  }
};

/// Where and when a point meets a triangle.
struct TriangleHit {
  double time = 0.0;
  std::array<double, 3> weight = {};    ///< barycentric: the point is sum weight[k] corner[k]
  /// Of length 1; seen from its tip the corners are counter-clockwise.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

/** The first time in [begin, end] at which a moving point passes from its own side of a moving
    triangle to the other: side +1 is where the normal points, -1 the other.

    The signed volume of point and triangle, times the side, is a cubic in time; a hit is where it
    falls through zero with the point inside the triangle, found on the cubic's monotone pieces.
    Two tolerances make a closed surface tight against rounding, which is smaller than both:
    triangles are `edge_tolerance` (in barycentric coordinates) larger than they are, so that no gap
    is left where they meet; and a point that is on the wrong side by less than `contact` (a length)
    hits if it goes on, and is let back if it comes back. `touching` says that it has just hit this
    triangle: rounding alone has then decided on which side it is. */
class TriangleCollision {
 public:
  double contact = 1.0e-10;
  static constexpr double edge_tolerance = 1.0e-8;

  /// Returns whether there is a hit.
  bool find(const MovingPoint &point, const std::array<MovingPoint, 3> &triangle, int side,
            double begin, double end, bool touching, TriangleHit &hit) const;
};

/** The impulse that a point of mass m receives from a surface point x = sum b_k r_k of a triangle whose
    corners are the masses d_k: v changes by J/m, w_k by -b_k J/d_k. With the effective inverse mass
    s = sum b_k^2/d_k of the surface point and the relative velocity u = v - sum b_k w_k,

      slip:     J = -2 (u.n) n / (1/m + s)        no slip:  J = -2 u / (1/m + s)

    which reverses u.n, or u, and so keeps the kinetic energy; linear momentum is kept because
    sum b_k = 1, angular momentum because sum b_k r_k x J = x x J. */
Eigen::Vector3d collision_impulse(const TriangleHit &hit, const Eigen::Vector3d &point_velocity,
                                  const std::array<Eigen::Vector3d, 3> &corner_velocities,
                                  double inverse_mass,
                                  const std::array<double, 3> &corner_inverse_masses, bool no_slip);

/// The point of a resting triangle that is nearest to x, as barycentric coordinates [C. Ericson,
/// Real-Time Collision Detection, 5.1.5].
std::array<double, 3> nearest_on_triangle(const Eigen::Vector3d &x, const Eigen::Vector3d &a,
                                          const Eigen::Vector3d &b, const Eigen::Vector3d &c);

}    // namespace Membrane_NS

#endif
