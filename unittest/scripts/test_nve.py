"""fix hd/nve: second order in the timestep, reversible, keeps energy and momenta, on hard meshes.

    MEMBRANE_LONG=1    drift over 1,000,000 steps in place of 60,000
"""
# cost: 20

import math

from lammps_claims import LONG, claim, finish, run, thermo
from membrane_scenes import TETRAHEDRON, bipyramid, frames, write_off
from spread_and_slope import order, slope, spread

SCENE = """
units           lj
atom_style      membrane_cp
region          box block -4 4 -4 4 -4 4
create_box      1 box angle/types 1
{create}
set             type 1 mass {mass}
pair_style      helfrich
pair_coeff      1 1 10.0 0.0 area 1000.0 init volume 1000.0 init
{prepare}
reset_timestep  0
velocity        all create {T} 4711 mom yes rot yes
fix             1 all hd/nve {options}
compute         T all hd/temp
thermo_style    custom step pe etotal c_T
thermo_modify   temp T norm no format float %.16g
"""
ICOSPHERE = dict(create="create_membrane 1 sphere 2 1.0 interpolate yes", mass=0.08, T=0.05,
                 prepare="min_style membrane\nminimize 0 1e-8 100 1000")


def energies(dt, time, options="", scene=ICOSPHERE, ranks=1, every=1):
    steps = round(time / dt)
    script = SCENE.format(**scene, options=options) + \
        f"thermo {every}\ntimestep {dt:.10g}\nrun {steps}\n"
    return [row["TotEng"] for row in thermo(run(script, ranks=ranks))[-(steps // every) - 1:]]


# === The residual that a solution reaches

for options, tolerance in (("mass vertex", 1e-10), ("mass vertex tol 1e-6", 1e-6), ("mass lumped", 1e-14),
                           ("mass consistent tol 1e-8", 1e-8), ("mass consistent solver direct", 1e-12)):
    rows = thermo(run(SCENE.format(**ICOSPHERE, options=options) +
                      "thermo_style custom step f_1[1] f_1[2]\nthermo 10\ntimestep 1e-5\nrun 20\n"))[-3:]
    worst = max(row["f_1[2]"] for row in rows)
    claim(f"{options}: the residual is reported and within a factor of 3 of tol", worst < 3 * tolerance,
          f"{worst:.1e} in {rows[-1]['f_1[1]']:.0f} passes")

# === Order of the energy error

for options in ("mass vertex", "mass consistent", "mass lumped"):
    steps = [6.4e-4 / 2**k for k in range(5)]
    errors = [spread(energies(dt, 0.0768, options + " tol 1e-13")) for dt in steps]
    power = order(steps, errors)
    claim(f"{options}: energy error goes as dt^2 over a factor 16", abs(power - 2) < 0.1,
          f"order {power:.3f}, errors " + " ".join(f"{e:.2e}" for e in errors))


# === Reversibility

REVERSE = SCENE.format(**ICOSPHERE, options="mass {mass} tol 1e-12") + """
thermo          1000
timestep        4e-4
dump            1 all custom 400 x.dump id x y z
dump_modify     1 format float %.17g
variable        a atom -vx
variable        b atom -vy
variable        c atom -vz
run             400
velocity        all set v_a v_b v_c
run             400
"""
for kind in ("vertex", "consistent", "lumped"):
    run(REVERSE.replace("{mass}", kind))
    there = frames("x.dump")
    first, middle, last = there[0], there[1], there[-1]
    back = max(abs(a - b) for p, q in zip(first, last) for a, b in zip(p, q))
    away = max(abs(a - b) for p, q in zip(first, middle) for a, b in zip(p, q))
    claim(f"mass {kind}: 400 steps forth and back return to the start to the solver's tolerance",
          back < 1e-9 and away > 1e-3, f"{back:.1e} after moving {away:.1e}")

# === Momenta, of the masses at the limit positions: sum d dr/dt and sum d r x dr/dt.
# Velocity Verlet keeps them exactly as differences of successive positions.

MOMENTA = SCENE.format(**ICOSPHERE, options="tol 1e-13") + """
compute         c all membrane/curvature/atom
thermo          1000
timestep        4e-4
dump            1 all custom 1 r.dump id c_c[3] c_c[4] c_c[5]
dump_modify     1 format float %.17g
run             1
undump          1
run             2000
dump            1 all custom 1 s.dump id c_c[3] c_c[4] c_c[5]
dump_modify     1 format float %.17g
run             1
"""


def momenta(path):
    before, after = frames(path)[-2:]
    linear, angular = [0.0] * 3, [0.0] * 3
    for (_, *r), (_, *s) in zip(before, after):
        v = [(b - a) / 4e-4 for a, b in zip(r, s)]
        for k in range(3):
            i, j = (k + 1) % 3, (k + 2) % 3
            linear[k] += 0.08 * v[k]
            angular[k] += 0.08 * (r[i] * v[j] - r[j] * v[i])
    return linear, angular


run(MOMENTA)
(p0, l0), (p1, l1) = momenta("r.dump"), momenta("s.dump")
claim("linear momentum is kept to 1e-10", max(abs(a - b) for a, b in zip(p0, p1)) < 1e-10,
      f"{max(abs(a - b) for a, b in zip(p0, p1)):.1e}")
claim("angular momentum is kept to 1e-10", max(abs(a - b) for a, b in zip(l0, l1)) < 1e-10,
      f"{max(abs(a - b) for a, b in zip(l0, l1)):.1e} of {max(map(abs, l0)):.1e}")

# === Hard meshes: half the step, a quarter of the error, and no trend

write_off("valence3.off", *TETRAHEDRON)
write_off("valence12.off", *bipyramid(12))
HARD = [("valence 3", "create_membrane 1 file valence3.off refine 2", 2e-4),
        ("valence 12", "create_membrane 1 file valence12.off refine 2", 1e-5),
        ("edge ratio 10", "create_membrane 1 sphere 2 1.0 scale 4 1 0.4", 1e-4),
        ("faces of 2 degrees", "create_membrane 1 torus 8 16 1.5 0.3", 1e-4),
        ("a sharp prolate", "create_membrane 1 sphere 2 1.0 scale 0.4 0.4 2.0", 1e-5)]
for name, create, dt in HARD:
    scene = dict(create=create, mass=0.08, T=1e-3, prepare="")
    coarse, fine = (energies(step, 400 * dt, "tol 1e-13", scene) for step in (dt, 0.5 * dt))
    ratio = spread(coarse) / spread(fine)
    claim(f"{name}: half the step has a quarter of the energy error", 3.5 < ratio < 4.5,
          f"ratio {ratio:.3f}, error {spread(fine):.1e} of {fine[0]:.1f}")

# === Drift: a torus with waves, a quarter of the stability limit, its mesh kept by weak terms

steps = 1000000 if LONG else 40000
TORUS = dict(create="create_membrane 1 torus 12 8 1.5 0.6", mass=0.08, T=1e-3,
             prepare="pair_coeff 1 1 10.0 0.0 area 1000.0 init volume 1000.0 init "
                     "regularize 0.5 area/local 1.0\nmin_style membrane\nminimize 0 1e-8 200 2000")
values = energies(6e-4, 6e-4 * steps, "", TORUS, every=20)
values = values[len(values) // 5:]    # after the transient
parts = [values[len(values) * i // 8:len(values) * (i + 1) // 8] for i in range(8)]
means = [sum(part) / len(part) for part in parts]
trend = slope(range(8), means) / (len(values) / 8 * 20) * 1e4 / values[0]
error = spread(means) / math.sqrt(42.0) / (len(values) / 8 * 20) * 1e4 / values[0]
claim(f"no drift of the energy over {steps} steps: zero within three errors, or below 1e-8 in 1e4 steps",
      abs(trend) < max(1e-8, 3 * error), f"{trend:.1e} +- {error:.1e} of the energy in 1e4 steps, "
      f"fluctuation {spread(values) / values[0]:.1e}")

# === Ranks follow the same trajectory

paths = {}
for ranks in (1, 2):
    run(SCENE.format(**dict(ICOSPHERE, prepare=""), options="tol 1e-12") + """
thermo          1000
timestep        4e-4
dump            1 all custom 1000 x.dump id x y z
dump_modify     1 format float %.17g
run             1000
""", ranks=ranks)
    paths[ranks] = frames("x.dump")[-1]
apart = max(abs(a - b) for p, q in zip(paths[1], paths[2]) for a, b in zip(p, q))
claim("2 ranks follow one to 1e-9 over 1000 steps", apart < 1e-9, f"{apart:.1e}")

# === Units: the same scene in real, metal, nano and lj
# kc = 20 kT at 300 K, R = 10 nm, 162 points of 1e5 g/mol (areas of some 8 nm^2 of a bilayer)

KT, LENGTH, MASS = 1.3806504e-23 * 300, 1e-8, 1e5 * 1.66053907e-27    # SI
LJ_KT, LJ_LENGTH, LJ_MASS = 2.5, 3.0, 0.7    # any, which sets the units of energy, distance and mass
LJ_TIME = LENGTH / LJ_LENGTH * math.sqrt((MASS / LJ_MASS) / (KT / LJ_KT))    # in seconds
UNITS = {    # energy of kT at 300 K, 10 nm, mass, time of 1 ps, in the style's units
    "real": (0.0019872067 * 300, 100.0, 1e5, 1000.0),
    "metal": (8.617343e-5 * 300, 100.0, 1e5, 1.0),
    "nano": (0.013806504 * 300, 10.0, 1e5 * 1.66053907e-6, 1e-3),
    "lj": (LJ_KT, LJ_LENGTH, LJ_MASS, 1e-12 / LJ_TIME)}
curves = {}
for units, (kT, length, mass, ps) in UNITS.items():
    rows = thermo(run(f"""
units           {units}
atom_style      membrane_cp
region          box block {-3 * length} {3 * length} {-3 * length} {3 * length} {-3 * length} {3 * length}
create_box      1 box angle/types 1
create_membrane 1 sphere 2 {length} interpolate yes scale 1 1 1.3
set             type 1 mass {mass}
pair_style      helfrich
pair_coeff      1 1 {20 * kT} 0.0
fix             1 all hd/nve
compute         shape all membrane/shape
compute         T all hd/temp
hd_velocity     all {LJ_KT if units == 'lj' else 300.0} 4711
thermo_style    custom step pe ke c_shape[1] c_shape[2]
thermo_modify   temp T norm no format float %.16g
thermo          50
timestep        {0.5 * ps}
run             500
"""))
    curves[units] = [(row["PotEng"] / kT, row["KinEng"] / kT, row["c_shape[1]"] / length**2) for row in rows]
apart = max(abs(a / b - 1) for units in ("metal", "nano", "lj")
            for p, q in zip(curves[units], curves["real"]) for a, b in zip(p, q))
moved = abs(curves["real"][-1][0] / curves["real"][0][0] - 1)
claim("units real, metal, nano and lj give the same thermal motion", apart < 1e-5 and moved > 1e-3,
      f"apart {apart:.1e}, moved {moved:.1e}")

finish()
