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

#include "membrane_srd_approach_list.h"
#include "membrane_srd_events.h"
#include "membrane_srd_surface_grid.h"
#include "membrane_srd_inverse_mask.h"
#include "srd_cells.h"
#include "srd_solvent.h"
#include "srd_streaming.h"
#include "srd_surface_motion.h"
#include "srd_regions.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/** Membranes in the way of solvent: streams solvent past the moving limit surface, with which it
    exchanges impulses, and keeps it on its own side.

    The surface is made of the triangles between the limit positions of the vertices, which are the
    point masses of `mass vertex`, or of finer triangles. */
class SurfaceObstacle : protected Pointers {
 public:
  struct Settings {
    int membranes = 0;          ///< their group
    int level = 0;              ///< of the surface, see SurfaceMotion
    uint64_t seed = 0;          ///< of all random numbers
    bool no_slip = false;
    bool control = false;       ///< impulses act on control points
    int most_bounces = 0;       ///< of an atom in one step; 0 for very many
    double spacing = 0.0;       ///< of the grid that finds triangles; 0 to choose it
    double stray = 0.0;         ///< how far solvent may be from its owner's sub-domain
    std::string user;           ///< named in errors
  };
  SurfaceObstacle(class LAMMPS *, const Settings &);

  SurfaceMotion motion;
  SurfaceRegions regions;
  bool forces_on_solvent = false;    ///< and atom->f has them

  // === Life cycle; all collective

  void init();
  /// From setup(): finds the region of each solvent atom.
  void setup(const SRDSolvent &);
  /// From post_integrate(), after control points have moved for the time dt.
  void begin_step(double dt) { motion.begin_step(dt); }
  /// Solvent moves for the time dt, the step or the next part of it. horizon: from now on its velocities
  /// last so long, but for what it meets and kicks.
  void stream(const SRDSolvent &, SRDStreaming &, double dt, double horizon);
  /// Call when solvent has other velocities, or places, or numbers: then its way is looked at anew.
  void forget() { approaching.clear(); }
  /// Forces have changed velocities by up to this.
  void kicked(double change) { approaching.bend(change); }
  /** Around a collision in cells between two parts of a step, if the surface does not slip: the point
      masses take part in it, each with the solvent on one of its sides, drawn anew for each step; what
      is held, with thermal velocities of kT. */
  void join_cells(SRDCells &cells, bigint step, double kT);
  void leave_cells(SRDCells &cells);
  /// From final_integrate().
  void remember() { motion.remember(); }
  /// Counts solvent on the wrong side, and puts it back on its own. Returns how many there were.
  bigint check(const SRDSolvent &);

  // === Per-atom data, as of a fix

  void grow(int nmax) { regions.grow(nmax); }
  void copy(int i, int j) { regions.region[j] = regions.region[i]; }

  // === What has happened so far

  enum { COLLISIONS, CROSSINGS, RESCUES, ABANDONED, HANDED, OUTER = HANDED + 3, INNER, NUM_TALLIES };
  /** Of this rank; sum over ranks. HANDED: momentum given to membranes, 3 numbers; OUTER, INNER:
      impulse normal to the surface, of solvent in front of it and behind it. */
  double tally[NUM_TALLIES];

  double memory_usage() const;

 private:
  Settings settings;
  Membrane_NS::CollisionEvents events;
  Membrane_NS::SurfaceGrid grid;
  std::unique_ptr<Membrane_NS::InverseMask> inverse_mask;
  bigint built_epoch;
  bool everywhere;             // impulses act far from where they are, too
  std::vector<char> shared;    // if not: vertices that atoms of several ranks may touch
  Membrane_NS::ApproachList approaching;    // of local atoms
  struct Near {                // an atom that may meet triangles in this step, and does if turned
    int atom;
    Membrane_NS::MovingPoint path;
    bool turned;
  };
  std::vector<Near> near;
  std::vector<char> apart;     // with walls, by local atom: it is near; then: it turned there
  std::vector<int> found, turned_by_walls;
  double speed;                // of this rank's solvent, root mean square, when the grid was built
  double vertex_slack, point_slack;

  const std::vector<Membrane_NS::SurfaceVertex> *vertices;
  Membrane_NS::VertexField joined;    // velocities of owned point masses as they joined
  std::vector<Membrane_NS::SurfaceImpulse> told, from_outside;    // by all ranks; by others

  struct Flight {              // what stream() does
    const SRDSolvent &solvent;
    SRDStreaming &streaming;
    double dt, horizon;
  };
  void build_grid(const Flight &);
  void find_shared();
  bool gather(const Flight &);
  void list_approaching(const Flight &);
  bool find_and_note(int atom, const Flight &);
  void note(int atom, const std::vector<int> &triangles, const Flight &);
  void run(const Flight &);
  double most_slack() const;
  bool exchange();
  void move(const Flight &);
  void finish(const Flight &);
  [[noreturn]] void report_escape();
  Eigen::Vector3d nearest_point(const SurfaceRegions::Crossing &, Eigen::Vector3d &normal);
  bool rescue(const SurfaceRegions::Crossing &, const Eigen::Vector3d &nearest,
              const Eigen::Vector3d &normal);
};

}    // namespace LAMMPS_NS

#endif
