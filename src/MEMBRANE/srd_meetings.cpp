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

#include "srd_meetings.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "mesh_box.h"
#include "srd_regions.h"
#include "srd_solvent.h"
#include "srd_streaming.h"
#include "srd_surface_motion.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using Eigen::Vector3d;
using Membrane_NS::ApproachList;
using Membrane_NS::BoxWalls;
using Membrane_NS::CollisionEvents;
using Membrane_NS::MovingPoint;
using Membrane_NS::SurfaceGrid;

// what flies further in a step, in sub-domains, is no solvent any more
static constexpr double MOST_BOXES = 1000.0;

// all of these in edges of the mesh; those of the grid, of the surface

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
// and for it solvent moves so far, in root mean squares: further, and there would be many to look
// at
static constexpr double LONGEST = 0.5;

// solvent faster than this, in root mean squares, needs more than one look
static constexpr double FAST = 2.5;

// Rows of LAMMPS' arrays of vectors are one block. So a row is found without its pointer, which for an atom anywhere in
// memory would have to be fetched first

static Eigen::Map<Vector3d> row(double **array, int i)
{
  return Vector3d::Map(array[0] + 3 * (size_t) i);
}

/* ---------------------------------------------------------------------- */

SurfaceMeetings::SurfaceMeetings(LAMMPS *lmp, SurfaceMotion &motion,
                                 const SurfaceRegions &regions, const Settings &settings) :
    Pointers(lmp),
    motion(motion), regions(regions), settings(settings), mesh(lmp, settings.user), speed(0.0),
    vertex_slack(0.0), point_slack(0.0)
{
}

void SurfaceMeetings::setup()
{
  const SRDSurface &surface = motion.surface();
  grid = {};
  approaching = ApproachList(MARGIN * surface.edge(),
                             SKIN * surface.edge() + MOST_SLACK * surface.mesh_edge());
  vertex_slack = point_slack = FIRST_SLACK * surface.mesh_edge();
}

// === The grid

bool SurfaceMeetings::has_grid()
{
  const bool new_owners = mesh.follow() != MeshChange::NOTHING && comm->nprocs > 1;
  return grid.is_valid_for(motion.paths(), motion.lattice_now()) && !new_owners;
}

bool SurfaceMeetings::build_grid(const SRDFlight &flight)
{
  cut_space(flight);
  const auto images = grid.images();
  const bool same_box = grid.lattice() == motion.lattice_now();
  const bool other_part = motion.have_near(grid.region_lo(), grid.region_hi());
  grid.build(motion.here().faces(), motion.paths(), motion.lattice_now(),
             periodic_directions(*domain));
  // the list knows triangles by their numbers, and not of images that move with the box
  if (other_part || !same_box || grid.images() != images) approaching.clear();
  return other_part;
}

// where this rank's solvent is, and may come to be before the grid is built anew

void SurfaceMeetings::cut_space(const SRDFlight &flight)
{
  const SRDSolvent &solvent = flight.solvent;
  Vector3d lo = Vector3d::Map(domain->sublo), hi = Vector3d::Map(domain->subhi);
  if (domain->triclinic)
    domain->bbox(domain->sublo_lamda, domain->subhi_lamda, lo.data(), hi.data());
  double square = 0.0;
  for (int i = solvent.first(); i < solvent.last(); ++i) {
    if (!solvent.has(i)) continue;
    const Vector3d x = row(atom->x, i), v = row(atom->v, i);
    const double way = flight.dt * v.norm();
    if (!x.allFinite() || !(way < MOST_BOXES * (hi - lo).maxCoeff()))
      error->one(FLERR,
                 "{}: solvent atom {} flies off, with the velocity {:.4g}: use a shorter timestep or weaker "
                 "forces on it",
                 settings.user, atom->tag[i], v.norm());
    const Vector3d room = Vector3d::Constant(way);
    lo = lo.cwiseMin(x - room);
    hi = hi.cwiseMax(x + room);
    square += v.squaredNorm();
  }
  const double edge = motion.surface().edge();
  SurfaceGrid::Settings s;
  s.skin = SKIN * edge;
  speed = std::sqrt(square / std::max(1, solvent.count()));
  s.reach = REACH * edge + FAST * flight.dt * speed;
  s.spacing = settings.spacing > 0.0 ? settings.spacing : SPACING * edge;
  s.most_cubes = std::min(1 << 24, 4096 + 8 * solvent.count());
  const Vector3d margin = Vector3d::Constant(settings.stray + edge);
  grid.cut(lo - margin, hi + margin, s);
}

/* ----------------------------------------------------------------------
   solvent that may meet triangles in this step is noted, with these; false if some is beyond the
   grid
------------------------------------------------------------------------- */

