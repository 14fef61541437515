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

#ifndef LMP_MEMBRANE_MASS_H
#define LMP_MEMBRANE_MASS_H

#include "membrane_cholesky.h"
#include "membrane_topology.h"
#include "membrane_vertex_field.h"

#include <Eigen/SparseCore>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace Membrane_NS {

/** The vertices of one rank, numbered compactly: first those it owns, then copies of neighbours
    that other ranks own, its halo. On one rank there is no halo. */
class VertexPart {
 public:
  virtual ~VertexPart() noexcept(false) = default;
  /// For each local number the vertex of the topology; the first `owned` are this rank's.
  std::vector<int> vertices;
  int owned = 0;
  int size() const { return static_cast<int>(vertices.size()); }

  /** Where the layers of owned vertices start, and the end of the last: the neighbours of a vertex
      are in its own layer, the one before or the one after. If there is a halo, the first layer
      holds all vertices next to it. */
  std::vector<int> layers;
  /// Number the owned vertices by layers, in an order that depends on which they are alone.
  void order(const Topology &topology);

  /// Collective: copy the values of owned vertices to where they are halo.
  void fill_halo(VertexField &field)
  {
    begin_halo(field);
    end_halo(field);
  }
  /// The same in two halves; between them neither owned nor halo values may change.
  virtual void begin_halo(VertexField &) {}
  virtual void end_halo(VertexField &) {}
  /// Collective: the sum over all ranks.
  virtual void sum(double *, int) {}
  /// Collective: a field on all vertices of the topology, from the owned parts of all ranks.
  virtual void gather(const VertexField &owned_values, VertexField &all);
};

/// How the mass of the membrane is spread over its surface.
enum class MassKind {
  VERTEX,        ///< point masses at the limit positions of the vertices: M = L^T D L
  CONSISTENT,    ///< spread evenly over the parameters of each face (Galerkin)
  LUMPED         ///< on the control points themselves: right equilibrium, wrong dynamics
};

/** The mass matrix M of the control points' kinetic energy (1/2) qdot^T M qdot, the same for x, y
    and z, and the solution of M qdot = p.

    VERTEX, with the limit mask r = L q, row i: c_i on i and (1 - c_i)/n_i =: e_i on its n_i
    neighbours, and D = diag(vertex masses). L = diag(e) S with S symmetric and positive definite
    on every mesh without boundary, so L is similar to a symmetric matrix with a positive spectrum
    (bounds: limit_mask_lowest()), and Chebyshev's iteration solves L x = b in a number of passes
    known beforehand, without inner products. L^T x = b is L (e x) = e b. A factorization of S solves it,
    too.

    CONSISTENT: M_ij = sum over faces of 2 m_f integral phi_i phi_j du dv, with m_f the sum over the
    face's corners of their mass over their valence; solved by conjugate gradients with Jacobi's
    preconditioner or by a factorization.

    Factorizations are of the whole matrix, which every rank has.

    Fields have an entry for each vertex of the part; only owned entries are read and written. */
class MassOperator {
 public:
  struct Settings {
    MassKind kind = MassKind::VERTEX;
    bool direct = false;          ///< by Cholesky; not LUMPED
    double tolerance = 1.0e-10;   ///< of the residual, relative to the right-hand side
  };

  /// masses: of all vertices of the topology, positive; labels: what noise is keyed by. The part
  /// must outlive the operator.
  MassOperator(const Topology &topology, VertexPart &part, const std::vector<double> &masses,
               const std::vector<uint64_t> &labels, const Settings &settings);

  // === The matrix

  /// p = M v
  void multiply(const VertexField &v, VertexField &p);
  /// v = M^-1 p
  void solve(const VertexField &p, VertexField &v);
  /** Random v with <v v^T> = kT M^-1, exact for the discrete M: the velocities of equilibrium.
      VERTEX: L^-1 D^-1/2 z; LUMPED: D^-1/2 z; CONSISTENT: M^-1 B z with B B^T = M, face by face.
      The normal numbers z depend on seed, step and the label of a vertex (face) alone, so the
      result does not depend on how vertices are shared among ranks. */
  void sample(double kT, uint64_t seed, uint64_t step, VertexField &v);

