"""membrane_build: lipids of a patch on membranes, whole and as many as the area asks for; its files read back by others; odd
PDB files and bad input.

    MEMBRANE_LONG=1    more shapes, from a patch that ran for longer; a sphere of lipids with hydrogens
"""
# cost: 70
# timeout: 7200

import glob
import json
import math
import os
import resource
import shutil
import signal
import subprocess
import sys

from lammps_claims import EXAMPLES, LMP, LONG, MPIEXEC, claim, error_of, finish, lammps, run, skip, start
from vectors import cross, dihedral, dot, minus

HERE = os.path.dirname(os.path.abspath(__file__))
FOLDER = os.path.join(EXAMPLES, "molecules")
for name in (path for end in ("pdb", "cif", "gro", "data", "psf", "top", "part") for path in glob.glob(f"*.{end}")):
    os.remove(name)    # of an earlier run in this folder
for name in glob.glob(os.path.join(FOLDER, "*")):
    shutil.copy(name, ".")
sys.path.insert(0, FOLDER)
import make_patch    # noqa: E402
import atom_patch    # noqa: E402

START = """
units           real
atom_style      membrane_cp
region          box block {box}
create_box      2 box angle/types 1
create_membrane 1 {shape}
set             type 1 mass 1000
"""
BEADS = len(make_patch.NAMES)


def script(shape, box, options, more=""):
    return START.format(shape=shape, box=box) + more + f"membrane_build {options}\n"


def remove(name):
    for path in glob.glob(name + ".*"):
        os.remove(path)


def report(output, what):
    return next((line.strip() for line in output.split("\n") if what in line), "")


def numbers_of(output, leaflet):
    """Lipids of a leaflet, and what its area asks for."""
    words = report(output, f"{leaflet} leaflet:").split()
    return int(words[words.index("lipids,") - 1]), float(words[words.index("by") - 1])


def clashing(output):
    return float(report(output, "lipids in a clash, with").split("%")[0].split(",")[-1]) / 100


def closest(output):
    return float(report(output, "closest pair of lipids:").split()[4])


def read_data(path):
    """Unwrapped places by molecule, and the bonds, of a data file."""
    lines = open(path).read().split("\n")
    lengths = [next(float(line.split()[1]) - float(line.split()[0]) for line in lines if line.endswith(f"{k}lo {k}hi")) for k in "xyz"]
    def section(title):
        first = next(i for i, line in enumerate(lines) if line.startswith(title)) + 2
        last = next((i for i in range(first, len(lines)) if not lines[i]), len(lines))
        return [line.split() for line in lines[first:last]]
    molecules = {}
    for words in section("Atoms"):
        x = [float(words[4 + k]) + lengths[k] * int(words[7 + k]) for k in range(3)]
        molecules.setdefault(int(words[1]), []).append(x)
    return list(molecules.values()), [[int(w) for w in words[2:]] for words in section("Bonds")]


class Kind:
    """What lipids of a kind keep when parts of them turn about bonds, which are pairs of atoms."""

    def __init__(self, bonds, atoms):
        self.near = [sorted({a for bond in bonds if i in bond for a in bond if a != i}) for i in range(atoms)]
        two = {tuple(sorted((i, k))) for j in range(atoms) for i in self.near[j] for k in self.near[j] if i != k}
        self.lengths = sorted({tuple(sorted(bond)) for bond in bonds} | two)
        self.centres = [i for i in range(atoms) if len(self.near[i]) > 2]
        self.torsions = [(min(set(self.near[i]) - {j}), i, j, min(set(self.near[j]) - {i})) for i, j in bonds
                         if len(self.near[i]) > 1 and len(self.near[j]) > 1]

    def kept(self, lipid):
        """Lengths of bonds and of the third sides of their angles, and on which side of its neighbors an atom is."""
        volumes = [dot(cross(*(minus(lipid[k], lipid[i]) for k in self.near[i][:2])), minus(lipid[self.near[i][2]], lipid[i]))
                   for i in self.centres]
        return [math.dist(lipid[i], lipid[j]) for i, j in self.lengths] + [volume / 10 for volume in volumes]

    def angles(self, lipid):
        return [dihedral(*(lipid[i] for i in torsion)) for torsion in self.torsions]

    def compare(self, lipids, patch):
        """How far lipids are from what is kept in one of the patch, and torsions (degrees) from the nearest of the patch."""
        kept, angles = [self.kept(lipid) for lipid in patch], list(zip(*(self.angles(lipid) for lipid in patch)))
        off = max(min(max(abs(a - b) for a, b in zip(mine, theirs)) for theirs in kept) for mine in map(self.kept, lipids))
        turned = max(min(abs(math.remainder(angle - b, 2 * math.pi)) for b in seen)
                     for lipid in lipids for angle, seen in zip(self.angles(lipid), angles))
        return off, math.degrees(turned)


