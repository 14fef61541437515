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

#ifndef LMP_FIX_HD_BOUND_H
#define LMP_FIX_HD_BOUND_H

#include "bound_curvature.h"
#include "bound_site_file.h"
#include "fix.h"
#include "membrane_closest_point.h"
#include "mesh_local.h"
#include "mesh_surface.h"
#include "restart_archive.h"

#include <memory>
#include <string>
#include <tuple>
#include <vector>

namespace LAMMPS_NS {

/** Holds atoms on the limit surface of membranes. An atom stays an ordinary atom, which other fixes move; its
    distance d from the surface is held at a height, by a spring or rigidly. With S the closest point, n
    the normal and c_i the weights of control points q_i there,
      dd/dx = n,  dd/dq_i = -c_i n,
    exactly, so linear and angular momentum are kept (doc/src/Derivation_bound.rst). Fix hd/bind is this with
    the words that say how. */
class FixHDBound : public Fix {
 public:
  FixHDBound(class LAMMPS *, int, char **);
  ~FixHDBound() override;

  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void setup(int) override;
  void min_setup(int) override;
  void initial_integrate(int) override;
  void post_force(int) override;
  void post_force_respa(int, int, int) override;
  void min_post_force(int) override;
  void final_integrate() override;
  void reset_dt() override;
  bigint dof(int) override;

  /// The energy of springs, footprints and correction.
  double compute_scalar() override;
  /// See the enum Output.
  double compute_vector(int) override;
  double memory_usage() override;

  // === Sites follow their atoms

  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;
  void write_restart(FILE *) override;
  void restart(char *) override;

  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;

  // === What others ask

  /// The fix of this ID, or an error of `user`.
  static FixHDBound *named(class LAMMPS *, const std::string &id, const std::string &user);
  /// Collective: the largest eigenvalue of 1/m + S, S_ab = n_a.n_b c_a^T M^-1 c_b: times the spring's
  /// stiffness and ftm2v it is the square of a frequency. 0 without particles. Feet are those of the last step.
  double largest_response();
  /// The same for motion without inertia, where it is a rate.
  double largest_mobility();
  /// Stiffness of the spring, energy/distance^2; 0 if it is not known yet or the hold is rigid.
  double stiffness() const { return rigid ? 0.0 : spring; }
  /// The spring is chosen with the timestep.
  bool follows_timestep() const { return automatic; }
  int membrane_bit() const { return membranebit; }
  /// Whether it moves its atoms itself, without inertia.
  bool is_overdamped() const { return diffusion > 0.0; }
  /// The site of an owned atom of the group.
  const BoundSite &site(int i) const { return sites[i]; }
  /// The area that the footprint of an owned atom takes of its membrane.
  double footprint_area(int i) const;
  LocalSurface &surface() const { return *limit; }
  /// Owned atoms that are bound, and owned faces of the membranes of the membrane group.
  const std::vector<int> &bound_atoms() const { return members; }
  std::vector<int> owned_faces() const;
  double mass_of(int) const;
  /// Atoms are exactly over their sites, and move along the surface only.
  bool is_rigid() const { return rigid; }
  /// Collective: the sum over its atoms of the logarithm of the area that they can be in, of the surface at their
  /// height, to that of u and v at their site.
  double log_areas();
  /// Takes atoms back over their sites on the surface as it is now.
  void return_to_sites();
  /// Collective: feet at the present positions, for computes.
  void update_feet();

 protected:
  std::string membrane_name;
  int membranebit;
  double max_distance;    // 0: half a mean edge
  int leaflet;            // 0: both
  double height;
  bool rigid, automatic;
  enum class Correct { DEFAULT, YES, NO } correct;    // the metric factor of rigid particles
  double spring;
  double diffusion, temperature;    // of motion without inertia; 0: others move the atoms
  bigint seed;
  bool carried;    // the drag is against the membrane, which takes them along, and not against a bath
  double turning, turning_temperature;    // diffusion of directors, in angle^2/time; 0: none
  bigint turning_seed;
  BoundCurvature curvature;
  std::string site_path;    // of a file with sites, for atoms that have none yet
  std::vector<SiteOfAtom> given;

 private:
  /// What a spring lets go by before a particle is said to be lost, and how far atoms are taken at first, in
  /// mean edges.
  static constexpr double FARTHEST = 0.5;

  enum Output { STIFFNESS, COUNT, RMS, LARGEST, PHASE, FOOTPRINTS, NUM_OUTPUT };

  bool correcting;    // in this run
  bool migrating;     // atoms were taken somewhere else before it
  class FixHDBase *mover;    // of the membranes, in this run, or null
  bigint noise_steps;

  LocalMesh mesh;
  std::unique_ptr<LocalSurface> limit;
  BoundSites sites;
  double footprint_energy;
  std::vector<double> torque;    // on directors about the normal, by member
  bigint total;               // of bound atoms, on all ranks
  double precision;           // of closest points, a length: the same for all runs, so that restarts are exact
  double chosen_for;          // timestep that an automatic spring is for
  bigint chosen_count;        // and number of particles
  double energy, squares, farthest, phase;

  // === Of this rank, in a step

  struct Foot {
    int atom, face;           // owned
    Eigen::Vector3d normal;
    double off;               // from its height, a length
    int start, size;          // of its weights
    Eigen::Vector3d place;    // the point of the surface, if carried
  };
  using FeetOfRank = std::tuple<std::vector<Foot>, std::vector<double>, std::vector<int>>;
  std::vector<int> members;   // owned atoms that are bound
  std::vector<Foot> feet;     // of them
  std::vector<double> weights;
  std::vector<int> points;    // local indices
  std::vector<int> last_points;
  bool followed = false;      // feet and points are still those of members, as they were when last looked at
  double **work, **answer;    // [atoms][3], for exchange
  double **exchanged;         // what pack_reverse_comm() and pack_forward_comm() are of
  int allocated;

  // life cycle
  void check_group();
  void check_integrators();
  bool is_near(int, int face) const;
  void bind_free_atoms();
  void bind_given_atoms();
  void return_strays();
  void check_inside_box();
  void check_given_sites();
  std::vector<int> components_of_group() const;
  void make_surface();
  void follow();
  void find_members();
  void look_ahead(size_t a) const;
  void find_feet();
  void remember(int, const Membrane_NS::ClosestPoint &);
  void choose_spring();

  // steps
  void hold(int);
  void tally_pull(const Foot &, double pull);
  void clear_work();
  void spread(const std::vector<double> &);
  Eigen::Vector3d place_of(const Foot &) const;
  void drag_membrane();
  void diffuse();
  void couple();
  void take_footprints(int);
  void give_director(int, const Eigen::Vector3d &normal);
  void turn_directors();
  std::vector<class FixHDBase *> integrators(bool overdamped) const;
  double largest(bool overdamped);
  void respond(const std::vector<double> &, std::vector<double> &, bool overdamped);
  double dot(const std::vector<double> &, const std::vector<double> &) const;
  std::vector<double> multipliers(const std::vector<double> &residual);
  void push(const std::vector<double> &, double step, double **by);
  double bath_kT() const;
  void correct_metric();
  void constrain_positions();
  void constrain_velocities();
  void archive(RestartArchive &);
};

}    // namespace LAMMPS_NS

#endif
