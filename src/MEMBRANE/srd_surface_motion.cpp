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
#include "mesh_distributed.h"
#include "domain.h"
#include "error.h"
#include "fix_deform.h"
#include "fix_hd_base.h"
#include "force.h"
#include "group.h"
#include "membrane_limit_basis.h"
#include "membrane_tessellation.h"
#include "modify.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Membrane_NS::CollisionEvents;
using Membrane_NS::LimitMask;
using Membrane_NS::MassKind;
using Membrane_NS::SurfaceCorners;
using Membrane_NS::SurfaceVertex;
using Membrane_NS::TriangleMesh;
using Membrane_NS::Vector4;
using Membrane_NS::VertexField;

// relative residual of L x = b: far below the errors that conservation is tested to
static constexpr double TOLERANCE = 1.0e-14;
// with that, on one rank and for so many control points, a factorization solves in a third to a half of the
// time of the passes
static constexpr bigint MOST_DIRECT = 10000;

/* ---------------------------------------------------------------------- */

SurfaceMotion::SurfaceMotion(LAMMPS *lmp, int igroup, int level, std::string user) :
    Pointers(lmp), user(std::move(user)), igroup(igroup), groupbit(group->bitmask[igroup]),
    level(level), points(lmp, igroup, this->user), mean_edge(0.0), any_fixed(false),
    remapped(false), shared_epoch(-1), whole(0.0), ahead(0.0)
{
}

void SurfaceMotion::init()
{
  points.init();
  shared_epoch = -1;
  check_movers();
  find_box_movers();
  find_components();
  find_masses();
}

/* ----------------------------------------------------------------------
   impulses act on momenta of point masses, or on something that never yields
------------------------------------------------------------------------- */

void SurfaceMotion::check_movers()
{
  integrators.clear();
  for (auto &fix : modify->get_fix_list()) {
    auto *integrator = dynamic_cast<FixHDBase *>(fix);
    if (!integrator && !fix->time_integrate) continue;
    int here = 0, any;
    for (int i = 0; i < atom->nlocal; ++i)
      if (atom->mask[i] & groupbit && atom->mask[i] & fix->groupbit) here = 1;
    MPI_Allreduce(&here, &any, 1, MPI_INT, MPI_MAX, world);
    if (!any) continue;
    if (!integrator) {
      if (strcmp(fix->style, "move") == 0) continue;
      error->all(FLERR,
                 "{}: the membranes of group {} are moved by fix {} ({}), which impulses of solvent "
                 "cannot act on: use fix hd/nve or hd/langevin",
                 user, group->names[igroup], fix->id, fix->style);
    }
    if (integrator->drag_coefficient() > 0.0)
      error->all(FLERR,
                 "{}: fix {} ({}) knows no momenta that solvent could change: use fix hd/nve or "
                 "hd/langevin",
                 user, fix->id, fix->style);
    if (integrator->mass_settings().kind != MassKind::VERTEX)
      error->all(FLERR, "{} needs point masses on the surface: use mass vertex in fix {} ({})",
                 user, fix->id, fix->style);
    integrator->remember_displacement();
    integrators.push_back(integrator);
  }
}

/* ----------------------------------------------------------------------
   fix deform takes either all atoms along at the end of a step, or none: then images of atoms move
------------------------------------------------------------------------- */

void SurfaceMotion::find_box_movers()
{
  remapped = false;
  for (auto &fix : modify->get_fix_by_style("^deform")) {
    const auto *deform = dynamic_cast<FixDeform *>(fix);
    if (!deform || deform->remapflag != Domain::X_REMAP) continue;
    int here = 0, any;
    for (int i = 0; i < atom->nlocal; ++i)
      if (atom->mask[i] & groupbit && atom->mask[i] & fix->groupbit) here = 1;
    MPI_Allreduce(&here, &any, 1, MPI_INT, MPI_MAX, world);
    remapped = remapped || any;
  }
}

bool SurfaceMotion::images_move() const
{
  return domain->deform_flag && !remapped;
}

/* ---------------------------------------------------------------------- */

