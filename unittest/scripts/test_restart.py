"""Membranes survive what LAMMPS does to files and atoms: restart, data files, replicate, rerun, delete_atoms, clear."""

from lammps_claims import claim, error_of, finish, run, thermo
from membrane_scenes import SCENES, coefficients, read_dump

# every reference is of the shape before a shake: it cannot be taken anew without a change of the energy
INIT = "area 70.0 init area/local 40.0 area/difference 8.0 init thickness 0.1 volume 60.0 init pressure 1.5"
REMEMBERING = f"""
pair_coeff      1 1 10.0 0.8 kg 7.0 tension 3.0 {INIT}
pair_coeff      2 2 15.0 -0.4 kg -5.0 tension 5.0 {INIT}
"""
OUTPUT = """
compute         hf all pair helfrich
thermo_style    custom step pe c_hf[*]
thermo_modify   norm no format float %24.17g
"""


def difference(row, reference, times=1):
    """Largest relative difference of energies, areas and volumes, the reference taken that many times."""
    return max(abs(row[k] - times * reference[k]) / (1.0 + abs(times * reference[k]))
               for k in row if k[0] == "c" and k != "c_hf[8]" or k == "PotEng")    # [8] counts points


def same(text, row, reference, times=1):
    error = difference(row, reference, times)
    claim(f"{text}: energies, area and volume are the same to 1e-12", error < 1e-12, f"{error:.1e}")


def last(script, **options):
    return thermo(run(script, **options))[-1]


THREE = SCENES["three membranes, one sharing a type"]
CORNER = SCENES["sphere across the corner of the box"]
PLANE = SCENES["plane"]
TILTED = SCENES["tilted box, sphere across its corner"]
remembered = REMEMBERING + "run 0\n" + THREE.shake(3) + "\nrun 0\n"

# === write_restart, read_restart

rows = thermo(run(THREE.setup(quadrature=3) + remembered + "write_restart three.restart\n", ranks=2))
before = rows[-1]
claim("the energy remembers references that are not of the present shape",
      before["c_hf[4]"] < -1.0 and abs(rows[0]["c_hf[4]"] - before["c_hf[4]"]) > 1e-3)
for ranks in (1, 2):
    restarted = last("read_restart three.restart\n" + OUTPUT + "run 0\n", ranks=ranks)
    same(f"read_restart on {ranks} of a file from 2 ranks, pair_coeff and references from the file", restarted, before)
again = last("read_restart three.restart\npair_style helfrich quadrature 3\n" + REMEMBERING + OUTPUT + "run 0\n")
same("read_restart, then the same pair_style and pair_coeff commands again", again, before)
anew = thermo(run("read_restart three.restart\n" + OUTPUT + "run 0\n" + REMEMBERING + "run 0\n"))[-1]
claim("a pair_coeff command after a run takes references anew", difference(anew, before) > 1e-3)
repeated = last("read_restart three.restart\nwrite_restart again.restart\nclear\nread_restart again.restart\n" +
                OUTPUT + "run 0\n")
same("a restart file written right after read_restart", repeated, before)

# === Restart with hybrid/overlay, which keeps settings only: pair_coeff commands come again

overlay = "".join(f"pair_coeff {i} {i} helfrich {kc}\n" for i, kc in
                  enumerate((f"10.0 0.8 kg 7.0 tension 3.0 {INIT}", f"15.0 -0.4 kg -5.0 tension 5.0 {INIT}"), 1))
overlay += "pair_coeff * * lj/cut 0.0 0.2\n"
before_overlay = last(THREE.setup(style="hybrid/overlay helfrich lj/cut 0.5") + overlay + "run 0\n" +
                      THREE.shake(3) + "\nrun 0\nwrite_restart overlay.restart\n")
restarted = last("read_restart overlay.restart\n" + overlay + OUTPUT + "run 0\n")
same("read_restart with hybrid/overlay", restarted, before_overlay)

# === write_data, read_data

