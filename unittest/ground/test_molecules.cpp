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

// Molecules on membranes: patches, layout, relaxation and files

#include "membrane_molecule_build.h"
#include "membrane_molecule_output.h"
#include "membrane_molecule_reader.h"
#include "membrane_molecule_rings.h"
#include "membrane_mesh_shapes.h"

#include "how_many.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

using namespace Membrane_NS;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/* ----------------------------------------------------------------------
   A patch of 2 n^2 lipids of seven beads on a square lattice, with a handedness: N, P, two chains of two, and a bead G beside the
   axis. The second species has a ring in place of a chain.
------------------------------------------------------------------------- */

struct Bead {
  const char *name;
  double x, y, z;
};
const std::vector<Bead> LIPID = {{"NC3", 0, 0, 21},    {"PO4", 0.3, 0, 17}, {"GL1", -1.5, 1.2, 13}, {"C1A", -1.8, 0, 9},
                                 {"C2A", -1.8, 0, 4.5}, {"C1B", 1.8, 0, 10}, {"C2B", 1.8, 0, 5}};
const std::vector<int> BONDS = {0, 1, 1, 2, 2, 3, 3, 4, 1, 5, 5, 6};

double uniform()
{
  return std::rand() / (RAND_MAX + 1.0);
}

MoleculeFile patch_file(int n = 6, double spacing = 8.0, int every = 0)
{
  std::srand(1);
  MoleculeFile file;
  file.path = "patch";
  for (int k = 0; k < 2; ++k) file.lengths[k] = n * spacing;
  file.lengths[2] = 70.0;
  int residue = 0;
  for (int side : {1, -1})
    for (int i = 0; i < n * n; ++i) {
      const double turn = 2.0 * M_PI * uniform();
      const int first = static_cast<int>(file.atoms.size());
      for (const Bead &bead : LIPID) {
        MoleculeAtom atom;
        atom.name = bead.name;
        atom.residue = every && i % every == 0 ? "CHOL" : "LIPI";
        atom.residue_index = residue;
        atom.number = residue + 1;
        atom.type = bead.name;
        atom.mass = 72.0;
        file.atoms.push_back(atom);
        Vector3d x(std::cos(turn) * bead.x - std::sin(turn) * bead.y, std::sin(turn) * bead.x + std::cos(turn) * bead.y, bead.z);
        if (side < 0) x = Vector3d(x[0], -x[1], -x[2]);    // turned about x
        x += Vector3d((i % n + 0.5) * spacing, (i / n + 0.5) * spacing, 30.0);
        for (int k = 0; k < 3; ++k) x[k] -= file.lengths[k] * std::floor(x[k] / file.lengths[k]);
        file.x.push_back(x);
      }
      for (int bond : BONDS) file.terms[BOND].push_back(first + bond);
      ++residue;
    }
  file.has_terms = true;
  return file;
}

// Positive for all lipids of the patch

double handedness(const std::vector<Vector3d> &x)
{
  return (x[5] - x[3]).cross(x[1] - x[0]).dot(x[2] - x[1]);
}

struct Built {
  PatchLipids library;
  Patch patch;
  BuildReport report;
  Structure structure;
  std::unique_ptr<Topology> topology;
  std::unique_ptr<LimitSurfaceOfMesh> surface;
  std::vector<Vector3d> molecule(size_t m) const
  {
    const auto first = structure.x.begin() + structure.molecules[m].atom;
    return {first, first + structure.species_of(structure.molecules[m]).atoms.size()};
  }
};

TriangleMesh scaled_box(TriangleMesh mesh, double length)
{
  mesh.lattice = length * Matrix3d::Identity();
  return mesh;
}

Built build(const TriangleMesh &mesh, const MoleculeFile &file, bool flip = false,
            const std::vector<PlacedProtein> &proteins = {})
{
  Built built;
  built.patch = make_patch(file, flip, 0.0, built.library);
  built.topology = std::make_unique<Topology>(mesh.points.size(), mesh.faces);
  built.surface = std::make_unique<LimitSurfaceOfMesh>(*built.topology, mesh);
  MembranePart part = {{}, 1};
  for (int f = 0; f < built.topology->num_faces(); ++f) part.faces.push_back(f);
  Team alone;
  built.structure = build_structure(*built.surface, Vector3d::Zero(), {part}, {&built.patch, &built.patch}, built.library,
                                    proteins, nullptr, 7, alone, built.report);
  return built;
}

