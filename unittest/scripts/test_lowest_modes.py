"""hd_modes: the softest modes of a membrane, against the theory of spheres and sheets, and as modes file of fix hd."""
# cost: 15

import math

from lammps_claims import MPIEXEC, claim, error_of, finish, lammps, run, thermo

VESICLE = """
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
create_box      1 box angle/types 1
create_membrane 1 {shape} mass 0.05 {more}
pair_style      helfrich
pair_coeff      1 1 20.0 0.0 {terms}
"""


def vesicle(rest, shape="sphere 3 1.0 interpolate yes", terms="", more="", **options):
    return run(VESICLE.format(shape=shape, terms=terms, more=more) + rest + "\n", **options)


def table(path):
    """Rows of the header: time or None, stiffness, residual."""
    rows = []
    for line in open(path):
        words = line.split()
        if line.startswith("#") and words[1].isdigit():
            rows.append((None if words[2] == "none" else float(words[2]), float(words[3]), float(words[4])))
    return rows


def shapes(path):
    rows = [list(map(float, line.split())) for line in open(path) if not line.startswith("#")]
    return {int(row[0]): row[1:] for row in rows}


# === A sphere: (l - 1) l (l + 1) (l + 2) kc/R^4 for each area, 2l + 1 times

vesicle("hd_modes all lowest 2 file scale.txt")
size, first = (row[1] for row in table("scale.txt"))
claim("nothing but the mesh holds the size of a sphere whose volume may change", 0 < size < 0.02 * first, size / first)
VOLUME = "volume 100000 init"    # it stays a sphere without pressure
vesicle("hd_modes all lowest 21 file sphere.txt", terms=VOLUME)
rows = table("sphere.txt")
AREA = 4 * math.pi
row = 0
for l, tolerance in ((2, 0.005), (3, 0.01), (4, 0.02)):
    mine = rows[row:row + 2 * l + 1]
    row += 2 * l + 1
    stiffness = AREA * 20 * (l - 1) * l * (l + 1) * (l + 2)
    off = max(abs(k / stiffness - 1) for _, k, _ in mine)
    claim(f"a sphere has {2 * l + 1} modes of degree {l}, of the stiffness of theory within {100 * tolerance:g} %", off < tolerance, f"{off:.2g}")
    period = 2 * math.pi / math.sqrt(stiffness / (642 * 0.05))
    off = max(abs(t / period - 1) for t, _, _ in mine)
    claim("    and its periods", off < 0.02, f"{off:.2g}")
claim("residuals are below 1e-4", len(rows) == 21 and max(residual for _, _, residual in rows) <= 1e-4)

if MPIEXEC:
    vesicle("hd_modes all lowest 21 file two.txt", terms=VOLUME, ranks=2)
    off = max(abs(a[1] / b[1] - 1) for a, b in zip(rows, table("two.txt")))
    claim("two ranks find the same", off < 1e-6, f"{off:.1g}")
run("newton off\n" + VESICLE.format(shape="sphere 3 1.0 interpolate yes", terms=VOLUME, more="") +
    "hd_modes all lowest 5 file newton.txt\n")
off = max(abs(a[1] / b[1] - 1) for a, b in zip(rows, table("newton.txt")))
claim("newton off finds the same", off < 1e-6, f"{off:.1g}")

# === The command leaves everything as it was

PROBE = "fix 1 all hd/nve\nvelocity all set 0.1 0.2 0.3\nthermo_style custom step pe ke etotal\nthermo_modify norm no format float %.17g\nthermo 5\ntimestep 1e-4\n"
claim("a run after it is the same, bit by bit",
      thermo(vesicle(PROBE + "run 10")) == thermo(vesicle(PROBE + "hd_modes all lowest 3 file x.txt\nrun 10")))

# === Other shapes: every symmetry and none

vesicle("hd_modes all lowest 4 file torus.txt", shape="torus 24 16 1.4142135623730951 1.0", terms="volume 1000 init area 1000 init")
torus = table("torus.txt")
claim("a torus at constant area and volume is stable, its lowest modes in pairs or alone",
      all(t is not None for t, _, _ in torus), [k for _, k, _ in torus])

SHEET = """
units           lj
atom_style      membrane_cp
region          box block 0 16 0 13.856406460551018 -4 4
create_box      1 box angle/types 1
create_membrane 1 plane 16 16 mass 1.0
pair_style      helfrich
pair_coeff      1 1 1.0 0.0 {terms}
"""
run(SHEET.format(terms="tension 0.3 regularize 1") + "hd_modes all lowest 6 file sheet.txt\n")
a, b = 2 * math.pi / 16, 2 * math.pi / 13.856406460551018
expected = sorted(2 * [(q * q + 0.3) * q * q for q in (a, b, math.hypot(a, b), math.hypot(a, b))])[:6]
off = max(abs(k / (16 * 13.856406460551018) / e - 1) for (_, k, _), e in zip(table("sheet.txt"), expected))
claim("a tense sheet has the waves of theory", off < 2e-3, f"{off:.1g}")

