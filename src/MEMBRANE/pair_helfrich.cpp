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

#include "pair_helfrich.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "group.h"
#include "membrane_regularization.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using Membrane_NS::Face;
using Membrane_NS::FaceGroup;
using Membrane_NS::PatchRules;
using Membrane_NS::Quadrature;

enum { BENDING, GAUSSIAN, AREA, VOLUME, TOTAL_AREA, TOTAL_VOLUME, REGULARIZATION, POINTS, NEXTRA };

// a face whose D/A is beyond this is about to turn over
static constexpr double WORST_FACE = 50.0;

// of the bending energy and of kc: beyond it a warning at the end of a run
static constexpr double MOST_QUADRATURE_ERROR = 0.1;

/* ---------------------------------------------------------------------- */

PairHelfrich::PairHelfrich(LAMMPS *lmp) :
    Pair(lmp), quadrature(Quadrature::SIX), mesh(lmp, "Pair style helfrich"), first_pass(false),
    volumes(false), area_local(false), gauss(false), regularized(false), report(false),
    default_regularize(0.0), terms_for_default(0.0), points_evaluated(0.0), restored(false), stale(true), totals(lmp, mesh)
{
  single_enable = 0;
  restartinfo = 1;
  one_coeff = 0;
  no_virial_fdotr_compute = 1;
  centroidstressflag = CENTROID_NOTAVAIL;
  comm_reverse = comm_reverse_off = 10;
  nextra = NEXTRA;
  pvector = new double[NEXTRA]();
}

PairHelfrich::~PairHelfrich()
{
  if (copymode) return;
  delete[] pvector;
  if (!allocated) return;
  memory->destroy(setflag);
  memory->destroy(cutsq);
}

/* ---------------------------------------------------------------------- */

void PairHelfrich::settings(int narg, char **arg)
{
  quadrature = Quadrature::SIX;
  for (int iarg = 0; iarg < narg; iarg += 2) {
    if (strcmp(arg[iarg], "quadrature") != 0)
      error->all(FLERR, "Unknown pair_style helfrich keyword {}; the only one is: quadrature",
                 arg[iarg]);
    if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "pair_style helfrich quadrature", error);
    if (!Membrane_NS::parse_quadrature(arg[iarg + 1], quadrature))
      error->all(FLERR, "pair_style helfrich quadrature {} is not one of 1, 3, 6, 12, careful",
                 arg[iarg + 1]);
  }
  if (quadrature == Quadrature::ONE && comm->me == 0)
    error->warning(FLERR,
                   "pair_style helfrich quadrature 1 has zero-energy wrinkles and is second-order "
                   "only; results are not to be trusted without comparison to quadrature 6");
  rules = std::make_unique<PatchRules>(quadrature);
  stale = true;
}

/* ----------------------------------------------------------------------
   types without coefficients may exist, as those of solvent: they must have no control points,
   which init_style() checks
------------------------------------------------------------------------- */

void PairHelfrich::allocate()
{
  allocated = 1;
  const int n = atom->ntypes + 1;
  memory->create(setflag, n, n, "pair:setflag");
  memory->create(cutsq, n, n, "pair:cutsq");
  for (int i = 1; i < n; ++i)
    for (int j = 1; j < n; ++j) setflag[i][j] = i == j;
  coefficients.assign(n, HelfrichCoefficients());
}

void PairHelfrich::coeff(int narg, char **arg)
{
  if (!allocated) allocate();
  if (narg < 4) utils::missing_cmd_args(FLERR, "pair_coeff for pair_style helfrich", error);

  int ilo, ihi, jlo, jhi;
  utils::bounds(FLERR, arg[0], 1, atom->ntypes, ilo, ihi, error);
  utils::bounds(FLERR, arg[1], 1, atom->ntypes, jlo, jhi, error);

  HelfrichCoefficients c = HelfrichCoefficients::parse(lmp, narg - 2, arg + 2);
  c.fresh = !restored;

  int count = 0;
  for (int i = MAX(ilo, jlo); i <= MIN(ihi, jhi); ++i) {
    coefficients[i] = c;
    ++count;
  }
  if (count == 0)
    error->all(FLERR,
               "pair_coeff {} {}: pair helfrich has coefficients per control-point type, so give "
               "the same type twice",
               arg[0], arg[1]);
}