TriangleMesh ball(double radius)
{
  return scaled_box(interpolate(icosphere(3, radius)), 10.0 * radius);
}

// Lipids of two species on a small vesicle, which several tests look at

const MoleculeFile &two_species()
{
  static const MoleculeFile file = patch_file(6, 8.0, 3);
  return file;
}

const Built &vesicle()
{
  static const Built built = build(ball(35.0), two_species());
  return built;
}

std::string message_of(const std::function<void()> &f)
{
  try {
    f();
  } catch (const MoleculeError &err) {
    return err.what();
  }
  return "";
}

std::string content_of(const std::string &path)
{
  std::ifstream file(path);
  std::stringstream all;
  all << file.rdbuf();
  return all.str();
}

}    // namespace

// === Cells and molecules

TEST(BeadGrid, FindsWhatAllPairsFindInAnyImage)
{
  Matrix3d lattice;
  lattice << 10.0, 2.0, -1.0, 0.0, 9.0, 3.0, 0.0, 0.0, 4.0;
  std::vector<Vector3d> points;
  for (int i = 0; i < 60; ++i) points.push_back(lattice * Vector3d(3 * uniform(), 2 * uniform() - 2, 2 * uniform()));
  for (const std::array<bool, 3> periodic : {std::array<bool, 3>{true, true, true}, {true, false, true}, {false, false, false}})
    for (double cutoff : {1.5, 4.5}) {    // the box is narrower than the second
      BeadGrid grid(lattice, periodic);
      grid.fill(points, cutoff);
      for (const Vector3d &x : points) {
        std::multiset<int> expected, found;
        for (size_t j = 0; j < points.size(); ++j)
          for (int a = -6; a <= 6; ++a)
            for (int b = -6; b <= 6; ++b)
              for (int c = -6; c <= 6; ++c) {
                if ((a && !periodic[0]) || (b && !periodic[1]) || (c && !periodic[2])) continue;
                if ((points[j] + lattice * Vector3d(a, b, c) - x).norm() < cutoff) expected.insert(static_cast<int>(j));
              }
        grid.near(x, [&](int j, const Vector3d &d, double d2) {
          found.insert(j);
          const Vector3d turns = lattice.inverse() * (d - (points[j] - x));
          EXPECT_NEAR((turns - Vector3d(turns.array().round())).norm(), 0.0, 1e-9);
          EXPECT_NEAR(d.squaredNorm(), d2, 1e-12);
        });
        EXPECT_EQ(found, expected);
      }
    }
}

TEST(Molecules, AreMadeWholeAcrossAnyFaceOfTheCell)
{
  Matrix3d cell;
  cell << 20.0, 5.0, 0.0, 0.0, 18.0, 0.0, 0.0, 0.0, 30.0;
  std::vector<Vector3d> chain, broken;
  for (int i = 0; i < 12; ++i) chain.emplace_back(18.0 + 2.0 * i, 17.0 + 1.5 * i, 29.0 - i);    // longer than the cell
  std::vector<int> bonds;
  for (int i = 1; i < 12; ++i) bonds.insert(bonds.end(), {i - 1, i});
  for (const Vector3d &x : chain) {
    Vector3d turns = cell.inverse() * x;
    broken.push_back(x - cell * Vector3d(turns.array().floor()));
  }
  for (const auto &known : {bonds, std::vector<int>()}) {
    std::vector<Vector3d> x = broken;
    make_whole(cell, known, x);
    for (int i = 1; i < 12; ++i) EXPECT_NEAR((x[i] - x[i - 1] - chain[i] + chain[i - 1]).norm(), 0.0, 1e-9) << known.size();
  }
}

TEST(Molecules, RingsAreTheShortestThroughEachBond)
{
  EXPECT_TRUE(find_rings(4, {0, 1, 1, 2, 2, 3}).empty());
  // a six-ring and a five-ring with a bond in common, and a tail
  const auto rings = find_rings(10, {0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 0, 4, 6, 6, 7, 7, 8, 8, 5, 8, 9});
  std::multiset<size_t> sizes;
  for (const auto &ring : rings) sizes.insert(ring.size());
  EXPECT_EQ(sizes, (std::multiset<size_t>{5, 6}));
}

