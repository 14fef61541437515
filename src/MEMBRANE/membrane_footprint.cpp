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

#include "membrane_footprint.h"

#include "membrane_footprint_points.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace Membrane_NS;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// LANES points of a face, some of them within rho of the particle; the others have no weight

struct Membrane_NS::NearBlock {
  int block;
  Lane3 away;            // r - x
  Lane weight, slope;    // W, and dW/dr = slope (r - x)
};

static double sum(const Lane &a)
{
  double all = 0.0;
  for (int l = 0; l < LANES; ++l) all += a[l];
  return all;
}

static Vector3d sum(const Lane3 &a)
{
  return {sum(a.x), sum(a.y), sum(a.z)};
}

static Lane3 everywhere(const Vector3d &a)
{
  return {Lane{} + a[0], Lane{} + a[1], Lane{} + a[2]};
}

/* ---------------------------------------------------------------------- */

Director Membrane_NS::carry(const Director &director, const Vector3d &normal)
{
  Vector3d t = director.along;
  if (!director.normal.isZero(0.0)) {
    const double cosine = 1.0 + director.normal.dot(normal);
    if (!(cosine > 1.0e-6))
      throw MeshError("the membrane under a bound particle has turned over within a step: "
                      "use a smaller timestep");
    t -= normal.dot(t) / cosine * (director.normal + normal);
  }
  const Vector3d along = t - t.dot(normal) * normal;
  const double length = along.norm();
  if (!(length > 1.0e-6 * t.norm()))
    throw MeshError("the director of a bound particle is along the normal of the membrane: "
                    "give it one along the surface");
  return {along / length, normal};
}

/* ---------------------------------------------------------------------- */

Footprints::Footprints(const LimitSurface &surface, std::unique_ptr<FootprintPoints> points) :
    surface_(surface), points_(std::move(points)), visited_(surface.topology().num_faces(), 0), virial_(Matrix3d::Zero())
{
  update();
}

Footprints::Footprints(const LimitSurface &surface, Quadrature quadrature) :
    Footprints(surface, std::make_unique<FootprintPoints>(surface, quadrature))
{
}

Footprints::Footprints(const LimitSurface &surface, PatchRules &graded) :
    Footprints(surface, std::make_unique<FootprintPoints>(surface, graded))
{
}

Footprints::~Footprints() = default;

void Footprints::update()
{
  visit_ = 0;
  std::fill(visited_.begin(), visited_.end(), 0);
  points_->update();
  touched_.clear();
  virial_.setZero();
  half_width_ = INFINITY;
  if (!surface_.is_periodic()) return;
  const Matrix3d to_fraction = surface_.lattice().inverse();
  for (int k = 0; k < 3; ++k)
    if (surface_.periodic()[k])
      half_width_ = std::min(half_width_, 0.5 / to_fraction.row(k).norm());
}

/* ----------------------------------------------------------------------
   The points of a face within reach. `from` is x in the image that the face is in.
------------------------------------------------------------------------- */

bool Footprints::look_at_points(int face, const Vector3d &from, double radius, bool directed)
{
  const auto &patch = (*points_)[face];
  const double unit = 1.0 / (radius * radius);
  const Lane3 place = everywhere(from);
  const size_t before = near_.size();
  for (int b = patch.first; b < patch.first + points_->blocks_of(patch); ++b) {
    const Lane3 away = points_->points(b).position - place;
    Lane inside = 1.0 - unit * dot(away, away);
    bool any = false;
    for (int l = 0; l < LANES; ++l) {
      inside[l] = std::max(inside[l], 0.0);
      any |= inside[l] > 0.0;
    }
    if (any) near_.push_back({b, away, inside * inside * inside, -6.0 * unit * inside * inside});
  }
  if (near_.size() == before) return false;
  points_->bend(face, directed);
  return true;
}

/* ----------------------------------------------------------------------
   from the face of the foot across edges, as far as faces are in reach
------------------------------------------------------------------------- */

