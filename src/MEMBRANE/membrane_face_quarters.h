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

#ifndef LMP_MEMBRANE_FACE_QUARTERS_H
#define LMP_MEMBRANE_FACE_QUARTERS_H

#include "membrane_face_groups.h"

#include <utility>
#include <vector>

namespace Membrane_NS {

/** Faces whose rule cuts them in four, evaluated by quarters. A quarter has one extraordinary corner at most: there are few
    kinds of them, whatever valences meet in the faces of a mesh, so that blocks are full, rules are short and most are regular.
    Control points of quarters are kept apart for each face, since neighbours are in blocks of other groups. */
class FaceQuarters {
 public:
  FaceQuarters() = default;
  /// Of groups of faces, which it does not keep.
  explicit FaceQuarters(const std::vector<FaceGroup> &groups);

  /// Groups of quarters, with points in x() and slots of their own.
  const std::vector<FaceGroup> &groups() const { return groups_; }
  /// [slots of quarters] The slot of the face.
  const std::vector<int> &faces() const { return faces_; }

  // for a call with the groups and the control points of faces

  /// Places control points of quarters, and sets forces on them to 0.
  void place(const std::vector<FaceGroup> &groups, const double (*x)[3]);
  const double (*x() const)[3] { return reinterpret_cast<const double(*)[3]>(x_.data()); }
  double (*f())[3] { return reinterpret_cast<double(*)[3]>(f_.data()); }
  /// Adds forces on quarters to those on the control points of faces.
  void pull(const std::vector<FaceGroup> &groups, double (*f)[3]) const;

  double memory_usage() const;

 private:
  std::vector<FaceGroup> groups_;
  std::vector<int> faces_;
  std::vector<double> x_, f_;    // [points][3]; by groups of faces, in these [blocks][points of a face][LANES]
};

/// The faces that a kernel works on.
struct FaceGroups : std::vector<FaceGroup> {
  FaceQuarters quarters;

  FaceGroups() = default;
  FaceGroups(std::vector<FaceGroup> &&groups) : std::vector<FaceGroup>(std::move(groups)), quarters(*this) {}
  double memory_usage() const;
};

}    // namespace Membrane_NS

#endif
