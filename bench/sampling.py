#!/usr/bin/env python3
"""What an independent sample of a vesicle's shape costs with each mass: the integrated autocorrelation time of the power of
degree 2, in steps, and the processor time until its mean is known to 1 %.

    bench/sampling.py [--lmp build/lmp] [--levels 2 3] [--inverse 20] [--scale 1.0]

--inverse is kc/kT, --scale multiplies the lengths of runs. Times are of this machine: compare them within a table. With the slow
masses runs are short of what they need at the finer meshes: their times are from below.
"""

import argparse
import math
import os
import subprocess
import tempfile

SCRIPT = """
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
create_box      1 box angle/types 1
create_membrane 1 sphere {level} 1.0 interpolate yes mass {mass!r}
special_bonds   lj/coul 1 1 1
pair_style      helfrich
pair_coeff      1 1 1.0 0.0 volume 1000.0 {volume!r} regularize {modulus} conformal
fix             1 all {fix}
timestep        {dt!r}
thermo          1000000
run             {warm}
compute         u all hd/modes sphere 2
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


parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
parser.add_argument("--lmp", default=os.path.join(os.path.dirname(__file__), "..", "build", "lmp"))
parser.add_argument("--levels", type=int, nargs="+", default=[2, 3])
parser.add_argument("--inverse", type=float, default=20.0)
parser.add_argument("--scale", type=float, default=1.0)
options = parser.parse_args()
lmp, kT = os.path.abspath(options.lmp), 1 / options.inverse

print(f"kc = {options.inverse:g} kT")
print("points  mass                      timestep  steps/tau  ms/step  seconds for 1 %")
for level in options.levels:
    points = 10 * 4 ** level + 2
    # limits of stability go with the fourth power of an edge for Brownian motion, with its square for others
    finer = 4.0 ** (2 - level)
    for name, fix, dt, steps, every in (
            ("sampling", f"hd/langevin {kT} {kT} 1.5 4711 mass sampling", 0.35, 8000, 1),
            ("sampling, hd/brownian", f"hd/brownian {kT} 4711 mass sampling", 0.2, 8000, 1),
            ("lumped", f"hd/langevin {kT} {kT} 0.1 4711 mass lumped", 0.008 * finer, 60000, 10),
            ("vertex", f"hd/langevin {kT} {kT} 0.1 4711 mass vertex", 0.0025 * finer, 60000, 20),
            ("lumped, hd/brownian", f"hd/brownian {kT} 4711 gamma_t {4 * math.pi / points} mass lumped",
             4e-4 * finer ** 2, 60000, 20)):
        steps = max(1000, int(steps * options.scale))
        with tempfile.TemporaryDirectory() as folder:
            text = dict(level=level, mass=4 * math.pi / points, volume=4 * math.pi / 3, fix=fix, dt=dt, every=every,
                        modulus=10 * kT)
            open(os.path.join(folder, "in"), "w").write(SCRIPT.format(warm=steps // 20, steps=steps, **text))
            ended = subprocess.run([lmp, "-in", "in", "-log", "none"], cwd=folder, capture_output=True, text=True)
            loop = [line.split() for line in ended.stdout.split("\n") if line.startswith("Loop time")]
            if ended.returncode or len(loop) < 2:
                error = [line for line in ended.stdout.split("\n") if line.startswith("ERROR")]
                print(f"{points:6d}  {name:24s}  stopped: {(error or ['?'])[0][:90]}")
                continue
            rows = rows_of(os.path.join(folder, "u.dat"))
        series = [[row[m] for row in rows] for m in range(4, 9)]
        tau = autocorrelation(series) * every
        # the mean of five squares of Gaussians has the variance 2/5
        cost = float(loop[1][3]) / steps
        print(f"{points:6d}  {name:24s}  {dt:8.2g}  {tau:9.1f}  {1000 * cost:7.2f}  {2 / 5 * 2 * tau * cost / 1e-4:10.0f}", flush=True)
