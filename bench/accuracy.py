#!/usr/bin/env python3
"""Error against cost: what each choice of quadrature, mass, solver tolerance, timestep and mesh size
buys. Cost is in LJ units, as in run_bench.py: time of a control point and step over that of an atom
and step of LAMMPS' Lennard-Jones benchmark, in this run.

  bench/accuracy.py [STUDY...] [--lmp build/lmp] [--out FOLDER]

Studies: energy, modes, steps, thermal; by default all. Each writes STUDY.csv and, with
python3-matplotlib, STUDY.png, which Howto_membrane_accuracy shows."""

import argparse
import csv
import math
import os
import re
import statistics
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
MASSES = ("vertex", "consistent", "lumped")
STYLE = {"vertex": ("tab:blue", "o"), "consistent": ("tab:green", "s"), "lumped": ("tab:orange", "^")}


class Lammps:
    """Runs scripts and knows the LJ unit, taken now and then between them."""

    def __init__(self, path):
        self.path, self.units = os.path.abspath(path), []
        self.measure_unit()

    def run(self, script):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([self.path, "-log", "none"], input=script, capture_output=True, text=True,
                                  cwd=folder)
        if done.returncode:
            sys.exit(f"{script}\n{done.stdout[-2000:]}\nthis failed")
        return done.stdout

    def measure_unit(self):
        with open(os.path.join(HERE, "in.lj")) as file:
            self.units.append(self.per_point(self.run(file.read()), "Loop"))

    def cost(self, output, line="Loop"):
        return self.per_point(output, line) / statistics.median(self.units)

    @staticmethod
    def per_point(output, line):
        loop = re.findall(r"Loop time of (\S+) on \d+ procs for (\d+) steps with (\d+) atoms", output)[-1]
        total = loop[0] if line == "Loop" else re.findall(rf"^{line}\s*\|\s*\S+\s*\|\s*(\S+)", output, re.M)[-1]
        return float(total) / int(loop[1]) / int(loop[2])


def thermo(output):
    """Rows of the last thermo table, as lists of numbers."""
    rows = []
    for line in output.splitlines():
        words = line.split()
        if words[:1] == ["Step"]:
            rows = []
        try:
            rows.append([float(word) for word in words]) if len(words) > 1 else None
        except ValueError:
            pass
    return rows


def number(name, output):
    return float(re.findall(rf"{name}\s+(\S+)", output)[-1])


HEAD = "units lj\natom_style membrane_cp\nspecial_bonds lj/coul 1 1 1\n"


# === Static energy: a Clifford torus whose limit positions are on the torus, exact 4 pi^2 kc

def energy(lammps):
    rows = []
    for nx, ny in ((24, 16), (48, 32), (96, 64), (192, 128)):
        for rule in ("1", "3", "6", "12"):
            output = lammps.run(HEAD + f"""
region          box block -3 3 -3 3 -3 3
create_box      1 box angle/types 1
create_membrane 1 torus {nx} {ny} {math.sqrt(2.0):.17g} 1.0 interpolate yes
pair_style      helfrich quadrature {rule}
pair_coeff      1 1 1.0 0.0
compute         hf all pair helfrich
thermo_style    custom step c_hf[1]
thermo_modify   norm no format float %.15g
run             0
thermo          1000000
neigh_modify    delay 1000000
run             {max(20, 200000 // (nx * ny))}
""")
            value = thermo(output)[0][1]
            rows.append([rule, nx * ny, lammps.cost(output, "Pair"), abs(value / (4 * math.pi**2) - 1)])
        lammps.measure_unit()
    return ["quadrature", "points", "cost", "error"], rows


def plot_energy(axes, rows):
    for rule in ("1", "3", "6", "12"):
        mine = [row for row in rows if row[0] == rule]
        axes.loglog([row[1] * row[2] for row in mine], [row[3] for row in mine], marker="o",
                    label=f"{rule} point{'s' if rule != '1' else ''} a face")
    axes.set(xlabel="cost of an evaluation of energy and forces (LJ atom-steps)",
             ylabel="relative error of the bending energy", title="Clifford torus, 384 to 24,576 control points")
    axes.legend()


# === Frequency of a wave of length 16 on sheets of 8, 16 and 32 edges a wave: Rayleigh's quotient of the
# discrete system, and the cost of a period at a quarter of the stability limit

