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

#ifndef MEMBRANE_TEST_SCENE_H
#define MEMBRANE_TEST_SCENE_H

// What the ground floor's tests share: meshes to test on, and a Scene that evaluates one as the
// pair style does, periodic images becoming ghost points with indices of their own.

#include "how_many.h"
#include "membrane_helfrich.h"
#include "membrane_mesh_file.h"
#include "membrane_mesh_shapes.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace Membrane_TEST {

using namespace Membrane_NS;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr double PI = 3.14159265358979323846;
constexpr Quadrature ALL_QUADRATURES[] = {Quadrature::ONE, Quadrature::THREE, Quadrature::SIX,
                                          Quadrature::TWELVE, Quadrature::CAREFUL};

inline std::string name(Quadrature quadrature)
{
  static const std::map<Quadrature, std::string> names = {{Quadrature::ONE, "one"},
                                                          {Quadrature::THREE, "three"},
                                                          {Quadrature::SIX, "six"},
                                                          {Quadrature::TWELVE, "twelve"},
                                                          {Quadrature::CAREFUL, "careful"}};
  return names.at(quadrature);
}

inline std::string scientific(double number)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.2e", number);
  return text;
}

/// The same numbers on every machine.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform() { return engine_() / 4294967296.0; }           ///< [0, 1)
  double symmetric() { return 2.0 * uniform() - 1.0; }            ///< [-1, 1)
  int below(int n) { return static_cast<int>(n * uniform()); }    ///< 0..n-1
  Vector3d vector()
  {
    const double x = symmetric(), y = symmetric(), z = symmetric();
    return {x, y, z};
  }

 private:
  std::mt19937 engine_;
};

// === Meshes

inline Topology topology_of(const TriangleMesh &mesh)
{
  return Topology(static_cast<int>(mesh.points.size()), mesh.faces);
}

/// One of the reference meshes; the environment says in which folder they are.
inline TriangleMesh test_mesh(const std::string &name)
{
  const char *folder = std::getenv("REFERENCE");
  if (!folder) throw MeshError("set REFERENCE to the folder of reference meshes");
  return read_mesh(std::string(folder) + "/" + name + ".off");
}

inline TriangleMesh tetrahedron()
{
  TriangleMesh mesh;
  mesh.points = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  mesh.faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  return mesh;
}

/// Two apexes of valence n over a rim of n vertices of valence 4; n = 4 is the octahedron.
inline TriangleMesh bipyramid(int n)
{
  TriangleMesh mesh;
  for (int i = 0; i < n; ++i)
    mesh.points.emplace_back(std::cos(2.0 * PI * i / n), std::sin(2.0 * PI * i / n), 0.0);
  mesh.points.emplace_back(0.0, 0.0, 1.0);
  mesh.points.emplace_back(0.0, 0.0, -1.0);
  for (int i = 0; i < n; ++i) {
    mesh.faces.push_back({n, i, (i + 1) % n});
    mesh.faces.push_back({n + 1, (i + 1) % n, i});
  }
  return mesh;
}

inline TriangleMesh perturbed(TriangleMesh mesh, double amplitude, unsigned seed)
{
  Random random(seed);
  for (Vector3d &p : mesh.points) p += amplitude * random.vector();
  return mesh;
}

/// Both meshes, the second moved by `shift`.
inline TriangleMesh together(TriangleMesh mesh, const TriangleMesh &other, const Vector3d &shift)
{
  const int start = static_cast<int>(mesh.points.size());
  for (const Vector3d &p : other.points) mesh.points.push_back(p + shift);
  for (const Face &face : other.faces)
    mesh.faces.push_back({start + face[0], start + face[1], start + face[2]});
  return mesh;
}

/// Flip random edges, keeping the mesh valid and its valences within 3..most.
inline TriangleMesh flipped(TriangleMesh mesh, int flips, int most, unsigned seed)
{
  Random random(seed);
  for (int done = 0, tries = 0; done < flips && tries < 100 * flips; ++tries) {
    const Topology topology = topology_of(mesh);
    const int f = random.below(topology.num_faces()), k = random.below(3);
    const int g = topology.neighbor(f, k), d = topology.opposite(f, k);
    const int a = mesh.faces[f][k], b = mesh.faces[f][(k + 1) % 3], c = mesh.faces[f][(k + 2) % 3];
    const IntSpan ring = topology.ring(c);
    if (c == d || std::find(ring.begin(), ring.end(), d) != ring.end()) continue;
    if (topology.valence(a) == 3 || topology.valence(b) == 3) continue;
    if (topology.valence(c) == most || topology.valence(d) == most) continue;
    mesh.faces[f] = {a, d, c};
    mesh.faces[g] = {b, c, d};
    ++done;
  }
  return mesh;
}

