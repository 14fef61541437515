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

// Fits the points of quadrature around extraordinary corners, and writes them as a table:
//
//   cmake --build build --target bench_corner_rules && build/bench_corner_rules src/MEMBRANE/membrane_quadrature_corners.cpp
//
// Rules that the table has stay as they are; those that are wanted and missing are searched for, for minutes. The search
// amplifies rounding: another compiler or machine finds other rules, about as good, which must pass ground_relaxation
// and ground_helfrich before they go into the table. A rule for the patch (n, 6, 6) is a set of points, symmetric under the patch's mirror image, with two
// positive weights each. Where the surface is nearly flat its energy is an integral over the plane of the characteristic map
// [U. Reif, CAGD 12, 153 (1995)] of products of second derivatives of the height, its area and volume of products of
// first ones: rules are fitted to these moments, for all shapes that the patch's control points can take. Smooth shapes
// count more, and most the quadratic ones, which are all that is left at the corner after much subdivision; but a
// shape that counts for nothing is where a minimizer hides energy. Random rules with many points are improved by
// Levenberg and Marquardt's method, and lose point after point; the best of each size is kept.
//
// Of each rule it says: the norm of what moments miss; the largest error of the moments of quadratic shapes, over the
// largest of these; between which factors the rule has the integral of (laplacian)^2 of any shape of this one patch, which
// its neighbours see too; the relative error of the area of the map.

#include "membrane_limit_basis.h"
#include "membrane_mesh_shapes.h"
#include "membrane_quadrature.h"
#include "membrane_quadrature_corners.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <vector>

using namespace Membrane_NS;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// for each valence how many random rules, whether they are fitted to spheres as well, and which numbers of points are
// written: those that PatchRules takes
const struct Wanted {
  int valence, starts;
  bool spheres;
  std::vector<int> points;
} WANTED[] = {{4, 400, true, {7, 10, 16}},  {5, 400, true, {7, 10, 16}}, {7, 200, false, {8, 10, 15}},
              {8, 200, false, {10, 12, 18}}, {9, 300, false, {20}},        {10, 300, false, {20}},
              {11, 300, false, {22}},       {12, 300, false, {20}}};
constexpr int MOST = 28, LEAST = 6;    // points of a random rule, and of the last that it becomes
constexpr double TAIL = 1.0e-9;         // of the energy, left out at the corner

// how much moments count: of all shapes alike, of smooth ones, of quadratic ones; of area and volume, and of their next order
constexpr double ROUGH = 0.05, SMOOTH = 1.0, POWER = 2.0, QUADRATIC = 3.0, AREA = 4.0, STEEP = 0.03;
constexpr int STEEP_SHAPES = 4;
// and spheres of so many levels of refinement, in full, of the valences that meshes of spheres have
constexpr int SPHERES = 2;
constexpr double SPHERE_ENERGY = 30.0, SPHERE_AREA = 1000.0;

// === The patch

/// Shapes of the patch (n, 6, 6), one in a column of control points: the characteristic map's x and y, then others.
class Patch {
 public:
  int n;
  int size;    // control points
  MatrixXd to_next;

  explicit Patch(int valence) : n(valence), size(valence + 6), basis_({valence, 6, 6})
  {
    to_next = basis_.child_matrix(0);
    const MatrixXd map = eigenvectors(subdominant_eigenvalue(n));    // two of them
    Eigen::Matrix2d at, wanted;    // neighbours 1 and 2 are at (1, 0) and (cos, sin)
    at << map.row(1), map.row(2);
    wanted << 1.0, 0.0, std::cos(2.0 * M_PI / n), std::sin(2.0 * M_PI / n);
    set_shapes(map * at.inverse() * wanted);
  }

  /// Shapes that subdivision shrinks by this factor.
  MatrixXd eigenvectors(double factor) const
  {
    Eigen::FullPivLU<MatrixXd> lu(to_next - factor * MatrixXd::Identity(size, size));
    lu.setThreshold(1e-10);
    return lu.kernel();
  }

  const MatrixXd &shapes() const { return shapes_; }

