// Solvent of stochastic rotation dynamics: what a collision keeps and what it draws, walls, formulas.

#include "membrane_srd_walls.h"
#include "membrane_random.h"
#include "membrane_srd.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

using namespace Membrane_NS;
using Eigen::Vector3d;

namespace {

constexpr double PI = 3.14159265358979323846;

// particles in unit cells, each with its centre as the origin
struct Gas {
  std::vector<double> velocity, mass, offset, drawn;
  std::vector<int> cell;
  std::vector<uint64_t> label;
  int cells = 0;

  void add(int c, double m, uint64_t seed)
  {
    const uint64_t name = mass.size() + 1;
    const CounterRandom random(seed, 0);
    const auto z = random.normals(name);
    const auto a = random.uniforms(name, 10), b = random.uniforms(name, 11);
    for (int k = 0; k < 3; ++k) velocity.push_back(z[k] + (k == 0 ? 3.0 : -1.0));
    for (double s : {a[0], a[1], b[0]}) offset.push_back(s - 0.5);
    mass.push_back(m);
    cell.push_back(c);
    label.push_back(name);
    drawn.resize(offset.size());
    cells = std::max(cells, c + 1);
  }
  int size() const { return mass.size(); }
  Vector3d v(int i) const { return Eigen::Map<const Vector3d>(&velocity[3 * i]); }
  Vector3d d(int i) const { return Eigen::Map<const Vector3d>(&offset[3 * i]); }

  SRDParticles particles(int first = 0, int last = -1)
  {
    SRDParticles p;
    p.count = (last < 0 ? size() : last) - first;
    p.velocity = &velocity[3 * first];
    p.mass = &mass[first];
    p.cell = &cell[first];
    p.offset = &offset[3 * first];
    p.label = &label[first];
    p.drawn = &drawn[3 * first];
    return p;
  }
  void collide(const CollisionRule &rule, uint64_t step)
  {
    std::vector<double> moments(cells * rule.num_moments(), 0.0), actions(cells * rule.num_actions());
    std::vector<int64_t> numbers(cells);
    std::iota(numbers.begin(), numbers.end(), 0);
    rule.add(particles(), step, moments.data());
    rule.prepare(cells, numbers.data(), step, moments.data(), actions.data());
    rule.apply(particles(), actions.data());
  }

  struct Cell {
    double mass = 0.0, energy = 0.0;
    Vector3d momentum = Vector3d::Zero(), angular = Vector3d::Zero();
  };
  std::vector<Cell> sums() const
  {
    std::vector<Cell> all(cells);
    for (int i = 0; i < size(); ++i) {
      if (cell[i] < 0) continue;
      Cell &c = all[cell[i]];
      c.mass += mass[i];
      c.energy += 0.5 * mass[i] * v(i).squaredNorm();
      c.momentum += mass[i] * v(i);
      c.angular += mass[i] * d(i).cross(v(i));
    }
    return all;
  }
};

// cells of 1, 2, 3, ... particles of different masses
Gas mixed_gas(int cells, uint64_t seed)
{
  Gas gas;
  for (int c = 0; c < cells; ++c)
    for (int i = 0; i <= c; ++i) gas.add(c, 0.5 + 0.25 * ((i + c) % 5), seed);
  return gas;
}

CollisionRule rule_of(CollisionRule::Method method, bool thermostat = false, double degrees = 130.0,
                      double kT = 1.0)
{
  CollisionRule::Settings settings;
  settings.method = method;
  settings.thermostat = thermostat;
  settings.angle = degrees * PI / 180.0;
  settings.kT = kT;
  settings.seed = 4711;
  return CollisionRule(settings);
}

constexpr auto SRD = CollisionRule::Method::SRD;
constexpr auto AT_A = CollisionRule::Method::AT_A;

}    // namespace

// === What a collision keeps

TEST(SRDCollision, KeepsMomentumOfEachCell)
{
  for (const auto &rule : {rule_of(SRD), rule_of(SRD, true), rule_of(AT_A)}) {
    Gas gas = mixed_gas(12, 1);
    for (int step = 0; step < 50; ++step) {
      const auto before = gas.sums();
      gas.collide(rule, step);
      const auto after = gas.sums();
      for (int c = 0; c < gas.cells; ++c)
        EXPECT_LT((after[c].momentum - before[c].momentum).norm(), 1e-12 * before[c].momentum.norm());
    }
  }
}