inline std::set<int> valences_of(const TriangleMesh &mesh)
{
  const Topology topology = topology_of(mesh);
  std::set<int> valences;
  for (int v = 0; v < topology.num_vertices(); ++v) valences.insert(topology.valence(v));
  return valences;
}

// === Scene

/// The material of one connected component.
struct Moduli {
  double kc = 0.0, c0 = 0.0, kg = 0.0, tension = 0.0, pressure = 0.0, moment = 0.0;
  double leaflet = 0.0, outer = 0.0, inner = 0.0;
};

struct Totals {
  double bending = 0.0, gauss = 0.0, tension = 0.0, pressure = 0.0, moment = 0.0;    ///< energies
  double area = 0.0, volume = 0.0, curvature = 0.0;
  double first_pass_bending = 0.0;
  Vector3d vector_area = Vector3d::Zero();
  Points force;                          ///< [vertices]
  Eigen::Matrix<double, 6, 1> virial;    ///< xx yy zz xy xz yz of sum r f
  double energy() const { return bending + gauss + tension + pressure + moment; }
};

/// Patch rules are the same for all scenes: each is built once in a test program.
inline PatchRules &shared_rules(Quadrature quadrature)
{
  static std::map<Quadrature, PatchRules> rules;
  return rules.try_emplace(quadrature, quadrature).first->second;
}

/// A mesh, or some faces of it, with a quadrature and a material for each component.
class Scene {
 public:
  Scene(const TriangleMesh &mesh, Quadrature quadrature, std::vector<Moduli> moduli = {{1.0}}) :
      Scene(mesh, quadrature, std::move(moduli), all_faces(mesh))
  {
  }

  Scene(const TriangleMesh &mesh, Quadrature quadrature, std::vector<Moduli> moduli,
        const std::vector<int> &faces) :
      mesh_(mesh),
      topology_(topology_of(mesh)), moduli_(std::move(moduli)),
      groups_(group_faces(topology_, shared_rules(quadrature), faces))
  {
    moduli_.resize(topology_.num_components(), moduli_.front());
    for (int v = 0; v < topology_.num_vertices(); ++v) locals_.push_back({v, Vector3d::Zero()});
    if (mesh.is_periodic()) make_ghosts();
    fill_model(Vector3d::Zero());
  }

  const TriangleMesh &mesh() const { return mesh_; }
  const Topology &topology() const { return topology_; }
  FaceGroups &groups() { return groups_; }
  FaceModel &model() { return model_; }
  FaceTerms &terms() { return terms_; }
  FaceEnergies &last_energies() { return energies_; }

  /// Volumes are measured from here.
  void set_origin(const Vector3d &origin) { fill_model(origin); }

  Totals evaluate() { return evaluate(mesh_.points, mesh_.lattice); }
  Totals evaluate(const Points &points) { return evaluate(points, mesh_.lattice); }

  Totals evaluate(const Points &points, const Matrix3d &lattice)
  {
    const size_t nlocal = locals_.size(), nslots = count_slots(groups_);
    Points x(nlocal), f(nlocal, Vector3d::Zero());
    for (size_t i = 0; i < nlocal; ++i)
      x[i] = points[locals_[i].owner] + lattice * locals_[i].image;
    const auto positions = reinterpret_cast<const double(*)[3]>(x.data());
    const auto forces = reinterpret_cast<double(*)[3]>(f.data());

    FaceIntegrals integrals;
    integrals.area.resize(nslots);
    integrals.volume.resize(nslots);
    integrals.vector_area.resize(3 * nslots);
    integrals.curvature.resize(nslots);
    integrals.bending.resize(nslots);
    for (auto *array : {&energies_.bending, &energies_.gauss, &energies_.area})
      array->assign(nslots, 0.0);
    energies_.virial.assign(6 * nslots, 0.0);

    Totals sum;
    sum.virial.setZero();
    face_integrals(groups_, positions, model_, integrals);
    face_forces(groups_, positions, model_, terms_, forces, energies_);
    for (const FaceGroup &group : groups_) {
      for (int i = 0; i < group.nfaces; ++i) {
        const int slot = group.first_slot + i;
        sum.bending += energies_.bending[slot];
        sum.gauss += energies_.gauss[slot];
        sum.tension += model_.tension[slot] * energies_.area[slot];
        sum.pressure += model_.pressure[slot] * integrals.volume[slot];
        sum.moment += model_.moment[slot] * integrals.curvature[slot];
        sum.first_pass_bending += integrals.bending[slot];
        sum.curvature += integrals.curvature[slot];
        sum.area += integrals.area[slot];
        sum.volume += integrals.volume[slot];
        sum.vector_area += Eigen::Map<const Vector3d>(&integrals.vector_area[3 * slot]);
        sum.virial += Eigen::Map<const Eigen::Matrix<double, 6, 1>>(&energies_.virial[6 * slot]);
      }
    }
    sum.force.assign(topology_.num_vertices(), Vector3d::Zero());
    for (size_t i = 0; i < nlocal; ++i) sum.force[locals_[i].owner] += f[i];
    return sum;
  }