Footprints::Sums Footprints::look(const Vector3d &x, const SurfacePoint &foot, double radius,
                                  bool directed)
{
  const Topology &topology = surface_.topology();
  FootprintPoints &points = *points_;
  near_.clear();
  queue_.clear();
  reached_.clear();
  ++visit_;
  queue_.push_back(foot.face);
  visited_[foot.face] = visit_;
  for (size_t i = 0; i < queue_.size(); ++i) {
    const int face = queue_[i];
    const auto &patch = points.place(face);
    const Vector3d away = surface_.nearest_image(patch.center - x);
    const double reach = radius + patch.radius;
    if (away.squaredNorm() >= reach * reach) continue;
    if (reach >= half_width_)
      throw MeshError("a footprint of radius " + std::to_string(radius) + " and a face, " +
                      std::to_string(2.0 * reach) + " in all, are wider than the periodic box: " +
                      "use a larger box or a smaller footprint");
    if (look_at_points(face, patch.center - away, radius, directed)) reached_.push_back(face);
    for (int k = 0; k < 3; ++k) {
      const int next = topology.neighbor(face, k);
      if (visited_[next] == visit_) continue;
      visited_[next] = visit_;
      queue_.push_back(next);
    }
  }

  Lane area{}, curvature{};
  Lane3 normal{};
  for (const NearBlock &near : near_) {
    const PointBlock &point = points.points(near.block);
    const Lane weight = point.area * near.weight;
    area += weight;
    curvature += weight * point.curvature;
    if (directed) normal += weight * points.frames(near.block).normal;
  }
  return {sum(area), sum(curvature), sum(normal)};
}

/* ----------------------------------------------------------------------
   The smallest rotation that takes nbar to n_k takes a vector t across nbar to
     t - (n_k.t)/(1 + nbar.n_k) (nbar + n_k),
   of which the part along n_k does not matter to S_k
------------------------------------------------------------------------- */

FootprintAverage Footprints::average(const Vector3d &x, const SurfacePoint &foot, double radius)
{
  FootprintAverage out;
  const Sums sums = look(x, foot, radius, true);
  if (!(sums.area > 0.0)) return out;
  out.area = sums.area;
  out.curvature = sums.curvature / sums.area;
  out.normal = sums.normal.normalized();
  const Matrix3d across = Matrix3d::Identity() - out.normal * out.normal.transpose();
  for (const NearBlock &near : near_) {
    const PointBlock &point = points_->points(near.block);
    const FrameBlock &frame = points_->frames(near.block);
    for (int l = 0; l < LANES; ++l) {
      const Vector3d normal(frame.normal.x[l], frame.normal.y[l], frame.normal.z[l]);
      const LaneTensor &s = frame.tensor;
      Matrix3d tensor;
      tensor << s.xx[l], s.xy[l], s.xz[l], s.xy[l], s.yy[l], s.yz[l], s.xz[l], s.yz[l], s.zz[l];
      const Matrix3d turn =
          across - out.normal * (across * normal / (1.0 + out.normal.dot(normal))).transpose();
      out.tensor +=
          point.area[l] * near.weight[l] / sums.area * turn.transpose() * tensor * turn;
    }
  }
  return out;
}

/* ----------------------------------------------------------------------
   With w_k = A_k W_k, c = 2Hbar = sum w_k tr S_k / sum w_k, m = sum w_k n_k, nbar = m/|m|, and t the
   director, which stands for its part across nbar, of length 1:
     c_t = sum w_k tau_k.S_k.tau_k / sum w_k,  tau_k = t - beta_k nbar,
     beta_k = (n_k.t)/(1 + nbar.n_k),  c_s = c - c_t.
   First the derivatives by c and c_t, then by t and nbar, then by what the surface does at the points.
------------------------------------------------------------------------- */

