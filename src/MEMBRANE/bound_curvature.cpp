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

#include "bound_curvature.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "helfrich_model.h"
#include "mesh_distributed.h"
#include "modify.h"
#include "pair.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using Eigen::Vector3d;
using Membrane_NS::CurvatureCoupling;
using Membrane_NS::MeshError;

// footprints of area a and radius rho that leave the energy bounded have a (1 - kp/kc) less than this times rho^2
static constexpr double BOUNDED = 7.0 / 16.0 * 3.14159265358979323846;

/* ---------------------------------------------------------------------- */

int BoundCurvature::parse(int narg, char **arg)
{
  const std::string key = arg[0];
  const bool directed = key == "bar";
  const int words = directed ? 8 : 6;
  if (narg < words) utils::missing_cmd_args(FLERR, "fix hd/bind " + key, error);
  const int type = utils::expand_type_int(FLERR, arg[1], Atom::ATOM, lmp);
  if (type < 1 || type > atom->ntypes)
    error->all(FLERR, "Fix hd/bind {} type {} does not exist", key, arg[1]);
  auto number = [&](int i) { return utils::numeric(FLERR, arg[i], false, lmp); };
  CurvatureCoupling c;
  c.area = number(2);
  if (directed) {
    c.k_par = number(3);
    c.c_par = number(4);
    c.k_perp = number(5);
    c.c_perp = number(6);
  } else {
    c.kp = number(3);
    c.c0p = number(4);
  }
  c.radius = number(words - 1);
  if (!(c.area > 0.0 && std::isfinite(c.area)))
    error->all(FLERR, "Fix hd/bind {}: the area {} of a footprint must be positive", key, arg[2]);
  if (!(c.radius > 0.0 && std::isfinite(c.radius)))
    error->all(FLERR, "Fix hd/bind {}: the radius {} of a footprint must be positive", key, arg[words - 1]);
  if (!(c.kp >= 0.0 && c.k_par >= 0.0 && c.k_perp >= 0.0))
    error->all(FLERR, "Fix hd/bind {}: bending moduli must not be negative", key);
  if (directed && c.k_par == 0.0 && c.k_perp == 0.0)
    error->all(FLERR, "Fix hd/bind bar: without a modulus there is no direction, use footprint");
  coupling[type] = c;
  return words;
}

bool BoundCurvature::has_director(int type) const
{
  const auto found = coupling.find(type);
  return found != coupling.end() && found->second.has_director();
}

double BoundCurvature::area(int type) const
{
  const auto found = coupling.find(type);
  return found == coupling.end() ? 0.0 : found->second.area;
}

double BoundCurvature::radius() const
{
  double most = 0.0;
  for (const auto &entry : coupling) most = MAX(most, entry.second.radius);
  return most;
}

