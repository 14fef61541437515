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

#include "membrane_mode_space.h"

#include "membrane_limit_mask.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace Membrane_NS;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

static constexpr double PI = 3.14159265358979323846;

// nothing is a sphere whose distance from the middle varies by more than this part of the radius
static constexpr double MOST_RADIAL = 0.5;

// a fit has converged, or does not
static constexpr double SMALLEST_SHIFT = 1.0e-14;
static constexpr int MOST_FITS = 100;

namespace {

/// All vertices of a component on one rank.
struct WholeComponent : VertexPart {
  WholeComponent(const Topology &topology, int component)
  {
    for (int v = 0; v < topology.num_vertices(); ++v)
      if (topology.component(v) == component) vertices.push_back(v);
    owned = static_cast<int>(vertices.size());
    order(topology);
  }
};

/// Limit positions of the control points of a component, in its order.
std::vector<Vector3d> limit_positions(const Topology &topology, const LimitMask &mask,
                                      const WholeComponent &part, const TriangleMesh &mesh)
{
  std::vector<Vector3d> r(part.owned);
  for (int i = 0; i < part.owned; ++i) {
    const int v = part.vertices[i];
    Vector3d sum = Vector3d::Zero();
    for (int w : topology.ring(v)) sum += mesh.edge(v, w);
    r[i] = mesh.points[v] + mask.spoke(i) * sum;
  }
  return r;
}

/// Columns of functions at limit positions to those at control points, three at a time.
void to_control_points(LimitMask &mask, MatrixXd &functions)
{
  const Eigen::Index n = functions.rows();
  VertexField b(n), x(n);
  for (Eigen::Index first = 0; first < functions.cols(); first += 3) {
    const Eigen::Index count = std::min<Eigen::Index>(3, functions.cols() - first);
    for (Eigen::Index i = 0; i < n; ++i) {
      b[i] = Vector4{};
      for (Eigen::Index k = 0; k < count; ++k) b[i].c[k] = functions(i, first + k);
    }
    mask.solve(b, x);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index k = 0; k < count; ++k) functions(i, first + k) = x[i].c[k];
  }
}

void store_functions(const MatrixXd &functions, MembraneModes &to)
{
  const auto n = static_cast<int>(functions.rows()), count = static_cast<int>(functions.cols());
  const int blocks = (count + LANES - 1) / LANES;
  to.functions = blocks * LANES;
  to.psi.assign((size_t) n * blocks, Lane{});
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < count; ++j) to.psi[(size_t) i * blocks + j / LANES][j % LANES] = functions(i, j);
}

/// Mean edge of a mesh of equilateral triangles of this area.
double mean_edge(double area, int vertices)
{
  return std::sqrt(2.0 * area / (std::sqrt(3.0) * vertices));
}

/// Nodes and weights of Gauss and Legendre on (-1, 1).
void legendre_nodes(int n, std::vector<double> &node, std::vector<double> &weight)
{
  node.resize(n);
  weight.resize(n);
  for (int i = 0; i < n; ++i) {
    double z = std::cos(PI * (i + 0.75) / (n + 0.5)), slope = 1.0;
    for (int pass = 0; pass < 100; ++pass) {
      double p = 1.0, before = 0.0;
      for (int l = 1; l <= n; ++l) {
        const double next = ((2 * l - 1) * z * p - (l - 1) * before) / l;
        before = p;
        p = next;
      }
      slope = n * (z * p - before) / (z * z - 1.0);
      const double step = p / slope;
      z -= step;
      if (std::fabs(step) < 1.0e-15) break;
    }
    node[i] = z;
    weight[i] = 2.0 / ((1.0 - z * z) * slope * slope);
  }
}

/* ----------------------------------------------------------------------
   n_c Y_k = sum_j C^c_jk Y_j with j one degree above or below k: the components of a radial field are
   harmonics again. By a quadrature that is exact for products of three of them.
------------------------------------------------------------------------- */

