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

#ifndef LMP_MEMBRANE_CORNER_FORCES_H
#define LMP_MEMBRANE_CORNER_FORCES_H


#include "membrane_face_groups.h"
#include "membrane_lanes.h"

#include <algorithm>

namespace Membrane_NS {

/// The flat triangles of the control points of a block of faces, for energies of these.
struct CornerBlock {
  int slot, faces;      ///< the first of the block, and how many it has
  const int *points;    ///< [3][LANES]
  Lane3 place[3];
  Lane3 side[3];        ///< side k is that opposed to corner k, on to the next corner
  Lane3 normal;         ///< of length twice the area

  CornerBlock(const FaceGroup &group, int block) :
      slot(group.first_slot + block * LANES), faces(std::min(LANES, group.nfaces - block * LANES)),
      points(&group.points[static_cast<size_t>(block) * group.rule->size * LANES])
  {
  }

  /// Has some face of the block this weight?
  bool any(const Lane &weight) const
  {
    bool some = false;
    for (int l = 0; l < faces; ++l) some = some || weight[l] != 0.0;
    return some;
  }

  /// x is [points][3].
  void look(const double (*x)[3])
  {
    gather(points, 3, x, place);
    for (int k = 0; k < 3; ++k) side[k] = place[(k + 2) % 3] - place[(k + 1) % 3];
    normal = cross(side[0], side[1]);
  }

  /// The gradient of the area by corner k is this over 4 areas.
  Lane3 area_gradient(int k) const { return cross(normal, side[k]); }

  /// Subtracts gradients by the first two corners, and by the third what makes their sum zero, from f, [points][3],
  /// and adds their virial (xx yy zz xy xz yz) to `virial`, by slot, unless that is empty.
  void subtract_gradients(const Lane3 &first, const Lane3 &second, double (*f)[3], std::vector<double> &virial) const
  {
    const Lane3 g[3] = {first, second, Lane3{} - first - second};
    subtract(points, 3, faces, g, f);
    if (virial.empty()) return;
    Lane v[6] = {};
    for (int k = 1; k < 3; ++k) add_virial(place[k] - place[0], g[k], v);
    add_virial_of(v, virial);
  }

  void add_energy(const Lane &e, std::vector<double> &energy) const
  {
    for (int l = 0; l < faces && !energy.empty(); ++l) energy[slot + l] += e[l];
  }

  void add_virial_of(const Lane (&v)[6], std::vector<double> &virial) const
  {
    for (int l = 0; l < faces; ++l)
      for (int i = 0; i < 6; ++i) virial[6 * static_cast<size_t>(slot + l) + i] += v[i][l];
  }
};

/// a where there is a weight: without one a face may have no area either.
inline Lane where(const Lane &weight, const Lane &a, double otherwise = 0.0)
{
  return weight == 0.0 ? Lane{} + otherwise : a;
}
inline Lane3 where(const Lane &weight, const Lane3 &a)
{
  return {where(weight, a.x), where(weight, a.y), where(weight, a.z)};
}

}    // namespace Membrane_NS

#endif
