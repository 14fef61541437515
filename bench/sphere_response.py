#!/usr/bin/env python3
"""Undulations of a sphere of few points at low temperature, exactly: what unittest/scripts/test_spectrum_sphere.py
compares simulations with.

  bench/sphere_response.py [--lmp build/lmp] [--level 2] [--mesh FILE] [--lmax 4] [--c0 0] [--terms "regularize 0.01"]

A sphere, an icosphere or that of a file, is relaxed, the Hessian H of its energy and the derivatives a of each amplitude u_lm of compute hd/modes taken by
differences, and the mean square of harmonic undulations is <u_lm^2> = kT a.H^-1 a. Printed for each l, the mean over
m: that for kT = kc = 1, and its ratio to 1/((l-1)(l+2)(l(l+1)+s)), theory for a continuous sphere with R = 1 and
s = tension/kc - 2 c0 + c0^2/2. 642 points up to l = 8 take some minutes."""

import argparse
import math
import operator
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
STEP = 1e-5
SPHERE = """
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
create_box      1 box angle/types 1
create_membrane 1 {shape}
special_bonds   lj/coul 1 1 1
pair_style      helfrich
pair_coeff      1 1 1.0 {c0} volume 1000.0 {volume!r} {terms}
thermo_modify   norm no format float %.15g
"""
RELAX = """
min_style       membrane
minimize        0 1e-11 2000 20000
write_dump      all custom rest.dump id x y z modify sort id format float %.17g
"""
RESPOND = """
compute         m all hd/modes sphere {lmax}
thermo_style    custom step {columns}
thermo          1
dump            d all custom 1 forces.dump id fx fy fz
dump_modify     d sort id format float %.15g
rerun           displaced.dump dump x y z
"""


def run(lmp, script, folder):
    done = subprocess.run([os.path.abspath(lmp), "-log", "none"], input=script, capture_output=True, text=True, cwd=folder)
    if done.returncode:
        sys.exit(done.stdout + "\nthis failed")
    return done.stdout


def frames(path):
    """Each frame of a dump as one list, x, y, z of atom 1 first."""
    with open(path) as file:
        while header := file.readline():
            if header.startswith("ITEM: NUMBER"):
                count = int(file.readline())
            elif header.startswith("ITEM: ATOMS"):
                yield [float(word) for _ in range(count) for word in file.readline().split()[1:]]


def write_displaced(path, rest):
    """One coordinate after the other, up and down."""
    head = "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS pp pp pp\n-3 3\n-3 3\n-3 3\nITEM: ATOMS id x y z\n"
    with open(path, "w") as file:
        for i in range(len(rest)):
            for step, shift in ((2 * i, STEP), (2 * i + 1, -STEP)):
                x = rest[:i] + [rest[i] + shift] + rest[i + 1:]
                file.write(head.format(step, len(x) // 3))
                file.writelines("%d %.17g %.17g %.17g\n" % (k // 3 + 1, *x[k:k + 3]) for k in range(0, len(x), 3))


def dot(a, b):
    return sum(map(operator.mul, a, b))


def rigid_motions(rest):
    """Orthogonal since the sphere is centred, of length 1."""
    result = []
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        move, turn = [0.0] * len(rest), [0.0] * len(rest)
        for p in range(0, len(rest), 3):
            move[p + k] = 1.0
            turn[p + i], turn[p + j] = -rest[p + j], rest[p + i]
        result += [move, turn]
    return [[x / math.sqrt(dot(row, row)) for x in row] for row in result]


def cholesky(matrix):
    """Rows of the lower triangle."""
    rows = []
    for i, line in enumerate(matrix):
        row = []
        for j in range(i):
            row.append((line[j] - dot(row, rows[j])) / rows[j][j])
        row.append(math.sqrt(line[i] - dot(row, row)))
        rows.append(row)
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lmp", default=os.path.join(HERE, "..", "build", "lmp"))
    parser.add_argument("--level", type=int, default=2)
    parser.add_argument("--mesh", help="of radius 1, in place of an icosphere")
    parser.add_argument("--lmax", type=int, default=4)
    parser.add_argument("--c0", type=float, default=0.0)
    parser.add_argument("--terms", default="regularize 0.01")
    options = parser.parse_args()
    shape = f"file {os.path.abspath(options.mesh)}" if options.mesh else f"sphere {options.level} 1.0 interpolate yes"
    sphere = SPHERE.format(shape=shape, c0=options.c0, terms=options.terms, volume=4 * math.pi / 3)
    columns = [f"c_m[{row}][4]" for row in range(1, (options.lmax + 1) ** 2 + 1)]

    with tempfile.TemporaryDirectory() as folder:
        run(options.lmp, sphere + RELAX, folder)
        rest = next(frames(os.path.join(folder, "rest.dump")))
        write_displaced(os.path.join(folder, "displaced.dump"), rest)
        output = run(options.lmp, sphere + RESPOND.format(lmax=options.lmax, columns=" ".join(columns)), folder)
        forces = frames(os.path.join(folder, "forces.dump"))
        hessian = [[(b - a) / (2 * STEP) for a, b in zip(up, next(forces))] for up in forces]
    table = output.split("Step ")[-1].split("Loop time")[0].splitlines()[1:]
    modes = [[float(word) for word in line.split()[1:]] for line in table if len(line.split()) == len(columns) + 1]
    slopes = [[(a - b) / (2 * STEP) for a, b in zip(up, down)] for up, down in zip(modes[::2], modes[1::2])]

    stiff = max(row[i] for i, row in enumerate(hessian))
    motions = rigid_motions(rest)    # no force resists these, and no amplitude of l = 2 or more sees them
    for i, row in enumerate(hessian):
        for j in range(i + 1):
            row[j] = 0.5 * (row[j] + hessian[j][i]) + stiff * sum(motion[i] * motion[j] for motion in motions)
    factor = cholesky(hessian)

    for l in range(2, options.lmax + 1):
        power = 0.0
        for mode in range(l * l, (l + 1) ** 2):
            solution = []
            for i, row in enumerate(factor):
                solution.append((slopes[i][mode] - dot(row, solution)) / row[i])
            power += dot(solution, solution) / (2 * l + 1)
        words = options.terms.split()
        tension = float(words[words.index("tension") + 1]) if "tension" in words else 0.0
        s = tension - 2 * options.c0 + 0.5 * options.c0 ** 2
        print(f"l = {l}: {power:.6g}, {power * (l - 1) * (l + 2) * (l * (l + 1) + s):.5f} of theory", flush=True)


if __name__ == "__main__":
    main()
