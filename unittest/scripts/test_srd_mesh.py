"""fix srd/mesh with membranes: what a collision keeps, that nothing passes, ranks, restarts, scenes."""
# cost: 50

import math
import os

from lammps_claims import REFERENCE, claim, error_of, finish, run, thermo
from membrane_scenes import read_dump

# === One collision, against the formulas


def read_off(path):
    words = open(path).read().split()
    n, m = int(words[1]), int(words[2])
    numbers = words[4:]
    points = [tuple(map(float, numbers[3 * i:3 * i + 3])) for i in range(n)]
    rest = list(map(int, numbers[3 * n:]))
    return points, [tuple(rest[4 * f + 1:4 * f + 4]) for f in range(m)]


OFF = os.path.join(REFERENCE, "icosphere_2.off")
POINTS, FACES = read_off(OFF)
COUNT, VERTEX_MASS, MASS = len(POINTS), 10.0, 0.7


def limit_mask():
    """Rows {vertex: weight} of L, from Loop's weights."""
    rings = [set() for _ in POINTS]
    for a, b, c in FACES:
        rings[a] |= {b, c}
        rings[b] |= {c, a}
        rings[c] |= {a, b}
    rows = []
    for v, ring in enumerate(rings):
        n = len(ring)
        beta = (0.625 - (0.375 + math.cos(2 * math.pi / n) / 4) ** 2) / n
        spoke = 1 / (3 / (8 * beta) + n)
        rows.append({v: 1 - n * spoke, **{w: spoke for w in ring}})
    return rows


MASK = limit_mask()


def to_masses(q):
    return [[sum(c * q[w][k] for w, c in row.items()) for k in range(3)] for row in MASK]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


ONE = f"""
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
create_box      2 box angle/types 1
create_membrane 1 file {OFF}
create_atoms    2 single {{at}}
set             type 1 mass {VERTEX_MASS}
set             type 2 mass {MASS}
group           membrane type 1
group           solvent type 2
velocity        membrane create 0.01 4711
velocity        solvent set {{v}}
pair_style      helfrich
pair_coeff      1 1 0.0 0.0 regularize 0
fix             1 membrane hd/nve
fix             2 solvent srd/mesh 100000 membrane 1.0 1.0 4711 shift yes 9127 measure no velocity keep {{args}}
timestep        0.02
thermo_style    custom step f_2[2] f_2[3] f_2[8]
thermo          1
dump            d all custom 1 one.dump id x y z vx vy vz
dump_modify     d sort id format float %.17g
run             35
"""


def one(at, v, args):
    """Frames before and after the first collision, as (positions, velocities) of masses and solvent."""
    rows = thermo(run(ONE.format(at=at, v=v, args=args)))
    step = next(i for i, row in enumerate(rows) if row["f_2[2]"])
    states = []
    for frame in read_dump("one.dump")[step - 1:step + 1]:
        q = [frame[i + 1][:3] for i in range(COUNT)]
        qdot = [frame[i + 1][3:] for i in range(COUNT)]
        states.append((q, qdot, to_masses(q), to_masses(qdot), frame[COUNT + 1][:3], frame[COUNT + 1][3:]))
    return rows[step], states


def sums(state):
    _, _, r, w, x, v = state
    energy = MASS * dot(v, v) / 2 + sum(VERTEX_MASS * dot(u, u) / 2 for u in w)
    linear = [MASS * v[k] + VERTEX_MASS * sum(u[k] for u in w) for k in range(3)]
    angular = [MASS * c for c in cross(x, v)]
    for a, u in zip(r, w):
        c = cross(a, u)
        angular = [angular[k] + VERTEX_MASS * c[k] for k in range(3)]
    return energy, linear, angular


def gap(a, b):
    return max(abs(x - y) for x, y in zip(a, b))


