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

#include "membrane_mesh_shapes.h"

#include "membrane_limit_basis.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include <string>

using namespace Membrane_NS;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double TWO_PI = 6.283185307179586476925;

void require(bool good, const std::string &what)
{
  if (!good) throw MeshError(what);
}

void require_length(double length, const std::string &what)
{
  require(std::isfinite(length) && length > 0.0, what + " must be a positive length");
}

void require_lattice(const Matrix3d &lattice)
{
  require(lattice.allFinite() && lattice.determinant() > 0.0,
          "the box vectors must span a right-handed box of positive volume");
}

/* ----------------------------------------------------------------------
   faces of an nx by ny grid, periodic both ways, point (i, j) being number j*nx + i and the
   rows with odd j shifted by half a spacing towards larger i
------------------------------------------------------------------------- */

std::vector<Face> staggered_faces(int nx, int ny)
{
  std::vector<Face> faces;
  faces.reserve(2 * static_cast<size_t>(nx) * ny);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int row = j * nx, above = (j + 1) % ny * nx, next = (i + 1) % nx;
      const int a = row + i, b = row + next, c = above + next, d = above + i;
      if (j % 2 == 0) {
        faces.push_back({a, b, d});
        faces.push_back({b, c, d});
      } else {
        faces.push_back({a, b, c});
        faces.push_back({a, c, d});
      }
    }
  return faces;
}

/* ----------------------------------------------------------------------
   each face in four: where the new points go and which faces they make
------------------------------------------------------------------------- */

struct Split {
  std::vector<std::array<int, 2>> edges;    // new point i lies on side edges[i][1] of face [0]
  std::vector<Face> faces;
};

Split split_faces(const Topology &mesh)
{
  const int num_vertices = mesh.num_vertices();
  std::vector<std::array<int, 3>> midpoint(mesh.num_faces(), {-1, -1, -1});
  Split split;
  split.edges.reserve(mesh.num_edges());
  split.faces.reserve(4 * static_cast<size_t>(mesh.num_faces()));
  for (int f = 0; f < mesh.num_faces(); ++f) {
    const Face &face = mesh.face(f);
    for (int k = 0; k < 3; ++k) {
      if (midpoint[f][k] >= 0) continue;
      const int other = mesh.neighbor(f, k);
      midpoint[f][k] = num_vertices + static_cast<int>(split.edges.size());
      midpoint[other][corner_of(mesh.face(other), face[(k + 1) % 3])] = midpoint[f][k];
      split.edges.push_back({f, k});
    }
    const auto [ab, bc, ca] = midpoint[f];
    split.faces.push_back({face[0], ab, ca});
    split.faces.push_back({ab, face[1], bc});
    split.faces.push_back({ca, bc, face[2]});
    split.faces.push_back({ab, bc, ca});
  }
  return split;
}

Topology topology_of(const TriangleMesh &mesh)
{
  return Topology(static_cast<int>(mesh.points.size()), mesh.faces);
}

// the sum of the edges from a vertex to its neighbours: right across periodic boundaries

Vector3d sum_of_edges(const TriangleMesh &mesh, const Topology &topology, int v)
{
  Vector3d sum = Vector3d::Zero();
  for (int w : topology.ring(v)) sum += mesh.edge(v, w);
  return sum;
}

}    // namespace

/* ---------------------------------------------------------------------- */