// === Patches

TEST(Patch, HasLipidsOfBothLeafletsOutwardAndTurnedNotMirrored)
{
  const MoleculeFile file = patch_file();
  for (bool flip : {false, true}) {
    PatchLipids library;
    const Patch patch = make_patch(file, flip, 0.0, library);
    EXPECT_EQ(patch.conformers[OUTER].size(), 36u);
    EXPECT_EQ(patch.conformers[INNER].size(), 36u);
    EXPECT_NEAR(patch.area_per_lipid(OUTER), 64.0, 1e-9);
    EXPECT_NEAR(patch.neutral[OUTER], (21 + 17 + 13 + 9 + 4.5 + 10 + 5) / 7.0, 1e-9);
    EXPECT_NEAR(patch.head[INNER], 21.0, 1e-9);
    for (const Conformer &conformer : library.conformers) {
      EXPECT_GT(conformer.x[0][2] - conformer.x[4][2], 16.0);
      EXPECT_GT(handedness(conformer.x), 0.0);
    }
  }
}

TEST(Patch, FlipTurnsItOver)
{
  MoleculeFile file = patch_file();
  for (size_t i = 0; i < file.atoms.size() / 2; ++i) file.atoms[i].residue = "UPPE";
  auto upper_of = [&](bool flip) {
    PatchLipids library;
    const Patch patch = make_patch(file, flip, 0.0, library);
    return library.species[library.conformers[patch.conformers[OUTER][0]].species].name;
  };
  EXPECT_EQ(upper_of(false), "UPPE");
  EXPECT_EQ(upper_of(true), "LIPI");
}

TEST(Patch, SaysWhatItCannotUse)
{
  auto refused = [](MoleculeFile file) {
    PatchLipids library;
    return message_of([&] { make_patch(file, false, 0.0, library); });
  };
  MoleculeFile file = patch_file();
  EXPECT_EQ(refused(file), "");
  file.lengths[1] = 0.0;
  EXPECT_THAT(refused(file), testing::HasSubstr("CRYST1"));
  file = patch_file();
  file.angles[0] = 80.0;
  EXPECT_THAT(refused(file), testing::HasSubstr("right angles"));
  file = patch_file();
  file.atoms[3].residue = "ALA";
  for (MoleculeAtom &atom : file.atoms)
    if (atom.residue_index == 0) atom.residue = "ALA";
  EXPECT_THAT(refused(file), testing::HasSubstr("amino acid"));
  file = patch_file();
  file.atoms.resize(36 * 7);
  file.x.resize(36 * 7);
  file.terms[BOND].resize(36 * 12);
  EXPECT_THAT(refused(file), testing::HasSubstr("one leaflet only"));
  for (MoleculeAtom &atom : file.atoms) atom.residue = "TIP3";
  EXPECT_THAT(refused(file), testing::HasSubstr("no lipids"));
}

TEST(Patch, LeavesWaterAndIonsOut)
{
  MoleculeFile file = patch_file();
  for (int i = 0; i < 30; ++i) {
    MoleculeAtom atom;
    atom.name = "W";
    atom.residue = i % 2 ? "W" : "NA+";
    atom.residue_index = 100 + i;
    file.atoms.push_back(atom);
    file.x.emplace_back(uniform() * 48, uniform() * 48, 60.0);
  }
  PatchLipids library;
  const Patch patch = make_patch(file, false, 0.0, library);
  EXPECT_EQ(library.species.size(), 1u);
  EXPECT_THAT(patch.notes, testing::Contains("left out: 15 NA+, 15 W"));
}

// === Surfaces

TEST(ParallelSurfaces, HaveTheAreasOfSpheresAndTori)
{
  auto area = [](const TriangleMesh &mesh, double height) {
    const Topology topology(mesh.points.size(), mesh.faces);
    const LimitSurfaceOfMesh surface(topology, mesh);
    std::vector<int> faces;
    for (int f = 0; f < topology.num_faces(); ++f) faces.push_back(f);
    return ParallelSurfaces(surface, faces).area(height);
  };
  for (double h : {-20.0, 0.0, 20.0}) {
    EXPECT_NEAR(area(ball(80.0), h) / (4.0 * M_PI * (80.0 + h) * (80.0 + h)), 1.0, 2e-3);
    EXPECT_NEAR(area(scaled_box(interpolate(torus(48, 24, 120.0, 60.0)), 1000.0), h) / (4.0 * M_PI * M_PI * 120.0 * (60.0 + h)), 1.0,
                2e-3);
  }
}

