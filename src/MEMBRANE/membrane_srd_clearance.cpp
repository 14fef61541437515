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

#include "membrane_srd_clearance.h"

#include "membrane_srd_collision.h"

#include <algorithm>
#include <cmath>

namespace Membrane_NS {

using Eigen::Matrix3d;
using Eigen::Vector3d;

static constexpr int MOST_BINS = 64;    // along a direction

/* ---------------------------------------------------------------------- */

// bins are parallel to the box, which in periodic directions they fill

SurfaceClearance::SurfaceClearance(const TriangleMesh &mesh, double distance) :
    mesh_(mesh), distance_(distance), to_fraction_(mesh.lattice.inverse()), lo_(Vector3d::Zero()),
    hi_(Vector3d::Ones())
{
  // corners of a triangle in one piece

  std::vector<std::array<Vector3d, 2>> bounds;
  const Vector3d margin = distance * to_fraction_.rowwise().norm();
  double edges = 0.0;
  for (const Face &face : mesh_.faces) {
    const Vector3d a = mesh_.points[face[0]];
    const Vector3d b = a + mesh_.edge(face[0], face[1]), c = a + mesh_.edge(face[0], face[2]);
    edges += ((b - a).norm() + (c - b).norm() + (a - c).norm()) / (3.0 * mesh_.faces.size());
    const Vector3d fa = to_fraction_ * a, fb = to_fraction_ * b, fc = to_fraction_ * c;
    bounds.push_back(
        {fa.cwiseMin(fb).cwiseMin(fc) - margin, fa.cwiseMax(fb).cwiseMax(fc) + margin});
    for (int k = 0; k < 3; ++k)
      if (!mesh_.periodic[k]) {
        lo_[k] = std::min(lo_[k], bounds.back()[0][k]);
        hi_[k] = std::max(hi_[k], bounds.back()[1][k]);
      }
  }

  const Vector3d widest = (hi_ - lo_).cwiseQuotient(to_fraction_.rowwise().norm());
  for (int k = 0; k < 3; ++k)
    bins_[k] = std::clamp(static_cast<int>(widest[k] / (distance + edges)), 1, MOST_BINS);
  triangles_.resize(static_cast<size_t>(bins_[0]) * bins_[1] * bins_[2]);

  for (size_t f = 0; f < bounds.size(); ++f) {
    std::array<std::vector<int>, 3> reached;
    for (int k = 0; k < 3; ++k) {
      const double scale = bins_[k] / (hi_[k] - lo_[k]);
      const int first = static_cast<int>(std::floor((bounds[f][0][k] - lo_[k]) * scale)),
                last = static_cast<int>(std::floor((bounds[f][1][k] - lo_[k]) * scale));
      for (int i = first; i <= last && i < first + bins_[k]; ++i)
        reached[k].push_back(mesh_.periodic[k] ? (i % bins_[k] + bins_[k]) % bins_[k]
                                               : std::clamp(i, 0, bins_[k] - 1));
    }
    for (int i : reached[0])
      for (int j : reached[1])
        for (int k : reached[2])
          triangles_[(static_cast<size_t>(k) * bins_[1] + j) * bins_[0] + i].push_back(
              static_cast<int>(f));
  }
}

int SurfaceClearance::bin(int k, double fraction) const
{
  if (mesh_.periodic[k]) fraction -= std::floor(fraction);
  const int i = static_cast<int>(std::floor((fraction - lo_[k]) * bins_[k] / (hi_[k] - lo_[k])));
  return std::clamp(i, 0, bins_[k] - 1);
}

bool SurfaceClearance::is_clear(const Vector3d &x) const
{
  const Vector3d s = to_fraction_ * x;
  const int at[3] = {bin(0, s[0]), bin(1, s[1]), bin(2, s[2])};
  for (int f : triangles_[(static_cast<size_t>(at[2]) * bins_[1] + at[1]) * bins_[0] + at[0]]) {
    const Face &face = mesh_.faces[f];
    const Vector3d a = mesh_.points[face[0]], ab = mesh_.edge(face[0], face[1]),
                   ac = mesh_.edge(face[0], face[2]);
    const Vector3d centre = a + (ab + ac) / 3.0;
    const Vector3d d = mesh_.nearest_image(x - centre) + centre - a;
    const auto w = nearest_on_triangle(d, Vector3d::Zero(), ab, ac);
    if ((d - w[1] * ab - w[2] * ac).squaredNorm() < distance_ * distance_) return false;
  }
  return true;
}

}    // namespace Membrane_NS
