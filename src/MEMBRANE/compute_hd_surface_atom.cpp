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

#include "compute_hd_surface_atom.h"

#include "atom.h"
#include "error.h"
#include "fix_hd_bound.h"
#include "memory.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;
using Eigen::Vector3d;

enum { FACE, U, V, DISTANCE, P_U, P_V, MEAN, GAUSSIAN, NORMAL, LEAFLET = NORMAL + 3, FOOTPRINT, DIRECTOR, NCOLUMNS = DIRECTOR + 3 };

/* ---------------------------------------------------------------------- */

ComputeHDSurfaceAtom::ComputeHDSurfaceAtom(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), bind(nullptr), nmax(0)
{
  if (narg != 4) error->all(FLERR, "Compute hd/surface/atom has one argument: the ID of a fix hd/bind");
  bind_id = arg[3];
  peratom_flag = 1;
  size_peratom_cols = NCOLUMNS;
}

ComputeHDSurfaceAtom::~ComputeHDSurfaceAtom()
{
  memory->destroy(array_atom);
}

void ComputeHDSurfaceAtom::init()
{
  bind = FixHDBound::named(lmp, bind_id, "Compute hd/surface/atom");
}

void ComputeHDSurfaceAtom::compute_peratom()
{
  invoked_peratom = update->ntimestep;
  bind->update_feet();
  if (atom->nmax > nmax) {
    nmax = atom->nmax;
    memory->destroy(array_atom);
    memory->create(array_atom, nmax, NCOLUMNS, "hd/surface/atom:array_atom");
  }
  for (int i = 0; i < atom->nlocal; ++i) std::fill_n(array_atom[i], NCOLUMNS, 0.0);
  for (int i : bind->bound_atoms()) {
    if (!(atom->mask[i] & groupbit)) continue;
    const BoundSite &site = bind->site(i);
    bind->surface().look_from(i);
    const auto jet = bind->surface().evaluate<2>(site.point);
    const auto point = jet.limit_point();
    const Vector3d p = bind->mass_of(i) * Vector3d::Map(atom->v[i]);
    double *row = array_atom[i];
    row[FACE] = site.point.face + 1;
    row[U] = site.point.u;
    row[V] = site.point.v;
    row[DISTANCE] = site.distance;
    row[P_U] = p.dot(jet.du());
    row[P_V] = p.dot(jet.dv());
    row[MEAN] = point.mean_curvature;
    row[GAUSSIAN] = point.gaussian_curvature;
    for (int k = 0; k < 3; ++k) row[NORMAL + k] = point.normal[k];
    row[LEAFLET] = site.leaflet;
    row[FOOTPRINT] = site.curvature;
    for (int k = 0; k < 3; ++k) row[DIRECTOR + k] = site.director[k];
  }
}

double ComputeHDSurfaceAtom::memory_usage()
{
  return sizeof(double) * (double) nmax * NCOLUMNS;
}
