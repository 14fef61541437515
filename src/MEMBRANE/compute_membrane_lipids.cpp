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

#include "compute_membrane_lipids.h"

#include "atom.h"
#include "error.h"
#include "fmt/format.h"
#include "force.h"
#include "helfrich_lipids.h"
#include "memory.h"
#include "mesh_lipid_places.h"
#include "modify.h"
#include "pair.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using Membrane_NS::FaceGroup;
using Membrane_NS::FaceLipids;

static constexpr int NCOLUMNS = 4;
static constexpr int CURVATURE = 2, BEND = 3;    // columns that are of no leaflet

/* ---------------------------------------------------------------------- */

ComputeMembraneLipids::ComputeMembraneLipids(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), mesh(lmp, fmt::format("Compute {} membrane/lipids", id)),
    rules(Membrane_NS::Quadrature::SIX), most_faces(0)
{
  mesh.require();
  int iarg = 3;
  while (iarg < narg) {
    const std::string key = arg[iarg];
    if (key == "curvature" || key == "bend") {
      columns.push_back({key == "bend" ? BEND : CURVATURE, ""});
      ++iarg;
    } else if (key == "outer" || key == "inner") {
      if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "compute membrane/lipids " + key, error);
      columns.push_back({key == "inner", arg[iarg + 1]});
      iarg += 2;
    } else
      error->all(FLERR, "Unknown compute membrane/lipids keyword {}; known are: outer, inner, curvature, bend", key);
  }
  vector_flag = array_flag = 1;
  size_vector = 0;
  size_vector_variable = 1;
  size_array_cols = NCOLUMNS;
  size_array_rows = 0;
  size_array_rows_variable = 1;
  extvector = extarray = 0;
  if (!columns.empty()) {
    local_flag = 1;
    size_local_cols = static_cast<int>(columns.size());
  }
}

ComputeMembraneLipids::~ComputeMembraneLipids()
{
  delete[] vector;
  memory->destroy(array);
  memory->destroy(array_local);
}

// the number of kinds is known before the first run, for styles that ask how long arrays are

void ComputeMembraneLipids::init()
{
  mesh.init();
  Pair *pair = force->pair_match("helfrich", 1);
  int dim;
  if (const void *said = pair ? pair->extract("lipids", dim) : nullptr)
    resize(static_cast<const HelfrichLipids *>(said)->library().size());
}

/* ---------------------------------------------------------------------- */

const LipidPlaces &ComputeMembraneLipids::places()
{
  mesh.follow();
  const LipidPlaces *found = LipidPlaces::on(*mesh, modify);
  if (!found)
    error->all(FLERR, "Compute {} membrane/lipids: no single lipids are on faces; use fix hd/lipids", id);
  resize(found->lipids->num_kinds());
  return *found;
}

void ComputeMembraneLipids::resize(int nkinds)
{
  if (vector && size_vector == 2 * nkinds) return;
  size_vector = size_array_rows = 2 * nkinds;
  delete[] vector;
  vector = new double[size_vector]();
  memory->destroy(array);
  memory->create(array, size_array_rows, NCOLUMNS, "membrane/lipids:array");
}

// faces of membranes of which some control point is in the group

std::vector<char> ComputeMembraneLipids::chosen() const
{
  const auto &topology = mesh->topology();
  const int nmembranes = static_cast<int>(mesh->molecules().size());
  std::vector<int> mine(nmembranes, 0), all(nmembranes);
  for (int i = 0; i < atom->nlocal; ++i) {
    const int v = mesh->vertex(atom->tag[i]);
    if (v >= 0 && atom->mask[i] & groupbit) mine[mesh->membrane(topology.component(v))] = 1;
  }
  MPI_Allreduce(mine.data(), all.data(), nmembranes, MPI_INT, MPI_MAX, world);
  std::vector<char> faces(topology.num_faces());
  for (int f = 0; f < topology.num_faces(); ++f)
    faces[f] = all[mesh->membrane(topology.component(topology.face(f)[0]))];
  return faces;
}

/* ---------------------------------------------------------------------- */

void ComputeMembraneLipids::compute_vector()
{
  invoked_vector = update->ntimestep;
  const FaceLipids &numbers = *places().lipids;
  const std::vector<char> inside = chosen();
  const int nkinds = numbers.num_kinds();
  for (int l = 0; l < 2; ++l) {
    std::vector<int> n(nkinds, 0);
    for (int f = 0; f < numbers.num_faces(); ++f)
      if (inside[f]) numbers.count(l, f, n.data());
    std::copy(n.begin(), n.end(), vector + l * nkinds);
  }
}

// the mean of 2H over each face of all ranks

std::vector<double> ComputeMembraneLipids::bends()
{
  const int nfaces = mesh->topology().num_faces();
  Membrane_NS::FaceGroups groups = mesh->local_groups(rules);
  const int nslots = count_slots(groups);
  Membrane_NS::FaceModel model;
  Membrane_NS::FaceIntegrals found;
  model.resize(nslots);
  found.area.resize(nslots);
  found.curvature.resize(nslots);
  const auto x = atom->nlocal ? reinterpret_cast<const double(*)[3]>(atom->x[0]) : nullptr;
  std::vector<double> mine(nfaces, 0.0), bend(nfaces);
  face_integrals(groups, x, model, found);
  for (const FaceGroup &group : groups)
    for (int s = 0; s < group.nfaces; ++s)
      mine[group.face[s]] = found.curvature[group.first_slot + s] / found.area[group.first_slot + s];
  MPI_Allreduce(mine.data(), bend.data(), nfaces, MPI_DOUBLE, MPI_SUM, world);
  return bend;
}

