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

/** KV/2 (V - V0)^2/V0 for each membrane */
class VolumeTerm : public TermWithTarget<TargetCoefficients> {
 public:
  explicit VolumeTerm(LAMMPS *lmp) : TermWithTarget(lmp, "volume", HelfrichOutput::VOLUME) {}

  Needs needs() const override
  {
    Needs needs;
    needs.totals = needs.origins = true;
    needs.volume = true;
    return needs;
  }

 protected:
  int read(const HelfrichWords &words, TargetCoefficients &c) const override
  {
    c.modulus = words.modulus(1);
    c.init = !words.number_or_init(2, c.target);
    if (!c.init && c.target <= 0.0)
      error->all(FLERR, "pair_coeff helfrich reference volume {} must be positive or init",
                 words.word(2));
    return 3;
  }
  double compared(const TargetCoefficients &, const MeshTotals::Total &total) const override
  {
    return total.volume;
  }
  double law(const TargetCoefficients &c, int m, const MeshTotals::Total &total,
             Conjugates &slope) const override
  {
    const double d = excess(c, m, total), v0 = target(m);
    slope.pressure = c.modulus * d / v0;
    return 0.5 * c.modulus * d * d / v0;
  }
};

}    // namespace

/* ---------------------------------------------------------------------- */

std::unique_ptr<HelfrichTerm> LAMMPS_NS::make_volume_term(LAMMPS *lmp)
{
  return std::make_unique<VolumeTerm>(lmp);
}
