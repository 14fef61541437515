"""create_membrane reads the mesh files that people have, says what it did to them, and write_membrane's own."""


import math
import os

from lammps_claims import MPIEXEC, REFERENCE, claim, error_of, finish, run, thermo
from membrane_scenes import bipyramid, read_off, write_off

RANKS = (1, 2) if MPIEXEC else (1,)

BOX = """
units           lj
atom_style      membrane_cp
region          box block {lo} {hi} {lo} {hi} {lo} {hi}
create_box      2 box angle/types 1
"""
MEASURE = """
pair_style      helfrich
pair_coeff      * * 1.0 {c0}
compute         e all pair helfrich
compute         shape all membrane/shape
thermo_style    custom step c_e[1] c_shape[1] c_shape[2] c_shape[6]
thermo_modify   norm no format float %.15g
run             0
"""
POINTS, FACES = read_off(os.path.join(REFERENCE, "icosphere_1.off"))


def measure(commands, c0=0.0, lo=-2, hi=2, **options):
    """Output, and bending energy, area, volume, Euler characteristic."""
    out = run(BOX.format(lo=lo, hi=hi) + commands + MEASURE.format(c0=c0), **options)
    row = thermo(out)[-1]
    return out, [row[f"c_{name}"] for name in ("e[1]", "shape[1]", "shape[2]", "shape[6]")]


def line_of(out, start):
    return next((line for line in out.splitlines() if line.startswith(start)), "")


def worst(a, b):
    return max(abs(x - y) / max(abs(y), 1.0) for x, y in zip(a, b))


REFERENCE_VALUES = measure(f"create_membrane 1 file {REFERENCE}/icosphere_1.off\n")[1]


def same(name, commands, said, tolerance, **options):
    for ranks in RANKS:
        out, values = measure(commands, ranks=ranks, **options)
        claim(f"{name}: the icosphere, {ranks} ranks", worst(values, REFERENCE_VALUES) < tolerance, values)
        line = line_of(out, "Read ")
        claim(f"{name}: it says what it had and did, {ranks} ranks", said in line, line)


# === Vertices that occur twice

with open("soup.obj", "w") as file:    # as VMD writes triangles
    for face in FACES:
        for i in face:
            file.write("v %.6f %.6f %.6f\n" % tuple(POINTS[i]))
        file.write("vn 0 0 1\nf -3//-1 -2//-1 -1//-1\n")
same("a soup of triangles", "create_membrane 1 file soup.obj\n",
     "soup.obj: 240 vertices, 80 faces; 198 vertices joined with others at their place", 1e-5)

double = [i for i in range(42) if POINTS[i][0] > 0]
number = {v: 42 + k for k, v in enumerate(double)}
east = [[number.get(v, v) for v in face] if sum(POINTS[v][0] for v in face) > 1 else face for face in FACES]
write_off("seam.off", POINTS + [POINTS[v] for v in double], east)
same("a seam", "create_membrane 1 file seam.off\n", f"{len(double)} vertices joined", 1e-13)

with open("seam.ply", "w") as file:
    file.write(f"ply\nformat ascii 1.0\nelement vertex {42 + len(double)}\nproperty float x\nproperty float y\n"
               "property float z\nelement face 80\nproperty list uchar int vertex_indices\nend_header\n")
    for p in POINTS + [POINTS[v] for v in double]:
        file.write("%.9g %.9g %.9g\n" % tuple(p))
    for face in east:
        file.write("3 %d %d %d\n" % tuple(face))
same("a seam in PLY", "create_membrane 1 file seam.ply\n", f"{len(double)} vertices joined", 1e-8)

# === The formats of other programs

with open("continued.obj", "w") as file:
    for p in POINTS:
        file.write("v %.17g %.17g \\\n %.17g\n" % tuple(p))
    for a, b, c in FACES:
        file.write(f"f {a + 1}//{a + 1} {b + 1}//{b + 1} \\\r\n {c + 1}//{c + 1}\n")