for name, at, v in (("from inside", "0.2 0.1 -0.3", "1.7 -0.9 1.1"),
                    ("from outside", "1.4 -0.9 0.3", "-2.0 1.5 -0.6")):
    for args in ("collision slip", "collision noslip", "level 1 collision slip", "level 3 collision noslip",
                 "impulse control collision slip"):
        row, (before, after) = one(at, v, args)
        (e0, p0, l0), (e1, p1, l1) = sums(before), sums(after)
        turned = gap(before[5], after[5])
        claim(f"a collision {name}, {args}: energy and momentum to 1e-12",
              row["f_2[2]"] == 1 and turned > 0.1 and abs(e1 / e0 - 1) < 1e-12 and gap(p0, p1) < 1e-12,
              f"{e1 / e0 - 1:.1e} {gap(p0, p1):.1e}, velocity changed by {turned:.2f}")
        if not args.startswith("impulse"):
            claim("    and angular momentum", gap(l0, l1) < 1e-12, f"{gap(l0, l1):.1e}")
            continue
        claim("    but not angular momentum", gap(l0, l1) > 1e-4, f"{gap(l0, l1):.1e}")

        # Eq. 44: alpha = 2 (v - qdot_i).n / (1/m + M^-1_ii), from a dense M = L^T D L

        n = [a - b for a, b in zip(before[5], after[5])]
        size = math.sqrt(dot(n, n))
        n = [x / size for x in n]
        place = [after[4][k] - 0.01 * (before[5][k] + after[5][k]) for k in range(3)]
        nearest = sorted(range(COUNT), key=lambda a: math.dist(before[2][a], place))[:3]
        matrix = [[0.0] * COUNT for _ in range(COUNT)]
        for row in MASK:
            for j, c in row.items():
                for l, d in row.items():
                    matrix[j][l] += VERTEX_MASS * c * d
        columns = [[1.0 if j == i else 0.0 for i in nearest] for j in range(COUNT)]
        for j in range(COUNT):    # Gauss: positive definite, no pivots needed
            for l in range(j + 1, COUNT):
                f = matrix[l][j] / matrix[j][j]
                if f:
                    row_j, row_l = matrix[j], matrix[l]
                    for m in range(j, COUNT):
                        row_l[m] -= f * row_j[m]
                    columns[l] = [a - f * b for a, b in zip(columns[l], columns[j])]
        for j in reversed(range(COUNT)):
            for i in range(3):
                known = sum(matrix[j][m] * columns[m][i] for m in range(j + 1, COUNT))
                columns[j][i] = (columns[j][i] - known) / matrix[j][j]
        error, spread = 1.0, 1.0
        for i, v in enumerate(nearest):    # which is nearest to where it hit depends on when
            relative = dot([a - b for a, b in zip(before[5], before[1][v])], n)
            alpha = 2 * relative / (1 / MASS + columns[v][i])
            if abs(MASS * size / alpha - 1) < error:
                error = abs(MASS * size / alpha - 1)
                spread = max(abs(after[1][j][k] - before[1][j][k] - columns[j][i] * alpha * n[k])
                             for j in range(COUNT) for k in range(3))
        claim("    the impulse is that of Eq. 44, and qdot changes by M^-1 times it",
              error < 1e-11 and spread < 1e-11, f"{error:.1e} {spread:.1e}")

# === Scenes: nothing passes, momentum is kept, ranks agree, restarts continue

SCENE = """
units           lj
atom_style      membrane_cp
{boundary}
region          box {box}
create_box      2 box angle/types 1
{create}
set             type 1 mass 5.0
set             type 2 mass 1.0
group           membrane type 1
group           solvent type 2
pair_style      helfrich
pair_coeff      1 1 {energy}
{move}
fix             2 solvent srd/mesh 5 membrane 1.0 1.0 4711 angle 130 shift yes 9127 measure no {args}
compute         T membrane hd/temp
compute         ks solvent ke
timestep        0.01
thermo_style    custom step c_T c_ks pe f_2[*]
thermo_modify   norm no format float %.17g
thermo          10
"""
DUMP = """dump d all custom 60 {path} id x y z vx vy vz
dump_modify     d sort id format float %.17g
"""
SOLVENT = "create_atoms 2 random {} 8341 box\n"
CLOSED, OPEN = "20.0 0.0 area 200.0 init volume 200.0 init", "10.0 0.0"


