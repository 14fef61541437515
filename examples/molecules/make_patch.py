#!/usr/bin/env python3
"""A flat patch of coarse-grained lipids, twelve beads each, for in.patch:

    make_patch.py start     writes patch.start, lipids upright on a square lattice, for LAMMPS to melt
    make_patch.py finish    makes patch.pdb and patch.psf of the places in patch.dump

The model is as simple as can be: beads of one size, bonds and angles as in Martini lipids, and no water."""

import math
import random
import sys

SIDE = 12                # lipids along each side of a leaflet
SPACING = 8.0            # Angstrom: 64 Angstrom^2 a lipid
HEIGHT = 90.0            # of the box
NAMES = "NC3 PO4 GL1 GL2 C1A C2A C3A C4A C1B C2B C3B C4B".split()
TYPES = [1, 2, 3, 3] + 8 * [4]
TYPE_NAMES = ("NC", "PO", "GL", "C")
CHARGES = (1.0, -1.0, 0.0, 0.0)
Z = (24, 20, 16, 16, 12.5, 9, 5.5, 2.5, 12.5, 9, 5.5, 2.5)
X = (-0.7, -0.7, -1.7, 2.0, -1.9, -1.9, -1.9, -1.9, 2.0, 2.0, 2.0, 2.0)
BONDS = ((1, 0, 1), (1, 1, 2), (2, 2, 3), (1, 2, 4), (1, 4, 5), (1, 5, 6), (1, 6, 7), (1, 3, 8), (1, 8, 9), (1, 9, 10), (1, 10, 11))
ANGLES = ((2, 1, 2, 3), (1, 1, 2, 4), (1, 2, 4, 5), (1, 4, 5, 6), (1, 5, 6, 7), (1, 3, 8, 9), (1, 8, 9, 10), (1, 9, 10, 11))


def lattice(side):
    """Places of lipids upright, each turned at random."""
    random.seed(1)
    places = []
    for m in range(2 * side * side):
        up = 1 if m < side * side else -1
        turn = random.uniform(0, 2 * math.pi)
        middle = [(m % side + 0.5) * SPACING, (m // side % side + 0.5) * SPACING]
        for x, z in zip(X, Z):
            place = (middle[0] + x * math.cos(turn), middle[1] + up * x * math.sin(turn), up * z)
            places.append([value + random.gauss(0, 0.2) for value in place])
    return places


def start(path="patch.start", side=SIDE):
    lipids, beads = 2 * side * side, len(NAMES)
    with open(path, "w") as file:
        file.write(f"lipids on a lattice\n\n{beads * lipids} atoms\n{len(BONDS) * lipids} bonds\n{len(ANGLES) * lipids} angles\n"
                   f"4 atom types\n2 bond types\n2 angle types\n0 {side * SPACING} xlo xhi\n0 {side * SPACING} ylo yhi\n"
                   f"{-HEIGHT / 2} {HEIGHT / 2} zlo zhi\n\nMasses\n\n")
        file.writelines(f"{t + 1} 72 # {name}\n" for t, name in enumerate(TYPE_NAMES))
        file.write("\nAtoms # molecular\n\n")
        for i, x in enumerate(lattice(side)):
            file.write(f"{i + 1} {i // beads + 1} {TYPES[i % beads]} {x[0]:.4f} {x[1]:.4f} {x[2]:.4f}\n")
        for title, terms in (("Bonds", BONDS), ("Angles", ANGLES)):
            file.write(f"\n{title}\n\n")
            for m in range(lipids):
                for k, (kind, *atoms) in enumerate(terms):
                    file.write(f"{m * len(terms) + k + 1} {kind} {' '.join(str(m * beads + i + 1) for i in atoms)}\n")


def read_places(path="patch.dump"):
    """Unwrapped places in the order of atom IDs, from a dump of id xu yu zu."""
    lines = open(path).read().split("\n")
    first = next(i for i, line in enumerate(lines) if line.startswith("ITEM: ATOMS")) + 1
    rows = sorted([float(word) for word in line.split()] for line in lines[first:] if line)
    return [row[1:4] for row in rows]


def pdb_line(serial, name, residue, chain, number, x, segment="MEMB", record="ATOM  ", element=""):
    padded = " " + name if len(name) < 4 else name
    return (f"{record}{serial:5d} {padded:<4s} {residue:<4s}{chain}{number:4d}    {x[0]:8.3f}{x[1]:8.3f}{x[2]:8.3f}"
            f"  1.00  0.00      {segment:<4s}{element:>2s}\n")


def finish(x, name="patch", side=SIDE, residues=lambda m: "DPPC"):
    """Atoms are wrapped in the plane, as simulations leave them."""
    beads, width = len(NAMES), side * SPACING
    lipids = len(x) // beads
    with open(name + ".pdb", "w") as file:
        file.write(f"CRYST1{width:9.3f}{width:9.3f}{HEIGHT:9.3f}  90.00  90.00  90.00 P 1           1\n")
        for i, (a, b, c) in enumerate(x):
            m = i // beads
            file.write(pdb_line(i + 1, NAMES[i % beads], residues(m), "A", m + 1, (a % width, b % width, c)))
        file.write("END\n")
    with open(name + ".psf", "w") as file:
        file.write(f"PSF\n\n       1 !NTITLE\n REMARKS PATCH OF LIPIDS\n\n{len(x):8d} !NATOM\n")
        for i in range(len(x)):
            m, kind = i // beads, TYPES[i % beads] - 1
            file.write(f"{i + 1:8d} MEMB {m + 1:<4d} {residues(m):<4s} {NAMES[i % beads]:<4s} {TYPE_NAMES[kind]:<4s}"
                       f" {CHARGES[kind]:10.6f} {72.0:13.4f} {0:11d}\n")
        for title, terms, in_a_line in (("!NBOND: bonds", BONDS, 4), ("!NTHETA: angles", ANGLES, 3),
                                        ("!NPHI: dihedrals", (), 2), ("!NIMPHI: impropers", (), 2)):
            rows = [[m * beads + i + 1 for i in atoms] for m in range(lipids) for _, *atoms in terms]
            file.write(f"\n{len(rows):8d} {title}\n")
            for k in range(0, len(rows), in_a_line):
                file.write("".join(f"{i:8d}" for row in rows[k:k + in_a_line] for i in row) + "\n")


if __name__ == "__main__":
    if sys.argv[1] == "start":
        start()
    else:
        finish(read_places())