Eigen::SparseMatrix<double> radial_coupling(const std::vector<ModeChoice::Mode> &modes, int functions)
{
  int highest = 0;
  for (const auto &mode : modes) highest = std::max(highest, mode.first);
  const int above = highest + 1, nall = (above + 1) * (above + 1);
  const auto nmodes = static_cast<int>(modes.size());
  std::vector<double> node, weight;
  legendre_nodes(highest + 2, node, weight);
  const int nphi = 2 * highest + 4;

  std::vector<MatrixXd> sums(3, MatrixXd::Zero(nall, nmodes));
  std::vector<double> y(nall);
  MatrixXd here(nphi, nall), chosen(nphi, nmodes), weighted(nphi, nmodes);
  MatrixXd n(nphi, 3);
  for (size_t t = 0; t < node.size(); ++t) {
    const double across = std::sqrt(1.0 - node[t] * node[t]);
    for (int f = 0; f < nphi; ++f) {
      const double phi = 2.0 * PI * f / nphi;
      n.row(f) << across * std::cos(phi), across * std::sin(phi), node[t];
      harmonics_at(n.row(f), above, y.data());
      here.row(f) = Eigen::Map<Eigen::RowVectorXd>(y.data(), nall);
      for (int k = 0; k < nmodes; ++k) {
        const int l = modes[k].first;
        chosen(f, k) = y[l * l + l + modes[k].second];
      }
    }
    for (int c = 0; c < 3; ++c) {
      weighted = (2.0 * PI / nphi * weight[t]) * n.col(c).asDiagonal() * chosen;
      sums[c].noalias() += here.transpose() * weighted;
    }
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (int c = 0; c < 3; ++c)
    for (int k = 0; k < nmodes; ++k)
      for (int l : {modes[k].first - 1, modes[k].first + 1}) {
        if (l < 0) continue;
        for (int m = -l; m <= l; ++m) {
          const int j = l * l + l + m;
          if (std::fabs(sums[c](j, k)) > 1.0e-13) entries.emplace_back(c * functions + j, k, sums[c](j, k));
        }
      }
  Eigen::SparseMatrix<double> couple(3 * functions, nmodes);
  couple.setFromTriplets(entries.begin(), entries.end());
  return couple;
}

/// Wave vectors 2 pi (nx a* + ny b*) of the box.
Eigen::Vector2d wave_vector(const TriangleMesh &mesh, const ModeChoice::Mode &mode)
{
  const Eigen::Matrix2d inverse = mesh.lattice.topLeftCorner<2, 2>().inverse();
  return 2.0 * PI * (mode.first * inverse.row(0) + mode.second * inverse.row(1)).transpose();
}

double wave_at(const TriangleMesh &mesh, const ModeChoice::Mode &mode, const Vector3d &r)
{
  const double phase = wave_vector(mesh, mode).dot(r.head<2>());
  return mode.sine ? std::sin(phase) : std::cos(phase);
}

double projected_area(const TriangleMesh &mesh)
{
  return std::fabs(mesh.lattice.topLeftCorner<2, 2>().determinant());
}

}    // namespace

/* ---------------------------------------------------------------------- */

std::vector<ModeChoice::Mode> ModeChoice::list() const
{
  std::vector<Mode> modes;
  if (shape == Shape::SPHERE) {
    for (int l = lowest; l <= highest; ++l)
      for (int m = -l; l != 1 && m <= l; ++m) modes.push_back({l, m, false});
  } else if (shape == Shape::PLANE) {
    auto add = [&](int n1, int n2) {
      modes.push_back({n1, n2, false});
      modes.push_back({n1, n2, true});
    };
    if (one) add(nx, ny);
    for (int n1 = 0; !one && n1 <= highest; ++n1)
      for (int n2 = n1 == 0 ? 1 : -highest; n2 <= highest; ++n2)
        if (std::max(n1, std::abs(n2)) >= lowest) add(n1, n2);
  }
  return modes;
}

int ModeSpace::count() const
{
  int sum = 0;
  for (const auto &membrane : membranes) sum += static_cast<int>(membrane.modes.size());
  return sum;
}

int ModeSpace::num_vertices() const
{
  int sum = 0;
  for (const auto &membrane : membranes) sum += static_cast<int>(membrane.vertices.size());
  return sum;
}

double ModeSpace::memory_usage() const
{
  double bytes = sizeof(Vector3d) * reference.capacity();
  for (const auto &membrane : membranes)
    bytes += sizeof(Lane) * membrane.psi.capacity() + sizeof(int) * membrane.vertices.capacity() +
        (sizeof(double) + sizeof(int)) * membrane.couple.nonZeros();
  return bytes;
}

/* ----------------------------------------------------------------------
   the recurrences of sphere_harmonics()
------------------------------------------------------------------------- */

