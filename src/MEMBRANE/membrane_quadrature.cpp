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

void append(PatchRule &rule, double weight, const Weights &w)
{
  rule.size = static_cast<int>(w.cols());
  rule.npoints++;
  rule.weight.push_back(weight);
  rule.rows.insert(rule.rows.end(), w.data(), w.data() + w.size());
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
    append(rule, child.weight[q], w);
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
  }
}

}    // namespace

// where parts of a face are so narrow that it errs less than the rule itself does elsewhere

static Quadrature cheaper_rule(Quadrature quadrature)
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

PatchRules::PatchRules(Quadrature quadrature) :
    quadrature_(quadrature), triangle_(triangle_rule(quadrature))
{
}

const PatchRule &PatchRules::get(const Valences &valences)
{
  auto found = rules_.find(valences);
  if (found == rules_.end()) found = rules_.emplace(valences, build(valences)).first;
  return found->second;
}

PatchRule PatchRules::build(const Valences &valences)
{
  PatchRule rule;
  const LimitBasis basis(valences);
  if (basis.is_regular()) {
    for (int q = 0; q < triangle_.size(); ++q)
      append(rule, triangle_.weight[q], box_spline(triangle_.u[q], triangle_.v[q]));
    return rule;
  }

  const PatchRule &regular = get({6, 6, 6});
  for (int child = 0; child < 4; ++child) {
    MatrixXd matrix = basis.child_matrix(child);
    const RowVectorXd mask = basis.corner_mask(child % 3);
    if (child == 3 || valences[child] == 6) {
      append_child(rule, regular, matrix, mask);
      continue;
    }

    // the tip's rule has its extraordinary vertex in slot 0: turn the child's rows to match

    const int n = valences[child], k = child, next = (k + 1) % 3, prev = (k + 2) % 3;
    const int list_length[3] = {k == 0 ? n - 3 : 3, k == 1 ? n - 3 : 3, k == 2 ? n - 3 : 3};
    const int list_start[3] = {3, 3 + list_length[0], 3 + list_length[0] + list_length[1]};
    MatrixXd turned(matrix.rows(), matrix.cols());
    int row = 0;
    for (int c : {k, next, prev}) turned.row(row++) = matrix.row(c);
    for (int c : {k, next, prev})
      for (int i = 0; i < list_length[c]; ++i) turned.row(row++) = matrix.row(list_start[c] + i);
    append_child(rule, graded(n), turned, mask);
  }
  return rule;
}

/* ----------------------------------------------------------------------
   The patch (n, 6, 6): at each level three regular children, then the tip. A patch of the next
   level has the same layout, with control points A times those of this level.
------------------------------------------------------------------------- */

const PatchRule &PatchRules::graded(int n)
{
  auto found = tips_.find(n);
  if (found != tips_.end()) return found->second;

  const double tolerance = quadrature_ == Quadrature::CAREFUL ? 1.0e-11 : 1.0e-4;
  const int levels = static_cast<int>(std::ceil(std::log(tolerance) / std::log(energy_decay(n))));

  const LimitBasis basis({n, 6, 6});
  const MatrixXd to_next = basis.child_matrix(0);
  const RowVectorXd mask = basis.corner_mask(0);
  const double shrink = subdominant_eigenvalue(n);

  PatchRule level = regular_children(basis, quadrature_), tip, rule;
  const Quadrature cheaper = cheaper_rule(quadrature_);
  for (int q = 0; q < triangle_.size(); ++q)
    append(tip, triangle_.weight[q], basis.evaluate(triangle_.u[q], triangle_.v[q]));

  for (int depth = 1; depth < levels; ++depth) {
    for (int q = 0; q < level.npoints; ++q)
      append(rule, level.weight[q],
             Eigen::Map<const Weights>(level.row(q, 0), LimitBasis::ROWS, level.size));
    if (depth == 1) level = regular_children(basis, cheaper);
    for (PatchRule *part : {&level, &tip}) {
      PatchRule next;
      append_child(next, *part, to_next, mask);
      rescale(next, shrink);
      *part = std::move(next);
    }
  }
  for (int q = 0; q < tip.npoints; ++q)
    append(rule, tip.weight[q],
           Eigen::Map<const Weights>(tip.row(q, 0), LimitBasis::ROWS, tip.size));
  return tips_[n] = std::move(rule);
}

// of the patch (n, 6, 6)

PatchRule PatchRules::regular_children(const LimitBasis &basis, Quadrature quadrature) const
{
  const TriangleRule triangle = triangle_rule(quadrature);
  PatchRule regular, rule;
  for (int q = 0; q < triangle.size(); ++q)
    append(regular, triangle.weight[q], box_spline(triangle.u[q], triangle.v[q]));
  for (int child = 1; child < 4; ++child)
    append_child(rule, regular, basis.child_matrix(child), basis.corner_mask(0));
  return rule;
}

double PatchRules::memory_usage() const
{
  double bytes = 0.0;
  for (const auto &entry : rules_) bytes += sizeof(double) * entry.second.rows.size();
  for (const auto &entry : tips_) bytes += sizeof(double) * entry.second.rows.size();
  return bytes;
}
