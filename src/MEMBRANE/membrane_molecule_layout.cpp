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

#include "membrane_molecule_layout.h"

#include "membrane_closest_point.h"
#include "membrane_molecule_grid.h"

#include <algorithm>
#include <cmath>

using namespace Membrane_NS;
using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

static constexpr double PATCH_SHARE = 0.8;     // of the patch's edge: the largest distance of charts
static constexpr double SHARPEST = 0.05;       // of the area may be curved more than the distance allows
static constexpr double LEAST_SPACING = 20.0;  // Angstrom: no charts of less than a few lipids
static constexpr double HEXAGON = 0.866;       // area of a chart over the distance squared
static constexpr int SPREADING = 60;           // steps
static constexpr double STRIDE = 8.0;          // Angstrom: of a geodesic
static constexpr double SEAMLESS = 0.02;       // Angstrom: of a side, to be a multiple
enum { CENTRES = 1, COVERAGE, CHART };         // labels of random numbers

namespace {

/// Chart centres and their common random choices.
struct Chart {
  SurfacePoint point;
  double turn;
  Vector2d offset;    // in sides of the patch
};

/* ----------------------------------------------------------------------
   Evenly spread: random places that repel one another
------------------------------------------------------------------------- */

std::vector<ParallelPlace> spread(const ParallelSurfaces &surfaces, int number, double distance,
                                  const CounterRandom &random)
{
  const LimitSurface &surface = surfaces.surface();
  std::vector<ParallelPlace> places = surfaces.random(number, 0.0, random, CENTRES);
  BeadGrid grid(surface.lattice(), surface.periodic());
  std::vector<Vector3d> x(number);
  for (int step = 0; step < SPREADING; ++step) {
    for (int i = 0; i < number; ++i) x[i] = places[i].x;
    grid.fill(x, distance);
    for (int i = 0; i < number; ++i) {
      Vector3d push = Vector3d::Zero();
      grid.near(x[i], [&](int j, const Vector3d &d, double d2) {
        if (j != i && d2 > 0.0) push -= 0.25 * (distance / std::sqrt(d2) - 1.0) * d;
      });
      const double length = push.norm(), most = 0.2 * distance;
      if (length > most) push *= most / length;
      if (length > 0.0) places[i] = surfaces.project(x[i] + push, places[i].point, 0.0);
    }
  }
  return places;
}

/* ----------------------------------------------------------------------
   On the surface at one height: charts know which places are theirs
------------------------------------------------------------------------- */

class Leaf {
 public:
  Leaf(const ParallelSurfaces &surfaces, const std::vector<Chart> &charts, double height, double distance,
       const CounterRandom &random);

  const ParallelPlace &centre(int chart) const { return centres_[chart]; }
  /// No place of a chart is further from its centre, along the surface.
  double reach() const { return reach_; }
  bool owns(int chart, const ParallelPlace &place) const;