void Membrane_NS::harmonics_at(const Vector3d &n, int lmax, double *values)
{
  double diagonal = 1.0 / std::sqrt(4.0 * PI), re = 1.0, im = 0.0;
  for (int m = 0; m <= lmax; ++m) {
    if (m > 0) {
      diagonal *= std::sqrt((2.0 * m + 1.0) / (2.0 * m));
      const double turned = re * n.x() - im * n.y();
      im = re * n.y() + im * n.x();
      re = turned;
    }
    const double norm = m > 0 ? std::sqrt(2.0) : 1.0;
    double q = diagonal, before = 0.0, back = 0.0;
    for (int l = m; l <= lmax; ++l) {
      if (l > m) {
        const double a = std::sqrt((4.0 * l * l - 1.0) / ((double) l * l - (double) m * m));
        const double next = a * (n.z() * q - back * before);
        before = q;
        q = next;
        back = 1.0 / a;
      }
      values[l * l + l + m] = norm * q * re;
      if (m > 0) values[l * l + l - m] = norm * q * im;
    }
  }
}

/* ----------------------------------------------------------------------
   Reference: least squares for the modes together with the mean and, on a sphere, l = 1, so that a shape which is a
   reference and its modes has that reference again, to rounding
------------------------------------------------------------------------- */

ReferenceFrame Membrane_NS::find_reference(const Topology &topology, int component, const TriangleMesh &shape,
                                           const ModeChoice &choice, TriangleMesh &reference)
{
  const WholeComponent part(topology, component);
  for (int v : part.vertices) reference.points[v] = shape.points[v];
  if (choice.shape == ModeChoice::Shape::FILE) return {Vector3d::Zero(), 0.0};

  WholeComponent own(topology, component);
  LimitMask mask(topology, own, {true, 1.0e-14});
  const auto r = limit_positions(topology, mask, part, shape);
  const int n = part.owned;
  const auto modes = choice.list();
  const auto nmodes = static_cast<int>(modes.size());

  if (choice.shape == ModeChoice::Shape::PLANE) {
    MatrixXd basis(n, nmodes + 1);
    VectorXd height(n);
    for (int i = 0; i < n; ++i) {
      height[i] = r[i].z();
      basis(i, 0) = 1.0;
      for (int k = 0; k < nmodes; ++k) basis(i, k + 1) = wave_at(shape, modes[k], r[i]);
    }
    const double z = (basis.transpose() * basis).ldlt().solve(basis.transpose() * height)[0];
    for (int v : part.vertices) reference.points[v].z() = z;
    const double area = projected_area(shape);
    return {Vector3d(0.0, 0.0, z), std::sqrt(area)};
  }

  ReferenceFrame frame = {Vector3d::Zero(), 0.0};
  for (const auto &at : r) frame.middle += at / n;
  for (const auto &at : r) frame.radius += (at - frame.middle).norm() / n;
  const int highest = std::max(1, choice.highest), nall = (highest + 1) * (highest + 1);
  std::vector<double> y(nall);
  MatrixXd basis(n, 4 + nmodes);
  VectorXd distance(n);
  const double dipole = std::sqrt(3.0 / (4.0 * PI)), monopole = 1.0 / std::sqrt(4.0 * PI);
  for (int pass = 0; pass < MOST_FITS; ++pass) {
    double furthest = 0.0;
    for (int i = 0; i < n; ++i) {
      const Vector3d arm = r[i] - frame.middle;
      distance[i] = arm.norm() - frame.radius;
      furthest = std::max(furthest, std::fabs(distance[i]) / frame.radius);
      harmonics_at(arm.normalized(), highest, y.data());
      for (int k = 0; k < 4; ++k) basis(i, k) = y[k];
      for (int k = 0; k < nmodes; ++k)
        basis(i, 4 + k) = modes[k].first == 0 ? 0.0 : y[modes[k].first * (modes[k].first + 1) + modes[k].second];
    }
    if (!(furthest < MOST_RADIAL))
      throw ModeError("is far from a sphere: the distance from its middle differs from the mean by " +
                      std::to_string(static_cast<int>(100.0 * furthest)) + " %");
    MatrixXd normal = basis.transpose() * basis;
    for (int k = 0; k < nmodes; ++k)
      if (modes[k].first == 0) normal(4 + k, 4 + k) = 1.0;
    const VectorXd a = normal.ldlt().solve(basis.transpose() * distance);
    const Vector3d shift = dipole * Vector3d(a[3], a[1], a[2]);
    frame.middle += shift;
    frame.radius += monopole * a[0];
    if (shift.norm() + std::fabs(a[0]) < SMALLEST_SHIFT * frame.radius) break;
  }

  MatrixXd directions(n, 3);
  for (int i = 0; i < n; ++i) directions.row(i) = (r[i] - frame.middle).normalized();
  to_control_points(mask, directions);
  for (int i = 0; i < n; ++i)
    reference.points[part.vertices[i]] = frame.middle + frame.radius * directions.row(i).transpose();
  return frame;
}

