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

#include "hd_mass.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "group.h"
#include "hd_mode_space.h"
#include "helfrich_measure.h"
#include "helfrich_model.h"
#include "membrane_mass_kinds.h"
#include "modify.h"
#include "pair.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using Membrane_NS::MassKind;
using Membrane_NS::MassOperator;
using Membrane_NS::VertexField;

// mass sampling: the reference is renewed when normals have turned by 40 degrees or so: at kc = 20 kT
// those of a membrane in equilibrium turn by 12
static constexpr double MOST_DISTANCE = 0.25;

// or when the kT of the measure, which is a tension in it, is another by such a factor
static constexpr double MOST_HEAT = 2.0;

/* ---------------------------------------------------------------------- */

HDMass::HDMass(LAMMPS *lmp, int igroup, std::string user) :
    Pointers(lmp), groupbit(group->bitmask[igroup]), user(std::move(user)),
    points(lmp, igroup, this->user), drag(0.0), reported(false), numberings(0), renewals(-1)
{
}

int HDMass::parse(int iarg, int narg, char **arg, bool integrates)
{
  const std::string key = arg[iarg];
  if (integrates)
    if (const int used = HDModeSpace(lmp, user).parse(iarg, narg, arg, settings)) return used;
  if (key != "mass" && key != "solver" && key != "tol") return 0;
  if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, user + " " + key, error);
  const std::string value = arg[iarg + 1];
  if (key == "mass") {
    if (!Membrane_NS::find_mass_kind(value, settings.kind))
      error->all(FLERR, "{} mass {} is not vertex, consistent, lumped or sampling", user, value);
    settings.reference.reset();
    if (settings.kind == MassKind::SAMPLING)
      settings.reference = std::make_shared<Membrane_NS::SharedReference>();
  } else if (key == "solver") {
    if (value != "direct" && value != "iterative")
      error->all(FLERR, "{} solver {} is not iterative or direct", user, value);
    settings.direct = value == "direct";
    settings.quickest = false;
  } else {
    settings.tolerance = utils::numeric(FLERR, value, false, lmp);
    if (!(settings.tolerance >= 1.0e-14 && settings.tolerance <= 1.0e-2))
      error->all(FLERR, "{} tol {} must be between 1e-14 and 1e-2", user, value);
  }
  return 2;
}

/* ---------------------------------------------------------------------- */

void HDMass::init(bool other_atoms)
{
  if (settings.direct && (settings.kind == MassKind::LUMPED || settings.kind == MassKind::SAMPLING))
    error->all(FLERR, "{} solver direct: mass {} needs no solver", user,
               Membrane_NS::mass_kind_name(settings.kind));
  HDModeSpace(lmp, user).check(settings);
  points.init(other_atoms);
  gram.resize(0, 0);
  if (drag == 0.0) check_masses();
  reported = false;
}

void HDMass::check_masses()
{
  tagint mine = 0, bad;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit) || mesh().vertex(atom->tag[i]) < 0) continue;
    if (!(atom->rmass[i] > 0.0) || !std::isfinite(atom->rmass[i])) mine = MAX(mine, atom->tag[i]);
  }
  MPI_Allreduce(&mine, &bad, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  if (bad)
    error->all(FLERR, "{}: control point {} has no positive mass: use set ... mass", user, bad);
}

/* ---------------------------------------------------------------------- */

void HDMass::refresh()
{
  const bool renumbered = points.follow(Membrane_NS::mass_halo_rings(settings.kind));
  auto *reference = settings.reference.get();
  if (reference) {
    const auto &topology = mesh().topology();
    const bool same = reference->now && reference->now->shape.faces == topology.faces() &&
        reference->now->shape.points.size() == (size_t) topology.num_vertices();
    if (!same && reference->now && comm->me == 0)
      utils::logmesg(lmp, "{} mass sampling: control points have changed, the reference is taken anew\n", user);
    if (!same) take_reference();    // the first time, and after replicate, delete_atoms, reset_atoms
  }
  auto *modes = settings.modes.get();
  if (modes && (renumbered || !modes->now)) HDModeSpace(lmp, user).follow(mesh(), part(), *modes);
  const int64_t now = reference ? reference->renewals : modes ? modes->renewals : renewals;
  if (!renumbered && now == renewals) return;
  ++numberings;
  if (now != renewals) gram.resize(0, 0);
  renewals = now;
  settings.unit = (drag > 0.0 ? drag : 1.0) / force->mvv2e;    // of time is 1

  const int n = mesh().topology().num_vertices();
  std::vector<double> masses(n, 0.0);
  std::vector<uint64_t> labels(n);
  for (int i = 0; i < part().owned; ++i)
    masses[part().vertices[i]] = drag > 0.0 ? drag : atom->rmass[part().atom_of(i)];
  part().sum(masses.data(), n);
  for (int v = 0; v < n; ++v) labels[v] = mesh().tag(v);
  try {
    const Membrane_NS::VertexMasses vertices = {mesh().topology(), part(), masses, labels};
    auto chosen = settings;
    if (settings.quickest) chosen.direct = points.suit_factors();
    mass = Membrane_NS::make_mass(vertices, chosen);
    if (!modes) return;
    mass = std::make_unique<Membrane_NS::ModalMass>(vertices, std::move(mass), *modes, drag > 0.0, gram);
    gram = modal()->gram();
  } catch (const Membrane_NS::MeshError &err) {
    error->all(FLERR, "{}: {}", user, err.what());
  }
}

void HDMass::take_modes_anew()
{
  settings.modes->shape.points.clear();
  settings.modes->now.reset();
  refresh();
}

Membrane_NS::ModalMass *HDMass::modal() const
{
  return dynamic_cast<Membrane_NS::ModalMass *>(mass.get());
}

