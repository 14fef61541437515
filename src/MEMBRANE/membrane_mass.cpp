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

#include "membrane_mass.h"

#include "membrane_limit_basis.h"
#include "membrane_quadrature.h"
#include "membrane_random.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <unordered_map>

using namespace Membrane_NS;

/* ---------------------------------------------------------------------- */

void VertexPart::gather(const VertexField &owned_values, VertexField &all)
{
  for (int i = 0; i < owned; ++i) all[vertices[i]] = owned_values[i];
}

/* ---------------------------------------------------------------------- */

MassOperator::MassOperator(const Topology &topology, VertexPart &part,
                           const std::vector<double> &masses, const std::vector<uint64_t> &labels,
                           const Settings &settings) :
    settings_(settings), part_(part)
{
  for (int i = 0; i < part.owned; ++i) {
    mass_.push_back(masses[part.vertices[i]]);
    label_.push_back(labels[part.vertices[i]]);
  }
  if (settings.kind == MassKind::VERTEX) build_rings(topology);
  if (settings.kind == MassKind::VERTEX && settings.direct) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int v = 0; v < topology.num_vertices(); ++v) {
      if (masses[v] == 0.0) continue;
      const int n = topology.valence(v);
      const double c = limit_mask_centre(n);
      entries.emplace_back(v, v, n * c / (1.0 - c));
      for (int w : topology.ring(v)) entries.emplace_back(v, w, 1.0);
    }
    factorize(topology, masses, entries);
  }
  if (settings.kind == MassKind::CONSISTENT) build_rows(topology, masses, labels);
}

// local numbers of the vertices of a part

static std::unordered_map<int, int> local_numbers(const VertexPart &part)
{
  std::unordered_map<int, int> local;
  local.reserve(2 * part.size());
  for (int i = 0; i < part.size(); ++i) local.emplace(part.vertices[i], i);
  return local;
}

/* ----------------------------------------------------------------------
   breadth first from the vertices next to the halo; without a halo, and for what cannot be reached
   from it, from the lowest vertex left
------------------------------------------------------------------------- */

void VertexPart::order(const Topology &topology)
{
  std::vector<char> waiting(topology.num_vertices(), 0);
  std::vector<int> lowest(vertices.begin(), vertices.begin() + owned), sorted;
  std::sort(lowest.begin(), lowest.end());
  for (int v : lowest) waiting[v] = 1;
  auto visit = [&](int v) {
    if (!waiting[v]) return;
    waiting[v] = 0;
    sorted.push_back(v);
  };

  const std::vector<char> mine(waiting);
  layers.assign(1, 0);
  for (int v : lowest)
    for (int w : topology.ring(v))
      if (!mine[w]) visit(v);
  auto seed = lowest.begin();
  while ((int) sorted.size() < owned || layers.back() < owned) {
    if (layers.back() == (int) sorted.size()) {
      while (!waiting[*seed]) ++seed;
      visit(*seed);
    }
    const int first = layers.back(), last = static_cast<int>(sorted.size());
    layers.push_back(last);
    for (int i = first; i < last; ++i)
      for (int w : topology.ring(sorted[i])) visit(w);
  }
  std::copy(sorted.begin(), sorted.end(), vertices.begin());
}

/* ----------------------------------------------------------------------
   VERTEX
------------------------------------------------------------------------- */

double Membrane_NS::limit_mask_lowest(const Topology &topology)
{
  std::map<Valences, double> smallest;
  double lowest = 1.0;
  for (const Face &face : topology.faces()) {
    Valences n;
    for (int k = 0; k < 3; ++k) n[k] = topology.valence(face[k]);
    std::sort(n.begin(), n.end());
    const auto [found, added] = smallest.emplace(n, 1.0);
    if (!added) continue;
    Eigen::Matrix3d s = Eigen::Matrix3d::Constant(0.5), inverse_e = Eigen::Matrix3d::Zero();
    for (int k = 0; k < 3; ++k) {
      const double c = limit_mask_centre(n[k]);
      s(k, k) = c / (1.0 - c);
      inverse_e(k, k) = 1.0 / (1.0 - c);
    }
    found->second =
        Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d>(s, inverse_e).eigenvalues()[0];
    lowest = std::min(lowest, found->second);
  }
  return lowest;
}