  /** v = keep v + sqrt(1 - keep^2) times a sample: an exact step of friction and noise. With one
      number for all vertices any mass will do; with one per owned vertex it acts on the velocities
      of the masses, L v (VERTEX) or v (LUMPED). */
  void relax(double keep, double kT, uint64_t seed, uint64_t step, VertexField &v);
  void relax(const std::vector<double> &keep, double kT, uint64_t seed, uint64_t step,
             VertexField &v);

  // === The limit mask L (VERTEX)

  /// y = L x: limit positions of control points, velocities of the masses. Fills the halo of x.
  void apply_mask(VertexField &x, VertexField &y);
  /// x = L^-1 b, to the tolerance of the settings.
  void solve_mask(const VertexField &b, VertexField &x);
  /// The same for two, y = L^-1 c.
  void solve_mask(const VertexField &b, const VertexField &c, VertexField &x, VertexField &y);
  /// The entries of L at an owned vertex and at each of its neighbours.
  double mask_centre(int i) const { return centre_[i]; }
  double mask_spoke(int i) const { return spoke_[i]; }

  // === What a solve costs and gives

  /// Passes over the mesh of the last solve.
  int iterations() const { return iterations_; }
  /// |p - M v| / |p|, the same on all ranks.
  double residual(const VertexField &p, const VertexField &v);
  /// Bounds on the spectrum of L (VERTEX).
  std::array<double, 2> spectrum() const { return {lowest_, 1.0}; }
  double memory_usage() const;

 private:
  Settings settings_;
  VertexPart &part_;
  std::vector<double> mass_;    // of owned vertices
  std::vector<uint64_t> label_;
  int iterations_ = 0;
  VertexField work_, scratch_, kick_;

  // VERTEX: rings of owned vertices in local numbers; c and e of owned vertices
  std::vector<int> ring_start_, ring_;
  std::vector<double> centre_, spoke_;
  double lowest_ = 1.0;
  int passes_ = 0;
  VertexField previous_;

  // CONSISTENT: rows of owned vertices, columns in local numbers
  Eigen::SparseMatrix<double, Eigen::RowMajor> rows_;
  struct FaceNoise {    // a face that reaches owned vertices
    uint64_t label;
    double amplitude;                     // sqrt(2 m_f)
    const Eigen::MatrixXd *root;          // of the face's matrix for unit mass
    std::vector<std::pair<int, int>> owned;    // local vertex, row of root
  };
  std::map<std::array<int, 3>, Eigen::MatrixXd> roots_;
  std::vector<FaceNoise> noise_;
  std::vector<double> diagonal_;

  std::unique_ptr<SparseCholesky> factor_;    // if direct: of S (VERTEX) or M (CONSISTENT)
  VertexField whole_, other_;                 // by vertex of the topology

  void build_rings(const Topology &topology);
  void build_rows(const Topology &topology, const std::vector<double> &masses,
                  const std::vector<uint64_t> &labels);
  void chebyshev(const VertexField &b, VertexField &x);
  void chebyshev_pass(int first, int last, double omega, const VertexField &b,
                      const VertexField &x, VertexField &y) const;
  void factorize(const Topology &topology, const std::vector<double> &masses,
                 std::vector<Eigen::Triplet<double>> &entries);
  void solve_direct(const VertexField &b, VertexField &x);
  void conjugate_gradients(const VertexField &p, VertexField &v);
};

/** A lower bound, not far from the least, of the eigenvalues of the limit mask on a mesh without
    boundary. S and diag(1/e) are sums over faces of 3 x 3 matrices, diag(c/(1 - c)) + (J - 1)/2 and
    diag(1/(1 - c)) with J all ones, so Rayleigh's quotient of L lies above the smallest eigenvalue
    of any face's pair: 1/4 where all valences are 6 or more, and never above (3 c_i - 1)/2 by more
    than that. */
double limit_mask_lowest(const Topology &topology);

}    // namespace Membrane_NS

#endif
