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

// How many points the rules of quadrature take on a mesh, what they err by, and what they cost:
//
//   cmake --build build --target bench_quadrature && build/bench_quadrature MESH.off...
//
// Against careful: bending energy, area, volume, and forces of the bending energy, in their norm; the time of an
// evaluation of forces a control point over that of an icosphere of 2,562 by the same rule, the median of many that take
// turns.

#include "membrane_helfrich.h"
#include "membrane_mesh_file.h"
#include "membrane_mesh_shapes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numeric>

using namespace Membrane_NS;

namespace {

constexpr int RUNS = 101;

double processor_time()
{
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return now.tv_sec + 1e-9 * now.tv_nsec;
}

double median(std::vector<double> values)
{
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

class Evaluation {
 public:
  double bending = 0.0, area = 0.0, volume = 0.0, points = 0.0;    // points of quadrature a face
  std::vector<double> force;

  Evaluation(const TriangleMesh &mesh, PatchRules &rules) :
      x_(mesh.points), topology_(static_cast<int>(mesh.points.size()), mesh.faces)
  {
    std::vector<int> faces(mesh.faces.size());
    std::iota(faces.begin(), faces.end(), 0);
    groups_ = group_faces(topology_, rules, faces);
    model_.resize(count_slots(groups_));
    std::fill(model_.kc.begin(), model_.kc.end(), 1.0);
    FaceIntegrals integrals;
    energies_.bending.resize(model_.kc.size());
    integrals.area = integrals.volume = energies_.bending;
    forces();
    face_integrals(groups_, reinterpret_cast<const double(*)[3]>(x_.data()), model_, integrals);
    for (const FaceGroup &group : groups_) {
      points += group.rule->npoints * static_cast<double>(group.nfaces) / mesh.faces.size();
      for (int slot = group.first_slot; slot < group.first_slot + group.nfaces; ++slot) {
        bending += energies_.bending[slot];
        area += integrals.area[slot];
        volume += integrals.volume[slot];
      }
    }
  }

  /// Seconds that it took.
  double forces()
  {
    force.assign(3 * x_.size(), 0.0);
    const double start = processor_time();
    face_forces(groups_, reinterpret_cast<const double(*)[3]>(x_.data()), model_, {},
                  reinterpret_cast<double(*)[3]>(force.data()), energies_);
    return processor_time() - start;
  }

 private:
  std::vector<Eigen::Vector3d> x_;
  Topology topology_;
  FaceGroups groups_;
  FaceModel model_;
  FaceEnergies energies_;
};

double difference(const std::vector<double> &a, const std::vector<double> &b)
{
  double apart = 0.0, whole = 0.0;
  for (size_t i = 0; i < a.size(); ++i) {
    apart += (a[i] - b[i]) * (a[i] - b[i]);
    whole += b[i] * b[i];
  }
  return std::sqrt(apart / whole);
}

}    // namespace

int main(int narg, char **arg)
{
  PatchRules careful(Quadrature::CAREFUL);
  const TriangleMesh sphere = icosphere(4, 1.0);
  for (int i = 1; i < narg; ++i) {
    const TriangleMesh mesh = read_mesh(arg[i]);
    const Evaluation exact(mesh, careful);
    std::printf("%s: %zu control points\n", arg[i], mesh.points.size());
    std::printf("quadrature  points a face   bending      area    volume    forces   time/icosphere\n");
    for (Quadrature quadrature : {Quadrature::THREE, Quadrature::SIX, Quadrature::TWELVE}) {
      PatchRules rules(quadrature);
      Evaluation here(mesh, rules), regular(sphere, rules);
      std::vector<double> times, regular_times;
      for (int run = 0; run < RUNS; ++run) {
        times.push_back(here.forces() / mesh.points.size());
        regular_times.push_back(regular.forces() / sphere.points.size());
      }
      std::printf("%-10s  %13.2f  %8.1e  %8.1e  %8.1e  %8.1e  %8.2f\n", quadrature_name(quadrature).c_str(), here.points,
                  here.bending / exact.bending - 1.0, here.area / exact.area - 1.0, here.volume / exact.volume - 1.0,
                  difference(here.force, exact.force), median(times) / median(regular_times));
    }
  }
  return 0;
}
