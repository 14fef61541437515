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

#include "srd_surface_motion.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "group.h"

#include <cmath>

using namespace LAMMPS_NS;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Membrane_NS::LimitMask;
using Membrane_NS::SurfaceChange;
using Membrane_NS::SurfaceVertex;
using Membrane_NS::Vector4;
using Membrane_NS::VertexField;

// relative residual of L x = b: far below the errors that conservation is tested to
static constexpr double TOLERANCE = 1.0e-14;
// with that, on one rank and for so many control points, a factorization solves in a third to a
// half of the time of the passes
static constexpr bigint MOST_DIRECT = 10000;

/* ---------------------------------------------------------------------- */

SurfaceMotion::SurfaceMotion(LAMMPS *lmp, int igroup, int level, std::string user) :
    Pointers(lmp), user(std::move(user)), groupbit(group->bitmask[igroup]),
    local_mesh(lmp, this->user), points(lmp, igroup, this->user), movers(lmp, igroup, this->user),
    shape(lmp, groupbit, level, this->user), any_fixed(false), step(0.0), time_left(0.0)
{
}

void SurfaceMotion::init()
{
  points.init();
  local_mesh.init();
  movers.init();
  find_masses();
}

void SurfaceMotion::setup()
{
  follow_points();
  shape.setup(mesh());
  vertices.assign(shape.num_vertices(), {{Vector3d::Zero(), Vector3d::Zero()}});
  for (size_t v = 0; v < inverse_masses.size(); ++v) vertices[v].inverse_mass = inverse_masses[v];
  remember();
}

/* ----------------------------------------------------------------------
   masses of all vertices, and which of them are free to move
------------------------------------------------------------------------- */

void SurfaceMotion::find_masses()
{
  const int n = mesh().topology().num_vertices();
  std::vector<double> here(2 * n, 0.0), sum(2 * n);
  for (int i = 0; i < atom->nlocal; ++i) {
    const int v = mesh().vertex(atom->tag[i]);
    if (v < 0 || !(atom->mask[i] & groupbit)) continue;
    here[v] = atom->rmass[i];
    if (movers.moves(i)) here[n + v] = 1.0;
  }
  MPI_Allreduce(here.data(), sum.data(), 2 * n, MPI_DOUBLE, MPI_SUM, world);
  masses.assign(sum.begin(), sum.begin() + n);
  any_fixed = false;
  inverse_masses.resize(n);
  for (int v = 0; v < n; ++v) {
    const bool free = sum[n + v] > 0.0;
    inverse_masses[v] = free ? 1.0 / masses[v] : 0.0;
    any_fixed = any_fixed || (masses[v] > 0.0 && !free);
  }
}

/* ----------------------------------------------------------------------
   With remap v LAMMPS changes velocities of atoms that pass through the boundary: those of one
   membrane would be in two frames, and neither masses nor places of control points would fit
   together; with remap none, places would not
------------------------------------------------------------------------- */

void SurfaceMotion::check_frames()
{
  const Matrix3d rate = lattice_rate();
  for (int i = 0; i < part().owned; ++i) {
    const int v = part().vertices[i], j = part().atom_of(i);
    const auto &offset = shape.to_one_piece(v), &seam = shape.ring_images(v);
    const imageint image = atom->image[j];
    const std::array<int, 3> n = {(int) (image & IMGMASK) - IMGMAX + offset[0],
                                  (int) (image >> IMGBITS & IMGMASK) - IMGMAX + offset[1],
                                  (int) (image >> IMG2BITS) - IMGMAX + offset[2]};
    for (int k = 0; k < 3; ++k)
      if (rate.col(k).squaredNorm() > 0.0 && (n[k] != 0 || seam[k] != 0))
        error->one(
            FLERR,
            "{}: the membrane of atom {} passes through the boundary of the box in {}, which fix "
            "deform moves without the atoms: keep it inside, or use remap x",
            user, atom->tag[j], "xyz"[k]);
  }
}

/* ----------------------------------------------------------------------
   after reneighbouring: who owns what
------------------------------------------------------------------------- */

void SurfaceMotion::follow_points()
{
  constexpr int RINGS = 1;
  if (!points.follow(RINGS)) return;
  const bool direct = comm->nprocs == 1 && points.count() <= MOST_DIRECT;
  mask =
      std::make_unique<LimitMask>(mesh().topology(), part(), LimitMask::Solver{direct, TOLERANCE});
}