code, output = lammps(open("in.patch").read(), args=["-var", "steps", 800 if not LONG else 5000])
claim("the example makes a patch", code == 0 and os.path.exists("patch.psf"), output[-300:] if code else "")
if "cannot read files of molecules" in error_of("units real\natom_style membrane_cp\nregion box block 0 1 0 1 0 1\n"
                                                "create_box 1 box\nmembrane_build patch patch.pdb out none\n"):
    skip("the package was compiled without gemmi")

patch = make_patch.read_places()
patch = [patch[i:i + BEADS] for i in range(0, len(patch), BEADS)]
middle = sum(x[2] for lipid in patch for x in lipid) / len(patch) / BEADS
heads = sum(abs(lipid[1][2] - middle) for lipid in patch) / len(patch)
FROM_PATCH = "patch patch.pdb psf patch.psf seed 1 "

# === Curved membranes

BOX = "-100 100 -100 100 -100 100"
SPHERE = "sphere 3 50 interpolate yes"
first = None
for ranks in (1, 2) if MPIEXEC else (1,):
    output = run(script(SPHERE, BOX, FROM_PATCH + f"format pdb,cif,gro,data,top out ball{ranks}"), ranks=ranks)
    files = {path.split(".")[1]: open(path).read() for path in glob.glob(f"ball{ranks}.*")}
    if first:
        same = [end for end in files if files[end] != first[end]]
        claim("    the same files from two ranks", not same and len(files) == 6, same)
        break
    first = files
    for leaflet in ("outer", "inner"):
        number, wanted = numbers_of(output, leaflet)
        claim(f"sphere, {leaflet} leaflet: as many lipids as the area asks for", abs(number - wanted) < 0.51, (number, wanted))
    claim("    at most 3 % of lipids have a pair closer than 0.8 of the closest in the patch", clashing(output) < 0.03, clashing(output))
    claim("    no pair closer than 1.5 A", closest(output) > 1.5, closest(output))
    claim("    the progress is shown", "relaxation 4 of 4" in output)
molecules, bonds = read_data("ball1.data")
count = len(molecules)
off, turned = Kind([bond[1:] for bond in make_patch.BONDS], BEADS).compare(molecules, patch)
claim("    every lipid has lengths, angles and handedness of one in the patch", off < 0.01, off)
claim("    torsions within 15 degrees of one in the patch", turned < 15.2, turned)
outer = numbers_of(output, "outer")[0] if not MPIEXEC else int(first["top"].split("DPPC")[1].split()[0])
wrong = [m for m, lipid in enumerate(molecules) if (math.hypot(*lipid[0]) > math.hypot(*lipid[7])) != (m < outer)]
claim("    heads outward on both leaflets, tails inward", not wrong, len(wrong))

output = run(script("cylinder 30 8 100 z interpolate yes", "-180 180 -180 180 -30 30", FROM_PATCH + "out tube"))
molecules, _ = read_data("tube.data")
outer, inner = (numbers_of(output, leaflet)[0] for leaflet in ("outer", "inner"))
for name, part in (("outer", molecules[:outer]), ("inner", molecules[outer:])):
    height = sum(abs(math.hypot(*lipid[1][:2]) - 100) for lipid in part) / len(part)
    claim(f"tube of 100 A: heads of the {name} leaflet within 1.5 A of their height in the patch", abs(height - heads) < 1.5,
          (height, heads))
    number, wanted = numbers_of(output, name)
    claim("    as many as the area asks for", abs(number - wanted) < 0.51, (number, wanted))
claim("    at most 3 % of lipids in a clash", clashing(output) < 0.03, clashing(output))

# === Lipids with hydrogens, which must bend

