"""Modes in place of control points: motion. What they keep of the motion of all control points, energy, relaxation
rates, ranks, restarts, what is refused. doc/src/Derivation_modes.rst derives the rates."""
# cost: 30
# processors: 2

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
for fix in (THERMAL, "fix 1 all hd/nve modes sphere min 0 max 4",
            "fix 1 all hd/brownian 1.0 4711 modes sphere min 2 max 6 relax eta 1.0"):
    dt = 0.001 if "brownian" in fix else 0.01
    vesicle(fix, f"hd_velocity all 1.0 815 scale yes\ntimestep {dt}\nrestart 150 half.*.restart\n"
                 + DUMP.format("whole.dump") + "run 300")
    run("read_restart half.150.restart\npair_coeff 1 1 20.0 0.0\n" + fix + f"\ntimestep {dt}\n" + DUMP.format("rest.dump")
        + "run 150")
    ends = [open(name).read().rsplit("ITEM: TIMESTEP", 1)[-1] for name in ("whole.dump", "rest.dump")]
    claim(f"a restart in the middle of a run continues {fix.split()[3]} bit by bit", ends[0] == ends[1] and len(ends[0]) > 999)
finish()
