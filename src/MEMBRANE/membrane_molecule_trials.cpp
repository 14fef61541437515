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

// Monte Carlo of the lipids of a crowd that hurt

#include "membrane_molecule_crowd.h"

#include <algorithm>
#include <cmath>

using namespace Membrane_NS;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

static constexpr double DRIFT = 4.0;            // Angstrom: how far a lipid is taken from where it was
static constexpr double ENOUGH = 1.0e-4;        // energy of a lipid that no longer hurts
static constexpr double GROWTH = 2.0;           // Angstrom: how much further out than in the patch atoms of a lipid may be
static constexpr double JITTER = 0.05;          // radian, of an angle that is taken over
static constexpr double KINK = 0.5;             // radian
static constexpr double PARALLEL = 0.8;         // cosine of the angle of two bonds
static constexpr double NUDGE = 0.4, TILT = 0.08;    // Angstrom and radian: of a lipid as a whole

namespace {

/* ----------------------------------------------------------------------
   Lipids that hurt, in colours: no two of a colour can feel each other. While those of a colour try new places all
   others stand still, so it does not matter who tries which.
------------------------------------------------------------------------- */

std::vector<std::vector<int>> in_colours(const LipidCrowd &crowd, const std::vector<int> &chosen, double apart)
{
  std::vector<Vector3d> centres;
  for (int i : chosen) centres.push_back(crowd.lipids[i].x);
  BeadGrid near = crowd.grid();
  near.fill(centres, apart);
  std::vector<int> colour(chosen.size(), -1);
  std::vector<std::vector<int>> batches;
  for (size_t c = 0; c < chosen.size(); ++c) {
    std::vector<char> taken(batches.size() + 1, 0);
    near.near(centres[c], [&](int other, const Vector3d &, double) {
      if (colour[other] >= 0) taken[colour[other]] = 1;
    });
    colour[c] = static_cast<int>(std::find(taken.begin(), taken.end(), 0) - taken.begin());
    if (colour[c] == static_cast<int>(batches.size())) batches.emplace_back();
    batches[colour[c]].push_back(chosen[c]);
  }
  return batches;
}

/// The atoms that a lipid may get in the way of: those that never move, and those of lipids that do.
class Bystanders {
 public:
  Bystanders(const LipidCrowd &crowd, const std::vector<int> &chosen) :
      crowd_(crowd), chosen_(chosen), near_still_(crowd.grid()), near_others_(crowd.grid())
  {
    std::vector<char> moves(crowd.lipids.size(), 0);
    for (int i : chosen) moves[i] = 1;
    const LipidCrowd::Atoms all = crowd.atoms();
    for (size_t a = 0; a < all.x.size(); ++a)
      if (all.owner[a] < 0 || !moves[all.owner[a]]) still_.add(all.x[a], all.owner[a], all.kind[a]);
    near_still_.fill(still_.x, crowd.largest_soft());
  }

  /// To be called when lipids have moved.
  void look_again()
  {
    others_ = Bodies();
    for (int i : chosen_) {
      const auto &kinds = crowd_.species_of(i).kinds;
      for (size_t k = 0; k < kinds.size(); ++k)
        others_.add(crowd_.atom(crowd_.lipids[i], static_cast<int>(k)), i, kinds[k]);
    }
    near_others_.fill(others_.x, crowd_.largest_soft());
  }

  /// The energy of an atom of lipid `me` with all other lipids.
  double energy(int me, int kind, const Vector3d &x) const
  {
    double sum = 0.0;
    near_still_.near(x, [&](int b, const Vector3d &, double d2) {
      sum += overlap(d2, crowd_.soft(kind, still_.kind[b]));
    });
    near_others_.near(x, [&](int b, const Vector3d &, double d2) {
      if (others_.owner[b] != me) sum += overlap(d2, crowd_.soft(kind, others_.kind[b]));
    });
    return sum;
  }

  /// Of a lipid; no more than what is found once it is above `limit`.
  double energy(int me, const PlacedLipid &lipid, double limit = INFINITY) const
  {
    const auto &kinds = crowd_.library().species[crowd_.conformer(lipid).species].kinds;
    double sum = 0.0;
    for (size_t k = 0; k < kinds.size() && sum < limit; ++k)
      sum += energy(me, kinds[k], crowd_.atom(lipid, static_cast<int>(k)));
    return sum;
  }

