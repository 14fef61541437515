"""Warnings about the mesh while it moves: a vesicle that crumples goes on for a while, stretched or coarse
meshes are left alone. fix nve on control points is warned of, and so are pair styles that atoms get through."""

from lammps_claims import claim, error_of, finish, run, thermo
from membrane_scenes import TETRAHEDRON, bipyramid, write_off

# === A vesicle only crumples: it may go on for a while

CRUMPLED = """
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
create_box      1 box angle/types 1
create_membrane 1 sphere 2 1.0
pair_style      helfrich
pair_coeff      1 1 10.0 0.0 area 100.0 init volume 100.0 init
fix             1 all hd/langevin 1.0 1.0 10.0 4711 measure no
{modify}
compute         s all membrane/shape
thermo_style    custom step pe c_s[10]
thermo_modify   norm no
timestep        0.001
{runs}
"""
for ranks in (1, 2):
    output = run(CRUMPLED.format(modify="", runs="run 1000"), ranks=ranks)
    lines = [line for line in output.split("\n") if "WARNING" in line and "face" in line and "turned over" in line]
    claim(f"{ranks} rank(s): a vesicle that crumples goes on with a warning", 1 <= len(lines) <= ranks and
          "the run stops after step" in lines[0], lines[:1])
    error = error_of(CRUMPLED.format(modify="fix_modify 1 faces 300", runs="run 1000"), ranks=ranks)
    claim("    and stops as many steps later as fix_modify says",
          "Fix hd/langevin: face " in error and "regularize in pair_coeff" in error, error)
    error = error_of(CRUMPLED.format(modify="fix_modify 1 faces 300", runs="run 103\n" * 10), ranks=ranks)
    claim("    also if it is made of many short runs", "Fix hd/langevin: face " in error, error)
error = error_of(CRUMPLED.format(modify="fix_modify 1 faces -1", runs="run 1"))
claim("fix_modify faces -1", "must not be negative" in error, error)

# === No false alarm: meshes that are stretched, coarse or sharp from the start

STIFF = """
units           lj
atom_style      membrane_cp
region          box block -4 4 -4 4 -4 4
create_box      1 box angle/types 1
create_membrane 1 {shape}
pair_style      helfrich
pair_coeff      1 1 1.0 0.0 area 100.0 init volume 100.0 init
velocity        all create 1e-6 4711
fix             1 all hd/nve
compute         s all membrane/shape
thermo_style    custom step pe c_s[7] c_s[8] c_s[9]
thermo_modify   norm no
timestep        {dt}
run             200
"""
write_off("tetrahedron.off", *TETRAHEDRON)
write_off("bipyramid3.off", *bipyramid(3))
write_off("bipyramid12.off", *bipyramid(12))
for name, shape, dt in (("edge ratio 10", "sphere 2 1.0 scale 4 1 0.4", 1e-4),
                        ("edge ratio 50", "sphere 2 1.0 scale 1 1 0.02", 5e-6),
                        ("faces of 2 degrees", "torus 8 16 1.5 0.3", 1e-4),
                        ("a bare tetrahedron", "file tetrahedron.off", 1e-3),
                        ("valence 3", "file bipyramid3.off", 1e-3),
                        ("valence 12", "file bipyramid12.off refine 1", 1e-4),
                        ("a sharp prolate", "sphere 2 1.0 scale 0.4 0.4 2.0", 1e-5)):
    rows = thermo(run(STIFF.format(shape=shape, dt=dt)))
    claim(f"{name}: runs", len(rows) == 2, f"edges {rows[0]['c_s[7]']:.3g} to {rows[0]['c_s[8]']:.3g}, "
          f"smallest angle {rows[0]['c_s[9]']:.3g}")

# === Integrators of plain atoms

