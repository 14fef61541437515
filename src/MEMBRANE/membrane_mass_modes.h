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

#ifndef LMP_MEMBRANE_MASS_MODES_H
#define LMP_MEMBRANE_MASS_MODES_H

#include "membrane_mass.h"
#include "membrane_mode_space.h"

#include <map>
#include <string>
#include <utility>

namespace Membrane_NS {

/// The modes that several masses share, and the friction of each: who integrates says which, all others follow.
struct SharedModes {
  ModeChoice choice;
  std::string file;          ///< FILE
  double viscosity = 0.0;    ///< of the solvent that gives friction, if positive, mass/(length time)
  std::map<std::pair<int, int>, double> times;    ///< or relaxation times by (l, 0), (nx, ny) or (number, 0)
  bool has_friction() const { return viscosity > 0.0 || !times.empty(); }

  /// About which shape they are: remembered over runs.
  TriangleMesh shape;
  std::vector<ReferenceFrame> frames;    ///< by membrane of the space

  std::shared_ptr<const ModeSpace> now;
  /// [modes] mass/time: force over velocity of an amplitude; empty if proportional to mass, or not known yet.
  std::vector<double> friction;
  int64_t renewals = 0;    ///< of these two
};

/** Another mass matrix M in a space of modes, v = Phi adot: with G = Phi^T M Phi

      M^-1 -> Phi G^-1 Phi^T

    gives to momenta p the velocity of modes that do the same work, and noise has the covariance kT of this. So
    whatever kicks, drifts and relaxes with this matrix stays in the space. If modes have friction of their own and M
    is of drag coefficients, G is that friction. */
class ModalMass : public MassOperator {
 public:
  /// MeshError if the mesh cannot tell the modes apart. gram: that of an earlier matrix of the same masses, or none.
  ModalMass(const VertexMasses &, std::unique_ptr<MassOperator> full, const SharedModes &, bool drag,
            const Eigen::MatrixXd &gram);

  void multiply(const VertexField &v, VertexField &p) override;
  void solve(const VertexField &p, VertexField &v) override;
  void sample(double kT, uint64_t seed, uint64_t step, VertexField &v) override;
  void solve_with_noise(const VertexField &p, VertexField &v, uint64_t seed, uint64_t step, VertexField &z) override;
  int lost_freedoms() const override { return 3 * space_->num_vertices() - count_; }
  bool has_own_friction() const override { return !friction_.empty(); }
  void relax_own(double time, double kT, uint64_t seed, uint64_t step, VertexField &v) override;
  double memory_usage() const override;

  // === Amplitudes, in the order of the space

  const ModeSpace &space() const { return *space_; }
  int count() const { return count_; }
  /// Phi^T M Phi of the full matrix: see the constructor.
  const Eigen::MatrixXd &gram() const { return gram_; }
  /// Of which v is Phi a, or nearest to it in the metric of M. Collective.
  Eigen::VectorXd amplitudes(const VertexField &v);
  /// Phi^T f. Collective.
  Eigen::VectorXd project(const VertexField &f) const;
  /// v = Phi a
  void expand(const Eigen::VectorXd &a, VertexField &v) const;

 private:
  struct Membrane {
    const MembraneModes *modes;
    int first;                 // of its modes
    std::vector<int> local;    // owned vertices of the part
    std::vector<Lane> psi;     // their rows
  };
  const std::shared_ptr<const ModeSpace> space_;
  const std::unique_ptr<MassOperator> full_;
  const bool drag_;
  const std::vector<double> friction_;
  std::vector<Membrane> membranes_;
  int count_;
  Eigen::MatrixXd gram_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::MatrixXd turn_, decay_;    // Q, and W with W^T G W = 1 and W^T friction W = rates_
  Eigen::VectorXd rates_;
  VertexField work_, momentum_;

  bool is_drag_of_modes() const { return drag_ && !friction_.empty(); }
  Eigen::VectorXd response(const VertexField &p) const;
  Eigen::VectorXd unit_noise(uint64_t seed, uint64_t step) const;
  template <int N>
  void expand(const std::array<const Eigen::VectorXd *, N> &a, const std::array<VertexField *, N> &v) const;
  void find_membranes();
  void find_gram();
  void find_decay();
  Eigen::VectorXd white(uint64_t seed, uint64_t step) const;
};

}    // namespace Membrane_NS

#endif
