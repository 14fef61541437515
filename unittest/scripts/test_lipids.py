"""Lipids: what leaflets are made of gives spontaneous curvatures; their files, their log, restarts, and a flat membrane."""

import math
import os
import re

from lammps_claims import claim, error_of, finish, run, thermo

# === The library that comes with the package

FILE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "potentials", "lipids.membrane")
LIPIDS = {}
for line in open(FILE):
    words = line.split("#")[0].split()
    if words:
        LIPIDS[words[0]] = (float(words[1]), float(words[2]))
EXPECTED = {"POPC": (68.3, -1 / 87.3), "DOPC": (69.7, -1 / 87.3), "DOPE": (63.4, -1 / 29.4), "POPE": (58.8, -1 / 29.4),
            "CHOL": (31.0, -1 / 27.2), "CHL1": (31.0, -1 / 27.2), "DOG": (59.0, -1 / 11.5), "DOPS": (71.6, 1 / 144),
            "CER180": (59.0, 0.0), "SSM": (59.0, 0.0), "PSM": (59.0, 0.0)}
claim("lipids.membrane has the lipids of the hd program with their numbers",
      all(abs(LIPIDS[k][0] - a) + abs(LIPIDS[k][1] - c) < 1e-15 for k, (a, c) in EXPECTED.items()), len(LIPIDS))

# === Mixtures

R, KC = 200.0, 14.0
SCENE = """
units           {units}
atom_style      membrane_cp
region          box block {lo} {hi} {lo} {hi} {lo} {hi}
create_box      1 box angle/types 1
create_membrane 1 sphere 2 {radius}
pair_style      helfrich
{coeff}
compute         hf all pair helfrich
thermo_style    custom step pe c_hf[1] c_hf[5]
thermo_modify   norm no format float %.15g
run             0
"""
ENV = {"LAMMPS_POTENTIALS": os.path.dirname(FILE)}


def script(words, units="real", scale=1.0, c0=0.0):
    return SCENE.format(units=units, lo=-300 * scale, hi=300 * scale, radius=R * scale,
                        coeff=f"pair_coeff 1 1 {KC} {c0!r} {words}")


def energy(words, **options):
    return thermo(run(script(words, **options), env=ENV))[-1]


def curvature(parts, library=LIPIDS):
    area = sum(n * library[k][0] for k, n in parts.items())
    return sum(n * library[k][0] * library[k][1] for k, n in parts.items()) / area


def bilayer(outer, inner, library=LIPIDS):
    return 0.5 * (curvature(outer, library) - curvature(inner, library))


def close(a, b, tolerance=1e-12):
    return abs(a / b - 1) < tolerance


MIX = "lipids lipids.membrane outer DOPC 50 DOPE 30 CHOL 20 inner DOPC 10 DOPS 5"
c0 = bilayer({"DOPC": 50, "DOPE": 30, "CHOL": 20}, {"DOPC": 10, "DOPS": 5})
plain, mixed = energy("", c0=c0), energy(MIX)
flat = 0.5 * KC * c0**2 * plain["c_hf[5]"]
claim("a mixture bends as a bilayer with the mean c0 weighted by area, less what it has when flat",
      close(mixed["PotEng"], plain["PotEng"] - flat) and close(mixed["c_hf[1]"], mixed["PotEng"]), mixed["PotEng"])
for words in ("lipids lipids.membrane inner DOPS 1 outer CHOL 2 DOPE 3 inner DOPC 2 outer DOPC 5",
              "lipids lipids.membrane library X 1 1 inner DOPC 2 DOPS 1 outer DOPE 3 DOPC 5 CHOL 2"):
    claim("order does not matter, nor what parts sum to", close(energy(words)["PotEng"], mixed["PotEng"]))
claim("equal leaflets have no curvature", close(
    energy("lipids lipids.membrane outer DOPE 2 inner DOPE 7")["PotEng"], energy("")["PotEng"]))
ours = dict(LIPIDS, DOPE=(70.0, -0.001))
c0 = bilayer({"DOPE": 1, "DOPC": 1}, {"DOPC": 1}, ours)
claim("library takes the place of the file", close(
    energy("lipids lipids.membrane outer DOPE 1 DOPC 1 inner DOPC 1 library DOPE 70.0 -0.001")["PotEng"],
    energy("", c0=c0)["PotEng"] - 0.5 * KC * c0**2 * plain["c_hf[5]"]))
claim("c0 of pair_coeff comes to it", close(
    energy("lipids lipids.membrane outer DOPC 1 inner DOPC 1", c0=0.01)["PotEng"],
    energy("", c0=0.01)["PotEng"] - 0.5 * KC * 0.01**2 * plain["c_hf[5]"]))
claim("lengths are converted to the units of the simulation", close(
    energy(MIX, units="nano", scale=0.1)["PotEng"], mixed["PotEng"]))
for units in ("lj",):
    claim(f"units {units} have no length for the file: an error says what to do",
          "say NULL in place of the file" in error_of(script(MIX, units=units), env=ENV))
for head, what in (("# DATE: 2000-01-01 CONTRIBUTOR: nobody", "must have UNITS"),
                   ("# UNITS: real\nDOPC -69.7 0.1", "other.membrane, line 2: the area of lipid DOPC must be positive"),
                   ("# UNITS: real\nDOPC 69.7", "line 2: a line has the name of a lipid"),
                   ("# UNITS: real\nDOPC 69.7 0.1\nDOPC 69.7 0.2", "line 3: lipid DOPC has area")):
    with open("other.membrane", "w") as file:
        file.write(head + "\n")
    found = error_of(script("lipids other.membrane outer DOPC 1 inner DOPC 1"))
    claim(f"a file with an error is refused: {what}", what in found, found if what not in found else "")

