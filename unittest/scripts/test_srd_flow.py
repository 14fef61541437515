"""fix srd/mesh: flow between plates, which are walls of the box or flat membranes that are held.

Between plates at z = +-H a force g on each unit of mass makes Poiseuille's flow, and plates that move at +-U
Couette's,

    v = g/(2 nu) (H^2 - z^2 + 2 b H),    v = U z/(H + b).

b is the slip length, the distance beyond a plate at which the flow, continued, has the plate's velocity. The
curvature gives the viscosity, nu = eta/rho. Both are fitted to what is farther from the plates than 1.5 cells, more
than a cell of the shifted grid reaches, and three mean free paths more if they are of the size of a cell. Errors
are those of 16 blocks of the run, each several times the 4 H^2/(pi^2 nu) in which a flow forgets.

Limits: for slip a tenth of a cell, since solvent knows no structure that is smaller than a cell; for the viscosity
the 2 % within which kinetic theory holds without plates (test_srd_viscosity.py). At a mean free path of 1 it is
printed only: there stress lives in the velocities of particles, and the thermostat, which the formula knows nothing
of, makes a cell forget the part 1/(k + 1), k = 3 (N - 1)/2, of it at each collision.

    MEMBRANE_LONG=1    more flows, and each for six to ten times as long
"""
# cost: 40
# timeout: 3600

import math

from lammps_claims import LONG, claim, finish, run, thermo

BLOCKS, BIN, APART = 16, 0.5, 1.5
NX, LY, NY = 8, 7, 8    # of a sheet; faces nearly equilateral

SCRIPT = """
units           lj
atom_style      membrane_cp
boundary        p p {side}
region          box block 0 {NX} 0 {LY} {lo} {hi}
create_box      2 box angle/types 1
{sheets}
create_solvent  2 both {M} 8341
group           solvent type 2
fix             srd solvent srd/mesh 1 {membrane} 1.0 1.0 4711 angle {angle} shift yes 9127 tstat yes &
                collision noslip wall noslip {moving}
{drive}
compute         z solvent chunk/atom bin/1d z lower {BIN} units box
timestep        {dt}
thermo_style    custom step f_srd[1] f_srd[3] f_srd[10]
thermo_modify   norm no format float %.9g
thermo          {steps}
run             {steps}
{reset}
fix             p solvent ave/chunk {every} {samples} {steps} z vx norm all file profile.txt format " %.9g"
run             $({BLOCKS}*{steps})
"""

# Held or moved, a sheet takes part in collisions of cells as point masses, each on either side by chance. With
# the mass of a layer of solvent one cell thick the two sides of a cut cell have on average the mass of a whole one
SHEETS = """
create_membrane 1 plane {NX} {NY} center 0 0 {low} mass {mass}
create_membrane 1 plane {NX} {NY} center 0 0 {high} mass {mass}
group           membrane type 1
group           lower molecule 1
group           upper molecule 2
pair_style      helfrich
pair_coeff      1 1 100.0 0.0
"""


def read_profile(path):
    """Blocks of a fix ave/chunk file: {position: velocity} each."""
    blocks, missing = [], 0
    for words in (line.split() for line in open(path) if not line.startswith("#")):
        if missing:
            blocks[-1][float(words[1])] = float(words[3])
            missing -= 1
        else:
            blocks.append({})
            missing = int(words[1])
    return blocks


def flow(kind, plates, M, angle, dt, H, steps, push=0.0, speed=0.0):
    """Blocks of the profile over z = -H ... H, and rows of thermo output."""
    walls = plates == "walls"
    low, high = (-H, H) if walls else (-2 * H, 2 * H)
    sheets = moving = drive = ""
    reset = "reset_timestep 0"
    if not walls:
        sheets = SHEETS.format(NX=NX, NY=NY, low=-H, high=H, mass=M * LY / NY)
    if kind == "Poiseuille":
        drive = f"fix g solvent addforce {push} 0 0"
    elif walls:
        moving = f"wall/velocity zlo {-speed} 0 0 wall/velocity zhi {speed} 0 0"
    else:
        reset = ""    # to fix move the step is the time
        drive = f"fix low lower move linear {-speed} 0 0\nfix high upper move linear {speed} 0 0"
    every = max(1, round(1 / dt))
    steps = max(1, round(steps / every)) * every
    rows = thermo(run(SCRIPT.format(side="f" if walls else "p", lo=low, hi=high, NX=NX, LY=LY, M=M, sheets=sheets,
                                    membrane="NULL" if walls else "membrane", angle=angle, moving=moving, drive=drive,
                                    reset=reset, BIN=BIN, dt=dt, steps=steps, every=every, samples=steps // every,
                                    BLOCKS=BLOCKS), timeout=3600))
    blocks = read_profile("profile.txt")
    if not walls:    # what is outside of the sheets is a second channel, a mirror image of the first
        blocks = [{z: 0.5 * (v + block[2 * H - z if z > 0 else -2 * H - z]) for z, v in block.items() if abs(z) < H}
                  for block in blocks]
    return blocks, rows


