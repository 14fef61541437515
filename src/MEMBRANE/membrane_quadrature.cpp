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

#include "membrane_quadrature.h"

#include "membrane_quadrature_corners.h"

#include <algorithm>
#include <cmath>

using namespace Membrane_NS;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Weights = LimitBasis::Weights;

static const std::map<std::string, Quadrature> NAMES = {{"1", Quadrature::ONE},
                                                        {"3", Quadrature::THREE},
                                                        {"6", Quadrature::SIX},
                                                        {"12", Quadrature::TWELVE},
                                                        {"careful", Quadrature::CAREFUL}};

bool Membrane_NS::parse_quadrature(const std::string &word, Quadrature &quadrature)
{
  const auto found = NAMES.find(word);
  if (found == NAMES.end()) return false;
  quadrature = found->second;
  return true;
}

std::string Membrane_NS::quadrature_name(Quadrature quadrature)
{
  for (const auto &[name, value] : NAMES)
    if (value == quadrature) return name;
  return "";
}

/* ----------------------------------------------------------------------
   Symmetric Gauss rules [G. Strang and G. Fix, 1973; D. Dunavant, IJNME 21, 1129, 1985], and for
   CAREFUL the product of two Gauss-Legendre rules on the square folded into the triangle.
------------------------------------------------------------------------- */

namespace {

// the points with barycentric coordinates (1-2a, a, a) in all orders, weight w of a total of 1
void add_orbit3(TriangleRule &rule, double a, double w)
{
  const double b = 1.0 - 2.0 * a;
  for (auto [u, v] : {std::pair(a, a), std::pair(b, a), std::pair(a, b)}) {
    rule.u.push_back(u);
    rule.v.push_back(v);
    rule.weight.push_back(0.5 * w);
  }
}

// the points with barycentric coordinates (a, b, 1-a-b) in all orders
void add_orbit6(TriangleRule &rule, double a, double b, double w)
{
  const double c = 1.0 - a - b;
  for (auto [u, v] : {std::pair(a, b), std::pair(b, a), std::pair(a, c), std::pair(c, a),
                      std::pair(b, c), std::pair(c, b)}) {
    rule.u.push_back(u);
    rule.v.push_back(v);
    rule.weight.push_back(0.5 * w);
  }
}

// Gauss-Legendre nodes and weights on [0, 1] by Newton's iteration on the Legendre polynomial
void gauss_legendre(int n, std::vector<double> &x, std::vector<double> &w)
{
  x.resize(n);
  w.resize(n);
  for (int i = 0; i < n; ++i) {
    double t = std::cos(M_PI * (i + 0.75) / (n + 0.5)), slope = 1.0;
    for (int iteration = 0; iteration < 100; ++iteration) {
      double p0 = 1.0, p1 = t;
      for (int k = 2; k <= n; ++k) {
        const double p2 = ((2.0 * k - 1.0) * t * p1 - (k - 1.0) * p0) / k;
        p0 = p1;
        p1 = p2;
      }
      slope = n * (t * p1 - p0) / (t * t - 1.0);
      const double step = p1 / slope;
      t -= step;
      if (std::fabs(step) < 1.0e-15) break;
    }
    x[i] = 0.5 * (1.0 - t);
    w[i] = 1.0 / ((1.0 - t * t) * slope * slope);
  }
}

constexpr int CAREFUL_POINTS = 10;    // per direction

}    // namespace

TriangleRule Membrane_NS::triangle_rule(Quadrature quadrature)
{
  TriangleRule rule;
  switch (quadrature) {
    case Quadrature::ONE:
      rule = {{1.0 / 3.0}, {1.0 / 3.0}, {0.5}};
      break;
    case Quadrature::THREE:
      add_orbit3(rule, 1.0 / 6.0, 1.0 / 3.0);
      break;
    case Quadrature::SIX:
      add_orbit3(rule, 0.445948490915964886318, 0.223381589678011465944);
      add_orbit3(rule, 0.091576213509770743460, 0.109951743655321867389);
      break;
    case Quadrature::TWELVE:
      add_orbit3(rule, 0.249286745170910421291, 0.116786275726379366030);
      add_orbit3(rule, 0.063089014491502228340, 0.050844906370206816921);
      add_orbit6(rule, 0.053145049844816947353, 0.310352451033784405416,
                 0.082851075618373575194);
      break;
    case Quadrature::CAREFUL: {
      std::vector<double> x, w;
      gauss_legendre(CAREFUL_POINTS, x, w);
      for (int i = 0; i < CAREFUL_POINTS; ++i)
        for (int j = 0; j < CAREFUL_POINTS; ++j) {
          rule.u.push_back(x[i]);
          rule.v.push_back((1.0 - x[i]) * x[j]);
          rule.weight.push_back(w[i] * w[j] * (1.0 - x[i]));
        }
      break;
    }
  }
  return rule;
}

