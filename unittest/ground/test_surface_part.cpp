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

#include "how_many.h"
#include "membrane_mesh_shapes.h"
#include "membrane_srd_corners.h"
#include "membrane_srd_events.h"
#include "membrane_srd_image_finder.h"
#include "membrane_srd_inverse_mask.h"
#include "membrane_srd_surface_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace Membrane_NS;
using namespace Membrane_TEST;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// A sphere of which a part has the triangles above a height, and the masses that these need.
struct Scene {
  TriangleMesh mesh = icosphere(3, 1.0);
  Topology topology{(int) mesh.points.size(), mesh.faces};
  SurfaceCorners whole;
  std::vector<Face> faces;              // of the part, in numbers of the whole
  std::vector<int> masses, corners;     // of the part
  std::vector<double> inverse_masses;

  explicit Scene(int n, double height) : whole(topology, n)
  {
    std::vector<char> has_mass(topology.num_vertices(), 0), has_corner(whole.count(), 0);
    for (size_t t = 0; t < whole.triangles().size(); ++t) {
      const Face &face = mesh.faces[t / (n * n)];
      if (mesh.points[face[0]][2] < height) continue;
      faces.push_back(whole.triangles()[t]);
      for (int c : faces.back()) {
        has_corner[c] = 1;
        for (const auto &entry : whole.masses_of(c)) has_mass[entry.first] = 1;
      }
    }
    for (int a = 0; a < topology.num_vertices(); ++a)
      if (has_mass[a]) masses.push_back(a);
    for (int c = whole.num_masses(); c < whole.count(); ++c)
      if (has_corner[c]) corners.push_back(c);
    for (int a = 0; a < topology.num_vertices(); ++a) inverse_masses.push_back(0.1 + 0.01 * (a % 7));
  }
  int number(int vertex) const    // in the part, or -1
  {
    const auto &list = vertex < whole.num_masses() ? masses : corners;
    const auto at = std::lower_bound(list.begin(), list.end(), vertex);
    if (at == list.end() || *at != vertex) return -1;
    return (int) (at - list.begin()) + (&list == &corners ? (int) masses.size() : 0);
  }
};

/// What an impulse from elsewhere changes.
std::vector<SurfaceChange> changes(const SurfaceCorners *corners, std::vector<double> inverse_masses,
                                   int num_vertices, const SurfaceImpulse &impulse)
{
  std::vector<SurfaceVertex> vertices(num_vertices, {{Vector3d::Zero(), Vector3d::Zero()}});
  for (size_t a = 0; a < inverse_masses.size(); ++a) vertices[a].inverse_mass = inverse_masses[a];
  CollisionEvents::Settings settings;
  if (corners) {
    settings.corners = corners;
    settings.inverse_masses = &inverse_masses;
  }
  CollisionEvents events(settings);
  const std::vector<SurfaceTriangle> none;
  events.begin(vertices, none, 1.0, 10.0);
  EXPECT_EQ(events.run({impulse}), CollisionEvents::Outcome::DONE);
  return events.changes();
}

}    // namespace

TEST(SurfacePart, HasTheRowsOfTheWholeSurface)
{
  for (int n : {2, SANITIZED ? 3 : 4}) {
    const Scene scene(n, 0.8);
    const SurfaceCorners part(scene.whole, scene.masses, scene.corners);
    ASSERT_LT((int) scene.masses.size(), 2 * scene.topology.num_vertices() / 3);
    ASSERT_EQ(part.num_masses(), (int) scene.masses.size());
    ASSERT_EQ(part.count(), (int) (scene.masses.size() + scene.corners.size()));
    for (int c : scene.corners) {
      std::vector<SurfaceCorners::Entry> expected;
      for (const auto &[a, g] : scene.whole.masses_of(c)) expected.emplace_back(scene.number(a), g);
      const auto row = part.masses_of(scene.number(c));
      EXPECT_EQ(std::vector<SurfaceCorners::Entry>(row.begin(), row.end()), expected);
    }
    for (int a = 0; a < part.num_masses(); ++a)
      for (const auto &[c, g] : part.corners_of(a)) {
        ASSERT_LT(c, part.count());
        const auto row = part.masses_of(c);
        EXPECT_NE(std::find(row.begin(), row.end(), SurfaceCorners::Entry(a, g)), row.end());
      }
  }
}

