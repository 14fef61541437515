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

#include "srd_surface_in_cells.h"

#include "atom.h"
#include "membrane_random.h"
#include "srd_cells.h"
#include "srd_surface_motion.h"

using namespace LAMMPS_NS;
using Membrane_NS::VertexField;

// of the random numbers that say with which side a point mass collides, and of thermal velocities
// of those that are held
static constexpr uint64_t SIDE_SEED = 0x73696465, HELD_SEED = 0x68656c64;

/* ---------------------------------------------------------------------- */

SurfaceInCells::SurfaceInCells(LAMMPS *lmp, SurfaceMotion &motion, uint64_t seed) :
    Pointers(lmp), motion(motion), seed(seed)
{
}

void SurfaceInCells::join(SRDCells &cells, bigint step, double kT)
{
  VertexField position;
  motion.masses_now(position, joined);
  MeshPart &part = motion.part();
  const Membrane_NS::CounterRandom random(seed ^ SIDE_SEED, step);
  cells.others.clear();
  for (int i = 0; i < part.owned; ++i) {
    const tagint tag = atom->tag[part.atom_of(i)];
    if (!motion.is_free(i)) {
      double v[3];
      Membrane_NS::thermal_velocity(seed ^ HELD_SEED, step, tag, kT,
                                    motion.mass_of(i), v);
      for (int k = 0; k < 3; ++k) joined[i].c[k] += v[k];
    }
    cells.others.add(position[i].c, joined[i].c, motion.mass_of(i), tag,
                     random.uniforms(tag, 0)[0] < 0.5);
  }
}

void SurfaceInCells::leave(SRDCells &cells, double *momentum)
{
  MeshPart &part = motion.part();
  VertexField change(part.owned);
  for (int i = 0; i < part.owned; ++i)
    for (int k = 0; k < 3; ++k) {
      change[i].c[k] = cells.others.velocity[3 * i + k] - joined[i].c[k];
      momentum[k] += motion.mass_of(i) * change[i].c[k];
    }
  motion.apply(change);
  cells.others.clear();
}
