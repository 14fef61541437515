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

#include "membrane_regularization.h"

#include "membrane_corner_forces.h"
#include "membrane_lanes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

using namespace Membrane_NS;
using Eigen::Map;
using Eigen::Vector3d;

static const double INVERSE_4_SQRT_3 = 0.25 / std::sqrt(3.0);

double Membrane_NS::face_distortion(const double *pa, const double *pb, const double *pc)
{
  const Map<const Vector3d> a(pa), b(pb), c(pc);
  const double edges = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return INVERSE_4_SQRT_3 * edges / (0.5 * (b - a).cross(c - a).norm());
}

double Membrane_NS::face_uprightness(const double *const (&p)[3], const double *const (&across)[3])
{
  const Vector3d corner[3] = {Vector3d(p[0]), Vector3d(p[1]), Vector3d(p[2])};
  Vector3d around = Vector3d::Zero();
  double edges = 0.0;
  for (int k = 0; k < 3; ++k) {
    const Vector3d &next = corner[(k + 1) % 3], edge = corner[k] - next;
    around += edge.cross(Map<const Vector3d>(across[k]) - next);
    edges += edge.squaredNorm();
  }
  const Vector3d normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  const double upright = 0.5 * normal.norm() / (INVERSE_4_SQRT_3 * edges);
  return normal.dot(around) < 0.0 ? -upright : upright;
}

// D/A of faces, and its gradient by the first two corners: (d dirichlet - ratio d area)/area

static Lane distortion(const CornerBlock &corners, Lane3 (&gradient)[2])
{
  const Lane3 *side = corners.side;
  const Lane area = 0.5 * sqrt(dot(corners.normal, corners.normal)), inverse = 1.0 / area;
  const Lane ratio = INVERSE_4_SQRT_3 * inverse * (dot(side[0], side[0]) + dot(side[1], side[1]) + dot(side[2], side[2]));
  const Lane stretch = 2.0 * INVERSE_4_SQRT_3 * inverse, spread = 0.25 * ratio * inverse * inverse;
  for (int k = 0; k < 2; ++k)
    gradient[k] = stretch * (side[(k + 1) % 3] - side[(k + 2) % 3]) - spread * corners.area_gradient(k);
  return ratio;
}

static double largest(const CornerBlock &corners, const Lane &ratio, double so_far)
{
  for (int l = 0; l < corners.faces; ++l) so_far = std::max(so_far, std::isfinite(ratio[l]) ? ratio[l] : INFINITY);
  return so_far;
}

double Membrane_NS::regularize_faces(const FaceGroup &group, const double (*x)[3],
                                     const std::vector<double> &modulus, double (*f)[3],
                                     std::vector<double> &energy, std::vector<double> &virial)
{
  double worst = 1.0;
  for (int block = 0; block < group.nblocks(); ++block) {
    CornerBlock corners(group, block);
    const Lane K = load(modulus, corners.slot);
    if (!corners.any(K)) continue;
    corners.look(x);
    Lane3 gradient[2];
    const Lane ratio = where(K, distortion(corners, gradient), 1.0);
    worst = largest(corners, ratio, worst);
    corners.add_energy(K * (ratio - 1.0), energy);
    corners.subtract_gradients(where(K, K * gradient[0]), where(K, K * gradient[1]), f, virial);
  }
  return worst;
}

/* ---------------------------------------------------------------------- */

// of regularize_faces(), so that faces of an irregular mesh are of similar sizes; and a face with more D/A than
// this is kept from collapse
static constexpr double PLAIN = 0.1, BARRIER = 1.3;

std::vector<int> Membrane_NS::edge_families(const Topology &topology)
{
  constexpr int UNKNOWN = -2, NONE = -1;
  std::vector<char> regular(topology.num_components(), 1);
  for (int v = 0; v < topology.num_vertices(); ++v)
    if (topology.valence(v) != 6) regular[topology.component(v)] = 0;
  const auto component = [&](int f) { return topology.component(topology.face(f)[0]); };

  std::vector<int> family(topology.num_faces(), UNKNOWN), next;
  for (int start = 0; start < topology.num_faces(); ++start) {
    if (family[start] != UNKNOWN) continue;
    family[start] = regular[component(start)] ? 0 : NONE;
    if (family[start] == NONE) continue;
    next = {start};
    while (!next.empty()) {
      const int f = next.back();
      next.pop_back();
      for (int k = 0; k < 3; ++k) {
        // the edge from corner k is that from corner j of the face beyond it
        const int g = topology.neighbor(f, k), end = topology.face(f)[(k + 1) % 3];
        int j = 0;
        while (topology.neighbor(g, j) != f || topology.face(g)[j] != end) ++j;
        const int expected = (family[f] + k - j + 3) % 3;
        if (family[g] == UNKNOWN) {
          family[g] = expected;
          next.push_back(g);
        } else if (family[g] != expected) {
          regular[component(f)] = 0;    // lines close on those of another family
        }
      }
    }
  }
  for (int f = 0; f < topology.num_faces(); ++f)
    if (!regular[component(f)]) family[f] = NONE;
  return family;
}