void SurfaceMotion::refresh()
{
  follow_points();
  if (local_mesh.follow() == MeshChange::NOTHING) return;

  MeshPart &part = points.part();
  atom_vertex.assign(atom->nlocal, -1);
  for (int i = 0; i < part.owned; ++i) atom_vertex[part.atom_of(i)] = i;

  int owned = part.owned;
  counts.resize(comm->nprocs);
  starts.assign(comm->nprocs + 1, 0);
  MPI_Allgather(&owned, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (int p = 0; p < comm->nprocs; ++p) starts[p + 1] = starts[p] + counts[p];
  owned_by_all.resize(starts.back());
  owner_of.assign(mesh().topology().num_vertices(), -1);
  MPI_Allgatherv(part.vertices.data(), owned, MPI_INT, owned_by_all.data(), counts.data(),
                 starts.data(), MPI_INT, world);
  for (int p = 0; p < comm->nprocs; ++p)
    for (int i = starts[p]; i < starts[p + 1]; ++i) owner_of[owned_by_all[i]] = p;
}

/* ---------------------------------------------------------------------- */

void SurfaceMotion::remember()
{
  if (!any_fixed) return;
  follow_points();
  points.part().load(atom->x, remembered);
  remembered_box = lattice();
  remembered_corner = Vector3d::Map(domain->boxlo);
}

// r: limit positions, unwrapped

void SurfaceMotion::load_positions()
{
  MeshPart &part = points.part();
  q.resize(part.size());
  r.resize(part.size());
  const Matrix3d box = lattice();
  for (int i = 0; i < part.owned; ++i) {
    const int v = part.vertices[i], j = part.atom_of(i);
    Vector3d x;
    domain->unmap(atom->x[j], atom->image[j], x.data());
    const auto &offset = shape.to_one_piece(v);
    x += box * Vector3d(offset[0], offset[1], offset[2]);
    q[i] = {{x[0], x[1], x[2], 0.0}};
  }
  mask->apply(q, r);
  for (int i = 0; i < part.owned; ++i) {
    const auto &seam = shape.ring_images(part.vertices[i]);
    if (!seam[0] && !seam[1] && !seam[2]) continue;
    const Vector3d shift = box * Vector3d(seam[0], seam[1], seam[2]);
    for (int k = 0; k < 3; ++k) r[i].c[k] += mask->spoke(i) * shift[k];
  }
}

// moved: what integrators did in this step; of others, the difference to the last

void SurfaceMotion::load_displacements()
{
  MeshPart &part = points.part();
  moved.assign(part.size(), Vector4{});
  const Matrix3d box = lattice(), to_fraction = box.inverse();
  const Vector3d corner = Vector3d::Map(domain->boxlo);
  if (any_fixed)
    for (int i = 0; i < part.owned; ++i) {
      if (is_free(part.vertices[i])) continue;
      Vector3d before = Vector3d::Map(remembered[i].c);
      if (movers.box_takes_atoms() &&
          box != remembered_box)    // fix deform has taken it along since
        before = corner + box * remembered_box.inverse() * (before - remembered_corner);
      const Vector3d d = Vector3d::Map(atom->x[part.atom_of(i)]) - before;
      Vector3d images = to_fraction * d;    // where another fix has wrapped it
      for (int k = 0; k < 3; ++k) images[k] = domain->periodicity[k] ? std::round(images[k]) : 0.0;
      Vector3d::Map(moved[i].c) = d - box * images;
    }
  movers.load_displacements(atom_vertex, moved);
}

void SurfaceMotion::load_accelerations()
{
  moved.assign(points.part().size(), Vector4{});
  movers.load_accelerations(atom_vertex, moved);
}

// all = the ranks' mine, `width` numbers a vertex, in the order of owned_by_all

void SurfaceMotion::share(int width)
{
  all.resize(width * owned_by_all.size());
  if (comm->nprocs == 1) {
    all = mine;
    return;
  }
  std::vector<int> n(comm->nprocs), first(comm->nprocs);
  for (int p = 0; p < comm->nprocs; ++p) {
    n[p] = width * counts[p];
    first[p] = width * starts[p];
  }
  MPI_Allgatherv(mine.data(), n[comm->me], MPI_DOUBLE, all.data(), n.data(), first.data(),
                 MPI_DOUBLE, world);
}

/* ---------------------------------------------------------------------- */

void SurfaceMotion::begin_step(double dt)
{
  refresh();
  if (movers.images_move()) check_frames();
  load_displacements();
  for (int i = 0; i < part().owned; ++i)
    for (int k = 0; k < 3; ++k) moved[i].c[k] /= dt;
  drift = moved;
  velocity.resize(part().size());
  mask->apply(moved, velocity);
  load_accelerations();
  acceleration.resize(part().size());
  mask->apply(moved, acceleration);
  step = time_left = dt;
}

const std::vector<SurfaceVertex> &SurfaceMotion::paths()
{
  load_positions();
  const int owned = part().owned;
  mine.resize(9 * owned);
  for (int i = 0; i < owned; ++i)
    for (int k = 0; k < 3; ++k) {
      mine[9 * i + k] = r[i].c[k] - time_left * velocity[i].c[k];
      mine[9 * i + 3 + k] = velocity[i].c[k];
      mine[9 * i + 6 + k] = acceleration[i].c[k];
    }
  share(9);
  for (size_t i = 0; i < owned_by_all.size(); ++i) {
    SurfaceVertex &vertex = vertices[owned_by_all[i]];
    vertex.path = {Vector3d::Map(&all[9 * i]), Vector3d::Map(&all[9 * i + 3])};
    vertex.acceleration = Vector3d::Map(&all[9 * i + 6]);
  }
  shape.place_corners(vertices);
  return vertices;
}

const std::vector<SurfaceVertex> &SurfaceMotion::places()
{
  refresh();
  load_positions();
  MeshPart &part = points.part();
  mine.resize(3 * part.owned);
  for (int i = 0; i < part.owned; ++i)
    for (int k = 0; k < 3; ++k) mine[3 * i + k] = r[i].c[k];
  share(3);
  for (size_t i = 0; i < owned_by_all.size(); ++i)
    vertices[owned_by_all[i]].path = {Vector3d::Map(&all[3 * i]), Vector3d::Zero()};
  shape.place_corners(vertices);
  return vertices;
}

void SurfaceMotion::masses_now(VertexField &position, VertexField &velocity_now)
{
  refresh();
  load_positions();
  position.assign(r.begin(), r.begin() + part().owned);
  if (time_left > 0.0)
    for (int i = 0; i < part().owned; ++i)
      for (int k = 0; k < 3; ++k) position[i].c[k] -= time_left * velocity[i].c[k];
  part().load(atom->v, moved);
  velocity_now.resize(part().size());
  for (int i = 0; i < part().owned; ++i)    // whatever velocities the atoms have that nothing moves
    if (!is_free(part().vertices[i])) moved[i] = drift[i];
  mask->apply(moved, velocity_now);
}

/* ----------------------------------------------------------------------
   The control points' velocities and positions follow from those of the masses by L^-1. Atoms are
   at the end of the step already, which velocities that change now change, too.
------------------------------------------------------------------------- */

void SurfaceMotion::apply(const VertexField &change)
{
  q = change;
  q.resize(part().size());
  for (int i = 0; i < part().owned; ++i)
    if (!is_free(part().vertices[i])) q[i] = {};
  mask->solve(q, r);
  change_velocities();
}

void SurfaceMotion::apply(const std::vector<SurfaceChange> &changes)
{
  q.resize(part().size());
  moved.resize(part().size());
  for (int i = 0; i < part().owned; ++i) {
    const SurfaceChange &change = changes[part().vertices[i]];
    q[i] = {{change.velocity[0], change.velocity[1], change.velocity[2], 0.0}};
    moved[i] = {{change.position[0], change.position[1], change.position[2], 0.0}};
  }
  mask->solve(q, moved, r, detour);
  change_velocities();
  for (int i = 0; i < part().owned; ++i)
    if (is_free(part().vertices[i]))
      for (int k = 0; k < 3; ++k) atom->x[part().atom_of(i)][k] += detour[i].c[k];
}

// of masses by q, of control points by r

void SurfaceMotion::change_velocities()
{
  for (int i = 0; i < part().owned; ++i) {
    if (!is_free(part().vertices[i])) continue;
    const int j = part().atom_of(i);
    for (int k = 0; k < 3; ++k) {
      atom->v[j][k] += r[i].c[k];
      atom->x[j][k] += time_left * r[i].c[k];
      if (time_left > 0.0) velocity[i].c[k] += q[i].c[k];
    }
  }
}

double SurfaceMotion::memory_usage() const
{
  return (mask ? mask->memory_usage() : 0.0) + shape.memory_usage() +
      sizeof(SurfaceVertex) * vertices.capacity() +
      sizeof(double) * (mine.capacity() + all.capacity() + masses.capacity()) +
      sizeof(int) * (owned_by_all.capacity() + owner_of.capacity() + atom_vertex.capacity()) +
      sizeof(Vector4) *
      (q.capacity() + moved.capacity() + r.capacity() + detour.capacity() + velocity.capacity() +
       drift.capacity() + acceleration.capacity());
}
