/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

#ifndef LMP_SRD_OBSTACLE_H
#define LMP_SRD_OBSTACLE_H

#include "membrane_srd_events.h"
#include "membrane_srd_inverse_mask.h"
#include "srd_impulse_exchange.h"
#include "srd_meetings.h"
#include "srd_regions.h"
#include "srd_rescue.h"
#include "srd_surface_in_cells.h"
#include "srd_surface_motion.h"

#include <memory>
#include <string>

namespace LAMMPS_NS {

/** Membranes in the way of solvent: streams solvent past the moving limit surface, with which it
    exchanges impulses, and keeps it on its own side.

    The surface is made of the triangles between the limit positions of the vertices, which are the
    point masses of `mass vertex`, or of finer triangles. */
class SurfaceObstacle : protected Pointers {
 public:
  struct Settings {
    int membranes = 0;    ///< their group
    int level = 0;        ///< of the surface, see SRDSurface
    uint64_t seed = 0;    ///< of all random numbers
    bool no_slip = false;
    bool control = false;    ///< impulses act on control points
    int most_bounces = 0;    ///< of an atom in one step; 0 for very many
    double spacing = 0.0;    ///< of the grid that finds triangles; 0 to choose it
    double stray = 0.0;      ///< how far solvent may be from its owner's sub-domain
    std::string user;        ///< named in errors
  };
  SurfaceObstacle(class LAMMPS *, const Settings &);

  SurfaceMotion motion;
  SurfaceRegions regions;
  SurfaceMeetings meetings;

  // === Life cycle; all collective

  void init();
  /// From setup(): finds the region of each solvent atom.
  void setup(const class SRDSolvent &);
  /// From post_integrate(), after control points have moved for the time dt.
  void begin_step(double dt)
  {
    regions.forget_places();
    motion.begin_step(dt);
  }
  /// Solvent moves, for the step or the next part of it.
  void stream(const SRDFlight &);
  /// Around a collision in cells between two parts of a step, if the surface does not slip: the
  /// point masses take part in it; what is held, with thermal velocities of kT.
  void join_cells(class SRDCells &cells, bigint step, double kT) { in_cells.join(cells, step, kT); }
  void leave_cells(SRDCells &cells) { in_cells.leave(cells, tally + HANDED); }
  /// From final_integrate().
  void remember() { motion.remember(); }
  /// Collective: how many solvent atoms are on the wrong side.
  bigint count_strays(const SRDSolvent &) const;
  /// Counts them, and puts them back on their own. Returns how many there were.
  bigint put_back(const SRDSolvent &, bigint step);

  // === Per-atom data, as of a fix

  void grow(int nmax) { regions.grow(nmax); }
  void copy(int i, int j) { regions.region[j] = regions.region[i]; }

  // === What has happened so far

  enum {
    COLLISIONS,
    CROSSINGS,
    RESCUES,
    ABANDONED,
    HANDED,
    OUTER = HANDED + 3,
    INNER,
    NUM_TALLIES
  };
  /** Of this rank; sum over ranks. HANDED: momentum given to membranes, 3 numbers; OUTER, INNER:
      impulse normal to the surface, of solvent in front of it and behind it. */
  double tally[NUM_TALLIES];

  double memory_usage() const;

 private:
  Settings settings;
  Membrane_NS::CollisionEvents::Settings rule;
  Membrane_NS::CollisionEvents events;
  std::unique_ptr<Membrane_NS::InverseMask> inverse_mask;
  ImpulseExchange impulses;
  SurfaceInCells in_cells;
  SurfaceRescue rescue;

  void build_grid(const SRDFlight &);
  void run(const SRDFlight &);
  void finish(const SRDFlight &);
  double contact() const;
  [[noreturn]] void report_escape();
};

}    // namespace LAMMPS_NS

#endif
