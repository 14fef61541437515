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

#ifndef LMP_MESH_LIPIDS_H
#define LMP_MESH_LIPIDS_H

#include "lmptype.h"

#include <vector>

namespace LAMMPS_NS {

/** What lipids there are on each face, as far as its energy is concerned: the spontaneous curvature of the
    monolayers of either leaflet, by face of the topology and the same on the ranks that have the face. While
    active it stands in place of the mean over corners that `lipids` of pair style helfrich gives, 0 at those without. Who
    writes here counts the stamp up, on all ranks together. */
struct MeshLipids {
  bool active = false;
  bigint stamp = 0;
  std::vector<double> outer, inner;    ///< [faces], of the sign of LipidKind::c0
};

}    // namespace LAMMPS_NS

#endif