void MassOperator::build_rings(const Topology &topology)
{
  const auto local = local_numbers(part_);
  ring_start_.assign(1, 0);
  for (int i = 0; i < part_.owned; ++i) {
    const int v = part_.vertices[i], n = topology.valence(v);
    centre_.push_back(limit_mask_centre(n));
    spoke_.push_back((1.0 - centre_.back()) / n);
    for (int w : topology.ring(v)) ring_.push_back(local.at(w));
    ring_start_.push_back(static_cast<int>(ring_.size()));
  }
  lowest_ = limit_mask_lowest(topology);

  // Chebyshev's error bound: 2 rate^k

  const double root = std::sqrt(lowest_), rate = (1.0 - root) / (1.0 + root);
  passes_ = std::max(1, (int) std::ceil(std::log(0.5 * settings_.tolerance) / std::log(rate)));
}

namespace {

// sum over a ring; nearly all have six vertices
inline Quad ring_sum(const int *ring, int n, const Vector4 *x)
{
  if (n == 6)
    return (quad(x[ring[0]]) + quad(x[ring[1]])) + (quad(x[ring[2]]) + quad(x[ring[3]])) +
        (quad(x[ring[4]]) + quad(x[ring[5]]));
  Quad sum = {};
  for (int j = 0; j < n; ++j) sum += quad(x[ring[j]]);
  return sum;
}

}    // namespace

// y = L x on owned vertices

void MassOperator::apply_mask(VertexField &x, VertexField &y)
{
  part_.fill_halo(x);
  for (int i = 0; i < part_.owned; ++i) {
    const int start = ring_start_[i], n = ring_start_[i + 1] - start;
    quad(y[i]) = centre_[i] * quad(x[i]) + spoke_[i] * ring_sum(&ring_[start], n, x.data());
  }
}

/* ----------------------------------------------------------------------
   Chebyshev's semi-iterative method for L x = b [G. Golub and C. Van Loan, Matrix Computations,
   4th ed., 11.2.8]: x_k+1 = x_k-1 + omega_k+1 (x_k - x_k-1 + (b - L x_k)/theta). It keeps two iterates
   only, and the new one takes the place of the one before last.

   On one rank several passes follow one another through the layers of the mesh, each a layer
   behind the last, so that a vertex is in the cache for all of them. On several ranks the halo travels
   while the inner vertices are done.
------------------------------------------------------------------------- */

void MassOperator::chebyshev_pass(int first, int last, double omega, const VertexField &b,
                                  const VertexField &x, VertexField &y) const
{
  const double scale = 2.0 * omega / (1.0 + lowest_);
  const Vector4 *now = x.data(), *rhs = b.data();
  const int *starts = ring_start_.data(), *ring = ring_.data();
  const double *c = centre_.data(), *e = spoke_.data();
  Vector4 *out = y.data();
  for (int i = first; i < last; ++i) {
    const Quad sum = ring_sum(ring + starts[i], starts[i + 1] - starts[i], now);
    const Quad before = quad(out[i]), here = quad(now[i]);
    quad(out[i]) = before + omega * (here - before) +
        scale * (quad(rhs[i]) - c[i] * here - e[i] * sum);
  }
}

void MassOperator::solve_mask(const VertexField &b, VertexField &x)
{
  if (!factor_) return chebyshev(b, x);
  x.resize(part_.size());
  for (int i = 0; i < part_.owned; ++i) quad(x[i]) = quad(b[i]) / spoke_[i];
  solve_direct(x, x);
}

