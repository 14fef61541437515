#!/usr/bin/env python3
"""What fix srd/mesh sends, holds and takes on several ranks to let solvent meet a vesicle.

  bench/srd_ranks.py [--lmp build/lmp] [--ranks 1,2,4] [--sizes 3,4] [--args "angle 90"] [--steps 100]
                     [--density 12.5] [--beside OTHER_LMP]

For each size of the vesicle (a refinement level: 642 control points at 3, 2,562 at 4, ...) and number of ranks:
bytes that a rank sends in a step, its peak memory, and the time of the loop over that of the smallest number
of ranks. Bytes and memory are those of the ranks with most, and in brackets without what the same scene takes
if solvent and vesicle do not meet. Bytes are counted by Open MPI's monitoring, between runs of two lengths;
times say nothing if there are fewer cores than ranks. With another executable also its time over that of the first,
best of five rounds in which both take turns."""

import argparse
import glob
import os
import re
import subprocess
import sys
import tempfile

from run_bench import HERE

# runs lmp and says how much memory it took
RANK = ("import resource, subprocess, sys; code = subprocess.call(sys.argv[1:]); "
        "sys.stderr.write('rank took %d kB\\n' % resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss); sys.exit(code)")


def scene(level, density):
    """Vesicles with edges of about one cell, in a box with four cells around them."""
    radius = 6.0 * 2 ** (level - 3)
    half = radius + 4.0
    return {"vesicle": "yes", "level": str(level), "radius": str(radius), "half": str(half),
            "atoms": str(round(density * (2 * half) ** 3)), "solver": "iterative"}


def measure(lmp, ranks, variables):
    """Bytes sent by each rank, peak memory of each, seconds of the last loop."""
    with tempfile.TemporaryDirectory() as folder:
        command = ["mpirun", "--oversubscribe", "-np", str(ranks), "--mca", "pml_monitoring_enable", "1",
                   "--mca", "pml_monitoring_enable_output", "3",
                   "--mca", "pml_monitoring_filename", os.path.join(folder, "sent"),
                   sys.executable, "-c", RANK, lmp, "-in", os.path.join(HERE, "in.srd"), "-log", "none"]
        for name, value in variables.items():
            command += ["-var", name, value]
        environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        environment.pop("OMPI_MCA_pml", None)    # with one that is named there is no monitoring
        result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment)
        if result.returncode:
            sys.exit(f"this failed: {' '.join(command)}\n{result.stdout[-2000:]}")
        sent = []
        for path in sorted(glob.glob(os.path.join(folder, "sent*"))):
            with open(path) as file:
                sent.append(sum(int(n) for n in re.findall(r"^[EI]\s+\d+\s+\d+\s+(\d+) bytes", file.read(), re.M)))
        memory = [1024 * int(n) for n in re.findall(r"rank took (\d+) kB", result.stdout)]
        return sent or [0], memory, float(re.findall(r"Loop time of (\S+)", result.stdout)[-1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lmp", default=os.path.join(HERE, "..", "build", "lmp"))
    parser.add_argument("--ranks", default="1,2,4")
    parser.add_argument("--sizes", default="3,4")
    parser.add_argument("--args", default="angle 90")
    parser.add_argument("--steps", type=int, default=100)
    parser.add_argument("--density", type=float, default=12.5, help="solvent atoms in a cell")
    parser.add_argument("--beside", metavar="OTHER_LMP")
    options = parser.parse_args()
    print("points  ranks   bytes a step (coupling)      memory in MB (coupling)  time (coupling)")
    for level in map(int, options.sizes.split(",")):
        first = None
        for ranks in map(int, options.ranks.split(",")):
            both, other = {}, ""
            for couple in ("yes", "no"):
                variables = {**scene(level, options.density), "couple": couple}
                if couple == "yes":
                    variables["args"] = options.args
                few = measure(options.lmp, ranks, {**variables, "steps": str(options.steps // 5)})[0]
                many, memory, time = measure(options.lmp, ranks, {**variables, "steps": str(options.steps)})
                more = options.steps - options.steps // 5
                both[couple] = (max(b - a for a, b in zip(few, many)) / more, max(memory) / 2**20, time)
            if options.beside:
                rounds = [[measure(lmp, ranks, {**variables, "couple": couple, "args": options.args,
                                                "steps": str(options.steps)})[2]
                           for couple in ("yes", "no") for lmp in (options.beside, options.lmp)] for _ in range(5)]
                best = [min(times) for times in zip(*rounds)]
                other = f"   other: {best[0] / best[1]:.2f}, solvent alone {best[2] / best[3]:.2f}"
            first = first or both["yes"][2]
            (b, m, t), (b0, m0, t0) = both["yes"], both["no"]
            print(f"{10 * 4**level + 2:6d} {ranks:6d} {b:12.0f} ({b - b0:8.0f}) {m:18.1f} ({m - m0:6.1f})"
                  f" {t / first:10.2f} ({(t - t0) / first:.2f}){other}", flush=True)


if __name__ == "__main__":
    main()
