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

#include "membrane_quadrature.h"

#include "membrane_quadrature_corners.h"
#include "scene.h"

#include <gtest/gtest.h>

using namespace Membrane_TEST;
using Eigen::RowVectorXd;
using Planar = Eigen::Matrix<double, Eigen::Dynamic, 2>;
using Weights = LimitBasis::Weights;

namespace {

// the valences with rules of few points
constexpr int FITTED[] = {4, 5, 7, 8, 9, 10, 11, 12};

// integral of u^a v^b over the triangle
double monomial(int a, int b)
{
  return std::tgamma(a + 1.0) * std::tgamma(b + 1.0) / std::tgamma(a + b + 3.0);
}

// faces with one, two and three extraordinary corners, every valence from 3 to 16 among them
std::vector<Valences> triples()
{
  std::vector<Valences> list = {{6, 6, 6}, {3, 3, 3}, {5, 5, 5}, {3, 12, 7}, {6, 4, 16}, {9, 6, 5}};
  for (int n = 3; n <= 16; ++n) {
    list.push_back({n, 6, 6});
    if (n % 4 == 0) list.push_back({n, 4, 5});
  }
  return list;
}

Planar random_points(int count, unsigned seed)
{
  Random random(seed);
  Planar points(count, 2);
  for (int i = 0; i < count; ++i) points.row(i) << random.symmetric(), random.symmetric();
  return points;
}

// area and first moment in x of the limit of a flat patch, over its parameters
struct Flat {
  double area = 0.0, moment = 0.0;
};

Flat by_rule(const PatchRule &rule, const Planar &points)
{
  Flat sum;
  for (int q = 0; q < rule.npoints; ++q) {
    const Eigen::Map<const Weights> w(rule.row(q, 0), LimitBasis::ROWS, rule.size);
    const Eigen::Matrix<double, LimitBasis::ROWS, 2> r = w * points;
    const double density =
        r(LimitBasis::DU, 0) * r(LimitBasis::DV, 1) - r(LimitBasis::DU, 1) * r(LimitBasis::DV, 0);
    sum.area += rule.area_weight[q] * density;
    sum.moment += rule.area_weight[q] * density * r(LimitBasis::VALUE, 0);
  }
  return sum;
}

// The same as integrals along the border, x dy and x^2/2 dy. An edge is a quartic between
// neighbouring points 2^-k from its ends, where six Gauss points are exact for both.
Flat by_border(const Valences &valences, const Planar &points)
{
  const double node[3] = {0.2386191860831969, 0.6612093864662645, 0.9324695142031521};
  const double weight[3] = {0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
  const int depth = 29;
  const LimitBasis basis(valences);
  Flat sum;
  for (int k = 0; k < 3; ++k) {
    auto at = [&](double s) -> Eigen::Matrix<double, 2, 2> {    // position; derivative in s
      double t[3] = {0.0, 0.0, 0.0};
      t[k] = 1.0 - s;
      t[(k + 1) % 3] = s;
      const Weights w = basis.evaluate(t[1], t[2]);
      const double du = (k == 0) - (k == 1), dv = (k == 1) - (k == 2);
      Eigen::Matrix<double, 2, 2> r;
      r.row(0) = w.row(LimitBasis::VALUE) * points;
      r.row(1) = (du * w.row(LimitBasis::DU) + dv * w.row(LimitBasis::DV)) * points;
      return r;
    };
    auto piece = [&](double a, double b) {
      for (int i = 0; i < 3; ++i)
        for (double side : {-1.0, 1.0}) {
          const auto r = at(0.5 * (a + b) + 0.5 * (b - a) * side * node[i]);
          const double dy = 0.5 * (b - a) * weight[i] * r(1, 1);
          sum.area += r(0, 0) * dy;
          sum.moment += 0.5 * r(0, 0) * r(0, 0) * dy;
        }
    };
    auto chord = [&](double a, double b) {    // what is left at the corner
      const auto from = at(a), to = at(b);
      const double x = 0.5 * (from(0, 0) + to(0, 0)), dy = to(0, 1) - from(0, 1);
      sum.area += x * dy;
      sum.moment += 0.5 * x * x * dy;
    };
    for (int level = 1; level < depth; ++level) {
      piece(std::ldexp(0.5, -level), std::ldexp(1.0, -level));
      piece(1.0 - std::ldexp(1.0, -level), 1.0 - std::ldexp(0.5, -level));
    }
    chord(0.0, std::ldexp(1.0, -depth));
    chord(1.0 - std::ldexp(1.0, -depth), 1.0);
  }
  return sum;
}

// faces with random flat control points, and their exact integrals
struct Sample {
  Valences valences;
  Planar points;
  Flat exact;
};

const std::vector<Sample> &samples()
{
  static const std::vector<Sample> list = [] {
    std::vector<Sample> made;
    unsigned seed = 0;
    const std::vector<Valences> all = triples();
    for (size_t i = 0; i < all.size(); i += STRIDE) {
      const Valences &n = all[i];
      const Planar points = random_points(LimitBasis(n).size(), ++seed);
      made.push_back({n, points, by_border(n, points)});
    }
    return made;
  }();
  return list;
}

std::string text(const Valences &n)
{
  return std::to_string(n[0]) + ", " + std::to_string(n[1]) + ", " + std::to_string(n[2]);
}

}    // namespace

// === On the triangle

TEST(TriangleRule, WeightsArePositiveAndSumToTheTriangle)
{
  for (Quadrature quadrature : ALL_QUADRATURES) {
    const TriangleRule rule = triangle_rule(quadrature);
    double sum = 0.0;
    for (int q = 0; q < rule.size(); ++q) {
      EXPECT_GT(rule.weight[q], 0.0);
      EXPECT_GT(std::min({rule.u[q], rule.v[q], 1.0 - rule.u[q] - rule.v[q]}), 0.0);
      sum += rule.weight[q];
    }
    EXPECT_NEAR(sum, 0.5, 1e-14) << name(quadrature);
  }
}

TEST(TriangleRule, IsExactToItsDegreeAndNoFurther)
{
  const std::map<Quadrature, int> degrees = {{Quadrature::ONE, 1},
                                             {Quadrature::THREE, 2},
                                             {Quadrature::SIX, 4},
                                             {Quadrature::TWELVE, 6},
                                             {Quadrature::CAREFUL, 18}};
  for (const auto &[quadrature, degree] : degrees) {
    const TriangleRule rule = triangle_rule(quadrature);
    double beyond = 0.0;
    for (int a = 0; a <= degree + 2; ++a)
      for (int b = 0; a + b <= degree + 2; ++b) {
        double sum = 0.0;
        for (int q = 0; q < rule.size(); ++q)
          sum += rule.weight[q] * std::pow(rule.u[q], a) * std::pow(rule.v[q], b);
        const double error = std::fabs(sum - monomial(a, b));
        if (a + b <= degree)
          EXPECT_LT(error, 1e-14) << name(quadrature) << " u^" << a << " v^" << b;
        else
          beyond = std::max(beyond, error / monomial(a, b));
      }
    EXPECT_GT(beyond, 1e-12) << name(quadrature);
  }
}

TEST(TriangleRule, HasTheNumberOfPointsInItsName)
{
  EXPECT_EQ(triangle_rule(Quadrature::ONE).size(), 1);
  EXPECT_EQ(triangle_rule(Quadrature::THREE).size(), 3);
  EXPECT_EQ(triangle_rule(Quadrature::SIX).size(), 6);
  EXPECT_EQ(triangle_rule(Quadrature::TWELVE).size(), 12);
}

TEST(TriangleRule, IsChosenByTheWordsOfThePairStyle)
{
  const std::map<std::string, Quadrature> words = {{"1", Quadrature::ONE},
                                                   {"3", Quadrature::THREE},
                                                   {"6", Quadrature::SIX},
                                                   {"12", Quadrature::TWELVE},
                                                   {"careful", Quadrature::CAREFUL}};
  for (const auto &[word, expected] : words) {
    Quadrature quadrature = expected == Quadrature::ONE ? Quadrature::SIX : Quadrature::ONE;
    EXPECT_TRUE(parse_quadrature(word, quadrature));
    EXPECT_EQ(quadrature, expected);
  }
  for (const std::string word : {"", "2", "six", "06", "1.0", "Careful"}) {
    Quadrature quadrature = Quadrature::TWELVE;
    EXPECT_FALSE(parse_quadrature(word, quadrature)) << word;
    EXPECT_EQ(quadrature, Quadrature::TWELVE);
  }
}

// === On faces

TEST(PatchRules, CarryTheBasisOfARegularFaceAtThePointsOfTheTriangle)
{
  for (Quadrature quadrature : ALL_QUADRATURES) {
    const TriangleRule triangle = triangle_rule(quadrature);
    const PatchRule &rule = shared_rules(quadrature).get({6, 6, 6});
    ASSERT_EQ(rule.size, 12);
    ASSERT_EQ(rule.npoints, triangle.size());
    for (int q = 0; q < rule.npoints; ++q) {
      EXPECT_EQ(rule.weight[q], triangle.weight[q]);
      const Eigen::Map<const Weights> w(rule.row(q, 0), LimitBasis::ROWS, rule.size);
      EXPECT_LT((w - box_spline(triangle.u[q], triangle.v[q])).norm(), 1e-15);
    }
  }
}

TEST(PatchRules, ArePartitionsOfUnityWithDerivativesOfTheOrderOfAnEdge)
{
  for (Quadrature quadrature : {Quadrature::THREE, Quadrature::CAREFUL})
    for (const Valences &n : {Valences{3, 6, 6}, {5, 5, 5}, {6, 7, 6}, {4, 16, 4}, {3, 3, 3}}) {
      const PatchRule &rule = shared_rules(quadrature).get(n);
      EXPECT_EQ(rule.size, LimitBasis(n).size());
      double sum = 0.0, value = 0.0, derivative = 0.0, most = 0.0, least = 1.0;
      for (int q = 0; q < rule.npoints; ++q) {
        const Eigen::Map<const Weights> w(rule.row(q, 0), LimitBasis::ROWS, rule.size);
        sum += rule.weight[q];
        value = std::max(value, std::fabs(w.row(LimitBasis::VALUE).sum() - 1.0));
        for (int row = LimitBasis::DU; row < LimitBasis::ROWS; ++row)
          derivative = std::max(derivative, std::fabs(w.row(row).sum()) / w.row(row).norm());
        const double size = w.middleRows(LimitBasis::DU, 2).norm();
        most = std::max(most, size);
        least = std::min(least, size);
      }
      EXPECT_LT(value, 1e-12);
      EXPECT_LT(derivative, 1e-14);
      EXPECT_GT(least, 0.005);
      EXPECT_LT(most, 5.0);
      EXPECT_GT(sum, 0.0);
    }
}

TEST(PatchRules, CarefulIntegratesAFlatFaceExactlyForEveryValence)
{
  double worst = 0.0;
  for (size_t i = 0; i < samples().size(); i += SANITIZED ? 3 : 1) {
    const auto &[n, points, exact] = samples()[i];
    const Flat rule = by_rule(shared_rules(Quadrature::CAREFUL).get(n), points);
    const double error =
        std::max(std::fabs(rule.area - exact.area), std::fabs(rule.moment - exact.moment));
    EXPECT_LT(error, 1e-12) << text(n);
    worst = std::max(worst, error);
  }
  RecordProperty("worst_error", scientific(worst));
}

// the area density is of degree 6: only the tip is not exact
TEST(PatchRules, TwelveIntegratesTheAreaOfAFlatFaceButForTheTip)
{
  double worst = 0.0;
  for (const auto &[n, points, exact] : samples()) {
    const double error =
        std::fabs(by_rule(shared_rules(Quadrature::TWELVE).get(n), points).area - exact.area);
    EXPECT_LT(error, LimitBasis(n).is_regular() ? 1e-14 : 1e-7) << text(n);
    worst = std::max(worst, error);
  }
  RecordProperty("worst_error", scientific(worst));
}

TEST(PatchRules, MorePointsAreMoreAccurate)
{
  double previous = 1.0;
  for (Quadrature quadrature : ALL_QUADRATURES) {
    double sum = 0.0;
    int count = 0;
    for (size_t i = 0; i < samples().size(); i += SANITIZED ? 3 : 1) {
      const auto &[n, points, exact] = samples()[i];
      const double error = by_rule(shared_rules(quadrature).get(n), points).moment - exact.moment;
      sum += error * error;
      ++count;
    }
    const double error = std::sqrt(sum / count);
    RecordProperty(name(quadrature), scientific(error));
    EXPECT_LT(error, 0.2 * previous) << name(quadrature);
    previous = error;
  }
}

TEST(PatchRules, CountOfPointsFollowsFromTheValence)
{
  // parts of a graded face with one extraordinary corner: 3, then 3 a level, then the tip; from the third cut on
  // the 3 take the next coarser rule. Around large valences they take the next finer one
  const std::map<int, int> parts = {{3, 22}, {5, 19}, {8, 37}, {16, 151}};
  constexpr int WIDE = 3 + 3;
  struct Rules {
    Quadrature own, wide, small;
  };
  const Rules graded[] = {{Quadrature::ONE, Quadrature::ONE, Quadrature::ONE},
                          {Quadrature::THREE, Quadrature::THREE, Quadrature::THREE},
                          {Quadrature::SIX, Quadrature::SIX, Quadrature::THREE},
                          {Quadrature::TWELVE, Quadrature::TWELVE, Quadrature::SIX}};
  const Rules narrow[] = {{Quadrature::ONE, Quadrature::ONE, Quadrature::ONE},
                          {Quadrature::THREE, Quadrature::SIX, Quadrature::THREE},
                          {Quadrature::SIX, Quadrature::TWELVE, Quadrature::SIX},
                          {Quadrature::TWELVE, Quadrature::TWELVE, Quadrature::SIX}};
  for (const auto &[n, count] : parts)
    for (const Rules &r : n == 16 ? narrow : graded) {
      const bool fitted = n != 3 && n <= 12 && (r.own == Quadrature::THREE || r.own == Quadrature::SIX);
      if (fitted) continue;
      EXPECT_EQ(shared_rules(r.own).get({n, 6, 6}).npoints,
                WIDE * triangle_rule(r.wide).size() + (count - WIDE - 1) * triangle_rule(r.small).size() + triangle_rule(r.own).size())
          << "valence " << n;
    }
  for (const Rules &r : narrow) EXPECT_EQ(shared_rules(r.own).squeezed().npoints, triangle_rule(r.wide).size());
  PatchRules other(Quadrature::TWELVE, Quadrature::SIX);    // what the default rule is compared with
  EXPECT_EQ(other.get({6, 6, 6}).npoints, 12);
  EXPECT_EQ(other.squeezed().npoints, 6);
  EXPECT_EQ(other.get({16, 6, 6}).npoints, WIDE * 6 + (parts.at(16) - WIDE - 1) * 3 + 12);

  const PatchRules fresh(Quadrature::SIX);
  EXPECT_EQ(fresh.quadrature(), Quadrature::SIX);
}

TEST(PatchRules, FittedPointsAreFew)
{
  struct Number {
    int whole, whole_of_three, quarter;
  };
  const std::map<int, Number> numbers = {{4, {16, 10, 7}}, {5, {16, 10, 7}}, {7, {15, 10, 8}}, {8, {18, 12, 10}}};
  PatchRules &three = shared_rules(Quadrature::THREE), &six = shared_rules(Quadrature::SIX);
  for (const auto &[n, number] : numbers) {
    EXPECT_EQ(three.get({n, 6, 6}).npoints, number.whole_of_three) << n;
    EXPECT_EQ(six.get({6, n, 6}).npoints, number.whole) << n;
    EXPECT_EQ(three.get({n, 5, 6}).npoints, 2 * 3 + number.quarter + 7) << n;
    EXPECT_EQ(six.get({n, 5, 6}).npoints, 2 * 6 + number.quarter + 7) << n;
    EXPECT_EQ(six.get({n, 5, n}).npoints, 6 + 2 * number.quarter + 7) << n;
    EXPECT_EQ(six.get({n, 9, 6}).npoints, 2 * 6 + number.quarter + 20) << n;
  }
  for (int n = 9; n <= 12; ++n)
    for (auto [rules, regular] : {std::pair(&three, 3), std::pair(&six, 6)})
      EXPECT_EQ(rules->get({n, 6, 6}).npoints, 3 * (n > 10 ? 2 : 1) * regular + (n == 11 ? 22 : 20)) << n;
}

TEST(PatchRules, AreBuiltOnceAndStayWhereTheyAre)
{
  PatchRules rules(Quadrature::THREE);
  EXPECT_EQ(rules.memory_usage(), 0.0);
  const PatchRule &first = rules.get({5, 6, 6});
  const double *data = first.rows.data();
  const int npoints = first.npoints;
  for (int n = 3; n < 12; ++n) rules.get({n, 6, 6});
  EXPECT_EQ(&rules.get({5, 6, 6}), &first);
  EXPECT_EQ(first.rows.data(), data);
  EXPECT_EQ(first.npoints, npoints);
  EXPECT_GE(rules.memory_usage(), sizeof(double) * first.rows.size());
}

// === Fitted

TEST(CornerPoints, AreInsideWithPositiveWeights)
{
  for (int n : FITTED)
    for (int count = 6; count <= 22; ++count) {
      int points = 0;
      for (const CornerPoint &p : corner_points(n, count)) {
        points += p.u == p.v ? 1 : 2;
        EXPECT_GE(p.u, p.v);
        EXPECT_GT(std::min(p.v, 1.0 - p.u - p.v), 0.0) << n << ", " << count;
        EXPECT_GT(std::min(p.weight, p.area_weight), 0.0) << n << ", " << count;
      }
      EXPECT_TRUE(points == 0 || points == count) << n << ", " << count;
    }
  EXPECT_TRUE(corner_points(6, 12).empty());
  EXPECT_TRUE(corner_points(5, 6).empty());
}

// the same face, whichever of its corners comes first
TEST(PatchRules, FittedPointsTurnWithTheFace)
{
  for (Quadrature quadrature : {Quadrature::THREE, Quadrature::SIX})
    for (const Valences &n : {Valences{5, 6, 6}, {6, 8, 6}, {7, 4, 6}, {3, 5, 8}, {9, 5, 6}}) {
      const Planar points = random_points(LimitBasis(n).size(), 7);
      Planar turned = points;
      turned << points.row(1), points.row(2), points.row(0), points.bottomRows(points.rows() - n[0]),
          points.middleRows(3, n[0] - 3);
      const Flat here = by_rule(shared_rules(quadrature).get(n), points);
      const Flat there = by_rule(shared_rules(quadrature).get({n[1], n[2], n[0]}), turned);
      EXPECT_NEAR(here.area, there.area, 1e-13) << text(n);
      EXPECT_NEAR(here.moment, there.moment, 1e-13) << text(n);
    }
}

TEST(PatchRules, FittedPointsSeeTheEnergyOfSmoothSurfaces)
{
  for (int n : FITTED) {
    TriangleMesh mesh = bipyramid(n);
    for (int level = 0; level < 2; ++level) mesh = loop_refine(mesh);
    const double exact = Scene(mesh, Quadrature::CAREFUL).evaluate().bending;
    for (const auto &[quadrature, limit] : {std::pair(Quadrature::THREE, 1e-3), std::pair(Quadrature::SIX, 1e-4)}) {
      const double error = Scene(mesh, quadrature).evaluate().bending / exact - 1.0;
      EXPECT_LT(std::fabs(error), limit) << "valence " << n << ", " << name(quadrature);
      RecordProperty("valence_" + std::to_string(n) + "_" + name(quadrature), scientific(error));
    }
  }
}

// a vesicle as others simulate it
TEST(PatchRules, MeshesOfRandomValencesTakeFewPoints)
{
  const TriangleMesh mesh = test_mesh("thermal_1800");
  Scene scene(mesh, Quadrature::SIX);
  double points = 0.0;
  for (const FaceGroup &group : scene.groups()) points += group.rule->npoints * static_cast<double>(group.nfaces) / mesh.faces.size();
  EXPECT_LT(points, 20.5);
  const Totals by_rule = scene.evaluate();
  if (SANITIZED) return;    // 75 kinds of faces with thousands of points each take a minute
  const Totals exact = Scene(mesh, Quadrature::CAREFUL).evaluate();
  EXPECT_LT(std::fabs(by_rule.bending / exact.bending - 1.0), 1e-3);
  double apart = 0.0, whole = 0.0;
  for (size_t v = 0; v < mesh.points.size(); ++v) {
    apart += (by_rule.force[v] - exact.force[v]).squaredNorm();
    whole += exact.force[v].squaredNorm();
  }
  EXPECT_LT(std::sqrt(apart / whole), 1e-2);
  RecordProperty("points_a_face", std::to_string(points));
  RecordProperty("bending", scientific(by_rule.bending / exact.bending - 1.0));
  RecordProperty("forces", scientific(std::sqrt(apart / whole)));
}