bool SurfaceMeetings::gather(const SRDFlight &flight, CollisionEvents &events)
{
  const auto &vertices = motion.paths();
  const SRDSolvent &solvent = flight.solvent;
  const BoxWalls &walls = flight.streaming.walls;
  const bool have_walls = walls.any();
  near.clear();
  apart.assign(have_walls ? atom->nlocal : 0, 0);
  grid.begin(vertices, flight.dt, vertex_slack, motion.lattice_rate());
  events.begin(vertices, grid.triangles(), flight.dt, vertex_slack, walls, motion.middle());
  if (solvent.count() == 0) return true;
  if (!approaching.is_valid_for(grid, vertices, flight.dt)) list_approaching(flight);

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
      note(i, *triangles, flight, events);
    else
      all_found = find_and_note(i, flight, events) && all_found;
  };
  approaching.for_each_meeting(grid, flight.dt, point_slack, fetch, take);
  if (!have_walls) return all_found;

  // who meets a wall may then fly anywhere

  for (int i = solvent.first(); i < solvent.last(); ++i) {
    if (!solvent.has(i) || apart[i]) continue;
    int face;
    walls.first_hit(atom->x[i], atom->v[i], flight.dt, face);
    if (face >= 0) all_found = find_and_note(i, flight, events) && all_found;
  }
  return all_found;
}

void SurfaceMeetings::list_approaching(const SRDFlight &flight)
{
  const SRDSolvent &solvent = flight.solvent;
  const double far = LONGEST * motion.surface().edge() / std::max(speed, 1.0e-300);
  approaching.begin(grid, motion.paths(), atom->nlocal,
                    std::max(flight.dt, std::min(flight.horizon, far)),
                    std::max(flight.dt, update->dt), 2.0 * point_slack);
  std::function<bool(int)> has;
  if (!solvent.dense())
    has = [&](int i) {
      return solvent.has(i);
    };
  approaching.offer(grid, solvent.first(), solvent.last(), atom->x[0], atom->v[0], has);
  approaching.end(grid);
}

// false if it is beyond the grid

bool SurfaceMeetings::find_and_note(int i, const SRDFlight &flight, CollisionEvents &events)
{
  const Vector3d x = row(atom->x, i), v = row(atom->v, i);
  if (!grid.find(x, flight.dt * v.norm() + point_slack, found)) return false;
  note(i, found, flight, events);
  return true;
}

void SurfaceMeetings::note(int i, const std::vector<int> &triangles, const SRDFlight &flight,
                           CollisionEvents &events)
{
  if (triangles.empty()) return;
  const MovingPoint path = {row(atom->x, i), row(atom->v, i)};
  near.push_back({i, path, false});
  if (!apart.empty()) apart[i] = 1;
  const double mass = flight.solvent.mass()[i];
  events.add_point(path, 1.0 / mass, atom->tag[i], flight.dt * path.velocity.norm() + point_slack);
  if (forces_on_solvent) events.accelerate_point(force->ftm2v / mass * row(atom->f, i));
  const Vector3d way = flight.dt * path.velocity;
  for (int t : triangles) {
    const auto &image = grid.images()[t];
    events.add_pair(t,
                    regions.side(regions.region[i], atom->image[i], motion.here().component(image.face),
                                 image.lattice),
                    grid.needs(t, path.origin.data(), way.data()));
  }
}

// === Slack

void SurfaceMeetings::allow_more_for_points()
{
  point_slack *= MORE_SLACK;
}

void SurfaceMeetings::allow_more_for_vertices()
{
  const double most = MOST_SLACK * motion.surface().mesh_edge();
  if (!(vertex_slack < most))
    error->one(FLERR,
               "{}: solvent deflects the surface by more than {} of an edge in one step: use a "
               "shorter timestep or heavier control points",
               settings.user, MOST_SLACK);
  vertex_slack = std::min(MORE_SLACK * vertex_slack, most);
}

void SurfaceMeetings::allow_less()
{
  const double least = FIRST_SLACK * motion.surface().mesh_edge();
  vertex_slack = std::max(LESS_SLACK * vertex_slack, least);
  point_slack = std::max(LESS_SLACK * point_slack, least);
}

/* ----------------------------------------------------------------------
   all solvent to the end of its way; who has turned on it is looked at anew
------------------------------------------------------------------------- */

void SurfaceMeetings::move(const SRDFlight &flight, const CollisionEvents &events)
{
  const bool have_walls = flight.streaming.walls.any();
  for (size_t n = 0; n < near.size(); ++n) {
    const MovingPoint &path = events.path(n);
    near[n].turned = path.velocity != near[n].path.velocity || path.origin != near[n].path.origin;
    if (have_walls) apart[near[n].atom] = near[n].turned;
  }
  turned_by_walls.clear();
  flight.streaming.stream(flight.solvent, flight.dt, &apart, &turned_by_walls);
  approaching.pass(flight.dt);
  for (size_t n = 0; n < near.size(); ++n) {
    if (!near[n].turned) continue;
    const int i = near[n].atom;
    row(atom->x, i) = events.path(n).at(flight.dt);
    row(atom->v, i) = events.path(n).velocity;
  }
  if (approaching.left() == 0.0) return;
  auto look_anew = [&](int i) {
    approaching.add(grid, i, row(atom->x, i), row(atom->v, i));
  };
  for (const Near &n : near)
    if (n.turned) look_anew(n.atom);
  for (int i : turned_by_walls) look_anew(i);
}
