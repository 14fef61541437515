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

#include "error.h"

using namespace LAMMPS_NS;

namespace {

/** KA/2 (A - A0)^2/A0 for each membrane */
class AreaTerm : public TermWithTarget<TargetCoefficients> {
 public:
  explicit AreaTerm(LAMMPS *lmp) : TermWithTarget(lmp, "area", HelfrichOutput::AREA) {}

  Needs needs() const override
  {
    Needs needs;
    needs.totals = needs.origins = true;
    return needs;
  }

 protected:
  int read(const HelfrichWords &words, TargetCoefficients &c) const override
  {
    c.modulus = words.modulus(1);
    c.init = !words.number_or_init(2, c.target);
    if (!c.init && c.target <= 0.0)
      error->all(FLERR, "pair_coeff helfrich reference area {} must be positive or init",
                 words.word(2));
    return 3;
  }
  double compared(const TargetCoefficients &, const MeshTotals::Total &total) const override
  {
    return total.area;
  }
  double law(const TargetCoefficients &c, int m, const MeshTotals::Total &total,
             Conjugates &slope) const override
  {
    const double d = excess(c, m, total), a0 = target(m);
    slope.tension = c.modulus * d / a0;
    return 0.5 * c.modulus * d * d / a0;
  }
};

}    // namespace

/* ---------------------------------------------------------------------- */

std::unique_ptr<HelfrichTerm> LAMMPS_NS::make_area_term(LAMMPS *lmp)
{
  return std::make_unique<AreaTerm>(lmp);
}
