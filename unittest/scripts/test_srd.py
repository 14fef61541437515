"""fix srd/mesh without membranes: what is kept, ranks, restarts, walls, forces, boxes that change."""
# cost: 20

from lammps_claims import MPIEXEC, claim, finish, lammps, run, thermo
from membrane_scenes import read_dump

HEAD = """
units           lj
atom_style      membrane_cp
{before}
region          box {box}
create_box      1 box angle/types 1
create_solvent  1 both 10 8341
group           solvent type 1
"""
FIX = """
fix             srd solvent srd/mesh {N} NULL 1.0 1.0 4711 angle 130 {args}
timestep        {dt}
compute         ke all ke
thermo_style    custom step atoms c_ke f_srd[*]
thermo_modify   norm no format float %.17g
thermo          {every}
"""
DUMP = "dump d all custom {every} {path} id x y z vx vy vz\ndump_modify d sort id format float %.17g\n"


def head(box="block 0 8 0 8 0 8", before=""):
    return HEAD.format(box=box, before=before)


def fix(args="shift yes 9127", N=5, dt=0.02, every=100):
    return FIX.format(args=args, N=N, dt=dt, every=every)


def column(rows, i):
    return [row[f"f_srd[{i}]"] for row in rows]


# === Momentum and energy

for args in ("shift yes 9127", "shift yes 9127 tstat yes", "shift yes 9127 method at+a", "shift no"):
    steps = 10000 if args == "shift yes 9127" else 2000
    rows = thermo(run(head() + fix(args, N=2, dt=0.1 if args == "shift no" else 0.05, every=500) + f"run {steps}\n"))
    scale = (2 * rows[0]["Atoms"] * rows[0]["c_ke"]) ** 0.5
    momentum = max(abs(p) for i in (5, 6, 7) for p in column(rows, i)) / scale
    claim(f"{args}: total momentum stays zero to 1e-12 of sqrt(2 N E)", momentum < 1e-12, f"{momentum:.1e}")
    energy = [row["c_ke"] for row in rows]
    drift = max(abs(e / energy[0] - 1) for e in energy)
    if "tstat" in args or "at+a" in args:
        t = column(rows[1:], 1)
        mean, error = sum(t) / len(t), (2 / 3 / rows[0]["Atoms"] / len(t)) ** 0.5
        claim(f"{args}: the temperature is that of the bath within four standard errors",
              abs(mean - 1.0) < 4 * error, f"{mean:.5f} +- {error:.5f}")
        claim("and its energy fluctuates", drift > 1e-3, f"{drift:.1e}")
    else:
        claim(f"{args}: energy is kept to 1e-10 over {steps} steps", drift < 1e-10, f"{drift:.1e}")

row = thermo(run(head() + fix() + "run 0\n"))[0]
claim("initial velocities: no momentum, the kinetic energy of Tsrd",
      max(abs(row[f"f_srd[{i}]"]) for i in (5, 6, 7)) < 1e-10 and
      abs(row["c_ke"] / (1.5 * (row["Atoms"] - 1)) - 1) < 1e-12, row["c_ke"])
moving = head() + "velocity solvent create 3.0 1\n" + fix("shift yes 9127 velocity keep") + "run 0\n"
row = thermo(run(moving))[0]
claim("velocity keep: initial velocities are the user's", abs(row["c_ke"] / (1.5 * (row["Atoms"] - 1)) - 3) < 1e-12)
rows = thermo(run(head() + fix() + "run 100\nvelocity solvent set 1.0 0 0 sum yes\nrun 100\n"))
claim("a later run keeps velocities", abs(rows[-1]["f_srd[5]"] / rows[-1]["Atoms"] - 1) < 1e-12)
rows = thermo(run(head() + fix("lamda 0.2 shift yes 9127") + "run 0\n"))
claim("lamda sets the temperature", abs(rows[0]["f_srd[16]"] - 0.2) < 1e-14 and
      abs(rows[0]["c_ke"] / (1.5 * (rows[0]["Atoms"] - 1)) - 4) < 1e-12, rows[0]["f_srd[16]"])

