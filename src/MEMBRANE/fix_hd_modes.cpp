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

// Modes in place of control points: what fix hd/nve, hd/langevin and hd/brownian need besides their matrix.

#include "fix_hd_base.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "hd_mode_space.h"
#include "hd_stiffness_probe.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using Eigen::VectorXd;
using Membrane_NS::ModeChoice;
using Membrane_NS::VertexField;

enum { FIRST_NUMBER, SECOND_NUMBER, WAVE_NUMBER, REAL, IMAGINARY, REAL_RATE, IMAGINARY_RATE, KINETIC, POTENTIAL,
       MOLECULE, NCOLUMNS };

// sums of steps are rounded: so many of them leave the space by some 1e-14 of an edge
static constexpr int SETTLE_EVERY = 1000;

// what is out of the space by less than this, in edges or of the largest velocity, is left where it is when a run
// begins, so that a run from a restart file is the one that goes on
static constexpr double ROUNDING = 1.0e-11;

// from where on control points have been moved, and what is too far for any of the modes, in edges
static constexpr double WORTH_TELLING = 1.0e-6, MOST = 1.0;

/* ---------------------------------------------------------------------- */

void FixHDBase::post_constructor()
{
  if (!modes()) return;
  restart_global = 1;
  array_flag = 1;
  extarray = 0;
  const HDModeSpace space(lmp, std::string("Fix ") + style);
  space.check(mass.settings);
  size_array_rows = space.count_rows(*modes(), groupbit);
  size_array_cols = NCOLUMNS;
}

void FixHDBase::setup_pre_force(int)
{
  if (!modes()) return;
  mass.refresh();
  settle(true);
  comm->forward_comm();
}

// a sheet is of its box, and no membrane goes along with one: its shapes are those about the reference

void FixHDBase::check_box()
{
  for (auto &other : modify->get_fix_list()) {
    if (!other->box_change) continue;
    const bool taken_along = groups_meet(lmp, groupbit, other->groupbit);
    if (taken_along || modes()->choice.shape == ModeChoice::Shape::PLANE)
      error->all(FLERR,
                 "Fix {} modes are those of one box, and fix {} ({}) changes it: take the membrane out of its group if it is "
                 "closed, or move all control points",
                 style, other->id, other->style);
  }
}

/* ----------------------------------------------------------------------
   of owned control points, in the nearest images
------------------------------------------------------------------------- */

void FixHDBase::displacement_from_reference(VertexField &u)
{
  const MeshPart &part = mass.part();
  const auto &reference = mass.modal()->space().reference;
  const double *h = domain->h, *inverse = domain->h_inv;
  u.assign(part.size(), Membrane_NS::Vector4{});
  for (int i = 0; i < part.owned; ++i) {
    const double *x = atom->x[part.atom_of(i)];
    double *d = u[i].c;
    for (int k = 0; k < 3; ++k) d[k] = x[k] - reference[part.vertices[i]][k];
    const double lz = domain->zperiodic ? std::round(inverse[2] * d[2]) : 0.0;
    const double ly = domain->yperiodic ? std::round(inverse[1] * d[1] + inverse[3] * d[2]) : 0.0;
    const double lx = domain->xperiodic ? std::round(inverse[0] * d[0] + inverse[5] * d[1] + inverse[4] * d[2]) : 0.0;
    d[0] -= h[0] * lx + h[5] * ly + h[4] * lz;
    d[1] -= h[1] * ly + h[3] * lz;
    d[2] -= h[2] * lz;
  }
}

/* ----------------------------------------------------------------------
   positions to q0 + Phi a and velocities to Phi adot, those that are nearest in the metric of M
------------------------------------------------------------------------- */

