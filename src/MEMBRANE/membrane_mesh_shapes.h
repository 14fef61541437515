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

#ifndef LMP_MEMBRANE_MESH_SHAPES_H
#define LMP_MEMBRANE_MESH_SHAPES_H

#include "membrane_triangle_mesh.h"

namespace Membrane_NS {

// === Shapes
// Control points on the named surface, faces counter-clockwise from outside. The limit surface of
// a curved shape lies a little inside the points; interpolate() puts it through them. Every shape
// passes Topology. Throws MeshError for numbers that give no valid mesh, naming the number.

/// Icosahedron around the origin, refined: 10 * 4^level + 2 points, level 0 to 7; valences 5 and 6.
TriangleMesh icosphere(int level, double radius);

/** Plane spanned by the box vectors a and b at the fraction z of the box vector c, normal along +c,
    periodic along a and b. nx points in a row along a, ny rows along b (even), every other row
    shifted by half a spacing: all valences 6, equilateral where |b|/ny = sqrt(3)/2 |a|/nx.
    nx, ny >= 4. The corner of the box is the origin. */
TriangleMesh sheet(int nx, int ny, const Eigen::Matrix3d &lattice, double z);

/** Cylinder around the line through the origin along box vector `axis` (0, 1, 2), periodic along
    it, normals outward. ntheta points in a ring, nz rings (even), every other ring turned by half
    a spacing: all valences 6. ntheta >= 3, nz >= 4. */
TriangleMesh tube(int ntheta, int nz, double radius, const Eigen::Matrix3d &lattice, int axis);

/** Torus around the z axis through the origin, all valences 6. nu points around the axis at
    distance R, times nv around the tube of radius r < R; each step around the tube also turns half
    a spacing around the axis. nu >= 3, nv >= 4 and even. Point (i, j) is number i*nv + j. */
TriangleMesh torus(int nu, int nv, double R, double r);

// === Refinement and interpolation
// Both know periodic meshes. Both throw MeshError for faces that Topology rejects.

/// One step of Loop subdivision: the old points, moved, then one per edge; the same limit surface.
TriangleMesh loop_refine(const TriangleMesh &mesh);

/** Control points whose limit positions are the points given, to 1e-13 of the mesh size. Linear in
    the number of points. The limit surface runs through the points but may bend more between them
    than the surface they were taken from. */
TriangleMesh interpolate(const TriangleMesh &mesh);

/// The limit positions of all points: c p + (1-c)/n times the sum over the n neighbours, c from
/// limit_mask_centre().
std::vector<Eigen::Vector3d> limit_positions(const TriangleMesh &mesh);

}    // namespace Membrane_NS

#endif