same("OBJ with lines that go on", "create_membrane 1 file continued.obj\n", "42 vertices, 80 faces", 1e-13)

for name, words in {"bom": "solid endsolid endloop endfacet", "spaced": "solid end_solid end_loop end_facet",
                    "loud": "SOLID ENDSOLID ENDLOOP ENDFACET"}.items():
    solid, endsolid, endloop, endfacet = (word.replace("_", " ") for word in words.split())
    with open(f"{name}.stl", "w") as file:
        file.write(("\ufeff" if name == "bom" else "") + f"{solid} of a can-1\n")
        for face in FACES:
            file.write(" facet normal 0 0 0\n  outer loop\n")
            for i in face:
                file.write("   vertex %.15e %.15e %.15e\n" % tuple(POINTS[i]))
            file.write(f"  {endloop}\n {endfacet}\n")
        file.write(f"{endsolid} of a can-1\n")
    same(f"STL, {name}", f"create_membrane 1 file {name}.stl\n", "198 vertices joined", 1e-13)

with open("headless.off", "w") as file:
    file.write("42 80\n" + "".join("%.17g %.17g %.17g\n" % tuple(p) for p in POINTS) +
               "".join("3 %d %d %d\n" % tuple(f) for f in FACES))
same("OFF without its first word", "create_membrane 1 file headless.off\n", "42 vertices, 80 faces", 1e-13)

rings = [sorted({w for face in FACES if v in face for w in face} - {v}) for v in range(42)]
with open("ball.mesh", "w") as file:
    file.write("3D saved surface\n4.0 0.0 0.0\n0.0 4.0 0.0\n0.0 0.0 4.0\n")
    for v, p in enumerate(POINTS):
        file.write("%d %.17g %.17g %.17g %d %s\n" % (v, *p, len(rings[v]), " ".join(map(str, rings[v]))))
    file.write("ntri 80\n" + "".join("%d %d %d\n" % tuple(f if i % 3 else f[::-1]) for i, f in enumerate(FACES)))
same("the program hd", "create_membrane 1 file ball.mesh\n", "27 faces turned", 1e-13)

with open("ball.tsi", "w") as file:
    file.write("version 1.1\nbox       4.000000       4.000000       4.000000\nvertex 42\n")
    for v, p in enumerate(POINTS):
        file.write("%5d %18.10f %18.10f %18.10f\n" % (v, *(x + 2.0 for x in p)))
    file.write("triangle 80\n" + "".join("%5d %5d %5d %5d\n" % (i, *f) for i, f in enumerate(FACES)))
    file.write("inclusion 1\n    0     1     5     1.0     0.0\n")
same("FreeDTS", "create_membrane 1 file ball.tsi\n", "42 vertices, 80 faces", 1e-8, lo=0, hi=4)
same("FreeDTS, moved", "create_membrane 1 file ball.tsi center -2 -2 -2\n", "42 vertices, 80 faces", 1e-8)

# quads: a cube has the faces of the same cube in triangles

