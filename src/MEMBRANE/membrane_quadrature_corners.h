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

#ifndef LMP_MEMBRANE_QUADRATURE_CORNERS_H
#define LMP_MEMBRANE_QUADRATURE_CORNERS_H

#include <vector>

namespace Membrane_NS {

/** A point of a rule that was fitted to the patch (n, 6, 6), extraordinary corner at u = v = 0, in the patch's own
    parameters; where u and v differ, (v, u) is a point with the same weights. `weight` is for what depends on
    curvature, `area_weight` for area and volume. Points are inside and weights positive. */
struct CornerPoint {
  double u, v, weight, area_weight;
};

/** The rule with that many points, mirror images counted, for a valence; empty if there is none. They are fitted by
    bench/corner_rules.cpp, whose head says to what. */
const std::vector<CornerPoint> &corner_points(int valence, int npoints);

}    // namespace Membrane_NS

#endif
