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

#include "membrane_mass_modes.h"

#include "membrane_random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

using namespace Membrane_NS;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// modes whose shares of one another leave less than this of any are not told apart
static constexpr double SMALLEST_PIVOT = 1.0e-6;

/* ---------------------------------------------------------------------- */

ModalMass::ModalMass(const VertexMasses &vertices, std::unique_ptr<MassOperator> full, const SharedModes &modes,
                     bool drag, const MatrixXd &gram) :
    MassOperator(vertices.part), space_(modes.now), full_(std::move(full)), drag_(drag),
    friction_(modes.friction), count_(modes.now->count()), gram_(gram)
{
  find_membranes();
  if (gram_.rows() != count_) find_gram();
  factor_.compute(gram_);
  const MatrixXd pivots = factor_.matrixLLT();
  for (int k = 0; k < count_; ++k)
    if (factor_.info() != Eigen::Success || !(pivots(k, k) * pivots(k, k) > SMALLEST_PIVOT * gram_(k, k)))
      throw MeshError("the control points of the membrane cannot tell its modes apart: refine the mesh, or choose "
                      "fewer modes");
  if (!friction_.empty()) find_decay();
}

void ModalMass::find_membranes()
{
  const auto local = part_.local_numbers();
  int first = 0;
  for (const MembraneModes &modes : space_->membranes) {
    Membrane membrane = {&modes, first, {}, {}};
    const int blocks = modes.functions / LANES;
    for (size_t row = 0; row < modes.vertices.size(); ++row) {
      const auto found = local.find(modes.vertices[row]);
      if (found == local.end() || found->second >= part_.owned) continue;
      membrane.local.push_back(found->second);
      const auto begin = modes.psi.begin() + row * blocks;
      membrane.psi.insert(membrane.psi.end(), begin, begin + blocks);
    }
    first += static_cast<int>(modes.modes.size());
    membranes_.push_back(std::move(membrane));
  }
}

void ModalMass::find_gram()
{
  gram_.resize(count_, count_);
  VertexField v(part_.size(), Vector4{}), p(part_.size(), Vector4{});
  for (int k = 0; k < count_; ++k) {
    expand(VectorXd::Unit(count_, k), v);
    full_->multiply(v, p);
    gram_.col(k) = project(p);
  }
  gram_ = (0.5 * (gram_ + gram_.transpose())).eval();
}

void ModalMass::find_decay()
{
  const MatrixXd inverse = factor_.matrixU().solve(MatrixXd::Identity(count_, count_));
  const MatrixXd friction = Eigen::Map<const VectorXd>(friction_.data(), count_).asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(inverse.transpose() * friction * inverse);
  turn_ = solver.eigenvectors();
  decay_ = inverse * turn_;
  rates_ = solver.eigenvalues();
}

/* ----------------------------------------------------------------------
   Sums over vertices of psi_ij f_i, and then those of the modes. Modes are read once and in order, ROWS rows at a time:
   the sums are read and written as often, from the cache next to the core
------------------------------------------------------------------------- */

template <int ROWS>
static inline void add_products(const Lane *psi, int blocks, const double *const (&f)[2], Lane *x, Lane *y, Lane *z)
{
  double force[ROWS][3];
  for (int i = 0; i < ROWS; ++i) std::copy_n(f[i], 3, force[i]);
  for (int j = 0; j < blocks; ++j) {
    Lane sx = x[j], sy = y[j], sz = z[j];
    for (int i = 0; i < ROWS; ++i) {
      const Lane here = psi[i * blocks + j];
      sx += here * force[i][0];
      sy += here * force[i][1];
      sz += here * force[i][2];
    }
    x[j] = sx;
    y[j] = sy;
    z[j] = sz;
  }
}

VectorXd ModalMass::project(const VertexField &f) const
{
  size_t total = 0;
  for (const Membrane &membrane : membranes_) total += membrane.modes->functions / LANES;
  std::vector<Lane> sums(3 * total, Lane{});
  size_t place = 0;
  for (const Membrane &membrane : membranes_) {
    const int blocks = membrane.modes->functions / LANES;
    const size_t rows = membrane.local.size();
    Lane *x = &sums[place], *y = x + blocks, *z = y + blocks;
    const Lane *psi = membrane.psi.data();
    size_t i = 0;
    for (; i + 2 <= rows; i += 2, psi += 2 * blocks)
      add_products<2>(psi, blocks, {f[membrane.local[i]].c, f[membrane.local[i + 1]].c}, x, y, z);
    if (i < rows) add_products<1>(psi, blocks, {f[membrane.local[i]].c, nullptr}, x, y, z);
    place += 3 * blocks;
  }
  VectorXd all(3 * total * LANES), a(count_);
  std::memcpy(all.data(), sums.data(), sizeof(Lane) * sums.size());
  part_.sum(all.data(), static_cast<int>(all.size()));
  const double *numbers = all.data();
  for (const Membrane &membrane : membranes_) {
    const int size = 3 * membrane.modes->functions;
    a.segment(membrane.first, membrane.modes->modes.size()) =
        membrane.modes->couple.transpose() * Eigen::Map<const VectorXd>(numbers, size);
    numbers += size;
  }
  return a;
}

void ModalMass::expand(const VectorXd &a, VertexField &v) const
{
  expand<1>({&a}, {&v});
}

