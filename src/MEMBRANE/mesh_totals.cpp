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
#include "mesh_totals.h"

#include "atom.h"
#include "domain.h"

#include <algorithm>
#include <array>

using namespace LAMMPS_NS;
using Membrane_NS::FaceGroup;
using Membrane_NS::FaceGroups;
using Membrane_NS::FaceIntegrals;
using Membrane_NS::FaceModel;

// image flags of an atom in the box itself
static constexpr imageint NOT_MOVED = (static_cast<imageint>(IMGMAX) << IMG2BITS) |
    (static_cast<imageint>(IMGMAX) << IMGBITS) | IMGMAX;

/* ---------------------------------------------------------------------- */

MeshTotals::MeshTotals(LAMMPS *lmp, const LocalMesh &mesh) : Pointers(lmp), mesh(mesh) {}

/* ---------------------------------------------------------------------- */

// where the centres were when the mesh was last brought up to date

void MeshTotals::place_centres()
{
  seen = mesh.stamp();
  const auto &topology = mesh->topology();
  parts.assign(topology.num_components(), Total());
  for (int v = 0; v < topology.num_vertices(); ++v) {
    const int c = topology.component(v);
    for (int k = 0; k < 3; ++k)
      parts[c].centre[k] += mesh->unwrapped()[3 * (size_t) v + k] / topology.num_vertices(c);
  }
}

/* ---------------------------------------------------------------------- */

void MeshTotals::unwrap(int i, double *at) const
{
  if (atom->image[i] == NOT_MOVED)
    std::copy_n(atom->x[i], 3, at);
  else
    domain->unmap(atom->x[i], atom->image[i], at);
}

void MeshTotals::place_origins(const std::vector<FaceGroup> &groups, FaceModel &model) const
{
  const bool moved = std::any_of(atom->image, atom->image + atom->nlocal + atom->nghost,
                                 [](imageint image) { return image != NOT_MOVED; });
  for (const FaceGroup &group : groups)
    for (int s = 0, n = group.nslots(); s < n; ++s) {
      const Total &total = parts[component_of(group, s)];
      double *origin = &model.origin[3 * (size_t) (group.first_slot + s)];
      std::copy_n(total.centre, 3, origin);
      if (!moved) continue;
      const int face = group.face[std::min(s, group.nfaces - 1)];
      const int owner = atom->map(mesh->tag(mesh->topology().face(face)[0]));
      if (atom->image[owner] == NOT_MOVED) continue;
      double unwrapped[3];
      domain->unmap(atom->x[owner], atom->image[owner], unwrapped);
      for (int k = 0; k < 3; ++k) origin[k] = total.centre[k] - (unwrapped[k] - atom->x[owner][k]);
    }
}

/* ---------------------------------------------------------------------- */

void MeshTotals::place(const std::vector<FaceGroup> &groups, FaceModel &model)
{
  if (seen != mesh.stamp()) place_centres();
  std::vector<double> mine(3 * parts.size(), 0.0), all(mine.size());
  for (const auto &[i, v] : mesh->owned_points()) {
    double unwrapped[3];
    unwrap(i, unwrapped);
    for (int k = 0; k < 3; ++k) mine[3 * mesh->topology().component(v) + k] += unwrapped[k];
  }
  MPI_Allreduce(mine.data(), all.data(), mine.size(), MPI_DOUBLE, MPI_SUM, world);
  for (size_t c = 0; c < parts.size(); ++c)
    for (int k = 0; k < 3; ++k)
      parts[c].centre[k] = all[3 * c + k] / mesh->topology().num_vertices(static_cast<int>(c));
  place_origins(groups, model);
}

/* ---------------------------------------------------------------------- */

void MeshTotals::measure(FaceGroups &groups, FaceModel &model,
                         FaceIntegrals &integrals, const Wanted &wanted)
{
  if (seen != mesh.stamp()) place_centres();
  const int nslots = count_slots(groups);
  integrals.area.resize(nslots);
  integrals.curvature.resize(wanted.curvature ? nslots : 0);
  integrals.volume.resize(wanted.volume ? nslots : 0);
  integrals.vector_area.resize(wanted.volume ? 3 * (size_t) nslots : 0);

  const auto x = atom->nlocal ? reinterpret_cast<const double(*)[3]>(atom->x[0]) : nullptr;
  if (wanted.volume) place_origins(groups, model);
  face_integrals(groups, x, model, integrals);

  constexpr int WIDTH = 9;
  const int n = parts.size();
  std::vector<double> mine((size_t) n * WIDTH, 0.0), all(mine.size());
  for (const FaceGroup &group : groups)
    for (int s = 0; s < group.nfaces;) {
      const int component = component_of(group, s);
      double *sum = &mine[component * WIDTH], area = 0.0, volume = 0.0, vector[3] = {0.0, 0.0, 0.0};
      for (; s < group.nfaces && component_of(group, s) == component; ++s) {
        const int slot = group.first_slot + s;
        area += integrals.area[slot];
        if (wanted.curvature) sum[8] += integrals.curvature[slot];
        if (!wanted.volume) continue;
        volume += integrals.volume[slot];
        for (int k = 0; k < 3; ++k) vector[k] += integrals.vector_area[3 * (size_t) slot + k];
      }
      sum[0] += area;
      sum[1] += volume;
      for (int k = 0; k < 3; ++k) sum[2 + k] += vector[k];
    }
  if (wanted.volume)
    for (const auto &[i, v] : mesh->owned_points()) {
      double unwrapped[3];
      unwrap(i, unwrapped);
      double *sum = &mine[mesh->topology().component(v) * WIDTH];
      for (int k = 0; k < 3; ++k) sum[5 + k] += unwrapped[k];
    }
  MPI_Allreduce(mine.data(), all.data(), mine.size(), MPI_DOUBLE, MPI_SUM, world);

  sums.assign(mesh->molecules().size(), Total());
  std::vector<std::array<double, 3>> shift(n);
  for (int c = 0; c < n; ++c) {
    const double *sum = &all[c * WIDTH];
    Total &total = parts[c];
    Total &membrane = sums[mesh->membrane(c)];
    total.area = sum[0];
    total.curvature = sum[8];
    membrane.area += total.area;
    membrane.curvature += total.curvature;
    if (!wanted.volume) continue;
    total.volume = sum[1];
    for (int k = 0; k < 3; ++k) {
      const double centre = sum[5 + k] / mesh->topology().num_vertices(c);
      total.vector_area[k] = sum[2 + k];
      total.volume -= (centre - total.centre[k]) * sum[2 + k] / 3.0;
      shift[c][k] = centre - total.centre[k];
      total.centre[k] = centre;
    }
    if (mesh->is_closed(c)) membrane.volume += total.volume;
  }
  if (!wanted.volume) return;
  for (const FaceGroup &group : groups)
    for (int s = 0, n = group.nslots(); s < n; ++s) {
      const auto &d = shift[component_of(group, s)];
      for (int k = 0; k < 3; ++k) model.origin[3 * (size_t) (group.first_slot + s) + k] += d[k];
    }
}
