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

#include "membrane_mass_kinds.h"
#include "membrane_mesh_shapes.h"
#include "membrane_random.h"
#include "one_rank.h"
#include "scene.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <map>

using namespace Membrane_NS;
using namespace Membrane_TEST;

namespace {

MassOperator::Settings settings(MassKind kind, bool direct, double tolerance, int most_passes = 1000)
{
  MassOperator::Settings result;
  result.kind = kind;
  result.direct = direct;
  result.tolerance = tolerance;
  result.most_passes = most_passes;
  return result;
}

struct Body {
  TriangleMesh mesh;
  Topology topology;
  OneRank part;
  std::vector<double> masses;
  std::vector<uint64_t> labels;
  std::unique_ptr<MassOperator> matrix;

  Body(TriangleMesh m, MassKind kind, bool direct = false, double tolerance = 1.0e-10) :
      mesh(std::move(m)), topology(mesh.points.size(), mesh.faces), part(topology),
      masses(uneven(mesh.points.size())), labels(numbers(mesh.points.size())),
      matrix(make_mass({topology, part, masses, labels}, settings(kind, direct, tolerance)))
  {
  }
  int size() const { return part.owned; }

  static std::vector<double> uneven(int n)
  {
    std::vector<double> m(n);
    for (int i = 0; i < n; ++i) m[i] = 1.0 + 0.3 * std::sin(i);
    return m;
  }
  static std::vector<uint64_t> numbers(int n)
  {
    std::vector<uint64_t> l(n);
    for (int i = 0; i < n; ++i) l[i] = i + 1;
    return l;
  }
};

const MassKind KINDS[] = {MassKind::VERTEX, MassKind::CONSISTENT, MassKind::LUMPED};

}    // namespace

