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

#include "create_solvent.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "membrane_mesh_shapes.h"
#include "membrane_random.h"
#include "mesh_distributed.h"
#include "region.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using Eigen::Vector3d;
using Membrane_NS::CounterRandom;
using Membrane_NS::Face;
using Membrane_NS::SurfaceSide;
using Membrane_NS::TriangleMesh;

static constexpr uint64_t POSITION_NUMBERS = 0x706f7369740000ULL;

// candidates that all ranks look at together; and how often in vain before giving up
static constexpr int BATCH = 1 << 16;
static constexpr int MOST_EMPTY_BATCHES = 100;

/* ---------------------------------------------------------------------- */

void CreateSolvent::command(int narg, char **arg)
{
  if (!domain->box_exist) error->all(FLERR, "create_solvent needs a box: use create_box first");
  if (domain->dimension != 3) error->all(FLERR, "create_solvent needs dimension 3");
  parse(narg, arg);
  if (side != Side::BOTH || distance > 0.0) find_membranes();

  const double box = domain->xprd * domain->yprd * domain->zprd;
  const double volume = side == Side::BOTH ? box : side == Side::INSIDE ? enclosed : box - enclosed;
  const double wanted = std::round(density * volume);
  if (wanted >= MAXTAGINT)
    error->all(FLERR, "create_solvent: {:.4g} atoms are too many for their IDs", wanted);

  if (region) region->prematch();
  if (atom->map_style != Atom::MAP_NONE) atom->map_clear();
  atom->nghost = 0;
  atom->avec->clear_bonus();
  if (comm->layout == Comm::LAYOUT_TILED) comm->coord2proc_setup();
  const int nlocal_before = atom->nlocal;
  const bigint natoms_before = atom->natoms;
  const bigint added = add_atoms(static_cast<bigint>(wanted));
  atom->data_fix_compute_variable(nlocal_before, atom->nlocal);
  finish(natoms_before + added);
  if (comm->me == 0) utils::logmesg(lmp, "Created {} solvent atoms\n", added);
}

/* ---------------------------------------------------------------------- */

void CreateSolvent::parse(int narg, char **arg)
{
  if (narg < 4) utils::missing_cmd_args(FLERR, "create_solvent", error);
  type = utils::expand_type_int(FLERR, arg[0], Atom::ATOM, lmp);
  if (type < 1 || type > atom->ntypes)
    error->all(FLERR, "create_solvent type {} is not one of the {} atom types of the box", arg[0],
               atom->ntypes);
  if (strcmp(arg[1], "inside") == 0)
    side = Side::INSIDE;
  else if (strcmp(arg[1], "outside") == 0)
    side = Side::OUTSIDE;
  else if (strcmp(arg[1], "both") == 0)
    side = Side::BOTH;
  else
    error->all(FLERR, "create_solvent side {} is not inside, outside or both", arg[1]);
  density = utils::numeric(FLERR, arg[2], false, lmp);
  if (!(density > 0.0)) error->all(FLERR, "create_solvent density {} must be positive", arg[2]);
  const bigint number = utils::bnumeric(FLERR, arg[3], false, lmp);
  if (number <= 0) error->all(FLERR, "create_solvent seed {} must be positive", arg[3]);
  seed = number;

  for (int iarg = 4; iarg < narg; iarg += 2) {
    const std::string key = arg[iarg];
    if (iarg + 1 >= narg) utils::missing_cmd_args(FLERR, "create_solvent " + key, error);
    const char *word = arg[iarg + 1];
    if (key == "mass") {
      mass = utils::numeric(FLERR, word, false, lmp);
      if (!(mass > 0.0)) error->all(FLERR, "create_solvent mass {} must be positive", word);
      if (!atom->rmass)
        error->all(FLERR,
                   "create_solvent mass: atoms of this atom style have the mass of their "
                   "type, see the mass command");
    } else if (key == "molecule" || key == "mol") {
      molecule = utils::tnumeric(FLERR, word, false, lmp);
      if (!atom->molecule_flag)
        error->all(FLERR, "create_solvent molecule: atoms of this atom style have no molecule IDs");
    } else if (key == "distance") {
      distance = utils::numeric(FLERR, word, false, lmp);
      if (distance < 0.0)
        error->all(FLERR, "create_solvent distance {} must not be negative", word);
    } else if (key == "region") {
      region = domain->get_region_by_id(word);
      if (!region) error->all(FLERR, "create_solvent: there is no region {}", word);
      region->init();
    } else
      error->all(FLERR,
                 "Unknown create_solvent keyword {}; known are: mass, molecule, distance, region",
                 key);
  }
}

/* ----------------------------------------------------------------------
   the same surface that fix srd/mesh bounces solvent off
------------------------------------------------------------------------- */

void CreateSolvent::find_membranes()
{
  DistributedMesh &mesh = DistributedMesh::of(lmp, "create_solvent");
  mesh.update();
  const auto &topology = mesh.topology();
  surface = mesh.triangle_mesh();
  surface.points = Membrane_NS::limit_positions(surface);
  const Vector3d corner(domain->boxlo[0], domain->boxlo[1], domain->boxlo[2]);
  for (Vector3d &p : surface.points) p -= corner;
  if (distance > 0.0 && !surface.faces.empty())
    clearance = std::make_unique<Membrane_NS::SurfaceClearance>(surface, distance);
  if (side == Side::BOTH) return;

  std::vector<Vector3d> fractions;
  const Eigen::Matrix3d to_fraction = surface.lattice.inverse();
  for (const Vector3d &p : surface.points) fractions.push_back(to_fraction * p);
  std::vector<std::vector<Face>> faces(topology.num_components());
  for (const Face &face : surface.faces) faces[topology.component(face[0])].push_back(face);
  for (int c = 0; c < topology.num_components(); ++c) {
    if (!mesh.is_closed(c)) {
      faces[c].clear();
      continue;
    }
    closed.emplace_back(fractions, faces[c], 2, surface.periodic);
  }
  if (closed.empty())
    error->all(FLERR, "create_solvent {}: there is no closed membrane, which would have an inside",
               side == Side::INSIDE ? "inside" : "outside");
  enclosed = find_enclosed(faces);
}