/* ----------------------------------------------------------------------
   assembling patch rules
------------------------------------------------------------------------- */

namespace {

void append(PatchRule &rule, double weight, double area_weight, const Weights &w)
{
  rule.size = static_cast<int>(w.cols());
  rule.npoints++;
  rule.weight.push_back(weight);
  rule.area_weight.push_back(area_weight);
  rule.rows.insert(rule.rows.end(), w.data(), w.data() + w.size());
}

// the points of another rule of the same patch
void append(PatchRule &rule, const PatchRule &more)
{
  for (int q = 0; q < more.npoints; ++q)
    append(rule, more.weight[q], more.area_weight[q],
           Eigen::Map<const Weights>(more.row(q, 0), LimitBasis::ROWS, more.size));
}

PatchRule regular_patch(Quadrature quadrature)
{
  const TriangleRule triangle = triangle_rule(quadrature);
  PatchRule rule;
  for (int q = 0; q < triangle.size(); ++q)
    append(rule, triangle.weight[q], triangle.weight[q], box_spline(triangle.u[q], triangle.v[q]));
  return rule;
}

PatchRule regular_face(Quadrature quadrature)
{
  PatchRule rule = regular_patch(quadrature);
  rule.threefold = threefold_points(rule.weight, rule.area_weight, rule.rows);
  return rule;
}

// express the points of a child's rule in its parent's control points; derivative rows are kept
// free of a net weight, see LimitBasis::evaluate()
void append_child(PatchRule &rule, const PatchRule &child, const MatrixXd &matrix,
                  const RowVectorXd &mask)
{
  for (int q = 0; q < child.npoints; ++q) {
    Weights w = Eigen::Map<const Weights>(child.row(q, 0), LimitBasis::ROWS, child.size) * matrix;
    for (int row = LimitBasis::DU; row <= LimitBasis::DVV; ++row)
      w.row(row) -= w.row(row).sum() * mask;
    append(rule, child.weight[q], child.area_weight[q], w);
  }
}

// measure derivatives in parameters that are `factor` times as large
void rescale(PatchRule &rule, double factor)
{
  for (int q = 0; q < rule.npoints; ++q) {
    Eigen::Map<Weights> w(rule.rows.data() + (size_t) q * LimitBasis::ROWS * rule.size,
                          LimitBasis::ROWS, rule.size);
    w.middleRows(LimitBasis::DU, 2) /= factor;
    w.middleRows(LimitBasis::DUU, 3) /= factor * factor;
    rule.weight[q] *= factor * factor;
    rule.area_weight[q] *= factor * factor;
  }
}

// the patch (n, 6, 6) by points fitted to its corner, mirror images included; without points if there are none
PatchRule fitted_patch(int n, int npoints)
{
  PatchRule rule;
  const LimitBasis basis({n, 6, 6});
  auto add = [&](double u, double v, const CornerPoint &point) {
    // derivatives in parameters as large as the part that subdivision finds the point in
    const double size = std::pow(0.5, std::max(0.0, std::floor(-std::log2(u + v))));
    Weights w = basis.evaluate(u, v);
    w.middleRows(LimitBasis::DU, 2) *= size;
    w.middleRows(LimitBasis::DUU, 3) *= size * size;
    append(rule, point.weight / (size * size), point.area_weight / (size * size), w);
  };
  for (const CornerPoint &point : corner_points(n, npoints)) {
    add(point.u, point.v, point);
    if (point.u != point.v) add(point.v, point.u, point);
  }
  return rule;
}

}    // namespace

// where parts of a face are so small that it errs less than the rule itself does elsewhere

static Quadrature coarser_rule(Quadrature quadrature)
{
  switch (quadrature) {
    case Quadrature::SIX:
      return Quadrature::THREE;
    case Quadrature::TWELVE:
      return Quadrature::SIX;
    default:
      return quadrature;
  }
}

