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

// What places on the limit surface cost, in processor time:
//
//   cmake --build build --target bench_surface_point && build/bench_surface_point
//
// A row for each kind of face, places in random order as particles would be; the best of fifty
// runs and the worst, which tells how quiet the machine was.

#include "membrane_closest_point.h"
#include "membrane_mesh_shapes.h"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <random>

using namespace Membrane_NS;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr int PLACES = 4000, RUNS = 50;

double processor_time()
{
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return t.tv_sec + 1.0e-9 * t.tv_nsec;
}

double checksum = 0.0;    // so that nothing is left out

template <class Work> void measure(const char *what, Work &&work)
{
  double best = INFINITY, worst = 0.0;
  for (int run = 0; run < RUNS; ++run) {
    const double before = processor_time();
    for (int i = 0; i < PLACES; ++i) checksum += work(i);
    const double each = (processor_time() - before) / PLACES * 1.0e6;
    best = std::min(best, each);
    worst = std::max(worst, each);
  }
  std::printf("  %-52s %.3f us (to %.3f)\n", what, best, worst);
}

struct Place {
  SurfacePoint point, start;
  Vector2d step;
  Vector3d x;
};

std::vector<Place> random_places(const LimitSurface &surface, bool regular)
{
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const Topology &topology = surface.topology();
  std::vector<int> faces;
  for (int f = 0; f < topology.num_faces(); ++f)
    if (topology.is_regular(f) == regular) faces.push_back(f);
  std::vector<Place> places;
  while (static_cast<int>(places.size()) < PLACES) {
    Place place;
    double u = uniform(engine), v = uniform(engine);
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    place.point = {faces[engine() % faces.size()], u, v};
    place.step = Vector2d(uniform(engine) - 0.5, uniform(engine) - 0.5) * 0.04;
    place.start = walk(topology, place.point, place.step).end;
    const SurfaceJet jet = surface.evaluate<1>(place.point);
    place.x = jet.position() + 0.1 * surface.mean_edge() * (uniform(engine) - 0.5) * jet.normal();
    places.push_back(place);
  }
  return places;
}

void measure_faces(const char *title, const TriangleMesh &mesh, bool regular)
{
  const Topology topology(static_cast<int>(mesh.points.size()), mesh.faces);
  const LimitSurfaceOfMesh surface(topology, mesh);
  ClosestPointFinder finder(surface);
  const std::vector<Place> places = random_places(surface, regular);
  std::printf("%s\n", title);
  measure("position", [&](int i) {
    return surface.evaluate<0>(places[i].point).position()[0];
  });
  measure("first derivatives", [&](int i) {
    return surface.evaluate<1>(places[i].point).du()[0];
  });
  measure("second derivatives", [&](int i) {
    return surface.evaluate<2>(places[i].point).row(Derivative::DUV)[0];
  });
  measure("third derivatives", [&](int i) {
    return surface.evaluate<3>(places[i].point).row(Derivative::DUVV)[0];
  });
  measure("normal, H and K", [&](int i) {
    return surface.evaluate<2>(places[i].point).limit_point().mean_curvature;
  });
  SurfaceWeights weights;
  measure("weights", [&](int i) {
    surface.weights<0>(places[i].point, weights);
    return weights(0, 0);
  });
  measure("weights and their second derivatives", [&](int i) {
    surface.weights<2>(places[i].point, weights);
    return weights(0, 0);
  });
  measure("LimitBasis::evaluate, for comparison", [&](int i) {
    if (i % 16) return 0.0;
    const SurfacePoint &p = places[i].point;
    return 16.0 * LimitBasis(topology.valences(p.face)).evaluate(p.u, p.v)(0, 0);
  });
  measure("walk within a face or to the next", [&](int i) {
    return walk(topology, places[i].point, 5.0 * places[i].step).end.u;
  });
  measure("walk of 3 edges", [&](int i) {
    return walk(topology, places[i].point, 100.0 * places[i].step).end.u;
  });
  long evaluations = 0;
  for (double near : {0.02, 0.002})
    for (double tolerance : {1.0e-6, 1.0e-9}) {
      evaluations = 0;
      char what[80];
      std::snprintf(what, sizeof what, "closest point to %.0e edges, start %g away", tolerance,
                    near);
      measure(what, [&](int i) {
        const Vector2d step = places[i].step * (near / 0.02);
        const SurfacePoint start = walk(topology, places[i].point, step).end;
        const ClosestPoint found =
            closest_point(surface, places[i].x, start, tolerance * surface.mean_edge());
        evaluations += found.evaluations;
        return found.distance;
      });
      std::printf("    evaluations: %.2f\n", evaluations / double(PLACES) / RUNS);
    }
  measure("closest point, nothing known", [&](int i) {
    return finder.find(places[i].x).distance;
  });
  const double before = processor_time();
  finder.update();
  std::printf("  %-52s %.3f us a face\n", "samples taken anew",
              (processor_time() - before) / topology.num_faces() * 1.0e6);
}

}    // namespace

int main()
{
  const TriangleMesh sphere = icosphere(4, 14.0);
  measure_faces("Regular faces", sphere, true);
  measure_faces("Faces with one corner of valence 5", sphere, false);
  measure_faces("Faces with three corners of valence 5", icosphere(0, 1.0), false);
  std::printf("(%g)\n", checksum);
  return 0;
}
