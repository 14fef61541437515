"""A flat patch of lipids with all hydrogens, for test_molecules.py: a head with a ring, a tail on an ester, one with a double
bond, and a center with a handedness. The force field is as simple as can be, and there is no water.

    start()     writes atoms.start, lipids upright on a square lattice, and returns the script that melts them in LAMMPS
    finish()    makes atoms.pdb and atoms.psf of the places in atoms.dump, and returns the lipids
"""

import itertools
import math
import random

import make_patch
from vectors import cross, dihedral, dot, minus

SIDE = 5                 # lipids along each side of a leaflet
SPACING = 6.8            # Angstrom: 46 Angstrom^2 a lipid
HEIGHT = 80.0            # of the box
TAIL = 13                 # carbons in a row
TYPES, MASSES, SIGMAS = "CHO", (12.011, 1.008, 15.999), (3.3, 2.3, 2.9)


def unit(a):
    return [p / math.sqrt(dot(a, a)) for p in a]


def sum_of(*pairs):
    return [sum(factor * a[k] for factor, a in pairs) for k in range(3)]


class Lipid:
    """Its atoms, upright. The turns, dihedral angles near the center, bring the tails side by side."""

    def __init__(self, turns):
        head, first_a, first_b, second_b, skew = turns
        self.elements, self.x, self.bonds, self.flat = ["C", "C"], [[0, 0, 0], [1.53, 0, 0]], [(0, 1)], {}
        for element, turn in (("O", 0), ("C", 120)):
            self.place(element, 0, 1, [0, 1, 0], 1.45, 110, turn)
        ring = [self.place("C", 1, 0, self.x[2], 1.53, 112, head)]
        for k, turn in enumerate((180, 180, 55, -55, 55)):
            ring.append(self.place("C", ring[-1], ([0, 1] + ring)[k + 1], self.x[([0, 1] + ring)[k]], 1.53, 111, turn))
        self.bonds.append((ring[0], ring[-1]))
        acid = self.place("C", 2, 0, self.x[1], 1.35, 117, first_a)
        self.place("O", acid, 2, self.x[0], 1.21, 123, 0)
        self.flat[(2, acid)] = 180
        tails = [self.tail([0, 2, acid], TAIL * [180]),
                 self.tail([1, 0, 3], [first_b, second_b, 180, skew, 0, -skew] + (TAIL - 6) * [180])]
        self.ends = [(tail[2], tail[-1]) for tail in tails]
        self.flat[tuple(tails[1][5:7])] = 0
        flat = {acid, *tails[1][5:7]}
        for i in [i for i, element in enumerate(self.elements) if element == "C"]:
            self.add_hydrogens(i, i in flat)
        down = unit(sum_of(*((s, self.x[tail[k]]) for tail in self.ends for s, k in ((1, 1), (-1, 0)))))
        self.stand(down)

    def place(self, element, at, before, first, length, angle, turn):
        """A new atom, bonded to `at`: its dihedral angle with the place `first` and the atoms before it."""
        along = unit(minus(self.x[at], self.x[before]))
        normal = unit(cross(minus(self.x[before], first), along))
        angle, turn = math.radians(angle), math.radians(turn)
        self.x.append(sum_of((1, self.x[at]), (-length * math.cos(angle), along),
                             (length * math.sin(angle) * math.cos(turn), cross(normal, along)),
                             (length * math.sin(angle) * math.sin(turn), normal)))
        self.elements.append(element)
        self.bonds.append((at, len(self.x) - 1))
        return len(self.x) - 1

    def tail(self, chain, turns):
        """More carbons; the bond of a turn of 0 is a double one."""
        for k, turn in enumerate(turns):
            length, angle = 1.34 if 0 in turns[k + 1:k + 2] else 1.53, 125 if 0 in turns[k:k + 2] else 112
            chain.append(self.place("C", chain[-1], chain[-2], self.x[chain[-3]], length, angle, turn))
        return chain

    def near(self, i):
        return [a + b - i for a, b in self.bonds if i in (a, b)]

    def add_hydrogens(self, i, flat):
        to = [unit(minus(self.x[j], self.x[i])) for j in self.near(i)]
        back = unit(sum_of(*((-1, u) for u in to)))
        if flat or len(to) == 3:
            ways = [back] if len(to) == (2 if flat else 3) else []
        elif len(to) == 2:
            side = unit(cross(*to))
            ways = [sum_of((0.58, back), (0.815 * s, side)) for s in (1, -1)]
        else:
            other = next(j for j in self.near(self.near(i)[0]) if j != i)
            side = unit(cross(to[0], minus(self.x[other], self.x[i])))
            third = cross(to[0], side)
            ways = [sum_of((0.33, back), (0.943 * math.cos(t), third), (0.943 * math.sin(t), side))
                    for t in (math.pi / 3, math.pi, -math.pi / 3)]
        for way in ways:
            self.x.append(sum_of((1, self.x[i]), (1.09, way)))
            self.elements.append("H")
            self.bonds.append((i, len(self.x) - 1))

    def stand(self, down):
        """Turned so that this direction is down, the lowest atom 1.5 above the middle."""
        side = unit(cross(down, [0.3, 0.5, 0.8]))
        frame = [side, cross(side, down), [-c for c in down]]
        self.x = [[dot(row, x) for row in frame] for x in self.x]
        for k, shift in enumerate([sum(x[k] for x in self.x) / len(self.x) for k in (0, 1)] + [min(x[2] for x in self.x) - 1.5]):
            for x in self.x:
                x[k] -= shift

    def angles(self):
        return [(i, j, k) for j in range(len(self.x)) for i, k in itertools.combinations(self.near(j), 2)]

    def dihedrals(self):
        """Of heavy atoms, one a bond: kind 1 has three wells, 2 is trans, 3 is cis."""
        found = []
        heavy = [[j for j in self.near(i) if self.elements[j] != "H"] for i in range(len(self.x))]
        for i, j in self.bonds:
            before, after = [k for k in heavy[i] if k != j], [k for k in heavy[j] if k != i]
            if self.elements[j] != "H" and before and after:
                kind = {180: 2, 0: 3}.get(self.flat.get((i, j)), 1)
                after.sort(key=lambda k: self.elements[k] == "O")    # of the acid, the chain
                found.append((kind, before[0], i, j, after[0]))
        return found

    def badness(self):
        near = {frozenset(bond) for bond in self.bonds} | {frozenset((i, k)) for i, _, k in self.angles()}
        close = sum(max(0.0, 2.3 - math.dist(self.x[i], self.x[j])) for i, j in itertools.combinations(range(len(self.x)), 2)
                    if frozenset((i, j)) not in near)
        a, b = (unit(minus(self.x[last], self.x[first])) for first, last in self.ends)
        return close - dot(a, b) + 0.2 * max(math.hypot(*x[:2]) for x in self.x)