TriangleMesh Membrane_NS::icosphere(int level, double radius)
{
  require(level >= 0 && level <= 7,
          "icosphere level " + std::to_string(level) + " must be between 0 and 7");
  require_length(radius, "icosphere radius");

  const double t = 0.5 * (1.0 + std::sqrt(5.0));
  TriangleMesh mesh;
  mesh.points = {{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                 {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
  mesh.faces = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (Vector3d &p : mesh.points) p.normalize();
  for (int i = 0; i < level; ++i) {
    Split split = split_faces(topology_of(mesh));
    for (const auto &[f, k] : split.edges) {
      const Face &face = mesh.faces[f];
      mesh.points.push_back((mesh.points[face[k]] + mesh.points[face[(k + 1) % 3]]).normalized());
    }
    mesh.faces = std::move(split.faces);
  }
  for (Vector3d &p : mesh.points) p *= radius;
  return mesh;
}

/* ---------------------------------------------------------------------- */

TriangleMesh Membrane_NS::sheet(int nx, int ny, const Matrix3d &lattice, double z)
{
  require(nx >= 4, "a sheet needs at least 4 points in a row, not " + std::to_string(nx));
  require(ny >= 4 && ny % 2 == 0,
          "a sheet needs an even number of rows, at least 4, not " + std::to_string(ny));
  require(std::isfinite(z), "the height of a sheet must be a number");
  require_lattice(lattice);

  TriangleMesh mesh;
  mesh.lattice = lattice;
  mesh.periodic = {true, true, false};
  mesh.points.reserve(static_cast<size_t>(nx) * ny);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      mesh.points.push_back(lattice * Vector3d((i + 0.5 * (j % 2)) / nx, double(j) / ny, z));
  mesh.faces = staggered_faces(nx, ny);
  return mesh;
}

/* ---------------------------------------------------------------------- */

TriangleMesh Membrane_NS::tube(int ntheta, int nz, double radius, const Matrix3d &lattice, int axis)
{
  require(ntheta >= 3, "a tube needs at least 3 points in a ring, not " + std::to_string(ntheta));
  require(nz >= 4 && nz % 2 == 0,
          "a tube needs an even number of rings, at least 4, not " + std::to_string(nz));
  require(axis >= 0 && axis <= 2,
          "the axis of a tube must be box vector 0, 1 or 2, not " + std::to_string(axis));
  require_length(radius, "tube radius");
  require_lattice(lattice);

  // right-handed frame: along the axis, and two directions across it

  const Vector3d along = lattice.col(axis).normalized();
  const Vector3d second = lattice.col((axis + 1) % 3);
  const Vector3d across = (second - along * along.dot(second)).normalized();
  const Vector3d third = along.cross(across);

  TriangleMesh mesh;
  mesh.lattice = lattice;
  mesh.periodic[axis] = true;
  mesh.points.reserve(static_cast<size_t>(ntheta) * nz);
  for (int j = 0; j < nz; ++j)
    for (int i = 0; i < ntheta; ++i) {
      const double theta = TWO_PI * (i + 0.5 * (j % 2)) / ntheta;
      mesh.points.push_back(lattice.col(axis) * (double(j) / nz) +
                            radius * (std::cos(theta) * across + std::sin(theta) * third));
    }
  mesh.faces = staggered_faces(ntheta, nz);
  return mesh;
}

/* ---------------------------------------------------------------------- */

TriangleMesh Membrane_NS::torus(int nu, int nv, double R, double r)
{
  require(nu >= 3, "a torus needs at least 3 points around its axis, not " + std::to_string(nu));
  require(nv >= 4 && nv % 2 == 0,
          "a torus needs an even number of points around its tube, at least 4, not " +
              std::to_string(nv));
  require_length(R, "torus radius");
  require_length(r, "torus tube radius");
  require(r < R, "the tube radius of a torus must be smaller than its radius");

  TriangleMesh mesh;
  mesh.points.reserve(static_cast<size_t>(nu) * nv);
  mesh.faces.reserve(2 * static_cast<size_t>(nu) * nv);

  // nv steps around the tube turn nv/2 spacings around the axis: point (i, nv) is (i + nv/2, 0)

  auto number = [&](int i, int j) {
    return (i + j / nv * (nv / 2)) % nu * nv + j % nv;
  };

  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const double u = TWO_PI * (i + 0.5 * j) / nu, v = TWO_PI * j / nv;
      const double rho = R + r * std::cos(v);
      mesh.points.emplace_back(rho * std::cos(u), rho * std::sin(u), r * std::sin(v));
      mesh.faces.push_back({number(i, j), number(i + 1, j), number(i, j + 1)});
      mesh.faces.push_back({number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)});
    }
  return mesh;
}

/* ----------------------------------------------------------------------
   C. Loop, Smooth Subdivision Surfaces Based on Triangles, MSc thesis, University of Utah (1987):
   an old vertex keeps 1 - n beta of itself and takes beta of each neighbour; the point on an edge
   takes 3/8 of each end and 1/8 of each opposite corner
------------------------------------------------------------------------- */

TriangleMesh Membrane_NS::loop_refine(const TriangleMesh &mesh)
{
  const Topology topology = topology_of(mesh);
  Split split = split_faces(topology);

  TriangleMesh fine;
  fine.lattice = mesh.lattice;
  fine.periodic = mesh.periodic;
  fine.points.reserve(mesh.points.size() + split.edges.size());
  for (int v = 0; v < topology.num_vertices(); ++v)
    fine.points.push_back(mesh.points[v] +
                          loop_beta(topology.valence(v)) * sum_of_edges(mesh, topology, v));
  for (const auto &[f, k] : split.edges) {
    const Face &face = topology.face(f);
    const int a = face[k], b = face[(k + 1) % 3], c = face[(k + 2) % 3];
    const int d = topology.opposite(f, k);
    fine.points.push_back(mesh.points[a] + 0.375 * mesh.edge(a, b) +
                          0.125 * (mesh.edge(a, c) + mesh.edge(a, d)));
  }
  fine.faces = std::move(split.faces);
  return fine;
}

/* ----------------------------------------------------------------------
   H. Hoppe et al., Piecewise Smooth Surface Reconstruction, SIGGRAPH (1994), appendix
------------------------------------------------------------------------- */

std::vector<Vector3d> Membrane_NS::limit_positions(const TriangleMesh &mesh)
{
  const Topology topology = topology_of(mesh);
  std::vector<Vector3d> limit(mesh.points);
  for (int v = 0; v < topology.num_vertices(); ++v) {
    const int n = topology.valence(v);
    limit[v] += (1.0 - limit_mask_centre(n)) / n * sum_of_edges(mesh, topology, v);
  }
  return limit;
}

/* ----------------------------------------------------------------------
   control points q with limit positions p: L q = p, row v of L being c on v and (1-c)/n on each of
   its n neighbours. With S = diag(n c/(1-c)) + adjacency, L = diag((1-c)/n) S, and S is symmetric.
   It is positive definite on every mesh without boundary: each edge lies in two triangles, and the
   sum over triangles of (x_a + x_b + x_c)^2 >= 0 bounds x.Ax below by -1/2 sum n x^2, while
   n c/(1-c) >= 2n/3 as c >= 2/5. So conjugate gradients need the same few iterations for any size.

   For the displacements d = q - p, which have no periodic images, L d = p - L p turns into
   S d = -(sum of the edges of p from v to its neighbours).
------------------------------------------------------------------------- */

TriangleMesh Membrane_NS::interpolate(const TriangleMesh &mesh)
{
  const Topology topology = topology_of(mesh);
  const int num_vertices = topology.num_vertices();

  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(num_vertices + 2 * static_cast<size_t>(topology.num_edges()));
  Eigen::MatrixXd right_side(num_vertices, 3);
  for (int v = 0; v < num_vertices; ++v) {
    const int n = topology.valence(v);
    const double c = limit_mask_centre(n);
    entries.emplace_back(v, v, n * c / (1.0 - c));
    for (int w : topology.ring(v)) entries.emplace_back(v, w, 1.0);
    right_side.row(v) = -sum_of_edges(mesh, topology, v);
  }
  require(right_side.allFinite(), "cannot interpolate a mesh whose coordinates are not finite");

  Eigen::SparseMatrix<double> matrix(num_vertices, num_vertices);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver;
  solver.setTolerance(1e-14);
  solver.setMaxIterations(1000);
  solver.compute(matrix);
  const Eigen::MatrixXd displacement = solver.solve(right_side);
  require(solver.info() == Eigen::Success,
          "the control points that interpolate the mesh did not converge; check its coordinates");

  TriangleMesh control = mesh;
  for (int v = 0; v < num_vertices; ++v) control.points[v] += displacement.row(v).transpose();
  return control;
}