  /// Heights are measured from the corner.
  void set_shapes(const MatrixXd &shapes)
  {
    const Eigen::RowVectorXd mask = basis_.corner_mask(0);
    auto from_corner = [&](const MatrixXd &x) -> MatrixXd { return x.rowwise() - mask * x; };
    shapes_ = from_corner(shapes);
    parts_.clear();
    for (MatrixXd x = shapes_; parts_.size() < 3 * LEVELS; x = from_corner(to_next * x))
      for (int child = 1; child < 4; ++child) parts_.push_back(basis_.child_matrix(child) * x);
  }

  /// Rows: height, its first and its second derivatives in the map's x and y; the area of the map per (u, v).
  double derivatives(double u, double v, MatrixXd &d) const
  {
    size_t level = 0;
    double scale = 2.0;
    for (; u + v <= 0.5 && level + 1 < LEVELS; ++level, scale *= 2.0) u *= 2.0, v *= 2.0;
    int part = 2;
    if (u >= 0.5) part = 0, u = 2.0 * u - 1.0, v = 2.0 * v;
    else if (v >= 0.5) part = 1, u = 2.0 * u, v = 2.0 * v - 1.0;
    else u = 1.0 - 2.0 * u, v = 1.0 - 2.0 * v, scale = -scale;

    QuarticJet<12> jet;
    evaluate_quartics<2, 12>(box_spline_quartics(), u, v, 1.0, jet);
    Eigen::Matrix<double, 6, 12> rows;
    for (int row = 0; row < 6; ++row) rows.row(row) = jet[row].matrix().transpose();
    const MatrixXd w = rows * parts_[3 * level + part];

    const double xu = w(1, 0), yu = w(1, 1), xv = w(2, 0), yv = w(2, 1), area = xu * yv - xv * yu;
    const double ux = yv / area, vx = -yu / area, uy = -xv / area, vy = xu / area;
    d.resize(6, w.cols());
    d.row(0) = w.row(0);
    d.row(1) = ux * w.row(1) + vx * w.row(2);
    d.row(2) = uy * w.row(1) + vy * w.row(2);
    const MatrixXd h = w.bottomRows(3) - w.col(0).tail(3) * d.row(1) - w.col(1).tail(3) * d.row(2);
    d.row(3) = ux * ux * h.row(0) + 2.0 * ux * vx * h.row(1) + vx * vx * h.row(2);
    d.row(4) = ux * uy * h.row(0) + (ux * vy + vx * uy) * h.row(1) + vx * vy * h.row(2);
    d.row(5) = uy * uy * h.row(0) + 2.0 * uy * vy * h.row(1) + vy * vy * h.row(2);
    return area * scale * scale;
  }

 private:
  static constexpr size_t LEVELS = 48;
  LimitBasis basis_;
  MatrixXd shapes_;
  std::vector<MatrixXd> parts_;    // control points of the three regular parts of each level
};

struct Point {
  double u, v, weight;
};

/// Points so many that their sums are the integrals.
std::vector<Point> many_points(int valence)
{
  const TriangleRule rule = triangle_rule(Quadrature::CAREFUL);
  std::vector<Point> points;
  const int levels = static_cast<int>(std::ceil(std::log(TAIL) / std::log(energy_decay(valence))));
  for (int level = 1; level <= levels; ++level) {
    const double s = std::ldexp(1.0, -level);
    for (int q = 0; q < rule.size(); ++q) {
      const double u = s * rule.u[q], v = s * rule.v[q], w = s * s * rule.weight[q];
      points.push_back({s + u, v, w});
      points.push_back({u, s + v, w});
      points.push_back({s - u, s - v, w});
    }
  }
  return points;
}

