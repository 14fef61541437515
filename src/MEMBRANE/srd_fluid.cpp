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

#include "srd_fluid.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "membrane_srd.h"
#include "srd_mesh_arguments.h"
#include "srd_solvent.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;
using Membrane_NS::CollisionRule;
using Shift = SRDMeshArguments::Shift;

// with shorter free paths than these, in cells, solvent meets the same partners again and again
static constexpr double SHORT_PATH = 0.1, SHIFT_PATH = 0.6;

/* ---------------------------------------------------------------------- */

SRDFluid::SRDFluid(LAMMPS *lmp, const SRDMeshArguments &given) :
    Pointers(lmp), given(given), temp(given.temperature), mean_mass(1.0), path(0.0), in_cell(0.0),
    eta(0.0), side_in_cell{}, side_eta{}, atoms(0)
{
}

double SRDFluid::kT() const
{
  return force->boltz * temp / force->mvv2e;
}

// time between collisions

double SRDFluid::step() const
{
  return given.every * update->dt;
}

void SRDFluid::measure(const SRDSolvent &solvent)
{
  atoms = solvent.total();
  if (atoms == 0) return;
  double p[4];
  solvent.momentum(p);
  mean_mass = p[3] / atoms;
  if (given.lamda > 0.0)
    temp = std::pow(given.lamda / step(), 2) * mean_mass * force->mvv2e / force->boltz;
  path = Membrane_NS::mean_free_path(kT(), mean_mass, step());
}

SRDCells::Settings SRDFluid::cell_settings() const
{
  SRDCells::Settings settings = given.cells;
  settings.rule.kT = kT();
  const double in_cells = path / settings.size;
  settings.shift = given.shift == Shift::YES ||
      (given.shift == Shift::POSSIBLE && in_cells < SHIFT_PATH);
  if (!settings.shift && in_cells < SHORT_PATH)
    error->all(FLERR,
               "Fix srd/mesh: a mean free path of {:.4g} cells is too short for a grid that stays: "
               "use shift yes, or a longer time between collisions",
               in_cells);
  if (!settings.shift && in_cells < SHIFT_PATH && comm->me == 0)
    error->warning(FLERR,
                   "Fix srd/mesh: with a mean free path of {:.4g} cells and no shift, flow depends "
                   "on the velocity of the grid",
                   in_cells);
  return settings;
}

void SRDFluid::fit(const SRDGrid &grid, bool warn)
{
  in_cell = atoms * grid.cell_volume() / (domain->xprd * domain->yprd * domain->zprd);
  if (grid.deviation() > given.cubic_tolerance) {
    const std::string text = fmt::format(
        "Fix srd/mesh: cells of {:.6g} x {:.6g} x {:.6g} that fit the box differ from hgrid {} by "
        "more than {}: change the box or hgrid, or allow it with cubic warn {:.2g}",
        grid.edge(0), grid.edge(1), grid.edge(2), given.cells.size, given.cubic_tolerance,
        std::ceil(100.0 * grid.deviation()) / 100.0);
    if (given.cubic_error) error->all(FLERR, text);
    if (comm->me == 0 && warn) error->warning(FLERR, text);
  }

  eta = viscosity_of(in_cell, grid);
  for (int side : {0, 1}) side_in_cell[side] = side_eta[side] = 0.0;
}

double SRDFluid::viscosity_of(double particles, const SRDGrid &grid) const
{
  const double edge = std::cbrt(grid.cell_volume());
  const auto &rule = given.cells.rule;
  return rule.method == CollisionRule::Method::SRD
      ? Membrane_NS::srd_viscosity(particles, rule.angle, kT(), mean_mass, edge, step())
      : Membrane_NS::at_viscosity(particles, kT(), mean_mass, edge, step());
}

void SRDFluid::fit_sides(const SRDGrid &grid, const Sides &sides)
{
  const double whole = in_cell;    // if it were spread over the box
  double filled = 0.0;
  for (int side : {0, 1}) {
    if (sides.atoms[side] == 0 || sides.volume[side] == 0.0) continue;
    filled += sides.volume[side];
    side_in_cell[side] = whole * sides.atoms[side] / (atoms * sides.volume[side]);
    side_eta[side] = viscosity_of(side_in_cell[side], grid);
  }
  if (filled == 0.0) return;
  in_cell = whole / filled;
  eta = viscosity_of(in_cell, grid);
}

void SRDFluid::report(const SRDGrid &grid) const
{
  if (comm->me != 0) return;
  utils::logmesg(
      lmp,
      "Fix srd/mesh: {} solvent atoms in {} x {} x {} cells of {:.6g} x {:.6g} x {:.6g}\n"
      "  atoms per cell = {:.6g}, mean free path = {:.6g}, viscosity = {:.6g}\n",
      atoms, grid.divisions(0), grid.divisions(1), grid.divisions(2), grid.edge(0), grid.edge(1),
      grid.edge(2), in_cell, path, eta);
  const char *name[] = {"outside", "inside"};
  for (int side : {1, 0})
    if (side_eta[0] > 0.0 && side_eta[1] > 0.0)
      utils::logmesg(lmp, "  {}: atoms per cell = {:.6g}, viscosity = {:.6g}\n", name[side],
                     side_in_cell[side], side_eta[side]);
}
