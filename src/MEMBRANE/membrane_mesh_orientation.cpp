/* -----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing author: MEMBRANE developers
------------------------------------------------------------------------- */

#include "membrane_mesh_orientation.h"

#include <limits>

using namespace Membrane_NS;
using Eigen::Vector3d;

/* ----------------------------------------------------------------------
   unwrapped from the first vertex on; where a way around ends in another image there is no inside
------------------------------------------------------------------------- */

std::vector<double> Membrane_NS::enclosed_volumes(const Topology &topology,
                                                  const TriangleMesh &mesh)
{
  std::vector<Vector3d> x(mesh.points.size());    // relative to the component's first vertex
  std::vector<bool> placed(mesh.points.size(), false);
  std::vector<int> stack;
  for (int seed = 0; seed < topology.num_vertices(); ++seed) {
    if (placed[seed]) continue;
    x[seed].setZero();
    placed[seed] = true;
    stack.push_back(seed);
    while (!stack.empty()) {
      const int v = stack.back();
      stack.pop_back();
      for (int w : topology.ring(v))
        if (!placed[w]) {
          x[w] = x[v] + mesh.edge(v, w);
          placed[w] = true;
          stack.push_back(w);
        }
    }
  }

  std::vector<double> volumes(topology.num_components(), 0.0);
  const Eigen::Matrix3d to_fraction = mesh.is_periodic() ? Eigen::Matrix3d(mesh.lattice.inverse())
                                                         : Eigen::Matrix3d::Zero();
  for (const Face &face : mesh.faces) {
    double &volume = volumes[topology.component(face[0])];
    volume += x[face[0]].dot(x[face[1]].cross(x[face[2]])) / 6.0;
    if (!mesh.is_periodic()) continue;
    for (int k = 0; k < 3; ++k) {
      const int v = face[k], w = face[(k + 1) % 3];
      const Vector3d jump = to_fraction * (x[w] - x[v] - mesh.edge(v, w));
      if (jump.cwiseAbs().maxCoeff() > 0.5) volume = std::numeric_limits<double>::quiet_NaN();
    }
  }
  return volumes;
}

/* ---------------------------------------------------------------------- */

int Membrane_NS::turn_components(TriangleMesh &mesh, const Topology &topology,
                                 const std::vector<bool> &which)
{
  int turned = 0;
  for (Face &face : mesh.faces)
    if (which[topology.component(face[0])]) {
      std::swap(face[1], face[2]);
      ++turned;
    }
  return turned;
}
