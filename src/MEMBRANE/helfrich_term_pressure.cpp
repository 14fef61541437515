/* -----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing author: MEMBRANE developers
------------------------------------------------------------------------- */

#include "helfrich_term_totals.h"

using namespace LAMMPS_NS;

namespace {

struct Coefficients {
  double pressure = 0.0;    // inside less outside

  bool active() const { return pressure != 0.0; }
  bool same(const Coefficients &o) const { return pressure == o.pressure; }
  void archive(RestartArchive &file) { file(pressure); }
};

/// -DP V for each membrane
class PressureTerm : public TermOfTotals<Coefficients> {
 public:
  explicit PressureTerm(LAMMPS *lmp) : TermOfTotals(lmp, "pressure", HelfrichOutput::VOLUME) {}

  Needs needs() const override
  {
    Needs needs;
    needs.totals = true;
    needs.volume = true;
    return needs;
  }

 protected:
  int read(const HelfrichWords &words, Coefficients &c) const override
  {
    c.pressure = words.number(1);
    return 2;
  }
  double law(const Coefficients &c, int, const MeshTotals::Total &total,
             Conjugates &slope) const override
  {
    slope.pressure = -c.pressure;
    return -c.pressure * total.volume;
  }
};

}    // namespace

/* ---------------------------------------------------------------------- */

std::unique_ptr<HelfrichTerm> LAMMPS_NS::make_pressure_term(LAMMPS *lmp)
{
  return std::make_unique<PressureTerm>(lmp);
}