// where faces are so narrow that the rule errs more than elsewhere

static Quadrature finer_rule(Quadrature quadrature)
{
  switch (quadrature) {
    case Quadrature::THREE:
      return Quadrature::SIX;
    case Quadrature::SIX:
      return Quadrature::TWELVE;
    default:
      return quadrature;
  }
}

// points of quarters are the same if their weights are
static constexpr double SAME_POINT = 1e-12;

// a face with one extraordinary corner; the quarter at such a corner of other faces

enum class CornerPatch { FACE, QUARTER };

// How many points of a fitted rule it takes; 0: it has none. A quarter has a fourth of the energy, so it may err more, and
// curvature varies the more the larger the valence. Valence 3 is rare; with 12 and 16 points forces with leaflets missed their
// differences by 8e-7

static int points_on(CornerPatch patch, int valence, Quadrature quadrature)
{
  struct Points {
    int face_of_three, face_of_six, quarter;
  };
  static const std::map<int, Points> points = {{4, {10, 16, 7}}, {5, {10, 16, 7}}, {7, {10, 15, 8}}, {8, {12, 18, 10}},
                                               {9, {0, 0, 20}},  {10, {0, 0, 20}}, {11, {0, 0, 22}}, {12, {0, 0, 20}}};
  const auto found = points.find(valence);
  if (found == points.end() || (quadrature != Quadrature::THREE && quadrature != Quadrature::SIX)) return 0;
  if (patch == CornerPatch::QUARTER) return found->second.quarter;
  return quadrature == Quadrature::THREE ? found->second.face_of_three : found->second.face_of_six;
}

PatchRules::PatchRules(Quadrature quadrature) : PatchRules(quadrature, finer_rule(quadrature)) {}

PatchRules::PatchRules(Quadrature quadrature, Quadrature narrow) :
    quadrature_(quadrature), narrow_(narrow), triangle_(triangle_rule(quadrature))
{
}

const PatchRule &PatchRules::get(const Valences &valences)
{
  auto found = rules_.find(valences);
  if (found == rules_.end()) found = rules_.emplace(valences, build(valences)).first;
  return found->second;
}

const PatchRule &PatchRules::squeezed()
{
  if (narrow_ == quadrature_) return get({6, 6, 6});
  if (squeezed_.npoints == 0) squeezed_ = regular_face(narrow_);
  return squeezed_;
}

/* ----------------------------------------------------------------------
   rows of a matrix that gives the control points of a patch whose extraordinary corner is in slot k, in
   the order of one where it is in slot 0
------------------------------------------------------------------------- */

static MatrixXd turned(const MatrixXd &matrix, int n, int k)
{
  const int next = (k + 1) % 3, prev = (k + 2) % 3;
  const int length[3] = {k == 0 ? n - 3 : 3, k == 1 ? n - 3 : 3, k == 2 ? n - 3 : 3};
  const int start[3] = {3, 3 + length[0], 3 + length[0] + length[1]};
  MatrixXd rows(matrix.rows(), matrix.cols());
  int row = 0;
  for (int c : {k, next, prev}) rows.row(row++) = matrix.row(c);
  for (int c : {k, next, prev})
    for (int i = 0; i < length[c]; ++i) rows.row(row++) = matrix.row(start[c] + i);
  return rows;
}

// a quarter has its extraordinary corner, if there is one, first

static int quarter_valence(const Valences &valences, int child)
{
  return child == 3 ? 6 : valences[child];
}

static MatrixXd quarter_matrix(const LimitBasis &basis, const Valences &valences, int child)
{
  const int n = quarter_valence(valences, child);
  return n == 6 ? basis.child_matrix(child) : turned(basis.child_matrix(child), n, child);
}

const PatchRule &PatchRules::quarter(const Valences &valences, int child)
{
  const int n = quarter_valence(valences, child);
  if (n != 6) return tip(n);
  return *std::max_element(valences.begin(), valences.end()) >= SQUEEZING_VALENCE ? squeezed() : get({6, 6, 6});
}