void BoundCurvature::init(const DistributedMesh &mesh, int membranebit)
{
  if (!any()) return;
  int dim;
  auto *pair = force->pair_match("helfrich", 1, 1);
  if (!pair)
    error->all(FLERR, "Fix hd/bind footprint needs pair_style helfrich: a footprint stands in place of the bare "
                      "membrane");
  auto *model = static_cast<HelfrichModel *>(pair->extract("model", dim));
  quadrature = model->quadrature();
  footprints.reset();

  const auto moduli = model->bending_moduli();
  const int n = atom->ntypes + 1;
  std::vector<int> mine(n, 0), types(n);
  for (int i = 0; i < atom->nlocal; ++i)
    if (mesh.vertex(atom->tag[i]) >= 0 && atom->mask[i] & membranebit) mine[atom->type[i]] = 1;
  MPI_Allreduce(mine.data(), types.data(), n, MPI_INT, MPI_MAX, world);
  int first = 0;
  for (int t = 1; t < n; ++t) {
    if (!types[t]) continue;
    if (!first) first = t;
    if (moduli[t] != moduli[first] || model->spontaneous_curvature(t) != model->spontaneous_curvature(first))
      error->all(FLERR,
                 "Fix hd/bind footprint: control points of types {} and {} have different kc or c0, so it is not "
                 "known what a footprint stands in place of: bind to one of them by its group",
                 first, t);
  }
  if (!first) return;
  if (comm->me == 0 && (model->has_term("leaflets", first) || !modify->get_fix_by_style("^hd/lipids$").empty()))
    error->warning(FLERR, "Fix hd/bind footprint stands in place of a bilayer with the c0 of pair_coeff: leaflets, and the single "
                          "lipids of fix hd/lipids underneath, make no difference to it");

  // the area of the smallest membrane, by its triangles

  const auto control = mesh.triangle_mesh();
  const auto &topology = mesh.topology();
  std::vector<double> area(topology.num_components(), 0.0);
  for (const auto &face : topology.faces())
    area[topology.component(face[0])] +=
        0.5 * control.edge(face[0], face[1]).cross(control.edge(face[0], face[2])).norm();
  const double smallest = *std::min_element(area.begin(), area.end());
  for (auto &[type, c] : coupling) {
    c.kc = moduli[first];
    c.c0 = model->spontaneous_curvature(first);
    const double along = c.k_par + c.k_perp > 0.0 ? c.k_par * c.k_perp / (c.k_par + c.k_perp) : 0.0;
    const double lacking = c.area * (1.0 - (c.kp + along) / c.kc);
    if (lacking > BOUNDED * c.radius * c.radius && comm->me == 0)
      error->warning(FLERR,
                     "Fix hd/bind footprint of type {} is softer than the membrane over an area that its radius {:.4g} "
                     "does not cover: the membrane may bend without end; {:.4g} is always enough",
                     type, c.radius, std::sqrt(lacking / BOUNDED));
    if (c.area > smallest)
      error->all(FLERR, "Fix hd/bind footprint of type {}: the area {:.4g} is larger than that of a membrane, {:.4g}",
                 type, c.area, smallest);
  }
}

void BoundCurvature::set_surface(LocalSurface *on)
{
  surface = on;
  footprints.reset();
}

void BoundCurvature::update()
{
  if (!any()) return;
  if (!footprints) footprints = std::make_unique<Membrane_NS::Footprints>(*surface, quadrature);
  footprints->update();
}

/* ----------------------------------------------------------------------
   from the inner leaflet curvature is seen with the other sign
------------------------------------------------------------------------- */

double BoundCurvature::add(int i, BoundSite &site, double *f, Vector3d &turn)
{
  const auto found = coupling.find(atom->type[i]);
  if (found == coupling.end()) return 0.0;
  CurvatureCoupling c = found->second;
  c.c0p *= site.leaflet;
  c.c_par *= site.leaflet;
  c.c_perp *= site.leaflet;
  Membrane_NS::FootprintForces forces;
  try {
    const Membrane_NS::Director director = {Vector3d::Map(site.director), Vector3d::Map(site.normal)};
    forces = footprints->add(c, Vector3d::Map(atom->x[i]), site.point, director);
    if (c.has_director()) {
      Vector3d::Map(site.director) = forces.director.along;
      Vector3d::Map(site.normal) = forces.director.normal;
    }
  } catch (const MeshError &err) {
    error->one(FLERR, "Fix hd/bind: atom {}: {}", atom->tag[i], err.what());
  }
  if (!(forces.area > 0.0))
    error->one(FLERR, "Fix hd/bind: there is no point of quadrature within the radius {:.4g} of atom {}: use a larger "
                      "one, 1.5 edges or more", c.radius, atom->tag[i]);
  site.curvature = forces.curvature;
  for (int k = 0; k < 3; ++k) f[k] += forces.force[k];
  turn = forces.director_force;
  return forces.energy;
}

void BoundCurvature::take_forces(double **f, double *virial)
{
  const Eigen::Matrix3d sum = footprints->take_forces([&](int face, const Membrane_NS::Lane4 *force_on) {
    const int *local = surface->atoms(face), size = surface->stencil(face).size();
    for (int k = 0; k < size; ++k)
      for (int d = 0; d < 3; ++d) f[local[k]][d] += force_on[k][d];
  });
  static constexpr int PAIRS[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
  for (int k = 0; k < 6; ++k)
    virial[k] += 0.5 * (sum(PAIRS[k][0], PAIRS[k][1]) + sum(PAIRS[k][1], PAIRS[k][0]));
}
