#!/usr/bin/env python3
"""Speed in LJ units: seconds per control point and step, over the seconds per atom and step of
LAMMPS' Lennard-Jones benchmark, both timed in this run.

  bench/run_bench.py [--lmp build/lmp] [--repeat 5] [--levels 3,4,5,6,7] [--ranks 2] [--solvent yes] [--out bench]

A sphere of 10*4^level + 2 control points; with 2,562 of them also meshes of random valences, a thermal vesicle
of 1,800 points (4 to 11) and the sphere with flips of random edges (4 to 10, random_valences.py); with 10,242 points also
ten lipids a face that trade places. Last fix srd/mesh beside LAMMPS' fix srd, the same solvent in the same box, in
bulk and around a vesicle of 642 control points, if lmp has LAMMPS' package SRD: --levels "" has that alone.
In each round the benchmark is run before the cases of a level; the tables have the median over the rounds and, in
brackets, the smallest and the largest; that of solvent also the ratio of the fastest rounds, which a busy machine
disturbs least. Writes OUT.csv and, with python3-matplotlib, OUT.png."""

import argparse
import csv
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time

from random_valences import random_valences, write_off

HERE = os.path.dirname(os.path.abspath(__file__))

FAST = {"quadrature": "3"}
DEFAULT = {"quadrature": "6"}
THERMAL = {"read": "yes", "mesh": os.path.join(HERE, "..", "unittest", "meshes", "thermal_1800.off")}
THERMAL_POINTS = 1800
IRREGULAR_LEVEL = 4
# ten lipids a face and leaflet at 10,242 points; runs have two sweeps of their exchange
LIPIDS_LEVEL, LIPIDS_STEPS = 5, 200
LIPIDS = {"terms": "lipids NULL outer A 50 B 50 inner A 50 B 50 library A 6.1e-5 0.5 library B 6.1e-5 -0.5"}
TOTALS = {"terms": "area 100 init volume 100 init"}
REGULARIZED = {"terms": TOTALS["terms"] + " regularize 1.0 conformal"}


# messages of some kB go through memory that processes share: the kernel, which is asked to copy them else, is slow
OPEN_MPI = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
            "OMPI_MCA_btl_vader_single_copy_mechanism": "none", "OMPI_MCA_btl_vader_eager_limit": "16384"}


def fix(style):
    return {"integrate": "yes", "fix": style}


# name, input variables, line of LAMMPS' timing that counts
CASES = {
    "force, 3 points": (FAST, "Pair"),
    "force, 6 points": (DEFAULT, "Pair"),
    "force, 6 points, area and volume": ({**DEFAULT, **TOTALS}, "Pair"),
    "hd/nve, 3 points": ({**FAST, **fix("hd/nve")}, "Loop"),
    "hd/nve solver iterative, 3 points": ({**FAST, **fix("hd/nve solver iterative")}, "Loop"),
    "hd/nve, 6 points": ({**DEFAULT, **fix("hd/nve")}, "Loop"),
    "hd/nve, 6 points, area and volume": ({**DEFAULT, **TOTALS, **fix("hd/nve")}, "Loop"),
    "hd/nve, 6 points, area, volume, regularize": ({**DEFAULT, **REGULARIZED, **fix("hd/nve")}, "Loop"),
    "hd/nve mass lumped, 3 points": ({**FAST, **fix("hd/nve mass lumped")}, "Loop"),
    "hd/langevin, 3 points": ({**FAST, **fix("hd/langevin 1.0 1.0 1.0 4711 measure no")}, "Loop"),
}
THERMAL_CASES = {
    "force, 3 points, thermal mesh": ({**FAST, **THERMAL}, "Pair"),
    "force, 6 points, thermal mesh": ({**DEFAULT, **THERMAL}, "Pair"),
}
FLIPPED_CASES = {    # with the name of a file for the mesh
    "force, 3 points, random flips": (FAST, "Pair"),
    "force, 6 points, random flips": (DEFAULT, "Pair"),
}
LIPID_CASES = {
    "hd/nve, 6 points, composition": ({**DEFAULT, **LIPIDS, **fix("hd/nve")}, "Loop"),
    "hd/nve, 6 points, a sweep of lipids every 100 steps":
        ({**DEFAULT, **LIPIDS, **fix("hd/nve"), "exchange": "yes"}, "Loop"),
}
# input variables of in.srd
SOLVENT_CASES = {
    "fix srd, bulk": {"fix": "srd", "args": "cubic warn 0.01"},
    "fix srd/mesh, bulk": {"fix": "srd/mesh"},
    "fix srd/mesh, bulk, thermostat": {"fix": "srd/mesh", "args": "angle 90 tstat yes"},
    "fix srd/mesh, vesicle of 642 points": {"fix": "srd/mesh", "vesicle": "yes"},
    "fix srd/mesh, vesicle, quadrature 3": {"fix": "srd/mesh", "vesicle": "yes", "quadrature": "3"},
    "fix srd/mesh, vesicle, level 1": {"fix": "srd/mesh", "vesicle": "yes", "args": "angle 90 level 1"},
    "fix srd/mesh, vesicle, slip": {"fix": "srd/mesh", "vesicle": "yes", "args": "angle 90 collision slip"},
}
# M^-1 f: what the fix takes with the mass matrix, less what it takes with a diagonal one
SOLVE = "M^-1 f, tol 1e-10"
MASK = "one solve with L"
# hd/nve is direct on one process up to 15,000 points, and never on several
SCALING = ["hd/nve, 3 points", "hd/nve solver iterative, 3 points", "hd/langevin, 3 points"]

