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

#include "membrane_topology.h"
#include "membrane_vertex_field.h"
#include "membrane_vertex_part.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace Membrane_NS {

/// How the mass of the membrane is spread over its surface; each kind has a class of its own.
enum class MassKind {
  VERTEX,        ///< point masses at the limit positions of the vertices: M = L^T D L
  CONSISTENT,    ///< spread evenly over the parameters of each face (Galerkin)
  LUMPED,        ///< on the control points themselves: right equilibrium, wrong dynamics
  SAMPLING       ///< stiffness in place of mass: equilibrium in few steps, no dynamics
};

struct SharedReference;
struct SharedModes;

/// What a mass matrix is made of: the vertices of a rank, with numbers for all of the topology.
struct VertexMasses {
  const Topology &topology;
  VertexPart &part;                       ///< must outlive the matrix
  const std::vector<double> &masses;      ///< positive; 0 for vertices that no rank's part has
  const std::vector<uint64_t> &labels;    ///< what noise is keyed by
};

/** The mass matrix M of the control points' kinetic energy (1/2) qdot^T M qdot, the same for x, y
    and z: momenta p = M v, velocities v = M^-1 p and random velocities with <v v^T> = kT M^-1.

    A new kind derives from this, has its line in the table of membrane_mass_kinds.cpp, and needs
    multiply(), solve() and sample() alone. Fields have an entry for each vertex of the part; only
    owned entries are read and written. All functions that take fields are collective. */
class MassOperator {
 public:
  struct Settings {
    MassKind kind = MassKind::VERTEX;
    bool direct = false;           ///< by Cholesky; not LUMPED
    double tolerance = 1.0e-10;    ///< of the residual, relative to the right-hand side
    int most_passes = 1000;        ///< of conjugate gradients, which need some 30 to 200
    std::shared_ptr<SharedReference> reference;    ///< SAMPLING only
    double unit = 1.0;             ///< likewise: mass over stiffness, the square of the unit of time
    std::shared_ptr<SharedModes> modes;    ///< that are all the motion there is, if any
  };

  virtual ~MassOperator() = default;

  // === Momenta and velocities

  /// p = M v
  virtual void multiply(const VertexField &v, VertexField &p) = 0;
  /// v = M^-1 p
  virtual void solve(const VertexField &p, VertexField &v) = 0;
  /** Random v with <v v^T> = kT M^-1, exact for the discrete M: the velocities of equilibrium. The
      normal numbers depend on seed, step and the label of a vertex (or face) alone, so the result
      does not depend on how vertices are shared among ranks. */
  virtual void sample(double kT, uint64_t seed, uint64_t step, VertexField &v) = 0;
  /** v = M^-1 p, and unit noise: z is a sample at kT = 1. Where both have passes over the mesh in common, z costs
      next to nothing and its covariance is M^-1 to 2e-4 and not exactly. */
  virtual void solve_with_noise(const VertexField &p, VertexField &v, uint64_t seed, uint64_t step,
                                VertexField &z);
  /// Sums over all vertices of v_a p_b for ab = xx, yy, zz, xy, xz, yz: twice the kinetic energy by
  /// components.
  std::array<double, 6> kinetic(const VertexField &v);

  // === Friction and noise

  // v = keep v + sqrt((1 - keep^2) kT) times unit noise is an exact step of friction and noise, p' = -gamma p

  /// Whether friction may differ between vertices, because each of them carries a mass of its own.
  virtual bool has_vertex_friction() const { return false; }
  /// If so: the same with one number per owned vertex, for the momenta of these masses.
  virtual void relax(const std::vector<double> &keep, double kT, uint64_t seed, uint64_t step,
                     VertexField &v);
  /// Whether its motions have friction of their own, other than in proportion to their mass.
  virtual bool has_own_friction() const { return false; }
  /// If so: an exact step of this friction and its noise.
  virtual void relax_own(double time, double kT, uint64_t seed, uint64_t step, VertexField &v);

  // === Motions that there are not

  /// How many of the 3 n directions have no velocity.
  virtual int lost_freedoms() const { return 0; }
  /** Adds to f, for owned vertices, what makes up for them in the equilibrium of shapes. x: coordinates of
      owned vertices, unwrapped; kT in units of f times x. Collective. */
  virtual void add_gauge_forces(double /*kT*/, const VertexField & /*x*/, VertexField & /*f*/) {}

  // === What a solution costs and gives

  /// Passes over the mesh of the last solve().
  int passes() const { return passes_; }
  /// |p - M v| / |p|, the same on all ranks.
  double residual(const VertexField &p, const VertexField &v);
  /// Residual of the last solution, here or in a sample, that missed the tolerance; 0 if none has yet.
  double missed_residual() const { return missed_residual_; }
  virtual double memory_usage() const;

 protected:
  explicit MassOperator(VertexPart &part) : part_(part) {}

  VertexPart &part_;
  int passes_ = 0;
  double missed_residual_ = 0.0;

 private:
  VertexField momentum_;
};

}    // namespace Membrane_NS

#endif
