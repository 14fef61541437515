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

#include "membrane_limit_basis.h"

#include "scene.h"

#include <gtest/gtest.h>

#include <functional>

using namespace Membrane_TEST;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::Vector2d;
using Eigen::VectorXd;
using Weights = LimitBasis::Weights;

namespace {

// valences that occur at the corners of one face; every neighbour of a vertex of valence 3 is one
// of its neighbours' too, so two such corners occur only on a tetrahedron
const Valences TRIPLES[] = {{6, 6, 6},   {3, 3, 3},    {3, 6, 6},    {6, 3, 6},  {6, 6, 3},
                            {4, 6, 6},   {5, 6, 6},    {6, 7, 6},    {6, 6, 8},  {16, 6, 6},
                            {5, 5, 5},   {4, 4, 4},    {3, 4, 4},    {4, 3, 4},  {4, 4, 3},
                            {3, 12, 7},  {12, 7, 3},   {7, 3, 12},   {16, 4, 4}, {5, 6, 7},
                            {9, 10, 11}, {13, 14, 15}, {16, 16, 16}, {20, 5, 3}, {3, 6, 4}};

std::string text(const Valences &n)
{
  return std::to_string(n[0]) + ", " + std::to_string(n[1]) + ", " + std::to_string(n[2]);
}

// lattice positions (in u, v) of the control points of a regular face, as Topology::stencil() has
// them: corners, then each corner's ring counter-clockwise from the vertex across the edge that
// ends in it
const std::vector<Vector2d> LATTICE = {{0, 0},  {1, 0},  {0, 1}, {-1, 1}, {-1, 0}, {0, -1},
                                       {1, -1}, {2, -1}, {2, 0}, {1, 1},  {0, 2},  {-1, 2}};

// one row applied to a function of the lattice position
template <class Function> double applied(const Weights &w, int row, Function &&f)
{
  double sum = 0.0;
  for (size_t k = 0; k < LATTICE.size(); ++k) sum += w(row, k) * f(LATTICE[k][0], LATTICE[k][1]);
  return sum;
}

// points in the face, none of them within 1/16 of a corner or 1/128 of a line across which a
// third derivative jumps
std::vector<Vector2d> sample_points(int count, unsigned seed)
{
  Random random(seed);
  std::vector<Vector2d> points;
  auto clear = [](double t) {
    for (double scale = 1.0; scale < 20.0; scale *= 2.0)
      if (std::fabs(t * scale - std::round(t * scale)) < scale / 128.0) return false;
    return true;
  };
  while (static_cast<int>(points.size()) < count) {
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    if (std::max({u, v, 1.0 - u - v}) > 1.0 - 1.0 / 16.0) continue;
    if (clear(u) && clear(v) && clear(u + v)) points.emplace_back(u, v);
  }
  return points;
}

// the rows DU..DVV from differences of VALUE rows; exact for polynomials of degree 4
Weights from_differences(const std::function<Weights(double, double)> &basis, double u, double v)
{
  const double h = 1.0 / 512.0;
  auto value = [&](double du, double dv) -> RowVectorXd {
    return basis(u + du * h, v + dv * h).row(LimitBasis::VALUE);
  };
  auto first = [&](double du, double dv) -> RowVectorXd {
    return (8.0 * (value(du, dv) - value(-du, -dv)) - value(2 * du, 2 * dv) +
            value(-2 * du, -2 * dv)) /
        (12.0 * h);
  };
  auto second = [&](double du, double dv) -> RowVectorXd {
    return (16.0 * (value(du, dv) + value(-du, -dv)) - value(2 * du, 2 * dv) -
            value(-2 * du, -2 * dv) - 30.0 * value(0, 0)) /
        (12.0 * h * h);
  };
  Weights w(LimitBasis::ROWS, value(0, 0).size());
  w.row(LimitBasis::VALUE) = value(0, 0);
  w.row(LimitBasis::DU) = first(1, 0);
  w.row(LimitBasis::DV) = first(0, 1);
  w.row(LimitBasis::DUU) = second(1, 0);
  w.row(LimitBasis::DVV) = second(0, 1);
  w.row(LimitBasis::DUV) = 0.25 * (second(1, 1) - second(1, -1));
  return w;
}

// rows as rows of positions and derivatives
Eigen::Matrix<double, LimitBasis::ROWS, 3>
surface(const TriangleMesh &mesh, const Topology &topology, int face, int first, double u, double v)
{
  std::vector<int> points;
  topology.stencil(face, points, first);
  const Face &f = topology.face(face);
  Valences n;
  for (int k = 0; k < 3; ++k) n[k] = topology.valence(f[(first + k) % 3]);
  MatrixXd x(points.size(), 3);
  for (size_t k = 0; k < points.size(); ++k) x.row(k) = mesh.points[points[k]];
  return LimitBasis(n).evaluate(u, v) * x;
}

// meshes that have extraordinary vertices of many kinds, also several on one face
std::vector<TriangleMesh> closed_meshes()
{
  std::vector<TriangleMesh> meshes = {tetrahedron(),
                                      bipyramid(3),
                                      bipyramid(4),
                                      bipyramid(7),
                                      bipyramid(12),
                                      icosphere(0, 1.0),
                                      flipped(icosphere(1, 1.0), 40, 12, 1),
                                      torus(5, 6, 2.0, 0.7)};
  unsigned seed = 10;
  for (TriangleMesh &mesh : meshes) mesh = perturbed(mesh, 0.1, ++seed);
  return meshes;
}

}    // namespace

