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

#ifndef LMP_MEMBRANE_SURFACE_FAN_H
#define LMP_MEMBRANE_SURFACE_FAN_H

#include "membrane_surface_point.h"

namespace Membrane_NS {

/** Parameters for the faces around an extraordinary vertex in which the surface is as steep near the
    vertex as anywhere, and which know no sides: a plane with the vertex in its origin and neighbour i of
    Topology::ring() at (cos 2 pi i/n, sin 2 pi i/n).

    On the surface, subdivision shrinks distances to the vertex by its subdominant eigenvalue l, in u
    and v by 1/2: at a distance s = 1 - b_vertex in parameters they are s^g, g = -log2 l. The
    plane has the point with coordinates a and b towards neighbours i and i + 1, a + b = s, at
    s^(g-1) (a E_i + b E_i+1), to which the characteristic map of subdivision is close. */
struct FanPoint {
  int vertex;
  Eigen::Vector2d place;
  Eigen::Matrix2d slope;    ///< of place with respect to u, v of the face; not at the vertex
};

/// Of a point on a face, seen from its corner k.
FanPoint fan_point(const Topology &topology, const SurfacePoint &p, int k);
/// The point at a place, within the faces around the vertex or, beyond, on the line to the vertex where
/// that leaves them.
SurfacePoint point_in_fan(const Topology &topology, int vertex, const Eigen::Vector2d &place);
/// The extraordinary corner of its face that a point is closest to, within 1/2 in parameters, or -1.
int fan_corner(const Topology &topology, const SurfacePoint &p);

}    // namespace Membrane_NS

#endif