/* ----------------------------------------------------------------------
   volume inside of any of them: those that are within others add nothing
------------------------------------------------------------------------- */

double CreateSolvent::find_enclosed(const std::vector<std::vector<Face>> &faces)
{
  const Eigen::Matrix3d to_fraction = surface.lattice.inverse();
  double sum = 0.0;
  int number = 0;
  for (const auto &part : faces) {
    if (part.empty()) continue;
    const Vector3d first = surface.points[part[0][0]], fraction = to_fraction * first;
    bool within = false;
    for (int other = 0; other < static_cast<int>(closed.size()); ++other)
      within = within || (other != number && closed[other].level(fraction) != 0);
    ++number;
    if (within) continue;
    double volume = 0.0;
    for (const Face &f : part)
      volume += (surface.points[f[0]] - first)
                    .dot((surface.points[f[1]] - first).cross(surface.points[f[2]] - first)) /
          6.0;
    sum += std::fabs(volume);
  }
  return sum;
}

bool CreateSolvent::is_inside(const Vector3d &fraction) const
{
  return std::any_of(closed.begin(), closed.end(), [&](const SurfaceSide &s) {
    return s.level(fraction) != 0;
  });
}

/// Of those on the right side: what the options leave.

bool CreateSolvent::is_wanted(const double *x, const double *fraction) const
{
  if (region && !region->match(x[0], x[1], x[2])) return false;
  return !clearance ||
      clearance->is_clear(surface.lattice * Vector3d(fraction[0], fraction[1], fraction[2]));
}

/* ----------------------------------------------------------------------
   of places that are uniform in the box, the first n on the right side. Each rank looks at those in
   its sub-domain; all count together.
------------------------------------------------------------------------- */

bigint CreateSolvent::add_atoms(bigint n)
{
  tagint most = 0, last;
  for (int i = 0; i < atom->nlocal; ++i) most = MAX(most, atom->tag[i]);
  MPI_Allreduce(&most, &last, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  if ((bigint) last + n >= MAXTAGINT)
    error->all(FLERR, "create_solvent: too many atoms for their IDs; build LAMMPS with BIGBIG");

  // 0: another rank's or on the wrong side, 1: on the right side but not wanted, 2: to be made

  const CounterRandom random(seed ^ POSITION_NUMBERS, 0);
  std::vector<int> mine(BATCH), all(BATCH);
  std::vector<std::array<double, 3>> places(BATCH);
  bigint counted = 0, added = 0;
  int empty = 0;
  for (bigint start = 0; counted < n; start += BATCH) {
    for (int i = 0; i < BATCH; ++i) {
      const auto a = random.uniforms(start + i, 0), b = random.uniforms(start + i, 1);
      double fraction[3] = {a[0], a[1], b[0]};
      double *x = places[i].data();
      if (domain->triclinic)
        domain->lamda2x(fraction, x);
      else
        for (int k = 0; k < 3; ++k) x[k] = domain->boxlo[k] + fraction[k] * domain->prd[k];
      mine[i] = 0;
      if (!is_here(domain->triclinic ? fraction : x)) continue;
      if (side != Side::BOTH &&
          is_inside(Vector3d(fraction[0], fraction[1], fraction[2])) != (side == Side::INSIDE))
        continue;
      mine[i] = is_wanted(x, fraction) ? 2 : 1;
    }
    MPI_Allreduce(mine.data(), all.data(), BATCH, MPI_INT, MPI_MAX, world);
    const bigint before = counted;
    for (int i = 0; i < BATCH && counted < n; ++i) {
      counted += all[i] > 0;
      if (all[i] < 2) continue;
      ++added;
      if (mine[i]) add_atom(places[i].data(), last + added);
    }
    if (counted == before && ++empty == MOST_EMPTY_BATCHES)
      error->all(FLERR, "create_solvent: found no place for atoms; is the membrane very small?");
  }
  return added;
}

bool CreateSolvent::is_here(const double *coordinates)
{
  double c[3] = {coordinates[0], coordinates[1], coordinates[2]};
  int px, py, pz;
  return comm->coord2proc(c, px, py, pz) == comm->me;
}

void CreateSolvent::add_atom(const double *x, tagint id)
{
  double place[3] = {x[0], x[1], x[2]};
  atom->avec->create_atom(type, place);
  const int i = atom->nlocal - 1;
  atom->tag[i] = id;
  if (mass > 0.0) atom->rmass[i] = mass;
  if (atom->molecule_flag) atom->molecule[i] = molecule;
}

void CreateSolvent::finish(bigint expected)
{
  bigint nlocal = atom->nlocal;
  MPI_Allreduce(&nlocal, &atom->natoms, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (atom->natoms != expected)
    error->all(FLERR, "create_solvent lost {} atoms", expected - atom->natoms);
  atom->tag_check();
  if (atom->map_style != Atom::MAP_NONE) {
    atom->map_init();
    atom->map_set();
  }
}
