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

#ifndef LMP_HELFRICH_TERM_BENDING_H
#define LMP_HELFRICH_TERM_BENDING_H

#include "helfrich_term.h"

namespace LAMMPS_NS {

struct BendingCoefficients {
  double kc = 0.0, c0 = 0.0;
  bool set = false;    ///< a pair_coeff line was given

  bool active() const { return set; }
  void archive(RestartArchive &file)
  {
    file(kc);
    file(c0);
    file(set);
  }
};

/// kc/2 (2H - c0)^2 per area: the two numbers that every pair_coeff line begins with.
class HelfrichTermBending : public TermWith<BendingCoefficients> {
 public:
  explicit HelfrichTermBending(class LAMMPS *);

  void localize(const std::vector<Membrane_NS::FaceGroup> &, Membrane_NS::FaceModel &) override;
  void tally(const HelfrichScene &, HelfrichTally &) const override;
  /// kc by type, from 1.
  std::vector<double> moduli() const;
  /// c0 by type.
  double spontaneous_curvature(int type) const { return by_type[type].c0; }

 protected:
  int read(const HelfrichWords &, BendingCoefficients &) const override;
};

}    // namespace LAMMPS_NS

#endif