/* ---------------------------------------------------------------------- */

void PairHelfrich::init_style()
{
  default_regularize = 0.0;    // fixes that need one set it in their own init()
  mesh.init();

  // every control point has coefficients, every atom with coefficients is a control point

  tagint bad[2] = {0, 0};
  for (int i = 0; i < atom->nlocal; ++i) {
    const bool is_point = mesh->vertex(atom->tag[i]) >= 0;
    if (is_point && !coefficients[atom->type[i]].set) bad[0] = MAX(bad[0], atom->tag[i]);
    if (!is_point && coefficients[atom->type[i]].set) bad[1] = MAX(bad[1], atom->tag[i]);
  }
  tagint any[2];
  MPI_Allreduce(bad, any, 2, MPI_LMP_TAGINT, MPI_MAX, world);
  if (any[0])
    error->all(FLERR, "Control point {} is of a type without coefficients: add a pair_coeff line",
               any[0]);
  if (any[1])
    error->all(FLERR,
               "Atom {} is of a type with pair helfrich coefficients but is in no face: give it a "
               "type of its own or delete it",
               any[1]);
  if (mesh->topology().num_faces() == 0 && comm->me == 0)
    error->warning(FLERR, "Pair style helfrich finds no membrane: use create_membrane or read_data");

  choose_terms();
  if (update->whichflag == 1) check_integrators();
}

/* ----------------------------------------------------------------------
   integrators for plain atoms do move control points, as particles of their own. Rigid and prescribed
   motion is the same with any mass matrix
------------------------------------------------------------------------- */

void PairHelfrich::check_integrators()
{
  static constexpr const char *FITTING[] = {"^hd/", "^move", "^rigid", "^nve/noforce"};
  for (auto &fix : modify->get_fix_list()) {
    if (!fix->time_integrate) continue;
    const bool fits = std::any_of(std::begin(FITTING), std::end(FITTING), [&](const char *pattern) {
      return utils::strmatch(fix->style, pattern);
    });
    if (fits) continue;
    if (std::find(warned.begin(), warned.end(), fix->id) != warned.end()) continue;
    bigint mine = 0, all;
    for (int i = 0; i < atom->nlocal; ++i)
      if (atom->mask[i] & fix->groupbit && mesh->vertex(atom->tag[i]) >= 0) ++mine;
    MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
    if (all == 0) continue;
    warned.emplace_back(fix->id);
    if (comm->me == 0)
      error->warning(FLERR,
                     "Fix {} ({}) moves {} control points as independent particles: it ignores the "
                     "mass matrix of the surface, and waves are too slow; use fix hd/nve, "
                     "hd/langevin or hd/brownian",
                     fix->id, fix->style, all);
  }
}

/* ----------------------------------------------------------------------
   which terms this scene has; all ranks agree
------------------------------------------------------------------------- */