FootprintForces Footprints::add(const CurvatureCoupling &particle, const Vector3d &x,
                                const SurfacePoint &foot, const Director &director)
{
  FootprintForces out;
  out.director = director;
  const bool directed = particle.has_director();
  const Sums sums = look(x, foot, particle.radius, directed);
  if (!(sums.area > 0.0)) return out;
  const double mean = sums.curvature / sums.area, per_area = 1.0 / sums.area;
  out.area = sums.area;
  out.curvature = mean;

  const double excess = mean - particle.c0p, bare = mean - particle.c0;
  double energy = 0.5 * particle.kp * excess * excess - 0.5 * particle.kc * bare * bare;
  double by_mean = particle.kp * excess - particle.kc * bare, by_along = 0.0;
  Vector3d nbar = Vector3d::Zero(), t = nbar, by_sum = nbar;    // by_sum: by m
  if (directed) {
    nbar = sums.normal.normalized();
    out.director = carry(director, nbar);
    t = out.director.along;
    const Lane3 all_nbar = everywhere(nbar), all_t = everywhere(t);
    Lane sum_along{};
    Lane3 sum_by_t{}, sum_by_nbar{};    // of c_t
    for (const NearBlock &near : near_) {
      const FrameBlock &frame = points_->frames(near.block);
      const Lane cosine = 1.0 + dot(all_nbar, frame.normal), beta = dot(frame.normal, all_t) / cosine;
      const Lane3 tau = all_t - beta * all_nbar, bend = 2.0 * (frame.tensor * tau);
      const Lane weight = points_->points(near.block).area * near.weight * per_area;
      sum_along += 0.5 * weight * dot(bend, tau);
      const Lane3 by = weight * (bend - dot(bend, all_nbar) / cosine * frame.normal);
      sum_by_t += by;
      sum_by_nbar += -beta * by;
    }
    const double along = sum(sum_along);
    const Vector3d by_t = sum(sum_by_t), by_nbar_of_along = sum(sum_by_nbar);
    const double too_bent = along - particle.c_par, too_wide = mean - along - particle.c_perp;
    energy +=
        0.5 * particle.k_par * too_bent * too_bent + 0.5 * particle.k_perp * too_wide * too_wide;
    by_along = particle.area * (particle.k_par * too_bent - particle.k_perp * too_wide);
    by_mean += particle.k_perp * too_wide;

    const Vector3d by_part = by_along * (by_t - by_t.dot(t) * t);
    const Vector3d by_nbar = by_along * by_nbar_of_along - by_part.dot(nbar) * t;
    by_sum = (by_nbar - by_nbar.dot(nbar) * nbar) / sums.normal.norm();
    out.along = along;
    out.across = mean - along;
    out.director_force = by_part.dot(nbar) * nbar - by_part;
  }
  out.energy = particle.area * energy;
  by_mean *= particle.area;

  const Lane3 all_nbar = everywhere(nbar), all_t = everywhere(t), all_by_sum = everywhere(by_sum);
  Lane3 force{};
  Lane virial[9] = {};
  for (const NearBlock &near : near_) {
    PointBlock &point = points_->points(near.block);
    const Lane weight = point.area * near.weight;
    Lane by_weight = by_mean * (point.curvature - mean);
    point.by_curvature += weight * (per_area * by_mean);
    if (directed) {
      FrameBlock &frame = points_->frames(near.block);
      const Lane cosine = 1.0 + dot(all_nbar, frame.normal), beta = dot(frame.normal, all_t) / cosine;
      const Lane3 tau = all_t - beta * all_nbar, bend = frame.tensor * tau;
      const Lane factor = by_along * per_area * weight;
      by_weight += by_along * (dot(bend, tau) - out.along);
      frame.by_tensor.add(factor, tau);
      frame.by_normal += weight * all_by_sum - 2.0 * factor * dot(bend, all_nbar) / cosine * tau;
      by_weight = by_weight * per_area + dot(all_by_sum, frame.normal);
    } else
      by_weight *= per_area;
    point.by_area += by_weight * near.weight;
    const Lane3 &away = near.away, by_position = by_weight * point.area * near.slope * away;
    point.by_position += by_position;
    force += by_position;
    virial[0] += away.x * by_position.x;
    virial[1] += away.x * by_position.y;
    virial[2] += away.x * by_position.z;
    virial[3] += away.y * by_position.x;
    virial[4] += away.y * by_position.y;
    virial[5] += away.y * by_position.z;
    virial[6] += away.z * by_position.x;
    virial[7] += away.z * by_position.y;
    virial[8] += away.z * by_position.z;
  }
  out.force = sum(force);
  for (int k = 0; k < 9; ++k) virial_(k / 3, k % 3) -= sum(virial[k]);
  for (int face : reached_) {
    auto &patch = (*points_)[face];
    if (patch.touched) continue;
    patch.touched = true;
    touched_.push_back(face);
  }
  return out;
}

/* ---------------------------------------------------------------------- */

void Footprints::pull_face(int face)
{
  (*points_)[face].touched = false;
  points_->pull(face, force_, virial_);
}

Matrix3d Footprints::take_forces(std::vector<Vector3d> &force)
{
  return take_forces([&](int face, const Lane4 *of_face) {
    const IntSpan points = surface_.stencil(face);
    for (int k = 0; k < points.size(); ++k) force[points[k]] += of_face[k].head<3>().matrix();
  });
}

double Footprints::memory_usage() const
{
  return points_->memory_usage() +
      sizeof(int) * (queue_.capacity() + reached_.capacity() + touched_.capacity()) +
      sizeof(NearBlock) * near_.capacity();
}
