"""Modes in place of control points: motion. What they keep of the motion of all control points, energy, relaxation
rates, ranks, restarts, what is refused. doc/src/Derivation_modes.rst derives the rates."""
# cost: 15

import math

from lammps_claims import MPIEXEC, claim, error_of, finish, run, thermo

ETA = 0.7

# a sheet of 16 x 16 points of edge 1, kc = 1, and a wave of 16/n edges along x

SHEET = """
units           lj
atom_style      membrane_cp
region          box block 0 16 0 13.856406460551018 -4 4
create_box      1 box angle/types 1
create_membrane 1 plane 16 16 mass 1.0
pair_style      helfrich
pair_coeff      1 1 1.0 0.0 {terms}
{start}
{fix}
compute         h all hd/modes plane 2 quadrature careful
thermo_style    custom step c_h[{row}][4] pe ke etotal
thermo_modify   norm no format float %.15g
thermo          {every}
timestep        {dt}
run             {steps}
"""
AREA = 16 * 13.856406460551018
DENSITY = 256 / AREA


def wave(n, height=1e-4):
    return f"variable wave atom {height}*cos(2*PI*{n}*x/16)\nset type 1 z v_wave"


def sheet(fix, n=1, terms="", dt=0.05, steps=1000, every=100, start=None, **options):
    script = SHEET.format(fix=fix, row=1 + (5 * n + 0) - 1, terms=terms, dt=dt, steps=steps, every=every,
                          start=start or wave(n))
    return thermo(run(script, **options))


def amplitudes(rows, n=1):
    return [row[f"c_h[{5 * n}][4]"] for row in rows]


# === The linear problem: a wave is a normal mode of the whole sheet

for mass in ("vertex", "consistent", "lumped"):
    full = amplitudes(sheet(f"fix 1 all hd/nve mass {mass} tol 1e-13"))
    modal = amplitudes(sheet(f"fix 1 all hd/nve mass {mass} tol 1e-13 modes plane min 1 max 2"))
    worst = max(abs(a - b) for a, b in zip(full, modal)) / max(map(abs, full))
    claim(f"small waves with mass {mass}: modes move as they do among all control points, to 1e-8", worst < 1e-8,
          f"{worst:.1e}")

# === Energy

VESICLE = """
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
{processors}
create_box      1 box angle/types 1
create_membrane 1 sphere {level} 1.0 interpolate yes mass 1.0 {center}
pair_style      helfrich
pair_coeff      1 1 20.0 0.0 {terms}
{fix}
compute         T all hd/temp
thermo_style    custom step temp pe ke etotal {more}
thermo_modify   norm no temp T format float %.15g
{rest}
"""


def vesicle(fix, rest, level=2, terms="", more="", center="", processors="", **options):
    return thermo(run(VESICLE.format(fix=fix, rest=rest, level=level, terms=terms, more=more, center=center,
                                     processors=processors), **options))


def spread(dt, steps):
    rows = vesicle("fix 1 all hd/nve modes sphere min 2 max 6",
                   f"hd_velocity all 1.0 4711\nthermo 5\ntimestep {dt}\nrun {steps}")
    energy = [row["TotEng"] for row in rows]
    mean = sum(energy) / len(energy)
    half = len(energy) // 2
    drift = sum(energy[half:]) / (len(energy) - half) - sum(energy[:half]) / half
    return math.sqrt(sum((e - mean) ** 2 for e in energy) / len(energy)), drift


(coarse, _), (fine, drift) = spread(0.01, 2000), spread(0.005, 4000)
claim("energy errors of nve are of second order in the timestep", 3.5 < coarse / fine < 4.5, f"{coarse / fine:.3f}")
claim("energy does not drift", abs(drift) < 0.3 * fine, f"{drift:.1e} of {fine:.1e}")

# === Relaxation, without noise