 private:
  std::vector<ParallelPlace> centres_;
  BeadGrid grid_;
  double reach_;
};

Leaf::Leaf(const ParallelSurfaces &surfaces, const std::vector<Chart> &charts, double height, double distance,
           const CounterRandom &random) :
    grid_(surfaces.surface().lattice(), surfaces.surface().periodic())
{
  std::vector<Vector3d> x;
  for (const Chart &chart : charts) {
    centres_.push_back(surfaces.lift(chart.point, height));
    x.push_back(centres_.back().x);
  }

  // how far places are from the nearest centre

  const double stretch = std::sqrt(std::max(surfaces.area(height) / surfaces.area(0.0), 0.25));
  double cutoff = 2.0 * distance * std::max(1.0, stretch), furthest = 0.0;
  grid_.fill(x, cutoff);
  const int samples = std::min(20000, 40 * static_cast<int>(charts.size()));
  for (const ParallelPlace &place : surfaces.random(samples, height, random, COVERAGE)) {
    double nearest = cutoff * cutoff;
    grid_.near(place.x, [&](int, const Vector3d &, double d2) { nearest = std::min(nearest, d2); });
    furthest = std::max(furthest, std::sqrt(nearest));
  }
  reach_ = 1.15 * furthest + STRIDE;
  grid_.fill(x, reach_);
}

bool Leaf::owns(int chart, const ParallelPlace &place) const
{
  const double own = (place.x - centres_[chart].x).squaredNorm();
  bool nearest = true;
  grid_.near(place.x, [&](int j, const Vector3d &, double d2) {
    if (d2 < own * (1.0 - 1.0e-12) && centres_[j].normal.dot(place.normal) > 0.0) nearest = false;
  });
  return nearest;
}

/* ----------------------------------------------------------------------
   A geodesic of a parallel surface: straight strides, each brought back to the surface with the directions
   turned into its tangent plane. On a sphere of radius R a stride s covers R atan(s/R).
------------------------------------------------------------------------- */

void go(const ParallelSurfaces &surfaces, double height, Vector3d direction, double length, ParallelPlace &place,
        Vector3d &along)
{
  const int strides = std::max(1, static_cast<int>(std::ceil(length / STRIDE)));
  for (int k = 0; k < strides; ++k) {
    place = surfaces.project(place.x + direction * (length / strides), place.point, height);
    direction = (direction - place.normal * place.normal.dot(direction)).normalized();
    along = (along - place.normal * place.normal.dot(along)).normalized();
  }
}

Vector3d any_tangent(const Vector3d &normal)
{
  const Vector3d axis = std::fabs(normal[0]) < 0.6 ? Vector3d::UnitX() : Vector3d::UnitY();
  return (axis - normal * normal.dot(axis)).normalized();
}

void fill_chart(const ParallelSurfaces &surfaces, const Leaf &leaf, int leaflet, const Patch &patch, int number,
                const Chart &chart, std::vector<LipidSite> &sites)
{
  const double height = sign_of(leaflet) * patch.neutral[leaflet], reach = leaf.reach();
  const ParallelPlace &centre = leaf.centre(number);
  const Vector3d first = any_tangent(centre.normal), second = centre.normal.cross(first);
  const Vector3d ex = std::cos(chart.turn) * first + std::sin(chart.turn) * second, ey = centre.normal.cross(ex);
  const Matrix2d inverse = patch.cell.inverse();
  const Vector2d origin = patch.cell * chart.offset;
  int images[2];
  for (int k = 0; k < 2; ++k) images[k] = static_cast<int>(std::ceil(reach * inverse.row(k).norm())) + 1;

  for (size_t i = 0; i < patch.conformers[leaflet].size(); ++i) {
    const Vector2d from = patch.centres[leaflet][i] - origin, fraction = inverse * from;
    const Vector2d base = from - patch.cell * Vector2d(std::floor(fraction[0]), std::floor(fraction[1]));
    for (int a = -images[0]; a <= images[0]; ++a)
      for (int b = -images[1]; b <= images[1]; ++b) {
        const Vector2d uv = base + patch.cell * Vector2d(a, b);
        const double length = uv.norm();
        if (length > reach) continue;
        ParallelPlace place = centre;
        Vector3d along = ex;
        if (length > 0.0) go(surfaces, height, (ex * uv[0] + ey * uv[1]) / length, length, place, along);
        if (!leaf.owns(number, place)) continue;
        sites.push_back({place.point, place.x, place.normal, along, patch.conformers[leaflet][i], leaflet});
      }
  }
}

/* ----------------------------------------------------------------------
   Copies of the patch on a plane: its sides as multiples of the patch's, M = cell^-1 sides, in the plane's
   own axes
------------------------------------------------------------------------- */

bool is_multiple(const Matrix2d &cell, const Matrix2d &sides, int *copies)
{
  const Matrix2d multiple = cell.inverse() * sides;
  const Matrix2d whole = multiple.array().round();
  if ((cell * (multiple - whole)).norm() > SEAMLESS || whole(0, 1) != 0.0 || whole(1, 0) != 0.0) return false;
  for (int k = 0; k < 2; ++k) copies[k] = static_cast<int>(whole(k, k));
  return copies[0] != 0 && copies[1] != 0;
}

bool tile(const ParallelSurfaces &surfaces, const LeafletPatches &patches, std::vector<LipidSite> &sites)
{
  const LimitSurface &surface = surfaces.surface();
  Vector3d normal;
  if (!surfaces.is_plane(normal)) return false;
  int out = -1;    // the box vector across the plane
  for (int k = 0; k < 3; ++k)
    if (normal.cross(surface.lattice().col((k + 1) % 3).cross(surface.lattice().col((k + 2) % 3)).normalized()).norm() <
        1.0e-6)
      out = k;
  if (out < 0) return false;
  const Vector3d a = surface.lattice().col(out == 0 ? 1 : 0), b = surface.lattice().col(out == 2 ? 1 : 2);
  const Vector3d ex = a.normalized(), ey = normal.cross(ex);
  Matrix2d sides;
  sides << a.dot(ex), b.dot(ex), a.dot(ey), b.dot(ey);
  int copies[2];
  for (const Patch *patch : patches)
    if (!is_multiple(patch->cell, sides, copies)) return false;

  const ParallelPlace start = surfaces.lift({surfaces.faces()[0]}, 0.0);
  const ClosestPointFinder finder(surface);
  for (int leaflet = 0; leaflet < LEAFLETS; ++leaflet) {
    const Patch &patch = *patches[leaflet];
    is_multiple(patch.cell, sides, copies);
    const double height = sign_of(leaflet) * patch.neutral[leaflet];
    for (int i = 0; i < std::abs(copies[0]); ++i)
      for (int j = 0; j < std::abs(copies[1]); ++j)
        for (size_t k = 0; k < patch.conformers[leaflet].size(); ++k) {
          const Vector2d uv = patch.centres[leaflet][k] + patch.cell * Vector2d(i, j);
          const Vector3d on_plane = ex * uv[0] + ey * uv[1] + normal * normal.dot(start.x);
          sites.push_back({finder.find(on_plane).point, on_plane + height * normal, normal, ex, patch.conformers[leaflet][k], leaflet});
        }
  }
  return true;
}

}    // namespace

