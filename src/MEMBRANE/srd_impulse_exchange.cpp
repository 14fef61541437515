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
using Membrane_NS::SurfaceImpulse;

// far more than any step takes, unless impulses are not numbers, and so differ from themselves
static constexpr int MOST_EXCHANGES = 1000;

/* ---------------------------------------------------------------------- */

ImpulseExchange::ImpulseExchange(LAMMPS *lmp, SurfaceMotion &motion, std::string user) :
    Pointers(lmp), motion(motion), user(std::move(user)), exchanges(0)
{
}

void ImpulseExchange::find_partners()
{
  partners.clear();
  partner_of.assign(comm->nprocs, -1);
  if (comm->nprocs == 1) return;
  const SRDSurfacePart &here = motion.here();
  for (int a = 0; a < here.num_masses(); ++a)
    for (const int *rank = here.first_sharer(a); rank != here.last_sharer(a); ++rank) {
      if (partner_of[*rank] >= 0) continue;
      partner_of[*rank] = static_cast<int>(partners.size());
      partners.push_back({*rank, {}, {}, 0, 0});
    }
  concerned.resize(partners.size());
  requests.resize(2 * partners.size());
  statuses.resize(2 * partners.size());
}

/* ---------------------------------------------------------------------- */

void ImpulseExchange::begin()
{
  sent.clear();
  others.clear();
  exchanges = 0;
}

// which partners have a mass that an impulse acts on; whether any has

bool ImpulseExchange::find_concerned(const SurfaceImpulse &impulse)
{
  bool any = false;
  if (impulse.control >= 0) {    // far around
    std::fill(concerned.begin(), concerned.end(), 1);
    return !partners.empty();
  }
  std::fill(concerned.begin(), concerned.end(), 0);
  const auto *corners = motion.here().corners();
  for (int v : impulse.vertex)
    if (corners)
      for (const auto &entry : corners->masses_of(v)) add_sharers(entry.first, any);
    else
      add_sharers(v, any);
  return any;
}

void ImpulseExchange::add_sharers(int mass, bool &any)
{
  if (motion.inverse_masses()[mass] == 0.0) return;
  const SRDSurfacePart &here = motion.here();
  for (const int *rank = here.first_sharer(mass); rank != here.last_sharer(mass); ++rank) {
    concerned[partner_of[*rank]] = 1;
    any = true;
  }
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

  const SRDSurfacePart &here = motion.here();
  std::vector<SurfaceImpulse> now;
  for (Partner &partner : partners) partner.out.clear();
  for (const SurfaceImpulse &impulse : impulses) {
    if (!find_concerned(impulse)) continue;
    now.push_back(impulse);
    SurfaceImpulse &told = now.back();
    for (int &v : told.vertex) v = here.to_whole(v);
    if (told.control >= 0) told.control = here.to_whole(told.control);
    for (size_t p = 0; p < partners.size(); ++p)
      if (concerned[p]) partners[p].out.push_back(told);
  }
  int differs = now != sent, any;
  MPI_Allreduce(&differs, &any, 1, MPI_INT, MPI_MAX, world);
  if (!any) return false;
  sent = std::move(now);
  send_and_receive();
  return true;
}

void ImpulseExchange::send_and_receive()
{
  int n = 0;
  for (Partner &p : partners) MPI_Irecv(&p.receives, 1, MPI_INT, p.rank, 0, world, &requests[n++]);
  for (Partner &p : partners) {
    p.sends = static_cast<int>(p.out.size());
    MPI_Isend(&p.sends, 1, MPI_INT, p.rank, 0, world, &requests[n++]);
  }
  if (n > 0) MPI_Waitall(n, requests.data(), statuses.data());
  n = 0;
  constexpr int SIZE = sizeof(SurfaceImpulse);
  for (Partner &p : partners) {
    p.in.resize(p.receives);
    if (p.receives > 0)
      MPI_Irecv(p.in.data(), p.receives * SIZE, MPI_BYTE, p.rank, 0, world, &requests[n++]);
  }
  for (Partner &p : partners)
    if (p.sends > 0)
      MPI_Isend(p.out.data(), p.sends * SIZE, MPI_BYTE, p.rank, 0, world, &requests[n++]);
  if (n > 0) MPI_Waitall(n, requests.data(), statuses.data());

  SRDSurfacePart &here = motion.here();
  others.clear();
  for (const Partner &p : partners)
    for (SurfaceImpulse impulse : p.in) {
      for (int &v : impulse.vertex) v = here.hit_from_whole(v);
      if (impulse.control >= 0) impulse.control = here.from_whole(impulse.control);
      others.push_back(impulse);
    }
}
