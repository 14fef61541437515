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

#include "srd_surface_part.h"

#include "comm.h"
#include "membrane_srd_image_finder.h"
#include "mesh_box.h"
#include "mesh_gather.h"
#include "mesh_part.h"

#include <algorithm>

using namespace LAMMPS_NS;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Membrane_NS::ImageFinder;
using Membrane_NS::SurfaceCorners;
using Membrane_NS::SurfaceVertex;
using Membrane_NS::Topology;

static void sort_out(std::vector<int> &list)
{
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

// in an ascending list, or -1

static int find(const std::vector<int> &list, int item)
{
  const auto at = std::lower_bound(list.begin(), list.end(), item);
  return at != list.end() && *at == item ? static_cast<int>(at - list.begin()) : -1;
}

/* ---------------------------------------------------------------------- */

SRDSurfacePart::SRDSurfacePart(LAMMPS *lmp, const SRDSurface &whole, const Topology &topology,
                               const MeshPart &part, std::vector<int> faces, bool all_masses) :
    Pointers(lmp),
    whole(whole), whole_face(std::move(faces)), table(nullptr)
{
  find_masses(topology, part, all_masses);
  std::vector<int> owned(part.vertices.begin(), part.vertices.begin() + part.owned), others;
  std::vector<char> is_owned(mass.size(), 0);
  for (int v : owned) {
    owned_place.push_back(find(mass, v));
    is_owned[owned_place.back()] = 1;
  }
  for (size_t a = 0; a < mass.size(); ++a)
    if (!is_owned[a]) others.push_back(mass[a]);
  copies = std::make_unique<VertexCopies>(lmp, owned, std::move(others));
  for (int v : copies->vertices()) copy_place.push_back(find(mass, v));
  number_triangles();
}

void SRDSurfacePart::find_masses(const Topology &topology, const MeshPart &part, bool all_masses)
{
  const int n = topology.num_vertices();
  for (int t : whole_face)
    for (int v : whole.faces().faces[t]) (v < n ? mass : finer).push_back(v);
  sort_out(finer);
  mass.insert(mass.end(), part.vertices.begin(), part.vertices.begin() + part.owned);
  if (whole.corners()) {
    std::vector<char> needed(n, 0);
    for (int a : mass) needed[a] = 1;
    for (int c : finer)
      for (const auto &entry : whole.corners()->masses_of(c)) needed[entry.first] = 1;
    mass.clear();
    for (int a = 0; a < n; ++a)
      if (needed[a]) mass.push_back(a);
  }
  if (all_masses) {
    std::vector<char> in_group(topology.num_components(), 0);
    for (int c : whole.components()) in_group[c] = 1;
    for (int a = 0; a < n; ++a)
      if (in_group[topology.component(a)]) mass.push_back(a);
  }
  sort_out(mass);
  if (!whole.corners()) return;
  if (static_cast<int>(mass.size() + finer.size()) == whole.num_vertices())
    table = whole.corners();
  else {
    part_of_table = std::make_unique<SurfaceCorners>(*whole.corners(), mass, finer);
    table = part_of_table.get();
  }
}

void SRDSurfacePart::number_triangles()
{
  for (int t : whole_face) {
    Membrane_NS::Face face = whole.faces().faces[t];
    for (int &v : face) v = from_whole(v);
    triangles.faces.push_back(face);
    triangles.seams.push_back(whole.faces().seams[t]);
  }
}

int SRDSurfacePart::from_whole(int vertex) const
{
  const int a = find(mass, vertex);
  if (a >= 0 || finer.empty()) return a;
  const int c = find(finer, vertex);
  return c < 0 ? -1 : num_masses() + c;
}

int SRDSurfacePart::hit_from_whole(int vertex)
{
  const int known = from_whole(vertex);
  if (known >= 0 || !table || vertex < whole.corners()->num_masses()) return known;
  const auto at = std::lower_bound(hit.begin(), hit.end(), std::make_pair(vertex, -1));
  if (at != hit.end() && at->first == vertex) return at->second;
  const int number = part_of_table->add(*whole.corners(), mass, vertex);
  hit.insert(at, {vertex, number});
  return number;
}

/* ---------------------------------------------------------------------- */

void SRDSurfacePart::spread(const std::vector<double> &owned, int width,
                            std::vector<double> &values)
{
  received.resize(width * copy_place.size());
  values.resize(width * mass.size());
  copies->begin(owned.data(), received.data(), width, width);
  for (size_t i = 0; i < owned_place.size(); ++i)
    std::copy_n(&owned[width * i], width, &values[(size_t) width * owned_place[i]]);
  copies->end();
  for (size_t i = 0; i < copy_place.size(); ++i)
    std::copy_n(&received[width * i], width, &values[(size_t) width * copy_place[i]]);
}

/* ----------------------------------------------------------------------
   each rank looks through its triangles for all others
------------------------------------------------------------------------- */

std::vector<int> SRDSurfacePart::find_in(const Vector3d &lo, const Vector3d &hi,
                                         const Matrix3d &lattice,
                                         const std::vector<SurfaceVertex> &vertices) const
{
  const std::array<double, 6> mine = {lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]};
  const auto regions = gather_all(std::vector<std::array<double, 6>>{mine}, world);

  std::vector<std::array<Vector3d, 3>> corners;
  Vector3d first = Vector3d::Constant(INFINITY), last = -first;
  for (size_t t = 0; t < triangles.faces.size(); ++t) {
    corners.push_back(corners_together(triangles, t, vertices, lattice));
    for (const Vector3d &x : corners.back()) {
      first = first.cwiseMin(x);
      last = last.cwiseMax(x);
    }
  }
  std::vector<std::vector<int>> near(comm->nprocs);
  for (int p = 0; p < comm->nprocs && !corners.empty(); ++p) {
    const ImageFinder region(lattice, periodic_directions(*domain),
                             Vector3d::Map(regions[p].data()), Vector3d::Map(regions[p].data() + 3));
    if (!region.any({first, last, last})) continue;
    for (size_t t = 0; t < corners.size(); ++t)
      if (region.any(corners[t])) near[p].push_back(whole_face[t]);
  }
  std::vector<int> found;
  for (const auto &list : exchange_lists(near, world))
    found.insert(found.end(), list.begin(), list.end());
  std::sort(found.begin(), found.end());
  return found;
}

void SRDSurfacePart::find_sharers()
{
  shared = copies->sharers();
  sharing.resize(mass.size());
  int list = 0;
  for (int a : owned_place) sharing[a] = list++;
  for (int a : copy_place) sharing[a] = list++;
}

double SRDSurfacePart::memory_usage() const
{
  return triangles.faces.capacity() * (sizeof(Membrane_NS::Face) + 10 * sizeof(int)) +
      sizeof(int) * (3.0 * mass.capacity() + finer.capacity() + shared.items.capacity()) +
      sizeof(double) * received.capacity() + copies->memory_usage() +
      (part_of_table ? part_of_table->memory_usage() : 0.0);
}