void PairHelfrich::choose_terms()
{
  const auto &topology = mesh->topology();
  const int nmembranes = mesh->molecules().size();

  // the types of each membrane's control points, from all ranks

  std::vector<int> mine((size_t) nmembranes * (atom->ntypes + 1), 0), types(mine.size());
  for (int i = 0; i < atom->nlocal; ++i) {
    const int v = mesh->vertex(atom->tag[i]);
    if (v < 0) continue;
    const int m = mesh->membrane(topology.component(v));
    mine[m * (atom->ntypes + 1) + atom->type[i]] = 1;
  }
  MPI_Allreduce(mine.data(), types.data(), mine.size(), MPI_INT, MPI_MAX, world);

  std::vector<char> whole_terms(nmembranes, 0);
  for (int m = 0; m < nmembranes; ++m)
    for (int t = 1; t <= atom->ntypes; ++t)
      if (types[m * (atom->ntypes + 1) + t] && coefficients[t].uses_totals()) whole_terms[m] = 1;
  const std::vector<char> excluded = find_excluded(whole_terms);

  static const HelfrichCoefficients NOTHING;
  membrane_terms.assign(nmembranes, nullptr);
  membrane_volume.assign(nmembranes, 0);
  first_pass = volumes = area_local = gauss = regularized = false;
  for (int m = 0; m < nmembranes; ++m)
    for (int t = 1; t <= atom->ntypes; ++t) {
      if (!types[m * (atom->ntypes + 1) + t]) continue;
      if (excluded[m]) {
        membrane_terms[m] = &NOTHING;
        continue;
      }
      const HelfrichCoefficients &c = coefficients[t];
      const tagint molecule = mesh->molecules()[m];
      if (!membrane_terms[m]) membrane_terms[m] = &c;
      if (c.fresh) references.erase(molecule);
      if (!membrane_terms[m]->same_global_terms(c))
        error->all(FLERR,
                   "Membrane {} has control points of types with different area, area/local, "
                   "volume or pressure coefficients; these belong to a whole membrane: make them "
                   "equal",
                   molecule);
      if (c.uses_volume() && !mesh->is_closed_membrane(m))
        error->all(FLERR,
                   "Membrane {} continues through the periodic box and encloses no volume: remove "
                   "volume and pressure from pair_coeff {} {}",
                   molecule, t, t);
      if (c.uses_volume()) membrane_volume[m] = 1;
      if (c.uses_totals()) first_pass = true;
      volumes = volumes || c.uses_volume();
      area_local = area_local || c.local_area_modulus != 0.0;
      gauss = gauss || c.kg != 0.0;
      regularized = regularized || regularize_of(c) != 0.0;
    }

  for (auto &c : coefficients) c.fresh = false;
  restored = false;

  // total volumes cost a pass: only if there are any and somebody can read them

  report = false;
  if (!modify->get_compute_by_style("^pair$").empty())
    for (int m = 0; m < nmembranes; ++m) report = report || mesh->is_closed_membrane(m);
  terms_for_default = default_regularize;

  membrane_faces.clear();
  reference_area.clear();
  if (area_local) {
    membrane_faces.resize(nmembranes);
    for (int f = 0; f < topology.num_faces(); ++f)
      membrane_faces[mesh->membrane(topology.component(topology.face(f)[0]))].push_back(f);
  }
}

/* ----------------------------------------------------------------------
   neigh_modify exclude group A A says that what is within A does not matter, as for a frozen part:
   faces that depend on points of A only are left out. A membrane with terms of its total area or
   volume is left out as a whole or not at all. By membrane, whether it is left out; all ranks agree.
------------------------------------------------------------------------- */

bool PairHelfrich::in_exclusion(int mask, int e) const
{
  return mask & group->bitmask[neighbor->ex1_group[e]] &&
      mask & group->bitmask[neighbor->ex2_group[e]];
}

std::vector<char> PairHelfrich::find_excluded(const std::vector<char> &whole_terms) const
{
  const int nmembranes = static_cast<int>(whole_terms.size());
  std::vector<char> excluded(nmembranes, 0);
  std::vector<bigint> size(nmembranes, 0), mine(nmembranes), inside(nmembranes);
  for (int c = 0; c < mesh->topology().num_components(); ++c)
    size[mesh->membrane(c)] += mesh->topology().num_vertices(c);
  for (int e = 0; e < neighbor->nex_group; ++e) {
    std::fill(mine.begin(), mine.end(), 0);
    for (int i = 0; i < atom->nlocal; ++i) {
      const int v = mesh->vertex(atom->tag[i]);
      if (v >= 0 && in_exclusion(atom->mask[i], e))
        ++mine[mesh->membrane(mesh->topology().component(v))];
    }
    MPI_Allreduce(mine.data(), inside.data(), nmembranes, MPI_LMP_BIGINT, MPI_SUM, world);
    for (int m = 0; m < nmembranes; ++m) {
      if (inside[m] == size[m]) excluded[m] = 1;
      if (inside[m] && inside[m] < size[m] && whole_terms[m])
        error->all(FLERR,
                   "neigh_modify exclude group has {} of the {} control points of membrane {}, whose "
                   "area or volume terms need all of it: exclude the whole membrane or nothing",
                   inside[m], size[m], mesh->molecules()[m]);
    }
  }
  return excluded;
}

