"""A mesh that folds between the points of quadrature has a wrong energy, and a warning says so.

What the warning rests on is measured apart from it: the bending energy of the same shape by the rule in use and
by quadrature 12. It is due when they differ by more than a tenth of the latter and of kc.
"""
# cost: 15

import math
import os
import re

from lammps_claims import REFERENCE, claim, finish, run, thermo
from membrane_scenes import read_off, write_off

DEGRADED = re.compile("WARNING: The bending energy is .* has degraded")


def warned(output):
    return bool(DEGRADED.search(output))


def due(row, finer):
    """Whether a finer rule sees another energy; kc = 1."""
    return abs(row["c_e[1]"] - finer["c_e[1]"]) > 0.1 * (finer["c_e[1]"] + 1.0)


# === The wave of the zone's corner, of which quadrature 1 sees nothing

CORNER = f"""
units           lj
atom_style      membrane_cp
region          box block 0 15 0 {8 * math.sqrt(3)!r} -6 6
create_box      1 box angle/types 1
create_membrane 1 plane 15 16
variable        z atom 0.05*cos(2*PI*10*x/15)
displace_atoms  all move 0 0 v_z
"""
BENDING = """
pair_style      helfrich quadrature {rule}
pair_coeff      1 1 1.0 {terms}
compute         e all pair helfrich
thermo_style    custom step c_e[1]
thermo_modify   norm no
{then}
uncompute       e
"""
finer = thermo(run(CORNER + BENDING.format(rule=12, terms="0.0", then="run 0")))[-1]
for rule, folded in ((1, True), (3, False), (6, False)):
    output = run(CORNER + BENDING.format(rule=rule, terms="0.0", then="run 0"))
    row = thermo(output)[-1]
    claim(f"quadrature {rule} " + ("sees nothing of the wave of the zone's corner, and a warning says so" if folded
          else "sees the wave of the zone's corner: no warning"),
          warned(output) == due(row, finer) == folded, f"{row['c_e[1]']:.4g} of {finer['c_e[1]']:.4g}")

# === A neck that closes: two spheres have no energy for this c0. Whether the mesh has degraded for the default rule
# where a minimization without regularize stops hangs on the rounding of a machine

points, faces = read_off(os.path.join(REFERENCE, "icosphere_2.off"))
waist = [(x * w, y * w, 1.4 * z) for x, y, z in points for w in (0.3 + 0.7 * min(1.0, z * z / 0.25),)]
write_off("waist.off", waist, faces)
WAIST = """
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
create_box      1 box angle/types 1
create_membrane 1 file waist.off refine 1
special_bonds   lj/coul 1 1 1
min_style       membrane
"""
TERMS = f"{2 * math.sqrt(2)!r} area 1000.0 {4 * math.pi!r} volume 1000.0 {4 * math.pi / 3 * math.sqrt(0.5)!r}"
for keep, name in (("", "no regularize"), ("regularize 0.01", "regularize")):
    terms = f"{TERMS} {keep}"
    relaxed, _, checked = run(
        WAIST + BENDING.format(rule=6, terms=terms, then="minimize 0 0 4000 40000\nprint END") +
        BENDING.format(rule=12, terms=terms, then="run 0")).partition("\nEND\n")
    row, finer = thermo(relaxed)[-1], thermo(checked)[-1]
    measured = f"{row['c_e[1]']:.4g} by quadrature 6, {finer['c_e[1]']:.4g} by quadrature 12"
    claim(f"a neck that closes, {name}: a warning if a finer rule sees another energy, and none if it does not",
          warned(relaxed) == due(row, finer), measured)
    if keep:
        claim("    it sees the same energy", not due(row, finer), measured)

finish()
