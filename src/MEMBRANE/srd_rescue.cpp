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

#include "srd_rescue.h"

#include "atom.h"
#include "membrane_random.h"
#include "membrane_srd_collision.h"
#include "srd_solvent.h"
#include "srd_surface_motion.h"

#include <cmath>

using namespace LAMMPS_NS;
using Eigen::Vector3d;

/* ---------------------------------------------------------------------- */

SurfaceRescue::SurfaceRescue(LAMMPS *lmp, SurfaceMotion &motion, SurfaceRegions &regions) :
    Pointers(lmp), motion(motion), regions(regions)
{
}

SurfaceRescue::Counts SurfaceRescue::put_back(const SRDSolvent &solvent, double contact,
                                            bigint step)
{
  Counts counts;
  for (const auto &crossing : regions.find_crossings(solvent)) {
    const Vector3d nearest = nearest_point(crossing);
    const Vector3d x = Vector3d::Map(atom->x[crossing.atom]);
    if ((x - nearest).norm() <= contact) continue;
    ++counts.crossed;
    if (put_beside(crossing, nearest) || put_anywhere(crossing, step)) ++counts.rescued;
  }
  return counts;
}

bigint SurfaceRescue::count(const SRDSolvent &solvent, double contact) const
{
  bigint n = 0;
  for (const auto &crossing : regions.find_crossings(solvent))
    n += (Vector3d::Map(atom->x[crossing.atom]) - nearest_point(crossing)).norm() > contact;
  return n;
}

// the point of a surface nearest to an atom, in the image nearest to it

Vector3d SurfaceRescue::nearest_point(const SurfaceRegions::Crossing &crossing) const
{
  const auto &surface = motion.surface().faces();
  const auto &places = regions.places();
  const Eigen::Matrix3d box = motion.lattice(), to_fraction = box.inverse();
  const Vector3d x = Vector3d::Map(atom->x[crossing.atom]);
  Vector3d nearest = x;
  double least = INFINITY;
  for (size_t f = 0; f < surface.faces.size(); ++f) {
    if (motion.surface().component(f) != crossing.component) continue;
    std::array<Vector3d, 3> corner;
    for (int k = 0; k < 3; ++k) {
      const auto &seam = surface.seams[f][k];
      corner[k] =
          places[surface.faces[f][k]].path.origin + box * Vector3d(seam[0], seam[1], seam[2]);
    }
    Vector3d images = to_fraction * (x - corner[0]);
    for (int k = 0; k < 3; ++k) images[k] = domain->periodicity[k] ? std::round(images[k]) : 0.0;
    for (Vector3d &c : corner) c += box * images;
    const auto b = Membrane_NS::nearest_on_triangle(x, corner[0], corner[1], corner[2]);
    const Vector3d p = b[0] * corner[0] + b[1] * corner[1] + b[2] * corner[2];
    if ((p - x).squaredNorm() >= least) continue;
    least = (p - x).squaredNorm();
    nearest = p;
  }
  return nearest;
}

/* ----------------------------------------------------------------------
   on its own side, close to where it crossed: straight back over the surface, which at an edge leads in between
   the faces. Close enough not to come through the next surface, but not closer: without slip an atom
   flies to and fro in a valley, and so close to the bottom thousands of times in a step. It keeps its
   velocity, and the surface takes the momentum when the two meet
------------------------------------------------------------------------- */

bool SurfaceRescue::put_beside(const SurfaceRegions::Crossing &crossing, const Vector3d &nearest)
{
  const int i = crossing.atom, region = regions.region[i];
  const Vector3d back = (nearest - Vector3d::Map(atom->x[i])).normalized();
  for (double distance = 0.1; distance > 0.5e-6; distance *= 0.1)
    for (double sign : {1.0, -1.0}) {
      const Vector3d x = nearest + sign * distance * motion.surface().mesh_edge() * back;
      if (!regions.belongs(x.data(), atom->image[i], region)) continue;
      Vector3d::Map(atom->x[i]) = x;
      return true;
    }
  return false;
}

bool SurfaceRescue::put_anywhere(const SurfaceRegions::Crossing &crossing, bigint step)
{
  const int i = crossing.atom;
  Vector3d x;
  constexpr int TRIALS = 1000;
  const Membrane_NS::CounterRandom random(atom->tag[i], step);
  for (int trial = 0; trial < TRIALS; ++trial) {
    const auto a = random.uniforms(trial, 0), b = random.uniforms(trial, 1);
    const double s[3] = {a[0], a[1], b[0]};
    if (domain->triclinic) {
      double lamda[3];
      for (int k = 0; k < 3; ++k)
        lamda[k] =
            domain->sublo_lamda[k] + s[k] * (domain->subhi_lamda[k] - domain->sublo_lamda[k]);
      domain->lamda2x(lamda, x.data());
    } else
      for (int k = 0; k < 3; ++k)
        x[k] = domain->sublo[k] + s[k] * (domain->subhi[k] - domain->sublo[k]);
    if (!regions.belongs(x.data(), atom->image[i], regions.region[i])) continue;
    Vector3d::Map(atom->x[i]) = x;
    return true;
  }
  return false;
}
