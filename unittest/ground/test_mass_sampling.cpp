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

// Mass sampling: an inverse that is explicit, noise that has it as covariance, and what it leaves out.

#include "membrane_mass_kinds.h"
#include "membrane_mass_reference.h"
#include "one_rank.h"
#include "scene.h"

#include <gtest/gtest.h>

using namespace Membrane_NS;
using namespace Membrane_TEST;

namespace {

constexpr double UNIT = 0.7;

enum class TotalsOf { NONE, VOLUME, VOLUME_AND_LENGTH };

struct Sampled {
  TriangleMesh mesh;
  Topology topology;
  OneRank part;
  std::vector<double> masses;
  std::vector<uint64_t> labels;
  std::shared_ptr<SharedReference> reference = std::make_shared<SharedReference>();
  std::unique_ptr<MassOperator> matrix;

  explicit Sampled(TriangleMesh m, TotalsOf totals = TotalsOf::VOLUME) :
      mesh(std::move(m)), topology(topology_of(mesh)), part(topology), masses(mesh.points.size(), 1.0)
  {
    for (size_t v = 0; v < masses.size(); ++v) labels.push_back(v + 1);
    StiffnessReference stiffness;
    stiffness.shape = mesh;
    stiffness.kc.assign(masses.size(), 1.0);
    stiffness.tension.assign(mesh.faces.size(), 0.3);
    stiffness.shear.assign(mesh.faces.size(), 0.5);
    stiffness.stretch.assign(mesh.faces.size(), 0.0);
    stiffness.closed.assign(topology.num_components(), !mesh.is_periodic());
    if (totals != TotalsOf::NONE) {
      StiffnessReference::Total total = {100.0, std::vector<Vector3d>(masses.size(), Vector3d::Zero())};
      for (const Face &face : mesh.faces)
        for (int v : face)
          total.gradient[v] += mesh.edge(face[0], face[1]).cross(mesh.edge(face[0], face[2])) / 6.0;
      stiffness.totals.push_back(total);
    }
    if (totals == TotalsOf::VOLUME_AND_LENGTH) stiffness.totals.push_back({SOFT, length()});
    reference->now = std::make_shared<const StiffnessReference>(stiffness);
    MassOperator::Settings settings;
    settings.kind = MassKind::SAMPLING;
    settings.reference = reference;
    settings.unit = UNIT;
    matrix = make_mass({topology, part, masses, labels}, settings);
  }
  int size() const { return part.owned; }

  // how long the body is along z, and a stiffness of that like the one that bending and regularize give an
  // icosahedron; that of the volume is far larger, nearly infinite

  static constexpr double SOFT = 3.0;
  std::vector<Vector3d> length() const
  {
    std::vector<Vector3d> gradient;
    for (const Vector3d &p : mesh.points) gradient.emplace_back(0.0, 0.0, p.z());
    return gradient;
  }

  // M^-1, column by column

  Eigen::MatrixXd inverse()
  {
    Eigen::MatrixXd result(3 * size(), 3 * size());
    for (int j = 0; j < 3 * size(); ++j) {
      VertexField p(size(), Vector4{}), v(size());
      p[j / 3].c[j % 3] = 1.0;
      matrix->solve(p, v);
      for (int i = 0; i < 3 * size(); ++i) result(i, j) = v[i / 3].c[i % 3];
    }
    return result;
  }
};

TriangleMesh small_sheet()
{
  Eigen::Matrix3d lattice = Eigen::Matrix3d::Identity();
  lattice.diagonal() << 5.0, 3.0 * std::sqrt(3.0), 10.0;
  return sheet(5, 6, lattice, 0.0);
}

std::vector<TriangleMesh> some_meshes()
{
  return {icosphere(1, 2.0), perturbed(bipyramid(7), 0.1, 3), small_sheet(),
          together(icosphere(1, 1.0), icosphere(1, 1.5), Vector3d(9, 0, 0))};
}

}    // namespace