TEST(ParallelSurfaces, SayWhereTheyAreTooCurved)
{
  const std::string message = message_of([] { build(ball(20.0), patch_file()); });
  EXPECT_THAT(message, testing::ContainsRegex("radius of (20|1[5-9])"));
  EXPECT_THAT(message, testing::HasSubstr("inner leaflet"));
}

// === Structures

TEST(Structure, OfAPlaneOfWholeMultiplesIsThePatch)
{
  const Matrix3d lattice = Vector3d(96.0, 144.0, 80.0).asDiagonal();
  TriangleMesh mesh = sheet(12, 20, lattice, 0.5);
  mesh.lattice = lattice;
  mesh.periodic = {true, true, true};
  const MoleculeFile file = patch_file();
  const Built built = build(mesh, file);
  EXPECT_TRUE(built.report.exact);
  ASSERT_EQ(built.structure.molecules.size(), 72u * 6);

  // each atom is where an image of an atom of the patch is, all at the same distance along z

  std::vector<Vector3d> from = file.x;
  Matrix3d cell = Vector3d(48.0, 48.0, 70.0).asDiagonal();
  for (size_t m = 0; m < built.structure.molecules.size(); ++m) {
    const auto x = built.molecule(m);
    double best = INFINITY;
    for (size_t l = 0; l < 72; ++l) {
      double most = 0.0;
      for (int k = 0; k < 7; ++k) {
        Vector3d d = x[k] - Vector3d(0, 0, 40.0 - 30.0) - from[7 * l + k];
        for (int a = 0; a < 3; ++a) d[a] -= cell(a, a) * std::round(d[a] / cell(a, a));
        most = std::max(most, d.norm());
      }
      best = std::min(best, most);
    }
    EXPECT_LT(best, 1e-9);
  }
}

const Built &torus_of_lipids()
{
  static const Built built = build(scaled_box(interpolate(torus(24, 16, 60.0, 30.0)), 600.0), two_species());
  return built;
}

class Curved : public testing::TestWithParam<int> {};

TEST_P(Curved, LipidsAreWholeOutwardAndAsManyAsTheAreaAsksFor)
{
  const Built &built = GetParam() == 0 ? vesicle() : torus_of_lipids();
  const auto &numbers = built.report.numbers[0];
  for (int leaflet = 0; leaflet < LEAFLETS; ++leaflet) {
    const double wanted = built.report.areas[0][leaflet] / 64.0;
    const int all = numbers[leaflet][0] + numbers[leaflet][1];
    EXPECT_NEAR(all, wanted, 0.51);
    const int chol = built.library.species[0].name == "CHOL" ? 0 : 1;
    EXPECT_NEAR(numbers[leaflet][chol], all / 3.0, 1.0);
  }
  EXPECT_LT(built.report.clashes, 0.03 * built.structure.molecules.size());
  EXPECT_GT(built.report.closest, 1.5);

  const Vector3d centre = Vector3d::Zero();
  for (size_t m = 0; m < built.structure.molecules.size(); ++m) {
    const auto x = built.molecule(m);
    for (size_t b = 0; b < BONDS.size(); b += 2) {
      const Bead &p = LIPID[BONDS[b]], &q = LIPID[BONDS[b + 1]];
      const double length = Vector3d(p.x - q.x, p.y - q.y, p.z - q.z).norm();
      EXPECT_NEAR((x[BONDS[b]] - x[BONDS[b + 1]]).norm(), length, 1e-9);
    }
    EXPECT_GT(handedness(x), 0.0);
    if (GetParam() == 1) continue;
    const bool outer = built.structure.groups[built.structure.molecules[m].group].what == "outer leaflet";
    EXPECT_EQ((x[0] - centre).norm() > (x[4] - centre).norm(), outer);
  }
}

// the torus, of three times the lipids, takes no other ways through the code
INSTANTIATE_TEST_SUITE_P(Surfaces, Curved, testing::Range(0, Membrane_TEST::SANITIZED ? 1 : 2));

