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

#include "fix_hd_bound.h"

#include "atom.h"
#include "bound_search.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_hd_base.h"
#include "force.h"
#include "group.h"
#include "irregular.h"
#include "membrane_limit_surface.h"
#include "mesh_box.h"
#include "mesh_group.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

using namespace LAMMPS_NS;
using Eigen::Vector3d;
using Membrane_NS::ClosestPoint;

// distances to two membranes that are the same, and what is on the surface and so on its outer side, in mean
// edges
static constexpr double SAME = 1.0e-6;

// of an atom from the first corner of its face, in longest edges
static constexpr double FACES_AWAY = 3.0;

// the phase of a spring in a step, omega dt, or without inertia its rate times dt: chosen, and where the
// integrators end
static constexpr double PHASE_CHOSEN = 0.5;
static constexpr double PHASE_MOST = 2.0;

// of atoms with a rigid hold, in mean edges: what is closer to its place is there
static constexpr double STRAY = 1.0e-6;

// a run stops when an atom is FARTHEST off, which should be so many times what its temperature does
static constexpr double SIGMAS = 6.0;

// === What is checked and chosen before a run

void FixHDBound::check_group()
{
  tagint mine[2] = {0, 0}, any[2];
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) {
      sites.clear(i);    // it may come back from elsewhere
      continue;
    }
    if (mesh->vertex(atom->tag[i]) >= 0) mine[0] = MAX(mine[0], atom->tag[i]);
    if (!std::isfinite(atom->x[i][0] + atom->x[i][1] + atom->x[i][2]))
      mine[1] = MAX(mine[1], atom->tag[i]);
  }
  MPI_Allreduce(mine, any, 2, MPI_LMP_TAGINT, MPI_MAX, world);
  if (any[0])
    error->all(FLERR,
               "Fix hd/bind: atom {} of its group is a control point of a membrane: bind atoms that are none",
               any[0]);
  if (any[1]) error->all(FLERR, "Fix hd/bind: coordinates of atom {} are not numbers", any[1]);

  for (auto &fix : modify->get_fix_by_style("^hd/bind$")) {
    if (fix == this) continue;
    tagint twice = 0, all;
    for (int i = 0; i < atom->nlocal; ++i)
      if (atom->mask[i] & groupbit && atom->mask[i] & fix->groupbit) twice = MAX(twice, atom->tag[i]);
    MPI_Allreduce(&twice, &all, 1, MPI_LMP_TAGINT, MPI_MAX, world);
    if (all)
      error->all(FLERR, "Atom {} is bound by fix {} and by fix {}: use groups without common atoms", all, id,
                 fix->id);
  }
}

/* ----------------------------------------------------------------------
   each particle is moved by one fix; and rigid holds correct what integrators before them have done
------------------------------------------------------------------------- */

void FixHDBound::check_integrators()
{
  if (update->whichflag != 1) return;
  std::vector<int> movers(atom->nlocal, 0);
  bool after = false;
  std::string late;
  for (auto &fix : modify->get_fix_list()) {
    if (fix == this) after = true;
    const bool holds = fix->rigid_flag || utils::strmatch(fix->style, "^shake") || utils::strmatch(fix->style, "^rattle");
    if (holds && (rigid || !after) && groups_meet(lmp, groupbit, fix->groupbit)) {
      if (rigid)
        error->all(FLERR, "Fix hd/bind hold rigid: fix {} ({}) holds its atoms, too: use hold spring", fix->id, fix->style);
      error->all(FLERR, "Fix {} ({}) must come after fix {} (hd/bind), whose places and forces it takes: define it later",
                 fix->id, fix->style, id);
    }
    if (!fix->time_integrate) continue;
    int mine = 0, any;
    for (int i = 0; i < atom->nlocal; ++i) {
      if (!(atom->mask[i] & fix->groupbit)) continue;
      if (atom->mask[i] & groupbit) ++movers[i];
      if (atom->mask[i] & (groupbit | membranebit)) mine = 1;
    }
    MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, world);
    if (after && fix != this && any) late = fix->id;
  }
  if ((rigid || diffusion > 0.0) && !late.empty())
    error->all(FLERR, "Fix {} (hd/bind) must come after fix {}, which moves its atoms or its membrane", id, late);

  tagint mine[2] = {0, 0}, any[2];
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    if (movers[i] == 0) mine[0] = MAX(mine[0], atom->tag[i]);
    if (movers[i] > 1) mine[1] = MAX(mine[1], atom->tag[i]);
  }
  MPI_Allreduce(mine, any, 2, MPI_LMP_TAGINT, MPI_MAX, world);
  if (any[1])
    error->all(FLERR, "Bound atom {} is moved by more than one fix: use groups without common atoms", any[1]);
  if (any[0] && comm->me == 0)
    error->warning(FLERR,
                   "Bound atom {} is not moved by any fix: integrate it with fix nve, or say brownian in fix "
                   "hd/bind",
                   any[0]);
}

