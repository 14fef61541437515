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

#ifndef LMP_MEMBRANE_SRD_INVERSE_MASK_H
#define LMP_MEMBRANE_SRD_INVERSE_MASK_H

#include "membrane_srd_control_weights.h"
#include "membrane_topology.h"

#include <unordered_map>
#include <vector>

namespace Membrane_NS {

/** Rows of L^-1, the inverse of the limit mask r = L q, worked out when asked for. They fall off
    exponentially with the distance on the mesh, so one takes a neighbourhood, not the mesh; each
    rank can find any of them, for they depend on the topology alone. Exact to 1e-15. */
class InverseMask : public ControlWeights {
 public:
  /// The topology must outlive this.
  explicit InverseMask(const Topology &topology);
  /// Rows are asked for, and have vertices, in other numbers than the topology's: these are its
  /// vertices in the order of those numbers. All vertices of a row must be among them.
  void renumber(const std::vector<int> &vertices);
  const Row &row(int control_point) override;
  double memory_usage() const;

 private:
  const Topology &topology_;
  std::vector<double> centre_, spoke_;    // the entries of L
  double lowest_ = 1.0;                   // eigenvalue
  int passes_ = 0;
  std::unordered_map<int, Row> known_;
  size_t entries_ = 0;
  std::vector<double> x_, residual_, step_, next_;    // zero but while a row is worked out
  std::vector<char> reached_;
  std::vector<int> vertices_, number_;    // from a user's numbers to the topology's and back

  Row solve(int v);
};

}    // namespace Membrane_NS

#endif
