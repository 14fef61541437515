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

#ifndef LMP_MESH_TOTALS_H
#define LMP_MESH_TOTALS_H

#include "membrane_helfrich.h"
#include "mesh_local.h"

#include <algorithm>
#include <vector>

namespace LAMMPS_NS {

/** Areas and enclosed volumes of all membranes, summed over the ranks.

    V = (1/3) sum weight (r - centre).n dA, with the centre of the component's control points: the
    quadrature of n dA over a closed surface vanishes only to its own accuracy, and measuring from
    the centre keeps V, and so total momentum, exactly independent of where the membrane is. */
class MeshTotals : protected Pointers {
 public:
  /// Sums over a connected component of the mesh, or over those of a membrane.
  struct Total {
    double area = 0.0, volume = 0.0;
    double curvature = 0.0;                     ///< integral of 2H
    double vector_area[3] = {0.0, 0.0, 0.0};    ///< components only
    double centre[3] = {0.0, 0.0, 0.0};         ///< components only; unwrapped
  };

  /// The handle must outlive this.
  MeshTotals(class LAMMPS *, const LocalMesh &);

  /// What besides areas.
  struct Wanted {
    bool volume, curvature;
  };
  /** Collective. Areas, and what else is wanted, of the faces of these groups, of their components
      and of their membranes. A membrane's volume is that of its closed components. With volumes, the
      model's origins are at the centres afterwards, moved to the periodic image each face is in. */
  void measure(Membrane_NS::FaceGroups &, Membrane_NS::FaceModel &,
               Membrane_NS::FaceIntegrals &, const Wanted &);
  /** Collective. Only the centres of the components, and the model's origins there, without integrals. These
      stay good until reneighbouring moves atoms to other images. */
  void place(const std::vector<Membrane_NS::FaceGroup> &, Membrane_NS::FaceModel &);
  const std::vector<Total> &components() const { return parts; }
  const std::vector<Total> &membranes() const { return sums; }

  /// The connected component of the face in a slot of a group.
  int component_of(const Membrane_NS::FaceGroup &group, int slot) const
  {
    const auto &topology = mesh->topology();
    if (topology.num_components() == 1) return 0;    // most scenes, and each step asks for every face
    return topology.component(topology.face(group.face[std::min(slot, group.nfaces - 1)])[0]);
  }

 private:
  const LocalMesh &mesh;
  std::pair<bigint, bigint> seen{-1, -1};    // stamp of the mesh that parts are for
  std::vector<Total> parts, sums;

  void place_centres();
  void unwrap(int i, double *at) const;
  void place_origins(const std::vector<Membrane_NS::FaceGroup> &, Membrane_NS::FaceModel &) const;
};

}    // namespace LAMMPS_NS

#endif
