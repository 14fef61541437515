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

#include "helfrich_model.h"

#include "atom.h"
#include "domain.h"
#include "membrane_cotangent.h"

#include <cmath>

using namespace LAMMPS_NS;
using Eigen::Vector3d;
using Membrane_NS::FaceGroup;
using Membrane_NS::FaceModel;
using Membrane_NS::StiffnessReference;

/* ----------------------------------------------------------------------
   of an area, volume or integral of 2H of membrane m by the control points when these have moved, exact
   for the quadrature: the forces of a model that has nothing but this conjugate
------------------------------------------------------------------------- */

std::vector<Vector3d> HelfrichModel::gradient(int m, double Conjugates::*of,
                                              const std::vector<Vector3d> &moved)
{
  Conjugates unit;
  unit.*of = 1.0;
  const std::vector<Conjugates> conjugates = scene.conjugates;
  scene.conjugates.assign(scene.types.size(), Conjugates());
  scene.conjugates[m] = unit;
  FaceModel model = scene.model;
  for (auto *zero :
       {&model.kc, &model.c0, &model.kg, &model.tension, &model.moment, &model.pressure})
    std::fill(zero->begin(), zero->end(), 0.0);
  for (const FaceGroup &group : scene.groups)
    for (int s = 0; s < group.nslots(); ++s) {
      if (scene.membrane(group, s) != m) continue;
      model.tension[group.first_slot + s] = unit.tension;
      model.pressure[group.first_slot + s] = unit.pressure;
      model.moment[group.first_slot + s] = unit.moment;
    }

  const int nall = atom->nlocal + atom->nghost;
  std::vector<double> force(3 * (size_t) nall, 0.0), place(force.size(), 0.0);
  for (int i = 0; i < nall; ++i) {
    const int v = scene.mesh->vertex(atom->tag[i]);
    for (int k = 0; v >= 0 && k < 3; ++k) place[3 * (size_t) i + k] = atom->x[i][k] + moved[v][k];
  }
  const auto x = nall ? reinterpret_cast<const double(*)[3]>(place.data()) : nullptr;
  const auto f = nall ? reinterpret_cast<double(*)[3]>(force.data()) : nullptr;
  const bool volume = unit.pressure != 0.0;
  Membrane_NS::FaceEnergies none;
  face_forces(scene.groups, x, model, {false, volume, unit.moment != 0.0, false}, f, none);
  if (volume) share_volume_recoil(f);
  scene.conjugates = conjugates;

  // the pressure is dE/dV with the sign of a force, tension and moment are energies

  const int n = scene.mesh->topology().num_vertices();
  std::vector<double> mine(3 * (size_t) n, 0.0), all(mine.size());
  for (int i = 0; i < nall; ++i) {
    const int v = scene.mesh->vertex(atom->tag[i]);
    if (v < 0) continue;
    for (int k = 0; k < 3; ++k) mine[3 * (size_t) v + k] -= force[3 * (size_t) i + k];
  }
  MPI_Allreduce(mine.data(), all.data(), 3 * n, MPI_DOUBLE, MPI_SUM, world);
  std::vector<Vector3d> result(n);
  for (int v = 0; v < n; ++v) result[v] = Vector3d(&all[3 * (size_t) v]);
  return result;
}

/* ---------------------------------------------------------------------- */

StiffnessReference HelfrichModel::describe()
{
  prepare({false, false, false});
  HelfrichStiffness found;
  found.shear.assign(scene.nslots(), 0.0);
  found.stretch.assign(scene.nslots(), 0.0);
  found.totals.assign(scene.types.size(), Conjugates());
  for (HelfrichTerm *term : present) term->add_stiffness(scene, found);

  const auto &topology = scene.mesh->topology();
  const int n = topology.num_vertices(), nfaces = topology.num_faces();
  StiffnessReference reference;
  reference.closed.resize(topology.num_components());
  for (int c = 0; c < topology.num_components(); ++c)
    reference.closed[c] = scene.mesh->is_closed(c);

  // vertices: place and kc

  const std::vector<double> kc = bending_moduli();
  std::vector<double> mine(4 * (size_t) n, 0.0), all(mine.size());
  for (const auto &[i, v] : scene.mesh->owned_points()) {
    double x[3];
    domain->unmap(atom->x[i], atom->image[i], x);
    std::copy_n(x, 3, &mine[4 * (size_t) v]);
    mine[4 * (size_t) v + 3] = kc[atom->type[i]];
  }
  MPI_Allreduce(mine.data(), all.data(), 4 * n, MPI_DOUBLE, MPI_SUM, world);
  Membrane_NS::TriangleMesh shape = scene.mesh->triangle_mesh();
  reference.kc.resize(n);
  for (int v = 0; v < n; ++v) {
    shape.points[v] = Vector3d(&all[4 * (size_t) v]);
    reference.kc[v] = all[4 * (size_t) v + 3];
  }
  reference.shape = long_waves(shape, topology);
  std::vector<Vector3d> moved(n);
  for (int v = 0; v < n; ++v) moved[v] = reference.shape.points[v] - shape.points[v];

  // faces: tension of the energy, and of c0, which undulations of a sphere feel as one of
  // kc (c0^2/2 - 2H c0)

  std::vector<double> part(4 * (size_t) nfaces, 0.0), faces(part.size());
  for (const FaceGroup &group : scene.groups)
    for (int s = 0; s < group.nfaces; ++s) {
      const int slot = group.first_slot + s;
      double *face = &part[4 * (size_t) group.face[s]];
      const double bent = scene.model.kc[slot] * scene.model.c0[slot];
      face[0] = scene.model.tension[slot] + scene.model.flat_energy(slot);
      face[1] = found.shear[slot];
      face[2] = found.stretch[slot];
      face[3] = bent;
    }
  MPI_Allreduce(part.data(), faces.data(), 4 * nfaces, MPI_DOUBLE, MPI_SUM, world);
  const Membrane_NS::FlatAreas areas(reference.shape, topology);
  for (int f = 0; f < nfaces; ++f) {
    const double *face = &faces[4 * (size_t) f];
    const int c = topology.component(topology.face(f)[0]);
    const double twice_h = reference.closed[c] ? 4.0 * std::sqrt(M_PI / areas.components[c]) : 0.0;
    reference.tension.push_back(face[0] - twice_h * face[3]);
    reference.shear.push_back(face[1]);
    reference.stretch.push_back(face[2]);
  }

  // totals, if anything holds them

  for (size_t m = 0; m < found.totals.size(); ++m)
    for (auto of : {&Conjugates::tension, &Conjugates::pressure, &Conjugates::moment})
      if (found.totals[m].*of > 0.0)
        reference.totals.push_back({found.totals[m].*of, gradient(static_cast<int>(m), of, moved)});
  return reference;
}