// whether a face may still be the one: other atoms have its IDs after reset_atoms

bool FixHDBound::is_near(int i, int face) const
{
  const double most = FACES_AWAY * mesh->longest_edge() + height;
  const double *corner = &mesh->unwrapped()[3 * (size_t) mesh->topology().face(face)[0]];
  double d[3];
  for (int k = 0; k < 3; ++k) d[k] = atom->x[i][k] - corner[k];
  nearest_image(*domain, d);
  return d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < most * most;
}

std::vector<int> FixHDBound::components_of_group() const
{
  const auto &topology = mesh->topology();
  std::vector<int> inside(topology.num_components(), 0), all(inside.size());
  for (int i = 0; i < atom->nlocal; ++i) {
    const int v = mesh->vertex(atom->tag[i]);
    if (v >= 0 && atom->mask[i] & membranebit) inside[topology.component(v)] = 1;
  }
  MPI_Allreduce(inside.data(), all.data(), static_cast<int>(inside.size()), MPI_INT, MPI_MAX, world);
  std::vector<int> components;
  for (int c = 0; c < topology.num_components(); ++c)
    if (all[c]) components.push_back(c);
  return components;
}

// of the file, once, when there are atoms to be bound

void FixHDBound::check_given_sites()
{
  std::set<tagint> mine;
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit) mine.insert(atom->tag[i]);
  std::vector<int> have(given.size()), somewhere(given.size());
  for (size_t k = 0; k < given.size(); ++k) have[k] = mine.count(given[k].atom);
  MPI_Allreduce(have.data(), somewhere.data(), static_cast<int>(have.size()), MPI_INT, MPI_MAX, world);
  const std::vector<int> components = components_of_group();
  for (size_t k = 0; k < given.size(); ++k) {
    SiteOfAtom &one = given[k];
    const std::string where = fmt::format("Fix hd/bind sites {}, line {}", site_path, one.line);
    if (!somewhere[k])
      error->all(FLERR, "{}: atom {} is not in the group of the fix", where, one.atom);
    for (tagint corner : one.site.corner) {
      const int v = mesh->vertex(corner);
      if (v < 0) error->all(FLERR, "{}: atom {} is not a control point", where, corner);
      const int c = mesh->topology().component(v);
      if (std::find(components.begin(), components.end(), c) == components.end())
        error->all(FLERR, "{}: control point {} is not of a membrane of group {}", where, corner, membrane_name);
    }
    find_again(*mesh, one.site);
    if (one.site.point.face < 0)
      error->all(FLERR, "{}: control points {}, {} and {} are not the corners of a face", where, one.site.corner[0],
                 one.site.corner[1], one.site.corner[2]);
    if (one.site.leaflet == 0) one.site.leaflet = leaflet ? leaflet : 1;
    if (leaflet && leaflet != one.site.leaflet)
      error->all(FLERR, "{}: leaflet {} is not that of the fix, {}", where, one.site.leaflet < 0 ? "in" : "out",
                 leaflet < 0 ? "in" : "out");
    const double place = height * one.site.leaflet;
    if (!one.has_distance) one.site.distance = place;
    if (std::fabs(one.site.distance - place) > FARTHEST * limit->mean_edge())
      error->all(FLERR, "{}: the distance {:.6g} is more than half an edge from the height {:.6g}", where,
                 one.site.distance, place);
  }
}

/* ----------------------------------------------------------------------
   atoms with a place in the file are taken there, wherever they are: LAMMPS finds the ranks of these places later
------------------------------------------------------------------------- */

