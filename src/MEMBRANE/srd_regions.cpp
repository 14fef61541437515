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

#include "srd_regions.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "membrane_tessellation.h"
#include "memory.h"
#include "mesh_box.h"
#include "srd_solvent.h"

#include <algorithm>
#include <cmath>
#include <map>

using namespace LAMMPS_NS;
using Eigen::Vector3d;
using Membrane_NS::Face;
using Membrane_NS::SurfaceSide;

// for volumes
static constexpr int PLACES = 30000;

/* ---------------------------------------------------------------------- */

SurfaceRegions::SurfaceRegions(LAMMPS *lmp, SurfaceMotion &motion, std::string user) :
    Pointers(lmp), region(nullptr), motion(motion), user(std::move(user)), num_surfaces(0), flip{}
{
}

SurfaceRegions::~SurfaceRegions()
{
  memory->destroy(region);
}

void SurfaceRegions::grow(int nmax)
{
  memory->grow(region, nmax, "srd/mesh:region");
}

/* ----------------------------------------------------------------------
   the surfaces as they are now
------------------------------------------------------------------------- */

void SurfaceRegions::locate()
{
  vertices = motion.places();
  const Eigen::Matrix3d to_fraction = motion.lattice().inverse();
  std::vector<Vector3d> points;
  points.reserve(vertices.size());
  for (const auto &v : vertices) points.push_back(to_fraction * v.path.origin);

  const DistributedMesh &mesh = motion.mesh();
  const SRDSurface &surface = motion.surface();
  const auto &topology = mesh.topology();
  const auto continues = continuing_directions(topology, mesh.triangle_mesh());
  const auto &components = surface.components();
  num_surfaces = static_cast<int>(components.size());
  surface_of.assign(topology.num_components(), -1);
  sides.assign(topology.num_components(), {});
  std::vector<std::vector<Face>> faces(topology.num_components());
  for (size_t f = 0; f < surface.faces().faces.size(); ++f)
    faces[surface.component(f)].push_back(surface.faces().faces[f]);

  std::fill_n(flip, 3, 0);
  for (int s = 0; s < num_surfaces; ++s) {
    const int c = components[s];
    surface_of[c] = s;
    int axis = 2;
    while (axis >= 0 && continues[c][axis]) --axis;
    if (axis < 0)
      error->all(FLERR,
                 "{}: membrane {} continues through the box in all three directions: its sides "
                 "cannot be told apart",
                 user, mesh.molecule(c));
    sides[c] = SurfaceSide(points, faces[c], axis, periodic_directions(*domain));
    flip[axis] = (flip[axis] + sides[c].degree()) & 1;
  }
}

Vector3d SurfaceRegions::fraction(const double *x, imageint image) const
{
  const auto s = in_box_lengths(*domain, x);
  return {s[0] + flag(image, 0), s[1] + flag(image, 1), s[2] + flag(image, 2)};
}

/* ---------------------------------------------------------------------- */

void SurfaceRegions::assign(const SRDSolvent &solvent)
{
  locate();
  const auto &components = motion.surface().components();

  // the sets of levels that occur here, then everywhere

  std::map<std::vector<int>, int> found;
  std::vector<int> set(num_surfaces), list;
  std::vector<const std::vector<int> *> set_of(solvent.last() - solvent.first(), nullptr);
  for (int i = solvent.first(); i < solvent.last(); ++i) {
    if (!solvent.has(i)) continue;
    const Vector3d x = fraction(atom->x[i], atom->image[i]);
    for (int s = 0; s < num_surfaces; ++s) set[s] = sides[components[s]].level(x);
    const auto [entry, is_new] = found.emplace(set, 0);
    if (is_new) list.insert(list.end(), set.begin(), set.end());
    set_of[i - solvent.first()] = &entry->first;
  }
  const int nprocs = comm->nprocs;
  int mine = static_cast<int>(list.size());
  std::vector<int> counts(nprocs), starts(nprocs + 1, 0);
  MPI_Allgather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (int p = 0; p < nprocs; ++p) starts[p + 1] = starts[p] + counts[p];
  std::vector<int> all(starts.back());
  MPI_Allgatherv(list.data(), mine, MPI_INT, all.data(), counts.data(), starts.data(), MPI_INT,
                 world);
  std::map<std::vector<int>, int> numbers;
  for (size_t j = 0; num_surfaces > 0 && j < all.size(); j += num_surfaces)
    numbers.emplace(std::vector<int>(&all[j], &all[j] + num_surfaces), 0);
  if (num_surfaces == 0) numbers.emplace(std::vector<int>(), 0);

  levels.clear();
  inside.clear();
  odd.clear();
  for (auto &[key, number] : numbers) {
    number = static_cast<int>(inside.size());
    levels.insert(levels.end(), key.begin(), key.end());
    bool is_in = false;
    int sum = 0;
    for (int s = 0; s < num_surfaces; ++s) {
      is_in = is_in || (motion.mesh().is_closed(components[s]) && key[s] != 0);
      sum += key[s];
    }
    inside.push_back(is_in);
    odd.push_back(sum & 1);
  }
  std::fill_n(region, atom->nlocal, 0);
  for (int i = solvent.first(); i < solvent.last(); ++i)
    if (solvent.has(i)) region[i] = numbers.at(*set_of[i - solvent.first()]);
}

