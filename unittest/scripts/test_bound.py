"""fix hd/bind: atoms held on the limit surface; order, conservation, geodesics, ranks, restarts.

    MEMBRANE_LONG=1    drift over 100,000 steps, and 1e7 particle-steps on two ranks
"""
# cost: 35
# timeout: 14400

import math

from lammps_claims import LONG, claim, finish, run, thermo
from membrane_scenes import TETRAHEDRON, bipyramid, frames, write_off
from spread_and_slope import order, slope, spread

SCENE = """
units           lj
newton          {newton}
atom_style      membrane_cp
region          box block -8 8 -8 8 -8 8
create_box      2 box angle/types 1
create_membrane 1 sphere 2 3.5 interpolate yes
set             type 1 mass 1.0
group           mem type 1
create_bound    {n} 2 mem 4711 mass {m}
group           p type 2
pair_style      hybrid/overlay helfrich zero 1.0
pair_coeff      1 1 helfrich 20.0 0.0 regularize 10
pair_coeff      * * zero
neighbor        0.5 bin
timestep        {dt}
fix             1 mem hd/nve tol 1e-13 measure 1.0 {mass}
fix             2 p nve
{bind}
hd_velocity     mem 1.0 12
{warm}
compute         T all hd/temp
compute         c mem membrane/curvature/atom
thermo_style    custom step pe etotal c_T {more}
thermo_modify   norm no format float %.16g temp T
thermo          {every}
"""


def script(n=10, m=1.0, hold="spring 3000", dt=0.005, every=1, newton="on", mass="", more=""):
    bind = f"fix b p hd/bind mem hold {hold}" if n else ""
    warm = "velocity p create 1.0 99 loop all" if n else ""
    return SCENE.format(n=n, m=m, bind=bind, warm=warm, dt=dt, every=every, newton=newton, mass=mass,
                        more=more or ("f_b[4]" if n else ""))


