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
#include "fmt/format.h"
#include "memory.h"
#include "mesh_box.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

using namespace LAMMPS_NS;
using Membrane_NS::Face;
using Membrane_NS::FaceGroup;
using Membrane_NS::MeshError;
using Membrane_NS::PatchRules;
using Membrane_NS::Topology;

// the ghost cutoff covers stencils that grow by this factor before the next run; edges of a fluid
// membrane of kc = 20 kT come to twice their length
static constexpr double REACH_MARGIN = 2.0;

static constexpr char MISSING_ATOM[] =
    "Control point {} is used by a face but is not an atom: delete whole membranes only, with "
    "delete_atoms ... bond yes mol yes";

/* ---------------------------------------------------------------------- */

DistributedMesh::DistributedMesh(LAMMPS *lmp) : Pointers(lmp) {}

const std::shared_ptr<DistributedMesh> &DistributedMesh::shared(LAMMPS *lmp, const std::string &user)
{
  auto *owner = dynamic_cast<MeshOwner *>(lmp->atom->style_match("membrane_cp"));
  if (!owner)
    lmp->error->all(FLERR, "{} needs control points: use atom_style membrane_cp", user);
  return owner->mesh();
}

/* ---------------------------------------------------------------------- */

// faces of this rank: the three atom IDs and the molecule ID of the middle atom

struct DistributedMesh::AngleList {
  static constexpr int WIDTH = 4;
  std::vector<tagint> data;
};

void DistributedMesh::collect_angles(AngleList &angles)
{
  int lo = 1, hi = atom->nangletypes;
  if (face_types != "*")
    utils::bounds(FLERR, face_types, 1, MAX(1, atom->nangletypes), lo, hi, error);

  // with newton_bond off each of the three atoms has a copy: the middle one counts

  for (int i = 0; i < atom->nlocal; ++i)
    for (int m = 0; m < atom->num_angle[i]; ++m) {
      const int type = std::abs(atom->angle_type[i][m]);
      if (atom->angle_atom2[i][m] != atom->tag[i] || type < lo || type > hi) continue;
      angles.data.insert(angles.data.end(),
                         {atom->angle_atom1[i][m], atom->angle_atom2[i][m],
                          atom->angle_atom3[i][m], atom->molecule[i]});
    }
}

// gather vectors of all ranks, in rank order, on all ranks

template <typename T> static std::vector<T> gather_all(const std::vector<T> &mine, MPI_Comm world)
{
  int nprocs;
  MPI_Comm_size(world, &nprocs);
  int bytes = static_cast<int>(mine.size() * sizeof(T));    // LAMMPS' stand-in for MPI wants it writable
  std::vector<int> counts(nprocs), starts(nprocs, 0);
  MPI_Allgather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  std::partial_sum(counts.begin(), counts.end() - 1, starts.begin() + 1);
  std::vector<T> all((starts.back() + counts.back()) / sizeof(T));
  MPI_Allgatherv(const_cast<T *>(mine.data()), bytes, MPI_BYTE, all.data(), counts.data(),
                 starts.data(), MPI_BYTE, world);
  return all;
}

/* ---------------------------------------------------------------------- */

void DistributedMesh::update()
{
  if (!domain->box_exist) error->all(FLERR, "A membrane needs a simulation box: use create_box");
  if (domain->dimension != 3)
    error->all(FLERR, "A membrane is a surface in space: use dimension 3");

  AngleList angles;
  collect_angles(angles);

  // a sum of hashes does not depend on which rank holds which face

  uint64_t sum = 0;
  auto mix = [](uint64_t h) {
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9ULL;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebULL;
    return h ^ (h >> 31);
  };
  for (size_t i = 0; i < angles.data.size(); i += AngleList::WIDTH) {
    uint64_t h = 1;
    for (int k = 0; k < AngleList::WIDTH; ++k) h = mix(h + (uint64_t) angles.data[i + k]);
    sum += h;
  }
  bigint mine = static_cast<bigint>(sum), total;
  MPI_Allreduce(&mine, &total, 1, MPI_LMP_BIGINT, MPI_SUM, world);

  if (version == 0 || total != fingerprint) {
    rebuild(angles);
    fingerprint = total;
    ++version;
  }
  unwrap();
  measure_reach();
  stale = true;
  ++update_count;

  // stencils that outgrow the margin are found in local_neighbor(); an edge and the skin is what
  // LAMMPS makes of the pair cutoff

  comm->cutghostuser =
      MAX(comm->cutghostuser, MAX(REACH_MARGIN * reach_max, edge_max + neighbor->skin));
}

