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

#ifndef LMP_MEMBRANE_REGULARIZATION_H
#define LMP_MEMBRANE_REGULARIZATION_H

#include "membrane_helfrich.h"

namespace Membrane_NS {

/** Keeps the control mesh of a fluid membrane well shaped: each face has the energy

      K (D/A - 1),   D = sum of squared edges / (4 sqrt(3)),   A = area of the flat triangle,

    which is 0 for an equilateral triangle of any size and grows without bound as a face collapses
    [K. Hormann and G. Greiner, MIPS: an efficient global parametrization method, 2000]. It knows
    shapes but not sizes, so it has no tension; a sheet with slopes s changes it by O(s^4) only.

    Adds minus the gradient to f, [points][3]; energy [slots] and virial [slots][6] (xx yy zz xy xz
    yz) are added to where not empty. modulus: K by slot, in energy. Returns the worst face's D/A. */
double regularize_faces(const FaceGroup &group, const double (*x)[3],
                        const std::vector<double> &modulus, double (*f)[3],
                        std::vector<double> &energy, std::vector<double> &virial);

/** Keeps the control mesh of a fluid membrane well shaped without a tension on curved surfaces: each face
    has a half of K/9 times

      2 (ln c)^2,   c = |p1 p2| |p0 d|/(|p2 p0| |d p1|)

    for each edge p0 p1 with the corners p2 and d of the faces on both sides: the length cross ratio
    [B. Springborn, P. Schroeder and U. Pinkall, Conformal equivalence of triangle meshes, ACM Trans. Graph.
    27, 77 (2008)]. It does not change when the mesh is deformed conformally, that is with another scale in
    every place, and resists shear as much as regularize_faces() of the same K. Besides,
    K (r - 1.3)^2/r of r = D/A > 1.3 keeps faces from collapse.

    across: [slots][3], the point d of the edge from corner k to k+1; logs: [slots][3], ln c of these edges, or
    how far it is from what it is at rest. The rest is as of regularize_faces(). */
double conformal_faces(const FaceGroup &group, const double (*x)[3],
                       const std::vector<double> &modulus, const std::vector<int> &across,
                       const std::vector<double> &logs, double (*f)[3], std::vector<double> &energy,
                       std::vector<double> &virial);

/// ln c of the edges, where there is a modulus.
void cross_ratios(const FaceGroup &group, const double (*x)[3], const std::vector<double> &modulus,
                  const std::vector<int> &across, std::vector<double> &logs);

/** On which side of a closed component its points gather. Conformal maps of a sphere onto itself take them to any
    pole at no cost in cross ratios. So a component of F faces with the areas A_f and the centres c_f, together A, has
    the energy

      10 K 4 pi |d|^2/A,   d = sum over faces of (1/F - A_f/A) c_f,

    which depends on neither size nor attitude nor place. Sums, over a rank's faces and then over all: */
struct PointDipole {
  double faces = 0.0, area = 0.0;
  double modulus = 0.0;                                      ///< of K
  Eigen::Vector3d centres = Eigen::Vector3d::Zero();         ///< of c_f
  Eigen::Vector3d weighted = Eigen::Vector3d::Zero();        ///< of A_f c_f

  Eigen::Vector3d moment() const { return centres / faces - weighted / area; }
};

/// component: [slots], which dipole a face belongs to, or -1; origin: [slots][3], any point that all faces of a
/// component share, in the periodic image that the face is in.
void add_dipoles(const FaceGroup &group, const double (*x)[3], const std::vector<double> &origin,
                 const std::vector<double> &modulus, const std::vector<int> &component,
                 std::vector<PointDipole> &dipoles);
/// What the dipoles do; each face has an equal share of the energy. The rest is as of regularize_faces().
void hold_dipoles(const FaceGroup &group, const double (*x)[3], const std::vector<double> &origin,
                  const std::vector<int> &component, const std::vector<PointDipole> &dipoles, double (*f)[3],
                  std::vector<double> &energy, std::vector<double> &virial);

/** Edges that run in the same direction: where all points of a component have valence 6 it is made of three
    families of parallel lines, as a sheet through the box is. By face, the family 0, 1 or 2 of the edge from
    corner 0 to 1, after which the two others follow; -1 in other components. A uniform shear changes ln c
    of all edges of a family alike. */
std::vector<int> edge_families(const Topology &topology);

/// D/A of a triangle: 1 if equilateral, infinite if it has no area.
double face_distortion(const double *a, const double *b, const double *c);

/** A/D of the face p among its neighbours: 1 if equilateral, 0 if it has no area, less if it has
    turned over, so that its normal is opposed to the sum of the normals, by area, of the three faces
    across its edges. across[k] is the far corner of the face across the edge from p[k] to p[k+1]. */
double face_uprightness(const double *const (&p)[3], const double *const (&across)[3]);

}    // namespace Membrane_NS

#endif