TEST(SamplingMass, TheInverseIsSymmetricAndHasOneZeroForEachRotation)
{
  for (const TriangleMesh &mesh : some_meshes()) {
    Sampled body(mesh, mesh.is_periodic() ? TotalsOf::NONE : TotalsOf::VOLUME);
    const Eigen::MatrixXd inverse = body.inverse();
    const double scale = inverse.norm();
    EXPECT_LT((inverse - inverse.transpose()).norm(), 1e-10 * scale);
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(inverse).eigenvalues();
    const int lost = body.matrix->lost_freedoms();
    EXPECT_EQ(lost, mesh.is_periodic() ? 0 : 3 * body.topology.num_components());
    EXPECT_GT(values.minCoeff(), -1e-12 * scale);
    for (int i = 0; i < values.size(); ++i) EXPECT_EQ(values[i] < 1e-9 * scale, i < lost) << values[i];
  }
}

// Woodbury's formula for one more: the inverse loses Y Y^T/(1/K + g.Y), Y = M^-1 g

TEST(SamplingMass, ATotalAddsItsStiffness)
{
  Sampled without(icosphere(0, 1.0)), with(icosphere(0, 1.0), TotalsOf::VOLUME_AND_LENGTH);
  const std::vector<Vector3d> length = without.length();
  Eigen::VectorXd g(3 * without.size());
  for (int i = 0; i < without.size(); ++i) g.segment<3>(3 * i) = length[without.part.vertices[i]];
  const Eigen::MatrixXd inverse = without.inverse();
  const Eigen::VectorXd y = inverse * g;
  const double own = 1.0 / g.dot(y), added = Sampled::SOFT * UNIT;
  EXPECT_LT(added, 2.0 * own);
  EXPECT_LT(own, 2.0 * added);
  const Eigen::MatrixXd expected = inverse - y * y.transpose() / (1.0 / own + 1.0 / added);
  EXPECT_LT((with.inverse() - expected).norm(), 1e-10 * expected.norm());
}

// each face of a sheet adds (3/4) kT/A_f |grad h|^2 A_f to h M h, twice the energy

TEST(SamplingMass, TheMeasureIsATensionOfLongWaves)
{
  Sampled body(small_sheet(), TotalsOf::NONE);
  StiffnessReference warm = *body.reference->now;
  warm.measure = 0.2;
  const double length = body.mesh.lattice(0, 0), q = 2.0 * M_PI / length;
  VertexField v(body.size(), Vector4{}), p(body.size());
  for (int i = 0; i < body.size(); ++i) v[i].c[2] = std::cos(q * body.mesh.points[body.part.vertices[i]].x());
  double energy[2];
  for (int hot = 0; hot < 2; ++hot) {
    if (hot) body.reference->now = std::make_shared<const StiffnessReference>(warm);
    MassOperator::Settings settings;
    settings.kind = MassKind::SAMPLING;
    settings.reference = body.reference;
    settings.unit = UNIT;
    make_mass({body.topology, body.part, body.masses, body.labels}, settings)->multiply(v, p);
    energy[hot] = 0.0;
    for (int i = 0; i < body.size(); ++i) energy[hot] += v[i].c[2] * p[i].c[2];
  }
  // edges are 1 long along x or lie at 60 degrees; the mean of |grad h|^2 is q^2/2 as q becomes small
  const double slope = (4.0 * std::pow(std::sin(0.5 * q), 2) + 8.0 * std::pow(std::sin(0.25 * q), 2)) / 3.0;
  const double faces = body.topology.num_faces();
  EXPECT_NEAR(energy[1] - energy[0], 0.75 * warm.measure * faces * slope * UNIT, 1e-9 * energy[1]);
}

