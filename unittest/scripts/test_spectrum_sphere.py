"""Thermal undulations of spheres have the spectrum of theory, with fix hd/langevin and hd/brownian alike.

    MEMBRANE_LONG=1    1,000,000 steps in each run in place of some ten thousand

As test_spectrum_plane.py; all m of one l are taken together.
"""
# cost: 60
# timeout: 7200

import math

from lammps_claims import LONG, finish, run, thermo
from lattice_waves import thermal_factor
from mode_statistics import BLOCKS, EVERY, agree, averages, block_length, compare, mean_and_error

KT = 1e-4

# === Spheres, R = kc = rho = 1, at constant volume. Their shape at rest is not quite a sphere: the mesh
# has the symmetry of the icosahedron, and so a little of l = 6, which adds to the mean power. The sum over
# m is the same in any attitude.


def sphere(fix, dt, steps, level=3, lmax=8, terms="", c0=0.0, s=0.0):
    per, points = block_length(1000000 if LONG else steps), 10 * 4 ** level + 2
    columns = " ".join(f"c_m[{row}][6]" for row in range(1, (lmax + 1) ** 2 + 1))
    output = run(f"""
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
create_box      1 box angle/types 1
create_membrane 1 sphere {level} 1.0 interpolate yes mass {4 * math.pi / points!r}
special_bonds   lj/coul 1 1 1
pair_style      helfrich
pair_coeff      1 1 1.0 {c0} volume 1000.0 {4 * math.pi / 3!r} regularize 0.01 {terms}
compute         m all hd/modes sphere {lmax}
thermo_style    custom step {columns}
thermo_modify   norm no format float %.9g
min_style       membrane
minimize        0 1e-9 200 2000
run             0
fix             1 all {fix}
thermo_style    custom step pe
timestep        {dt}
run             {per}
reset_timestep  0
fix             a all ave/time {EVERY} {per // EVERY} {per} c_m[6] mode vector file power.txt
run             {BLOCKS * per}
""", timeout=7200)
    blocks, rest = averages("power.txt"), [row for row in thermo(output) if "c_m[1][6]" in row][-1]
    edge = math.sqrt(4 * math.pi / points * 2 / math.sqrt(3))
    result = {}
    for l in range(2, lmax + 1):
        size = math.sqrt(l * (l + 1)) * edge
        factor = 0.5 * (thermal_factor((size, 0)) + thermal_factor((0, size)))
        power = factor * KT / ((l - 1) * (l + 2) * (l * (l + 1) + s))
        at_rest = sum(rest[f"c_m[{row}][6]"] for row in range(l * l + 1, (l + 1) ** 2 + 1))
        result[f"l = {l}"] = mean_and_error([(sum(block[l * l:(l + 1) ** 2]) - at_rest) / (2 * l + 1) / power
                                             for block in blocks])
    return result


langevin = sphere(f"hd/langevin {KT} {KT} 0.1 4713 mass lumped", 0.008, 40000)
compare("sphere of 642 points, hd/langevin", langevin)
small = dict(level=2, lmax=4)
DRAG = 4 * math.pi / 162
coarse = sphere(f"hd/langevin {KT} {KT} 0.1 4715", 0.008, 40000, **small)
brownian = sphere(f"hd/brownian {KT} 4716 gamma_t {DRAG} mass lumped", 6e-4, 50000, **small)
compare("sphere of 162 points, hd/langevin", coarse)
compare("sphere of 162 points, hd/brownian", brownian)
agree("sphere: hd/langevin and hd/brownian", coarse, brownian)
compare("sphere of 162 points with c0 = -1 and tension 2: s = 4.5",
        sphere(f"hd/langevin {KT} {KT} 0.1 4714 mass lumped", 0.03, 40000, terms="tension 2.0", c0=-1.0, s=4.5, **small))

finish()
