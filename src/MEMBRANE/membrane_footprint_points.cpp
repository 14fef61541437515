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

#include "membrane_footprint_points.h"

#include <algorithm>
#include <climits>
#include <cmath>

using namespace Membrane_NS;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// what is known of a face
enum { NOTHING, PLACE, BEND, FRAME };

static Lane of_row(const double *row, int k)
{
  Lane lane;
  std::memcpy(&lane, row + k * LANES, sizeof(Lane));
  return lane;
}

static double sum(const Lane &a)
{
  double all = 0.0;
  for (int l = 0; l < LANES; ++l) all += a[l];
  return all;
}

// += w x at each point, for one control point x

static void add(Lane3 &to, const Lane &w, const Lane4 &x)
{
  to.x += w * x[0];
  to.y += w * x[1];
  to.z += w * x[2];
}

void LaneTensor::add(const Lane &factor, const Lane3 &v)
{
  const Lane3 scaled = factor * v;
  xx += scaled.x * v.x;
  yy += scaled.y * v.y;
  zz += scaled.z * v.z;
  xy += scaled.x * v.y;
  xz += scaled.x * v.z;
  yz += scaled.y * v.z;
}

/* ----------------------------------------------------------------------
   How the surface bends at points. With a = r_u x r_v, J = |a|, n = a/J and the dual vectors
   p = r_v x a/J^2, b = a x r_u/J^2,
     S = L p p^T + M (p b^T + b p^T) + N b b^T,  L = -r_uu.n, M = -r_uv.n, N = -r_vv.n:
   positive on a sphere, S n = 0, its trace is 2H.
------------------------------------------------------------------------- */

namespace {

struct Bend {
  Lane3 ru{}, rv{}, ruu{}, ruv{}, rvv{};
  Lane3 a, n, p, b;
  Lane per_J, L, M, N;

  // control points relative to one of them
  Bend(const PointRule &rule, int block, const Lane4 *control)
  {
    const int size = rule.size;
    const double *wu = rule.row(block, LimitBasis::DU), *wv = rule.row(block, LimitBasis::DV);
    const double *wuu = rule.row(block, LimitBasis::DUU), *wuv = rule.row(block, LimitBasis::DUV);
    const double *wvv = rule.row(block, LimitBasis::DVV);

    // in two loops, whose sums fit into 16 vector registers

    Lane3 u{}, v{}, uu{}, uv{}, vv{};
    for (int k = 0; k < size; ++k) {
      add(u, of_row(wu, k), control[k]);
      add(v, of_row(wv, k), control[k]);
    }
    for (int k = 0; k < size; ++k) {
      add(uu, of_row(wuu, k), control[k]);
      add(uv, of_row(wuv, k), control[k]);
      add(vv, of_row(wvv, k), control[k]);
    }
    ru = u;
    rv = v;
    ruu = uu;
    ruv = uv;
    rvv = vv;
    a = cross(ru, rv);
    per_J = 1.0 / sqrt(dot(a, a));
    n = per_J * a;
    p = per_J * cross(rv, n);
    b = per_J * cross(n, ru);
    L = -dot(ruu, n);
    M = -dot(ruv, n);
    N = -dot(rvv, n);
  }
};

// += a b^T

void add_product(Lane *to, const Lane3 &a, const Lane3 &b)
{
  const Lane *of_a[3] = {&a.x, &a.y, &a.z}, *of_b[3] = {&b.x, &b.y, &b.z};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) to[3 * i + j] += *of_a[i] * *of_b[j];
}

}    // namespace

/* ---------------------------------------------------------------------- */

FootprintPoints::FootprintPoints(const LimitSurface &surface) :
    surface_(surface), patches_(surface.topology().num_faces())
{
}

FootprintPoints::FootprintPoints(const LimitSurface &surface, Quadrature quadrature) :
    FootprintPoints(surface)
{
  triangle_ = triangle_rule(quadrature);
}

FootprintPoints::FootprintPoints(const LimitSurface &surface, PatchRules &graded) :
    FootprintPoints(surface)
{
  graded_ = &graded;
}

