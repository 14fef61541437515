"""fix hd/langevin and hd/brownian: relaxation rates of one mode, temperature, energy balance, restarts,
ranks."""
# cost: 15

import math

from lammps_claims import claim, error_of, finish, run, thermo

# a sheet of 16 x 16 points of edge 1, and a wave along x of 16 edges; kc = 1

SHEET = """
units           lj
atom_style      membrane_cp
region          box block 0 16 0 13.856406460551018 -4 4
create_box      1 box angle/types 1
create_membrane 1 plane 16 16
pair_style      helfrich
pair_coeff      1 1 1.0 0.0 {terms}
variable        phase atom 2*PI*x/16
variable        wave atom 1e-4*cos(v_phase)
set             type 1 z v_wave
variable        part atom z*cos(v_phase)/128/1e-4
compute         amplitude all reduce sum v_part
{fix}
thermo_style    custom step c_amplitude
thermo_modify   norm no format float %.12g
thermo          {every}
timestep        {dt}
run             {steps}
"""
q = 2 * math.pi / 16
area = math.sqrt(3) / 2                       # of a vertex
omega = q * q / math.sqrt(1 / area)           # kc = rho area = 1


def decay(fix, dt, steps, every, terms=""):
    rows = thermo(run(SHEET.format(fix=fix, dt=dt, steps=steps, every=every, terms=terms)))
    return [(row["Step"] * dt, row["c_amplitude"]) for row in rows]


gamma = 0.2 * omega
curve = decay(f"fix 1 all hd/langevin 0 0 {1 / gamma} 1", 0.05, 1800, 10)
ring = math.sqrt(omega**2 - gamma**2 / 4)
exact = [math.exp(-gamma * t / 2) * (math.cos(ring * t) + gamma / (2 * ring) * math.sin(ring * t))
         for t, _ in curve]
worst = max(abs(a - b) for (_, a), b in zip(curve, exact))
claim("underdamped: a mode rings down as exp(-t/2 damp) within 2 %", worst < 0.02, f"{worst:.5f}")