CUBE = [(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
QUADS = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
with open("quads.off", "w") as file:
    file.write("OFF\n8 6 0\n" + "".join("%d %d %d\n" % p for p in CUBE) + "".join("4 %d %d %d %d\n" % q for q in QUADS))
out, values = measure("create_membrane 1 file quads.off\n", lo=-3, hi=3)
claim("quads are cut into triangles", "8 vertices, 6 faces; 6 polygons cut into triangles" in out and
      "Created membrane 1: 8 control points, 12 faces" in out and values[3] == 2, line_of(out, "Read"))

# === Orientation

write_off("mixed.off", POINTS, [f[::-1] if i % 4 == 1 else f for i, f in enumerate(FACES)])
same("faces in mixed orientation", "create_membrane 1 file mixed.off\n", "20 faces turned", 1e-13)
write_off("inward.off", POINTS, [f[::-1] for f in FACES])
WARNING = "WARNING: create_membrane inward.off: the membrane is inside out"
for ranks in RANKS:
    out, values = measure("create_membrane 1 file inward.off\n", c0=2.0, ranks=ranks)
    claim(f"inside out: a warning with the cure, {ranks} ranks",
          out.count(WARNING) == 1 and "flip yes turns the faces" in line_of(out, "WARNING: create"),
          line_of(out, "WARNING: create"))
    claim(f"and the file is taken at its word, {ranks} ranks", abs(values[2] + REFERENCE_VALUES[2]) < 1e-12, values)
    out, values = measure("create_membrane 1 file inward.off flip yes\n", ranks=ranks)
    claim(f"flip yes turns it, without a warning, {ranks} ranks",
          worst(values, REFERENCE_VALUES) < 1e-13 and "inside out" not in out and "Turned 80 of 80 faces" in out, values)
out, values = measure(f"create_membrane 1 file {REFERENCE}/icosphere_1.off flip yes\n")
claim("flip yes leaves what is outward", worst(values, REFERENCE_VALUES) == 0.0 and "Turned 0 of 80 faces" in out, values)
out = run(BOX.format(lo=-2, hi=2) + "create_membrane 1 plane 12 14 flip yes\nwrite_membrane p.off subdivide 0\n")
points, faces = read_off("p.off")
a, b, c = (points[i] for i in faces[40])
claim("flip yes reverses the normal of a plane",
      (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) < 0 and "Turned 336 of 336" in out)
out, _ = measure("create_membrane 1 file soup.obj\n")
claim("no warning of what is outward", "inside out" not in out)

# === Several surfaces in one file

def beside(points, x):
    return [(p[0] + x, p[1], p[2]) for p in points]


TETRA = ([(0.5, 0.5, 0.5), (0.5, -0.5, -0.5), (-0.5, 0.5, -0.5), (-0.5, -0.5, 0.5)],
         [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)])
pyramid = bipyramid(6)
three = (beside(TETRA[0], -1.4) + beside(pyramid[0], 0.2) + beside(TETRA[0], 1.45))
cells = TETRA[1] + [[v + 4 for v in f] for f in pyramid[1]] + [[v + 12 for v in f[::-1]] for f in TETRA[1]]
write_off("three.off", three, cells)
DUMP = "write_dump all custom m.dump id mol modify sort id\n"
for ranks in RANKS:
    for words, expected, said in (("", [5] * 4 + [6] * 8 + [7] * 4, "membranes 5 to 7"),
                                  (" molecule 9", [9] * 16, "membrane 9")):
        out = run(BOX.format(lo=-2, hi=2) + "create_membrane 2 sphere 0 0.1 center 0 0 1.8 molecule 4\n"
                  f"create_membrane 1 file three.off{words}\n" + DUMP, ranks=ranks)
        got = [int(line.split()[1]) for line in open("m.dump").read().split("\n")[9:] if line][12:]
        claim(f"three surfaces{words}: molecule IDs, {ranks} ranks", got == expected, got)
        claim(f"three surfaces{words}: it says so, {ranks} ranks", f"Created {said}: 16 control points, 20 faces" in out)
        claim(f"the third is inside out, {ranks} ranks",
              "1 of its 3 surfaces, the first of them number 3, is inside out" in out, line_of(out, "WARNING"))

pyramid = ([[round(x, 6) for x in p] for p in pyramid[0]], pyramid[1])
touching = beside(pyramid[0], -1.0) + beside(pyramid[0], 1.0)    # in the origin
write_off("touching.off", touching, pyramid[1] + [[v + 8 for v in f] for f in pyramid[1]])
with open("touching.stl", "w") as file:
    file.write("solid\n")
    for face in pyramid[1] + [[v + 8 for v in f] for f in pyramid[1]]:
        file.write("facet normal 0 0 0\nouter loop\n" + "".join("vertex %.9g %.9g %.9g\n" % touching[v] for v in face) +
                   "endloop\nendfacet\n")
    file.write("endsolid\n")
for end in ("off", "stl"):
    out = run(BOX.format(lo=-3, hi=3) + f"create_membrane 1 file touching.{end}\n")
    claim(f"two membranes that touch stay two, {end}", "Created membranes 1 to 2: 16 control points, 24 faces" in out and
          ("1 vertex doubled where surfaces touch" in out) == (end == "stl"), line_of(out, "Read"))

# === There and back

START = {"a sphere": "create_membrane 1 sphere 2 1.0\n",
         "a sphere across the sides": "create_membrane 1 sphere 2 1.0 center 1.7 1.9 0.0\n",
         "a plane": "create_membrane 1 plane 12 14\ndisplace_atoms all random 0.05 0.05 0.1 4711 units box\n"}
for name, start in START.items():
    for end, back in (("vtp", ""), ("tsi", " center -2 -2 -2")):
        before = measure(start + f"write_membrane a.{end} subdivide 0\n")[1]
        for ranks in RANKS:
            out, after = measure(f"create_membrane 1 file a.{end}{back}\n", ranks=ranks)
            claim(f"{name} in {end} makes the same membrane again, {ranks} ranks", worst(after, before) < 1e-12,
                  (after, line_of(out, "Read")))
            claim(f"{name} in {end}: nothing had to be turned, {ranks} ranks", "turned" not in out)
error = error_of(BOX.format(lo=-3, hi=3) + "create_membrane 1 file a.tsi\n")
claim("a plane in another box than that of its file", "a.tsi: the mesh continues through the sides of its periodic "
      "box in x, which is 4 long, and the simulation box is 6 there; make a simulation box of that length" in error, error)
out, after = measure("create_membrane 1 file a.tsi scale 2 2 2 center -4 -4 -4\n", lo=-4, hi=4)
claim("scaled with its file it fits again", abs(after[0] - before[0]) < 1e-12 and abs(after[1] / before[1] - 4) < 1e-12, after)

# === What TSI tells of vertices

PARTICLES = BOX.format(lo=-2, hi=2) + """create_membrane 1 sphere 2 1.0
group points molecule 1
create_bound 9 2 points 4711
group bound subtract all points
set group bound mass 1.0
region upper block INF INF INF INF 0 INF
group upper region upper
group top intersect points upper
set group top type 2
fix b bound hd/bind points
"""
for ranks in RANKS:
    run(PARTICLES + "write_membrane b.tsi subdivide 2 inclusions b 3 domains yes\nwrite_dump bound custom b.dump x y z modify sort id\n", ranks=ranks)
    words = open("b.tsi").read().split("\n")
    first = next(i for i, line in enumerate(words) if line.startswith("vertex")) + 1
    number = int(words[first - 1].split()[1])
    vertices = [[float(w) for w in line.split()] for line in words[first:first + number]]
    first = next(i for i, line in enumerate(words) if line.startswith("inclusion")) + 1
    inclusions = [line.split() for line in words[first:] if line]
    atoms = [[float(w) + 2 for w in line.split()] for line in open("b.dump").read().split("ATOMS x y z")[1].strip().split("\n")]
    far = max(math.dist(vertices[int(row[2])][1:4], x) for row, x in zip(inclusions, atoms))
    claim(f"bound particles are inclusions of vertices near them, {ranks} ranks",
          len(inclusions) == 9 and far < 0.12 and len({row[2] for row in inclusions}) == 9 and {row[1] for row in inclusions} == {"3"}, far)
    wrong = [v for v in vertices if abs(v[3] - 2) > 0.3 and v[4] != (v[3] > 2)]
    claim(f"    and domains are the types of control points, {ranks} ranks", not wrong, wrong[:3])
_, after = measure("create_membrane 1 file b.tsi center -2 -2 -2\n")
claim("    and the file is read again", after[0] > 0, after)
BACK = BOX.format(lo=-2, hi=2) + """create_membrane 1 file b.tsi center -2 -2 -2 interpolate yes
group points molecule 1
create_bound all 2 points 4711 inclusions b.tsi 3 {}
group bound subtract all points
set group bound mass 1.0
"""
for ranks in RANKS:
    run(BACK.format("center -2 -2 -2") + "write_dump bound custom back.dump x y z modify sort id\n", ranks=ranks)
    back = [[float(w) for w in line.split()] for line in open("back.dump").read().split("ATOMS x y z")[1].strip().split("\n")]
    far = max(math.dist([w - 2 for w in vertices[int(row[2])][1:4]], x) for row, x in zip(inclusions, back))
    claim(f"create_bound places atoms at the inclusions of the file, {ranks} ranks", len(back) == 9 and far < 0.001, far)
for words, expected in (("", "off the membrane, more than an edge: give center and scale"),
                        ("center -2 -2 -2 min 1", "min is for places at random"),
                        ("center -2 -2", "Illegal create_bound center command"),
                        ("scale 0", "scale 0 must be positive")):
    error = error_of(BACK.format(words))
    claim(f"create_bound inclusions {words}: one clear line", expected in error, error)
for words, expected in (("all 2 points 4711", "create_bound all: atoms at random are a number"),
                        ("5 2 points 4711 inclusions b.tsi 3", "create_bound 5: atoms at random are a number"),
                        ("all 2 points 4711 inclusions b.tsi 4", "has no inclusions of type 4, but of 3"),
                        ("all 2 points 4711 inclusions a.vtp 4", "only files of FreeDTS and TS2CG"),
                        ("all 2 points 4711 inclusions none.tsi 4", "cannot be opened"),
                        ("5 2 points 4711 scale 2", "center and scale are those of a file")):
    error = error_of(PARTICLES.replace("create_bound 9 2 points 4711", "create_bound " + words))
    claim(f"create_bound {words}: one clear line", expected in error, error)
for end, words in (("b.off inclusions b 1", "only a file in TSI format"), ("b.tsi inclusions none 1", "none"),
                   ("b.tsi inclusions b -1", "must not be negative")):
    error = error_of(PARTICLES + f"write_membrane {end}\n")
    claim(f"write_membrane {end}: one clear line", words in error, error)

# === Wrong input

error = error_of(BOX.format(lo=-2, hi=2) + "create_membrane 1 sphere 2 1.0\nwrite_membrane a.tsi fields yes\n")
claim("TSI has no fields", "a file in TSI format has no place for fields" in error, error)
error = error_of("units lj\natom_style membrane_cp\nregion box prism -2 2 -2 2 -2 2 1 0 0\ncreate_box 1 box angle/types 1\n"
                 "create_membrane 1 sphere 1 1.0\nwrite_membrane a.tsi\n")
claim("TSI has no tilted box", "right angles" in error and "write another format" in error, error)
write_off("hole.off", POINTS, FACES[1:])
with open("medit.mesh", "w") as file:
    file.write("MeshVersionFormatted 2\nDimension 3\n")
with open("appended.vtp", "w") as file:
    file.write('<VTKFile type="PolyData"><PolyData><Piece><Points><DataArray type="Float32" format="appended"/>')
for name, words in {"hole.off": ("is a boundary, one of 3 such edges", "close the holes"),
                    "medit.mesh": ("3D saved surface", "export other meshes as OFF or PLY"),
                    "appended.vtp": ("in the format 'appended'", "Data Mode Ascii")}.items():
    for ranks in RANKS:
        error = error_of(BOX.format(lo=-2, hi=2) + f"create_membrane 1 file {name}\n", ranks=ranks)
        claim(f"{name}: one clear line, {ranks} ranks", all(word in error for word in words), error)
error = error_of(BOX.format(lo=-2, hi=2) + "create_membrane 1 sphere 1 1.0 flip perhaps\n")
claim("flip takes yes or no", "perhaps" in error, error)

finish()
