/* -----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing author: MEMBRANE developers
------------------------------------------------------------------------- */

#include "membrane_mass_consistent.h"

#include "membrane_limit_basis.h"
#include "membrane_quadrature.h"
#include "membrane_random.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

using namespace Membrane_NS;

/* ----------------------------------------------------------------------
   the matrix of a face of unit mass, by a rule that is exact for it
------------------------------------------------------------------------- */

// integral over the face's own parameters of phi_k phi_l, times 2; recursion over the children
static Eigen::MatrixXd face_matrix(const Valences &valences)
{
  const LimitBasis basis(valences);
  if (basis.is_regular()) {
    const TriangleRule rule = triangle_rule(Quadrature::CAREFUL);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(12, 12);
    for (int q = 0; q < rule.size(); ++q) {
      const Eigen::VectorXd w = box_spline(rule.u[q], rule.v[q]).row(LimitBasis::VALUE).transpose();
      matrix += 2.0 * rule.weight[q] * w * w.transpose();
    }
    return matrix;
  }

  // a corner child that is its own parent's kind: sum the series A^T X A/4 until nothing is left

  const Eigen::MatrixXd regular = face_matrix({6, 6, 6});
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(basis.size(), basis.size());
  int self = -1;
  for (int child = 0; child < 4; ++child) {
    const Valences inner = basis.child_valences(child);
    const Eigen::MatrixXd s = basis.child_matrix(child);
    if (inner == valences) {
      self = child;
      continue;
    }
    const Eigen::MatrixXd part = inner == Valences{6, 6, 6} ? regular : face_matrix(inner);
    matrix += 0.25 * s.transpose() * part * s;
  }
  if (self < 0) return matrix;
  const Eigen::MatrixXd a = basis.child_matrix(self);
  Eigen::MatrixXd term = matrix;
  for (int level = 0; level < 60; ++level) {
    term = (0.25 * a.transpose() * term * a).eval();
    matrix += term;
  }
  return matrix;
}

// B with B B^T = matrix, for positive semi-definite matrices too
static Eigen::MatrixXd square_root(const Eigen::MatrixXd &matrix)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

/* ---------------------------------------------------------------------- */

ConsistentMass::ConsistentMass(const VertexMasses &vertices, const Settings &settings) :
    MassOperator(vertices.part), settings_(settings)
{
  build(vertices);
}

void ConsistentMass::build(const VertexMasses &vertices)
{
  const auto &[topology, part, masses, labels] = vertices;
  const auto local = part.local_numbers();
  std::map<Valences, Eigen::MatrixXd> matrices;
  std::vector<Eigen::Triplet<double>> entries, all;
  std::vector<int> stencil;
  for (int f = 0; f < topology.num_faces(); ++f) {
    topology.stencil(f, stencil);
    FaceNoise noise;
    for (size_t k = 0; k < stencil.size(); ++k) {
      const auto found = local.find(stencil[k]);
      if (found != local.end() && found->second < part.owned)
        noise.owned.emplace_back(found->second, k);
    }
    if (noise.owned.empty() && !settings_.direct) continue;

    const Valences valences = topology.valences(f);
    double mass = 0.0;
    noise.label = 0;
    for (int k = 0; k < 3; ++k) {
      const int v = topology.face(f)[k];
      mass += masses[v] / valences[k];
      noise.label = noise.label * 0x9E3779B97F4A7C15ULL + labels[v];
    }
    auto found = matrices.find(valences);
    if (found == matrices.end()) {
      found = matrices.emplace(valences, face_matrix(valences)).first;
      roots_[valences] = square_root(found->second);
    }
    noise.amplitude = std::sqrt(mass);
    noise.root = &roots_[valences];
    for (auto [i, k] : noise.owned)
      for (size_t l = 0; l < stencil.size(); ++l)
        entries.emplace_back(i, local.at(stencil[l]), mass * found->second(k, l));
    if (settings_.direct)
      for (size_t k = 0; k < stencil.size(); ++k)
        for (size_t l = 0; l < stencil.size(); ++l)
          all.emplace_back(stencil[k], stencil[l], mass * found->second(k, l));
    if (!noise.owned.empty()) face_noise_.push_back(std::move(noise));
  }

  rows_.resize(part.owned, part.size());
  rows_.setFromTriplets(entries.begin(), entries.end());
  for (int i = 0; i < part.owned; ++i) diagonal_.push_back(rows_.coeff(i, i));
  if (!settings_.direct) return;

  for (int v = 0; v < topology.num_vertices(); ++v)
    if (masses[v] == 0.0) all.emplace_back(v, v, 1.0);    // of no rank's part
  Eigen::SparseMatrix<double> matrix(topology.num_vertices(), topology.num_vertices());
  matrix.setFromTriplets(all.begin(), all.end());
  factor_ = std::make_unique<PartCholesky>(part_, matrix);
}