TEST(Structure, ProteinsHaveTheirPlaceWithoutLipids)
{
  auto protein = std::make_shared<MoleculeFile>();
  protein->path = "helix.pdb";
  for (int i = 0; i < 20; ++i) {
    MoleculeAtom atom;
    atom.name = "CA";
    atom.residue = "LEU";
    atom.residue_index = i;
    atom.number = i + 1;
    protein->atoms.push_back(atom);
    protein->x.emplace_back(4.0 * std::cos(1.7 * i), 4.0 * std::sin(1.7 * i), 2.0 * (i - 9.5));
  }
  const Built &without = vesicle();
  const Vector3d top(0.0, 0.0, 35.0);
  const Built built = build(ball(35.0), two_species(), false, {{protein, top, Matrix3d::Identity()}});
  ASSERT_EQ(built.structure.groups[built.structure.molecules[0].group].what, "protein");
  for (int i = 0; i < 20; ++i) EXPECT_NEAR((built.structure.x[i] - top - protein->x[i]).norm(), 0.0, 1e-12);
  EXPECT_GT(built.report.displaced, 0);
  EXPECT_EQ(built.structure.molecules.size() - 1 + built.report.displaced, without.structure.molecules.size());
  for (size_t i = 20; i < built.structure.x.size(); ++i)
    for (int k = 0; k < 20; ++k) EXPECT_GT((built.structure.x[i] - built.structure.x[k]).norm(), 1.5);
}

// A species of carbon atoms and its conformers, in a library of such

void add_species(PatchLipids &library, const std::string &name, const std::vector<int> &bonds,
                 const std::vector<std::vector<Vector3d>> &conformers)
{
  const int number = static_cast<int>(library.species.size());
  MoleculeAtom atom;
  atom.name = "C";
  LipidSpecies species;
  species.name = name;
  species.terms[BOND] = bonds;
  species.rings = find_rings(static_cast<int>(conformers[0].size()), bonds);
  species.atoms.assign(conformers[0].size(), atom);
  species.kinds.assign(conformers[0].size(), library.contacts.kind(atom));
  library.species.push_back(species);
  library.by_species.emplace_back();
  for (const auto &x : conformers) {
    library.by_species[number].push_back(static_cast<int>(library.conformers.size()));
    library.conformers.push_back({number, 0.0, x});
  }
}

/// A crowd on a periodic plane of 40 x 40 Angstrom.
struct Flat {
  TriangleMesh mesh;
  std::unique_ptr<Topology> topology;
  std::unique_ptr<LimitSurfaceOfMesh> surface;
  std::vector<ParallelSurfaces> parts;
  Team alone;
  FixedAtoms fixed;
  std::unique_ptr<LipidCrowd> crowd;

  Flat(const PatchLipids &library, const FixedAtoms &atoms = {}) : fixed(atoms)
  {
    const Matrix3d lattice = Vector3d(40.0, 40.0, 40.0).asDiagonal();
    mesh = sheet(8, 8, lattice, 0.5);
    mesh.lattice = lattice;
    mesh.periodic = {true, true, true};
    topology = std::make_unique<Topology>(mesh.points.size(), mesh.faces);
    surface = std::make_unique<LimitSurfaceOfMesh>(*topology, mesh);
    std::vector<int> faces;
    for (int f = 0; f < topology->num_faces(); ++f) faces.push_back(f);
    parts.emplace_back(*surface, faces);
    crowd = std::make_unique<LipidCrowd>(library, parts, std::array<double, LEAFLETS>{1.0, 1.0}, fixed, 1, alone);
  }
};

