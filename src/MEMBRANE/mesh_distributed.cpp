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

#include "mesh_distributed.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "membrane_tessellation.h"
#include "mesh_box.h"
#include "neighbor.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;
using Membrane_NS::FaceGroup;
using Membrane_NS::MeshError;
using Membrane_NS::PatchRules;

// the ghost cutoff covers stencils that grow by this factor before the next run; edges of a fluid
// membrane of kc = 20 kT come to twice their length
static constexpr double REACH_MARGIN = 2.0;

/* ---------------------------------------------------------------------- */

DistributedMesh::DistributedMesh(LAMMPS *lmp) : MeshFaces(lmp), pieces(lmp, *this) {}

const std::shared_ptr<DistributedMesh> &DistributedMesh::shared(LAMMPS *lmp, const std::string &user)
{
  auto *owner = dynamic_cast<MeshOwner *>(lmp->atom->style_match("membrane_cp"));
  if (!owner)
    lmp->error->all(FLERR, "{} needs control points: use atom_style membrane_cp", user);
  return owner->mesh();
}

/* ---------------------------------------------------------------------- */

void DistributedMesh::update()
{
  if (!domain->box_exist) error->all(FLERR, "A membrane needs a simulation box: use create_box");
  if (domain->dimension != 3)
    error->all(FLERR, "A membrane is a surface in space: use dimension 3");
  update_faces();
  pieces.update();
  stale = true;
  ++update_count;

  // stencils that outgrow the margin are found in local_neighbor(); an edge and the skin is what
  // LAMMPS makes of the pair cutoff

  comm->cutghostuser = MAX(comm->cutghostuser, ghost_cutoff());
}

double DistributedMesh::ghost_cutoff() const
{
  return MAX(REACH_MARGIN * pieces.reach(), longest_edge() + neighbor->skin);
}

bool DistributedMesh::is_closed_membrane(int m) const
{
  for (int c = 0; c < topo.num_components(); ++c)
    if (membrane(c) == m && !pieces.is_closed(c)) return false;
  return true;
}

Membrane_NS::TriangleMesh DistributedMesh::triangle_mesh() const
{
  Membrane_NS::TriangleMesh mesh;
  mesh.lattice = box_vectors(*domain);
  mesh.periodic = periodic_directions(*domain);
  for (size_t i = 0; i < unwrapped().size(); i += 3) mesh.points.emplace_back(&unwrapped()[i]);
  mesh.faces = topo.faces();
  return mesh;
}

/* ----------------------------------------------------------------------
   a component that is wider than the box, in a direction it does not continue in, runs into its images
------------------------------------------------------------------------- */

void DistributedMesh::warn_of_overlap() const
{
  if (comm->me != 0) return;
  const auto continues = continuing_directions(topo, triangle_mesh());
  const std::vector<double> &x = unwrapped();
  const int n = topo.num_components();
  std::vector<std::array<double, 3>> lo(n, {INFINITY, INFINITY, INFINITY}),
      hi(n, {-INFINITY, -INFINITY, -INFINITY});
  for (int v = 0; v < topo.num_vertices(); ++v) {
    const int c = topo.component(v);
    const auto s = in_box_lengths(*domain, &x[3 * v]);
    for (int k = 0; k < 3; ++k) {
      lo[c][k] = MIN(lo[c][k], s[k]);
      hi[c][k] = MAX(hi[c][k], s[k]);
    }
  }
  for (int c = 0; c < n; ++c)
    for (int k = 0; k < 3; ++k)
      if (domain->periodicity[k] && !continues[c][k] && hi[c][k] - lo[c][k] > 1.0)
        error->warning(FLERR,
                       "Membrane {} spans {:.4g} of the periodic box in {}: it overlaps its own images; "
                       "use a larger box",
                       molecule(c), hi[c][k] - lo[c][k], "xyz"[k]);
}

/* ---------------------------------------------------------------------- */

void DistributedMesh::refresh()
{
  // the count of neighbor builds starts anew at each setup; the time step tells frames of rerun apart

  const bool rebuilt =
      stale || seen_ncalls != neighbor->ncalls || seen_lastcall != neighbor->lastcall;
  int changed = rebuilt || seen_nlocal != atom->nlocal || seen_nghost != atom->nghost;

  // between runs a command may take atoms from one rank alone, and all follow together

  if (lmp->update->whichflag == 0)
    MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPI_INT, MPI_MAX, world);
  if (!changed) return;

  // a mesh whose points move fast against the skin is often rebuilt with nothing new in it

  int other = !is_arranged_as_before();
  if (rebuilt && !stale && lmp->update->whichflag != 0 && !lmp->update->setupflag) {
    MPI_Allreduce(MPI_IN_PLACE, &other, 1, MPI_INT, MPI_MAX, world);
    if (!other) {
      seen_ncalls = neighbor->ncalls;
      seen_lastcall = neighbor->lastcall;
      return;
    }
  }

  // rerun reads coordinates, perhaps without image flags, between update() and setup

  if (rebuilt && lmp->update->setupflag && pieces.has_moved()) pieces.update();
  stale = false;
  seen_ncalls = neighbor->ncalls;
  seen_lastcall = neighbor->lastcall;
  seen_nlocal = atom->nlocal;
  seen_nghost = atom->nghost;
  ++local_epoch;
  near2 = surely_nearest_square(*domain);

  faces_here.clear();
  points_here.clear();
  for (int i = 0; i < atom->nlocal; ++i) {
    const int v = vertex(atom->tag[i]);
    if (v < 0) continue;
    points_here.push_back({i, v});
    for (int f : topo.faces_around(v))
      if (topo.face(f)[0] == v) faces_here.push_back(f);
  }
}