code, output = lammps(atom_patch.start())
claim("a patch with all atoms", code == 0 and os.path.exists("atoms.dump"), output[-300:] if code else "")
atoms = atom_patch.finish()
kind = Kind(atom_patch.BONDS, atom_patch.ATOMS)
for shape, box in (("plane 8 10", "-30 30 -30 30 -60 60"),) + (((SPHERE, BOX),) if LONG else ()):
    output = run(script(shape, box, "patch atoms.pdb psf atoms.psf overwrite yes out atoms_built"))
    claim(f"all atoms, {shape}: rigid lipids do not get out of each other's way, and bend", "bending 1 of " in output,
          report(output, "relaxation 4 of 4"))
    claim("    at most 3 % in a clash, no pair closer than 1.5 A",
          clashing(output) < 0.03 and closest(output) > 1.5, (clashing(output), closest(output)))
    claim("    no bonds through rings", "0 left" in report(output, "bonds through rings"), report(output, "bonds through rings"))
    molecules, _ = read_data("atoms_built.data")
    off, turned = kind.compare(molecules[::1 if len(molecules) < 200 else 7], atoms)
    claim("    every lipid has lengths, angles and handedness of one in the patch", off < 0.01, off)
    claim("    torsions within 15 degrees of one in the patch", turned < 15.2, turned)

# === A flat membrane that is no multiple of the patch: beads by height as in the patch

def profile(lipids, middle):
    """By kind of bead, numbered alike in all lipids, and slab of 2 A: beads a lipid, and the variance of that."""
    counts = {}
    for lipid in lipids:
        for bead, x in enumerate(lipid):
            place = (bead, math.floor((x[2] - middle) / 2))
            counts[place] = counts.get(place, 0) + 1
    number = len(lipids)
    return {place: (n / number, n * (1 - n / number) / number**2) for place, n in counts.items()}


output = run(script("plane 20 24", "-90 90 -90 90 -60 60", FROM_PATCH + "out plain"))
molecules, _ = read_data("plain.data")
claim("a plane that is no multiple of the patch", "copies of it" not in output and clashing(output) < 0.03, clashing(output))
outer = numbers_of(output, "outer")[0]
for name, mine, theirs in (("outer", molecules[:outer], [lipid for lipid in patch if lipid[1][2] > middle]),
                           ("inner", molecules[outer:], [lipid for lipid in patch if lipid[1][2] < middle])):
    built, of_patch = profile(mine, 0.0), profile(theirs, middle)
    chi, terms = 0.0, 0
    for place in set(built) | set(of_patch):
        (p, dp), (q, dq) = built.get(place, (0.0, 0.0)), of_patch.get(place, (0.0, 0.0))
        if len(theirs) * (p + q) > 10:    # too few to have an error
            chi += (p - q)**2 / (dp + dq)
            terms += 1
    claim(f"    {name} leaflet: beads of each kind by height as in the patch, within errors", chi < terms + 4 * math.sqrt(2 * terms),
          f"chi^2 {chi:.1f} of {terms}")
    height, theirs_too = (sum(lipid[1][2] - z for lipid in part) / len(part) for part, z in ((mine, 0.0), (theirs, middle)))
    claim("    heads within 1.5 A of their height", abs(height - theirs_too) < 1.5, (height, theirs_too))

if LONG:
    for shape, limit in (("sphere 4 100 interpolate yes", 0.03), ("torus 48 32 120 60 interpolate yes", 0.05),
                         ("torus 48 32 100 50 interpolate yes", 0.05), ("plane 24 28", 0.03)):
        box = "-100 100 -100 100 -60 60" if "plane" in shape else "-300 300 -300 300 -150 150"
        output = run(script(shape, box, FROM_PATCH + "overwrite yes out long"), timeout=3000)
        claim(f"{shape}: clashes within the limit", clashing(output) < limit and closest(output) > 1.5,
              (clashing(output), closest(output)))
        for leaflet in ("outer", "inner"):
            number, wanted = numbers_of(output, leaflet)
            claim("    as many as the area asks for", abs(number - wanted) < 0.51, (number, wanted))

# === What others read

def mdanalysis(*files):
    for python in (sys.executable, "/usr/bin/python3"):
        done = subprocess.run([python, os.path.join(HERE, "read_molecules.py"), *files], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True)
        if done.returncode == 0:
            return json.loads(done.stdout)
        if "No module named 'MDAnalysis'" not in done.stderr:
            print(done.stderr)
    return None