PLAIN = """
units           lj
atom_style      membrane_cp
region          box block -4 4 -4 4 -4 4
create_box      2 box angle/types 1
create_membrane 1 sphere 1 1.0
create_atoms    2 single 3 3 3
group           points type 1
group           others type 2
pair_style      helfrich
pair_coeff      1 1 1.0 0.0
timestep        1e-4
{fixes}
run             10
run             10
"""
WARNING = "moves 42 control points as independent particles"
for fixes, count in (("fix 1 all nve", 1), ("fix 1 points nvt temp 1 1 1", 1),
                     ("fix 1 points hd/nve\nfix 2 others nve", 0), ("fix 1 points move linear 0 0 1", 0),
                     ("fix 1 points rigid single", 0), ("fix 1 points nve/noforce", 0)):
    for ranks in (1, 2):
        output = run(PLAIN.format(fixes=fixes), ranks=ranks)
        lines = [line for line in output.split("\n") if WARNING in line]
        claim(f"{fixes!r}, {ranks} rank(s): {'one warning' if count else 'no warning'} that it ignores the mass matrix",
              len(lines) == count and all("use fix hd/nve" in line for line in lines), lines[:1])
output = run(PLAIN.format(fixes="fix 1 points nve").replace("run             10\n", "") +
             "minimize 0 0 5 10\n")
claim("no warning in a minimization", WARNING not in output)

# === Fixes of single points, which masses couple

COUPLED = """
units           lj
boundary        f f f
atom_style      membrane_cp
region          box block -4 4 -4 4 -4 4
create_box      2 box angle/types 1
create_membrane 1 sphere 2 1.0 mass 0.1
group           some id 1:3
pair_style      helfrich
pair_coeff      1 1 1.0 0.0 regularize 1.0 conformal
timestep        1e-4
{fixes}
run             5
"""
TURNS, TAKES = "turns velocities of single points", "takes forces from some of the points"
for fixes, said in (("fix 1 all hd/nve\nfix w all wall/reflect zhi 0.95", TURNS), ("fix 1 all hd/nve mass lumped\nfix w all wall/reflect zhi 0.95", None),
                    ("fix 1 all hd/nve\nfix w some setforce 0 0 0", TAKES), ("fix 1 all hd/nve\nfix w all setforce NULL NULL 0", None),
                    ("fix 1 all hd/nve mass lumped\nfix w some lineforce 1 0 0", None),
                    ("fix 1 all hd/langevin 0.05 0.05 1 4711 mass consistent\nfix w some planeforce 1 0 0", TAKES)):
    output = run(COUPLED.format(fixes=fixes))
    claim(f"{fixes!r}: {'a warning' if said else 'no warning'}", (TURNS in output, TAKES in output) == (said == TURNS, said == TAKES))
for fixes, words in (("fix 1 all hd/langevin 0.05 0.05 1 4711 mass sampling\nfix w all wall/reflect zhi 0.95", ("mass sampling moves", "wall/harmonic")),
                     ("fix 1 all hd/nve modes sphere min 2 max 3\nfix w all wall/reflect zhi 0.95", ("a mode moves", "wall/harmonic")),
                     ("fix 1 all hd/nve modes sphere min 2 max 3\nfix w all recenter INIT INIT INIT", ("no motion as a whole", "leave it out")),
                     ("pair_style hybrid helfrich helfrich\npair_coeff 1 1 helfrich 1 1.0 0.0\npair_coeff 2 2 helfrich 2 1.0 0.0\n"
                      "pair_coeff 1 2 none\nset group some type 2\nfix 1 all hd/nve", ("several times in hybrid", "use it once"))):
    line = error_of(COUPLED.format(fixes=fixes))
    claim(f"error: {fixes!r}", all(word in line for word in words), line[:150])
output = run(COUPLED.format(fixes="fix w some lineforce 1 1 0\nmin_style membrane\nminimize 0 1e-3 2 10\nfix 1 all hd/nve mass lumped"))
claim("min_style membrane warns of lines and planes", "keeps lines and planes that are parallel to axes" in output)
output = run(COUPLED.format(fixes="fix 1 all hd/nve").replace("run             5", "fix w some setforce 0 0 0\nminimize 0 1e-3 2 10"))
claim("forces taken in a minimization hold points: no warning", TAKES not in output)
FAR = COUPLED.replace("boundary        f f f\n", "").replace("block -4 4 -4 4 -4 4", "block 4996 5004 -4 4 -4 4")
claim("a box far from the origin is a box like others", "Loop time" in run(FAR.format(fixes="fix 1 all hd/nve")))
output = run(COUPLED.format(fixes="fix 1 all hd/nve\nfix w all spring/self 5.0\nhd_timestep all"))
claim("hd_timestep names fixes whose forces it does not know", "(without the forces of fixes: w (spring/self))" in output)

# === Wider than the box

