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

#include "membrane_srd_inverse_mask.h"

#include "membrane_limit_basis.h"

#include <algorithm>
#include <cmath>

using namespace Membrane_NS;

static constexpr double TOLERANCE = 1.0e-16;
// known rows are dropped when they have so many entries in all
static constexpr size_t MOST_ENTRIES = 8000000;

/* ---------------------------------------------------------------------- */

InverseMask::InverseMask(const Topology &topology) : topology_(topology)
{
  const int n = topology.num_vertices();
  for (int v = 0; v < n; ++v) {
    centre_.push_back(limit_mask_centre(topology.valence(v)));
    spoke_.push_back((1.0 - centre_.back()) / topology.valence(v));
    lowest_ = std::min(lowest_, 0.5 * (3.0 * centre_.back() - 1.0));    // see MassOperator
  }
  const double root = std::sqrt(lowest_), rate = (1.0 - root) / (1.0 + root);
  passes_ = std::max(1, (int) std::ceil(std::log(0.5 * TOLERANCE) / std::log(rate)));
  for (auto *field : {&x_, &residual_, &step_, &next_}) field->assign(n, 0.0);
  reached_.assign(n, 0);
}

void InverseMask::renumber(const std::vector<int> &vertices)
{
  known_.clear();
  entries_ = 0;
  vertices_ = vertices;
  number_.assign(topology_.num_vertices(), -1);
  for (size_t i = 0; i < vertices.size(); ++i) number_[vertices[i]] = static_cast<int>(i);
}

const ControlWeights::Row &InverseMask::row(int v)
{
  const auto found = known_.find(v);
  if (found != known_.end()) return found->second;
  if (entries_ > MOST_ENTRIES) {
    known_.clear();
    entries_ = 0;
  }
  Row &row = known_[v] = solve(vertices_.empty() ? v : vertices_[v]);
  if (!vertices_.empty())
    for (int &a : row.vertex) a = number_[a];
  entries_ += row.vertex.size();
  return row;
}

/* ----------------------------------------------------------------------
   row v of L^-1 is y with L^T y = 1 at v. With e the spokes, L = diag(e) S and S symmetric, so L (e
   y) = e at v: Chebyshev's iteration as in MassOperator, on vertices that it has reached so far
------------------------------------------------------------------------- */

ControlWeights::Row InverseMask::solve(int v)
{
  const double theta = 0.5 * (1.0 + lowest_), delta = 0.5 * (1.0 - lowest_);
  const double sigma = theta / delta;
  double rho = 1.0 / sigma;

  std::vector<int> active = {v};
  size_t front = 0;    // where the outermost ring begins
  reached_[v] = 1;
  residual_[v] = spoke_[v];
  step_[v] = spoke_[v] / theta;
  for (int pass = 0; pass < passes_; ++pass) {
    const size_t end = active.size();
    for (; front < end; ++front)
      for (int w : topology_.ring(active[front]))
        if (!reached_[w]) {
          reached_[w] = 1;
          active.push_back(w);
        }
    const double rho_next = 1.0 / (2.0 * sigma - rho);
    const double keep = rho_next * rho, add = 2.0 * rho_next / delta;
    rho = rho_next;
    for (int a : active) {
      double sum = 0.0;
      for (int w : topology_.ring(a)) sum += step_[w];
      x_[a] += step_[a];
      residual_[a] -= centre_[a] * step_[a] + spoke_[a] * sum;
      next_[a] = keep * step_[a] + add * residual_[a];
    }
    for (int a : active) step_[a] = next_[a];
  }

  Row row;
  double total = 0.0;
  int centre = 0;
  for (int a : active) {
    const double weight = x_[a] / spoke_[a];
    if (a == v) centre = static_cast<int>(row.vertex.size());
    if (std::fabs(weight) > TOLERANCE) {
      row.vertex.push_back(a);
      row.weight.push_back(weight);
      total += weight;
    }
    x_[a] = residual_[a] = step_[a] = next_[a] = 0.0;
    reached_[a] = 0;
  }
  row.weight[centre] += 1.0 - total;    // rows of L sum to 1, and so do these
  return row;
}

double InverseMask::memory_usage() const
{
  return 4.0 * sizeof(double) * x_.size() + entries_ * (sizeof(int) + sizeof(double));
}
