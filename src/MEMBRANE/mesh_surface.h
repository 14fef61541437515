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

#ifndef LMP_MESH_SURFACE_H
#define LMP_MESH_SURFACE_H

#include "membrane_limit_surface.h"
#include "mesh_distributed.h"

#include <vector>

namespace LAMMPS_NS {

/** The limit surface where this rank is: its control points are LAMMPS' owned and ghost atoms as they are now.
    Nothing is copied or exchanged: what is not looked at costs nothing. A face is where an image of
    its first corner is that this rank has; use nearest_image() of differences. */
class LocalSurface : public Membrane_NS::LimitSurface {
 public:
  /// Collective; of the mesh as it is: when its topology changes, make another. It must outlive this.
  LocalSurface(class LAMMPS *, DistributedMesh &);

  /// Call when LAMMPS has reneighboured, and local indices of atoms are others.
  void forget_atoms() { ++epoch; }
  /// Call in each step: the box may have changed.
  void follow_box();

  /// Where there are several images of a face, take the one next to this owned atom.
  void look_from(int atom) { viewer = atom; }

  /// The local indices of the control points of a face, as stencil() has them. Stops if the
  /// communication cutoff does not reach them.
  const int *atoms(int face) const;

  /// Says what atoms(face) would find, which is then not looked up: of one face at a time, -1 for none.
  void expect(int face, const int *local)
  {
    expected_face = face;
    expected = local;
  }

  double memory_usage() const override;

 private:
  class LAMMPS *lmp;
  DistributedMesh &mesh;
  int epoch = 1, viewer = -1, expected_face = -1;
  const int *expected = nullptr;
  mutable std::vector<int> atom_of, found;    // [as stencil_], [faces] epoch in which they were looked up

  void gather(int face, Membrane_NS::Lane4 *x) const override;
};

}    // namespace LAMMPS_NS

#endif
