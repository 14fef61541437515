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

#include "srd_streaming.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "modify.h"

using namespace LAMMPS_NS;
using Membrane_NS::BoxWalls;

/* ---------------------------------------------------------------------- */

void SRDStreaming::find_walls()
{
  constexpr int FIXED = 1;
  for (int f = 0; f < BoxWalls::FACES; ++f) {
    const int k = f / 2;
    walls.present[f] = !domain->periodicity[k];
    if (!walls.present[f]) continue;
    if (domain->boundary[k][f % 2] != FIXED)
      error->all(FLERR,
                 "Fix srd/mesh: the boundary of the box in {} shrinks, so it cannot be a wall for "
                 "solvent: use boundary f or p",
                 "xyz"[k]);
    const bool tilted = (k == 0 && (domain->xy != 0.0 || domain->xz != 0.0)) ||
        (k == 1 && domain->yz != 0.0);
    if (tilted)
      error->all(FLERR, "Fix srd/mesh: walls in {} of a box that is tilted there are not known",
                 "xyz"[k]);
    for (auto &fix : modify->get_fix_list())
      if (fix->box_change & (Fix::BOX_CHANGE_X << k))
        error->all(FLERR, "Fix srd/mesh: fix {} moves the box in {}, where solvent has walls",
                   fix->id, "xyz"[k]);
  }
  place_walls();
}

void SRDStreaming::place_walls()
{
  for (int k = 0; k < 3; ++k) {
    walls.position[2 * k] = domain->boxlo[k];
    walls.position[2 * k + 1] = domain->boxhi[k];
  }
}

/* ---------------------------------------------------------------------- */

void SRDStreaming::stream(const SRDSolvent &solvent, double dt, const std::vector<char> *held,
                          std::vector<int> *turned)
{
  if (solvent.count() == 0) return;
  double *x = atom->x[0], *v = atom->v[0];

  if (walls.any()) {
    place_walls();
    for (int i = solvent.first(); i < solvent.last(); ++i) {
      if (!solvent.has(i) || (held && (*held)[i])) continue;
      if (walls.stream(x + 3 * (size_t) i, v + 3 * (size_t) i, solvent.mass()[i], dt) && turned)
        turned->push_back(i);
    }
    return;
  }
  if (solvent.dense()) {
    const size_t last = 3 * (size_t) solvent.last();
    for (size_t j = 3 * (size_t) solvent.first(); j < last; ++j) x[j] += dt * v[j];
    return;
  }
  for (int i = solvent.first(); i < solvent.last(); ++i)
    if (solvent.has(i))
      for (size_t j = 3 * (size_t) i; j < 3 * (size_t) i + 3; ++j) x[j] += dt * v[j];
}