seen = mdanalysis("ball1.psf", "ball1.pdb")
if seen:
    claim("MDAnalysis reads PSF and PDB: atoms, residues, bonds and angles",
          (seen["atoms"], seen["residues"], seen["bonds"], seen["angles"]) == (12 * count, count, 11 * count, 8 * count), seen["atoms"])
    claim("    names and box", seen["names"] == make_patch.NAMES and seen["resnames"] == ["DPPC"] and
          seen["box"] == [200, 200, 200, 90, 90, 90], seen["box"])
    widest = max(math.dist(a, b) for lipid in patch for a, b in ((lipid[i], lipid[j]) for _, i, j in make_patch.BONDS))
    claim("    and bonds no longer than those of the patch", max(seen["lengths"]) < widest + 0.01, max(seen["lengths"]))
    read_first = seen["places"]
    for files, unit in ((("ball1.gro",), 1), (("ball1.data",), 1)):
        seen = mdanalysis(*files)
        shift = 100 if files[0].endswith("data") else 0
        off = max(abs(a + shift - b) for x, y in zip(seen["places"], read_first) for a, b in zip(x, y))
        off = min(off, 200) if files[0].endswith("gro") else min(abs(off), abs(off - 200))
        claim(f"    {files[0]} has the same places", seen["atoms"] == 12 * count and off < 0.01, off)
else:
    print("note   MDAnalysis is missing (Debian: python3-mdanalysis): files are read back by LAMMPS only")

run(open("in.buckle").read())
output = run(open("in.relax").read().replace("run             200", "run             0"), args=["-var", "name", "buckle"])
energies = [float(line.split()[2]) for line in output.split("\n") if len(line.split()) == 7 and line.split()[0] in ("0", "300")]
claim("LAMMPS reads the data file, and the structure relaxes", len(energies) >= 2 and energies[1] < 100 < energies[0], energies)

# === A small patch, and a plane of whole multiples of it

SIDE = 6
places = make_patch.lattice(SIDE)
SMALL = 2 * SIDE * SIDE
make_patch.finish(places, "small", SIDE, lambda m: "DPPC" if m % 4 else "DOPC")
PLANE, PLANE_BOX = "plane 16 18", "0 96 0 96 -40 40"
output = run(script(PLANE, PLANE_BOX, "patch small.pdb psf small.psf out plane"))
molecules, _ = read_data("plane.data")
claim("a plane of whole multiples has copies of the patch", "copies of it, unchanged" in output and len(molecules) == 4 * SMALL)


def distance(lipid, other):
    d = [minus(x, y) for x, y in zip(lipid, other)]
    d = [[v - 48 * round(v / 48) for v in x[:2]] + x[2:] for x in d]
    return max(max(abs(v) for v in minus(x, [0, 0, d[0][2]])) for x in d)


lipids = [places[i:i + BEADS] for i in range(0, len(places), BEADS)]
off = max(min(distance(lipid, other) for other in lipids) for lipid in molecules[::5])
claim("    each lipid is where one of the patch is", off < 0.002, off)
output = run(script(PLANE, PLANE_BOX, "patch small.pdb psf small.psf flip yes out flipped"))
claim("    turned over by flip", "copies of it" in output and
      open("flipped.pdb").read() != open("plane.pdb").read() and clashing(output) == 0)

# === Two patches, one membrane of two

make_patch.finish(places, "other", SIDE, lambda m: "POPG")
more = "create_membrane 1 sphere 2 40 center 0 0 0 molecule 2 interpolate yes\n"
code, output = lammps(script("sphere 3 120 interpolate yes", "-150 150 -150 150 -150 150",
                             "outer small.pdb inner other.pdb membrane 2 out second", more))
claim("one membrane of two", code == 0 and "membrane 2 outer" in output and "membrane 1 outer" not in output, output[-200:] if code else "")
claim("a patch for each leaflet", "POPG" in report(output, "inner leaflet:") and "POPG" not in report(output, "outer leaflet:"))

# === Units, restarts, composition, proteins

