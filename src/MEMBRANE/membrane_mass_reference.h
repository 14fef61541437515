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

#ifndef LMP_MEMBRANE_MASS_REFERENCE_H
#define LMP_MEMBRANE_MASS_REFERENCE_H

#include "membrane_triangle_mesh.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace Membrane_NS {

/** What membranes resist around a shape that they have: the second derivatives of their energy, in
    outline. Mass for sampling is made of it. Any consistent units. */
struct StiffnessReference {
  TriangleMesh shape;              ///< smooth, of the control points, each component in one piece
  std::vector<double> kc;          ///< [vertices] energy
  std::vector<double> tension;     ///< [faces] energy/area: what undulations feel, of any sign
  std::vector<double> shear;       ///< [faces] energy: modulus of regularize
  std::vector<double> stretch;     ///< [faces] energy/area: modulus of local area
  std::vector<char> closed;        ///< [components]
  double measure = 0.0;            ///< kT of the measure of the mesh that is in the energy; 0 if there is none

  /// An energy stiffness/2 (sum over vertices of gradient . dq)^2: of totals of a membrane.
  struct Total {
    double stiffness;
    std::vector<Eigen::Vector3d> gradient;    ///< [vertices]
  };
  std::vector<Total> totals;

  /** How far a shape has left this one: 1 - cos of the angle between normals of a vertex then and
      now, mean over the vertices; 0 for the same shape, 1 for none of it. */
  double distance(const TriangleMesh &now, const Topology &topology) const;
};

/** A shape without its short waves, those of less than some ten edges, which are noise in a membrane in
    thermal motion. Components stay where they are, in one piece and as large. */
TriangleMesh long_waves(const TriangleMesh &shape, const Topology &topology);

/// A reference that several masses share: who integrates renews it, all others follow.
struct SharedReference {
  std::shared_ptr<const StiffnessReference> now;
  int64_t renewals = 0;
};

}    // namespace Membrane_NS

#endif
