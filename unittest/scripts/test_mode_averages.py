"""compute hd/modes ... average: mean powers over a run, errors, theory, several runs, changes between them, wrong input."""

import math
import os

from lammps_claims import claim, error_of, finish, run, thermo

VESICLE = """
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
create_box      1 box angle/types 1
create_membrane 1 sphere 2 1.0 mass 0.1
special_bonds   lj/coul 1 1 1
pair_style      helfrich
pair_coeff      1 1 1.0 0.0 volume 1000.0 init regularize 1.0 conformal
fix             1 all hd/langevin 0.05 0.05 1.5 4711 mass sampling
timestep        0.3
thermo          100
thermo_modify   norm no format float %.15g
"""
SHEET = """
units           lj
atom_style      membrane_cp
region          box block 0 12 0 12.124355652982141 -9 9
create_box      1 box angle/types 1
create_membrane 1 plane 12 14 mass 0.9
special_bonds   lj/coul 1 1 1
pair_style      helfrich
pair_coeff      1 1 1.0 0.0 regularize 1.0 conformal tension 0.2
fix             1 all hd/langevin 0.05 0.05 1.5 4711 mass sampling
timestep        0.3
thermo          100
thermo_modify   norm no format float %.15g
"""
COLUMNS = 7


def table(rows):
    """Columns of thermo that have the table, and what gets it out of a row of thermo."""
    entries = " ".join(f"c_a[{i}][{j}]" for i in range(1, rows + 1) for j in range(1, COLUMNS + 1))
    return entries, lambda row: [[row[f"c_a[{i}][{j}]"] for j in range(1, COLUMNS + 1)] for i in range(1, rows + 1)]


def numbers_of(path):
    return [list(map(float, line.split())) for line in open(path) if not line.startswith("#")]


def custom(rows):
    return f"thermo_style custom step c_a[{{}}] {table(rows)[0]}\nthermo_modify norm no format float %.15g\n"


# === Means are those of fix ave/time; two runs are one; the steps that runs begin with are not counted

for ranks in (1, 2):
    if os.path.exists("spectrum.txt"):
        os.remove("spectrum.txt")
    output = run(VESICLE + """
run             20
compute         a all hd/modes sphere 6 average 2 theory 0.05 1.0 0.3 file spectrum.txt
""" + custom(5).format(5) + "run 80\nrun 120\n", ranks=ranks)
    rows = thermo(output)
    found = table(5)[1](rows[-1])
    claim(f"{ranks} ranks: one sample every two steps of both runs", rows[-1]["c_a[5]"] == 100, rows[-1]["c_a[5]"])
    claim(f"{ranks} ranks: none before the first step", rows[-1]["Step"] == 220 and
          next(row for row in rows if "c_a[5]" in row)["c_a[5]"] == 0)
    claim(f"{ranks} ranks: rows are degrees 2 to 6 with their modes", [row[:2] for row in found] ==
          [[l, 2 * l + 1] for l in range(2, 7)])

rows = thermo(run(VESICLE + """
run             100
compute         u all hd/modes sphere 6
compute         a all hd/modes sphere 6 average 2 theory 0.05 1.0 0.3 file spectrum.txt
fix             b all ave/time 2 50 100 c_u[2] c_u[6] mode vector file power.txt
""" + custom(5).format(5) + "run 60\nrun 40\nrun 100\n"))
found = table(5)[1](rows[-1])
blocks = [[float(line.split()[2]) for line in open("power.txt") if len(line.split()) == 3 and line[0] != "#"]]
blocks = [blocks[0][i:i + 49] for i in range(0, len(blocks[0]), 49)]
means = [sum(sum(block[l * l:(l + 1) ** 2]) for block in blocks) / len(blocks) / (2 * l + 1) for l in range(2, 7)]
off = max(abs(row[2] / mean - 1) for row, mean in zip(found, means))
claim("mean powers are those of fix ave/time", len(blocks) == 2 and off < 1e-5, f"{off:.1e}")
for l, row in enumerate(found, 2):
    theory = 0.05 / ((l - 1) * (l + 2) * (l * (l + 1) + 0.3))
    claim(f"l = {l}: the ratio is that to theory", abs(row[4] / (row[2] / theory) - 1) < 0.02, row[4] / (row[2] / theory))
    claim(f"l = {l}: errors are of the size of five to thirteen correlated squares",
          0.7 < row[3] / row[2] / math.sqrt(2 / (2 * l + 1) / 100) < 5 and
          abs(row[5] / row[4] / (row[3] / row[2]) - 1) < 0.1, (row[3] / row[2], row[6]))
written = numbers_of("spectrum.txt")
off = max(abs(a - b) / b for have, want in zip(written, found) for a, b in zip(have[:3] + have[4:6], want[:3] + want[4:6]))
claim("the file has the table at the end of the run", len(written) == 5 and off < 1e-3, f"{off:.1e}")

rows = thermo(run(VESICLE + "compute a all hd/modes sphere 2 average 1\n" + custom(1).format(5) +
                  "run 30\nreset_timestep 0\nrun 30\nreset_timestep 7\nrun 0\nminimize 0 0 3 3\nrun 20\n"))
