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

#include "mesh_unwrapped.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "mesh_box.h"
#include "mesh_faces.h"
#include "mesh_gather.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

// of the box, beyond which an edge could go either way
static constexpr double HALF = 0.45;

/* ---------------------------------------------------------------------- */

void MeshUnwrapped::update()
{
  const std::vector<tagint> molecule = gather_points();
  walk(molecule);
  check_edges();
  correct_images();
}

/* ----------------------------------------------------------------------
   unmapped coordinates of all control points; returns their molecule IDs
------------------------------------------------------------------------- */

std::vector<tagint> MeshUnwrapped::gather_points()
{
  struct Located {
    tagint tag, molecule;
    double x[3];
  };
  std::vector<Located> mine;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (mesh.vertex(atom->tag[i]) < 0) continue;
    Located point;
    point.tag = atom->tag[i];
    point.molecule = atom->molecule[i];
    domain->unmap(atom->x[i], atom->image[i], point.x);
    mine.push_back(point);
  }
  const std::vector<Located> all = gather_all(mine, world);

  const int n = mesh.topology().num_vertices();
  coordinates.assign(3 * (size_t) n, NAN);
  std::vector<tagint> molecule(n, 0);
  for (const Located &point : all) {
    const int v = mesh.vertex(point.tag);
    molecule[v] = point.molecule;
    for (int k = 0; k < 3; ++k) coordinates[3 * (size_t) v + k] = point.x[k];
  }
  for (int v = 0; v < n; ++v)
    for (int k = 0; k < 3; ++k)
      if (!std::isfinite(coordinates[3 * (size_t) v + k])) {
        if ((bigint) all.size() < n) mesh.report_missing_atoms();
        error->all(FLERR, "Control point {} has a coordinate that is not a finite number",
                   mesh.tag(v));
      }
  return molecule;
}

/* ---------------------------------------------------------------------- */

void MeshUnwrapped::walk(const std::vector<tagint> &molecule)
{
  const auto &topology = mesh.topology();
  const int n = topology.num_vertices();
  edge_max = 0.0;
  closed.assign(topology.num_components(), 1);
  std::vector<char> reached(n, 0);
  std::vector<int> queue;
  for (int seed = 0; seed < n; ++seed) {
    if (reached[seed]) continue;
    reached[seed] = 1;
    queue.assign(1, seed);
    for (size_t head = 0; head < queue.size(); ++head) {
      const int v = queue[head];
      for (int i = 0; i < topology.valence(v); ++i) {
        const int w = topology.ring(v)[i];
        if (molecule[w] != molecule[v])
          error->all(FLERR,
                     "Membrane mesh: {} joins membranes {} and {}; control points of one connected "
                     "surface must have one molecule ID: use set ... mol",
                     mesh.face_name(topology.faces_around(v)[i]), molecule[v], molecule[w]);
        const double *from = &coordinates[3 * (size_t) v];
        double *to = &coordinates[3 * (size_t) w];
        double d[3];
        for (int k = 0; k < 3; ++k) d[k] = to[k] - from[k];
        const auto moved = nearest_image(*domain, d);
        if (!reached[w]) {
          reached[w] = 1;
          queue.push_back(w);
          for (int k = 0; k < 3; ++k) to[k] = from[k] + d[k];
        } else if (moved[0] || moved[1] || moved[2])
          closed[topology.component(v)] = 0;
        edge_max = MAX(edge_max, d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
      }
    }
  }
  edge_max = std::sqrt(edge_max);
}

/* ---------------------------------------------------------------------- */

void MeshUnwrapped::check_edges() const
{
  const auto &topology = mesh.topology();
  for (int k = 0; k < 3; ++k) {
    if (!domain->periodicity[k]) continue;
    for (int v = 0; v < topology.num_vertices(); ++v)
      for (int w : topology.ring(v)) {
        double d[3];
        for (int j = 0; j < 3; ++j) d[j] = coordinates[3 * (size_t) w + j] - coordinates[3 * (size_t) v + j];
        nearest_image(*domain, d);
        if (std::fabs(in_box_lengths(*domain, d)[k]) > HALF)
          error->all(FLERR,
                     "The edge between control points {} and {} spans half the periodic box in {}; "
                     "use a larger box or a finer mesh",
                     mesh.tag(v), mesh.tag(w), "xyz"[k]);
      }
  }
}

/* ---------------------------------------------------------------------- */

void MeshUnwrapped::correct_images()
{
  bigint corrected = 0, total;
  for (int i = 0; i < atom->nlocal; ++i) {
    const int v = mesh.vertex(atom->tag[i]);
    if (v < 0 || !closed[mesh.topology().component(v)]) continue;
    double now[3], d[3];
    domain->unmap(atom->x[i], atom->image[i], now);
    for (int k = 0; k < 3; ++k) d[k] = now[k] - coordinates[3 * (size_t) v + k];
    const auto moved = nearest_image(*domain, d);
    if (!(moved[0] || moved[1] || moved[2])) continue;
    const imageint old = atom->image[i];
    const int flag[3] = {(int) (old & IMGMASK) - IMGMAX + moved[0],
                         (int) (old >> IMGBITS & IMGMASK) - IMGMAX + moved[1],
                         (int) (old >> IMG2BITS) - IMGMAX + moved[2]};
    atom->image[i] = ((imageint) (flag[0] + IMGMAX) & IMGMASK) |
        (((imageint) (flag[1] + IMGMAX) & IMGMASK) << IMGBITS) |
        (((imageint) (flag[2] + IMGMAX) & IMGMASK) << IMG2BITS);
    ++corrected;
  }
  MPI_Allreduce(&corrected, &total, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (total && comm->me == 0)
    utils::logmesg(lmp, "Set image flags of {} control points so that closed membranes are in one piece; use run 0 before "
                        "fixes and computes that remember places\n", total);
}

/* ---------------------------------------------------------------------- */

bool MeshUnwrapped::has_moved() const
{
  const double tiny = 1.0e-12 * edge_max * edge_max;
  int mine = 0, any;
  for (int i = 0; i < atom->nlocal && !mine; ++i) {
    const int v = mesh.vertex(atom->tag[i]);
    if (v < 0) continue;
    double d[3];
    domain->unmap(atom->x[i], atom->image[i], d);
    for (int k = 0; k < 3; ++k) d[k] -= coordinates[3 * (size_t) v + k];
    const auto images = nearest_image(*domain, d);
    mine = !(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] <= tiny) ||
        (closed[mesh.topology().component(v)] && (images[0] || images[1] || images[2]));
  }
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, world);
  return any;
}

/* ---------------------------------------------------------------------- */

double MeshUnwrapped::reach() const
{
  const auto &topology = mesh.topology();
  double most = 0.0;
  std::vector<int> stencil;
  for (int f = 0; f < topology.num_faces(); ++f) {
    topology.stencil(f, stencil);
    for (int corner : topology.face(f))
      for (int v : stencil) {
        double d[3];
        for (int k = 0; k < 3; ++k)
          d[k] = coordinates[3 * (size_t) v + k] - coordinates[3 * (size_t) corner + k];
        nearest_image(*domain, d);
        most = MAX(most, d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
      }
  }
  return std::sqrt(most);
}

double MeshUnwrapped::memory_usage() const
{
  return sizeof(double) * coordinates.capacity() + closed.capacity();
}
