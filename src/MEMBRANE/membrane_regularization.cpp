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

// D/A of a face, and its gradient by the first two corners

static double distortion(const FaceCorners &corners, Vector3d (&gradient)[2])
{
  const Vector3d *p = corners.place;
  const Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
  const double area = 0.5 * normal.norm();
  const double edges = (p[1] - p[0]).squaredNorm() + (p[2] - p[1]).squaredNorm() +
      (p[0] - p[2]).squaredNorm();
  const double ratio = INVERSE_4_SQRT_3 * edges / area;

  // (d dirichlet - ratio d area)/area

  const double stretch = 2.0 * INVERSE_4_SQRT_3 / area, spread = 0.25 * ratio / (area * area);
  for (int k = 0; k < 2; ++k) {
    const Vector3d &a = p[k], &b = p[(k + 1) % 3], &c = p[(k + 2) % 3];
    gradient[k] = stretch * (2.0 * a - b - c) - spread * normal.cross(c - b);
  }
  return ratio;
}

static double *of_slot(std::vector<double> &virial, int slot)
{
  return virial.empty() ? nullptr : &virial[6 * static_cast<size_t>(slot)];
}

double Membrane_NS::regularize_faces(const FaceGroup &group, const double (*x)[3],
                                     const std::vector<double> &modulus, double (*f)[3],
                                     std::vector<double> &energy, std::vector<double> &virial)
{
  double worst = 1.0;
  Lane3 p[3], g[3];
  for (int block = 0; block < group.nblocks(); ++block) {
    const int slot = group.first_slot + block * LANES, faces = std::min(LANES, group.nfaces - block * LANES);
    const Lane K = load(modulus, slot);
    bool any = false;
    for (int l = 0; l < faces; ++l) any = any || K[l] != 0.0;
    if (!any) continue;

    const int *points = &group.points[static_cast<size_t>(block) * group.rule->size * LANES];
    gather(points, 3, x, p);
    const Lane3 side[3] = {p[2] - p[1], p[0] - p[2], p[1] - p[0]};
    const Lane3 normal = cross(side[0], side[1]);
    const Lane area = 0.5 * sqrt(dot(normal, normal));
    Lane ratio = INVERSE_4_SQRT_3 * (dot(side[0], side[0]) + dot(side[1], side[1]) + dot(side[2], side[2])) / area;

    // as in distortion(), K d(D/A); a face without K may have no area either

    const Lane stretch = K * (2.0 * INVERSE_4_SQRT_3) / area, spread = 0.25 * K * ratio / (area * area);
    for (int k = 0; k < 2; ++k) {
      const Lane3 by = stretch * (side[(k + 1) % 3] - side[(k + 2) % 3]) - spread * cross(normal, side[k]);
      g[k].x = K == 0.0 ? Lane{} : by.x;
      g[k].y = K == 0.0 ? Lane{} : by.y;
      g[k].z = K == 0.0 ? Lane{} : by.z;
    }
    g[2] = Lane3{} - g[0] - g[1];
    ratio = K == 0.0 ? Lane{} + 1.0 : ratio;
    for (int l = 0; l < faces; ++l) worst = std::max(worst, std::isfinite(ratio[l]) ? ratio[l] : INFINITY);
    subtract(points, 3, faces, g, f);
    if (!energy.empty()) store(energy, slot, load(energy, slot) + K * (ratio - 1.0));
    if (virial.empty()) continue;
    Lane v[6] = {};
    for (int k = 1; k < 3; ++k) add_virial(p[k] - p[0], g[k], v);
    for (int l = 0; l < LANES; ++l)
      for (int i = 0; i < 6; ++i) virial[6 * (slot + l) + i] += v[i][l];
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

// the sides of the two faces at the edge from corner k, in the order of l_1 l_2/(l_3 l_4)

static std::array<Vector3d, 4> sides_at(const FaceCorners &corners, int k, const double *across)
{
  const Vector3d &p0 = corners.place[k], &p1 = corners.place[(k + 1) % 3], &p2 = corners.place[(k + 2) % 3];
  const Map<const Vector3d> d(across);
  return {p1 - p2, p0 - d, p2 - p0, d - p1};
}

void Membrane_NS::cross_ratios(const FaceGroup &group, const double (*x)[3],
                               const std::vector<double> &modulus, const std::vector<int> &across,
                               std::vector<double> &logs)
{
  for (int s = 0; s < group.nfaces; ++s) {
    const size_t slot = group.first_slot + s;
    if (modulus[slot] == 0.0) continue;
    const FaceCorners corners(group, s, x);
    for (int k = 0; k < 3; ++k) {
      const auto side = sides_at(corners, k, x[across[3 * slot + k]]);
      logs[3 * slot + k] = 0.5 * std::log(side[0].squaredNorm() * side[1].squaredNorm() /
                                          (side[2].squaredNorm() * side[3].squaredNorm()));
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
  for (int s = 0; s < group.nfaces; ++s) {
    const int slot = group.first_slot + s;
    if (modulus[slot] == 0.0) continue;
    const FaceCorners corners(group, s, x);
    Vector3d gradient[2];
    const double ratio = distortion(corners, gradient);
    worst = std::max(worst, std::isfinite(ratio) ? ratio : INFINITY);
    double *v = of_slot(virial, slot);
    double law = PLAIN * (ratio - 1.0), slope = PLAIN;
    if (ratio > BARRIER) {
      law += (ratio - BARRIER) * (ratio - BARRIER) / ratio;
      slope += 1.0 - BARRIER * BARRIER / (ratio * ratio);
    }
    slope *= -modulus[slot];
    if (!energy.empty()) energy[slot] += modulus[slot] * law;
    corners.add({slope * gradient[0], slope * gradient[1]}, f, v);

    const double weight = modulus[slot] / 9.0;
    for (int k = 0; k < 3; ++k) {
      const int d = across[3 * static_cast<size_t>(slot) + k];
      const auto side = sides_at(corners, k, x[d]);
      double square[4];
      for (int i = 0; i < 4; ++i) square[i] = side[i].squaredNorm();
      const double cross = logs[3 * static_cast<size_t>(slot) + k];
      if (!energy.empty()) energy[slot] += weight * cross * cross;

      // each side pulls its two ends together, or pushes them apart

      const double pull = 2.0 * weight * cross;
      const Vector3d one = -pull / square[0] * side[0], two = -pull / square[1] * side[1],
                     three = pull / square[2] * side[2], four = pull / square[3] * side[3];
      const Vector3d on[4] = {two - three, one - four, three - one, four - two};
      const int at[4] = {corners.point[k], corners.point[(k + 1) % 3], corners.point[(k + 2) % 3], d};
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 3; ++j) f[at[i]][j] += on[i][j];
      if (!v) continue;
      const Vector3d arm[4] = {one, two, three, four};
      for (int i = 0; i < 4; ++i) {
        v[0] += side[i][0] * arm[i][0];
        v[1] += side[i][1] * arm[i][1];
        v[2] += side[i][2] * arm[i][2];
        v[3] += side[i][0] * arm[i][1];
        v[4] += side[i][0] * arm[i][2];
        v[5] += side[i][1] * arm[i][2];
      }
    }
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
  for (int s = 0; s < group.nfaces; ++s) {
    const size_t slot = group.first_slot + s;
    if (component[slot] < 0) continue;
    PointDipole &dipole = dipoles[component[slot]];
    const FaceCorners corners(group, s, x);
    const Vector3d *p = corners.place;
    const Vector3d centre = (p[0] + p[1] + p[2]) / 3.0 - Map<const Vector3d>(&origin[3 * slot]);
    const double area = 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
    dipole.faces += 1.0;
    dipole.area += area;
    dipole.modulus += modulus[slot];
    dipole.centres += centre;
    dipole.weighted += area * centre;
  }
}

void Membrane_NS::hold_dipoles(const FaceGroup &group, const double (*x)[3],
                               const std::vector<double> &origin, const std::vector<int> &component,
                               const std::vector<PointDipole> &dipoles, double (*f)[3],
                               std::vector<double> &energy, std::vector<double> &virial)
{
  constexpr double FOUR_PI = 4.0 * M_PI;
  int c = -1;
  Vector3d d, middle;
  double stiffness = 0.0, part = 0.0, per_area = 0.0;
  for (int s = 0; s < group.nfaces; ++s) {
    const size_t slot = group.first_slot + s;
    if (component[slot] < 0) continue;
    const PointDipole &dipole = dipoles[component[slot]];
    if (component[slot] != c) {
      c = component[slot];
      d = dipole.moment();
      stiffness = DIPOLE * FOUR_PI / dipole.area * dipole.modulus / dipole.faces;
      part = 1.0 / dipole.faces;
      per_area = 1.0 / dipole.area;
      middle = dipole.weighted * per_area;
    }
    if (!energy.empty()) energy[slot] += stiffness * d.squaredNorm() * part;

    const FaceCorners corners(group, s, x);
    const Vector3d *p = corners.place;
    const Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
    const double area = 0.5 * normal.norm();
    const Vector3d centre = (p[0] + p[1] + p[2]) / 3.0 - Map<const Vector3d>(&origin[3 * slot]) - middle;

    // dE = stiffness (2 d.dd - d^2 dA/A): its corners move the face as a whole, and change its area

    const Vector3d whole = -2.0 * stiffness * (part - area * per_area) * d;
    const double tension = stiffness * (2.0 * d.dot(centre) + d.squaredNorm()) * per_area / (4.0 * area);
    double *v = of_slot(virial, slot);
    corners.add({tension * normal.cross(p[2] - p[1]), tension * normal.cross(p[0] - p[2])}, f, v);
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) f[corners.point[k]][i] += whole[i] / 3.0;
    if (!v) continue;
    v[0] += centre[0] * whole[0];
    v[1] += centre[1] * whole[1];
    v[2] += centre[2] * whole[2];
    v[3] += centre[0] * whole[1];
    v[4] += centre[0] * whole[2];
    v[5] += centre[1] * whole[2];
  }
}
