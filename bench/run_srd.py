#!/usr/bin/env python3
"""Speed of fix srd/mesh beside LAMMPS' fix srd, the same solvent in the same box, timed one after the other.

  bench/run_srd.py [--lmp build/lmp] [--repeat 5]

Prints the time of an atom and step in bulk and around a vesicle of 642 control points, in LJ units (see
run_bench.py) and as ratios to fix srd in bulk: median over the rounds and, in brackets, smallest and largest,
then the ratio of the fastest rounds, which a busy machine disturbs least.
lmp needs LAMMPS' package SRD."""

import argparse
import os
import statistics

from run_bench import HERE, lammps, seconds

CASES = {
    "fix srd, bulk": {"fix": "srd", "args": "cubic warn 0.01"},
    "fix srd/mesh, bulk": {"fix": "srd/mesh"},
    "fix srd/mesh, bulk, thermostat": {"fix": "srd/mesh", "args": "angle 90 tstat yes"},
    "fix srd/mesh, vesicle of 642 points": {"fix": "srd/mesh", "vesicle": "yes"},
    "fix srd/mesh, vesicle, quadrature 3": {"fix": "srd/mesh", "vesicle": "yes", "quadrature": "3"},
    "fix srd/mesh, vesicle, level 1": {"fix": "srd/mesh", "vesicle": "yes", "args": "angle 90 level 1"},
    "fix srd/mesh, vesicle, slip": {"fix": "srd/mesh", "vesicle": "yes", "args": "angle 90 collision slip"},
}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lmp", default=os.path.join(HERE, "..", "build", "lmp"))
    parser.add_argument("--repeat", type=int, default=5)
    options = parser.parse_args()
    rounds, times = [], {name: [] for name in CASES}
    for _ in range(options.repeat):
        unit = seconds(lammps(options.lmp, "in.lj", {})[0], "Loop")
        rounds.append({})
        for name, variables in CASES.items():
            output = lammps(options.lmp, "in.srd", variables)[0]
            times[name].append(seconds(output[output.rindex("Loop time"):], "Loop"))
            rounds[-1][name] = times[name][-1] / unit
    reference = next(iter(CASES))
    print("case                                    LJ units an atom-step     over fix srd in bulk      fastest")
    for name in CASES:
        values = [r[name] for r in rounds]
        ratios = [r[name] / r[reference] for r in rounds]
        print(f"{name:38s}" + "".join(f"  {statistics.median(v):6.3f} [{min(v):.3f}, {max(v):.3f}]"
                                      for v in (values, ratios))
              + f"  {min(times[name]) / min(times[reference]):6.3f}")


if __name__ == "__main__":
    main()
