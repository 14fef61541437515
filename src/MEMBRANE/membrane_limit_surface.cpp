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

#include "membrane_limit_surface.h"

#include <algorithm>
#include <cmath>

using namespace Membrane_NS;
using Eigen::Matrix3d;
using Eigen::Vector3d;

static constexpr double TWO_PI = 6.283185307179586476925;

static Lane4 four(const Vector3d &x)
{
  return {x[0], x[1], x[2], 0.0};
}

/* ---------------------------------------------------------------------- */

LimitSurface::LimitSurface(const Topology &topology, const std::array<bool, 3> &periodic) :
    topology_(topology), periodic_(periodic), lattice_(Matrix3d::Identity()),
    to_fraction_(Matrix3d::Identity())
{
  start_.push_back(0);
  std::vector<int> stencil;
  for (int f = 0; f < topology.num_faces(); ++f) {
    patch_.push_back(&patches_.get(topology.valences(f)));
    topology.stencil(f, stencil);
    stencil_.insert(stencil_.end(), stencil.begin(), stencil.end());
    start_.push_back(static_cast<int>(stencil_.size()));
  }
}

void LimitSurface::set_box(const Matrix3d &lattice)
{
  lattice_ = lattice;
  to_fraction_ = lattice.inverse();
  surely_nearest2_ = INFINITY;
  for (int k = 0; k < 3; ++k)
    if (periodic_[k]) surely_nearest2_ = std::min(surely_nearest2_, 0.2499 / to_fraction_.row(k).squaredNorm());
}

LimitSurfaceOfMesh::LimitSurfaceOfMesh(const Topology &topology, const TriangleMesh &control) :
    LimitSurface(topology, control.periodic)
{
  for (const Vector3d &x : control.points) points_.push_back(four(x));
  for (int f = 0; f < topology.num_faces() && is_periodic(); ++f) {
    const IntSpan points = stencil(f);
    find_images(f, control, {points.begin(), points.end()});
  }
  set_box(control.lattice);
  measure();
}

/* ----------------------------------------------------------------------
   Which images the control points of a face are, in box vectors. There are few different ones: each
   is kept once.
------------------------------------------------------------------------- */

void LimitSurfaceOfMesh::find_images(int face, const TriangleMesh &control,
                                     const std::vector<int> &stencil)
{
  const Matrix3d to_fraction = control.lattice.inverse();
  std::vector<std::array<int, 3>> image(stencil.size(), {0, 0, 0});
  topology_.along_stencil(stencil, [&](int column, int anchor) {
    const int v = stencil[anchor], w = stencil[column];
    const Vector3d shift =
        to_fraction * (control.edge(v, w) - (control.points[w] - control.points[v]));
    for (int k = 0; k < 3; ++k)
      image[column][k] = image[anchor][k] + static_cast<int>(std::lround(shift[k]));
  });
  for (const auto &n : image) {
    const auto known = std::find(images_.begin(), images_.end(), n);
    image_.push_back(static_cast<std::uint16_t>(known - images_.begin()));
    if (known == images_.end()) images_.push_back(n);
  }
  if (images_.size() > 65535)
    throw MeshError("face " + std::to_string(face) + " has points in too many periodic images");
}

void LimitSurfaceOfMesh::move(const std::vector<Vector3d> &points, const Matrix3d &lattice)
{
  const Matrix3d before = to_fraction_;
  set_box(lattice);
  if (is_periodic()) {
    for (size_t v = 0; v < points.size(); ++v) {
      Vector3d shift = to_fraction_ * points[v] - before * points_[v].head<3>().matrix();
      for (int k = 0; k < 3; ++k) shift[k] = periodic_[k] ? std::round(shift[k]) : 0.0;
      points_[v] = four(points[v] - lattice * shift);
    }
  } else
    for (size_t v = 0; v < points.size(); ++v) points_[v] = four(points[v]);
  measure();
}

// what follows from the points and the box

void LimitSurfaceOfMesh::measure()
{
  translation_.clear();
  for (const auto &n : images_) translation_.push_back(four(lattice_ * Vector3d(n[0], n[1], n[2])));
  double sum = 0.0;
  for (int v = 0; v < topology_.num_vertices(); ++v)
    for (int w : topology_.ring(v))
      if (v < w) sum += nearest_image((points_[w] - points_[v]).head<3>().matrix()).norm();
  set_mean_edge(sum / std::max(topology_.num_edges(), 1));
}

Vector3d LimitSurface::image_of(const Vector3d &difference) const
{
  Vector3d shift = to_fraction_ * difference;
  for (int k = 0; k < 3; ++k) shift[k] = periodic_[k] ? std::rint(shift[k]) : 0.0;
  return shift.isZero(0.0) ? difference : difference - lattice_ * shift;
}

/* ---------------------------------------------------------------------- */

void LimitSurfaceOfMesh::gather(int face, Lane4 *x) const
{
  const int begin = start_[face], size = start_[face + 1] - begin;
  const int *stencil = stencil_.data() + begin;
  for (int k = 0; k < size; ++k) x[k] = points_[stencil[k]];
  if (image_.empty()) return;
  const std::uint16_t *image = image_.data() + begin;
  for (int k = 0; k < size; ++k) x[k] += translation_[image[k]];
}

