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

#include "srd_obstacle.h"

#include "atom.h"
#include "comm.h"
#include "mesh_distributed.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "membrane_random.h"
#include "update.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using Eigen::Vector3d;
using Membrane_NS::ApproachList;
using Membrane_NS::BoxWalls;
using Membrane_NS::CollisionEvents;
using Membrane_NS::MovingPoint;
using Membrane_NS::SurfaceGrid;
using Membrane_NS::VertexField;
using Membrane_NS::SurfaceImpulse;

// all of these in edges of the mesh; those of the grid, of the surface

// see TriangleCollision: far above rounding, also of coordinates in a large box
static constexpr double CONTACT = 1.0e-10;
// the grid is built anew when vertices have moved so far; its cubes know triangles within both
static constexpr double SKIN = 0.35, REACH = 0.45;
// vertices may be deflected so far in one step, points so far beyond where their speed takes them;
// looked for in the first attempt, and at most
static constexpr double FIRST_SLACK = 0.004, MOST_SLACK = 0.15;
// more for a step that needs it, which is likely too much for others
static constexpr double MORE_SLACK = 1.5, LESS_SLACK = 0.99;
static constexpr double SPACING = 1.2;
// of the list of solvent that comes near, to begin with
static constexpr double MARGIN = 0.2;
// and for it solvent moves so far, in root mean squares: further, and there would be many to look at
static constexpr double LONGEST = 0.5;

// of the random numbers that say with which side a point mass collides, and of thermal velocities of
// those that are held
static constexpr uint64_t SIDE_SEED = 0x73696465, HELD_SEED = 0x68656c64;

// solvent faster than this, in root mean squares, needs more than one look
static constexpr double FAST = 2.5;

/* ---------------------------------------------------------------------- */

SurfaceObstacle::SurfaceObstacle(LAMMPS *lmp, const Settings &settings) :
    Pointers(lmp), motion(lmp, settings.membranes, settings.level, settings.user),
    regions(lmp, motion, settings.user), tally{}, settings(settings), built_epoch(-1),
    everywhere(settings.control || settings.level > 0),
    speed(0.0), vertex_slack(0.0), point_slack(0.0), vertices(nullptr)
{
}

void SurfaceObstacle::init()
{
  motion.init();
}

void SurfaceObstacle::setup(const SRDSolvent &solvent)
{
  motion.setup();
  regions.assign(solvent);
  CollisionEvents::Settings rule;
  rule.no_slip = settings.no_slip;
  rule.contact = CONTACT * motion.edge();
  if (settings.most_bounces > 0) rule.most_bounces = settings.most_bounces;
  if (settings.control) {
    inverse_mask = std::make_unique<Membrane_NS::InverseMask>(motion.mesh().topology());
    rule.control = inverse_mask.get();
  }
  if (motion.corners()) {
    rule.corners = motion.corners();
    rule.inverse_masses = &motion.all_inverse_masses();
  }
  events = CollisionEvents(rule);
  grid = {};
  approaching = ApproachList(MARGIN * motion.surface_edge(),
                             SKIN * motion.surface_edge() + MOST_SLACK * motion.edge());
  vertex_slack = point_slack = FIRST_SLACK * motion.edge();
}

/* ----------------------------------------------------------------------
   the exact motion of solvent and point masses over dt, see CollisionEvents
------------------------------------------------------------------------- */

void SurfaceObstacle::stream(const SRDSolvent &solvent, SRDStreaming &streaming, double dt,
                             double horizon)
{
  const Flight flight = {solvent, streaming, dt, horizon};
  vertices = &motion.paths();
  if (!grid.serves(*vertices, motion.lattice_now()) ||
      (comm->nprocs > 1 && built_epoch != motion.epoch()))
    build_grid(flight);
  int beyond = !gather(flight), any;
  MPI_Allreduce(&beyond, &any, 1, MPI_INT, MPI_MAX, world);
  if (any) {
    build_grid(flight);
    if (!gather(flight)) report_escape();
  }
  from_outside.clear();
  told.clear();
  run(flight);
  if (comm->nprocs > 1)
    while (exchange()) run(flight);
  move(flight);
  finish(flight);
  vertex_slack = std::max(LESS_SLACK * vertex_slack, FIRST_SLACK * motion.edge());
  point_slack = std::max(LESS_SLACK * point_slack, FIRST_SLACK * motion.edge());
}

