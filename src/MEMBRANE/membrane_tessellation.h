/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

#ifndef LMP_MEMBRANE_TESSELLATION_H
#define LMP_MEMBRANE_TESSELLATION_H

#include "membrane_limit_point.h"
#include "membrane_stencil.h"
#include "membrane_topology.h"
#include "membrane_triangle_mesh.h"

#include <array>
#include <map>
#include <vector>

namespace Membrane_NS {

/** Cuts faces into n x n triangles with corners on the limit surface.

    The points are (u, v) = (i/n, j/n), i + j <= n, row by row from v = 0. Weights are worked out
    once for each triple of valences. At an extraordinary corner the position is exact; normal and
    curvature, which has no limit there, are those 1/64 inside the face. */
class FaceTessellation {
 public:
  /// n from 1 to MOST; MeshError otherwise.
  explicit FaceTessellation(int n);
  static constexpr int MOST = 256;

  int subdivision() const { return n_; }
  int num_points() const { return (n_ + 1) * (n_ + 2) / 2; }
  int index(int i, int j) const { return j * (n_ + 1) - j * (j - 1) / 2 + i; }
  /// The corner of the face to which a point is nearest in (u, v).
  int nearest_corner(int point) const { return nearest_[point]; }
  /// The n x n triangles, counter-clockwise from outside like the face.
  const std::vector<Face> &triangles() const { return triangles_; }

  /// All points of one face. Length num_points().
  void evaluate(const Valences &valences, const StencilPoints &control,
                std::vector<LimitPoint> &points);

 private:
  int n_;
  std::vector<Face> triangles_;
  std::vector<int> nearest_;
  std::map<Valences, Eigen::MatrixXd> weights_;    // [num_points * ROWS][stencil]
  Eigen::Matrix<double, Eigen::Dynamic, 3> values_;

  const Eigen::MatrixXd &weights(const Valences &valences);
};

/** Numbers the points of all faces in the whole surface: first the vertices, then the points on edges,
    then those inside faces. */
class TessellationNumbering {
 public:
  /// The topology must outlive this.
  TessellationNumbering(const Topology &topology, int n);
  int num_points() const { return first_inside_ + topology_.num_faces() * inside(); }
  /// Of point (i, j) of face f, see FaceTessellation.
  int number(int f, int i, int j) const;

 private:
  struct Edge {
    int first;
    bool reversed;
  };
  const Topology &topology_;
  int n_, first_inside_;
  std::vector<std::array<Edge, 3>> edges_;

  int inside() const { return (n_ - 1) * (n_ - 2) / 2; }
  int on_edge(const Edge &edge, int step) const
  {
    return edge.first + (edge.reversed ? n_ - step : step) - 1;
  }
};

/// A mesh on the limit surface.
struct TessellatedSurface {
  TriangleMesh mesh;    ///< periodic if the control mesh is
  std::vector<Eigen::Vector3d> normals;
  std::vector<double> mean_curvature, gaussian_curvature;
  std::vector<int> face;    ///< a face of the control mesh that each point lies on
};

/** The whole limit surface, each face cut into n x n triangles, points as TessellationNumbering has
    them. Where several faces meet the curvatures are the mean over these, which matters at extraordinary vertices only. */
TessellatedSurface tessellate(const Topology &topology, const TriangleMesh &control, int n);

/** For each connected component, the box vectors along which it continues through the box. A
    component that does not must be in one piece. */
std::vector<std::array<bool, 3>> continuing_directions(const Topology &topology,
                                                       const TriangleMesh &mesh);

}    // namespace Membrane_NS

#endif
