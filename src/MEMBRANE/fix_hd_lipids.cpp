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

#include "fix_hd_lipids.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_hd_base.h"
#include "force.h"
#include "group.h"
#include "helfrich_model.h"
#include "math_extra.h"
#include "mesh_exclusion.h"
#include "mesh_gather.h"
#include "modify.h"
#include "pair.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

using namespace LAMMPS_NS;
using Membrane_NS::CounterRandom;
using Membrane_NS::FaceGroup;
using Membrane_NS::FaceLipids;
using Membrane_NS::LipidExchange;

// streams of random numbers of a visit: kinds of attempts in their order, and how many there are

enum { NEIGHBORS, ANYWHERE = 2, LEAFLETS = 4, ROUNDING, STREAMS = 8 };

/* ---------------------------------------------------------------------- */

FixHDLipids::FixHDLipids(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), temperature(0.0), diffusion(0.0), anywhere(0.0), flips(0.0), seed(0),
    mesh(lmp, "Fix hd/lipids"), model(nullptr), composition(nullptr), warned(false), published(false), filled(false), visits(0), last_visit(-1),
    attempted(0), accepted(0), energy(0.0)
{
  parse(narg, arg);
  mesh.require();
  scalar_flag = vector_flag = 1;
  size_vector = 4;
  global_freq = 1;
  extscalar = 1;
  extvector = 0;
  ecouple_flag = 1;
  restart_global = 1;
  dynamic_group_allow = 0;
}

FixHDLipids::~FixHDLipids()
{
  if (!published) return;
  MeshLipids &lipids = mesh->lipids();
  lipids.active = false;
  ++lipids.stamp;
}

void FixHDLipids::parse(int narg, char **arg)
{
  if (narg < 6) utils::missing_cmd_args(FLERR, "fix hd/lipids", error);
  nevery = utils::inumeric(FLERR, arg[3], false, lmp);
  temperature = utils::numeric(FLERR, arg[4], false, lmp);
  seed = utils::bnumeric(FLERR, arg[5], false, lmp);
  if (nevery <= 0) error->all(FLERR, "Fix hd/lipids: N {} must be a number of steps, 1 or more", arg[3]);
  if (!(temperature > 0.0)) error->all(FLERR, "Fix hd/lipids temperature {} must be positive", arg[4]);
  if (seed <= 0) error->all(FLERR, "Fix hd/lipids seed {} must be positive", arg[5]);

  int iarg = 6;
  while (iarg < narg) {
    const std::string key = arg[iarg];
    const int words = key == "interaction" ? 4 : 2;
    double *number = key == "diffuse" ? &diffusion : key == "global" ? &anywhere : key == "flip" ? &flips : nullptr;
    if (!number && key != "interaction")
      error->all(FLERR, "Unknown fix hd/lipids keyword {}; known are: diffuse, flip, global, interaction", key);
    if (iarg + words > narg) utils::missing_cmd_args(FLERR, "fix hd/lipids " + key, error);
    if (number) {
      *number = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
      if (!(*number >= 0.0)) error->all(FLERR, "Fix hd/lipids {} {} must not be negative", key, arg[iarg + 1]);
    } else
      interactions.push_back({arg[iarg + 1], arg[iarg + 2], utils::numeric(FLERR, arg[iarg + 3], false, lmp)});
    iarg += words;
  }
  if (diffusion == 0.0 && anywhere == 0.0 && flips == 0.0 && comm->me == 0)
    error->warning(FLERR, "Fix hd/lipids: no lipid will move; say diffuse, global or flip");
}

int FixHDLipids::setmask()
{
  return FixConst::PRE_FORCE | FixConst::MIN_PRE_FORCE;
}

/* ---------------------------------------------------------------------- */

void FixHDLipids::check_surroundings()
{
  if (modify->get_fix_by_style("^hd/lipids$").size() > 1)
    error->all(FLERR, "There are several fixes hd/lipids: use one, for a group of all membranes with exchange");
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix hd/lipids does not work with run_style respa: use verlet");
  Pair *pair = force->pair_match("helfrich", 1);
  int dim;
  model = pair ? static_cast<HelfrichModel *>(pair->extract("model", dim)) : nullptr;
  if (!model) error->all(FLERR, "Fix hd/lipids needs pair style helfrich, whose lipids it moves");
  composition = &model->composition();
  for (const Interaction &interaction : interactions)
    for (const std::string &name : {interaction.first, interaction.second})
      if (composition->library().find(name) < 0)
        error->all(FLERR, "Fix hd/lipids interaction: no membrane has the lipid {}; they have: {}", name,
                   composition->library().names());
}