void FixHDBound::bind_given_atoms()
{
  check_given_sites();
  const Membrane_NS::LimitSurfaceOfMesh surface(mesh->topology(), mesh->triangle_mesh());
  std::map<tagint, const BoundSite *> by_atom;
  for (const SiteOfAtom &one : given) by_atom[one.atom] = &one.site;
  double farthest_moved[2] = {0.0, 0.0}, all[2];
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit) || sites[i].bound()) continue;
    const auto found = by_atom.find(atom->tag[i]);
    if (found == by_atom.end()) continue;
    sites[i] = *found->second;
    const auto jet = surface.evaluate<1>(sites[i].point);
    const Vector3d to = jet.position() + sites[i].distance * jet.normal();
    Vector3d step = to - Vector3d::Map(atom->x[i]);
    nearest_image(*domain, step.data());
    Vector3d::Map(atom->x[i]) += step;
    farthest_moved[0] = MAX(farthest_moved[0], step.norm());
    farthest_moved[1] += 1.0;
  }
  MPI_Allreduce(&farthest_moved[0], &all[0], 1, MPI_DOUBLE, MPI_MAX, world);
  MPI_Allreduce(&farthest_moved[1], &all[1], 1, MPI_DOUBLE, MPI_SUM, world);
  migrating = true;
  given.clear();
  if (comm->me == 0)
    utils::logmesg(lmp, "Fix hd/bind {}: {:.0f} atoms bound to their sites in {}, moved by {:.3g} at most\n", id, all[1],
                   site_path, all[0]);
}

// before LAMMPS exchanges atoms with neighbouring ranks only

void FixHDBound::setup_pre_exchange()
{
  if (!migrating) return;
  migrating = false;
  if (domain->triclinic) domain->x2lamda(atom->nlocal);
  domain->pbc();
  domain->reset_box();
  Irregular(lmp).migrate_atoms(1);
  if (domain->triclinic) domain->lamda2x(atom->nlocal);
}

/* ----------------------------------------------------------------------
   atoms that have no site, or whose face is gone, get the closest one; those that are new are taken there
------------------------------------------------------------------------- */

void FixHDBound::bind_free_atoms()
{
  int mine = 0, any;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    BoundSite &site = sites[i];
    if (site.bound()) find_again(*mesh, site);
    if (site.point.face < 0 || !is_near(i, site.point.face)) site.corner[0] = 0;
    if (!site.bound()) mine = 1;
  }
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, world);
  if (!any) return;

  if (!given.empty()) bind_given_atoms();
  const std::vector<int> components = components_of_group();
  if (components.empty())
    error->all(FLERR, "Fix hd/bind: group {} has no control points to bind to", membrane_name);

  const BoundSearch search(*mesh, components);
  const double edge = limit->mean_edge();
  const double most = max_distance > 0.0 ? max_distance : FARTHEST * edge;
  double moved[2] = {0.0, 0.0}, sums[2];
  for (int i = 0; i < atom->nlocal; ++i) {
    BoundSite &site = sites[i];
    if (!(atom->mask[i] & groupbit) || site.bound()) continue;
    double *x = atom->x[i];
    const auto found = search.find(Vector3d::Map(x));
    const ClosestPoint &closest = found.closest;
    const bool is_new = site.leaflet == 0;
    if (is_new) site.leaflet = leaflet ? leaflet : closest.distance < -SAME * edge ? -1 : 1;
    const double off = height * site.leaflet - closest.distance;
    if (std::fabs(off) > most)
      error->one(FLERR,
                 "Fix hd/bind: atom {} is {:.4g} from where it would be bound, and max is {:.4g}: place it closer, "
                 "or raise max",
                 atom->tag[i], std::fabs(off), most);
    if (found.next - std::fabs(closest.distance) < SAME * edge)
      error->one(FLERR,
                 "Fix hd/bind: atom {} is equally near to membranes {} and {}: name one of them by its group",
                 atom->tag[i], mesh->molecule(found.component), mesh->molecule(found.next_component));
    remember(i, closest);
    if (!is_new) continue;
    for (int k = 0; k < 3; ++k) x[k] += off * closest.normal[k];
    site.distance += off;
    moved[0] = MAX(moved[0], std::fabs(off));
    moved[1] += 1.0;
    if (std::fabs(off) > FARTHEST * edge) mine = 2;
  }
  MPI_Allreduce(&moved[0], &sums[0], 1, MPI_DOUBLE, MPI_MAX, world);
  MPI_Allreduce(&moved[1], &sums[1], 1, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, world);
  if (any == 2) migrating = true;
  if (comm->me == 0 && sums[1] > 0.0)
    utils::logmesg(lmp, "Fix hd/bind {}: {:.0f} atoms bound, moved by {:.3g} at most\n", id, sums[1], sums[0]);
}

/* ----------------------------------------------------------------------
   rigid: what commands have moved off its place is taken back. A constraint would do so, too, with a velocity
------------------------------------------------------------------------- */