TEST(CounterRandom, PhiloxGivesThePublishedNumbers)
{
  // Random123, kat_vectors, philox4x32-10
  using Words = std::array<uint32_t, 4>;
  EXPECT_EQ(CounterRandom::philox({0, 0, 0, 0}, {0, 0}),
            (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(CounterRandom::philox({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff},
                                  {0xffffffff, 0xffffffff}),
            (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(CounterRandom::philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344},
                                  {0xa4093822, 0x299f31d0}),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(CounterRandom, NormalsHaveTheMomentsOfTheNormalDistribution)
{
  const CounterRandom random(4711, 12);
  double m1 = 0, m2 = 0, m4 = 0, neighbours = 0;
  const int n = 200000;
  std::array<double, 4> before{};
  for (int i = 0; i < n; ++i) {
    const auto z = random.normals(i);
    for (double v : z) {
      m1 += v;
      m2 += v * v;
      m4 += v * v * v * v;
    }
    neighbours += z[0] * before[0] + z[0] * z[2];
    before = z;
  }
  EXPECT_NEAR(m1 / (4 * n), 0.0, 5e-3);
  EXPECT_NEAR(m2 / (4 * n), 1.0, 7e-3);
  EXPECT_NEAR(m4 / (4 * n), 3.0, 5e-2);
  EXPECT_NEAR(neighbours / n, 0.0, 1.3e-2);
}

TEST(CounterRandom, NormalsOfManyLabelsAreThoseOfEachAlone)
{
  const CounterRandom random(815, 1ULL << 33);
  for (int n : {1, 2, 7, 64, 65, 1001}) {
    std::vector<uint64_t> labels;
    for (int i = 0; i < n; ++i) labels.push_back(i % 3 ? 7 * i : (1ULL << 40) + i);
    VertexField z(n);
    random.normals(labels, z);
    for (int i = 0; i < n; ++i) {
      const auto alone = random.normals(labels[i]);
      for (int k = 0; k < 4; ++k) ASSERT_NEAR(z[i].c[k], alone[k], 1e-14) << "label " << i << " of " << n;
    }
  }
}

TEST(CounterRandom, NormalsAreRightToTheLastBitsFromTheSmallestNumberToTheLargest)
{
  // around all eighths of a turn and powers of two, and in between
  std::vector<uint64_t> numbers;
  for (uint64_t eighth = 0; eighth <= 8; ++eighth)
    for (int64_t d = -3; d <= 3; ++d) numbers.push_back(((eighth << 29) + d) & 0xffffffff);
  for (int bit = 0; bit < 32; ++bit)
    for (int64_t d = -2; d <= 2; ++d) numbers.push_back(((1ULL << bit) + d) & 0xffffffff);
  for (uint64_t i = 1; i <= 2000; ++i) numbers.push_back(i * 2654435761 & 0xffffffff);
  const double two_pi = 6.283185307179586476925;
  for (size_t i = 0; i + 4 <= numbers.size(); i += 4) {
    CounterRandom::Words word[4];
    Quad z[4];
    for (int l = 0; l < 4; ++l)
      for (int k = 0; k < 4; ++k)    // the last of a large radius, where an error in the angle shows
        word[k][l] = k == 2 ? l : numbers[i + l];
    CounterRandom::box_muller(word, z);
    for (int l = 0; l < 4; ++l)
      for (int k = 0; k < 4; k += 2) {
        const long double u = (word[k][l] + 0.5L) * 0x1.0p-32L;
        const long double radius = std::sqrt(-2.0L * std::log(u));
        const double angle = two_pi * (word[k + 1][l] + 0.5) * 0x1.0p-32;
        EXPECT_NEAR(z[k][l], radius * std::cos(angle), 2e-15 * radius) << word[k][l] << " " << word[k + 1][l];
        EXPECT_NEAR(z[k + 1][l], radius * std::sin(angle), 2e-15 * radius) << word[k][l] << " " << word[k + 1][l];
      }
  }
}

TEST(CounterRandom, UnitVectorsAreUniformOnTheSphere)
{
  const CounterRandom random(4711, 3);
  const int n = 100000;
  std::vector<int64_t> labels(n);
  for (int i = 0; i < n; ++i) labels[i] = i % 2 ? 3 * i : (int64_t(1) << 40) - i;
  std::vector<std::array<double, 3>> vectors(n);
  random.unit_vectors(labels.data(), n, reinterpret_cast<double(*)[3]>(vectors.data()));
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  double fourth = 0.0;
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d v(vectors[i].data());
    ASSERT_NEAR(v.norm(), 1.0, 1e-15);
    mean += v / n;
    second += v * v.transpose() / n;
    fourth += (std::pow(v[0], 4) + std::pow(v[1], 4) + std::pow(v[2], 4)) / n;
    if (i > 200) continue;
    double alone[1][3];
    random.unit_vectors(&labels[i], 1, alone);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(alone[0][k], vectors[i][k]);
    const auto word = random.words(labels[i], 0);
    const double angle = 2.0 * M_PI * (word[1] + 0.5) * 0x1.0p-32;
    EXPECT_NEAR(v[2], 2.0 * (word[0] + 0.5) * 0x1.0p-32 - 1.0, 1e-15);
    EXPECT_NEAR(v[0] * std::sin(angle), v[1] * std::cos(angle), 2e-15);
    EXPECT_GT(v[0] * std::cos(angle) + v[1] * std::sin(angle), 0.0);
  }
  const double error = 1.0 / std::sqrt(3.0 * n);    // of a mean component
  EXPECT_LT(mean.norm(), 5.0 * error);
  EXPECT_LT((second - Eigen::Matrix3d::Identity() / 3.0).cwiseAbs().maxCoeff(), 5.0 * error);
  EXPECT_NEAR(fourth, 0.6, 5.0 * error);
}

TEST(MassOperator, KindsAreFoundByTheirNames)
{
  for (MassKind kind : KINDS) {
    MassKind found = kind == MassKind::LUMPED ? MassKind::VERTEX : MassKind::LUMPED;
    EXPECT_TRUE(find_mass_kind(mass_kind_name(kind), found));
    EXPECT_EQ(found, kind);
  }
  MassKind found = MassKind::CONSISTENT;
  EXPECT_FALSE(find_mass_kind("heavy", found));
  EXPECT_EQ(found, MassKind::CONSISTENT);
}

TEST(MassOperator, TotalMassIsThatOfTheVertices)
{
  for (MassKind kind : KINDS) {
    Body body(icosphere(1, 1.0), kind);
    VertexField one(body.size(), Vector4{{1, 1, 1, 1}}), p(body.size());
    body.matrix->multiply(one, p);
    double total = 0, expected = 0;
    for (int i = 0; i < body.size(); ++i) {
      total += p[i].c[0];
      expected += body.masses[i];
    }
    EXPECT_NEAR(total, expected, 1e-12 * expected);
  }
}

TEST(MassOperator, ConsistentRowOfARegularMeshIsTheTextbookOne)
{
  const Eigen::Matrix3d box = Eigen::Vector3d(12, 12, 12).asDiagonal();
  const TriangleMesh mesh = sheet(12, 12, box, 0.5);
  const Topology topology(mesh.points.size(), mesh.faces);
  OneRank part(topology);
  std::vector<double> masses(mesh.points.size(), 1.0);
  const auto labels = Body::numbers(mesh.points.size());
  const auto matrix =
      make_mass({topology, part, masses, labels}, settings(MassKind::CONSISTENT, false, 1e-10));
  VertexField unit(part.owned, Vector4{}), row(part.owned);
  unit[0].c[0] = 1.0;
  matrix->multiply(unit, row);
  std::map<long, int> count;
  for (const auto &entry : row) ++count[std::lround(entry.c[0] * 1e12)];
  const std::map<double, int> expected = {{1979.0 / 7560, 1}, {18871.0 / 181440, 6},
                                          {85.0 / 6048, 6},   {31.0 / 6480, 6},
                                          {17.0 / 181440, 12}, {1.0 / 181440, 6}};
  for (auto [value, times] : expected) EXPECT_EQ(count[std::lround(value * 1e12)], times) << value;
}

TEST(MassOperator, SolvesToTheToleranceOnEveryMesh)
{
  for (MassKind kind : KINDS)
    for (int n : {3, 4, 5, 8, 12, 16}) {
      Body body(loop_refine(bipyramid(n)), kind);
      const VertexField f = rough(body.size());
      VertexField v(body.size());
      body.matrix->solve(f, v);
      EXPECT_LT(body.matrix->residual(f, v), 3e-10) << "valence " << n;
    }
}

TEST(MassOperator, DirectSolverAgreesWithTheIterativeOne)
{
  for (MassKind kind : {MassKind::VERTEX, MassKind::CONSISTENT})
    for (const TriangleMesh &mesh :
         {icosphere(2, 1.0), loop_refine(bipyramid(9)), icosphere(0, 1.0)}) {
      Body iterative(mesh, kind, false, 1e-12), direct(mesh, kind, true);
      const VertexField f = rough(direct.size());
      VertexField a(direct.size()), b(direct.size());
      iterative.matrix->solve(f, a);
      direct.matrix->solve(f, b);
      EXPECT_LT(direct.matrix->residual(f, b), 1e-13);
      double largest = 0.0;
      for (const Vector4 &value : a)
        for (int k = 0; k < 3; ++k) largest = std::max(largest, std::fabs(value.c[k]));
      for (int i = 0; i < direct.size(); ++i)
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[i].c[k], b[i].c[k], 1e-10 * largest);
    }
}

TEST(MassOperator, NeedsAsManyPassesOnAnyMeshOfTheSameValences)
{
  int passes = 0;
  for (int level : {3, 4, 5, 6, 7}) {
    Body body(icosphere(level, 1.0), MassKind::VERTEX);
    const VertexField f = rough(body.size());
    VertexField v(body.size());
    body.matrix->solve(f, v);
    if (!passes) passes = body.matrix->passes();
    EXPECT_EQ(body.matrix->passes(), passes);
    EXPECT_LT(body.matrix->residual(f, v), 1e-10);
  }
  EXPECT_LE(passes, 2 * 25);
}

TEST(MassOperator, MassIsSymmetricAndPositive)
{
  for (MassKind kind : KINDS) {
    Body body(loop_refine(bipyramid(7)), kind);
    const int n = body.size();
    Eigen::MatrixXd m(n, n);
    for (int j = 0; j < n; ++j) {
      VertexField unit(n, Vector4{}), p(n);
      unit[j].c[1] = 1.0;
      body.matrix->multiply(unit, p);
      for (int i = 0; i < n; ++i) m(i, j) = p[i].c[1];
    }
    EXPECT_LT((m - m.transpose()).norm(), 1e-13 * m.norm());
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m).eigenvalues().minCoeff(), 0.0);
  }
}

