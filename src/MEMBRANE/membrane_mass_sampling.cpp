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

#include "membrane_mass_sampling.h"

#include "membrane_cotangent.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

using namespace Membrane_NS;
using Eigen::Map;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

// B = kc (K D^-1 K + s a K + t a^2 D), a = 4 pi/area: exact for a sphere but for t, which keeps it
// positive, and for a plane. Tension may make s as small as LEAST

struct Undulations {
  double s, t;
};
static constexpr Undulations CLOSED = {-2.0, 1.5}, CONTINUING = {0.0, 0.25};
static constexpr double LEAST[] = {-2.2, -0.8};    // > -2 sqrt(t)

// (3/4) kT ln A of a face is a tension as long as points do not move along the surface; of kT over its area
static constexpr double MEASURE_TENSION = 0.75;

// T = FACTOR sum over faces of shear (K_f/A_f + FLOOR a D_f/A_f): see the derivation

static constexpr double SHEAR_FACTOR = 2.0, SHEAR_FLOOR = 1.0;

// nothing resists the translation of a component, and where it is nobody asks: slower than its shape
static constexpr double TRANSLATION = 25.0;

/* ---------------------------------------------------------------------- */

SamplingMass::SamplingMass(const VertexMasses &vertices, const Settings &settings) :
    MassOperator(vertices.part), settings_(settings), labels_(vertices.labels)
{
  const Topology &topology = vertices.topology;
  all_.assign(topology.num_vertices(), Vector4{});
  along_.assign(topology.num_vertices(), 0.0);
  noise_ = all_;
  noise_along_ = along_;
  build_factors(topology, vertices.masses);
  build_totals(topology);
}

static SparseMatrix diagonal(const VectorXd &d)
{
  SparseMatrix matrix(d.size(), d.size());
  matrix.reserve(Eigen::VectorXi::Ones(d.size()));
  for (int i = 0; i < d.size(); ++i) matrix.insert(i, i) = d[i];
  return matrix;
}

void SamplingMass::build_factors(const Topology &topology, const std::vector<double> &masses)
{
  const StiffnessReference &reference = *settings_.reference->now;
  const int n = topology.num_vertices();
  const FlatAreas areas(reference.shape, topology);
  normals_ = areas.normals;
  for (Vector3d &normal : normals_)
    if (normal.isZero()) normal = Vector3d::UnitZ();    // folded flat: any does

  // undulations

  VectorXd kc = Map<const VectorXd>(reference.kc.data(), n), mean(n), floor(n);
  for (int v = 0; v < n; ++v) {
    const int c = topology.component(v);
    const Undulations &law = reference.closed[c] ? CLOSED : CONTINUING;
    const double a = 4.0 * M_PI / areas.components[c];
    if (masses[v] == 0.0)
      kc[v] = 1.0;    // of no rank's part
    else if (!(kc[v] > 0.0))
      throw MeshError("mass sampling needs a bending modulus, not 0, in pair_coeff");
    mean[v] = 0.5 * law.s * a * kc[v];    // of the two ends of an edge
    floor[v] = law.t * a * a * kc[v] * areas.vertices[v];
  }
  std::vector<double> tension(topology.num_faces());
  for (int f = 0; f < topology.num_faces(); ++f) {
    const Face &face = topology.face(f);
    const int c = topology.component(face[0]), open = reference.closed[c] ? 0 : 1;
    const double unit =
        4.0 * M_PI / areas.components[c] * (kc[face[0]] + kc[face[1]] + kc[face[2]]) / 3.0;
    const double felt = reference.tension[f] + MEASURE_TENSION * reference.measure / areas.faces[f];
    tension[f] =
        std::max(felt, (LEAST[open] - (open ? CONTINUING : CLOSED).s) * unit);
  }
  const SparseMatrix k = cotangent_laplacian(reference.shape, topology,
                                             std::vector<double>(topology.num_faces(), 1.0));
  undulation_ = k * diagonal(kc.cwiseQuotient(areas.vertices)) * k;
  undulation_ += SparseMatrix(k * diagonal(mean)) + SparseMatrix(diagonal(mean) * k);
  undulation_ += cotangent_laplacian(reference.shape, topology, tension) + diagonal(floor);

  // along the surface

  std::vector<double> shear(topology.num_faces());
  VectorXd rest = VectorXd::Zero(n);
  for (int f = 0; f < topology.num_faces(); ++f) {
    shear[f] = SHEAR_FACTOR * reference.shear[f] / areas.faces[f] + reference.stretch[f];
    if (masses[topology.face(f)[0]] == 0.0)
      shear[f] = 1.0;
    else if (!(shear[f] > 0.0))
      throw MeshError("mass sampling needs regularize in pair_coeff: half of kc is a good value");
    const double a = 4.0 * M_PI / areas.components[topology.component(topology.face(f)[0])];
    for (int v : topology.face(f)) rest[v] += SHEAR_FLOOR * a * shear[f] * areas.faces[f] / 3.0;
  }
  sliding_ = cotangent_laplacian(reference.shape, topology, shear) + diagonal(rest);

  undulation_ *= settings_.unit;
  sliding_ *= settings_.unit;
  normal_factor_ = std::make_unique<SparseCholesky>(undulation_);
  tangent_factor_ = std::make_unique<SparseCholesky>(sliding_);
  SparseMatrix blocked = sliding_;
  for (int v = 0; v < n; ++v)
    for (SparseMatrix::InnerIterator at(blocked, v); at; ++at)
      at.valueRef() *= normals_[v].dot(normals_[at.row()]);
  blocked_factor_ = std::make_unique<SparseCholesky>(blocked);
  find_turning(topology, areas.components);
}

