#!/usr/bin/env python3
"""min_style membrane where it is hard put: poles of valence 32, surfaces cut out of voxels, a wall that pulls on a
vesicle; and the flattened sphere of in.deflate from 162 to 10242 control points.

  bench/awkward_minimizations.py [CASE ...] [--lmp build/lmp] [--iterations 1500]

Prints iterations, evaluations of forces and processor seconds of each minimization until it stops by itself or after so
many iterations, the bending energy over 8 pi kc, the smallest angle of the mesh, and errors or warnings of the mesh.
A sphere has 1; the least of a surface with two holes is 1.7419, Lawson's."""

import argparse
import math
import os
import re
import resource
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "unittest", "scripts"))
from awkward_meshes import (BOX_OF_TWO_HOLES, WALLED_VESICLE, meridian_sphere, two_holes,    # noqa: E402
                            voxel_surface)
from membrane_scenes import write_off    # noqa: E402

with open(os.path.join(HERE, "in.deflate")) as file:
    DEFLATE = file.read()

FREE = """
units           lj
atom_style      membrane_cp
region          box block -8 8 -8 8 -8 8
create_box      1 box angle/types 1
create_membrane 1 file {file}
special_bonds   lj/coul 1 1 1
comm_modify     cutoff 7.0
pair_style      helfrich
pair_coeff      1 1 1.0 0.0 {terms}
compute         e all pair helfrich
compute         s all membrane/shape
thermo_style    custom step c_e[1] c_s[9]
thermo_modify   norm no
thermo          10000
min_style       membrane
minimize        1.0e-9 0.0 {iterations} 100000
"""
AGAIN = """
pair_coeff      1 1 1.0 0.0 {terms}
minimize        1.0e-9 0.0 {iterations} 100000
"""
FINER = """
write_membrane  relaxed.off subdivide 0
clear
"""


def deflate(level, iterations):
    script = DEFLATE.replace("thermo          10", "thermo          10000")
    script = script.replace("min_style", "compute         s all membrane/shape\n"
                            "thermo_style    custom step c_e[1] c_s[9]\nthermo_modify   norm no\nmin_style")
    script = script.replace("0.0 10000 ${evals}", f"0.0 {iterations} 100000")
    return script.replace("${level}", str(level)), None


def free(mesh, *terms, refine=False):
    def make(iterations):
        script = "".join((FREE if i == 0 else AGAIN).format(file="mesh.off", terms=words, iterations=iterations)
                         for i, words in enumerate(terms))
        if refine:
            script += FINER + FREE.format(file="relaxed.off refine 1", terms=terms[-1], iterations=iterations)
        return script, mesh()
    return make


def walled(depth):
    script = WALLED_VESICLE.replace("{depth}", str(depth)).replace("{style}", "membrane").replace("{more}", "")
    return lambda iterations: (script.replace("{iterations}", str(iterations)), None)


def voxels(slivers):
    return lambda: voxel_surface(two_holes, BOX_OF_TWO_HOLES, (18, 12, 6), slivers)


AREA = "area 100 31"
CASES = {
    "sphere with poles of valence 32": free(lambda: meridian_sphere(32, 15), ""),
    "the same, regularize": free(lambda: meridian_sphere(32, 15), "regularize 1e-4"),
    "two holes, voxels": free(voxels(0.5), AREA),
    "two holes, voxels, regularize": free(voxels(0.5), f"{AREA} regularize 1e-4"),
    "two holes, slivers, regularize": free(voxels(0.0), f"{AREA} regularize 1e-2", f"{AREA} regularize 1e-4"),
    "two holes, voxels, regularize, refined": free(voxels(0.5), f"{AREA} regularize 1e-4", refine=True),
    "wall, 0.02": walled(0.02),
    "wall, 1": walled(1.0)}
for n in (2, 3, 4, 5):
    CASES[f"flattened sphere, {10 * 4**n + 2} points"] = lambda iterations, n=n: deflate(n, iterations)


def measure(options, case):
    script, mesh = CASES[case](options.iterations)
    with tempfile.TemporaryDirectory() as folder:
        if mesh:
            write_off(os.path.join(folder, "mesh.off"), *mesh)
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        done = subprocess.run([os.path.abspath(options.lmp), "-log", "none"], input=script, cwd=folder, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    counts = re.findall(r"Iterations, force evaluations = (\d+) (\d+)", done.stdout)
    rows = [line.split() for line in done.stdout.splitlines() if re.match(r"\s*\d+\s+[-+.e\d]+\s+[-+.e\d]+\s*$", line)]
    said = re.findall(r"^(?:ERROR|WARNING: Min style).*", done.stdout, re.M)
    kc = 10.0 if "wall" in case else 1.0
    return (case, " + ".join(i for i, _ in counts), " + ".join(e for _, e in counts), f"{seconds:.1f}",
            f"{float(rows[-1][1]) / (8 * math.pi * kc):.5f}" if counts else "", rows[-1][2] if counts else "",
            said[-1] if said else "")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", metavar="CASE", help="part of a name; by default all")
    parser.add_argument("--lmp", default=os.path.join(HERE, "..", "build", "lmp"))
    parser.add_argument("--iterations", type=int, default=1500)
    options = parser.parse_args()
    print("case | iterations | evaluations | seconds | E/(8 pi kc) | smallest angle | what LAMMPS says", flush=True)
    for case in CASES:
        if not options.cases or any(part in case for part in options.cases):
            print(" | ".join(measure(options, case)), flush=True)


if __name__ == "__main__":
    main()
