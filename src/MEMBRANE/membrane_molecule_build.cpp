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

#include "membrane_molecule_build.h"

#include "membrane_lipid_numbers.h"
#include "membrane_molecule_rings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>

using namespace Membrane_NS;
using Eigen::Vector3d;

static constexpr double LEAST_STRETCH = 0.1;    // of lengths at the heads: below, lipids have no room
static constexpr int FIRST_STEPS = 100, STEPS = 50, LAST_STEPS = 150, ROUNDS = 4, TRIALS = 200;
static constexpr int BENDS = 12, ENOUGH_BENDS = 3, BEND_TRIALS = 1000;    // enough if nothing clashes
static constexpr double HURTS = 0.04;           // energy of a lipid that Monte Carlo is for
static constexpr double TEMPERATURE = 0.005, SLIDE = 1.5;
static constexpr size_t MOST_NAMED = 5;
static constexpr int KINDS = 3000000;               // purpose of random numbers, and one more
static constexpr int BENDING = 4000000;             // and as many more as there are rounds

namespace {

template <class... Args> std::string text(const char *format, Args... args)
{
  char line[512];
  std::snprintf(line, sizeof(line), format, args...);
  return line;
}

void check_curvature(const ParallelSurfaces &part, const LeafletPatches &patches)
{
  for (int leaflet = 0; leaflet < LEAFLETS; ++leaflet) {
    const bool neutral = patches[leaflet]->neutral[leaflet] > patches[leaflet]->head[leaflet];
    const double height = sign_of(leaflet) * (neutral ? patches[leaflet]->neutral : patches[leaflet]->head)[leaflet];
    const auto narrowest = part.narrowest(height);
    if (narrowest.stretch > LEAST_STRETCH) continue;
    const Vector3d &at = narrowest.place;
    throw MoleculeError(text("the membrane is curved with a radius of %.4g Angstrom near %.4g %.4g %.4g, and the %s of the "
                             "%s leaflet are %.4g from its middle: take a smoother surface, or a %s",
                             1.0 / std::fabs(narrowest.curvature), at[0], at[1], at[2], neutral ? "neutral surfaces" : "heads",
                             leaflet == OUTER ? "outer" : "inner", std::fabs(height),
                             neutral ? "smaller height for neutral" : "thinner patch"));
  }
}

LipidNumbers numbers_of(const LipidCrowd &crowd)
{
  LipidNumbers numbers(crowd.parts().size());
  for (auto &part : numbers)
    for (auto &leaflet : part) leaflet.assign(crowd.library().species.size(), 0);
  for (size_t i = 0; i < crowd.lipids.size(); ++i)
    ++numbers[crowd.lipids[i].part][crowd.lipids[i].leaflet][crowd.conformer_of(static_cast<int>(i)).species];
  return numbers;
}

/* ----------------------------------------------------------------------
   Proteins: their atoms are of kinds of their own library entries
------------------------------------------------------------------------- */

FixedAtoms fix_proteins(const std::vector<PlacedProtein> &proteins, PatchLipids &library)
{
  FixedAtoms fixed;
  for (const PlacedProtein &protein : proteins)
    for (size_t i = 0; i < protein.molecule->atoms.size(); ++i) {
      fixed.x.push_back(protein.origin + protein.frame * protein.molecule->x[i]);
      fixed.kinds.push_back(library.contacts.kind(protein.molecule->atoms[i]));
    }
  return fixed;
}

// === The result

void add_lipids(const LipidCrowd &crowd, const std::vector<MembranePart> &membranes, Structure &structure)
{
  std::vector<int> order(crowd.lipids.size());
  std::iota(order.begin(), order.end(), 0);
  std::map<long long, int> number;    // of membranes, in the order of the parts
  for (const MembranePart &part : membranes) number.try_emplace(part.membrane, static_cast<int>(number.size()));
  auto key = [&](int i) {
    const PlacedLipid &lipid = crowd.lipids[i];
    return std::array<int, 3>{number.at(membranes[lipid.part].membrane), lipid.leaflet, crowd.conformer_of(i).species};
  };
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return key(i) < key(j); });
  const BeadGrid box = crowd.grid();
  std::array<int, 3> last = {-1, -1, -1};
  for (int i : order) {
    const auto now = key(i);
    const PlacedLipid &lipid = crowd.lipids[i];
    if (now[0] != last[0] || now[1] != last[1])
      structure.groups.push_back({now[1] == OUTER ? "outer leaflet" : "inner leaflet", membranes[lipid.part].membrane});
    last = now;
    structure.molecules.push_back({crowd.conformer_of(i).species, static_cast<int>(structure.groups.size()) - 1,
                                   static_cast<int>(structure.x.size())});
    const Vector3d shift = box.fold(lipid.x - structure.origin) + structure.origin - lipid.x;
    for (size_t k = 0; k < crowd.conformer_of(i).x.size(); ++k)
      structure.x.push_back(crowd.atom(lipid, static_cast<int>(k)) + shift);
  }
}

