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

#include "fix_hd_tension.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_hd_base.h"
#include "fix_hd_bound.h"
#include "group.h"
#include "helfrich_measure.h"
#include "membrane_tessellation.h"
#include "mesh_box.h"
#include "mesh_group.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

// of the box, beyond which an edge could go either way
static constexpr double HALF = 0.45;

// the longest change of the logarithm of a length that stencils and ghost atoms allow for without further ado
static constexpr double MOST_CHANGE = 0.1;

// of what neighbor lists allow for
static constexpr double PART_OF_SKIN = 0.5;

/* ---------------------------------------------------------------------- */

void FixHDTension::init()
{
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix hd/tension does not work with run_style respa");
  trial.init();
  check_periodic();
  check_fixes();
  has_points = false;
  plane = {0, 1};
  if (atom->style_match("membrane_cp")) {
    if (!mesh) mesh = std::make_unique<LocalMesh>(lmp, "Fix hd/tension");
    mesh->init();
    has_points = (*mesh)->topology().num_vertices() > 0;
  }
  if (has_points) check_membranes();
  if (has_tension && !has_points)
    error->all(FLERR, "Fix hd/tension tension needs a membrane that continues through the box in two directions, and there "
                      "is none");
}

// when other fixes know what they do in this run

void FixHDTension::setup(int)
{
  check_temperature();
  check_outsiders();
  if (has_points) check_bound_atoms();
  if (has_points) check_measure();
  limit_steps();
  trial.expect(next_visit());
}

/* ---------------------------------------------------------------------- */

void FixHDTension::check_periodic()
{
  static constexpr int CHANGES[] = {BOX_CHANGE_X, BOX_CHANGE_Y, BOX_CHANGE_Z};
  for (int k = 0; k < 3; ++k)
    if (box_change & CHANGES[k] && !domain->periodicity[k])
      error->all(FLERR, "Fix hd/tension: the box is not periodic in {}, so it cannot move there; use boundary p", "xyz"[k]);
}

void FixHDTension::check_fixes()
{
  movers = 0;
  held.clear();
  for (auto &fix : modify->get_fix_list()) {
    if (!groups_meet(lmp, groupbit, fix->groupbit)) continue;
    if (fix->rigid_flag || utils::strmatch(fix->style, "^shake") || utils::strmatch(fix->style, "^rattle"))
      error->all(FLERR,
                 "Fix hd/tension stretches the atoms of its group, and fix {} ({}) holds some of them rigid: use groups "
                 "without common atoms",
                 fix->id, fix->style);
    if (fix->time_integrate) movers |= fix->groupbit;
    auto *bound = dynamic_cast<FixHDBound *>(fix);
    if (bound && bound->is_rigid()) {
      held.push_back(bound);
      movers |= fix->groupbit;
    }
    const auto *integrator = dynamic_cast<FixHDBase *>(fix);
    if (scale_momenta && integrator && (integrator->sampling() || integrator->drag_coefficient() > 0.0))
      error->all(FLERR,
                 "Fix hd/tension momenta scale: the velocities of fix {} ({}) are not those of momenta in a box; use "
                 "momenta keep",
                 fix->id, fix->style);
  }
  if (scale_momenta && !held.empty())
    error->all(FLERR, "Fix hd/tension momenta scale: fix {} ({}) holds atoms on a surface; use momenta keep",
               held.front()->id, held.front()->style);
}

/* ----------------------------------------------------------------------
   a membrane is stretched as a whole or stays as it is, and one that continues through the box goes with it
------------------------------------------------------------------------- */

