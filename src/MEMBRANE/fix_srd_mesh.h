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
#include "srd_ghost_free_group.h"
#include "hd_mass.h"
#include "srd_cells.h"
#include "srd_mesh_arguments.h"
#include "srd_solvent.h"
#include "srd_streaming.h"
#include "srd_obstacle.h"

#include <memory>

namespace LAMMPS_NS {

/** Solvent of stochastic rotation dynamics around membranes. A step: half a kick if other fixes
    exert forces on the solvent, streaming once integrators have moved the membranes, half a kick; every N
    steps a collision in cells, at the end of the step or, if membranes take part in it, halfway through
    streaming. */
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
  const int membrane;          // group, or -1
  double temperature;
  SRDCells::Settings cell_settings;

  // the roles
  SRDSolvent solvent;
  SRDStreaming streaming;
  std::unique_ptr<SRDCells> cells;
  std::unique_ptr<HDMass> mass;    // of the membranes; none without them
  std::unique_ptr<SurfaceObstacle> obstacle;
  bool have_obstacle;              // there are membranes, and setup() has been there
  bool running;                    // in a run since setup(), not a minimization
  bool membranes_join;             // their point masses take part in collisions in cells
  std::vector<int> side;           // of a membrane, by owned atom
  GhostFreeGroup aside;

  bigint num_solvent;
  double solvent_mass;         // mean
  double filling;              // mean number in a cell
  bool velocities_set;         // by the first run
  bool have_forces;            // some fix or pair style acts on solvent
  bool velocities_stay;        // but for forces and what this fix does
  bool clear_forces;           // LAMMPS does not

  enum {
    TEMPERATURE, COLLISIONS, CROSSINGS, RESCUES, MOMENTUM, INSIDE = MOMENTUM + 3, OUTSIDE,
    VISCOSITY, TEMPERATURE_IN, TEMPERATURE_OUT, HANDED, FREE_PATH = HANDED + 3,
    NORMAL_IMPULSE, WALLS, NUM_VALUES = WALLS + 3
  };
  double values[NUM_VALUES], carried[NUM_VALUES];    // now; up to the restart file
  bigint sampled;

  void check_group();
  void check_other_solvents();
  void check_box_movers();
  void keep_meshes_in_shape();
  void find_influences();
  void prepare_cells();
  void report();
  void maxwell();
  void kick();
  void stream_past_membranes(double dt, double until_collision);
  void wrap();
  void collide();
  void zero_forces();
  bool is_due() const;
  bool any_strayed();
  void sample();
  void sample_obstacle();
  const int *sides();
  void check_sides();
  double kT() const;
};

}    // namespace LAMMPS_NS

#endif
#endif
