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

#include "fix_hd_bound.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_hd_base.h"
#include "mesh_gather.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Membrane_NS::Derivative;

/* ----------------------------------------------------------------------
   Rigid particles are found in proportion to sqrt(det(1 + m S)) per area, since the momenta that constraints
   leave free have that volume [M. Fixman, PNAS 71, 3050 (1974)]. The potential
     F = (kT/2) ln det Q,  Q_ab = delta_ab/m_a + (n_a.n_b) c_a^T M^-1 c_b,
   makes them uniform, as particles on stiff springs are. With W = Q^-1, C_ab = c_a^T M^-1 c_b,
   V_a = sum_b W_ab C_ab n_b and Y_a = sum_b W_ab (n_a.n_b) M^-1 c_b,
     dF = kT sum_a (V_a.dn_a + dc_a.Y_a)
   (doc/src/Derivation_bound.rst). Solutions with M: one for three particles.
------------------------------------------------------------------------- */

// mass sampling is another matrix for each direction, and no mass

double FixHDBound::bath_kT() const
{
  return mover && !mover->sampling() && !(mover->drag_coefficient() > 0.0) ? mover->sampled_kT() : 0.0;
}

void FixHDBound::correct_metric()
{
  const double kT = bath_kT();

  // particles of all ranks, in the order of ranks

  struct Particle {
    double normal[3], inverse_mass;
  };
  std::vector<Particle> mine;
  for (const Foot &foot : feet)
    mine.push_back({{foot.normal[0], foot.normal[1], foot.normal[2]}, 1.0 / mass_of(foot.atom)});
  const std::vector<Particle> all = gather_all(mine, world);
  const int n = static_cast<int>(all.size());
  int here = static_cast<int>(feet.size()), first = 0;
  MPI_Scan(&here, &first, 1, MPI_INT, MPI_SUM, world);
  first -= here;
  auto normal = [&](int a) { return Vector3d(all[a].normal[0], all[a].normal[1], all[a].normal[2]); };

  // M^-1 c_b at the control points of particles here, and from it rows of C

  std::vector<MatrixXd> answers;
  for (const Foot &foot : feet) answers.emplace_back(foot.size, n);
  std::vector<double> rows((size_t) here * n);
  for (int b = 0; b < n; b += 3) {
    clear_work();
    for (int d = 0; d < 3; ++d) {
      const int a = b + d - first;
      if (b + d >= n || a < 0 || a >= here) continue;
      const Foot &foot = feet[a];
      for (int k = foot.start; k < foot.start + foot.size; ++k) work[points[k]][d] += weights[k];
    }
    exchanged = work;
    comm->reverse_comm(this);
    if (atom->nlocal) std::fill_n(answer[0], 3 * atom->nlocal, 0.0);
    for (FixHDBase *integrator : integrators(false)) integrator->respond(work, answer);
    exchanged = answer;
    comm->forward_comm(this);
    for (int a = 0; a < here; ++a)
      for (int d = 0; d < 3 && b + d < n; ++d) {
        double sum = 0.0;
        for (int k = 0; k < feet[a].size; ++k) {
          answers[a](k, b + d) = answer[points[feet[a].start + k]][d];
          sum += weights[feet[a].start + k] * answers[a](k, b + d);
        }
        rows[(size_t) a * n + b + d] = sum;
      }
  }
  const std::vector<double> table = gather_all(rows, world);
  const Eigen::Map<const Eigen::Matrix<double, -1, -1, Eigen::RowMajor>> C(table.data(), n, n);
  MatrixXd Q(n, n);
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) Q(a, b) = normal(a).dot(normal(b)) * C(a, b) + (a == b) * all[a].inverse_mass;
  const Eigen::LDLT<MatrixXd> factor(Q);
  const MatrixXd W = factor.solve(MatrixXd::Identity(n, n));
  if (comm->me == 0)
    for (int a = 0; a < n; ++a)
      energy += 0.5 * kT * (std::log(factor.vectorD()[a]) - std::log(all[a].inverse_mass));

  // forces; first derivatives at the feet, fixed point of the surface: dn = -r^a (n.dr_a)

  clear_work();
  Membrane_NS::SurfaceWeights row;
  for (int a = 0; a < here; ++a) {
    const Foot &foot = feet[a];
    const BoundSite &site = sites[foot.atom];
    limit->look_from(foot.atom);
    const auto jet = limit->evaluate<2>(site.point);
    limit->weights<1>(site.point, row);
    Vector3d V = Vector3d::Zero();
    Eigen::VectorXd Y = Eigen::VectorXd::Zero(foot.size);
    for (int b = 0; b < n; ++b) {
      V += W(first + a, b) * C(first + a, b) * normal(b);
      Y += W(first + a, b) * foot.normal.dot(normal(b)) * answers[a].col(b);
    }
    const Vector3d r[2] = {jet.du(), jet.dv()}, &normal_here = foot.normal;
    const Matrix2d metric = jet.metric();
    Matrix2d second;
    second << normal_here.dot(jet.row(Derivative::DUU)), normal_here.dot(jet.row(Derivative::DUV)),
        normal_here.dot(jet.row(Derivative::DUV)), normal_here.dot(jet.row(Derivative::DVV));

    // n_a = -b_ab r^b, so V.n_a = -b_ab V^b

    const Vector2d V_up = metric.inverse() * Vector2d(V.dot(r[0]), V.dot(r[1]));
    Vector2d gradient = -second * V_up;
    for (int k = 0; k < foot.size; ++k) {
      gradient[0] += row(Derivative::DU, k) * Y[k];
      gradient[1] += row(Derivative::DV, k) * Y[k];
    }
    const double d = site.distance;
    const Vector2d h = kT * (metric - d * second).inverse() * gradient;
    const Vector3d pull = h[0] * r[0] + h[1] * r[1];
    const Vector2d turn = kT * V_up - d * h;
    for (int k = 0; k < foot.size; ++k) {
      const double along = turn[0] * row(Derivative::DU, k) + turn[1] * row(Derivative::DV, k);
      for (int c = 0; c < 3; ++c)
        work[points[foot.start + k]][c] += weights[foot.start + k] * pull[c] + along * normal_here[c];
    }
    for (int c = 0; c < 3; ++c) atom->f[foot.atom][c] -= pull[c];
    if (!evflag) continue;
    const Vector3d tangent = turn[0] * r[0] + turn[1] * r[1] - d * pull;    // times n, and half of it each way
    double v[6];
    static constexpr int PAIRS[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
    for (int k = 0; k < 6; ++k) {
      const int i = PAIRS[k][0], j = PAIRS[k][1];
      v[k] = 0.5 * (tangent[i] * normal_here[j] + tangent[j] * normal_here[i]);
    }
    int list = foot.atom;
    v_tally(1, &list, 1.0, v);
  }
  exchanged = work;
  comm->reverse_comm(this);
  for (int i = 0; i < atom->nlocal; ++i)
    for (int k = 0; k < 3; ++k) atom->f[i][k] += work[i][k];
}
