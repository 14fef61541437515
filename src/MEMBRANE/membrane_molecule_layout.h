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

#ifndef LMP_MEMBRANE_MOLECULE_LAYOUT_H
#define LMP_MEMBRANE_MOLECULE_LAYOUT_H

#include "membrane_molecule_patch.h"
#include "membrane_molecule_surface.h"
#include "membrane_molecule_team.h"

namespace Membrane_NS {

/// Where a lipid is to stand: on the neutral surface of its leaflet.
struct LipidSite {
  SurfacePoint point;
  Eigen::Vector3d x, normal;
  Eigen::Vector3d along;    ///< where the patch's x axis has gone
  int conformer, leaflet;
};

/// The patch of each leaflet; both may be the same.
using LeafletPatches = std::array<const Patch *, LEAFLETS>;

/** Lays flat patches on one connected surface, by charts.

    The centres of charts are spread evenly over the limit surface, about min(0.8 patch edge, R) apart, R its
    radius of curvature. Each has one random point of the patch and one random turn, for both leaflets. From
    there geodesics of the leaflet's neutral surface go to the lateral centre of each lipid, as
    far and in the direction as in the patch, and carry the direction along; the lipid is kept if
    no other centre is nearer to it. Neighbours in the patch so are neighbours on the surface but
    across the borders of charts.

    A periodic plane whose sides are whole multiples of the patch's sides gets copies of the patch, and
    `exact` is set. Work is shared; the result is the same for any team, and each has all of it. */
std::vector<LipidSite> lay_out(const ParallelSurfaces &surfaces, const LeafletPatches &patches,
                               const CounterRandom &random, Team &team, bool &exact);

}    // namespace Membrane_NS

#endif
