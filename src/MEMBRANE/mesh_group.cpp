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

#include "mesh_group.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "group.h"

using namespace LAMMPS_NS;

// vertices whose factors still fit into a third-level cache
static constexpr bigint MOST_FACTORIZED = 15000;

/* ---------------------------------------------------------------------- */

bool LAMMPS_NS::groups_meet(LAMMPS *lmp, int groupbit, int other)
{
  const int *mask = lmp->atom->mask;
  int mine = 0, any;
  for (int i = 0; i < lmp->atom->nlocal; ++i)
    if (mask[i] & groupbit && mask[i] & other) mine = 1;
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, lmp->world);
  return any != 0;
}

/* ---------------------------------------------------------------------- */

MeshGroup::MeshGroup(LAMMPS *lmp, int igroup, std::string user) :
    Pointers(lmp), igroup(igroup), groupbit(group->bitmask[igroup]), user(std::move(user)),
    surface(lmp, this->user), outdated(true), nparts(0), npoints(0)
{
  surface.require();
}

void MeshGroup::init(bool other_atoms)
{
  surface.init();
  check_group(other_atoms);
  outdated = true;
}

/* ----------------------------------------------------------------------
   the group holds control points only, and all those of each of its membranes
------------------------------------------------------------------------- */

void MeshGroup::check_group(bool other_atoms)
{
  const auto &topology = surface->topology();
  const int ncomponents = topology.num_components();
  tagint mine = 0, other;
  std::vector<int> inside(ncomponents, 0), all(ncomponents);
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    const int v = surface->vertex(atom->tag[i]);
    if (v >= 0)
      ++inside[topology.component(v)];
    else
      mine = MAX(mine, atom->tag[i]);
  }
  MPI_Allreduce(&mine, &other, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  MPI_Allreduce(inside.data(), all.data(), ncomponents, MPI_INT, MPI_SUM, world);
  if (other && !other_atoms)
    error->all(FLERR,
               "{} moves control points, and atom {} of its group is none: integrate plain "
               "atoms with a fix of their own, such as fix nve",
               user, other);
  npoints = 0;
  for (int n : all) npoints += n;
  for (int c = 0; c < ncomponents; ++c)
    if (all[c] && all[c] != topology.num_vertices(c))
      error->all(FLERR,
                 "{}: group {} has {} of the {} control points of membrane {}; a surface moves "
                 "as a whole: use a group of whole membranes (group ... molecule)",
                 user, group->names[igroup], all[c], topology.num_vertices(c),
                 surface->molecule(c));
}

/* ---------------------------------------------------------------------- */

bool MeshGroup::follow(int rings)
{
  const MeshChange change = surface.follow();
  if (!outdated) {
    if (change == MeshChange::NOTHING) return false;
    if (change == MeshChange::NUMBERS && vertices->find_atoms_again(*surface)) return false;
  }
  vertices = std::make_unique<MeshPart>(lmp, *surface, groupbit, rings);
  outdated = false;
  ++nparts;
  return true;
}

/* ---------------------------------------------------------------------- */

bool MeshGroup::suit_factors() const
{
  return comm->nprocs == 1 && npoints <= MOST_FACTORIZED;
}