// closed components. They translate with the stiffness of a wave as long as they are

void SamplingMass::find_turning(const Topology &topology, const std::vector<double> &areas)
{
  const StiffnessReference &reference = *settings_.reference->now;
  arms_.assign(topology.num_vertices(), Vector3d::Zero());
  turning_of_.assign(topology.num_vertices(), -1);
  for (int c = 0; c < topology.num_components(); ++c) {
    if (!reference.closed[c]) continue;
    Turning turning;
    Vector3d middle = Vector3d::Zero();
    double kc = 0.0;
    for (int v = 0; v < topology.num_vertices(); ++v) {
      if (topology.component(v) != c) continue;
      turning.vertices.push_back(v);
      middle += reference.shape.points[v];
      kc += reference.kc[v];
    }
    const double n = turning.vertices.size();
    for (int v : turning.vertices) {
      arms_[v] = reference.shape.points[v] - middle / n;
      turning_of_[v] = static_cast<int>(turning_.size());
    }
    Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
    for (int v : turning.vertices) square += normals_[v] * normals_[v].transpose();
    turning.inverse_square = square.inverse();
    const double a = 4.0 * M_PI / areas[c];
    turning.mobility = 1.0 / (settings_.unit * TRANSLATION * 4.0 * M_PI * a * kc / n);
    turning_.push_back(std::move(turning));
  }
}

/* ----------------------------------------------------------------------
   M^-1 = M0^-1 - Y W Y^T with Y = M0^-1 U and W = (S + k^-1)^-1, S = U^T Y: Woodbury's formula for
   M0 + U k U^T, where k is infinite for motions that there are not to be. Noise is v - Y C U^T v, with
   C + C^T - C S C^T = W
------------------------------------------------------------------------- */

void SamplingMass::build_totals(const Topology &topology)
{
  const int n = topology.num_vertices();
  const auto &totals = settings_.reference->now->totals;
  const int rank = static_cast<int>(totals.size() + 6 * turning_.size());
  u_ = MatrixXd::Zero(3 * n, rank);
  VectorXd softness = VectorXd::Zero(rank);
  int j = 0;
  for (const auto &total : totals) {
    for (int v = 0; v < n; ++v) u_.col(j).segment<3>(3 * v) = total.gradient[v];
    softness[j++] = 1.0 / (settings_.unit * total.stiffness);
  }
  for (const Turning &turning : turning_)
    for (int k = 0; k < 3; ++k, j += 2)
      for (int v : turning.vertices) {
        u_.col(j).segment<3>(3 * v) = Vector3d::Unit(k).cross(arms_[v]);
        u_.col(j + 1).segment<3>(3 * v) = normals_[v][k] * normals_[v];
      }
  if (rank == 0) return;
  u_.colwise().normalize();
  for (size_t i = 0; i < totals.size(); ++i) {
    double square = 0.0;
    for (const Vector3d &g : totals[i].gradient) square += g.squaredNorm();
    softness[i] /= square;
  }
  stiffness_ = softness.head(totals.size()).cwiseInverse();

  y_.resize(3 * n, rank);
  for (j = 0; j < rank; ++j) {
    for (int v = 0; v < n; ++v) {
      all_[v] = Vector4{};
      Map<Vector3d>(all_[v].c) = u_.col(j).segment<3>(3 * v);
    }
    solve_base(all_);
    for (int v = 0; v < n; ++v) y_.col(j).segment<3>(3 * v) = Map<Vector3d>(all_[v].c);
  }
  const MatrixXd s = u_.transpose() * y_;
  w_ = (s + MatrixXd(softness.asDiagonal())).inverse();
  const MatrixXd f = s.llt().matrixL();
  const MatrixXd hat = f.transpose() * w_ * f, one = MatrixXd::Identity(rank, rank);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(one - 0.5 * (hat + hat.transpose()));
  const MatrixXd root = eigen.eigenvectors() *
      eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() * eigen.eigenvectors().transpose();
  const MatrixXd inverse = f.inverse();
  c_ = inverse.transpose() * (one - root) * inverse;
}

