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

#ifndef LMP_FIX_HD_BASE_H
#define LMP_FIX_HD_BASE_H

#include "fix.h"
#include "hd_mass.h"
#include "helfrich_measure.h"

#include "restart_archive.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/** What all integrators of control points share: the mass matrix, the checks, and the moves that
    they are put together from. Integrators change x and v of control points by these alone, so
    what restricts the motion or adds to it has its place in them and in the mass matrix. */
class FixHDBase : public Fix {
 public:
  FixHDBase(class LAMMPS *, int, char **);
  ~FixHDBase() override;

  void post_constructor() override;
  void init() override;
  void setup_pre_force(int) override;
  void setup(int) override;
  void pre_force(int) override;
  int modify_param(int, char **) override;
  /// 0: passes over the mesh of the last M^-1 f; 1: its residual |f - M a|/|f|
  double compute_vector(int) override;
  /// Modes, one in a row: two numbers, wave number, amplitude, velocity, energies, molecule ID
  double compute_array(int, int) override;
  double memory_usage() override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  /// "measure": a HelfrichMeasure, dim 0
  void *extract(const char *, int &dim) override;

  // === What others ask of an integrator

  /// The fix of this kind that moves atoms of the group, if any. Collective; stops if there are
  /// several and their matrices differ.
  static FixHDBase *of_group(class LAMMPS *, int groupbit, const std::string &user);
  /// What is wrong if a fix samples the shapes that `user` changes at another temperature; else empty. Collective.
  static std::string other_temperature(class LAMMPS *, const Fix *user, double temperature);
  double drag_coefficient() const { return mass.drag_coefficient(); }
  const HDMass::Settings &mass_settings() const { return mass.settings; }
  /// From now on, remember by how much drift() moves the control points in a step.
  void remember_displacement() { remembers = true; }
  /// By how much it has in the present step; the order is that of part().
  const Membrane_NS::VertexField &displacement() const { return moved; }
  /// M^-1 f at the start of the present step, in units of force/mass; the same order.
  const Membrane_NS::VertexField &last_acceleration() const { return acceleration; }
  const MeshPart &part() { return mass.part(); }
  /// Collective: v = M^-1 f of its control points; both are [atoms][3], of owned atoms.
  void respond(const double *const *f, double **v);
  /// The temperature, times Boltzmann's constant, that its shapes are sampled at; 0 if it is not known.
  double sampled_kT() const { return measure.kT; }
  /// For commands that sort atoms between runs, whose next one may be without setup.
  static void atoms_renumbered(class LAMMPS *);
  /// Something has moved atoms after a step's end, and their forces are others.
  void forces_changed() { forces_due = true; }
  /// Collective: twice the kinetic energy by direction, mass times velocity squared.
  std::array<double, 3> twice_kinetic();
  /// The modes that are all of its motion, or nullptr.
  const Membrane_NS::SharedModes *modes() const { return mass.settings.modes.get(); }
  /// Its dynamics have no meaning.
  bool sampling() const { return mass.settings.kind == Membrane_NS::MassKind::SAMPLING; }

 protected:
  HDMass mass;
  /// At which temperature the shapes of membranes are sampled; kT = 0 if at none.
  HelfrichMeasure measure;

  /** Steps with noise since the fix was made, restarts included: random numbers are a function of it, and
      not of LAMMPS' timestep, which reset_timestep sets back. */
  bigint noise_steps;
  /// What restart files keep, of a fix with restart_global = 1.
  virtual void archive(RestartArchive &file);

  // === Moves of the momenta p = M v and of x

  /// Take the atoms' forces f for what follows: acceleration = M^-1 f; and unit noise, if there is a noise_seed.
  void accelerate();
  /// p += step f, which with constant M is v += step M^-1 f
  void kick(double step);
  /// x += step v; stops if a control point runs away
  void drift(double step);
  /// One after the other.
  void kick_and_drift(double kick_step, double drift_step);
  /// The noise of the present step with <z z^T> = M^-1, which accelerate() has made.
  Membrane_NS::VertexField &unit_noise();
  bigint noise_seed;    ///< of unit_noise(); 0 if none is wanted
  /// p = keep p + unit noise: an exact step of friction and noise, once a step.
  void relax(double keep, double kT);
  /// The same with one number per owned vertex, if the mass has friction per vertex.
  void relax(const std::vector<double> &keep, double kT, bigint seed);
  /// The same for modes with friction of their own, over this time.
  void relax_modes(double time, double kT, bigint seed);
  /** Collective, once a step: whether mass sampling is another than in the last step, since the shape has left
      its reference, or at first, so that velocities of before are worth nothing. relax() does so itself. */
  bool renew();
  /// With mass sampling, before the first step: velocities are those of another mass.
  bool has_foreign_velocities() const { return sampling() && drawn_for < 0; }
  /** With mass sampling: a step that would tear the mesh is taken back. Call before the step moves anything, and after.
      Whether it was: then points are where they were, and velocities such that after the last half kick of the step
      they are the opposite of those before it, if half_kick is that kick's time. Stops if that happens often. */
  void hold_on();
  bool step_back(double half_kick);
  /// v = M^-1 f + spread (noise1 + noise2), where M is a drag matrix: forces and drag balance.
  void balance(double spread, const Membrane_NS::VertexField &noise1, const Membrane_NS::VertexField &noise2);

 private:
  Membrane_NS::VertexField force_field, acceleration, noise, velocity, moved;
  bigint noise_step, noise_numbering;    // which step and which matrix `noise` is for
  double most_drift;
  bigint moved_step;    // of which step `moved` is
  int64_t drawn_for;    // the reference of mass sampling that velocities are drawn for, or -1
  int passes;           // of the last accelerate()
  bool forces_due;      // others have changed forces since the last accelerate(), in setup() or after a step
  bool remembers, check, limit_due;
  double limit;    // of stability for the timestep, when a run last began; 0 if not known
  bool watching;
  std::vector<std::array<double, 6>> held;    // x and v of owned points
  int64_t held_reference;                     // of the mass matrix then
  bigint taken_back;                          // steps
  double tried_with;                          // the timestep that these were counted with, in runs one after the other
  bigint tried_here, taken_back_here;
  std::unique_ptr<class FaceWatch> faces;

  void check_other_integrators();
  void find_limit();
  template <bool KICKS> void move(double kick_step, double drift_step);
  void report_runaway(tagint);
  std::string shape_lost_at(tagint);

  // === Modes, in fix_hd_modes.cpp

  bigint settled_step, measured_step;
  std::vector<std::array<double, 10>> rows;    // of the array, of measured_step
  void check_box();
  void displacement_from_reference(Membrane_NS::VertexField &);
  struct OutOfSpace;
  OutOfSpace out_of_space();
  void settle(bool first);
  void find_friction();
  void measure_modes();
};

}    // namespace LAMMPS_NS

#endif