def line(points):
    """Intercept and slope of the straight line through points."""
    n = len(points)
    mx, my = sum(x for x, _ in points) / n, sum(y for _, y in points) / n
    slope = sum((x - mx) * (y - my) for x, y in points) / sum((x - mx) ** 2 for x, _ in points)
    return my - slope * mx, slope


def fit(kind, block, H, push, speed, away):
    """Slip length, and kinematic viscosity of Poiseuille's flow."""
    inner = [(z, v) for z, v in block.items() if abs(z) < H - away]
    if kind == "Poiseuille":
        top, curve = line([(z * z + BIN * BIN / 12, v) for z, v in inner])    # mean over a bin
        return (top + curve * H * H) / (-2 * curve * H), -push / (2 * curve)
    slope = sum(z * v for z, v in inner) / sum(z * z for z, _ in inner)
    return speed / slope - H, None


def mean_block(blocks):
    return {z: sum(block[z] for block in blocks) / len(blocks) for z in blocks[0]}


def fit_with_errors(kind, blocks, *args):
    """Of the mean profile; errors by leaving out one block at a time."""
    n = len(blocks)
    best = fit(kind, mean_block(blocks), *args)
    left = [fit(kind, mean_block(blocks[:i] + blocks[i + 1:]), *args) for i in range(n)]
    return [(x, math.sqrt((n - 1) / n * sum((y[k] - sum(z[k] for z in left) / n) ** 2 for y in left)))
            for k, x in enumerate(best) if x is not None]

# === Flows: speeds below the thermal one, and rates of shear too low for the time between collisions to matter

NAME = "{kind}, {plates}, M = {M}, {angle} degrees, mean free path {dt}"
THIN = dict(M=5, angle=130, dt=0.1, H=6, push=0.03, speed=0.6)
DENSE = THIN | dict(M=10)
FLOWS = [("walls", 1000.0, THIN), ("walls", 500.0, DENSE), ("membranes", 300.0, DENSE),
         ("walls", 5000.0, dict(M=10, angle=90, dt=1.0, H=12, push=0.0025, speed=0.6))]
if not LONG:
    FLOWS = [("walls", 260.0, THIN), ("membranes", 50.0, THIN)]

for plates, time, parameters in FLOWS:
    for kind in ("Poiseuille", "Couette") if LONG or plates == "walls" else ("Poiseuille",):
        H, push, speed = (parameters[key] for key in ("H", "push", "speed"))
        away = APART + 3 * max(0.0, parameters["dt"] - 0.1)
        blocks, rows = flow(kind, plates, steps=time / parameters["dt"], **parameters)
        slip, *viscosity = fit_with_errors(kind, blocks, H, push, speed, away)
        name = NAME.format(kind=kind, plates=plates, **parameters)
        claim(f"{name}: slip length below 0.1 cells", abs(slip[0]) < 0.1 and slip[1] < 0.03,
              f"{slip[0]:+.4f} +- {slip[1]:.4f}")
        claim("    and no solvent has crossed", rows[-1]["f_srd[3]"] == 0.0)
        if viscosity:
            formula = rows[-1]["f_srd[10]"] / parameters["M"]
            ratio, error = (x / formula for x in viscosity[0])
            measured = f"{100 * (ratio - 1):+.2f} +- {100 * error:.2f} %"
            if parameters["dt"] > 0.5:
                print("note       viscosity against the formula", measured)
                continue
            claim("    the viscosity is that of kinetic theory within 2 %" + ("" if LONG else " and two errors"),
                  abs(ratio - 1) < 0.02 + (0.0 if LONG else 2 * error) and error < (0.01 if LONG else 0.02), measured)

finish()
