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

#include "membrane_molecule_surface.h"

#include "membrane_closest_point.h"
#include "membrane_quadrature.h"

#include <algorithm>
#include <cmath>

using namespace Membrane_NS;
using Eigen::Vector3d;

static constexpr double FLAT = 1.0e-6;     // the largest curvature of a plane, of its inverse mean edge
static constexpr double MARGIN = 1.5;      // how much more than at the samples the area element may be
static constexpr int MOST_TRIES = 1000;

/// The larger of the principal curvatures by size, of those with a sign if that is not 0.
static double largest_curvature(double mean, double gaussian, int sign)
{
  const double half = std::sqrt(std::max(0.0, mean * mean - gaussian));
  if (sign > 0) return mean + half;
  if (sign < 0) return mean - half;
  return std::fabs(mean) + half;
}

/* ---------------------------------------------------------------------- */

ParallelSurfaces::ParallelSurfaces(const LimitSurface &surface, std::vector<int> faces) :
    surface_(surface), faces_(std::move(faces)), area_(faces_.size())
{
  const Topology &topology = surface.topology();
  PatchRules rules(Quadrature::SIX);
  const TriangleRule inside = triangle_rule(Quadrature::SIX);
  samples_of_face_ = inside.size();
  std::vector<Lane4> control(MOST_STENCIL);
  for (size_t i = 0; i < faces_.size(); ++i) {
    const int f = faces_[i];
    surface.control_points(f, control.data());
    const PatchRule &rule = rules.get(topology.valences(f));
    std::array<double, 3> &sum = area_[i];
    sum = {0.0, 0.0, 0.0};
    for (int q = 0; q < rule.npoints; ++q) {
      LimitValues values = LimitValues::Zero();
      for (int row = 0; row < LimitBasis::ROWS; ++row)
        for (int k = 0; k < rule.size; ++k)
          values.row(row) += rule.row(q, row)[k] * control[k].head<3>().matrix().transpose();
      const LimitPoint point = limit_point(values);
      const Vector3d du = values.row(LimitBasis::DU), dv = values.row(LimitBasis::DV);
      const double J = du.cross(dv).norm(), curved = rule.weight[q] * J;
      sum[0] += rule.area_weight[q] * J;
      sum[1] += 2.0 * point.mean_curvature * curved;
      sum[2] += point.gaussian_curvature * curved;
    }
    for (int q = 0; q < inside.size(); ++q) {
      const SurfaceJet jet = surface.evaluate<2>(SurfacePoint{f, inside.u[q], inside.v[q]});
      const LimitPoint point = jet.limit_point();
      samples_.push_back({jet.area_vector().norm(), point.mean_curvature, point.gaussian_curvature, point.position,
                          point.normal});
    }
  }
}

double ParallelSurfaces::area(double height) const
{
  double sum = 0.0;
  for (size_t i = 0; i < faces_.size(); ++i) sum += area(static_cast<int>(i), height);
  return sum;
}

ParallelPlace ParallelSurfaces::lift(const SurfacePoint &point, double height) const
{
  const SurfaceJet jet = surface_.evaluate<1>(point);
  const Vector3d normal = jet.normal();
  return {point, jet.position() + height * normal, normal};
}

ParallelPlace ParallelSurfaces::project(const Vector3d &x, const SurfacePoint &start, double height) const
{
  const ClosestPoint closest = closest_point(surface_, x, start, 1.0e-7 * surface_.mean_edge());
  return {closest.point, closest.foot + height * closest.normal, closest.normal};
}

/* ----------------------------------------------------------------------
   A face by its area, and in it by rejection
------------------------------------------------------------------------- */

std::vector<ParallelPlace> ParallelSurfaces::random(int number, double height, const CounterRandom &random,
                                                    uint32_t label) const
{
  std::vector<double> sums, bound;
  double sum = 0.0;
  auto stretch = [&](double mean, double gaussian) {
    return std::max(0.0, 1.0 + height * (2.0 * mean + height * gaussian));
  };
  for (size_t i = 0; i < faces_.size(); ++i) {
    sums.push_back(sum += std::max(0.0, area(static_cast<int>(i), height)));
    double most = 0.0;
    for (int q = 0; q < samples_of_face_; ++q) {
      const Sample &s = samples_[i * samples_of_face_ + q];
      most = std::max(most, s.element * stretch(s.mean, s.gaussian));
    }
    bound.push_back(MARGIN * most);
  }
  std::vector<ParallelPlace> places;
  for (int k = 0; k < number; ++k) {
    const uint64_t which = static_cast<uint64_t>(label) << 40 | static_cast<uint64_t>(k);
    const double a = random.uniforms(which, 0)[0] * sum;
    const size_t i = std::min<size_t>(std::lower_bound(sums.begin(), sums.end(), a) - sums.begin(), sums.size() - 1);
    SurfacePoint point;
    for (int t = 1; t < MOST_TRIES; ++t) {
      auto uv = random.uniforms(which, 2 * t);
      if (uv[0] + uv[1] > 1.0) uv = {1.0 - uv[0], 1.0 - uv[1]};
      point = {faces_[i], uv[0], uv[1]};
      const SurfaceJet jet = surface_.evaluate<2>(point);
      const LimitPoint at = jet.limit_point();
      if (random.uniforms(which, 2 * t + 1)[0] * bound[i] <
          jet.area_vector().norm() * stretch(at.mean_curvature, at.gaussian_curvature))
        break;
    }
    places.push_back(lift(point, height));
  }
  return places;
}

double ParallelSurfaces::radius(double fraction) const
{
  std::vector<std::pair<double, double>> sorted;    // curvature, area
  double all = 0.0;
  for (const Sample &s : samples_) {
    sorted.emplace_back(largest_curvature(s.mean, s.gaussian, 0), s.element);
    all += s.element;
  }
  std::sort(sorted.begin(), sorted.end());
  double sum = 0.0;
  for (const auto &[curvature, element] : sorted) {
    sum += element;
    if (sum >= (1.0 - fraction) * all) return curvature > 0.0 ? 1.0 / curvature : INFINITY;
  }
  return INFINITY;
}

bool ParallelSurfaces::is_plane(Vector3d &normal) const
{
  normal = samples_.front().normal;
  const double flat = FLAT / surface_.mean_edge();
  for (const Sample &s : samples_)
    if (largest_curvature(s.mean, s.gaussian, 0) > flat || (s.normal - normal).norm() > FLAT) return false;
  return true;
}

ParallelSurfaces::Narrowest ParallelSurfaces::narrowest(double height) const
{
  Narrowest least = {INFINITY, 0.0, Vector3d::Zero()};
  for (const Sample &s : samples_) {
    const double k = largest_curvature(s.mean, s.gaussian, height > 0.0 ? -1 : 1);
    if (1.0 + k * height < least.stretch) least = {1.0 + k * height, k, s.position};
  }
  return least;
}