TEST(SamplingMass, NoiseHasTheInverseAsCovariance)
{
  Sampled body(icosphere(0, 1.0), TotalsOf::VOLUME_AND_LENGTH);
  const int n = 3 * body.size(), samples = how_many(60000, 600000L);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, n);
  const double kT = 0.4;
  for (int s = 0; s < samples; ++s) {
    VertexField v(body.size());
    body.matrix->sample(kT, 11, s, v);
    Eigen::VectorXd x(n);
    for (int i = 0; i < n; ++i) x[i] = v[i / 3].c[i % 3];
    sum += x * x.transpose() / samples;
  }
  const Eigen::MatrixXd expected = kT * body.inverse();
  // each entry has the error sqrt((ii jj + ij^2)/samples)
  for (int i = 0; i < n; ++i)
    for (int j = 0; j <= i; ++j) {
      const double error = std::sqrt((expected(i, i) * expected(j, j) + expected(i, j) * expected(i, j)) / samples);
      EXPECT_NEAR(sum(i, j), expected(i, j), 5.0 * error) << i << " " << j;
    }
}

TEST(SamplingMass, SolvesWithTheNoiseOfASample)
{
  for (const TriangleMesh &mesh : some_meshes()) {
    Sampled body(mesh, mesh.is_periodic() ? TotalsOf::NONE : TotalsOf::VOLUME_AND_LENGTH);
    const VertexField p = rough(body.size());
    VertexField v(body.size()), z(body.size()), solved(body.size()), sampled(body.size());
    body.matrix->solve(p, solved);
    body.matrix->sample(1.0, 7, 13, sampled);
    body.matrix->solve_with_noise(p, v, 7, 13, z);
    for (int i = 0; i < body.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(v[i].c[k], solved[i].c[k], 1e-12);
        EXPECT_NEAR(z[i].c[k], sampled[i].c[k], 1e-12);
      }
  }
}

TEST(SamplingMass, MultiplyUndoesSolve)
{
  std::vector<TriangleMesh> meshes = some_meshes();
  meshes.push_back(perturbed(icosphere(2, 1.0), 0.05, 6));
  meshes.push_back(perturbed(small_sheet(), 0.2, 7));
  for (const TriangleMesh &mesh : meshes) {
    Sampled body(mesh, mesh.is_periodic() ? TotalsOf::NONE : TotalsOf::VOLUME);
    const VertexField p = rough(body.size());
    VertexField v(body.size()), q(body.size()), w(body.size());
    body.matrix->solve(p, v);
    body.matrix->multiply(v, q);
    body.matrix->solve(q, w);
    double off = 0.0, size = 0.0, energy = 0.0, other = 0.0, momenta[2] = {0.0, 0.0};
    for (int i = 0; i < body.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        off += std::pow(w[i].c[k] - v[i].c[k], 2);
        size += std::pow(v[i].c[k], 2);
        energy += v[i].c[k] * p[i].c[k];
        other += v[i].c[k] * q[i].c[k];
        momenta[0] += std::pow(p[i].c[k], 2);
        momenta[1] += std::pow(q[i].c[k], 2);
      }
    EXPECT_LT(off, 1e-20 * size);
    EXPECT_NEAR(other, energy, 1e-10 * energy);
    EXPECT_LT(momenta[1], 4.0 * momenta[0]);    // no more of what velocities do not know than there was
  }
}

TEST(SamplingMass, GaugeForcesAreThoseOfMinusKTLnDetR)
{
  Sampled body(perturbed(icosphere(1, 1.0), 0.1, 4));
  const int n = body.size();
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d &p : body.mesh.points) middle += p / n;
  const auto energy = [&](const Points &x) {
    Matrix3d r = Matrix3d::Zero();
    for (int v = 0; v < n; ++v)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k)
          r(j, k) += Vector3d::Unit(j).cross(body.mesh.points[v] - middle).dot(Vector3d::Unit(k).cross(x[v]));
    return -0.3 * std::log(r.determinant());
  };
  const Points at = perturbed(body.mesh, 0.1, 5).points;
  VertexField x(n), f(n, Vector4{});
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) x[i].c[k] = at[body.part.vertices[i]][k];
  body.matrix->add_gauge_forces(0.3, x, f);
  Vector3d total = Vector3d::Zero();
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < 3; ++k) {
      Points ahead = at, back = at;
      ahead[body.part.vertices[i]][k] += 1e-5;
      back[body.part.vertices[i]][k] -= 1e-5;
      EXPECT_NEAR(f[i].c[k], -(energy(ahead) - energy(back)) / 2e-5, 1e-8);
    }
    total += Vector3d(f[i].c);
  }
  EXPECT_LT(total.norm(), 1e-12);
}