 private:
  struct Bodies {
    std::vector<Vector3d> x;
    std::vector<int> owner, kind;
    void add(const Vector3d &place, int whose, int which)
    {
      x.push_back(place);
      owner.push_back(whose);
      kind.push_back(which);
    }
  };
  const LipidCrowd &crowd_;
  const std::vector<int> &chosen_;
  Bodies still_, others_;
  BeadGrid near_still_, near_others_;
};

std::vector<int> above(double least, const std::vector<double> &energies)
{
  std::vector<int> chosen;
  for (size_t i = 0; i < energies.size(); ++i)
    if (energies[i] > least) chosen.push_back(static_cast<int>(i));
  return chosen;
}

// By how much the energy may grow in a trial: by Metropolis' rule, with a temperature that falls

double allowed(double temperature, int trial, int trials, double random)
{
  const double heat = temperature * (1.0 - static_cast<double>(trial) / trials);
  return -(heat + 1.0e-9) * std::log(random);
}

int one_of(size_t many, double random)
{
  return static_cast<int>(std::min(static_cast<size_t>(random * many), many - 1));
}

std::array<double, 4> four(const CounterRandom &random, uint64_t label, uint32_t block)
{
  const auto a = random.uniforms(label, block), b = random.uniforms(label, block + 1);
  return {a[0], a[1], b[0], b[1]};
}

/// One lipid whose shape is tried: places of its atoms, and their energies.
class BendingLipid {
 public:
  PlacedLipid placed;
  std::vector<Vector3d> x;

  BendingLipid(const LipidCrowd &crowd, const Bystanders &bystanders, const LipidTorsions &flexible,
               const std::vector<double> &within, int number, double farthest) :
      placed(crowd.lipids[number]), bystanders_(bystanders), flexible_(flexible), within_(within),
      kinds_(crowd.species_of(number).kinds), all_kinds_(crowd.library().contacts.kinds()), me_(number),
      home_(placed.x), farthest_(farthest)
  {
    for (size_t k = 0; k < kinds_.size(); ++k) {
      x.push_back(crowd.atom(placed, static_cast<int>(k)));
      energy_.push_back(bystanders.energy(me_, kinds_[k], x[k]));
      all_.push_back(static_cast<int>(k));
    }
  }

  double energy() const
  {
    double sum = 0.0;
    for (size_t k = 0; k < x.size(); ++k) {
      sum += energy_[k];
      for (size_t l = 0; l < k; ++l) sum += own(x, static_cast<int>(k), static_cast<int>(l));
    }
    return sum;
  }

  /// A trial: places of the atoms after it, and which have moved. False if it is none.
  bool turn(const std::array<double, 4> &random, std::vector<Vector3d> &after, std::vector<int> &moved) const
  {
    const auto &torsions = flexible_.torsions;
    const Torsion &torsion = torsions[one_of(torsions.size(), random[0])];
    const double now = torsion.angle(x);
    after = x;
    moved = torsion.turning;
    if (random[1] < 0.5) {
      const double angle = torsion.seen[one_of(torsion.seen.size(), random[2])] + JITTER * (2.0 * random[3] - 1.0);
      torsion.turn(angle - now, after);
      return true;
    }
    std::vector<const Torsion *> partners;
    const Vector3d axis = (x[torsion.to] - x[torsion.from]).normalized();
    for (const Torsion &other : torsions)
      if (&other != &torsion && std::fabs(axis.dot((x[other.to] - x[other.from]).normalized())) > PARALLEL &&
          std::find(moved.begin(), moved.end(), other.to) != moved.end() &&
          std::find(moved.begin(), moved.end(), other.from) != moved.end())
        partners.push_back(&other);
    if (partners.empty()) return false;
    const Torsion &other = *partners[one_of(partners.size(), random[2])];
    const double by = KINK * (2.0 * random[3] - 1.0);
    const double back = axis.dot(x[other.to] - x[other.from]) > 0.0 ? -by : by;
    if (std::fabs(torsion.off(now + by)) > LipidCrowd::LIBRATION ||
        std::fabs(other.off(other.angle(x) + back)) > LipidCrowd::LIBRATION)
      return false;
    torsion.turn(by, after);
    other.turn(back, after);
    return true;
  }