TEST(SRDCollision, KeepsEnergyOfEachCellOverTenThousandSteps)
{
  const auto rule = rule_of(SRD);
  Gas gas = mixed_gas(12, 2);
  const auto before = gas.sums();
  for (int step = 0; step < 10000; ++step) gas.collide(rule, step);
  const auto after = gas.sums();
  for (int c = 0; c < gas.cells; ++c)
    EXPECT_NEAR(after[c].energy / before[c].energy, 1.0, 1e-10);
}

TEST(SRDCollision, AndersenKeepsAngularMomentumOfEachCell)
{
  Gas gas = mixed_gas(12, 3);
  for (int step = 0; step < 50; ++step) {
    const auto before = gas.sums();
    gas.collide(rule_of(AT_A), step);
    const auto after = gas.sums();
    for (int c = 0; c < gas.cells; ++c)
      EXPECT_LT((after[c].angular - before[c].angular).norm(), 1e-12 * before[c].momentum.norm());
  }
}

TEST(SRDCollision, AndersenKeepsAngularMomentumOfParticlesOnALine)
{
  Gas gas;
  for (int i = 0; i < 5; ++i) gas.add(0, 1.0 + i, 4);
  for (int i = 0; i < 5; ++i)
    for (int k = 0; k < 3; ++k) gas.offset[3 * i + k] = (0.1 * i - 0.2) * (k + 1);
  const auto before = gas.sums();
  gas.collide(rule_of(AT_A), 0);
  const auto after = gas.sums();
  EXPECT_LT((after[0].angular - before[0].angular).norm(), 1e-12 * before[0].momentum.norm());
  for (double v : gas.velocity) EXPECT_LT(std::fabs(v), 20.0);
}

TEST(SRDCollision, LeavesALoneParticleAndOthersWithoutCell)
{
  for (const auto &rule : {rule_of(SRD), rule_of(SRD, true), rule_of(AT_A)}) {
    Gas gas = mixed_gas(3, 5);
    for (int i = 3; i < 6; ++i) gas.cell[i] = -1;
    const auto before = gas.velocity;
    gas.collide(rule, 0);
    for (int i : {0, 1, 2, 9, 10, 11, 12, 13, 14, 15, 16, 17})
      EXPECT_NEAR(gas.velocity[i], before[i], 1e-14);
    EXPECT_GT(std::fabs(gas.velocity[3] - before[3]), 1e-3);
  }
}

// === What it draws

TEST(SRDCollision, TurnsByTheAngleAboutAnAxisUniformOnTheSphere)
{
  const double degrees = 70.0;
  const auto rule = rule_of(SRD, false, degrees);
  constexpr int TRIES = 20000;
  Gas gas;
  for (int c = 0; c < TRIES; ++c)
    for (int i = 0; i < 4; ++i) gas.add(c, 1.0, 6);
  const auto before = gas;
  gas.collide(rule, 17);

  Vector3d first = Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (int c = 0; c < TRIES; ++c) {
    Vector3d mean = Vector3d::Zero();
    for (int i = 0; i < 4; ++i) mean += 0.25 * before.v(4 * c + i);
    Eigen::Matrix3d from, to;
    for (int i = 0; i < 3; ++i) {
      from.col(i) = before.v(4 * c + i) - mean;
      to.col(i) = gas.v(4 * c + i) - mean;
    }
    const Eigen::Matrix3d turn = to * from.inverse();
    if (from.determinant() * from.determinant() < 1e-4) continue;
    EXPECT_NEAR(turn.trace(), 1.0 + 2.0 * std::cos(degrees * PI / 180.0), 1e-9);
    EXPECT_NEAR(turn.determinant(), 1.0, 1e-9);
    const Vector3d axis = Vector3d(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0),
                                   turn(1, 0) - turn(0, 1)) /
        (2.0 * std::sin(degrees * PI / 180.0));
    first += axis;
    second += axis * axis.transpose();
  }
  // a component has variance 1/3, its square 4/45, a product of two 1/15: five standard errors
  for (int k = 0; k < 3; ++k) {
    EXPECT_LT(std::fabs(first[k]) / TRIES, 5.0 * std::sqrt(1.0 / 3.0 / TRIES));
    EXPECT_NEAR(second(k, k) / second.trace(), 1.0 / 3.0, 5.0 * std::sqrt(4.0 / 45.0 / TRIES));
    EXPECT_LT(std::fabs(second(k, (k + 1) % 3)) / TRIES, 5.0 * std::sqrt(1.0 / 15.0 / TRIES));
  }
}

