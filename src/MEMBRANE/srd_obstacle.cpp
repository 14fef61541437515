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

#include "error.h"
#include "srd_streaming.h"

using namespace LAMMPS_NS;
using Eigen::Vector3d;
using Membrane_NS::CollisionEvents;

// in edges of the mesh; see TriangleCollision: far above rounding, also of coordinates in a large
// box
static constexpr double CONTACT = 1.0e-10;

/* ---------------------------------------------------------------------- */

static SurfaceMeetings::Settings meeting_settings(const SurfaceObstacle::Settings &settings)
{
  return {settings.spacing, settings.stray, settings.user};
}

SurfaceObstacle::SurfaceObstacle(LAMMPS *lmp, const Settings &settings) :
    Pointers(lmp), motion(lmp, settings.membranes, settings.level, settings.control, settings.user),
    regions(lmp, motion, settings.user),
    meetings(lmp, motion, regions, meeting_settings(settings)), tally{}, settings(settings),
    impulses(lmp, motion, settings.user),
    in_cells(lmp, motion, settings.seed), rescue(lmp, motion, regions)
{
}

void SurfaceObstacle::init()
{
  motion.init();
  meetings.init();
}

void SurfaceObstacle::setup(const SRDSolvent &solvent)
{
  motion.setup();
  regions.assign(solvent);
  rule = {};
  rule.no_slip = settings.no_slip;
  rule.contact = CONTACT * motion.surface().mesh_edge();
  if (settings.most_bounces > 0) rule.most_bounces = settings.most_bounces;
  if (settings.control) {
    inverse_mask = std::make_unique<Membrane_NS::InverseMask>(motion.mesh().topology());
    rule.control = inverse_mask.get();
  }
  meetings.setup();
}

/* ----------------------------------------------------------------------
   solvent and point masses move exactly for dt, see CollisionEvents
------------------------------------------------------------------------- */

static bool anywhere(bool here, MPI_Comm world)
{
  int mine = here, any;
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, world);
  return any != 0;
}

void SurfaceObstacle::stream(const SRDFlight &flight)
{
  const bool known = motion.find_paths(), grid = meetings.has_grid();
  if (anywhere(!known || !grid, world)) build_grid(flight);
  if (anywhere(!meetings.gather(flight, events), world)) {
    build_grid(flight);
    if (!meetings.gather(flight, events)) report_escape();
  }
  impulses.begin();
  do run(flight);
  while (impulses.exchange(events.impulses()));
  meetings.move(flight, events);
  finish(flight);
  meetings.allow_less();
}

// numbers of vertices are then others

void SurfaceObstacle::build_grid(const SRDFlight &flight)
{
  if (!meetings.build_grid(flight)) return;
  if (inverse_mask) inverse_mask->renumber(motion.here().masses());
  if (motion.here().corners()) {
    rule.corners = motion.here().corners();
    rule.inverse_masses = &motion.inverse_masses();
  }
  events = CollisionEvents(rule);
  impulses.find_partners();
}

void SurfaceObstacle::report_escape()
{
  error->one(
      FLERR,
      "{}: solvent moves further than {:.6g} in one step, or has left the box: use a shorter "
      "timestep",
      settings.user, settings.stray);
}

/* ----------------------------------------------------------------------
   this rank's collisions, for impulses from others as far as they are known
------------------------------------------------------------------------- */

void SurfaceObstacle::run(const SRDFlight &flight)
{
  while (true) {
    const auto outcome = events.run(impulses.from_others());
    if (outcome == CollisionEvents::Outcome::DONE) return;
    if (outcome == CollisionEvents::Outcome::POINT_STRAYED)
      meetings.allow_more_for_points();
    else
      meetings.allow_more_for_vertices();
    if (!meetings.gather(flight, events)) report_escape();
  }
}

void SurfaceObstacle::finish(const SRDFlight &flight)
{
  Vector3d::Map(flight.streaming.walls.impulse) += events.wall_impulse();
  tally[COLLISIONS] += events.impulses().size();
  tally[ABANDONED] += events.abandoned();
  tally[OUTER] += events.normal_impulse()[0];
  tally[INNER] += events.normal_impulse()[1];
  for (int k = 0; k < 3; ++k) tally[HANDED + k] += events.impulse()[k];

  motion.pass(flight.dt);
  if (anywhere(!events.touched().empty(), world)) motion.apply(events.changes());
}

/* ---------------------------------------------------------------------- */

bigint SurfaceObstacle::count_strays(const SRDSolvent &solvent) const
{
  bigint mine = rescue.count(solvent, contact()), all;
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  return all;
}

bigint SurfaceObstacle::put_back(const SRDSolvent &solvent, bigint step)
{
  auto here = rescue.put_back(solvent, contact(), step);
  if (here.rescued > 0) meetings.solvent_changed();
  tally[CROSSINGS] += here.crossed;
  tally[RESCUES] += here.rescued;
  bigint crossed;
  MPI_Allreduce(&here.crossed, &crossed, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  return crossed;
}

// what is closer to the surface is on it, by rounding

double SurfaceObstacle::contact() const
{
  return 4.0 * CONTACT * motion.surface().mesh_edge();
}

double SurfaceObstacle::memory_usage() const
{
  return motion.memory_usage() + regions.memory_usage() + meetings.memory_usage() +
      (inverse_mask ? inverse_mask->memory_usage() : 0.0);
}
