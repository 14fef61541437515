"""Every style stays alive through every command that may stand between two runs.

A row of the matrix is a set of styles, a column a command with what it does to the energy. To add a
style or a command is to add a line."""
# cost: 15

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
                claim("   ... with the energy that it should have", abs(found - expected) <= 1e-10 * (1 + abs(E)),
                      (found, expected))
            if "dump" in style:
                claim("   ... and draws", len(glob.glob("d.*.ppm")) >= 2, glob.glob("d.*.ppm"))

# === What "init" stands for: the shape at the first run of these control points, whatever commands renumber

TERMS = """
pair_style      helfrich
pair_coeff      1 1 10.0 0.0 area 30 init volume 20 init area/difference 5 init thickness 0.1 area/local 40 regularize 2 conformal
"""
SHEET_TERMS = """
pair_style      helfrich
pair_coeff      1 1 10.0 0.0 area 30 init area/difference 5 init thickness 0.1 area/local 40
"""
SHEET = START.replace(VESICLE, "create_membrane 1 plane 8 8 mass 50\n")
TWO = START + "create_membrane 1 sphere 2 1.0 center 0 0 9 mass 50\n"
SHAKE = "displace_atoms all random 0.05 0.05 0.05 77\n"
RENUMBER = {
    "reset_atoms id": "reset_atoms id",
    "reset_atoms id sort yes": "reset_atoms id sort yes",
    "set mol": "set group all mol 7",
    "reset_timestep": "reset_timestep 0",
    "balance": "balance 1.0 shift xyz 5 1.05",
    "change_box": "change_box all x final -4 4 y final -4 4 units box",
    "write_restart": "write_restart s.restart\nclear\nread_restart s.restart\nthermo_style custom step pe\n"
                     "thermo_modify norm no format float %24.17g",
    "pair_style of another kind": "pair_style zero 1.0\npair_coeff * *\nrun 0\n" + TERMS,
}
for ranks in RANKS:
    for what, (start, terms) in {"sphere": (START, TERMS), "plane": (SHEET, SHEET_TERMS)}.items():
        head = start + terms + OUTPUT.format("") + "run 0\n" + SHAKE + "run 0\n"
        expected = {name: (command, lambda E, NEW: E) for name, command in RENUMBER.items()
                    if not (what == "plane" and name in ("change_box", "pair_style of another kind"))}
        if what == "sphere":
            expected["pair_style of another kind"] = (RENUMBER["pair_style of another kind"], None)
            expected["delete_atoms, create_membrane"] = ("delete_atoms group all bond no\n" + VESICLE,
                                                         lambda E, NEW: NEW)
        across = " bond/periodic\nset group all mol 1" if what == "plane" else ""
        expected["replicate"] = (f"replicate 2 1 1{across}", lambda E, NEW: 2 * E)
        expected["replicate twice"] = (f"replicate 2 1 1{across}\nrun 0\nreset_atoms id sort yes\n"
                                       f"replicate 1 2 1{across}", lambda E, NEW: 4 * E)
        expected["pair_coeff again"] = (terms.strip().splitlines()[1], None)
        for name, (command, energy) in expected.items():
            rows = rows_of(head + command + "\nrun 0\nrun 0\n", ranks=ranks)
            if claim(f"init of a {what} on {ranks}, {name}: runs on", len(rows) >= 4):
                E, NEW, found, again = rows[1]["PotEng"], rows[0]["PotEng"], rows[-2]["PotEng"], rows[-1]["PotEng"]
                if energy:
                    claim("   ... with the references that it should have", abs(found - energy(E, NEW)) <= 1e-10 * E,
                          (found, energy(E, NEW)))
                else:
                    claim("   ... and takes the present shape", found < E - 0.01, (found, E))
                claim("   ... also in the run after", abs(found - again) <= 1e-12 * E, (found, again))
    # where points gather is measured in one piece, whatever images they are in
    rows = rows_of(START + "pair_style helfrich\npair_coeff 1 1 0 0 regularize 2 conformal\n" + OUTPUT.format("") + "run 0\n" + SHAKE +
                   "run 0\ndisplace_atoms all move 3 3 3\nrun 0\ndisplace_atoms all move 7 -2 0\nrun 0\n", ranks=ranks)
    E = rows[1]["PotEng"]
    claim(f"regularize conformal on {ranks}: the same across the corner of the box",
          all(abs(row["PotEng"] - E) < 1e-10 * E for row in rows[2:]) and len(rows) == 4, [row["PotEng"] for row in rows])
    rows = rows_of(TWO + TERMS + OUTPUT.format("") + "run 0\n" + SHAKE + "run 0\n" +
                   "group one molecule 1\ndelete_atoms group one\nreset_atoms id sort yes\nset group all mol 1\nrun 0\n" +
                   "replicate 1 1 2\nrun 0\n", ranks=ranks)
    alone = rows_of(TWO + TERMS + OUTPUT.format("") + "run 0\n" + SHAKE + "group two molecule 2\n"
                    "delete_atoms group two\nrun 0\n", ranks=ranks)
    if claim(f"init on {ranks}: runs on when the first of two is deleted, renumbered and replicated",
             len(rows) == 4 and len(alone) == 2):
        first = alone[1]["PotEng"]
        claim("   ... the second keeps its reference", abs(rows[1]["PotEng"] - first - rows[2]["PotEng"]) < 1e-9,
              (rows[1]["PotEng"], first, rows[2]["PotEng"]))
        claim("   ... and so do its copies", abs(rows[3]["PotEng"] - 2 * rows[2]["PotEng"]) < 1e-9)

    error = error_of(START + TERMS + "run 0\nreset_atoms mol all single yes\nrun 0\n", ranks=ranks)
    claim(f"reset_atoms mol on {ranks}, which looks at bonds only, takes membranes apart, and it is said",
          "joins membranes" in error, error)

