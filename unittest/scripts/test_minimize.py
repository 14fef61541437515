"""min_style membrane: a few hundred evaluations on any mesh. How LAMMPS' own styles fare: bench/minimizers.py."""

import os
import re

from lammps_claims import EXAMPLES, claim, finish, run, thermo

SCRIPT = open(os.path.join(EXAMPLES, "..", "bench", "in.deflate")).read()
MINIMUM = 45.769    # bending energy at moderate penalties, oblate branch, reduced volume 0.652


def relax(level, evals=2000, ranks=1):
    output = run(SCRIPT, ranks=ranks, args=["-var", "level", level, "-var", "evals", evals])
    used = int(re.findall(r"Iterations, force evaluations = (\d+) (\d+)", output)[-1][1])
    return used, thermo(output)[-1]["c_e[1]"], output


for level in range(1, 6):
    used, energy, _ = relax(level, evals=240)
    claim(f"{10 * 4**level + 2} points: within 0.1 % of the minimum in 250 evaluations",
          used <= 250 and abs(energy / MINIMUM - 1) < 1e-3, f"{used}, {energy:.4f}")

_, serial, _ = relax(3)
_, parallel, _ = relax(3, ranks=2)
claim("two ranks find the same minimum", abs(parallel / serial - 1) < 1e-4,
      f"{serial:.6f}, {parallel:.6f}")

for kc in (0.05, 20.0):
    scaled = SCRIPT.replace("1 1 1.0 0.0", f"1 1 {kc} 0.0").replace("1.0e4", f"{kc * 1e4}")
    output = run(scaled, args=["-var", "level", 3])
    claim(f"kc = {kc}: the same minimum in other energy units",
          abs(thermo(output)[-1]["c_e[1]"] / kc / serial - 1) < 1e-4,
          f'{thermo(output)[-1]["c_e[1]"] / kc:.5f}')

output = run(SCRIPT.replace("minimize  ", "group held id 1 2 3\nfix held held setforce 0 0 0\n"
                            "variable x equal x[1]\nthermo_style custom step v_x\nminimize  "))
claim("fix setforce 0 holds control points", len({row["v_x"] for row in thermo(output)[1:]}) == 1)

output = run(SCRIPT.replace("create_box      1", "create_box      2").replace(
    "pair_coeff      1 1 1.0 0.0\n",
    "create_atoms    2 single 2 2 2\ncreate_atoms    2 single 2.5 2 2\npair_coeff      1 1 1.0 0.0\n", 1)
    .replace("pair_style      helfrich", "pair_style      hybrid/overlay helfrich lj/cut 1.5\n"
             "pair_coeff      * * lj/cut 0.0 1.0\npair_coeff      2 2 lj/cut 1.0 0.6")
    .replace("pair_coeff      1 1 1.0", "pair_coeff      1 1 helfrich 1.0"), args=["-var", "level", 2])
claim("a scene with plain atoms beside the membrane relaxes too",
      abs(thermo(output)[-1]["c_e[1]"] / MINIMUM - 1) < 2e-3, f'{thermo(output)[-1]["c_e[1]"]:.4f}')

finish()
