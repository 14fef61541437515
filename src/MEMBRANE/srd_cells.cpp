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

#include "srd_cells.h"

#include "atom.h"
#include "error.h"
#include "membrane_random.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using Membrane_NS::BoxWalls;
using Membrane_NS::CellEnergy;
using Membrane_NS::CounterRandom;
using Membrane_NS::SRDParticles;

static constexpr uint64_t FILLER_NUMBERS = 0x66696c6c65720000ULL;

// atom IDs are positive: particles beyond walls have labels that no atom has
static constexpr uint64_t FILLER_LABEL = 1ULL << 63;

/* ---------------------------------------------------------------------- */

SRDCells::SRDCells(LAMMPS *lmp, const Settings &settings) :
    Pointers(lmp), grid(lmp, settings.size), given(settings), rule(settings.rule)
{
}

void SRDCells::Participants::clear()
{
  position.clear();
  velocity.clear();
  mass.clear();
  label.clear();
}

int SRDCells::Participants::add(const double *x, const double *v, double m, uint64_t name)
{
  position.insert(position.end(), x, x + 3);
  velocity.insert(velocity.end(), v, v + 3);
  mass.push_back(m);
  label.push_back(name);
  return count() - 1;
}

/* ---------------------------------------------------------------------- */

void SRDCells::collide(const SRDSolvent &solvent, bigint step, BoxWalls &walls, double filling,
                       double solvent_mass, const int *side)
{
  if (given.shift) {
    double shift[3];
    Membrane_NS::random_shift(given.shift_seed, step, shift);
    grid.place(shift);
  }

  const int members = others.count();
  if (given.shift && walls.noslip && walls.any()) add_fillers(step, walls, filling, solvent_mass);

  const bool offsets = rule.needs_offsets();
  const SRDParticles atoms = bin_solvent(solvent, side, offsets), rest = bin_others(offsets);

  const int layers = side ? 2 : 1, cells = grid.size(), wide = rule.num_moments();
  moments.assign((size_t) layers * cells * wide, 0.0);
  rule.add(atoms, step, moments.data());
  rule.add(rest, step, moments.data());
  for (int i = 0; i < layers; ++i) grid.sum(moments.data() + (size_t) i * cells * wide, wide);

  numbers = grid.numbers();
  if (side)
    for (int64_t c : grid.numbers()) numbers.push_back(c + grid.num_numbers());
  actions.resize((size_t) layers * cells * rule.num_actions());
  rule.prepare(layers * cells, numbers.data(), step, moments.data(), actions.data());

  rule.apply(atoms, actions.data());
  for (int i = members; i < others.count(); ++i)
    for (int k = 0; k < 3; ++k) walls.impulse[k] -= others.mass[i] * others.velocity[3 * i + k];
  rule.apply(rest, actions.data());
  for (int i = members; i < others.count(); ++i)
    for (int k = 0; k < 3; ++k) walls.impulse[k] += others.mass[i] * others.velocity[3 * i + k];

  others.position.resize(3 * members);
  others.velocity.resize(3 * members);
  others.mass.resize(members);
  others.label.resize(members);
}

/* ----------------------------------------------------------------------
   side 0 in the first layer of cells, others in the second
------------------------------------------------------------------------- */

SRDParticles SRDCells::bin_solvent(const SRDSolvent &solvent, const int *side, bool offsets)
{
  const int first = solvent.first(), count = solvent.last() - first, cells = grid.size();
  Binned &bins = solvent_bins;
  bins.cell.resize(count);
  const double *const *x = atom->x;
  const bool dense = solvent.dense();
  int lost = -1;

  if (offsets) {
    bins.offset.resize(3 * (size_t) count);
    bins.drawn.resize(3 * (size_t) count);
    bins.label.resize(count);
  }
  for (int i = 0; i < count; ++i) {
    const int j = first + i;
    if (!dense && !solvent.has(j)) {
      bins.cell[i] = -1;
      continue;
    }
    int c;
    if (offsets) {
      c = grid.cell(x[j], &bins.offset[3 * (size_t) i]);
      bins.label[i] = atom->tag[j];
    } else
      c = grid.cell(x[j]);
    if (c < 0) lost = j;
    if (side && side[j] && c >= 0) c += cells;
    bins.cell[i] = c;
  }
  if (lost >= 0)
    error->one(FLERR,
               "Fix srd/mesh: solvent atom {} at ({:.6g}, {:.6g}, {:.6g}) is far outside of its "
               "sub-domain or the box",
               atom->tag[lost], x[lost][0], x[lost][1], x[lost][2]);

  SRDParticles p;
  p.count = count;
  if (count == 0) return p;
  p.velocity = atom->v[first];
  p.mass = solvent.mass() + first;
  p.cell = bins.cell.data();
  p.offset = bins.offset.data();
  p.drawn = bins.drawn.data();
  p.label = bins.label.data();
  return p;
}