void LimitSurface::make_piece(const SurfacePoint &p, SurfacePiece &piece) const
{
  Lane4 x[MOST_STENCIL];
  gather(p.face, x);
  const LimitPatch &patch = *patch_[p.face];
  piece.face = p.face;
  piece.part = patch.part_at(p.u, p.v);
  patch.polynomial(piece.part, x, piece.origin, piece.polynomial);
}

template <int ORDER>
void LimitSurface::evaluate(const SurfacePoint &p, SurfacePiece &piece, SurfaceJet &jet) const
{
  const LimitPatch &patch = *patch_[p.face];
  SurfacePoint at = p;
  const int corner = patch.corner_at(p.u, p.v);
  if (corner >= 0) LimitPatch::move_inside(corner, at.u, at.v);
  if (!piece.contains(at)) make_piece(at, piece);

  QuarticJet<4> &rows = jet.rows();
  const RegularPart &part = piece.part;
  evaluate_quartics<ORDER, 4>(piece.polynomial, part.scale * at.u + part.u0,
                              part.scale * at.v + part.v0, part.scale, rows);
  rows[Derivative::VALUE] += piece.origin;
  for (int row = Derivative::rows(ORDER); row < Derivative::ROWS; ++row) rows[row].setZero();
  if (corner >= 0) {
    Lane4 x[MOST_STENCIL];
    gather(p.face, x);
    rows[Derivative::VALUE] = patch.corner_position(corner, x);
  }
}

template <int ORDER> SurfaceJet LimitSurface::evaluate(const SurfacePoint &p) const
{
  SurfacePiece piece;
  SurfaceJet jet;
  evaluate<ORDER>(p, piece, jet);
  return jet;
}

template <int ORDER> void LimitSurface::weights(const SurfacePoint &p, SurfaceWeights &out) const
{
  patch_[p.face]->weights<ORDER>(p.u, p.v, out);
}

template SurfaceJet LimitSurface::evaluate<0>(const SurfacePoint &) const;
template SurfaceJet LimitSurface::evaluate<1>(const SurfacePoint &) const;
template SurfaceJet LimitSurface::evaluate<2>(const SurfacePoint &) const;
template SurfaceJet LimitSurface::evaluate<3>(const SurfacePoint &) const;
template void LimitSurface::evaluate<0>(const SurfacePoint &, SurfacePiece &, SurfaceJet &) const;
template void LimitSurface::evaluate<1>(const SurfacePoint &, SurfacePiece &, SurfaceJet &) const;
template void LimitSurface::evaluate<2>(const SurfacePoint &, SurfacePiece &, SurfaceJet &) const;
template void LimitSurface::evaluate<3>(const SurfacePoint &, SurfacePiece &, SurfaceJet &) const;
template void LimitSurface::weights<0>(const SurfacePoint &, SurfaceWeights &) const;
template void LimitSurface::weights<1>(const SurfacePoint &, SurfaceWeights &) const;
template void LimitSurface::weights<2>(const SurfacePoint &, SurfaceWeights &) const;
template void LimitSurface::weights<3>(const SurfacePoint &, SurfaceWeights &) const;

/* ----------------------------------------------------------------------
   Tangent masks [H. Hoppe et al., Piecewise Smooth Surface Reconstruction, SIGGRAPH 1994], scaled
   such that a ring of neighbours at cos, sin in a plane gives the axes of that plane. The ring is put
   where the face is: neighbours by their edges from the corner.
------------------------------------------------------------------------- */

Matrix3d LimitSurface::vertex_frame(int face, int k) const
{
  Lane4 x[MOST_STENCIL];
  gather(face, x);
  const IntSpan points = stencil(face), ring = topology_.ring(topology_.face(face)[k]);
  const int n = ring.size();
  Matrix3d frame = Matrix3d::Zero();
  frame.col(0) = x[k].head<3>().matrix();
  const double spoke = (1.0 - limit_mask_centre(n)) / n;
  for (int i = 0; i < n; ++i) {
    const auto column = std::find(points.begin(), points.end(), ring[i]) - points.begin();
    const Vector3d edge = nearest_image((x[column] - x[k]).head<3>().matrix());
    frame.col(0) += spoke * edge;
    frame.col(1) += 2.0 / n * std::cos(TWO_PI * i / n) * edge;
    frame.col(2) += 2.0 / n * std::sin(TWO_PI * i / n) * edge;
  }
  return frame;
}

double LimitSurface::memory_usage() const
{
  return sizeof(LimitPatch *) * patch_.capacity() +
      sizeof(int) * (start_.capacity() + stencil_.capacity()) + patches_.memory_usage();
}

double LimitSurfaceOfMesh::memory_usage() const
{
  return LimitSurface::memory_usage() +
      sizeof(Lane4) * (points_.capacity() + translation_.capacity()) +
      sizeof(std::uint16_t) * image_.capacity();
}
