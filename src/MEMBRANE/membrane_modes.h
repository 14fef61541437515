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

#ifndef LMP_MEMBRANE_MODES_H
#define LMP_MEMBRANE_MODES_H

#include "membrane_helfrich.h"
#include "membrane_lanes.h"

#include <vector>

namespace Membrane_NS {

/** Quadrature points of the limit surface, LANES at a time: positions r, less the origin of the face's slot,
    which puts faces in different periodic images together, and n dA = r_u x r_v du dv. Lanes that fill up
    a last block have n dA = 0. */
struct SurfacePoints {
  std::vector<Lane3> r, area;

  /// Makes them anew.
  void take(const std::vector<FaceGroup> &groups, const double (*x)[3], const FaceModel &model);
};

// Integrals of the limit surface that give its undulations, added to `sums`.

// === Sheets: h(x, y) = sum_q h_q exp(i q.r), q = 2 pi (nx a* + ny b*)

/// Waves with 0 <= nx <= nmax, |ny| <= nmax, of which h, being real, has one of q and -q: those
/// with nx > 0 or ny > 0. Wave (nx, ny) has number nx (2 nmax + 1) + ny, from 1 to this one.
inline int count_waves(int nmax)
{
  return 2 * nmax * (nmax + 1);
}

/// The projection on the box vectors a = (ax, 0), b = (bx, by): r = s a + t b.
struct SheetFrame {
  double s_x, s_y, t_y;    ///< s = s_x x + s_y y, t = t_y y
  double height;           ///< that h is measured from
};

/// n_z dA and z n_z dA
void sheet_moments(const SurfacePoints &points, double (&sums)[2]);

/// sums[1 + count_waves(nmax)][2]: real and imaginary part of h exp(-i q.r) n_z dA for each wave,
/// h = z - height; before them h^2 n_z dA and 0.
void sheet_waves(const SurfacePoints &points, const SheetFrame &frame, int nmax, double *sums);

// === Spheres: r = R (1 + sum_lm u_lm Y_lm)

/** Real harmonics, orthonormal on the unit sphere, without the phase (-1)^m: with P the associated
    Legendre function of cos(theta), N its norm, x = sin(theta) cos(phi), y = sin(theta) sin(phi),
      Y_l0 = N P_l,  Y_lm = sqrt(2) N P_lm cos(m phi),  Y_l,-m = sqrt(2) N P_lm sin(m phi).
    Y_lm has number l^2 + l + m, from 0. */
inline int count_harmonics(int lmax)
{
  return (lmax + 1) * (lmax + 1);
}

/// (1/3) r.n dA, the volume, and (1/4) r (r.n) dA, the integral of r over the volume
void sphere_moments(const SurfacePoints &points, double (&sums)[4]);

/// sums[count_harmonics(lmax) + 1]: (|r|/radius - 1) Y_lm dOmega for each harmonic, dOmega =
/// r.n dA/|r|^3; after them dOmega. r is measured from `middle`.
void sphere_harmonics(const SurfacePoints &points, const double (&middle)[3], double radius, int lmax,
                      double *sums);

}    // namespace Membrane_NS

#endif