# floating-point operations of a quadrature point in the kernel of membrane_helfrich.cpp, no optional term: 5 derivatives
# of points by threes, see membrane_threefold.h, forth and back, their combinations, and the energy density with its chain rule
FLOPS = 2 * 3 * (20 + 11 / 3) + 2 * (4 * 8 + 4 * 6 + 20) + (26 + 42) + 160

PEAK = r"""
#include <chrono>
#include <cstdio>
#if defined(__AVX512F__)
constexpr int LANES = 8;
#elif defined(__AVX__)
constexpr int LANES = 4;
#else
constexpr int LANES = 2;    // wider vectors than the machine's would go through memory
#endif
typedef double V __attribute__((vector_size(8 * LANES)));
int main()
{
  V x[10], a = {}, b = {};
  for (int l = 0; l < LANES; ++l) a[l] = 1.0 - 1e-9 * l, b[l] = 1e-9;
  for (auto &v : x) v = a;
  double best = 0.0;
  for (int repeat = 0; repeat < 20; ++repeat) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < 2000000; ++i)
      for (auto &v : x) v = v * a + b;
    const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (2000000.0 * 10 * LANES * 2 / s > best) best = 2000000.0 * 10 * LANES * 2 / s;
  }
  double sum = 0.0;
  for (auto &v : x) sum += v[0];
  std::printf("%g %g\n", best, sum);
}
"""


def peak_flops():
    """Multiplications and additions a second of one core that does nothing else, or None."""
    with tempfile.TemporaryDirectory() as folder:
        source = os.path.join(folder, "peak.cpp")
        with open(source, "w") as file:
            file.write(PEAK)
        try:
            subprocess.run(["g++", "-O3", "-march=native", "-o", source + ".exe", source], check=True,
                           capture_output=True)
            return float(subprocess.run([source + ".exe"], check=True, capture_output=True,
                                        text=True).stdout.split()[0])
        except (OSError, subprocess.CalledProcessError):
            return None


def lammps(lmp, script, variables, ranks=1):
    """Run a script; returns its output, wall seconds and peak memory in bytes."""
    command = [lmp, "-in", os.path.join(HERE, script), "-log", "none"]
    if ranks > 1:
        command = ["mpirun", "--oversubscribe", "-np", str(ranks)] + command
    for name, value in variables.items():
        command += ["-var", name, value]
    environment = {**OPEN_MPI, **os.environ}
    start = time.time()
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                               env=environment)
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status:
        sys.exit(f"this failed: {' '.join(command)}\n{output[-2000:]}")
    return output, time.time() - start, usage.ru_maxrss * 1024


def seconds(output, line):
    """Seconds per atom and step of the loop or of a part of it."""
    loop = re.search(r"Loop time of (\S+) on \d+ procs for (\d+) steps with (\d+) atoms", output)
    total = loop[1] if line == "Loop" else re.search(rf"^{line}\s*\|\s*\S+\s*\|\s*(\S+)", output, re.M)[1]
    return float(total) / int(loop[2]) / int(loop[3])


