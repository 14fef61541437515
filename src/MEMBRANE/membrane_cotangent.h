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

#ifndef LMP_MEMBRANE_COTANGENT_H
#define LMP_MEMBRANE_COTANGENT_H

#include "membrane_triangle_mesh.h"

#include <Eigen/SparseCore>

#include <vector>

namespace Membrane_NS {

/// Areas and normals of a mesh of flat triangles, in any unit of length.
struct FlatAreas {
  FlatAreas(const TriangleMesh &mesh, const Topology &topology);
  std::vector<double> faces, components;
  Eigen::VectorXd vertices;                ///< a third of the faces around
  std::vector<Eigen::Vector3d> normals;    ///< of vertices, by area, of length 1
};

/** The Laplacian of a mesh by cotangents, K = sum over faces of weight times

      K_f,  u^T K_f u = integral over face f of |grad u|^2,

    symmetric and positive semi-definite; without dimension if weights are. Cotangents are bounded from
    below, so that off the diagonal nothing is positive on any mesh. */
Eigen::SparseMatrix<double> cotangent_laplacian(const TriangleMesh &mesh, const Topology &topology,
                                                const std::vector<double> &weights);

}    // namespace Membrane_NS

#endif
