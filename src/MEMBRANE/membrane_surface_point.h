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

#ifndef LMP_MEMBRANE_SURFACE_POINT_H
#define LMP_MEMBRANE_SURFACE_POINT_H

#include "membrane_topology.h"

#include <Eigen/Core>

namespace Membrane_NS {

/** A place on the limit surface: the point corner0 (1-u-v) + corner1 u + corner2 v of a face, 0 <= u, v,
    u + v <= 1. A value: it knows neither the mesh nor where it is in space, for which there are
    walk() and LimitSurface. A place on an edge or at a vertex can be told in several ways. */
struct SurfacePoint {
  int face = -1;    ///< of the topology; -1: nowhere
  double u = 1.0 / 3.0, v = 1.0 / 3.0;

  std::array<double, 3> barycentric() const { return {1.0 - u - v, u, v}; }
  static SurfacePoint at_corner(int face, int k)
  {
    return {face, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0};
  }
};

/// Where a walk ended.
struct SurfaceWalk {
  SurfacePoint end;
  Eigen::Matrix2d turn = Eigen::Matrix2d::Identity();    ///< see walk()
  int edges = 0;                                         ///< crossed
  int vertices = 0;    ///< extraordinary ones gone straight through
};

/** Goes from `start` by `step` = (du, dv), in a straight line in the parameters.

    Across an edge the neighbouring face is unfolded into the parameter plane of this one: with
    barycentric coordinates b, edge from corner i to j, and k the third,
      b'_across = -b_k,  b'_i = b_i + b_k,  b'_j = b_j + b_k.
    This is exact, with integers for coefficients, and the surface is twice continuously differentiable
    in these parameters across every edge, whatever the valences at its ends. `turn` is the product of
    these maps for differences: a vector (du, dv) of the first face is turn (du, dv) in the last one,
    and along an edge both are the same tangent vector in space. The step itself has become turn * step,
    and walking by minus that goes back.

    Around an extraordinary vertex faces do not fit into one plane, n times 60 degrees to the plane's
    360: lines that pass it on its two sides part. A line that goes through it, closer than VERTEX_HIT,
    continues with equal angles, 30 n degrees, on both sides. A line that ends there ends in the vertex.
    One that starts there is unfolded around the nearer side. Through regular vertices a line goes
    straight.

    MeshError for a step that is longer than LONGEST_WALK or not a number. */
SurfaceWalk walk(const Topology &topology, const SurfacePoint &start, const Eigen::Vector2d &step);

/// How close to an extraordinary vertex, in parameters, a line goes through it.
constexpr double VERTEX_HIT = 1.0e-12;
/// The longest step, in parameters: its rounding errors would be those of 1e-10 edges.
constexpr double LONGEST_WALK = 1.0e6;

}    // namespace Membrane_NS

#endif
