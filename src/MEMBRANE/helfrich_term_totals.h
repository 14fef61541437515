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

#ifndef LMP_HELFRICH_TERM_TOTALS_H
#define LMP_HELFRICH_TERM_TOTALS_H

#include "helfrich_term.h"

#include <map>
#include <vector>

namespace LAMMPS_NS {

/** An energy W(A, V, M) of a membrane's area, volume and integral M of 2H. Its coefficients have
    `same()` besides what TermWith asks for. The energy is shared by the faces in proportion to area. */
template <class Coefficients> class TermOfTotals : public TermWith<Coefficients> {
 public:
  using TermWith<Coefficients>::TermWith;

  bool of_whole_membrane() const override { return true; }
  bool same(int type, int other) const override { return by_type[type].same(by_type[other]); }

  void act_on_membranes(HelfrichScene &scene) override
  {
    density.assign(scene.types.size(), 0.0);
    for (size_t m = 0; m < scene.types.size(); ++m) {
      const Coefficients *c = of_membrane(scene, m);
      if (!c) continue;
      const MeshTotals::Total &total = scene.totals.membranes()[m];
      Conjugates slope;
      density[m] = law(*c, scene.mesh->molecules()[m], total, slope) / total.area;
      scene.conjugates[m].tension += slope.tension;
      scene.conjugates[m].pressure += slope.pressure;
      scene.conjugates[m].moment += slope.moment;
    }
  }

  void tally(const HelfrichScene &scene, HelfrichTally &tally) const override
  {
    for (const Membrane_NS::FaceGroup &group : scene.groups)
      for (int s = 0; s < group.nfaces; ++s) {
        const int slot = group.first_slot + s;
        tally.add(slot, this->output, density[scene.membrane(group, s)] * scene.energies.area[slot]);
      }
  }

 protected:
  using TermWith<Coefficients>::by_type;

  /// The energy, and its derivatives by the totals.
  virtual double law(const Coefficients &, tagint molecule, const MeshTotals::Total &,
                     Conjugates &) const = 0;

  /// A membrane's coefficients, or null where it has none.
  const Coefficients *of_membrane(const HelfrichScene &scene, int m) const
  {
    if (scene.excluded[m] || scene.types[m].empty()) return nullptr;
    const Coefficients &c = by_type[scene.types[m].front()];
    return c.active() ? &c : nullptr;
  }

 private:
  std::vector<double> density;    // energy over area, by membrane
};

/// A modulus and what a total is compared with; "init" takes it at the first step.
struct TargetCoefficients {
  double modulus = 0.0, target = 0.0;
  bool init = false;

  bool active() const { return modulus != 0.0; }
  bool same(const TargetCoefficients &o) const
  {
    return modulus == o.modulus && target == o.target && init == o.init;
  }
  void archive(RestartArchive &file)
  {
    file(modulus);
    file(target);
    file(init);
  }
};

/// Keeps such a target for each membrane, by molecule ID, through later runs and restarts
template <class Coefficients> class TermWithTarget : public TermOfTotals<Coefficients> {
 public:
  using TermOfTotals<Coefficients>::TermOfTotals;

  void drop_reference(tagint molecule) override { targets.erase(molecule); }
  void archive_references(RestartArchive &file) override { file(targets); }
  void take_references(HelfrichScene &scene) override
  {
    for (size_t m = 0; m < scene.types.size(); ++m) {
      const Coefficients *c = this->of_membrane(scene, m);
      if (!c) continue;
      const tagint molecule = scene.mesh->molecules()[m];
      if (!c->init)
        targets[molecule] = c->target;
      else if (!targets.count(molecule))
        targets[molecule] = compared(*c, scene.totals.membranes()[m]);
    }
  }

 protected:
  /// What the target is compared with.
  virtual double compared(const Coefficients &, const MeshTotals::Total &) const = 0;
  double target(tagint molecule) const { return targets.at(molecule); }
  double excess(const Coefficients &c, tagint molecule, const MeshTotals::Total &total) const
  {
    return compared(c, total) - target(molecule);
  }

 private:
  std::map<tagint, double> targets;
};

}    // namespace LAMMPS_NS

#endif