TEST(SRDCollision, ThermostatDrawsEnergiesFromTheCanonicalDistribution)
{
  const double kT = 0.7;
  const auto rule = rule_of(SRD, true, 130.0, kT);
  constexpr int TRIES = 40000;
  for (int n : {2, 3, 10}) {
    Gas gas;
    for (int i = 0; i < n; ++i) gas.add(0, 0.5 + i, 7);
    double sum[3] = {0.0, 0.0, 0.0};
    for (int step = 0; step < TRIES; ++step) {
      gas.collide(rule, step);
      const auto cell = gas.sums()[0];
      const double e = (cell.energy - 0.5 * cell.momentum.squaredNorm() / cell.mass) / kT;
      for (int k = 0; k < 3; ++k) sum[k] += std::pow(e, k + 1) / TRIES;
    }
    // moments of a Gamma distribution of shape s: s, s (s+1), s (s+1) (s+2), ...
    const double s = 1.5 * (n - 1);
    double moment[7] = {1.0};
    for (int k = 1; k < 7; ++k) moment[k] = moment[k - 1] * (s + k - 1);
    for (int k = 1; k <= 3; ++k) {
      const double error = std::sqrt((moment[2 * k] - moment[k] * moment[k]) / TRIES);
      EXPECT_NEAR(sum[k - 1], moment[k], 4.0 * error) << n << " particles, moment " << k;
    }
  }
}

TEST(SRDCollision, AndersenDrawsTheEnergyOfTheFreedomItHas)
{
  // without momentum and angular momentum, 3 n - 6 degrees of freedom are left, 1 for two particles
  const double kT = 0.7;
  const auto rule = rule_of(AT_A, false, 0.0, kT);
  constexpr int TRIES = 40000;
  for (int n : {2, 3, 10}) {
    Gas gas;
    for (int i = 0; i < n; ++i) gas.add(0, 0.5 + i, 8);
    std::fill(gas.velocity.begin(), gas.velocity.end(), 0.0);
    double mean = 0.0;
    for (int step = 0; step < TRIES; ++step) {
      gas.collide(rule, step);
      mean += gas.sums()[0].energy / TRIES;
    }
    const double shape = 0.5 * (n == 2 ? 1 : 3 * n - 6);
    EXPECT_NEAR(mean / kT, shape, 4.0 * std::sqrt(shape / TRIES)) << n << " particles";
  }
}

TEST(SRDCollision, RandomNumbersDependOnCellStepAndSeedAlone)
{
  const auto rule = rule_of(SRD);
  const double moments[5] = {2.0, 2.0, 0.0, 0.0, 0.0};
  auto action = [&](const CollisionRule &r, int64_t number, uint64_t step) {
    std::vector<double> a(12);
    r.prepare(1, &number, step, moments, a.data());
    return a;
  };
  EXPECT_EQ(action(rule, 3, 10), action(rule, 3, 10));
  EXPECT_NE(action(rule, 3, 10), action(rule, 4, 10));
  EXPECT_NE(action(rule, 3, 10), action(rule, 3, 11));
  CollisionRule::Settings other = rule.settings();
  other.seed = 1;
  EXPECT_NE(action(rule, 3, 10), action(CollisionRule(other), 3, 10));
}

