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

#include <algorithm>
#include <cmath>
#include <string>

using namespace Membrane_NS;
using Eigen::Matrix3d;
using Eigen::Vector3d;

static Vector3d three(const Lane4 &x)
{
  return x.head<3>().matrix();
}

static Lane4 four(const Vector3d &x)
{
  return {x[0], x[1], x[2], 0.0};
}

/* ----------------------------------------------------------------------
   How the surface bends at a point. With a = r_u x r_v, J = |a|, n = a/J and the dual vectors
   p = r_v x a/J^2, b = a x r_u/J^2,
     S = L p p^T + M (p b^T + b p^T) + N b b^T,  L = -r_uu.n, M = -r_uv.n, N = -r_vv.n:
   positive on a sphere, S n = 0, its trace is 2H.
------------------------------------------------------------------------- */

namespace {

struct Bend {
  Vector3d ru, rv, ruu, ruv, rvv;
  Vector3d a, n, p, b;
  double per_J, L, M, N;

  // control points relative to one of them
  Bend(const PatchRule &rule, int q, const Lane4 *control)
  {
    const double *w = rule.row(q, LimitBasis::DU);
    const int size = rule.size;
    Lane4 u = Lane4::Zero(), v = u, uu = u, uv = u, vv = u;
    for (int k = 0; k < size; ++k) {
      const Lane4 &x = control[k];    // a copy would go through memory in halves
      u += w[k] * x;
      v += w[size + k] * x;
      uu += w[2 * size + k] * x;
      uv += w[3 * size + k] * x;
      vv += w[4 * size + k] * x;
    }
    ru = three(u);
    rv = three(v);
    ruu = three(uu);
    ruv = three(uv);
    rvv = three(vv);
    a = ru.cross(rv);
    per_J = 1.0 / a.norm();
    n = per_J * a;
    p = per_J * rv.cross(n);
    b = per_J * n.cross(ru);
    L = -ruu.dot(n);
    M = -ruv.dot(n);
    N = -rvv.dot(n);
  }
};

}    // namespace

void Footprints::Symmetric::add(double factor, const Vector3d &v)
{
  const Vector3d scaled = factor * v;
  xx += scaled[0] * v[0];
  yy += scaled[1] * v[1];
  zz += scaled[2] * v[2];
  xy += scaled[0] * v[1];
  xz += scaled[0] * v[2];
  yz += scaled[1] * v[2];
}

