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

#include "membrane_closest_point.h"

#include "membrane_surface_fan.h"

#include <algorithm>
#include <cmath>

using namespace Membrane_NS;
using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

static constexpr int MOST_EVALUATIONS = 100;
static constexpr double LONGEST_STEP = 0.5;         // of a face
static constexpr double LEAST_CONVEX = 1.0e-4;      // of the determinant of the metric
static constexpr double ROUNDING = 1.0e-14;         // of squared distances
static constexpr double PRECISE = 1.0e-10;          // of the mean edge
static constexpr double LEAST_FRACTION = 1.0e-8;    // of a step
static constexpr double NEAR_VERTEX =
    0.25;                                    // shorter steps, to the distance, see a smooth surface
static constexpr double FAN_RADIUS = 0.5;    // all within is on the faces around the vertex

namespace {

// The way from a point, a fraction of it or all.

class Move {
 public:
  Move(const LimitSurface &surface, const SurfacePoint &from, const Vector2d &step);
  /// From the extraordinary vertex at a corner, to a place in the plane of the fan.
  Move(const LimitSurface &surface, const SurfacePoint &from, int corner, const Vector2d &place);

  SurfacePoint to(double fraction) const
  {
    if (vertex_ >= 0) return point_in_fan(topology_, vertex_, from_place_ + fraction * step_);
    return walk(topology_, from_, fraction * step_).end;
  }

 private:
  const Topology &topology_;
  SurfacePoint from_;
  int vertex_ = -1;
  Vector2d from_place_, step_;    // steps in u and v, or of the place

  void try_fan(const FanPoint &fan, const Vector2d &step);
};

Vector2d no_longer(const Vector2d &step, double most)
{
  const double length =
      std::max({std::fabs(step[0]), std::fabs(step[1]), std::fabs(step[0] + step[1])});
  if (!std::isfinite(length)) return Vector2d::Zero();
  return length > most ? Vector2d(step * (most / length)) : step;
}

Move::Move(const LimitSurface &surface, const SurfacePoint &from, const Vector2d &step) :
    topology_(surface.topology()), from_(from)
{
  step_ = no_longer(step, LONGEST_STEP);
  const int corner = fan_corner(topology_, from);
  if (corner < 0) return;
  const double to_corner = 1.0 - from.barycentric()[corner];
  if (step_.lpNorm<Eigen::Infinity>() < NEAR_VERTEX * to_corner) return;
  try_fan(fan_point(topology_, from, corner), step);
}

Move::Move(const LimitSurface &surface, const SurfacePoint &from, int corner,
           const Vector2d &place) :
    topology_(surface.topology()),
    from_(from), vertex_(topology_.face(from.face)[corner]), from_place_(Vector2d::Zero()),
    step_(no_longer(place, LONGEST_STEP))
{
}

void Move::try_fan(const FanPoint &fan, const Vector2d &step)
{
  const Vector2d in_plane = no_longer(fan.slope * step, LONGEST_STEP);
  if ((fan.place + in_plane).norm() > FAN_RADIUS) return;
  vertex_ = fan.vertex;
  from_place_ = fan.place;
  step_ = in_plane;
}

/* ----------------------------------------------------------------------
   A point of the surface on its way to the foot of x.
------------------------------------------------------------------------- */

class Descent {
 public:
  Descent(const LimitSurface &surface, const Vector3d &x, const SurfacePoint &start,
          const Vector3d &near) :
      surface_(surface),
      x_(x), point_(start), to_surface_(near)
  {
    evaluate();
  }
  ClosestPoint run(double tolerance);

 private:
  const LimitSurface &surface_;
  const Vector3d x_;
  SurfacePiece piece_;
  SurfacePoint point_;
  SurfaceJet jet_;
  int corner_ = -1;    // the extraordinary one that the point is at
  Vector3d normal_;
  Vector3d to_surface_;    // from x; of periodic images that next to the last
  int evaluations_ = 0;