STEPS = "displace_atoms all random 0 0 0.01 77\nminimize 1e-12 1e-8 1000 10000\n"
run(SHEET.format(terms="tension 0.3 regularize 1") + STEPS + "hd_modes all lowest 6 file rough.txt\n")
off = max(abs(k / (16 * 13.856406460551018) / e - 1) for (_, k, _), e in zip(table("rough.txt"), expected))
claim("    and one that a minimization has left not quite flat, too", off < 2e-3, f"{off:.1g}")
TUBE = SHEET.replace("0 16 0 13.856406460551018 -4 4", "-4 4 -4 4 -4 4").replace("plane 16 16", "cylinder 16 20 1.5 z interpolate yes")
run(TUBE.format(terms="tension 0.22222222222 regularize 0.01") + "hd_modes all lowest 6 file tube.txt\n"
    "hd_modes all lowest 8 file free.txt rigid yes\n")
mine, free = ([k for _, k, _ in table(path)] for path in ("tube.txt", "free.txt"))
claim("a tube has the modes that remain when its two translations across are left out, and all of them",
      max(free[:2]) < 0.5 * free[2] and max(abs(a / b - 1) for a, b in zip(mine, free[2:])) < 1e-3, (mine, free))

# === Modes file: a small amplitude of one of them swings at its period, others stay at rest

period = rows[2][0]
vectors = shapes("sphere.txt")
start = "\n".join(f"group p id {tag}\ndisplace_atoms p move {' '.join('%.12g' % (1e-3 * v) for v in row[6:9])} units box\ngroup p delete"
                  for tag, row in vectors.items())
dt = period / 400
script = VESICLE.format(shape="sphere 3 1.0 interpolate yes", terms=VOLUME, more="") + \
    "fix 1 all hd/nve modes file sphere.txt\nrun 0\n" + start + \
    "\nthermo_style custom step f_1[3][4] f_1[4][4] f_1[12][4] pe etotal\nthermo_modify norm no format float %.12g\nthermo 20\n" + \
    f"timestep {dt!r}\nrun 400\n"
swing = [row for row in thermo(run(script)) if "f_1[3][4]" in row]
amplitude = [row["f_1[3][4]"] for row in swing]
off = max(abs(a - 1e-3 * math.cos(2 * math.pi * k / 20)) for k, a in enumerate(amplitude)) / 1e-3
claim("one of them swings at its period when modes file moves the vesicle", len(amplitude) == 21 and off < 0.02, f"{off:.2g}")
claim("    others stay at rest", max(abs(row[f"f_1[{j}][4]"]) for row in swing for j in (4, 12)) < 2e-5)

# === Not at a minimum, nothing to find, bad input

code, output = lammps(VESICLE.format(shape="sphere 2 1.0", terms="pressure 400", more="") + "hd_modes all lowest 3 file x.txt\n")
claim("a shape that is no minimum is called so", "this is no minimum of the energy" in output and code == 0, output[-200:])

TWO = "create_membrane 1 sphere 1 0.5 molecule 2 center 2 2 2 mass 1\n"
for rest, expected in (
        ("hd_modes all", "Illegal hd_modes command"),
        ("hd_modes none lowest 3 file x.txt", "Could not find hd_modes group ID none"),
        ("hd_modes all highest 3 file x.txt", "after the group comes: lowest N file NAME"),
        ("hd_modes all lowest 0 file x.txt", "must be 1 or more"),
        ("hd_modes all lowest 3 to x.txt", "after lowest N comes: file NAME"),
        ("hd_modes all lowest 99 file x.txt", "no more than 40 modes"),
        ("hd_modes all lowest 3 file x.txt residual 1", "between 1e-7 and 0.1"),
        ("hd_modes all lowest 3 file x.txt colour red", "Unknown hd_modes keyword colour"),
        ("hd_modes all lowest 3 file x.txt mass sampling", "choose another by keyword mass"),
        ("hd_modes all lowest 3 file no/such/x.txt", "cannot write file no/such/x.txt"),
        (TWO + "hd_modes all lowest 3 file x.txt", "has 2 membranes")):
    line = error_of(VESICLE.format(shape="sphere 2 1.0", terms="", more="") + rest + "\n")
    claim(f"error: {rest.split('hd_modes ')[-1]}", expected in line, line)
line = error_of("hd_modes all lowest 3 file x.txt\n")
claim("error: no box", "use it after create_membrane or read_data" in line, line)
line = error_of(VESICLE.format(shape="sphere 2 1.0", terms="", more="").replace("20.0", "0.0") + "hd_modes all lowest 3 file x.txt\n")
claim("error: no stiffness", "nothing resists displacements" in line, line)
finish()