/* ----------------------------------------------------------------------
   membranes with exchange are in the group as a whole, and all of their types have lipids
------------------------------------------------------------------------- */

void FixHDLipids::find_membranes()
{
  const auto &topology = mesh->topology();
  const int nmembranes = static_cast<int>(mesh->molecules().size());
  std::vector<int> mine(2 * static_cast<size_t>(topology.num_vertices()), 0), all(mine.size());
  for (int i = 0; i < atom->nlocal; ++i)
    if (const int v = mesh->vertex(atom->tag[i]); v >= 0) {
      mine[2 * v] = atom->type[i];
      mine[2 * v + 1] = (atom->mask[i] & groupbit) != 0;
    }
  MPI_Allreduce(mine.data(), all.data(), static_cast<int>(mine.size()), MPI_INT, MPI_MAX, world);

  std::vector<int> inside(nmembranes, 0), total(nmembranes, 0), without(nmembranes, 0);
  types.resize(topology.num_vertices());
  for (int v = 0; v < topology.num_vertices(); ++v) {
    const int m = mesh->membrane(topology.component(v));
    types[v] = all[2 * v];
    inside[m] += all[2 * v + 1];
    ++total[m];
    if (!composition->of(types[v]).given) without[m] = types[v];
  }
  takes_part.assign(nmembranes, 0);
  for (int m = 0; m < nmembranes; ++m) {
    if (inside[m] == 0) continue;
    if (inside[m] != total[m])
      error->all(FLERR,
                 "Fix hd/lipids: group {} has {} of the {} control points of membrane {}; use a group that has all of "
                 "them or none",
                 group->names[igroup], inside[m], total[m], mesh->molecules()[m]);
    if (without[m])
      error->all(FLERR, "Fix hd/lipids: membrane {} has no lipids to exchange; say lipids in pair_coeff {} {}",
                 mesh->molecules()[m], without[m], without[m]);
    takes_part[m] = 1;
  }
  if (std::count(takes_part.begin(), takes_part.end(), 1) == 0)
    error->all(FLERR, "Fix hd/lipids: group {} has no membrane", group->names[igroup]);
  membrane_of.resize(topology.num_faces());
  for (int f = 0; f < topology.num_faces(); ++f)
    membrane_of[f] = mesh->membrane(topology.component(topology.face(f)[0]));
}

// the composition's curvature of a face's monolayer

double FixHDLipids::composed(int face, int leaflet) const
{
  double sum = 0.0;
  for (int v : mesh->topology().face(face))
    sum += leaflet == 0 ? composition->outer_curvature(types[v]) : composition->inner_curvature(types[v]);
  return sum / 3.0;
}

/* ---------------------------------------------------------------------- */

void FixHDLipids::init()
{
  check_surroundings();
  if (exchange) keep();
  mesh.init();
  find_membranes();
  follow_origins();
  rules = std::make_unique<Membrane_NS::PatchRules>(model->quadrature());
  groups.clear();

  // until the shape is known, in setup_pre_force(), faces of new membranes have what pair_coeff says

  MeshLipids &lipids = mesh->lipids();
  const int nfaces = mesh->topology().num_faces();
  lipids.outer.resize(nfaces);
  lipids.inner.resize(nfaces);
  for (int f = 0; f < nfaces; ++f) {
    lipids.outer[f] = composed(f, 0);
    lipids.inner[f] = composed(f, 1);
  }
  lipids.active = published = true;
  places.lipids = nullptr;
  ++lipids.stamp;
  exchange.reset();
  filled = false;
  last_visit = -1;

  // lipids that are there need no shape, and commands that are no run call init() alone

  find_kept();
  if (std::none_of(anew.begin(), anew.end(), [](char c) { return c != 0; })) take_up();
}

void FixHDLipids::setup_pre_force(int)
{
  follow();
  measure();
  if (!filled) take_up();
}

void FixHDLipids::pre_force(int)
{
  if (update->ntimestep % nevery != 0 || update->ntimestep == last_visit) return;    // a trial of another fix
  last_visit = update->ntimestep;
  follow();
  measure();
  visit();
}

// faces of this rank and what they have without lipids