void FixHDTension::check_membranes()
{
  const auto &topology = (*mesh)->topology();
  const int n = topology.num_components();
  std::vector<int> mine(2 * n, 0), all(2 * n);
  for (int i = 0; i < atom->nlocal; ++i) {
    const int v = (*mesh)->vertex(atom->tag[i]);
    if (v >= 0) mine[2 * topology.component(v) + ((atom->mask[i] & groupbit) != 0)] = 1;
  }
  MPI_Allreduce(mine.data(), all.data(), 2 * n, MPI_INT, MPI_MAX, world);

  const auto continues = continuing_directions(topology, (*mesh)->triangle_mesh());
  const char *name = group->names[igroup];
  bool sheets = false;
  goes_along.assign(n, 0);
  for (int c = 0; c < n; ++c) {
    goes_along[c] = all[2 * c + 1];
    const tagint molecule = (*mesh)->molecule(c);
    const bool outside = all[2 * c], inside = all[2 * c + 1];
    if (inside && outside)
      error->all(FLERR, "Fix hd/tension: membrane {} is partly in its group {}, and would be torn: take all of it or nothing",
                 molecule, name);
    std::vector<int> directions;
    for (int k = 0; k < 3; ++k)
      if (continues[c][k]) directions.push_back(k);
    if (directions.empty()) continue;
    if (outside)
      error->all(FLERR,
                 "Fix hd/tension: membrane {} continues through the box in {}, and is not in its group {}: it must go with "
                 "the box",
                 molecule, "xyz"[directions[0]], name);
    if (directions.size() != 2) {
      if (has_tension)
        error->all(FLERR,
                   "Fix hd/tension tension: membrane {} continues through the box in {} directions: a frame has a tension "
                   "for sheets, which continue in two; use pressure",
                   molecule, directions.size());
      continue;
    }
    const std::array<int, 2> its = {directions[0], directions[1]};
    if (sheets && has_tension && its != plane)
      error->all(FLERR, "Fix hd/tension tension: sheets span different planes; use pressure");
    plane = its;
    sheets = true;
  }
  if (!has_tension) return;
  if (!sheets)
    error->all(FLERR, "Fix hd/tension tension needs a membrane that continues through the box in two directions, and there "
                      "is none; use pressure");
  const bool moves = std::any_of(freedoms.begin(), freedoms.end(), [this](const Freedom &freedom) {
    return freedom.along[plane[0]] || freedom.along[plane[1]];
  });
  if (!moves)
    error->all(FLERR, "Fix hd/tension tension: the sheet spans {} and {}, and neither of them moves", "xyz"[plane[0]],
               "xyz"[plane[1]]);
}

/* ----------------------------------------------------------------------
   particles that the box passes over push nothing. A membrane with what is bound to it is one body of many
------------------------------------------------------------------------- */

void FixHDTension::check_outsiders()
{
  int moving = 0, bound = 0;
  for (auto &fix : modify->get_fix_list()) {
    if (fix->time_integrate) moving |= fix->groupbit;
    if (dynamic_cast<FixHDBound *>(fix)) bound |= fix->groupbit;
  }
  bigint mine = 0, all;
  for (int i = 0; i < atom->nlocal; ++i) {
    const int mask = atom->mask[i];
    if (mask & groupbit || mask & bound || !(mask & moving)) continue;
    if (!has_points || (*mesh)->vertex(atom->tag[i]) < 0) ++mine;
  }
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (all && comm->me == 0)
    error->warning(FLERR, "Fix hd/tension: {} particles that move are not in its group {}: the box passes over them, and "
                          "feels no pressure of theirs as a gas", all, group->names[igroup]);
}

// what is held on a membrane goes where it goes

void FixHDTension::check_bound_atoms()
{
  const auto &topology = (*mesh)->topology();
  for (auto &fix : modify->get_fix_list()) {
    const auto *bound = dynamic_cast<FixHDBound *>(fix);
    if (!bound) continue;
    tagint mine = 0, any;
    for (int i = 0; i < atom->nlocal; ++i) {
      if (!(atom->mask[i] & bound->groupbit) || !bound->site(i).bound()) continue;
      const int v = (*mesh)->vertex(bound->site(i).corner[0]);
      const bool along = atom->mask[i] & groupbit;
      if (v >= 0 && along != static_cast<bool>(goes_along[topology.component(v)])) mine = MAX(mine, atom->tag[i]);
    }
    MPI_Allreduce(&mine, &any, 1, MPI_LMP_TAGINT, MPI_MAX, world);
    if (any)
      error->all(FLERR,
                 "Fix hd/tension: atom {} of fix {} ({}) and the membrane that it is bound to are not both in group {}, or both "
                 "outside: a move would tear it off",
                 any, fix->id, fix->style, group->names[igroup]);
  }
}