def modes(lammps):
    rows = []
    exact = 2 * math.pi / (2 * math.pi / 16)**2
    for edges in (4, 8, 16, 32):
        side = 2 * edges
        box = f"0 32 0 {32 * math.sqrt(3) / 2:.17g} -8 8"
        for rule in ("1", "3", "6"):
            for mass in MASSES:
                setup = HEAD + f"""
region          box block {box}
create_box      1 box angle/types 1
create_membrane 1 plane {side} {side}
set             type 1 mass {(32 / side)**2 * math.sqrt(3) / 2:.17g}
pair_style      helfrich quadrature {rule}
pair_coeff      1 1 1.0 0.0
"""
                # a wave along x, let go at rest: its period from where it turns
                output = lammps.run(setup + f"fix 1 all hd/nve mass {mass}\nhd_timestep all\n")
                limit = number("stability limit", output)
                dt = exact / math.ceil(exact / min(limit / 4, exact / 400))
                steps = round(exact / dt)
                output = lammps.run(setup + f"""
variable        phase atom 2*PI*x/16
variable        wave atom 1e-4*cos(v_phase)
set             type 1 z v_wave
variable        part atom z*cos(v_phase)/{side * side / 2}/1e-4
compute         a all reduce sum v_part
fix             1 all hd/nve mass {mass}
thermo_style    custom step c_a
thermo_modify   norm no format float %.15g
thermo          {steps // 4}
timestep        {dt:.17g}
run             {steps // 4}
""")
                amplitude = thermo(output)[-1][1]    # cos(omega t) close to its first zero
                phase = math.acos(max(-1.0, min(1.0, amplitude)))
                # velocity Verlet: sin(omega_dt dt/2) = omega dt/2
                apparent = phase / (dt * (steps // 4))
                omega = 2 / dt * math.sin(apparent * dt / 2)
                lammps_cost = lammps.cost(output)
                rows.append([mass, rule, edges, lammps_cost * side * side * exact / (limit / 4),
                             abs(omega * exact / (2 * math.pi) - 1), limit])
        lammps.measure_unit()
    return ["mass", "quadrature", "edges a wave", "cost of a period", "error", "stability limit"], rows


def plot_modes(axes, rows):
    for mass in MASSES:
        for rule, line in (("1", ":"), ("3", "--"), ("6", "-")):
            mine = [row for row in rows if row[0] == mass and row[1] == rule]
            axes.loglog([row[3] for row in mine], [row[4] for row in mine], color=STYLE[mass][0],
                        marker=STYLE[mass][1], linestyle=line, label=f"{mass}, {rule} point{'s' * (rule != '1')}")
    axes.set(xlabel="cost of a period at 1/4 of the stability limit (LJ atom-steps)",
             ylabel="relative error of the frequency", title="A wave of 4, 8, 16 and 32 edges")
    axes.legend(fontsize=7, ncol=3)


# === Energy error of dynamics: a vesicle, over timestep, mass and solver tolerance

VESICLE = HEAD + """
region          box block -3 3 -3 3 -3 3
create_box      1 box angle/types 1
create_membrane 1 sphere 3 1.0 interpolate yes
set             type 1 mass 0.02
pair_style      helfrich quadrature 6
pair_coeff      1 1 10.0 0.0 area 1000.0 init volume 1000.0 init
min_style       membrane
minimize        0 1e-8 100 1000
reset_timestep  0
fix             1 all hd/nve {options}
hd_velocity     all 1e-4 4711
compute         T all hd/temp
thermo_style    custom step etotal ke
thermo_modify   temp T norm no format float %.17g
thermo          1
"""


def steps(lammps):
    rows = []
    span = None
    for mass in MASSES:
        limit = number("stability limit", lammps.run(VESICLE.format(options=f"mass {mass}") + "hd_timestep all\n"))
        span = span or 400 * limit
        choices = [(part, "1e-10") for part in (0.8, 0.5, 0.25, 0.125, 0.0625)]
        if mass != "lumped":
            choices += [(0.25, tol) for tol in ("1e-2", "1e-3", "1e-4", "1e-6", "1e-8", "1e-12")]
        for part, tol in choices:
            dt = part * limit
            output = lammps.run(VESICLE.format(options=f"mass {mass} tol {tol}") +
                                f"timestep {dt:.12g}\nrun {round(span / dt)}\n")
            table = thermo(output)
            energies = [row[1] for row in table]
            mean = sum(energies) / len(energies)
            kinetic = sum(row[2] for row in table) / len(table)
            error = math.sqrt(sum((e - mean)**2 for e in energies) / len(energies)) / kinetic
            third = len(energies) // 3
            drift = abs(sum(energies[-third:]) - sum(energies[:third])) / third / kinetic
            rows.append([mass, tol, part, lammps.cost(output) * span / limit / part / 400, error, drift])
        lammps.measure_unit()
    return ["mass", "tol", "timestep over limit", "cost of a point and of one limit of mass vertex", "error",
            "drift"], rows


def plot_steps(axes, rows):
    for mass in MASSES:
        color, marker = STYLE[mass]
        mine = [row for row in rows if row[0] == mass and row[1] == "1e-10"]
        axes.loglog([row[3] for row in mine], [row[4] for row in mine], color=color, marker=marker,
                    label=f"{mass}, timestep 0.8 ... 1/16 of its limit")
        other = [row for row in rows if row[0] == mass and row[1] != "1e-10"]
        if other:
            axes.loglog([row[3] for row in other], [row[4] for row in other], color=color, marker="x",
                        linestyle="none", label=f"{mass}, 1/4 of its limit, tol 1e-2 ... 1e-12")
    axes.set(xlabel="cost of a control point per stability limit of mass vertex (LJ atom-steps)",
             ylabel="fluctuation of the total energy\nover the kinetic energy", title="A vesicle of 642 points")
    axes.legend(fontsize=7)


# === Sampling: mean bending energy of a thermal sheet, kT/2 for each of its N - 1 waves

def thermal(lammps):
    rows = []
    kT, points = 1e-4, 256
    for name, mass, fraction in [("langevin", mass, part) for mass in ("vertex", "lumped")
                                 for part in (0.9, 0.7, 0.5, 0.25)] + \
                                [("brownian", "vertex", part) for part in (0.5, 0.25, 0.1)]:
        fix = {"langevin": f"hd/langevin {kT} {kT} 1.0 4711 mass {mass}",
               "brownian": f"hd/brownian {kT} 4711 gamma_t 1.0 mass {mass}"}[name]
        setup = HEAD + f"""
region          box block 0 16 0 {16 * math.sqrt(3) / 2:.17g} -4 4
create_box      1 box angle/types 1
create_membrane 1 plane 16 16
pair_style      helfrich
pair_coeff      1 1 1.0 0.0 regularize 0.05
fix             1 all {fix}
fix_modify      1 check no
"""
        limit = number("stability limit", lammps.run(setup + f"hd_timestep all mass {mass}\n"
                                                     if name == "langevin" else
                                                     setup + "hd_timestep all\n"))
        dt = fraction * limit
        output = lammps.run(setup + f"""
compute         hf all pair helfrich
thermo_style    custom step c_hf[1]
thermo_modify   norm no format float %.15g
thermo          20
timestep        {dt:.12g}
run             40000
""")
        values = [row[1] for row in thermo(output)]
        values = values[len(values) // 10:]
        blocks = [statistics.mean(values[len(values) * i // 20:len(values) * (i + 1) // 20]) for i in range(20)]
        expected = 0.5 * (points - 1) * kT
        rows.append([name, mass, fraction, lammps.cost(output), statistics.mean(blocks) / expected - 1,
                     statistics.stdev(blocks) / math.sqrt(20) / expected])
        if len(rows) % 4 == 0:
            lammps.measure_unit()
    return ["integrator", "mass", "timestep over limit", "cost", "bias", "standard error"], rows


def plot_thermal(axes, rows):
    for name, mass in (("langevin", "vertex"), ("langevin", "lumped"), ("brownian", "vertex")):
        mine = [row for row in rows if row[0] == name and row[1] == mass]
        axes.errorbar([row[2] for row in mine], [100 * row[4] for row in mine], yerr=[100 * row[5] for row in mine],
                      capsize=3, label=f"hd/{name}, mass {mass}", marker="d" if name == "brownian" else STYLE[mass][1],
                      color="tab:red" if name == "brownian" else STYLE[mass][0])
    axes.axhline(0.0, color="grey", linewidth=0.8)
    axes.set(xlabel="timestep over stability limit", ylabel="error of the mean bending energy (%)",
             title="A thermal sheet of 256 points")
    axes.legend()


STUDIES = {"energy": (energy, plot_energy), "modes": (modes, plot_modes), "steps": (steps, plot_steps),
           "thermal": (thermal, plot_thermal)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("studies", nargs="*", metavar="STUDY", help=", ".join(STUDIES))
    parser.add_argument("--lmp", default=os.path.join(HERE, "..", "build", "lmp"))
    parser.add_argument("--out", default=".")
    options = parser.parse_args()
    for name in options.studies:
        if name not in STUDIES:
            parser.error(f"{name} is not one of {', '.join(STUDIES)}")
    lammps = Lammps(options.lmp)
    for name in options.studies or STUDIES:
        study, draw = STUDIES[name]
        head, rows = study(lammps)
        print(f"\n{name}\n" + "".join(f"{word:>24}" for word in head))
        for row in rows:
            print("".join(f"{x:24.3g}" if isinstance(x, float) else f"{x:>24}" for x in row), flush=True)
        path = os.path.join(options.out, name)
        with open(path + ".csv", "w", newline="") as table:
            csv.writer(table).writerows([head] + rows)
        try:
            import matplotlib
            matplotlib.use("Agg")
            import matplotlib.pyplot as plt
        except ImportError:
            print("no picture: install python3-matplotlib")
            continue
        figure, axes = plt.subplots(figsize=(6.4, 4.4), layout="constrained")
        draw(axes, rows)
        axes.grid(which="major", linewidth=0.3)
        figure.savefig(path + ".png", dpi=90)
    print(f"\nLJ unit {1e6 * statistics.median(lammps.units):.3f} us, {1e6 * min(lammps.units):.3f} to "
          f"{1e6 * max(lammps.units):.3f}")


if __name__ == "__main__":
    main()
