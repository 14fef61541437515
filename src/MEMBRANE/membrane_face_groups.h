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

#ifndef LMP_MEMBRANE_FACE_GROUPS_H
#define LMP_MEMBRANE_FACE_GROUPS_H

#include "membrane_quadrature.h"
#include "membrane_topology.h"

#include <vector>

namespace Membrane_NS {

/// Faces are evaluated LANES at a time, one to a lane of the vector unit of the machine that this is
/// compiled for: more lanes than it has go through memory in pieces, which is ten times slower.
#if defined(__AVX512F__)
constexpr int LANES = 8;
#elif defined(__AVX__)
constexpr int LANES = 4;
#else
constexpr int LANES = 2;
#endif

/** Faces that share a quadrature rule, in blocks of LANES. A face of the group has a slot; slots
    of all groups of a mesh are numbered through, so one array per property serves them all. The
    last block of a group is filled up with copies of its last face: slots from first_slot + nfaces on
    hold their values and must be left out of sums. Valences up to 32, else MeshError. */
struct FaceGroup {
  const PatchRule *rule = nullptr;
  int first_slot = 0;
  int nfaces = 0;
  std::vector<int> face;      ///< [nfaces] index in the topology
  std::vector<int> points;    ///< [nblocks][rule->size][LANES] control point indices
  // not inline: who includes this may be compiled for another machine's vectors
  int nblocks() const;
  int nslots() const;
  /// Blocks that are evaluated as they are: all, or all but the last if quarters of its faces join those of others.
  int nwhole() const;
  /// The k-th control point of the i-th face of the group.
  int &point(int i, int k);
  int point(int i, int k) const;
};

/// Sort faces into groups; `points` holds vertex indices. Groups keep pointers into `rules`.
std::vector<FaceGroup> group_faces(const Topology &topology, PatchRules &rules,
                                   const std::vector<int> &faces);
/// The number of slots of all groups.
int count_slots(const std::vector<FaceGroup> &groups);

/** Of D^2 (k1^2 + k2^2): up to EXACT leaflets have the energy of parallel surfaces, from THIN on its expansion to second
    order in D k, and a mixture in between. A parallel surface has a cusp at 1 or beyond. */
constexpr double LEAFLETS_EXACT = 0.5, LEAFLETS_THIN = 0.8;

/** What each face is made of, by slot: the energy of a face is
    integral kc/2 (2H - c0)^2 + kg K + moment 2H + tension dA, and pressure is dE/dV of its
    membrane. 2H = +2/R on a sphere with outward normals. Any consistent units.

    With leaflets, kc/4 (2H - outer)^2 dA on the surface at a distance `leaflet` outwards and kc/4 (2H + inner)^2 dA
    on the one inwards stand in place of kc/2 (2H - c0)^2 dA: see doc/src/Derivation_leaflets.rst. */
struct FaceModel {
  std::vector<double> kc, c0, kg, tension, moment, pressure;
  std::vector<double> leaflet, outer, inner;    ///< empty where there are none
  std::vector<double> origin;    ///< [slots][3] the point volumes are measured from, in the
                                 ///< periodic image that the face is in
  void resize(int nslots);

  bool has_leaflets() const { return !leaflet.empty(); }
  /// Adds to the spontaneous curvatures of monolayers, and so of the bilayer.
  void add_curvatures(int slot, double more_outer, double more_inner);
  /// Energy of bending per area of the flat membrane.
  double flat_energy(int slot) const;
};

}    // namespace Membrane_NS

#endif
