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

#include "srd_impulse_exchange.h"

#include "comm.h"
#include "error.h"
#include "srd_surface_motion.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;
using Membrane_NS::SurfaceImages;
using Membrane_NS::SurfaceImpulse;

// far more than any step takes, unless impulses are not numbers, and so differ from themselves
static constexpr int MOST_EXCHANGES = 1000;

/* ---------------------------------------------------------------------- */

ImpulseExchange::ImpulseExchange(LAMMPS *lmp, const SurfaceMotion &motion, bool everywhere,
                                 std::string user) :
    Pointers(lmp),
    motion(motion), everywhere(everywhere), user(std::move(user)), exchanges(0)
{
}

void ImpulseExchange::find_shared(const std::vector<SurfaceImages::Image> &images)
{
  if (comm->nprocs == 1 || everywhere) return;
  const auto &surface = motion.surface();
  const size_t n = surface.num_vertices();
  std::vector<int> users(n, 0), sum(n);
  for (const auto &image : images)
    for (int v : surface.faces().faces[image.face]) users[v] = motion.owner(v) == comm->me ? 1 : 2;
  MPI_Allreduce(users.data(), sum.data(), n, MPI_INT, MPI_SUM, world);
  shared.resize(n);
  for (size_t v = 0; v < n; ++v) shared[v] = sum[v] > 1;
}

/* ---------------------------------------------------------------------- */

void ImpulseExchange::begin()
{
  all.clear();
  others.clear();
  exchanges = 0;
}

std::vector<SurfaceImpulse>
ImpulseExchange::that_concern_others(const std::vector<SurfaceImpulse> &impulses) const
{
  if (everywhere) return impulses;
  std::vector<SurfaceImpulse> some;
  for (const SurfaceImpulse &impulse : impulses)
    if (std::any_of(impulse.vertex.begin(), impulse.vertex.end(), [this](int v) {
          return shared[v] && motion.is_free(v);
        }))
      some.push_back(impulse);
  return some;
}

bool ImpulseExchange::exchange(const std::vector<SurfaceImpulse> &impulses)
{
  if (comm->nprocs == 1) return false;
  if (++exchanges > MOST_EXCHANGES)
    error->all(
        FLERR,
        "{}: after {} exchanges the ranks do not agree on the collisions with the surface in step "
        "{}: are velocities numbers? Or use a shorter timestep",
        user, MOST_EXCHANGES, update->ntimestep);

  const std::vector<SurfaceImpulse> mine = that_concern_others(impulses);
  const int nprocs = comm->nprocs;
  int bytes = static_cast<int>(mine.size() * sizeof(SurfaceImpulse));
  std::vector<int> counts(nprocs), starts(nprocs + 1, 0);
  MPI_Allgather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (int p = 0; p < nprocs; ++p) starts[p + 1] = starts[p] + counts[p];
  std::vector<SurfaceImpulse> now(starts.back() / sizeof(SurfaceImpulse));
  if (!now.empty())
    MPI_Allgatherv(mine.data(), bytes, MPI_BYTE, now.data(), counts.data(), starts.data(), MPI_BYTE,
                   world);
  if (now == all) return false;

  const auto first = now.begin() + starts[comm->me] / sizeof(SurfaceImpulse);
  others.assign(now.begin(), first);
  others.insert(others.end(), first + mine.size(), now.end());
  all = std::move(now);
  return true;
}