WIDE = """
units           lj
atom_style      membrane_cp
region          box block -2 2 -2 2 -2 2
create_box      1 box angle/types 1
create_membrane 1 {shape}
pair_style      helfrich
pair_coeff      1 1 1.0 0.0
run             0
"""
for ranks in (1, 2):
    output = run(WIDE.format(shape="sphere 3 3.0"), ranks=ranks)
    said = [line for line in output.split("\n") if "overlaps its own images" in line]
    claim(f"{ranks} rank(s): a vesicle wider than the periodic box is warned of in x, y and z",
          len(said) == 3 and "Membrane 1 spans 1.5 of the periodic box in x" in said[0], said[:1])
for shape in ("sphere 3 1.9", "plane 8 8", "cylinder 16 16 1.5 z"):
    claim(f"{shape}: no such warning", "overlaps" not in run(WIDE.format(shape=shape)))

# === Pair styles with other atoms whose range is shorter than an edge

GAPS = """
units           lj
atom_style      membrane_cp
boundary        p p p
region          box block -12 12 -12 12 -12 12
create_box      3 box angle/types 1
create_membrane 1 sphere 2 5.0
create_atoms    2 single 0 0 0
group           others type 2
pair_style      {style}
pair_coeff      1 1 helfrich 20.0 0.0
pair_coeff      2 2 lj/cut 1.0 0.6
pair_coeff      * 3 none
pair_coeff      3 3 zero
{coeff}
{more}
run             0
run             0
"""
OVERLAY = "hybrid/overlay helfrich lj/cut 0.7 zero 1.0"


def gaps(coeff, style=OVERLAY, more="", ranks=1):
    output = run(GAPS.format(style=style, coeff=coeff, more=more), ranks=ranks)
    return [line for line in output.split("\n") if "get through the surface" in line]


for ranks in (1, 2):
    said = gaps("pair_coeff 1 2 lj/cut 1.0 0.6", ranks=ranks)
    claim(f"{ranks} rank(s): a range shorter than an edge is warned of, once",
          len(said) == 1 and "Pair style lj/cut acts between control points of type 1 and atoms of type 2 up to a "
          "distance of 0.7, and edges of the mesh are 1.497 long on average" in said[0] and "up to 1.625:" in said[0], said)
for name, count, scene in (
        ("a range of an edge", 0, {"coeff": "pair_coeff 1 2 lj/cut 1.0 0.6 1.63"}),
        ("no pair style between the two", 0, {"coeff": "pair_coeff 1 2 none"}),
        ("one without force", 0, {"coeff": "pair_coeff 1 2 zero"}),
        ("no atom of the type", 0, {"coeff": "pair_coeff 1 2 none\npair_coeff 1 3 lj/cut 1.0 0.6"}),
        ("solvent of fix srd/mesh", 0,
         {"coeff": "pair_coeff 1 2 lj/cut 1.0 0.6", "more": "fix s others srd/mesh 10 NULL 1.0 1.0 4711 shift yes 9127"}),
        ("of two the longer range counts", 0,
         {"style": OVERLAY + " soft 2.0", "coeff": "pair_coeff 1 2 lj/cut 1.0 0.6\npair_coeff 1 2 soft 1.0"}),
        ("both are named", 1,
         {"style": OVERLAY + " soft 1.5", "coeff": "pair_coeff 1 2 lj/cut 1.0 0.6\npair_coeff 1 2 soft 1.0"})):
    said = gaps(**scene)
    claim(f"{name}: {'a' if count else 'no'} warning", len(said) == count and
          all("lj/cut and soft" in line and "1.5," in line for line in said), said)
said = gaps("pair_coeff 1 2 lj/cut 1.0 0.6", more="change_box all x final -2.6 2.6 y final -2.6 2.6 z final -2.6 2.6 "
            "remap units box")
claim("lengths are those of the run", len(said) == 0, said)
SHEET = GAPS.replace("sphere 2 5.0", "plane 24 24").replace("single 0 0 0", "single 0 0 5")
said = [line for line in run(SHEET.format(style=OVERLAY, coeff="pair_coeff 1 2 lj/cut 1.0 0.6", more="")).split("\n")
        if "get through" in line]
claim("edges of a sheet are those of its mesh also across the box", len(said) == 1 and "up to 1.118:" in said[0], said)

finish()
