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

#ifndef LMP_MEMBRANE_SRD_CONTROL_WEIGHTS_H
#define LMP_MEMBRANE_SRD_CONTROL_WEIGHTS_H

#include <vector>

namespace Membrane_NS {

/** The velocity of a control point is a mean of the velocities of many vertices, qdot_j = sum_a l_a
    w_a with the row l of the inverse limit mask, L^-1. An impulse J on it changes w_a by l_a J/d_a.
    */
class ControlWeights {
 public:
  virtual ~ControlWeights() = default;
  struct Row {
    std::vector<int> vertex;
    std::vector<double> weight;    ///< sums to 1
  };
  /// Valid until the next call.
  virtual const Row &row(int control_point) = 0;
};

}    // namespace Membrane_NS

#endif