scaled = START.replace("units           real", "units lj").format(shape=PLANE, box="0 9.6 0 9.6 -4 4")
output = run(scaled + "membrane_build patch small.pdb psf small.psf scale 10 out scaled\n")
claim("units lj with a scale", open("scaled.pdb").read() == open("plane.pdb").read())
output = run(script(PLANE, "0 90 0 80 -40 40", "patch small.pdb psf small.psf overwrite yes out wavy",
                    "variable wave atom 6*cos(2*PI*x/lx)\nset type 1 z v_wave\nwrite_restart state\n"))
for leaflet in ("outer", "inner"):
    number, _ = numbers_of(output, leaflet)
    names = report(output, f"{leaflet} leaflet:").split("(")[1].split(")")[0]
    dopc = int(names.split(" DOPC")[0].split()[-1])
    claim(f"a quarter of the {leaflet} leaflet of a wavy sheet is DOPC", abs(dopc - number / 4) <= 1, names)
before = open("wavy.pdb").read()
run("read_restart state\nmembrane_build patch small.pdb psf small.psf overwrite yes out again\n", ranks=2 if MPIEXEC else 1)
claim("a restart file gives the same structure", open("again.pdb").read() == before)

with open("helix.pdb", "w") as file:
    for i in range(20):
        file.write(make_patch.pdb_line(i + 1, "CA", "LEU", "P", i + 1, (4 * math.cos(1.7 * i), 4 * math.sin(1.7 * i), 2 * (i - 9.5)), ""))
more = """
group points type 1
create_bound 2 2 points 11
group bound type 2
set type 2 mass 100
fix b bound hd/bind points
"""
output = run(script("sphere 3 40 interpolate yes", BOX, "patch small.pdb psf small.psf protein b helix.pdb out protein", more))
lines = [line for line in open("protein.pdb") if " LEU P" in line]
place = [[float(line[30 + 8 * k:38 + 8 * k]) - 100 for k in range(3)] for line in lines]
claim("a protein at each bound particle, lipids make room", len(lines) == 40 and "made room for proteins" in output, len(lines))
straight = max(abs(math.dist(place[i], place[i + 19]) - math.dist(
    (4, 0, -19), (4 * math.cos(1.7 * 19), 4 * math.sin(1.7 * 19), 19))) for i in (0, 20))
along = [math.hypot(*place[i + 19]) - math.hypot(*place[i]) for i in (0, 20)]
claim("    whole, along the normal", straight < 0.01 and all(abs(d - 38) < 2.5 for d in along), along)

# === Odd PDB files

TEXT = open("small.pdb").read()
LINES = TEXT.split("\n")
ATOMS = [line for line in LINES if line.startswith("ATOM")]


def built(text, name="odd"):
    """The report, or the error, of a build on the plane with a patch of this text."""
    with open(name + ".in.pdb", "w", newline="") as file:
        file.write(text)
    code, output = lammps(script(PLANE, PLANE_BOX, f"patch {name}.in.pdb overwrite yes out {name}"))
    lines = [line for line in output.split("\n") if line.startswith("ERROR")]
    return lines[0] if code else output


def same(text, what, note=""):
    output = built(text)
    fine = "copies of it" in output and f"{4 * SMALL} molecules" in output and note in output
    if fine:
        molecules, _ = read_data_without_bonds("odd.data")
        fine = max(min(distance(lipid, other) for other in lipids) for lipid in molecules[::31]) < 0.01
    claim(f"odd PDB: {what}", fine, "" if fine else output[-300:])


def read_data_without_bonds(path):
    with open(path, "a") as file:
        file.write("\nBonds\n\n1 1 1 2\n")
    return read_data(path)


def changed(change):
    return "\n".join(change(line) if line.startswith("ATOM") else line for line in LINES)


claim("odd PDB: no CRYST1", "CRYST1" in built("\n".join(LINES[1:])))
claim("odd PDB: box without volume", "no volume" in built(TEXT.replace("   48.000   48.000   90.000", "    0.000    0.000    0.000")))
half = len(ATOMS) // 2
claim("odd PDB: one leaflet only", "one leaflet only" in built("\n".join(LINES[:1] + ATOMS[:half] + ["END"])))
claim("odd PDB: a line cut short", "line 40" in built("\n".join(line[:50] if i == 39 else line for i, line in enumerate(LINES))))
claim("odd PDB: stars for a coordinate", "no number for y" in built(TEXT.replace(ATOMS[5], ATOMS[5][:38] + "********" + ATOMS[5][46:])))
same("\n".join(l + ("\nTER" if i % 12 == 0 and i else "") for i, l in enumerate(LINES[:-2])) + "\nCONECT    1    2\nCONECT    2    3    4\nEND\n",
     "TER after each lipid, and CONECT")