class Scene:
    def __init__(self, create, box="block 0 8 0 8 0 8", energy=OPEN, args="collision slip",
                 move="fix 1 membrane hd/nve tol 1e-13", boundary="", inside=False, kept=(0, 1, 2), alike=True):
        self.values = dict(create=create, box=box, energy=energy, args=args, move=move, boundary=boundary)
        self.inside, self.kept, self.alike = inside, kept, alike

    def text(self, create=None):
        return SCENE.format(**{**self.values, "create": self.values["create"] if create is None else create})


SCENES = {
    "vesicle across the corner of the box": Scene(
        "create_membrane 1 sphere 2 2.5 center 0.3 7.9 0.2\n" + SOLVENT.format(3000), energy=CLOSED, inside=True),
    "the same, no slip": Scene(
        "create_membrane 1 sphere 2 2.5 center 0.3 7.9 0.2\n" + SOLVENT.format(3000), energy=CLOSED,
        args="collision noslip", inside=True),
    "the same, impulses on control points": Scene(
        "create_membrane 1 sphere 2 2.5 center 0.3 7.9 0.2\n" + SOLVENT.format(2000), energy=CLOSED,
        args="impulse control collision slip", inside=True),
    "sheet": Scene("create_membrane 1 plane 13 16\n" + SOLVENT.format(3000)),
    "sheet, no slip": Scene("create_membrane 1 plane 13 16 center 0 0 3.9\n" + SOLVENT.format(3000),
                            args="collision noslip"),
    "two sheets with solvent squeezed between": Scene(
        "create_membrane 1 plane 13 16 center 0 0 -0.15\ncreate_membrane 1 plane 13 16 center 0 0 0.15\n" +
        SOLVENT.format(3000)),
    "sheet between walls": Scene("create_membrane 1 plane 13 16 center 0 0 2\n" + SOLVENT.format(3000),
                                 boundary="boundary p p f", kept=()),
    "vesicle in a vesicle": Scene(
        "create_membrane 1 sphere 2 3.0\ncreate_membrane 1 sphere 1 1.2\n" + SOLVENT.format(3000),
        energy=CLOSED, inside=True),
    "tube along x": Scene("create_membrane 1 cylinder 18 16 2.0 x\n" + SOLVENT.format(3000)),
    "torus in a tilted box": Scene(
        "create_membrane 1 torus 24 10 2.2 0.9 center 1 7 0\n" + SOLVENT.format(3000), energy=CLOSED,
        box="prism 0 8 0 8 0 8 2.0 -1.0 1.5", inside=True),
    "vesicle across the corner, level 2": Scene(
        "create_membrane 1 sphere 2 2.5 center 0.3 7.9 0.2\n" + SOLVENT.format(3000), energy=CLOSED,
        args="level 2 collision noslip", inside=True),
    "sheet of few points, level 1": Scene("create_membrane 1 plane 6 6\n" + SOLVENT.format(3000),
                                          args="level 1 collision noslip"),
    "two sheets, level 1": Scene(
        "create_membrane 1 plane 13 16 center 0 0 -0.15\ncreate_membrane 1 plane 13 16 center 0 0 0.15\n" +
        SOLVENT.format(3000), args="level 1 collision slip"),
    "torus in a tilted box, level 1": Scene(
        "create_membrane 1 torus 24 10 2.2 0.9 center 1 7 0\n" + SOLVENT.format(3000), energy=CLOSED,
        box="prism 0 8 0 8 0 8 2.0 -1.0 1.5", args="level 1 collision slip", inside=True),
    "tube along x, level 1, held": Scene("create_membrane 1 cylinder 18 16 2.0 x\n" + SOLVENT.format(3000),
                                         args="level 1 collision noslip", move="", kept=()),
    "vesicle with friction": Scene(
        "create_membrane 1 sphere 2 2.5\n" + SOLVENT.format(3000), energy=CLOSED, inside=True, kept=(),
        move="fix 1 membrane hd/langevin 1.0 1.0 1.0 4711"),
    "vesicle that does not move": Scene(
        "create_membrane 1 sphere 2 2.5\n" + SOLVENT.format(3000), energy=CLOSED, inside=True, kept=(), move=""),
    "vesicle on a circle": Scene(
        "create_membrane 1 sphere 2 2.5\n" + SOLVENT.format(3000), energy=CLOSED, inside=True, kept=(),
        move="fix 1 membrane move rotate 3 4 4 0 0 1 20"),
}
# others on four ranks are in test_srd_ranks.py
ON_FOUR = ("two sheets with solvent squeezed between", "torus in a tilted box")


