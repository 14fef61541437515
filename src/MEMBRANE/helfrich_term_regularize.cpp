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

#include "helfrich_term.h"

#include "atom.h"
#include "error.h"
#include "fix.h"
#include "membrane_regularization.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using Membrane_NS::FaceGroup;
using Membrane_NS::FaceModel;

// a face whose D/A is beyond this is about to turn over
static constexpr double WORST_FACE = 50.0;

namespace {

struct Coefficients {
  double modulus = 0.0;
  bool given = false;    // else the default of the fixes holds
  bool conformal = false;

  bool active() const { return modulus != 0.0; }
  void archive(RestartArchive &file)
  {
    file(modulus);
    file(given);
    file(conformal);
  }
};

/** Keeps faces of the control mesh in shape, see regularize_faces() and conformal_faces(). Fixes that shake
    control points may ask for a modulus where pair_coeff has none, by Fix::extract("default_regularize"). */
class RegularizeTerm : public TermWith<Coefficients> {
 public:
  explicit RegularizeTerm(LAMMPS *lmp) :
      TermWith(lmp, "regularize", HelfrichOutput::REGULARIZATION)
  {
  }

  bool acts_on(int type) const override { return modulus_of(type) != 0.0; }
  void choose(const HelfrichScene &) override;
  Needs needs() const override
  {
    Needs result;
    result.places = !dipoles.empty();
    return result;
  }
  void localize(const std::vector<FaceGroup> &, FaceModel &) override;
  void add_forces(HelfrichScene &, const double (*)[3], double (*)[3]) override;
  void tally(const HelfrichScene &, HelfrichTally &) const override;
  void add_stiffness(const HelfrichScene &, HelfrichStiffness &stiffness) override
  {
    for (size_t slot = 0; slot < modulus.size(); ++slot)
      stiffness.shear[slot] += modulus[slot] + conformal[slot];
  }

 protected:
  int read(const HelfrichWords &words, Coefficients &c) const override
  {
    c.modulus = words.modulus(1);
    c.given = true;
    c.conformal = words.is(2, "conformal");
    return c.conformal ? 3 : 2;
  }

 private:
  double unless_given = 0.0;
  bool any_conformal = false, across_known = false;
  std::vector<double> modulus, conformal, energy;    // by slot; energies only if anyone wants them
  std::vector<int> across;                           // by slot and edge, see conformal_faces()

  double modulus_of(int type) const
  {
    return by_type[type].given ? by_type[type].modulus : unless_given;
  }
  bool is_conformal(int type) const { return by_type[type].conformal && by_type[type].active(); }

  // of conformal: families of parallel edges, see edge_families(), with a number by component, or -1

  std::vector<int> families, number;
  bool any_families = false;
  std::vector<int> family;                      // by slot and edge: 3 number + 0, 1 or 2, or -1
  std::vector<double> logs, my_sums, sums;

  // of conformal: components that are spheres by topology have a number, others -1

  std::vector<int> sphere, sphere_of;    // by component, and by slot
  std::vector<Membrane_NS::PointDipole> dipoles;

