"""Sites of bound particles from a file: faces by their corners, barycentric coordinates. What write_bound writes
continues a scene elsewhere; every wrong line of a file is told."""
# cost: 8

import math

from lammps_claims import claim, finish, lammps, run, thermo
from membrane_scenes import read_dump

HEAD = """
units           lj
atom_style      membrane_cp
region          box prism 0 10 0 8.66 -4 4 2 0 0
create_box      2 box angle/types 1
create_membrane 1 plane 10 10
set             type 1 mass 1.0
"""
STYLES = """
group           mem type 1
group           p type 2
pair_style      hybrid/overlay helfrich zero 1.0
pair_coeff      1 1 helfrich 20.0 0.0 regularize 10
pair_coeff      * * zero
neighbor        0.3 bin
timestep        0.004
fix             1 mem hd/nve tol 1e-13 measure 1.0
fix             2 p nve
fix             b p hd/bind {words}
compute         s p hd/surface/atom b
compute         T all hd/temp
thermo_style    custom step pe etotal f_b[2] f_b[4] f_b[6]
thermo_modify   norm no format float %.16g temp T
thermo          10
"""
DUMP = """
dump            1 all custom 1000 x.dump id x y z c_s[2] c_s[3] c_s[4] c_s[12]
dump_modify     1 format float %.17g
"""


def sites(*lines):
    with open("sites.txt", "w") as file:
        file.write("# atoms of a test\n\n" + "\n".join(lines) + "\n")


# === Atoms made anywhere are taken to the places that the file names

run(HEAD + """
dump            1 all custom 1 x.dump id x y z
dump_modify     1 format float %.17g
compute         f all property/local aatom1 aatom2 aatom3
dump            2 all local 1 f.dump index c_f[1] c_f[2] c_f[3]
run             0
""")
point = read_dump("x.dump")[-1]
text = open("f.dump").read()
faces = [[int(word) for word in line.split()[1:]] for line in text[text.index("ITEM: ENTRIES"):].split("\n")[1:] if line]
i, j, k = min(faces, key=lambda face: sum(math.dist(point[v], (6.0, 4.3, 0.0)) for v in face))
ATOMS = "".join(f"create_atoms 2 single {1.0 + 1.7 * n} {0.5 + 1.6 * n} {-3.5 + 1.4 * n}\n" for n in range(5)) + "set type 2 mass 2.0\n"
sites(f"101 {i} {j} {k} 0.2 0.3 0.5   # of a fix with leaflet both: out", f"102 {k} {i} {j} 0.5 0.2 0.3 out", f"103 {j} {i} {k} 0.3 0.2 0.5 in",
      f"104 {i} {j} {k} 1 0 0 in -0.45")
places = {}
for ranks in (1, 2, 4):
    run(HEAD + ATOMS + STYLES.format(words="mem max 9 height 0.2 sites sites.txt") + DUMP + "run 0\n", ranks=ranks)
    places[ranks] = read_dump("x.dump")[-1]
here = places[1]
want = [sum(b * point[v][d] for b, v in zip((0.2, 0.3, 0.5), (i, j, k))) for d in range(3)]
off = max(math.dist(here[101][:3], (*want[:2], 0.2)), math.dist(here[102][:3], (*want[:2], 0.2)), math.dist(here[103][:3], (*want[:2], -0.2)),
          math.dist(here[104][:3], (*point[i][:2], -0.45)))
claim("atoms are at the barycentric coordinates of the corners named, in any order, and at the distance", off < 1e-12, f"{off:.1e}")
claim("    of the leaflet that the line says, or else the outer one", [here[n][6] for n in (101, 102, 103, 104)] == [1, 1, -1, -1])
claim("    one that is not in the file is bound to the closest point", math.dist(here[105][:2], (7.8, 6.9)) < 1e-9, here[105][:3])
off = max(math.dist(here[n][:3], places[r][n][:3]) for r in (2, 4) for n in here)
claim("    wherever they were made, on 2 and 4 ranks the same", off < 1e-12, f"{off:.1e}")

# === What write_bound writes, with a data file, goes on elsewhere as here

WHOLE = HEAD + "group mem type 1\ncreate_bound 20 2 mem 4711 leaflet both height 0.3 min 1.0\n" + STYLES.format(
    words="mem hold spring 3000 leaflet both height 0.3 bar 2 0.5 20.0 0.4 5.0 0.0 1.5 rotate 1.0 0.0001 4") + "velocity p create 2.0 99 loop all\n"