/* ---------------------------------------------------------------------- */

bool SurfaceRegions::belongs(const double *x, imageint image, int r) const
{
  const Vector3d s = fraction(x, image);
  for (int c : motion.surface().components())
    if (sides[c].level(s) != levels[r * num_surfaces + surface_of[c]]) return false;
  return true;
}

std::vector<SurfaceRegions::Crossing> SurfaceRegions::find_crossings(const SRDSolvent &solvent)
{
  locate();
  std::vector<Crossing> crossings;
  for (int i = solvent.first(); i < solvent.last(); ++i) {
    if (!solvent.has(i)) continue;
    const Vector3d x = fraction(atom->x[i], atom->image[i]);
    for (int c : motion.surface().components()) {
      const int level = levels[region[i] * num_surfaces + surface_of[c]];
      if (sides[c].level(x) == level) continue;
      crossings.push_back({i, c, level});
      break;
    }
  }
  return crossings;
}

void SurfaceRegions::forget_places()
{
  std::vector<Membrane_NS::SurfaceVertex>().swap(vertices);
  for (SurfaceSide &side : sides) side.forget_triangles();
}

/* ---------------------------------------------------------------------- */

void SurfaceRegions::find_parities(const SRDSolvent &solvent, int *parity) const
{
  const int *of_region = odd.data();
  const bool any_flips = flip[0] || flip[1] || flip[2];
  for (int i = solvent.first(); i < solvent.last(); ++i) {
    if (!solvent.has(i)) continue;
    int sum = of_region[region[i]];
    if (any_flips)
      for (int k = 0; k < 3; ++k)
        if (flip[k]) sum += flag(atom->image[i], k);
    parity[i] = sum & 1;
  }
}

/* ----------------------------------------------------------------------
   Places of an additive recurrence with powers of the root of g^4 = g + 1 [M. Roberts, The unreasonable
   effectiveness of quasirandom sequences, 2018]: unlike a grid's, their layers do not line up with those of
   a cylinder or a sheet along the box
------------------------------------------------------------------------- */

std::array<double, 2> SurfaceRegions::volumes() const
{
  constexpr double G = 1.2207440846057596;
  const Vector3d stride(1.0 / G, 1.0 / (G * G), 1.0 / (G * G * G));
  const auto lo = in_box_lengths(*domain, domain->boxlo);    // where sides are known, space begins at 0 and not with the box
  int mine = 0, odd_places;
  for (int i = comm->me; i < PLACES; i += comm->nprocs) {
    Vector3d x = Vector3d::Constant(0.5) + i * stride;
    for (int k = 0; k < 3; ++k) x[k] += lo[k] - std::floor(x[k]);
    int level = 0;
    for (int c : motion.surface().components()) level += sides[c].level(x);
    mine += level & 1;
  }
  MPI_Allreduce(&mine, &odd_places, 1, MPI_INT, MPI_SUM, world);
  const double part = (double) odd_places / PLACES;
  return {1.0 - part, part};
}

double SurfaceRegions::memory_usage() const
{
  return sizeof(int) * (double) atom->nmax +
      sizeof(Membrane_NS::SurfaceVertex) * vertices.capacity();
}
