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

#ifdef FIX_CLASS
// clang-format off
FixStyle(srd/mesh,FixSRDMesh);
// clang-format on
#else

#ifndef LMP_FIX_SRD_MESH_H
#define LMP_FIX_SRD_MESH_H

#include "fix.h"
#include "hd_mass.h"
#include "helfrich_measure.h"
#include "srd_cells.h"
#include "srd_fluid.h"
#include "srd_ghost_free_group.h"
#include "srd_influences.h"
#include "srd_mesh_arguments.h"
#include "srd_observables.h"
#include "srd_obstacle.h"
#include "srd_solvent.h"
#include "srd_streaming.h"

#include <memory>
#include <vector>

namespace LAMMPS_NS {

/** Solvent of stochastic rotation dynamics around membranes. A step: half a kick if other fixes
    exert forces on the solvent, streaming once integrators have moved the membranes, half a kick;
    every N steps a collision in cells, at the end of the step or, if membranes take part in it,
    halfway through streaming. */
class FixSRDMesh : public Fix {
 public:
  FixSRDMesh(class LAMMPS *, int, char **);
  ~FixSRDMesh() override;

  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void setup_pre_neighbor() override;
  void setup_pre_force(int) override;
  void setup(int) override;
  void initial_integrate(int) override;
  void post_integrate() override;
  void pre_neighbor() override;
  void pre_force(int) override;
  void min_pre_force(int) override;
  void final_integrate() override;
  void end_of_step() override;
  void post_run() override;
  double compute_vector(int) override;
  /** For pair style helfrich; null without membranes. Collective; may be asked before init(). dim 0.
      "default_regularize": a double, the modulus that meshes need among solvent where pair_coeff says
      nothing; "measure": a HelfrichMeasure. */
  void *extract(const char *, int &) override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  double memory_usage() override;

 private:
  const SRDMeshArguments given;
  const int membrane;    // group, or -1

  // the roles
  SRDSolvent solvent;
  SRDFluid fluid;
  SRDInfluences influences;
  SRDStreaming streaming;
  std::unique_ptr<SRDCells> cells;
  std::unique_ptr<HDMass> mass;    // of the membranes; none without a group of them
  std::unique_ptr<SurfaceObstacle> obstacle;
  SRDObservables observables;
  GhostFreeGroup ghost_free;

  bool have_membranes;      // the group has atoms, as of init()
  bool have_obstacle;       // so there are membranes, and setup() has been there
  bool running;             // in a run since setup(), not a minimization
  bool membranes_join;      // their point masses take part in collisions in cells
  std::vector<int> side;    // of a membrane, by owned atom
  bool velocities_set;      // by the first run
  bool clear_forces;        // LAMMPS does not
  double stiffness;         // see extract(); 0 if nobody has asked
  HelfrichMeasure sampling;    // the same
  bigint sampled, natoms_after_run;
  bigint steps;    // done since the fix was made, restarts included: what random numbers depend on
  struct {
    double scene[2], volume[2];    // of so much solvent and so many control points, the two sides' parts
  } measured;
  bool reported;

  void check_other_solvents();
  void init_membranes();
  void prepare_cells();
  void measure_sides();
  void stream_past_membranes(double dt, double until_collision);
  void kick();
  void solvent_changed();
  void wrap();
  void collide();
  void zero_forces();
  bool is_due() const;
  bool any_strayed();
  void sample();
  const int *sides();
  void put_strays_back();
  void report_strays(bigint count);
};

}    // namespace LAMMPS_NS

#endif
#endif