  void evaluate();
  Vector3d along_surface() const { return to_surface_ - to_surface_.dot(normal_) * normal_; }
  Move move() const;
  Vector2d newton_step() const;
};

void Descent::evaluate()
{
  jet_ = surface_.evaluate<2>(point_, piece_);
  ++evaluations_;
  Vector3d offset = jet_.position() - x_;
  if (surface_.is_periodic()) offset = to_surface_ + surface_.nearest_image(offset - to_surface_);
  to_surface_ = offset;
  corner_ = surface_.corner_at(point_);
  if (corner_ < 0)
    normal_ = jet_.normal();
  else {    // where the jet is that of a point nearby
    const Matrix3d frame = surface_.vertex_frame(point_.face, corner_);
    normal_ = frame.col(1).cross(frame.col(2)).normalized();
  }
}

/* ----------------------------------------------------------------------
   With e = r - x the gradient of e^2/2 is e.r_a and its second derivatives are r_a.r_b + e.r_ab.
------------------------------------------------------------------------- */

Vector2d Descent::newton_step() const
{
  const Vector3d du = jet_.du(), dv = jet_.dv();
  const double gu = to_surface_.dot(du), gv = to_surface_.dot(dv);
  const double muu = du.dot(du), muv = du.dot(dv), mvv = dv.dot(dv);
  double huu = muu + to_surface_.dot(jet_.row(Derivative::DUU));
  double huv = muv + to_surface_.dot(jet_.row(Derivative::DUV));
  double hvv = mvv + to_surface_.dot(jet_.row(Derivative::DVV));
  double det = huu * hvv - huv * huv;
  if (!(huu > 0.0 && det > LEAST_CONVEX * (muu * mvv - muv * muv))) {
    huu = muu;
    huv = muv;
    hvv = mvv;
    det = huu * hvv - huv * huv;
  }
  return {(huv * gv - hvv * gu) / det, (huv * gu - huu * gv) / det};
}

Move Descent::move() const
{
  if (corner_ < 0) return Move(surface_, point_, newton_step());
  const Matrix3d frame = surface_.vertex_frame(point_.face, corner_);
  const Eigen::Matrix<double, 3, 2> axes = frame.rightCols<2>();
  const Vector2d place = (axes.transpose() * axes).inverse() * (axes.transpose() * -to_surface_);
  return Move(surface_, point_, corner_, place);
}

ClosestPoint Descent::run(double tolerance)
{
  bool converged = false;
  while (evaluations_ < MOST_EVALUATIONS) {
    const Vector3d along = along_surface();
    converged = along.squaredNorm() <= tolerance * tolerance;
    if (converged) break;

    const Move move = this->move();
    if (corner_ >= 0 && surface_.corner_at(move.to(1.0)) >= 0) {    // as close as it can be told
      converged = true;
      break;
    }
    const SurfacePoint from = point_;
    const Vector3d from_offset = to_surface_;
    const double distance2 = to_surface_.squaredNorm();
    const double noise = ROUNDING * (jet_.position().norm() + x_.norm()) * to_surface_.norm();
    bool closer = false;
    for (double fraction = 1.0; fraction > LEAST_FRACTION && !closer; fraction *= 0.5) {
      point_ = move.to(fraction);
      to_surface_ = from_offset;
      evaluate();
      closer = to_surface_.squaredNorm() <= distance2 + noise;
    }
    if (closer) continue;
    point_ = from;
    to_surface_ = from_offset;
    evaluate();
    break;
  }

  ClosestPoint closest;
  closest.point = point_;
  closest.distance = -to_surface_.dot(normal_);
  closest.normal = normal_;
  closest.foot = x_ + to_surface_;
  closest.jet = jet_;
  closest.residual = along_surface().norm();
  closest.evaluations = evaluations_;
  closest.converged = converged;
  return closest;
}

double tolerance_for(const LimitSurface &surface, const Vector3d &x, double wanted)
{
  const double rounding = 4.0e-16 * x.norm();
  return std::max(wanted > 0.0 ? wanted : PRECISE * surface.mean_edge(), rounding);
}

}    // namespace

/* ---------------------------------------------------------------------- */

ClosestPoint Membrane_NS::closest_point(const LimitSurface &surface, const Vector3d &x,
                                        const SurfacePoint &start, double tolerance)
{
  const Vector3d near = surface.is_periodic()
      ? surface.nearest_image(surface.evaluate<0>(start).position() - x)
      : Vector3d(Vector3d::Zero());
  return Descent(surface, x, start, near).run(tolerance_for(surface, x, tolerance));
}

ClosestPointFinder::ClosestPointFinder(const LimitSurface &surface) :
    surface_(surface), samples_(surface)
{
}

ClosestPoint ClosestPointFinder::find(const Vector3d &x, double tolerance) const
{
  SampleGrid::Nearby nearby;
  const int count = samples_.near(x, nearby);
  if (count == 0) throw MeshError("there is no membrane to find the closest point of, or no place");
  const double precise = tolerance_for(surface_, x, tolerance);
  ClosestPoint best = Descent(surface_, x, nearby[0].point, nearby[0].offset).run(precise);
  for (int i = 1; i < count; ++i) {
    const double distance = (best.foot - x).norm();
    if (nearby[i].distance - samples_.radius() >= distance) break;
    const ClosestPoint other = Descent(surface_, x, nearby[i].point, nearby[i].offset).run(precise);
    if ((other.foot - x).norm() < distance) best = other;
  }
  return best;
}