/// Control points of a face with a corner of that valence on a mesh on the unit sphere, times 2.
MatrixXd sphere(int valence, int levels)
{
  TriangleMesh mesh = icosphere(levels, 1.0);
  if (valence != 5) {    // two apexes over a rim
    mesh = {};
    for (int i = 0; i < valence; ++i)
      mesh.points.emplace_back(std::cos(2.0 * M_PI * i / valence), std::sin(2.0 * M_PI * i / valence), 0.0);
    mesh.points.emplace_back(0.0, 0.0, 1.0);
    mesh.points.emplace_back(0.0, 0.0, -1.0);
    for (int i = 0; i < valence; ++i) {
      mesh.faces.push_back({valence, i, (i + 1) % valence});
      mesh.faces.push_back({valence + 1, (i + 1) % valence, i});
    }
    for (int i = 0; i < levels; ++i) mesh = loop_refine(mesh);
    for (auto &p : mesh.points) p.normalize();
  }
  const Topology topology(static_cast<int>(mesh.points.size()), mesh.faces);
  const Valences wanted = {valence, 6, 6};
  std::vector<int> stencil;
  for (int f = 0; f < topology.num_faces() && stencil.empty(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Valences n = topology.valences(f);
      if (Valences{n[k], n[(k + 1) % 3], n[(k + 2) % 3]} == wanted) {
        topology.stencil(f, stencil, k);
        break;
      }
    }
  MatrixXd points(stencil.size(), 3);
  for (size_t i = 0; i < stencil.size(); ++i) points.row(i) = 2.0 * mesh.points[stencil[i]].transpose();
  return points;
}

// === What rules are fitted to

class Moments {
 public:
  Moments(int valence, bool spheres) : patch(valence), points_(many_points(valence)), nspheres_(spheres ? SPHERES : 0)
  {
    const int size = patch.size;
    MatrixXd d, all(size, size + 2);
    all << patch.shapes(), MatrixXd::Identity(size, size);
    const MatrixXd map = patch.shapes();
    patch.set_shapes(all);
    MatrixXd energy = MatrixXd::Zero(size, size);    // integral of the square of second derivatives
    for (const Point &p : points_) {
      const double area = p.weight * patch.derivatives(p.u, p.v, d);
      const MatrixXd h = d.bottomRightCorner(3, size);
      energy += area * (h.row(0).transpose() * h.row(0) + 2.0 * h.row(1).transpose() * h.row(1) +
                        h.row(2).transpose() * h.row(2));
    }

    // bent shapes, each of energy 1; and how smooth they are

    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(energy);
    const VectorXd &values = solver.eigenvalues();
    int flat = 0;
    while (values[flat] < 1e-9 * values[size - 1]) ++flat;
    bent_ = size - flat;
    MatrixXd shapes(size, bent_);
    smooth_.resize(bent_);
    for (int k = 0; k < bent_; ++k) {
      shapes.col(k) = solver.eigenvectors().col(flat + k) / std::sqrt(values[flat + k]);
      smooth_[k] = std::pow(values[flat] / values[flat + k], 0.5 * (POWER - 1.0));
    }

    // the quadratic shapes: a cup, which Loop's weights shrink by the square of what the plane shrinks by, and saddles

    const double plane = subdominant_eigenvalue(valence);
    MatrixXd quadratic(size, 0);
    for (double factor : {plane * plane, valence == 3 ? 0.125 : 0.375 + 0.25 * std::cos(4.0 * M_PI / valence)}) {
      const MatrixXd found = patch.eigenvectors(factor);
      for (int k = 0; k < found.cols(); ++k) {
        const double own = found.col(k).dot(energy * found.col(k));
        if (own < 1e-12) continue;
        quadratic.conservativeResize(size, quadratic.cols() + 1);
        quadratic.rightCols(1) = found.col(k) / std::sqrt(own);
      }
    }
    quadratic_ = static_cast<int>(quadratic.cols());
    all.resize(size, 2 + bent_ + quadratic_ + 3 * nspheres_);
    all.leftCols(2 + bent_ + quadratic_) << map, shapes, quadratic;
    for (int i = 0; i < nspheres_; ++i) {
      const MatrixXd points = sphere(valence, i + 1);
      all.middleCols(2 + bent_ + quadratic_ + 3 * i, 3) = points;
      corner_[i] = (LimitBasis({valence, 6, 6}).corner_mask(0) * points).transpose();
    }
    patch.set_shapes(all);
    for (const Point &p : points_) add(p.u, p.v, p.weight, p.weight, target_, nenergy_);
  }

  Patch patch;
  int bent() const { return bent_; }
  int size() const { return static_cast<int>(target_.size()); }
  int nenergy() const { return nenergy_; }    // those of energies come first
  const VectorXd &target() const { return target_; }
  const std::vector<Point> &points() const { return points_; }

  /// Add the moments of a point to the sum, which may be empty.
  void add(double u, double v, double weight, double area_weight, VectorXd &sum) const
  {
    int dummy;
    add(u, v, weight, area_weight, sum, dummy);
  }

  /// Second derivatives of the bent shapes, and of the quadratic ones.
  double second(double u, double v, MatrixXd &bent, MatrixXd &quadratic) const
  {
    MatrixXd d;
    const double area = patch.derivatives(u, v, d);
    bent = d.block(3, 2, 3, bent_);
    quadratic = d.block(3, 2 + bent_, 3, quadratic_);
    return area;
  }

 private:
  std::vector<Point> points_;
  int nspheres_, bent_ = 0, quadratic_ = 0, nenergy_ = 0;
  VectorXd smooth_, target_;
  Eigen::Vector3d corner_[SPHERES];

  void add(double u, double v, double weight, double area_weight, VectorXd &sum, int &nenergy) const
  {
    MatrixXd d;
    const double area = patch.derivatives(u, v, d);
    std::vector<double> out;
    out.reserve(target_.size());
    double factor = weight * area;
    const double *h = d.data();    // columns of 6
    auto products = [&](int first, int count, int row, int rows, const auto &importance) {
      for (int k = 0; k < count; ++k)
        for (int l = k; l < count; ++l) {
          const double f = factor * importance(k, l);
          const double *a = h + 6 * (first + k) + row, *b = h + 6 * (first + l) + row;
          for (int i = 0; i < rows; ++i)
            for (int j = k == l ? i : 0; j < rows; ++j) out.push_back(f * a[i] * b[j]);
        }
    };
    products(2, bent_, 3, 3, [&](int k, int l) {
      const double smooth = SMOOTH * smooth_[k] * smooth_[l];
      return std::sqrt(ROUGH * ROUGH + smooth * smooth);
    });
    products(2 + bent_, quadratic_, 3, 3, [](int, int) { return QUADRATIC; });
    out.push_back(factor);    // with spontaneous curvature
    for (int k = 0; k < bent_; ++k) {
      const double *a = h + 6 * (2 + k);
      out.push_back(0.3 * factor * smooth_[k] * (a[3] + a[5]));
    }
    double whole[2 * SPHERES];    // areas and volumes
    for (int i = 0; i < nspheres_; ++i) {
      const auto r = d.middleCols(2 + bent_ + quadratic_ + 3 * i, 3);
      auto row = [&](int k) -> Eigen::Vector3d { return r.row(k).transpose(); };
      const Eigen::Vector3d x = row(1), y = row(2), normal = x.cross(y);
      const double J = normal.norm();
      const double bend = (y.dot(y) * row(3) - 2.0 * x.dot(y) * row(4) + x.dot(x) * row(5)).dot(normal) / (J * J * J);
      whole[2 * i] = J;
      whole[2 * i + 1] = normal.dot(corner_[i] + row(0));
      for (double f : {1.0, bend, bend * bend}) out.push_back(SPHERE_ENERGY * factor * J * f);
    }
    nenergy = static_cast<int>(out.size());

    for (int i = 0; i < 2 * nspheres_; ++i) out.push_back(SPHERE_AREA * area_weight * area * whole[i]);
    factor = AREA * area_weight * area;
    out.push_back(3.0 * factor);
    for (int k = 0; k < bent_; ++k) {    // components of the vector area, and volumes below the shape
      const double *a = h + 6 * (2 + k);
      for (double f : {a[0], a[1], a[2], 0.5 * (h[0] * a[1] + h[6] * a[2])}) out.push_back(factor * smooth_[k] * f);
      for (int l = k + 1; l < bent_; ++l) {
        const double *b = h + 6 * (2 + l);
        out.push_back(0.25 * factor * smooth_[k] * smooth_[l] * (a[1] * b[2] - a[2] * b[1]));
      }
    }
    products(2, bent_, 1, 2, [&](int k, int l) { return 0.25 * smooth_[k] * smooth_[l]; });
    std::vector<double> slopes;    // of smooth shapes that are not so flat, to the next order
    for (int k = 0; k < STEEP_SHAPES; ++k)
      for (int l = k; l < STEEP_SHAPES; ++l) {
        const double *a = h + 6 * (2 + k), *b = h + 6 * (2 + l);
        slopes.push_back(smooth_[k] * smooth_[l] * (a[1] * b[1] + a[2] * b[2]));
      }
    for (size_t k = 0; k < slopes.size(); ++k)
      for (size_t l = k; l < slopes.size(); ++l) out.push_back(STEEP * factor * slopes[k] * slopes[l]);
    const Eigen::Map<const VectorXd> all(out.data(), static_cast<Eigen::Index>(out.size()));
    if (sum.size() == 0) sum = all;
    else sum += all;
  }
};

// === Rules

/// A point on the mirror axis, or two points.
struct Orbit {
  double u, v, weight, area_weight;
  bool pair;
};
using Rule = std::vector<Orbit>;

int count(const Rule &rule)
{
  int points = 0;
  for (const Orbit &o : rule) points += o.pair ? 2 : 1;
  return points;
}

// moments of an orbit of weights 1
VectorXd moments_of(const Moments &moments, const Orbit &o)
{
  VectorXd sum;
  moments.add(o.u, o.v, 1.0, 1.0, sum);
  if (o.pair) moments.add(o.v, o.u, 1.0, 1.0, sum);
  return sum;
}

VectorXd weighted(const Moments &moments, VectorXd f, double weight, double area_weight)
{
  f.head(moments.nenergy()) *= weight;
  f.tail(f.size() - moments.nenergy()) *= area_weight;
  return f;
}

VectorXd misfit(const Moments &moments, const Rule &rule)
{
  VectorXd sum = -moments.target();
  for (const Orbit &o : rule) sum += weighted(moments, moments_of(moments, o), o.weight, o.area_weight);
  return sum;
}

// steps in unbounded coordinates, which keep points within the patch and weights positive
Orbit moved(const Orbit &o, double a, double b, double weight, double area_weight)
{
  const double t = 1.0 - o.u - o.v, p = o.u * std::exp(a), q = o.v * std::exp(o.pair ? b : a), sum = t + p + q;
  return {p / sum, q / sum, o.weight * std::exp(weight), o.area_weight * std::exp(area_weight), o.pair};
}

/// Levenberg and Marquardt's method; returns the norm of the misfit.
double improve(const Moments &moments, Rule &rule, int iterations)
{
  constexpr double STEP = 1.0e-5, LARGEST = 0.7;
  VectorXd error = misfit(moments, rule);
  double square = error.squaredNorm(), damping = 1.0e-3;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    int nparameters = 0;
    for (const Orbit &o : rule) nparameters += o.pair ? 4 : 3;
    MatrixXd jacobian(moments.size(), nparameters);
    int column = 0;
    for (const Orbit &o : rule) {
      const VectorXd f = moments_of(moments, o);
      for (int k = 0; k < (o.pair ? 2 : 1); ++k) {
        const VectorXd there = moments_of(moments, moved(o, k == 0 ? STEP : 0.0, k == 1 ? STEP : 0.0, 0.0, 0.0));
        jacobian.col(column++) = weighted(moments, (there - f) / STEP, o.weight, o.area_weight);
      }
      jacobian.col(column++) = weighted(moments, f, o.weight, 0.0);
      jacobian.col(column++) = weighted(moments, f, 0.0, o.area_weight);
    }
    const MatrixXd normal = jacobian.transpose() * jacobian;
    const VectorXd slope = jacobian.transpose() * error;
    const double before = square, least = 1e-12 * normal.diagonal().maxCoeff();
    bool better = false;
    for (int attempt = 0; attempt < 12 && !better; ++attempt) {
      MatrixXd damped = normal;
      damped.diagonal() += damping * (normal.diagonal().array() + least).matrix();
      VectorXd step = damped.ldlt().solve(-slope);
      const double largest = step.cwiseAbs().maxCoeff();
      if (largest > LARGEST) step *= LARGEST / largest;
      Rule next;
      int k = 0;
      for (const Orbit &o : rule) {
        const int w = o.pair ? 2 : 1;
        next.push_back(moved(o, step[k], step[k + w - 1], step[k + w], step[k + w + 1]));
        k += w + 2;
      }
      const VectorXd there = misfit(moments, next);
      better = there.squaredNorm() < square;
      if (better) {
        rule = next;
        error = there;
        square = there.squaredNorm();
      }
      damping = better ? std::max(1e-9, 0.3 * damping) : 4.0 * damping;
    }
    if (!better || square > before * (1.0 - 1e-4)) break;
  }
  return std::sqrt(square);
}

