#!/usr/bin/env python3
"""Error against cost: what each choice of quadrature, mass, solver tolerance, timestep and mesh size
buys. Cost is in LJ units, as in run_bench.py: time of a control point and step over that of an atom
and step of LAMMPS' Lennard-Jones benchmark, in this run.

  bench/accuracy.py [STUDY...] [--lmp build/lmp] [--out FOLDER]

Studies: energy, modes, steps, thermal, relaxed, sphere, sampling, hot; by default all. Each writes STUDY.csv and, with
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

    def attempt(self, script, files=None, fetch=None):
        """Run a script in a folder with these files {name: text}: exit code, and what LAMMPS printed or, with
        fetch, wrote to the file of that name."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text in (files or {}).items():
                with open(os.path.join(folder, name), "w") as file:
                    file.write(text)
            done = subprocess.run([self.path, "-log", "none"], input=script, capture_output=True, text=True,
                                  cwd=folder)
            if fetch and not done.returncode:
                with open(os.path.join(folder, fetch)) as file:
                    return 0, file.read()
        return done.returncode, done.stdout

    def run(self, script, files=None, fetch=None):
        code, output = self.attempt(script, files, fetch)
        if code:
            sys.exit(f"{script}\n{output[-2000:]}\nthis failed")
        return output

    def measure_unit(self):
        with open(os.path.join(HERE, "in.lj")) as file:
            self.units.append(self.per_point(self.run(file.read()), "Loop"))

    def cost(self, output, line="Loop"):
        return self.per_point(output, line) / statistics.median(self.units)

    def total_cost(self, output):
        """LJ atom-steps of all runs and minimizations of a script together."""
        walls = re.findall(r"^Loop time of (\S+) on", output, re.M)
        shares = re.findall(r"^([\d.]+)% CPU use", output, re.M)
        return sum(float(wall) * 0.01 * float(share) for wall, share in zip(walls, shares)) / \
            statistics.median(self.units)

    @staticmethod
    def per_point(output, line):
        """Processor seconds, so that what other programs take meanwhile does not count."""
        loop = re.findall(r"Loop time of (\S+) on \d+ procs for (\d+) steps with (\d+) atoms", output)[-1]
        share = 0.01 * float(re.findall(r"^([\d.]+)% CPU use", output, re.M)[-1])
        total = loop[0] if line == "Loop" else re.findall(rf"^{line}\s*\|\s*\S+\s*\|\s*(\S+)", output, re.M)[-1]
        return share * float(total) / int(loop[1]) / int(loop[2])


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
    return ["mass", "tol", "timestep over limit", "cost of a point", "error",
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


# === A relaxed shape: the red blood cell of reduced volume 0.65, by the multiplier method of
# examples/vesicle: ask for as much more area and volume as was missing

OBLATE = 1.826233    # axisymmetric minimum, E/(8 pi kc)


def relaxed(lammps):
    rows, area, volume = [], 4 * math.pi, 0.65 * 4 * math.pi / 3
    for rule, weak in (("3", ""), ("3", "regularize 0.01"), ("6", ""), ("6", "regularize 0.01"), ("12", "")):
        for level in (2, 3, 4):
            script = HEAD + f"""
region          box block -3 3 -3 3 -3 3
create_box      1 box angle/types 1
create_membrane 1 sphere {level} 1.0 scale 1.2 1.2 0.6
pair_style      helfrich quadrature {rule}
pair_coeff      1 1 1.0 0.0 area 1.0e4 {area!r} volume 1.0e4 {volume!r} {weak}
compute         hf all pair helfrich
compute         s all membrane/shape quadrature careful
thermo_style    custom step c_hf[1] c_s[5] c_s[9] c_s[1] c_s[2]
thermo_modify   norm no format float %.15g
thermo          100000
variable        area equal {area!r}
variable        volume equal {volume!r}
min_style       membrane
minimize        1e-8 0 300 3000
""" + 3 * f"""
run             0 post no
variable        area equal $(v_area+{area!r}-c_s[1]:%.15g)
variable        volume equal $(v_volume+{volume!r}-c_s[2]:%.15g)
pair_coeff      1 1 1.0 0.0 area 1.0e4 ${{area}} volume 1.0e4 ${{volume}} {weak}
minimize        0 0 300 3000
"""
            output = lammps.run(script)
            _, by_rule, careful, angle, *_ = [row for row in thermo(output) if len(row) == 6][-1]
            rows.append([rule, weak.split()[-1] if weak else "0", 10 * 4**level + 2, lammps.total_cost(output),
                         careful / (8 * math.pi) / OBLATE - 1, by_rule / (8 * math.pi), careful / (8 * math.pi), angle])
        lammps.measure_unit()
    return ["quadrature", "regularize", "points", "cost", "error", "by the rule", "careful", "smallest angle"], rows


def plot_relaxed(axes, rows):
    for rule, weak in (("3", "0.01"), ("6", "0.01"), ("6", "0"), ("12", "0")):
        mine = [row for row in rows if row[0] == rule and row[1] == weak]
        axes.loglog([row[3] for row in mine], [abs(row[4]) for row in mine], marker="o" if weak == "0" else "^",
                    linestyle="-" if weak == "0" else "--",
                    label=f"{rule} points" + (f", regularize {weak} kc" if weak != "0" else ""))
    axes.set(xlabel="cost of the whole minimization (LJ atom-steps)", ylabel="relative error of the bending energy",
             title="A vesicle of reduced volume 0.65, relaxed: 162, 642, 2,562 points")
    axes.legend(fontsize=8)


# === Vesicles: the slowest mode, degree 2, with equal masses and with masses as the areas around the points

def areas(points, faces):
    """A third of the flat faces around each point."""
    total = [0.0] * len(points)
    for face in faces:
        a, b, c = (points[v] for v in face)
        u, v = [y - x for x, y in zip(a, b)], [y - x for x, y in zip(a, c)]
        n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        for corner in face:
            total[corner] += math.hypot(*n) / 6
    return total


def mesh_of(data):
    """Points and faces of a data file."""
    section, points, faces = "", {}, []
    for line in data.splitlines():
        words = line.split("#")[0].split()
        if words[:1] in (["Atoms"], ["Angles"], ["Velocities"]):
            section = words[0]
        elif section == "Atoms" and len(words) >= 7:
            points[int(words[0])] = [float(word) for word in words[4:7]]
        elif section == "Angles" and len(words) == 5:
            faces.append(tuple(int(word) - 1 for word in words[2:5]))
    return [points[i] for i in sorted(points)], faces


def frequency_of(t, u, guess):
    """omega of the best u = a cos(omega t) + b, by golden section within 10 % of a guess."""
    def misfit(omega):
        c = [math.cos(omega * time) for time in t]
        n, sc, su = len(t), sum(c), sum(u)
        a = (n * sum(map(float.__mul__, c, u)) - sc * su) / (n * sum(x * x for x in c) - sc * sc)
        b = (su - a * sc) / n
        return sum((y - a * x - b)**2 for x, y in zip(c, u))
    low, high, golden = 0.9 * guess, 1.1 * guess, 0.5 * (math.sqrt(5) - 1)
    for _ in range(40):
        left, right = high - golden * (high - low), low + golden * (high - low)
        if misfit(left) < misfit(right):
            high = right
        else:
            low = left
    return 0.5 * (low + high)


def sphere(lammps):
    rows = []
    terms = f"volume 100.0 {4 * math.pi / 3!r}"
    ball = HEAD + "region box block -3 3 -3 3 -3 3\ncreate_box 1 box angle/types 1\ncreate_membrane 1 {}\n" \
        f"pair_style helfrich\npair_coeff 1 1 1.0 0.0 {terms}\n"
    for level in (2, 3, 4):
        points, faces = mesh_of(lammps.run(ball.format(f"sphere {level} 1.0 interpolate yes") +
                                           "min_style membrane\nminimize 0 0 50 2000\nwrite_data mesh.data nocoeff\n",
                                           fetch="mesh.data"))
        share = areas(points, faces)
        shape = [[c * (1 + 1e-5 * (1.5 * p[2]**2 / sum(x * x for x in p) - 0.5)) for c in p] for p in points]
        off = f"OFF\n{len(points)} {len(faces)} 0\n" + "".join("%.17g %.17g %.17g\n" % tuple(p) for p in shape) + \
            "".join("3 %d %d %d\n" % face for face in faces)
        for name, mass in (("equal", [4 * math.pi / len(share)] * len(share)),
                           ("as the areas", [4 * math.pi * a / sum(share) for a in share])):
            files = {"ball.off": off,
                     "mass.txt": f"{len(mass)}\n" + "".join(f"{i} {m!r}\n" for i, m in enumerate(mass, 1))}
            script = ball.format("file ball.off") + "variable mass atomfile mass.txt\nset group all mass v_mass\n"
            dt = 0.5 * number("stability limit", lammps.run(script + "hd_timestep all\n", files))
            steps = round(1.5 * 2 * math.pi / math.sqrt(24.0) / dt)
            rows_of_run = thermo(lammps.run(script + f"""
compute         m all hd/modes sphere 2
compute         s all membrane/shape
fix             1 all hd/nve
thermo_style    custom step c_m[7][4] c_m[1] c_s[1]
thermo_modify   norm no format float %.17g
timestep        {dt:.17g}
thermo          {max(1, steps // 120)}
run             {steps}
""", files))
            _, _, radius, area = rows_of_run[0]
            theory = math.sqrt(24.0 * area / (4 * math.pi)) / radius**2
            omega = frequency_of([row[0] * dt for row in rows_of_run], [row[1] for row in rows_of_run], theory)
            rows.append([name, len(mass), omega / theory - 1])
    return ["masses", "points", "error"], rows


# === Waves in equilibrium: what the mean power of one costs to a standard error of 1 %, and the mesh's error

def sheet(nx, ny, terms):
    return HEAD + f"""
region          box block 0 {nx} 0 {ny * math.sqrt(0.75):.17g} -6 6
create_box      1 box angle/types 1
create_membrane 1 plane {nx} {ny} mass {math.sqrt(0.75):.17g}
comm_modify     cutoff 5.0
pair_style      helfrich
pair_coeff      1 1 1.0 0.0 {terms}
compute         m all hd/modes plane 1
"""


def correlation_time(series, dt):
    """Integral of the autocorrelation of the square of a Gaussian amplitude, which is the square of that of
    the amplitude; summed up to five times itself."""
    n = len(series)
    variance, total = sum(x * x for x in series) / n, 0.5
    for lag in range(1, n // 10):
        total += (sum(map(float.__mul__, series[:-lag], series[lag:])) / (n - lag) / variance)**2
        if lag > 5 * total:
            break
    return total * dt


def sampling(lammps):
    rows, kT = [], 1e-4
    methods = {("langevin", mass): f"hd/langevin {kT} {kT} {{damp!r}} 4711 mass {mass} tol 1e-6" for mass in ("vertex", "lumped")}
    methods |= {("brownian", mass): f"hd/brownian {kT} 4711 gamma_t {math.sqrt(0.75)!r} mass {mass} tol 1e-6"
                for mass in ("vertex", "lumped")}
    ratios = {method: [] for method in methods}    # a step of a large sheet, in LJ units
    for _ in range(5):
        for method, fix in methods.items():
            lammps.measure_unit()
            output = lammps.run(sheet(48, 48, "regularize 0.1") + f"fix 1 all {fix.format(damp=3.0)}\nfix_modify 1 check no\n"
                                "timestep 0.005\nthermo 1000000\nrun 200\n")
            ratios[method].append(lammps.per_point(output, "Loop") / lammps.units[-1])
    for edges, ny in ((6, 8), (8, 10), (12, 14), (16, 18)):
        q = 2 * math.pi / edges
        still = thermo(lammps.run(sheet(edges, ny, "") + f"""
variable        z atom 1e-5*cos({q!r}*x)
set             group all z v_z
thermo_style    custom step pe c_m[3][6]
thermo_modify   norm no format float %.15g
run             0
"""))[0]
        mesh = edges * ny * math.sqrt(0.75) * q**4 * still[2] / still[1] - 1
        for (name, mass), fix in methods.items():
            if name == "brownian" and (edges > 12 or mass == "vertex" and edges > 8):
                continue    # much too long
            # damp: the wave's own time, near critical damping; drag: tau = 1/q^4
            fix = fix.format(damp=0.5 / q**2)
            setup = sheet(edges, ny, "regularize 0.1") + f"fix 1 all {fix}\nfix_modify 1 check no\n"
            dt = 0.5 * number("stability limit", lammps.run(setup + "hd_timestep all\n"))
            every = max(1, int((1 / q**2 if name == "langevin" else 1 / q**4) / 8 / dt))
            output = lammps.run(setup + f"""
timestep        {dt:.12g}
thermo          1000000
run             {every * 100}
thermo_style    custom step c_m[3][4] c_m[3][5]
thermo_modify   norm no format float %.9g
thermo          {every}
run             {every * 4000}
""")
            table = thermo(output)
            tau = sum(correlation_time([row[k] for row in table], every * dt) for k in (1, 2)) / 2
            needed = 1e4 * 2 * tau / dt    # the relative variance of a wave's power is 1; 2 tau lie between samples
            step = statistics.median(ratios[name, mass])
            # edges^2 / sqrt(3/4) points in a wavelength squared
            rows.append([name, mass, edges, dt, tau, needed * edges**2 / math.sqrt(0.75) * step, step, mesh])
    return ["integrator", "mass", "edges a wave", "timestep", "correlation time", "cost of 1 %", "cost of a step",
            "error of the mesh"], rows


def plot_sampling(axes, rows):
    for name, mass in (("langevin", "vertex"), ("langevin", "lumped"), ("brownian", "vertex"), ("brownian", "lumped")):
        mine = [row for row in rows if row[:2] == [name, mass]]
        axes.loglog([row[2] for row in mine], [row[5] for row in mine], color=STYLE[mass][0], marker=STYLE[mass][1],
                    linestyle="-" if name == "langevin" else "--", label=f"hd/{name}, mass {mass}")
    axes.set_xticks([6, 8, 12, 16], ["6", "8", "12", "16"])
    axes.minorticks_off()
    axes.set(xlabel="edges a wave", ylabel="cost of its mean power to 1 %\n(LJ atom-steps for a wavelength squared)",
             title="Sampling the slowest wave of a sheet, half the stability limit")
    axes.legend(fontsize=8, loc="lower right")


# === The same at the temperature of a lipid bilayer, kc = 20 kT, where edges and with them the limit vary

def hot(lammps):
    rows, kT = [], 0.05
    for mass, limit in (("vertex", 0.204124), ("lumped", 0.649519)):    # of the flat sheet
        for fraction in (0.0625, 0.125, 0.25, 0.375, 0.5):
            dt = fraction * limit
            steps = round(4000 / dt)
            code, output = lammps.attempt(sheet(12, 14, "regularize 0.5") + f"""
fix             1 all hd/langevin {kT} {kT} 3.0 4711 mass {mass} tol 1e-8 measure no
compute         hf all pair helfrich
compute         s all membrane/shape
thermo_style    custom step c_hf[1] c_s[9] c_s[7] c_s[8]
thermo_modify   norm no
timestep        {dt:.12g}
thermo          {max(1, steps // 20000)}
run             {steps}
""")
            table = thermo(output)
            if code:
                rows.append([mass, fraction, "", "", "", "", f"stops after step {table[-1][0]:.0f}"])
                continue
            table = table[len(table) // 20:]
            values = [row[1] / (168 * kT) for row in table]
            blocks = [statistics.mean(values[len(values) * i // 20:len(values) * (i + 1) // 20]) for i in range(20)]
            rows.append([mass, fraction, statistics.mean(blocks), statistics.stdev(blocks) / math.sqrt(20),
                         min(row[2] for row in table), max(row[4] for row in table), "runs"])
    return ["mass", "timestep over limit", "bending energy of a point in kT", "standard error", "smallest angle",
            "longest edge", ""], rows


STUDIES = {"energy": (energy, plot_energy), "modes": (modes, plot_modes), "steps": (steps, plot_steps),
           "thermal": (thermal, plot_thermal), "relaxed": (relaxed, plot_relaxed), "sphere": (sphere, None),
           "sampling": (sampling, plot_sampling), "hot": (hot, None)}


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
        os.makedirs(options.out, exist_ok=True)
        path = os.path.join(options.out, name)
        with open(path + ".csv", "w", newline="") as table:
            csv.writer(table).writerows([head] + rows)
        if not draw:
            continue
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
