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

#ifndef LMP_MEMBRANE_MASS_SAMPLING_H
#define LMP_MEMBRANE_MASS_SAMPLING_H

#include "membrane_cholesky.h"
#include "membrane_mass.h"
#include "membrane_mass_reference.h"
#include "membrane_random.h"

#include <Eigen/Dense>

#include <memory>
#include <vector>

namespace Membrane_NS {

/** Mass sampling: the stiffness of the membrane in place of mass, so that all of its motions take the
    same time and equilibrium is reached in a few steps; dynamics have no meaning. See
    doc/src/Derivation_sampling.rst for

      M^-1 = N B^-1 N^T + (1 - N N^T) T^-1 (1 - N N^T) - Y W Y^T + E E^T/m

    with normals N of a reference shape, B the stiffness of undulations, T of control points along the
    surface, Y and W what totals add to it and what takes away rotations, E/m translations.

    Every rank holds all of it and does all the work. */
class SamplingMass : public MassOperator {
 public:
  /// settings.reference is there, for this topology. MeshError if it does not resist enough.
  SamplingMass(const VertexMasses &, const Settings &);

  void multiply(const VertexField &v, VertexField &p) override;
  void solve(const VertexField &p, VertexField &v) override;
  void sample(double kT, uint64_t seed, uint64_t step, VertexField &v) override;
  void solve_with_noise(const VertexField &p, VertexField &v, uint64_t seed, uint64_t step, VertexField &z) override;
  int lost_freedoms() const override { return static_cast<int>(3 * turning_.size()); }
  void add_gauge_forces(double kT, const VertexField &x, VertexField &f) override;
  double memory_usage() const override;

 private:
  using Vectors = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  const Settings settings_;
  const std::vector<uint64_t> labels_;
  std::vector<Eigen::Vector3d> normals_;
  Eigen::SparseMatrix<double> undulation_, sliding_;               // B and T
  std::unique_ptr<SparseCholesky> normal_factor_, tangent_factor_, blocked_factor_;    // B, T, N^T T N

  // 3n x r, 3n x r, r x r, r x r: see the derivation; and W'' of the first columns, which are totals

  Eigen::MatrixXd u_, y_, w_, c_;
  Eigen::VectorXd stiffness_;

  struct Turning {    // a closed component, which does not turn
    std::vector<int> vertices;
    double mobility;    // 1/m of its translations
    Eigen::Matrix3d inverse_square;    // of the sum of n n^T
  };
  std::vector<Turning> turning_;
  std::vector<int> turning_of_;          // by vertex, or -1
  std::vector<Eigen::Vector3d> arms_;    // by vertex, from the middle of its component
  VertexField all_, noise_;    // by vertex of the topology
  std::vector<double> along_, noise_along_;

  struct Rest {    // of velocities, besides those of the base
    Eigen::VectorXd totals;
    std::vector<Eigen::Vector3d> speed;    // of turning components
  };

  void build_factors(const Topology &, const std::vector<double> &masses);
  void build_totals(const Topology &);
  void find_turning(const Topology &, const std::vector<double> &areas);
  void split(VertexField &x, std::vector<double> &along) const;
  void join(const std::vector<double> &along, VertexField &x) const;
  void solve_base(VertexField &x);
  void draw(double root, const CounterRandom &, VertexField &noise, std::vector<double> &along) const;
  Rest rest_of(const VertexField &p) const;
  Rest rest_of_noise(double root, const CounterRandom &, const VertexField &noise) const;
  void add(const Rest &, VertexField &v) const;
  void scatter(const VertexField &all, VertexField &x) const;
};

}    // namespace Membrane_NS

#endif