struct Best {
  double misfit = 1e300;
  Rule rule;
};

class Search {
 public:
  Search(const Moments &moments, unsigned seed) : moments_(moments), engine_(seed) {}

  void from_random()
  {
    Rule rule = random_rule();
    offer(rule, improve(moments_, rule, 40));
    while (count(rule) > LEAST) {
      Best next;
      double best = 1e300;
      for (size_t t = 0; t < rule.size(); ++t)
        for (bool merge : {false, true}) {
          Rule less = rule;
          if (!merge) less.erase(less.begin() + t);
          else if (!rule[t].pair) continue;
          else {
            Orbit &o = less[t];
            o.u = o.v = 0.5 * (o.u + o.v);
            o.weight *= 2.0;
            o.area_weight *= 2.0;
            o.pair = false;
          }
          if (count(less) < LEAST) continue;
          const double misfit = improve(moments_, less, 6);
          const double score = misfit * (count(rule) - count(less) == 2 ? 0.6 : 1.0);
          if (score < best) {
            best = score;
            next = {misfit, less};
          }
        }
      if (best == 1e300) break;
      rule = next.rule;
      const double misfit = improve(moments_, rule, 60);
      offer(rule, misfit);
    }
  }

  void finish()
  {
    for (auto &[points, best] : best_) best.misfit = improve(moments_, best.rule, 300);
  }