const PointRule &FootprintPoints::rule(const Valences &valences)
{
  const auto [entry, fresh] = rules_.try_emplace(valences);
  PointRule &rule = entry->second;
  if (!fresh) return rule;
  const LimitBasis basis(valences);
  const PatchRule *graded = graded_ ? &graded_->get(valences) : nullptr;
  const std::vector<double> &weight = graded ? graded->weight : triangle_.weight;
  const int npoints = static_cast<int>(weight.size());
  rule.size = basis.size();
  rule.nblocks = (npoints + LANES - 1) / LANES;
  rule.weight.assign((size_t) rule.nblocks * LANES, 0.0);
  std::copy(weight.begin(), weight.end(), rule.weight.begin());
  rule.rows.resize((size_t) rule.nblocks * LimitBasis::ROWS * rule.size * LANES);
  for (int slot = 0; slot < rule.nblocks * LANES; ++slot) {
    const int q = std::min(slot, npoints - 1), block = slot / LANES, lane = slot % LANES;
    LimitBasis::Weights plain;
    if (!graded) plain = basis.evaluate(triangle_.u[q], triangle_.v[q]);
    for (int which = 0; which < LimitBasis::ROWS; ++which)
      for (int k = 0; k < rule.size; ++k)
        rule.rows[(((size_t) block * LimitBasis::ROWS + which) * rule.size + k) * LANES + lane] =
            graded ? graded->row(q, which)[k] : plain(which, k);
  }
  return rule;
}

void FootprintPoints::update()
{
  if (++epoch_ == INT_MAX) {
    for (Patch &patch : patches_) patch.epoch = 0;
    epoch_ = 1;
  }
  points_.clear();
  frames_.clear();
}

/* ----------------------------------------------------------------------
   What a face is known by until the surface moves: the positions of its points, and a sphere around it.
   A place on it is the mean of its control points with weights >= 0 of which those that are no corners
   have less than half (0.39 at most, in a corner of valence 32): it is no farther from the middle
   of the corners than the farthest corner, and half of what other points are farther than that.
------------------------------------------------------------------------- */

FootprintPoints::Patch &FootprintPoints::place(int face)
{
  Patch &patch = patches_[face];
  if (patch.epoch == epoch_) return patch;
  if (!patch.rule) patch.rule = &rule(surface_.topology().valences(face));
  const PointRule &rule = *patch.rule;
  Lane4 x[MOST_STENCIL];
  surface_.control_points(face, x);

  const Lane4 middle = (x[0] + x[1] + x[2]) / 3.0;
  double corners = 0.0, all = 0.0;
  for (int k = 0; k < rule.size; ++k) {
    x[k] -= middle;
    all = std::max(all, x[k].square().sum());
    if (k == 2) corners = all;
  }
  patch.center = {middle[0], middle[1], middle[2]};
  patch.radius = 0.5 * (std::sqrt(corners) + std::sqrt(all));

  patch.epoch = epoch_;
  patch.known = PLACE;
  patch.touched = false;
  patch.first = static_cast<int>(points_.size());
  points_.resize(points_.size() + rule.nblocks);
  for (int b = 0; b < rule.nblocks; ++b) {
    const double *w = rule.row(b, LimitBasis::VALUE);
    Lane3 r = {Lane{} + middle[0], Lane{} + middle[1], Lane{} + middle[2]};
    for (int k = 0; k < rule.size; ++k) add(r, of_row(w, k), x[k]);
    points_[patch.first + b].position = r;
  }
  return patch;
}

void FootprintPoints::bend(int face, bool frames)
{
  Patch &patch = patches_[face];
  if (patch.known >= (frames ? FRAME : BEND)) return;
  const bool first_time = patch.known < BEND;
  patch.known = frames ? FRAME : BEND;
  if (frames && frames_.size() < points_.size()) frames_.resize(points_.size());
  const PointRule &rule = *patch.rule;
  Lane4 control[MOST_STENCIL];
  surface_.control_points(face, control);
  for (int k = rule.size - 1; k >= 0; --k) control[k] -= control[0];
  for (int block = 0; block < rule.nblocks; ++block) {
    const Bend bend(rule, block, control);
    const Lane3 &p = bend.p, &b = bend.b;
    if (first_time) {
      PointBlock &point = points_[patch.first + block];
      point.area = load(rule.weight, block * LANES) / bend.per_J;
      point.curvature = bend.L * dot(p, p) + 2.0 * bend.M * dot(p, b) + bend.N * dot(b, b);
      point.by_area = point.by_curvature = Lane{};
      point.by_position = Lane3{};
    }
    if (!frames) continue;
    FrameBlock &frame = frames_[patch.first + block];
    const Lane3 s = bend.L * p + bend.M * b, t = bend.M * p + bend.N * b;
    frame.normal = bend.n;
    frame.tensor = {s.x * p.x + t.x * b.x, s.y * p.y + t.y * b.y, s.z * p.z + t.z * b.z,
                    s.x * p.y + t.x * b.y, s.x * p.z + t.x * b.z, s.y * p.z + t.y * b.z};
    frame.by_normal = Lane3{};
    frame.by_tensor = LaneTensor{};
  }
}