void SurfaceMotion::find_components()
{
  const auto &topology = mesh().topology();
  const int n = topology.num_components();
  std::vector<int> here(n, 0), any(n);
  for (int i = 0; i < atom->nlocal; ++i) {
    const int v = mesh().vertex(atom->tag[i]);
    if (v >= 0 && atom->mask[i] & groupbit) here[topology.component(v)] = 1;
  }
  MPI_Allreduce(here.data(), any.data(), n, MPI_INT, MPI_MAX, world);
  group_components.clear();
  for (int c = 0; c < n; ++c)
    if (any[c]) group_components.push_back(c);
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
    for (FixHDBase *integrator : integrators)
      if (atom->mask[i] & integrator->groupbit) here[n + v] = 1.0;
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
   which images of atoms belong together does not change while LAMMPS counts image flags
------------------------------------------------------------------------- */

void SurfaceMotion::setup()
{
  follow_points();
  const auto &topology = mesh().topology();
  const int n = topology.num_vertices();
  const auto whole = mesh().triangle_mesh();
  const Matrix3d to_fraction = lattice().inverse();
  auto in_lattice = [&](const Vector3d &d) {
    const Vector3d s = to_fraction * d;
    return std::array<int, 3>{(int) std::lround(s[0]), (int) std::lround(s[1]),
                              (int) std::lround(s[2])};
  };

  std::vector<int> here(3 * n, 0), sum(3 * n);
  for (int i = 0; i < atom->nlocal; ++i) {
    const int v = mesh().vertex(atom->tag[i]);
    if (v < 0) continue;
    Vector3d x;
    domain->unmap(atom->x[i], atom->image[i], x.data());
    const auto d = in_lattice(whole.points[v] - x);
    std::copy(d.begin(), d.end(), &here[3 * v]);
  }
  MPI_Allreduce(here.data(), sum.data(), 3 * n, MPI_INT, MPI_SUM, world);
  offset.resize(n);
  ring_seam.assign(n, {0, 0, 0});
  SurfaceCorners::Seams seams(n);
  bool passes = false;
  for (int v = 0; v < n; ++v) {
    std::copy_n(&sum[3 * v], 3, offset[v].begin());
    for (int u : topology.ring(v)) {
      const auto d = in_lattice(whole.points[v] + whole.edge(v, u) - whole.points[u]);
      seams[v].push_back(d);
      for (int k = 0; k < 3; ++k) {
        ring_seam[v][k] += d[k];
        passes = passes || d[k] != 0;
      }
    }
  }
  if (!passes) seams.clear();
  if (level > 0 && (!finer || finer_faces != topology.faces() || finer_seams != seams)) {
    finer.reset();
    if (comm->me == 0)
      utils::logmesg(lmp, "{}: cutting {} faces into {} triangles each\n", user,
                     topology.num_faces(), 1 << (2 * level));
    finer = std::make_unique<SurfaceCorners>(topology, 1 << level, seams);
    finer_faces = topology.faces();
    finer_seams = seams;
  }
  make_surface(whole);
  owner_of.assign(n, -1);
  shared_epoch = -1;
  remember();
}

/* ----------------------------------------------------------------------
   The triangles, and the box vectors between the places of their corners. Each face has its corners
   together, as its control points are, while corners and masses each have one place.
------------------------------------------------------------------------- */

void SurfaceMotion::make_surface(const TriangleMesh &whole)
{
  const auto &topology = mesh().topology();
  const int n = topology.num_vertices();
  const Matrix3d to_fraction = lattice().inverse();
  faces = {};
  face_component.clear();
  vertices.assign(finer ? finer->count() : n, {{Vector3d::Zero(), Vector3d::Zero()}});
  for (int v = 0; v < n; ++v) vertices[v].inverse_mass = inverse_masses[v];

  // a mass has its place with its control point, as in load_positions()

  std::vector<Vector3d> place(vertices.size());
  std::vector<char> placed(vertices.size(), 0);
  for (int v = 0; v < n; ++v) {
    const double spokes = 1.0 - Membrane_NS::limit_mask_centre(topology.valence(v));
    place[v] = whole.points[v];
    for (int u : topology.ring(v)) place[v] += spokes / topology.valence(v) * whole.edge(v, u);
    placed[v] = 1;
  }

  std::vector<char> in_group(topology.num_components(), 0);
  for (int c : group_components) in_group[c] = 1;
  Membrane_NS::FaceTessellation cut(1 << level);
  Membrane_NS::StencilPoints stencil;
  std::vector<Membrane_NS::LimitPoint> points;
  double length = 0.0;
  int num_edges = 0;
  for (int f = 0; f < topology.num_faces(); ++f) {
    const auto &face = topology.face(f);
    const int c = topology.component(face[0]);
    if (!in_group[c]) continue;
    for (int k = 0; k < 3; ++k) length += whole.edge(face[k], face[(k + 1) % 3]).norm();
    num_edges += 3;
    Membrane_NS::stencil_points(topology, whole, f, stencil);
    cut.evaluate(topology.valences(f), stencil, points);
    for (size_t t = 0; t < cut.triangles().size(); ++t) {
      const auto &corners = cut.triangles()[t];
      const auto &triangle =
          finer ? finer->triangles()[f * cut.triangles().size() + t] : topology.face(f);
      std::array<Vector3d, 3> images;
      for (int k = 0; k < 3; ++k) {
        const int corner = triangle[k];
        const Vector3d &here = points[corners[k]].position;
        if (!placed[corner]) place[corner] = here;
        placed[corner] = 1;
        images[k] = to_fraction * (here - place[corner]);
      }
      std::array<std::array<int, 3>, 3> seam;
      for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 3; ++i)
          seam[k][i] = static_cast<int>(std::lround(images[k][i] - images[0][i]));
      faces.faces.push_back(triangle);
      faces.seams.push_back(seam);
      face_component.push_back(c);
    }
  }
  mean_edge = length / std::max(1, num_edges);
}