void SurfaceObstacle::report_escape()
{
  error->one(FLERR,
             "{}: solvent moves further than {:.6g} in one step, or has left the box: use a shorter "
             "timestep",
             settings.user, settings.stray);
}

/* ---------------------------------------------------------------------- */

// where this rank's solvent is, and may come to be before the grid is built anew

void SurfaceObstacle::build_grid(const Flight &flight)
{
  const SRDSolvent &solvent = flight.solvent;
  Vector3d lo = Vector3d::Map(domain->sublo), hi = Vector3d::Map(domain->subhi);
  if (domain->triclinic) domain->bbox(domain->sublo_lamda, domain->subhi_lamda, lo.data(), hi.data());
  double square = 0.0;
  for (int i = solvent.first(); i < solvent.last(); ++i) {
    if (!solvent.has(i)) continue;
    const Vector3d x = Vector3d::Map(atom->x[i]), v = Vector3d::Map(atom->v[i]);
    const Vector3d room = Vector3d::Constant(flight.dt * v.norm());
    lo = lo.cwiseMin(x - room);
    hi = hi.cwiseMax(x + room);
    square += v.squaredNorm();
  }
  const double edge = motion.surface_edge();
  SurfaceGrid::Settings s;
  s.skin = SKIN * edge;
  speed = std::sqrt(square / std::max(1, solvent.count()));
  s.reach = REACH * edge + FAST * flight.dt * speed;
  s.spacing = settings.spacing > 0.0 ? settings.spacing : SPACING * edge;
  s.most_cubes = std::min(1 << 24, 4096 + 8 * solvent.count());
  const Vector3d margin = Vector3d::Constant(settings.stray + edge);
  const auto images = grid.images();
  const bool same_box = grid.lattice() == motion.lattice_now();
  grid.build(motion.surface(), *vertices, motion.lattice_now(), motion.periodic(), lo - margin,
             hi + margin, s);
  built_epoch = motion.epoch();
  // the list knows triangles by their numbers, and not of images that move with the box
  if (!same_box || grid.images() != images) approaching.clear();
  if (comm->nprocs > 1 && !everywhere) find_shared();
}

/* ----------------------------------------------------------------------
   what happens to a vertex concerns other ranks unless only its owner's solvent comes near it
------------------------------------------------------------------------- */

void SurfaceObstacle::find_shared()
{
  const size_t n = vertices->size();
  std::vector<int> users(n, 0), sum(n);
  for (const auto &image : grid.images())
    for (int v : motion.surface().faces[image.face]) users[v] = motion.owner(v) == comm->me ? 1 : 2;
  MPI_Allreduce(users.data(), sum.data(), n, MPI_INT, MPI_SUM, world);
  shared.resize(n);
  for (size_t v = 0; v < n; ++v) shared[v] = sum[v] > 1;
}

/* ----------------------------------------------------------------------
   solvent that may meet triangles in this step is noted, with these; false if some is beyond the grid
------------------------------------------------------------------------- */

bool SurfaceObstacle::gather(const Flight &flight)
{
  const SRDSolvent &solvent = flight.solvent;
  const BoxWalls &walls = flight.streaming.walls;
  const bool have_walls = walls.any();
  near.clear();
  apart.assign(have_walls ? atom->nlocal : 0, 0);
  grid.begin(*vertices, flight.dt, vertex_slack, motion.lattice_rate());
  events.begin(*vertices, grid.triangles(), flight.dt, vertex_slack, walls, motion.middle());
  if (solvent.count() == 0) return true;
  if (!approaching.serves(grid, *vertices, flight.dt)) list_approaching(flight);

  bool all_found = true;
  const double *masses = solvent.mass();
  auto fetch = [&](int i) {    // from all over the memory, all at once
    for (int k : {0, 2}) {
      __builtin_prefetch(atom->x[0] + 3 * (size_t) i + k);
      __builtin_prefetch(atom->v[0] + 3 * (size_t) i + k);
    }
    __builtin_prefetch(masses + i);
    __builtin_prefetch(atom->tag + i);
    __builtin_prefetch(atom->image + i);
    __builtin_prefetch(regions.region + i);
  };
  auto take = [&](int i, const std::vector<int> *triangles) {
    if (triangles)
      note(i, *triangles, flight);
    else
      all_found = find_and_note(i, flight) && all_found;
  };
  approaching.for_each_meeting(grid, flight.dt, point_slack, fetch, take);
  if (!have_walls) return all_found;

  // who meets a wall may then fly anywhere

  for (int i = solvent.first(); i < solvent.last(); ++i) {
    if (!solvent.has(i) || apart[i]) continue;
    int face;
    walls.first_hit(atom->x[i], atom->v[i], flight.dt, face);
    if (face >= 0) all_found = find_and_note(i, flight) && all_found;
  }
  return all_found;
}