def rate(values, dt):
    n = len(values)
    return math.log(values[n // 4] / values[-1]) / (dt * (n - 1 - n // 4))


for n, sigma in ((1, 0.0), (2, 0.0), (1, 0.5)):
    q = 2 * math.pi * n / 16
    stiff = q ** 4 + sigma * q ** 2
    theory = stiff / (4 * ETA * q)
    terms = f"tension {sigma}" if sigma else ""
    dt = 0.02 / theory
    values = amplitudes(sheet(f"fix 1 all hd/brownian 0.0 4711 modes plane {n} 0 relax eta {ETA}", n, terms, dt, 100, 1), n)
    got = rate(values, dt) * (1 - 0.01)    # Euler's step: ln(1 - 0.02) is -0.02 (1 + 0.01)
    claim(f"hd/brownian relax eta: wave {n} under tension {sigma} has its hydrodynamic rate within 2 %",
          abs(got / theory - 1) < 0.02, f"{100 * (got / theory - 1):+.2f} %")

q = 2 * math.pi / 16
theory = q ** 3 / (4 * ETA)
inertia = 1 + q ** 4 * DENSITY / (4 * ETA * q) ** 2    # to first order
dt = 0.05
values = amplitudes(sheet(f"fix 1 all hd/langevin 0.0 0.0 NULL 4711 modes plane 1 0 relax eta {ETA}", 1, "", dt, 4000, 10))
got = rate(values, 10 * dt)
claim("hd/langevin relax eta: the same with mass, which hastens it a little", abs(got / theory / inertia - 1) < 0.02,
      f"{100 * (got / theory / inertia - 1):+.2f} %")

omega = q * q / math.sqrt(DENSITY)
gamma = 20 * omega
root = gamma / 2 - math.sqrt(gamma ** 2 / 4 - omega ** 2)
values = amplitudes(sheet(f"fix 1 all hd/langevin 0.0 0.0 {1 / gamma} 4711 modes plane 1 0", 1, "", 0.05, 3000, 100))
got = rate(values, 5.0)
claim("hd/langevin with one damping time: a mode relaxes as theory says within 2 %", abs(got / root - 1) < 0.02,
      f"{100 * (got / root - 1):+.2f} %")
for mass in ("vertex", "lumped"):
    theory = q ** 4 * (AREA / 256) / 2.0
    dt = 0.02 / theory
    values = amplitudes(sheet(f"fix 1 all hd/brownian 0.0 4711 gamma_t 2.0 mass {mass} modes plane 1 0", 1, "", dt, 100, 1))
    got = rate(values, dt) * (1 - 0.01)
    expected = theory if mass == "vertex" else theory * (1 - q * q / 8) ** 2    # control points are higher than the wave they make
    claim(f"hd/brownian gamma_t, mass {mass}: a mode relaxes in drag over stiffness within 2 %",
          abs(got / expected - 1) < 0.02, f"{100 * (got / expected - 1):+.2f} %")

for l in (2, 3, 5):
    theory = 20.0 / ETA * (l - 1) * (l + 2) * l * (l + 1) * l * (l + 1) / (2 * l + 1) / (2 * l * l + 2 * l - 1)
    dt = 0.02 / theory
    row = 1 + l * l - 4 + l    # of m = 0 among degrees from 2
    rows = vesicle(f"fix 1 all hd/brownian 0.0 4711 modes sphere min 2 max 6 relax eta {ETA}",
                   "compute u all hd/modes sphere 6\nvariable c atom z/sqrt(x*x+y*y+z*z)\n"
                   + {2: "variable p atom 1.5*v_c^2-0.5", 3: "variable p atom 2.5*v_c^3-1.5*v_c",
                      5: "variable p atom (63*v_c^5-70*v_c^3+15*v_c)/8"}[l]
                   + "\nvariable dx atom x*(1+1e-4*v_p)\nvariable dy atom y*(1+1e-4*v_p)\nvariable dz atom z*(1+1e-4*v_p)\n"
                   "set type 1 x v_dx y v_dy z v_dz\n"
                   f"thermo_style custom step pe f_1[{row}][4]\nthermo_modify format float %.15g\nthermo 1\ntimestep {dt}\nrun 100", level=3)
    values = [r[f"f_1[{row}][4]"] for r in rows]
    got = rate(values, dt) * (1 - 0.01)
    claim(f"relax eta: degree {l} has the rate of Milner and Safran within 2 %", abs(got / theory - 1) < 0.02,
          f"{100 * (got / theory - 1):+.2f} %")

with open("times.table", "w") as file:
    file.write("# nx ny, time\n1 0 25.0  # the longest\n")
values = amplitudes(sheet("fix 1 all hd/brownian 0.0 4711 modes plane 1 0 relax time times.table", 1, "", 0.5, 100, 1))
got = rate(values, 0.5) * (1 - 0.01) * 25.0
claim("relax time: a mode relaxes in the time of the table within 2 %", abs(got - 1) < 0.02, f"{100 * (got - 1):+.2f} %")

# === The same modes on any number of ranks, with newton on and off, and after a restart

THERMAL = "fix 1 all hd/langevin 1.0 1.0 NULL 4711 modes sphere min 2 max 6 relax eta 1.0"
COLUMNS = "f_1[1][4] f_1[2][6] f_1[7][8] f_1[12][9]"
RUN = "timestep 0.01\nthermo 1000\nrun 1000"
one = vesicle(THERMAL, RUN, more=COLUMNS)[-1]
for ranks, note in ((2, "newton on"), (4, "newton off")) if MPIEXEC else ():
    other = vesicle(THERMAL, RUN, more=COLUMNS, processors="" if note == "newton on" else "newton off", ranks=ranks,
                    center="")[-1]
    worst = max(abs(one[k] - other[k]) / max(abs(one[k]), 1e-3) for k in one)
    claim(f"{ranks} ranks and {note} give 1,000 steps of one rank to 1e-9", worst < 1e-9, f"{worst:.1e}")

shifted = vesicle(THERMAL, RUN, more=COLUMNS, center="center 2.9 -2.9 1.0")[-1]
worst = max(abs(one[k] - shifted[k]) / max(abs(one[k]), 1e-3) for k in one)
claim("a vesicle across the periodic boundary moves the same", worst < 1e-8, f"{worst:.1e}")

DUMP = "dump d all custom 100 {} id x y z vx vy vz\ndump_modify d sort id format float %.17g\n"


def last_frame(path):
    with open(path) as file:
        return file.read().rsplit("ITEM: TIMESTEP", 1)[-1]


for fix in (THERMAL, "fix 1 all hd/nve modes sphere min 0 max 4",
            "fix 1 all hd/brownian 1.0 4711 modes sphere min 2 max 6 relax time degrees.table"):
    with open("degrees.table", "w") as file:
        file.write("".join(f"{l} {1 / l}\n" for l in range(2, 7)))
    dt = 0.001 if "brownian" in fix else 0.01
    vesicle(fix, f"hd_velocity all 1.0 815\ntimestep {dt}\nrun 150\nwrite_restart half.restart\n"
                 + DUMP.format("whole.dump") + "run 150")
    run("read_restart half.restart\npair_coeff 1 1 20.0 0.0\n" + fix + f"\ntimestep {dt}\n" + DUMP.format("rest.dump")
        + "run 150")
    whole, rest = last_frame("whole.dump"), last_frame("rest.dump")
    claim(f"a run of {fix.split()[3]} continued from a restart file is bitwise the same", whole == rest and len(rest) > 999)

# === Commands between two runs

between = vesicle("fix 1 all hd/nve modes sphere min 2 max 4",
                  "hd_velocity all 1.0 815\ntimestep 0.01\nthermo 200\nrun 200\nreset_atoms id\nrun 0\nreplicate 2 1 1\nrun 0\n"
                  "displace_atoms all move 0.7 -0.2 0.1\nrun 200", more="f_1[1][4]")
straight = vesicle("fix 1 all hd/nve modes sphere min 2 max 4", "hd_velocity all 1.0 815\ntimestep 0.01\nthermo 200\nrun 400",
                   more="f_1[1][4]")
ends = [between[-1]["f_1[1][4]"], straight[-1]["f_1[1][4]"]]
claim("modes go on after reset_atoms id, replicate and displace_atoms", abs(ends[0] - ends[1]) < 1e-9 * abs(ends[1]), ends)

# steps are short for the waves, not for edges of 0.06 to 0.08

rows = vesicle("fix 1 all hd/brownian 1.0 4711 modes sphere min 2 max 3 relax eta 1.0",
               "timestep 0.0005\ncompute x all property/atom x y z\ncompute m all reduce max c_x[1] c_x[2] c_x[3]\n"
               "thermo_style custom step c_m[1] c_m[2] c_m[3]\nthermo 1\nrun 100", level=4)
most = max(abs(now[f"c_m[{k}]"] - before[f"c_m[{k}]"]) for before, now in zip(rows, rows[1:]) for k in (1, 2, 3))
claim("modes may move more than a quarter of an edge in a step", len(rows) == 101 and most > 0.02, most)
line = error_of(VESICLE.format(fix="fix 1 all hd/brownian 1.0 4711 modes sphere min 2 max 3 relax eta 1.0",
                               rest="timestep 0.1\nrun 300", level=2, terms="", more="", center="", processors=""))
claim("not more than a quarter of 1/q: one clear line", "and of 1/q of the shortest wave" in line, line)

# === What is refused

MODES = "fix 1 all hd/langevin 1.0 1.0 1.0 4711 "
for text, fix, words in (
        ("degrees beyond the mesh's limit", MODES + "modes sphere min 2 max 11", "modes up to l = 10"),
        ("sphere modes of l = 1", MODES + "modes sphere min 1 max 4", "begin with 2, or with 0"),
        ("plane modes of a vesicle", MODES + "modes plane min 1 max 2", "membrane 1 is closed, no sheet: use modes sphere"),
        ("an unknown shape", MODES + "modes cube 2", "is not plane, sphere or file"),
        ("max below min", MODES + "modes sphere min 4 max 3", "max must be between min and 200"),
        ("modes with mass sampling", MODES + "mass sampling modes sphere min 2 max 4", "mass sampling moves all control points"),
        ("relax without modes", MODES + "relax eta 1.0", "say modes before it"),
        ("relax with a damping time", MODES + "modes sphere min 2 max 4 relax eta 1.0", "say NULL for the damping time"),
        ("NULL without relax", "fix 1 all hd/langevin 1.0 1.0 NULL 4711 modes sphere min 2 max 4", "without relax it must be"),
        ("relax with hd/nve", "fix 1 all hd/nve modes sphere min 2 max 4 relax eta 1.0", "has no friction"),
        ("relax with gamma_t", "fix 1 all hd/brownian 1.0 1 gamma_t 1.0 modes sphere min 2 max 4 relax eta 1.0", "leave gamma_t out"),
        ("a negative viscosity", "fix 1 all hd/langevin 1 1 NULL 4 modes sphere min 2 max 4 relax eta -1", "must be positive"),
        ("a table that is missing", "fix 1 all hd/langevin 1 1 NULL 4 modes sphere min 2 max 4 relax time none", "cannot read file none"),
        ("a mode that is not in the table", "fix 1 all hd/langevin 1 1 NULL 4 modes sphere min 2 max 7 relax time degrees.table",
         "has no time for mode 7"),
        ("the measure with modes", MODES + "measure yes modes sphere min 2 max 4", "leave it out with modes"),
        ("scale with modes", MODES + "scale 1 2.0 modes sphere min 2 max 4", "use relax with modes"),
        ("two fixes for one membrane", MODES + "modes sphere min 2 max 4\nfix 2 all hd/nve modes sphere min 2 max 4",
         "fixes 1 and 2 move atoms of the group"),
        ("a shape far from a sphere", "change_box all x final -9 9\nvariable far atom 4*x\nset type 1 x v_far\n" + MODES + "modes sphere min 2 max 4",
         "is far from a sphere"),
        ("a box that changes", MODES + "modes sphere min 2 max 4\nfix d all deform 1 x erate 0.1", "those of one box")):
    script = VESICLE.format(fix=fix, rest="run 1", level=2, terms="", more="", center="", processors="")
    line = error_of(script)
    claim(f"{text}: one clear line", words in line, line)

solvent = ("group m type 1\ncreate_solvent 2 both 3.0 4711 mass 1.0\ngroup s type 2\nfix 1 m hd/nve modes sphere min 2 max 4\n"
           "fix 2 s srd/mesh 1 m 1.0 1.0 4711 shift yes 9127")
line = error_of(VESICLE.replace("create_box      1", "create_box      2").format(
    fix=solvent, rest="timestep 0.01\nrun 1", level=2, terms="", more="", center="", processors=""))
claim("solvent around a membrane of modes: one clear line", "have relax eta in place of solvent" in line, line)
line = error_of(SHEET.format(fix=MODES + "modes sphere min 2 max 4", row=5, terms="", dt=0.1, steps=1, every=1, start=wave(1)))
claim("sphere modes of a sheet: one clear line", "is no sphere: use modes plane" in line, line)
line = error_of(SHEET.format(fix=MODES + "modes plane 9 0", row=5, terms="", dt=0.1, steps=1, every=1, start=wave(1)))
claim("waves beyond the mesh's limit: one clear line", "waves as long as two edges or more" in line, line)
sheet("fix 1 all hd/nve modes plane min 1 max 5", steps=10)
claim("waves up to the limit of the mesh run", True)
finish()