def difference(a, b):
    return max(abs(x - y) for i in a for x, y in zip(a[i][3:], b[i][3:]))


for name, scene in SCENES.items():
    start = scene.text("").replace("region ", "#").replace("create_box ", "#").replace(
        "set             type", "#").replace("group           membrane", "read_data scene.data\ngroup membrane", 1)
    reference = None
    for ranks in (1, 2, 4) if name in ON_FOUR else (1, 2):
        make = scene.text() + "write_data scene.data nocoeff\nclear\n" if ranks == 1 else ""
        rows = thermo(run(make + start + DUMP.format(path="r.dump") + "run 60\n", ranks=ranks))
        frame = read_dump("r.dump")[-1]
        if ranks == 1:
            reference = frame
            crossings = rows[-1]["f_2[3]"]
            scale = math.sqrt(2 * 3000 * rows[0]["c_ks"])
            momentum = max(abs(row[f"f_2[{5 + k}]"] - rows[0][f"f_2[{5 + k}]"])
                           for row in rows for k in scene.kept) if scene.kept else 0.0
            split = [row["f_2[8]"] for row in rows]
            claim(f"{name}: no crossing, momentum kept, insides keep their atoms",
                  crossings == 0 and rows[-1]["f_2[2]"] > 100 and momentum < 1e-12 * scale and
                  max(split) == min(split) and (split[0] > 0) == scene.inside,
                  f"{rows[-1]['f_2[2]']:.0f} collisions, {momentum / scale:.1e}, {split[0]:.0f} inside")
            continue
        worst = difference(reference, frame)
        claim(f"    {ranks} ranks agree with 1", worst < 1e-10 and rows[-1]["f_2[3]"] == 0, f"{worst:.1e}")
    if name == "vesicle that does not move":
        energy = [row["c_ks"] for row in rows]
        claim("    solvent keeps its energy", max(energy) / min(energy) - 1 < 1e-12, max(energy) / min(energy) - 1)

# a sheet that is held and does not slip is a wall of the solvent's temperature: it neither heats nor cools

output = run("""
units           lj
atom_style      membrane_cp
region          box block 0 8 0 7 0 8
create_box      2 box angle/types 1
create_membrane 1 plane 8 8 mass 8.75
create_solvent  2 both 10 8341
group           membrane type 1
group           solvent type 2
pair_style      helfrich
pair_coeff      1 1 100.0 0.0
fix             2 solvent srd/mesh 1 membrane 1.0 1.0 4711 angle 130 shift yes 9127 measure no collision noslip
compute         T solvent temp
thermo_style    custom step c_T
thermo          20
timestep        0.1
run             2000
""")
temperatures = [row["c_T"] for row in thermo(output)[10:]]
mean = sum(temperatures) / len(temperatures)
claim("a held sheet without slip keeps the solvent at its temperature", abs(mean - 1) < 0.015, f"{mean:.4f}")

# energy without thermostat: no random walk, and a rise that goes as the square of the timestep