void Footprints::Point::forget()
{
  by_area = by_curvature = 0.0;
  by_position.setZero();
  by_normal.setZero();
  by_tensor = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
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

Footprints::Footprints(const LimitSurface &surface) :
    surface_(surface), patches_(surface.topology().num_faces()), virial_(Matrix3d::Zero())
{
  update();
}

Footprints::Footprints(const LimitSurface &surface, Quadrature quadrature) : Footprints(surface)
{
  triangle_ = triangle_rule(quadrature);
}

Footprints::Footprints(const LimitSurface &surface, PatchRules &graded) : Footprints(surface)
{
  graded_ = &graded;
}

const PatchRule &Footprints::rule(const Valences &valences)
{
  if (graded_) return graded_->get(valences);
  const auto [entry, fresh] = plain_.try_emplace(valences);
  PatchRule &rule = entry->second;
  if (!fresh) return rule;
  const LimitBasis basis(valences);
  rule.size = basis.size();
  rule.npoints = triangle_.size();
  rule.weight = triangle_.weight;
  for (int q = 0; q < rule.npoints; ++q) {
    const LimitBasis::Weights w = basis.evaluate(triangle_.u[q], triangle_.v[q]);
    rule.rows.insert(rule.rows.end(), w.data(), w.data() + w.size());
  }
  return rule;
}

void Footprints::update()
{
  ++epoch_;
  points_.clear();
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
   What a face is known by until the surface moves: the positions of its points, and a sphere around it.
   A place on it is the mean of its control points with weights >= 0 of which those that are no corners
   have less than half (0.39 at most, in a corner of valence 32): it is no farther from the middle
   of the corners than the farthest corner, and half of what other points are farther than that.
------------------------------------------------------------------------- */

Footprints::Patch &Footprints::place(int face)
{
  Patch &patch = patches_[face];
  if (patch.epoch == epoch_) return patch;
  if (!patch.rule) patch.rule = &rule(surface_.topology().valences(face));
  const PatchRule &rule = *patch.rule;
  Lane4 x[MOST_STENCIL];
  surface_.control_points(face, x);

  const Lane4 middle = (x[0] + x[1] + x[2]) / 3.0;
  double corners = 0.0, all = 0.0;
  for (int k = 0; k < rule.size; ++k) {
    all = std::max(all, (x[k] - middle).square().sum());
    if (k == 2) corners = all;
  }
  patch.center = three(middle);
  patch.radius = 0.5 * (std::sqrt(corners) + std::sqrt(all));

  patch.epoch = epoch_;
  patch.touched = false;
  patch.first = static_cast<int>(points_.size());
  points_.resize(points_.size() + rule.npoints);
  position_.resize(points_.size());
  for (int k = 0; k < rule.size; ++k) x[k] -= middle;
  for (int q = 0; q < rule.npoints; ++q) {
    const double *w = rule.row(q, LimitBasis::VALUE);
    Lane4 sum = middle;
    for (int k = 0; k < rule.size; ++k) sum += w[k] * x[k];
    position_[patch.first + q] = sum;
    points_[patch.first + q].area = -1.0;
  }
  return patch;
}

/* ----------------------------------------------------------------------
   The points of a face within reach; those that were not in anybody's reach before are worked out.
   `from` is x in the image that the face is in.
------------------------------------------------------------------------- */

bool Footprints::look_at_points(const Patch &patch, int face, const Vector3d &from, double radius)
{
  const double unit = 1.0 / (radius * radius);
  const size_t before = near_.size();
  Lane4 control[MOST_STENCIL];
  bool gathered = false;
  for (int q = 0; q < patch.rule->npoints; ++q) {
    const Vector3d away = three(position_[patch.first + q]) - from;
    const double inside = 1.0 - unit * away.squaredNorm();
    if (inside <= 0.0) continue;
    near_.push_back(
        {patch.first + q, away, inside * inside * inside, -6.0 * unit * inside * inside});
    Point &point = points_[patch.first + q];
    if (point.area >= 0.0) continue;
    if (!gathered) {
      surface_.control_points(face, control);
      for (int k = patch.rule->size - 1; k >= 0; --k) control[k] -= control[0];
      gathered = true;
    }
    const Bend bend(*patch.rule, q, control);
    const Vector3d s = bend.L * bend.p + bend.M * bend.b, t = bend.M * bend.p + bend.N * bend.b;
    const Vector3d &p = bend.p, &b = bend.b;
    point.area = patch.rule->weight[q] / bend.per_J;
    point.curvature = s.dot(p) + t.dot(b);
    point.normal = bend.n;
    point.tensor = {s[0] * p[0] + t[0] * b[0], s[1] * p[1] + t[1] * b[1],
                    s[2] * p[2] + t[2] * b[2], s[0] * p[1] + t[0] * b[1],
                    s[0] * p[2] + t[0] * b[2], s[1] * p[2] + t[1] * b[2]};
    point.forget();
  }
  return near_.size() > before;
}

/* ----------------------------------------------------------------------
   from the face of the foot across edges, as far as faces are in reach
------------------------------------------------------------------------- */

Footprints::Sums Footprints::look(const Vector3d &x, const SurfacePoint &foot, double radius,
                                  bool directed)
{
  const Topology &topology = surface_.topology();
  near_.clear();
  queue_.clear();
  reached_.clear();
  ++visit_;
  queue_.push_back(foot.face);
  patches_[foot.face].visit = visit_;
  for (size_t i = 0; i < queue_.size(); ++i) {
    const int face = queue_[i];
    const Patch &patch = place(face);
    const Vector3d away = surface_.nearest_image(patch.center - x);
    const double reach = radius + patch.radius;
    if (away.squaredNorm() >= reach * reach) continue;
    if (reach >= half_width_)
      throw MeshError("a footprint of radius " + std::to_string(radius) + " and a face, " +
                      std::to_string(2.0 * reach) + " in all, are wider than the periodic box: " +
                      "use a larger box or a smaller footprint");
    if (look_at_points(patch, face, patch.center - away, radius)) reached_.push_back(face);
    for (int k = 0; k < 3; ++k) {
      const int next = topology.neighbor(face, k);
      if (patches_[next].visit == visit_) continue;
      patches_[next].visit = visit_;
      queue_.push_back(next);
    }
  }

  Sums sums;
  for (const Near &near : near_) {
    const Point &point = points_[near.point];
    const double weight = point.area * near.weight;
    sums.area += weight;
    sums.curvature += weight * point.curvature;
    if (directed) sums.normal += weight * point.normal;
  }
  return sums;
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
  auto matrix = [](const Symmetric &s) {
    Matrix3d m;
    m << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
    return m;
  };
  const Matrix3d across = Matrix3d::Identity() - out.normal * out.normal.transpose();
  for (const Near &near : near_) {
    const Point &point = points_[near.point];
    const Matrix3d turn = across -
        out.normal * (across * point.normal / (1.0 + out.normal.dot(point.normal))).transpose();
    out.tensor +=
        point.area * near.weight / sums.area * turn.transpose() * matrix(point.tensor) * turn;
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
    double along = 0.0;
    Vector3d by_t = Vector3d::Zero(), by_nbar = by_t;    // of c_t
    for (const Near &near : near_) {
      const Point &point = points_[near.point];
      const double cosine = 1.0 + nbar.dot(point.normal), beta = point.normal.dot(t) / cosine;
      const Vector3d tau = t - beta * nbar, bend = 2.0 * (point.tensor * tau);
      const double weight = point.area * near.weight * per_area;
      along += 0.5 * weight * bend.dot(tau);
      const Vector3d by = weight * (bend - bend.dot(nbar) / cosine * point.normal);
      by_t += by;
      by_nbar -= beta * by;
    }
    const double too_bent = along - particle.c_par, too_wide = mean - along - particle.c_perp;
    energy +=
        0.5 * particle.k_par * too_bent * too_bent + 0.5 * particle.k_perp * too_wide * too_wide;
    by_along = particle.area * (particle.k_par * too_bent - particle.k_perp * too_wide);
    by_mean += particle.k_perp * too_wide;

    const Vector3d by_part = by_along * (by_t - by_t.dot(t) * t);
    by_nbar = by_along * by_nbar - by_part.dot(nbar) * t;
    by_sum = (by_nbar - by_nbar.dot(nbar) * nbar) / sums.normal.norm();
    out.along = along;
    out.across = mean - along;
    out.director_force = by_part.dot(nbar) * nbar - by_part;
  }
  out.energy = particle.area * energy;
  by_mean *= particle.area;

  for (const Near &near : near_) {
    Point &point = points_[near.point];
    const double weight = point.area * near.weight;
    double by_weight = by_mean * (point.curvature - mean);
    point.by_curvature += weight * per_area * by_mean;
    if (directed) {
      const double cosine = 1.0 + nbar.dot(point.normal), beta = point.normal.dot(t) / cosine;
      const Vector3d tau = t - beta * nbar, bend = point.tensor * tau;
      const double factor = by_along * per_area * weight;
      by_weight += by_along * (bend.dot(tau) - out.along);
      point.by_tensor.add(factor, tau);
      point.by_normal += weight * by_sum - 2.0 * factor * bend.dot(nbar) / cosine * tau;
    }
    by_weight = by_weight * per_area + by_sum.dot(point.normal);
    point.by_area += by_weight * near.weight;
    const Vector3d by_position = by_weight * point.area * near.slope * near.away;
    point.by_position += by_position;
    out.force += by_position;
    virial_ -= near.away * by_position.transpose();
  }
  for (int face : reached_) {
    Patch &patch = patches_[face];
    if (patch.touched) continue;
    patch.touched = true;
    touched_.push_back(face);
  }
  return out;
}

/* ----------------------------------------------------------------------
   the chain rule back through Bend, to the control points; derivatives are then zero again
------------------------------------------------------------------------- */

void Footprints::pull_face(int face)
{
  Patch &patch = patches_[face];
  const PatchRule &rule = *patch.rule;
  const int size = rule.size;
  patch.touched = false;
  std::fill(force_, force_ + size, Lane4::Zero());
  Lane4 control[MOST_STENCIL];
  surface_.control_points(face, control);
  for (int k = size - 1; k >= 0; --k) control[k] -= control[0];
  for (int q = 0; q < rule.npoints; ++q) {
    Point &point = points_[patch.first + q];
    if (point.area < 0.0) continue;
    const Bend bend(rule, q, control);
    const Vector3d &ru = bend.ru, &rv = bend.rv, &n = bend.n, &p = bend.p, &b = bend.b;

    // by L, M, N, p, b, then n, J and a

    const Vector3d gp = point.by_tensor * p + point.by_curvature * p;
    const Vector3d gb = point.by_tensor * b + point.by_curvature * b;
    const double by_L = p.dot(gp), by_M = 2.0 * p.dot(gb), by_N = b.dot(gb);
    const Vector3d by_p = 2.0 * bend.per_J * (bend.L * gp + bend.M * gb);
    const Vector3d by_b = 2.0 * bend.per_J * (bend.M * gp + bend.N * gb);
    const Vector3d by_n = point.by_normal - by_L * bend.ruu - by_M * bend.ruv - by_N * bend.rvv +
        by_p.cross(rv) + ru.cross(by_b);
    const double by_J = point.by_area * rule.weight[q] - by_p.dot(p) - by_b.dot(b);
    const Vector3d by_a = bend.per_J * (by_n - by_n.dot(n) * n) + by_J * n;

    const Vector3d by_u = by_b.cross(n) + rv.cross(by_a), by_v = n.cross(by_p) + by_a.cross(ru);
    virial_ -= ru * by_u.transpose() + rv * by_v.transpose() -
        (by_L * bend.ruu + by_M * bend.ruv + by_N * bend.rvv) * n.transpose();
    const double *w = rule.row(q, LimitBasis::VALUE);
    const Lane4 f = four(point.by_position), f_u = four(by_u), f_v = four(by_v);
    const Lane4 f_uu = four(by_L * n), f_uv = four(by_M * n), f_vv = four(by_N * n);
    for (int k = 0; k < size; ++k)
      force_[k] += w[3 * size + k] * f_uu + w[4 * size + k] * f_uv + w[5 * size + k] * f_vv -
          w[k] * f - w[size + k] * f_u - w[2 * size + k] * f_v;
    point.forget();
  }
}

Matrix3d Footprints::take_forces(std::vector<Vector3d> &force)
{
  return take_forces([&](int face, const Lane4 *of_face) {
    const IntSpan points = surface_.stencil(face);
    for (int k = 0; k < points.size(); ++k) force[points[k]] += three(of_face[k]);
  });
}

double Footprints::memory_usage() const
{
  double bytes = 0.0;
  for (const auto &entry : plain_) bytes += sizeof(double) * entry.second.rows.capacity();
  return bytes + sizeof(Patch) * patches_.capacity() +
      (sizeof(Point) + sizeof(Lane4)) * points_.capacity() +
      sizeof(int) * (queue_.capacity() + reached_.capacity() + touched_.capacity()) +
      sizeof(Near) * near_.capacity();
}
