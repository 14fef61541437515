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

// What leaflets cost beside bending alone, in processor time:
//
//   cmake --build build --target bench_leaflets && build/bench_leaflets
//
// One evaluation of energy and forces of a sphere of 2,562 control points, in nanoseconds a face, and its ratio to
// that of bending; the best of many runs, which take turns.

#include "membrane_helfrich.h"
#include "membrane_mesh_shapes.h"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <numeric>

using namespace Membrane_NS;

namespace {

constexpr int RUNS = 400;

double processor_time()
{
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * now.tv_sec + now.tv_nsec;
}

}    // namespace

int main()
{
  const TriangleMesh mesh = icosphere(4, 1.0);
  const Topology topology(static_cast<int>(mesh.points.size()), mesh.faces);
  std::vector<int> faces(mesh.faces.size());
  std::iota(faces.begin(), faces.end(), 0);
  const auto x = reinterpret_cast<const double(*)[3]>(mesh.points.data());
  std::vector<double> force(3 * mesh.points.size());
  const auto f = reinterpret_cast<double(*)[3]>(force.data());

  std::printf("quadrature  bending  with kg  leaflets  ratios\n");
  for (Quadrature quadrature : {Quadrature::THREE, Quadrature::SIX, Quadrature::TWELVE}) {
    PatchRules rules(quadrature);
    FaceGroups groups = group_faces(topology, rules, faces);
    FaceModel model;
    model.resize(count_slots(groups));
    std::fill(model.kc.begin(), model.kc.end(), 1.0);
    model.leaflet.assign(model.kc.size(), 0.05);
    model.outer = model.inner = model.c0;
    FaceEnergies energies;
    FaceTerms terms[3];
    terms[1].gauss = terms[2].leaflets = true;
    double best[3] = {1e300, 1e300, 1e300};
    for (int run = 0; run < RUNS; ++run)
      for (int kind = 0; kind < 3; ++kind) {
        energies.leaflet_bend.resize(kind == 2 ? model.kc.size() : 0);
        const double start = processor_time();
        face_forces(groups, x, model, terms[kind], f, energies);
        best[kind] = std::min(best[kind], (processor_time() - start) / faces.size());
      }
    std::printf("%-10s  %7.1f  %7.1f  %8.1f  %.3f %.3f\n", quadrature_name(quadrature).c_str(), best[0], best[1], best[2],
                best[1] / best[0], best[2] / best[0]);
  }
  return 0;
}
