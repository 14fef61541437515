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

#include "membrane_molecule_patch.h"

#include "membrane_molecule_grid.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>
#include <set>

using namespace Membrane_NS;
using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

static constexpr double FARTHEST_CONTACT = 8.0;    // Angstrom: no pair of kinds is kept further apart
static constexpr double LONELY = 4.0;              // Angstrom: the closest distance where none was seen
static constexpr double RIGHT_ANGLE = 0.01;        // degrees that an angle may be off
static constexpr size_t SMALLEST_LIPID = 4;        // atoms: water and ions have fewer

namespace {

const std::set<std::string> SMALL = {"HOH", "WAT", "SOL",  "TIP3", "TIP4", "TIP5", "TIP", "TP3", "TP4", "TP5",
                                     "SPC", "SPCE", "W", "WF", "PW", "ION"};
const std::set<std::string> AMINO_ACIDS = {"ALA", "ARG", "ASN", "ASP", "CYS", "GLN", "GLU", "GLY", "HIS", "HSD", "HSE",
                                           "HSP", "HID", "HIE", "HIP", "ILE", "LEU", "LYS", "MET", "PHE", "PRO", "SER",
                                           "THR", "TRP", "TYR", "VAL", "CYX", "MSE"};

/// A molecule of the file.
struct Lipid {
  std::vector<int> atoms;
  std::vector<Vector3d> x;
  Vector3d centre;
  int species = -1;
};

[[noreturn]] void fail(const MoleculeFile &file, const std::string &problem)
{
  throw MoleculeError(file.path + ": " + problem);
}

Matrix3d cell_of(const MoleculeFile &file)
{
  if (!(file.lengths[0] > 0.0 && file.lengths[1] > 0.0 && file.lengths[2] > 0.0))
    fail(file, "there is no box, or it has no volume: a patch needs a CRYST1 line with its three lengths");
  if (std::fabs(file.angles[0] - 90.0) > RIGHT_ANGLE || std::fabs(file.angles[1] - 90.0) > RIGHT_ANGLE ||
      !(file.angles[2] > 10.0 && file.angles[2] < 170.0))
    fail(file, "the third side of the box must be at right angles to the patch: alpha and beta 90");
  const double gamma = file.angles[2] * M_PI / 180.0;
  Matrix3d cell = Matrix3d::Zero();
  cell(0, 0) = file.lengths[0];
  cell(0, 1) = file.lengths[1] * (std::fabs(file.angles[2] - 90.0) < 1.0e-9 ? 0.0 : std::cos(gamma));
  cell(1, 1) = file.lengths[1] * std::sin(gamma);
  cell(2, 2) = file.lengths[2];
  return cell;
}

// === Molecules

std::vector<Lipid> find_molecules(const MoleculeFile &file)
{
  const int n = static_cast<int>(file.atoms.size());
  std::vector<int> parent(n);
  std::iota(parent.begin(), parent.end(), 0);
  auto root = [&](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  auto join = [&](int i, int j) {
    i = root(i);
    j = root(j);
    parent[std::max(i, j)] = std::min(i, j);
  };
  for (int i = 1; i < n; ++i)
    if (file.atoms[i].residue_index == file.atoms[i - 1].residue_index) join(i, i - 1);
  const auto &bonds = file.terms[BOND];
  for (size_t b = 0; b < bonds.size(); b += 2) join(bonds[b], bonds[b + 1]);
  std::vector<int> which(n, -1);
  std::vector<Lipid> molecules;
  for (int i = 0; i < n; ++i) {
    int &number = which[root(i)];
    if (number < 0) {
      number = static_cast<int>(molecules.size());
      molecules.emplace_back();
    }
    molecules[number].atoms.push_back(i);
  }
  return molecules;
}

bool is_solvent(const MoleculeFile &file, const Lipid &lipid)
{
  return lipid.atoms.size() < SMALLEST_LIPID || SMALL.count(file.atoms[lipid.atoms[0]].residue);
}

// === Species

// Terms by the molecule of their first atom, so that each lipid finds its own

class TermsOfMolecules {
 public:
  TermsOfMolecules(const MoleculeFile &file, const std::vector<Lipid> &lipids) :
      file_(file), molecule_(file.atoms.size(), -1), local_(file.atoms.size(), -1)
  {
    for (size_t m = 0; m < lipids.size(); ++m)
      for (size_t k = 0; k < lipids[m].atoms.size(); ++k) {
        molecule_[lipids[m].atoms[k]] = static_cast<int>(m);
        local_[lipids[m].atoms[k]] = static_cast<int>(k);
      }
    for (int kind = 0; kind < TERM_KINDS; ++kind) {
      of_[kind].resize(lipids.size());
      const auto &terms = file.terms[kind];
      for (size_t t = 0; t < terms.size(); t += TERM_ATOMS[kind])
        if (molecule_[terms[t]] >= 0) of_[kind][molecule_[terms[t]]].push_back(static_cast<int>(t));
    }
  }
  std::vector<int> local(int molecule, int kind) const
  {
    std::vector<int> terms;
    for (int t : of_[kind][molecule])
      for (int k = 0; k < TERM_ATOMS[kind]; ++k) {
        const int atom = file_.terms[kind][t + k];
        if (molecule_[atom] != molecule) fail(file_, "a term of the force field joins two lipids");
        terms.push_back(local_[atom]);
      }
    return terms;
  }

 private:
  const MoleculeFile &file_;
  std::vector<int> molecule_, local_;
  std::array<std::vector<std::vector<int>>, TERM_KINDS> of_;
};

std::string name_of(const MoleculeFile &file, const Lipid &lipid, std::string &key)
{
  std::string name;
  int last = -1;
  for (int i : lipid.atoms) {
    const MoleculeAtom &atom = file.atoms[i];
    if (atom.residue_index != last) name += (name.empty() ? "" : "-") + atom.residue;
    key += (atom.residue_index != last ? "/" + atom.residue + "/" : " ") + atom.name;
    last = atom.residue_index;
  }
  return name;
}

void find_species(const MoleculeFile &file, const TermsOfMolecules &terms, std::vector<Lipid> &lipids,
                  PatchLipids &library)
{
  auto key_of = [](const LipidSpecies &species) {
    MoleculeFile as;
    as.atoms = species.atoms;
    Lipid all;
    all.atoms.resize(as.atoms.size());
    std::iota(all.atoms.begin(), all.atoms.end(), 0);
    std::string key;
    name_of(as, all, key);
    return key;
  };
  std::map<std::string, int> known;
  for (size_t s = 0; s < library.species.size(); ++s) known[key_of(library.species[s])] = static_cast<int>(s);
  for (size_t m = 0; m < lipids.size(); ++m) {
    Lipid &lipid = lipids[m];
    std::string key;
    const std::string name = name_of(file, lipid, key);
    const auto [entry, is_new] = known.try_emplace(key, static_cast<int>(library.species.size()));
    lipid.species = entry->second;
    if (!is_new) continue;
    LipidSpecies species;
    species.name = name;
    for (int i : lipid.atoms) {
      MoleculeAtom atom = file.atoms[i];
      atom.residue_index -= file.atoms[lipid.atoms[0]].residue_index;
      species.kinds.push_back(library.contacts.kind(atom));
      species.atoms.push_back(atom);
    }
    for (int kind = 0; kind < TERM_KINDS; ++kind) species.terms[kind] = terms.local(static_cast<int>(m), kind);
    species.rings = find_rings(static_cast<int>(lipid.atoms.size()), species.terms[BOND]);
    library.species.push_back(species);
    library.by_species.emplace_back();
  }
}

// === Leaflets

// Heights in one piece: the box is opened where the widest gap is

void open_box(double height, std::vector<Lipid> &lipids)
{
  std::vector<double> z;
  for (const Lipid &lipid : lipids)
    for (const Vector3d &x : lipid.x) z.push_back(x[2] - height * std::floor(x[2] / height));
  std::sort(z.begin(), z.end());
  double gap = z.front() + height - z.back(), floor = z.front();
  for (size_t i = 1; i < z.size(); ++i)
    if (z[i] - z[i - 1] > gap) {
      gap = z[i] - z[i - 1];
      floor = z[i];
    }
  for (Lipid &lipid : lipids) {
    double low = INFINITY;
    for (const Vector3d &x : lipid.x) low = std::min(low, x[2]);
    const double shift = height * std::floor((low - floor) / height + 1.0e-9);
    for (Vector3d &x : lipid.x) x[2] -= shift;
    lipid.centre[2] -= shift;
  }
}

// Two groups of heights: where the sum of squares from their means is least

double between_leaflets(const std::vector<Lipid> &lipids)
{
  std::vector<double> z;
  for (const Lipid &lipid : lipids) z.push_back(lipid.centre[2]);
  std::sort(z.begin(), z.end());
  const double all = std::accumulate(z.begin(), z.end(), 0.0);
  double below = 0.0, best = -INFINITY, level = z.front();
  for (size_t i = 1; i < z.size(); ++i) {
    below += z[i - 1];
    const double n = static_cast<double>(i), m = static_cast<double>(z.size() - i);
    const double score = below * below / n + (all - below) * (all - below) / m;
    if (score > best && z[i] > z[i - 1]) {
      best = score;
      level = 0.5 * (z[i - 1] + z[i]);
    }
  }
  return level;
}

// Lipids of a kind stand upside down in the other leaflet

bool face_each_other(const std::vector<Lipid> &lipids, double middle)
{
  std::map<int, std::vector<double>> sums[LEAFLETS];
  for (const Lipid &lipid : lipids) {
    auto &sum = sums[lipid.centre[2] > middle ? OUTER : INNER][lipid.species];
    sum.resize(lipid.x.size(), 0.0);
    for (size_t k = 0; k < lipid.x.size(); ++k) sum[k] += lipid.x[k][2] - lipid.centre[2];
  }
  double product = 0.0;
  bool compared = false;
  for (const auto &[species, upper] : sums[OUTER]) {
    const auto lower = sums[INNER].find(species);
    if (lower == sums[INNER].end()) continue;
    compared = true;
    product += std::inner_product(upper.begin(), upper.end(), lower->second.begin(), 0.0);
  }
  return !compared || product < 0.0;
}

void observe_contacts(const std::vector<Lipid> &lipids, const Matrix3d &cell, PatchLipids &library)
{
  std::vector<Vector3d> points;
  std::vector<std::pair<int, int>> owner;    // lipid, kind
  for (size_t m = 0; m < lipids.size(); ++m)
    for (size_t k = 0; k < lipids[m].x.size(); ++k) {
      points.push_back(lipids[m].x[k]);
      owner.emplace_back(static_cast<int>(m), library.species[lipids[m].species].kinds[k]);
    }
  BeadGrid grid(cell, {true, true, false});
  grid.fill(points, FARTHEST_CONTACT);
  for (size_t i = 0; i < points.size(); ++i)
    grid.near(points[i], [&](int j, const Vector3d &, double d2) {
      if (owner[j].first != owner[i].first)
        library.contacts.observe(owner[i].second, owner[j].second, std::sqrt(d2));
    });
}

}    // namespace

/* ---------------------------------------------------------------------- */

void Membrane_NS::make_whole(const Matrix3d &cell, const std::vector<int> &bonds, std::vector<Vector3d> &x)
{
  const size_t n = x.size();
  const Matrix3d inverse = cell.inverse();
  std::vector<std::vector<int>> bonded(n);
  for (size_t b = 0; b < bonds.size(); b += 2) {
    bonded[bonds[b]].push_back(bonds[b + 1]);
    bonded[bonds[b + 1]].push_back(bonds[b]);
  }
  std::vector<double> distance(n, INFINITY);    // to what is placed; bonds come first
  std::vector<Vector3d> image(x);
  std::vector<char> placed(n, 0);
  size_t next = 0;
  for (size_t count = 0; count < n; ++count) {
    placed[next] = 1;
    x[next] = image[next];
    auto consider = [&](size_t j, bool bond) {
      if (placed[j] || (distance[j] < 0.0 && !bond)) return;
      Vector3d d = x[j] - x[next], turns = inverse * d;
      for (int k = 0; k < 3; ++k) turns[k] = std::round(turns[k]);
      d -= cell * turns;
      const double length = bond ? -1.0 : d.norm();
      if (length >= distance[j]) return;
      distance[j] = length;
      image[j] = x[next] + d;
    };
    for (int j : bonded[next]) consider(j, true);
    for (size_t j = 0; j < n; ++j) consider(j, false);
    double best = INFINITY;
    for (size_t j = 0; j < n; ++j)
      if (!placed[j] && distance[j] < best) {
        best = distance[j];
        next = j;
      }
  }
}

std::vector<std::vector<int>> Membrane_NS::find_rings(int natoms, const std::vector<int> &bonds)
{
  std::vector<std::vector<int>> bonded(natoms), rings;
  std::set<std::vector<int>> known;
  for (size_t b = 0; b < bonds.size(); b += 2) {
    bonded[bonds[b]].push_back(bonds[b + 1]);
    bonded[bonds[b + 1]].push_back(bonds[b]);
  }
  // the shortest way from one end of a bond to the other without it

  for (size_t b = 0; b < bonds.size(); b += 2) {
    std::vector<int> from(natoms, -1), front = {bonds[b]};
    from[bonds[b]] = bonds[b];
    for (int length = 1; length < 8 && !front.empty() && from[bonds[b + 1]] < 0; ++length) {
      std::vector<int> next;
      for (int i : front)
        for (int j : bonded[i])
          if (from[j] < 0 && !(i == bonds[b] && j == bonds[b + 1])) {
            from[j] = i;
            next.push_back(j);
          }
      front = next;
    }
    if (from[bonds[b + 1]] < 0) continue;
    std::vector<int> ring;
    for (int i = bonds[b + 1]; i != bonds[b]; i = from[i]) ring.push_back(i);
    ring.push_back(bonds[b]);
    std::vector<int> sorted = ring;
    std::sort(sorted.begin(), sorted.end());
    if (known.insert(sorted).second) rings.push_back(ring);
  }
  return rings;
}

/* ---------------------------------------------------------------------- */

Patch Membrane_NS::make_patch(const MoleculeFile &file, bool flip, double neutral, PatchLipids &library)
{
  const Matrix3d cell = cell_of(file);
  Patch patch;
  patch.path = file.path;
  patch.cell = cell.topLeftCorner<2, 2>();
  patch.notes = file.notes;

  std::vector<Lipid> lipids = find_molecules(file);
  std::map<std::string, int> left_out;
  for (const Lipid &lipid : lipids) {
    const std::string &name = file.atoms[lipid.atoms[0]].residue;
    if (AMINO_ACIDS.count(name))
      fail(file, "there is an amino acid, " + name + ": a patch has lipids alone; proteins have a keyword of their own");
    if (is_solvent(file, lipid)) ++left_out[name];
  }
  lipids.erase(std::remove_if(lipids.begin(), lipids.end(), [&](const Lipid &l) { return is_solvent(file, l); }),
               lipids.end());
  std::string names;
  for (const auto &[name, count] : left_out) names += (names.empty() ? "" : ", ") + std::to_string(count) + " " + name;
  if (!names.empty()) patch.notes.push_back("left out: " + names);
  if (lipids.size() < 2) fail(file, "there are no lipids: molecules of 4 atoms or more that are not water");

  const TermsOfMolecules terms(file, lipids);
  find_species(file, terms, lipids, library);
  for (size_t m = 0; m < lipids.size(); ++m) {
    Lipid &lipid = lipids[m];
    for (int i : lipid.atoms) {
      Vector3d x = file.x[i];
      if (flip) x = Vector3d(x[0], -x[1], -x[2]);
      lipid.x.push_back(x);
      patch.charge += file.atoms[i].charge;
    }
    make_whole(cell, terms.local(static_cast<int>(m), BOND), lipid.x);
    lipid.centre = std::accumulate(lipid.x.begin(), lipid.x.end(), Vector3d(Vector3d::Zero())) / lipid.x.size();
  }
  open_box(cell(2, 2), lipids);

  // the middle plane is halfway between the ends of the two leaflets

  const double between = between_leaflets(lipids);
  double end[LEAFLETS] = {0.0, 0.0}, count[LEAFLETS] = {0.0, 0.0};
  for (const Lipid &lipid : lipids) {
    const int leaflet = lipid.centre[2] > between ? OUTER : INNER;
    double inmost = INFINITY;
    for (const Vector3d &x : lipid.x) inmost = std::min(inmost, sign_of(leaflet) * x[2]);
    end[leaflet] += sign_of(leaflet) * inmost;
    ++count[leaflet];
  }
  if (count[OUTER] == 0.0 || count[INNER] == 0.0 || !face_each_other(lipids, between))
    fail(file, "there is one leaflet only: a patch is a bilayer, flat and along x and y");
  if (std::max(count[OUTER], count[INNER]) > 2.0 * std::min(count[OUTER], count[INNER]))
    fail(file, "one leaflet has " + std::to_string((int) count[OUTER]) + " lipids, the other " +
                   std::to_string((int) count[INNER]) + ": this is no flat bilayer at rest");
  const double middle = 0.5 * (end[OUTER] / count[OUTER] + end[INNER] / count[INNER]);
  for (Lipid &lipid : lipids) {
    for (Vector3d &x : lipid.x) x[2] -= middle;
    lipid.centre[2] -= middle;
  }
  observe_contacts(lipids, cell, library);

  double height[LEAFLETS] = {0.0, 0.0}, head[LEAFLETS] = {0.0, 0.0};
  for (const Lipid &lipid : lipids) {
    const int leaflet = lipid.centre[2] > between - middle ? OUTER : INNER;
    double outmost = -INFINITY;
    for (const Vector3d &x : lipid.x) outmost = std::max(outmost, sign_of(leaflet) * x[2]);
    height[leaflet] += std::fabs(lipid.centre[2]) / count[leaflet];
    head[leaflet] += outmost / count[leaflet];
  }
  for (int leaflet = 0; leaflet < LEAFLETS; ++leaflet) {
    patch.neutral[leaflet] = neutral > 0.0 ? neutral : height[leaflet];
    patch.head[leaflet] = head[leaflet];
  }
  for (const Lipid &lipid : lipids) {
    const int leaflet = lipid.centre[2] > between - middle ? OUTER : INNER;
    Conformer conformer;
    conformer.species = lipid.species;
    conformer.lift = sign_of(leaflet) * lipid.centre[2] - patch.neutral[leaflet];
    for (const Vector3d &x : lipid.x) {
      const Vector3d d = x - lipid.centre;
      conformer.x.push_back(leaflet == OUTER ? d : Vector3d(d[0], -d[1], -d[2]));
    }
    const int number = static_cast<int>(library.conformers.size());
    library.conformers.push_back(conformer);
    library.by_species[lipid.species].push_back(number);
    patch.conformers[leaflet].push_back(number);
    patch.centres[leaflet].push_back(lipid.centre.head<2>());
  }
  return patch;
}

/* ---------------------------------------------------------------------- */

int Contacts::kind(const MoleculeAtom &atom)
{
  std::string name = atom.element;
  for (size_t k = 0; name.empty() && k < atom.name.size(); ++k)
    if (std::isalpha(static_cast<unsigned char>(atom.name[k]))) name = std::string(1, atom.name[k]);
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found != names_.end()) return static_cast<int>(found - names_.begin());
  names_.push_back(name);
  return kinds() - 1;
}

void Contacts::observe(int a, int b, double distance)
{
  const auto [entry, is_new] = seen_.try_emplace(std::minmax(a, b), distance);
  if (!is_new) entry->second = std::min(entry->second, distance);
}

void Contacts::settle(double all)
{
  least_ = all > 0.0 ? all : INFINITY;
  if (!(all > 0.0))
    for (const auto &entry : seen_) least_ = std::min(least_, entry.second);
  if (!std::isfinite(least_)) least_ = LONELY;
  closest_.assign(static_cast<size_t>(kinds()) * kinds(), least_);
  if (!(all > 0.0))
    for (const auto &[pair, distance] : seen_) {
      closest_[pair.first * kinds() + pair.second] = distance;
      closest_[pair.second * kinds() + pair.first] = distance;
    }
}

double Contacts::largest() const
{
  return *std::max_element(closest_.begin(), closest_.end());
}