/* ----------------------------------------------------------------------
   number vertices and faces, and build the topology
------------------------------------------------------------------------- */

void DistributedMesh::rebuild(const AngleList &mine)
{
  const std::vector<tagint> all = gather_all(mine.data, world);
  const size_t nfaces = all.size() / AngleList::WIDTH;

  tags.clear();
  tags.reserve(3 * nfaces);
  for (size_t f = 0; f < nfaces; ++f)
    for (int k = 0; k < 3; ++k) tags.push_back(all[AngleList::WIDTH * f + k]);
  std::sort(tags.begin(), tags.end());
  tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
  tags.shrink_to_fit();

  // the lowest corner comes first and owns the face

  struct Record {
    Face face;
    tagint molecule;
  };
  std::vector<Record> records(nfaces);
  for (size_t f = 0; f < nfaces; ++f) {
    const tagint *a = &all[AngleList::WIDTH * f];
    Face face = {vertex(a[0]), vertex(a[1]), vertex(a[2])};
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    records[f] = {face, a[3]};
  }
  std::sort(records.begin(), records.end(),
            [](const Record &a, const Record &b) { return a.face < b.face; });
  std::vector<Face> faces(nfaces);
  for (size_t f = 0; f < nfaces; ++f) faces[f] = records[f].face;

  Topology::Labels labels;
  labels.vertex = [this](int v) { return fmt::format("control point {}", tags[v]); };
  labels.face = [this, &records](int f) {
    const Face &face = records[f].face;
    return fmt::format("face {}-{}-{}", tags[face[0]], tags[face[1]], tags[face[2]]);
  };
  try {
    topo = Topology(static_cast<int>(tags.size()), std::move(faces), labels);
  } catch (const MeshError &err) {
    version = 0;
    report_missing_atoms();
    error->all(FLERR, "Membrane mesh: {}", err.what());
  }

  // membranes; unwrap() checks that control points agree

  component_molecule.resize(topo.num_components());
  for (size_t f = 0; f < nfaces; ++f)
    component_molecule[topo.component(topo.face(f)[0])] = records[f].molecule;
  membranes = component_molecule;
  std::sort(membranes.begin(), membranes.end());
  membranes.erase(std::unique(membranes.begin(), membranes.end()), membranes.end());
  component_membrane.clear();
  for (tagint molecule : component_molecule)
    component_membrane.push_back(
        std::lower_bound(membranes.begin(), membranes.end(), molecule) - membranes.begin());
}

/* ----------------------------------------------------------------------
   a hole where atoms were deleted: better named by what is missing
------------------------------------------------------------------------- */

void DistributedMesh::report_missing_atoms()
{
  std::vector<char> mine(tags.size(), 0), exists(tags.size());
  for (int i = 0; i < atom->nlocal; ++i) {
    const int v = vertex(atom->tag[i]);
    if (v >= 0) mine[v] = 1;
  }
  MPI_Allreduce(mine.data(), exists.data(), mine.size(), MPI_CHAR, MPI_MAX, world);
  const auto missing = std::find(exists.begin(), exists.end(), 0);
  if (missing != exists.end()) error->all(FLERR, MISSING_ATOM, tags[missing - exists.begin()]);
}

/* ---------------------------------------------------------------------- */

int DistributedMesh::vertex(tagint id) const
{
  if (tags.empty() || id < tags.front() || id > tags.back()) return -1;
  if (tags.back() - tags.front() + 1 == (tagint) tags.size()) return id - tags.front();
  const auto found = std::lower_bound(tags.begin(), tags.end(), id);
  return *found == id ? found - tags.begin() : -1;
}

std::string DistributedMesh::face_name(int f) const
{
  const Face &face = topo.face(f);
  return fmt::format("face {}-{}-{}", tags[face[0]], tags[face[1]], tags[face[2]]);
}

bool DistributedMesh::is_closed_membrane(int membrane) const
{
  for (int c = 0; c < topo.num_components(); ++c)
    if (component_membrane[c] == membrane && !closed[c]) return false;
  return true;
}

