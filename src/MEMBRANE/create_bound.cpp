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

#include "create_bound.h"

#include "atom.h"
#include "atom_vec.h"
#include "bound_search.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "group.h"
#include "membrane_mesh_file.h"
#include "membrane_random.h"
#include "mesh_box.h"
#include "mesh_distributed.h"
#include "mesh_gather.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using Eigen::Vector3d;
using Membrane_NS::CounterRandom;
using Membrane_NS::LimitSurfaceOfMesh;
using Membrane_NS::SurfacePoint;

// cells of a face in each direction, and how much more than at its samples a cell may have of the area
static constexpr int CELLS = 4;
static constexpr double MARGIN = 1.25;

// off the surface, in mean edges, so that fix hd/bind leaflet both sees which leaflet it is
static constexpr double HINT = 1.0e-4;

// in vain, for each atom, before it is said that there is no room
static constexpr bigint MOST_TRIES = 10000;

/* ---------------------------------------------------------------------- */

void CreateBound::command(int narg, char **arg)
{
  if (!domain->box_exist) error->all(FLERR, "create_bound needs membranes: use create_membrane or read_data first");
  parse(narg, arg);
  DistributedMesh::of(lmp, "create_bound").update();
  const std::vector<Vector3d> places = file.empty() ? find_places() : find_inclusions();
  count = static_cast<bigint>(places.size());
  if (atom->map_style != Atom::MAP_NONE) atom->map_clear();
  atom->nghost = 0;
  atom->avec->clear_bonus();
  if (comm->layout == Comm::LAYOUT_TILED) comm->coord2proc_setup();
  const int before = atom->nlocal;
  const bigint expected = atom->natoms + count;
  add_atoms(places);
  atom->data_fix_compute_variable(before, atom->nlocal);
  bigint nlocal = atom->nlocal;
  MPI_Allreduce(&nlocal, &atom->natoms, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (atom->natoms != expected)
    error->all(FLERR, "create_bound lost {} atoms", expected - atom->natoms);
  atom->tag_check();
  if (atom->map_style != Atom::MAP_NONE) {
    atom->map_init();
    atom->map_set();
  }
  if (comm->me == 0) utils::logmesg(lmp, "Created {} atoms on membranes\n", count);
}

void CreateBound::parse(int narg, char **arg)
{
  if (narg < 4) utils::missing_cmd_args(FLERR, "create_bound", error);
  const bool all = strcmp(arg[0], "all") == 0;
  count = all ? 0 : utils::bnumeric(FLERR, arg[0], false, lmp);
  if (count < 0) error->all(FLERR, "create_bound number {} must not be negative", arg[0]);
  type = utils::expand_type_int(FLERR, arg[1], Atom::ATOM, lmp);
  if (type < 1 || type > atom->ntypes)
    error->all(FLERR, "create_bound type {} is not one of the {} atom types of the box", arg[1], atom->ntypes);
  const int igroup = group->find(arg[2]);
  if (igroup < 0) error->all(FLERR, "Could not find create_bound membrane group ID {}", arg[2]);
  membranebit = group->bitmask[igroup];
  const bigint number = utils::bnumeric(FLERR, arg[3], false, lmp);
  if (number <= 0) error->all(FLERR, "create_bound seed {} must be positive", arg[3]);
  seed = number;

  for (int iarg = 4; iarg < narg; iarg += 2) {
    const std::string key = arg[iarg];
    const int more = key == "center" ? 2 : key == "inclusions" ? 1 : 0;
    if (iarg + 1 + more >= narg) utils::missing_cmd_args(FLERR, "create_bound " + key, error);
    const std::string word = arg[iarg + 1];
    if (key == "leaflet") {
      if (word != "in" && word != "out" && word != "both")
        error->all(FLERR, "create_bound leaflet {} is not in, out or both", word);
      leaflet = word == "in" ? -1 : word == "out" ? 1 : 0;
    } else if (key == "molecule" || key == "mol") {
      molecule = utils::tnumeric(FLERR, word, false, lmp);
    } else if (key == "height" || key == "min" || key == "mass") {
      const double value = utils::numeric(FLERR, word, false, lmp);
      if (!(value >= 0.0 && std::isfinite(value)) || (key == "mass" && value == 0.0))
        error->all(FLERR, "create_bound {} {} must {}", key, word,
                   key == "mass" ? "be positive" : "not be negative");
      (key == "height" ? height : key == "min" ? least : mass) = value;
    } else if (key == "inclusions") {
      file = word;
      inclusion = utils::inumeric(FLERR, arg[iarg + 2], false, lmp);
    } else if (key == "center") {
      for (int k = 0; k < 3; ++k) center[k] = utils::numeric(FLERR, arg[iarg + 1 + k], false, lmp);
    } else if (key == "scale") {
      scale = utils::numeric(FLERR, word, false, lmp);
      if (!(scale > 0.0)) error->all(FLERR, "create_bound scale {} must be positive", word);
    } else
      error->all(FLERR,
                 "Unknown create_bound keyword {}; known are: leaflet, height, min, mass, molecule, inclusions, center, "
                 "scale", key);
    iarg += more;
  }
  if (all == file.empty())
    error->all(FLERR, "create_bound {}: atoms at random are a number, those at inclusions of a file are all of them",
               arg[0]);
  if (!file.empty() && least > 0.0)
    error->all(FLERR, "create_bound min is for places at random: the file says where inclusions are");
  if (file.empty() && (scale != 1.0 || !center.isZero()))
    error->all(FLERR, "create_bound center and scale are those of a file: say inclusions, too");
}

std::vector<int> CreateBound::components() const
{
  const DistributedMesh &mesh = DistributedMesh::of(lmp, "create_bound");
  const auto &topology = mesh.topology();
  std::vector<int> mine(topology.num_components(), 0), inside(mine.size());
  for (int i = 0; i < atom->nlocal; ++i) {
    const int v = mesh.vertex(atom->tag[i]);
    if (v >= 0 && atom->mask[i] & membranebit) mine[topology.component(v)] = 1;
  }
  MPI_Allreduce(mine.data(), inside.data(), static_cast<int>(mine.size()), MPI_INT, MPI_MAX, world);
  return inside;
}

/* ----------------------------------------------------------------------
   the place on the surface next to the vertex of each inclusion
------------------------------------------------------------------------- */

std::vector<Vector3d> CreateBound::find_inclusions()
{
  std::vector<Vector3d> places;
  std::string message;
  if (comm->me == 0) {
    try {
      places = Membrane_NS::read_inclusions(file, inclusion);
    } catch (const Membrane_NS::MeshError &err) {
      message = err.what();
    }
  }
  int sizes[2] = {static_cast<int>(message.size()), static_cast<int>(places.size())};
  MPI_Bcast(sizes, 2, MPI_INT, 0, world);
  message.resize(sizes[0]);
  MPI_Bcast(message.data(), sizes[0], MPI_CHAR, 0, world);
  if (!message.empty()) error->all(FLERR, "create_bound: {}", message);
  places.resize(sizes[1]);
  MPI_Bcast(places.data(), 3 * sizes[1], MPI_DOUBLE, 0, world);

  const DistributedMesh &mesh = DistributedMesh::of(lmp, "create_bound");
  const auto inside = components();
  std::vector<int> chosen;
  for (size_t c = 0; c < inside.size(); ++c)
    if (inside[c]) chosen.push_back(static_cast<int>(c));
  if (chosen.empty())
    error->all(FLERR, "create_bound: the group has no control points, so there is no membrane to place atoms on");
  const BoundSearch search(mesh, chosen);
  for (Vector3d &place : places) {
    const Vector3d x = scale * place + center;
    const auto found = search.find(x).closest;
    const double away = (found.foot - x).norm();
    if (!(away < mesh.longest_edge()))
      error->all(FLERR,
                 "create_bound: an inclusion of {} at {:.4g} {:.4g} {:.4g} is {:.3g} off the membrane, more than an edge: "
                 "give center and scale as in create_membrane", file, x[0], x[1], x[2], away);
    const int side = leaflet ? leaflet : found.distance < 0.0 ? -1 : 1;
    place = found.foot + side * MAX(height, HINT * mesh.longest_edge()) * found.normal;
  }
  return places;
}

/* ----------------------------------------------------------------------
   A cell of a face is drawn in proportion to a bound of its area element J, a point in it uniform in u
   and v, and this is taken with the probability J over the bound: uniform in area. All ranks do the same.
------------------------------------------------------------------------- */

std::vector<Vector3d> CreateBound::find_places()
{
  DistributedMesh &mesh = DistributedMesh::of(lmp, "create_bound");
  const auto &topology = mesh.topology();
  const auto inside = components();
  const LimitSurfaceOfMesh surface(topology, mesh.triangle_mesh());

  // corners of the cells: (i, j) to (i+1, j+1), of which those beyond the diagonal are mirrored

  struct Cell {
    int face, i, j;
    bool upper;
    double bound;
  };
  std::vector<Cell> cells;
  std::vector<double> sums;
  double sum = 0.0;
  auto element = [&](int face, double u, double v) {
    return surface.evaluate<1>(SurfacePoint{face, u, v}).area_vector().norm();
  };
  auto place_in = [&](const Cell &cell, double a, double b) {
    if (a + b > 1.0) {
      a = 1.0 - a;
      b = 1.0 - b;
    }
    const double u = cell.upper ? cell.i + 1 - a : cell.i + a, v = cell.upper ? cell.j + 1 - b : cell.j + b;
    return SurfacePoint{cell.face, u / CELLS, v / CELLS};
  };
  static constexpr double SAMPLES[][2] = {{1.0 / 3, 1.0 / 3}, {0.1, 0.1}, {0.8, 0.1}, {0.1, 0.8}};
  for (int f = 0; f < topology.num_faces(); ++f) {
    if (!inside[topology.component(topology.face(f)[0])]) continue;
    for (int i = 0; i < CELLS; ++i)
      for (int j = 0; i + j < CELLS; ++j)
        for (bool upper : {false, true}) {
          if (upper && i + j == CELLS - 1) continue;
          Cell cell = {f, i, j, upper, 0.0};
          for (const auto &s : SAMPLES) {
            const SurfacePoint p = place_in(cell, s[0], s[1]);
            cell.bound = MAX(cell.bound, MARGIN * element(f, p.u, p.v));
          }
          sum += cell.bound;
          cells.push_back(cell);
          sums.push_back(sum);
        }
  }
  if (cells.empty() && count > 0)
    error->all(FLERR, "create_bound: the group has no control points, so there is no membrane to place atoms on");

  const CounterRandom random(seed ^ 0x626f756e6400ULL, 0);
  std::vector<Vector3d> places, others;
  if (least > 0.0) others = other_atoms(mesh);
  bigint tries = 0;
  for (uint64_t k = 0; (bigint) places.size() < count; ++k) {
    if (++tries > MOST_TRIES)
      error->all(FLERR, "create_bound: only {} of {} atoms have room at a distance of {:.4g}", places.size(), count,
                 least);
    const auto a = random.uniforms(k, 0), b = random.uniforms(k, 1);
    const size_t which = std::lower_bound(sums.begin(), sums.end(), a[0] * sum) - sums.begin();
    const Cell &cell = cells[MIN(which, cells.size() - 1)];
    const auto c = random.uniforms(k, 2);
    const auto jet = surface.evaluate<1>(place_in(cell, b[0], b[1]));
    if (a[1] * cell.bound > jet.area_vector().norm()) continue;
    const int side = leaflet ? leaflet : c[0] < 0.5 ? -1 : 1;
    const Vector3d x = jet.position() + side * MAX(height, HINT * surface.mean_edge()) * jet.normal();
    auto too_close = [&](const Vector3d &y) {
      return surface.nearest_image(y - x).squaredNorm() < least * least;
    };
    if (least > 0.0 &&
        (std::any_of(places.begin(), places.end(), too_close) ||
         std::any_of(others.begin(), others.end(), too_close)))
      continue;
    places.push_back(x);
    tries = 0;
  }
  return places;
}

/// Positions of all atoms that are no control points.

std::vector<Vector3d> CreateBound::other_atoms(const DistributedMesh &mesh) const
{
  std::vector<std::array<double, 3>> mine;
  for (int i = 0; i < atom->nlocal; ++i)
    if (mesh.vertex(atom->tag[i]) < 0) mine.push_back({atom->x[i][0], atom->x[i][1], atom->x[i][2]});
  std::vector<Vector3d> all;
  for (const auto &x : gather_all(mine, world)) all.emplace_back(x[0], x[1], x[2]);
  return all;
}

void CreateBound::add_atoms(const std::vector<Vector3d> &places)
{
  tagint most = 0, last;
  for (int i = 0; i < atom->nlocal; ++i) most = MAX(most, atom->tag[i]);
  MPI_Allreduce(&most, &last, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  if ((bigint) last + count >= MAXTAGINT)
    error->all(FLERR, "create_bound: too many atoms for their IDs; build LAMMPS with BIGBIG");
  for (const Vector3d &place : places)
    if (const int k = beyond_fixed_side(*domain, place.data()); k >= 0)
      error->all(FLERR,
                 "create_bound: an atom at ({:.6g}, {:.6g}, {:.6g}) is outside the box, which is not periodic in {}: enlarge "
                 "the box", place[0], place[1], place[2], "xyz"[k]);
  for (const Vector3d &place : places) {
    double x[3] = {place[0], place[1], place[2]}, lamda[3];
    imageint image = ((imageint) IMGMAX << IMG2BITS) | ((imageint) IMGMAX << IMGBITS) | IMGMAX;
    domain->remap(x, image);
    double *coordinates = x;
    if (domain->triclinic) {
      domain->x2lamda(x, lamda);
      coordinates = lamda;
    }
    ++last;
    int px, py, pz;
    double c[3] = {coordinates[0], coordinates[1], coordinates[2]};
    if (comm->coord2proc(c, px, py, pz) != comm->me) continue;
    atom->avec->create_atom(type, x);
    const int i = atom->nlocal - 1;
    atom->tag[i] = last;
    if (mass > 0.0 && atom->rmass) atom->rmass[i] = mass;
    if (atom->molecule_flag) atom->molecule[i] = molecule;
  }
}