  const std::map<int, Best> &best() const { return best_; }

 private:
  const Moments &moments_;
  std::mt19937 engine_;
  std::map<int, Best> best_;

  double uniform() { return engine_() / 4294967296.0; }

  void offer(const Rule &rule, double misfit)
  {
    Best &best = best_[count(rule)];
    if (misfit < best.misfit) best = {misfit, rule};
  }

  // denser towards the corner
  Rule random_rule()
  {
    const double spread = 1.0 + (moments_.patch.n > 6 ? 2.0 : 0.6) * uniform();
    const int axis = 2 * static_cast<int>(2.5 * uniform()), pairs = (MOST - axis) / 2;
    Rule rule;
    for (int i = 0; i < axis + pairs; ++i) {
      const double radius = std::pow(0.02 + 0.95 * uniform(), spread);
      const double t = i < axis ? 0.5 : 0.5 + 0.48 * uniform(), weight = 0.9 / MOST * radius;
      rule.push_back({radius * t, radius * (1.0 - t), weight, weight, i >= axis});
    }
    return rule;
  }
};

// === What a rule errs by

struct Errors {
  double quadratic;      // largest error of the products of second derivatives of quadratic shapes, relative
  double least, most;    // of the rule's integral of (laplacian)^2 over the exact one, over all shapes
  double area;
};

