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

// Motion of a crowd of lipids down its energy

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
static constexpr double TURNING = 0.5;         // of an atom about a torsion, per force on it
static constexpr double FEW = 0.02;            // of all lipids: lists of these alone are made anew
static constexpr double STRAY = 1.5;           // Angstrom: how far the expansion of the height is used

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

// By how much each torsion of a lipid turns, down the energy; x and force of its atoms

std::vector<double> turns_of(const LipidTorsions &flexible, const Vector3d *x, const std::vector<Vector3d> &force)
{
  std::vector<double> turns;
  std::vector<Vector3d> places(x, x + force.size());
  double way = 0.0;
  for (const Torsion &torsion : flexible.torsions) {
    const Vector3d &end = places[torsion.to];
    const Vector3d axis = (end - places[torsion.from]).normalized();
    double torque = 0.0, inertia = INERTIA, lever = 0.0;
    for (int k : torsion.turning) {
      const Vector3d arm = axis.cross(places[k] - end);
      torque += arm.dot(force[k]);
      inertia += arm.squaredNorm();
      lever = std::max(lever, arm.squaredNorm());
    }
    double turn = TURNING * torque / inertia;
    const double now = torsion.angle(places), off = std::fabs(torsion.off(now + turn));
    if (off > LipidCrowd::LIBRATION && off > std::fabs(torsion.off(now))) turn = 0.0;
    turns.push_back(turn);
    way += std::fabs(turn) * std::sqrt(lever);
  }
  if (way > LONGEST)
    for (double &turn : turns) turn *= LONGEST / way;
  return turns;
}

}    // namespace

/* ----------------------------------------------------------------------
   Forces on atoms F = (d_c - d)/2 along each pair; a lipid of n atoms goes by MOBILITY/n times their sum and turns by
   MOBILITY I^-1 times their torque; the part beyond a torsion turns by TURNING times the torque about the bond, over
   its moment of inertia. All as in gradient descent, with steps that are cut short.
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
  std::vector<double> bent(n, 0.0);    // how far atoms may have gone since by torsions
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
        const double limit = reach(all, a, b);
        if (limit == 0.0 || d2 >= (limit + SKIN) * (limit + SKIN)) return;
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
    for (int i = 0; i < n; ++i)
      if (!few || stale[i]) bent[i] = 0.0;
    if (!few)
      for (int i = 0; i < n; ++i) listed[i] = {lipids[i].x, lipids[i].turn};
    std::fill(stale.begin(), stale.end(), 0);
  };

  std::vector<Motion> mine(last - first), moved;
  std::vector<Vector3d> force;
  std::vector<double> my_turns, turns;    // of the lipids that bend
  for (int step = 0; step < steps; ++step) {
    if (std::find(stale.begin(), stale.end(), 1) != stale.end()) make_lists();
    energy = 0.0;
    my_turns.clear();
    for (int i = first; i < last; ++i) {
      PlacedLipid &lipid = lipids[i];
      const int natoms = start[i + 1] - start[i];
      Vector3d sum = Vector3d::Zero(), torque = Vector3d::Zero();
      Matrix3d inertia = INERTIA * Matrix3d::Identity();
      bool pushed = false;
      force.assign(natoms, Vector3d::Zero());
      const Neighbours &near_by = lists[i - first];
      for (int a = start[i]; a < start[i + 1]; ++a) {
        const int row = a - start[i];
        for (int p = near_by.start[row]; p < near_by.start[row + 1]; ++p) {
          const int b = near_by.atom[p];
          const Vector3d d = all.x[b] - all.x[a] + shifts[near_by.image[p]];
          const double limit = reach(all, a, b), d2 = d.squaredNorm();
          if (d2 >= limit * limit) continue;
          const double length = std::sqrt(d2) + 1.0e-9, w = 1.0 - length / limit;
          energy += 0.5 * w * w;
          force[row] -= (0.5 * (limit - length) / length) * d;
          pushed = true;
        }
        if (!pushed) continue;
        const Vector3d r = all.x[a] - lipid.x;
        sum += force[row];
        torque += r.cross(force[row]);
      }
      Anchor &anchor = anchors[i - first];
      if (!(anchor.height < INFINITY) || (lipid.x - anchor.x).squaredNorm() > STRAY * STRAY)
        anchor.drop(parts_[lipid.part], lipid.x, lipid.point);
      const double wanted =
          sign_of(lipid.leaflet) * (neutral_[lipid.leaflet] + conformer(lipid).lift);
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
      if (has_own_shape(i)) {
        const std::vector<double> of_lipid = turns_of(torsions_[conformer(lipid).species], &all.x[start[i]], force);
        my_turns.insert(my_turns.end(), of_lipid.begin(), of_lipid.end());
      }
    }

    // all know where all have gone

    moved = concatenate(team_, mine);
    turns = concatenate(team_, my_turns);
    auto next_turn = turns.begin();
    for (int i = 0; i < n; ++i) {
      PlacedLipid &lipid = lipids[i];
      bool bends = false;
      if (has_own_shape(i)) {
        Conformer &shape = conformers_[lipid.conformer];
        for (const Torsion &torsion : torsions_[shape.species].torsions) {
          if (*next_turn != 0.0) bent[i] += torsion.turn(*next_turn, shape.x);
          bends |= *next_turn++ != 0.0;
        }
        if (bends)
          for (const Vector3d &x : shape.x) radius[i] = std::max(radius[i], x.norm());
      }
      if (!bends && moved[i].x == lipid.x && moved[i].turn.coeffs() == lipid.turn.coeffs()) continue;
      lipid.x = moved[i].x;
      lipid.turn = moved[i].turn;
      const Matrix3d turn = lipid.turn.toRotationMatrix();
      const auto &shape = conformer_of(i).x;
      for (size_t k = 0; k < shape.size(); ++k) all.x[start[i] + k] = lipid.x + turn * shape[k];
      const double way = (lipid.x - listed[i].x).norm() + bent[i] +
          2.0 * radius[i] * (lipid.turn.inverse() * listed[i].turn).vec().norm();
      stale[i] = 4.0 * way > SKIN;
    }
  }
  double total = 0.0;
  for (double part : concatenate(team_, std::vector<double>{energy})) total += part;
  return total;
}
