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

#include "srd_observables.h"

#include "atom.h"
#include "force.h"
#include "hd_mass.h"
#include "srd_cells.h"
#include "srd_fluid.h"
#include "srd_obstacle.h"
#include "srd_solvent.h"

#include <algorithm>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

void SRDObservables::sample(const Scene &scene)
{
  std::fill_n(values, (int) NUM_VALUES, 0.0);
  const double unit = force->mvv2e / force->boltz;
  const auto thermal = scene.cells.measure(scene.solvent, scene.sides);
  auto temperature_of = [unit](const Membrane_NS::CellEnergy &e) {
    return e.freedom > 0.0 ? unit * e.energy / e.freedom : 0.0;
  };
  values[TEMPERATURE] = temperature_of(thermal.all);
  values[TEMPERATURE_IN] = temperature_of(thermal.inside);
  values[TEMPERATURE_OUT] = temperature_of(thermal.outside);
  values[FREE_PATH] = scene.fluid.free_path();
  values[VISCOSITY] = scene.fluid.viscosity();
  values[VISCOSITY_OUT] = scene.fluid.viscosity(0);
  values[VISCOSITY_IN] = scene.fluid.viscosity(1);
  sample_momentum(scene);
  sample_obstacle(scene);
  MPI_Allreduce(const_cast<double *>(scene.wall_impulse), values + WALLS, 3, MPI_DOUBLE, MPI_SUM, world);
  for (int i = 0; i < NUM_VALUES; ++i) values[i] += carried[i];
}

void SRDObservables::sample_momentum(const Scene &scene)
{
  double p[4];
  scene.solvent.momentum(p);
  std::copy_n(p, 3, values + MOMENTUM);
  HDMass *mass = scene.mass;
  if (!mass) return;
  mass->refresh();
  Membrane_NS::VertexField v, pv;
  mass->part().load(atom->v, v);
  pv.resize(v.size());
  mass->matrix().multiply(v, pv);
  double sum[3] = {0.0, 0.0, 0.0};
  for (int i = 0; i < mass->part().owned; ++i)
    for (int k = 0; k < 3; ++k) sum[k] += pv[i].c[k];
  mass->part().sum(sum, 3);
  for (int k = 0; k < 3; ++k) values[MOMENTUM + k] += sum[k];
}

void SRDObservables::sample_obstacle(const Scene &scene)
{
  values[INSIDE] = 0.0;
  values[OUTSIDE] = static_cast<double>(scene.fluid.count());
  const SurfaceObstacle *obstacle = scene.obstacle;
  if (!obstacle) return;
  constexpr int N = SurfaceObstacle::NUM_TALLIES;
  double sum[N];
  MPI_Allreduce(const_cast<double *>(obstacle->tally), sum, N, MPI_DOUBLE, MPI_SUM, world);
  values[COLLISIONS] = sum[SurfaceObstacle::COLLISIONS];
  values[CROSSINGS] = sum[SurfaceObstacle::CROSSINGS] + scene.strays;
  values[RESCUES] = sum[SurfaceObstacle::RESCUES];
  std::copy_n(sum + SurfaceObstacle::HANDED, 3, values + HANDED);
  values[NORMAL_IMPULSE] = sum[SurfaceObstacle::INNER] - sum[SurfaceObstacle::OUTER];

  if (!scene.have_regions) return;
  const SRDSolvent &solvent = scene.solvent;
  const SurfaceRegions &regions = obstacle->regions;
  bigint mine = 0, all;
  for (int i = solvent.first(); i < solvent.last(); ++i)
    mine += solvent.has(i) && regions.is_inside(regions.region[i]);
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  values[INSIDE] = static_cast<double>(all);
  values[OUTSIDE] = static_cast<double>(scene.fluid.count() - all);
}

// === Restart

void SRDObservables::store(double *list) const
{
  std::fill_n(list, (int) NUM_VALUES, 0.0);
  for (int i : {(int) COLLISIONS, (int) CROSSINGS, (int) RESCUES, (int) HANDED, HANDED + 1,
                HANDED + 2, (int) NORMAL_IMPULSE, (int) WALLS, WALLS + 1, WALLS + 2})
    list[i] = values[i];
}

void SRDObservables::restore(const double *list)
{
  std::copy_n(list, (int) NUM_VALUES, carried);
  std::copy_n(list, (int) NUM_VALUES, values);
}
