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

#ifndef LMP_BOUND_SITE_FILE_H
#define LMP_BOUND_SITE_FILE_H

#include "bound_sites.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/// A site with the atom that it is of.
struct SiteOfAtom {
  tagint atom = 0;
  BoundSite site;               ///< its face is known by the corners; without leaflet it is 0
  bool has_distance = false;    ///< of the site
  int line = 0;                 ///< of the file
};

/** Files of sites: what fix hd/bind reads and write_bound writes. A line for each atom, with

      ID i j k bi bj bk [in|out [distance [tx ty tz]]]

    the atom IDs of the corners of its face, the barycentric coordinates, and if they matter leaflet,
    distance from the surface, outward positive, and director. # begins a comment. */
class BoundSiteFile {
 public:
  /// Collective: reads a file; stops at the first line that is wrong. Faces are not looked at.
  static std::vector<SiteOfAtom> read(class LAMMPS *, const std::string &path);
  /// On one rank: writes sites of all atoms.
  static void write(class LAMMPS *, const std::string &path, const std::vector<SiteOfAtom> &);
};

}    // namespace LAMMPS_NS

#endif
