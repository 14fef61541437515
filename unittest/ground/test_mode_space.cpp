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


#include "membrane_limit_mask.h"
#include "membrane_mass_kinds.h"
#include "membrane_mass_modes.h"
#include "membrane_mesh_shapes.h"
#include "one_rank.h"
#include "scene.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace Membrane_NS;
using namespace Membrane_TEST;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

ModeChoice degrees(int lowest, int highest)
{
  ModeChoice choice;
  choice.shape = ModeChoice::Shape::SPHERE;
  choice.lowest = lowest;
  choice.highest = highest;
  return choice;
}

/// A mesh, its modes and a mass matrix in their space. Vertices weigh their share of the limit surface.
struct Modal {
  TriangleMesh mesh;
  Topology topology;
  OneRank part;
  std::vector<double> masses;
  std::vector<uint64_t> labels;
  SharedModes shared;
  std::unique_ptr<ModalMass> matrix;

  Modal(TriangleMesh m, const ModeChoice &choice, std::vector<double> friction = {}, bool drag = false) :
      mesh(std::move(m)), topology(mesh.points.size(), mesh.faces), part(topology),
      masses(mesh.points.size(), 0.0), labels(mesh.points.size())
  {
    for (size_t i = 0; i < labels.size(); ++i) labels[i] = i + 1;
    shared.choice = choice;
    shared.shape = mesh;
    shared.frames.push_back(find_reference(topology, 0, mesh, choice, shared.shape));
    auto space = std::make_shared<ModeSpace>();
    space->reference = shared.shape.points;
    space->membranes.push_back(make_modes(topology, 0, shared.shape, shared.frames[0], choice));
    shared.now = space;
    shared.friction = std::move(friction);
    weigh();
    make_matrix(drag);
  }

  void make_matrix(bool drag = false)
  {
    const VertexMasses vertices = {topology, part, masses, labels};
    MassOperator::Settings settings;
    settings.tolerance = 1.0e-13;
    matrix = std::make_unique<ModalMass>(vertices, make_mass(vertices, settings), shared, drag, MatrixXd());
  }

  /// Masses that make the sum over vertices the integral of the spline through its values there: the gradient of the
  /// volume of a sphere is that of its splines times the normal.
  void weigh_as_splines()
  {
    Moduli pressure = {0.0};
    pressure.pressure = 1.0;
    const auto gradient = Scene(shared.shape, Quadrature::TWELVE, {pressure}).evaluate().force;
    const auto r = limit_positions(shared.shape.points);
    LimitMask mask(topology, part, {true, 1.0e-14});
    VertexField b(part.size()), x(part.size());
    for (int i = 0; i < part.owned; ++i)
      for (int k = 0; k < 3; ++k) b[i].c[k] = mask.spoke(i) * gradient[part.vertices[i]][k];
    mask.solve(b, x);
    for (int i = 0; i < part.owned; ++i) {
      const int v = part.vertices[i];
      masses[v] = std::fabs(r[v].normalized().dot(Vector3d(x[i].c))) / mask.spoke(i);
    }
    make_matrix();
  }

  void weigh()
  {
    const auto r = limit_positions(shared.shape.points);
    for (const Face &f : topology.faces())
      for (int k = 0; k < 3; ++k) {
        const Vector3d a = mesh.nearest_image(r[f[1]] - r[f[0]]), b = mesh.nearest_image(r[f[2]] - r[f[0]]);
        masses[f[k]] += a.cross(b).norm() / 6.0;
      }
  }

  std::vector<Vector3d> limit_positions(const std::vector<Vector3d> &q) const
  {
    TriangleMesh shaped = mesh;
    shaped.points = q;
    return Membrane_NS::limit_positions(shaped);
  }

  std::vector<Vector3d> shape(const VectorXd &a)
  {
    VertexField u(part.size());
    matrix->expand(a, u);
    auto q = shared.shape.points;
    for (int i = 0; i < part.owned; ++i) q[part.vertices[i]] += Vector3d(u[i].c);
    return q;
  }
};

VectorXd some(int n)
{
  VectorXd a(n);
  for (int k = 0; k < n; ++k) a[k] = std::sin(1.3 * k * k + 1.0);
  return a;
}

// whose limit positions are on the unit sphere

TriangleMesh sphere(int level)
{
  return interpolate(icosphere(level, 1.0));
}

}    // namespace

/* ---------------------------------------------------------------------- */