TEST(SamplingMass, SaysWhatPairCoeffLacks)
{
  Sampled body(icosphere(1, 1.0));
  const auto message = [&](auto change) {
    StiffnessReference stiffness = *body.reference->now;
    change(stiffness);
    MassOperator::Settings settings;
    settings.kind = MassKind::SAMPLING;
    settings.reference = std::make_shared<SharedReference>();
    settings.reference->now = std::make_shared<const StiffnessReference>(stiffness);
    try {
      make_mass({body.topology, body.part, body.masses, body.labels}, settings);
    } catch (const MeshError &error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message([](auto &s) { s.shear.assign(s.shear.size(), 0.0); }).find("regularize"), std::string::npos);
  EXPECT_NE(message([](auto &s) { s.kc.assign(s.kc.size(), 0.0); }).find("bending modulus"), std::string::npos);
  EXPECT_EQ(message([](auto &s) { s.tension.assign(s.tension.size(), -1e6); }), "");
}

TEST(SamplingMass, DistanceFromTheReferenceIsThatOfNormals)
{
  const Sampled body(icosphere(2, 1.0));
  const StiffnessReference &reference = *body.reference->now;
  EXPECT_NEAR(reference.distance(body.mesh, body.topology), 0.0, 1e-14);
  TriangleMesh turned = body.mesh, mirrored = body.mesh;
  const Matrix3d turn = Eigen::AngleAxisd(0.3, Vector3d::UnitZ()).toRotationMatrix();
  for (Vector3d &p : turned.points) p = 2.0 * (turn * p);
  for (Vector3d &p : mirrored.points) p.z() = -p.z();
  // mean of sin^2 over a sphere is 2/3
  EXPECT_NEAR(reference.distance(turned, body.topology), (1.0 - std::cos(0.3)) * 2.0 / 3.0, 2e-3);
  // normals (-x, -y, z) of places (x, y, z)
  EXPECT_NEAR(reference.distance(mirrored, body.topology), 4.0 / 3.0, 2e-3);
}

// === Shapes without short waves

namespace {

double mean_square_edge(const TriangleMesh &mesh)
{
  double sum = 0.0;
  for (const Face &face : mesh.faces)
    for (int k = 0; k < 3; ++k) sum += mesh.edge(face[k], face[(k + 1) % 3]).squaredNorm();
  return sum / (3.0 * mesh.faces.size());
}

double furthest(const TriangleMesh &one, const TriangleMesh &other)
{
  double most = 0.0;
  for (size_t v = 0; v < one.points.size(); ++v) most = std::max(most, (one.points[v] - other.points[v]).norm());
  return most;
}

// 1 - cos of normals, mean, of a shape and another

double apart(const TriangleMesh &one, const TriangleMesh &other)
{
  StiffnessReference reference;
  reference.shape = one;
  return reference.distance(other, topology_of(one));
}

}    // namespace

// 1/(1 + (L/0.5)^2) with L = 6 - the sum of six cosines

TEST(LongWaves, OfASheetAreKeptAndShortOnesGo)
{
  const int nx = 24, ny = 4;
  Matrix3d lattice = Matrix3d::Identity();
  lattice.diagonal() << nx, ny * std::sqrt(0.75), 10.0;
  const TriangleMesh flat = sheet(nx, ny, lattice, 0.0);
  const Topology topology = topology_of(flat);
  EXPECT_LT(furthest(long_waves(flat, topology), flat), 1e-12);
  for (int waves : {1, 2, 4, 12}) {
    const double q = 2.0 * PI * waves / nx, l = 6.0 - 2.0 * std::cos(q) - 4.0 * std::cos(0.5 * q);
    TriangleMesh bent = flat, expected = flat;
    for (size_t v = 0; v < flat.points.size(); ++v) {
      bent.points[v].z() += 1e-6 * std::cos(q * flat.points[v].x());
      expected.points[v].z() += 1e-6 * std::cos(q * flat.points[v].x()) / (1.0 + 4.0 * l * l);
    }
    // the same wherever the box cuts it
    for (size_t v = 0; v < flat.points.size(); v += 3) {
      bent.points[v] += lattice.col(0);
      expected.points[v] += lattice.col(0);
    }
    EXPECT_LT(furthest(long_waves(bent, topology), expected), 1e-12) << waves;
  }
}

TEST(LongWaves, VesiclesAndTubesStayWhatTheyAre)
{
  Matrix3d lattice = Matrix3d::Identity();
  lattice.diagonal() << 9.0, 11.0, 8.0;
  TriangleMesh oblate = icosphere(3, 1.0);
  for (Vector3d &p : oblate.points) p = Vector3d(1.2 * p.x() + 5.0, 1.2 * p.y(), 0.7 * p.z());
  const TriangleMesh shapes[] = {icosphere(0, 1.0), icosphere(2, 1.0), icosphere(3, 2.0), oblate,
                                 tube(8, 12, 0.9, lattice, 2), together(icosphere(1, 1.0), icosphere(2, 0.5), Vector3d(4, 0, 0))};
  for (const TriangleMesh &shape : shapes) {
    const TriangleMesh smooth = long_waves(shape, topology_of(shape));
    const double edge = std::sqrt(mean_square_edge(shape));
    EXPECT_LT(furthest(smooth, shape), 0.25 * edge) << shape.points.size();
    EXPECT_LT(apart(smooth, shape), 0.005) << shape.points.size();
  }
  // no linear map makes up for the ring of a torus, which becomes slim
  const TriangleMesh ring = torus(36, 18, 2.0, 0.8);
  EXPECT_LT(apart(long_waves(ring, topology_of(ring)), ring), 0.03);
}

// the same sphere, whatever its valences

TEST(LongWaves, OfAnIrregularMeshAreThoseOfTheSurface)
{
  TriangleMesh mesh = flipped(icosphere(3, 1.0), 300, 8, 10);
  const TriangleMesh smooth = long_waves(mesh, topology_of(mesh));
  EXPECT_LT(apart(smooth, mesh), 0.003);
}

// a wave as long as the shape itself, and noise that turns normals as thermal motion does at 20 kT

TEST(LongWaves, AreFoundUnderNoise)
{
  for (int level : {3, 4}) {
    TriangleMesh clean = icosphere(level, 1.0);
    for (Vector3d &p : clean.points) p *= 1.0 + 0.1 * (3.0 * p.z() * p.z() - 1.0);
    const double edge = std::sqrt(mean_square_edge(clean));
    const TriangleMesh noisy = perturbed(clean, 0.3 * edge, 8), smooth = long_waves(noisy, topology_of(noisy));
    EXPECT_GT(apart(noisy, clean), 0.005);
    EXPECT_LT(apart(smooth, clean), 0.25 * apart(noisy, clean)) << level;
  }
}

TEST(LongWaves, MoveAndTurnWithTheShape)
{
  const TriangleMesh shape = perturbed(icosphere(2, 1.0), 0.05, 9);
  TriangleMesh moved = shape, expected = long_waves(shape, topology_of(shape));
  const Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for (TriangleMesh *mesh : {&moved, &expected})
    for (Vector3d &p : mesh->points) p = 3.0 * (turn * p) + Vector3d(1, -2, 5);
  EXPECT_LT(furthest(long_waves(moved, topology_of(moved)), expected), 1e-10);
}