// === The regular face

TEST(BoxSpline, IsAPartitionOfUnityAndPositive)
{
  for (const Vector2d &p : sample_points(50, 1)) {
    const Weights w = box_spline(p[0], p[1]);
    EXPECT_NEAR(w.row(LimitBasis::VALUE).sum(), 1.0, 1e-14);
    EXPECT_GE(w.row(LimitBasis::VALUE).minCoeff(), 0.0);
    for (int row = LimitBasis::DU; row < LimitBasis::ROWS; ++row)
      EXPECT_NEAR(w.row(row).sum(), 0.0, 1e-13);
  }
}

TEST(BoxSpline, ReproducesLinearFunctions)
{
  for (const Vector2d &p : sample_points(50, 2)) {
    const double u = p[0], v = p[1];
    const Weights w = box_spline(u, v);
    auto f = [](double x, double y) {
      return 3.0 + 2.0 * x - 5.0 * y;
    };
    EXPECT_NEAR(applied(w, LimitBasis::VALUE, f), f(u, v), 1e-13);
    EXPECT_NEAR(applied(w, LimitBasis::DU, f), 2.0, 1e-13);
    EXPECT_NEAR(applied(w, LimitBasis::DV, f), -5.0, 1e-13);
    for (int row : {LimitBasis::DUU, LimitBasis::DUV, LimitBasis::DVV})
      EXPECT_NEAR(applied(w, row, f), 0.0, 1e-12);
  }
}

TEST(BoxSpline, ReproducesQuadraticFunctionsUpToAConstant)
{
  // the squared distance on the equilateral lattice, one harmonic there, and one neither
  auto round = [](double x, double y) {
    return x * x + x * y + y * y;
  };
  auto product = [](double x, double y) {
    return x * y;
  };
  auto saddle = [](double x, double y) {
    return x * x - y * y;
  };
  const double constant = applied(box_spline(0.0, 0.0), LimitBasis::VALUE, round);
  EXPECT_NEAR(constant, 0.5, 1e-14);    // six neighbours at 1/12 each
  for (const Vector2d &p : sample_points(50, 3)) {
    const double u = p[0], v = p[1];
    const Weights w = box_spline(u, v);
    EXPECT_NEAR(applied(w, LimitBasis::DUU, round), 2.0, 1e-12);
    EXPECT_NEAR(applied(w, LimitBasis::VALUE, round), round(u, v) + constant, 1e-13);
    EXPECT_NEAR(applied(w, LimitBasis::DUV, round), 1.0, 1e-12);
    EXPECT_NEAR(applied(w, LimitBasis::DVV, round), 2.0, 1e-12);
    EXPECT_NEAR(applied(w, LimitBasis::DUV, product), 1.0, 1e-12);
    EXPECT_NEAR(applied(w, LimitBasis::DU, product), v, 1e-13);
    EXPECT_NEAR(applied(w, LimitBasis::DV, product), u, 1e-13);
    EXPECT_NEAR(applied(w, LimitBasis::DU, saddle), 2.0 * u, 1e-13);
    EXPECT_NEAR(applied(w, LimitBasis::VALUE, saddle), saddle(u, v), 1e-13);
  }
}