same(changed(lambda line: line[:76]), "no elements")
same(changed(lambda line: "atom  " + line[6:]), "lower case")
same(TEXT.replace("\n", "\r\n"), "CRLF")
same(changed(lambda line: line[:22] + f"{int(line[22:26]) // 3:4d}" + "ABC"[int(line[22:26]) % 3] + line[27:]), "insertion codes")
same(changed(lambda line: line[:22] + "   7 " + line[27:]), "all residues with one number")
same(changed(lambda line: line[:6] + "A" + f"{int(line[6:11]):04d}" + line[11:]), "hybrid-36 serials")
same(changed(lambda line: line[:22] + "A" + f"{int(line[22:26]):03d}" + line[26:]), "hybrid-36 residues")
same(changed(lambda line: "HETATM" + line[6:]), "HETATM")
same(LINES[0] + "\nMODEL        1\n" + "\n".join(ATOMS) + "\nENDMDL\nMODEL        2\n" + "\n".join(ATOMS) + "\nENDMDL\nEND\n", "two models",
     "of 2 models the first")
same(changed(lambda line: line[:46] + f"{(float(line[46:54]) + 40) % 90:8.3f}" + line[54:]), "lipids wrapped along z")
same(changed(lambda line: line[:16] + "A" + line[17:] + "\n" + line[:16] + "B" + line[17:30] + "   0.000" + line[38:]),
     "alternate places", "alternate places")
