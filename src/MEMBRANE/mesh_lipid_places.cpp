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

#include "mesh_lipid_places.h"

#include "fix.h"
#include "mesh_distributed.h"
#include "modify.h"

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

const LipidPlaces *LipidPlaces::on(const DistributedMesh &mesh, Modify *modify)
{
  int dim;
  for (Fix *fix : modify->get_fix_by_style("^hd/lipids$")) {
    const auto found = static_cast<const LipidPlaces *>(fix->extract("places", dim));
    if (found->lipids && found->mesh == &mesh && found->generation == mesh.generation()) return found;
  }
  return nullptr;
}

int LipidPlaces::kind(const std::string &name) const
{
  for (size_t k = 0; k < kinds.size(); ++k)
    if (kinds[k].name == name) return static_cast<int>(k);
  return -1;
}

int LipidPlaces::count(int leaflet, int face, int kind) const
{
  int n = 0;
  const int first = lipids->first(leaflet, face);
  for (int i = 0; i < lipids->size(leaflet, face); ++i) n += lipids->kind(leaflet, first + i) == kind;
  return n;
}