HEAD = "units lj\natom_style membrane_cp\n"
for name in ("three membranes, one sharing a type", "sphere across the corner of the box", "plane",
             "tilted box, sphere across its corner", "tilted box, plane", "valence 12"):
    scene = SCENES[name]
    pair = coefficients("all terms", scene.closed).replace(" area/local 40.0", "")
    written = last(scene.setup() + pair + "run 0\nwrite_data scene.data\n")
    script = HEAD + "read_data scene.data\npair_style helfrich\n" + pair + OUTPUT + "run 0\n"
    for ranks in (1, 2):
        same(f"write_data and read_data, {ranks} rank(s), {name}", last(script, ranks=ranks), written)

# === A data file without image flags of a vesicle that crosses the boundaries


def drop_image_flags(source, target):
    section = ""
    with open(source) as lines, open(target, "w") as file:
        for line in lines:
            words = line.split()
            if words and words[0].isalpha():
                section = words[0]
            if section == "Atoms" and len(words) == 10:
                line = " ".join(words[:7]) + "\n"
            elif section == "Velocities":
                continue
            file.write(line)


for name in ("sphere across the corner of the box", "tilted box, sphere across its corner"):
    scene = SCENES[name]
    pair = coefficients("all terms").replace(" area/local 40.0", "")
    written = last(scene.setup() + pair + "run 0\nwrite_data whole.data\n")
    drop_image_flags("whole.data", "flagless.data")
    script = HEAD + "read_data flagless.data\npair_style helfrich\n" + pair + OUTPUT + \
        "run 0\ndump d all custom 1 flagless.dump id xu yu zu\nrun 0\n"
    for ranks in (1, 2):
        rows = thermo(run(script, ranks=ranks))
        same(f"read_data without image flags, {ranks} rank(s), {name}", rows[-1], written)
        points = read_dump("flagless.dump")[-1].values()
        extent = max(max(p[k] for p in points) - min(p[k] for p in points) for k in range(3))
        claim(f"and its unwrapped coordinates are one piece, {name}", extent < 3.0, f"extent {extent:.3f}")

# === replicate

for name in ("three membranes, one sharing a type", "sphere across the corner of the box"):
    scene, pair = SCENES[name], coefficients("all terms")
    output = run(scene.setup() + pair + "run 0\nreplicate 2 1 3\nrun 0\n"
                 "compute mol all property/atom mol\ncompute most all reduce max c_mol\n"
                 "variable most equal c_most\nthermo_style custom step v_most\nrun 0\n")
    one, many, molecules = thermo(output)
    # references are numbers, areas of faces those at the first run
    error = abs(many["PotEng"] - 6 * one["PotEng"]) / abs(many["PotEng"])
    same(f"replicate 2 1 3 makes six of each, {name}", many, one, times=6)
    count = 3 if name.startswith("three") else 1
    claim(f"and each has a molecule ID of its own, {name}", molecules["v_most"] == 6 * count, molecules["v_most"])

pair = coefficients("all terms", closed=False).replace("area 70.0 9.0", "").replace(
    "area/difference 8.0 2.0 thickness 0.1", "")
output = run(PLANE.setup() + pair + "run 0\nreplicate 2 3 1 bond/periodic\nset group all mol 1\nrun 0\n")
same("replicate 2 3 1 bond/periodic of a plane", *thermo(output)[:0:-1], thermo(output)[0], times=6)

# === rerun

pair = coefficients("all terms")
moving = CORNER.setup() + pair + """
set             group all mass 10.0
velocity        all set 6.0 5.0 4.0
fix             move all nve
timestep        0.001
thermo          50
dump            moving all custom 50 moving.dump id x y z ix iy iz
dump_modify     moving format float %24.17g
run             200
"""
rows = thermo(run(moving))
replayed = thermo(run(CORNER.setup() + pair + "thermo 50\nrerun moving.dump dump x y z ix iy iz\n", ranks=2))
claim("rerun sees every frame", len(replayed) == len(rows) == 5, len(replayed))
error = max(difference(a, b) for a, b in zip(replayed, rows))
claim("rerun of a dump gives the energies of the run to 1e-12", error < 1e-12, f"{error:.1e}")
replayed = thermo(run(CORNER.setup() + pair + "thermo 50\nrerun moving.dump dump x y z\n"))
error = max(difference(a, b) for a, b in zip(replayed, rows))
claim("rerun of a dump without image flags gives the energies of the run to 1e-12", error < 1e-12, f"{error:.1e}")