/* ---------------------------------------------------------------------- */

void ConsistentMass::multiply(const VertexField &v, VertexField &p)
{
  work_.resize(part_.size());
  std::copy_n(v.begin(), part_.owned, work_.begin());
  part_.fill_halo(work_);
  for (int i = 0; i < part_.owned; ++i) {
    Vector4 sum = {};
    for (decltype(rows_)::InnerIterator entry(rows_, i); entry; ++entry)
      for (int k = 0; k < 4; ++k) sum.c[k] += entry.value() * work_[entry.col()].c[k];
    p[i] = sum;
  }
}

void ConsistentMass::solve(const VertexField &p, VertexField &v)
{
  if (!factor_) return conjugate_gradients(p, v);
  std::copy_n(p.begin(), part_.owned, v.begin());
  factor_->solve(v);
  passes_ = 1;
}

/* ----------------------------------------------------------------------
   preconditioned conjugate gradients, x, y and z at once with inner products of their own; what is
   not a finite number in p is none in v
------------------------------------------------------------------------- */

void ConsistentMass::conjugate_gradients(const VertexField &p, VertexField &v)
{
  const int n = part_.owned;
  VertexField r(p.begin(), p.begin() + n), d(part_.size()), q(n);
  double rz[4] = {}, norm[4] = {}, rz_next[4], dq[4];
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < 4; ++k) {
      v[i].c[k] = 0.0;
      d[i].c[k] = r[i].c[k] / diagonal_[i];
      rz[k] += r[i].c[k] * d[i].c[k];
    }
  part_.sum(rz, 4);
  std::copy_n(rz, 4, norm);

  for (passes_ = 0; passes_ < settings_.most_passes; ++passes_) {
    bool solved = true;
    for (int k = 0; k < 3; ++k)
      solved = solved && rz[k] <= settings_.tolerance * settings_.tolerance * norm[k];
    if (solved) return;
    multiply(d, q);
    std::fill_n(dq, 4, 0.0);
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < 4; ++k) dq[k] += d[i].c[k] * q[i].c[k];
    part_.sum(dq, 4);
    std::fill_n(rz_next, 4, 0.0);
    double alpha[4], beta[4];
    for (int k = 0; k < 4; ++k) alpha[k] = dq[k] > 0.0 ? rz[k] / dq[k] : 0.0;
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < 4; ++k) {
        v[i].c[k] += alpha[k] * d[i].c[k];
        r[i].c[k] -= alpha[k] * q[i].c[k];
        rz_next[k] += r[i].c[k] * r[i].c[k] / diagonal_[i];
      }
    part_.sum(rz_next, 4);
    for (int k = 0; k < 4; ++k) {
      beta[k] = rz[k] > 0.0 ? rz_next[k] / rz[k] : 0.0;
      rz[k] = rz_next[k];
    }
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < 4; ++k) d[i].c[k] = r[i].c[k] / diagonal_[i] + beta[k] * d[i].c[k];
    if (!std::isfinite(rz[0] + rz[1] + rz[2])) return;
  }
  missed_residual_ = residual(p, v);
}

/* ---------------------------------------------------------------------- */

void ConsistentMass::sample(double kT, uint64_t seed, uint64_t step, VertexField &v)
{
  const CounterRandom random(seed, step);
  const double root = std::sqrt(kT);
  scratch_.assign(part_.size(), Vector4{});
  std::vector<std::array<double, 4>> normal;
  for (const FaceNoise &face : face_noise_) {
    const int columns = static_cast<int>(face.root->cols());
    normal.resize(columns);
    for (int j = 0; j < columns; ++j) normal[j] = random.normals(face.label, j);
    for (auto [i, row] : face.owned)
      for (int j = 0; j < columns; ++j)
        for (int k = 0; k < 3; ++k)
          scratch_[i].c[k] += root * face.amplitude * (*face.root)(row, j) * normal[j][k];
  }
  solve(scratch_, v);
}

double ConsistentMass::memory_usage() const
{
  return MassOperator::memory_usage() + 12.0 * rows_.nonZeros() +
      sizeof(double) * diagonal_.capacity() +
      sizeof(Vector4) * (work_.capacity() + scratch_.capacity()) +
      (factor_ ? factor_->memory_usage() : 0.0);
}