void FixHDBound::return_strays()
{
  const Membrane_NS::LimitSurfaceOfMesh surface(mesh->topology(), mesh->triangle_mesh());
  const double edge = limit->mean_edge();
  double mine[2] = {0.0, 0.0}, most, count;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    BoundSite &site = sites[i];
    const Vector3d foot = surface.evaluate<1>(site.point).position();
    Vector3d away = Vector3d::Map(atom->x[i]) - foot;
    nearest_image(*domain, away.data());
    const ClosestPoint closest = closest_point(surface, foot + away, site.point, precision);
    const double off = height * site.leaflet - closest.distance;
    if (std::fabs(off) < STRAY * edge) continue;
    if (std::fabs(off) > FARTHEST * edge)
      error->one(FLERR, "Fix hd/bind: atom {} is {:.4g} from where it is bound, more than half an edge: place it closer",
                 atom->tag[i], std::fabs(off));
    remember(i, closest);
    Vector3d::Map(atom->x[i]) += off * closest.normal;
    site.distance += off;
    mine[0] = MAX(mine[0], std::fabs(off));
    mine[1] += 1.0;
  }
  MPI_Allreduce(&mine[0], &most, 1, MPI_DOUBLE, MPI_MAX, world);
  MPI_Allreduce(&mine[1], &count, 1, MPI_DOUBLE, MPI_SUM, world);
  if (comm->me == 0 && count > 0.0)
    utils::logmesg(lmp, "Fix hd/bind {}: {:.0f} atoms taken back to the membrane, by {:.3g} at most\n", id, count, most);
}

// walls let nothing through, and what is beyond one would be lost

void FixHDBound::check_inside_box()
{
  for (int i = 0; i < atom->nlocal; ++i)
    if (const int k = atom->mask[i] & groupbit ? beyond_fixed_side(*domain, atom->x[i]) : -1; k >= 0)
      error->one(FLERR, "Fix hd/bind: the place of atom {} is outside the box, which is not periodic in {}: enlarge the box",
                 atom->tag[i], "xyz"[k]);
}

void FixHDBound::remember(int i, const ClosestPoint &closest)
{
  BoundSite &site = sites[i];
  site.distance = closest.distance;
  const bool same = site.bound() && site.point.face == closest.point.face;
  site.point = closest.point;
  if (same) return;
  for (int k = 0; k < 3; ++k) site.corner[k] = mesh->tag(mesh->topology().face(closest.point.face)[k]);
}

/* ----------------------------------------------------------------------
   velocity Verlet follows a spring up to omega dt = 2, an overdamped step up to rate dt = 2
------------------------------------------------------------------------- */

void FixHDBound::choose_spring()
{
  if (rigid || total == 0) return;
  const double dt = update->dt;
  const double inert = force->ftm2v * largest_response() * dt * dt, damped = largest_mobility() * dt;
  auto stiffest = [](double inertial, double overdamped) {
    return MIN(PHASE_CHOSEN * PHASE_CHOSEN / inertial, PHASE_CHOSEN / overdamped);
  };
  if (automatic && (chosen_for != dt || chosen_count != total)) {
    const double most = stiffest(inert, damped);
    spring = std::isfinite(most) ? most : 0.0;
    chosen_for = dt;
    chosen_count = total;
    if (comm->me == 0)
      utils::logmesg(lmp, "Fix hd/bind {}: spring {:.6g} for the timestep {}\n", id, spring, dt);
  }
  phase = std::sqrt(spring * inert);
  if (update->whichflag != 1) return;
  if (phase > PHASE_MOST || spring * damped > PHASE_MOST)
    error->all(FLERR,
               "Fix hd/bind spring {:.6g} is unstable with the timestep {}: at most {:.4g}, or say auto",
               spring, dt, stiffest(inert, damped));

  // PHASE_CHOSEN is the phase of a spring this stiff in a step this long

  const double kT = mover ? mover->sampled_kT() : 0.0, width = FARTHEST * limit->mean_edge() / SIGMAS;
  const double enough = kT / (width * width);
  if (spring < enough && update->setupflag && comm->me == 0)    // once a run, whatever changes the timestep
    error->warning(FLERR,
                   "Fix hd/bind spring {:.4g}: the temperature takes atoms {:.2g} edges off their places in the mean, and a "
                   "run stops at {}: {:.4g} would do, with a timestep of {:.3g} at most",
                   spring, std::sqrt(kT / spring) / limit->mean_edge(), FARTHEST, enough,
                   MIN(dt, MIN(dt * PHASE_CHOSEN / std::sqrt(enough * inert), dt * PHASE_CHOSEN / (enough * damped))));
}
