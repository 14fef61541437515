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

// Rigid motion and Monte Carlo of a crowd of lipids

#include "membrane_molecule_crowd.h"

#include "membrane_closest_point.h"

#include <algorithm>
#include <cmath>

using namespace Membrane_NS;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

static constexpr double MOBILITY = 3.0;        // of a lipid, per force on one of its atoms
static constexpr double LONGEST = 0.3;         // Angstrom: of a step
static constexpr double WIDEST = LONGEST / 8.0;    // radian
static constexpr double TO_HEIGHT = 0.02;      // of what is missing, in a step
static constexpr double INERTIA = 5.0;         // Angstrom^2 that keeps thin lipids from spinning
static constexpr double SKIN = 1.6;            // Angstrom: of lists of neighbours
static constexpr double FEW = 0.02;            // of all lipids: lists of these alone are made anew
static constexpr double STRAY = 1.5;           // Angstrom: how far the expansion of the height is used
static constexpr double DRIFT = 4.0;           // Angstrom: how far Monte Carlo takes a lipid from where it was

namespace {

/* ----------------------------------------------------------------------
   The height of a place above the limit surface near an anchor, to second order:
   d(x) = d0 + n.s + s.D s/2, s = x - anchor, D the second derivatives of the distance
------------------------------------------------------------------------- */

struct Anchor {
  Vector3d x, normal;
  Matrix3d hessian;
  double height = INFINITY;

  void drop(const ParallelSurfaces &surfaces, const Vector3d &place, const SurfacePoint &start)
  {
    const ClosestPoint closest = closest_point(surfaces.surface(), place, start);
    x = place;
    normal = closest.normal;
    height = closest.distance;
    hessian = closest.jet.distance_hessian(height);
    if (!hessian.allFinite()) hessian.setZero();
  }
  double height_of(const Vector3d &place) const
  {
    const Vector3d s = place - x;
    return height + s.dot(normal + 0.5 * hessian * s);
  }
};

/// Pairs of the atoms of a lipid with others, in the image that was nearest.
struct Neighbours {
  std::vector<int> start, atom;
  std::vector<unsigned char> image;    // of the box, see LipidCrowd::relax()
};

struct Motion {
  Vector3d x;
  Quaterniond turn;
};

}    // namespace

/* ----------------------------------------------------------------------
   Forces on atoms F = (d_c - d)/2 along each pair; a lipid of n atoms goes by MOBILITY/n times their sum and turns by
   MOBILITY I^-1 times their torque. All as in gradient descent, with steps that are cut short.
------------------------------------------------------------------------- */