TEST(BoxSpline, HasTheSecondDerivativesOfCubicFunctions)
{
  for (const Vector2d &p : sample_points(50, 4)) {
    const Weights w = box_spline(p[0], p[1]);
    auto cube = [](double x, double) {
      return x * x * x;
    };
    auto mixed = [](double x, double y) {
      return x * x * y;
    };
    EXPECT_NEAR(applied(w, LimitBasis::DUU, cube), 6.0 * p[0], 1e-12);
    EXPECT_NEAR(applied(w, LimitBasis::DUV, cube), 0.0, 1e-12);
    EXPECT_NEAR(applied(w, LimitBasis::DUU, mixed), 2.0 * p[1], 1e-12);
    EXPECT_NEAR(applied(w, LimitBasis::DUV, mixed), 2.0 * p[0], 1e-12);
    EXPECT_NEAR(applied(w, LimitBasis::DVV, mixed), 0.0, 1e-12);
  }
}

TEST(BoxSpline, DerivativesAreThoseOfTheValue)
{
  for (const Vector2d &p : sample_points(50, 5)) {
    const Weights difference = box_spline(p[0], p[1]) - from_differences(box_spline, p[0], p[1]);
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(BoxSpline, HasTheSymmetriesOfTheTriangle)
{
  // the corner that each corner goes to, and with it every lattice point
  const std::array<int, 3> moves[] = {{1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (const auto &move : moves)
    for (const Vector2d &p : sample_points(10, 6)) {
      auto moved = [&](const Vector2d &x) {
        const double from[3] = {1.0 - x[0] - x[1], x[0], x[1]};
        double to[3];
        for (int k = 0; k < 3; ++k) to[move[k]] = from[k];
        return Vector2d(to[1], to[2]);
      };
      const Vector2d q = moved(p);
      const Weights w = box_spline(p[0], p[1]), turned = box_spline(q[0], q[1]);
      for (size_t k = 0; k < LATTICE.size(); ++k) {
        const Vector2d image = moved(LATTICE[k]);
        size_t partner = 0;
        while ((LATTICE[partner] - image).norm() > 1e-12) ASSERT_LT(++partner, LATTICE.size());
        EXPECT_NEAR(w(LimitBasis::VALUE, k), turned(LimitBasis::VALUE, partner), 1e-14);
      }
    }
}

TEST(BoxSpline, TakesTheStencilInTheOrderOfTopology)
{
  Matrix3d box = Matrix3d::Identity();
  const TriangleMesh mesh = sheet(8, 8, box, 0.0);
  const Topology topology = topology_of(mesh);
  for (int f = 0; f < topology.num_faces(); f += 5)
    for (int first = 0; first < 3; ++first) {
      std::vector<int> points;
      topology.stencil(f, points, first);
      ASSERT_EQ(points.size(), LATTICE.size());
      const Vector3d along_u = mesh.edge(points[0], points[1]);
      const Vector3d along_v = mesh.edge(points[0], points[2]);
      for (size_t k = 0; k < points.size(); ++k) {
        const Vector3d expected = LATTICE[k][0] * along_u + LATTICE[k][1] * along_v;
        EXPECT_LT((mesh.edge(points[0], points[k]) - expected).norm(), 1e-12);
      }
    }
}

// === Loop's rule

TEST(LoopRule, HasLoopsOwnWeights)
{
  EXPECT_NEAR(loop_beta(3), 3.0 / 16.0, 1e-15);
  EXPECT_NEAR(loop_beta(6), 1.0 / 16.0, 1e-15);
  EXPECT_NEAR(limit_mask_centre(3), 0.4, 1e-15);
  EXPECT_NEAR(limit_mask_centre(6), 0.5, 1e-15);
  EXPECT_NEAR(limit_mask_centre(4), 0.4364, 5e-5);
  EXPECT_NEAR(limit_mask_centre(5), 0.4714, 5e-5);
  for (int n = 3; n <= 30; ++n) {
    const double cosine = std::cos(2.0 * PI / n);
    EXPECT_NEAR(loop_beta(n), (0.625 - std::pow(0.375 + 0.25 * cosine, 2)) / n, 1e-15);
  }
}

// the limit mask and the shrinking factor against the subdivision matrix of a vertex and its ring
TEST(LoopRule, MaskAndEigenvalueBelongToTheSubdivisionMatrix)
{
  for (int n = 3; n <= 20; ++n) {
    MatrixXd matrix = MatrixXd::Zero(n + 1, n + 1);
    matrix.row(0).setConstant(loop_beta(n));
    matrix(0, 0) = 1.0 - n * loop_beta(n);
    for (int i = 0; i < n; ++i) {
      matrix(1 + i, 0) += 0.375;
      matrix(1 + i, 1 + i) += 0.375;
      matrix(1 + i, 1 + (i + 1) % n) += 0.125;
      matrix(1 + i, 1 + (i + n - 1) % n) += 0.125;
    }
    RowVectorXd mask = RowVectorXd::Constant(n + 1, (1.0 - limit_mask_centre(n)) / n);
    mask[0] = limit_mask_centre(n);
    EXPECT_LT((mask * matrix - mask).norm(), 1e-15) << "valence " << n;

    RowVectorXd tangent = RowVectorXd::Zero(n + 1);
    for (int i = 0; i < n; ++i) tangent[1 + i] = std::cos(2.0 * PI * i / n);
    EXPECT_LT((tangent * matrix - subdominant_eigenvalue(n) * tangent).norm(), 1e-14);
  }
}

// === Faces with corners of any valence

TEST(LimitBasis, IsAPartitionOfUnity)
{
  for (const Valences &n : TRIPLES) {
    const LimitBasis basis(n);
    EXPECT_EQ(basis.size(), std::max(4, n[0] + n[1] + n[2] - 6));
    for (const Vector2d &p : sample_points(20, 7)) {
      const Weights w = basis.evaluate(p[0], p[1]);
      ASSERT_EQ(w.cols(), basis.size());
      EXPECT_NEAR(w.row(LimitBasis::VALUE).sum(), 1.0, 1e-13) << text(n);
      for (int row = LimitBasis::DU; row < LimitBasis::ROWS; ++row)
        EXPECT_NEAR(w.row(row).sum(), 0.0, 1e-12) << text(n) << " row " << row;
    }
  }
}

TEST(LimitBasis, DerivativesAreThoseOfTheValue)
{
  double worst = 0.0;
  for (const Valences &n : TRIPLES) {
    const LimitBasis basis(n);
    auto evaluate = [&](double u, double v) {
      return basis.evaluate(u, v);
    };
    for (const Vector2d &p : sample_points(20, 8)) {
      const Weights w = basis.evaluate(p[0], p[1]);
      const double error = (w - from_differences(evaluate, p[0], p[1])).cwiseAbs().maxCoeff();
      EXPECT_LT(error, 1e-8) << text(n) << " at " << p.transpose();
      worst = std::max(worst, error);
    }
  }
  RecordProperty("worst_error", scientific(worst));
}

TEST(LimitBasis, TurningTheFaceOnlyRenamesTheControlPoints)
{
  for (const Valences &n : TRIPLES) {
    const LimitBasis basis(n), turned({n[1], n[2], n[0]});
    std::vector<int> partner = {2, 0, 1};    // column of `turned` for each column of `basis`
    const int lists[3] = {n[0] - 3, n[1] - 3, n[2] - 3};
    for (int i = 0; i < lists[0]; ++i) partner.push_back(3 + lists[1] + lists[2] + i);
    for (int i = 0; i < lists[1] + lists[2]; ++i) partner.push_back(3 + i);
    if (partner.size() == 3) partner.push_back(3);
    for (const Vector2d &p : sample_points(10, 9)) {
      const Weights w = basis.evaluate(p[0], p[1]);
      const Weights t = turned.evaluate(p[1], 1.0 - p[0] - p[1]);
      for (int k = 0; k < basis.size(); ++k) {
        EXPECT_NEAR(w(LimitBasis::VALUE, k), t(LimitBasis::VALUE, partner[k]), 1e-14) << text(n);
        EXPECT_NEAR(w(LimitBasis::DU, k), -t(LimitBasis::DV, partner[k]), 1e-13) << text(n);
        EXPECT_NEAR(w(LimitBasis::DV, k),
                    t(LimitBasis::DU, partner[k]) - t(LimitBasis::DV, partner[k]), 1e-13)
            << text(n);
      }
    }
  }
}

TEST(LimitBasis, ChildrenAreTheFace)
{
  for (const Valences &n : TRIPLES) {
    const LimitBasis basis(n);
    // where the corners of the children lie on the face
    const Vector2d corner[4][3] = {{{0, 0}, {0.5, 0}, {0, 0.5}},
                                   {{0.5, 0}, {1, 0}, {0.5, 0.5}},
                                   {{0, 0.5}, {0.5, 0.5}, {0, 1}},
                                   {{0.5, 0.5}, {0, 0.5}, {0.5, 0}}};
    for (int child = 0; child < 4; ++child) {
      const LimitBasis sub(basis.child_valences(child));
      const MatrixXd matrix = basis.child_matrix(child);
      ASSERT_EQ(matrix.rows(), sub.size());
      EXPECT_LT((matrix.rowwise().sum().array() - 1.0).abs().maxCoeff(), 1e-14);
      for (const Vector2d &p : sample_points(5, 10)) {
        const Vector2d q = corner[child][0] * (1.0 - p[0] - p[1]) + corner[child][1] * p[0] +
            corner[child][2] * p[1];
        const RowVectorXd value = sub.evaluate(p[0], p[1]).row(LimitBasis::VALUE) * matrix;
        EXPECT_LT((value - basis.evaluate(q[0], q[1]).row(LimitBasis::VALUE)).norm(), 1e-14);
      }
    }
  }
}

TEST(LimitBasis, IsTwiceDifferentiableAcrossTheBordersOfItsChildren)
{
  for (const Valences &n : TRIPLES) {
    const LimitBasis basis(n);
    const double step = 1e-9;
    for (double t = 0.03; t < 0.5; t += 0.0937)
      for (double level : {0.5, 0.25}) {
        const std::pair<Vector2d, Vector2d> borders[] = {
            // a point on a border, and across it
            {{level, t * level}, {1, 0}},
            {{t * level, level}, {0, 1}},
            {{t * level, (1 - t) * level}, {0.7, 0.7}}};
        for (const auto &[p, across] : borders) {
          const Vector2d a = p + step * across, b = p - step * across;
          const Weights jump = basis.evaluate(a[0], a[1]) - basis.evaluate(b[0], b[1]);
          EXPECT_LT(jump.row(LimitBasis::VALUE).cwiseAbs().maxCoeff(), 1e-8) << text(n);
          EXPECT_LT(jump.middleRows(LimitBasis::DU, 2).cwiseAbs().maxCoeff(), 1e-7) << text(n);
          EXPECT_LT(jump.middleRows(LimitBasis::DUU, 3).cwiseAbs().maxCoeff(), 1e-6) << text(n);
        }
      }
  }
}

TEST(LimitBasis, TendsToTheLimitMaskAtACorner)
{
  for (const Valences &n : TRIPLES) {
    const LimitBasis basis(n);
    for (int k = 0; k < 3; ++k) {
      const RowVectorXd mask = basis.corner_mask(k);
      EXPECT_NEAR(mask.sum(), 1.0, 1e-14);
      EXPECT_NEAR(mask[k], limit_mask_centre(n[k]), n[0] + n[1] + n[2] == 9 ? 1.0 : 1e-14);

      double t[3] = {0.0, 0.0, 0.0};
      t[k] = 1.0;
      EXPECT_LT((basis.evaluate(t[1], t[2]).row(LimitBasis::VALUE) - mask).norm(), 1e-14);
      for (int level : {5, 10, 20, 28}) {
        const double distance = std::ldexp(1.0, -level);
        t[k] = 1.0 - distance;
        t[(k + 1) % 3] = 0.7 * distance;
        t[(k + 2) % 3] = 0.3 * distance;
        const RowVectorXd value = basis.evaluate(t[1], t[2]).row(LimitBasis::VALUE);
        // as fast as the subdominant eigenvalue shrinks the neighbourhood
        EXPECT_LT((value - mask).cwiseAbs().maxCoeff(),
                  2.0 * std::pow(subdominant_eigenvalue(n[k]), level) + 1e-14)
            << text(n) << " corner " << k << " level " << level;
      }
      EXPECT_TRUE(basis.evaluate(t[1], t[2]).allFinite());
    }
  }
}

// === On meshes

TEST(LimitSurface, IsTwiceDifferentiableAcrossEveryEdge)
{
  double worst = 0.0;
  for (const TriangleMesh &mesh : closed_meshes()) {
    const Topology topology = topology_of(mesh);
    for (int f = 0; f < topology.num_faces(); ++f)
      for (int k = 0; k < 3; ++k) {
        const int g = topology.neighbor(f, k);
        const int end = corner_of(topology.face(g), topology.face(f)[(k + 1) % 3]);
        for (double t : {0.1, 0.37, 0.5, 0.8}) {
          // both faces turned so that the edge is their u axis: the other's runs the other way
          auto here = surface(mesh, topology, f, k, t, 0.0);
          auto beyond = surface(mesh, topology, g, end, 1.0 - t, 0.0);
          beyond.middleRows(LimitBasis::DU, 2) *= -1.0;
          const double error = (here - beyond).cwiseAbs().maxCoeff();
          EXPECT_LT(error, 1e-11 * std::max(1.0, here.cwiseAbs().maxCoeff()));
          worst = std::max(worst, error);
        }
      }
  }
  RecordProperty("worst_jump", scientific(worst));
}

TEST(LimitSurface, HasOneTangentPlaneAtAnExtraordinaryVertex)
{
  for (const TriangleMesh &mesh : closed_meshes()) {
    const Topology topology = topology_of(mesh);
    for (int v = 0; v < topology.num_vertices(); ++v) {
      // the tangent masks of Loop's scheme [Hoppe 1994]
      const int n = topology.valence(v);
      Vector3d first = Vector3d::Zero(), second = Vector3d::Zero();
      for (int i = 0; i < n; ++i) {
        first += std::cos(2.0 * PI * i / n) * mesh.points[topology.ring(v)[i]];
        second += std::sin(2.0 * PI * i / n) * mesh.points[topology.ring(v)[i]];
      }
      const Vector3d normal = first.cross(second).normalized();
      for (int f : topology.faces_around(v)) {
        const auto near = surface(mesh, topology, f, corner_of(topology.face(f), v), 5e-9, 3e-9);
        const Vector3d du = near.row(LimitBasis::DU), dv = near.row(LimitBasis::DV);
        // the normal turns by (bending eigenvalue/tangent eigenvalue)^27, 0.1 at valence 12
        const double turn = std::pow(energy_decay(n), 0.5 * 27.0);
        EXPECT_LT((du.cross(dv).normalized() - normal).norm(), 20.0 * turn + 1e-6)
            << "valence " << n;
      }
    }
  }
}

// the oracle is explicit subdivision; the evaluation does not use that code
TEST(LimitSurface, IsTheLimitOfSubdivision)
{
  double worst = 0.0;
  for (const TriangleMesh &mesh : closed_meshes()) {
    const Topology topology = topology_of(mesh);
    struct Sub {
      int face;
      Face vertex;
      Vector2d uv[3];
    };
    std::vector<Sub> subs;
    for (int f = 0; f < topology.num_faces(); ++f)
      subs.push_back({f, topology.face(f), {{0, 0}, {1, 0}, {0, 1}}});

    TriangleMesh fine = mesh;
    for (int level = 1; level <= 2; ++level) {
      // a point of the finer mesh that is new lies on the edge of its two old neighbours
      const int num_old = static_cast<int>(fine.points.size());
      fine = loop_refine(fine);
      const Topology refined = topology_of(fine);
      std::map<std::pair<int, int>, int> midpoint;
      for (int v = num_old; v < refined.num_vertices(); ++v) {
        std::vector<int> ends;
        for (int w : refined.ring(v))
          if (w < num_old) ends.push_back(w);
        ASSERT_EQ(ends.size(), 2u);
        midpoint[{ends[0], ends[1]}] = midpoint[{ends[1], ends[0]}] = v;
      }
      std::vector<Sub> finer;
      for (const Sub &s : subs) {
        int m[3];
        Vector2d uv[3];
        for (int k = 0; k < 3; ++k) {
          m[k] = midpoint.at({s.vertex[k], s.vertex[(k + 1) % 3]});
          uv[k] = 0.5 * (s.uv[k] + s.uv[(k + 1) % 3]);
        }
        for (int k = 0; k < 3; ++k)
          finer.push_back(
              {s.face, {s.vertex[k], m[k], m[(k + 2) % 3]}, {s.uv[k], uv[k], uv[(k + 2) % 3]}});
        finer.push_back({s.face, {m[0], m[1], m[2]}, {uv[0], uv[1], uv[2]}});
      }
      subs = finer;
    }

    const Points limit = limit_positions(fine);
    for (const Sub &s : subs)
      for (int k = 0; k < 3; ++k) {
        const auto rows = surface(mesh, topology, s.face, 0, s.uv[k][0], s.uv[k][1]);
        const double error = (rows.row(LimitBasis::VALUE).transpose() - limit[s.vertex[k]]).norm();
        EXPECT_LT(error, 1e-13);
        worst = std::max(worst, error);
      }
  }
  RecordProperty("worst_distance", scientific(worst));
}
