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

#include "pair_helfrich.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "mesh_angle_style.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using Membrane_NS::FaceGroup;
using Membrane_NS::Quadrature;

// first in each block of a restart file
static constexpr int RESTART_MARK = 0x48464d31;

// boxes
static constexpr double MOST_SKIN = 10.0;

/* ---------------------------------------------------------------------- */

PairHelfrich::PairHelfrich(LAMMPS *lmp) : Pair(lmp), model(lmp), foreign_integrators(lmp), gaps(lmp)
{
  single_enable = 0;
  restartinfo = 1;
  one_coeff = 0;
  no_virial_fdotr_compute = 1;
  centroidstressflag = CENTROID_NOTAVAIL;
  comm_reverse = comm_reverse_off = 10;
  nextra = HelfrichOutput::COUNT;
  pvector = new double[nextra]();
}

PairHelfrich::~PairHelfrich()
{
  if (copymode) return;
  delete[] pvector;
  if (!allocated) return;
  memory->destroy(setflag);
  memory->destroy(cutsq);
}

/* ---------------------------------------------------------------------- */

void PairHelfrich::settings(int narg, char **arg)
{
  Quadrature quadrature = Quadrature::SIX;
  for (int iarg = 0; iarg < narg; iarg += 2) {
    if (strcmp(arg[iarg], "quadrature") != 0)
      error->all(FLERR, "Unknown pair_style helfrich keyword {}; the only one is: quadrature",
                 arg[iarg]);
    if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "pair_style helfrich quadrature", error);
    if (!Membrane_NS::parse_quadrature(arg[iarg + 1], quadrature))
      error->all(FLERR, "pair_style helfrich quadrature {} is not one of 1, 3, 6, 12, careful",
                 arg[iarg + 1]);
  }
  if (quadrature == Quadrature::ONE && comm->me == 0)
    error->warning(FLERR,
                   "pair_style helfrich quadrature 1 has zero-energy wrinkles and is second-order "
                   "only; results are not to be trusted without comparison to quadrature 6");
  model.set_quadrature(quadrature);
}

/* ----------------------------------------------------------------------
   types without coefficients may exist, as those of solvent: they must have no control points,
   which HelfrichModel::init() checks
------------------------------------------------------------------------- */

void PairHelfrich::allocate()
{
  allocated = 1;
  const int n = atom->ntypes + 1;
  memory->create(setflag, n, n, "pair:setflag");
  memory->create(cutsq, n, n, "pair:cutsq");
  for (int i = 1; i < n; ++i)
    for (int j = 1; j < n; ++j) setflag[i][j] = i == j;
  model.resize(atom->ntypes);
}

void PairHelfrich::coeff(int narg, char **arg)
{
  if (!allocated) allocate();
  if (narg < 4) utils::missing_cmd_args(FLERR, "pair_coeff for pair_style helfrich", error);

  int ilo, ihi, jlo, jhi;
  utils::bounds(FLERR, arg[0], 1, atom->ntypes, ilo, ihi, error);
  utils::bounds(FLERR, arg[1], 1, atom->ntypes, jlo, jhi, error);
  std::vector<int> types;
  for (int i = MAX(ilo, jlo); i <= MIN(ihi, jhi); ++i) types.push_back(i);
  if (types.empty())
    error->all(FLERR,
               "pair_coeff {} {}: pair helfrich has coefficients per control-point type, so give "
               "the same type twice",
               arg[0], arg[1]);
  model.set_coefficients(types, narg - 2, arg + 2);
}

/* ---------------------------------------------------------------------- */

void PairHelfrich::init_style()
{
  set_angle_style_of_faces(lmp);
  model.init();
  if (neighbor->skin > MOST_SKIN * std::max({domain->xprd, domain->yprd, domain->zprd}))
    error->all(FLERR,
               "Pair helfrich: the skin {} of neighbor lists is many times the box, and so would be the number of images: use "
               "the neighbor command with a skin of about an edge, {:.2g}", neighbor->skin, model.mesh().longest_edge());
  if (update->whichflag == 1) foreign_integrators.warn(model.mesh());
}

/* ----------------------------------------------------------------------
   control points act through the mesh, not through neighbor lists: the cutoff only gives LAMMPS a
   length to size its bins with, the ghost cutoff is set by DistributedMesh
------------------------------------------------------------------------- */

double PairHelfrich::init_one(int i, int j)
{
  const bool both = model.has_coefficients(i) && model.has_coefficients(j);
  return both ? model.mesh().longest_edge() : 0.0;
}

void PairHelfrich::setup()
{
  gaps.warn(model.mesh());
}

void PairHelfrich::finish()
{
  model.check_quadrature();
}

/* ---------------------------------------------------------------------- */

void PairHelfrich::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  if (!force->newton) {
    for (int i = atom->nlocal; i < atom->nlocal + atom->nghost; ++i)
      std::fill_n(atom->f[i], 3, 0.0);
    clear_ghost_tallies();
  }

  model.compute({eflag_either != 0, vflag_either != 0, eflag_global != 0});
  if (eflag_either || vflag_either) tally();

  if (!force->newton)
    comm->reverse_comm(this);
  else if (!force->newton_pair && (eflag_atom || vflag_atom)) {
    comm->reverse_comm(this);
    clear_ghost_tallies();
  }
}