TEST(ModeSpace, LimitPositionsFollowHarmonicsAlongTheRadiusExactly)
{
  Modal modal(sphere(2), degrees(2, 6));
  const auto &frame = modal.shared.frames[0];
  const VectorXd a = 0.02 * some(modal.matrix->count());
  const auto before = modal.limit_positions(modal.shared.shape.points), after = modal.limit_positions(modal.shape(a));
  std::vector<double> y(49);
  for (size_t v = 0; v < before.size(); ++v) {
    const Vector3d n = (before[v] - frame.middle).normalized();
    EXPECT_NEAR((before[v] - frame.middle).norm(), frame.radius, 1.0e-13);
    harmonics_at(n, 6, y.data());
    double height = 0.0;
    for (int k = 0; k < 45; ++k) height += a[k] * y[k + 4];
    EXPECT_NEAR((after[v] - before[v] - height * n).norm(), 0.0, 1.0e-12);
  }
}

TEST(ModeSpace, LimitPositionsOfASheetFollowPlaneWavesExactly)
{
  ModeChoice choice;
  choice.one = true;
  choice.nx = choice.highest = 2;
  choice.ny = -1;
  Eigen::Matrix3d lattice = 12.0 * Eigen::Matrix3d::Identity();
  TriangleMesh mesh = sheet(12, 14, lattice, 0.0);
  for (size_t v = 0; v < mesh.points.size(); ++v) mesh.points[v] += 0.1 * Vector3d(std::sin(5.0 * v), std::cos(3.0 * v), 0.0);
  Modal modal(mesh, choice);
  const auto before = modal.limit_positions(modal.shared.shape.points),
             after = modal.limit_positions(modal.shape(Eigen::Vector2d(0.3, -0.2)));
  for (size_t v = 0; v < before.size(); ++v) {
    const double phase = 2.0 * PI * (2.0 * before[v].x() - before[v].y()) / 12.0;
    const Vector3d moved = after[v] - before[v];
    EXPECT_NEAR((moved - Vector3d(0.0, 0.0, 0.3 * std::cos(phase) - 0.2 * std::sin(phase))).norm(), 0.0, 1.0e-12);
  }
}

TEST(ModeSpace, TheReferenceOfAShapeThatTheModesHaveIsItsReference)
{
  for (int lowest : {0, 2}) {
    Modal modal(sphere(2), degrees(lowest, 5));
    VectorXd a = 0.03 * some(modal.matrix->count());
    if (lowest == 0) a[0] = 0.0;
    TriangleMesh moved = modal.mesh, reference = modal.mesh;
    moved.points = modal.shape(a);
    for (auto &p : moved.points) p += Vector3d(0.3, -0.2, 0.1);
    const auto frame = find_reference(modal.topology, 0, moved, modal.shared.choice, reference);
    EXPECT_NEAR((frame.middle - modal.shared.frames[0].middle - Vector3d(0.3, -0.2, 0.1)).norm(), 0.0, 1.0e-12);
    for (size_t v = 0; v < moved.points.size(); ++v)
      EXPECT_NEAR((reference.points[v] - modal.shared.shape.points[v] - Vector3d(0.3, -0.2, 0.1)).norm(), 0.0, 1.0e-12);
  }
}

// 642 points: 1e-3; the error falls with the fourth power of the edge

TEST(ModeSpace, HarmonicsAreOrthonormalUnderTheMassAndConverge)
{
  double before = 0.0;
  for (int level = 2; level <= 4; ++level) {
    Modal modal(sphere(level), degrees(2, 5));
    modal.weigh_as_splines();
    double mass = 0.0;
    for (double m : modal.masses) mass += m;
    const MatrixXd g = 4.0 * PI / mass * modal.matrix->gram();
    const double error = (g - MatrixXd::Identity(g.rows(), g.rows())).cwiseAbs().maxCoeff();
    printf("%d points: %.2g\n", modal.part.owned, error);
    if (level == 3) {
      EXPECT_LT(error, 1.0e-3);
    }
    if (level > 2) {
      EXPECT_LT(error, before / 10.0);
    }
    before = error;
  }
}

