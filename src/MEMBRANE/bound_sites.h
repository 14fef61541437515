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

#ifndef LMP_BOUND_SITES_H
#define LMP_BOUND_SITES_H

#include "membrane_surface_point.h"
#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {

/// Where an atom is held on a membrane.
struct BoundSite {
  tagint corner[3] = {0, 0, 0};          ///< atom IDs of the face's corners, the first of `point` first; 0: free
  Membrane_NS::SurfacePoint point;       ///< the closest point of the surface
  double distance = 0.0;                 ///< from it, positive on the outer side
  int leaflet = 0;                       ///< 1 outer, -1 inner
  double director[3] = {0.0, 0.0, 0.0};  ///< of length 1, along the surface; 0 if it has none
  double normal[3] = {0.0, 0.0, 0.0};    ///< of the footprint where the director is along the surface

  double pull = 0.0;                     ///< of a rigid hold, the force along the normal in this step
  double curvature = 0.0;                ///< 2Hbar of its footprint in the last step; does not follow the atom

  bool bound() const { return corner[0] != 0; }
};

/** The sites of the atoms of a fix, which LAMMPS moves between ranks, sorts, and keeps in restart files
    with the atoms. Faces are known by their corners, since they may be renumbered between runs. */
class BoundSites {
 public:
  BoundSite &operator[](int i) { return sites[i]; }
  const BoundSite &operator[](int i) const { return sites[i]; }

  /// Has the processor read a site while it does something else.
  void prefetch(int i) const
  {
    __builtin_prefetch(&sites[i]);
    __builtin_prefetch(&sites[i].director);
  }

  void grow(int nmax) { sites.resize(nmax); }
  void copy(int from, int to) { sites[to] = sites[from]; }
  void clear(int i) { sites[i] = BoundSite(); }

  static constexpr int SIZE = 15;    ///< numbers of a site
  int pack(int i, double *buf) const;
  int unpack(int i, const double *buf);
  double memory_usage() const { return sizeof(BoundSite) * sites.capacity(); }

 private:
  std::vector<BoundSite> sites;
};

/// Puts a site into the present numbering of faces and order of corners; its face is -1 if there is no such face any more.
void find_again(const class MeshFaces &, BoundSite &);

}    // namespace LAMMPS_NS

#endif