TEST(SurfacePart, TakesItsShareOfAnImpulseElsewhere)
{
  // on triangles of the whole surface of whose corners the part has all, some or none

  for (int n : {1, 2}) {
    const Scene scene(n, 0.8);
    SurfaceCorners part(scene.whole, scene.masses, scene.corners);
    const int in_part = part.count();
    std::vector<double> inverse_masses;
    for (int a : scene.masses) inverse_masses.push_back(scene.inverse_masses[a]);
    int none = 0, some = 0, all = 0;
    for (size_t t = 0; t < scene.whole.triangles().size(); t += 5) {
      const Face &face = scene.whole.triangles()[t];
      SurfaceImpulse impulse = {0.25, 1, face, {0.2, 0.3, 0.5}, Vector3d(1.0, -2.0, 0.5), -1};
      const auto expected = changes(n > 1 ? &scene.whole : nullptr, scene.inverse_masses,
                                    scene.whole.count(), impulse);
      int has = 0;
      for (int &v : impulse.vertex) {
        const int known = scene.number(v);
        has += known >= 0;
        v = known < 0 && v >= scene.whole.num_masses() ? part.add(scene.whole, scene.masses, v) : known;
      }
      ++(has == 3 ? all : has == 0 ? none : some);
      const auto found = changes(n > 1 ? &part : nullptr, inverse_masses, in_part, impulse);
      for (size_t a = 0; a < scene.masses.size(); ++a) {
        EXPECT_EQ(found[a].velocity, expected[scene.masses[a]].velocity);
        EXPECT_EQ(found[a].position, expected[scene.masses[a]].position);
      }
    }
    EXPECT_GT(std::min({none, some, all}), 3);
  }
}

TEST(SurfacePart, HasRowsOfTheInverseMaskInItsNumbers)
{
  const Scene scene(1, -2.0);
  InverseMask plain(scene.topology), other(scene.topology);
  std::vector<int> backwards;
  for (int v = scene.topology.num_vertices(); v-- > 0;) backwards.push_back(v);
  other.row(0);
  other.renumber(backwards);
  for (int v : {0, 17, scene.topology.num_vertices() - 1}) {
    const auto expected = plain.row(v);
    const auto &row = other.row(scene.topology.num_vertices() - 1 - v);
    ASSERT_EQ(row.weight, expected.weight);
    for (size_t i = 0; i < row.vertex.size(); ++i) EXPECT_EQ(backwards[row.vertex[i]], expected.vertex[i]);
  }
}

TEST(SurfacePart, OfItsRegionIsAllThatAGridNeeds)
{
  // a sphere that reaches through the sides of the box, which is a tilted one: a grid of a corner of
  // the box knows the same triangles of the surface and of those that come into its region

  Matrix3d lattice;
  lattice << 3.0, 0.4, -0.3, 0.0, 2.6, 0.5, 0.0, 0.0, 2.8;
  const TriangleMesh mesh = icosphere(2, 1.1);
  std::vector<SurfaceVertex> vertices;
  for (const Vector3d &x : mesh.points) vertices.push_back({{x + Vector3d(2.9, 0.2, 0.1), Vector3d::Zero()}, 1.0});
  const SurfaceFaces surface = {mesh.faces, {}};
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  size_t fewest = mesh.faces.size();
  for (int trial = 0; trial < 30; ++trial) {
    const Vector3d lo = lattice * Vector3d(uniform(engine), uniform(engine), uniform(engine)),
                   hi = lo + 0.6 * Vector3d(uniform(engine), uniform(engine), uniform(engine));
    SurfaceGrid grid, of_part;
    for (SurfaceGrid *g : {&grid, &of_part}) g->cut(lo, hi, {0.05, 0.1, 0.15});
    grid.build(surface, vertices, lattice, {true, true, true});
    const ImageFinder region(lattice, {true, true, true}, grid.region_lo(), grid.region_hi());
    SurfaceFaces part;
    std::vector<int> whole_face;
    for (size_t f = 0; f < surface.faces.size(); ++f)
      if (region.any(corners_together(surface, f, vertices, lattice))) {
        part.faces.push_back(surface.faces[f]);
        whole_face.push_back((int) f);
      }
    of_part.build(part, vertices, lattice, {true, true, true});
    auto images = of_part.images();
    for (auto &image : images) image.face = whole_face[image.face];
    EXPECT_EQ(images, grid.images());
    fewest = std::min(fewest, part.faces.size());
  }
  EXPECT_LT(fewest, mesh.faces.size() / 4);
}