void PairHelfrich::clear_ghost_tallies()
{
  for (int i = atom->nlocal; i < atom->nlocal + atom->nghost; ++i) {
    if (eflag_atom) eatom[i] = 0.0;
    if (vflag_atom) std::fill_n(vatom[i], 6, 0.0);
  }
}

/* ----------------------------------------------------------------------
   a face's energy and virial are shared by its corners
------------------------------------------------------------------------- */

void PairHelfrich::tally()
{
  const HelfrichTally &energies = model.energies();
  if (eflag_either) std::copy_n(energies.output, nextra, pvector);
  for (const FaceGroup &group : model.groups())
    for (int s = 0; s < group.nfaces; ++s) {
      const int slot = group.first_slot + s;
      if (eflag_global) eng_vdwl += energies.face[slot];
      if (eflag_atom)
        for (int k = 0; k < 3; ++k) eatom[group.point(s, k)] += energies.face[slot] / 3.0;
      if (!vflag_either) continue;
      const double *v = &model.virials()[6 * (size_t) slot];
      if (vflag_global)
        for (int i = 0; i < 6; ++i) virial[i] += v[i];
      if (vflag_atom)
        for (int k = 0; k < 3; ++k)
          for (int i = 0; i < 6; ++i) vatom[group.point(s, k)][i] += v[i] / 3.0;
    }
}

/* ----------------------------------------------------------------------
   with newton off LAMMPS returns nothing from ghosts: forces and per-atom tallies go back here.
   With newton off for pairs only it returns all, but pair hybrid loses tallies: these go back here
------------------------------------------------------------------------- */

int PairHelfrich::pack_reverse_comm(int n, int first, double *buf)
{
  int m = 0;
  for (int i = first; i < first + n; ++i) {
    for (int k = 0; k < 3; ++k) buf[m++] = force->newton ? 0.0 : atom->f[i][k];
    buf[m++] = eflag_atom ? eatom[i] : 0.0;
    for (int k = 0; k < 6; ++k) buf[m++] = vflag_atom ? vatom[i][k] : 0.0;
  }
  return m;
}

void PairHelfrich::unpack_reverse_comm(int n, int *list, double *buf)
{
  int m = 0;
  for (int j = 0; j < n; ++j) {
    const int i = list[j];
    for (int k = 0; k < 3; ++k) atom->f[i][k] += buf[m++];
    if (eflag_atom) eatom[i] += buf[m];
    ++m;
    for (int k = 0; k < 6; ++k, ++m)
      if (vflag_atom) vatom[i][k] += buf[m];
  }
}

/* ----------------------------------------------------------------------
   restart: settings hold what "init" took as well, since pair_style hybrid writes only those
------------------------------------------------------------------------- */

void PairHelfrich::write_block(FILE *fp, const std::string &bytes)
{
  const bigint size = bytes.size();
  fwrite(&RESTART_MARK, sizeof(int), 1, fp);
  fwrite(&size, sizeof(bigint), 1, fp);
  fwrite(bytes.data(), 1, size, fp);
}

std::string PairHelfrich::read_block(FILE *fp)
{
  int mark = 0;
  bigint size = 0;
  if (comm->me == 0) {
    utils::sfread(FLERR, &mark, sizeof(int), 1, fp, nullptr, error);
    utils::sfread(FLERR, &size, sizeof(bigint), 1, fp, nullptr, error);
  }
  MPI_Bcast(&mark, 1, MPI_INT, 0, world);
  MPI_Bcast(&size, 1, MPI_LMP_BIGINT, 0, world);
  if (mark != RESTART_MARK || size < 0 || size > MAXSMALLINT)
    error->all(FLERR, "The restart file has pair style helfrich in another format, of an older "
                      "version of the package or damaged: continue from a data file");
  std::string bytes(size, '\0');
  if (comm->me == 0) utils::sfread(FLERR, &bytes[0], 1, size, fp, nullptr, error);
  MPI_Bcast(&bytes[0], static_cast<int>(size), MPI_CHAR, 0, world);
  return bytes;
}

void PairHelfrich::write_restart_settings(FILE *fp)
{
  RestartArchive file;
  model.archive_settings(file);
  write_block(fp, file.bytes());
}

void PairHelfrich::read_restart_settings(FILE *fp)
{
  RestartArchive file(read_block(fp));
  model.archive_settings(file);
}

void PairHelfrich::write_restart(FILE *fp)
{
  write_restart_settings(fp);
  RestartArchive file;
  model.archive_coefficients(file);
  write_block(fp, file.bytes());
}

void PairHelfrich::read_restart(FILE *fp)
{
  read_restart_settings(fp);
  allocate();
  RestartArchive file(read_block(fp));
  model.archive_coefficients(file);
}

/* ---------------------------------------------------------------------- */

void *PairHelfrich::extract(const char *name, int &dim)
{
  dim = 0;
  if (strcmp(name, "model") == 0) return &model;
  if (strcmp(name, "lipids") == 0)
    return model.composition().any() ? const_cast<HelfrichLipids *>(&model.composition()) : nullptr;
  if (strcmp(name, "kc") != 0) return nullptr;
  dim = 1;
  moduli = model.bending_moduli();
  return moduli.data();
}

double PairHelfrich::memory_usage()
{
  return Pair::memory_usage() + model.memory_usage();
}
