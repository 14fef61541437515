#!/usr/bin/env python3
"""Speed in LJ units: seconds per control point and step, over the seconds per atom and step of
LAMMPS' Lennard-Jones benchmark, both timed in this run.

  bench/run_bench.py [--lmp build/lmp] [--repeat 5] [--levels 3,5,7] [--out bench.csv]

Each case is run `repeat` times in turn with the benchmark; the table has the median of the ratios
and, in brackets, the smallest and the largest. Set-up time and memory are those of a whole run of
no steps."""

import argparse
import csv
import os
import re
import statistics
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))

# name, input variables, which line of LAMMPS' timing counts
CASES = [
    ("force, 3 points", {"quadrature": "3"}, "Pair"),
    ("force, 6 points", {"quadrature": "6"}, "Pair"),
    ("force, 6 points, area, volume",
     {"quadrature": "6", "terms": "area 100 init volume 100 init"}, "Pair"),
    ("step hd/nve, 3 points", {"quadrature": "3", "integrate": "yes", "fix": "hd/nve"}, "Loop"),
    ("step hd/nve, 6 points", {"quadrature": "6", "integrate": "yes", "fix": "hd/nve"}, "Loop"),
    ("step hd/nve mass lumped, 3 points", {"quadrature": "3", "integrate": "yes", "fix": "hd/nve mass lumped"}, "Loop"),
]


def lammps(lmp, script, variables):
    """Run a script; returns its output, wall seconds and peak memory in bytes."""
    command = [lmp, "-in", os.path.join(HERE, script), "-log", "none"]
    for name, value in variables.items():
        command += ["-var", name, value]
    start = time.time()
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status:
        sys.exit(f"this failed: {' '.join(command)}\n{output[-2000:]}")
    return output, time.time() - start, usage.ru_maxrss * 1024


def seconds_per_step(output, line):
    """Seconds per atom and step of the loop or of the pair style."""
    loop = re.search(r"Loop time of (\S+) on \d+ procs for (\d+) steps with (\d+) atoms", output)
    if line == "Loop":
        seconds = float(loop[1])
    else:
        seconds = float(re.search(r"^Pair\s*\|\s*\S+\s*\|\s*(\S+)", output, re.M)[1])
    return seconds / int(loop[2]) / int(loop[3])


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lmp", default=os.path.join(HERE, "..", "build", "lmp"))
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--levels", default="3,4,5,6,7")
    parser.add_argument("--out", default="bench.csv")
    options = parser.parse_args()
    levels = [int(level) for level in options.levels.split(",")]

    rows = []
    print("LJ units per control point: median [smallest, largest]")
    for name, variables, line in CASES:
        for level in levels:
            points = 10 * 4**level + 2
            ratios, unit_times = [], []
            for _ in range(options.repeat):
                unit = seconds_per_step(lammps(options.lmp, "in.lj", {})[0], "Loop")
                steps = str(max(10, 2000000 // points))
                output = lammps(options.lmp, "in.membrane",
                                dict(variables, level=str(level), steps=steps))[0]
                ratios.append(seconds_per_step(output, line) / unit)
                unit_times.append(unit)
            low, mid, high = min(ratios), statistics.median(ratios), max(ratios)
            print(f"{name:36s} {points:7d} points  {mid:6.3f} [{low:.3f}, {high:.3f}]   "
                  f"(LJ unit {statistics.median(unit_times) * 1e6:.3f} us)", flush=True)
            rows.append([name, points, mid, low, high])

    print("\nset-up: seconds and bytes per point of a run without steps, less those of 162 points")
    base_seconds, base_bytes = None, None
    for level in [2] + levels:
        points = 10 * 4**level + 2
        runs = [lammps(options.lmp, "in.membrane", {"level": str(level), "steps": "0"})[1:]
                for _ in range(options.repeat)]
        seconds, size = (statistics.median(column) for column in zip(*runs))
        if base_seconds is None:
            base_seconds, base_bytes = seconds, size
            continue
        extra = (size - base_bytes) / points
        print(f"set-up {points:7d} points  {seconds - base_seconds:7.3f} s  {extra:7.0f} bytes a point",
              flush=True)
        rows.append(["set-up seconds", points, seconds - base_seconds, "", ""])
        rows.append(["bytes a point", points, extra, "", ""])

    with open(options.out, "w", newline="") as table:
        writer = csv.writer(table)
        writer.writerow(["case", "points", "median", "smallest", "largest"])
        writer.writerows(rows)


if __name__ == "__main__":
    main()
