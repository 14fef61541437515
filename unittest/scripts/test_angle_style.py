"""Angle style membrane: faces are angles that need no style of the user's, and nothing else changes."""

from lammps_claims import MPIEXEC, claim, error_of, finish, run, thermo

HEAD = """
units           lj
atom_style      membrane_cp faces 1
region          box block -4 4 -4 4 -4 4
create_box      2 box angle/types {types}
"""
MESH = "create_membrane 1 sphere 2 1.6 mass 1.0\n"
SHAKE = "displace_atoms all random 0.05 0.05 0.05 4711\n"
PAIR = """
pair_style      helfrich
pair_coeff      1 1 10.0 0.0 area 100 init
"""
OUTPUT = """
thermo_style    custom step pe eangle press
thermo_modify   norm no format float %.17g
"""
START = HEAD.format(types=1) + MESH
WARNINGS = ("no angle style", "1-3 special")


def noise(output):
    return [line for line in output.splitlines() if any(words in line for words in WARNINGS)]


# === None set: no warning, in any run, whatever set the control points in motion or not at all

MOTION = "fix i all hd/nve\ntimestep 1e-4\n"
for name, script in {
        "pair helfrich": START + PAIR + MOTION + "run 1\nrun 1\nminimize 0 0 1 1\nrun 1\n",
        "no pair style": START + MOTION + "run 1\nrun 1\n",
        "hybrid": START + PAIR.replace("style      ", "style hybrid/overlay lj/cut 1.0 ").replace("1 1 ", "1 1 helfrich ") +
                  "pair_coeff * 2 lj/cut 1 1\n" + MOTION + "run 1\nrun 1\n",
        "replicate": START + PAIR + MOTION + "run 1\nreplicate 2 1 1\nrun 1\n",
        "clear": START + PAIR + "run 0\nclear\n" + START + PAIR + "run 0\n",
        "angle_style none": START + "angle_style none\n" + PAIR + "run 0\nangle_style none\nrun 0\n",
        "angle_style membrane": START + "angle_style membrane\nangle_coeff *\n" + PAIR + "run 0\nrun 0\n",
        "before and after the commands": START + "group all type 1\n" + PAIR + SHAKE + "delete_atoms group all bond no\n"
                                         "create_membrane 1 sphere 1 1.0\nrun 0\nset type 1 mass 2\nrun 0\n"}.items():
    for ranks in (1, 2) if MPIEXEC else (1,):
        found = noise(run(script, ranks=ranks))
        claim(f"{name} on {ranks}: LAMMPS does not miss an angle style", not found, found)

# === Restart and data files, with the style still there and not

for name, before, files in (("before a run", "", "ab"), ("after a run", "run 0\n", "cd")):
    run(START + PAIR + SHAKE + before + f"write_restart {files[0]}.file\nwrite_data {files[1]}.file\n")
    for kind, file in zip(("read_restart", "read_data"), files):
        head = "units lj\natom_style membrane_cp\n" if kind == "read_data" else ""
        output = run(head + f"{kind} {file}.file\n" + PAIR + OUTPUT + "run 0\n")
        energy = thermo(output)[-1]["PotEng"]
        claim(f"{kind} of a file written {name}: no warning, the same energy", not noise(output) and energy > 1.0, energy)
claim("data files have no Angle Coeffs", not any("Angle Coeffs" in open(f"{f}.file").read() for f in "bd"))

# === Angles of other molecules: the user's style acts on them as ever

TRIPLE = HEAD.format(types=2) + MESH + """
create_atoms    2 single 0 0 3
create_atoms    2 single 1 0 3
create_atoms    2 single 0 1 3
set             type 2 mass 1.0
create_bonds    single/angle 2 164 163 165
pair_style      hybrid/overlay helfrich zero 1.0
pair_coeff      1 1 helfrich 10.0 0.0
pair_coeff      * 2 zero
"""
HARMONIC = "angle_coeff 2 harmonic 3.0 60.0\n"
BEND = 3.0 * (3.141592653589793 / 6.0)**2
for name, style in {"hybrid with membrane": "angle_style hybrid membrane harmonic\nangle_coeff 1 membrane\n" + HARMONIC,
                    "hybrid with none": "angle_style hybrid harmonic\nangle_coeff 1 none\n" + HARMONIC,
                    "harmonic": "angle_style harmonic\nangle_coeff 1 0.0 60.0\nangle_coeff 2 3.0 60.0\n"}.items():
    for ranks in (1, 2) if MPIEXEC else (1,):
        rows = thermo(run(TRIPLE + style + OUTPUT + "run 0\nrun 0\nwrite_restart h.restart\n", ranks=ranks))
        energies = [row["E_angle"] for row in rows]
        claim(f"{name} on {ranks}: acts", len(rows) == 2 and all(abs(E - BEND) < 1e-12 for E in energies), energies)
        rows = thermo(run("read_restart h.restart\n" + ("" if name == "harmonic" else style) +
                          "pair_coeff 1 1 helfrich 10.0 0.0\npair_coeff * 2 zero\n" + OUTPUT + "run 0\n", ranks=ranks))
        claim("   ... and after a restart", abs(rows[0]["E_angle"] - BEND) < 1e-12, rows[0]["E_angle"])

# === Words

error = error_of(START + "angle_coeff 1 3.0 60.0\n")
claim("angle_coeff without an angle_style of one's own", "faces of membranes, which have no coefficients" in error, error)
error = error_of(START + "angle_style membrane zero\n")
claim("angle_style membrane takes no words", "Illegal angle_style membrane argument: zero" in error, error)
error = error_of(START + PAIR + "compute a all angle/local eng\nrun 0\n")
claim("compute angle/local asks for an angle style, as ever", "No angle style is defined" in error, error)

finish()
