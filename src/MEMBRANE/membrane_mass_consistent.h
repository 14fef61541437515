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

#ifndef LMP_MEMBRANE_MASS_CONSISTENT_H
#define LMP_MEMBRANE_MASS_CONSISTENT_H

#include "membrane_cholesky.h"
#include "membrane_mass.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <map>
#include <utility>

namespace Membrane_NS {

/** Mass consistent: M_ij = sum over faces of 2 m_f integral phi_i phi_j du dv, with m_f the sum over
    the face's corners of their mass over their valence. Solved by conjugate gradients with Jacobi's
    preconditioner or by a factorization of all of M on every rank. */
class ConsistentMass : public MassOperator {
 public:
  ConsistentMass(const VertexMasses &, const Settings &);
  void multiply(const VertexField &v, VertexField &p) override;
  void solve(const VertexField &p, VertexField &v) override;
  /// M^-1 B z with B B^T = M, face by face.
  void sample(double kT, uint64_t seed, uint64_t step, VertexField &v) override;
  double memory_usage() const override;

 private:
  Settings settings_;
  Eigen::SparseMatrix<double, Eigen::RowMajor> rows_;    // columns in local numbers
  std::vector<double> diagonal_;
  std::unique_ptr<PartCholesky> factor_;    // if direct

  struct FaceNoise {    // a face that reaches owned vertices
    uint64_t label;
    double amplitude;                          // sqrt(m_f)
    const Eigen::MatrixXd *root;               // B of the face's matrix for m_f = 1
    std::vector<std::pair<int, int>> owned;    // local vertex, row of root
  };
  std::map<std::array<int, 3>, Eigen::MatrixXd> roots_;    // by valences of the corners
  std::vector<FaceNoise> face_noise_;
  VertexField work_, scratch_;

  void build(const VertexMasses &);
  void conjugate_gradients(const VertexField &p, VertexField &v);
};

}    // namespace Membrane_NS

#endif