water = "".join(make_patch.pdb_line(5000 + i, "W", "W", " ", 500 + i, (8 * (i % 6), 8 * (i // 6), 44)) for i in range(36))
same("\n".join(LINES[:-2]) + "\n" + water + "END\n", "water", "left out: 36 W")

# === Bad input

def error(options, shape=PLANE, box=PLANE_BOX, **more):
    return error_of(script(shape, box, options), **more)


# === Kinds of lipids as they are on faces

with open("mixed.pdb", "w") as file:
    for line in open("patch.pdb"):
        name = "LIPA" if line[22:26].strip().isdigit() and int(line[22:26]) % 2 else "LIPB"
        file.write(line[:17] + name + line[21:] if line.startswith(("ATOM", "HETATM")) else line)


def kinds_of(path):
    """Of each lipid of a PDB file its leaflet, kind and height."""
    lipids = {}
    for line in open(path):
        if line.startswith(("ATOM", "HETATM")):
            entry = lipids.setdefault((line[21], line[22:26]), [line[21], line[17:21], []])
            entry[2].append(float(line[46:54]))
    chains = sorted({entry[0] for entry in lipids.values()})
    middle = sum(sum(z) / len(z) for _, _, z in lipids.values()) / len(lipids)    # the box of the file begins at 0
    return [(chains.index(chain), kind, sum(z) / len(z) - middle) for chain, kind, z in lipids.values()]


LIPIDS = """
pair_style      helfrich
pair_coeff      1 1 10.0 0.0 lipids NULL library LIPA 60 0.0 library LIPB 66 0.0 outer LIPA 1 LIPB 3 inner LIPA 3 LIPB 1
pair_coeff      2 2 10.0 0.0 lipids NULL library LIPA 60 0.0 library LIPB 66 0.0 outer LIPB 1 inner LIPA 1
region          top block INF INF INF INF 0 INF
set             region top type 2
"""
for how, more in (("pair_coeff", ""), ("fix hd/lipids", "fix x all hd/lipids 1 300.0 4711 global 1\nrun 0\n")):
    remove("kinds")
    output = run(script(SPHERE, BOX, "patch mixed.pdb composition from/lipids format pdb out kinds", LIPIDS + more))
    lipids = kinds_of("kinds.pdb")
    claim(f"composition from/lipids, of {how}", f"lipids are those of {how}" in output)
    for leaflet, kind, part in ((0, "LIPB", 0.75), (1, "LIPA", 0.75)):
        here = [(k, z) for l, k, z in lipids if l == leaflet]
        top, bottom = [k for k, z in here if z > 12], [k for k, z in here if z < -12]
        claim(f"    leaflet {leaflet}: one kind on the half that has one, and a mixture on the other",
              all(k == kind for k in top) and abs(bottom.count(kind) / len(bottom) - part) < 0.03,
              f"{bottom.count(kind)} of {len(bottom)}")
    for leaflet in ("outer", "inner"):
        number, wanted = numbers_of(output, leaflet)
        claim(f"    as many as fit: {leaflet}", abs(number - wanted) <= 0.5, f"{number} {wanted}")
claim("error: a lipid that no patch has", "no patch has the lipid LIPC; they have: LIP" in error_of(
    script(SPHERE, BOX, "patch mixed.pdb composition from/lipids out bad", LIPIDS.replace("LIPB", "LIPC"))))

remove("bad")
for options, expected in (
        ("patch none.pdb out bad", "cannot read none.pdb"),
        ("patch small.pdb", "needs out"),
        ("out bad", "needs a patch"),
        ("patch small.pdb inner small.pdb out bad", "needs a patch, or else"),
        ("inner small.pdb out bad", "needs a patch, or else"),
        ("patch small.pdb psf patch.psf out bad", "take the PSF of this structure"),
        ("patch small.pdb psf small.pdb out bad", "begins with the word PSF"),
        ("patch small.pdb composition from/lipids out bad", "say lipids in pair_coeff"),
        ("patch small.pdb composition POPC out bad", "from/patch or from/lipids"),
        ("patch small.pdb format xyz out bad", "not one of pdb"),
        ("patch small.pdb format psf out bad", "needs the PSF file"),
        ("patch small.pdb seed 0 out bad", "seed 0 must be positive"),
        ("patch small.pdb clash -1 out bad", "clash -1 must be positive"),
        ("patch small.pdb membrane 9 out bad", "membrane 9 does not exist"),
        ("patch small.pdb protein nofix helix.pdb out bad", "nofix"),
        ("patch small.pdb colour red out bad", "Unknown membrane_build keyword colour"),
        ("patch small.pdb out no/such/folder/bad", "cannot write no/such/folder/bad"),
        ("patch small.pdb out plane", "there is a file plane.pdb already"),
        ("patch helix.pdb out bad", "CRYST1")):
    line = error(options)
    claim(f"error: {options}", expected in line and not glob.glob("bad.*"), line)
claim("error: units of unknown length", "scale" in error_of(scaled + "membrane_build patch small.pdb out bad\n"))
line = error("patch small.pdb out bad", "sphere 2 15", BOX)
claim("error: a membrane too curved for the patch, and where", "radius of" in line and "near" in line, line)
line = error("patch small.pdb neutral 44.5 out bad", "sphere 2 45", "-100 100 -100 100 -100 100")
claim("error: a neutral surface beyond the middle of a sphere", "neutral surfaces of the inner leaflet are 44.5 from its middle" in line, line)
with open("small.psf") as file:
    psf = file.read()
with open("short.psf", "w") as file:
    file.write(psf[:len(psf) // 2])
line = error("patch small.pdb psf short.psf out bad")
claim("error: a PSF file cut short", "ends" in line or "needs number" in line or "too many" in line, line)
with open("named.psf", "w") as file:
    file.write(psf.replace("DOPC", "DLPC", 1))
claim("error: names that disagree", "atom 1 is NC3 of DLPC" in error("patch small.pdb psf named.psf out bad"))
line = error_of("units real\natom_style angle\nregion box block 0 1 0 1 0 1\ncreate_box 1 box\nmembrane_build patch a.pdb out bad\n")
claim("error: no membranes", "membrane_cp" in line, line)


def little_room():
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (60000, 60000))


before = open("plane.pdb").read()
with open("in.full", "w") as file:
    file.write(script(PLANE, PLANE_BOX, "patch small.pdb overwrite yes format data,pdb out plane"))
done = subprocess.run([LMP, "-in", "in.full", "-log", "none"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                      preexec_fn=little_room, env={**os.environ, "OMPI_MCA_btl_vader_backing_directory": "/dev/shm"})
left = glob.glob("*.part")
if "cannot write" in done.stdout or "ERROR" in done.stdout:
    claim("error: no room for the file; what was there is as it was",
          done.returncode != 0 and "cannot write plane" in done.stdout and not left and open("plane.pdb").read() == before,
          done.stdout[-300:])
else:
    print("note   this system does not limit the size of files so", done.returncode)
finish()