# === delete_atoms

pair = coefficients("all terms")
one_less = THREE.commands.splitlines()
del one_less[1]
only = last(THREE.setup() + pair + "run 0\ngroup second molecule 2\ndelete_atoms group second bond yes\nrun 0\n")
by_molecule = last(THREE.setup() + pair + "run 0\ngroup second id 50\ndelete_atoms group second mol yes bond yes\nrun 0\n")
alone = {}
for m in (1, 3):
    others = " ".join(str(k) for k in (1, 2, 3) if k != m)
    alone[m] = last(THREE.setup() + pair + f"group others molecule {others}\n"
                    "delete_atoms group others bond yes compress no\nrun 0\n")
rest = {k: alone[1][k] + alone[3][k] for k in alone[1]}
same("delete_atoms of one of three membranes leaves the others", only, rest)
same("delete_atoms mol yes of one point takes its membrane away", by_molecule, rest)

cut = THREE.setup() + pair + "run 0\ngroup hole id 50\ndelete_atoms group hole {}\nrun 0\n"
for ranks in (1, 2):
    error = error_of(cut.format("bond yes"), ranks=ranks)
    claim(f"delete_atoms of one point and its faces: the error names the edge at the hole, {ranks} rank(s)",
          "is a boundary" in error, error)
    error = error_of(cut.format("bond no compress no"), ranks=ranks)
    claim(f"delete_atoms of one point alone: the error names the point, {ranks} rank(s)",
          "Control point 50 is used by a face but is not an atom" in error, error)

# === clear, several runs, changes of pair_coeff

script = THREE.setup() + remembered
rows = thermo(run(script + "clear\n" + PLANE.setup() + coefficients("all terms", closed=False) + "run 0\nclear\n" + script))
same("clear and the same commands again", rows[-1], rows[1])
rows = thermo(run(script + "run 0\nrun 0 pre no\nreset_timestep 5\nrun 0\n"))
for row in rows[2:]:
    same("a run after a run", row, rows[1])

script = CORNER.setup()
pair = {kc: f"pair_coeff 1*2 1*2 {kc} 0.0 area 50.0 5.0\n" for kc in (10.0, 20.0)}
rows = thermo(run(script + pair[10.0] + "run 0\n" + pair[20.0] + "run 0\n" + pair[10.0] + "run 0\n" +
                  "pair_style helfrich quadrature 3\nrun 0\npair_style helfrich quadrature 6\nrun 0\n"))
claim("twice the bending modulus, twice the bending energy",
      abs(rows[1]["c_hf[1]"] / rows[0]["c_hf[1]"] - 2.0) < 1e-14, rows[1]["c_hf[1]"] / rows[0]["c_hf[1]"])
same("the old pair_coeff again", rows[2], rows[0])
claim("a new pair_style command changes the quadrature", 1e-6 < difference(rows[3], rows[0]) < 1e-1,
      difference(rows[3], rows[0]))
same("and back", rows[4], rows[0])

script = CORNER.setup() + "pair_coeff 1*2 1*2 10.0 0.0 area 50.0 init volume 50.0 init\nrun 0\n"
rows = thermo(run(script + "change_box all x scale 1.1 remap\nrun 0\n" +
                  "pair_coeff 1*2 1*2 10.0 0.0 area 50.0 init volume 50.0 init\nrun 0\n"))
claim("init references: none of the energy at first, some after a strain, none after a new pair_coeff",
      max(rows[0]["c_hf[3]"], rows[0]["c_hf[4]"], rows[2]["c_hf[3]"], rows[2]["c_hf[4]"]) < 1e-12 and
      min(rows[1]["c_hf[3]"], rows[1]["c_hf[4]"]) > 1e-3, [row["c_hf[3]"] for row in rows])

finish()
