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

#ifndef LMP_MEMBRANE_SRD_COLLISION_H
#define LMP_MEMBRANE_SRD_COLLISION_H

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

/** The impulse J that a point of mass m receives from a surface point x = sum g_a r_a of point
    masses d_a: v changes by J/m, w_a by -g_a J/d_a. With the relative velocity u = v - sum g_a w_a
    and the effective inverse mass 1/mu = 1/m + sum g_a^2/d_a,

      slip:     J = -2 mu (u.n) n        no slip:  J = -2 mu u

    which reverses u.n, or u, and so keeps the kinetic energy; linear momentum is kept because
    sum g_a = 1, angular momentum because sum g_a r_a x J = x x J. */
inline Eigen::Vector3d collision_impulse(const Eigen::Vector3d &relative,
                                         const Eigen::Vector3d &normal, double inverse_mass,
                                         bool no_slip)
{
  return -2.0 / inverse_mass * (no_slip ? relative : relative.dot(normal) * normal);
}

/// The point of a resting triangle that is nearest to x, as barycentric coordinates [C. Ericson,
/// Real-Time Collision Detection, 5.1.5].
std::array<double, 3> nearest_on_triangle(const Eigen::Vector3d &x, const Eigen::Vector3d &a,
                                          const Eigen::Vector3d &b, const Eigen::Vector3d &c);

}    // namespace Membrane_NS

#endif
