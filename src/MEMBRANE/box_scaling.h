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

#ifndef LMP_BOX_SCALING_H
#define LMP_BOX_SCALING_H

#include "pointers.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace LAMMPS_NS {

/** The box, with the atoms of a group, stretched about its centre: x -> c + A (x - c), A diagonal. Unwrapped
    coordinates follow the same map, image flags stay. Others stay where they are. Triclinic boxes keep the
    directions of A. */
class BoxScaling : protected Pointers {
 public:
  BoxScaling(class LAMMPS *lmp, int groupbit) : Pointers(lmp), groupbit(groupbit) {}

  /// Which image of the box, in box lengths.
  using Cell = std::array<int, 3>;
  /** Remembers the box and the positions of all owned atoms. cells: of each, from where its body begins, so that a
      body that is not in the group stays in one piece; empty if there are none across a side of the box. */
  void begin(std::vector<Cell> cells);
  /// Box and atoms of the group, from where begin() found them. Ghost atoms do not follow.
  void apply(const std::array<double, 3> &factors);
  /// Exactly as begin() found them.
  void put_back();

 private:
  int groupbit;
  std::array<double, 9> box;
  Eigen::Matrix3d vectors;    // of it
  std::vector<double> positions;
  std::vector<Cell> cells;

  std::array<double, 9> present() const;
  void set(const std::array<double, 9> &);
};

}    // namespace LAMMPS_NS

#endif
