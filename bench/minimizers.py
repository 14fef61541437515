#!/usr/bin/env python3
"""min_style membrane against LAMMPS' own: a flattened sphere relaxed to an oblate vesicle (in.deflate).

  bench/minimizers.py [--lmp build/lmp] [--plugin FILE] [--levels 2 3 4] [--styles cg fire]

Style membrane runs until it stops. The others may evaluate forces ten times as often, without a tolerance that would
stop them. What is printed is after how many evaluations each comes within 0.1 % of the least energy found, and how far
above that energy it ends.

How another minimizer fares hangs on the rounding of a machine, so it is not the tests' to claim: each is started
from coordinates that differ by 1e-12, and from other shapes. --plugin loads a membraneplugin.so into --lmp, so that
builds of the package for other machines (MEMBRANE_MARCH) can be compared."""

import argparse
import math
import os
import re
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
with open(os.path.join(HERE, "in.deflate")) as file:
    SCRIPT = file.read()
# name, height of the flattened sphere, size of random displacements, seeds
STARTS = (("0.6 high", 0.6, 0.0, (1,)), ("0.6 high, other rounding", 0.6, 1e-12, (1, 2, 3)),
          ("0.6 high, rough", 0.6, 1e-3, (1,)), ("0.5 high", 0.5, 0.0, (1,)), ("0.8 high", 0.8, 0.0, (1,)))


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lmp", default=os.path.join(HERE, "..", "build", "lmp"))
    parser.add_argument("--plugin")
    parser.add_argument("--levels", nargs="+", type=int, default=(2, 3, 4))
    parser.add_argument("--styles", nargs="+", default=("cg", "fire"))
    return parser.parse_args()


def relax(options, level, style, height, noise, seed, evaluations):
    """Evaluations taken, and the energy after each iteration."""
    script = SCRIPT.replace("scale 1 1 0.6\n", f"scale 1 1 {height}\n" +
                            f"displace_atoms all random {noise} {noise} {noise} {seed} units box\n" * (noise > 0))
    script = script.replace("fnorm", "fnorm pe").replace("thermo          10", "thermo          1")
    tolerance = "1e-7" if style == "membrane" else "0"
    script = script.replace("minimize        1.0e-7 0.0 10000", f"minimize        {tolerance} 0.0 1000000")
    if options.plugin:
        script = f"plugin load {os.path.abspath(options.plugin)}\n" + script
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([os.path.abspath(options.lmp), "-log", "none", "-var", "level", str(level),
                               "-var", "style", style, "-var", "evals", str(evaluations)],
                              input=script, capture_output=True, text=True, cwd=folder)
    used = re.findall(r"Iterations, force evaluations = \d+ (\d+)", done.stdout)
    if done.returncode or not used:
        sys.exit(done.stdout + "\nthis failed")
    table = done.stdout.split("PotEng")[-1].split("Loop time")[0]
    return int(used[-1]), [float(line.split()[-1]) for line in table.splitlines() if line.strip()]


def until(used, energies, limit):
    """Evaluations until the energy stays below a limit, those of an iteration taken to be equally many."""
    above = max((i for i, energy in enumerate(energies) if energy > limit), default=-1)
    return round(used * (above + 1) / (len(energies) - 1)) if above + 1 < len(energies) else math.inf


def spread(values, form):
    low, high = form.format(min(values)), form.format(max(values))
    return low if low == high else f"{low} to {high}"


def main():
    options = parse()
    print("points | start | style | evaluations | those to 0.1 % above | above in the end, %", flush=True)
    for level in options.levels:
        for name, height, noise, seeds in STARTS:
            found = {"membrane": [relax(options, level, "membrane", height, noise, seed, 2000) for seed in seeds]}
            most = 10 * max(used for used, _ in found["membrane"])
            for style in options.styles:
                found[style] = [relax(options, level, style, height, noise, seed, most) for seed in seeds]
            least = min(energies[-1] for runs in found.values() for _, energies in runs)
            for style, runs in found.items():
                print(10 * 4 ** level + 2, name, style, spread([used for used, _ in runs], "{}"),
                      spread([until(*run, 1.001 * least) for run in runs], "{}"),
                      spread([100 * (energies[-1] / least - 1) for _, energies in runs], "{:.3f}"),
                      sep=" | ", flush=True)


if __name__ == "__main__":
    main()