LIPID = min((Lipid(turns) for turns in itertools.product((60, 180), (90, 180), (60, 180, -60), (60, 180, -60), (115, -115))),
            key=Lipid.badness)
ATOMS = len(LIPID.x)
BONDS, ANGLES, DIHEDRALS = LIPID.bonds, LIPID.angles(), LIPID.dihedrals()
NAMES = [element + str(LIPID.elements[:i].count(element) + 1) for i, element in enumerate(LIPID.elements)]


def start():
    random.seed(2)
    lipids, width = 2 * SIDE * SIDE, SIDE * SPACING
    terms = [("Bonds", [(k + 1, *bond) for k, bond in enumerate(BONDS)]), ("Angles", [(k + 1, *angle) for k, angle in enumerate(ANGLES)]),
             ("Dihedrals", DIHEDRALS)]
    with open("atoms.start", "w") as file:
        file.write(f"lipids on a lattice\n\n{ATOMS * lipids} atoms\n{len(BONDS) * lipids} bonds\n{len(ANGLES) * lipids} angles\n"
                   f"{len(DIHEDRALS) * lipids} dihedrals\n3 atom types\n{len(BONDS)} bond types\n{len(ANGLES)} angle types\n"
                   f"3 dihedral types\n0 {width} xlo xhi\n0 {width} ylo yhi\n{-HEIGHT / 2} {HEIGHT / 2} zlo zhi\n\nMasses\n\n")
        file.writelines(f"{t + 1} {mass}\n" for t, mass in enumerate(MASSES))
        file.write("\nAtoms # molecular\n\n")
        for m in range(lipids):
            up, turn = 1 if m < SIDE * SIDE else -1, random.uniform(0, 2 * math.pi)
            c, s = math.cos(turn), math.sin(turn)
            for i, (x, y, z) in enumerate(LIPID.x):
                place = ((m % SIDE + 0.5) * SPACING + x * c - y * s, (m // SIDE % SIDE + 0.5) * SPACING + up * (x * s + y * c), up * z)
                file.write(f"{m * ATOMS + i + 1} {m + 1} {TYPES.index(LIPID.elements[i]) + 1} {place[0]:.4f} {place[1]:.4f} {place[2]:.4f}\n")
        for title, rows in terms:
            file.write(f"\n{title}\n\n")
            for m in range(lipids):
                for k, (kind, *atoms) in enumerate(rows):
                    file.write(f"{m * len(rows) + k + 1} {kind} {' '.join(str(m * ATOMS + i + 1) for i in atoms)}\n")

    pairs = [(a, b, 0.5 * (SIGMAS[a] + SIGMAS[b])) for a in range(3) for b in range(a, 3)]
    rest = [f"bond_coeff {k + 1} 300 {math.dist(LIPID.x[i], LIPID.x[j]):.4f}" for k, (i, j) in enumerate(BONDS)]
    for k, (i, j, l) in enumerate(ANGLES):
        cosine = dot(unit(minus(LIPID.x[i], LIPID.x[j])), unit(minus(LIPID.x[l], LIPID.x[j])))
        rest.append(f"angle_coeff {k + 1} 60 {math.degrees(math.acos(cosine)):.3f}")
    bonded = "\n".join(rest)
    hard = "\n".join(f"pair_coeff {a + 1} {b + 1} 0.07 {sigma} {2 ** (1 / 6) * sigma}" for a, b, sigma in pairs)
    return f"""
units           real
atom_style      molecular
pair_style      soft 2.5
bond_style      harmonic
angle_style     harmonic
dihedral_style  harmonic
special_bonds   lj 0 0 0
read_data       atoms.start
dihedral_coeff  1 1.4 1 3
dihedral_coeff  2 8 1 1
dihedral_coeff  3 8 -1 1
pair_coeff      * * 20
variable        push equal ramp(0,30)
fix             push all adapt 1 pair soft a * * v_push
fix             1 all nve/limit 0.1
fix             2 all langevin 600 600 100 4711
fix             3 all spring/self 0.01 z
neighbor        1.5 bin
{bonded}
timestep        1
thermo          500
run             1000
unfix           push
pair_style      lj/cut 4
pair_modify     shift yes
{hard}
run             4000
fix             2 all langevin 310 310 100 4711
run             2000
write_dump      all custom atoms.dump id xu yu zu
"""


def finish():
    x, width = make_patch.read_places("atoms.dump"), SIDE * SPACING
    lipids = len(x) // ATOMS
    with open("atoms.pdb", "w") as file:
        file.write(f"CRYST1{width:9.3f}{width:9.3f}{HEIGHT:9.3f}  90.00  90.00  90.00 P 1           1\n")
        for i, (a, b, c) in enumerate(x):
            file.write(make_patch.pdb_line(i + 1, NAMES[i % ATOMS], "LIPD", "A", i // ATOMS + 1, (a % width, b % width, c),
                                           element=LIPID.elements[i % ATOMS]))
        file.write("END\n")
    with open("atoms.psf", "w") as file:
        file.write(f"PSF\n\n       1 !NTITLE\n REMARKS PATCH OF LIPIDS\n\n{len(x):8d} !NATOM\n")
        for i in range(len(x)):
            element = LIPID.elements[i % ATOMS]
            file.write(f"{i + 1:8d} MEMB {i // ATOMS + 1:<4d} LIPD {NAMES[i % ATOMS]:<4s} {element:<4s}"
                       f" {0:10.6f} {MASSES[TYPES.index(element)]:13.4f} {0:11d}\n")
        for title, terms, in_a_line in (("!NBOND: bonds", BONDS, 4), ("!NTHETA: angles", ANGLES, 3),
                                        ("!NPHI: dihedrals", [term[1:] for term in DIHEDRALS], 2), ("!NIMPHI: impropers", (), 2)):
            rows = [[m * ATOMS + i + 1 for i in atoms] for m in range(lipids) for atoms in terms]
            file.write(f"\n{len(rows):8d} {title}\n")
            for k in range(0, len(rows), in_a_line):
                file.write("".join(f"{i:8d}" for row in rows[k:k + in_a_line] for i in row) + "\n")
    return [x[i:i + ATOMS] for i in range(0, len(x), ATOMS)]