void add_proteins(const std::vector<PlacedProtein> &proteins, const FixedAtoms &fixed, Structure &structure)
{
  std::map<const MoleculeFile *, int> known;
  size_t atom = 0;
  for (const PlacedProtein &protein : proteins) {
    const MoleculeFile &file = *protein.molecule;
    const auto [entry, is_new] = known.try_emplace(&file, static_cast<int>(structure.species.size()));
    if (is_new) {
      LipidSpecies species;
      const size_t slash = file.path.find_last_of('/');
      species.name = file.path.substr(slash == std::string::npos ? 0 : slash + 1);
      species.name = species.name.substr(0, species.name.find('.'));
      species.atoms = file.atoms;
      species.terms = file.terms;
      structure.species.push_back(species);
    }
    structure.groups.push_back({"protein", 0});
    structure.molecules.push_back(
        {entry->second, static_cast<int>(structure.groups.size()) - 1, static_cast<int>(structure.x.size())});
    for (size_t k = 0; k < file.atoms.size(); ++k) structure.x.push_back(fixed.x[atom++]);
  }
}

void name_clashes(const LipidCrowd &crowd, const LipidCrowd::Report &state, const Vector3d &origin, BuildReport &report)
{
  for (int i : state.which) {
    if (report.clashing.size() == MOST_NAMED) return;
    const Vector3d x = crowd.grid().fold(crowd.lipids[i].x - origin) + origin;
    report.clashing.push_back(text("%s near %.1f %.1f %.1f", crowd.species_of(i).name.c_str(), x[0], x[1], x[2]));
  }
}

void relax(LipidCrowd &crowd, const Vector3d &origin, BuildReport &report)
{
  LipidCrowd::Report state = crowd.report();
  report.clashes_before = state.lipids;
  const int total = static_cast<int>(crowd.lipids.size());
  auto say = [&](const std::string &what, double energy) {
    crowd.team().say(text("  %s: overlap %.4g, %d of %d lipids in a clash, closest pair %.2f Angstrom", what.c_str(),
                          energy, state.lipids, total, state.closest));
  };
  double energy = crowd.relax(FIRST_STEPS);
  for (int round = 1; round <= ROUNDS; ++round) {
    for (int sweep = 0; sweep < 2; ++sweep)
      crowd.shuffle(HURTS, TRIALS, sweep == 0 ? TEMPERATURE : 0.0, SLIDE, 2 * round + sweep);
    if (round == ROUNDS) {
      report.freed = static_cast<int>(find_pierced_rings(crowd).size());
      free_rings(crowd);
    }
    energy = crowd.relax(round < ROUNDS ? STEPS : LAST_STEPS);
    state = crowd.report();
    say(text("relaxation %d of %d", round, ROUNDS), energy);
  }

  // what rigid lipids cannot do

  for (int round = 1; round <= BENDS && (round <= ENOUGH_BENDS || state.lipids > 0); ++round) {
    const int bent = crowd.bend(HURTS, BEND_TRIALS, round < BENDS ? TEMPERATURE : 0.0, BENDING + round);
    if (!bent) break;
    energy = crowd.relax(STEPS);
    state = crowd.report();
    say(text("bending %d of %d, %d lipids", round, BENDS, bent), energy);
  }

  // what relaxation may have put through a ring, and a last word

  report.pierced = static_cast<int>(free_rings(crowd).size());
  report.freed -= report.pierced;
  state = crowd.report();
  report.clashes = state.lipids;
  report.closest = state.closest;
  name_clashes(crowd, state, origin, report);
}

}    // namespace

/* ---------------------------------------------------------------------- */

LipidNumbers Membrane_NS::numbers_from_patch(const std::vector<ParallelSurfaces> &parts, const LeafletPatches &patches,
                                             const PatchLipids &library)
{
  LipidNumbers numbers(parts.size());
  for (size_t p = 0; p < parts.size(); ++p)
    for (int leaflet = 0; leaflet < LEAFLETS; ++leaflet) {
      const Patch &patch = *patches[leaflet];
      const double all = patch.conformers[leaflet].size();
      const double wanted = std::round(parts[p].area(sign_of(leaflet) * patch.neutral[leaflet]) / patch.area_per_lipid(leaflet));
      std::vector<double> share(library.species.size(), 0.0);
      for (int conformer : patch.conformers[leaflet]) share[library.conformers[conformer].species] += wanted / all;
      std::vector<int> &number = numbers[p][leaflet];
      int left = static_cast<int>(wanted);
      std::vector<std::pair<double, int>> remainder;
      for (size_t s = 0; s < share.size(); ++s) {
        const double whole = std::floor(share[s] + 1.0e-9);
        number.push_back(static_cast<int>(whole));
        left -= number.back();
        remainder.emplace_back(whole - share[s], static_cast<int>(s));
      }
      std::sort(remainder.begin(), remainder.end());
      for (int k = 0; k < left; ++k) ++number[remainder[k].second];
    }
  return numbers;
}