# === Ranks


def last(path):
    return read_dump(path)[-1]


def difference(a, b, length=8.0):
    worst = 0.0
    for i in a:
        for k in range(3):
            worst = max(worst, abs((a[i][k] - b[i][k] + length / 2) % length - length / 2))
            worst = max(worst, abs(a[i][3 + k] - b[i][3 + k]))
    return worst


CUTS = {
    "2 ranks": (2, "", ""),
    "4 ranks": (4, "", ""),
    "3 ranks in a row": (3, "processors 1 1 3", ""),
    "4 ranks, sub-domains narrower than a cell, cells of 4":
        (4, "processors 4 1 1", "balance 1.0 x 0.1 0.3 0.5"),
    "4 ranks, balanced": (4, "variable w atom 1.0+2*(x<3)*(y<5)",
                          "fix b all balance 20 1.0 shift xyz 10 1.05 weight var w"),
    "4 ranks, tiled": (4, "comm_style tiled\nvariable w atom 1.0+2*(x<3)*(y<5)",
                       "fix b all balance 20 1.0 rcb weight var w"),
}
if not MPIEXEC:
    CUTS = {}    # one process cannot be cut
for args, tolerance in (("shift yes 9127", 1e-11), ("shift yes 9127 tstat yes", 1e-11),
                        ("shift yes 9127 method at+a", 1e-6)):
    reference = None
    for name, (ranks, before, after) in ({"1 rank": (1, "", "")} | CUTS).items():
        if args != "shift yes 9127" and name not in ("1 rank", "2 ranks", "4 ranks, tiled"):
            continue
        script = head(before=before) + after + "\n" + fix(args) + DUMP.format(every=200, path="r.dump") + "run 200\n"
        rows = thermo(run(script, ranks=ranks))
        if reference is None:
            reference, first = last("r.dump"), rows
            continue
        worst = difference(last("r.dump"), reference)
        claim(f"{args}: {name} and 1 rank agree to rounding after 40 collisions", worst < tolerance, f"{worst:.1e}")
big = "shift yes 9127"
script = head(before="processors 4 1 1") + fix(big).replace("1.0 1.0 4711", "1.0 4.0 4711") + \
    DUMP.format(every=200, path="r.dump") + "run 200\n"
frames = []
for ranks in (1, 4):
    run(script if ranks == 4 else script.replace("processors 4 1 1", ""), ranks=ranks)
    frames.append(last("r.dump"))
worst = difference(*frames)
claim("cells of 4, sub-domains of 2: 4 ranks and 1 rank agree", worst < 1e-11, f"{worst:.1e}")

# === Restart

WALLED = dict(box="block 0 8 0 8 0 8", before="boundary p p f")
for name, scene, args in (("bulk", {}, "shift yes 9127 tstat yes"), ("at+a", {}, "shift yes 9127 method at+a"),
                          ("between walls", WALLED, "shift yes 9127 wall/velocity zhi 0.5 0 0")):
    for ranks in (1, 2):
        tail = DUMP.format(every=150, path="{}") + "run 150\n"
        straight = thermo(run(head(**scene) + fix(args, every=50) + "run 150\nwrite_restart half.restart\n" +
                              tail.format("straight.dump"), ranks=ranks))
        again = thermo(run("read_restart half.restart\n" + fix(args, every=50) + tail.format("again.dump"),
                           ranks=ranks))
        claim(f"{name}, {ranks} rank(s): a run continued from a restart file is bitwise the same",
              open("straight.dump").read() == open("again.dump").read())
        worst = max(abs(straight[-1][k] - x) / (1 + abs(x)) for k, x in again[-1].items())
        # what walls have received is a sum of many impulses of both signs, taken in another order
        claim("and what the fix reports agrees to rounding", worst < 1e-11, f"{worst:.1e}")

# === Walls and forces

