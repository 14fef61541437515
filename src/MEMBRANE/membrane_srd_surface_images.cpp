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

#include "membrane_srd_surface_images.h"

#include "membrane_srd_image_finder.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>

using namespace Membrane_NS;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/* ---------------------------------------------------------------------- */

void SurfaceImages::find_images(const SurfaceFaces &surface,
                                const std::vector<SurfaceVertex> &vertices, const Matrix3d &lattice,
                                const std::array<bool, 3> &periodic, const Vector3d &lo,
                                const Vector3d &hi, double pad)
{
  lattice_ = lattice;
  list_images(surface, vertices, periodic, lo, hi, pad);
  list_corners(surface, static_cast<int>(vertices.size()));
}

/* ----------------------------------------------------------------------
   the periodic images of each face that come near the region
------------------------------------------------------------------------- */

void SurfaceImages::list_images(const SurfaceFaces &surface,
                                const std::vector<SurfaceVertex> &vertices,
                                const std::array<bool, 3> &periodic, const Vector3d &lo,
                                const Vector3d &hi, double pad)
{
  const Vector3d margin = Vector3d::Constant(pad);
  const ImageFinder region(lattice_, periodic, lo - margin, hi + margin);
  images_.clear();
  for (size_t f = 0; f < surface.faces.size(); ++f)
    region.for_each(corners_together(surface, f, vertices, lattice_),
                    [&](const std::array<int, 3> &image) {
                      images_.push_back({static_cast<int>(f), image});
                    });
}

// few corners are not the vertex itself but one of its images

void SurfaceImages::list_corners(const SurfaceFaces &surface, int num_vertices)
{
  corners_.resize(num_vertices);
  for (int v = 0; v < num_vertices; ++v) corners_[v] = {v, {0, 0, 0}};
  std::map<std::pair<int, std::array<int, 3>>, int> others;
  corners_of_.resize(images_.size());
  triangles_.resize(images_.size());
  planes_.resize(images_.size());
  for (size_t t = 0; t < images_.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Image &image = images_[t];
      const int vertex = triangles_[t].vertex[k] = surface.faces[image.face][k];
      triangles_[t].shift[k] = triangles_[t].drift[k] = Vector3d::Zero();
      std::array<int, 3> n = image.lattice;
      if (!surface.seams.empty())
        for (int j = 0; j < 3; ++j) n[j] += surface.seams[image.face][k][j];
      corners_of_[t][k] = vertex;
      if (n == std::array<int, 3>{0, 0, 0}) continue;
      const auto [other, is_new] = others.try_emplace({vertex, n}, corners_.size());
      if (is_new) corners_.push_back({vertex, n});
      corners_of_[t][k] = other->second;
    }
}

/* ---------------------------------------------------------------------- */

void SurfaceImages::begin(const std::vector<SurfaceVertex> &vertices, double duration, double slack,
                          const Matrix3d &rate)
{
  slack_ = slack;
  most_moves_ = 0.0;
  const size_t n = corners_.size(), num_vertices = vertices.size();
  corner_at_.resize(n);
  corner_velocity_.resize(n);
  corner_speed_.resize(n);
  for (size_t c = 0; c < n; ++c) {
    const MovingPoint &path = vertices[corners_[c].vertex].path;
    corner_at_[c] = path.origin;
    corner_velocity_[c] = path.velocity;
    if (c >= num_vertices) {
      const auto &l = corners_[c].lattice;
      const Vector3d images(l[0], l[1], l[2]);
      corner_at_[c] += lattice_ * images;
      corner_velocity_[c] += rate * images;
    }
    corner_speed_[c] = corner_velocity_[c].norm();
  }

  for (size_t t = 0; t < planes_.size(); ++t) {
    Plane &plane = planes_[t];
    const auto &corner = corners_of_[t];
    for (int k = 0; k < 3; ++k)
      if (corner[k] >= static_cast<int>(num_vertices)) {
        const auto &l = corners_[corner[k]].lattice;
        const Vector3d images(l[0], l[1], l[2]);
        triangles_[t].shift[k] = lattice_ * images;
        triangles_[t].drift[k] = rate * images;
      }
    const Vector3d &a = corner_at_[corner[0]], &b = corner_at_[corner[1]],
                   &c = corner_at_[corner[2]];
    Vector3d normal = (b - a).cross(c - a);
    const double size = normal.norm();
    if (size > 0.0) normal /= size;
    double rise[3], fastest = 0.0;
    for (int k = 0; k < 3; ++k) {
      rise[k] = normal.dot(corner_velocity_[corner[k]]);
      fastest = std::max(fastest, corner_speed_[corner[k]]);
      plane.normal[k] = normal[k];
      plane.lo[k] = std::min({a[k], b[k], c[k]});
      plane.hi[k] = std::max({a[k], b[k], c[k]});
    }
    plane.offset = -normal.dot(a);
    plane.moves = duration * fastest + slack;
    plane.up = duration * std::max({rise[0], rise[1], rise[2]}) + slack;
    plane.down = duration * std::min({rise[0], rise[1], rise[2]}) - slack;
    most_moves_ = std::max(most_moves_, plane.moves);
  }
}

double SurfaceImages::memory_usage() const
{
  return sizeof(SurfaceTriangle) * triangles_.capacity() + sizeof(Plane) * planes_.capacity() +
      sizeof(Image) * images_.capacity() + sizeof(Corner) * corners_.capacity() +
      3 * sizeof(int) * corners_of_.capacity() + 7 * sizeof(double) * corner_at_.capacity();
}
