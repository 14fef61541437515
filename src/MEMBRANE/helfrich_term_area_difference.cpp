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

struct Coefficients : TargetCoefficients {
  double thickness = 0.0;

  bool same(const Coefficients &o) const
  {
    return TargetCoefficients::same(o) && thickness == o.thickness;
  }
  void archive(RestartArchive &file)
  {
    TargetCoefficients::archive(file);
    file(thickness);
  }
};

/** Area difference elasticity [L. Miao, U. Seifert, M. Wortis and H.-G. Doebereiner, Phys. Rev. E 49,
    5389 (1994)]: KD/2 (DA - DA0)^2/(A D^2) for each membrane, with the difference DA = D M between the
    areas of two surfaces a distance D apart, M the integral of 2H. So it is KD/2 (M - M0)^2/A, and targets
    are kept as M0 = DA0/D. */
class AreaDifferenceTerm : public TermWithTarget<Coefficients> {
 public:
  explicit AreaDifferenceTerm(LAMMPS *lmp) :
      TermWithTarget(lmp, "area/difference", HelfrichOutput::AREA_DIFFERENCE)
  {
  }

  Needs needs() const override
  {
    Needs needs;
    needs.totals = needs.origins = true;
    needs.curvature = true;
    return needs;
  }

 protected:
  int read(const HelfrichWords &words, Coefficients &c) const override
  {
    c.modulus = words.modulus(1);
    c.init = !words.number_or_init(2, c.target);
    if (words.word(3) != "thickness")
      error->all(FLERR, "pair_coeff helfrich area/difference: {} must be thickness and a length",
                 words.word(3));
    c.thickness = words.number(4);
    if (!(c.thickness > 0.0))
      error->all(FLERR, "pair_coeff helfrich area/difference thickness {} must be positive",
                 words.word(4));
    c.target /= c.thickness;
    return 5;
  }
  double compared(const Coefficients &, const MeshTotals::Total &total) const override
  {
    return total.curvature;
  }

  // dE/dM = KD (M - M0)/A, dE/dA = -E/A

  double law(const Coefficients &c, int m, const MeshTotals::Total &total,
             Conjugates &slope) const override
  {
    const double strain = excess(c, m, total);
    const double energy = 0.5 * c.modulus * strain * strain / total.area;
    slope.moment = c.modulus * strain / total.area;
    slope.tension = -energy / total.area;
    return energy;
  }
};

}    // namespace

/* ---------------------------------------------------------------------- */

std::unique_ptr<HelfrichTerm> LAMMPS_NS::make_area_difference_term(LAMMPS *lmp)
{
  return std::make_unique<AreaDifferenceTerm>(lmp);
}