bool PairHelfrich::is_excluded(int face, std::vector<int> &stencil) const
{
  mesh->topology().stencil(face, stencil);
  int common = ~0;
  for (int v : stencil) {
    const int i = atom->map(mesh->tag(v));
    if (i < 0) return false;    // local_groups() reports it
    common &= atom->mask[i];
  }
  for (int e = 0; e < neighbor->nex_group; ++e)
    if (in_exclusion(common, e)) return true;
  return false;
}

/* ----------------------------------------------------------------------
   control points act through the mesh, not through neighbor lists: the cutoff only gives LAMMPS a
   length to size its bins with, the ghost cutoff is set by DistributedMesh
------------------------------------------------------------------------- */

double PairHelfrich::init_one(int i, int j)
{
  return coefficients[i].set && coefficients[j].set ? mesh->longest_edge() : 0.0;
}

/* ----------------------------------------------------------------------
   after reneighbouring: faces of this rank and their coefficients, the mean of their corners'
------------------------------------------------------------------------- */

void PairHelfrich::localize()
{
  std::vector<int> faces(mesh->owned_faces()), stencil;
  if (neighbor->nex_group)
    faces.erase(std::remove_if(faces.begin(), faces.end(),
                               [&](int f) { return is_excluded(f, stencil); }),
                faces.end());
  groups = mesh->local_groups(*rules, faces);
  stale = false;
  const int nslots = count_slots(groups);
  model.resize(nslots);
  base_tension.assign(nslots, 0.0);
  local_modulus.assign(area_local ? nslots : 0, 0.0);
  regularization.assign(regularized ? nslots : 0, 0.0);

  for (const FaceGroup &group : groups)
    for (int s = 0; s < group.nslots(); ++s) {
      const int slot = group.first_slot + s;
      for (int k = 0; k < 3; ++k) {
        const HelfrichCoefficients &c = coefficients[atom->type[group.point(s, k)]];
        model.kc[slot] += c.kc / 3.0;
        model.c0[slot] += c.c0 / 3.0;
        model.kg[slot] += c.kg / 3.0;
        base_tension[slot] += c.tension / 3.0;
        if (area_local) local_modulus[slot] += c.local_area_modulus / 3.0;
        if (regularized) regularization[slot] += regularize_of(c) / 3.0;
      }
    }
  model.tension = base_tension;
}

/* ----------------------------------------------------------------------
   reference areas and volumes: kept per molecule ID, through later runs and restarts
------------------------------------------------------------------------- */

void PairHelfrich::take_references()
{
  const auto &molecules = mesh->molecules();
  const auto &membranes = totals.membranes();
  bool missing = false;
  for (size_t m = 0; m < molecules.size(); ++m) {
    const HelfrichCoefficients &c = *membrane_terms[m];
    Reference &reference = references[molecules[m]];
    if (c.area_modulus != 0.0) {
      if (!c.area_init) reference.area = c.area;
      if (reference.area == 0.0) reference.area = membranes[m].area;
    }
    if (c.volume_modulus != 0.0) {
      if (!c.volume_init) reference.volume = c.volume;
      if (reference.volume == 0.0) reference.volume = membranes[m].volume;
    }
    if (membrane_volume[m] && update->setupflag && membranes[m].volume <= 0.0)
      error->all(FLERR,
                 "Membrane {} encloses the volume {:.6g}: its faces are inside out; reverse the "
                 "order of their corners",
                 molecules[m], membranes[m].volume);
    if (c.local_area_modulus != 0.0 && reference.face_area.size() != membrane_faces[m].size())
      missing = true;
  }
  if (!area_local || !reference_area.empty()) return;

  const int nfaces = mesh->topology().num_faces();
  reference_area.assign(nfaces, 0.0);
  if (missing) {
    std::vector<double> mine(nfaces, 0.0);
    for (const FaceGroup &group : groups)
      for (int s = 0; s < group.nfaces; ++s)
        mine[group.face[s]] = integrals.area[group.first_slot + s];
    MPI_Allreduce(mine.data(), reference_area.data(), nfaces, MPI_DOUBLE, MPI_SUM, world);
  }
  for (size_t m = 0; m < molecules.size(); ++m) {
    auto &kept = references[molecules[m]].face_area;
    const auto &faces = membrane_faces[m];
    if (kept.size() != faces.size()) {
      kept.resize(faces.size());
      for (size_t i = 0; i < faces.size(); ++i) kept[i] = reference_area[faces[i]];
    }
    for (size_t i = 0; i < faces.size(); ++i) reference_area[faces[i]] = kept[i];
  }
}

