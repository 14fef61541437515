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

#ifndef LMP_HD_STIFFNESS_PROBE_H
#define LMP_HD_STIFFNESS_PROBE_H

#include "hd_mass.h"

#include <array>
#include <vector>

namespace LAMMPS_NS {

/** The stiffness K of the present configuration, as a linear map on the control points of a mass
    matrix: K v by central differences of forces, so without ever being formed. Moves control points
    and overwrites forces; restore() puts both back, bit by bit. All functions are collective, and
    ghost atoms must be in place. */
class StiffnessProbe : protected Pointers {
 public:
  /// Which forces count: those of pair style helfrich, or all of pair, bond, ..., kspace styles.
  enum class Forces { MEMBRANE, ALL };

  /** Collective; for commands, before the mass matrix is made: atoms and ghosts are placed as the set-up of a
      run does, so that a later run finds every atom in the place it would have had anyway. Fixes are not asked. */
  static void place_atoms(class LAMMPS *);

  StiffnessProbe(class LAMMPS *, HDMass &, Forces);
  /// Whether there is anything to compute forces with.
  bool has_forces() const;
  void restore();

  /// Forces where the control points are now; the potential energy if wanted, else 0.
  double evaluate(bool energy);

  // === Eigenvalues of M^-1 K, in 1/time^2; with drag coefficients for masses in 1/time

  struct Eigenvalue {
    double value;          ///< the largest Ritz value: not above the largest eigenvalue
    double uncertainty;    ///< an eigenvalue is within this distance of it
    int evaluations;       ///< of forces
  };
  /// By Lanczos' method, until the uncertainty is below tolerance times the value.
  Eigenvalue largest(int most_steps, double tolerance);
  /// Rayleigh's quotient v K v / v M v.
  double quotient(const Membrane_NS::VertexField &v);
  /// product = K v, in units of M v/time^2, for owned vertices.
  void multiply(const Membrane_NS::VertexField &v, Membrane_NS::VertexField &product);

 private:
  HDMass &mass;
  Forces which;
  class Pair *helfrich;
  std::vector<std::array<double, 3>> x_before, f_before;    // of owned atoms

  void displace(const Membrane_NS::VertexField &v, double step);
  double dot(const Membrane_NS::VertexField &, const Membrane_NS::VertexField &);
};

}    // namespace LAMMPS_NS

#endif
