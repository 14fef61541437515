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

#include "membrane_molecule_torsions.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

using namespace Membrane_NS;
using Eigen::Vector3d;

static constexpr double STIFF = 0.96;    // |mean of exp(i angle)|, a standard deviation of 16 degrees
static constexpr int NEAR = 3;           // bonds

namespace {

using Bonded = std::vector<std::vector<int>>;

// Atoms that are reached from a bond without crossing it; empty if this leads to its other end

std::vector<int> side_of(const Bonded &bonded, int from, int to)
{
  std::vector<char> reached(bonded.size(), 0);
  std::vector<int> side = {to};
  reached[to] = 1;
  for (size_t i = 0; i < side.size(); ++i)
    for (int j : bonded[side[i]]) {
      if (j == from && side[i] == to) continue;
      if (j == from) return {};
      if (!reached[j]) side.push_back(j);
      reached[j] = 1;
    }
  side.erase(side.begin());
  return side;
}

// A neighbour that makes a dihedral angle: the one with the most neighbours of its own

int neighbour(const Bonded &bonded, int of, int other)
{
  int best = -1;
  for (int j : bonded[of])
    if (j != other && (best < 0 || bonded[j].size() > bonded[best].size())) best = j;
  return best;
}

std::vector<char> far_apart(const Bonded &bonded)
{
  const size_t n = bonded.size();
  std::vector<char> apart(n * n, 1);
  for (size_t i = 0; i < n; ++i) {
    std::vector<int> front = {static_cast<int>(i)};
    apart[i * n + i] = 0;
    for (int distance = 0; distance < NEAR; ++distance) {
      std::vector<int> next;
      for (int j : front)
        for (int k : bonded[j])
          if (apart[i * n + k]) {
            apart[i * n + k] = 0;
            next.push_back(k);
          }
      front = next;
    }
  }
  return apart;
}

}    // namespace

/* ---------------------------------------------------------------------- */

double Torsion::angle(const std::vector<Vector3d> &x) const
{
  const Vector3d axis = x[to] - x[from];
  const Vector3d a = axis.cross(x[before] - x[from]), b = axis.cross(x[after] - x[to]);
  return std::atan2(axis.dot(a.cross(b)), axis.norm() * a.dot(b));
}

double Torsion::turn(double by, std::vector<Vector3d> &x) const
{
  const Eigen::Matrix3d rotation(Eigen::AngleAxisd(by, (x[to] - x[from]).normalized()));
  double way = 0.0;
  for (int k : turning) {
    const Vector3d place = x[to] + rotation * (x[k] - x[to]);
    way = std::max(way, (place - x[k]).squaredNorm());
    x[k] = place;
  }
  return std::sqrt(way);
}

double Torsion::off(double angle) const
{
  const auto above = std::lower_bound(seen.begin(), seen.end(), angle);
  const double high = std::remainder(angle - (above == seen.end() ? seen.front() : *above), 2.0 * M_PI);
  const double low = std::remainder(angle - (above == seen.begin() ? seen.back() : *(above - 1)), 2.0 * M_PI);
  return std::fabs(low) < std::fabs(high) ? low : high;
}

LipidTorsions::LipidTorsions(const PatchLipids &library, int species)
{
  const auto &bonds = library.species[species].terms[BOND];
  Bonded bonded(library.species[species].atoms.size());
  for (size_t b = 0; b < bonds.size(); b += 2) {
    bonded[bonds[b]].push_back(bonds[b + 1]);
    bonded[bonds[b + 1]].push_back(bonds[b]);
  }
  apart = far_apart(bonded);
  for (size_t b = 0; b < bonds.size(); b += 2) {
    Torsion torsion;
    torsion.from = bonds[b];
    torsion.to = bonds[b + 1];
    torsion.turning = side_of(bonded, torsion.from, torsion.to);
    if (2 * torsion.turning.size() + 2 > bonded.size()) {
      std::swap(torsion.from, torsion.to);
      torsion.turning = side_of(bonded, torsion.from, torsion.to);
    }
    torsion.before = neighbour(bonded, torsion.from, torsion.to);
    torsion.after = neighbour(bonded, torsion.to, torsion.from);
    if (torsion.turning.empty() || torsion.before < 0) continue;
    std::complex<double> sum = 0.0;
    for (int conformer : library.by_species[species]) {
      torsion.seen.push_back(torsion.angle(library.conformers[conformer].x));
      sum += std::polar(1.0, torsion.seen.back());
    }
    if (std::abs(sum) > STIFF * torsion.seen.size()) continue;
    std::sort(torsion.seen.begin(), torsion.seen.end());
    torsions.push_back(std::move(torsion));
  }
}

std::vector<double> Membrane_NS::closest_within(const PatchLipids &library, const std::vector<LipidTorsions> &torsions)
{
  const int kinds = library.contacts.kinds();
  std::vector<double> closest(static_cast<size_t>(kinds) * kinds, INFINITY);
  for (const Conformer &conformer : library.conformers) {
    const auto &kind = library.species[conformer.species].kinds;
    const auto &apart = torsions[conformer.species].apart;
    const size_t n = conformer.x.size();
    for (size_t i = 0; i < n; ++i)
      for (size_t j = 0; j < n; ++j)
        if (apart[i * n + j]) {
          double &least = closest[kind[i] * kinds + kind[j]];
          least = std::min(least, (conformer.x[j] - conformer.x[i]).norm());
        }
  }
  return closest;
}