/* ----------------------------------------------------------------------
   area and volume terms act as a tension and a pressure:
     d/dA [KA/2 (A-A0)^2/A0] = KA (A-A0)/A0,   d/dV [KV/2 (V-V0)^2/V0 - DP V] = KV (V-V0)/V0 - DP
------------------------------------------------------------------------- */

void PairHelfrich::apply_global_terms()
{
  const auto &molecules = mesh->molecules();
  const auto &membranes = totals.membranes();
  std::vector<double> tension(molecules.size(), 0.0), pressure(molecules.size(), 0.0);
  for (size_t m = 0; m < molecules.size(); ++m) {
    const HelfrichCoefficients &c = *membrane_terms[m];
    const Reference &reference = references[molecules[m]];
    if (c.area_modulus != 0.0)
      tension[m] = c.area_modulus * (membranes[m].area - reference.area) / reference.area;
    if (c.volume_modulus != 0.0)
      pressure[m] = c.volume_modulus * (membranes[m].volume - reference.volume) / reference.volume;
    pressure[m] -= c.pressure;
  }

  for (const FaceGroup &group : groups)
    for (int s = 0; s < group.nslots(); ++s) {
      const int slot = group.first_slot + s;
      const int m = mesh->membrane(totals.component_of(group, s));
      model.tension[slot] = base_tension[slot] + tension[m];
      model.pressure[slot] = pressure[m];
      if (!area_local || local_modulus[slot] == 0.0) continue;
      const double a0 = reference_area[group.face[std::min(s, group.nfaces - 1)]];
      model.tension[slot] += local_modulus[slot] * (integrals.area[slot] - a0) / a0;
    }
}

/* ----------------------------------------------------------------------
   gradient of the volume through the centre it is measured from, see MeshTotals
------------------------------------------------------------------------- */

void PairHelfrich::share_volume_recoil()
{
  const auto &topology = mesh->topology();
  const auto &molecules = mesh->molecules();
  const auto &membranes = totals.membranes();
  for (const auto &[i, v] : mesh->owned_points()) {
    const int c = topology.component(v), m = mesh->membrane(c);
    if (!membrane_volume[m]) continue;
    const HelfrichCoefficients &terms = *membrane_terms[m];
    double pressure = -terms.pressure;
    if (terms.volume_modulus != 0.0) {
      const double v0 = references[molecules[m]].volume;
      pressure += terms.volume_modulus * (membranes[m].volume - v0) / v0;
    }
    const double share = pressure / (3.0 * topology.num_vertices(c));
    for (int k = 0; k < 3; ++k) atom->f[i][k] += share * totals.components()[c].vector_area[k];
  }
}

/* ---------------------------------------------------------------------- */

void PairHelfrich::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  const MeshChange changed = mesh.follow();
  if (changed == MeshChange::TOPOLOGY || terms_for_default != default_regularize) {
    choose_terms();
    stale = true;
  }
  if (stale || changed != MeshChange::NOTHING) localize();

  const bool wants_volume = volumes || (eflag_global && report);
  if (first_pass || wants_volume) {
    totals.measure(groups, model, integrals, wants_volume);
    take_references();
  }
  double points = 0.0;
  for (const FaceGroup &group : groups) points += 1.0 * group.nfaces * group.rule->npoints;
  points_evaluated = first_pass || wants_volume ? 2.0 * points : points;
  if (first_pass) apply_global_terms();

  const int nslots = count_slots(groups);
  for (auto *sum : {&energies.bending, &energies.gauss, &energies.area})
    sum->resize(eflag_either ? nslots : 0);
  energies.virial.resize(vflag_either ? 6 * (size_t) nslots : 0);

  const int nall = atom->nlocal + atom->nghost;
  if (!force->newton) {
    for (int i = atom->nlocal; i < nall; ++i) std::fill_n(atom->f[i], 3, 0.0);
    clear_ghost_tallies();
  }

  Membrane_NS::HelfrichTerms terms;
  terms.gauss = gauss;
  terms.volume = volumes;
  const auto x = nall ? reinterpret_cast<const double(*)[3]>(atom->x[0]) : nullptr;
  const auto f = nall ? reinterpret_cast<double(*)[3]>(atom->f[0]) : nullptr;
  for (const FaceGroup &group : groups) face_forces(group, x, model, terms, f, energies);
  if (volumes) share_volume_recoil();
  if (regularized) regularize();

  if (eflag_either || vflag_either) tally();
  if (!force->newton)
    comm->reverse_comm(this);
  else if (!force->newton_pair && (eflag_atom || vflag_atom)) {
    comm->reverse_comm(this);
    clear_ghost_tallies();
  }
}