/* ---------------------------------------------------------------------- */

MembraneModes Membrane_NS::make_modes(const Topology &topology, int component, const TriangleMesh &reference,
                                      const ReferenceFrame &frame, const ModeChoice &choice)
{
  WholeComponent part(topology, component);
  LimitMask mask(topology, part, {true, 1.0e-14});
  const auto r = limit_positions(topology, mask, part, reference);
  const int n = part.owned;

  MembraneModes result;
  result.component = component;
  result.length = choice.shape == ModeChoice::Shape::SPHERE ? frame.radius : 1.0;
  result.norm = choice.shape == ModeChoice::Shape::SPHERE ? frame.radius * frame.radius : 0.5 * projected_area(reference);
  result.vertices = part.vertices;
  result.modes = choice.list();
  const auto nmodes = static_cast<int>(result.modes.size());

  // two edges are a wave's length at least; on a sphere that of degree l is 2 pi R/l

  const double radius = frame.radius;
  const bool sphere = choice.shape == ModeChoice::Shape::SPHERE;
  const double shortest = 2.0 * mean_edge(sphere ? 4.0 * PI * radius * radius : projected_area(reference), n);
  for (const auto &mode : result.modes) {
    const double q = sphere ? mode.first / radius : wave_vector(reference, mode).norm();
    result.wave_number.push_back(sphere ? mode.first : q);
    if (!(q * shortest > 2.0 * PI * (1.0 + 1.0e-9))) continue;
    if (sphere)
      throw ModeError("has modes up to l = " + std::to_string(static_cast<int>(2.0 * PI * radius / shortest)) +
                      ", two edges to a wave: refine the mesh, or choose a lower max");
    throw ModeError("has waves as long as two edges or more, " + std::to_string(shortest) + ", and that of (" +
                    std::to_string(mode.first) + ", " + std::to_string(mode.second) + ") measures " +
                    std::to_string(2.0 * PI / q) + ": refine the mesh, or choose lower numbers");
  }

  if (!sphere) {
    MatrixXd waves(n, nmodes);
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < nmodes; ++k) waves(i, k) = wave_at(reference, result.modes[k], r[i]);
    to_control_points(mask, waves);
    store_functions(waves, result);
    result.couple.resize(3 * result.functions, nmodes);
    for (int k = 0; k < nmodes; ++k) result.couple.insert(2 * result.functions + k, k) = 1.0;
    result.couple.makeCompressed();
    return result;
  }

  const int above = choice.highest + 1, nall = (above + 1) * (above + 1);
  MatrixXd harmonics(n, nall);
  std::vector<double> y(nall);
  for (int i = 0; i < n; ++i) {
    harmonics_at((r[i] - frame.middle).normalized(), above, y.data());
    harmonics.row(i) = Eigen::Map<Eigen::RowVectorXd>(y.data(), nall);
  }
  to_control_points(mask, harmonics);
  store_functions(harmonics, result);
  result.couple = radial_coupling(result.modes, result.functions);
  return result;
}

MembraneModes Membrane_NS::make_modes(const Topology &topology, int component,
                                      const std::vector<std::vector<Vector3d>> &displacements)
{
  const WholeComponent part(topology, component);
  const auto nmodes = static_cast<int>(displacements.size());
  MembraneModes result;
  result.component = component;
  result.length = 1.0;
  result.norm = 0.0;
  result.vertices = part.vertices;
  MatrixXd functions(part.owned, 3 * nmodes);
  for (int k = 0; k < nmodes; ++k) {
    result.modes.push_back({k + 1, 0, false});
    result.wave_number.push_back(0.0);
    for (int i = 0; i < part.owned; ++i)
      functions.block<1, 3>(i, 3 * k) = displacements[k][part.vertices[i]];
  }
  store_functions(functions, result);
  result.couple.resize(3 * result.functions, nmodes);
  for (int k = 0; k < nmodes; ++k)
    for (int c = 0; c < 3; ++c) result.couple.insert(c * result.functions + 3 * k + c, k) = 1.0;
  result.couple.makeCompressed();
  return result;
}