  /** The change of the energy that `after` makes, of whose atoms `moved` have moved. Is taken if it is less than
      `limit`. Returns what is found, which is above the limit otherwise. */
  double try_shape(const std::vector<Vector3d> &after, const std::vector<int> &moved, double limit)
  {
    double sum = 0.0;
    std::vector<char> moves(x.size(), 0);
    for (int k : moved) moves[k] = 1;
    for (int k : moved) {
      if ((after[k] - placed.x).norm() > farthest_) return INFINITY;
      sum -= energy_[k];
      for (size_t l = 0; l < x.size(); ++l)
        if (!moves[l] || l < static_cast<size_t>(k))
          sum += own(after, k, static_cast<int>(l)) - own(x, k, static_cast<int>(l));
    }
    return take_if_below(after, moved, sum, limit);
  }

  /// A small motion as a whole. False where it would leave its place.
  bool nudge(const std::array<double, 4> &random, const std::array<double, 4> &more, PlacedLipid &to,
             std::vector<Vector3d> &after) const
  {
    to = placed;
    to.x += NUDGE * Vector3d(2.0 * random[1] - 1.0, 2.0 * random[2] - 1.0, 2.0 * random[3] - 1.0);
    if ((to.x - home_).squaredNorm() > DRIFT * DRIFT) return false;
    const Vector3d angle = TILT * Vector3d(2.0 * more[0] - 1.0, 2.0 * more[1] - 1.0, 2.0 * more[2] - 1.0);
    const Quaterniond turn(Eigen::AngleAxisd(angle.norm(), angle.normalized()));
    to.turn = (turn * placed.turn).normalized();
    after.clear();
    for (const Vector3d &place : x) after.push_back(to.x + turn * (place - placed.x));
    return true;
  }

  double try_place(const PlacedLipid &to, const std::vector<Vector3d> &after, double limit)
  {
    double sum = 0.0;
    for (double energy : energy_) sum -= energy;
    sum = take_if_below(after, all_, sum, limit);
    if (sum < limit) placed = to;
    return sum;
  }

 private:
  const Bystanders &bystanders_;
  const LipidTorsions &flexible_;
  const std::vector<double> &within_;
  const std::vector<int> &kinds_;
  const int all_kinds_, me_;
  const Vector3d home_;
  const double farthest_;
  std::vector<int> all_;                  // atoms
  std::vector<double> energy_, trial_;    // of atoms, with other lipids

  double take_if_below(const std::vector<Vector3d> &after, const std::vector<int> &moved, double sum, double limit)
  {
    trial_.clear();
    for (int k : moved) {
      if (sum >= limit) return sum;
      trial_.push_back(bystanders_.energy(me_, kinds_[k], after[k]));
      sum += trial_.back();
    }
    if (sum >= limit) return sum;
    x = after;
    for (size_t m = 0; m < moved.size(); ++m) energy_[moved[m]] = trial_[m];
    return sum;
  }

  double own(const std::vector<Vector3d> &places, int k, int l) const
  {
    if (!flexible_.apart[k * places.size() + l]) return 0.0;
    return overlap((places[l] - places[k]).squaredNorm(), within_[kinds_[k] * all_kinds_ + kinds_[l]]);
  }
};

}    // namespace

/* ---------------------------------------------------------------------- */

