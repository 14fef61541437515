#!/usr/bin/env python3
"""What bound particles cost: the time of a step with them over that of the same step without.

  bench/bound.py [--lmp build/lmp] [--level 5] [--particles 1000] [--steps 300] [--repeat 9] [--ranks 1]
  bench/bound.py --messages [--ranks 2]    what a rank sends in a step, by bench/messages.c, in place of times

A vesicle of 10 * 4^level + 2 control points by fix hd/nve; particles by fix nve. Each run with particles is
between two without, and medians of the ratios of its time and their mean are printed, with their range. "motion" is without holding, fix nve and ghosts alone.
"""

import argparse
import os
import re
import statistics
import subprocess
import tempfile

SCRIPT = """
units           lj
atom_style      membrane_cp
region          box block -2 2 -2 2 -2 2
create_box      2 box angle/types 1
create_membrane 1 sphere {level} 1.0
group           mem type 1
create_bound    {n} 2 mem 4711 mass 0.01
set             type 1 mass 0.01
group           p type 2
pair_style      helfrich
pair_coeff      1 1 10.0 0.0
neigh_modify    exclude group p p
timestep        1e-6
thermo          1000000
fix             1 mem hd/nve
fix             2 p nve
{bind}
hd_velocity     mem 0.01 12
run             5
run             {steps}
"""
HOLDS = {"motion": "", "spring": "fix b p hd/bind mem", "spring, Brownian": "unfix 2\nfix b p hd/bind mem brownian 1 1e-3 5",
         "footprint": "fix b p hd/bind mem footprint 2 0.001 20 0 {rho}"}


def output_of(args, n, bind, steps, environment=()):
    text = SCRIPT.format(level=args.level, n=n, bind=bind.format(rho=1.5 * 2.15 / 2**args.level * 0.5), steps=steps)
    command = ["mpirun", "--oversubscribe", "-np", str(args.ranks), *environment] if args.ranks > 1 else []
    return subprocess.run(command + [args.lmp, "-log", "none", "-in", "/dev/stdin"], input=text, text=True,
                          capture_output=True).stdout


def sent(args, n, bind, library):
    """Messages, bytes and collective sums of a step, means over ranks: the difference of two runs."""
    totals = []
    for steps in (20, 40):
        lines = re.findall(r"sent (\d+) messages, (\d+) bytes, took part in (\d+)", output_of(
            args, n, bind, steps, ("-x", "LD_PRELOAD=" + library)))
        totals.append([sum(int(line[k]) for line in lines) / args.ranks for k in range(3)])
    return [(b - a) / 20 for a, b in zip(*totals)]


def print_messages(args):
    with tempfile.TemporaryDirectory() as folder:
        library = os.path.join(folder, "messages.so")
        source = os.path.join(os.path.dirname(os.path.abspath(__file__)), "messages.c")
        subprocess.run(["mpicc", "-shared", "-fPIC", source, "-o", library], check=True)
        print(f"{10 * 4**args.level + 2} control points, {args.particles} particles, {args.ranks} ranks: sent by a rank in a step")
        for name, n, bind in [("no particles", 0, "")] + [(name, args.particles, bind) for name, bind in HOLDS.items()]:
            messages, size, sums = sent(args, n, bind, library)
            print(f"  {name:<28}{messages:6.1f} messages  {size / 1024:8.1f} kB  {sums:5.1f} sums", flush=True)


def loop_time(args, n, bind):
    out = output_of(args, n, bind, args.steps)
    times = re.findall(r"Loop time of ([\d.e+-]+)", out)
    if len(times) < 2:
        raise SystemExit(out[-2000:])
    return float(times[-1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lmp", default="build/lmp")
    parser.add_argument("--level", type=int, default=5)
    parser.add_argument("--particles", type=int, default=1000)
    parser.add_argument("--steps", type=int, default=300)
    parser.add_argument("--repeat", type=int, default=9)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--messages", action="store_true")
    args = parser.parse_args()
    if args.messages:
        args.ranks = max(args.ranks, 2)
        print_messages(args)
        return
    print(f"{10 * 4**args.level + 2} control points, {args.particles} particles: time of a step over that without any")
    for name, bind in list(HOLDS.items()) + [("no particles, with the fix", None)]:
        ratios = []
        for _ in range(args.repeat):
            before = loop_time(args, 0, "")
            with_it = loop_time(args, 0, HOLDS["spring"]) if bind is None else loop_time(args, args.particles, bind)
            ratios.append(2 * with_it / (before + loop_time(args, 0, "")))
        print(f"  {name:<28}{statistics.median(ratios):.3f}  [{min(ratios):.3f}, {max(ratios):.3f}]", flush=True)


if __name__ == "__main__":
    main()
