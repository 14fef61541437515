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

#include "membrane_surface_point.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace Membrane_NS;
using Eigen::Matrix2d;
using Eigen::Vector2d;

/* ----------------------------------------------------------------------
   A straight line seen from the face that it has reached: where it started and where it will end, in
   the barycentric coordinates of that face, unfolded. Positions are never put together from pieces:
   rounding does not grow with the number of edges.
------------------------------------------------------------------------- */

namespace {

using Barycentric = std::array<double, 3>;

struct Line {
  int face;
  Barycentric start, end, u, v;    // u and v: what the steps (1, 0) and (0, 1) have become
};

bool is_at(int corner, const Barycentric &b)
{
  return std::fabs(b[(corner + 1) % 3]) <= VERTEX_HIT &&
      std::fabs(b[(corner + 2) % 3]) <= VERTEX_HIT;
}

// the corner opposite the edge through which the line leaves its face, or -1: it ends there

int way_out(const Line &line)
{
  int out = -1;
  for (int k = 0; k < 3; ++k) {
    if (line.end[k] >= 0.0) continue;
    if (out < 0) {
      out = k;
      continue;
    }
    // the fraction of the line before it meets edge k is start / (start - end); at a corner, where both
    // are 0, the nearer side
    const double here = line.start[k] * -line.end[out], there = line.start[out] * -line.end[k];
    if (here < there || (here == there && line.end[k] < line.end[out])) out = k;
  }
  return out;
}

// into the face across from corner k

void cross(const Topology &topology, int k, Line &line)
{
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  const Face &from = topology.face(line.face);
  const int next = topology.neighbor(line.face, i);
  const Face &to = topology.face(next);
  int image[3];    // of the corners k, i, j: k means the vertex across
  image[1] = corner_of(to, from[i]);
  image[2] = corner_of(to, from[j]);
  image[0] = 3 - image[1] - image[2];
  for (Barycentric *b : {&line.start, &line.end, &line.u, &line.v}) {
    const double bi = (*b)[i] + (*b)[k], bj = (*b)[j] + (*b)[k], bk = -(*b)[k];
    (*b)[image[0]] = bk;
    (*b)[image[1]] = bi;
    (*b)[image[2]] = bj;
  }
  line.face = next;
}

/* ----------------------------------------------------------------------
   Straight through a vertex of valence n at corner k: turn what lies beyond it about the vertex such
   that it makes 30 n degrees with where the line came from. Vectors from the vertex have components
   along the edges to the next and to the previous corner, 60 degrees apart. Seen from the next corner
   towards the previous, faces follow one another as Topology::faces_around() has them.
------------------------------------------------------------------------- */

void go_through(const Topology &topology, int k, Line &line)
{
  const int vertex = topology.face(line.face)[k];
  const IntSpan around = topology.faces_around(vertex);
  const int n = around.size(), i = (k + 1) % 3, j = (k + 2) % 3;

  // the part of the step that is left when the line is closest to the vertex

  Barycentric step;
  for (int c = 0; c < 3; ++c) step[c] = line.end[c] - line.start[c];
  auto dot = [&](double ai, double aj, double bi, double bj) {
    return ai * bi + aj * bj + 0.5 * (ai * bj + aj * bi);
  };
  const double left = std::clamp(dot(line.end[i], line.end[j], step[i], step[j]) /
                                     dot(step[i], step[j], step[i], step[j]),
                                 0.0, 1.0);

  // back along the line, turned by 60 degrees times n/2, or (n -+ 1)/2 and +-30 degrees more

  static const double THIRD = 1.0 / std::sqrt(3.0);
  Matrix2d turn = -Matrix2d::Identity();
  int sectors = n / 2;
  if (n % 2) {
    const bool first_half = -step[i] >= -step[j];
    if (first_half)
      turn << -THIRD, THIRD, -THIRD, -2.0 * THIRD;
    else {
      turn << -2.0 * THIRD, -THIRD, THIRD, -THIRD;
      ++sectors;
    }
  }
  int here = 0;
  while (around[here] != line.face) ++here;
  const int next = around[(here + sectors) % n];
  const int c = corner_of(topology.face(next), vertex), ci = (c + 1) % 3, cj = (c + 2) % 3;

  auto turned = [&](const Barycentric &b, double scale) {
    const Vector2d w = scale * (turn * Vector2d(b[i], b[j]));
    Barycentric out;
    out[ci] = w[0];
    out[cj] = w[1];
    out[c] = -w[0] - w[1];
    return out;
  };
  line.end = turned(step, left);
  line.end[c] += 1.0;
  line.u = turned(line.u, 1.0);
  line.v = turned(line.v, 1.0);
  line.start = {0.0, 0.0, 0.0};
  line.start[c] = 1.0;
  line.face = next;
}

// the extraordinary corner that the line goes through when it leaves across from corner k, or -1

int corner_hit(const Topology &topology, int k, const Line &line)
{
  const double t = line.start[k] / (line.start[k] - line.end[k]);
  for (int c : {(k + 1) % 3, (k + 2) % 3}) {
    const double there = line.start[c] + t * (line.end[c] - line.start[c]);
    if (there < 1.0 - VERTEX_HIT || there > 1.0 + VERTEX_HIT) continue;
    if (!is_at(c, line.start) && topology.valence(topology.face(line.face)[c]) != 6) return c;
  }
  return -1;
}

SurfacePoint within(int face, const Barycentric &b)
{
  SurfacePoint point = {face, std::max(b[1], 0.0), std::max(b[2], 0.0)};
  const double sum = point.u + point.v;
  if (sum > 1.0) {
    point.u /= sum;
    point.v = 1.0 - point.u;
  }
  return point;
}

}    // namespace

/* ---------------------------------------------------------------------- */

SurfaceWalk Membrane_NS::walk(const Topology &topology, const SurfacePoint &start,
                              const Vector2d &step)
{
  SurfaceWalk result;
  const double u = start.u + step[0], v = start.v + step[1];
  if (u >= 0.0 && v >= 0.0 && u + v <= 1.0) {
    result.end = {start.face, u, v};
    return result;
  }

  const double length = std::fabs(step[0]) + std::fabs(step[1]);
  if (!(length <= LONGEST_WALK))
    throw MeshError("a step of " + std::to_string(length) + " edges along a membrane");
  Line line = {
      start.face, start.barycentric(), {1.0 - u - v, u, v}, {-1.0, 1.0, 0.0}, {-1.0, 0.0, 1.0}};

  // A line meets each of the three families of edges once a unit of its coordinate, |du| + |dv| +
  // |du + dv| in all. Vertices may turn it, and rounding add edges at its ends; never so many.

  const double most = 32.0 + 8.0 * length;
  while (result.edges + result.vertices < most) {
    const int k = way_out(line);
    if (k < 0) break;
    const int hit = corner_hit(topology, k, line);
    if (hit >= 0) {
      if (is_at(hit, line.end)) {
        line.end = {0.0, 0.0, 0.0};
        line.end[hit] = 1.0;
        break;
      }
      go_through(topology, hit, line);
      ++result.vertices;
      continue;
    }
    cross(topology, k, line);
    ++result.edges;
  }
  result.end = within(line.face, line.end);
  result.turn << line.u[1], line.v[1], line.u[2], line.v[2];
  return result;
}
