"""The mesh of a fluid membrane: a thermal sheet without shear stiffness stops before it folds, and
regularize keeps it.

    MEMBRANE_LONG=1    40,000 steps in place of 15,000
"""
# cost: 15

import math
import re

from lammps_claims import LONG, claim, error_of, finish, lammps, run, thermo

# Control points slide until faces turn over

STEPS = 40000 if LONG else 15000
FLUID = f"""
units           lj
atom_style      membrane_cp
region          box block 0 15 0 {8 * math.sqrt(3)!r} -4 4
create_box      1 box angle/types 1
create_membrane 1 plane 15 16 mass {math.sqrt(0.75)!r}
pair_style      helfrich
pair_coeff      1 1 1.0 0.0 {{terms}}
fix             1 all {{fix}}
{{modify}}
compute         s all membrane/shape
compute         m all hd/modes plane 1
thermo_style    custom step pe c_s[9] c_m[2]
thermo_modify   norm no
thermo          1000
timestep        0.1
run             {{steps}}
"""
# on several ranks a stencil may outgrow the communication cutoff first: that message, too, has face and cure
SAID = ("turned over", "collapses", "beyond the communication cutoff")
for fix in ("hd/langevin 1e-3 1e-3 3 4711 measure no", "hd/langevin 1e-3 1e-3 3 4711 measure no mass lumped",
            "hd/brownian 1e-3 4711 measure no gamma_t 1 mass lumped"):
    for ranks in (1, 2):
        error = error_of(FLUID.format(terms="", fix=fix, modify="fix_modify 1 faces 0", steps=STEPS), ranks=ranks)
        claim(f"{fix}, {ranks} rank(s): a fluid sheet stops with the face and the cure",
              re.search(rf"Fix {fix.split()[0]}: face |: face .* needs control point", error) and
              any(word in error for word in SAID) and
              "regularize in pair_coeff" in error, error)
    rows = thermo(run(FLUID.format(terms="regularize 0.1", fix=fix, modify="", steps=STEPS)))
    claim("    with regularize it runs on, the smallest angle above 30 degrees",
          len(rows) == STEPS // 1000 + 1 and min(row["c_s[9]"] for row in rows) > 30,
          f"{min(row['c_s[9]'] for row in rows):.1f}")

code, output = lammps(FLUID.format(terms="", fix="hd/langevin 1e-3 1e-3 3 4711 measure no",
                                   modify="fix_modify 1 check no", steps=4000))
claim("fix_modify check no: no stop by the fix", "Fix hd/langevin: face" not in output,
      next((line for line in output.split("\n") if line.startswith("ERROR")), ""))

finish()