void PairHelfrich::clear_ghost_tallies()
{
  for (int i = atom->nlocal; i < atom->nlocal + atom->nghost; ++i) {
    if (eflag_atom) eatom[i] = 0.0;
    if (vflag_atom) std::fill_n(vatom[i], 6, 0.0);
  }
}

/* ----------------------------------------------------------------------
   at the end of a run: does a finer rule see the same energy? Between the points of quadrature a
   surface may fold unseen, which a minimization without regularize is sure to find
------------------------------------------------------------------------- */

void PairHelfrich::finish()
{
  if (quadrature == Quadrature::CAREFUL) return;
  mesh->refresh();
  const auto finer = quadrature == Quadrature::TWELVE ? Quadrature::CAREFUL : Quadrature::TWELVE;
  const int nall = atom->nlocal + atom->nghost;
  std::vector<double> scratch(3 * (size_t) nall + 3);
  const auto x = nall ? reinterpret_cast<const double(*)[3]>(atom->x[0]) : nullptr;
  const auto f = reinterpret_cast<double(*)[3]>(scratch.data());

  const auto bending = [&] {
    Membrane_NS::FaceEnergies found;
    found.bending.resize(count_slots(groups));
    double mine = 0.0, all;
    for (const FaceGroup &group : groups) {
      face_forces(group, x, model, Membrane_NS::HelfrichTerms(), f, found);
      for (int s = 0; s < group.nfaces; ++s) mine += found.bending[group.first_slot + s];
    }
    MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
    return all;
  };

  localize();
  const double here = bending();
  auto kept = std::make_unique<PatchRules>(finer);
  std::swap(rules, kept);
  localize();
  const double there = bending();
  std::swap(rules, kept);
  stale = true;

  double largest_kc = 0.0;
  for (const HelfrichCoefficients &c : coefficients) largest_kc = MAX(largest_kc, c.kc);
  if (comm->me == 0 &&
      !(std::fabs(there - here) <= MOST_QUADRATURE_ERROR * (there + largest_kc)))
    error->warning(FLERR,
                   "The bending energy is {:.6g} by quadrature {} but {:.6g} by quadrature {}: the "
                   "mesh is too coarse for this shape, or has degraded; refine it, or keep it in "
                   "shape with regularize in pair_coeff",
                   here, Membrane_NS::quadrature_name(quadrature), there,
                   Membrane_NS::quadrature_name(finer));
}

/* ----------------------------------------------------------------------
   faces' shapes; stops before one collapses
------------------------------------------------------------------------- */

void PairHelfrich::regularize()
{
  distortion_energy.assign(eflag_either ? count_slots(groups) : 0, 0.0);
  if (atom->nlocal + atom->nghost == 0) return;
  const auto x = reinterpret_cast<const double(*)[3]>(atom->x[0]);
  const auto f = reinterpret_cast<double(*)[3]>(atom->f[0]);
  for (const FaceGroup &group : groups) {
    const double worst = Membrane_NS::regularize_faces(group, x, regularization, f,
                                                       distortion_energy, energies.virial);
    if (worst < WORST_FACE) continue;
    for (int s = 0; s < group.nfaces; ++s)
      if (!(Membrane_NS::face_distortion(x[group.point(s, 0)], x[group.point(s, 1)],
                                         x[group.point(s, 2)]) < WORST_FACE))
        error->one(FLERR,
                   "Membrane mesh: {} is about to collapse; use a larger regularize modulus in "
                   "pair_coeff or a smaller timestep",
                   mesh->face_name(group.face[s]));
  }
}

