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
#include "domain.h"
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
  side.clear();
}

int SRDCells::Participants::add(const double *x, const double *v, double m, uint64_t name,
                                int which_side)
{
  position.insert(position.end(), x, x + 3);
  velocity.insert(velocity.end(), v, v + 3);
  mass.push_back(m);
  label.push_back(name);
  side.push_back(which_side);
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

  const bool offsets = rule.needs_offsets();
  change_frame(solvent, 1.0);
  const SRDParticles atoms = bin_solvent(solvent, side, offsets), rest = bin_others(side, offsets);

  const int layers = side ? 2 : 1, cells = grid.size(), wide = rule.num_moments();
  moments.assign((size_t) layers * cells * wide, 0.0);
  rule.add(atoms, step, moments.data());
  rule.add(rest, step, moments.data());
  for (int i = 0; i < layers; ++i) grid.sum(moments.data() + (size_t) i * cells * wide, wide);

  // all ranks that hold a cell make the same fillers of it, from the same sums

  const bool filled = given.shift && walls.noslip && walls.any();
  if (filled) fill(step, walls, filling, solvent_mass, layers);
  const SRDParticles fill_in = particles_of(fillers, filler_bins);
  rule.add(fill_in, step, moments.data());

  numbers = grid.numbers();
  if (side)
    for (int64_t c : grid.numbers()) numbers.push_back(c + grid.num_numbers());
  actions.resize((size_t) layers * cells * rule.num_actions());
  rule.prepare(layers * cells, numbers.data(), step, moments.data(), actions.data());

  rule.apply(atoms, actions.data());
  rule.apply(rest, actions.data());
  if (filled) {
    hand_over(walls, -1.0);
    rule.apply(fill_in, actions.data());
    hand_over(walls, 1.0);
  }
  change_frame(solvent, -1.0);
}

/* ----------------------------------------------------------------------
   periodic images of a box that deforms move at different velocities, if fix deform remaps them: in
   a cell that reaches over the boundary, as in Domain::pbc()
------------------------------------------------------------------------- */

void SRDCells::change_frame(const SRDSolvent &solvent, double sign)
{
  if (!domain->deform_vremap) return;
  const double *rate = domain->h_rate;
  auto change = [&](const double *x, double *v) {
    int times[3];
    grid.passed(x, times);
    v[0] -= sign * (rate[0] * times[0] + rate[5] * times[1] + rate[4] * times[2]);
    v[1] -= sign * (rate[1] * times[1] + rate[3] * times[2]);
    v[2] -= sign * rate[2] * times[2];
  };
  for (int i = solvent.first(); i < solvent.last(); ++i)
    if (solvent.has(i) && atom->mask[i] & domain->deform_groupbit) change(atom->x[i], atom->v[i]);
  for (int i = 0; i < others.count(); ++i) change(&others.position[3 * i], &others.velocity[3 * i]);
}

/* ----------------------------------------------------------------------
   side 0 in the first layer of cells, others in the second. A cell that the periodic boundary runs
   through is in one piece beyond one of its ends.
------------------------------------------------------------------------- */

int SRDCells::side_of(const double *x, int side) const
{
  int s = side != 0, times[3];
  if (!flips[0] && !flips[1] && !flips[2]) return s;
  grid.passed(x, times);
  for (int k = 0; k < 3; ++k)
    if (flips[k]) s ^= times[k] & 1;
  return s;
}

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
  if (!offsets && count > 0) grid.find_cells(x[first], count, bins.cell.data());
  for (int i = 0; i < count; ++i) {
    const int j = first + i;
    int &c = bins.cell[i];
    if (!dense && !solvent.has(j)) {
      c = -1;
      continue;
    }
    if (offsets) {
      c = grid.cell(x[j], &bins.offset[3 * (size_t) i]);
      bins.label[i] = atom->tag[j];
    }
    lost = c < 0 ? j : lost;
  }
  if (lost >= 0)
    error->one(FLERR,
               "Fix srd/mesh: solvent atom {} at ({:.6g}, {:.6g}, {:.6g}) is far outside of its "
               "sub-domain or the box",
               atom->tag[lost], x[lost][0], x[lost][1], x[lost][2]);

  if (side && (flips[0] || flips[1] || flips[2])) {
    for (int i = 0; i < count; ++i)
      if (bins.cell[i] >= 0 && side_of(x[first + i], side[first + i])) bins.cell[i] += cells;
  } else if (side) {
    const int *of = side + first;
    int *cell = bins.cell.data();
    for (int i = 0; i < count; ++i) cell[i] += (of[i] != 0) & (cell[i] >= 0) ? cells : 0;
  }

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

SRDParticles SRDCells::bin_others(bool layers, bool offsets)
{
  Binned &bins = other_bins;
  bins.resize(others.count());
  for (int i = 0; i < others.count(); ++i) {
    const double *x = &others.position[3 * i];
    bins.cell[i] = offsets ? grid.cell(x, &bins.offset[3 * i]) : grid.cell(x);
    if (bins.cell[i] < 0)
      error->one(FLERR,
                 "Fix srd/mesh: a point mass of the membrane at ({:.6g}, {:.6g}, {:.6g}) is far "
                 "outside of its sub-domain",
                 x[0], x[1], x[2]);
    if (layers && side_of(x, others.side[i])) bins.cell[i] += grid.size();
  }
  return particles_of(others, bins);
}

