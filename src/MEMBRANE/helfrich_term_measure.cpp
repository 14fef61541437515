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
#include "helfrich_measure.h"
#include "membrane_measure.h"
#include "modify.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;
using Membrane_NS::FaceGroup;
using Membrane_NS::FaceModel;

// of kT, so that the measure of a face is what its share of the vertices' coordinates has
static constexpr double EXPONENT = 0.75;

// two fixes have the same temperature if they differ by less than this part of it
static constexpr double SAME = 1.0e-9;

namespace {

/** (3/4) kT sum ln A over the faces of membranes that fixes sample at a temperature, see
    doc/src/Derivation_measure.rst. It belongs to a temperature and so to fixes, which are asked for it
    by Fix::extract("measure"); in a minimization there is none. */
class MeasureTerm : public HelfrichTerm {
 public:
  explicit MeasureTerm(LAMMPS *lmp) : HelfrichTerm(lmp, "measure", HelfrichOutput::MEASURE) {}

  bool is_keyword() const override { return false; }
  bool is_in(const HelfrichScene &, int m) const override { return source[m] >= 0; }
  Needs needs() const override;
  void choose(const HelfrichScene &) override;
  void add_forces(HelfrichScene &, const double (*)[3], double (*)[3]) override;
  void tally(const HelfrichScene &, HelfrichTally &) const override;

 private:
  std::vector<HelfrichMeasure *> measures;
  std::vector<std::string> names;    // the IDs of their fixes
  std::vector<int> source;           // of a membrane: which of them, or -1
  struct Rivals {
    int one, other, membrane;
  };
  std::vector<Rivals> rivals;            // membranes of several; not yet compared
  std::vector<double> weight, energy;    // by slot; energies only if anyone wants them

  void compare(const HelfrichScene &);
};

HelfrichTerm::Needs MeasureTerm::needs() const
{
  Needs needs;
  needs.regularize = true;
  return needs;
}

/* ----------------------------------------------------------------------
   which fix samples which membrane: collective, and the same on all ranks
------------------------------------------------------------------------- */

void MeasureTerm::choose(const HelfrichScene &scene)
{
  const int n = static_cast<int>(scene.types.size());
  measures.clear();
  names.clear();
  rivals.clear();
  source.assign(n, -1);
  if (update->whichflag == 2) return;
  for (auto &fix : modify->get_fix_list()) {
    int dim;
    auto *measure = static_cast<HelfrichMeasure *>(fix->extract("measure", dim));
    if (!measure || !measure->on) continue;
    std::vector<int> mine(n, 0), any(n);
    for (int i = 0; i < atom->nlocal; ++i) {
      const int v = scene.mesh->vertex(atom->tag[i]);
      if (v >= 0 && atom->mask[i] & measure->groupbit)
        mine[scene.mesh->membrane(scene.mesh->topology().component(v))] = 1;
    }
    MPI_Allreduce(mine.data(), any.data(), n, MPI_INT, MPI_MAX, world);
    for (int m = 0; m < n; ++m) {
      if (!any[m]) continue;
      if (source[m] >= 0) rivals.push_back({source[m], static_cast<int>(measures.size()), m});
      if (source[m] < 0) source[m] = static_cast<int>(measures.size());
    }
    measures.push_back(measure);
    names.push_back(fix->id);
  }
}

// when all fixes know the temperature of this run

void MeasureTerm::compare(const HelfrichScene &scene)
{
  for (const auto &[one, other, m] : rivals)
    if (!(std::fabs(measures[one]->kT - measures[other]->kT) <= SAME * measures[one]->kT))
      error->all(FLERR,
                 "Fixes {} and {} sample membrane {} at different temperatures: give them the same, "
                 "or one of them measure no",
                 names[one], names[other], scene.mesh->molecules()[m]);
  rivals.clear();
}

/* ---------------------------------------------------------------------- */

void MeasureTerm::add_forces(HelfrichScene &scene, const double (*x)[3], double (*f)[3])
{
  compare(scene);
  bool tallies = !scene.energies.area.empty();
  for (HelfrichMeasure *measure : measures) tallies = tallies || measure->tally;
  weight.assign(scene.nslots(), 0.0);
  energy.assign(tallies ? scene.nslots() : 0, 0.0);
  for (HelfrichMeasure *measure : measures) measure->logs = 0.0;
  for (const FaceGroup &group : scene.groups) {
    for (int s = 0; s < group.nfaces; ++s) {
      const int from = source[scene.membrane(group, s)];
      if (from >= 0) weight[group.first_slot + s] = EXPONENT * measures[from]->kT;
    }
    measure_faces(group, x, weight, f, energy, scene.energies.virial);
    if (!tallies) continue;
    for (int s = 0; s < group.nfaces; ++s) {
      const int from = source[scene.membrane(group, s)];
      if (from >= 0 && measures[from]->kT > 0.0)
        measures[from]->logs += energy[group.first_slot + s] / measures[from]->kT;
    }
  }
}

void MeasureTerm::tally(const HelfrichScene &scene, HelfrichTally &tally) const
{
  for (const FaceGroup &group : scene.groups)
    for (int s = 0; s < group.nfaces; ++s)
      tally.add(group.first_slot + s, output, energy[group.first_slot + s]);
}

}    // namespace

std::unique_ptr<HelfrichTerm> LAMMPS_NS::make_measure_term(LAMMPS *lmp)
{
  return std::make_unique<MeasureTerm>(lmp);
}