FaceCut PatchRules::cut(const LimitBasis &basis, const Valences &valences)
{
  FaceCut cut;
  std::vector<RowVectorXd> points;
  for (int child = 0; child < 4; ++child) {
    const MatrixXd matrix = quarter_matrix(basis, valences, child);
    FaceCut::Quarter quarter = {&this->quarter(valences, child), {}};
    for (int row = 0; row < matrix.rows(); ++row) {
      const RowVectorXd point = matrix.row(row);
      const auto same = std::find_if(points.begin(), points.end(), [&](const RowVectorXd &other) {
        return (other - point).cwiseAbs().maxCoeff() < SAME_POINT;
      });
      quarter.points.push_back(static_cast<int>(same - points.begin()));
      if (same == points.end()) points.push_back(point);
    }
    cut.quarters.push_back(std::move(quarter));
  }
  cut.start.push_back(0);
  for (const RowVectorXd &point : points) {
    for (int k = 0; k < point.size(); ++k) {
      if (point[k] == 0.0) continue;
      cut.from.push_back(k);
      cut.weight.push_back(point[k]);
    }
    cut.start.push_back(static_cast<int>(cut.from.size()));
  }
  return cut;
}

PatchRule PatchRules::build(const Valences &valences)
{
  const LimitBasis basis(valences);
  if (basis.is_regular()) return regular_face(quadrature_);

  PatchRule rule;
  int corners = 0, k = 0;    // k: the last of them
  for (int i = 0; i < 3; ++i)
    if (valences[i] != 6) ++corners, k = i;
  const PatchRule face = corners == 1 ? fitted_patch(valences[k], points_on(CornerPatch::FACE, valences[k], quadrature_))
                                      : PatchRule();
  if (face.npoints > 0) {
    const MatrixXd same = MatrixXd::Identity(basis.size(), basis.size());
    append_child(rule, face, turned(same, valences[k], k), basis.corner_mask(k));
    return rule;
  }

  for (int child = 0; child < 4; ++child)
    append_child(rule, quarter(valences, child), quarter_matrix(basis, valences, child), basis.corner_mask(child % 3));
  rule.cut = cut(basis, valences);
  return rule;
}

const PatchRule &PatchRules::tip(int n)
{
  auto found = tips_.find(n);
  if (found != tips_.end()) return found->second;
  PatchRule rule = fitted_patch(n, points_on(CornerPatch::QUARTER, n, quadrature_));
  if (rule.npoints == 0) rule = graded(n);
  return tips_[n] = std::move(rule);
}

/* ----------------------------------------------------------------------
   The patch (n, 6, 6): at each level three regular children, then the tip. A patch of the next
   level has the same layout, with control points A times those of this level.
------------------------------------------------------------------------- */

PatchRule PatchRules::graded(int n) const
{
  const LimitBasis basis({n, 6, 6});
  const MatrixXd to_next = basis.child_matrix(0);
  const RowVectorXd mask = basis.corner_mask(0);
  const double shrink = subdominant_eigenvalue(n);

  const Quadrature quadrature = n >= SQUEEZING_VALENCE ? narrow_ : quadrature_;
  PatchRule level = regular_children(basis, quadrature), rule;
  PatchRule tip;
  for (int q = 0; q < triangle_.size(); ++q)
    append(tip, triangle_.weight[q], triangle_.weight[q], basis.evaluate(triangle_.u[q], triangle_.v[q]));
  const double tolerance = quadrature_ == Quadrature::CAREFUL ? 1.0e-11 : 1.0e-4;
  const int levels = static_cast<int>(std::ceil(std::log(tolerance) / std::log(energy_decay(n))));

  for (int depth = 1; depth < levels; ++depth) {
    append(rule, level);
    if (depth == 1) level = regular_children(basis, coarser_rule(quadrature));
    for (PatchRule *part : {&level, &tip}) {
      PatchRule next;
      append_child(next, *part, to_next, mask);
      rescale(next, shrink);
      *part = std::move(next);
    }
  }
  append(rule, tip);
  return rule;
}

// of the patch (n, 6, 6)

PatchRule PatchRules::regular_children(const LimitBasis &basis, Quadrature quadrature) const
{
  const PatchRule regular = regular_patch(quadrature);
  PatchRule rule;
  for (int child = 1; child < 4; ++child)
    append_child(rule, regular, basis.child_matrix(child), basis.corner_mask(0));
  return rule;
}

double PatchRules::memory_usage() const
{
  double bytes = 0.0;
  for (const auto &entry : rules_) bytes += sizeof(double) * entry.second.rows.size();
  for (const auto &entry : tips_) bytes += sizeof(double) * entry.second.rows.size();
  bytes += sizeof(double) * squeezed_.rows.size();
  return bytes;
}
