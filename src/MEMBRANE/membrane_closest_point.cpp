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
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

static constexpr int MOST_EVALUATIONS = 100;
static constexpr double LONGEST_STEP = 0.5;         // of a face
static constexpr double LEAST_FRACTION = 1.0e-8;    // of a step
static constexpr double LEAST_CONVEX = 1.0e-4;      // of the determinant of the metric
static constexpr double ROUNDING = 2.0e-15;         // of coordinates
static constexpr double PRECISE = 1.0e-10;          // of the mean edge

// steps in u and v that are short against the distance from a vertex do not see it; in the fan's plane
// all within the radius is on the faces around the vertex

static constexpr double NEAR_VERTEX = 0.25;
static constexpr double FAN_RADIUS = 0.5;

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
  const auto is_short = [&](double nearness) { return step_.lpNorm<Eigen::Infinity>() < NEAR_VERTEX * (1.0 - nearness); };
  const auto nearness = from.barycentric();    // 1 at a corner
  if (is_short(std::max({nearness[0], nearness[1], nearness[2]}))) return;
  const int corner = fan_corner(topology_, from);
  if (corner < 0 || is_short(nearness[corner])) return;
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
   A point of the surface on its way to the foot of x. With e = r - x, the gradient of e^2/2 is
   g_a = e.r_a and its second derivatives are r_a.r_b + e.r_ab; the part of e along the surface has
   the square g_a (G^-1)_ab g_b, G_ab = r_a.r_b.
------------------------------------------------------------------------- */

class Descent {
 public:
  /// Of periodic images, begins at the one whose offset from x is nearest to `near`.
  Descent(const LimitSurface &surface, const Vector3d &x, const SurfacePoint &start,
          const Vector3d &near, ClosestPoint &result) :
      surface_(surface),
      x_(x), result_(result), point_(result.point), jet_(result.jet), to_surface_(near)
  {
    point_ = start;
    evaluate();
    rounding_ = ROUNDING * (jet_.position().lpNorm<1>() + x.lpNorm<1>());
  }
  /// On to the foot, or as far as it goes, and the result.
  void run(double tolerance);

 private:
  const LimitSurface &surface_;
  const Vector3d x_;
  double rounding_;
  int evaluations_ = 0;
  bool converged_ = false;

  ClosestPoint &result_;
  SurfacePoint &point_;
  SurfaceJet &jet_;
  SurfacePiece piece_;
  int corner_ = -1;                     // the extraordinary one that the point is at
  Vector3d to_surface_;                 // from x; of periodic images that next to the last
  double gu_, gv_, muu_, muv_, mvv_;    // gradient and metric

  void evaluate();
  double along_surface2() const
  {
    const double det = muu_ * mvv_ - muv_ * muv_;
    return (mvv_ * gu_ * gu_ - 2.0 * muv_ * gu_ * gv_ + muu_ * gv_ * gv_) / det;
  }
  Vector2d newton_step() const;
  Move move() const;
  bool go(const Move &move);
  void finish();
};

void Descent::evaluate()
{
  surface_.evaluate<2>(point_, piece_, jet_);
  ++evaluations_;
  const Vector3d offset = jet_.position() - x_;
  to_surface_ = surface_.is_periodic()
      ? Vector3d(to_surface_ + surface_.nearest_image(offset - to_surface_))
      : offset;

  // at an extraordinary vertex the jet is that of a point nearby: take tangents of its own

  corner_ = surface_.corner_at(point_);
  Vector3d du = jet_.du(), dv = jet_.dv();
  if (corner_ >= 0) {
    const Matrix3d frame = surface_.vertex_frame(point_.face, corner_);
    du = frame.col(1);
    dv = frame.col(2);
  }
  gu_ = to_surface_.dot(du);
  gv_ = to_surface_.dot(dv);
  muu_ = du.dot(du);
  muv_ = du.dot(dv);
  mvv_ = dv.dot(dv);
}

// by the second derivatives if they make a bowl, else without those of r

Vector2d Descent::newton_step() const
{
  double huu = muu_, huv = muv_, hvv = mvv_;
  if (corner_ < 0) {
    huu += to_surface_.dot(jet_.row(Derivative::DUU));
    huv += to_surface_.dot(jet_.row(Derivative::DUV));
    hvv += to_surface_.dot(jet_.row(Derivative::DVV));
  }
  const double metric = muu_ * mvv_ - muv_ * muv_;
  double det = huu * hvv - huv * huv;
  if (!(huu > 0.0 && det > LEAST_CONVEX * metric)) {
    huu = muu_;
    huv = muv_;
    hvv = mvv_;
    det = metric;
  }
  return Vector2d(huv * gv_ - hvv * gu_, huv * gu_ - huu * gv_) / det;
}

Move Descent::move() const
{
  const Vector2d step = newton_step();
  return corner_ < 0 ? Move(surface_, point_, step) : Move(surface_, point_, corner_, step);
}

// to where it is closer, or back

bool Descent::go(const Move &move)
{
  const SurfacePoint from = point_;
  const Vector3d before = to_surface_;
  const double enough = before.squaredNorm() + rounding_ * before.lpNorm<1>();
  for (double fraction = 1.0; fraction > LEAST_FRACTION; fraction *= 0.5) {
    point_ = move.to(fraction);
    to_surface_ = before;
    evaluate();
    if (to_surface_.squaredNorm() <= enough) return true;
  }
  point_ = from;
  to_surface_ = before;
  evaluate();
  return false;
}

void Descent::run(double tolerance)
{
  int visits = 0;    // of an extraordinary vertex
  while (evaluations_ < MOST_EVALUATIONS) {
    converged_ = along_surface2() <= tolerance * tolerance;
    if (converged_) break;
    const Move move = this->move();
    if (corner_ >= 0) {    // as close as can be told, if the next place is there too or was before
      converged_ = ++visits > 2 || surface_.corner_at(move.to(1.0)) >= 0;
      if (converged_) break;
    }
    if (!go(move)) break;
  }
  finish();
}

void Descent::finish()
{
  result_.normal = jet_.normal();
  if (corner_ >= 0) {
    const Matrix3d frame = surface_.vertex_frame(point_.face, corner_);
    result_.normal = frame.col(1).cross(frame.col(2)).normalized();
  }
  result_.distance = -to_surface_.dot(result_.normal);
  result_.foot = x_ + to_surface_;
  result_.residual = std::sqrt(std::max(along_surface2(), 0.0));
  result_.evaluations = evaluations_;
  result_.converged = converged_;
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
  ClosestPoint closest;
  Descent(surface, x, start, Vector3d::Zero(), closest).run(tolerance_for(surface, x, tolerance));
  return closest;
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
  ClosestPoint best, other;
  Descent(surface_, x, nearby[0].point, nearby[0].offset, best).run(precise);
  for (int i = 1; i < count; ++i) {
    const double distance = (best.foot - x).norm();
    if (nearby[i].distance - samples_.radius() >= distance) break;
    Descent(surface_, x, nearby[i].point, nearby[i].offset, other).run(precise);
    if ((other.foot - x).norm() < distance) best = other;
  }
  return best;
}