void SRDCells::Binned::resize(int n)
{
  cell.resize(n);
  offset.resize(3 * (size_t) n);
  drawn.resize(3 * (size_t) n);
}

SRDParticles SRDCells::particles_of(Participants &members, Binned &bins)
{
  SRDParticles p;
  p.count = members.count();
  p.velocity = members.velocity.data();
  p.mass = members.mass.data();
  p.cell = bins.cell.data();
  p.offset = bins.offset.data();
  p.drawn = bins.drawn.data();
  p.label = members.label.data();
  return p;
}

/* ----------------------------------------------------------------------
   Where cells stick out of the box, an ideal gas at rest with the wall: of a gas that fills the
   cells, the particles outside. Without it the fluid would slip [A. Lamura, G. Gompper, T. Ihle and
   D. M. Kroll, Europhys. Lett. 56, 319 (2001)].

   With a gas at rest it still slips a little. In a flow u = g z along a wall at z = 0, the part of
   a cell inside, a fraction s, has the mean velocity g s/2 and so exchanges momentum, as s (1 - s)
   times the difference between the parts, with one at rest; within a fluid that goes on beyond the
   wall the difference is g/2 whatever s. Averaged over s the wall takes half of what it should, so
   the gas has to move against the flow. It gets the mean velocity -B sqrt(s/(1 - s)) times that of
   the solvent in the cell, with B such that the average is right: B times the integral of s^(5/2)
   (1 - s)^(1/2) over s is 1/12. Since B < 1, noise that is weaker by sqrt(1 - B^2) leaves the mean
   velocity of the gas the variance of equilibrium.
------------------------------------------------------------------------- */

static constexpr double OPPOSE = 0.6790610905254202;    // B = 32/(15 pi)

void SRDCells::fill(bigint step, const BoxWalls &walls, double filling, double mass, int layers)
{
  const uint64_t seed = given.rule.seed ^ FILLER_NUMBERS;
  const CounterRandom random(seed, step);
  fillers.clear();
  filler_bins.cell.clear();
  filler_bins.offset.clear();
  for (int c = 0; c < grid.size(); ++c) {
    if (!grid.sticks_out(c)) continue;
    const int64_t number = grid.numbers()[c];

    // Poisson's distribution, by adding up its terms

    const double u = random.uniforms(number, 0)[0];
    int n = 0;
    double term = std::exp(-filling), sum = term;
    while (u > sum && term > 0.0) {
      term *= filling / ++n;
      sum += term;
    }

    // of solvent on two sides of a membrane, the wall meets those that are more

    const int wide = rule.num_moments();
    int layer = c;
    if (layers == 2 && moments[(size_t) wide * (c + grid.size())] > moments[(size_t) wide * c])
      layer += grid.size();

    const int first = fillers.count();
    double still[3] = {0.0, 0.0, 0.0}, noise[3] = {0.0, 0.0, 0.0};    // sums
    bool along[3] = {true, true, true};                               // the walls of this cell
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
      along[face / 2] = false;
      const uint64_t label = FILLER_LABEL | (static_cast<uint64_t>(number) << 16) | i;
      Membrane_NS::thermal_velocity(seed, step, label, given.rule.kT, mass, v);
      for (int k = 0; k < 3; ++k) {
        noise[k] += v[k];
        still[k] += walls.velocity[face][k];
        v[k] += walls.velocity[face][k];
      }
      fillers.add(x, v, mass, label);
      filler_bins.cell.push_back(layer);
      double offset[3];
      grid.cell(x, offset);
      filler_bins.offset.insert(filler_bins.offset.end(), offset, offset + 3);
    }

    const int added = fillers.count() - first;
    const double *solvent = &moments[(size_t) wide * layer];    // count, mass, momentum
    if (added == 0 || !(solvent[1] > 0.0)) continue;
    const double against = OPPOSE * std::sqrt(solvent[1] / (added * mass)),
                 weaker = std::sqrt(1.0 - OPPOSE * OPPOSE) - 1.0;
    for (int k = 0; k < 3; ++k) {
      if (!along[k]) continue;
      const double change =
          weaker * noise[k] / added - against * (solvent[2 + k] / solvent[1] - still[k] / added);
      for (int i = first; i < fillers.count(); ++i) fillers.velocity[3 * i + k] += change;
    }
  }
  filler_bins.resize(fillers.count());
}

void SRDCells::hand_over(BoxWalls &walls, double sign) const
{
  for (int i = 0; i < fillers.count(); ++i)
    if (grid.owned(filler_bins.cell[i] % grid.size()))
      for (int k = 0; k < 3; ++k)
        walls.impulse[k] += sign * fillers.mass[i] * fillers.velocity[3 * i + k];
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