static double largest(const VertexField &field, int n)
{
  double square = 0.0;
  for (int i = 0; i < n; ++i) {
    const double *c = field[i].c;
    square = std::max(square, c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
  }
  return std::sqrt(square);
}

// what positions and velocities have out of the space, and velocities in it; the largest of each on all ranks

struct FixHDBase::OutOfSpace {
  VertexField off, v_off, v_inside;
  double furthest, fastest_off, fastest;
};

FixHDBase::OutOfSpace FixHDBase::out_of_space()
{
  auto &modal = *mass.modal();
  const MeshPart &part = mass.part();
  OutOfSpace out;
  VertexField inside(part.size());
  out.v_inside.resize(part.size());
  displacement_from_reference(out.off);
  modal.expand(modal.amplitudes(out.off), inside);
  part.load(atom->v, out.v_off);
  modal.expand(modal.amplitudes(out.v_off), out.v_inside);
  for (int i = 0; i < part.owned; ++i)
    for (int k = 0; k < 3; ++k) {
      out.off[i].c[k] -= inside[i].c[k];
      out.v_off[i].c[k] -= out.v_inside[i].c[k];
    }
  double mine[3] = {largest(out.off, part.owned), largest(out.v_off, part.owned), largest(out.v_inside, part.owned)};
  double most[3];
  MPI_Allreduce(mine, most, 3, MPI_DOUBLE, MPI_MAX, world);
  out.furthest = most[0];
  out.fastest_off = most[1];
  out.fastest = most[2];
  return out;
}

void FixHDBase::settle(bool first)
{
  measured_step = -1;
  if (!first && (update->ntimestep % SETTLE_EVERY || settled_step == update->ntimestep)) return;
  settled_step = update->ntimestep;
  const double edge = mass.mesh().longest_edge();
  OutOfSpace out = out_of_space();
  if (first && out.furthest > WORTH_TELLING * edge) {    // somebody has moved them since
    mass.take_modes_anew();
    out = out_of_space();
    if (!(out.furthest <= MOST * edge))
      error->all(FLERR,
                 "Fix {} modes: control points are up to {:.3g} edges away from all shapes that the modes have: choose more "
                 "modes, or begin with a shape that is nearer to these",
                 style, out.furthest / edge);
    if (comm->me == 0)
      utils::logmesg(lmp,
                     "Fix {} modes: the reference is that of the present shape, and control points move by up to {:.3g} "
                     "edges to a shape that the modes have\n",
                     style, out.furthest / edge);
  }
  const bool places = !first || out.furthest > ROUNDING * edge;
  const bool velocities = !first || out.fastest_off > ROUNDING * out.fastest;
  const MeshPart &part = mass.part();
  for (int i = 0; i < part.owned; ++i) {
    const int j = part.atom_of(i);
    for (int k = 0; k < 3; ++k) {
      if (places) atom->x[j][k] -= out.off[i].c[k];
      if (velocities) atom->v[j][k] = out.v_inside[i].c[k];
    }
  }
}

/* ----------------------------------------------------------------------
   a mode of stiffness K in the reference relaxes in the time that is wanted if its friction is K times it
------------------------------------------------------------------------- */

void FixHDBase::find_friction()
{
  mass.refresh();
  auto &shared = *mass.settings.modes;
  const MeshPart &part = mass.part();
  VertexField u;
  displacement_from_reference(u);
  auto shift = [&](double sign) {
    for (int i = 0; i < part.owned; ++i)
      for (int k = 0; k < 3; ++k) atom->x[part.atom_of(i)][k] += sign * u[i].c[k];
  };
  std::vector<std::array<double, 3>> before(atom->nlocal);
  for (int i = 0; i < atom->nlocal; ++i) std::copy_n(atom->x[i], 3, before[i].data());
  shift(-1.0);
  std::vector<double> friction;
  {
    StiffnessProbe probe(lmp, mass, StiffnessProbe::Forces::MEMBRANE);
    if (!probe.has_forces()) error->all(FLERR, "Fix {} relax time needs forces: use pair_style helfrich", style);
    const auto &modal = *mass.modal();
    VertexField v(part.size());
    for (const auto &membrane : modal.space().membranes)
      for (const auto &mode : membrane.modes) {
        const bool sphere = shared.choice.shape == ModeChoice::Shape::SPHERE;
        const auto time = shared.times.find({mode.first, sphere ? 0 : mode.second});
        if (time == shared.times.end())
          error->all(FLERR, "Fix {} relax time: the table has no time for mode {}{}", style, mode.first,
                     sphere ? "" : fmt::format(" {}", mode.second));
        const auto k = static_cast<int>(friction.size());
        modal.expand(VectorXd::Unit(modal.count(), k), v);
        const double stiffness = probe.quotient(v) * modal.gram()(k, k);
        if (!(stiffness > 0.0))
          error->all(FLERR, "Fix {} relax time: nothing restores mode {} {}", style, mode.first, mode.second);
        friction.push_back(stiffness * time->second);
      }
    probe.restore();
  }
  for (int i = 0; i < atom->nlocal; ++i) std::copy_n(before[i].data(), 3, atom->x[i]);
  comm->forward_comm();
  shared.friction = friction;
  ++shared.renewals;
}

/* ----------------------------------------------------------------------
   The potential energy of a mode is that of a spring with its force at its amplitude, -(1/2) a Phi^T f: in equilibrium
   its mean is kT/2 whatever the energy is
------------------------------------------------------------------------- */

void FixHDBase::measure_modes()
{
  measured_step = update->ntimestep;
  mass.refresh();
  auto &modal = *mass.modal();
  const MeshPart &part = mass.part();
  VertexField u, v, f;
  displacement_from_reference(u);
  part.load(atom->v, v);
  part.load(atom->f, f);
  const VectorXd a = modal.amplitudes(u), rate = modal.amplitudes(v), pull = modal.project(f);
  const VectorXd momentum = drag_coefficient() > 0.0 ? VectorXd(0.0 * rate) : VectorXd(modal.gram() * rate);
  const bool plane = modes()->choice.shape == ModeChoice::Shape::PLANE;
  rows.clear();
  int k = 0;
  for (const auto &membrane : modal.space().membranes)
    for (size_t m = 0; m < membrane.modes.size(); ++m, ++k) {
      const auto &mode = membrane.modes[m];
      const double kinetic = 0.5 * force->mvv2e * rate[k] * momentum[k], potential = -0.5 * a[k] * pull[k];
      const double amplitude = a[k] / membrane.length, speed = rate[k] / membrane.length;
      if (!mode.sine) {
        const double part_of_wave = plane ? 0.5 : 1.0;    // h = 2 Re h_q exp(iqr)
        rows.push_back({(double) mode.first, (double) mode.second, membrane.wave_number[m],
                        part_of_wave * amplitude, 0.0, part_of_wave * speed, 0.0, kinetic, potential,
                        (double) mass.mesh().molecule(membrane.component)});
      } else {
        rows.back()[IMAGINARY] = -0.5 * amplitude;
        rows.back()[IMAGINARY_RATE] = -0.5 * speed;
        rows.back()[KINETIC] += kinetic;
        rows.back()[POTENTIAL] += potential;
      }
    }
}

double FixHDBase::compute_array(int i, int j)
{
  if (!mass.modal()) return 0.0;    // before the first run
  if (measured_step != update->ntimestep) measure_modes();
  return i < static_cast<int>(rows.size()) ? rows[i][j] : 0.0;
}