TEST(SRDCollision, ManyCellsDoWhatEachDoesAlone)
{
  constexpr int CELLS = 3 * CounterRandom::MANY + 5;
  for (bool thermostat : {false, true}) {
    const auto rule = rule_of(SRD, thermostat);
    std::vector<int64_t> numbers;
    std::vector<double> moments;
    for (int c = 0; c < CELLS; ++c) {
      numbers.push_back(7 * c % CELLS);
      const double count = c % 5;    // none in some
      moments.insert(moments.end(), {count, count, 0.1 * count, -0.2 * count, 0.3 * count});
      if (thermostat) moments.push_back(2.0 * count);
    }
    ASSERT_EQ(moments.size(), static_cast<size_t>(CELLS) * rule.num_moments());
    std::vector<double> actions(CELLS * rule.num_actions(), 0.0);
    rule.prepare(CELLS, numbers.data(), 10, moments.data(), actions.data());
    for (int c = 0; c < CELLS; ++c) {
      std::vector<double> alone(rule.num_actions(), 0.0);
      rule.prepare(1, &numbers[c], 10, &moments[c * rule.num_moments()], alone.data());
      for (int k = 0; k < rule.num_actions(); ++k) EXPECT_EQ(actions[c * rule.num_actions() + k], alone[k]) << c;
    }
  }
}

TEST(SRDCollision, MomentsOfPartsAddUp)
{
  for (const auto &rule : {rule_of(SRD), rule_of(SRD, true), rule_of(AT_A)}) {
    Gas gas = mixed_gas(10, 9);
    std::vector<double> whole(gas.cells * rule.num_moments(), 0.0), parts = whole;
    rule.add(gas.particles(), 5, whole.data());
    rule.add(gas.particles(0, 20), 5, parts.data());
    rule.add(gas.particles(20), 5, parts.data());
    EXPECT_EQ(whole, parts);
  }
}

TEST(SRDShift, IsUniform)
{
  constexpr int TRIES = 20000;
  double mean[3] = {}, square[3] = {};
  for (int step = 0; step < TRIES; ++step) {
    double shift[3];
    random_shift(9127, step, shift);
    for (int k = 0; k < 3; ++k) {
      ASSERT_TRUE(shift[k] > 0.0 && shift[k] < 1.0);
      mean[k] += shift[k] / TRIES;
      square[k] += shift[k] * shift[k] / TRIES;
    }
  }
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(mean[k], 0.5, 5.0 * std::sqrt(1.0 / 12.0 / TRIES));
    EXPECT_NEAR(square[k], 1.0 / 3.0, 5.0 * std::sqrt(4.0 / 45.0 / TRIES));
  }
}

// === Measurement

TEST(SRDEnergy, TemperatureIsThatOfVelocitiesRelativeToTheCells)
{
  constexpr int CELLS = 4000;
  Gas gas;
  for (int c = 0; c < CELLS; ++c)
    for (int i = 0; i < 10; ++i) gas.add(c, 1.0, 10);
  for (int i = 0; i < gas.size(); ++i) gas.velocity[3 * i] += 0.01 * gas.cell[i];    // a flow
  std::vector<double> moments(CELLS * CellEnergy::NUM_MOMENTS, 0.0);
  CellEnergy::add(gas.particles(), moments.data());
  CellEnergy sum;
  for (int c = 0; c < CELLS; ++c) sum.count(&moments[c * CellEnergy::NUM_MOMENTS]);
  EXPECT_EQ(sum.freedom, 27.0 * CELLS);
  EXPECT_NEAR(sum.energy / sum.freedom, 1.0, 4.0 * std::sqrt(2.0 / sum.freedom));
}

// === Formulas

TEST(SRDTheory, Viscosities)
{
  auto eta = [](double particles, double degrees, double step) {
    return srd_viscosity(particles, degrees * PI / 180.0, 1.0, 1.0, 1.0, step);
  };
  EXPECT_NEAR(eta(10.0, 130.0, 0.1), 8.700, 5e-4);
  EXPECT_NEAR(eta(5.0, 130.0, 0.1), 3.961, 5e-4);
  EXPECT_NEAR(eta(10.0, 90.0, 0.1), 5.426, 5e-4);
  EXPECT_NEAR(eta(10.0, 90.0, 1.0), 4.759, 5e-4);
  EXPECT_DOUBLE_EQ(mean_free_path(4.0, 1.0, 0.1), 0.2);
}

