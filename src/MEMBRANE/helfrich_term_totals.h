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

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
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
      density[m] = law(*c, m, total, slope) / total.area;
      scene.conjugates[m].tension += slope.tension;
      scene.conjugates[m].pressure += slope.pressure;
      scene.conjugates[m].moment += slope.moment;
    }
  }

  void add_stiffness(const HelfrichScene &scene, HelfrichStiffness &stiffness) override
  {
    for (size_t m = 0; m < scene.types.size(); ++m) {
      const Coefficients *c = of_membrane(scene, m);
      if (!c) continue;
      const MeshTotals::Total &total = scene.totals.membranes()[m];
      const double length = std::sqrt(total.area);
      add_second(*c, m, total, &MeshTotals::Total::area, &Conjugates::tension, length * length,
                 stiffness);
      add_second(*c, m, total, &MeshTotals::Total::volume, &Conjugates::pressure,
                 length * length * length, stiffness);
      add_second(*c, m, total, &MeshTotals::Total::curvature, &Conjugates::moment, length, stiffness);
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

  /// The energy of membrane m, and its derivatives by the totals.
  virtual double law(const Coefficients &, int m, const MeshTotals::Total &,
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

  // by a difference of slopes

  void add_second(const Coefficients &c, size_t m, const MeshTotals::Total &at,
                  double MeshTotals::Total::*by, double Conjugates::*slope, double scale,
                  HelfrichStiffness &stiffness) const
  {
    const double step = 1.0e-4 * scale;
    MeshTotals::Total above = at, below = at;
    above.*by += step;
    below.*by -= step;
    Conjugates up, down;
    law(c, static_cast<int>(m), above, up);
    law(c, static_cast<int>(m), below, down);
    stiffness.totals[m].*slope += (up.*slope - down.*slope) / (2.0 * step);
  }
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

/// What "init" stood for, of a membrane of so many control points.
struct KeptTarget {
  double target;
  int points;
  void archive(RestartArchive &file)
  {
    file(target);
    file(points);
  }
};

/** Keeps what "init" stood for through later runs and restarts, by the lowest origin of a membrane's control
    points. A sheet that replicate made k times larger has k times the target. */
template <class Coefficients> class TermWithTarget : public TermOfTotals<Coefficients> {
 public:
  using TermOfTotals<Coefficients>::TermOfTotals;

  void archive_references(RestartArchive &file) override { file(kept); }

  void find_references(const HelfrichScene &scene, const std::vector<char> &anew) override
  {
    const int n = static_cast<int>(scene.types.size());
    targets.assign(n, 0.0);
    known.assign(n, 0);
    lowest.assign(n, 0);
    points.assign(n, 0);
    const auto before = origins_by_membrane(scene, scene.origins.before());
    const auto now = origins_by_membrane(scene, scene.origins.now());
    std::map<bigint, KeptTarget> still;
    for (auto &[origin, entry] : kept)
      if (scene.origins.exists(origin)) still[origin] = entry;
    for (int m = 0; m < n; ++m) {
      const Coefficients *c = this->of_membrane(scene, m);
      if (!c) continue;
      lowest[m] = now[m].front();
      points[m] = static_cast<int>(now[m].size());
      still.erase(lowest[m]);
      known[m] = !c->init;
      targets[m] = c->target;
      if (known[m] || anew[m]) continue;
      const auto distinct = std::set<bigint>(before[m].begin(), before[m].end()).size();
      const auto found = kept.find(before[m].front());
      if (found == kept.end() || distinct != (size_t) found->second.points || points[m] % distinct)
        continue;
      known[m] = 1;
      targets[m] = found->second.target * (points[m] / distinct);
      still[lowest[m]] = {targets[m], points[m]};
    }
    kept = std::move(still);
  }

  void take_references(HelfrichScene &scene) override
  {
    for (size_t m = 0; m < scene.types.size(); ++m) {
      const Coefficients *c = this->of_membrane(scene, m);
      if (!c || known[m]) continue;
      known[m] = 1;
      targets[m] = compared(*c, scene.totals.membranes()[m]);
      kept[lowest[m]] = {targets[m], points[m]};
    }
  }

 protected:
  /// What the target is compared with.
  virtual double compared(const Coefficients &, const MeshTotals::Total &) const = 0;
  double target(int m) const { return targets[m]; }
  double excess(const Coefficients &c, int m, const MeshTotals::Total &total) const
  {
    return compared(c, total) - targets[m];
  }

 private:
  std::map<bigint, KeptTarget> kept;
  std::vector<double> targets;    // by membrane
  std::vector<char> known;        // and whether it is taken
  std::vector<bigint> lowest;     // origin
  std::vector<int> points;

  /// Increasing.
  static std::vector<std::vector<bigint>> origins_by_membrane(const HelfrichScene &scene,
                                                              const std::vector<bigint> &origins)
  {
    std::vector<std::vector<bigint>> result(scene.types.size());
    for (size_t v = 0; v < origins.size(); ++v)
      result[scene.mesh->membrane(scene.mesh->topology().component(v))].push_back(origins[v]);
    for (auto &list : result) std::sort(list.begin(), list.end());
    return result;
  }
};

}    // namespace LAMMPS_NS

#endif