void FixHDLipids::follow()
{
  const MeshChange changed = mesh.follow();
  if (changed == MeshChange::TOPOLOGY && filled)
    error->all(FLERR, "Fix hd/lipids: faces have changed during a run; delete membranes between runs");
  if (changed == MeshChange::NOTHING && !groups.empty()) return;
  groups = mesh->local_groups(*rules);
  Membrane_NS::FaceModel faces;
  model->describe_faces(groups, faces);
  const MeshLipids &lipids = mesh->lipids();
  const int nslots = count_slots(groups);
  kc = faces.kc;
  std::vector<char> counts(mesh->topology().num_faces(), 0);
  for (int face : MeshExclusion(lmp).remaining_faces(*mesh)) counts[face] = 1;
  distance.assign(nslots, 0.0);
  if (faces.has_leaflets()) distance = faces.leaflet;
  base_outer.assign(nslots, 0.0);
  base_inner.assign(nslots, 0.0);
  for (const FaceGroup &group : groups)
    for (int s = 0; s < group.nfaces; ++s) {
      const int slot = group.first_slot + s, f = group.face[s];
      if (!counts[f]) kc[slot] = 0.0;
      if (distance[slot] > 0.0) {
        base_outer[slot] = faces.outer[slot] - lipids.outer[f];
        base_inner[slot] = faces.inner[slot] - lipids.inner[f];
      } else {
        base_outer[slot] = faces.c0[slot] - 0.5 * (lipids.outer[f] - lipids.inner[f]);
        base_inner[slot] = -base_outer[slot];
      }
    }
}

/* ----------------------------------------------------------------------
   integrals over faces, from the ranks that have them. That of the Gaussian curvature, which areas and
   curvatures of neutral surfaces need, is the energy of a surface with no other modulus
------------------------------------------------------------------------- */

void FixHDLipids::measure()
{
  const int nslots = count_slots(groups), nall = atom->nlocal + atom->nghost;
  const auto x = nall ? reinterpret_cast<const double(*)[3]>(atom->x[0]) : nullptr;
  Membrane_NS::FaceModel bare;
  bare.resize(nslots);
  Membrane_NS::FaceIntegrals found;
  found.area.resize(nslots);
  found.curvature.resize(nslots);
  found.curved_area.resize(nslots);
  face_integrals(groups, x, bare, found);
  Membrane_NS::FaceEnergies gauss;
  if (std::any_of(distance.begin(), distance.end(), [](double d) { return d > 0.0; })) {
    gauss.gauss.resize(nslots);
    std::fill(bare.kg.begin(), bare.kg.end(), 1.0);
    std::vector<double> forces(3 * static_cast<size_t>(nall), 0.0);
    Membrane_NS::FaceTerms terms;
    terms.gauss = true;
    face_forces(groups, x, bare, terms, reinterpret_cast<double(*)[3]>(forces.data()), gauss);
  }

  const auto &topology = mesh->topology();
  std::vector<FaceShape> mine;
  for (const FaceGroup &group : groups)
    for (int s = 0; s < group.nfaces; ++s) {
      const int slot = group.first_slot + s;
      const double D = distance[slot], area = found.curved_area[slot], curvature = found.curvature[slot];
      const double K = gauss.gauss.empty() ? 0.0 : gauss.gauss[slot];
      FaceShape shape;
      shape.face = group.face[s];
      shape.middle = found.area[slot];
      for (int l = 0; l < 2; ++l) shape.area[l] = area + (l == 0 ? D : -D) * curvature + D * D * K;
      if (D > 0.0)
        shape.bending = Membrane_NS::leaflet_bending(
            kc[slot], shape.area,
            {curvature + 2.0 * D * K - base_outer[slot] * shape.area[0],
             -(curvature - 2.0 * D * K) - base_inner[slot] * shape.area[1]});
      else
        shape.bending = Membrane_NS::bilayer_bending(kc[slot], area, curvature - base_outer[slot] * area);
      if (diffusion > 0.0) {
        const int first =
            Membrane_NS::corner_of(topology.face(shape.face), mesh->vertex(atom->tag[group.point(s, 0)]));
        for (int k = 0; k < 3; ++k) {
          const double *a = x[group.point(s, k)], *b = x[group.point(s, (k + 1) % 3)], *c = x[group.point(s, (k + 2) % 3)];
          double ca[3], cb[3], normal[3];
          MathExtra::sub3(a, c, ca);
          MathExtra::sub3(b, c, cb);
          MathExtra::cross3(ca, cb, normal);
          shape.cotangents[(first + k) % 3] = MathExtra::dot3(ca, cb) / MathExtra::len3(normal);
        }
      }
      mine.push_back(shape);
    }
  const std::vector<FaceShape> all = gather_all(mine, world);
  shapes.resize(topology.num_faces());
  for (const FaceShape &shape : all) shapes[shape.face] = shape;
}

