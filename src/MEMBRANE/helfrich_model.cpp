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

#include "helfrich_model.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using Membrane_NS::FaceGroup;
using Membrane_NS::FaceModel;
using Membrane_NS::PatchRules;
using Membrane_NS::Quadrature;

// of the bending energy and of kc: beyond it a warning at the end of a run
static constexpr double MOST_QUADRATURE_ERROR = 0.1;

static constexpr int RESTART_VERSION = 3;

/* ----------------------------------------------------------------------
   a new term: one file that defines it, and one line here. In this order they act
------------------------------------------------------------------------- */

static std::vector<std::unique_ptr<HelfrichTerm>> make_terms(LAMMPS *lmp)
{
  std::vector<std::unique_ptr<HelfrichTerm>> terms;
  terms.push_back(std::make_unique<HelfrichTermBending>(lmp));
  for (auto make : {make_gauss_term, make_leaflets_term, make_tension_term, make_lipids_term, make_area_term,
                    make_area_difference_term, make_local_area_term, make_volume_term, make_pressure_term,
                    make_regularize_term, make_measure_term})
    terms.push_back(make(lmp));
  return terms;
}

HelfrichModel::HelfrichModel(LAMMPS *lmp) :
    Pointers(lmp), scene(lmp), exclusion(lmp), terms(make_terms(lmp)),
    bending(static_cast<HelfrichTermBending *>(terms.front().get())),
    lipids(static_cast<HelfrichTermLipids *>(find_term("lipids"))), restored(false), reports_volume(false),
    stale(true), lipid_stamp(0), tally{}
{
  set_quadrature(Quadrature::SIX);
}

HelfrichTerm *HelfrichModel::find_term(const std::string &keyword) const
{
  const auto found = std::find_if(terms.begin(), terms.end(), [&](auto &t) { return t->keyword == keyword; });
  return found == terms.end() ? nullptr : found->get();
}

void HelfrichModel::set_quadrature(Quadrature quadrature)
{
  rules = std::make_unique<PatchRules>(quadrature);
  finer_rules.reset();
  stale = true;
}

void HelfrichModel::resize(int ntypes)
{
  for (auto &term : terms) term->resize(ntypes + 1);
  fresh.assign(ntypes + 1, 0);
}

void HelfrichModel::set_coefficients(const std::vector<int> &types, int narg, char **arg)
{
  for (auto &term : terms)
    for (int type : types) term->clear(type);
  for (int type : types) fresh[type] = !restored;

  std::vector<std::string> keywords;
  for (size_t i = 1; i < terms.size(); ++i)
    if (terms[i]->is_keyword()) keywords.push_back(terms[i]->keyword);

  int iarg = bending->parse(types, HelfrichWords(lmp, narg, arg, keywords));
  while (iarg < narg) {
    const HelfrichWords words(lmp, narg - iarg, arg + iarg, keywords);
    if (!words.at_end(0)) {
      std::string known;
      for (const std::string &keyword : keywords) known += (known.empty() ? "" : ", ") + keyword;
      error->all(FLERR, "Unknown pair_coeff helfrich keyword {}; known are: {}", words.keyword(), known);
    }
    iarg += find_term(words.keyword())->parse(types, words);
  }
}

/* ---------------------------------------------------------------------- */

void HelfrichModel::init()
{
  scene.mesh.init();
  stale = true;
  check_types();
  if (scene.mesh->topology().num_faces() == 0 && comm->me == 0)
    error->warning(FLERR, "Pair style helfrich finds no membrane: use create_membrane or read_data");
  scene.mesh->warn_of_overlap();
  choose();
}

/* ----------------------------------------------------------------------
   every control point has coefficients, every atom with coefficients is a control point
------------------------------------------------------------------------- */