TEST(MassOperator, KineticEnergyIsHalfOfVelocityTimesMomentum)
{
  for (MassKind kind : KINDS) {
    Body body(loop_refine(bipyramid(7)), kind);
    const VertexField v = rough(body.size());
    VertexField p(body.size());
    body.matrix->multiply(v, p);
    Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
    for (int i = 0; i < body.size(); ++i)
      expected += Eigen::Map<const Eigen::Vector3d>(v[i].c) *
          Eigen::Map<const Eigen::RowVector3d>(p[i].c);
    const auto t = body.matrix->kinetic(v);
    const double measured[6] = {expected(0, 0), expected(1, 1), expected(2, 2),
                                expected(0, 1), expected(0, 2), expected(1, 2)};
    for (int k = 0; k < 6; ++k) EXPECT_NEAR(t[k], measured[k], 1e-13 * expected.trace());
    EXPECT_GT(expected.trace(), 0.0);
  }
}

TEST(MassOperator, RecordsTheResidualOfASolutionThatMissedTheTolerance)
{
  for (int most_passes : {1000, 5}) {
    Body body(icosphere(2, 1.0), MassKind::CONSISTENT);
    body.matrix = make_mass({body.topology, body.part, body.masses, body.labels},
                                     settings(MassKind::CONSISTENT, false, 1e-10, most_passes));
    const VertexField p = rough(body.size());
    VertexField v(body.size());
    EXPECT_EQ(body.matrix->missed_residual(), 0.0);
    body.matrix->solve(p, v);
    EXPECT_LE(body.matrix->passes(), most_passes);
    const bool missed = most_passes == 5;
    EXPECT_EQ(body.matrix->residual(p, v) > 1e-9, missed);
    EXPECT_EQ(body.matrix->missed_residual(), missed ? body.matrix->residual(p, v) : 0.0);
  }
}

