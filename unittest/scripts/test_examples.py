"""The examples of dynamics do what they say; those that take averages with a tenth of their steps."""
# cost: 60

import os
import shutil
import subprocess
import sys

from lammps_claims import EXAMPLES, claim, finish, run


def example(name, *changes, script="in.membrane"):
    """What an example prints, its long runs cut short."""
    script = open(os.path.join(EXAMPLES, name, script)).read()
    for long, short in changes:
        claim(f"{name} has {long!r}", long in script)
        script = script.replace(long, short)
    return run(script)


def plotted(name, table="spectrum.txt"):
    """Exit code of the example's plot.py, and the rows of its table."""
    shutil.copy(os.path.join(EXAMPLES, name, "plot.py"), ".")
    done = subprocess.run([sys.executable, "plot.py"], stdout=subprocess.PIPE, text=True)
    return done.returncode, [line.split() for line in open(table)][1:]


def ratios_of(rows):
    return [float(row[-3]) for row in rows]


output = example("vesicle_nve")
last = [line for line in output.split("\n") if line.startswith("timestep ") and "smaller by a factor" in line][-1]
factor = float(last.split()[-1])
claim("vesicle_nve: half the timestep has a quarter of the energy error", 3.5 < factor < 4.5, last)

output = example("plane", ("500 5000", "50 500"), ("run             100000", "run             10000"))
lines = output.split("\n")
start = max(i for i, line in enumerate(lines) if line.split() == ["nx", "ny", "q", "omega", "omega/q^2"])
ratios = [float(line.split()[4]) for line in lines[start + 1:start + 5]]
claim("plane: omega = q^2 within 3e-4", all(abs(ratio - 1) < 3e-4 for ratio in ratios), ratios)
code, rows = plotted("plane")
ratios = ratios_of(rows)
mean = sum(ratios) / len(ratios)
claim("    and its spectrum is near theory", code == 0 and len(ratios) == 21 and abs(mean - 1) < 0.05, f"{mean:.3f}")

example("flicker", ("run             20000", "run             2000"))
code, rows = plotted("flicker")
ratios = ratios_of([row for row in rows if row[0] != "fitted"])
mean = sum(ratios) / len(ratios)
claim("flicker: the spectrum is near theory", code == 0 and len(ratios) == 9 and abs(mean - 1) < 0.1, f"{mean:.3f}")
kc, error = float(rows[-2][2]), float(rows[-2][4])
claim("    and so is the bending modulus that is fitted to it", abs(kc - 1) < 0.02 + 3 * error, f"{kc} +- {error}")

example("tension", ("run             2000", "run             300"), ("run             10000", "run             600"))
code, rows = plotted("tension", "tension.txt")
claim("tension: two frames, each with its membrane near the area of theory",
      code == 0 and len(rows) == 4 and all(abs(float(row[2]) / float(row[5]) - 1) < 0.005 for row in rows[::2]),
      [row[2:6] for row in rows[::2]])

example("relaxation_srd", ("loop 6", "loop 2"), ("run             2000", "run             1000"), script="in.plane")
example("relaxation_srd", ("loop 6", "loop 2"), ("run             1000", "run             300"),
        ("run             850", "run             500"), script="in.vesicle")
shutil.copy(os.path.join(EXAMPLES, "relaxation_srd", "plot.py"), ".")
code = subprocess.run([sys.executable, "plot.py"]).returncode
for name in ("plane", "vesicle"):
    rows = [[float(word) for word in line.split()] for line in open(name + ".txt") if not line.startswith("#")]
    early = sum(row[1] - row[3] for row in rows[:len(rows) // 3]) / (len(rows) // 3)
    claim(f"relaxation_srd: {name} relaxes, at first near theory", code == 0 and abs(early) < 0.3 and rows[-1][1] < 0.9,
          f"{early:+.3f}, {rows[-1][1]:.3f} in the end")

output = example("poiseuille", ("20 250 5000 layer", "20 50 1000 layer"), ("20 250 5000 v_speed", "20 50 1000 v_speed"),
                 ("index 1000 1000 3000 15000 20000", "index 300 300 400 1000 1000"),
                 script="in.poiseuille")
code, rows = plotted("poiseuille", "flow.txt")
*profile, last = rows
speed, mean, without = float(last[1]), float(last[7].rstrip(",")), float(last[10])
claim("poiseuille: the vesicle takes away some of the flow, and is faster than its mean",
      code == 0 and len(profile) == 24 and 0.7 < mean / without < 1.0 and mean < speed < 1.5 * without,
      f"vesicle {speed:.3f}, mean {mean:.3f}, without vesicle {without:.3f}")

output = example("bound", ("run             2000", "run             500"), ("run             12000", "run             2400"),
                 script="in.bound")
code, rows = plotted("bound", "decay.txt")
free, crowded = [[float(row[7].rstrip(",")) for row in rows if row[:2] == ["fitted", kind]] for kind in ("tracers", "proteins")]
error = [float(row[9].rstrip(",")) for row in rows if row[:2] == ["fitted", "tracers"]]
claim("bound: tracers diffuse as they do when free", code == 0 and abs(free[1] - 0.1) < 0.005 + 3 * error[1], f"{free} +- {error}")
claim("    and proteins that crowd one another more slowly", all(0.3 < c / 0.1 < 0.6 for c in crowded), crowded)

output = example("bound_sorting", ("run             8000", "run             600"), ("run             2000", "run             600"),
                 script="in.sorting")
code, rows = plotted("bound_sorting", "sorting.txt")
crests, theory = float(rows[-1][4]), float(rows[-1][8])
claim("bound_sorting: coats gather on the crests", code == 0 and crests > 1.5 and theory > 1.5, f"{crests}, theory {theory}")

example("modes", ("run             60000", "run             6000"), script="in.solvent")
code, rows = plotted("modes", "solvent.txt")
off = [float(row[2]) - float(row[3]) for row in rows if row[0] == "3"]
claim("modes: a wave in implicit solvent is forgotten as hydrodynamics has it", code == 0 and max(map(abs, off)) < 0.3,
      f"within {max(map(abs, off)):.2f}")
finish()
