#!/usr/bin/env python3
"""How many control points a process should have, on paper: what processes send in a step is measured, the network is
a model.

  bench/hockney.py [--lmp build/lmp] [--levels 4,5] [--ranks 2,4,8] [--latency 1.5e-6] [--bandwidth 1e10]
                   [--point 0.3e-6] [--fix "hd/nve"]

bench/messages.c counts messages and bytes of each process (needs mpicc), in two runs of different length on a sphere.
By Hockney's model n messages of B bytes in all take n latency + B/bandwidth. Bytes of the process that sends most go with the
length of its border, so with the root of its points; of messages it has as many however few its points are. --point: seconds of
a control point and step on one process without others, by bench/run_bench.py. Prints for each case what is sent, and the
points a process at which sending takes as long as computing: with fewer, processes that are added gain little."""

import argparse
import math
import os
import re
import subprocess
import tempfile

from run_bench import HERE


def sent(options, level, ranks, steps, library):
    """{rank: (messages, bytes, sums)}"""
    variables = {"level": level, "steps": steps, "integrate": "yes", "fix": options.fix, "quadrature": 3}
    command = ["mpirun", "--oversubscribe", "-np", str(ranks), "-x", f"LD_PRELOAD={library}", options.lmp,
               "-in", os.path.join(HERE, "in.membrane"), "-log", "none"]
    for name, value in variables.items():
        command += ["-var", name, str(value)]
    environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    output = subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout
    lines = re.findall(r"rank (\d+) sent (\d+) messages, (\d+) bytes, took part in (\d+)", output)
    return {line[0]: tuple(map(int, line[1:])) for line in lines}


def points_at_balance(point, fixed, border):
    """n with n point = fixed + border sqrt(n)"""
    root = (border + math.sqrt(border * border + 4.0 * point * fixed)) / (2.0 * point)
    return root * root


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lmp", default=os.path.join(HERE, "..", "build", "lmp"))
    parser.add_argument("--levels", default="4,5")
    parser.add_argument("--ranks", default="2,4,8")
    parser.add_argument("--latency", type=float, default=1.5e-6)
    parser.add_argument("--bandwidth", type=float, default=1.0e10)
    parser.add_argument("--point", type=float, default=0.3e-6)
    parser.add_argument("--fix", default="hd/nve")
    options = parser.parse_args()
    short, long = 10, 30
    print(f"{options.fix}: of the process that sends most, in a step")
    print(" points  processes  messages      kB  sums  time on the network  points a process at balance")
    with tempfile.TemporaryDirectory() as folder:
        library = os.path.join(folder, "messages.so")
        subprocess.run(["mpicc", "-shared", "-fPIC", os.path.join(HERE, "messages.c"), "-o", library], check=True)
        for level in map(int, options.levels.split(",")):
            for ranks in map(int, options.ranks.split(",")):
                before, after = (sent(options, level, ranks, steps, library) for steps in (short, long))
                each = [[(b - a) / (long - short) for a, b in zip(before[rank], after[rank])] for rank in after]
                messages, size, sums = (max(column) for column in zip(*each))
                points = 10 * 4**level + 2
                # a sum of all processes is a message up and one down for each doubling of their number
                fixed = options.latency * (messages + 2.0 * sums * math.ceil(math.log2(ranks)))
                border = size / options.bandwidth / math.sqrt(points / ranks)
                network = fixed + size / options.bandwidth
                print(f"{points:7d}  {ranks:9d}  {messages:8.1f}  {size / 1e3:6.0f}  {sums:4.1f}  {network * 1e6:16.0f} us"
                      f"  {points_at_balance(options.point, fixed, border):12.0f}", flush=True)


if __name__ == "__main__":
    main()
