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

#include "hd_face_watch.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fmt/format.h"
#include "membrane_regularization.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;

// a face with less than this A/D is about to turn over, unless it began with little more: then it
// may fall to a fraction of that
static constexpr double LEAST_UPRIGHT = 1.0 / 50.0;
static constexpr double LEAST_FRACTION = 0.25;

static constexpr bigint PATIENCE = 10000;

// of an edge in a step of mass sampling
static constexpr double MOST_STRAIN = 1.0;

/* ---------------------------------------------------------------------- */

FaceWatch::FaceWatch(LAMMPS *lmp, int groupbit, std::string user) :
    Pointers(lmp), patience(PATIENCE), groupbit(groupbit), user(std::move(user)),
    mesh(lmp, this->user), judged(false), last_step(-1), bad_since(-1), warned(false)
{
}

void FaceWatch::init()
{
  if (mesh.init() == MeshChange::TOPOLOGY) judged = false;
}

/* ----------------------------------------------------------------------
   after reneighbouring. A face whose neighbours are out of reach has grown too much for the energy,
   which says so
------------------------------------------------------------------------- */

void FaceWatch::localize()
{
  const auto &topology = mesh->topology();
  faces.clear();
  for (int f : mesh->owned_faces()) {
    Watched watched;
    watched.face = f;
    bool complete = true;
    for (int k = 0; k < 3; ++k) {
      watched.corner[k] = k == 0 ? atom->map(mesh->tag(topology.face(f)[0]))
                                 : mesh->find_neighbor(watched.corner[0], topology.face(f)[k]);
      if (k == 0 && !(atom->mask[watched.corner[0]] & groupbit)) complete = false;
      complete = complete && watched.corner[k] >= 0;
      if (!complete) break;
    }
    for (int k = 0; complete && k < 3; ++k) {
      watched.across[k] = mesh->find_neighbor(watched.corner[k], topology.opposite(f, k));
      complete = watched.across[k] >= 0;
    }
    if (complete) faces.push_back(watched);
  }
}

double FaceWatch::uprightness(const Watched &watched) const
{
  const double *const corner[3] = {atom->x[watched.corner[0]], atom->x[watched.corner[1]],
                                   atom->x[watched.corner[2]]};
  const double *const across[3] = {atom->x[watched.across[0]], atom->x[watched.across[1]],
                                   atom->x[watched.across[2]]};
  return Membrane_NS::face_uprightness(corner, across);
}

/* ---------------------------------------------------------------------- */

void FaceWatch::begin()
{
  mesh.follow();
  localize();
  if (!judged || update->ntimestep != last_step) judge_start();
  last_step = update->ntimestep;
}

void FaceWatch::judge_start()
{
  judged = true;
  bad_since = -1;
  warned = false;

  // all ranks know all faces, since faces move between ranks

  std::vector<double> mine(mesh->topology().num_faces(), -INFINITY);
  for (const Watched &watched : faces) {
    const double now = uprightness(watched);
    if (now > 0.0) mine[watched.face] = MIN(LEAST_UPRIGHT, LEAST_FRACTION * now);
  }
  least.resize(mine.size());
  MPI_Allreduce(mine.data(), least.data(), mine.size(), MPI_DOUBLE, MPI_MAX, world);
}

void FaceWatch::check(bool due)
{
  last_step = update->ntimestep;
  if (!due) return;
  if (mesh.follow() != MeshChange::NOTHING) localize();

  const Watched *worst = nullptr;
  double least_upright = 0.0;
  for (const Watched &watched : faces) {
    const double now = uprightness(watched);
    if (!(now < least[watched.face]) || (worst && now > least_upright)) continue;
    worst = &watched;
    least_upright = now;
  }
  if (!worst) {
    bad_since = -1;
    return;
  }

  if (bad_since < 0) bad_since = last_step;
  const bool stop = last_step >= bad_since + patience;
  if (warned && !stop) return;
  const std::string what = fmt::format(
      "{}: {} {}, as happens to the mesh of a fluid membrane: keep it in shape with regularize in "
      "pair_coeff, or use a smaller timestep",
      user, mesh->face_name(worst->face),
      least_upright > 0.0 ? fmt::format("collapses (distortion {:.3g})", 1.0 / least_upright - 1.0)
                          : "has turned over");
  if (stop) error->one(FLERR, what);
  warned = true;
  error->warning(FLERR, "{}; unless it recovers, the run stops after step {}", what,
                 bad_since + patience);
}

std::array<double, 9> FaceWatch::edges(const Watched &watched) const
{
  std::array<double, 9> result;
  for (int k = 0; k < 3; ++k) {
    const double *a = atom->x[watched.corner[k]], *b = atom->x[watched.corner[(k + 1) % 3]];
    for (int c = 0; c < 3; ++c) result[3 * k + c] = b[c] - a[c];
  }
  return result;
}

void FaceWatch::hold()
{
  if (mesh.follow() != MeshChange::NOTHING) localize();
  held.resize(faces.size());
  for (size_t i = 0; i < faces.size(); ++i) held[i] = edges(faces[i]);
}

// |after - before|^2 over |after| |before|, so that neither is before the other

bool FaceWatch::torn()
{
  comm->forward_comm();
  int mine = 0, any;
  for (size_t i = 0; i < faces.size() && !mine; ++i) {
    mine = !(uprightness(faces[i]) >= least[faces[i].face]);
    const auto before = held[i], after = edges(faces[i]);
    for (int k = 0; k < 9; k += 3) {
      double change = 0.0, was = 0.0, is = 0.0;
      for (int c = k; c < k + 3; ++c) {
        change += (after[c] - before[c]) * (after[c] - before[c]);
        was += before[c] * before[c];
        is += after[c] * after[c];
      }
      if (!(change < MOST_STRAIN * MOST_STRAIN * std::sqrt(was * is))) mine = 1;
    }
  }
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, world);
  return any;
}

double FaceWatch::memory_usage() const
{
  return sizeof(Watched) * faces.capacity() + sizeof(held[0]) * held.capacity() + sizeof(double) * least.capacity();
}