void MassOperator::solve_mask(const VertexField &b, const VertexField &c, VertexField &x,
                              VertexField &y)
{
  if (!factor_) {
    chebyshev(b, x);
    chebyshev(c, y);
    return;
  }
  x.resize(part_.size());
  y.resize(part_.size());
  for (int i = 0; i < part_.owned; ++i) {
    quad(x[i]) = quad(b[i]) / spoke_[i];
    quad(y[i]) = quad(c[i]) / spoke_[i];
  }
  part_.gather(x, whole_);
  part_.gather(y, other_);
  factor_->solve(whole_, other_);
  for (int i = 0; i < part_.owned; ++i) {
    x[i] = whole_[part_.vertices[i]];
    y[i] = other_[part_.vertices[i]];
  }
}

void MassOperator::chebyshev(const VertexField &b, VertexField &x)
{
  constexpr int TOGETHER = 8;    // passes: their layers fit into a second-level cache
  const int n = part_.owned;
  const double theta = 0.5 * (1.0 + lowest_), sigma = theta / (0.5 * (1.0 - lowest_));
  previous_.resize(part_.size());
  x.resize(part_.size());

  // the iterates take turns in two fields, such that the last is x

  VertexField *field[2] = {&x, &previous_};
  if (passes_ % 2) std::swap(field[0], field[1]);
  for (int i = 0; i < n; ++i) {
    quad((*field[0])[i]) = Quad{};
    quad((*field[1])[i]) = quad(b[i]) / theta;
  }
  std::vector<double> omega(passes_, 2.0);
  for (int k = 1; k < passes_; ++k) omega[k] = 1.0 / (1.0 - 0.25 * omega[k - 1] / (sigma * sigma));

  if (part_.size() > n) {
    for (int k = 1; k < passes_; ++k) {
      VertexField &now = *field[k % 2], &next = *field[(k + 1) % 2];
      part_.begin_halo(now);
      chebyshev_pass(part_.layers[1], n, omega[k], b, now, next);
      part_.end_halo(now);
      chebyshev_pass(0, part_.layers[1], omega[k], b, now, next);
    }
  } else {
    const int nlayers = static_cast<int>(part_.layers.size()) - 1;
    for (int k = 1; k < passes_; k += TOGETHER) {
      const int passes = std::min(TOGETHER, passes_ - k);
      for (int front = 0; front < nlayers + passes - 1; ++front)
        for (int j = std::max(0, front - nlayers + 1); j < std::min(passes, front + 1); ++j)
          chebyshev_pass(part_.layers[front - j], part_.layers[front - j + 1], omega[k + j], b,
                         *field[(k + j) % 2], *field[(k + j + 1) % 2]);
    }
  }
  iterations_ = passes_;
}

/* ----------------------------------------------------------------------
   CONSISTENT: the matrix of a face of unit mass, by a rule that is exact for it
------------------------------------------------------------------------- */