void HelfrichModel::check_types()
{
  tagint bad[2] = {0, 0}, any[2];
  for (int i = 0; i < atom->nlocal; ++i) {
    const bool is_point = scene.mesh->vertex(atom->tag[i]) >= 0;
    const bool has = has_coefficients(atom->type[i]);
    if (is_point && !has) bad[0] = MAX(bad[0], atom->tag[i]);
    if (!is_point && has) bad[1] = MAX(bad[1], atom->tag[i]);
  }
  MPI_Allreduce(bad, any, 2, MPI_LMP_TAGINT, MPI_MAX, world);
  if (any[0] && !force->pair_match("helfrich", 1))
    error->all(FLERR, "pair_style helfrich stands several times in hybrid: use it once, for all membranes");
  if (any[0])
    error->all(FLERR, "Control point {} is of a type without coefficients: add a pair_coeff line",
               any[0]);
  if (any[1])
    error->all(FLERR,
               "Atom {} is of a type with pair helfrich coefficients but is in no face: give it a "
               "type of its own or delete it",
               any[1]);
}

/* ----------------------------------------------------------------------
   which terms this scene has; all ranks agree
------------------------------------------------------------------------- */

void HelfrichModel::choose()
{
  find_types();
  for (auto &term : terms) term->choose(scene);

  const int nmembranes = static_cast<int>(scene.types.size());
  std::vector<char> has_totals(nmembranes, 0);
  for (int m = 0; m < nmembranes; ++m)
    for (auto &term : terms)
      if (term->of_whole_membrane() && term->is_in(scene, m)) has_totals[m] = 1;
  scene.excluded = exclusion.find_membranes(*scene.mesh, has_totals);

  present.clear();
  needs = HelfrichTerm::Needs();
  for (auto &term : terms) {
    bool found = false;
    for (int m = 0; m < nmembranes; ++m)
      found = found || (!scene.excluded[m] && term->is_in(scene, m));
    if (!found) continue;
    present.push_back(term.get());
    const HelfrichTerm::Needs more = term->needs();
    needs.totals = needs.totals || more.totals;
    needs.volume = needs.volume || more.volume;
    needs.curvature = needs.curvature || more.curvature;
    needs.gauss = needs.gauss || more.gauss;
    needs.places = needs.places || more.places;
    needs.origins = needs.origins || more.origins;
  }

  membrane_volume.assign(nmembranes, 0);
  for (int m = 0; m < nmembranes; ++m)
    if (!scene.excluded[m]) check_membrane(m);

  std::vector<char> anew(nmembranes, 0);
  for (int m = 0; m < nmembranes; ++m)
    for (int t : scene.types[m]) anew[m] = anew[m] || fresh[t];
  if (needs.origins) scene.origins.give(*scene.mesh);
  for (HelfrichTerm *term : present) term->find_references(scene, anew);
  std::fill(fresh.begin(), fresh.end(), 0);
  restored = false;

  // total volumes cost a pass: only if there are any and somebody can read them

  reports_volume = false;
  if (!modify->get_compute_by_style("^pair$").empty())
    for (int m = 0; m < nmembranes; ++m)
      reports_volume = reports_volume || scene.mesh->is_closed_membrane(m);
}

// the types of each membrane's control points, from all ranks

void HelfrichModel::find_types()
{
  const int nmembranes = static_cast<int>(scene.mesh->molecules().size()), n = atom->ntypes + 1;
  std::vector<int> mine((size_t) nmembranes * n, 0), all(mine.size());
  for (int i = 0; i < atom->nlocal; ++i) {
    const int v = scene.mesh->vertex(atom->tag[i]);
    if (v < 0) continue;
    const int m = scene.mesh->membrane(scene.mesh->topology().component(v));
    mine[(size_t) m * n + atom->type[i]] = 1;
  }
  MPI_Allreduce(mine.data(), all.data(), mine.size(), MPI_INT, MPI_MAX, world);
  scene.types.assign(nmembranes, {});
  for (int m = 0; m < nmembranes; ++m)
    for (int t = 1; t < n; ++t)
      if (all[(size_t) m * n + t]) scene.types[m].push_back(t);
}

// terms of a whole membrane fit it