void SurfaceObstacle::list_approaching(const Flight &flight)
{
  const SRDSolvent &solvent = flight.solvent;
  const double far = LONGEST * motion.surface_edge() / std::max(speed, 1.0e-300);
  approaching.begin(grid, *vertices, atom->nlocal, std::max(flight.dt, std::min(flight.horizon, far)),
                    std::max(flight.dt, update->dt), 2.0 * point_slack);
  std::function<bool(int)> has;
  if (!solvent.dense()) has = [&](int i) { return solvent.has(i); };
  approaching.offer(grid, solvent.first(), solvent.last(), atom->x[0], atom->v[0], has);
  approaching.end(grid);
}

// false if it is beyond the grid

bool SurfaceObstacle::find_and_note(int i, const Flight &flight)
{
  const Vector3d x = Vector3d::Map(atom->x[i]), v = Vector3d::Map(atom->v[i]);
  if (!grid.find(x, flight.dt * v.norm() + point_slack, found)) return false;
  note(i, found, flight);
  return true;
}

void SurfaceObstacle::note(int i, const std::vector<int> &triangles, const Flight &flight)
{
  if (triangles.empty()) return;
  const MovingPoint path = {Vector3d::Map(atom->x[i]), Vector3d::Map(atom->v[i])};
  near.push_back({i, path, false});
  if (!apart.empty()) apart[i] = 1;
  const double mass = flight.solvent.mass()[i];
  events.add_point(path, 1.0 / mass, atom->tag[i], flight.dt * path.velocity.norm() + point_slack);
  if (forces_on_solvent)
    events.accelerate_point(force->ftm2v / mass * Vector3d::Map(atom->f[i]));
  const Vector3d way = flight.dt * path.velocity;
  for (int t : triangles) {
    const auto &image = grid.images()[t];
    events.add_pair(t,
                    regions.side(regions.region[i], atom->image[i], motion.component(image.face),
                                 image.lattice),
                    grid.needs(t, path.origin.data(), way.data()));
  }
}

double SurfaceObstacle::most_slack() const
{
  return MOST_SLACK * motion.edge();
}

/* ----------------------------------------------------------------------
   this rank's collisions, for impulses from others as far as they are known
------------------------------------------------------------------------- */

void SurfaceObstacle::run(const Flight &flight)
{
  while (true) {
    const auto outcome = events.run(from_outside);
    if (outcome == CollisionEvents::Outcome::DONE) return;
    if (outcome == CollisionEvents::Outcome::POINT_STRAYED)
      point_slack *= MORE_SLACK;
    else if (vertex_slack < most_slack())
      vertex_slack = std::min(MORE_SLACK * vertex_slack, most_slack());
    else
      error->one(FLERR,
                 "{}: solvent deflects the surface by more than {} of an edge in one step: use a "
                 "shorter timestep or heavier control points",
                 settings.user, MOST_SLACK);
    if (!gather(flight)) report_escape();
  }
}

/* ----------------------------------------------------------------------
   Each rank works out its atoms' collisions for given impulses of others. Those that come first in
   time are right at once, and what they cause is right after one exchange more, so impulses are
   told to all until none changes: two or three times, since few cross from rank to rank in a step.
------------------------------------------------------------------------- */

bool SurfaceObstacle::exchange()
{
  std::vector<SurfaceImpulse> mine;
  if (everywhere) mine = events.impulses();
  else
    for (const SurfaceImpulse &impulse : events.impulses())
      for (int v : impulse.vertex)
        if (shared[v] && motion.is_free(v)) {
          mine.push_back(impulse);
          break;
        }

  const int nprocs = comm->nprocs;
  int bytes = static_cast<int>(mine.size() * sizeof(SurfaceImpulse));
  std::vector<int> counts(nprocs), starts(nprocs + 1, 0);
  MPI_Allgather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (int p = 0; p < nprocs; ++p) starts[p + 1] = starts[p] + counts[p];
  std::vector<SurfaceImpulse> all(starts.back() / sizeof(SurfaceImpulse));
  if (!all.empty())
    MPI_Allgatherv(mine.data(), bytes, MPI_BYTE, all.data(), counts.data(), starts.data(), MPI_BYTE,
                   world);
  if (all == told) return false;

  const auto first = all.begin() + starts[comm->me] / sizeof(SurfaceImpulse);
  from_outside.assign(all.begin(), first);
  from_outside.insert(from_outside.end(), first + mine.size(), all.end());
  told = std::move(all);
  return true;
}