Matrix3d SurfaceMotion::lattice() const
{
  const double *h = domain->h;
  Matrix3d columns;
  columns << h[0], h[5], h[4], 0.0, h[1], h[3], 0.0, 0.0, h[2];
  return columns;
}

Matrix3d SurfaceMotion::lattice_rate() const
{
  Matrix3d columns = Matrix3d::Zero();
  if (!images_move()) return columns;
  const double *h = domain->h_rate;
  columns << h[0], h[5], h[4], 0.0, h[1], h[3], 0.0, 0.0, h[2];
  return columns;
}

/* ----------------------------------------------------------------------
   With remap v LAMMPS changes velocities of atoms that pass through the boundary: those of one membrane
   would be in two frames, and neither masses nor places of control points would fit together; with remap
   none, places would not
------------------------------------------------------------------------- */

void SurfaceMotion::check_frames()
{
  const Matrix3d rate = lattice_rate();
  for (int i = 0; i < part().owned; ++i) {
    const int v = part().vertices[i], j = part().atom_of(i);
    const imageint image = atom->image[j];
    const std::array<int, 3> n = {(int) (image & IMGMASK) - IMGMAX + offset[v][0],
                                  (int) (image >> IMGBITS & IMGMASK) - IMGMAX + offset[v][1],
                                  (int) (image >> IMG2BITS) - IMGMAX + offset[v][2]};
    for (int k = 0; k < 3; ++k)
      if (rate.col(k).squaredNorm() > 0.0 && (n[k] != 0 || ring_seam[v][k] != 0))
        error->one(FLERR,
                   "{}: the membrane of atom {} passes through the boundary of the box in {}, which fix "
                   "deform moves without the atoms: keep it inside, or use remap x",
                   user, atom->tag[j], "xyz"[k]);
  }
}

std::array<bool, 3> SurfaceMotion::periodic() const
{
  return {domain->periodicity[0] != 0, domain->periodicity[1] != 0, domain->periodicity[2] != 0};
}

/* ----------------------------------------------------------------------
   after reneighbouring: who owns what
------------------------------------------------------------------------- */

void SurfaceMotion::follow_points()
{
  constexpr int RINGS = 1;
  if (!points.follow(RINGS)) return;
  const bool direct = comm->nprocs == 1 && points.count() <= MOST_DIRECT;
  mask = std::make_unique<LimitMask>(mesh().topology(), part(),
                                     LimitMask::Solver{direct, TOLERANCE});
}

void SurfaceMotion::refresh()
{
  follow_points();
  if (shared_epoch == epoch()) return;
  shared_epoch = epoch();

  MeshPart &part = points.part();
  atom_vertex.assign(atom->nlocal, -1);
  for (int i = 0; i < part.owned; ++i) atom_vertex[part.atom_of(i)] = i;

  int owned = part.owned;
  counts.resize(comm->nprocs);
  starts.assign(comm->nprocs + 1, 0);
  MPI_Allgather(&owned, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (int p = 0; p < comm->nprocs; ++p) starts[p + 1] = starts[p] + counts[p];
  listed.resize(starts.back());
  MPI_Allgatherv(part.vertices.data(), owned, MPI_INT, listed.data(), counts.data(), starts.data(),
                 MPI_INT, world);
  for (int p = 0; p < comm->nprocs; ++p)
    for (int i = starts[p]; i < starts[p + 1]; ++i) owner_of[listed[i]] = p;
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
    x += box * Vector3d(offset[v][0], offset[v][1], offset[v][2]);
    q[i] = {{x[0], x[1], x[2], 0.0}};
  }
  mask->apply(q, r);
  for (int i = 0; i < part.owned; ++i) {
    const auto &seam = ring_seam[part.vertices[i]];
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
      if (remapped && box != remembered_box)    // fix deform has taken it along since
        before = corner + box * remembered_box.inverse() * (before - remembered_corner);
      const Vector3d d = Vector3d::Map(atom->x[part.atom_of(i)]) - before;
      Vector3d images = to_fraction * d;    // where another fix has wrapped it
      for (int k = 0; k < 3; ++k) images[k] = domain->periodicity[k] ? std::round(images[k]) : 0.0;
      Vector3d::Map(moved[i].c) = d - box * images;
    }
  for (FixHDBase *integrator : integrators) {
    const MeshPart &theirs = integrator->part();
    for (int i = 0; i < theirs.owned; ++i) {
      const int here = atom_vertex[theirs.atom_of(i)];
      if (here >= 0) moved[here] = integrator->displacement()[i];
    }
  }
}