TEST(MassOperator, ConjugateGradientsEndAtOnceWithoutFiniteNumbers)
{
  Body body(icosphere(2, 1.0), MassKind::CONSISTENT);
  VertexField p = rough(body.size()), v(body.size());
  p[3].c[1] = NAN;
  body.matrix->solve(p, v);
  EXPECT_LE(body.matrix->passes(), 1);
  EXPECT_TRUE(std::isnan(v[3].c[1]));
}

TEST(MassOperator, SamplesHaveEquipartition)
{
  // <p_i v_j> = kT delta_ij: the whole diagonal to 0.5 % (2.5 standard errors), pairs within four standard errors

  const double kT = 0.7;
  for (MassKind kind : KINDS) {
    Body body(icosphere(1, 1.0), kind);
    const int n = body.size(), samples = how_many(4000);
    VertexField v(n), p(n);
    double diagonal = 0, pairs[3] = {};
    for (int s = 0; s < samples; ++s) {
      body.matrix->sample(kT, 99, s, v);
      body.matrix->multiply(v, p);
      for (int i = 0; i < n; ++i)
        for (int k = 0; k < 3; ++k) diagonal += p[i].c[k] * v[i].c[k];
      const int near = body.topology.ring(0)[0], far = n - 1;
      pairs[0] += p[0].c[0] * v[0].c[0];
      pairs[1] += p[0].c[0] * v[near].c[0] + p[0].c[1] * v[near].c[1];
      pairs[2] += p[0].c[0] * v[far].c[0] + p[0].c[0] * v[0].c[1];
    }
    EXPECT_NEAR(diagonal / (3.0 * n * samples), kT, 5e-3 * kT * std::sqrt(4000.0 / samples));
    const double error = 4.0 * kT * 8.0 / std::sqrt(samples);    // <p^2><v^2> of order (4 kT)^2
    EXPECT_NEAR(pairs[0] / samples, kT, error);
    EXPECT_NEAR(pairs[1] / samples, 0.0, error);
    EXPECT_NEAR(pairs[2] / samples, 0.0, error);
  }
}

