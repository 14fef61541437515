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

#ifndef LMP_BOUND_SEARCH_H
#define LMP_BOUND_SEARCH_H

#include "membrane_closest_point.h"
#include "mesh_distributed.h"

#include <memory>
#include <vector>

namespace LAMMPS_NS {

/** The closest point of some connected components of the mesh, each with its own surface and grid: for
    atoms of which nothing is known yet. All of it is on every rank; make it, ask, and let it go. */
class BoundSearch {
 public:
  /// Of the mesh at its last update().
  BoundSearch(const DistributedMesh &, const std::vector<int> &components);

  struct Found {
    Membrane_NS::ClosestPoint closest;    ///< face is of the whole mesh
    int component = -1;                   ///< -1: there is nothing to find
    double next = INFINITY;               ///< distance to the next component
    int next_component = -1;
  };
  /// Collective it is not.
  Found find(const Eigen::Vector3d &x) const;

 private:
  struct Part {
    int component;
    std::vector<int> face;    // in the whole mesh
    Membrane_NS::Topology topology;
    std::unique_ptr<Membrane_NS::LimitSurfaceOfMesh> surface;
    std::unique_ptr<Membrane_NS::ClosestPointFinder> finder;
  };
  std::vector<std::unique_ptr<Part>> parts;
};

}    // namespace LAMMPS_NS

#endif