Errors errors_of(const Moments &moments, const Rule &rule)
{
  const int m = moments.bent();
  MatrixXd exact = MatrixXd::Zero(m, m), summed = exact, b, q, exact_q, summed_q;
  double exact_area = 0.0, area = 0.0;
  auto add = [&](double u, double v, double weight, double area_weight, MatrixXd &sum, MatrixXd &sum_q, double &sum_area) {
    const double J = moments.second(u, v, b, q);
    const VectorXd laplacian = (b.row(0) + b.row(2)).transpose();
    const VectorXd flat = Eigen::Map<VectorXd>(q.data(), q.size());
    sum += weight * J * laplacian * laplacian.transpose();
    if (sum_q.size() == 0) sum_q = MatrixXd::Zero(flat.size(), flat.size());
    sum_q += weight * J * flat * flat.transpose();
    sum_area += area_weight * J;
  };
  for (const Point &p : moments.points()) add(p.u, p.v, p.weight, p.weight, exact, exact_q, exact_area);
  for (const Orbit &o : rule) {
    add(o.u, o.v, o.weight, o.area_weight, summed, summed_q, area);
    if (o.pair) add(o.v, o.u, o.weight, o.area_weight, summed, summed_q, area);
  }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(exact);
  int none = 0;    // harmonic shapes
  while (solver.eigenvalues()[none] < 1e-7) ++none;
  const MatrixXd range = solver.eigenvectors().rightCols(m - none) *
      solver.eigenvalues().tail(m - none).cwiseSqrt().cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> ratio(range.transpose() * summed * range);
  return {(summed_q - exact_q).cwiseAbs().maxCoeff() / exact_q.cwiseAbs().maxCoeff(), ratio.eigenvalues()[0],
          ratio.eigenvalues()[m - none - 1], area / exact_area - 1.0};
}