rows = thermo(run(head(**WALLED) + fix("shift yes 9127 wall/velocity zhi 0.5 0.2 0") + "run 1000\n", ranks=2))
balance = max(abs(column(rows, 5 + k)[i] + column(rows, 18 + k)[i]) for k in range(3) for i in range(len(rows)))
taken = max(abs(x) for x in column(rows, 18))
claim("momentum that solvent loses is what walls take", balance < 1e-10 * taken and taken > 10,
      f"{balance:.1e} of {taken:.1f}")
rows = thermo(run(head(box="block 0 8 0 8 0 8", before="boundary f f f") +
                  fix("shift yes 9127 wall slip") + "run 1000\n"))
energy = [row["c_ke"] for row in rows]
claim("walls that slip, on all six sides: energy is kept, no atom is lost",
      max(energy) / min(energy) - 1 < 1e-11 and rows[-1]["Atoms"] == 5120, max(energy) / min(energy) - 1)
for ranks in (1, 2):
    rows = thermo(run(head() + fix() + "fix g solvent addforce 0.1 0.0 -0.2\nrun 1000\n", ranks=ranks))
    expected = 5120 * 0.1 * 1000 * 0.02
    error = max(abs(rows[-1]["f_srd[5]"] / expected - 1), abs(rows[-1]["f_srd[7]"] / (-2 * expected) - 1))
    claim(f"forces of other fixes act on solvent, {ranks} rank(s): dp = f t", error < 1e-11, f"{error:.1e}")

# === Boxes

TILTED = "prism 0 8 0 8 0 8 {} 0 0"
tails = fix() + DUMP.format(every=200, path="r.dump") + "run 200\n"
frames = []
for box in ("block 0 8 0 8 0 8", TILTED.format(0)):
    run(head(box=box) + tails)
    frames.append(last("r.dump"))
claim("a tilted box without tilt is the box", difference(*frames) < 1e-11, difference(*frames))
frames = []
for ranks in (1, 4):
    rows = thermo(run(head(box="prism 0 8 0 8 0 8 2.0 -1.0 1.5") + tails, ranks=ranks))
    frames.append(last("r.dump"))
energy = [row["c_ke"] for row in rows]
claim("a tilted box: energy is kept", max(energy) / min(energy) - 1 < 1e-12, max(energy) / min(energy) - 1)
worst = max(abs(a - b) for i in frames[0] for a, b in zip(frames[0][i][3:], frames[1][i][3:]))
claim("and 4 ranks agree with 1", worst < 1e-11, worst)

for ranks in (1, 2):
    rows = thermo(run(head() + fix("shift yes 9127 tstat yes", every=500) +
                      "fix d all deform 1 x scale 1.5 y scale 0.8 z vel 0.1 remap x\nrun 1500\n", ranks=ranks))
    claim(f"the box is deformed, {ranks} rank(s): no solvent is lost, cells follow",
          rows[-1]["Atoms"] == 5120 and abs(rows[-1]["f_srd[1]"] - 1) < 0.05, rows[-1]["f_srd[1]"])
rows = thermo(run(head(box=TILTED.format("0.0")) + fix("shift yes 9127 tstat yes", every=500) +
                  "fix d all deform 1 xy erate 0.2 remap v\nrun 1500\nvariable p atom vx*(y-4)\n"
                  "compute p all reduce ave v_p\nvariable yy atom (y-4)^2\ncompute yy all reduce ave v_yy\n"
                  "thermo_style custom step c_p c_yy f_srd[1]\nrun 0\n", ranks=2))
rate = rows[-1]["c_p"] / rows[-1]["c_yy"]
claim("a box that shears, with remap v, drags the solvent along at its rate", abs(rate / 0.2 - 1) < 0.15, f"{rate:.4f}")

# === Forces of bonds and angles: between collisions solvent moves as by fix nve