// integral over the face's own parameters of phi_k phi_l, times 2; recursion over the children
static Eigen::MatrixXd face_matrix(const Valences &valences)
{
  const LimitBasis basis(valences);
  if (basis.is_regular()) {
    const TriangleRule rule = triangle_rule(Quadrature::CAREFUL);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(12, 12);
    for (int q = 0; q < rule.size(); ++q) {
      const Eigen::VectorXd w =
          box_spline(rule.u[q], rule.v[q]).row(LimitBasis::VALUE).transpose();
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

void MassOperator::build_rows(const Topology &topology, const std::vector<double> &masses,
                              const std::vector<uint64_t> &labels)
{
  const auto local = local_numbers(part_);
  std::map<Valences, Eigen::MatrixXd> matrices;
  std::vector<Eigen::Triplet<double>> entries, all;
  std::vector<int> stencil;
  for (int f = 0; f < topology.num_faces(); ++f) {
    topology.stencil(f, stencil);
    FaceNoise noise;
    for (size_t k = 0; k < stencil.size(); ++k) {
      const auto found = local.find(stencil[k]);
      if (found != local.end() && found->second < part_.owned)
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
    if (!noise.owned.empty()) noise_.push_back(std::move(noise));
  }

  rows_.resize(part_.owned, part_.size());
  rows_.setFromTriplets(entries.begin(), entries.end());
  for (int i = 0; i < part_.owned; ++i) diagonal_.push_back(rows_.coeff(i, i));
  if (settings_.direct) factorize(topology, masses, all);
}

void MassOperator::factorize(const Topology &topology, const std::vector<double> &masses,
                             std::vector<Eigen::Triplet<double>> &entries)
{
  Eigen::SparseMatrix<double> matrix(topology.num_vertices(), topology.num_vertices());
  for (int v = 0; v < topology.num_vertices(); ++v)
    if (masses[v] == 0.0) entries.emplace_back(v, v, 1.0);    // not of this operator
  matrix.setFromTriplets(entries.begin(), entries.end());
  factor_ = std::make_unique<SparseCholesky>(matrix);
  whole_.assign(topology.num_vertices(), Vector4{});
  other_ = whole_;
}

void MassOperator::solve_direct(const VertexField &b, VertexField &x)
{
  part_.gather(b, whole_);
  factor_->solve(whole_);
  for (int i = 0; i < part_.owned; ++i) x[i] = whole_[part_.vertices[i]];
  iterations_ = 1;
}

/* ----------------------------------------------------------------------
   preconditioned conjugate gradients, x, y and z at once with inner products of their own
------------------------------------------------------------------------- */

void MassOperator::conjugate_gradients(const VertexField &p, VertexField &v)
{
  constexpr int MOST = 1000;
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

  for (iterations_ = 0; iterations_ < MOST; ++iterations_) {
    bool done = true;
    for (int k = 0; k < 3; ++k)
      done = done && rz[k] <= settings_.tolerance * settings_.tolerance * norm[k];
    if (done) break;
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
  }
}

/* ---------------------------------------------------------------------- */

void MassOperator::multiply(const VertexField &v, VertexField &p)
{
  const int n = part_.owned;
  work_.resize(part_.size());
  if (settings_.kind == MassKind::LUMPED) {
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < 4; ++k) p[i].c[k] = mass_[i] * v[i].c[k];
    return;
  }
  std::copy_n(v.begin(), n, work_.begin());
  if (settings_.kind == MassKind::CONSISTENT) {
    part_.fill_halo(work_);
    for (int i = 0; i < n; ++i) {
      Vector4 sum = {};
      for (decltype(rows_)::InnerIterator entry(rows_, i); entry; ++entry)
        for (int k = 0; k < 4; ++k) sum.c[k] += entry.value() * work_[entry.col()].c[k];
      p[i] = sum;
    }
    return;
  }

  // L^T D L v, with L^T x = (1/e) L (e x)

  scratch_.resize(part_.size());
  apply_mask(work_, scratch_);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < 4; ++k) scratch_[i].c[k] *= mass_[i] * spoke_[i];
  apply_mask(scratch_, p);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < 4; ++k) p[i].c[k] /= spoke_[i];
}

void MassOperator::solve(const VertexField &p, VertexField &v)
{
  const int n = part_.owned;
  switch (settings_.kind) {
    case MassKind::LUMPED:
      for (int i = 0; i < n; ++i)
        for (int k = 0; k < 4; ++k) v[i].c[k] = p[i].c[k] / mass_[i];
      iterations_ = 1;
      return;
    case MassKind::CONSISTENT:
      if (factor_) return solve_direct(p, v);
      return conjugate_gradients(p, v);
    case MassKind::VERTEX:
      // L^-T p = (1/e) L^-1 (e p), then L^-1 D^-1

      work_.resize(part_.size());
      for (int i = 0; i < n; ++i)
        for (int k = 0; k < 4; ++k) work_[i].c[k] = spoke_[i] * p[i].c[k];
      solve_mask(work_, v);
      for (int i = 0; i < n; ++i)
        for (int k = 0; k < 4; ++k) work_[i].c[k] = v[i].c[k] / (spoke_[i] * mass_[i]);
      solve_mask(work_, v);
      iterations_ *= 2;
  }
}

/* ---------------------------------------------------------------------- */

void MassOperator::sample(double kT, uint64_t seed, uint64_t step, VertexField &v)
{
  const CounterRandom random(seed, step);
  const int n = part_.owned;
  const double root = std::sqrt(kT);

  if (settings_.kind == MassKind::CONSISTENT) {
    scratch_.assign(part_.size(), Vector4{});
    std::vector<std::array<double, 4>> normal;
    for (const FaceNoise &face : noise_) {
      const int columns = static_cast<int>(face.root->cols());
      normal.resize(columns);
      for (int j = 0; j < columns; ++j) normal[j] = random.normals(face.label, j);
      for (auto [i, row] : face.owned)
        for (int j = 0; j < columns; ++j)
          for (int k = 0; k < 3; ++k)
            scratch_[i].c[k] += root * face.amplitude * (*face.root)(row, j) * normal[j][k];
    }
    solve(scratch_, v);
    return;
  }

  VertexField &w = settings_.kind == MassKind::VERTEX ? scratch_ : v;
  w.resize(part_.size());
  for (int i = 0; i < n; ++i) {
    const auto normal = random.normals(label_[i]);
    const double spread = root / std::sqrt(mass_[i]);
    for (int k = 0; k < 3; ++k) w[i].c[k] = spread * normal[k];
    w[i].c[3] = 0.0;
  }
  if (settings_.kind == MassKind::VERTEX) solve_mask(scratch_, v);
}

/* ---------------------------------------------------------------------- */

void MassOperator::relax(double keep, double kT, uint64_t seed, uint64_t step, VertexField &v)
{
  kick_.resize(part_.size());
  sample((1.0 - keep * keep) * kT, seed, step, kick_);
  for (int i = 0; i < part_.owned; ++i)
    for (int k = 0; k < 3; ++k) v[i].c[k] = keep * v[i].c[k] + kick_[i].c[k];
}

void MassOperator::relax(const std::vector<double> &keep, double kT, uint64_t seed, uint64_t step,
                         VertexField &v)
{
  const CounterRandom random(seed, step);
  scratch_.resize(part_.size());
  if (settings_.kind == MassKind::VERTEX) {
    work_ = v;
    work_.resize(part_.size());
    apply_mask(work_, scratch_);
  } else
    std::copy_n(v.begin(), part_.owned, scratch_.begin());
  for (int i = 0; i < part_.owned; ++i) {
    const auto normal = random.normals(label_[i]);
    const double spread = std::sqrt((1.0 - keep[i] * keep[i]) * kT / mass_[i]);
    for (int k = 0; k < 3; ++k)
      scratch_[i].c[k] = keep[i] * scratch_[i].c[k] + spread * normal[k];
  }
  if (settings_.kind == MassKind::VERTEX)
    solve_mask(scratch_, v);
  else
    std::copy_n(scratch_.begin(), part_.owned, v.begin());
}

/* ---------------------------------------------------------------------- */

double MassOperator::residual(const VertexField &p, const VertexField &v)
{
  VertexField product(part_.size());
  multiply(v, product);
  double sums[2] = {0.0, 0.0};
  for (int i = 0; i < part_.owned; ++i)
    for (int k = 0; k < 3; ++k) {
      const double d = p[i].c[k] - product[i].c[k];
      sums[0] += d * d;
      sums[1] += p[i].c[k] * p[i].c[k];
    }
  part_.sum(sums, 2);
  return sums[1] > 0.0 ? std::sqrt(sums[0] / sums[1]) : std::sqrt(sums[0]);
}

double MassOperator::memory_usage() const
{
  return sizeof(Vector4) * (previous_.capacity() + work_.capacity() + scratch_.capacity() +
                            kick_.capacity() + whole_.capacity() + other_.capacity()) +
      sizeof(int) * (ring_.capacity() + ring_start_.capacity()) + 12.0 * rows_.nonZeros() +
      (factor_ ? factor_->memory_usage() : 0.0);
}