/* ----------------------------------------------------------------------
   without it N control points are an ideal gas of N molecules to the box, see Derivation_measure
------------------------------------------------------------------------- */

void FixHDTension::check_measure()
{
  int measured = 0;
  for (auto &fix : modify->get_fix_list()) {
    int dim;
    const auto *measure = static_cast<HelfrichMeasure *>(fix->extract("measure", dim));
    if (measure && measure->on) measured |= measure->groupbit;
  }
  tagint mine = 0, any;
  for (int i = 0; i < atom->nlocal; ++i)
    if (is_sampled(i) && (*mesh)->vertex(atom->tag[i]) >= 0 && !(atom->mask[i] & measured))
      mine = MAX(mine, atom->molecule[i]);
  MPI_Allreduce(&mine, &any, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  if (any && comm->me == 0)
    error->warning(FLERR,
                   "Fix hd/tension: membrane {} is sampled without the measure of its mesh, so its control points push "
                   "the box as an ideal gas would: say measure in the fix that moves it",
                   any);
}

void FixHDTension::check_temperature()
{
  const std::string wrong = FixHDBase::other_temperature(lmp, this, temperature);
  if (!wrong.empty()) error->all(FLERR, wrong);
}

/* ----------------------------------------------------------------------
   Lists are new at each visit. They hold pairs up to the skin beyond the cutoff; those that come within it by
   all moves of a visit must be among them
------------------------------------------------------------------------- */

void FixHDTension::limit_steps()
{
  longest_step = MOST_CHANGE;
  const bool lists = neighbor->nlist > 0;
  next_reneighbor = lists ? next_visit() : -1;
  force_reneighbor = lists;
  if (lists && neighbor->cutneighmax > 0.0)
    longest_step = MIN(longest_step, PART_OF_SKIN * neighbor->skin / neighbor->cutneighmax / (until_accepted ? 1 : trials));
  for (Freedom &freedom : freedoms) {
    if (freedom.step <= longest_step) continue;
    if (comm->me == 0)
      error->warning(FLERR, "Fix hd/tension step {:.4g} is larger than neighbor lists allow for: it is {:.4g} now; a "
                            "larger skin allows for more",
                     freedom.step, longest_step);
    freedom.step = longest_step;
  }
}

/* ----------------------------------------------------------------------
   before a move, when images of neighbors are known. In the group edges follow the box in each direction;
   others do not
------------------------------------------------------------------------- */

void FixHDTension::check_edges(const std::array<double, 3> &a)
{
  mesh->follow();
  const auto &topology = (*mesh)->topology();
  tagint worst[3] = {0, 0, 0}, any[3];
  for (const auto &point : (*mesh)->owned_points())
    for (int w : topology.ring(point.vertex)) {
      const int j = (*mesh)->find_neighbor(point.atom, w);
      if (j < 0) continue;
      double d[3];
      for (int k = 0; k < 3; ++k) d[k] = atom->x[j][k] - atom->x[point.atom][k];
      const auto s = in_box_lengths(*domain, d);
      for (int k = 0; k < 3; ++k) {
        const double length = atom->mask[point.atom] & groupbit ? 1.0 : a[k];
        if (domain->periodicity[k] && std::fabs(s[k]) > HALF * length) worst[k] = MAX(worst[k], atom->tag[point.atom]);
      }
    }
  MPI_Allreduce(worst, any, 3, MPI_LMP_TAGINT, MPI_MAX, world);
  for (int k = 0; k < 3; ++k)
    if (any[k])
      error->all(FLERR,
                 "Fix hd/tension: an edge of control point {} spans half the periodic box in {}: the box has become too "
                 "small for its mesh; start from a larger box, or use a higher tension",
                 any[k], "xyz"[k]);
}