def cases_of(level, folder):
    """{name: (input variables, line of LAMMPS' timing, steps)}"""
    points = 10 * 4**level + 2
    steps = max(10, 1500000 // points)
    result = {name: (*case, steps) for name, case in CASES.items()}
    if level == IRREGULAR_LEVEL:
        result.update({name: (*case, 1500000 // THERMAL_POINTS) for name, case in THERMAL_CASES.items()})
        mesh = os.path.join(folder, "flipped.off")
        if not os.path.exists(mesh):
            write_off(mesh, *random_valences(level))
        result.update({name: ({**variables, "read": "yes", "mesh": mesh}, line, steps)
                       for name, (variables, line) in FLIPPED_CASES.items()})
    if level == LIPIDS_LEVEL:
        result.update({name: (*case, LIPIDS_STEPS) for name, case in LIPID_CASES.items()})
    return result


def lj_unit(lmp):
    return seconds(lammps(lmp, "in.lj", {})[0], "Loop")


def one_round(lmp, level, ranks, folder):
    """{case: LJ units}, {"unit": seconds}, and the speed-ups on several ranks."""
    unit = lj_unit(lmp)
    result = {"unit": unit}
    modify = {}
    for name, (variables, line, steps) in cases_of(level, folder).items():
        output = lammps(lmp, "in.membrane", {**variables, "level": str(level), "steps": str(steps)})[0]
        result[name] = seconds(output, line) / unit
        modify[name] = seconds(output, "Modify") / unit
        if ranks > 1 and name in SCALING:
            shared = lammps(lmp, "in.membrane", {**variables, "level": str(level), "steps": str(steps)}, ranks)[0]
            result[f"{name}: speed-up on {ranks} ranks"] = seconds(output, "Loop") / seconds(shared, "Loop")
    result[SOLVE] = modify["hd/nve, 3 points"] - modify["hd/nve mass lumped, 3 points"]
    result[MASK] = 0.5 * result[SOLVE]
    return result


def spread(values):
    return f"{statistics.median(values):6.3f} [{min(values):.3f}, {max(values):.3f}]"


def solvent(lmp, repeat):
    """Prints a table; rows of LJ units an atom and step."""
    if not re.search(r"\bsrd\s", subprocess.run([lmp, "-help"], capture_output=True, text=True).stdout):
        print("no solvent: lmp has no package SRD")
        return []
    rounds, times = [], {name: [] for name in SOLVENT_CASES}
    for i in range(repeat):
        unit = lj_unit(lmp)
        rounds.append({})
        for name, variables in SOLVENT_CASES.items():
            output = lammps(lmp, "in.srd", variables)[0]
            times[name].append(seconds(output[output.rindex("Loop time"):], "Loop"))
            rounds[-1][name] = times[name][-1] / unit
        print(f"\rsolvent, round {i + 1} of {repeat}", end="", file=sys.stderr, flush=True)
    print("\r", end="", file=sys.stderr)
    reference = next(iter(SOLVENT_CASES))
    print("\nsolvent                                LJ units an atom and step   over fix srd in bulk        fastest")
    rows = []
    for name in SOLVENT_CASES:
        values = [r[name] for r in rounds]
        print(f"{name:38s} {spread(values)}   {spread([r[name] / r[reference] for r in rounds])}"
              f"  {min(times[name]) / min(times[reference]):6.3f}")
        rows.append([name, "", statistics.median(values), min(values), max(values)])
    return rows


def set_up(lmp, levels, repeat):
    """Seconds and bytes a point of runs without steps, less those of 162 points."""
    table = {}
    for level in [2] + levels:
        runs = [lammps(lmp, "in.membrane", {"level": str(level), "steps": "0"})[1:] for _ in range(repeat)]
        table[level] = [statistics.median(column) for column in zip(*runs)]
    return {level: (table[level][0] - table[2][0], (table[level][1] - table[2][1]) / (10 * 4**level + 2))
            for level in levels}


def plot(rows, set_up_rows, path):
    try:
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
    except ImportError:
        print("no plot: install python3-matplotlib")
        return
    once = [row for row in rows if row[0] in {**THERMAL_CASES, **FLIPPED_CASES, **LIPID_CASES, **SOLVENT_CASES}]
    panels = ["sizes", "set-up"] * bool(set_up_rows) + ["once"] * bool(once)
    if not panels:
        return
    figure, axes = plt.subplots(1, len(panels), figsize=(5.5 * len(panels), 4.5), layout="constrained", squeeze=False)
    by_name = dict(zip(panels, axes[0]))
    if set_up_rows:
        left, right = by_name["sizes"], by_name["set-up"]
        for name in list(CASES) + [SOLVE]:
            data = [(points, *values) for case, points, *values in rows if case == name]
            x, mid, low, high = zip(*data)
            left.errorbar(x, mid, yerr=[[m - l for m, l in zip(mid, low)], [h - m for m, h in zip(mid, high)]],
                          marker="o", markersize=4, capsize=2, label=name)
        left.set(xscale="log", xlabel="control points", ylim=(0, None),
                 ylabel="time of a control point and step\nin that of a Lennard-Jones atom")
        left.axhline(1.0, color="grey", linewidth=0.8, linestyle=":")
        left.legend(fontsize=7, ncol=2, loc="upper left")
        left.set_ylim(0, 1.5 * left.get_ylim()[1])
        x = [points for points, *_ in set_up_rows]
        right.loglog(x, [max(s, 1e-3) for _, s, _ in set_up_rows], marker="o", label="set-up, seconds")
        right.loglog(x, [b * p / 2**20 for p, _, b in set_up_rows], marker="s", label="memory, MB")
        right.set(xlabel="control points")
        right.legend()
    if once:
        bars = by_name["once"]
        names, _, mid, low, high = zip(*once)
        bars.barh(range(len(names)), mid, xerr=[[m - l for m, l in zip(mid, low)], [h - m for m, h in zip(mid, high)]],
                  color="lightsteelblue", capsize=2)
        bars.set_yticks(range(len(names)), names, fontsize=7)
        bars.invert_yaxis()
        bars.set(xlabel="time of a point or atom and step\nin that of a Lennard-Jones atom")
    figure.savefig(path, dpi=120)
    print(f"wrote {path}")


def membranes(options, levels, folder):
    """Prints tables; their rows, and those of set-up."""
    rows, units = [], []
    print("LJ units a control point and step: median [smallest, largest]", flush=True)
    for level in levels:
        points = 10 * 4**level + 2
        rounds = []
        for i in range(options.repeat):
            rounds.append(one_round(options.lmp, level, options.ranks, folder))
            print(f"\r{points} points, round {i + 1} of {options.repeat}", end="", file=sys.stderr, flush=True)
        print("\r", end="", file=sys.stderr)
        units += [r["unit"] for r in rounds]
        for name in [key for key in rounds[0] if key != "unit"]:
            values = [r[name] for r in rounds]
            rows.append([name, points, statistics.median(values), min(values), max(values)])
            print(f"{points:7d}  {name:42s} {spread(values)}", flush=True)
    unit = statistics.median(units)
    print(f"\nLJ unit {unit * 1e6:.3f} us, {min(units) * 1e6:.3f} to {max(units) * 1e6:.3f}")

    peak = peak_flops()
    if peak:
        for case, points, mid, *_ in rows:
            if case == "force, 3 points":
                rate = 2 * 3 * FLOPS / (mid * unit)    # two faces a point, three quadrature points a face
                print(f"kernel, 3 points, {points:7d}: {rate / 1e9:.0f} Gflop/s, {100 * rate / peak:.0f} % of the "
                      f"{peak / 1e9:.0f} that one core's fused multiply-adds reach")
    if len(levels) > 1:
        print(f"\ncost a point at {10 * 4**levels[-1] + 2} over that at {10 * 4**levels[0] + 2}:")
        for name in CASES:
            cost = {points: mid for case, points, mid, *_ in rows if case == name}
            print(f"  {name:38s} {cost[max(cost)] / cost[min(cost)]:.2f}")

    print("\nset-up")
    set_up_rows = []
    for level, (time_taken, size) in set_up(options.lmp, levels, options.repeat).items():
        points = 10 * 4**level + 2
        set_up_rows.append((points, time_taken, size))
        rows += [["set-up seconds", points, time_taken, "", ""], ["bytes a point", points, size, "", ""]]
        print(f"{points:7d} points  {time_taken:7.3f} s  {size:7.0f} bytes a point", flush=True)

    return rows, set_up_rows


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lmp", default=os.path.join(HERE, "..", "build", "lmp"))
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--levels", default="3,4,5,6,7")
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--solvent", choices=["yes", "no"], default="yes")
    parser.add_argument("--out", default="bench")
    options = parser.parse_args()
    levels = [int(level) for level in options.levels.split(",") if level]

    rows, set_up_rows = [], []
    if levels:
        with tempfile.TemporaryDirectory() as folder:
            rows, set_up_rows = membranes(options, levels, folder)
    if options.solvent == "yes":
        rows += solvent(options.lmp, options.repeat)
    with open(options.out + ".csv", "w", newline="") as table:
        writer = csv.writer(table)
        writer.writerow(["case", "points", "median", "smallest", "largest"])
        writer.writerows(rows)
    print(f"wrote {options.out}.csv")
    plot(rows, set_up_rows, options.out + ".png")


if __name__ == "__main__":
    main()
