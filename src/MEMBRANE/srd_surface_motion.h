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

#ifndef LMP_SRD_SURFACE_MOTION_H
#define LMP_SRD_SURFACE_MOTION_H

#include "membrane_limit_mask.h"
#include "membrane_srd_surface.h"
#include "mesh_box.h"
#include "mesh_group.h"
#include "mesh_local.h"
#include "srd_surface.h"
#include "srd_surface_movers.h"
#include "srd_surface_part.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/** The limit positions of the control points of a group of membranes as moving point masses: where
    they, and the surface that they span, are and go in a step, and what impulses on them do to the
    control points.

    Each rank knows of the surface what comes near its solvent, see SRDSurfacePart. Positions are
    unwrapped and, component by component, in one piece, as DistributedMesh::unwrapped() has them. */
class SurfaceMotion : protected Pointers {
 public:
  /// `level` is that of SRDSurface; all_masses: each rank knows all masses; `user` is named in
  /// errors.
  SurfaceMotion(class LAMMPS *, int igroup, int level, bool all_masses, std::string user);

  // === Life cycle

  /// Collective; call from init(). Stops if membranes of the group are moved in a way that impulses
  /// cannot act on.
  void init();
  /// Collective; call from setup(), when the mesh is unwrapped.
  void setup();
  /// Collective; call when all positions of a step are final, before the next step moves them.
  void remember();

  // === What moves

  DistributedMesh &mesh() const { return *local_mesh; }
  const SRDSurface &surface() const { return shape; }
  /// The box vectors as columns, and the rate at which they change for images, which in a box whose
  /// deformation does not move atoms along have other velocities.
  Eigen::Matrix3d lattice() const { return box_vectors(*domain); }
  Eigen::Matrix3d lattice_rate() const { return movers.lattice_rate(); }

  // === A step

  /** Collective; call when control points have moved for a time dt. They have so in straight lines,
      on which this goes back to the start; pass() goes on from there. */
  void begin_step(double dt);
  void pass(double duration) { time_left -= duration; }
  /// The box vectors now, in the course of the step.
  Eigen::Matrix3d lattice_now() const { return lattice() + (step - time_left) * lattice_rate(); }
  /// When from now the middle of the step is.
  double middle() const { return time_left - 0.5 * step; }
  /** Collective: paths from now on of the vertices that this rank has, and accelerations. False if
      vertices have new owners, and have_near() is due: the same on all ranks. */
  bool find_paths();
  /** Collective, after find_paths(): this rank has of the surface what comes into the region between
      lo and hi at the start of the paths. False if it and all others have that already. */
  bool have_near(const Eigen::Vector3d &lo, const Eigen::Vector3d &hi);
  SRDSurfacePart &here() { return *known; }
  const SRDSurfacePart &here() const { return *known; }
  /// Vertices of here().
  const std::vector<Membrane_NS::SurfaceVertex> &paths() const { return vertices; }
  /// Inverse masses of its masses.
  const std::vector<double> &inverse_masses() const { return inverse_masses_here; }
  /// Collective: all vertices of the surface, at rest where they are at the end of the step.
  std::vector<Membrane_NS::SurfaceVertex> places();
  /// Collective: limit positions and velocities of the owned vertices, in the order of part().
  void masses_now(Membrane_NS::VertexField &position, Membrane_NS::VertexField &velocity);
  /// Collective: changes of the masses' velocities now, in the order of part(), reach the control
  /// points.
  void apply(const Membrane_NS::VertexField &change);
  /// Collective: changes of velocity and position now of the owned masses among those of here() do.
  void apply(const std::vector<Membrane_NS::SurfaceChange> &changes);

  /// The owned vertices.
  MeshPart &part() { return points.part(); }
  double mass_of(int owned) const { return masses[owned]; }
  bool is_free(int owned) const { return inverse_masses_owned[owned] > 0.0; }
  double memory_usage() const;

 private:
  std::string user;
  int groupbit;
  bool all_masses;
  LocalMesh local_mesh;
  MeshGroup points;
  std::unique_ptr<Membrane_NS::LimitMask> mask;
  SurfaceMovers movers;
  SRDSurface shape;
  std::vector<double> masses, inverse_masses_owned;    // of owned vertices
  // the triangles whose faces start with an owned vertex, and those near the solvent
  std::unique_ptr<SRDSurfacePart> own, known;
  bigint known_for;    // which numbers of the part
  std::vector<Membrane_NS::SurfaceVertex> vertices;
  std::vector<double> inverse_masses_here;

  bool any_fixed;                         // some vertices do not yield to impulses
  Membrane_NS::VertexField remembered;    // if so: x of the last step, and the box then
  Eigen::Matrix3d remembered_box;
  Eigen::Vector3d remembered_corner;
  std::vector<int> atom_vertex;         // place in part() of local atoms, or -1
  std::vector<double> mine, spread;     // paths of owned masses, and of those that are here
  double step, time_left;               // its duration, and what is left of it
  Membrane_NS::VertexField drift;       // velocities of owned control points in it
  Membrane_NS::VertexField velocity;    // of owned masses for the rest of it
  Membrane_NS::VertexField acceleration;
  Membrane_NS::VertexField q, moved, r, detour;

  void find_fixed();
  void find_masses();
  void follow_points();
  void refresh();
  void load_positions();
  void load_displacements();
  void load_accelerations();
  void spread_paths(SRDSurfacePart &, std::vector<Membrane_NS::SurfaceVertex> &);
  std::vector<int> own_triangles();
  std::unique_ptr<SRDSurfacePart> make_part(std::vector<int> triangles);
  void check_frames();
  void change_velocities();
};

}    // namespace LAMMPS_NS

#endif