/* ---------------------------------------------------------------------- */

// along normals, and what is left along the surface

void SamplingMass::split(VertexField &x, std::vector<double> &along) const
{
  for (size_t v = 0; v < x.size(); ++v) {
    Map<Vector3d> f(x[v].c);
    along[v] = normals_[v].dot(f);
    f -= along[v] * normals_[v];
    x[v].c[3] = 0.0;
  }
}

void SamplingMass::join(const std::vector<double> &along, VertexField &x) const
{
  for (size_t v = 0; v < x.size(); ++v) {
    Map<Vector3d> f(x[v].c);
    f += (along[v] - normals_[v].dot(f)) * normals_[v];
  }
}

// x = (N B^-1 N^T + (1 - N N^T) T^-1 (1 - N N^T)) x

void SamplingMass::solve_base(VertexField &x)
{
  split(x, along_);
  normal_factor_->solve(along_);
  tangent_factor_->solve(x);
  join(along_, x);
}

static VectorXd products(const MatrixXd &columns, const VertexField &x)
{
  VectorXd result(columns.cols());
  for (int j = 0; j < columns.cols(); ++j) {
    double sum = 0.0;
    for (size_t v = 0; v < x.size(); ++v)
      for (int i = 0; i < 3; ++i) sum += columns(3 * v + i, j) * x[v].c[i];
    result[j] = sum;
  }
  return result;
}

static void subtract(const MatrixXd &columns, const VectorXd &q, VertexField &x)
{
  for (int j = 0; j < columns.cols(); ++j)
    for (size_t v = 0; v < x.size(); ++v)
      for (int i = 0; i < 3; ++i) x[v].c[i] -= columns(3 * v + i, j) * q[j];
}

// what totals and translations add to the solution of the base, from momenta

SamplingMass::Rest SamplingMass::rest_of(const VertexField &p) const
{
  Rest rest;
  rest.speed.assign(turning_.size(), Vector3d::Zero());
  for (size_t t = 0; t < turning_.size(); ++t) {
    for (int v : turning_[t].vertices) rest.speed[t] += Map<const Vector3d>(p[v].c);
    rest.speed[t] *= turning_[t].mobility;
  }
  if (w_.size()) rest.totals = w_ * products(y_, p);
  return rest;
}

// the same from the noise of the base

SamplingMass::Rest SamplingMass::rest_of_noise(double root, const CounterRandom &random, const VertexField &noise) const
{
  Rest rest;
  for (const Turning &turning : turning_) {
    const auto normal = random.normals(labels_[turning.vertices[0]], 1);
    rest.speed.push_back(root * std::sqrt(turning.mobility) * Vector3d(normal[0], normal[1], normal[2]));
  }
  if (c_.size()) rest.totals = c_ * products(u_, noise);
  return rest;
}

void SamplingMass::add(const Rest &rest, VertexField &v) const
{
  if (rest.totals.size()) subtract(y_, rest.totals, v);
  for (size_t t = 0; t < turning_.size(); ++t)
    for (int i : turning_[t].vertices) Map<Vector3d>(v[i].c) += rest.speed[t];
}

void SamplingMass::scatter(const VertexField &all, VertexField &x) const
{
  for (int i = 0; i < part_.owned; ++i) x[i] = all[part_.vertices[i]];
}

void SamplingMass::solve(const VertexField &p, VertexField &v)
{
  part_.gather(p, all_);
  const Rest rest = rest_of(all_);
  solve_base(all_);
  add(rest, all_);
  scatter(all_, v);
  passes_ = 1;
}

/* ---------------------------------------------------------------------- */

void SamplingMass::draw(double root, const CounterRandom &random, VertexField &noise, std::vector<double> &along) const
{
  random.normals(labels_, noise);
  for (size_t i = 0; i < noise.size(); ++i) {
    quad(noise[i]) *= root;
    along[i] = noise[i].c[3];
    noise[i].c[3] = 0.0;
  }
}

void SamplingMass::sample(double kT, uint64_t seed, uint64_t step, VertexField &v)
{
  const CounterRandom random(seed, step);
  const double root = std::sqrt(kT);
  draw(root, random, all_, along_);
  normal_factor_->colour(along_);
  tangent_factor_->colour(all_);
  join(along_, all_);
  add(rest_of_noise(root, random, all_), all_);
  scatter(all_, v);
}

// both at once: factors are read twice in place of three times