/* ----------------------------------------------------------------------
   a face's energy and virial are shared by its corners; energies of whole membranes are shared in
   proportion to area
------------------------------------------------------------------------- */

void PairHelfrich::tally()
{
  std::fill_n(pvector, NEXTRA, 0.0);
  pvector[POINTS] = points_evaluated;

  // energy of each membrane's area and volume, per area

  const auto &molecules = mesh->molecules();
  const auto &membranes = totals.membranes();
  std::vector<double> area_energy(molecules.size(), 0.0), volume_energy(molecules.size(), 0.0);
  if (eflag_either && first_pass)
    for (size_t m = 0; m < molecules.size(); ++m) {
      const HelfrichCoefficients &c = *membrane_terms[m];
      const Reference &reference = references[molecules[m]];
      if (c.area_modulus != 0.0) {
        const double excess = membranes[m].area - reference.area;
        area_energy[m] = 0.5 * c.area_modulus * excess * excess / reference.area;
      }
      if (c.volume_modulus != 0.0) {
        const double excess = membranes[m].volume - reference.volume;
        volume_energy[m] = 0.5 * c.volume_modulus * excess * excess / reference.volume;
      }
      volume_energy[m] -= c.pressure * membranes[m].volume;
      area_energy[m] /= membranes[m].area;
      volume_energy[m] /= membranes[m].area;
    }

  for (const FaceGroup &group : groups)
    for (int s = 0; s < group.nfaces; ++s) {
      const int slot = group.first_slot + s;
      if (eflag_either) {
        const double area = energies.area[slot];
        if (!std::isfinite(area + energies.bending[slot] + energies.gauss[slot]))
          error->one(FLERR,
                     "Membrane mesh: the energy of {} is not a finite number: control points around "
                     "it coincide or have flown apart; use a better mesh or a smaller timestep",
                     mesh->face_name(group.face[s]));
        const int m = mesh->membrane(totals.component_of(group, s));
        double part[4] = {energies.bending[slot], energies.gauss[slot],
                          (base_tension[slot] + area_energy[m]) * area, volume_energy[m] * area};
        if (area_local && local_modulus[slot] != 0.0) {
          const double a0 = reference_area[group.face[s]], excess = area - a0;
          part[AREA] += 0.5 * local_modulus[slot] * excess * excess / a0;
        }
        const double shape = regularized ? distortion_energy[slot] : 0.0;
        const double sum = part[0] + part[1] + part[2] + part[3] + shape;
        pvector[REGULARIZATION] += shape;
        for (int k = 0; k < 4; ++k) pvector[k] += part[k];
        pvector[TOTAL_AREA] += area;
        if (eflag_global) eng_vdwl += sum;
        if (eflag_atom)
          for (int k = 0; k < 3; ++k) eatom[group.point(s, k)] += sum / 3.0;
      }
      if (vflag_either) {
        const double *v = &energies.virial[6 * (size_t) slot];
        if (vflag_global)
          for (int i = 0; i < 6; ++i) virial[i] += v[i];
        if (vflag_atom)
          for (int k = 0; k < 3; ++k)
            for (int i = 0; i < 6; ++i) vatom[group.point(s, k)][i] += v[i] / 3.0;
      }
    }

  if (eflag_either && (volumes || report) && comm->me == 0)
    for (const auto &membrane : totals.membranes()) pvector[TOTAL_VOLUME] += membrane.volume;
}

/* ----------------------------------------------------------------------
   with newton off LAMMPS returns nothing from ghosts: forces and per-atom tallies go back here.
   With newton off for pairs only it returns all, but pair hybrid loses tallies: these go back here
------------------------------------------------------------------------- */