TEST(Rings, BondsThatGoThroughAreFoundAndUndone)
{
  // two kinds on a plane: rings of six in a sheet, and rods, one of which stands in a ring

  PatchLipids library;
  std::vector<Vector3d> ring;
  std::vector<int> bonds;
  for (int k = 0; k < 6; ++k) {
    ring.emplace_back(1.4 * std::cos(M_PI * k / 3), 1.4 * std::sin(M_PI * k / 3), 0.0);
    bonds.insert(bonds.end(), {k, (k + 1) % 6});
  }
  add_species(library, "RING", bonds, {ring});
  add_species(library, "ROD", {0, 1}, {{{0, 0, -0.8}, {0, 0, 0.8}}});
  library.contacts.settle(1.5);

  Flat flat(library);
  LipidCrowd &crowd = *flat.crowd;
  const ParallelPlace here = flat.parts[0].lift({3, 0.3, 0.3}, 1.0);
  crowd.lipids = {crowd.stand(here, Vector3d::UnitX(), 0, OUTER, 0), crowd.stand(here, Vector3d::UnitX(), 1, OUTER, 0)};
  EXPECT_EQ(find_pierced_rings(crowd).size(), 1u);
  crowd.lipids[1].x += Vector3d(1.6, 0.0, 0.0);    // beside the ring
  EXPECT_EQ(find_pierced_rings(crowd).size(), 0u);
  crowd.lipids[1].x -= Vector3d(1.0, 0.0, 0.0);    // off its middle
  EXPECT_EQ(find_pierced_rings(crowd).size(), 1u);
  EXPECT_EQ(free_rings(crowd).size(), 0u);
  EXPECT_EQ(find_pierced_rings(crowd).size(), 0u);
}

// === Lipids that bend

// A chain of ten with a double bond between 4 and 5 and a ring at its end, in many shapes

std::vector<std::vector<Vector3d>> chains(int number, std::vector<int> &bonds)
{
  bonds.clear();
  std::vector<Vector3d> x;
  for (int k = 0; k < 10; ++k) x.emplace_back(0.8 * (k % 2), 0.0, -1.25 * k);
  for (int k = 0; k < 9; ++k) bonds.insert(bonds.end(), {k, k + 1});
  x.push_back(x[9] + Vector3d(-0.8, 1.2, -0.4));
  x.push_back(x[9] + Vector3d(-0.8, -0.3, -1.2));
  bonds.insert(bonds.end(), {9, 10, 10, 11, 11, 9});
  std::vector<std::vector<Vector3d>> shapes;
  std::srand(5);
  for (int s = 0; s < number; ++s) {
    shapes.push_back(x);
    for (int k = 1; k < 9; ++k) {
      Torsion torsion;
      torsion.from = k;
      torsion.to = k + 1;
      for (int l = k + 2; l < 12; ++l) torsion.turning.push_back(l);
      const double three = 2.0 * M_PI / 3.0 * static_cast<int>(3.0 * uniform());
      torsion.turn((k == 4 ? 0.0 : three) + 0.2 * (uniform() - 0.5), shapes.back());
    }
  }
  return shapes;
}

// Lengths of bonds and the angles between them, as distances

std::vector<double> lengths(const std::vector<Vector3d> &x)
{
  std::vector<double> all = {(x[10] - x[9]).norm(), (x[11] - x[10]).norm(), (x[11] - x[9]).norm(), (x[10] - x[8]).norm()};
  for (int k = 0; k < 9; ++k) all.push_back((x[k + 1] - x[k]).norm());
  for (int k = 0; k < 8; ++k) all.push_back((x[k + 2] - x[k]).norm());
  return all;
}