/* ----------------------------------------------------------------------
   Back through Bend: by L, M, N, p, b, then n, J and a. The derivative by S is by_curvature times 1, and
   by_tensor.
------------------------------------------------------------------------- */

template <bool FRAMES>
void FootprintPoints::pull(const Patch &patch, const Lane4 *control, Lane4 *force,
                           Matrix3d &virial) const
{
  const PointRule &rule = *patch.rule;
  const int size = rule.size;
  Lane3 g[MOST_STENCIL];
  std::fill(g, g + size, Lane3{});
  Lane product[9] = {};
  for (int block = 0; block < rule.nblocks; ++block) {
    const PointBlock &point = points_[patch.first + block];
    const Bend bend(rule, block, control);
    const Lane3 &ru = bend.ru, &rv = bend.rv, &n = bend.n, &p = bend.p, &b = bend.b;

    Lane3 gp = point.by_curvature * p, gb = point.by_curvature * b;
    if (FRAMES) {
      const FrameBlock &frame = frames_[patch.first + block];
      gp += frame.by_tensor * p;
      gb += frame.by_tensor * b;
    }
    const Lane by_L = dot(p, gp), by_M = 2.0 * dot(p, gb), by_N = dot(b, gb);
    const Lane twice = 2.0 * bend.per_J;
    const Lane3 by_p = twice * (bend.L * gp + bend.M * gb);
    const Lane3 by_b = twice * (bend.M * gp + bend.N * gb);
    const Lane3 second = by_L * bend.ruu + by_M * bend.ruv + by_N * bend.rvv;
    Lane3 by_n = cross(by_p, rv) + cross(ru, by_b) - second;
    if (FRAMES) by_n += frames_[patch.first + block].by_normal;
    const Lane by_J =
        point.by_area * load(rule.weight, block * LANES) - dot(by_p, p) - dot(by_b, b);
    const Lane3 by_a = bend.per_J * (by_n - dot(by_n, n) * n) + by_J * n;

    const Lane3 by_u = cross(by_b, n) + cross(rv, by_a), by_v = cross(n, by_p) + cross(by_a, ru);
    add_product(product, ru, by_u);
    add_product(product, rv, by_v);
    add_product(product, -1.0 * second, n);

    const Lane3 f = -1.0 * point.by_position, f_u = -1.0 * by_u, f_v = -1.0 * by_v;
    const Lane3 f_uu = by_L * n, f_uv = by_M * n, f_vv = by_N * n;
    const double *w = rule.row(block, LimitBasis::VALUE), *wu = rule.row(block, LimitBasis::DU);
    const double *wv = rule.row(block, LimitBasis::DV), *wuu = rule.row(block, LimitBasis::DUU);
    const double *wuv = rule.row(block, LimitBasis::DUV), *wvv = rule.row(block, LimitBasis::DVV);
    for (int k = 0; k < size; ++k) {
      Lane3 all = g[k];
      all += of_row(w, k) * f;
      all += of_row(wu, k) * f_u;
      all += of_row(wv, k) * f_v;
      all += of_row(wuu, k) * f_uu;
      all += of_row(wuv, k) * f_uv;
      all += of_row(wvv, k) * f_vv;
      g[k] = all;
    }
  }
  for (int i = 0; i < 9; ++i) virial(i / 3, i % 3) -= sum(product[i]);
  for (int k = 0; k < size; ++k) force[k] = {sum(g[k].x), sum(g[k].y), sum(g[k].z), 0.0};
}

void FootprintPoints::pull(int face, Lane4 *force, Matrix3d &virial)
{
  const Patch &patch = patches_[face];
  Lane4 control[MOST_STENCIL];
  surface_.control_points(face, control);
  for (int k = patch.rule->size - 1; k >= 0; --k) control[k] -= control[0];
  if (patch.known == FRAME)
    pull<true>(patch, control, force, virial);
  else
    pull<false>(patch, control, force, virial);
  for (int b = patch.first; b < patch.first + blocks_of(patch); ++b) {
    PointBlock &point = points_[b];
    point.by_area = point.by_curvature = Lane{};
    point.by_position = Lane3{};
    if (patch.known < FRAME) continue;
    frames_[b].by_normal = Lane3{};
    frames_[b].by_tensor = LaneTensor{};
  }
}

double FootprintPoints::memory_usage() const
{
  double bytes = 0.0;
  for (const auto &entry : rules_) bytes += sizeof(double) * entry.second.rows.capacity();
  return bytes + sizeof(Patch) * patches_.capacity() + sizeof(PointBlock) * points_.capacity() +
      sizeof(FrameBlock) * frames_.capacity();
}