text = run(WHOLE + "hd_velocity mem 1.0 12\nrun 100\nwrite_bound b out.sites\nwrite_data c.data nocoeff\nrun 0\nrun 100\n", ranks=2)
rows = thermo(text)
claim("write_bound says how many", "Wrote the sites of 20 atoms to out.sites" in text)
ON = ("units lj\natom_style membrane_cp\nread_data c.data\n" + WHOLE[WHOLE.index("\ngroup           mem"):]).replace("velocity p create 2.0 99 loop all\n", "")
again = thermo(run(ON.replace("rotate", "sites out.sites rotate") + "run 0\n"))
without = thermo(run(ON + "run 0\n"))
zero = [row for row in rows if row["Step"] == 100][0]
off = abs(again[0]["PotEng"] - zero["PotEng"])
claim("with sites from the file the energy is that of before, footprints with their directors included", off < 1e-7 * abs(zero["PotEng"]),
      f"{zero['PotEng']} {again[0]['PotEng']}")
claim("    and without it is not: springs are at rest, directors new", abs(without[0]["PotEng"] - zero["PotEng"]) > 0.1,
      without[0]["PotEng"])
claim("    all are bound, where they were", again[0]["f_b[2]"] == 20 and abs(again[0]["f_b[4]"] - zero["f_b[4]"]) < 1e-9)

# === Wrong files: one line, the thing and the cure


def fails(line, *words, fix="mem max 9 height 0.2 sites sites.txt", after="run 0\n"):
    sites(f"143 {i} {j} {k} 0.2 0.3 0.5", line)    # lines 3 and 4; the sphere's points are 101 to 142
    code, output = lammps(HEAD + "create_membrane 1 sphere 1 1.0 center 5 4 2.5\nset type 1 mass 1.0\n" + ATOMS +
                          "group sheet molecule 1\n" + STYLES.format(words=fix) + after)
    error = next((text for text in output.split("\n") if text.startswith("ERROR")), "no error")
    claim(f"{line}: {' '.join(words)}"[:90], code != 0 and all(word in error for word in words), error[:170])


def wrong(line, *words, **options):
    fails(line, "sites.txt", "line 4", *words, **options)


wrong(f"144 {i} {j} {k} 0.2 0.3", "6 words", "must be")
wrong(f"144 {i} {j} {k} 0.2 0.3 0.6", "sum to 1.1")
wrong(f"144 {i} {j} {k} 0.7 0.8 -0.5", "-0.5 is negative")
wrong(f"144 {i} {j} {k} nan 0.3 0.5", "nan", "not a number")
wrong(f"144 {i} {j} x 0.2 0.3 0.5", "x is not an atom ID")
wrong(f"144 {i} {j} 145 0.2 0.3 0.5", "atom 145 is not a control point")
wrong(f"144 {i} {j} {(k + 49) % 100 + 1} 0.2 0.3 0.5", "not the corners of a face")
wrong(f"144 101 {j} {k} 0.2 0.3 0.5", "101 is not of a membrane of group sheet", fix="sheet sites sites.txt")
wrong(f"7 {i} {j} {k} 0.2 0.3 0.5", "atom 7 is not in the group")
wrong(f"143 {i} {j} {k} 0.2 0.3 0.5", "atom 143 has had its site")
wrong(f"144 {i} {j} {k} 0.2 0.3 0.5 up", "leaflet up", "in or out")
wrong(f"144 {i} {j} {k} 0.2 0.3 0.5 in", "leaflet in is not that of the fix", fix="mem leaflet out sites sites.txt")
wrong(f"144 {i} {j} {k} 0.2 0.3 0.5 out 3.0", "distance 3", "half an edge")
fails(f"144 {i} {j} {k} 0.2 0.3 0.5", "cannot read", "nofile", fix="mem sites nofile")
fails(f"144 {i} {j} {k} 0.2 0.3 0.5 out 0.2 0 0 1", "along the normal", "along the surface",
      fix="mem max 9 height 0.2 sites sites.txt bar 2 0.5 20.0 0.4 5.0 0.0 1.5")
fails(f"144 {i} {j} {k} 0.2 0.3 0.5", "not bound yet", "run 0", after="write_bound b out.sites\n")
fails(f"144 {i} {j} {k} 0.2 0.3 0.5", "no fix hd/bind", "nofix", after="write_bound nofix out.sites\n")
fails(f"144 {i} {j} {k} 0.2 0.3 0.5", "cannot open", after="run 0\nwrite_bound b no/such/folder\n")

finish()
