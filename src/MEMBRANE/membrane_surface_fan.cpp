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

#include "membrane_surface_fan.h"

#include "membrane_limit_basis.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

using namespace Membrane_NS;
using Eigen::Matrix2d;
using Eigen::Vector2d;

static constexpr double TWO_PI = 6.283185307179586476925;

// the powers of two, for which subdivision shrinks s, that the eigenvalue is

static double shrinking_power(int n)
{
  return -std::log2(subdominant_eigenvalue(n));
}

static Vector2d neighbour(int i, int n)
{
  return {std::cos(TWO_PI * i / n), std::sin(TWO_PI * i / n)};
}

/* ---------------------------------------------------------------------- */

FanPoint Membrane_NS::fan_point(const Topology &topology, const SurfacePoint &p, int k)
{
  FanPoint fan;
  fan.vertex = topology.face(p.face)[k];
  const IntSpan around = topology.faces_around(fan.vertex);
  const int n = around.size();
  int sector = 0;
  while (around[sector] != p.face) ++sector;
  Matrix2d axes;
  axes << neighbour(sector, n), neighbour(sector + 1, n);

  const auto t = p.barycentric();
  const Vector2d ab(t[(k + 1) % 3], t[(k + 2) % 3]);
  const double s = ab.sum(), g = shrinking_power(n);
  if (s <= 0.0) {
    fan.place.setZero();
    fan.slope.setIdentity();
    return fan;
  }
  const double factor = std::pow(s, g - 1.0);
  fan.place = axes * (factor * ab);

  Matrix2d by_ab = Matrix2d::Identity() * factor;    // of the point's two components
  by_ab.colwise() += factor * (g - 1.0) / s * ab;
  Matrix2d ab_by_uv;    // rows: t of the next and of the previous corner
  for (int row = 0; row < 2; ++row) {
    const int c = (k + 1 + row) % 3;
    ab_by_uv.row(row) << (c == 0 ? -1.0 : c == 1 ? 1.0 : 0.0), (c == 0 ? -1.0 : c == 2 ? 1.0 : 0.0);
  }
  fan.slope = axes * by_ab * ab_by_uv;
  return fan;
}

SurfacePoint Membrane_NS::point_in_fan(const Topology &topology, int vertex, const Vector2d &place)
{
  const IntSpan around = topology.faces_around(vertex);
  const int n = around.size();
  const double turns = std::atan2(place[1], place[0]) / TWO_PI;
  const int sector = std::min(static_cast<int>((turns - std::floor(turns)) * n), n - 1);
  Matrix2d axes;
  axes << neighbour(sector, n), neighbour(sector + 1, n);
  const Vector2d inside = (axes.inverse() * place).cwiseMax(0.0);
  const double distance = inside.sum();
  double t[3] = {0.0, 0.0, 0.0};
  const int face = around[sector], k = corner_of(topology.face(face), vertex);
  if (distance > 0.0) {
    const double s = std::min(std::pow(distance, 1.0 / shrinking_power(n)), 1.0);
    t[(k + 1) % 3] = inside[0] / distance * s;
    t[(k + 2) % 3] = inside[1] / distance * s;
  }
  t[k] = std::max(1.0 - t[(k + 1) % 3] - t[(k + 2) % 3], 0.0);
  return {face, t[1], t[2]};
}

int Membrane_NS::fan_corner(const Topology &topology, const SurfacePoint &p)
{
  const auto t = p.barycentric();
  for (int k = 0; k < 3; ++k)
    if (t[k] > 0.5 && topology.valence(topology.face(p.face)[k]) != 6) return k;
  return -1;
}