SRDParticles SRDCells::bin_others(bool offsets)
{
  const int count = others.count();
  Binned &bins = other_bins;
  bins.cell.resize(count);
  bins.offset.resize(3 * (size_t) count);
  if (offsets) bins.drawn.resize(3 * (size_t) count);
  for (int i = 0; i < count; ++i) {
    const double *x = &others.position[3 * i];
    bins.cell[i] = grid.cell(x, &bins.offset[3 * i]);
    if (bins.cell[i] < 0)
      error->one(FLERR,
                 "Fix srd/mesh: a point mass of the membrane at ({:.6g}, {:.6g}, {:.6g}) is far "
                 "outside of its sub-domain",
                 x[0], x[1], x[2]);
  }
  SRDParticles p;
  p.count = count;
  p.velocity = others.velocity.data();
  p.mass = others.mass.data();
  p.cell = bins.cell.data();
  p.offset = bins.offset.data();
  p.drawn = bins.drawn.data();
  p.label = others.label.data();
  return p;
}

/* ----------------------------------------------------------------------
   where cells stick out of the box, an ideal gas at rest with the wall: of a gas that fills the
   cells, the particles outside. Without them the fluid would slip [A. Lamura, G. Gompper, T. Ihle
   and D. M. Kroll, Europhys. Lett. 56, 319 (2001); D. S. Bolintineanu et al., Phys. Rev. E 86,
   066703 (2012)].
------------------------------------------------------------------------- */

void SRDCells::add_fillers(bigint step, const BoxWalls &walls, double filling, double mass)
{
  const uint64_t seed = given.rule.seed ^ FILLER_NUMBERS;
  const CounterRandom random(seed, step);
  for (int c = 0; c < grid.size(); ++c) {
    if (!grid.owned(c) || !grid.sticks_out(c)) continue;
    const int64_t number = grid.numbers()[c];

    // Poisson's distribution, by adding up its terms

    const double u = random.uniforms(number, 0)[0];
    int n = 0;
    double term = std::exp(-filling), sum = term;
    while (u > sum && term > 0.0) {
      term *= filling / ++n;
      sum += term;
    }

    for (int i = 0; i < n; ++i) {
      const auto a = random.uniforms(number, 2 * i + 1), b = random.uniforms(number, 2 * i + 2);
      const double f[3] = {a[0], a[1], b[0]};
      double x[3], v[3];
      grid.position_in_cell(c, f, x);
      int face = -1;
      for (int k = 0; k < BoxWalls::FACES; ++k)
        if (walls.present[k] &&
            (k % 2 ? x[k / 2] > walls.position[k] : x[k / 2] < walls.position[k]))
          face = k;
      if (face < 0) continue;
      const uint64_t label = FILLER_LABEL | (static_cast<uint64_t>(number) << 16) | i;
      Membrane_NS::thermal_velocity(seed, step, label, given.rule.kT, mass, v);
      for (int k = 0; k < 3; ++k) v[k] += walls.velocity[face][k];
      others.add(x, v, mass, label);
    }
  }
}

/* ---------------------------------------------------------------------- */

SRDCells::Energies SRDCells::measure(const SRDSolvent &solvent, const int *side)
{
  constexpr int WIDE = CellEnergy::NUM_MOMENTS;
  const int cells = grid.size();
  const double origin[3] = {0.0, 0.0, 0.0};
  grid.place(origin);
  const SRDParticles atoms = bin_solvent(solvent, side, false);
  std::vector<double> sums(2 * (size_t) cells * WIDE, 0.0);
  CellEnergy::add(atoms, sums.data());
  grid.sum(sums.data(), WIDE);
  double *inside = sums.data() + (size_t) cells * WIDE;
  grid.sum(inside, WIDE);

  Energies mine;
  for (int c = 0; c < cells; ++c) {
    if (!grid.owned(c)) continue;
    double *out = sums.data() + (size_t) c * WIDE, *in = inside + (size_t) c * WIDE;
    mine.outside.count(out);
    mine.inside.count(in);
    for (int k = 0; k < WIDE; ++k) out[k] += in[k];
    mine.all.count(out);
  }
  double here[6] = {mine.outside.energy, mine.outside.freedom, mine.inside.energy,
                    mine.inside.freedom, mine.all.energy,      mine.all.freedom},
         sum[6];
  MPI_Allreduce(here, sum, 6, MPI_DOUBLE, MPI_SUM, world);
  Energies total;
  total.outside = {sum[0], sum[1]};
  total.inside = {sum[2], sum[3]};
  total.all = {sum[4], sum[5]};
  return total;
}

double SRDCells::memory_usage() const
{
  return grid.memory_usage() + (moments.capacity() + actions.capacity()) * sizeof(double) +
      solvent_bins.cell.capacity() * sizeof(int) +
      (solvent_bins.offset.capacity() + solvent_bins.drawn.capacity()) * sizeof(double) +
      (solvent_bins.label.capacity() + numbers.capacity()) * sizeof(uint64_t);
}