int PairHelfrich::pack_reverse_comm(int n, int first, double *buf)
{
  int m = 0;
  for (int i = first; i < first + n; ++i) {
    for (int k = 0; k < 3; ++k) buf[m++] = force->newton ? 0.0 : atom->f[i][k];
    buf[m++] = eflag_atom ? eatom[i] : 0.0;
    for (int k = 0; k < 6; ++k) buf[m++] = vflag_atom ? vatom[i][k] : 0.0;
  }
  return m;
}

void PairHelfrich::unpack_reverse_comm(int n, int *list, double *buf)
{
  int m = 0;
  for (int j = 0; j < n; ++j) {
    const int i = list[j];
    for (int k = 0; k < 3; ++k) atom->f[i][k] += buf[m++];
    if (eflag_atom) eatom[i] += buf[m];
    ++m;
    for (int k = 0; k < 6; ++k, ++m)
      if (vflag_atom) vatom[i][k] += buf[m];
  }
}

/* ----------------------------------------------------------------------
   restart: settings hold what "init" took as well, since pair_style hybrid writes only those
------------------------------------------------------------------------- */

void PairHelfrich::write_restart_settings(FILE *fp)
{
  const int which = static_cast<int>(quadrature);
  const bigint n = references.size();
  fwrite(&which, sizeof(int), 1, fp);
  fwrite(&n, sizeof(bigint), 1, fp);
  for (const auto &[molecule, reference] : references) {
    const bigint faces = reference.face_area.size();
    fwrite(&molecule, sizeof(tagint), 1, fp);
    fwrite(&reference.area, sizeof(double), 1, fp);
    fwrite(&reference.volume, sizeof(double), 1, fp);
    fwrite(&faces, sizeof(bigint), 1, fp);
    fwrite(reference.face_area.data(), sizeof(double), faces, fp);
  }
}

void PairHelfrich::read_all(FILE *fp, void *data, size_t size, size_t n)
{
  if (comm->me == 0) utils::sfread(FLERR, data, size, n, fp, nullptr, error);
  MPI_Bcast(data, size * n, MPI_BYTE, 0, world);
}

void PairHelfrich::read_restart_settings(FILE *fp)
{
  int which;
  bigint n, faces;
  read_all(fp, &which, sizeof(int), 1);
  quadrature = static_cast<Quadrature>(which);
  rules = std::make_unique<PatchRules>(quadrature);

  references.clear();
  read_all(fp, &n, sizeof(bigint), 1);
  for (bigint i = 0; i < n; ++i) {
    tagint molecule;
    read_all(fp, &molecule, sizeof(tagint), 1);
    Reference &reference = references[molecule];
    read_all(fp, &reference.area, sizeof(double), 1);
    read_all(fp, &reference.volume, sizeof(double), 1);
    read_all(fp, &faces, sizeof(bigint), 1);
    reference.face_area.resize(faces);
    read_all(fp, reference.face_area.data(), sizeof(double), faces);
  }
  restored = true;
}

void PairHelfrich::write_restart(FILE *fp)
{
  write_restart_settings(fp);
  fwrite(coefficients.data(), sizeof(HelfrichCoefficients), coefficients.size(), fp);
}

void PairHelfrich::read_restart(FILE *fp)
{
  read_restart_settings(fp);
  allocate();
  read_all(fp, coefficients.data(), sizeof(HelfrichCoefficients), coefficients.size());
}

/* ---------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   kc: bending moduli by type, for min style membrane; default_regularize: of types that pair_coeff says
   nothing of, for a fix to set before each run
------------------------------------------------------------------------- */

void *PairHelfrich::extract(const char *name, int &dim)
{
  dim = 0;
  if (strcmp(name, "default_regularize") == 0) return &default_regularize;
  if (strcmp(name, "kc") != 0) return nullptr;
  dim = 1;
  moduli.resize(coefficients.size());
  for (size_t t = 0; t < coefficients.size(); ++t) moduli[t] = coefficients[t].kc;
  return moduli.data();
}

/* ---------------------------------------------------------------------- */

double PairHelfrich::memory_usage()
{
  double bytes = Pair::memory_usage();
  for (const FaceGroup &group : groups)
    bytes += sizeof(int) * (group.points.capacity() + group.face.capacity());
  bytes += sizeof(double) * 13.0 * count_slots(groups);
  if (rules) bytes += rules->memory_usage();
  return bytes;
}
