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

#include "membrane_limit_mask.h"

#include "membrane_limit_basis.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <map>

using namespace Membrane_NS;

static const double C_OF_SIX = limit_mask_centre(6);

/* ---------------------------------------------------------------------- */

double Membrane_NS::limit_mask_lowest(const Topology &topology)
{
  std::map<Valences, double> smallest;
  double lowest = 1.0;
  for (int f = 0; f < topology.num_faces(); ++f) {
    Valences n = topology.valences(f);
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

/* ---------------------------------------------------------------------- */

LimitMask::LimitMask(const Topology &topology, VertexPart &part, const Solver &solver) :
    part_(part), lowest_(limit_mask_lowest(topology))
{
  const auto local = part.local_numbers();
  ring_start_.assign(1, 0);
  for (int i = 0; i < part.owned; ++i) {
    const int v = part.vertices[i], n = topology.valence(v);
    centre_.push_back(limit_mask_centre(n));
    spoke_.push_back((1.0 - centre_.back()) / n);
    for (int w : topology.ring(v)) ring_.push_back(sizeof(Vector4) * local.at(w));
    ring_start_.push_back(static_cast<int>(ring_.size()));
  }

  find_weights(solver.tolerance);
  if (solver.direct) factorize(topology);
}

/* ----------------------------------------------------------------------
   as many passes as Chebyshev's error bound 2 rate^k takes. In halves, the fourth number begins anew with the
   pass `half_`, from x_1 of its second right-hand side and x_0 = 0
------------------------------------------------------------------------- */

void LimitMask::find_weights(double tolerance)
{
  const double root = std::sqrt(lowest_), rate = (1.0 - root) / (1.0 + root);
  const double sigma = (1.0 + lowest_) / (1.0 - lowest_);
  num_passes_ = std::max(1, (int) std::ceil(std::log(0.5 * tolerance) / std::log(rate)));
  half_ = (num_passes_ + 1) / 2;
  tolerance_of_half_ = 2.0 * std::pow(rate, half_);

  double omega = 2.0;
  for (int k = 1; k < num_passes_; ++k) {
    omega = 1.0 / (1.0 - 0.25 * omega / (sigma * sigma));
    weights_.push_back({omega + Quad{}, 1.0 - omega + Quad{}, omega * first_step() + Quad{}});
  }
  weights_of_halves_ = weights_;
  for (int k = half_; k < num_passes_; ++k) {
    Weights &w = weights_of_halves_[k - 1];
    const Weights &anew = weights_[k - half_];
    w.now[3] = anew.now[3];
    w.before[3] = k == half_ ? 0.0 : anew.before[3];
    w.step[3] = anew.step[3];
  }
}

/* ----------------------------------------------------------------------
   S = diag(n c/(1 - c)) + adjacency, and 1 for vertices that no rank's part has
------------------------------------------------------------------------- */

void LimitMask::factorize(const Topology &topology)
{
  const int n = topology.num_vertices();
  VertexField one(part_.size(), Vector4{{1.0}}), in_part(n, Vector4{});
  part_.gather(one, in_part);
  std::vector<Eigen::Triplet<double>> entries;
  for (int v = 0; v < n; ++v) {
    if (in_part[v].c[0] == 0.0) {
      entries.emplace_back(v, v, 1.0);
      continue;
    }
    const int valence = topology.valence(v);
    const double c = limit_mask_centre(valence);
    entries.emplace_back(v, v, valence * c / (1.0 - c));
    for (int w : topology.ring(v)) entries.emplace_back(v, w, 1.0);
  }
  Eigen::SparseMatrix<double> s(n, n);
  s.setFromTriplets(entries.begin(), entries.end());
  factor_ = std::make_unique<PartCholesky>(part_, s);
}

/* ---------------------------------------------------------------------- */

namespace {

const Quad &at(const Vector4 *x, uint32_t place)
{
  return *reinterpret_cast<const Quad *>(reinterpret_cast<const char *>(x) + place);
}

// sums over rings; nearly all have six vertices

Quad sum_of_six(const uint32_t *ring, const Vector4 *x)
{
  return (at(x, ring[0]) + at(x, ring[1])) + (at(x, ring[2]) + at(x, ring[3])) + (at(x, ring[4]) + at(x, ring[5]));
}

Quad ring_sum(const uint32_t *ring, int n, const Vector4 *x)
{
  if (n == 6) return sum_of_six(ring, x);
  Quad sum = {};
  for (int j = 0; j < n; ++j) sum += at(x, ring[j]);
  return sum;
}

}    // namespace

void LimitMask::apply(VertexField &x, VertexField &y)
{
  part_.fill_halo(x);
  for (int i = 0; i < part_.owned; ++i) {
    const int start = ring_start_[i], n = ring_start_[i + 1] - start;
    quad(y[i]) = centre_[i] * quad(x[i]) + spoke_[i] * ring_sum(&ring_[start], n, x.data());
  }
}

/* ---------------------------------------------------------------------- */

void LimitMask::solve(const VertexField &b, VertexField &x)
{
  if (!factor_) return chebyshev(b, x, weights_, [](int, int, int, VertexField &) {});
  x.resize(part_.size());
  for (int i = 0; i < part_.owned; ++i) quad(x[i]) = quad(b[i]) / spoke_[i];
  factor_->solve(x);
}

void LimitMask::solve(const VertexField &b, const VertexField &c, VertexField &x, VertexField &y)
{
  if (!factor_) {
    solve(b, x);
    solve(c, y);
    return;
  }
  x.resize(part_.size());
  y.resize(part_.size());
  for (int i = 0; i < part_.owned; ++i) {
    quad(x[i]) = quad(b[i]) / spoke_[i];
    quad(y[i]) = quad(c[i]) / spoke_[i];
  }
  factor_->solve(x, y);
}

void LimitMask::solve(VertexField &b, VertexField &x, std::vector<double> &other)
{
  chebyshev(b, x, weights_of_halves_, [&](int pass, int first, int last, VertexField &now) {
    if (pass != half_ - 1) return;
    for (int i = first; i < last; ++i) {
      b[i].c[3] = other[i];
      other[i] = now[i].c[3];
      now[i].c[3] = first_step() * b[i].c[3];
    }
  });
}

/* ----------------------------------------------------------------------
   Chebyshev's semi-iterative method for L x = b [G. Golub and C. Van Loan, Matrix Computations,
   4th ed., 11.2.8]: x_k+1 = x_k-1 + omega_k+1 (x_k - x_k-1 + (b - L x_k)/theta). It keeps two iterates
   only, and the new one takes the place of the one before last.

   On one rank several passes follow one another through the layers of the mesh, each a layer
   behind the last, so that a vertex is in the cache for all of them. On several ranks the halo travels
   while the inner vertices are done. `after` sees each piece of a pass when it is done.
------------------------------------------------------------------------- */

void LimitMask::chebyshev_pass(int first, int last, const Weights &weights, const VertexField &b,
                               const VertexField &x, VertexField &y) const
{
  const Weights w = weights;
  const Vector4 *now = x.data(), *rhs = b.data();
  const int *starts = ring_start_.data();
  const uint32_t *ring = ring_.data() + starts[first];
  Vector4 *out = y.data();

  // of y = before y + here x + around (the ring's x) + step b

  const Quad here_of_six = w.now - C_OF_SIX * w.step, around_of_six = (C_OF_SIX - 1.0) / 6.0 * w.step;
  for (int i = first; i < last; ++i) {
    const int n = starts[i + 1] - starts[i];
    const Quad known = w.before * quad(out[i]) + w.step * quad(rhs[i]);
    if (n == 6)
      quad(out[i]) = known + here_of_six * quad(now[i]) + around_of_six * sum_of_six(ring, now);
    else
      quad(out[i]) = known + (w.now - centre_[i] * w.step) * quad(now[i]) -
          spoke_[i] * w.step * ring_sum(ring, n, now);
    ring += n;
  }
}

template <class After>
void LimitMask::chebyshev(const VertexField &b, VertexField &x, const std::vector<Weights> &weights,
                          const After &after)
{
  constexpr int TOGETHER = 8;    // passes: their layers fit into a second-level cache
  const int n = part_.owned;
  previous_.resize(part_.size());
  x.resize(part_.size());

  // the iterates take turns in two fields, such that the last is x

  VertexField *field[2] = {&x, &previous_};
  if (num_passes_ % 2) std::swap(field[0], field[1]);
  for (int i = 0; i < n; ++i) {
    quad((*field[0])[i]) = Quad{};
    quad((*field[1])[i]) = first_step() * quad(b[i]);
  }
  const auto pass = [&](int k, int first, int last) {
    VertexField &next = *field[(k + 1) % 2];
    chebyshev_pass(first, last, weights[k - 1], b, *field[k % 2], next);
    after(k, first, last, next);
  };

  if (part_.size() > n) {
    for (int k = 1; k < num_passes_; ++k) {
      part_.begin_halo(*field[k % 2]);
      pass(k, part_.layers[1], n);
      part_.end_halo(*field[k % 2]);
      pass(k, 0, part_.layers[1]);
    }
  } else {
    const int nlayers = static_cast<int>(part_.layers.size()) - 1;
    for (int k = 1; k < num_passes_; k += TOGETHER) {
      const int depth = std::min(TOGETHER, num_passes_ - k);
      for (int front = 0; front < nlayers + depth - 1; ++front)
        for (int j = std::max(0, front - nlayers + 1); j < std::min(depth, front + 1); ++j)
          pass(k + j, part_.layers[front - j], part_.layers[front - j + 1]);
    }
  }
}

/* ---------------------------------------------------------------------- */

double LimitMask::memory_usage() const
{
  return sizeof(Vector4) * previous_.capacity() +
      sizeof(int) * ring_start_.capacity() + sizeof(uint32_t) * ring_.capacity() +
      sizeof(double) * (centre_.capacity() + spoke_.capacity()) +
      (factor_ ? factor_->memory_usage() : 0.0);
}
