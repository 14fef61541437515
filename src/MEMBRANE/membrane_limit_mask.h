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

#ifndef LMP_MEMBRANE_LIMIT_MASK_H
#define LMP_MEMBRANE_LIMIT_MASK_H

#include "membrane_cholesky.h"
#include "membrane_topology.h"
#include "membrane_vertex_part.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace Membrane_NS {

/** The limit mask L of a mesh without boundary: r = L q are the limit positions of the vertices with
    control points q. Row i holds c_i on i and (1 - c_i)/n_i =: e_i on its n_i neighbours.

    L = diag(e) S with S symmetric and positive definite, so L is similar to a symmetric matrix with
    a positive spectrum, whose bounds are known. Chebyshev's iteration therefore solves L x = b in a
    number of passes known beforehand, without inner products; a factorization of S solves it, too.
    L^T x = b is L (e x) = e b.

    Fields have an entry for each vertex of the part; only owned entries are read and written. The fourth
    number of a vertex is one like the others here, and is solved for at no cost. */
class LimitMask {
 public:
  struct Solver {
    bool direct = false;           ///< factorize S: all of it, on every rank
    double tolerance = 1.0e-10;    ///< of the residual, relative to the right-hand side
  };

  /// Collective. The halo of the part reaches one edge at least; the part must outlive this.
  LimitMask(const Topology &topology, VertexPart &part, const Solver &solver);

  // === The matrix

  /// y = L x. Fills the halo of x.
  void apply(VertexField &x, VertexField &y);
  /// c and e of an owned vertex.
  double centre(int i) const { return centre_[i]; }
  double spoke(int i) const { return spoke_[i]; }
  /// Bounds on the spectrum.
  std::array<double, 2> spectrum() const { return {lowest_, 1.0}; }

  // === Solutions, collective

  /// x = L^-1 b
  void solve(const VertexField &b, VertexField &x);
  /// The same for two, y = L^-1 c.
  void solve(const VertexField &b, const VertexField &c, VertexField &x, VertexField &y);
  /** x = L^-1 b, and in the fourth number two solutions one after the other, each in half of the passes: the
      right-hand side is that of b first, whose solution is put into `other`, then what was in `other`,
      whose solution is in x. Not with the direct solver. */
  void solve(VertexField &b, VertexField &x, std::vector<double> &other);
  /// The residual of these two, relative to the right-hand side.
  double tolerance_of_half() const { return tolerance_of_half_; }
  bool is_direct() const { return factor_ != nullptr; }
  /// Passes over the mesh that a solution takes.
  int passes() const { return factor_ ? 1 : num_passes_; }

  double memory_usage() const;

 private:
  VertexPart &part_;
  std::vector<int> ring_start_;    // of owned vertices
  std::vector<uint32_t> ring_;     // of each its neighbours, as places in a field counted in bytes
  std::vector<double> centre_, spoke_;
  double lowest_;
  // of Chebyshev's passes after the first, for each of the four numbers: x_k+1 = now x_k + before x_k-1 + step (b - L x_k)
  struct Weights {
    Quad now, before, step;
  };
  int num_passes_, half_;
  double tolerance_of_half_;
  std::vector<Weights> weights_, weights_of_halves_;
  VertexField previous_;
  std::unique_ptr<PartCholesky> factor_;    // of S, if direct

  void factorize(const Topology &topology);
  void find_weights(double tolerance);
  template <class After>
  void chebyshev(const VertexField &b, VertexField &x, const std::vector<Weights> &, const After &);
  void chebyshev_pass(int first, int last, const Weights &, const VertexField &b, const VertexField &x,
                      VertexField &y) const;
  double first_step() const { return 2.0 / (1.0 + lowest_); }
};

/** A lower bound, not far from the least, of the eigenvalues of the limit mask on a mesh without
    boundary. S and diag(1/e) are sums over faces of 3 x 3 matrices, diag(c/(1 - c)) + (J - 1)/2 and
    diag(1/(1 - c)) with J all ones, so Rayleigh's quotient of L lies above the smallest eigenvalue
    of any face's pair: 1/4 where all valences are 6 or more, and never above (3 c_i - 1)/2 by more
    than that. */
double limit_mask_lowest(const Topology &topology);

}    // namespace Membrane_NS

#endif
