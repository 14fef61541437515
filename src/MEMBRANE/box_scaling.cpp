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

#include "box_scaling.h"

#include "atom.h"
#include "domain.h"
#include "mesh_box.h"

#include <algorithm>
#include <utility>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

std::array<double, 9> BoxScaling::present() const
{
  return {domain->boxlo[0], domain->boxlo[1], domain->boxlo[2], domain->boxhi[0], domain->boxhi[1],
          domain->boxhi[2], domain->xy,       domain->xz,       domain->yz};
}

void BoxScaling::set(const std::array<double, 9> &to)
{
  for (int k = 0; k < 3; ++k) {
    domain->boxlo[k] = to[k];
    domain->boxhi[k] = to[3 + k];
  }
  if (domain->triclinic) {
    domain->xy = to[6];
    domain->xz = to[7];
    domain->yz = to[8];
  }
  domain->set_global_box();
  domain->set_local_box();
}

void BoxScaling::begin(std::vector<Cell> cells_of_atoms)
{
  box = present();
  vectors = box_vectors(*domain);
  cells = std::move(cells_of_atoms);
  const int n = 3 * atom->nlocal;
  positions.assign(n ? atom->x[0] : nullptr, n ? atom->x[0] + n : nullptr);
}

/* ----------------------------------------------------------------------
   the columns of the box are (x), (xy, y), (xz, yz, z), each component stretched with its direction
------------------------------------------------------------------------- */

void BoxScaling::apply(const std::array<double, 3> &a)
{
  std::array<double, 9> to = box;
  double centre[3];
  const double tilt[3] = {0.5 * (box[6] + box[7]), 0.5 * box[8], 0.0};
  for (int k = 0; k < 3; ++k) {
    const double half = 0.5 * (box[3 + k] - box[k]), middle = 0.5 * (box[k] + box[3 + k]);
    centre[k] = middle + tilt[k];
    to[k] = centre[k] - a[k] * (half + tilt[k]);
    to[3 + k] = to[k] + 2.0 * a[k] * half;
  }
  to[6] *= a[0];
  to[7] *= a[0];
  to[8] *= a[1];
  set(to);
  const Eigen::Matrix3d shrinks = vectors - box_vectors(*domain);
  for (int i = 0; i < atom->nlocal; ++i) {
    const double *x = &positions[3 * (size_t) i];
    Eigen::Vector3d stays = Eigen::Vector3d::Map(x);
    if (!cells.empty()) stays += shrinks * Eigen::Map<const Eigen::Vector3i>(cells[i].data()).cast<double>();
    for (int k = 0; k < 3; ++k) atom->x[i][k] = atom->mask[i] & groupbit ? centre[k] + a[k] * (x[k] - centre[k]) : stays[k];
  }
}

void BoxScaling::put_back()
{
  set(box);
  std::copy(positions.begin(), positions.end(), atom->nlocal ? atom->x[0] : nullptr);
}