LipidNumbers Membrane_NS::numbers_from_faces(const std::vector<ParallelSurfaces> &parts,
                                             const std::vector<MembranePart> &membranes, const LeafletPatches &patches,
                                             const FaceComposition &composition)
{
  LipidNumbers numbers(parts.size());
  for (size_t p = 0; p < parts.size(); ++p)
    for (int leaflet = 0; leaflet < LEAFLETS; ++leaflet) {
      const std::vector<double> sum = composition.sum(membranes[p], leaflet);
      const double area = parts[p].area(sign_of(leaflet) * patches[leaflet]->neutral[leaflet]);
      numbers[p][leaflet] = largest_remainders(sum, static_cast<int>(std::lround(area / composition.area_per_lipid(sum))));
    }
  return numbers;
}

Structure Membrane_NS::build_structure(const LimitSurface &surface, const Vector3d &origin,
                                       const std::vector<MembranePart> &membranes, const LeafletPatches &patches,
                                       PatchLipids &library, const std::vector<PlacedProtein> &proteins,
                                       const FaceComposition *composition, uint64_t seed, Team &team, BuildReport &report)
{
  Structure structure;
  structure.lattice = surface.lattice();
  structure.periodic = surface.periodic();
  structure.origin = origin;

  std::vector<ParallelSurfaces> parts;
  for (const MembranePart &membrane : membranes) {
    parts.emplace_back(surface, membrane.faces);
    check_curvature(parts.back(), patches);
    report.areas.push_back({parts.back().area(patches[OUTER]->neutral[OUTER]),
                            parts.back().area(-patches[INNER]->neutral[INNER])});
    std::array<double, LEAFLETS> asked;
    for (int leaflet = 0; leaflet < LEAFLETS; ++leaflet)
      asked[leaflet] = report.areas.back()[leaflet] /
          (composition ? composition->area_per_lipid(composition->sum(membrane, leaflet)) : patches[leaflet]->area_per_lipid(leaflet));
    report.asked.push_back(asked);
  }
  const FixedAtoms fixed = fix_proteins(proteins, library);
  library.contacts.settle(library.clash);
  const std::array<double, LEAFLETS> neutral = {patches[OUTER]->neutral[OUTER], patches[INNER]->neutral[INNER]};
  LipidCrowd crowd(library, parts, neutral, fixed, seed, team);
  report.exact = proteins.empty() && !composition;
  for (size_t p = 0; p < parts.size(); ++p) {
    bool exact;
    const auto sites = lay_out(parts[p], patches, CounterRandom(seed, 1000000 + p), team, exact);
    report.exact &= exact;
    for (const LipidSite &site : sites)
      crowd.lipids.push_back(crowd.stand({site.point, site.x, site.normal}, site.along, site.conformer, site.leaflet,
                                         static_cast<int>(p)));
  }
  team.say(text("  %d lipids laid out", static_cast<int>(crowd.lipids.size())));

  // kinds by face before proteins make room, which have to displace the lipids that are there, and once more for those
  // that numbers added

  report.numbers = composition ? numbers_from_faces(parts, membranes, patches, *composition)
                               : numbers_from_patch(parts, patches, library);
  if (!report.exact) {
    if (composition) follow_faces(crowd, membranes, *composition, report.numbers, KINDS);
    const auto displaced = fit_numbers(crowd, report.numbers);
    if (composition) follow_faces(crowd, membranes, *composition, numbers_of(crowd), KINDS + 1);
    report.displaced = displaced[OUTER] + displaced[INNER];
    relax(crowd, origin, report);
  } else {
    const auto state = crowd.report();
    report.clashes = report.clashes_before = state.lipids;
    report.closest = state.closest;
    report.pierced = static_cast<int>(find_pierced_rings(crowd).size());
  }

  // numbers as they are

  report.numbers = numbers_of(crowd);

  structure.species = library.species;
  add_proteins(proteins, fixed, structure);
  add_lipids(crowd, membranes, structure);
  return structure;
}

double Structure::charge() const
{
  double sum = 0.0;
  for (const Molecule &molecule : molecules)
    for (const MoleculeAtom &atom : species_of(molecule).atoms) sum += atom.charge;
  return sum;
}