/* ----------------------------------------------------------------------
   all solvent to the end of its way; who has turned on it is looked at anew
------------------------------------------------------------------------- */

void SurfaceObstacle::move(const Flight &flight)
{
  const bool have_walls = flight.streaming.walls.any();
  for (size_t n = 0; n < near.size(); ++n) {
    const MovingPoint &path = events.path(n);
    near[n].turned =
        path.velocity != near[n].path.velocity || path.origin != near[n].path.origin;
    if (have_walls) apart[near[n].atom] = near[n].turned;
  }
  turned_by_walls.clear();
  flight.streaming.stream(flight.solvent, flight.dt, &apart, &turned_by_walls);
  approaching.pass(flight.dt);
  for (size_t n = 0; n < near.size(); ++n) {
    if (!near[n].turned) continue;
    const int i = near[n].atom;
    Vector3d::Map(atom->x[i]) = events.path(n).at(flight.dt);
    Vector3d::Map(atom->v[i]) = events.path(n).velocity;
  }
  if (approaching.left() == 0.0) return;
  auto look_anew = [&](int i) {
    approaching.add(grid, i, Vector3d::Map(atom->x[i]), Vector3d::Map(atom->v[i]));
  };
  for (const Near &n : near)
    if (n.turned) look_anew(n.atom);
  for (int i : turned_by_walls) look_anew(i);
}

/* ---------------------------------------------------------------------- */

void SurfaceObstacle::finish(const Flight &flight)
{
  Vector3d::Map(flight.streaming.walls.impulse) += events.wall_impulse();
  tally[COLLISIONS] += events.impulses().size();
  tally[ABANDONED] += events.abandoned();
  tally[OUTER] += events.normal_impulse()[0];
  tally[INNER] += events.normal_impulse()[1];
  for (int k = 0; k < 3; ++k) tally[HANDED + k] += events.impulse()[k];

  motion.pass(flight.dt);
  int mine = !events.touched().empty(), any;
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, world);
  if (any) motion.apply(events.changes());
}

/* ----------------------------------------------------------------------
   solvent that bounces back at a surface still slips where cells are cut by it, unless the surface
   itself has mass in these cells. What is held is a wall: it has the temperature of the solvent
------------------------------------------------------------------------- */

void SurfaceObstacle::join_cells(SRDCells &cells, bigint step, double kT)
{
  VertexField position;
  motion.masses_now(position, joined);
  MeshPart &part = motion.part();
  const Membrane_NS::CounterRandom random(settings.seed ^ SIDE_SEED, step);
  cells.others.clear();
  for (int i = 0; i < part.owned; ++i) {
    const tagint tag = atom->tag[part.atom_of(i)];
    if (!motion.is_free(part.vertices[i])) {
      double v[3];
      Membrane_NS::thermal_velocity(settings.seed ^ HELD_SEED, step, tag, kT, motion.mass_of(part.vertices[i]), v);
      for (int k = 0; k < 3; ++k) joined[i].c[k] += v[k];
    }
    cells.others.add(position[i].c, joined[i].c, motion.mass_of(part.vertices[i]), tag,
                     random.uniforms(tag, 0)[0] < 0.5);
  }
}

void SurfaceObstacle::leave_cells(SRDCells &cells)
{
  MeshPart &part = motion.part();
  VertexField change(part.owned);
  for (int i = 0; i < part.owned; ++i)
    for (int k = 0; k < 3; ++k) {
      change[i].c[k] = cells.others.velocity[3 * i + k] - joined[i].c[k];
      tally[HANDED + k] += motion.mass_of(part.vertices[i]) * change[i].c[k];
    }
  motion.apply(change);
  cells.others.clear();
}

/* ----------------------------------------------------------------------
   solvent on the wrong side
------------------------------------------------------------------------- */