  void find_across(const HelfrichScene &, const double (*)[3]);
  void find_spheres(const HelfrichScene &);
  void measure_dipoles(const HelfrichScene &, const double (*)[3]);
  void measure_cross_ratios(const HelfrichScene &, const double (*)[3]);
};

/* ---------------------------------------------------------------------- */

void RegularizeTerm::choose(const HelfrichScene &scene)
{
  families = Membrane_NS::edge_families(scene.mesh->topology());
  number.assign(scene.mesh->topology().num_components(), -1);
  int count = 0;
  for (size_t f = 0; f < families.size(); ++f) {
    int &mine = number[scene.mesh->topology().component(scene.mesh->topology().face(static_cast<int>(f))[0])];
    if (families[f] >= 0 && mine < 0) mine = count++;
  }
  sums.assign(6 * static_cast<size_t>(count), 0.0);
  find_spheres(scene);

  unless_given = 0.0;
  for (auto &fix : modify->get_fix_list()) {
    int dim;
    if (const void *wanted = fix->extract("default_regularize", dim))
      unless_given = MAX(unless_given, *static_cast<const double *>(wanted));
  }
}

void RegularizeTerm::find_spheres(const HelfrichScene &scene)
{
  const auto &topology = scene.mesh->topology();
  sphere.assign(topology.num_components(), 0);
  for (int f = 0; f < topology.num_faces(); ++f) ++sphere[topology.component(topology.face(f)[0])];
  int count = 0;
  for (int c = 0; c < topology.num_components(); ++c) {
    const bool round = 2 * topology.num_vertices(c) - sphere[c] == 4;    // twice Euler's characteristic
    const auto &types = scene.types[scene.mesh->membrane(c)];
    const bool here = std::any_of(types.begin(), types.end(), [this](int type) { return is_conformal(type); });
    sphere[c] = round && here ? count++ : -1;
  }
  dipoles.resize(count);
}

void RegularizeTerm::localize(const std::vector<FaceGroup> &groups, FaceModel &)
{
  modulus.assign(count_slots(groups), 0.0);
  conformal.assign(modulus.size(), 0.0);
  const auto of_kind = [this](bool kind) {
    return [this, kind](int type) { return by_type[type].conformal == kind ? modulus_of(type) : 0.0; };
  };
  add_corner_means(groups, atom->type, modulus, of_kind(false));
  add_corner_means(groups, atom->type, conformal, of_kind(true));
  any_conformal = std::any_of(conformal.begin(), conformal.end(), [](double k) { return k != 0.0; });
  any_families = !sums.empty() &&
      std::any_of(by_type.begin(), by_type.end(), [](const Coefficients &c) { return c.conformal && c.active(); });
  across_known = false;
}

/* ----------------------------------------------------------------------
   among the points that shape a face; in a small box these may have several images of a vertex
------------------------------------------------------------------------- */

void RegularizeTerm::find_across(const HelfrichScene &scene, const double (*x)[3])
{
  across_known = true;
  const auto &topology = scene.mesh->topology();
  across.assign(3 * conformal.size(), 0);
  family.assign(across.size(), -1);
  logs.assign(across.size(), 0.0);
  sphere_of.assign(conformal.size(), -1);
  for (const FaceGroup &group : scene.groups)
    for (int s = 0; s < group.nfaces; ++s) {
      const int f = group.face[s];
      const Membrane_NS::Face &face = topology.face(f);
      sphere_of[group.first_slot + s] = sphere[topology.component(face[0])];
      for (int k = 0; k < 3; ++k) {
        const int here = group.point(s, k), v = scene.mesh->vertex(atom->tag[here]);
        const int corner = static_cast<int>(std::find(face.begin(), face.end(), v) - face.begin());
        const tagint wanted = scene.mesh->tag(topology.opposite(f, corner));
        if (families[f] >= 0)
          family[3 * static_cast<size_t>(group.first_slot + s) + k] =
              3 * number[topology.component(v)] + (families[f] + corner) % 3;
        double nearest = INFINITY;
        for (int i = 0; i < group.rule->size; ++i) {
          const int j = group.point(s, i);
          if (atom->tag[j] != wanted) continue;
          double square = 0.0;
          for (int m = 0; m < 3; ++m) square += (x[j][m] - x[here][m]) * (x[j][m] - x[here][m]);
          if (!(square < nearest)) continue;
          nearest = square;
          across[3 * static_cast<size_t>(group.first_slot + s) + k] = j;
        }
      }
    }
}

/* ----------------------------------------------------------------------
   a fluid sheet does not resist a uniform shear of its mesh, which undulations do to one in a box of fixed
   shape: the cross ratio at rest of a family of parallel edges is their mean. Where energy is least by it,
   forces do not notice that it changes
------------------------------------------------------------------------- */

void RegularizeTerm::measure_cross_ratios(const HelfrichScene &scene, const double (*x)[3])
{
  for (const FaceGroup &group : scene.groups)
    Membrane_NS::cross_ratios(group, x, conformal, across, logs);
  if (!any_families) return;

  my_sums.assign(sums.size(), 0.0);
  const auto visit = [&](auto &&act) {
    for (const FaceGroup &group : scene.groups)
      for (size_t e = 3 * static_cast<size_t>(group.first_slot), end = e + 3 * group.nfaces; e < end; ++e)
        if (family[e] >= 0) act(e, conformal[e / 3]);
  };
  visit([&](size_t e, double weight) {
    my_sums[2 * family[e]] += weight;
    my_sums[2 * family[e] + 1] += weight * logs[e];
  });
  MPI_Allreduce(my_sums.data(), sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, world);
  visit([&](size_t e, double weight) {
    if (weight > 0.0) logs[e] -= sums[2 * family[e] + 1] / sums[2 * family[e]];
  });
}

/* ---------------------------------------------------------------------- */

void RegularizeTerm::measure_dipoles(const HelfrichScene &scene, const double (*x)[3])
{
  std::vector<Membrane_NS::PointDipole> mine(dipoles.size());
  for (const FaceGroup &group : scene.groups)
    Membrane_NS::add_dipoles(group, x, scene.model.origin, conformal, sphere_of, mine);
  static_assert(sizeof(Membrane_NS::PointDipole) == 9 * sizeof(double), "sums are added up as an array");
  MPI_Allreduce(mine.data(), dipoles.data(), static_cast<int>(9 * mine.size()), MPI_DOUBLE, MPI_SUM, world);
}

/* ----------------------------------------------------------------------
   stops before a face collapses
------------------------------------------------------------------------- */

void RegularizeTerm::add_forces(HelfrichScene &scene, const double (*x)[3], double (*f)[3])
{
  if ((any_conformal || any_families || !dipoles.empty()) && !across_known) find_across(scene, x);
  if (any_conformal || any_families) measure_cross_ratios(scene, x);
  if (!dipoles.empty()) measure_dipoles(scene, x);
  energy.assign(scene.energies.area.size(), 0.0);
  auto &virial = scene.energies.virial;
  for (const FaceGroup &group : scene.groups) {
    double worst = Membrane_NS::regularize_faces(group, x, modulus, f, energy, virial);
    if (any_conformal)
      worst = std::max(worst, Membrane_NS::conformal_faces(group, x, conformal, across, logs, f, energy, virial));
    if (!dipoles.empty())
      Membrane_NS::hold_dipoles(group, x, scene.model.origin, sphere_of, dipoles, f, energy, virial);
    if (worst < WORST_FACE || (update->whichflag == 2 && std::isfinite(worst))) continue;
    for (int s = 0; s < group.nfaces; ++s)
      if (!(Membrane_NS::face_distortion(x[group.point(s, 0)], x[group.point(s, 1)],
                                         x[group.point(s, 2)]) < WORST_FACE))
        error->one(FLERR,
                   "Membrane mesh: {} is about to collapse; use a larger regularize modulus in "
                   "pair_coeff or a smaller timestep",
                   scene.mesh->face_name(group.face[s]));
  }
}

void RegularizeTerm::tally(const HelfrichScene &scene, HelfrichTally &tally) const
{
  for (const FaceGroup &group : scene.groups)
    for (int s = 0; s < group.nfaces; ++s)
      tally.add(group.first_slot + s, output, energy[group.first_slot + s]);
}

}    // namespace

/* ---------------------------------------------------------------------- */

std::unique_ptr<HelfrichTerm> LAMMPS_NS::make_regularize_term(LAMMPS *lmp)
{
  return std::make_unique<RegularizeTerm>(lmp);
}
