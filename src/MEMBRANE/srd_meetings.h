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

#ifndef LMP_SRD_MEETINGS_H
#define LMP_SRD_MEETINGS_H

#include "membrane_srd_approach_list.h"
#include "membrane_srd_events.h"
#include "membrane_srd_surface_grid.h"
#include "mesh_local.h"
#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/// Solvent that moves for the time dt, the step or a part of it. horizon: from now on its
/// velocities last so long, but for what it meets and kicks.
struct SRDFlight {
  const class SRDSolvent &solvent;
  class SRDStreaming &streaming;
  double dt, horizon;
};

/** Finds the solvent that may meet the surface, with a grid of its triangles and a list of the
    solvent that comes near, and takes it to where collisions leave it. */
class SurfaceMeetings : protected Pointers {
 public:
  struct Settings {
    double spacing = 0.0;    ///< of the grid; 0 to choose it
    double stray = 0.0;      ///< how far solvent may be from its owner's sub-domain
    std::string user;        ///< named in errors
  };
  SurfaceMeetings(class LAMMPS *, class SurfaceMotion &, const class SurfaceRegions &,
                  const Settings &);
  bool forces_on_solvent = false;    ///< and atom->f has them

  // === Life cycle

  /// Collective; from init().
  void init() { mesh.init(); }
  /// From setup(), when the motion has been set up.
  void setup();
  /// Call when solvent has other velocities, or places, or numbers: then its way is looked at anew.
  void solvent_changed() { approaching.clear(); }
  /// Forces have changed velocities by up to this.
  void velocities_changed_by(double most) { approaching.bend(most); }

  // === A step, or a part of it

  /// Whether the grid knows what this rank's solvent may meet; not when vertices have moved far or
  /// LAMMPS has reneighboured.
  bool has_grid();
  /// Collective: makes what this rank has of the surface, see SurfaceMotion, and the grid anew.
  /// Returns whether the former has changed.
  bool build_grid(const SRDFlight &);
  /// Begins the events and gives them all that may happen; false if solvent may come beyond the
  /// grid.
  bool gather(const SRDFlight &, Membrane_NS::CollisionEvents &);
  /// All solvent to the end of its way, of which the events know those that meet the surface.
  void move(const SRDFlight &, const Membrane_NS::CollisionEvents &);

  // === How far points and vertices may be found from where they are expected

  void allow_more_for_points();
  /// Stops if that is too much.
  void allow_more_for_vertices();
  /// After a step: what it took may be too much for the next.
  void allow_less();

  double memory_usage() const { return grid.memory_usage() + approaching.memory_usage(); }

 private:
  SurfaceMotion &motion;
  const SurfaceRegions &regions;
  Settings settings;
  LocalMesh mesh;    // the grid was built for the neighbours that it has seen
  Membrane_NS::SurfaceGrid grid;
  Membrane_NS::ApproachList approaching;    // of local atoms
  struct Near {    // an atom that may meet triangles in this step, and does if turned
    int atom;
    Membrane_NS::MovingPoint path;
    bool turned;
  };
  std::vector<Near> near;
  std::vector<char> apart;    // with walls, by local atom: it is near; then: it turned there
  std::vector<int> found, turned_by_walls;
  double speed;    // of this rank's solvent, root mean square, when the grid was built
  double vertex_slack, point_slack;

  void cut_space(const SRDFlight &);
  void list_approaching(const SRDFlight &);
  bool find_and_note(int atom, const SRDFlight &, Membrane_NS::CollisionEvents &);
  void note(int atom, const std::vector<int> &triangles, const SRDFlight &,
            Membrane_NS::CollisionEvents &);
};

}    // namespace LAMMPS_NS

#endif
