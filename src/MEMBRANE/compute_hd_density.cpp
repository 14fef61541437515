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

#include "compute_hd_density.h"

#include "atom.h"
#include "error.h"
#include "fix_hd_bound.h"
#include "memory.h"
#include "update.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using Membrane_NS::SurfacePoint;

// the area of a face is found at the middles of so many squared equal triangles
static constexpr int PARTS = 4;

enum { CURVATURE, AREA, OUTER, INNER, OUTER_DENSITY, INNER_DENSITY, NCOLUMNS };

/* ---------------------------------------------------------------------- */

ComputeHDDensity::ComputeHDDensity(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), bind(nullptr), bins(1), lowest(-INFINITY), highest(INFINITY)
{
  if (narg != 4 && narg != 8)
    error->all(FLERR, "Compute hd/density has the arguments: ID of a fix hd/bind, and: curvature N lowest highest");
  bind_id = arg[3];
  if (narg == 8) {
    if (strcmp(arg[4], "curvature") != 0)
      error->all(FLERR, "Unknown compute hd/density keyword {}; the only one is: curvature", arg[4]);
    bins = utils::inumeric(FLERR, arg[5], false, lmp);
    lowest = utils::numeric(FLERR, arg[6], false, lmp);
    highest = utils::numeric(FLERR, arg[7], false, lmp);
    if (bins < 1) error->all(FLERR, "Compute hd/density curvature: number of bins {} must be positive", arg[5]);
    if (!(lowest < highest))
      error->all(FLERR, "Compute hd/density curvature: {} must be less than {}", arg[6], arg[7]);
  }
  array_flag = 1;
  extarray = 0;
  size_array_rows = bins;
  size_array_cols = NCOLUMNS;
  memory->create(array, bins, NCOLUMNS, "hd/density:array");
}

ComputeHDDensity::~ComputeHDDensity()
{
  memory->destroy(array);
}

void ComputeHDDensity::init()
{
  bind = FixHDBound::named(lmp, bind_id, "Compute hd/density");
}

// of what is beyond the ends, the first and last

int ComputeHDDensity::bin_of(double curvature) const
{
  if (bins == 1) return 0;
  const double at = std::floor(bins * (curvature - lowest) / (highest - lowest));
  return static_cast<int>(MAX(0.0, MIN(at, bins - 1.0)));
}

void ComputeHDDensity::compute_array()
{
  invoked_array = update->ntimestep;
  bind->update_feet();
  mine.assign(3 * (size_t) bins, 0.0);
  LocalSurface &surface = bind->surface();
  auto curvature = [&](const SurfacePoint &p, double &element) {
    const auto jet = surface.evaluate<2>(p);
    element = jet.area_vector().norm();
    return jet.limit_point().mean_curvature;
  };
  double element;
  surface.look_from(-1);
  for (int f : bind->owned_faces())
    for (int i = 0; i < PARTS; ++i)
      for (int j = 0; i + j < PARTS; ++j)
        for (int upper = 0; upper < (i + j < PARTS - 1 ? 2 : 1); ++upper) {
          const double c = upper ? 2.0 / 3.0 : 1.0 / 3.0;
          const double h = curvature({f, (i + c) / PARTS, (j + c) / PARTS}, element);
          mine[3 * bin_of(h)] += 0.5 * element / (PARTS * PARTS);
        }
  for (int i : bind->bound_atoms()) {
    if (!(atom->mask[i] & groupbit)) continue;
    surface.look_from(i);
    const BoundSite &site = bind->site(i);
    ++mine[3 * bin_of(curvature(site.point, element)) + (site.leaflet > 0 ? 1 : 2)];
  }
  all.resize(mine.size());
  MPI_Allreduce(mine.data(), all.data(), static_cast<int>(mine.size()), MPI_DOUBLE, MPI_SUM, world);
  for (int b = 0; b < bins; ++b) {
    const double *sum = &all[3 * b];
    double *row = array[b];
    row[CURVATURE] = bins == 1 ? 0.0 : lowest + (b + 0.5) * (highest - lowest) / bins;
    row[AREA] = sum[0];
    row[OUTER] = sum[1];
    row[INNER] = sum[2];
    row[OUTER_DENSITY] = sum[0] > 0.0 ? sum[1] / sum[0] : 0.0;
    row[INNER_DENSITY] = sum[0] > 0.0 ? sum[2] / sum[0] : 0.0;
  }
}
