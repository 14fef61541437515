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

// What the curvature coupling of bound particles costs, in processor time:
//
//   cmake --build build --target bench_footprint && build/bench_footprint
//
// A row for each mesh and rule, in microseconds a particle: one particle on a surface that has moved, and
// one for every ten and four for every ten vertices, which share what is known of faces. The best of twenty
// runs. The last column is the error of 2Hbar, against the rule with twelve points.

#include "membrane_footprint.h"
#include "membrane_mesh_shapes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <random>

using namespace Membrane_NS;
using Eigen::Vector3d;

namespace {

constexpr int RUNS = 20;
constexpr double RADIUS = 1.5;    // mean edges

double processor_time()
{
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return t.tv_sec + 1.0e-9 * t.tv_nsec;
}

struct Particle {
  SurfacePoint foot;
  Vector3d x;
  Director director;
};

double checksum = 0.0;    // so that nothing is left out

// microseconds a particle, `together` of them at a time

double cost(Footprints &footprints, const CurvatureCoupling &kind,
            const std::vector<Particle> &particles, size_t together, std::vector<Vector3d> &force)
{
  double best = INFINITY;
  const size_t number = std::max<size_t>(together, 200);
  for (int run = 0; run < RUNS; ++run) {
    const double before = processor_time();
    for (size_t i = 0; i < number; ++i) {
      if (i % together == 0) footprints.update();
      const Particle &p = particles[i % particles.size()];
      checksum += footprints.add(kind, p.x, p.foot, p.director).energy;
      if ((i + 1) % together == 0) checksum += footprints.take_forces(force).trace();
    }
    best = std::min(best, (processor_time() - before) / number * 1.0e6);
  }
  return best;
}

void measure(const char *title, TriangleMesh mesh)
{
  std::mt19937 engine(1);
  auto random = [&engine] {
    return engine() / 4294967296.0;
  };
  const Topology topology(static_cast<int>(mesh.points.size()), mesh.faces);
  const double roughness = 0.05 * mesh.edge(mesh.faces[0][0], mesh.faces[0][1]).norm();
  for (Vector3d &p : mesh.points)
    for (int k = 0; k < 3; ++k) p[k] += roughness * (2.0 * random() - 1.0);
  const LimitSurfaceOfMesh surface(topology, mesh);
  std::vector<Particle> particles;
  for (int i = 0; i < topology.num_vertices(); ++i) {
    const double u = random(), v = random() * (1.0 - u);
    const SurfacePoint foot = {static_cast<int>(random() * topology.num_faces()), u, v};
    particles.push_back({foot,
                         surface.evaluate<0>(foot).position(),
                         {surface.evaluate<1>(foot).du(), Vector3d::Zero()}});
  }
  PatchRules fine(Quadrature::TWELVE);
  Footprints reference(surface, fine);
  const double radius = RADIUS * surface.mean_edge();
  std::vector<Vector3d> force(topology.num_vertices(), Vector3d::Zero());
  std::printf("%s\n", title);
  for (Quadrature quadrature : {Quadrature::ONE, Quadrature::THREE, Quadrature::SIX}) {
    Footprints footprints(surface, quadrature);
    double error = 0.0, size = 0.0;
    for (const Particle &p : particles) {
      const double good = reference.average(p.x, p.foot, radius).curvature;
      error += std::pow(footprints.average(p.x, p.foot, radius).curvature - good, 2);
      size += good * good;
    }
    for (bool directed : {false, true}) {
      CurvatureCoupling kind;
      kind.area = kind.kc = kind.kp = kind.c0p = 1.0;
      kind.radius = radius;
      if (directed) kind.k_par = kind.c_par = 1.0;
      const size_t all = particles.size();
      std::printf(
          "  rule %-2s %-14s  one %7.2f   many %7.2f %7.2f us   error of 2Hbar %.1e of its rms\n",
          quadrature_name(quadrature).c_str(), directed ? "with director" : "isotropic",
          cost(footprints, kind, particles, 1, force),
          cost(footprints, kind, particles, all / 10, force),
          cost(footprints, kind, particles, all * 4 / 10, force), std::sqrt(error / size));
    }
  }
}

}    // namespace

int main()
{
  measure("regular faces: a torus of 2048 points", torus(64, 32, 6.0, 2.6));
  measure("a sphere of 2562 points, twelve of valence 5", icosphere(4, 8.0));
  return checksum == 0.123;
}