// The four sides of the two faces at each edge, in the order of l_1 l_2/(l_3 l_4): those of the face itself are
// corners.side[k] and side[k + 1] with the edge from corner k.

namespace {

struct EdgeSides {
  int points[6 * LANES];    // of the corners, and across the edge from each
  Lane3 across[3];
  Lane3 one[3], other[3];    // by edge, the second and the fourth
  Lane square[3], square_one[3], square_other[3];

  EdgeSides(const CornerBlock &corners, const Lane &K, const std::vector<int> &far, const double (*x)[3])
  {
    std::copy_n(corners.points, 3 * LANES, points);
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < LANES; ++l)
        points[(3 + k) * LANES + l] = l < corners.faces && K[l] != 0.0 ? far[3 * static_cast<size_t>(corners.slot + l) + k]
                                                                        : corners.points[(k + 2) % 3 * LANES + l];
    gather(points + 3 * LANES, 3, x, across);
    for (int k = 0; k < 3; ++k) {
      one[k] = corners.place[k] - across[k];
      other[k] = across[k] - corners.place[(k + 1) % 3];
      square[k] = dot(corners.side[k], corners.side[k]);
      square_one[k] = dot(one[k], one[k]);
      square_other[k] = dot(other[k], other[k]);
    }
  }
};

}    // namespace

void Membrane_NS::cross_ratios(const FaceGroup &group, const double (*x)[3],
                               const std::vector<double> &modulus, const std::vector<int> &across,
                               std::vector<double> &logs)
{
  for (int block = 0; block < group.nblocks(); ++block) {
    CornerBlock corners(group, block);
    const Lane K = load(modulus, corners.slot);
    if (!corners.any(K)) continue;
    corners.look(x);
    const EdgeSides sides(corners, K, across, x);
    for (int k = 0; k < 3; ++k) {
      const Lane square = sides.square[k] * sides.square_one[k] / (sides.square[(k + 1) % 3] * sides.square_other[k]);
      for (int l = 0; l < corners.faces; ++l)
        if (K[l] != 0.0) logs[3 * static_cast<size_t>(corners.slot + l) + k] = 0.5 * std::log(square[l]);
    }
  }
}

double Membrane_NS::conformal_faces(const FaceGroup &group, const double (*x)[3],
                                    const std::vector<double> &modulus,
                                    const std::vector<int> &across, const std::vector<double> &logs,
                                    double (*f)[3], std::vector<double> &energy,
                                    std::vector<double> &virial)
{
  double worst = 1.0;
  for (int block = 0; block < group.nblocks(); ++block) {
    CornerBlock corners(group, block);
    const Lane K = load(modulus, corners.slot);
    if (!corners.any(K)) continue;
    corners.look(x);
    Lane3 gradient[2];
    const Lane ratio = where(K, distortion(corners, gradient), 1.0);
    worst = largest(corners, ratio, worst);
    const Lane over = ratio > BARRIER ? ratio - BARRIER : Lane{};
    const Lane slope = K * (PLAIN + over * (ratio + BARRIER) / (ratio * ratio));
    Lane law = PLAIN * (ratio - 1.0) + over * over / ratio;

    const EdgeSides sides(corners, K, across, x);
    Lane3 g[6];
    for (int k = 0; k < 2; ++k) g[k] = slope * gradient[k];
    g[2] = Lane3{} - g[0] - g[1];
    const Lane3 logs_here = load3(logs, corners.slot);
    const Lane log_ratio[3] = {logs_here.x, logs_here.y, logs_here.z}, weight = 2.0 / 9.0 * K;
    Lane inverse[3];
    for (int k = 0; k < 3; ++k) inverse[k] = 1.0 / sides.square[k];
    for (int k = 0; k < 3; ++k) {
      law += 1.0 / 9.0 * log_ratio[k] * log_ratio[k];

      // by the two ends of each side

      const int next = (k + 1) % 3, last = (k + 2) % 3;
      const Lane push = weight * log_ratio[k];
      const Lane3 one = push * inverse[k] * corners.side[k], two = push / sides.square_one[k] * sides.one[k],
                  three = push * inverse[next] * corners.side[next], four = push / sides.square_other[k] * sides.other[k];
      g[k] += two - three;
      g[next] = g[next] - one + four;
      g[last] += one + three;
      g[3 + k] = Lane3{} - two - four;
    }
    for (Lane3 &by : g) by = where(K, by);
    subtract(sides.points, 6, corners.faces, g, f);
    corners.add_energy(where(K, K * law), energy);
    if (virial.empty()) continue;
    Lane v[6] = {};
    for (int k = 1; k < 6; ++k) add_virial((k < 3 ? corners.place[k] : sides.across[k - 3]) - corners.place[0], g[k], v);
    corners.add_virial_of(v, virial);
  }
  return worst;
}