double LipidCrowd::relax(int steps)
{
  const int n = static_cast<int>(lipids.size());
  const auto [first, last] = team_.part(n);
  std::vector<int> start(n + 1, 0);
  std::vector<double> radius(n, 0.0);
  for (int i = 0; i < n; ++i) {
    const Conformer &conformer = conformer_of(i);
    start[i + 1] = start[i] + static_cast<int>(conformer.x.size());
    for (const Vector3d &x : conformer.x) radius[i] = std::max(radius[i], x.norm());
  }
  Atoms all = atoms();
  const LimitSurface &surface = parts_[0].surface();
  const Matrix3d inverse = surface.lattice().inverse();
  BeadGrid near = grid();
  std::vector<Anchor> anchors(last - first);
  std::vector<Motion> listed(n);    // where lipids were when they were last found to be stale
  std::vector<char> stale(n, 1);
  std::vector<Neighbours> lists(last - first);
  std::vector<Vector3d> shifts(1, Vector3d::Zero());
  double energy = 0.0;

  auto list = [&](int i) {
    Neighbours &of = lists[i - first];
    of.start.assign(1, 0);
    of.atom.clear();
    of.image.clear();
    for (int a = start[i]; a < start[i + 1]; ++a) {
      near.near(all.x[a], [&](int b, const Vector3d &d, double d2) {
        if (all.owner[b] == i) return;
        const double reach = soft(all.kind[a], all.kind[b]) + SKIN;
        if (d2 >= reach * reach) return;
        unsigned char image = 0;
        if (surface.is_periodic()) {
          const Vector3d shift = d - (all.x[b] - all.x[a]);
          while (image < shifts.size() && (shifts[image] - shift).squaredNorm() > 1.0e-6) ++image;
          if (image == shifts.size()) shifts.push_back(surface.lattice() * (inverse * shift).array().round().matrix());
        }
        of.atom.push_back(b);
        of.image.push_back(image);
      });
      of.start.push_back(static_cast<int>(of.atom.size()));
    }
  };

  // Lists of lipids that have gone more than SKIN/4 from where they were, and of those they are near to now. So no
  // lipid goes further than SKIN/2 between two lists that it is in, and two no further than SKIN.

  auto make_lists = [&]() {
    near.fill(all.x, largest_soft_ + SKIN);
    std::vector<char> affected(stale);
    const bool few = std::count(stale.begin(), stale.end(), 1) < FEW * n;
    for (int i = 0; i < n; ++i) {
      if (!stale[i]) continue;
      listed[i] = {lipids[i].x, lipids[i].turn};
      for (int a = start[i]; few && a < start[i + 1]; ++a)
        near.near(all.x[a], [&](int b, const Vector3d &, double) {
          if (all.owner[b] >= 0) affected[all.owner[b]] = 1;
        });
    }
    for (int i = first; i < last; ++i)
      if (!few || affected[i]) list(i);
    if (!few)
      for (int i = 0; i < n; ++i) listed[i] = {lipids[i].x, lipids[i].turn};
    std::fill(stale.begin(), stale.end(), 0);
  };

  std::vector<Motion> mine(last - first), moved;
  std::vector<Vector3d> force;
  for (int step = 0; step < steps; ++step) {
    if (std::find(stale.begin(), stale.end(), 1) != stale.end()) make_lists();
    energy = 0.0;
    for (int i = first; i < last; ++i) {
      PlacedLipid &lipid = lipids[i];
      const int natoms = start[i + 1] - start[i];
      Vector3d sum = Vector3d::Zero(), torque = Vector3d::Zero();
      Matrix3d inertia = INERTIA * Matrix3d::Identity();
      bool pushed = false;
      const Neighbours &near_by = lists[i - first];
      for (int a = start[i]; a < start[i + 1]; ++a) {
        Vector3d f = Vector3d::Zero();
        const int row = a - start[i];
        for (int p = near_by.start[row]; p < near_by.start[row + 1]; ++p) {
          const int b = near_by.atom[p];
          const Vector3d d = all.x[b] - all.x[a] + shifts[near_by.image[p]];
          const double reach = soft(all.kind[a], all.kind[b]), d2 = d.squaredNorm();
          if (d2 >= reach * reach) continue;
          const double length = std::sqrt(d2) + 1.0e-9, w = 1.0 - length / reach;
          energy += 0.5 * w * w;
          f -= (0.5 * (reach - length) / length) * d;
          pushed = true;
        }
        if (!pushed) continue;
        const Vector3d r = all.x[a] - lipid.x;
        sum += f;
        torque += r.cross(f);
      }
      Anchor &anchor = anchors[i - first];
      if (!(anchor.height < INFINITY) || (lipid.x - anchor.x).squaredNorm() > STRAY * STRAY)
        anchor.drop(parts_[lipid.part], lipid.x, lipid.point);
      const double wanted =
          sign_of(lipid.leaflet) * (neutral_[lipid.leaflet] + library_.conformers[lipid.conformer].lift);
      Vector3d shift = sum * (MOBILITY / natoms);
      if (const double length = shift.norm(); length > LONGEST) shift *= LONGEST / length;
      shift -= anchor.normal * (TO_HEIGHT * (anchor.height_of(lipid.x) - wanted));
      Quaterniond turn = lipid.turn;
      if (pushed) {
        for (int a = start[i]; a < start[i + 1]; ++a) {
          const Vector3d r = all.x[a] - lipid.x;
          inertia += r.squaredNorm() * Matrix3d::Identity() - r * r.transpose();
        }
        Vector3d angle = MOBILITY * inertia.ldlt().solve(torque);
        double size = angle.norm();
        if (size > WIDEST) {
          angle *= WIDEST / size;
          size = WIDEST;
        }
        if (size > 1.0e-12) turn = (Quaterniond(Eigen::AngleAxisd(size, angle / size)) * turn).normalized();
      }
      mine[i - first] = {lipid.x + shift, turn};
    }

    // all know where all have gone

    moved = concatenate(team_, mine);
    for (int i = 0; i < n; ++i) {
      PlacedLipid &lipid = lipids[i];
      if (moved[i].x == lipid.x && moved[i].turn.coeffs() == lipid.turn.coeffs()) continue;
      lipid.x = moved[i].x;
      lipid.turn = moved[i].turn;
      const Matrix3d turn = lipid.turn.toRotationMatrix();
      const auto &shape = conformer_of(i).x;
      for (size_t k = 0; k < shape.size(); ++k) all.x[start[i] + k] = lipid.x + turn * shape[k];
      const double way = (lipid.x - listed[i].x).norm() +
          2.0 * radius[i] * (lipid.turn.inverse() * listed[i].turn).vec().norm();
      stale[i] = 4.0 * way > SKIN;
    }
  }
  double total = 0.0;
  for (double part : concatenate(team_, std::vector<double>{energy})) total += part;
  return total;
}