TEST(Torsions, ArePartsThatTurnAboutBondsInNoRing)
{
  PatchLipids library;
  std::vector<int> bonds;
  const auto shapes = chains(40, bonds);
  add_species(library, "CHAIN", bonds, shapes);
  const LipidTorsions lipid(library, 0);

  // those of bonds between inner atoms, without the double one; the smaller part turns

  std::set<std::pair<int, int>> found;
  for (const Torsion &torsion : lipid.torsions) {
    found.insert(std::minmax(torsion.from, torsion.to));
    EXPECT_LE(torsion.turning.size(), 5u);
    EXPECT_EQ(torsion.seen.size(), 40u);
    EXPECT_TRUE(std::is_sorted(torsion.seen.begin(), torsion.seen.end()));
  }
  EXPECT_EQ(found, (std::set<std::pair<int, int>>{{1, 2}, {2, 3}, {3, 4}, {5, 6}, {6, 7}, {7, 8}, {8, 9}}));

  for (const Torsion &torsion : lipid.torsions) {
    auto x = shapes[3];
    const double way = torsion.turn(0.7, x);
    EXPECT_THAT(lengths(x), testing::Pointwise(testing::DoubleNear(1e-12), lengths(shapes[3])));
    double most = 0.0;
    for (size_t k = 0; k < x.size(); ++k) most = std::max(most, (x[k] - shapes[3][k]).norm());
    EXPECT_NEAR(way, most, 1e-12);
    for (const Torsion &other : lipid.torsions) {
      const double by = &other == &torsion ? 0.7 : 0.0;
      EXPECT_NEAR(std::remainder(other.angle(x) - other.angle(shapes[3]) - by, 2.0 * M_PI), 0.0, 1e-12);
    }
  }

  // the nearest of angles, across pi, too

  Torsion torsion;
  torsion.seen = {-3.0, 0.5, 2.9};
  EXPECT_NEAR(torsion.off(3.1), -(-3.0 + 2.0 * M_PI - 3.1), 1e-12);
  EXPECT_NEAR(torsion.off(-3.13), -0.13, 1e-12);
  EXPECT_NEAR(torsion.off(2.95), 0.05, 1e-12);
  EXPECT_NEAR(torsion.off(0.1), -0.4, 1e-12);

  // apart: more than three bonds; 10 and 11 are in a ring with 9

  EXPECT_FALSE(lipid.apart[0 * 12 + 0] || lipid.apart[0 * 12 + 3] || lipid.apart[3 * 12 + 0] || lipid.apart[7 * 12 + 11]);
  EXPECT_TRUE(lipid.apart[0 * 12 + 4] && lipid.apart[6 * 12 + 11] && lipid.apart[11 * 12 + 6]);
  library.contacts.settle(3.0);
  double least = INFINITY;
  for (const auto &x : shapes)
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 12; ++j)
        if (lipid.apart[i * 12 + j]) least = std::min(least, (x[i] - x[j]).norm());
  EXPECT_EQ(closest_within(library, {lipid}), std::vector<double>{least});
}

TEST(Torsions, LetLipidsOutOfEachOthersWay)
{
  PatchLipids library;
  std::vector<int> bonds;
  const auto shapes = chains(40, bonds);
  add_species(library, "CHAIN", bonds, shapes);
  library.contacts.settle(3.0);
  const LipidTorsions lipid(library, 0);

  // a chain whose head is in a cage that it fits, and with atoms where its tail is

  FixedAtoms cage;
  Flat empty(library);
  const PlacedLipid placed = empty.crowd->stand(empty.parts[0].lift({3, 0.3, 0.3}, 1.0), Vector3d::UnitX(), 7, OUTER, 0);
  auto distance = [&](const Vector3d &x, int first, int last) {
    double least = INFINITY;
    for (int k = first; k <= last; ++k) least = std::min(least, (shapes[7][k] - x).norm());
    return least;
  };
  for (int cell = 0; cell < 40 * 40 * 40; ++cell) {
    const Vector3d x = shapes[7][0] + Vector3d(cell % 40 - 20, cell / 40 % 40 - 20, cell / 1600 - 20);
    if (distance(x, 0, 4) < 4.5 && distance(x, 0, 11) > 3.1) cage.x.push_back(placed.x + placed.turn * x);
  }
  for (int k : {7, 8, 9, 10, 11}) cage.x.push_back(placed.x + placed.turn * shapes[7][k]);
  cage.kinds.assign(cage.x.size(), 0);
  Flat flat(library, cage);
  LipidCrowd &crowd = *flat.crowd;
  crowd.lipids = {placed};
  crowd.relax(300);
  EXPECT_EQ(crowd.report().lipids, 1);
  for (int round = 0; round < 3; ++round) {
    crowd.bend(1e-3, 1000, 0.005, round);
    crowd.relax(50);
  }
  EXPECT_EQ(crowd.report().lipids, 0);
  EXPECT_LT(crowd.energies()[0], 0.02);
  std::vector<Vector3d> x;
  for (int k = 0; k < 12; ++k) x.push_back(crowd.atom(crowd.lipids[0], k));
  EXPECT_THAT(lengths(x), testing::Pointwise(testing::DoubleNear(1e-9), lengths(shapes[7])));
  for (const Torsion &torsion : lipid.torsions) EXPECT_LT(std::fabs(torsion.off(torsion.angle(x))), LipidCrowd::LIBRATION + 1e-9);
}

