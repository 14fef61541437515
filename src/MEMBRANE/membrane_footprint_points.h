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

#ifndef LMP_MEMBRANE_FOOTPRINT_POINTS_H
#define LMP_MEMBRANE_FOOTPRINT_POINTS_H

#include "membrane_lanes.h"
#include "membrane_limit_surface.h"
#include "membrane_quadrature.h"

#include <map>
#include <vector>

namespace Membrane_NS {

/// A symmetric 3x3 matrix at each of LANES points.
struct LaneTensor {
  Lane xx, yy, zz, xy, xz, yz;

  Lane3 operator*(const Lane3 &v) const
  {
    return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z,
            xz * v.x + yz * v.y + zz * v.z};
  }
  /// Adds factor v v^T.
  void add(const Lane &factor, const Lane3 &v);
};

/// LANES points of a rule on one face: what the surface does there, and derivatives of the energy by that.
/// The last block of a rule is filled up with points of no area.
struct PointBlock {
  PointBlock() {}    // leaves numbers alone
  Lane3 position;
  Lane area, curvature;    ///< A_k and 2H
  Lane by_area, by_curvature;
  Lane3 by_position;
};

/// The same points, for particles with directors.
struct FrameBlock {
  FrameBlock() {}
  Lane3 normal, by_normal;
  LaneTensor tensor, by_tensor;    ///< of curvature; its trace is 2H
};

/** What footprints know of the points of the quadrature rules of a surface: for each face from when it is
    looked at first until the surface moves. LANES points of a face are worked out at a time, so a face alone uses
    the vector unit, and no two of them have to be looked at together. */
class FootprintPoints {
 public:
  /// The same few points on every face, or those of graded rules. Both must outlive this.
  FootprintPoints(const LimitSurface &surface, Quadrature quadrature);
  FootprintPoints(const LimitSurface &surface, PatchRules &graded);

  /// Forget all of it.
  void update();

  /// A face: where it is. Small, since there are many and memory is slow.
  struct Patch {
    Eigen::Vector3d center;    ///< of a sphere around it
    double radius;
    int first = 0;             ///< of its blocks
    bool touched = false;      ///< for the caller: whether derivatives were added

    char known = 0;            // PLACE, BEND or FRAME
    int epoch = 0;
    const struct PointRule *rule = nullptr;
  };
  int blocks_of(const Patch &patch) const;
  Patch &operator[](int face) { return patches_[face]; }
  /// Positions of points and the sphere.
  Patch &place(int face);
  /// Curvature and area of a face that is placed, and with `frames` normals and tensors; derivatives are 0.
  void bend(int face, bool frames);
  PointBlock &points(int block) { return points_[block]; }
  FrameBlock &frames(int block) { return frames_[block]; }

  /** The chain rule from the derivatives at points of a face back to its control points: minus that of each, as
      LimitSurface::stencil() has them, to force; takes the virial off, relative to the points. */
  void pull(int face, Lane4 *force, Eigen::Matrix3d &virial);

  double memory_usage() const;

 private:
  const LimitSurface &surface_;
  PatchRules *graded_ = nullptr;
  TriangleRule triangle_;    // if there are no graded rules
  std::map<Valences, struct PointRule> rules_;
  int epoch_ = 1;
  std::vector<Patch> patches_;    // [faces]
  std::vector<PointBlock> points_;
  std::vector<FrameBlock> frames_;    // as points_, or fewer

  FootprintPoints(const LimitSurface &surface);
  const struct PointRule &rule(const Valences &valences);
  template <bool FRAMES> void pull(const Patch &patch, const Lane4 *control, Lane4 *force,
                                   Eigen::Matrix3d &virial) const;
};

/// A rule with rows for LANES points at a time.
struct PointRule {
  int size = 0, nblocks = 0;
  std::vector<double> weight;    ///< [nblocks][LANES]; 0 for what fills up the last
  std::vector<double> rows;      ///< [nblocks][LimitBasis::ROWS][size][LANES]

  const double *row(int block, int which) const
  {
    return rows.data() + ((size_t) block * LimitBasis::ROWS + which) * size * LANES;
  }
};

inline int FootprintPoints::blocks_of(const Patch &patch) const
{
  return patch.rule->nblocks;
}

}    // namespace Membrane_NS

#endif
