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

#ifndef LMP_MEMBRANE_TRIANGLE_MESH_H
#define LMP_MEMBRANE_TRIANGLE_MESH_H

#include "membrane_topology.h"

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <vector>

namespace Membrane_NS {

/** Points, faces and the periodic box they live in: what mesh files and shapes hand over.

    Lengths are in the user's unit. The points may lie anywhere: a face joins the periodic images
    of its corners that are nearest to one another, so in a periodic direction every edge must be
    shorter than half the box. Nothing is checked here; Topology checks the faces. */
struct TriangleMesh {
  std::vector<Eigen::Vector3d> points;
  std::vector<Face> faces;                                  ///< counter-clockwise from outside
  Eigen::Matrix3d lattice = Eigen::Matrix3d::Identity();    ///< columns are the box vectors
  std::array<bool, 3> periodic = {false, false, false};     ///< along each box vector

  bool is_periodic() const { return periodic[0] || periodic[1] || periodic[2]; }

  /// From point a to the nearest periodic image of point b. Needs an invertible lattice.
  Eigen::Vector3d edge(int a, int b) const { return nearest_image(points[b] - points[a]); }

  /// The periodic image of a difference whose fractional coordinates lie within +-1/2.
  Eigen::Vector3d nearest_image(const Eigen::Vector3d &difference) const;
};

/* ---------------------------------------------------------------------- */

inline Eigen::Vector3d TriangleMesh::nearest_image(const Eigen::Vector3d &difference) const
{
  if (!is_periodic()) return difference;
  Eigen::Vector3d shift = lattice.inverse() * difference;
  for (int k = 0; k < 3; ++k) shift[k] = periodic[k] ? std::round(shift[k]) : 0.0;
  return difference - lattice * shift;
}

}    // namespace Membrane_NS

#endif