Membrane_NS::TriangleMesh DistributedMesh::triangle_mesh() const
{
  Membrane_NS::TriangleMesh mesh;
  mesh.lattice = box_vectors(*domain);
  mesh.periodic = periodic_directions(*domain);
  for (size_t i = 0; i < whole.size(); i += 3)
    mesh.points.emplace_back(whole[i], whole[i + 1], whole[i + 2]);
  mesh.faces = topo.faces();
  return mesh;
}

/* ----------------------------------------------------------------------
   nearest image of a difference, and by how many box lengths it was moved
------------------------------------------------------------------------- */

static std::array<int, 3> nearest_image(const Domain *domain, double *d)
{
  std::array<int, 3> moved = {0, 0, 0};
  const double *inv = domain->h_inv, *h = domain->h;
  const double s[3] = {inv[0] * d[0] + inv[5] * d[1] + inv[4] * d[2], inv[1] * d[1] + inv[3] * d[2],
                       inv[2] * d[2]};
  for (int k = 0; k < 3; ++k)
    if (domain->periodicity[k]) moved[k] = -static_cast<int>(std::round(s[k]));
  d[0] += h[0] * moved[0] + h[5] * moved[1] + h[4] * moved[2];
  d[1] += h[1] * moved[1] + h[3] * moved[2];
  d[2] += h[2] * moved[2];
  return moved;
}

/* ----------------------------------------------------------------------
   put every connected component into one piece by walking over edges; one that comes back to where
   it started in another image of the box is periodic, others are closed and get image flags that
   agree with the walk (volumes are measured in unwrapped coordinates)
------------------------------------------------------------------------- */

void DistributedMesh::unwrap()
{
  struct Located {
    tagint tag, molecule;
    double x[3];
  };
  std::vector<Located> mine;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (vertex(atom->tag[i]) < 0) continue;
    Located point;
    point.tag = atom->tag[i];
    point.molecule = atom->molecule[i];
    domain->unmap(atom->x[i], atom->image[i], point.x);
    mine.push_back(point);
  }
  const std::vector<Located> all = gather_all(mine, world);

  const int n = topo.num_vertices();
  whole.assign(3 * (size_t) n, NAN);
  std::vector<tagint> molecule(n, 0);
  for (const Located &point : all) {
    const int v = vertex(point.tag);
    molecule[v] = point.molecule;
    for (int k = 0; k < 3; ++k) whole[3 * v + k] = point.x[k];
  }
  for (int v = 0; v < n; ++v)
    for (int k = 0; k < 3; ++k)
      if (!std::isfinite(whole[3 * v + k])) {
        if ((bigint) all.size() < n) report_missing_atoms();
        error->all(FLERR, "Control point {} has a coordinate that is not a finite number", tags[v]);
      }

  edge_max = 0.0;
  closed.assign(topo.num_components(), 1);
  std::vector<char> reached(n, 0);
  std::vector<int> queue;
  for (int seed = 0; seed < n; ++seed) {
    if (reached[seed]) continue;
    reached[seed] = 1;
    queue.assign(1, seed);
    for (size_t head = 0; head < queue.size(); ++head) {
      const int v = queue[head];
      for (int i = 0; i < topo.valence(v); ++i) {
        const int w = topo.ring(v)[i];
        if (molecule[w] != molecule[v])
          error->all(FLERR,
                     "Membrane mesh: {} joins membranes {} and {}; control points of one connected "
                     "surface must have one molecule ID: use set ... mol",
                     face_name(topo.faces_around(v)[i]), molecule[v], molecule[w]);
        double d[3];
        for (int k = 0; k < 3; ++k) d[k] = whole[3 * w + k] - whole[3 * v + k];
        const auto moved = nearest_image(domain, d);
        if (!reached[w]) {
          reached[w] = 1;
          queue.push_back(w);
          for (int k = 0; k < 3; ++k) whole[3 * w + k] = whole[3 * v + k] + d[k];
        } else if (moved[0] || moved[1] || moved[2])
          closed[topo.component(v)] = 0;
        edge_max = MAX(edge_max, d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
      }
    }
  }
  edge_max = std::sqrt(edge_max);

  // an edge of half the box could go either way

  for (int k = 0; k < 3; ++k) {
    if (!domain->periodicity[k]) continue;
    const double *inv = domain->h_inv;
    for (int v = 0; v < n; ++v)
      for (int w : topo.ring(v)) {
        double d[3];
        for (int j = 0; j < 3; ++j) d[j] = whole[3 * w + j] - whole[3 * v + j];
        nearest_image(domain, d);
        const double s[3] = {inv[0] * d[0] + inv[5] * d[1] + inv[4] * d[2],
                             inv[1] * d[1] + inv[3] * d[2], inv[2] * d[2]};
        if (std::fabs(s[k]) > 0.45)
          error->all(FLERR,
                     "The edge between control points {} and {} spans half the periodic box in {}; "
                     "use a larger box or a finer mesh",
                     tags[v], tags[w], "xyz"[k]);
      }
  }

  bigint corrected = 0;
  for (int i = 0; i < atom->nlocal; ++i) {
    const int v = vertex(atom->tag[i]);
    if (v < 0 || !closed[topo.component(v)]) continue;
    double now[3], d[3];
    domain->unmap(atom->x[i], atom->image[i], now);
    for (int k = 0; k < 3; ++k) d[k] = now[k] - whole[3 * v + k];
    const auto moved = nearest_image(domain, d);
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
  bigint total;
  MPI_Allreduce(&corrected, &total, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (total && comm->me == 0)
    utils::logmesg(lmp, "Set image flags of {} control points so that closed membranes are whole\n",
                   total);
}

/* ----------------------------------------------------------------------
   whether coordinates differ from those of the last unwrap(), other than by wrapping; collective
------------------------------------------------------------------------- */

bool DistributedMesh::moved_since_unwrap()
{
  const double tiny = 1.0e-12 * edge_max * edge_max;
  int mine = 0, any;
  for (int i = 0; i < atom->nlocal && !mine; ++i) {
    const int v = vertex(atom->tag[i]);
    if (v < 0) continue;
    double d[3];
    domain->unmap(atom->x[i], atom->image[i], d);
    for (int k = 0; k < 3; ++k) d[k] -= whole[3 * (size_t) v + k];
    const auto images = nearest_image(domain, d);
    mine = !(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] <= tiny) ||
        (closed[topo.component(v)] && (images[0] || images[1] || images[2]));
  }
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, world);
  return any;
}