/* ----------------------------------------------------------------------
   mass sampling
------------------------------------------------------------------------- */

void HDMass::take_reference()
{
  Pair *pair = force->pair_match("helfrich", 1);
  int dim;
  auto *model = pair ? static_cast<HelfrichModel *>(pair->extract("model", dim)) : nullptr;
  if (!model) error->all(FLERR, "{} mass sampling is made of what pair_style helfrich resists: use it", user);
  Membrane_NS::StiffnessReference reference = model->describe();
  reference.measure = measured_kT();
  settings.reference->now = std::make_shared<const Membrane_NS::StiffnessReference>(std::move(reference));
  ++settings.reference->renewals;
}

// of the fixes that sample control points of the group with the measure of their mesh; collective

double HDMass::measured_kT()
{
  double kT = 0.0;
  for (auto &fix : modify->get_fix_list()) {
    int dim;
    const auto *measure = static_cast<const HelfrichMeasure *>(fix->extract("measure", dim));
    if (measure && measure->on && groups_meet(lmp, groupbit, measure->groupbit)) kT = MAX(kT, measure->kT);
  }
  return kT;
}

bool HDMass::renew()
{
  if (!settings.reference) return false;
  refresh();
  Membrane_NS::TriangleMesh shape = mesh().triangle_mesh();
  VertexField mine(part().size()), all(shape.points.size(), Membrane_NS::Vector4{});
  for (int i = 0; i < part().owned; ++i) {
    const int j = part().atom_of(i);
    domain->unmap(atom->x[j], atom->image[j], mine[i].c);
    mine[i].c[3] = 1.0;
  }
  part().gather(mine, all);
  const auto &reference = *settings.reference->now;
  for (size_t v = 0; v < all.size(); ++v)
    shape.points[v] = all[v].c[3] > 0.0 ? Eigen::Vector3d(all[v].c) : reference.shape.points[v];
  const double distance = reference.distance(shape, mesh().topology()), kT = measured_kT();
  std::string reason;
  if (distance > MOST_DISTANCE)
    reason = fmt::format("the shape has left the reference (1 - cos of normals: {:.2g}), which is taken anew: what came "
                         "before is equilibration, not sampling", distance);
  else if (kT > MOST_HEAT * reference.measure || reference.measure > MOST_HEAT * kT)
    reason = "the temperature has left that of the reference, which is taken anew";
  else
    return false;
  if (comm->me == 0)
    utils::logmesg(lmp, "{} mass sampling: at step {} {}\n", user, update->ntimestep, reason);
  take_reference();
  refresh();
  return true;
}

static void archive_points(RestartArchive &file, std::vector<Eigen::Vector3d> &points)
{
  std::vector<double> numbers;
  for (const auto &p : points) numbers.insert(numbers.end(), p.data(), p.data() + 3);
  file(numbers);
  if (!file.is_reading()) return;
  points.clear();
  for (size_t i = 0; i + 2 < numbers.size(); i += 3) points.emplace_back(&numbers[i]);
}

void HDMass::archive(RestartArchive &file)
{
  archive_reference(file);
  char modal = settings.modes && !settings.modes->shape.points.empty();
  file(modal);
  Membrane_NS::SharedModes none;
  if (modal) HDModeSpace::archive(file, settings.modes ? *settings.modes : none);
}

void HDMass::archive_reference(RestartArchive &file)
{
  char known = settings.reference && settings.reference->now;
  file(known);
  if (!known) return;
  Membrane_NS::StiffnessReference reference;
  if (!file.is_reading()) reference = *settings.reference->now;
  archive_points(file, reference.shape.points);
  std::vector<int> corners;
  for (const auto &face : reference.shape.faces) corners.insert(corners.end(), face.begin(), face.end());
  file(corners);
  if (file.is_reading())
    for (size_t i = 0; i + 2 < corners.size(); i += 3)
      reference.shape.faces.push_back({corners[i], corners[i + 1], corners[i + 2]});
  for (auto *numbers : {&reference.kc, &reference.tension, &reference.shear, &reference.stretch})
    file(*numbers);
  file(reference.closed);
  file(reference.measure);
  auto count = static_cast<int>(reference.totals.size());
  file(count);
  if (file.is_reading()) reference.totals.resize(file.ok() ? count : 0);
  for (auto &total : reference.totals) {
    file(total.stiffness);
    archive_points(file, total.gradient);
  }
  std::vector<double> box(reference.shape.lattice.data(), reference.shape.lattice.data() + 9);
  file(box);
  for (bool &along : reference.shape.periodic) file(along);
  if (!file.is_reading() || !file.ok() || !settings.reference) return;
  std::copy_n(box.begin(), 9, reference.shape.lattice.data());
  settings.reference->now =
      std::make_shared<const Membrane_NS::StiffnessReference>(std::move(reference));
  ++settings.reference->renewals;
}

/* ---------------------------------------------------------------------- */

void HDMass::report_missed_tolerance()
{
  if (reported || mass->missed_residual() == 0.0) return;
  reported = true;
  if (comm->me == 0)
    error->warning(FLERR,
                   "{}: mass {} was solved in {} passes to a residual of {:.2g} only, not {:.2g}: "
                   "use solver direct, a larger tol, or masses that differ less",
                   user, mass_kind_name(settings.kind), settings.most_passes,
                   mass->missed_residual(), settings.tolerance);
}

/* ---------------------------------------------------------------------- */

void HDMass::kinetic(double *t)
{
  refresh();
  VertexField v;
  part().load(atom->v, v);
  const auto sums = mass->kinetic(v);
  std::copy(sums.begin(), sums.end(), t);
}