TEST(SRDTheory, ViscosityHasItsUnits)
{
  // lengths in a, masses in m, times in a sqrt(m/kT)
  const double a = 2.5, m = 0.3, kT = 1.7, time = a * std::sqrt(m / kT);
  const double unit = m / (a * time);
  EXPECT_NEAR(srd_viscosity(8.0, 1.9, kT, m, a, 0.2 * time), unit * srd_viscosity(8.0, 1.9, 1.0, 1.0, 1.0, 0.2),
              1e-12);
  EXPECT_NEAR(at_viscosity(8.0, kT, m, a, 0.2 * time), unit * at_viscosity(8.0, 1.0, 1.0, 1.0, 0.2), 1e-12);
}

// === Walls

namespace {

BoxWalls box(bool noslip)
{
  BoxWalls walls;
  walls.noslip = noslip;
  for (int f = 0; f < BoxWalls::FACES; ++f) {
    walls.present[f] = true;
    walls.position[f] = f % 2 ? 1.0 + f : -1.0 - f;
  }
  return walls;
}

}    // namespace

TEST(BoxWalls, MirrorOrReverseVelocitiesInContinuousTime)
{
  for (bool noslip : {false, true}) {
    BoxWalls walls = box(noslip);
    double x[3] = {1.5, 0.0, 0.0}, v[3] = {2.0, 1.0, 0.5};
    walls.stream(x, v, 3.0, 0.5);    // meets xhi = 2 after 0.25
    const double s = noslip ? -1.0 : 1.0;
    const double end[3] = {1.5, noslip ? 0.0 : 0.5, noslip ? 0.0 : 0.25}, after[3] = {-2.0, s, 0.5 * s};
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(x[k], end[k], 1e-15);
      EXPECT_EQ(v[k], after[k]);
      EXPECT_NEAR(walls.impulse[k], 3.0 * ((k == 0 ? 2.0 : k == 1 ? 1.0 : 0.5) - after[k]), 1e-14);
    }
  }
}

TEST(BoxWalls, HoldAParticleThroughManyBouncesAndCorners)
{
  for (bool noslip : {false, true}) {
    BoxWalls walls = box(noslip);
    double x[3] = {0.9, -1.2, 3.0}, v[3] = {31.0, -17.0, 23.0};
    const double start[3] = {x[0], x[1], x[2]};
    for (int step = 0; step < 1000; ++step) {
      walls.stream(x, v, 1.0, 0.37);
      for (int k = 0; k < 3; ++k)
        ASSERT_TRUE(x[k] >= walls.position[2 * k] && x[k] <= walls.position[2 * k + 1]);
    }
    EXPECT_NEAR(v[0] * v[0] + v[1] * v[1] + v[2] * v[2], 31.0 * 31.0 + 17.0 * 17.0 + 23.0 * 23.0, 1e-9);
    for (double &c : v) c = -c;    // and back
    for (int step = 0; step < 1000; ++step) walls.stream(x, v, 1.0, 0.37);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(x[k], start[k], 1e-8);
  }
  BoxWalls walls = box(false);
  double x[3] = {1.0, 3.0, 5.0}, v[3] = {1.0, 1.0, 1.0};    // into the corner (2, 4, 6)
  walls.stream(x, v, 1.0, 2.0);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(v[k], -1.0);
    EXPECT_NEAR(x[k], 1.0 + 2.0 * k, 1e-15);
  }
}

TEST(BoxWalls, TurnBackWhatIsBeyondThem)
{
  BoxWalls walls = box(false);
  double x[3] = {2.0 + 1e-9, 0.0, 0.0}, v[3] = {1.0, 0.0, 0.0};
  walls.stream(x, v, 1.0, 0.5);
  EXPECT_EQ(v[0], -1.0);
  EXPECT_NEAR(x[0], 1.5, 1e-8);
}

TEST(BoxWalls, ThatMoveDragAParticleAlong)
{
  BoxWalls walls = box(true);
  walls.velocity[1][1] = 5.0;    // xhi, along y
  double x[3] = {1.5, 0.0, 0.0}, v[3] = {1.0, 0.5, -0.25};
  walls.stream(x, v, 1.0, 0.75);
  EXPECT_EQ(v[0], -1.0);
  EXPECT_EQ(v[1], 9.5);    // relative to the wall 4.5 in place of -4.5
  EXPECT_EQ(v[2], 0.25);
}