void SurfaceMotion::load_accelerations()
{
  moved.assign(points.part().size(), Vector4{});
  for (FixHDBase *integrator : integrators) {
    const MeshPart &theirs = integrator->part();
    for (int i = 0; i < theirs.owned; ++i) {
      const int here = atom_vertex[theirs.atom_of(i)];
      if (here >= 0)
        for (int k = 0; k < 3; ++k)
          moved[here].c[k] = force->ftm2v * integrator->last_acceleration()[i].c[k];
    }
  }
}

// all = the ranks' mine, `width` numbers a vertex, in the order of `listed`

void SurfaceMotion::share(int width)
{
  all.resize(width * listed.size());
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
  if (images_move()) check_frames();
  load_displacements();
  for (int i = 0; i < part().owned; ++i)
    for (int k = 0; k < 3; ++k) moved[i].c[k] /= dt;
  drift = moved;
  velocity.resize(part().size());
  mask->apply(moved, velocity);
  load_accelerations();
  acceleration.resize(part().size());
  mask->apply(moved, acceleration);
  whole = ahead = dt;
}

const std::vector<SurfaceVertex> &SurfaceMotion::paths()
{
  load_positions();
  const int owned = part().owned;
  mine.resize(9 * owned);
  for (int i = 0; i < owned; ++i)
    for (int k = 0; k < 3; ++k) {
      mine[9 * i + k] = r[i].c[k] - ahead * velocity[i].c[k];
      mine[9 * i + 3 + k] = velocity[i].c[k];
      mine[9 * i + 6 + k] = acceleration[i].c[k];
    }
  share(9);
  for (size_t i = 0; i < listed.size(); ++i) {
    SurfaceVertex &vertex = vertices[listed[i]];
    vertex.path = {Vector3d::Map(&all[9 * i]), Vector3d::Map(&all[9 * i + 3])};
    vertex.acceleration = Vector3d::Map(&all[9 * i + 6]);
  }
  place_corners();
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
  for (size_t i = 0; i < listed.size(); ++i)
    vertices[listed[i]].path = {Vector3d::Map(&all[3 * i]), Vector3d::Zero()};
  place_corners();
  return vertices;
}

void SurfaceMotion::place_corners()
{
  if (!finer) return;
  const Matrix3d box = lattice();
  for (size_t v = finer->num_masses(); v < vertices.size(); ++v) {
    SurfaceVertex corner;
    corner.path = {box * finer->shift(v), Vector3d::Zero()};
    for (const auto &[a, g] : finer->masses_of(v)) {
      const SurfaceVertex &one = vertices[a];
      corner.path.origin += g * one.path.origin;
      corner.path.velocity += g * one.path.velocity;
      corner.acceleration += g * one.acceleration;
    }
    vertices[v] = corner;
  }
}

void SurfaceMotion::masses_now(VertexField &position, VertexField &velocity_now)
{
  refresh();
  load_positions();
  position.assign(r.begin(), r.begin() + part().owned);
  if (ahead > 0.0)
    for (int i = 0; i < part().owned; ++i)
      for (int k = 0; k < 3; ++k) position[i].c[k] -= ahead * velocity[i].c[k];
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

void SurfaceMotion::apply(const std::vector<CollisionEvents::Change> &changes)
{
  q.resize(part().size());
  moved.resize(part().size());
  for (int i = 0; i < part().owned; ++i) {
    const CollisionEvents::Change &change = changes[part().vertices[i]];
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
      atom->x[j][k] += ahead * r[i].c[k];
      if (ahead > 0.0) velocity[i].c[k] += q[i].c[k];
    }
  }
}

double SurfaceMotion::memory_usage() const
{
  return (mask ? mask->memory_usage() : 0.0) + sizeof(SurfaceVertex) * vertices.capacity() +
      sizeof(double) * (mine.capacity() + all.capacity() + masses.capacity()) +
      sizeof(int) * (listed.capacity() + owner_of.capacity() + atom_vertex.capacity() +
                     6 * offset.capacity()) +
      (finer ? finer->memory_usage() : 0.0) +
      faces.faces.capacity() * (sizeof(Membrane_NS::Face) + 9 * sizeof(int)) +
      sizeof(Vector4) *
      (q.capacity() + moved.capacity() + r.capacity() + detour.capacity() + velocity.capacity() + drift.capacity() +
       acceleration.capacity());
}