void HelfrichModel::check_membrane(int m)
{
  const tagint molecule = scene.mesh->molecules()[m];
  const int first = scene.types[m].front();
  for (int t : scene.types[m])
    for (auto &term : terms) {
      if (term->of_whole_membrane() && !term->same(first, t))
        error->all(FLERR,
                   "Membrane {} has control points of types with different {} coefficients; these "
                   "belong to a whole membrane: make them equal",
                   molecule, term->keyword);
      if (!term->acts_on(t) || !term->needs().volume) continue;
      membrane_volume[m] = 1;
      if (!scene.mesh->is_closed_membrane(m))
        error->all(FLERR,
                   "Membrane {} continues through the periodic box and encloses no volume: remove "
                   "volume and pressure from pair_coeff {} {}",
                   molecule, t, t);
    }
  const bool shape_needed = std::any_of(terms.begin(), terms.end(), [&](auto &term) {
    return term->needs().regularize && term->is_in(scene, m);
  });
  const auto &regularize = *std::find_if(terms.begin(), terms.end(),
                                         [](auto &term) { return term->keyword == "regularize"; });
  for (int t : scene.types[m])
    if (shape_needed && !regularize->acts_on(t))
      error->all(FLERR,
                 "Membrane {} is sampled at a temperature without anything that keeps its faces in "
                 "shape: add regularize to pair_coeff {} {}, half of kc is a good value, or say measure "
                 "no in the fix",
                 molecule, t, t);
}

/* ----------------------------------------------------------------------
   after reneighbouring: faces of this rank and their coefficients
------------------------------------------------------------------------- */

void HelfrichModel::localize()
{
  stale = false;
  faces = exclusion.remaining_faces(*scene.mesh);
  scene.groups = scene.mesh->local_groups(*rules, faces);
  load(scene.groups, scene.model);
}

void HelfrichModel::load(const std::vector<FaceGroup> &groups, FaceModel &model)
{
  lipid_stamp = scene.mesh->lipids().stamp;
  model.resize(count_slots(groups));
  for (HelfrichTerm *term : present) term->localize(groups, model);
}

void HelfrichModel::describe_faces(const std::vector<FaceGroup> &groups, FaceModel &model)
{
  load(groups, model);
  stale = true;    // terms keep what they load
}

/* ----------------------------------------------------------------------
   first pass, and what terms make of it: derivatives by totals act as tension, pressure and moment
------------------------------------------------------------------------- */

void HelfrichModel::measure(const Wanted &wanted)
{
  const bool volume = needs.volume || (wanted.total_volume && reports_volume);
  if (needs.places && !volume) scene.totals.place(scene.groups, scene.model);
  if (!needs.totals && !volume) return;
  scene.totals.measure(scene.groups, scene.model, scene.integrals, {volume, needs.curvature});
  for (HelfrichTerm *term : present) term->take_references(scene);
  if (!update->setupflag) return;
  for (size_t m = 0; m < membrane_volume.size(); ++m)
    if (membrane_volume[m] && scene.totals.membranes()[m].volume <= 0.0)
      error->all(FLERR,
                 "Membrane {} encloses the volume {:.6g}: its faces are inside out; reverse the "
                 "order of their corners, as flip yes of create_membrane does",
                 scene.mesh->molecules()[m], scene.totals.membranes()[m].volume);
}

void HelfrichModel::act()
{
  scene.conjugates.assign(scene.types.size(), Conjugates());
  for (HelfrichTerm *term : present) term->act_on_membranes(scene);
  for (const FaceGroup &group : scene.groups)
    for (int s = 0, n = group.nslots(); s < n; ++s) {
      const int slot = group.first_slot + s;
      const Conjugates &total = scene.conjugates[scene.membrane(group, s)];
      scene.model.tension[slot] = total.tension;
      scene.model.pressure[slot] = total.pressure;
      scene.model.moment[slot] = total.moment;
    }
  for (HelfrichTerm *term : present) term->act_on_faces(scene);
}

/* ----------------------------------------------------------------------
   gradient of the volume through the centre it is measured from, see MeshTotals
------------------------------------------------------------------------- */

void HelfrichModel::share_volume_recoil(double (*f)[3])
{
  const auto &topology = scene.mesh->topology();
  for (const auto &[i, v] : scene.mesh->owned_points()) {
    const int c = topology.component(v), m = scene.mesh->membrane(c);
    if (!membrane_volume[m]) continue;
    const double share = scene.conjugates[m].pressure / (3.0 * topology.num_vertices(c));
    for (int k = 0; k < 3; ++k) f[i][k] += share * scene.totals.components()[c].vector_area[k];
  }
}