TEST(MassOperator, NoiseThatComesWithASolutionIsASampleAndLeavesTheSolutionAlone)
{
  for (MassKind kind : KINDS)
    for (double tolerance : {1e-10, 1e-6}) {
      Body body(icosphere(3, 1.0), kind, false, tolerance);
      const int n = body.size();
      const VertexField p = rough(n);
      VertexField v(n), z(n), alone(n), sample(n);
      body.matrix->solve_with_noise(p, v, 12, 34, z);
      const int passes = body.matrix->passes();
      body.matrix->solve(p, alone);
      EXPECT_EQ(passes, body.matrix->passes());
      body.matrix->sample(1.0, 12, 34, sample);
      double square = 0.0, difference = 0.0;
      for (int i = 0; i < n; ++i)
        for (int k = 0; k < 3; ++k) {
          EXPECT_NEAR(v[i].c[k], alone[i].c[k], 1e-14 * n);
          difference += std::pow(z[i].c[k] - sample[i].c[k], 2);
          square += std::pow(sample[i].c[k], 2);
        }
      EXPECT_LT(difference, 1e-10 * square);
    }
}

TEST(MassOperator, OnlyPointMassesHaveFrictionPerVertex)
{
  for (MassKind kind : KINDS) {
    Body body(icosphere(1, 1.0), kind);
    EXPECT_EQ(body.matrix->has_vertex_friction(), kind != MassKind::CONSISTENT);
    VertexField v = rough(body.size());
    const std::vector<double> keep(body.size(), 0.5);
    if (kind == MassKind::CONSISTENT) {
      EXPECT_THROW(body.matrix->relax(keep, 1.0, 5, 1, v), std::logic_error);
    }
  }
}

TEST(MassOperator, FrictionAndNoiseKeepEquilibriumAndForgetExponentially)
{
  for (bool scaled : {false, true})
    for (MassKind kind : {MassKind::VERTEX, MassKind::LUMPED}) {
      Body body(icosphere(1, 1.0), kind);
      const int n = body.size(), steps = 4000;
      const double keep = 0.8;
      VertexField v(n), before, p(n), a(n), z(n);
      body.matrix->sample(1.0, 5, 0, v);
      double energy = 0, memory = 0;
      for (int s = 1; s <= steps; ++s) {
        before = v;
        if (scaled) {
          body.matrix->relax(std::vector<double>(n, keep), 1.0, 5, s, v);
        } else {
          body.matrix->solve_with_noise(p, a, 5, s, z);
          for (int i = 0; i < n; ++i)
            for (int k = 0; k < 3; ++k)
              v[i].c[k] = keep * v[i].c[k] + std::sqrt(1.0 - keep * keep) * z[i].c[k];
        }
        body.matrix->multiply(v, p);
        for (int i = 0; i < n; ++i)
          for (int k = 0; k < 3; ++k) {
            energy += p[i].c[k] * v[i].c[k];
            memory += p[i].c[k] * before[i].c[k];
          }
      }
      EXPECT_NEAR(energy / (3.0 * n * steps), 1.0, 1e-2);
      EXPECT_NEAR(memory / energy, keep, 5e-3);
    }
}
