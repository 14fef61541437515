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

#ifndef LMP_MEMBRANE_SRD_CLEARANCE_H
#define LMP_MEMBRANE_SRD_CLEARANCE_H

#include "membrane_triangle_mesh.h"

#include <vector>

namespace Membrane_NS {

/// Whether points keep a distance from the triangles of a mesh, in all periodic images.
class SurfaceClearance {
 public:
  /// distance: positive.
  SurfaceClearance(const TriangleMesh &mesh, double distance);

  /// A point in any periodic image.
  bool is_clear(const Eigen::Vector3d &x) const;

 private:
  const TriangleMesh mesh_;
  double distance_;
  Eigen::Matrix3d to_fraction_;
  Eigen::Vector3d lo_, hi_;    // fractional bounds of the bins
  std::array<int, 3> bins_;
  std::vector<std::vector<int>> triangles_;    // of a bin

  int bin(int k, double fraction) const;
};

}    // namespace Membrane_NS

#endif
