#!/usr/bin/env python3
"""What an independent sample of a vesicle's shape costs with each mass: the integrated autocorrelation time of the power of
degree 2, in steps, and the processor time until its mean is known to 1 %.

    bench/sampling.py [--lmp build/lmp] [--levels 2 3 4] [--inverse 20] [--scale 1.0] [--only sampling]

--inverse is kc/kT, --scale multiplies the lengths of runs, --only takes masses whose name begins so. Timesteps of masses
lumped and vertex are a part of what hd_timestep finds, a quarter at kc = 20 kT and a half at 100 kT or colder. Times are
processor times of this machine, without those of the measurement: compare them within a table. A run shorter than 50
correlation times is marked with >: its time is from below. "of forces" is the time of a step over that of an evaluation of
the forces alone. Modes are those of degree 0 and 2 to 6, without regularize, which they do not need.
"""

import argparse
import math
import os
import subprocess
import tempfile

SCENE = """
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
create_box      1 box angle/types 1
create_membrane 1 sphere {level} 1.0 interpolate yes mass {mass!r}
special_bonds   lj/coul 1 1 1
pair_style      helfrich
pair_coeff      1 1 1.0 0.0 volume 1000.0 {volume!r} {regularize}
{fix}
thermo          1000000
"""
LIMIT = """
hd_timestep     all
"""
FORCES = """
timestep        0.0
run             {steps}
"""
RUN = """
timestep        {dt!r}
run             {warm}
run             {timed}
compute         u all hd/modes sphere 2 quadrature 3
fix             2 all ave/time {every} 1 {every} c_u[4] mode vector file u.dat
run             {steps}
"""


def autocorrelation(series):
    """Of the squares of several Gaussian series of mean 0: 1/2 + sum of the square of their correlation, in samples."""
    n = len(series[0])
    variance = sum(sum(a * a for a in x) for x in series) / n
    tau, lag, quiet = 0.5, 1, 0
    while lag < n // 3:
        c = sum(sum(x[i] * x[i + lag] for i in range(n - lag)) for x in series) / (n - lag) / variance
        quiet = quiet + 1 if c * c < 0.004 else 0
        if quiet >= 4:
            break
        tau += c * c
        lag += 1
    return tau


def rows_of(path):
    rows, missing = [], 0
    for words in (line.split() for line in open(path) if not line.startswith("#")):
        if missing:
            rows[-1].append(float(words[1]))
            missing -= 1
        else:
            rows.append([])
            missing = int(words[1])
    return rows


def lines_of(text, **values):
    """What lmp prints of a script, run in a folder of its own, and the rows that it left; or the error."""
    with tempfile.TemporaryDirectory() as folder:
        open(os.path.join(folder, "in"), "w").write(text.format(**values))
        ended = subprocess.run([lmp, "-in", "in", "-log", "none"], cwd=folder, capture_output=True, text=True)
        lines = ended.stdout.split("\n")
        if ended.returncode:
            raise RuntimeError(([line for line in lines if line.startswith("ERROR")] + ["?"])[0][:90])
        path = os.path.join(folder, "u.dat")
        return lines, rows_of(path) if os.path.exists(path) else []


def seconds_of(lines, run):
    """Processor time of a run, the first is 0."""
    loops = [float(line.split()[3]) for line in lines if line.startswith("Loop time")]
    use = [float(line.split("%")[0]) for line in lines if "% CPU use" in line]
    return loops[run] * use[run] / 100


parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
parser.add_argument("--lmp", default=os.path.join(os.path.dirname(__file__), "..", "build", "lmp"))
parser.add_argument("--levels", type=int, nargs="+", default=[2, 3, 4])
parser.add_argument("--inverse", type=float, default=20.0)
parser.add_argument("--scale", type=float, default=1.0)
parser.add_argument("--only", default="")
options = parser.parse_args()
lmp, kT, cold = os.path.abspath(options.lmp), 1 / options.inverse, options.inverse >= 100
part = 0.5 if cold else 0.25

print(f"kc = {options.inverse:g} kT")
print("points  mass                    timestep  power/theory  steps/tau  ms/step  of forces  seconds for 1 %")
for level in options.levels:
    points = 10 * 4 ** level + 2
    long, longer = {2: (8000, 60000), 3: (8000, 30000), 4: (4000, 15000)}.get(level, (300, 1000))
    # name, fix, timestep or None: a part of the limit, steps, steps between samples
    for name, fix, dt, steps, every in (
            ("sampling", f"hd/langevin {kT} {kT} {0.6 if cold else 1.0} 4711 mass sampling", 1.0 if cold else 0.8 if level < 5 else 0.4, long, 1),
            ("sampling, hd/brownian", f"hd/brownian {kT} 4711 mass sampling", 0.8 if cold else 0.4 if level < 5 else 0.1, long, 1),
            ("lumped", f"hd/langevin {kT} {kT} 0.1 4711 mass lumped", None, longer, 10),
            ("vertex", f"hd/langevin {kT} {kT} 0.1 4711 mass vertex", None, longer, 10),
            ("lumped, hd/brownian", f"hd/brownian {kT} 4711 gamma_t {4 * math.pi / points} mass lumped", None, longer, 20),
            ("modes", f"hd/langevin {kT} {kT} 0.15 4711 modes sphere min 0 max 6", None, longer, 5),
            ("modes, relax eta", f"hd/brownian {kT} 4711 modes sphere min 0 max 6 relax eta 1", None, longer, 20)):
        if not name.startswith(options.only):
            continue
        regularize = "" if "modes" in name else f"regularize {0.5 if cold else 1.0} conformal"
        values = dict(level=level, mass=4 * math.pi / points, volume=4 * math.pi / 3, fix="fix 1 all " + fix, every=every,
                      regularize=regularize)
        steps = max(200, int(steps * options.scale))
        try:
            if dt is None:
                limit = [line for line in lines_of(SCENE + LIMIT, **values)[0] if line.startswith("  stability limit")]
                dt = part * float(limit[0].split()[-1])
            lines, rows = lines_of(SCENE + RUN, dt=dt, warm=steps // 20, timed=steps // 20, steps=steps, **values)
        except RuntimeError as error:
            print(f"{points:6d}  {name:22s}  stopped: {error}", flush=True)
            continue
        series = [[row[m] for row in rows] for m in range(4, 9)]
        tau = autocorrelation(series) * every
        # the mean of five squares of Gaussians has the variance 2/5
        cost, variance = seconds_of(lines, 1) / (steps // 20), 2 / 5 * 2 * tau
        evaluation = seconds_of(lines_of(SCENE + FORCES, **{**values, "fix": ""}, steps=steps // 20)[0], 0) / (steps // 20)
        power = sum(a * a for x in series for a in x) / 5 / len(rows) / (kT / 24)
        mark = " " if steps > 50 * tau else ">"
        error = 1000 * power * math.sqrt(variance / steps)
        print(f"{points:6d}  {name:22s}  {dt:8.2g}  {power:6.3f}({error:3.0f})  {mark}{tau:9.1f}  "
              f"{1000 * cost:7.2f}  {cost / evaluation:9.2f}  {mark}{variance * cost / 1e-4:10.0f}", flush=True)
