"""Modes in place of control points: equilibrium at kc = 20 kT. Each mode has its share of energy, whatever the integrator,
and small undulations have the powers of theory.

    MEMBRANE_LONG=1    twenty times the steps
"""
# cost: 25
# timeout: 7200

import math

from lammps_claims import LONG, claim, finish, run

MANY = 20 if LONG else 1
SIGMAS = 4.0
BLOCKS = 25

VESICLE = """
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
create_box      1 box angle/types 1
create_membrane 1 sphere 1 1.0 interpolate yes mass 3.9
pair_style      helfrich
pair_coeff      1 1 20.0 0.0 {terms}
"""
SHEET = """
units           lj
atom_style      membrane_cp
region          box block 0 12 0 10.392304845413264 -6 6
create_box      1 box angle/types 1
create_membrane 1 plane 12 12
pair_style      helfrich
pair_coeff      1 1 20.0 0.0 {terms}
"""
RUN = """
fix             1 all {fix}
compute         T all hd/temp
timestep        {dt}
run             {warm}
fix             2 all ave/time {every} 1 {every} f_1[1] f_1[2] f_1[4] f_1[5] f_1[8] f_1[9] mode vector file modes.dat
compute_modify  T dynamic/dof yes
fix             3 all ave/time {every} 1 {every} c_T file temp.dat
run             {steps}
"""


def samples(path):
    """Tables [sample][mode][column] of fix ave/time in mode vector."""
    tables = []
    with open(path) as file:
        for line in file:
            words = line.split()
            if line.startswith("#"):
                continue
            if len(words) == 2:
                tables.append([])
            else:
                tables[-1].append([float(word) for word in words[1:]])
    return tables


def mean_and_error(series):
    """Of a correlated series, from means of blocks."""
    n = len(series) // BLOCKS
    means = [sum(series[b * n:(b + 1) * n]) / n for b in range(BLOCKS)]
    mean = sum(means) / BLOCKS
    return mean, math.sqrt(sum((m - mean) ** 2 for m in means) / BLOCKS / (BLOCKS - 1))


def agrees(text, series, theory, precision=0.0):
    mean, error = mean_and_error(series)
    off = mean / theory - 1
    claim(text, abs(off) < SIGMAS * error / theory + precision, f"{100 * off:+.2f} +- {100 * error / theory:.2f} %")


def study(name, scene, fix, dt, steps, every, terms="", pairs=1, kinetic=True):
    run(scene.format(terms=terms) + RUN.format(fix=fix, dt=dt, warm=steps // 20, steps=MANY * steps, every=every))
    tables = samples("modes.dat")
    labels = [int(max(abs(row[0]), 0 if pairs == 1 else abs(row[1]))) for row in tables[0]]
    for label in sorted(set(labels)):
        chosen = [i for i, other in enumerate(labels) if other == label]
        share = [sum(table[i][5] for i in chosen) / len(chosen) / pairs for table in tables]
        agrees(f"{name}: modes of number {label} have kT/2 of potential energy each", share, 0.5)
    worst = 0.0
    for i in range(len(labels)):
        mean, error = mean_and_error([table[i][5] / pairs for table in tables])
        worst = max(worst, abs(mean - 0.5) / error)
    claim(f"{name}: so has each of {len(labels)} by itself", worst < SIGMAS + 1.0, f"worst {worst:.1f} errors")
    if kinetic:
        agrees(f"{name}: and kT/2 of kinetic energy",
               [sum(row[4] for row in table) / len(table) / pairs for table in tables], 0.5, 0.01)
        with open("temp.dat") as file:
            temperatures = [float(line.split()[1]) for line in file if not line.startswith("#")]
        agrees(f"{name}: compute hd/temp counts the modes", temperatures, 1.0, 0.01)
    return tables


# 42 vertices of mass 3.9: l = 2 to 4 have frequencies of 6 to 23. So coarse a mesh has other powers than a sphere, but kT/2
# is that of any energy

study("hd/langevin, vesicle", VESICLE, "hd/langevin 1.0 1.0 0.15 4711 modes sphere min 2 max 4", 0.01, 40000, 10)
study("hd/langevin relax eta, vesicle with fixed volume and tension", VESICLE,
      "hd/langevin 1.0 1.0 NULL 4711 modes sphere min 0 max 4 relax eta 5.0", 0.01, 40000, 10,
      "tension 5.0 volume 2000 init")
tables = study("hd/brownian relax eta, sheet", SHEET, "hd/brownian 1.0 4711 modes plane min 1 max 2 relax eta 1.0",
               0.02 if LONG else 0.04, 20000, 20, pairs=2, kinetic=False)    # the largest of 1e8 moves is beyond 1/4 of an edge
area, q = 12 * 10.392304845413264, 2 * math.pi / 12
row = [i for i, entry in enumerate(tables[0]) if entry[:2] == [1.0, 0.0]][0]
agrees("hd/brownian, sheet: the wave (1, 0) has the power of theory within 8 % and its error",    # others soften it
       [table[row][2] ** 2 + table[row][3] ** 2 for table in tables], 1 / (area * 20 * q ** 4), 0.08)
finish()