/* ---------------------------------------------------------------------- */

void DistributedMesh::measure_reach()
{
  double most = 0.0;
  std::vector<int> stencil;
  for (int f = 0; f < topo.num_faces(); ++f) {
    topo.stencil(f, stencil);
    for (int corner : topo.face(f))
      for (int v : stencil) {
        double d[3];
        for (int k = 0; k < 3; ++k) d[k] = whole[3 * v + k] - whole[3 * corner + k];
        nearest_image(domain, d);
        most = MAX(most, d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
      }
  }
  reach_max = std::sqrt(most);
}

/* ---------------------------------------------------------------------- */

void DistributedMesh::refresh()
{
  // the count of neighbor builds starts anew at each setup; the time step tells frames of rerun apart

  const bool rebuilt =
      stale || seen_ncalls != neighbor->ncalls || seen_lastcall != neighbor->lastcall;
  if (!rebuilt && seen_nlocal == atom->nlocal && seen_nghost == atom->nghost) return;

  // rerun reads coordinates, perhaps without image flags, between update() and setup

  if (rebuilt && lmp->update->setupflag && moved_since_unwrap()) unwrap();
  stale = false;
  seen_ncalls = neighbor->ncalls;
  seen_lastcall = neighbor->lastcall;
  seen_nlocal = atom->nlocal;
  seen_nghost = atom->nghost;
  ++local_epoch;

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

int DistributedMesh::find_neighbor(int i, int neighbor)
{
  int j = atom->map(tags[neighbor]);
  if (j < 0) return -1;
  j = domain->closest_image(i, j);
  double d[3];
  for (int k = 0; k < 3; ++k) d[k] = atom->x[j][k] - atom->x[i][k];
  const auto moved = nearest_image(domain, d);
  return moved[0] || moved[1] || moved[2] ? -1 : j;
}

int DistributedMesh::local_neighbor(int i, int neighbor, int face)
{
  const int j = find_neighbor(i, neighbor);
  if (j >= 0) return j;
  error->one(FLERR,
             "Control point {}: {} needs control point {}, which is beyond the communication cutoff "
             "{:.6g}; raise it with comm_modify cutoff, or if the mesh of a fluid membrane has lost its "
             "shape, keep it with regularize in pair_coeff{}",
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
      sizeof(double) * whole.capacity() +
      sizeof(int) * faces_here.capacity() + sizeof(OwnedPoint) * points_here.capacity();
}
