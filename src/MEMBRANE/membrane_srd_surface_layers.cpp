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

#include "membrane_srd_surface_layers.h"

#include "membrane_srd_surface_images.h"

#include <algorithm>
#include <cmath>

using namespace Membrane_NS;
using Eigen::Vector3d;

/* ---------------------------------------------------------------------- */

void SurfaceLayers::build(const SurfaceImages &surface, const std::vector<int> &start,
                          const std::vector<int> &list, std::vector<int> lead)
{
  lead_ = std::move(lead);
  const size_t n = surface.images().size();
  std::vector<int> first(n + 2, 0), cubes(lead_.size());    // cubes by lead
  for (int t : lead_)
    if (t >= 0) ++first[t + 2];
  for (size_t t = 0; t < n; ++t) first[t + 2] += first[t + 1];
  for (size_t c = 0; c < lead_.size(); ++c)
    if (lead_[c] >= 0) cubes[first[lead_[c] + 1]++] = static_cast<int>(c);

  led_.clear();
  led_start_.assign(1, 0);
  std::vector<int> seen(n, -1), seen_corner(surface.num_corners(), -1);
  for (int lead = 0; lead < static_cast<int>(n); ++lead) {
    for (int i = first[lead]; i < first[lead + 1]; ++i)
      for (int j = start[cubes[i]]; j < start[cubes[i] + 1]; ++j) {
        if (seen[list[j]] == lead) continue;
        seen[list[j]] = lead;
        for (int corner : surface.corners_of(list[j])) {
          if (seen_corner[corner] == lead) continue;
          seen_corner[corner] = lead;
          led_.push_back(corner);
        }
      }
    led_start_.push_back(static_cast<int>(led_.size()));
  }
}

void SurfaceLayers::measure(const SurfaceImages &surface)
{
  const size_t num_triangles = surface.images().size();
  layers_.assign(LED + num_triangles, {{0.0, 0.0, 0.0}, INFINITY, -INFINITY});
  layers_[OPEN] = {{0.0, 0.0, 0.0}, -INFINITY, INFINITY};
  for (size_t t = 0; t < num_triangles; ++t) {
    Layer &layer = layers_[LED + t];
    std::copy_n(surface.plane(t).normal, 3, layer.normal);
    for (int j = led_start_[t]; j < led_start_[t + 1]; ++j) {
      const double h = Vector3d::Map(layer.normal).dot(surface.corner_at(led_[j]));
      layer.lo = std::min(layer.lo, h);
      layer.hi = std::max(layer.hi, h);
    }
  }
}

/* ----------------------------------------------------------------------
   By one look at a layer, in vectors. Who may come to triangles that the cube does not know stays,
   and so does what is not a number
------------------------------------------------------------------------- */

int SurfaceLayers::keep_passing(const double *x, const double *velocity, const int *cubes,
                                double time, double margin, double listed, int *which, int n) const
{
  int stays[BLOCK];
  const double spare = std::max(0.0, listed - margin), most = spare * spare / (time * time);
  const Layer *layers = layers_.data();
  const int *lead = lead_.data();
#pragma GCC ivdep
  for (int j = 0; j < n; ++j) {
    const int i = which[j], cube = cubes[i];
    const double *at = x + 3 * i, *v = velocity + 3 * i;
    const Layer &layer = layers[cube < 0 ? OPEN : EMPTY + 1 + lead[cube < 0 ? 0 : cube]];
    const double a = layer.normal[0] * at[0] + layer.normal[1] * at[1] + layer.normal[2] * at[2];
    const double b =
        a + time * (layer.normal[0] * v[0] + layer.normal[1] * v[1] + layer.normal[2] * v[2]);
    const double low = a < b ? a : b, high = a < b ? b : a;
    const bool passes_by = (low > layer.hi + margin) | (high < layer.lo - margin);
    const bool knows_all = v[0] * v[0] + v[1] * v[1] + v[2] * v[2] < most;
    stays[j] = !(passes_by & knows_all);
  }
  int kept = 0;
  for (int j = 0; j < n; ++j) {
    which[kept] = which[j];
    kept += stays[j];
  }
  return kept;
}

double SurfaceLayers::memory_usage() const
{
  return sizeof(int) * (lead_.capacity() + led_start_.capacity() + led_.capacity()) +
      sizeof(Layer) * layers_.capacity();
}