void SamplingMass::solve_with_noise(const VertexField &p, VertexField &v, uint64_t seed, uint64_t step, VertexField &z)
{
  const CounterRandom random(seed, step);
  part_.gather(p, all_);
  const Rest rest = rest_of(all_);
  split(all_, along_);
  draw(1.0, random, noise_, noise_along_);
  normal_factor_->solve_and_colour(along_, noise_along_);
  tangent_factor_->solve_and_colour(all_, noise_);
  join(along_, all_);
  join(noise_along_, noise_);
  add(rest, all_);
  add(rest_of_noise(1.0, random, noise_), noise_);
  scatter(all_, v);
  scatter(noise_, z);
  passes_ = 1;
}

/* ----------------------------------------------------------------------
   P T^-1 P with P = 1 - N N^T is the inverse of T - T N (N^T T N)^-1 N^T T along the surface. Translations
   are what velocities have of degree 1 along normals; whatever of that kind momenta may have does not
   change velocities otherwise, so it is there to give them their sum
------------------------------------------------------------------------- */

void SamplingMass::multiply(const VertexField &v, VertexField &p)
{
  part_.gather(v, all_);
  const auto n = static_cast<int>(all_.size());
  std::vector<Vector3d> speed(turning_.size(), Vector3d::Zero());
  for (size_t t = 0; t < turning_.size(); ++t) {
    for (int i : turning_[t].vertices)
      speed[t] += normals_[i] * normals_[i].dot(Map<Vector3d>(all_[i].c));
    speed[t] = turning_[t].inverse_square * speed[t];
    for (int i : turning_[t].vertices) Map<Vector3d>(all_[i].c) -= speed[t];
  }
  VectorXd totals = VectorXd::Zero(u_.cols());
  if (stiffness_.size())
    totals.head(stiffness_.size()) =
        stiffness_.cwiseProduct(products(u_, all_).head(stiffness_.size()));

  Vectors along(n, 3), across(n, 3);
  VectorXd out(n);
  for (int i = 0; i < n; ++i) {
    const Map<const Vector3d> here(all_[i].c);
    out[i] = normals_[i].dot(here);
    along.row(i) = here - out[i] * normals_[i];
  }
  out = undulation_ * out;
  along = sliding_ * along;
  for (int i = 0; i < n; ++i) along_[i] = normals_[i].dot(along.row(i));
  blocked_factor_->solve(along_);
  for (int i = 0; i < n; ++i) across.row(i) = along_[i] * normals_[i];
  along -= sliding_ * across;
  for (int i = 0; i < n; ++i)
    Map<Vector3d>(all_[i].c) = along.row(i).transpose() + out[i] * normals_[i];
  if (stiffness_.size()) subtract(u_, -totals, all_);

  for (size_t t = 0; t < turning_.size(); ++t) {
    Vector3d missing = speed[t] / turning_[t].mobility;
    for (int i : turning_[t].vertices) missing -= Map<Vector3d>(all_[i].c);
    missing = turning_[t].inverse_square * missing;
    for (int i : turning_[t].vertices)
      Map<Vector3d>(all_[i].c) += normals_[i] * normals_[i].dot(missing);
  }
  scatter(all_, p);
}

/* ----------------------------------------------------------------------
   the mass does not let a component turn, so it is sampled in one attitude: sum of arms x dq = 0. That
   all attitudes are equal is a factor det R of the weight, R_jk = sum (e_j x arm).(e_k x x) over the
   vertices, which is an energy of -kT ln det R
------------------------------------------------------------------------- */

void SamplingMass::add_gauge_forces(double kT, const VertexField &x, VertexField &f)
{
  if (turning_.empty()) return;
  std::vector<Eigen::Matrix3d> r(turning_.size(), Eigen::Matrix3d::Zero());
  for (int i = 0; i < part_.owned; ++i) {
    const int v = part_.vertices[i], t = turning_of_[v];
    if (t < 0) continue;
    const Map<const Vector3d> place(x[i].c);
    r[t] += arms_[v].dot(place) * Eigen::Matrix3d::Identity() - place * arms_[v].transpose();
  }
  part_.sum(r[0].data(), static_cast<int>(9 * r.size()));
  for (auto &matrix : r) {
    const Eigen::Matrix3d inverse = matrix.inverse();
    matrix = kT * (inverse.trace() * Eigen::Matrix3d::Identity() - inverse.transpose());
  }
  for (int i = 0; i < part_.owned; ++i) {
    const int v = part_.vertices[i], t = turning_of_[v];
    if (t >= 0) Map<Vector3d>(f[i].c) += r[t] * arms_[v];
  }
}

/* ---------------------------------------------------------------------- */

double SamplingMass::memory_usage() const
{
  return MassOperator::memory_usage() + normal_factor_->memory_usage() +
      tangent_factor_->memory_usage() + blocked_factor_->memory_usage() +
      12.0 * (undulation_.nonZeros() + sliding_.nonZeros()) +
      sizeof(double) * (u_.size() + y_.size());
}