TEST(ModeSpace, DegreesUpTo20OnTheMeshThatCarriesThem)
{
  Modal modal(sphere(3), degrees(2, 20));
  EXPECT_EQ(modal.matrix->count(), 21 * 21 - 4);
  const VectorXd a = 0.01 * some(modal.matrix->count());
  VertexField u(modal.part.size());
  modal.matrix->expand(a, u);
  EXPECT_NEAR((modal.matrix->amplitudes(u) - a).norm() / a.norm(), 0.0, 1.0e-9);
  EXPECT_THROW(Modal(sphere(3), degrees(2, 21)), ModeError);
  EXPECT_THROW(Modal(sphere(1), degrees(2, 6)), ModeError);
}

TEST(ModeSpace, ShapesFarFromASphereAreRefused)
{
  TriangleMesh mesh = sphere(2);
  for (auto &p : mesh.points) p.x() *= 4.0;
  EXPECT_THROW(Modal(mesh, degrees(2, 6)), ModeError);
}

/* ---------------------------------------------------------------------- */

TEST(ModalMass, MomentaAndVelocitiesAreThoseOfAmplitudes)
{
  Modal modal(sphere(2), degrees(2, 4));
  const VertexField p = rough(modal.part.size());
  VertexField v(p.size()), back(p.size());
  modal.matrix->solve(p, v);
  EXPECT_NEAR((modal.matrix->gram() * modal.matrix->amplitudes(v) - modal.matrix->project(p)).norm(), 0.0, 1.0e-10);
  modal.matrix->multiply(v, back);
  EXPECT_NEAR((modal.matrix->project(back) - modal.matrix->project(p)).norm(), 0.0, 1.0e-10);
  EXPECT_EQ(modal.matrix->lost_freedoms(), 3 * 162 - 21);
}

TEST(ModalMass, FrictionOfModesStandsForTheMassWhereMassIsDrag)
{
  std::vector<double> friction;
  for (int k = 0; k < 21; ++k) friction.push_back(1.0 + k);
  Modal modal(sphere(2), degrees(2, 4), friction, true);
  const VertexField p = rough(modal.part.size());
  VertexField v(p.size()), back(p.size());
  modal.matrix->solve(p, v);
  const VectorXd pull = modal.matrix->project(p), rate = modal.matrix->amplitudes(v);
  for (int k = 0; k < 21; ++k) EXPECT_NEAR(rate[k] * friction[k], pull[k], 1.0e-10);
  modal.matrix->multiply(v, back);
  EXPECT_NEAR((modal.matrix->project(back) - pull).norm(), 0.0, 1.0e-10);
}

TEST(ModalMass, NoiseHasTheCovarianceOfEquilibrium)
{
  constexpr int SAMPLES = 20000;
  for (bool drag : {false, true}) {
    Modal modal(sphere(1), degrees(2, 2), {1.0, 2.0, 3.0, 4.0, 5.0}, drag);
    VertexField v(modal.part.size());
    MatrixXd covariance = MatrixXd::Zero(5, 5), own = covariance;
    VertexField relaxed(modal.part.size(), Vector4{});
    for (int s = 0; s < SAMPLES; ++s) {
      modal.matrix->sample(2.0, 4711, s, v);
      const VectorXd a = modal.matrix->amplitudes(v);
      covariance += a * a.transpose() / SAMPLES;
      if (drag) continue;
      modal.matrix->relax_own(3.0, 2.0, 815, s, relaxed);
      const VectorXd b = modal.matrix->amplitudes(relaxed);
      own += b * b.transpose() / SAMPLES;
    }
    const MatrixXd inverse = drag ? MatrixXd(VectorXd::LinSpaced(5, 1.0, 5.0).asDiagonal()) : modal.matrix->gram();
    const MatrixXd one = MatrixXd::Identity(5, 5);
    EXPECT_LT((0.5 * covariance * inverse - one).cwiseAbs().maxCoeff(), 0.06);
    if (drag) continue;
    EXPECT_LT((0.5 * own * inverse - one).cwiseAbs().maxCoeff(), 0.06);
  }
}

TEST(ModalMass, EachModeRelaxesWithItsOwnFriction)
{
  Modal modal(sphere(1), degrees(2, 2), {1.0, 2.0, 3.0, 4.0, 5.0});
  const VectorXd a = some(5);
  VertexField v(modal.part.size());
  modal.matrix->expand(a, v);
  modal.matrix->relax_own(1.0e-3, 0.0, 1, 1, v);
  const VectorXd lost = modal.matrix->gram() * (a - modal.matrix->amplitudes(v)) / 1.0e-3;
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(lost[k], (k + 1) * a[k], 0.02 * (k + 1));
}