void LipidCrowd::shuffle(double least, int trials, double temperature, double slide, int purpose)
{
  const CounterRandom mine = random(purpose);
  const std::vector<int> chosen = above(least, energies());
  if (chosen.empty()) return;
  Bystanders bystanders(*this, chosen);
  struct Result {
    int lipid;
    PlacedLipid placed;
  };
  for (const std::vector<int> &batch : in_colours(*this, chosen, 2.0 * (reach_of_lipids() + slide) + largest_soft_)) {
    bystanders.look_again();
    std::vector<Result> results;
    for (size_t b = team_.rank(); b < batch.size(); b += team_.size()) {
      const int i = batch[b];
      PlacedLipid now = lipids[i];
      const ParallelSurfaces &part = parts_[now.part];
      const double height = sign_of(now.leaflet) * neutral_[now.leaflet];
      const auto &like = library_.by_species[conformer(now).species];
      const ParallelPlace home = site_of(now);
      ParallelPlace place = home;
      Vector3d along = now.turn * Vector3d::UnitX();
      double energy = bystanders.energy(i, now);
      for (int t = 0; t < trials && energy > ENOUGH; ++t) {
        const uint64_t label = static_cast<uint64_t>(i);
        const uint32_t block = 4 * static_cast<uint32_t>(t);
        const auto a = mine.uniforms(label, block), b1 = mine.uniforms(label, block + 1);
        ParallelPlace new_place = place;
        double angle = 2.0 * M_PI * a[1];
        int conformer = now.conformer;
        if (a[0] > 2.0 / 3.0) {
          const auto c = mine.uniforms(label, block + 2);
          const Vector3d step = slide * Vector3d(2.0 * b1[0] - 1.0, 2.0 * b1[1] - 1.0, 2.0 * c[0] - 1.0);
          new_place = part.project(place.x + step, place.point, height);
          if ((new_place.x - home.x).squaredNorm() > DRIFT * DRIFT) continue;
          angle = 0.3 * (2.0 * a[1] - 1.0);
        } else if (a[0] > 1.0 / 3.0)
          conformer = like[one_of(like.size(), b1[0])];
        const Vector3d direction = Eigen::AngleAxisd(angle, new_place.normal) * along;
        const PlacedLipid trial = stand(new_place, direction, conformer, now.leaflet, now.part);
        const double limit = energy + allowed(temperature, t, trials, mine.uniforms(label, block + 3)[0]);
        const double new_energy = bystanders.energy(i, trial, limit);
        if (new_energy >= limit) continue;
        energy = new_energy;
        now = trial;
        place = new_place;
        along = direction;
      }
      results.push_back({i, now});
    }
    for (const Result &result : concatenate(team_, results)) lipids[result.lipid] = result.placed;
  }
}

/* ---------------------------------------------------------------------- */

int LipidCrowd::bend(double least, int trials, double temperature, int purpose)
{
  prepare_torsions();
  const CounterRandom mine = random(purpose);
  std::vector<int> chosen;
  for (int i : above(least, energies()))
    if (!torsions_[conformer_of(i).species].torsions.empty()) chosen.push_back(i);
  if (chosen.empty()) return 0;
  for (int i : chosen) give_own_shape(i);
  Bystanders bystanders(*this, chosen);
  const double farthest = reach_of_lipids() + GROWTH;
  struct Result {
    int lipid;
    PlacedLipid placed;
  };
  for (const std::vector<int> &batch : in_colours(*this, chosen, 2.0 * (farthest + DRIFT) + largest_soft_)) {
    bystanders.look_again();
    std::vector<Result> results;
    std::vector<Vector3d> shapes, after;
    std::vector<int> moved;
    for (size_t b = team_.rank(); b < batch.size(); b += team_.size()) {
      const int i = batch[b];
      BendingLipid lipid(*this, bystanders, torsions_[conformer_of(i).species], soft_within_, i, farthest);
      double energy = lipid.energy();
      for (int t = 0; t < trials && energy > ENOUGH; ++t) {
        const uint64_t label = static_cast<uint64_t>(i);
        const uint32_t block = 5 * static_cast<uint32_t>(t);
        const auto a = four(mine, label, block), c = four(mine, label, block + 2);
        const double toss = mine.uniforms(label, block + 4)[0];
        const double limit = allowed(temperature, t, trials, toss);
        double change = INFINITY;
        PlacedLipid to;
        if (c[3] >= 0.75) {
          if (lipid.nudge(a, c, to, after)) change = lipid.try_place(to, after, limit);
        } else if (lipid.turn(a, after, moved))
          change = lipid.try_shape(after, moved, limit);
        if (change < limit) energy += change;
      }
      results.push_back({i, lipid.placed});
      for (const Vector3d &place : lipid.x) shapes.push_back(lipid.placed.turn.inverse() * (place - lipid.placed.x));
    }
    const std::vector<Vector3d> all_shapes = concatenate(team_, shapes);
    auto next = all_shapes.begin();
    for (const Result &result : concatenate(team_, results)) {
      lipids[result.lipid] = result.placed;
      auto &shape = conformers_[result.placed.conformer].x;
      std::copy_n(next, shape.size(), shape.begin());
      next += shape.size();
    }
  }
  return static_cast<int>(chosen.size());
}