# === The log

log = run(script("lipids lipids.membrane outer DOPC 1 DOPE 1 inner DOPC 1"), env=ENV)
found = re.search(r"Lipids of type 1 on area (\S+), bilayer c0 (\S+):\s+outer DOPC 0.5, DOPE 0.5, area/lipid 66.55, "
                  r"curvature (\S+), (\d+) lipids\s+inner DOPC 1, area/lipid 69.7, curvature (\S+), (\d+) lipids", log)
claim("the log shows fractions, curvatures, areas and numbers", found and
      close(float(found[2]), bilayer({"DOPC": 1, "DOPE": 1}, {"DOPC": 1}), 1e-5) and
      abs(float(found[4]) - float(found[1]) / 66.55) < 1 and abs(float(found[6]) - float(found[1]) / 69.7) < 1,
      found and found[0].replace("\n", ";"))

# === Restarts and types

TWO = (SCENE.replace("create_box      1", "create_box      2").replace("pair_style", "set group all type/fraction 2 0.5 4711\n"
       "pair_style"))
BOTH = (f"pair_coeff 1 1 {KC} 0.001 leaflets 12.0 {MIX}\npair_coeff 2 2 {KC} 0.0 lipids lipids.membrane outer DOPE 1 "
        "inner CHOL 1")
ROW = "write_restart   lipids.restart\n"
settings = dict(units="real", lo=-300, hi=300, radius=R, coeff=BOTH)
first = {ranks: thermo(run(TWO.format(**settings) + ROW, env=ENV, ranks=ranks))[-1] for ranks in (2, 1)}
claim("two ranks have the energy of one", close(first[1]["PotEng"], first[2]["PotEng"], 1e-13), first[1]["PotEng"])
again = thermo(run("""
read_restart    lipids.restart
compute         hf all pair helfrich
thermo_style    custom step pe c_hf[1] c_hf[5]
thermo_modify   norm no format float %.15g
run             0
"""))[-1]
claim("a restart has the same energy to the last bit, without the file", again == first[1])
claim("a name has the same numbers for all types", "lipid DOPC has area 50" in error_of(
    TWO.format(**dict(settings, coeff=f"pair_coeff 1 1 {KC} 0.0 {MIX}\npair_coeff 2 2 {KC} 0.0 lipids NULL library DOPC 50 0 "
                      "outer DOPC 1 inner DOPC 1")), env=ENV))

# === A relaxed sphere with leaflets

RELAX = """
units           lj
atom_style      membrane_cp
region          box block -2 2 -2 2 -2 2
create_box      1 box angle/types 1
create_membrane 1 sphere 2 1.0
set             type 1 mass 1.0
pair_style      helfrich
pair_coeff      1 1 1.0 0.0 leaflets {distance} lipids NULL library A 1 0.8 library B 1 -0.5 outer A 1 inner B 1 &
                regularize 0.001 area 1e4 init
compute         hf all pair helfrich
thermo_style    custom step pe c_hf[1] c_hf[5]
thermo_modify   norm no format float %.15g
thermo          1000
min_style       membrane
minimize        0 1e-7 2000 4000
"""
for distance in (0.05, 0.1, 0.2, 0.3):
    row = thermo(run(RELAX.format(distance=distance)))[-1]
    radius = math.sqrt(row["c_hf[5]"] / (4 * math.pi))
    out, back = radius + distance, radius - distance
    exact = math.pi * ((2 / out - 0.8) ** 2 * out**2 + (2 / back - 0.5) ** 2 * back**2 - (0.8**2 + 0.5**2) * radius**2)
    claim(f"a relaxed sphere of 162 points with leaflets at D/R = {distance / radius:.3f} has the energy of a sphere to 2e-4",
          close(row["c_hf[1]"], exact, 2e-4), f"{row['c_hf[1]'] / exact - 1:.1e}")

# === A flat membrane keeps its area

SHEET = """
units           real
atom_style      membrane_cp
region          box block 0 200 0 173.2050807568877 -50 50
create_box      1 box angle/types 1
create_membrane 1 plane 12 12
set             type 1 mass 1000.0
pair_style      helfrich
pair_coeff      1 1 14.0 0.0 area 0.35 init {words}
thermo_style    custom step pe lx ly pxx pyy fmax
thermo_modify   norm no format float %.15g
fix             box all box/relax x 0.0 y 0.0 vmax 0.001
minimize        0 1e-12 200 400
unfix           box
fix             motion all hd/nve
timestep        1.0
run             20
"""
for words in ("outer CHOL 1 inner DOPS 1", "outer DOPS 3 CHOL 2 inner DOPE 1", "outer DOPE 1 inner DOPE 1"):
    for leaflets in ("", "leaflets 12.0 "):
        rows = thermo(run(SHEET.format(words=f"{leaflets}lipids lipids.membrane {words}"), env=ENV))
        worst = max(max(abs(row["Lx"] / 200 - 1), abs(row["Ly"] / 173.2050807568877 - 1)) for row in rows)
        pressure = max(max(abs(row["Pxx"]), abs(row["Pyy"])) for row in rows)
        claim(f"a flat sheet at rest keeps its area: {leaflets}{words}", worst < 1e-10 and pressure < 1e-7,
              f"{worst:.1e}, pressure {pressure:.1e} atm")

finish()
