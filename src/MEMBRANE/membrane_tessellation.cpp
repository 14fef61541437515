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

#include "membrane_tessellation.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace Membrane_NS;
using Eigen::Vector3d;

/* ---------------------------------------------------------------------- */

FaceTessellation::FaceTessellation(int n) : n_(n)
{
  if (n < 1 || n > MOST)
    throw MeshError("faces cannot be cut into " + std::to_string(n) + " parts a side; use 1 to " +
                    std::to_string(MOST));
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i + j <= n; ++i) {
      const std::array<int, 3> share = {n - i - j, i, j};
      nearest_.push_back(std::max_element(share.begin(), share.end()) - share.begin());
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i + j < n; ++i) {
      triangles_.push_back({index(i, j), index(i + 1, j), index(i, j + 1)});
      if (i + j + 1 < n)
        triangles_.push_back({index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)});
    }
}

const Eigen::MatrixXd &FaceTessellation::weights(const Valences &valences)
{
  const auto [entry, is_new] = weights_.try_emplace(valences);
  if (!is_new) return entry->second;
  const LimitBasis basis(valences);
  entry->second.resize(num_points() * LimitBasis::ROWS, basis.size());
  for (int j = 0; j <= n_; ++j)
    for (int i = 0; i + j <= n_; ++i)
      entry->second.middleRows(index(i, j) * LimitBasis::ROWS, LimitBasis::ROWS) =
          basis.evaluate(double(i) / n_, double(j) / n_);
  return entry->second;
}

void FaceTessellation::evaluate(const Valences &valences, const StencilPoints &control,
                                std::vector<LimitPoint> &points)
{
  values_ = weights(valences).lazyProduct(control);
  points.resize(num_points());
  for (int p = 0; p < num_points(); ++p)
    points[p] = limit_point(values_.middleRows<LimitBasis::ROWS>(p * LimitBasis::ROWS));
}

/* ---------------------------------------------------------------------- */

TessellationNumbering::TessellationNumbering(const Topology &topology, int n) :
    topology_(topology), n_(n), edges_(topology.num_faces())
{
  int next = topology.num_vertices();
  for (int f = 0; f < topology.num_faces(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int g = topology.neighbor(f, k);
      if (f > g) continue;
      const int there = corner_of(topology.face(g), topology.face(f)[(k + 1) % 3]);
      edges_[f][k] = {next, false};
      edges_[g][there] = {next, true};
      next += n - 1;
    }
  first_inside_ = next;
}

int TessellationNumbering::number(int f, int i, int j) const
{
  const Face &face = topology_.face(f);
  const int k = n_ - i - j;
  if (k == n_) return face[0];
  if (i == n_) return face[1];
  if (j == n_) return face[2];
  if (j == 0) return on_edge(edges_[f][0], i);
  if (k == 0) return on_edge(edges_[f][1], j);
  if (i == 0) return on_edge(edges_[f][2], k);
  return first_inside_ + f * inside() + (j - 1) * (n_ - 2) - (j - 1) * (j - 2) / 2 + i - 1;
}

/* ---------------------------------------------------------------------- */

TessellatedSurface Membrane_NS::tessellate(const Topology &topology, const TriangleMesh &control,
                                           int n)
{
  FaceTessellation cut(n);
  const TessellationNumbering numbering(topology, n);
  const int num_points = numbering.num_points();

  TessellatedSurface surface;
  surface.mesh.lattice = control.lattice;
  surface.mesh.periodic = control.periodic;
  surface.mesh.points.resize(num_points);
  surface.mesh.faces.reserve(size_t(topology.num_faces()) * n * n);
  surface.normals.assign(num_points, Vector3d::Zero());
  surface.mean_curvature.assign(num_points, 0.0);
  surface.gaussian_curvature.assign(num_points, 0.0);
  surface.face.assign(num_points, -1);

  StencilPoints stencil;
  std::vector<LimitPoint> points;
  std::vector<int> number(cut.num_points()), meet(num_points, 0);
  for (int f = 0; f < topology.num_faces(); ++f) {
    stencil_points(topology, control, f, stencil);
    cut.evaluate(topology.valences(f), stencil, points);
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i + j <= n; ++i) number[cut.index(i, j)] = numbering.number(f, i, j);

    for (int p = 0; p < cut.num_points(); ++p) {
      const int v = number[p];
      if (meet[v]++ == 0) {
        surface.mesh.points[v] = points[p].position;
        surface.face[v] = f;
      }
      surface.normals[v] += points[p].normal;
      surface.mean_curvature[v] += points[p].mean_curvature;
      surface.gaussian_curvature[v] += points[p].gaussian_curvature;
    }
    for (const Face &t : cut.triangles())
      surface.mesh.faces.push_back({number[t[0]], number[t[1]], number[t[2]]});
  }
  for (int v = 0; v < num_points; ++v) {
    surface.normals[v].normalize();
    surface.mean_curvature[v] /= meet[v];
    surface.gaussian_curvature[v] /= meet[v];
  }
  return surface;
}

/* ---------------------------------------------------------------------- */

std::vector<std::array<bool, 3>> Membrane_NS::continuing_directions(const Topology &topology,
                                                                    const TriangleMesh &mesh)
{
  std::vector<std::array<bool, 3>> continues(topology.num_components(), {false, false, false});
  if (!mesh.is_periodic()) return continues;
  const Eigen::Matrix3d to_fraction = mesh.lattice.inverse();
  for (int v = 0; v < topology.num_vertices(); ++v)
    for (int w : topology.ring(v)) {
      const Vector3d shift = to_fraction * (mesh.points[w] - mesh.points[v] - mesh.edge(v, w));
      for (int k = 0; k < 3; ++k)
        if (std::lround(shift[k]) != 0) continues[topology.component(v)][k] = true;
    }
  return continues;
}