/* ----------------------------------------------------------------------
   the correlation is Pearson's of the fraction of a kind and 2H over faces, weighted by their numbers of lipids
------------------------------------------------------------------------- */

void ComputeMembraneLipids::compute_array()
{
  invoked_array = update->ntimestep;
  const FaceLipids &numbers = *places().lipids;
  const int nfaces = numbers.num_faces(), nkinds = numbers.num_kinds();
  const std::vector<double> bend = bends();
  const std::vector<char> inside = chosen();
  std::vector<int> n(nkinds);
  for (int l = 0; l < 2; ++l) {
    double all = 0.0, sum = 0.0, squares = 0.0;    // of lipids, and of 2H over them
    std::vector<double> of_kind(nkinds, 0.0), fractions(nkinds, 0.0), products(nkinds, 0.0);
    for (int f = 0; f < nfaces; ++f) {
      const double size = numbers.size(l, f), H = bend[f];
      if (!inside[f] || size == 0.0) continue;
      std::fill(n.begin(), n.end(), 0);
      numbers.count(l, f, n.data());
      all += size;
      sum += size * H;
      squares += size * H * H;
      for (int k = 0; k < nkinds; ++k) {
        of_kind[k] += n[k];
        fractions[k] += n[k] * (n[k] / size);
        products[k] += n[k] * H;
      }
    }
    for (int k = 0; k < nkinds; ++k) {
      double *row = array[l * nkinds + k];
      const double x = all > 0.0 ? of_kind[k] / all : 0.0, H = all > 0.0 ? sum / all : 0.0;
      const double spread = (fractions[k] - of_kind[k] * x) * (squares - sum * H);    // all^2 times variances
      row[0] = of_kind[k];
      row[1] = x;
      row[2] = of_kind[k] > 0.0 ? products[k] / of_kind[k] : 0.0;
      row[3] = spread > 0.0 ? (products[k] - of_kind[k] * H) / std::sqrt(spread) : 0.0;
    }
  }
}

/* ----------------------------------------------------------------------
   the faces of this rank in the order of compute property/local, which lists angles with their second atom
------------------------------------------------------------------------- */

int ComputeMembraneLipids::list_faces(bool write, const std::vector<double> &bend)
{
  const auto &topology = mesh->topology();
  const LipidPlaces &found = places();
  int count = 0;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    for (int a = 0; a < atom->num_angle[i]; ++a) {
      if (atom->tag[i] != atom->angle_atom2[i][a]) continue;
      const int first = atom->map(atom->angle_atom1[i][a]), third = atom->map(atom->angle_atom3[i][a]);
      if (first < 0 || !(atom->mask[first] & groupbit) || third < 0 || !(atom->mask[third] & groupbit)) continue;
      if (atom->angle_type[i][a] == 0) continue;
      if (write) {
        const int v = mesh->vertex(atom->tag[i]), next = mesh->vertex(atom->angle_atom3[i][a]);
        int face = -1;
        if (v >= 0)
          for (int f : topology.faces_around(v))
            if (topology.face(f)[(Membrane_NS::corner_of(topology.face(f), v) + 1) % 3] == next) face = f;
        for (size_t c = 0; c < columns.size(); ++c) {
          double &value = array_local[count][c];
          value = 0.0;
          if (face < 0) continue;
          if (columns[c].leaflet == CURVATURE) {
            value = 0.5 * (mesh->lipids().outer[face] - mesh->lipids().inner[face]);
            continue;
          }
          if (columns[c].leaflet == BEND) {
            value = bend[face];
            continue;
          }
          value = found.count(columns[c].leaflet, face, found.kind(columns[c].name));
        }
      }
      ++count;
    }
  }
  return count;
}

void ComputeMembraneLipids::compute_local()
{
  invoked_local = update->ntimestep;
  const LipidPlaces &found = places();
  for (const Column &column : columns)
    if (column.leaflet < CURVATURE && found.kind(column.name) < 0)
      error->all(FLERR, "Compute {} membrane/lipids: no membrane has the lipid {}", id, column.name);
  std::vector<double> bend;
  for (const Column &column : columns)
    if (column.leaflet == BEND && bend.empty()) bend = bends();
  size_local_rows = list_faces(false, bend);
  if (size_local_rows > most_faces || !array_local) {
    most_faces = std::max(size_local_rows, 1);
    memory->destroy(array_local);
    memory->create(array_local, most_faces, size_local_cols, "membrane/lipids:array_local");
  }
  list_faces(true, bend);
}

double ComputeMembraneLipids::memory_usage()
{
  return sizeof(double) * (1.0 * most_faces * columns.size() + 1.0 * size_array_rows * (NCOLUMNS + 1)) +
      rules.memory_usage();
}
