"""Meshes and scenes that are hard on the numerics: forces are the gradient of the energy, the stability
limit found is one, half the timestep has a quarter of the energy error. Prints a table of what it
measures, for Howto_membrane_accuracy, with MEMBRANE_LONG=1 as it is there."""

import math
import os
import re

from lammps_claims import LONG, REFERENCE, claim, finish, run, thermo
from membrane_scenes import bipyramid, read_dump, read_off, write_off

SCENE = """
units           lj
atom_style      membrane_cp
region          box block {box}
create_box      2 box angle/types 1
{create}
set             group all mass 1.0
pair_style      helfrich
pair_coeff      * * 1.0 0.0
{coefficients}
compute         T all hd/temp
thermo_style    custom step pe etotal
thermo_modify   temp T norm no format float %.17g
"""
BOX = "-3 3 -3 3 -3 3"


def scene(create, box=BOX, coefficients="", tiny=1e-6):
    return dict(create=create, box=box, coefficients=coefficients, tiny=tiny)


CASES = {}
for n in (3, 4, 5, 7, 8, 10, 12, 14, 16):
    write_off(f"valence{n}.off", *bipyramid(n))
    CASES[f"valence {n}"] = scene(f"create_membrane 1 file valence{n}.off refine 2")
for ratio in (10, 50):
    for name, box in ((f"needles, edge ratio {ratio}", f"0 {8 / ratio} 0 8 -2 2"),
                      (f"flat triangles, base {ratio} times the height", f"0 8 0 {8 / ratio} -2 2")):
        CASES[name] = scene("create_membrane 1 plane 8 8\ndisplace_atoms all random 0 0 0.002 1", box=box, tiny=1e-8)
# a dumbbell: the icosphere with its waist drawn in to a hundredth of its radius
points, faces = read_off(os.path.join(REFERENCE, "icosphere_2.off"))
write_off("neck.off", [(x * w, y * w, 1.5 * z) for x, y, z in points
                       for w in (0.01 + 0.99 * min(1.0, z * z / 0.25),)], faces)
CASES["a neck of a hundredth of the radius"] = scene("create_membrane 1 file neck.off refine 1")
CASES["kc over four decades on one sphere"] = scene(
    "create_membrane 1 sphere 2 1.0 interpolate yes\nregion half block INF INF INF INF INF 0\n"
    "set region half type 2", coefficients="pair_coeff 1 1 0.01 0.0\npair_coeff 2 2 100.0 0.0")
CASES[f"42 points beside {10242 if LONG else 2562}"] = scene(f"create_membrane 1 sphere {5 if LONG else 4} 1.5 center -1 0 0\n"
                                                              "create_membrane 2 sphere 1 0.5 center 2 0 0")
CASES["two sheets a hundredth of an edge apart"] = scene(
    "create_membrane 1 plane 8 8\ndisplace_atoms all random 0 0 0.05 1\n"
    "group lower type 1\ncreate_membrane 2 plane 8 8\ngroup upper type 2\n"
    "displace_atoms upper random 0 0 0.05 1\ndisplace_atoms upper move 0 0 0.01", box="0 8 0 6.93 -2 2")
CASES["a sphere across all corners of the box"] = scene("create_membrane 1 sphere 2 1.2 center 3 3 3")


def finite_difference(case):
    """Largest deviation of f from -dE/dx on some points, over the largest force of these."""
    tiny = case["tiny"]
    script = SCENE.format(**case) + """
dump            1 all custom 1 f.dump id fx fy fz
dump_modify     1 format float %.17g sort id
run             0
undump          1
variable        n equal count(all)
"""
    moves = [(fraction, axis) for fraction in (0.0, 0.37, 0.81, 1.0) for axis in range(3)]
    for number, (fraction, axis) in enumerate(moves):
        step = [0.0] * 3
        step[axis] = tiny
        there, back, back2 = (" ".join(f"{s * x:.17g}" for x in step) for s in (1, -2, 1))
        script += f"""
variable        i equal 1+floor({fraction}*(v_n-1))
group           one id ${{i}}
displace_atoms  one move {there} units box
run             0 post no
displace_atoms  one move {back} units box
run             0 post no
displace_atoms  one move {back2} units box
group           one delete
"""
    rows = thermo(run(script))[-2 * len(moves):]
    forces = read_dump("f.dump")[0]
    size, worst = 1e-300, 0.0
    for number, (fraction, axis) in enumerate(moves):
        force = forces[1 + math.floor(fraction * (len(forces) - 1))][axis]
        estimate = -(rows[2 * number]["PotEng"] - rows[2 * number + 1]["PotEng"]) / (2 * tiny)
        worst, size = max(worst, abs(force - estimate)), max(size, abs(force))
    return worst / size


def stability_limit(case):
    output = run(SCENE.format(**case) + "fix 1 all hd/nve tol 1e-13\nhd_timestep all\n")
    return float(re.search(r"stability limit\s+(\S+)", output)[1])


def energy_error(case, dt, steps):
    output = run(SCENE.format(**case) + f"""
fix             1 all hd/nve tol 1e-13
fix_modify      1 check no
hd_velocity     all 1e-6 4711
thermo          1
timestep        {dt:.12g}
run             {steps}
""")
    energies = [row["TotEng"] for row in thermo(output)]
    mean = sum(energies) / len(energies)
    return math.sqrt(sum((e - mean)**2 for e in energies) / len(energies)), energies[0]


print("case | stability limit | forces against differences | error at 0.2 of the limit / at 0.1")
for name, case in CASES.items():
    apart = finite_difference(case)
    limit = stability_limit(case)
    (coarse, energy), (fine, _) = (energy_error(case, part * limit, round(8 / part)) for part in (0.2, 0.1))
    print(f"note   {name} | {limit:.2e} | {apart:.0e} | {coarse / fine:.2f}")
    claim(f"{name}: forces are the gradient of the energy", apart < 2e-5, f"{apart:.1e}")
    claim(f"{name}: half the step, a quarter of the energy error", 3.5 < coarse / fine < 4.5,
          f"{coarse / fine:.3f}, {fine:.1e} of {energy:.3g}")

finish()