/* ---------------------------------------------------------------------- */

// a whole number with this mean

int64_t FixHDLipids::attempts(double mean, int which) const
{
  const double whole = std::floor(mean);
  return static_cast<int64_t>(whole) +
      (CounterRandom(seed, STREAMS * visits + ROUNDING).uniforms(which, 0)[0] < mean - whole);
}

void FixHDLipids::visit()
{
  if (!warned) {
    const std::string wrong = FixHDBase::other_temperature(lmp, this, temperature);
    warned = !wrong.empty();
    if (warned && comm->me == 0) error->warning(FLERR, wrong);
  }
  const double time = update->dt * nevery, kT = force->boltz * temperature;
  const FaceLipids &lipids = exchange->lipids();
  const int nfaces = lipids.num_faces(), nmembranes = static_cast<int>(takes_part.size());
  std::vector<Membrane_NS::FaceBending> bending(nfaces);
  std::vector<double> area(nmembranes, 0.0);
  for (int f = 0; f < nfaces; ++f) {
    bending[f] = shapes[f].bending;
    area[membrane_of[f]] += shapes[f].middle;
  }
  exchange->set_bending(std::move(bending));
  const auto random = [this](int stream) { return CounterRandom(seed, STREAMS * visits + stream); };
  const int64_t before[] = {exchange->attempted(), exchange->accepted()};
  double change = exchange->interaction_energy();    // which no total energy has

  if (diffusion > 0.0) {
    std::vector<std::array<double, 3>> cotangents(nfaces);
    for (int f = 0; f < nfaces; ++f) cotangents[f] = shapes[f].cotangents;
    const std::vector<double> conductances = Membrane_NS::edge_conductances(mesh->topology(), cotangents);
    for (int l = 0; l < 2; ++l) {
      std::vector<double> density(nmembranes, 0.0), weights(conductances.size());
      for (int f = 0; f < nfaces; ++f) density[membrane_of[f]] += lipids.size(l, f);
      for (int m = 0; m < nmembranes; ++m) density[m] /= area[m];
      for (size_t e = 0; e < weights.size(); ++e)
        weights[e] = diffusion * density[membrane_of[exchange->edges()[e].face[0]]] * conductances[e] * time;
      const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
      change += exchange->swap_neighbors(l, attempts(sum, NEIGHBORS + l), weights, kT, random(NEIGHBORS + l));
    }
  }
  if (anywhere > 0.0)
    for (int l = 0; l < 2; ++l)
      change += exchange->swap_anywhere(l, attempts(anywhere * lipids.size(l), ANYWHERE + l), kT, random(ANYWHERE + l));
  if (flips > 0.0) {
    std::vector<double> weights(nfaces, 0.0);
    for (int f = 0; f < nfaces; ++f)
      if (const double n = lipids.size(0, f), m = lipids.size(1, f); n * m > 0.0)
        weights[f] = flips * time * 2.0 * n * m / (n + m);
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    change += exchange->swap_leaflets(attempts(sum, LEAFLETS), weights, kT, random(LEAFLETS));
  }

  energy += change - exchange->interaction_energy();
  attempted += exchange->attempted() - before[0];
  accepted += exchange->accepted() - before[1];
  ++visits;
  publish();
}

void FixHDLipids::publish()
{
  MeshLipids &lipids = mesh->lipids();
  for (int f = 0; f < exchange->lipids().num_faces(); ++f)
    if (takes_part[membrane_of[f]]) {
      lipids.outer[f] = exchange->curvature(0, f);
      lipids.inner[f] = exchange->curvature(1, f);
    }
  ++lipids.stamp;
}

// === Output

double FixHDLipids::compute_scalar()
{
  return -energy;
}

double FixHDLipids::compute_vector(int which)
{
  if (which == 0) return static_cast<double>(attempted);
  if (which == 1) return attempted > 0 ? static_cast<double>(accepted) / attempted : 0.0;
  if (which == 3) return exchange ? exchange->interaction_energy() : 0.0;
  return static_cast<double>(visits);
}

void *FixHDLipids::extract(const char *name, int &dim)
{
  dim = 0;
  return strcmp(name, "places") == 0 ? &places : nullptr;
}

double FixHDLipids::memory_usage()
{
  double bytes = sizeof(FaceShape) * (double) shapes.capacity();
  if (exchange) bytes += 2.0 * exchange->lipids().memory_usage();
  return bytes + rules->memory_usage();
}