bigint SurfaceObstacle::check(const SRDSolvent &solvent)
{
  bigint count[2] = {0, 0}, all[2];
  for (const auto &crossing : regions.find_crossings(solvent)) {
    Vector3d normal;
    const Vector3d nearest = nearest_point(crossing, normal);
    const Vector3d x = Vector3d::Map(atom->x[crossing.atom]);
    if ((x - nearest).norm() <= 4.0 * CONTACT * motion.edge()) continue;    // on it, by rounding
    ++count[0];
    count[1] += rescue(crossing, nearest, normal);
  }
  MPI_Allreduce(count, all, 2, MPI_LMP_BIGINT, MPI_SUM, world);
  tally[CROSSINGS] += count[0];
  tally[RESCUES] += count[1];
  return all[0];
}

// the point of a surface nearest to an atom, in the image nearest to it, and the normal there

Vector3d SurfaceObstacle::nearest_point(const SurfaceRegions::Crossing &crossing, Vector3d &normal)
{
  const auto &surface = motion.surface();
  const auto &places = motion.current();
  const Eigen::Matrix3d box = motion.lattice(), to_fraction = box.inverse();
  const Vector3d x = Vector3d::Map(atom->x[crossing.atom]);
  Vector3d nearest = x;
  double least = INFINITY;
  for (size_t f = 0; f < surface.faces.size(); ++f) {
    if (motion.component(f) != crossing.component) continue;
    std::array<Vector3d, 3> corner;
    for (int k = 0; k < 3; ++k) {
      const auto &seam = surface.seams[f][k];
      corner[k] = places[surface.faces[f][k]].path.origin + box * Vector3d(seam[0], seam[1], seam[2]);
    }
    Vector3d images = to_fraction * (x - corner[0]);
    for (int k = 0; k < 3; ++k) images[k] = domain->periodicity[k] ? std::round(images[k]) : 0.0;
    for (Vector3d &c : corner) c += box * images;
    const auto b = Membrane_NS::nearest_on_triangle(x, corner[0], corner[1], corner[2]);
    const Vector3d p = b[0] * corner[0] + b[1] * corner[1] + b[2] * corner[2];
    if ((p - x).squaredNorm() >= least) continue;
    least = (p - x).squaredNorm();
    nearest = p;
    normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
  }
  return nearest;
}

/* ----------------------------------------------------------------------
   put an atom back on its own side, close to where it crossed, heading away from the surface; or if
   that cannot be, anywhere in its region
------------------------------------------------------------------------- */

bool SurfaceObstacle::rescue(const SurfaceRegions::Crossing &crossing, const Vector3d &nearest,
                             const Vector3d &normal)
{
  const int i = crossing.atom, region = regions.region[i];
  Vector3d x;
  for (double distance = 1.0e-6; distance < 0.5; distance *= 10.0)
    for (double sign : {1.0, -1.0}) {
      x = nearest + sign * distance * motion.edge() * normal;
      if (!regions.belongs(x.data(), atom->image[i], region)) continue;
      Vector3d::Map(atom->x[i]) = x;
      forget();
      const double speed = sign * Vector3d::Map(atom->v[i]).dot(normal);
      if (speed < 0.0) Vector3d::Map(atom->v[i]) -= 2.0 * sign * speed * normal;
      return true;
    }

  constexpr int TRIALS = 1000;
  const Membrane_NS::CounterRandom random(atom->tag[i], update->ntimestep);
  for (int trial = 0; trial < TRIALS; ++trial) {
    const auto a = random.uniforms(trial, 0), b = random.uniforms(trial, 1);
    const double s[3] = {a[0], a[1], b[0]};
    if (domain->triclinic) {
      double lamda[3];
      for (int k = 0; k < 3; ++k)
        lamda[k] = domain->sublo_lamda[k] + s[k] * (domain->subhi_lamda[k] - domain->sublo_lamda[k]);
      domain->lamda2x(lamda, x.data());
    } else
      for (int k = 0; k < 3; ++k)
        x[k] = domain->sublo[k] + s[k] * (domain->subhi[k] - domain->sublo[k]);
    if (!regions.belongs(x.data(), atom->image[i], region)) continue;
    Vector3d::Map(atom->x[i]) = x;
    forget();
    return true;
  }
  return false;
}

double SurfaceObstacle::memory_usage() const
{
  return motion.memory_usage() + regions.memory_usage() + grid.memory_usage() +
      approaching.memory_usage() +
      (inverse_mask ? inverse_mask->memory_usage() : 0.0);
}