claim("reset_timestep and minimizations between runs count for nothing", rows[-1]["c_a[5]"] == 80, rows[-1]["c_a[5]"])
claim("without theory the ratio is 0", rows[-1]["c_a[1][5]"] == 0 and rows[-1]["c_a[1][3]"] > 0)

row = thermo(run(VESICLE + "compute a all hd/modes sphere 3 average 1 theory 0.05 1.0 -8.0\n" + custom(2).format(5) +
                 "run 10\n"))[-1]
claim("where the tension of theory makes a mode grow its ratio is nan, and those of others are numbers",
      math.isnan(row["c_a[1][5]"]) and row["c_a[2][5]"] > 0, (row["c_a[1][5]"], row["c_a[2][5]"]))

# === Sheets: waves of the same length in a row

rows = thermo(run(SHEET + "run 100\ncompute u all hd/modes plane 2\n"
                  "compute a all hd/modes plane 2 average 4 theory 0.05 1.0 0.2\n"
                  "fix b all ave/time 4 25 100 c_u[3] c_u[6] mode vector file power.txt\n" + custom(5).format(4) +
                  "run 100\n"))
found = table(5)[1](rows[-1])
powers = [tuple(map(float, line.split()[1:])) for line in open("power.txt") if len(line.split()) == 3 and line[0] != "#"]
shells = []
for q, power in sorted(powers):
    if not shells or q > 1.05 * shells[-1][0][0]:
        shells.append([])
    shells[-1].append((q, power))
claim("plane: rows are waves of nearly the same length", [row[1] for row in found] == [2, 2, 2, 4, 2] and
      [len(shell) for shell in shells] == [2, 2, 2, 4, 2], [row[:2] for row in found])
off = max(max(abs(row[0] / (sum(q for q, _ in shell) / len(shell)) - 1), abs(row[2] / (sum(p for _, p in shell) / len(shell)) - 1))
          for row, shell in zip(found, shells))
claim("plane: with the means of fix ave/time", off < 1e-5, f"{off:.1e}")
area = 12 * 12.124355652982141
off = max(abs(row[4] / (sum(p / (0.05 / (area * (q ** 4 + 0.2 * q ** 2))) for q, p in shell) / len(shell)) - 1)
          for row, shell in zip(found, shells))
claim("plane: and the ratio of each wave to theory", off < 5e-5, f"{off:.1e}")

# === Between runs

TWO = VESICLE.replace("create_membrane 1 sphere 2 1.0 mass 0.1", "create_membrane 1 sphere 1 1.0 mass 0.1 center -1.5 0 0\n"
                      "create_membrane 1 sphere 1 1.0 mass 0.1 center 1.5 0 0\ngroup first molecule 1\n"
                      "group second molecule 2")
FIRST = "compute a first hd/modes sphere 2 average 1\n"
for ranks in (1, 2):
    for command in ("delete_atoms group second\nreset_atoms id", "create_membrane 1 sphere 1 0.5 mass 0.1 center 0 0 2.2"):
        output = run(TWO + FIRST + custom(1).format(5) + "run 20\n" + command + "\nrun 30\n", ranks=ranks)
        claim(f"{ranks} ranks, {command.split()[0]}: averages begin anew, and it is said",
              thermo(output)[-1]["c_a[5]"] == 30 and "averages begin anew" in output, thermo(output)[-1]["c_a[5]"])
    output = run(TWO + FIRST + custom(1).format(5) + "run 20\nuncompute a\nthermo_style custom step\n"
                 "delete_atoms group first\nrun 10\n" + FIRST.replace("first", "second") + custom(1).format(5) + "run 10\n",
                 ranks=ranks)
    claim(f"{ranks} ranks: uncompute ends it", thermo(output)[-1]["c_a[5]"] == 10)
    message = error_of(TWO + FIRST + custom(1).format(5) + "run 20\ndelete_atoms group first\nrun 10\n", ranks=ranks)
    claim(f"{ranks} ranks: without its membrane it says so", "has no membrane" in message, message)
claim("clear is safe", "Loop" in run(VESICLE + "compute a all hd/modes sphere 2 average 1\nrun 5\nclear\n" + VESICLE + "run 5\n"))

# === Wrong input

for words, said in (("sphere 4 average", "missing"), ("sphere 4 average 0", "average 0"), ("sphere 1 average 1", "begin with degree 2"),
                    ("sphere 4 average 1 theory 0.05 1.0", "missing"), ("sphere 4 average 1 theory 0 1.0 0", "must be positive"),
                    ("sphere 4 theory 0.05 1.0 0", "use average N"), ("sphere 4 file x", "use average N"),
                    ("sphere 4 average 1 mean 3", "known are")):
    message = error_of(VESICLE + f"compute a all hd/modes {words}\nrun 1\n")
    claim(f"error: {words}", said in message, message[:140])
message = error_of(VESICLE + "compute a all hd/modes sphere 4 average 1 file nowhere/at/all\n")
claim("error: a file that cannot be written, before any run", "cannot open file nowhere/at/all" in message, message[:140])

finish()
