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
#include "mesh_gather.h"

#include <algorithm>
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

/* ---------------------------------------------------------------------- */

SurfaceMotion::SurfaceMotion(LAMMPS *lmp, int igroup, int level, bool all_masses,
                             std::string user) :
    Pointers(lmp), user(std::move(user)), groupbit(group->bitmask[igroup]), all_masses(all_masses),
    local_mesh(lmp, this->user), points(lmp, igroup, this->user), movers(lmp, igroup, this->user),
    shape(lmp, groupbit, level, this->user), known_for(-1), any_fixed(false), step(0.0), time_left(0.0)
{
}

void SurfaceMotion::init()
{
  points.init();
  local_mesh.init();
  movers.init();
  find_fixed();
}

void SurfaceMotion::setup()
{
  follow_points();
  shape.setup(mesh());
  known_for = -1;
  remember();
}

void SurfaceMotion::find_fixed()
{
  int mine = 0, any;
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit && mesh().vertex(atom->tag[i]) >= 0 && !movers.moves(i)) mine = 1;
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, world);
  any_fixed = any != 0;
}

// masses of owned vertices, and which of them are free to move

void SurfaceMotion::find_masses()
{
  masses.clear();
  inverse_masses_owned.clear();
  for (int i = 0; i < part().owned; ++i) {
    const int j = part().atom_of(i);
    masses.push_back(atom->rmass[j]);
    inverse_masses_owned.push_back(movers.moves(j) ? 1.0 / atom->rmass[j] : 0.0);
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
  mask = std::make_unique<LimitMask>(mesh().topology(), part(),
                                     LimitMask::Solver{points.suit_factors(), TOLERANCE});
}

void SurfaceMotion::refresh()
{
  follow_points();
  if (local_mesh.follow() == MeshChange::NOTHING) return;

  MeshPart &part = points.part();
  atom_vertex.assign(atom->nlocal, -1);
  for (int i = 0; i < part.owned; ++i) atom_vertex[part.atom_of(i)] = i;
  find_masses();
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
      if (is_free(i)) continue;
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

// === The surface, as far as it is here

bool SurfaceMotion::find_paths()
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
  if (known_for != points.numbering()) return false;
  spread_paths(*known, vertices);
  return true;
}

void SurfaceMotion::spread_paths(SRDSurfacePart &to, std::vector<SurfaceVertex> &places)
{
  to.spread(mine, 9, spread);
  for (int a = 0; a < to.num_masses(); ++a) {
    const double *values = &spread[9 * (size_t) a];
    places[a].path = {Vector3d::Map(values), Vector3d::Map(values + 3)};
    places[a].acceleration = Vector3d::Map(values + 6);
  }
  shape.place_corners(to.corners(), places);
}

std::unique_ptr<SRDSurfacePart> SurfaceMotion::make_part(std::vector<int> triangles)
{
  return std::make_unique<SRDSurfacePart>(lmp, shape, mesh().topology(), part(),
                                          std::move(triangles), all_masses);
}

std::vector<int> SurfaceMotion::own_triangles()
{
  const auto &topology = mesh().topology();
  std::vector<int> found;
  for (int i = 0; i < part().owned; ++i) {
    const int v = part().vertices[i];
    for (int f : topology.faces_around(v))
      if (topology.face(f)[0] == v) shape.add_triangles(f, found);
  }
  std::sort(found.begin(), found.end());
  return found;
}

bool SurfaceMotion::have_near(const Vector3d &lo, const Vector3d &hi)
{
  const bool new_owners = known_for != points.numbering();
  if (comm->nprocs == 1 && !new_owners) return false;
  if (new_owners) own = make_part(own_triangles());
  if (comm->nprocs == 1)
    known = std::move(own);
  else {
    std::vector<SurfaceVertex> places(own->num_vertices());
    spread_paths(*own, places);
    std::vector<int> near = own->find_in(lo, hi, lattice_now(), places);
    int differs = new_owners || near != known->whole_faces(), any;
    MPI_Allreduce(&differs, &any, 1, MPI_INT, MPI_MAX, world);
    if (!any) return false;
    known = make_part(std::move(near));
    known->find_sharers();
  }
  known_for = points.numbering();
  known->spread(inverse_masses_owned, 1, inverse_masses_here);
  vertices.assign(known->num_vertices(), {});
  for (int a = 0; a < known->num_masses(); ++a) vertices[a].inverse_mass = inverse_masses_here[a];
  spread_paths(*known, vertices);
  return true;
}

std::vector<SurfaceVertex> SurfaceMotion::places()
{
  refresh();
  load_positions();
  struct Place {
    int vertex;
    double x[3];
  };
  std::vector<Place> owned;
  for (int i = 0; i < part().owned; ++i)
    owned.push_back({part().vertices[i], {r[i].c[0], r[i].c[1], r[i].c[2]}});
  std::vector<SurfaceVertex> all(shape.num_vertices(),
                                 {{Vector3d::Zero(), Vector3d::Zero()}});
  for (const Place &place : gather_all(owned, world))
    all[place.vertex].path.origin = Vector3d::Map(place.x);
  shape.place_corners(shape.corners(), all);
  return all;
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
    if (!is_free(i)) moved[i] = drift[i];
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
    if (!is_free(i)) q[i] = {};
  mask->solve(q, r);
  change_velocities();
}

void SurfaceMotion::apply(const std::vector<SurfaceChange> &changes)
{
  q.resize(part().size());
  moved.resize(part().size());
  for (int i = 0; i < part().owned; ++i) {
    const SurfaceChange &change = changes[known->place(i)];
    q[i] = {{change.velocity[0], change.velocity[1], change.velocity[2], 0.0}};
    moved[i] = {{change.position[0], change.position[1], change.position[2], 0.0}};
  }
  mask->solve(q, moved, r, detour);
  change_velocities();
  for (int i = 0; i < part().owned; ++i)
    if (is_free(i))
      for (int k = 0; k < 3; ++k) atom->x[part().atom_of(i)][k] += detour[i].c[k];
}

// of masses by q, of control points by r

void SurfaceMotion::change_velocities()
{
  for (int i = 0; i < part().owned; ++i) {
    if (!is_free(i)) continue;
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
      (own ? own->memory_usage() : 0.0) + (known ? known->memory_usage() : 0.0) +
      sizeof(SurfaceVertex) * vertices.capacity() +
      sizeof(double) * (mine.capacity() + spread.capacity() + 2 * masses.capacity()) +
      sizeof(int) * atom_vertex.capacity() +
      sizeof(Vector4) *
      (q.capacity() + moved.capacity() + r.capacity() + detour.capacity() + velocity.capacity() +
       drift.capacity() + acceleration.capacity());
}