for collision, limit in (("slip", 3e-5), ("noslip", 6e-5)):
    output = run(f"""
units           lj
atom_style      membrane_cp
region          box block -5 5 -5 5 -5 5
create_box      2 box angle/types 1
create_membrane 1 sphere 2 3.5
set             type 1 mass 5.0
create_atoms    2 random 10000 8341 box
set             type 2 mass 1.0
group           membrane type 1
group           solvent type 2
pair_style      helfrich
pair_coeff      1 1 10.0 0.0 area 200.0 init volume 200.0 init
fix             1 membrane hd/nve
fix             2 solvent srd/mesh 40 membrane 1.0 1.0 4711 angle 130 shift yes 9127 measure no collision {collision}
compute         T membrane hd/temp
compute         ks solvent ke
variable        e equal pe+ke+c_ks
thermo_style    custom step temp pe ke v_e f_2[2]
thermo_modify   norm no temp T format float %.15g
timestep        0.0025
run             1000
thermo          200
run             4000
""")
    rows = [row for row in thermo(output) if row["Step"] > 1000]
    energy, hits = ([row[key] for row in rows] for key in ("v_e", "f_2[2]"))
    rise = (energy[-1] - energy[0]) / (hits[-1] - hits[0])
    off = max(abs(e - energy[0] - rise * (h - hits[0])) for e, h in zip(energy, hits))
    claim(f"collision {collision}: energy rises by less than {limit} kT a collision, in a straight line",
          abs(rise) < limit and off < 0.15, f"{rise:.1e} in {hits[-1] - hits[0]:.0f} collisions, off the line by {off:.3f} kT")

for name in ("the same, no slip", "sheet, no slip"):
    scene = SCENES[name]
    for ranks in (1, 2):
        tail = DUMP.format(path="{}") + "run 60\n"
        straight = thermo(run(scene.text() + "run 60\nwrite_restart half.restart\n" + tail.format("s.dump"),
                              ranks=ranks))
        again = scene.text("read_restart half.restart").replace("region ", "#").replace(
            "create_box ", "#").replace("set             type", "#")
        rows = thermo(run(again + tail.format("a.dump"), ranks=ranks))
        worst = difference(read_dump("s.dump")[-1], read_dump("a.dump")[-1])
        same = all(abs(rows[-1][f"f_2[{i}]"] - straight[-1][f"f_2[{i}]"]) < 1e-9 for i in (2, 3, 4, 8, 9))
        claim(f"{name}, {ranks} rank(s): a run continues from a restart file", worst < 1e-10 and same, f"{worst:.1e}")

# === Membranes near the boundary, of the box and of a sub-domain, in solvent with a long free path

NEAR = """
units           lj
atom_style      membrane_cp
{before}
region          box {box}
create_box      2 box angle/types 1
{create}
set             type 2 mass 1.0
group           membrane type 1
group           solvent type 2
pair_style      helfrich
pair_coeff      1 1 100.0 0.0
{move}
fix             2 solvent srd/mesh {every} membrane 1.0 1.0 4711 angle 130 shift yes 9127 measure no {args}
compute         T solvent temp
compute_modify  T dynamic/dof yes
thermo_style    custom step f_2[2] f_2[3] c_T
thermo          100
timestep        0.01
run             {steps}
"""
SHEET = "create_membrane 1 plane 8 8 center 0 0 {} mass 8.75\ncreate_atoms 2 random 8000 8341 box"
SLAB = "block 0 8 0 7 0 20"


def near(what, create, box=SLAB, move="", args="collision slip", every=100, steps=600, before="", ranks=1):
    last = thermo(run(NEAR.format(create=create, box=box, move=move, args=args, every=every, steps=steps,
                                  before=before), ranks=ranks))[-1]
    claim(f"{what}: no crossing", last["f_2[3]"] == 0 and last["f_2[2]"] > 100, f"{last['f_2[2]']:.0f} collisions")
    return last


near("a sheet three edges from the boundary", SHEET.format(-6.7))
near("the same, cubes of 3", SHEET.format(-6.7), args="collision slip search 3")
near("a sheet that moves into another sub-domain", SHEET.format(4), move="fix 1 membrane move linear 0 0 -2",
     steps=400, before="processors 1 1 *", ranks=2)
VESICLE = "create_membrane 1 sphere 2 2.5 center 3.5 0 {} mass 8.75\ncreate_atoms 2 random 5000 8341 box"
SHEARED = dict(box="prism 0 8 0 8 0 8 0 0 0", before="comm_modify vel yes", move="fix 3 solvent deform 1 xz erate 0.2 remap v",
               args="tstat yes collision noslip", every=5)
for ranks in (1, 2):
    near(f"a vesicle near the boundary of a box that shears, {ranks} rank(s)", VESICLE.format(2.6), ranks=ranks, **SHEARED)