/* ---------------------------------------------------------------------- */

// are local indices, of owned atoms and of images, those of the same atoms as when it was asked last?

bool DistributedMesh::is_arranged_as_before()
{
  const size_t n = atom->nlocal + atom->nghost;
  std::vector<Seen> now(n);
  bool same = seen_nlocal == atom->nlocal && seen.size() == n;
  for (size_t i = 0; i < n; ++i) {
    now[i] = {atom->tag[i], atom->type[i], atom->mask[i], {atom->x[i][0], atom->x[i][1], atom->x[i][2]}};
    same = same && now[i].tag == seen[i].tag && now[i].type == seen[i].type && now[i].mask == seen[i].mask;
    if (!same) continue;
    double d[3];
    for (int k = 0; k < 3; ++k) d[k] = now[i].x[k] - seen[i].x[k];
    const auto moved = nearest_image(*domain, d);
    same = !moved[0] && !moved[1] && !moved[2];
  }
  seen.swap(now);
  return same;
}

/* ---------------------------------------------------------------------- */

int DistributedMesh::find_neighbor(int i, int neighbor)
{
  int j = atom->map(tags[neighbor]);
  if (j < 0) return -1;
  const double *const x = atom->x[i];
  double d[3];
  auto is_surely_nearest = [&] {
    for (int k = 0; k < 3; ++k) d[k] = atom->x[j][k] - x[k];
    return d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < near2;
  };
  if (is_surely_nearest()) return j;
  j = domain->closest_image(i, j);
  if (is_surely_nearest()) return j;
  const auto moved = nearest_image(*domain, d);
  return moved[0] || moved[1] || moved[2] ? -1 : j;
}

int DistributedMesh::local_neighbor(int i, int neighbor, int face)
{
  const int j = find_neighbor(i, neighbor);
  if (j >= 0) return j;
  if (lmp->update->whichflag == 0)
    error->one(FLERR, "Control point {}: {} needs control point {}, which is not at hand between runs: use run 0 after "
                      "commands that make or delete atoms", atom->tag[i], face_name(face), tags[neighbor]);
  error->one(FLERR,
             "Control point {}: {} needs control point {}, which is beyond the communication cutoff "
             "{:.6g}; raise it with comm_modify cutoff, or if the mesh of a fluid membrane has lost its "
             "shape, keep it with regularize in pair_coeff{}; if it was deleted, delete whole membranes",
             atom->tag[i], face_name(face), tags[neighbor], comm->get_comm_cutoff(),
             domain->nonperiodic ? ", unless it left the box, which is not periodic" : "");
  return -1;
}

/* ---------------------------------------------------------------------- */

std::vector<FaceGroup> DistributedMesh::local_groups(PatchRules &rules,
                                                     const std::vector<int> &faces)
{
  std::vector<FaceGroup> groups;
  try {
    groups = group_faces(topo, rules, faces);
  } catch (const MeshError &err) {
    error->one(FLERR, "Membrane mesh: {}", err.what());
  }

  for (FaceGroup &group : groups) {
    const int size = group.rule->size;
    for (int s = 0; s < group.nslots(); ++s) {
      const int f = group.face[MIN(s, group.nfaces - 1)];
      const int owner = topo.face(f)[0];

      // each point is the image nearest to one that is already placed and shares an edge with it:
      // corners to the owner, points of a corner's ring to that corner

      int anchor = 0;
      while (group.point(s, anchor) != owner) ++anchor;
      const int here = group.point(s, anchor) = atom->map(tags[owner]);
      int corner[3], valence[3];
      for (int k = 0; k < 3; ++k) {
        int &point = group.point(s, k);
        valence[k] = topo.valence(k == anchor ? owner : point);
        if (k != anchor) point = local_neighbor(here, point, f);
        corner[k] = point;
      }
      int column = 3;
      for (int k = 0; k < 3; ++k)
        for (int i = 0; i < valence[k] - 3; ++i, ++column)
          group.point(s, column) = local_neighbor(corner[k], group.point(s, column), f);
      if (column < size) group.point(s, column) = local_neighbor(here, group.point(s, column), f);
    }
  }
  return groups;
}

/* ---------------------------------------------------------------------- */

double DistributedMesh::memory_usage() const
{
  return topo.memory_usage() + sizeof(tagint) * tags.capacity() +
      pieces.memory_usage() +
      sizeof(Seen) * seen.capacity() + sizeof(int) * faces_here.capacity() + sizeof(OwnedPoint) * points_here.capacity();
}