TEST(Torsions, TurnDownTheEnergy)
{
  PatchLipids library;
  std::vector<int> bonds;
  const auto shapes = chains(40, bonds);
  add_species(library, "CHAIN", bonds, shapes);
  library.contacts.settle(3.0);

  // an atom beside each of the chain in turn; what a step gains as a rigid body, and with torsions

  Flat empty(library);
  const PlacedLipid placed = empty.crowd->stand(empty.parts[0].lift({3, 0.3, 0.3}, 1.0), Vector3d::UnitX(), 7, OUTER, 0);
  for (int k = 0; k < 12; ++k) {
    FixedAtoms beside;
    beside.x.push_back(placed.x + placed.turn * (shapes[7][k] + Vector3d(0.9, 2.0, 1.2)));
    beside.kinds.push_back(0);
    Flat flat(library, beside);
    LipidCrowd &crowd = *flat.crowd;
    double energy[3];
    for (int way = 0; way < 3; ++way) {
      crowd.lipids = {placed};
      if (way == 2) crowd.bend(-1.0, 0, 0.0, 0);    // a shape of its own
      if (way > 0) crowd.relax(1);
      energy[way] = crowd.energies()[0];
    }
    EXPECT_GT(energy[0], energy[1]) << k;
    EXPECT_GE(energy[1], energy[2]) << k;
    if (k < 2 || k > 6) {    // torsions matter
      EXPECT_GT(energy[1], energy[2]) << k;
    }
  }
}

// === Files

TEST(MoleculeFiles, Hybrid36HasTheNumbersOfItsAuthors)
{
  EXPECT_EQ(hybrid36(9999, 4), "9999");
  EXPECT_EQ(hybrid36(10000, 4), "A000");
  EXPECT_EQ(hybrid36(10000 + 26 * 36 * 36 * 36 - 1, 4), "ZZZZ");
  EXPECT_EQ(hybrid36(10000 + 26 * 36 * 36 * 36, 4), "a000");
  EXPECT_EQ(hybrid36(99999, 5), "99999");
  EXPECT_EQ(hybrid36(100000, 5), "A0000");
  EXPECT_EQ(hybrid36(43770016 + 100000 - 100000 - 1, 5), "ZZZZZ");
  EXPECT_EQ(hybrid36(43770016, 5), "a0000");
  EXPECT_EQ(hybrid36(87440031, 5), "zzzzz");
  EXPECT_EQ(hybrid36(87440032, 5), "*****");
}

TEST(MoleculeFiles, GetTheirNamesOnlyWhenAllIsWritten)
{
  std::remove("half.txt");
  {
    OutputFile file("half.txt");
    file.print("half");
  }
  EXPECT_FALSE(std::ifstream("half.txt").good());
  EXPECT_FALSE(std::ifstream("half.txt.part").good());
  {
    OutputFile file("half.txt");
    file.print("whole");
    file.finish();
    EXPECT_FALSE(std::ifstream("half.txt").good());
    file.take_name();
  }
  EXPECT_EQ(content_of("half.txt"), "whole");
  EXPECT_THAT(message_of([] { OutputFile file("no/such/folder"); }), testing::HasSubstr("cannot write no/such/folder"));
}

TEST(MoleculeFiles, APdbFileThatIsWrittenReadsBack)
{
  if (!can_read_molecules()) GTEST_SKIP() << "without gemmi";
  const Built &built = vesicle();
  for (const char *name : {"back.pdb", "back.cif"}) {
    OutputFile file(name);
    if (std::string(name) == "back.pdb")
      write_pdb(file, built.structure);
    else
      write_mmcif(file, built.structure);
    file.finish();
    file.take_name();
    const MoleculeFile back = read_molecules(name);
    ASSERT_EQ(back.atoms.size(), built.structure.x.size());
    for (size_t i = 0; i < back.x.size(); ++i) EXPECT_LT((back.x[i] - built.structure.x[i]).norm(), 2e-3);
    AtomNames(built.structure).each([&](int i, const MoleculeAtom &atom, int residue, char, int) {
      EXPECT_EQ(back.atoms[i].name, atom.name);
      EXPECT_EQ(back.atoms[i].residue, atom.residue);
      EXPECT_EQ(back.atoms[i].number, residue);
    });
    EXPECT_NEAR(back.lengths[0], 350.0, 1e-3);
  }
}