said = error_of(NEAR.format(create=VESICLE.format(0), steps=10, **SHEARED))
claim("a membrane through that boundary: an error with the cure", "remap x" in said, said)
last = near("a held vesicle whose points have velocities", VESICLE.format(0) + "\nvelocity all set 5 0 0",
            box="block 0 8 0 8 0 8", args="collision noslip", every=5, steps=300)
claim("    does not stir the solvent", abs(last["c_T"] - 1) < 0.05, last["c_T"])

# the list of solvent that comes near holds for 50 steps, if nothing turns solvent in between

AGAIN = """velocity        solvent scale 2.0
run             20 pre no post no
velocity        solvent create 1.0 3 loop all
run             40 pre no"""
for what, move, after in (("a thermostat", "fix 1 solvent temp/rescale 3 1.0 1.0 0.0 1.0", ""),
                          ("a shift of everything", "fix 1 membrane hd/nve\nvelocity membrane set 0.5 0.2 0.0\n"
                                                    "fix 3 membrane recenter INIT INIT INIT shift all", ""),
                          ("gravity", "fix 1 solvent gravity 1.0 vector 1 1 0", ""),
                          ("velocities set between runs", "", AGAIN)):
    near(f"{what}, cells that collide every 50 steps", VESICLE.format(0), box="block 0 8 0 8 0 8", move=move,
         args="collision noslip", every=50, steps=f"120 post no\n{after}" if after else 120)

# images of the membrane move with the box, whoever changes it

near("a vesicle near the boundary of a box that shrinks, by a fix that has no solvent", VESICLE.format(2.6),
     box="block 0 8 0 8 0 8", every=10, steps=100,
     move="fix 1 membrane hd/nve\nfix 3 membrane press/berendsen iso 1.0 100.0 1.0 modulus 50")

for remap, erate in (("x", -0.2), ("none", -0.05)):
    for what, mover in (("held", ""), ("moved", "fix 1 membrane move linear 0 0 -1\n"), ("free", "fix 1 membrane hd/nve\n")):
        near(f"a sheet near the boundary of a box that shrinks, remap {remap}, {what}", SHEET.format(9.35), every=10,
             steps=100, move=f"{mover}fix 3 all deform 1 z erate {erate} remap {remap}")
said = error_of(NEAR.format(create=VESICLE.format(0), box="block 0 8 0 8 0 8", every=10, steps=10, args="", before="",
                            move="fix 3 solvent deform 1 z erate 0.1 remap x"))
claim("solvent that passes through with the box: an error", "needs all solvent and all membranes" in said, said)

# a minimization moves the membrane past solvent that stays; the next run takes sides anew

output = run(SCENE.format(**{**SCENES["the same, no slip"].values, "energy": "20.0 0.0"}) + """
run             50
min_style       membrane
minimize        1e-6 0 50 200
run             50
""")
rows = thermo(output)
claim("a minimization warns that membranes pass over solvent", output.count("may pass over solvent") == 1)
claim("a minimization after a run leaves the counters alone, and a run after it loses nothing",
      rows[-1]["f_2[3]"] == 0 and rows[-1]["f_2[2]"] > 100 and rows[-1]["f_2[8]"] > 0, f"{rows[-1]['f_2[2]']:.0f} collisions")

# === Bad input

BASE = Scene("create_membrane 1 sphere 2 2.5\n" + SOLVENT.format(3000), energy=CLOSED)


def error(**changes):
    return error_of(SCENE.format(**{**BASE.values, **changes}) + "run 5\n")


for move, word in (("fix 1 membrane hd/brownian 1.0 4711 gamma_t 1.0", "momenta"),
                   ("fix 1 membrane hd/nve mass lumped", "mass vertex"),
                   ("fix 1 membrane hd/nve mass consistent", "mass vertex"),
                   ("fix 1 membrane nve", "hd/nve")):
    said = error(move=move)
    claim(f"{move}: an error with the cure", "Fix srd/mesh" in said and word in said, said)

# === Numbers of the solvent are those of the space that has some

