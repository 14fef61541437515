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

#ifndef LMP_MEMBRANE_MODE_SPACE_H
#define LMP_MEMBRANE_MODE_SPACE_H

#include "membrane_lanes.h"
#include "membrane_triangle_mesh.h"

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include <cstdint>
#include <stdexcept>
#include <vector>

namespace Membrane_NS {

/// Which modes a membrane has.
struct ModeChoice {
  enum class Shape {
    PLANE,     ///< waves along z on a sheet that continues through the box in x and y
    SPHERE,    ///< harmonics along the radius of a closed membrane
    FILE       ///< displacements of control points that somebody has written down
  };
  Shape shape = Shape::PLANE;
  int lowest = 0, highest = 0;    ///< degrees l; or of the larger of |nx|, |ny|
  bool one = false;               ///< a single wave
  int nx = 0, ny = 0;

  struct Mode {
    int first, second;    ///< l, m or nx, ny; the number of a mode of a file and 0
    bool sine;            ///< of a wave, which has a cosine and after it a sine
  };
  /// Waves and harmonics in the order of compute hd/modes. l = 1, which moves a sphere as a whole, is left out.
  std::vector<Mode> list() const;
};

/** The modes of one membrane: displacements of its control points

      dq_i = sum_j psi_ij b_j,   b_j = sum_k couple_jk a_k

    with scalars psi, made of functions of the limit surface by L^-1, and vectors b_j in space. */
struct MembraneModes {
  int component;
  double length;                ///< amplitudes of compute hd/modes are in units of this: radius, or 1
  double norm;                  ///< integral of the square of a mode over the area; 0 if not known
  std::vector<int> vertices;    ///< of the topology
  int functions;                ///< a multiple of LANES: the rest are 0
  std::vector<Lane> psi;        ///< [vertices][functions]
  Eigen::SparseMatrix<double> couple;    ///< [3 functions][modes]: x of all functions, then y, then z
  std::vector<ModeChoice::Mode> modes;
  std::vector<double> wave_number;    ///< [modes]
};

/// The modes of all membranes of a group about a reference shape q0.
struct ModeSpace {
  std::vector<Eigen::Vector3d> reference;    ///< q0 by vertex of the topology
  std::vector<MembraneModes> membranes;
  int count() const;
  int num_vertices() const;
  double memory_usage() const;
};

/// A mesh or a shape that does not carry these modes; what() says why and what to do.
class ModeError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Where a reference is.
struct ReferenceFrame {
  Eigen::Vector3d middle;
  double radius;    ///< SPHERE; of a sheet the square root of its area
};

/** The reference of a membrane of this shape: control points of the sphere (or sheet at one height) about which
    its limit positions have the modes of the choice and neither a mean nor l = 1. For FILE the shape itself.
    Writes the vertices of the component. ModeError if it is far from one. */
ReferenceFrame find_reference(const Topology &topology, int component, const TriangleMesh &shape,
                              const ModeChoice &choice, TriangleMesh &reference);

/// PLANE and SPHERE: the modes about a reference. ModeError if the mesh is too coarse for them.
MembraneModes make_modes(const Topology &topology, int component, const TriangleMesh &reference,
                         const ReferenceFrame &frame, const ModeChoice &choice);
/// FILE: displacements[modes] of all vertices of the topology.
MembraneModes make_modes(const Topology &topology, int component,
                         const std::vector<std::vector<Eigen::Vector3d>> &displacements);

/// Y_lm, number l^2 + l + m, in the direction of a unit vector; see sphere_harmonics().
void harmonics_at(const Eigen::Vector3d &direction, int lmax, double *values);

}    // namespace Membrane_NS

#endif
