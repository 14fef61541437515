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

#include "fix_hd_bound.h"

#include "atom.h"
#include "domain.h"
#include "mesh_box.h"

#include <cmath>

using namespace LAMMPS_NS;
using Eigen::Vector3d;

/* ----------------------------------------------------------------------
   the surface at the distance d has the area (1 + 2H d + K d^2) dA, and dA = |r_u x r_v| du dv
------------------------------------------------------------------------- */

double FixHDBound::log_areas()
{
  follow();
  double mine = 0.0, all;
  for (int i : members) {
    limit->look_from(i);
    const auto jet = limit->evaluate<2>(sites[i].point);
    const auto point = jet.limit_point();
    const double d = height * sites[i].leaflet;
    mine += std::log(jet.area_vector().norm() *
                     std::fabs(1.0 + 2.0 * point.mean_curvature * d + point.gaussian_curvature * d * d));
  }
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

void FixHDBound::return_to_sites()
{
  follow();
  for (int i : members) {
    limit->look_from(i);
    const auto jet = limit->evaluate<1>(sites[i].point);
    Vector3d x = jet.position() + height * sites[i].leaflet * jet.normal();
    Vector3d d = x - Vector3d::Map(atom->x[i]);
    nearest_image(*domain, d.data());
    Vector3d::Map(atom->x[i]) += d;
  }
}
