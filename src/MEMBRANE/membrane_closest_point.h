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

#ifndef LMP_MEMBRANE_CLOSEST_POINT_H
#define LMP_MEMBRANE_CLOSEST_POINT_H

#include "membrane_limit_surface.h"
#include "membrane_sample_grid.h"

namespace Membrane_NS {

/** The point of the limit surface that is closest to a place x in space, its foot, and the signed
    distance d of x. The gradient of d with respect to x is the normal; with respect to control point
    i it is minus its weight at the foot times the normal, exactly, on the surface and off it;
    second derivatives with respect to x: SurfaceJet::distance_hessian(). */
struct ClosestPoint {
  SurfacePoint point;
  double distance;           ///< positive on the side to which the normal points
  Eigen::Vector3d normal;    ///< of length 1, outward
  Eigen::Vector3d foot;      ///< in the periodic image nearest to x
  SurfaceJet jet;            ///< to second order; its position may be another image
  double residual;    ///< the part of x - foot along the surface, a length: 0 but for the tolerance
  int evaluations;    ///< of the surface
  bool converged;     ///< residual within the tolerance
};

/** The foot of x next to a point that is known: a minimum of the distance on the way downhill.

    Newton's iteration in u and v with the exact second derivatives of |x - r|^2/2, or without those of
    r where that is not convex; the place walks across edges. Near extraordinary vertices steps
    are straight in the plane of FanPoint. Steps are at most half a face, and halved until the distance
    falls. Does not allocate.

    tolerance: the largest residual, a length; 1e-10 mean edges by default. There is one foot as long as
    d is less than the radii of curvature on its side, and less than to any other part of the surface;
    beyond, what is found is a minimum near the start, or (converged is false) where the distance no
    longer falls. The vertex itself is the foot of all places whose foot is within the radius in
    parameters at which LimitBasis sees no difference, 1e-9, which is up to 1e-6 edges at valence 20. */
ClosestPoint closest_point(const LimitSurface &surface, const Eigen::Vector3d &x,
                           const SurfacePoint &start, double tolerance = 0.0);

/** Finds the closest point of a whole surface, with nothing to start from.

    Starts are samples of all faces in a grid. From the closest one, and from any other on a part of the surface
    apart from it that might be closer yet, goes downhill, and returns the best: the closest point, as
    long as downhill from the nearest sample leads to the nearest point of that part. */
class ClosestPointFinder {
 public:
  /// The surface must outlive this.
  explicit ClosestPointFinder(const LimitSurface &surface);
  /// To be called when the surface has moved.
  void update() { samples_.update(); }

  ClosestPoint find(const Eigen::Vector3d &x, double tolerance = 0.0) const;

  double memory_usage() const { return samples_.memory_usage(); }

 private:
  const LimitSurface &surface_;
  SampleGrid samples_;
};

}    // namespace Membrane_NS

#endif