# === Noise is not replayed after reset_timestep, nor after a restart, which goes on where it was

ONE_STEP = "velocity all create 1.0 77\nrun 1\n"
NOISE = {
    # friction that leaves nothing of the velocities before
    "fix hd/langevin": START + FORCES + "fix i all hd/langevin 1.0 1.0 1e-12 4711\n",
    "fix hd/brownian": START + FORCES + "fix i all hd/brownian 1.0 4711 gamma_t 1e6\n",
    "fix srd/mesh": START.replace(VESICLE, "create_solvent 2 both 5.0 4711 mass 1.0") +
                    "fix i all srd/mesh 1 NULL 1.0 1.0 4711 shift yes 9127\n",
}
for ranks in RANKS:
    for name, script in NOISE.items():
        script += "timestep 1e-9\nthermo_style custom step ke\nthermo 1\nthermo_modify norm no format float %24.17g\n"
        script += "variable v equal vx[7]\n" + ONE_STEP + "print 'v $(v_v:%.17g)'\nreset_timestep 0\nwrite_restart n.restart\n"
        code, output = lammps(script + ONE_STEP + "print 'v $(v_v:%.17g)'\n", ranks=ranks)
        first, second = ([float(line.split()[1]) for line in output.splitlines() if line.startswith("v ")] + [0, 0])[:2]
        claim(f"{name} on {ranks}: another velocity in the second run", code == 0 and abs(first - second) > 1e-6 * abs(first),
              (first, second))
        fix = next(line for line in script.splitlines() if line.startswith("fix"))
        code, output = lammps("read_restart n.restart\n" + fix + "\ntimestep 1e-9\nvariable v equal vx[7]\n" +
                              ONE_STEP + "print 'v $(v_v:%.17g)'\n", ranks=ranks)
        again = [float(line.split()[1]) for line in output.splitlines() if line.startswith("v ")]
        claim("   ... the same after a restart", code == 0 and again == [second], (again, second))

# === Atoms that go from one rank alone, of two that have no ghosts

LOST = """
units           lj
atom_style      membrane_cp
region          box block -20 20 -20 20 -20 20
create_box      2 box angle/types 1
create_membrane 1 sphere 2 2.5 center -10 0 0 mass 5
create_atoms    2 single -16 0 0
create_atoms    2 single 10 0 0
set             type 2 mass 1.0
group           membrane type 1
fix             i membrane hd/nve
velocity        membrane create 1.0 87287 loop geom
""" + FORCES + """
compute         t membrane hd/temp
run             0
region          right block 5 15 INF INF INF INF
group           right region right
delete_atoms    group right
print           "t $(c_t[1]:%.15g)"
"""
values = []
for ranks in RANKS:
    code, output = lammps(LOST, ranks=ranks)
    values += [float(line.split()[1]) for line in output.splitlines() if line.startswith("t ")]
claim("compute hd/temp, asked when one rank has lost an atom and another none, is the same on all numbers of ranks",
      len(values) == len(RANKS) and max(values) - min(values) < 1e-12 * max(values), values)

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
