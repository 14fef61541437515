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

#ifndef MEMBRANE_TEST_SURFACE_SCENE_H
#define MEMBRANE_TEST_SURFACE_SCENE_H

// What the tests of places on the limit surface share.

#include "membrane_limit_surface.h"
#include "scene.h"

namespace Membrane_TEST {

using Eigen::Vector2d;

/// A mesh with its surface.
struct SurfaceScene {
  TriangleMesh mesh;
  Topology topology;
  LimitSurfaceOfMesh surface;
  explicit SurfaceScene(TriangleMesh m) :
      mesh(std::move(m)), topology(topology_of(mesh)), surface(topology, mesh)
  {
  }
  SurfaceScene(const SurfaceScene &) = delete;

  Vector3d position(const SurfacePoint &p) const { return surface.evaluate<0>(p).position(); }
  /// From one place to another, in the nearest periodic image.
  Vector3d between(const SurfacePoint &a, const SurfacePoint &b) const
  {
    return surface.nearest_image(position(b) - position(a));
  }
};

/// Anywhere on the surface, or with `close`, half of them within 2^-28 to 1 of a corner.
inline SurfacePoint random_point(const Topology &topology, Random &random, bool close = false)
{
  double t[3] = {0.0, random.uniform(), random.uniform()};
  if (t[1] + t[2] > 1.0) {
    t[1] = 1.0 - t[1];
    t[2] = 1.0 - t[2];
  }
  if (close && random.below(2)) {
    const double s = std::pow(2.0, -28.0 * random.uniform());
    t[1] *= s;
    t[2] *= s;
  }
  t[0] = 1.0 - t[1] - t[2];
  const int turn = random.below(3);
  return {random.below(topology.num_faces()), t[(1 + turn) % 3], t[(2 + turn) % 3]};
}

// === Meshes

inline TriangleMesh tilted_sheet(int nx, int ny, double roughness)
{
  Matrix3d lattice;
  lattice << nx, 0.3 * nx, 0.5, 0.0, 0.9 * ny, -0.7, 0.0, 0.0, 9.0;
  TriangleMesh mesh = sheet(nx, ny, lattice, 0.97);    // so that it sticks out of the box
  mesh.lattice = lattice;
  mesh.periodic = {true, true, true};
  return perturbed(mesh, roughness, 21);
}

inline TriangleMesh tilted_tube(double roughness)
{
  Matrix3d lattice;
  lattice << 30.0, 3.0, 2.0, 0.0, 30.0, 1.0, 0.0, 0.0, 12.0;
  TriangleMesh mesh = tube(18, 14, 3.0, lattice, 2);
  mesh.lattice = lattice;
  mesh.periodic = {false, false, true};
  return perturbed(mesh, roughness, 22);
}

/// Edges of length 1 or so; no valence is left out.
inline std::vector<TriangleMesh> rough_meshes()
{
  std::vector<TriangleMesh> meshes = {
      tetrahedron(),
      bipyramid(4),
      icosphere(0, 1.0),
      perturbed(flipped(icosphere(2, 3.0), 200, 12, 1), 0.1, 2),
      perturbed(flipped(torus(16, 8, 3.0, 1.3), 150, 12, 3), 0.05, 4),
      tilted_sheet(8, 8, 0.2),
      tilted_tube(0.1),
      together(icosphere(1, 2.0), torus(12, 6, 3.0, 1.0), {9.0, 0.0, 0.0})};
  for (int n = 3; n <= 20; ++n) meshes.push_back(perturbed(bipyramid(n), 0.1, 5));
  meshes.push_back(perturbed(bipyramid(32), 0.02, 6));
  for (const char *name :
       {"bumpy_icosphere_2", "icosphere_1", "icosphere_2", "octasphere_2", "torus_24x12"})
    meshes.push_back(test_mesh(name));
  return meshes;
}

}    // namespace Membrane_TEST

#endif
