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

#ifndef LMP_MEMBRANE_SRD_SURFACE_H
#define LMP_MEMBRANE_SRD_SURFACE_H

#include "membrane_srd_collision.h"
#include "membrane_topology.h"

#include <array>
#include <vector>

namespace Membrane_NS {

/// What a triangulated surface is, apart from where its vertices are.
struct SurfaceFaces {
  std::vector<Face> faces;
  /// For each corner of a face the box vectors that bring its vertex next to the first corner; none
  /// for a surface in one piece that does not continue through the box.
  std::vector<std::array<std::array<int, 3>, 3>> seams;
};

/// A vertex of the surface: a point mass, or with inverse mass 0 one that nothing deflects; of a
/// finer surface, a mean of such masses.
struct SurfaceVertex {
  MovingPoint path;
  double inverse_mass = 0.0;                                 ///< not of a finer surface
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();    ///< by forces, see CollisionEvents
};

/// The corners of a face at the start of the step, together in the image of its first.
inline std::array<Eigen::Vector3d, 3> corners_together(const SurfaceFaces &surface, size_t face,
                                                       const std::vector<SurfaceVertex> &vertices,
                                                       const Eigen::Matrix3d &lattice)
{
  std::array<Eigen::Vector3d, 3> x;
  for (int k = 0; k < 3; ++k) {
    x[k] = vertices[surface.faces[face][k]].path.origin;
    if (!surface.seams.empty())
      for (int j = 0; j < 3; ++j) x[k] += surface.seams[face][k][j] * lattice.col(j);
  }
  return x;
}

/// A triangle of the surface, in the periodic image where a point may meet it.
struct SurfaceTriangle {
  std::array<int, 3> vertex;
  std::array<Eigen::Vector3d, 3> shift;    ///< from the vertices to the corners, at the start
  std::array<Eigen::Vector3d, 3> drift;    ///< velocity of that: images in a box that deforms
};

/// What has to happen in a step for a point to meet a triangle: nothing but the motion that is
/// known at its start; or vertices are deflected, by up to their slack; or the point turns.
enum class MeetingNeeds { NOTHING, DEFLECTION, TURN };

/// What collisions change of a point mass of the surface.
struct SurfaceChange {
  Eigen::Vector3d velocity, position;
};

}    // namespace Membrane_NS

#endif