/* ---------------------------------------------------------------------- */

// so that the two ends of a sphere differ in density by a factor of 1.5 or so at K = 20 kT
static constexpr double DIPOLE = 10.0;

void Membrane_NS::add_dipoles(const FaceGroup &group, const double (*x)[3],
                              const std::vector<double> &origin, const std::vector<double> &modulus,
                              const std::vector<int> &component, std::vector<PointDipole> &dipoles)
{
  for (int block = 0; block < group.nblocks(); ++block) {
    CornerBlock corners(group, block);
    const int *of = &component[corners.slot];
    if (std::all_of(of, of + corners.faces, [](int c) { return c < 0; })) continue;
    corners.look(x);
    const Lane area = 0.5 * sqrt(dot(corners.normal, corners.normal));
    const Lane3 centre = 1.0 / 3.0 * (corners.place[0] + corners.place[1] + corners.place[2]) - load3(origin, corners.slot);
    for (int l = 0; l < corners.faces; ++l) {
      if (of[l] < 0) continue;
      PointDipole &dipole = dipoles[of[l]];
      const Vector3d here(centre.x[l], centre.y[l], centre.z[l]);
      dipole.faces += 1.0;
      dipole.area += area[l];
      dipole.modulus += modulus[corners.slot + l];
      dipole.centres += here;
      dipole.weighted += area[l] * here;
    }
  }
}

// What a dipole does to a face: dE = stiffness (2 d.dd - d^2 dA/A).

namespace {

struct DipoleLanes {
  Lane3 d = {}, middle = {};
  Lane stiffness = {}, part = {}, per_area = {};
  int component[LANES];

  DipoleLanes() { std::fill_n(component, LANES, -1); }

  void put(int l, int c, const PointDipole &dipole)
  {
    if (component[l] == c) return;
    component[l] = c;
    set(d, l, dipole.moment());
    set(middle, l, dipole.weighted / dipole.area);
    stiffness[l] = DIPOLE * 4.0 * M_PI / dipole.area * dipole.modulus / dipole.faces;
    part[l] = 1.0 / dipole.faces;
    per_area[l] = 1.0 / dipole.area;
  }

 private:
  static void set(Lane3 &lanes, int l, const Vector3d &a)
  {
    lanes.x[l] = a[0];
    lanes.y[l] = a[1];
    lanes.z[l] = a[2];
  }
};

}    // namespace

void Membrane_NS::hold_dipoles(const FaceGroup &group, const double (*x)[3],
                               const std::vector<double> &origin, const std::vector<int> &component,
                               const std::vector<PointDipole> &dipoles, double (*f)[3],
                               std::vector<double> &energy, std::vector<double> &virial)
{
  DipoleLanes dipole;
  for (int block = 0; block < group.nblocks(); ++block) {
    CornerBlock corners(group, block);
    Lane has = {};
    for (int l = 0; l < corners.faces; ++l) {
      const int c = component[corners.slot + l];
      if (c < 0) continue;
      has[l] = 1.0;
      dipole.put(l, c, dipoles[c]);
    }
    if (!corners.any(has)) continue;
    corners.look(x);
    const Lane area = 0.5 * sqrt(dot(corners.normal, corners.normal)), square = dot(dipole.d, dipole.d);
    const Lane3 centre = 1.0 / 3.0 * (corners.place[0] + corners.place[1] + corners.place[2]) -
        load3(origin, corners.slot) - dipole.middle;
    corners.add_energy(where(has, dipole.stiffness * square * dipole.part), energy);

    // its corners move the face as a whole, and change its area

    const Lane3 whole = where(has, (2.0 * dipole.stiffness * (dipole.part - area * dipole.per_area)) * dipole.d);
    const Lane tension = dipole.stiffness * (2.0 * dot(dipole.d, centre) + square) * dipole.per_area / (4.0 * area);
    Lane3 g[3];
    for (int k = 0; k < 2; ++k) g[k] = where(has, (Lane{} - tension) * corners.area_gradient(k));
    g[2] = Lane3{} - g[0] - g[1];
    if (!virial.empty()) {
      Lane v[6] = {};
      for (int k = 1; k < 3; ++k) add_virial(corners.place[k] - corners.place[0], g[k], v);
      add_virial(where(has, centre), whole, v);
      corners.add_virial_of(v, virial);
    }
    for (Lane3 &by : g) by += 1.0 / 3.0 * whole;
    subtract(corners.points, 3, corners.faces, g, f);
  }
}
