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

#include "membrane_molecule_crowd.h"

#include <algorithm>
#include <cmath>

using namespace Membrane_NS;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/* ---------------------------------------------------------------------- */

LipidCrowd::LipidCrowd(const PatchLipids &library, const std::vector<ParallelSurfaces> &parts,
                       const std::array<double, LEAFLETS> &neutral, const FixedAtoms &fixed, uint64_t seed, Team &team) :
    library_(library),
    parts_(parts), neutral_(neutral), fixed_(fixed), seed_(seed), team_(team), kinds_(library.contacts.kinds()),
    conformers_(library.conformers)
{
  for (int a = 0; a < kinds_; ++a)
    for (int b = 0; b < kinds_; ++b) {
      soft_.push_back(SOFT * library.contacts.closest(a, b));
      largest_soft_ = std::max(largest_soft_, soft_.back());
    }
}

// The frame of the leaflet: x along, z outward. Turning keeps handedness.

PlacedLipid LipidCrowd::stand(const ParallelPlace &place, const Vector3d &along, int conformer, int leaflet, int part) const
{
  const Vector3d out = sign_of(leaflet) * place.normal;
  Matrix3d frame;
  frame.col(0) = (along - out * out.dot(along)).normalized();
  frame.col(1) = out.cross(frame.col(0));
  frame.col(2) = out;
  return {place.x + out * conformers_[conformer].lift, Quaterniond(frame), place.point, conformer, leaflet, part};
}

ParallelPlace LipidCrowd::site_of(const PlacedLipid &lipid) const
{
  return parts_[lipid.part].project(lipid.x, lipid.point, sign_of(lipid.leaflet) * neutral_[lipid.leaflet]);
}

BeadGrid LipidCrowd::grid() const
{
  const LimitSurface &surface = parts_[0].surface();
  return {surface.lattice(), surface.periodic()};
}

LipidCrowd::Atoms LipidCrowd::atoms() const
{
  Atoms all;
  for (size_t i = 0; i < lipids.size(); ++i) {
    const Conformer &conformer = conformer_of(static_cast<int>(i));
    const auto &kinds = library_.species[conformer.species].kinds;
    const Matrix3d turn = lipids[i].turn.toRotationMatrix();
    for (size_t k = 0; k < kinds.size(); ++k) {
      all.x.push_back(lipids[i].x + turn * conformer.x[k]);
      all.owner.push_back(static_cast<int>(i));
      all.kind.push_back(kinds[k]);
      all.index.push_back(static_cast<int>(k));
    }
  }
  all.x.insert(all.x.end(), fixed_.x.begin(), fixed_.x.end());
  all.kind.insert(all.kind.end(), fixed_.kinds.begin(), fixed_.kinds.end());
  all.owner.resize(all.x.size(), -1);
  all.index.resize(all.x.size(), -1);
  return all;
}

std::vector<double> LipidCrowd::energies() const
{
  const Atoms all = atoms();
  BeadGrid near = grid();
  near.fill(all.x, largest_soft_);
  std::vector<double> energy(lipids.size(), 0.0);
  for (size_t i = 0; i < all.x.size(); ++i) {
    if (all.owner[i] < 0) break;
    const int a = static_cast<int>(i);
    near.near(all.x[a], [&](int b, const Vector3d &, double d2) { energy[all.owner[a]] += overlap(d2, reach(all, a, b)); });
  }
  return energy;
}

LipidCrowd::Report LipidCrowd::report() const
{
  const Atoms all = atoms();
  BeadGrid near = grid();
  near.fill(all.x, library_.contacts.largest());
  std::vector<char> clash(lipids.size(), 0);
  double least = INFINITY;
  for (size_t i = 0; i < all.x.size(); ++i) {
    if (all.owner[i] < 0) break;
    near.near(all.x[i], [&](int j, const Vector3d &, double d2) {
      double closest = library_.contacts.closest(all.kind[i], all.kind[j]);
      if (all.owner[j] == all.owner[i])
        closest = std::min(closest, reach(all, static_cast<int>(i), j));
      else
        least = std::min(least, d2);
      closest *= CLASH;
      if (d2 < closest * closest) clash[all.owner[i]] = 1;
    });
  }
  Report report;
  report.closest = std::sqrt(least);
  for (size_t i = 0; i < clash.size(); ++i)
    if (clash[i]) report.which.push_back(static_cast<int>(i));
  report.lipids = static_cast<int>(report.which.size());
  return report;
}

/* ---------------------------------------------------------------------- */

void LipidCrowd::give_own_shape(int lipid)
{
  if (has_own_shape(lipid)) return;
  conformers_.push_back(conformer_of(lipid));
  lipids[lipid].conformer = static_cast<int>(conformers_.size()) - 1;
}

void LipidCrowd::prepare_torsions()
{
  if (!torsions_.empty()) return;
  for (size_t s = 0; s < library_.species.size(); ++s) torsions_.emplace_back(library_, static_cast<int>(s));
  soft_within_ = closest_within(library_, torsions_);
  for (size_t k = 0; k < soft_.size(); ++k) soft_within_[k] = std::min(soft_within_[k], soft_[k]);
}

// The largest distance of an atom from the centre of its lipid

double LipidCrowd::reach_of_lipids() const
{
  double reach = 0.0;
  for (const Conformer &conformer : conformers_)
    for (const Vector3d &x : conformer.x) reach = std::max(reach, x.norm());
  return reach;
}