/* ---------------------------------------------------------------------- */

// the scene of this step up to the forces; whether there was a first pass

bool HelfrichModel::prepare(const Wanted &wanted)
{
  const MeshChange changed = scene.mesh.follow();
  if (changed == MeshChange::TOPOLOGY) choose();
  if (stale || changed != MeshChange::NOTHING)
    localize();
  else if (scene.mesh->lipids().stamp != lipid_stamp)
    load(scene.groups, scene.model);

  const bool first_pass = needs.totals || (wanted.total_volume && reports_volume);
  measure(wanted);
  if (needs.totals) act();
  return first_pass;
}

void HelfrichModel::compute(const Wanted &wanted)
{
  const bool first_pass = prepare(wanted);
  const int nslots = scene.nslots(), nall = atom->nlocal + atom->nghost;
  for (auto *sum : {&scene.energies.bending, &scene.energies.gauss, &scene.energies.area})
    sum->resize(wanted.energy ? nslots : 0);
  scene.energies.leaflet_bend.resize(scene.model.has_leaflets() ? nslots : 0);
  scene.energies.virial.resize(wanted.virial ? 6 * (size_t) nslots : 0);

  const Membrane_NS::FaceTerms kernel = {needs.gauss, needs.volume, needs.curvature, scene.model.has_leaflets()};
  const auto x = nall ? reinterpret_cast<const double(*)[3]>(atom->x[0]) : nullptr;
  const auto f = nall ? reinterpret_cast<double(*)[3]>(atom->f[0]) : nullptr;
  double points = 0.0;
  face_forces(scene.groups, x, scene.model, kernel, f, scene.energies);
  for (const FaceGroup &group : scene.groups) points += 1.0 * group.nfaces * group.rule->npoints;
  if (needs.volume) share_volume_recoil(f);
  for (HelfrichTerm *term : present) term->add_forces(scene, x, f);
  if (wanted.energy) collect(first_pass ? 2.0 * points : points);
}

/* ---------------------------------------------------------------------- */

void HelfrichModel::collect(double points)
{
  tally = HelfrichTally{};
  tally.face.assign(scene.nslots(), 0.0);
  for (HelfrichTerm *term : present) term->tally(scene, tally);
  for (const FaceGroup &group : scene.groups)
    for (int s = 0; s < group.nfaces; ++s) {
      const int slot = group.first_slot + s;
      tally.output[HelfrichOutput::TOTAL_AREA] += scene.energies.area[slot];
      if (!std::isfinite(tally.face[slot] + scene.energies.area[slot]))
        error->one(FLERR,
                   "Membrane mesh: the energy of {} is not a finite number: control points around "
                   "it coincide or have flown apart; use a better mesh or a smaller timestep",
                   scene.mesh->face_name(group.face[s]));
    }
  tally.output[HelfrichOutput::POINTS] = points;
  if ((needs.volume || reports_volume) && comm->me == 0)
    for (const auto &membrane : scene.totals.membranes())
      tally.output[HelfrichOutput::TOTAL_VOLUME] += membrane.volume;
}

/* ----------------------------------------------------------------------
   does a finer rule see the same energy? Between the points of quadrature a surface may fold unseen,
   which a minimization without regularize is sure to find
------------------------------------------------------------------------- */