FLUID = """
units           lj
atom_style      membrane_cp
region          box block -6.5 6.5 -6.5 6.5 0 12
create_box      2 box angle/types 1
{shape}
pair_style      helfrich
pair_coeff      1 1 10.0 0.0
group           wall type 1
group           solvent type 2
fix             s solvent srd/mesh 1 {group} 1.0 1.0 4711 angle 130 shift yes 9127 measure no
timestep        0.1
thermo_style    custom step f_s[10] f_s[21] f_s[22] f_s[8] f_s[9]
run             0
"""


def viscosities(shape, group="wall", ranks=1):
    row = thermo(run(FLUID.format(shape=shape, group=group), ranks=ranks))[-1]
    return row["f_s[10]"], row["f_s[21]"], row["f_s[22]"], row["f_s[8]"] + row["f_s[9]"]


CYLINDER = "create_membrane 1 cylinder 32 16 5.0 z interpolate yes mass 10\nregion bore cylinder z 0 0 4.9 INF INF\n"
SPHERE = "create_membrane 1 sphere 3 4.0 interpolate yes center 0 0 6 mass 10\n"
bulk = {density: viscosities(f"create_solvent 2 both {density} 4711", "NULL")[0] for density in (5, 10)}
for ranks in (1, 2):
    eta, inside, outside, atoms = viscosities(CYLINDER + "create_solvent 2 both 5.0 4711 region bore", ranks=ranks)
    density = atoms / (math.pi * 25.0 * 12.0)    # once they have spread
    expected = bulk[5] + (density - 5.0) * (bulk[10] - bulk[5]) / 5.0
    claim(f"solvent in a bore on {ranks}: the viscosity of the bore, not of the box",
          abs(eta / expected - 1) < 0.02 and inside == eta and outside == 0, (eta, expected))
    eta, inside, outside, _ = viscosities(SPHERE + "create_solvent 2 inside 10.0 4711", ranks=ranks)
    claim(f"solvent in a vesicle on {ranks}: the viscosity there", abs(eta / bulk[10] - 1) < 0.01 and
          inside == eta and outside == 0, (eta, bulk[10]))
    eta, inside, outside, _ = viscosities(SPHERE + "create_solvent 2 inside 10.0 4711\ncreate_solvent 2 outside 5.0 4712", ranks=ranks)
    claim(f"solvent of two densities on {ranks}: two viscosities", abs(inside / bulk[10] - 1) < 0.01 and
          abs(outside / bulk[5] - 1) < 0.01 and outside < eta < inside, (inside, outside, eta))

# === Volumes of the two sides do not depend on where the box is

WALLED = """
units           lj
atom_style      membrane_cp
boundary        p p f
region          box block 0 12 0 12 {lo} {hi}
create_box      2 box angle/types 1
create_membrane 1 sphere 2 4.5 mass 5
special_bonds   lj/coul 1 1 1
create_solvent  2 outside 3.0 4711
group           membrane type 1
group           solvent type 2
pair_style      helfrich
pair_coeff      1 1 10.0 0.0
timestep        0.005
fix             2 solvent srd/mesh 10 membrane 1.0 1.0 4711 angle 130 shift yes 9127
thermo_style    custom step f_2[9] f_2[22]
run             10
"""
found = {lo: thermo(run(WALLED.format(lo=lo, hi=lo + 12)))[-1]["f_2[22]"] for lo in (0, -6, 7)}
claim("a box with walls that begins elsewhere has the same viscosity", max(found.values()) < 1.005 * min(found.values()), found)

# === A minimization before the first run has no solvent: velocities come after it

PERIODIC = WALLED.replace("boundary        p p f\n", "").replace("outside", "both").replace("9127\n", "9127 ghosts yes\n")
rows = thermo(run(PERIODIC.replace("fix             2", "fix             1 membrane hd/nve measure 1.0\nfix             2")
                  .replace("f_2[9]", "f_2[1]").replace("10.0 0.0", "10.0 0.0 volume 100.0 init regularize 10.0 conformal")
                  .replace("run             10", "minimize        1e-4 1e-4 10 100\nrun             30").format(lo=0, hi=12)))
claim("solvent has its temperature after a minimization", abs(rows[-1]["f_2[1]"] - 1.0) < 0.1, rows[-1]["f_2[1]"])

finish()