CHAIN = """
units           lj
atom_style      full
region          box block -3 3 -3 3 -3 3
create_box      1 box bond/types 1 angle/types 1 extra/bond/per/atom 2 extra/angle/per/atom 1 extra/special/per/atom 4
create_atoms    1 single -1.3 0.1 0.0
create_atoms    1 single 0.2 0.0 0.3
create_atoms    1 single 1.2 0.9 0.0
create_atoms    1 single 1.5 -1.9 0.2
mass            1 1.0
comm_modify     cutoff 4.0
{forces}
{fix}
timestep        0.01
dump            d all custom 100 chain.dump id x y z vx vy vz
dump_modify     d sort id format float %.17g
run             100
"""
FORCE_STYLES = {
    "bonds": "bond_style harmonic\nbond_coeff 1 100.0 1.0\ncreate_bonds single/bond 1 1 2\n",
    "angles": "angle_style harmonic\nangle_coeff 1 50.0 90.0\ncreate_bonds single/angle 1 1 2 3\n",
}
for name, forces in FORCE_STYLES.items():
    for ranks in (1, 2):
        frames = {}
        for mover in ("nve", "srd/mesh 1000000 NULL 1.0 1.0 4711 shift yes 9127 velocity keep ghosts no",
                      "srd/mesh 1000000 NULL 1.0 1.0 4711 shift yes 9127 velocity keep ghosts yes"):
            run(CHAIN.format(forces=forces, fix=f"fix m all {mover}"), ranks=ranks)
            frames[mover] = read_dump("chain.dump")[-1]
        exact = frames.pop("nve")
        worst = max(abs(a - b) for found in frames.values() for i in exact for a, b in zip(exact[i], found[i]))
        moved = max(abs(v) for row in exact.values() for v in row[3:])
        claim(f"{name} of solvent on {ranks} rank(s): as with fix nve", worst < 1e-11 and moved > 0.01, (worst, moved))

# === Ghosts, and what else solvent may be

code, output = lammps(head() + "pair_style zero 2.5\npair_coeff * *\n" + fix() + "run 100\n", ranks=2)
claim("solvent with a pair style has neighbors", code == 0 and "Total # of neighbors = 0" not in output)
both = head().replace("create_box      1", "create_box      2").replace("create_solvent", """
create_membrane 2 sphere 2 2.0
pair_style      helfrich
pair_coeff      2 2 10.0 0.0 area 100.0 init volume 100.0 init
create_solvent""") + "group vesicle type 2\nfix m vesicle hd/nve\n"
code, output = lammps(both + fix().replace("solvent srd", "solvent srd").replace("timestep        0.02", "timestep 0.002") + "run 100\n", ranks=2)
ghosts = [line for line in output.splitlines() if line.startswith("Nghost:")]
# the ghost cutoff of 2.5 takes in the points of the other rank and some of their periodic images; solvent would be thousands
claim("solvent around a vesicle is not in the ghost exchange", code == 0 and float(ghosts[0].split()[1]) <= 2 * 162, ghosts)
output = run(both + fix("shift yes 9127 ghosts yes").replace("timestep        0.02", "timestep 0.002") + "run 100\n", ranks=2)
ghosts = [line for line in output.splitlines() if line.startswith("Nghost:")]
claim("ghosts yes: it is", float(ghosts[0].split()[1]) > 500, ghosts)
rows = thermo(run(both + fix().replace("timestep        0.02", "timestep 0.002") +
                  "run 20\nunfix srd\natom_modify sort 1000 0.0\nfix srd solvent nve\nthermo_style custom step atoms\nrun 20\n"))
claim("unfix gives solvent back", rows[-1]["Atoms"] == 5120 + 162)
rows = thermo(run(both + fix().replace("timestep        0.02", "timestep 0.002") + "run 20\nminimize 0 0 3 10\nrun 20\n"))
claim("a minimization in between leaves the solvent alone", rows[-1]["Atoms"] == 5120 + 162)
run(head().replace("membrane_cp", "atomic").replace("angle/types 1", "") + "mass 1 1.0\n" + fix() + "run 20\n")
claim("without membranes any atom style will do", True)

finish()