def energies(time, **options):
    steps = round(time / options["dt"])
    rows = thermo(run(script(**options) + f"run {steps}\n"))
    return [row["TotEng"] for row in rows[-(steps // options.get("every", 1)) - 1:]]


def apart(a, b):
    return max(abs(x - y) for p, q in zip(a, b) for x, y in zip(p, q))


# === Order of the energy error, and no more than without particles

steps = [5e-3 / 2**k for k in range(4)]
bare = [spread(energies(0.5, n=0, dt=dt)) for dt in steps]
for n, m, hold in ((10, 0.1, "spring 300"), (10, 1.0, "spring 3000"), (10, 10.0, "spring 5000"),
                   (100, 1.0, "spring 1000"), (10, 1.0, "rigid"), (10, 10.0, "rigid")):
    errors = [spread(energies(0.5, n=n, m=m, hold=hold, dt=dt)) for dt in steps]
    power = order(steps, errors)
    claim(f"{n} particles of mass {m}, {hold}: energy error goes as dt^2 over a factor 8",
          abs(power - 2) < 0.1, f"order {power:.3f}, errors " + " ".join(f"{e:.2e}" for e in errors))
    claim("    and is at most 1.3 times that of the bare membrane", errors[-1] < 1.3 * bare[-1],
          f"{errors[-1] / bare[-1]:.2f}")

# === Momenta: of masses at the limit positions and of particles, as differences of successive positions

def momenta(path, dt, m):
    before, after = frames(path)[-2:]
    linear, angular = [0.0] * 3, [0.0] * 3
    for (_, kind, *r), (_, _, *s) in zip(before, after):
        r, s = (r[:3], s[:3]) if kind == 1 else (r[3:], s[3:])
        v = [(b - a) / dt for a, b in zip(r, s)]
        for k in range(3):
            i, j = (k + 1) % 3, (k + 2) % 3
            mass = 1.0 if kind == 1 else m
            linear[k] += mass * v[k]
            angular[k] += mass * (r[i] * v[j] - r[j] * v[i])
    return linear, angular


PAIR = """
dump            1 all custom 1 {file} id type c_c[3] c_c[4] c_c[5] xu yu zu
dump_modify     1 format float %.17g
run             1
undump          1
"""
for hold in ("spring 3000", "rigid"):
    run(script(hold=hold, every=1000) + PAIR.format(file="r.dump") + "run 1000\n" + PAIR.format(file="s.dump"))
    (p0, l0), (p1, l1) = momenta("r.dump", 0.005, 1.0), momenta("s.dump", 0.005, 1.0)
    claim(f"{hold}: linear momentum is kept to 1e-9", apart([p0], [p1]) < 1e-9, f"{apart([p0], [p1]):.1e}")
    claim(f"{hold}: angular momentum is kept to 1e-9 of its terms", apart([l0], [l1]) < 1e-9 * 172 * 3.5,
          f"{apart([l0], [l1]):.1e} of {max(map(abs, l0)):.1f}")

# === Reversible

for hold in ("spring 3000", "rigid"):
    run(script(hold=hold, every=1000, dt=0.002) + """
dump            1 all custom 300 x.dump id x y z
dump_modify     1 format float %.17g
variable        a atom -vx
variable        b atom -vy
variable        c atom -vz
run             300
velocity        all set v_a v_b v_c
run             300
""")
    there = frames("x.dump")
    back, away = apart(there[0], there[-1]), apart(there[0], there[1])
    claim(f"{hold}: 300 steps forth and back return to the start to 1e-9", back < 1e-9 and away > 0.1,
          f"{back:.1e} after moving {away:.2f}")

# === Rigid is the limit of stiff springs

run(script(hold="rigid", dt=2e-4) + "run 0\nwrite_data start.data\n")
START = """
units           lj
atom_style      membrane_cp
read_data       start.data
group           mem type 1
group           p type 2
pair_style      hybrid/overlay helfrich zero 1.0
pair_coeff      1 1 helfrich 20.0 0.0 regularize 10
pair_coeff      * * zero
timestep        2e-4
fix             1 mem hd/nve tol 1e-13 measure 1.0
fix             2 p nve
fix             b p hd/bind mem hold {hold}
thermo          1000
dump            1 p custom 1000 x.dump id x y z
dump_modify     1 format float %.17g
run             1000
"""
ends = {}
for hold in ("rigid correct no", "spring 8000", "spring 32000", "spring 128000"):
    run(START.format(hold=hold))
    ends[hold] = frames("x.dump")[-1]
off = [apart(ends["rigid correct no"], ends[f"spring {k}"]) for k in (8000, 32000, 128000)]
claim("springs tend to rigid as 1/K", all(3.0 < a / b < 5.3 for a, b in zip(off, off[1:])),
      " ".join(f"{d:.2e}" for d in off))

# === The forces of the correction are derivatives of its energy: heavy particles in a crowd, one central difference each

CROWD = """
units           lj
atom_style      membrane_cp
region          box block -8 8 -8 8 -8 8
create_box      2 box angle/types 1
create_membrane 1 sphere 2 3.5 scale 1.0 1.2 0.9
set             type 1 mass 1.0
create_atoms    2 single 0.3 0.2 3.1
create_atoms    2 single 0.8 0.1 3.1
create_atoms    2 single 0.1 0.9 3.0
create_atoms    2 single 2.2 0.9 2.2
set             type 2 mass 30.0
group           mem type 1
group           p type 2
pair_style      helfrich
pair_coeff      1 1 20.0 0.0 regularize 10
displace_atoms  mem random 0.1 0.1 0.1 77
fix             1 mem hd/nve tol 1e-13 measure 1.0
fix             2 p nve
fix             b p hd/bind mem max 2.0 hold rigid correct {correct}
thermo_style    custom step f_b
thermo_modify   norm no format float %.16g
dump            1 all custom 1 f.dump id fx fy fz
dump_modify     1 format float %.17g
run             0
undump          1
"""
force = {}
for correct in ("yes", "no"):
    run(CROWD.format(correct=correct))
    force[correct] = {int(row[0]): row[1:] for row in frames("f.dump")[0]}
change = {i: [a - b for a, b in zip(force["yes"][i], force["no"][i])] for i in force["yes"]}
points = sorted((i for i in change if i <= 162), key=lambda i: -sum(c * c for c in change[i]))[:3]
worst = most = 0.0
moves = ""
for atom in (163, 164, 165, *points):
    moves += f"group one clear\ngroup one id {atom}\n" + "".join(
        f"displace_atoms one move {step}\nrun 0\n" for step in ("1e-4 0 0", "-2e-4 0 0", "1e-4 1e-4 0", "0 -2e-4 0",
                                                                "0 1e-4 1e-4", "0 0 -2e-4")) + "displace_atoms one move 0 0 1e-4\n"
energy = [row["f_b"] for row in thermo(run(CROWD.format(correct="yes") + "group one empty\n" + moves))[-36:]]
for n, atom in enumerate((163, 164, 165, *points)):
    for k in range(3):
        plus, minus = energy[6 * n + 2 * k:6 * n + 2 * k + 2]
        worst = max(worst, abs(change[atom][k] + (plus - minus) / 2e-4))
        most = max(most, abs(change[atom][k]))
claim("forces of the correction on particles and control points are its derivatives to 1e-6", worst < 1e-6 * most,
      f"{worst:.1e} of {most:.3f}")

# === Frozen surfaces: geodesics

FROZEN = """
units           lj
atom_style      membrane_cp
region          box block -4 4 -4 4 -4 4
create_box      2 box angle/types 1
{create}
create_atoms    2 single {x} {y} {z}
group           mem type 1
group           p type 2
set             type 2 mass 1.0
pair_style      zero 1.0
pair_coeff      * *
timestep        {dt}
fix             2 p nve
fix             b p hd/bind mem max 0.5 hold rigid
velocity        p set {v}
compute         K p ke
thermo_style    custom step c_K
thermo_modify   format float %.16g
thermo          {steps}
run             0
thermo          1
dump            1 p custom {steps} x.dump id xu yu zu
dump_modify     1 format float %.17g
run             {steps}
"""
for name, create, x, y, z in (
        ("sphere", "create_membrane 1 sphere 2 1.0 interpolate yes", 0.6, 0.6, 0.6),
        ("ellipsoid", "create_membrane 1 sphere 2 1.0 scale 1.5 1 0.7", 0.8, 0.6, 0.4),
        ("torus", "create_membrane 1 torus 24 12 1.5 0.5", 1.9, 0.3, 0.3)):
    ends, speeds = [], []
    for dt in (0.02, 0.01, 0.005, 0.0025, 0.000625):
        rows = thermo(run(FROZEN.format(create=create, x=x, y=y, z=z, dt=dt, v="0.3 1.0 -0.2",
                                        steps=round(2 / dt))))
        ends.append(frames("x.dump")[-1])
        kinetic = [row["c_K"] for row in rows[1:]]
        speeds.append((max(kinetic) - min(kinetic)) / kinetic[0])
    off = [apart(e, ends[-1]) for e in ends[:-1]]
    claim(f"{name}: a free particle follows a geodesic, to a quarter of the error per halved step",
          all(3.5 < a / b < 4.8 for a, b in zip(off, off[1:])), " ".join(f"{d:.1e}" for d in off))
    claim(f"{name}: at constant speed, to second order", 3.3 < speeds[1] / speeds[2] < 4.8,
          " ".join(f"{s:.1e}" for s in speeds))

# straight at a vertex: from the side of a neighbour, in a plane of symmetry

for n in (3, 5, 7, 12, 20):
    points, faces = bipyramid(n) if n > 3 else TETRAHEDRON
    around = [sum(v in face for face in faces) for v in range(len(points))]
    apex = around.index(n)
    other = next(v for face in faces if apex in face for v in face if v != apex)
    p, q = points[apex], points[other]
    length = math.dist(p, q)
    write_off("apex.off", points, faces)
    start = [0.8 * (a + 0.3 * (b - a)) for a, b in zip(p, q)]
    text = FROZEN.format(create="create_membrane 1 file apex.off refine 2", dt=0.002, steps=500, x=start[0],
                         y=start[1], z=start[2], v=" ".join(str((a - b) / length) for a, b in zip(p, q)))
    rows = thermo(run(text.replace("max 0.5", "max 2.0")))
    kinetic = [row["c_K"] for row in rows[1:]]
    claim(f"straight at a vertex of valence {n} at constant speed", max(kinetic) - min(kinetic) < 0.01 * kinetic[0],
          f"{(max(kinetic) - min(kinetic)) / kinetic[0]:.1e}")

# === Ranks, newton, restart

paths = {}
for ranks, newton in ((1, "on"), (2, "off"), (4, "on")):
    run(script(n=40, every=1000, newton=newton) + """
dump            1 all custom 1000 x.dump id x y z
dump_modify     1 format float %.17g
run             1000
""", ranks=ranks)
    paths[ranks, newton] = frames("x.dump")[-1]
for ranks, newton in ((2, "off"), (4, "on")):
    off = apart(paths[1, "on"], paths[ranks, newton])
    claim(f"{ranks} ranks, newton {newton}: follow one to 1e-9 over 1000 steps", off < 1e-9, f"{off:.1e}")

WHOLE = script(n=40, hold="spring auto", every=100, more="f_b f_b[1]")
rows = thermo(run(WHOLE + "run 100\nwrite_restart b.restart\nrun 200\n", ranks=2))
CONTINUED = """
read_restart    b.restart
pair_style      hybrid/overlay helfrich zero 1.0
pair_coeff      1 1 helfrich 20.0 0.0 regularize 10
pair_coeff      * * zero
""" + WHOLE[WHOLE.index("neighbor"):WHOLE.index("hd_velocity")] + WHOLE[WHOLE.index("compute         T"):]
again = thermo(run(CONTINUED + "run 200\n", ranks=2))
claim("a run continued from a restart file is the same to the last digit",
      [r["TotEng"] for r in rows[-2:]] == [r["TotEng"] for r in again[-2:]]
      and rows[-1]["f_b"] == again[-1]["f_b"], f"{rows[-1]['TotEng']} {again[-1]['TotEng']}")

other = thermo(run(CONTINUED + "run 200\n"))
off = abs(other[-1]["TotEng"] - rows[-1]["TotEng"])
claim("a restart file of two ranks continues on one, to 1e-8", off < 1e-8, f"{off:.1e}")

# === Drift

count = 100000 if LONG else 6000
for hold in ("spring auto",):
    values = energies(0.005 * count, hold=hold, dt=0.005, every=20)
    values = values[len(values) // 5:]
    parts = [values[len(values) * i // 8:len(values) * (i + 1) // 8] for i in range(8)]
    means = [sum(part) / len(part) for part in parts]
    trend, error = slope(range(8), means), spread(means) / math.sqrt(42.0)
    claim(f"{hold}: no drift of the energy over {count} steps, within three errors", abs(trend) < 3 * error,
          f"{7 * trend:.2g} +- {7 * error:.2g}, fluctuation {spread(values):.2g}")
if LONG:
    # regularize as long thermal runs need it, or the mesh loses its shape on the way

    text = script(n=100, hold="spring auto", every=1000, more="f_b[2] f_b[4]").replace(
        "regularize 10\n", "regularize 20 conformal volume 100 init\nspecial_bonds lj/coul 1 1 1\n")
    text = run(text + "run 100000\n", ranks=2, timeout=14400)
    rows = thermo(text)
    claim("1e7 particle-steps on two ranks: none lost, none further off than half an edge",
          all(r["f_b[2]"] == 100 for r in rows) and max(r["f_b[4]"] for r in rows) < 0.5,
          f"at most {max(r['f_b[4]'] for r in rows):.3f}")

finish()
