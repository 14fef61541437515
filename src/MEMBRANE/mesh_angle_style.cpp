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

#include "mesh_angle_style.h"

#include "force.h"
#include "lammps.h"

#include <cstring>

using namespace LAMMPS_NS;

static constexpr const char *STYLE = "membrane";

/* ---------------------------------------------------------------------- */

void LAMMPS_NS::set_angle_style_of_faces(LAMMPS *lmp)
{
  if (!lmp->force->angle && lmp->force->angle_map->count(STYLE)) lmp->force->create_angle(STYLE, 0);
}

void LAMMPS_NS::unset_angle_style_of_faces(LAMMPS *lmp)
{
  if (lmp->force->angle && strcmp(lmp->force->angle_style, STYLE) == 0)
    lmp->force->create_angle("none", 0);
}