def rate(curve):
    (t0, a0), (t1, a1) = curve[len(curve) // 2], curve[-1]
    return math.log(a0 / a1) / (t1 - t0)


gamma = 20 * omega
root = gamma / 2 - math.sqrt(gamma**2 / 4 - omega**2)
measured = rate(decay(f"fix 1 all hd/langevin 0 0 {1 / gamma} 1", 0.05, 3000, 100))
claim("overdamped: relaxation in gamma/omega^2 within 2 %", abs(measured / root - 1) < 0.02,
      f"{100 * (measured / root - 1):+.3f} %")

for sigma in (0.0, 0.5):
    zeta = 100.0 / area
    measured = rate(decay("fix 1 all hd/brownian 0 1 gamma_t 100", 0.5, 1500, 100,
                          f"tension {sigma}" if sigma else ""))
    exact = (q**4 + sigma * q**2) / zeta
    claim(f"Brownian, tension {sigma}: tau = zeta/(kc q^4 + sigma q^2) within 2 %",
          abs(measured / exact - 1) < 0.02, f"{100 * (measured / exact - 1):+.3f} %")

# === A thermal vesicle

VESICLE = """
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
create_box      1 box angle/types 1
create_membrane 1 torus 12 8 1.5 0.6 mass 0.1
pair_style      helfrich
pair_coeff      1 1 10.0 0.0 area 500.0 init volume 500.0 init regularize 1.0
{fix}
compute         T all hd/temp
compute_modify  T extra/dof 0
thermo_style    custom step pe ke etotal c_T
thermo_modify   temp T norm no format float %.16g
thermo          10
timestep        2e-4
"""

for mass in ("vertex", "consistent", "lumped"):
    fix = f"fix 1 all hd/langevin 0.5 0.5 0.02 4711 mass {mass}"
    rows = thermo(run(VESICLE.format(fix=fix) + "run 1000\nrun 10000\n"))[101:]
    mean = sum(row["c_T"] for row in rows) / len(rows)
    error = math.sqrt(2 / 288 / (10000 * 2e-4 / 0.02))
    claim(f"mass {mass}: the mean temperature is that of the bath within three standard errors",
          abs(mean / 0.5 - 1) < 3 * error, f"{mean:.5f} +- {0.5 * error:.5f} of 0.5")

fix = "fix 1 all hd/langevin 0.1 0.1 0.1 4711 tally yes\nfix_modify 1 energy yes"
rows = thermo(run(VESICLE.format(fix=fix) + "run 5000\n"))
total, bath = [row["TotEng"] for row in rows], [row["KinEng"] for row in rows]
claim("energy of membrane and bath together is kept",
      max(total) - min(total) < 0.02 * max(bath) and max(bath) > 1.0,
      f"{max(total) - min(total):.2e} while kinetic energy rises to {max(bath):.2f}")

# === Restarts and ranks: noise depends on step and atom only

DUMP = """
dump            1 all custom 200 {path} id x y z vx vy vz
dump_modify     1 format float %.17g sort id
"""
for name, fix in (("hd/nve", "velocity all create 0.1 99\nfix 1 all hd/nve"),
                  ("hd/langevin", "fix 1 all hd/langevin 0.5 0.5 0.1 4711"),
                  ("hd/brownian", "fix 1 all hd/brownian 0.5 4711 gamma_t 30")):
    run(VESICLE.format(fix=fix) + "run 200\nwrite_restart half.restart\n" +
        DUMP.format(path="straight.dump") + "run 200\n")
    run("read_restart half.restart\n" + fix.split("\n")[-1] + "\ntimestep 2e-4\n" +
        DUMP.format(path="again.dump") + "run 200\n")
    claim(f"{name}: a run continued from a restart file is bitwise the same",
          open("straight.dump").read() == open("again.dump").read())
    last = {}
    for ranks in (1, 2):
        run(VESICLE.format(fix=fix) + DUMP.format(path="r.dump") + "run 200\n", ranks=ranks)
        lines = open("r.dump").read().split("ITEM: ATOMS")[-1].split("\n")[1:-1]
        last[ranks] = [float(word) for line in lines for word in line.split()[1:4]]
    apart = max(abs(a - b) for a, b in zip(last[1], last[2]))
    claim(f"{name}: 2 ranks follow one", apart < 1e-9, f"{apart:.1e}")

# === Wrong input

for fix, said in (("hd/langevin 1 1 0 4711", "damping time 0 must be positive"),
                  ("hd/langevin 1 1 -0.1 4711", "damping time -0.1 must be positive"),
                  ("hd/langevin -1 1 1 4711", "must not be negative"),
                  ("hd/langevin 1 -1 1 4711", "must not be negative"),
                  ("hd/brownian -1 4711 gamma_t 1", "must not be negative"),
                  ("hd/nve tol 0", "tol 0 must be between"),
                  ("hd/brownian 1 4711 gamma_t 1 tol 1e-20", "tol 1e-20 must be between"),
                  ("hd/langevin 1 1 1 0", "seed 0 must be positive"),
                  ("hd/langevin 1 1 1 4711 tol 1", "tol 1 must be between"),
                  ("hd/langevin 1 1 1 4711 mass heavy", "mass heavy is not"),
                  ("hd/langevin 1 1 1 4711 scale 1 2 mass consistent", "scale needs mass"),
                  ("hd/brownian 1 4711", "needs gamma_t"),
                  ("hd/brownian 1 4711 gamma_t -1", "must be positive"),
                  ("hd/nve mass lumped solver direct", "needs no solver"),
                  ("hd/nve thermostat", "Unknown fix hd/nve keyword thermostat")):
    error = error_of(VESICLE.format(fix=f"fix 1 all {fix}") + "run 0\n")
    claim(f"fix {fix}", said in error, error)
two = "fix 0 all {}\nfix 1 all hd/nve"
for other in ("hd/langevin 1 1 1 1", "nve", "nvt temp 1 1 1"):
    error = error_of(VESICLE.format(fix=two.format(other)) + "run 0\n")
    claim(f"two integrators, the other is {other}", "are also moved by fix" in error, error)
error = error_of(VESICLE.format(fix="group half id <= 40\nfix 1 half hd/nve") + "run 0\n")
claim("a group that cuts a membrane", "group half has 40 of the 96 control points" in error, error)
error = error_of(VESICLE.format(fix="set atom 5 mass 0.0\nfix 1 all hd/nve") + "run 0\n")
claim("no mass", "mass" in error, error)

finish()
