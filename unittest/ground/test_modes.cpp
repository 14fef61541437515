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

#include "membrane_modes.h"

#include "scene.h"

#include <gtest/gtest.h>

#include <complex>

using namespace Membrane_TEST;

namespace {

using Complex = std::complex<double>;

// A mesh of which every face has control points of its own, put together across periodic images:
// corners to the first one, the points around a corner to that corner.
struct Unfolded {
  Topology topology;
  PatchRules rules;
  std::vector<FaceGroup> groups;
  FaceModel model;
  std::vector<std::array<double, 3>> x;

  Unfolded(const TriangleMesh &mesh, Quadrature quadrature) :
      topology(topology_of(mesh)), rules(quadrature)
  {
    std::vector<int> faces(mesh.faces.size());
    for (size_t f = 0; f < faces.size(); ++f) faces[f] = static_cast<int>(f);
    groups = group_faces(topology, rules, faces);
    model.resize(count_slots(groups));
    auto place = [&](int v, const Vector3d &near) {
      const Vector3d p = near + mesh.nearest_image(mesh.points[v] - near);
      x.push_back({p[0], p[1], p[2]});
      return p;
    };
    for (FaceGroup &group : groups)
      for (int i = 0; i < group.nslots(); ++i) {
        const size_t first = x.size();
        Vector3d corner[3];
        int valence[3], column = 3;
        for (int k = 0; k < 3; ++k) {
          valence[k] = topology.valence(group.point(i, k));
          corner[k] = place(group.point(i, k), k ? corner[0] : mesh.points[group.point(i, 0)]);
        }
        for (int k = 0; k < 3; ++k)
          for (int j = 0; j < valence[k] - 3; ++j, ++column)
            place(group.point(i, column), corner[k]);
        if (column < group.rule->size) place(group.point(i, column), corner[0]);
        for (int k = 0; k < group.rule->size; ++k) group.point(i, k) = static_cast<int>(first) + k;
      }
  }
  const double (*positions() const)[3] { return reinterpret_cast<const double(*)[3]>(x.data()); }
  void move_origins(const Vector3d &by)
  {
    for (size_t i = 0; i < model.origin.size(); ++i) model.origin[i] += by[i % 3];
  }
};

// === Sheets

constexpr int NX = 12, NY = 14;

Matrix3d box(double tilt = 0.0)
{
  Matrix3d lattice;
  lattice << NX, tilt, 0.0, 0.0, NY * std::sqrt(0.75), 0.0, 0.0, 0.0, 10.0;
  return lattice;
}

// edges along the rows, and to the two neighbours in the next row
std::array<Vector3d, 3> edges(const TriangleMesh &mesh)
{
  const Vector3d a = mesh.lattice.col(0) / NX, b = mesh.lattice.col(1) / NY;
  return {a, Vector3d(b + 0.5 * a), Vector3d(b - 0.5 * a)};
}

Vector3d wave_vector(const TriangleMesh &mesh, int nx, int ny)
{
  const Matrix3d inverse = mesh.lattice.inverse();
  return 2.0 * PI * (nx * inverse.row(0) + ny * inverse.row(1)).transpose();
}

// The surface whose control points are at z = exp(i q.r) has the amplitude of its box spline, the
// product of sinc^2(q.e/2) over the three edges e
double response(const TriangleMesh &mesh, int nx, int ny)
{
  double product = 1.0;
  for (const Vector3d &e : edges(mesh)) {
    const double half = 0.5 * wave_vector(mesh, nx, ny).dot(e);
    if (std::fabs(half) > 1e-9) product *= std::sin(half) / half * std::sin(half) / half;
  }
  return product;
}

struct Waves {
  double area, height, mean_square;
  std::vector<Complex> h;    // by number; the first is not used
};

Waves waves(const TriangleMesh &mesh, int nmax, Quadrature quadrature = Quadrature::CAREFUL,
            const Vector3d &origin = Vector3d::Zero())
{
  Unfolded faces(mesh, quadrature);
  faces.move_origins(origin);
  double moments[2] = {0.0, 0.0};
  SurfacePoints points;
  points.take(faces.groups, faces.positions(), faces.model);
  sheet_moments(points, moments);
  const Matrix3d inverse = mesh.lattice.inverse();
  const SheetFrame frame = {inverse(0, 0), inverse(0, 1), inverse(1, 1), moments[1] / moments[0]};
  std::vector<double> sums(2 * (1 + count_waves(nmax)), 0.0);
  sheet_waves(points, frame, nmax, sums.data());

  Waves result = {moments[0], frame.height, sums[0] / moments[0], {}};
  for (size_t i = 0; i < sums.size(); i += 2)
    result.h.emplace_back(sums[i] / moments[0], sums[i + 1] / moments[0]);
  return result;
}

int number(int nmax, int nx, int ny)
{
  return nx * (2 * nmax + 1) + ny;
}

// z = sum of 2 Re[amplitude exp(i q.r)] of the control points
void add_wave(TriangleMesh &mesh, int nx, int ny, Complex amplitude)
{
  const Vector3d q = wave_vector(mesh, nx, ny);
  for (Vector3d &p : mesh.points)
    p[2] += 2.0 * std::real(amplitude * std::exp(Complex(0.0, q[0] * p[0] + q[1] * p[1])));
}

TEST(SheetWaves, AreNumberedByHalfThePlane)
{
  for (int nmax : {1, 2, 5}) {
    int count = 0;
    std::set<int> numbers;
    for (int nx = 0; nx <= nmax; ++nx)
      for (int ny = -nmax; ny <= nmax; ++ny)
        if (nx > 0 || ny > 0) {
          ++count;
          numbers.insert(number(nmax, nx, ny));
        }
    EXPECT_EQ(count, count_waves(nmax));
    EXPECT_EQ(static_cast<int>(numbers.size()), count);
    EXPECT_EQ(*numbers.begin(), 1);
    EXPECT_EQ(*numbers.rbegin(), count);
  }
}

TEST(SheetWaves, FindEachWaveOfTheControlPointsInTheSurfaceWithTheResponseOfTheSpline)
{
  constexpr int NMAX = 3;
  double worst = 0.0, six = 0.0;
  for (double tilt : {0.0, 1.7})
    for (int nx = 0; nx <= NMAX; ++nx)
      for (int ny = -NMAX; ny <= NMAX; ++ny) {
        if (nx == 0 && ny <= 0) continue;
        TriangleMesh mesh = sheet(NX, NY, box(tilt), 0.5);
        const Complex amplitude(0.03, -0.02);
        add_wave(mesh, nx, ny, amplitude);
        Complex expected = amplitude * response(mesh, nx, ny);
        const Waves found = waves(mesh, NMAX);
        const Waves default_rule = waves(mesh, NMAX, Quadrature::SIX);
        EXPECT_NEAR(found.area, mesh.lattice(0, 0) * mesh.lattice(1, 1), 1e-10);
        EXPECT_NEAR(found.height, 5.0, 1e-13);
        for (int i = 1; i <= count_waves(NMAX); ++i) {
          const Complex here = i == number(NMAX, nx, ny) ? expected : 0.0;
          worst = std::max(worst, std::abs(found.h[i] - here));
          six = std::max(six, std::abs(default_rule.h[i] - here) / std::abs(expected));
        }
      }
  EXPECT_LT(worst, 1e-14);
  EXPECT_LT(six, 3e-4);    // at 4 edges to a wave
  RecordProperty("worst_error_careful", scientific(worst));
  RecordProperty("worst_relative_error_six", scientific(six));
}

// with waves that are shorter than edges the mean square of the surface is their sum
TEST(SheetWaves, ObeyParseval)
{
  constexpr int NMAX = 15;
  TriangleMesh mesh = sheet(6, 6, box(), 0.5);
  Random random(5);
  for (Vector3d &p : mesh.points) p[2] += 0.1 * random.symmetric();
  const Waves found = waves(mesh, NMAX);
  double sum = 0.0;
  for (int i = 1; i <= count_waves(NMAX); ++i) sum += 2.0 * std::norm(found.h[i]);
  EXPECT_GT(found.mean_square, 1e-4);
  EXPECT_NEAR(sum / found.mean_square, 1.0, 1e-5);
}

// to the order to which splines between moved points reproduce the wave
TEST(SheetWaves, StayWhenControlPointsSlide)
{
  constexpr int NMAX = 2;
  const Complex amplitude(0.05, 0.02);
  auto made = [&](double slide) {
    TriangleMesh mesh = sheet(24, 28, box(), 0.5);
    Random random(3);
    for (Vector3d &p : mesh.points) {
      const double x = random.symmetric(), y = random.symmetric();
      p += slide * Vector3d(x, y, 0.0);
    }
    add_wave(mesh, 1, 1, amplitude);
    return interpolate(mesh);
  };
  const Waves still = waves(made(0.0), NMAX, Quadrature::SIX);
  const Waves moved = waves(made(0.05), NMAX, Quadrature::SIX);
  const int i = number(NMAX, 1, 1);
  EXPECT_NEAR(std::abs(still.h[i] - amplitude) / std::abs(amplitude), 0.0, 5e-5);
  EXPECT_NEAR(std::abs(moved.h[i] - amplitude) / std::abs(amplitude), 0.0, 5e-4);
  double others = 0.0;
  for (int j = 1; j <= count_waves(NMAX); ++j)
    if (j != i) others = std::max(others, std::abs(moved.h[j]));
  EXPECT_LT(others, 1e-3 * std::abs(amplitude));
}

TEST(SheetWaves, DoNotSeeTheSideThatFacesUp)
{
  TriangleMesh mesh = sheet(NX, NY, box(), 0.5);
  add_wave(mesh, 1, -2, Complex(0.02, 0.05));
  TriangleMesh reversed = mesh;
  for (Face &face : reversed.faces) std::swap(face[1], face[2]);
  const Waves up = waves(mesh, 2), down = waves(reversed, 2);
  EXPECT_NEAR(up.area, -down.area, 1e-11);
  EXPECT_NEAR(up.height, down.height, 1e-13);
  for (int i = 1; i <= count_waves(2); ++i) EXPECT_LT(std::abs(up.h[i] - down.h[i]), 1e-14);
}

TEST(SheetWaves, TurnTheirPhaseWhenTheSheetIsMoved)
{
  TriangleMesh mesh = sheet(NX, NY, box(), 0.5);
  add_wave(mesh, 2, 1, Complex(0.02, 0.05));
  const Vector3d by(0.37, -0.21, 0.8), q = wave_vector(mesh, 2, 1);
  const Waves before = waves(mesh, 2), after = waves(mesh, 2, Quadrature::CAREFUL, by);
  const int i = number(2, 2, 1);
  EXPECT_LT(std::abs(after.h[i] - before.h[i] * std::exp(Complex(0.0, q.dot(by)))), 1e-14);
  EXPECT_NEAR(after.height, before.height - by[2], 1e-13);
}

// === Spheres

double harmonic(int l, int m, const Vector3d &n)
{
  const double theta = std::acos(n[2] / n.norm()), phi = std::atan2(n[1], n[0]);
  const int k = std::abs(m);
  const double angle = m > 0 ? std::cos(k * phi) : m < 0 ? std::sin(k * phi) : std::sqrt(0.5);
  return std::sqrt(2.0) * std::sph_legendre(l, k, theta) * angle * (k % 2 ? -1.0 : 1.0);
}

struct Harmonics {
  double volume, solid_angle;
  Vector3d centroid;
  std::vector<double> u;    // of r/radius - 1, by number
};

Harmonics harmonics(const TriangleMesh &mesh, int lmax, double radius,
                    Quadrature quadrature = Quadrature::SIX,
                    const Vector3d &origin = Vector3d::Zero())
{
  Unfolded faces(mesh, quadrature);
  faces.move_origins(origin);
  double moments[4] = {0.0, 0.0, 0.0, 0.0};
  std::vector<double> sums(count_harmonics(lmax) + 1, 0.0);
  SurfacePoints points;
  points.take(faces.groups, faces.positions(), faces.model);
  sphere_moments(points, moments);
  sphere_harmonics(points, {0.0, 0.0, 0.0}, radius, lmax, sums.data());
  Harmonics result;
  result.volume = moments[0];
  result.centroid = Vector3d(moments[1], moments[2], moments[3]) / moments[0];
  result.solid_angle = sums.back();
  sums.pop_back();
  result.u = sums;
  return result;
}

// limit positions of the vertices on r = R (1 + u Y_lm)
TriangleMesh with_harmonic(int level, double radius, int l, int m, double u)
{
  TriangleMesh mesh = icosphere(level, radius);
  for (Vector3d &p : mesh.points) p *= 1.0 + u * harmonic(l, m, p);
  return interpolate(mesh);
}

TEST(SphereHarmonics, FindTheHarmonicThatWasPutIn)
{
  constexpr int LMAX = 5;
  constexpr double RADIUS = 1.3, U = 0.01;
  const Harmonics round = harmonics(icosphere(3, RADIUS), LMAX, RADIUS);
  const Harmonics blank = harmonics(interpolate(icosphere(3, RADIUS)), LMAX, RADIUS);
  double own = 0.0, other = 0.0;
  for (int l = 1; l <= LMAX; ++l)
    for (int m = -l; m <= l; ++m) {
      const Harmonics found = harmonics(with_harmonic(3, RADIUS, l, m, U), LMAX, RADIUS);
      for (int i = 1; i < count_harmonics(LMAX); ++i) {
        const double difference = (found.u[i] - blank.u[i]) / U;
        if (i == l * l + l + m)
          own = std::max(own, std::fabs(difference - 1.0));
        else
          other = std::max(other, std::fabs(difference));
      }
    }
  EXPECT_LT(own, 1e-3);
  EXPECT_LT(other, 1e-3);
  EXPECT_NEAR(round.solid_angle / (4.0 * PI), 1.0, 1e-6);
  RecordProperty("worst_error", scientific(own));
  RecordProperty("worst_leak", scientific(other));
}

// by the addition theorem the power of each l is the same in every orientation, exactly, for any
// quadrature: true of orthonormal harmonics only
TEST(SphereHarmonics, HaveAPowerThatRotationsLeaveAlone)
{
  constexpr int LMAX = 20;
  TriangleMesh mesh = perturbed(icosphere(1, 1.0), 0.1, 17);
  const Harmonics before = harmonics(mesh, LMAX, 0.9);
  const Matrix3d rotation = (Eigen::AngleAxisd(0.7, Vector3d(1.0, 2.0, -0.5).normalized()) *
                             Eigen::AngleAxisd(2.1, Vector3d(-1.0, 0.3, 0.8).normalized()))
                                .toRotationMatrix();
  for (Vector3d &p : mesh.points) p = rotation * p;
  const Harmonics after = harmonics(mesh, LMAX, 0.9);
  double worst = 0.0;
  for (int l = 0; l <= LMAX; ++l) {
    double powers[2] = {0.0, 0.0};
    for (int i = l * l; i < (l + 1) * (l + 1); ++i) {
      powers[0] += before.u[i] * before.u[i];
      powers[1] += after.u[i] * after.u[i];
    }
    worst = std::max(worst, std::fabs(powers[1] / powers[0] - 1.0));
  }
  EXPECT_LT(worst, 1e-11);
  EXPECT_LT((rotation * before.centroid - after.centroid).norm(), 1e-14);
  RecordProperty("worst_error", scientific(worst));
}

TEST(SphereHarmonics, MomentsGiveVolumeAndCentroidFromAnyOrigin)
{
  const Vector3d centre(0.3, -0.2, 0.1);
  TriangleMesh mesh = interpolate(icosphere(3, 1.3));
  for (Vector3d &p : mesh.points) p += centre;
  for (const Vector3d &origin : {Vector3d(0.0, 0.0, 0.0), Vector3d(0.5, 0.1, -0.3)}) {
    const Harmonics found = harmonics(mesh, 1, 1.3, Quadrature::SIX, origin);
    EXPECT_NEAR(found.volume / (4.0 / 3.0 * PI * 1.3 * 1.3 * 1.3), 1.0, 1e-4);
    EXPECT_LT((found.centroid + origin - centre).norm(), 1e-6);
    EXPECT_NEAR(found.solid_angle / (4.0 * PI), 1.0, 1e-4);
  }
}

// a shifted sphere is, to first order, its three harmonics of l = 1
TEST(SphereHarmonics, SeeAShiftAsTheFirstOnes)
{
  const TriangleMesh mesh = interpolate(icosphere(3, 1.0));
  const Vector3d shift(1e-4, -2e-4, 3e-4);
  const Harmonics still = harmonics(mesh, 1, 1.0);
  const Harmonics found = harmonics(mesh, 1, 1.0, Quadrature::SIX, -shift);
  const double unit = std::sqrt(4.0 * PI / 3.0);
  EXPECT_NEAR(found.u[1] - still.u[1], unit * shift[1], 1e-6);
  EXPECT_NEAR(found.u[2] - still.u[2], unit * shift[2], 1e-6);
  EXPECT_NEAR(found.u[3] - still.u[3], unit * shift[0], 1e-6);
}

TEST(SphereHarmonics, AreMeasuredFromTheMiddleThatIsGiven)
{
  const TriangleMesh mesh = perturbed(icosphere(2, 1.0), 0.05, 3);
  const Vector3d shift(0.05, -0.02, 0.03);
  const Harmonics found = harmonics(mesh, 3, 1.0, Quadrature::SIX, shift);
  Unfolded faces(mesh, Quadrature::SIX);
  SurfacePoints points;
  points.take(faces.groups, faces.positions(), faces.model);
  std::vector<double> sums(count_harmonics(3) + 1, 0.0);
  sphere_harmonics(points, {shift[0], shift[1], shift[2]}, 1.0, 3, sums.data());
  for (size_t i = 0; i < found.u.size(); ++i) EXPECT_NEAR(sums[i], found.u[i], 1e-13);
}

}    // namespace