// reading the modes is what takes time: N fields at once

template <int N>
void ModalMass::expand(const std::array<const VectorXd *, N> &a, const std::array<VertexField *, N> &v) const
{
  std::vector<Lane> vectors;
  for (const Membrane &membrane : membranes_) {
    const int blocks = membrane.modes->functions / LANES;
    vectors.resize(3 * static_cast<size_t>(N * blocks));
    for (int n = 0; n < N; ++n) {
      const VectorXd numbers = membrane.modes->couple * a[n]->segment(membrane.first, membrane.modes->modes.size());
      std::memcpy(&vectors[3 * static_cast<size_t>(n * blocks)], numbers.data(), 3 * sizeof(Lane) * blocks);
    }
    for (size_t i = 0; i < membrane.local.size(); ++i) {
      const Lane *psi = &membrane.psi[i * blocks];
      Lane sum[3 * N] = {};
      for (int j = 0; j < blocks; ++j)
        for (int k = 0; k < 3 * N; ++k) sum[k] += psi[j] * vectors[k * blocks + j];
      for (int n = 0; n < N; ++n) {
        double *to = (*v[n])[membrane.local[i]].c;
        for (int k = 0; k < 3; ++k) {
          to[k] = 0.0;
          for (int l = 0; l < LANES; ++l) to[k] += sum[3 * n + k][l];
        }
        to[3] = 0.0;
      }
    }
  }
}

VectorXd ModalMass::amplitudes(const VertexField &v)
{
  momentum_.resize(part_.size());
  full_->multiply(v, momentum_);
  return factor_.solve(project(momentum_));
}

/* ----------------------------------------------------------------------
   momenta of modes p: M v of the full matrix, which has Phi^T M v = G adot; where friction of the modes stands for G,
   M Phi G^-1 friction adot, of which the same is true
------------------------------------------------------------------------- */

void ModalMass::multiply(const VertexField &v, VertexField &p)
{
  if (!is_drag_of_modes()) {
    full_->multiply(v, p);
    return;
  }
  VectorXd a = amplitudes(v);
  for (int k = 0; k < count_; ++k) a[k] *= friction_[k];
  work_.resize(part_.size());
  expand(factor_.solve(a), work_);
  full_->multiply(work_, p);
}

VectorXd ModalMass::response(const VertexField &p) const
{
  VectorXd a = project(p);
  if (is_drag_of_modes())
    for (int k = 0; k < count_; ++k) a[k] /= friction_[k];
  else
    factor_.solveInPlace(a);
  return a;
}

void ModalMass::solve(const VertexField &p, VertexField &v)
{
  expand(response(p), v);
}

VectorXd ModalMass::white(uint64_t seed, uint64_t step) const
{
  const CounterRandom random(seed, step);
  VectorXd z(count_);
  for (int k = 0; k < count_; k += 4) {
    const auto normal = random.normals(k / 4);
    for (int l = k; l < std::min(k + 4, count_); ++l) z[l] = normal[l - k];
  }
  return z;
}

VectorXd ModalMass::unit_noise(uint64_t seed, uint64_t step) const
{
  VectorXd z = white(seed, step);
  if (is_drag_of_modes())
    for (int k = 0; k < count_; ++k) z[k] /= std::sqrt(friction_[k]);
  else
    factor_.matrixU().solveInPlace(z);
  return z;
}

void ModalMass::sample(double kT, uint64_t seed, uint64_t step, VertexField &v)
{
  expand(std::sqrt(kT) * unit_noise(seed, step), v);
}

void ModalMass::solve_with_noise(const VertexField &p, VertexField &v, uint64_t seed, uint64_t step, VertexField &z)
{
  const VectorXd a = response(p), b = unit_noise(seed, step);
  expand<2>({&a, &b}, {&v, &z});
}

/* ----------------------------------------------------------------------
   With G = U^T U and Q the eigenvectors of U^-T friction U^-1, adot = W b, W = U^-1 Q, turns G adot' = -friction adot
   + noise into b' = -rates b + noise, each for itself; b = W^T G adot. Many rates are the same and Q is any rotation
   among these: white noise is turned by it, too, so that the outcome does not depend on which
------------------------------------------------------------------------- */

void ModalMass::relax_own(double time, double kT, uint64_t seed, uint64_t step, VertexField &v)
{
  momentum_.resize(part_.size());
  full_->multiply(v, momentum_);
  VectorXd b = decay_.transpose() * project(momentum_);
  const VectorXd z = turn_.transpose() * white(seed, step);
  for (int k = 0; k < count_; ++k) {
    const double keep = std::exp(-rates_[k] * time);
    b[k] = keep * b[k] + std::sqrt((1.0 - keep * keep) * kT) * z[k];
  }
  expand(decay_ * b, v);
}

double ModalMass::memory_usage() const
{
  double bytes = MassOperator::memory_usage() + full_->memory_usage() +
      sizeof(double) * (gram_.size() * 3.0 + 2.0 * decay_.size()) + sizeof(Vector4) * (work_.capacity() + momentum_.capacity());
  for (const Membrane &membrane : membranes_)
    bytes += sizeof(Lane) * membrane.psi.capacity() + sizeof(int) * membrane.local.capacity();
  return bytes + space_->memory_usage();
}