Best in_table(const Moments &moments, int points)
{
  Best best;
  for (const CornerPoint &p : corner_points(moments.patch.n, points))
    best.rule.push_back({p.u, p.v, p.weight, p.area_weight, p.u != p.v});
  best.misfit = misfit(moments, best.rule).norm();
  return best;
}

const char *const HEAD = R"(/* -----------------------------------------------------------------------
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

// Written by bench/corner_rules.cpp, which has the meaning of what is said of each rule: do not edit

#include "membrane_quadrature_corners.h"

#include <map>
#include <utility>

using namespace Membrane_NS;

// by valence and number of points: u, v, weight, area_weight

static const std::map<std::pair<int, int>, std::vector<CornerPoint>> RULES = {
)";

const char *const TAIL_OF_FILE = R"(};

const std::vector<CornerPoint> &Membrane_NS::corner_points(int valence, int npoints)
{
  static const std::vector<CornerPoint> none;
  const auto found = RULES.find({valence, npoints});
  return found == RULES.end() ? none : found->second;
}
)";

void write(std::FILE *file, const Moments &moments, int points, const Best &best)
{
  const Errors e = errors_of(moments, best.rule);
  std::fprintf(file, "    // misfit %.1e; quadratic shapes to %.1e; of the energy of any shape %.3f to %.3f; area to %.1e\n",
               best.misfit, e.quadratic, std::fabs(e.least), e.most, std::fabs(e.area));
  std::fprintf(file, "    {{%d, %d},\n     {", moments.patch.n, points);
  for (size_t i = 0; i < best.rule.size(); ++i) {
    Orbit o = best.rule[i];
    if (o.u < o.v) std::swap(o.u, o.v);
    if (!o.pair) o.v = o.u;
    std::fprintf(file, "%s{%.16f, %.16f, %.16f, %.16f}", i ? ",\n      " : "", o.u, o.v, o.weight, o.area_weight);
  }
  std::fprintf(file, "}},\n");
}

}    // namespace

int main(int narg, char **arg)
{
  if (narg != 2) {
    std::fprintf(stderr, "usage: %s FILE\n", arg[0]);
    return 1;
  }
  std::FILE *file = std::fopen(arg[1], "w");
  if (!file) {
    std::perror(arg[1]);
    return 1;
  }
  std::fputs(HEAD, file);
  for (const Wanted &wanted : WANTED) {
    const Moments moments(wanted.valence, wanted.spheres);
    const auto is_missing = [&](int points) { return corner_points(wanted.valence, points).empty(); };
    std::map<int, Best> found;
    if (std::any_of(wanted.points.begin(), wanted.points.end(), is_missing)) {
      Search search(moments, 100 + wanted.valence);
      for (int i = 0; i < wanted.starts; ++i) search.from_random();
      search.finish();
      found = search.best();
      for (const auto &[points, best] : found) write(stdout, moments, points, best);
      std::fflush(stdout);
    }
    for (int points : wanted.points) write(file, moments, points, is_missing(points) ? found[points] : in_table(moments, points));
  }
  std::fputs(TAIL_OF_FILE, file);
  return std::fclose(file) == 0 ? 0 : 1;
}