/* ----------------------------------------------------------------------
   Lipids that hurt, in colours: no two of a colour can feel each other. While those of a colour try new places all
   others stand still, so it does not matter who tries which.
------------------------------------------------------------------------- */

void LipidCrowd::shuffle(double least, int trials, double temperature, double slide, int purpose)
{
  const CounterRandom mine = random(purpose);
  const std::vector<double> hurt = energies();
  std::vector<int> chosen;
  for (size_t i = 0; i < lipids.size(); ++i)
    if (hurt[i] > least) chosen.push_back(static_cast<int>(i));
  if (chosen.empty()) return;

  const double apart = 2.0 * (library_.largest_radius() + slide) + largest_soft_;
  std::vector<Vector3d> centres;
  for (int i : chosen) centres.push_back(lipids[i].x);
  BeadGrid near = grid();
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

  // atoms that stand still all the time, and the others

  std::vector<char> moves(lipids.size(), 0);
  for (int i : chosen) moves[i] = 1;
  Atoms still, other, all = atoms();
  for (size_t a = 0; a < all.x.size(); ++a) {
    if (all.owner[a] >= 0 && moves[all.owner[a]]) continue;
    still.x.push_back(all.x[a]);
    still.owner.push_back(all.owner[a]);
    still.kind.push_back(all.kind[a]);
  }
  near.fill(still.x, largest_soft_);
  BeadGrid near_other = grid();

  auto energy_of = [&](const PlacedLipid &lipid, int me) {
    const Conformer &conformer = library_.conformers[lipid.conformer];
    const auto &kinds = library_.species[conformer.species].kinds;
    const Matrix3d turn = lipid.turn.toRotationMatrix();
    double energy = 0.0;
    for (size_t k = 0; k < kinds.size(); ++k) {
      const Vector3d x = lipid.x + turn * conformer.x[k];
      auto add = [&](const Atoms &atoms, int b, double d2) {
        if (atoms.owner[b] == me) return;
        const double reach = soft(kinds[k], atoms.kind[b]);
        if (d2 >= reach * reach) return;
        const double w = 1.0 - std::sqrt(d2) / reach;
        energy += w * w;
      };
      near.near(x, [&](int b, const Vector3d &, double d2) { add(still, b, d2); });
      near_other.near(x, [&](int b, const Vector3d &, double d2) { add(other, b, d2); });
    }
    return energy;
  };

  struct Result {
    int lipid;
    PlacedLipid placed;
  };
  for (const std::vector<int> &batch : batches) {
    other = Atoms();
    for (int i : chosen) {
      const auto &kinds = species_of(i).kinds;
      for (size_t k = 0; k < kinds.size(); ++k) {
        other.x.push_back(atom(lipids[i], static_cast<int>(k)));
        other.owner.push_back(i);
        other.kind.push_back(kinds[k]);
      }
    }
    near_other.fill(other.x, largest_soft_);
    std::vector<Result> results;
    for (size_t b = team_.rank(); b < batch.size(); b += team_.size()) {
      const int i = batch[b];
      PlacedLipid now = lipids[i];
      const ParallelSurfaces &part = parts_[now.part];
      const double height = sign_of(now.leaflet) * neutral_[now.leaflet];
      const auto &like = library_.by_species[library_.conformers[now.conformer].species];
      const ParallelPlace home = site_of(now);
      ParallelPlace place = home;
      Vector3d along = now.turn * Vector3d::UnitX();
      double energy = energy_of(now, i);
      for (int t = 0; t < trials && energy > 1.0e-4; ++t) {
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
          conformer = like[std::min<size_t>(static_cast<size_t>(b1[0] * like.size()), like.size() - 1)];
        const Vector3d direction = Eigen::AngleAxisd(angle, new_place.normal) * along;
        const PlacedLipid trial = stand(new_place, direction, conformer, now.leaflet, now.part);
        const double new_energy = energy_of(trial, i);
        const double heat = temperature * (1.0 - static_cast<double>(t) / trials);
        if (new_energy < energy ||
            mine.uniforms(label, block + 3)[0] < std::exp(-(new_energy - energy) / (heat + 1.0e-9))) {
          energy = new_energy;
          now = trial;
          place = new_place;
          along = direction;
        }
      }
      results.push_back({i, now});
    }
    for (const Result &result : concatenate(team_, results)) lipids[result.lipid] = result.placed;
  }
}