/* ---------------------------------------------------------------------- */

std::vector<LipidSite> Membrane_NS::lay_out(const ParallelSurfaces &surfaces, const LeafletPatches &patches,
                                            const CounterRandom &random, Team &team, bool &exact)
{
  std::vector<LipidSite> sites;
  exact = tile(surfaces, patches, sites);
  if (exact) return sites;

  const double edge = std::min(patches[OUTER]->edge(), patches[INNER]->edge());
  const double distance = std::max(LEAST_SPACING, std::min(PATCH_SHARE * edge, surfaces.radius(SHARPEST)));
  const int number = std::max(4, static_cast<int>(std::lround(surfaces.area(0.0) / (HEXAGON * distance * distance))));
  std::vector<Chart> charts;
  for (const ParallelPlace &place : spread(surfaces, number, 1.1 * distance, random)) {
    const auto a = random.uniforms(charts.size(), CHART), b = random.uniforms(charts.size(), CHART + 1);
    charts.push_back({place.point, 2.0 * M_PI * a[0], {b[0], b[1]}});
  }
  for (int leaflet = 0; leaflet < LEAFLETS; ++leaflet) {
    const Patch &patch = *patches[leaflet];
    const Leaf leaf(surfaces, charts, sign_of(leaflet) * patch.neutral[leaflet], distance, random);
    const auto [first, last] = team.part(number);
    std::vector<LipidSite> mine;
    for (int k = first; k < last; ++k) fill_chart(surfaces, leaf, leaflet, patch, k, charts[k], mine);
    mine = concatenate(team, mine);
    sites.insert(sites.end(), mine.begin(), mine.end());
  }
  return sites;
}
