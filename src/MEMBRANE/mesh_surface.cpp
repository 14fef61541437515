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

#include "mesh_surface.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "mesh_box.h"

using namespace LAMMPS_NS;
using Membrane_NS::IntSpan;
using Membrane_NS::Lane4;

/* ---------------------------------------------------------------------- */

LocalSurface::LocalSurface(LAMMPS *lmp, DistributedMesh &mesh) :
    LimitSurface(mesh.topology(), periodic_directions(*lmp->domain)), lmp(lmp), mesh(mesh),
    atom_of(stencil_.size()), found(topology_.num_faces(), 0)
{
  follow_box();
  const auto control = mesh.triangle_mesh();
  double sum = 0.0;
  for (int v = 0; v < topology_.num_vertices(); ++v)
    for (int w : topology_.ring(v))
      if (v < w) sum += control.edge(v, w).norm();
  set_mean_edge(sum / MAX(topology_.num_edges(), 1));
}

void LocalSurface::follow_box()
{
  set_box(box_vectors(*lmp->domain));
}

/* ----------------------------------------------------------------------
   each point is the image nearest to one that is already placed and shares an edge with it
------------------------------------------------------------------------- */

const int *LocalSurface::atoms(int face) const
{
  if (face == expected_face) return expected;
  int *local = &atom_of[start_[face]];
  if (found[face] == epoch) return local;
  const IntSpan span = stencil(face);
  const std::vector<int> points(span.begin(), span.end());
  local[0] = lmp->atom->map(mesh.tag(points[0]));
  if (local[0] < 0)
    lmp->error->one(FLERR,
               "Membrane mesh: {} is beyond the communication cutoff {:.6g}, but a bound particle is on it: "
               "raise it with comm_modify cutoff, or reneighbor more often",
               mesh.face_name(face), lmp->comm->get_comm_cutoff());
  if (viewer >= 0) local[0] = lmp->domain->closest_image(viewer, local[0]);
  topology_.along_stencil(points, [&](int column, int anchor) {
    local[column] = mesh.local_neighbor(local[anchor], points[column], face);
  });
  found[face] = epoch;
  return local;
}

void LocalSurface::gather(int face, Lane4 *x) const
{
  const int *local = atoms(face), size = stencil_size(face);
  const double *const place = lmp->atom->x[0];
  for (int k = 0; k < size; ++k) {
    const double *at = place + 3 * static_cast<size_t>(local[k]);
    x[k] = {at[0], at[1], at[2], 0.0};
  }
}

double LocalSurface::memory_usage() const
{
  return LimitSurface::memory_usage() + sizeof(int) * (atom_of.capacity() + found.capacity());
}