 private:
  struct Local {
    int owner;
    Vector3d image;    // in box vectors
  };

  TriangleMesh mesh_;
  Topology topology_;
  std::vector<Moduli> moduli_;
  FaceGroups groups_;
  FaceModel model_;
  FaceTerms terms_;
  FaceEnergies energies_;
  std::vector<Local> locals_;    // vertices, then ghosts

  static std::vector<int> all_faces(const TriangleMesh &mesh)
  {
    std::vector<int> faces(mesh.faces.size());
    for (size_t f = 0; f < faces.size(); ++f) faces[f] = static_cast<int>(f);
    return faces;
  }

  void fill_model(const Vector3d &origin)
  {
    model_.resize(count_slots(groups_));
    terms_.leaflets = std::any_of(moduli_.begin(), moduli_.end(), [](const Moduli &m) { return m.leaflet > 0.0; });
    if (terms_.leaflets)
      for (auto *array : {&model_.leaflet, &model_.outer, &model_.inner}) array->resize(count_slots(groups_));
    for (const FaceGroup &group : groups_)
      for (int i = 0; i < group.nslots(); ++i) {
        const int slot = group.first_slot + i;
        const int face = group.face[std::min(i, group.nfaces - 1)];
        const Moduli &m = moduli_[topology_.component(topology_.face(face)[0])];
        model_.kc[slot] = m.kc;
        model_.c0[slot] = m.c0;
        model_.kg[slot] = m.kg;
        model_.tension[slot] = m.tension;
        model_.pressure[slot] = m.pressure;
        model_.moment[slot] = m.moment;
        if (terms_.leaflets) {
          model_.leaflet[slot] = m.leaflet;
          model_.outer[slot] = m.outer;
          model_.inner[slot] = m.inner;
        }
        for (int d = 0; d < 3; ++d) model_.origin[3 * slot + d] = origin[d];
        terms_.gauss = terms_.gauss || m.kg != 0.0;
        terms_.volume = terms_.volume || m.pressure != 0.0;
        terms_.moment = terms_.moment || m.moment != 0.0;
      }
  }

  // Which image of each control point a face means: corners joined by their shortest edges, then
  // the points around each corner joined to it likewise.
  void make_ghosts()
  {
    const Matrix3d inverse = mesh_.lattice.inverse();
    std::map<std::pair<int, std::array<int, 3>>, int> known;
    auto image_of = [&](int from, const Vector3d &image, int to) -> Vector3d {
      const Vector3d straight = mesh_.points[to] - mesh_.points[from];
      const Vector3d crossed = inverse * (mesh_.nearest_image(straight) - straight);
      return image +
          Vector3d(std::round(crossed[0]), std::round(crossed[1]), std::round(crossed[2]));
    };
    auto local = [&](int v, const Vector3d &image) {
      if (image.isZero()) return v;
      const std::array<int, 3> key = {int(image[0]), int(image[1]), int(image[2])};
      const auto [entry, fresh] = known.try_emplace({v, key}, int(locals_.size()));
      if (fresh) locals_.push_back({v, image});
      return entry->second;
    };
    for (FaceGroup &group : groups_)
      for (int i = 0; i < group.nslots(); ++i) {
        int corner[3];
        Vector3d image[3];
        for (int k = 0; k < 3; ++k) {
          corner[k] = group.point(i, k);
          image[k] = image_of(corner[0], Vector3d::Zero(), corner[k]);
          group.point(i, k) = local(corner[k], image[k]);
        }
        int column = 3;
        for (int k = 0; k < 3; ++k)
          for (int j = 0; j < topology_.valence(corner[k]) - 3; ++j, ++column) {
            const int v = group.point(i, column);
            group.point(i, column) = local(v, image_of(corner[k], image[k], v));
          }
      }
  }
};

// === Numerical derivatives

/// f'(0) from f at +-h and +-h/2 by Richardson extrapolation; error O(h^4).
template <class Function> double derivative(Function &&f, double h)
{
  auto central = [&](double s) {
    return (f(s) - f(-s)) / (2.0 * s);
  };
  return (4.0 * central(0.5 * h) - central(h)) / 3.0;
}

}    // namespace Membrane_TEST

#endif
