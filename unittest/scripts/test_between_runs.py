"""Every style stays alive through every command that may stand between two runs.

A row of the matrix is a set of styles, a column a command with what it does to the energy. To add a
style or a command is to add a line."""

import glob
import os

from lammps_claims import MPIEXEC, claim, error_of, finish, lammps, thermo

RANKS = (1, 2) if MPIEXEC else (1,)

VESICLE = "create_membrane 1 sphere 2 1.0 mass 50\n"
START = f"""
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
create_box      2 box angle/types 1
{VESICLE}
"""
FORCES = """
pair_style      helfrich
pair_coeff      1 1 10.0 0.0 regularize 1.0
timestep        0.001
thermo          1
"""
OUTPUT = """
thermo_style    custom step pe {}
thermo_modify   norm no format float %24.17g
"""

# === Membranes

STYLES = {
    "pair helfrich, computes": (
        "compute t all hd/temp\ncompute s all membrane/shape\ncompute k all membrane/curvature/atom\n"
        "compute m all reduce ave c_k[1]", "c_t c_s[1] c_m"),
    "fix hd/nve": ("fix i all hd/nve", ""),
    "fix hd/langevin": ("fix i all hd/langevin 1.0 1.0 1.0 4711", ""),
    "dump membrane/image": ("dump d all membrane/image 1 d.*.ppm type type size 40 40", ""),
}
# what happens; the energy after it, if E is that before it and NEW that of a new membrane
COMMANDS = {
    "replicate": ("replicate 2 1 1", lambda E, NEW: 2.0 * E),
    "reset_timestep": ("reset_timestep 0", lambda E, NEW: E),
    "delete_atoms": ("delete_atoms group all bond no", lambda E, NEW: 0.0),
    "delete_atoms, create_membrane":
        ("delete_atoms group all bond no\n" + VESICLE, lambda E, NEW: NEW),
    "create_membrane": ("create_membrane 1 sphere 2 1.0 center 0 0 9 mass 50", lambda E, NEW: E + NEW),
}
NO_MEMBRANE = {"delete_atoms"}


def rows_of(script, **options):
    code, output = lammps(script, **options)
    if code != 0:
        print("\n".join(output.splitlines()[-4:]))
    return thermo(output) if code == 0 else []


for ranks in RANKS:
    for style, (commands, column) in STYLES.items():
        for between, (command, energy) in COMMANDS.items():
            for picture in glob.glob("d.*.ppm"):
                os.remove(picture)
            script = START + FORCES + commands + "\n" + OUTPUT.format(column) + "run 1\n" + command + "\nrun 1\n"
            rows = rows_of(script, ranks=ranks)
            if claim(f"{style} on {ranks}, {between}: runs on", len(rows) == 4):
                E, NEW = rows[1]["PotEng"], rows[0]["PotEng"]
                expected, found = energy(E, NEW), rows[2]["PotEng"]
                claim("   ... with the energy that it should have", abs(found - expected) <= 1e-10 * (1 + E),
                      (found, expected))
            if "dump" in style:
                claim("   ... and draws", len(glob.glob("d.*.ppm")) >= 2, glob.glob("d.*.ppm"))

# === Solvent

SOLVENT = """
create_solvent  2 outside 5.0 4711 mass 1.0
group           membrane type 1
group           solvent type 2
fix             i membrane hd/nve
fix             s solvent srd/mesh 10 membrane 1.0 1.0 4711 shift yes 9127
timestep        0.01
thermo          20
"""
WATCH = OUTPUT.format("f_s[2] f_s[3] f_s[5] f_s[6] f_s[7] f_s[8] f_s[9]")    # collisions, crossings, momentum, sides
GONE = "delete_atoms group membrane bond no\n"

for ranks in RANKS:
    rows = rows_of(START + FORCES + SOLVENT + WATCH + "run 20\n" + GONE + "run 20\n" + VESICLE +
                   "group membrane type 1\nrun 20\n", ranks=ranks)
    if claim(f"fix srd/mesh on {ranks}: runs on without its membranes, and with new ones", len(rows) == 6):
        with_first, alone, with_new = (rows[i + 1]["f_s[2]"] - rows[i]["f_s[2]"] for i in (0, 2, 4))
        claim("   ... which it meets, alone nothing", with_first > 0 == alone < with_new,
              (with_first, alone, with_new))
        claim("   ... nothing crosses", rows[-1]["f_s[3]"] == 0)
        drift = max(abs(rows[i + 1][f"f_s[{k}]"] - rows[i][f"f_s[{k}]"]) for i in (0, 2, 4) for k in (5, 6, 7))
        claim("   ... momentum is kept in each run", drift < 1e-9, drift)
        claim("   ... without membranes all solvent is outside, with the new one some is inside",
              rows[3]["f_s[8]"] == 0 < rows[5]["f_s[8]"], (rows[3]["f_s[8]"], rows[5]["f_s[8]"]))
    rows = rows_of(START + FORCES + SOLVENT + WATCH + "run 20\nreset_timestep 0\nrun 20\n", ranks=ranks)
    if claim(f"fix srd/mesh on {ranks}: runs on after reset_timestep", len(rows) == 4):
        claim("   ... nothing crosses, and it goes on counting",
              rows[-1]["f_s[3]"] == 0 and rows[-1]["f_s[2]"] > rows[1]["f_s[2]"] == rows[2]["f_s[2]"])
    error = error_of(START + FORCES + SOLVENT + WATCH + "run 20\n" + GONE + 'print "$(f_s[1])"\n', ranks=ranks)
    claim(f"fix srd/mesh on {ranks}: asked between, when atoms are gone, it says so", "use run 0" in error, error)
    rows = rows_of(START + FORCES + SOLVENT + WATCH + "run 20\nunfix s\nreplicate 2 1 1\n" +
                   "fix s solvent srd/mesh 10 membrane 1.0 1.0 4711 shift yes 9127\n" + WATCH + "run 20\n",
                   ranks=ranks)
    if claim(f"fix srd/mesh on {ranks}: made anew after replicate, it runs on", len(rows) == 4):
        claim("   ... with twice the solvent", rows[2]["f_s[8]"] + rows[2]["f_s[9]"] ==
              2 * (rows[0]["f_s[8]"] + rows[0]["f_s[9]"]))

# the solvent keeps meshes in shape to the same extent in the first and in the second run
lamda = START.replace("sphere 2", "sphere 1") + FORCES.replace(" regularize 1.0", "") + SOLVENT.replace(
    "shift yes", "lamda 0.05 shift yes") + OUTPUT.format("") + "run 0\nrun 0\n"
rows = rows_of(lamda)
claim("default regularize of solvent with lamda is the same in a second run", len(rows) == 2 and
      rows[0]["PotEng"] == rows[1]["PotEng"], [row["PotEng"] for row in rows])

finish()