void HelfrichModel::check_quadrature()
{
  if (quadrature() == Quadrature::CAREFUL) return;
  scene.mesh->refresh();
  if (!finer_rules && quadrature() == Quadrature::TWELVE) finer_rules = std::make_unique<PatchRules>(Quadrature::CAREFUL);
  if (!finer_rules)    // SIX has twelve points where faces are narrow: others there
    finer_rules = std::make_unique<PatchRules>(
        Quadrature::TWELVE, quadrature() == Quadrature::SIX ? Quadrature::SIX : Quadrature::TWELVE);
  faces = exclusion.remaining_faces(*scene.mesh);
  const double here = bending_energy(*rules), there = bending_energy(*finer_rules);
  const std::vector<double> kc = bending_moduli();
  const double largest_kc = *std::max_element(kc.begin(), kc.end());
  if (comm->me == 0 &&
      !(std::fabs(there - here) <= MOST_QUADRATURE_ERROR * (there + largest_kc)))
    error->warning(FLERR,
                   "The bending energy is {:.6g} by quadrature {} but {:.6g} by quadrature {}: the "
                   "mesh is too coarse for this shape, or has degraded; refine it, or keep it in "
                   "shape with regularize in pair_coeff",
                   here, Membrane_NS::quadrature_name(quadrature()), there,
                   Membrane_NS::quadrature_name(finer_rules->quadrature()));
}

double HelfrichModel::bending_energy(PatchRules &by)
{
  Membrane_NS::FaceGroups groups = scene.mesh->local_groups(by, faces);
  FaceModel model;
  Membrane_NS::FaceIntegrals found;
  found.bending.resize(count_slots(groups));
  load(groups, model);
  stale = true;    // terms keep what they load
  const auto x =
      atom->nlocal ? reinterpret_cast<const double(*)[3]>(atom->x[0]) : nullptr;
  double mine = 0.0, all;
  face_integrals(groups, x, model, found);
  for (const FaceGroup &group : groups)
    for (int s = 0; s < group.nfaces; ++s) mine += found.bending[group.first_slot + s];
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

/* ----------------------------------------------------------------------
   restart. What each term has is stored under its keyword, so that terms may be added
------------------------------------------------------------------------- */

template <class Archive>
static void archive_terms(RestartArchive &file, std::vector<std::unique_ptr<HelfrichTerm>> &terms,
                          Error *error, const Archive &archive)
{
  int count = static_cast<int>(terms.size());
  file(count);
  for (int i = 0; i < count && file.ok(); ++i) {
    std::string keyword = file.is_reading() ? "" : terms[i]->keyword;
    file(keyword);
    const auto term = std::find_if(terms.begin(), terms.end(),
                                   [&](auto &t) { return t->keyword == keyword; });
    if (term == terms.end())
      error->all(FLERR, "The restart file has a term of pair style helfrich that this version of "
                        "the package does not know: {}", keyword);
    RestartArchive part;
    if (!file.is_reading()) archive(**term, part);
    std::string bytes = part.bytes();
    file(bytes);
    if (!file.is_reading()) continue;
    part = RestartArchive(bytes);
    archive(**term, part);
    if (!part.ok() || !part.at_end())
      error->all(FLERR, "The restart file is damaged: {} of pair style helfrich", keyword);
  }
}

void HelfrichModel::archive_settings(RestartArchive &file)
{
  int version = RESTART_VERSION, which = static_cast<int>(quadrature());
  file(version);
  if (version != RESTART_VERSION)
    error->all(FLERR,
               "The restart file has pair style helfrich of version {}, and this package reads "
               "version {}: continue from a data file",
               version, RESTART_VERSION);
  file(which);
  if (file.is_reading()) set_quadrature(static_cast<Quadrature>(which));
  scene.origins.archive(file);
  archive_terms(file, terms, error,
                [](HelfrichTerm &term, RestartArchive &part) { term.archive_references(part); });
  if (!file.ok()) error->all(FLERR, "The restart file is damaged: settings of pair style helfrich");
  restored = file.is_reading();
}

void HelfrichModel::archive_coefficients(RestartArchive &file)
{
  archive_terms(file, terms, error,
                [](HelfrichTerm &term, RestartArchive &part) { term.archive_coefficients(part); });
  if (!file.ok())
    error->all(FLERR, "The restart file is damaged: coefficients of pair style helfrich");
}

/* ---------------------------------------------------------------------- */

double HelfrichModel::memory_usage() const
{
  const double rule_bytes = rules->memory_usage() + (finer_rules ? finer_rules->memory_usage() : 0.0);
  return rule_bytes + scene.groups.memory_usage() + sizeof(double) * 14.0 * scene.nslots();
}
