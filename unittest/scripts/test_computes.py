"""compute membrane/shape and compute membrane/curvature/atom measure the limit surface."""
# cost: 20

import math
import os

from lammps_claims import REFERENCE, claim, error_of, finish, run, thermo
from membrane_scenes import SCENES, TETRAHEDRON, bipyramid, largest, read_dump, write_off

COLUMNS = ("area", "volume", "v", "mean", "willmore", "euler", "shortest", "longest", "angle",
           "fold", "x", "y", "z", "gyration")
H, K, POSITION, NORMAL = 0, 1, slice(2, 5), slice(5, 8)    # columns of the per-atom compute
PI = math.pi


def script(commands, box="block -3 3 -3 3 -3 3", before="", compute="", rows=0, after="run 0"):
    """One run that prints the global vector as c_s[*] and, for `rows` membranes, the array; and
    dumps id, x, y, z, and all per-atom values."""
    array = "".join(f" c_s[{i}][{j}]" for i in range(1, rows + 1) for j in range(1, len(COLUMNS) + 1))
    return f"""
units           lj
atom_style      membrane_cp
{before}
region          box {box}
create_box      2 box angle/types 1
{commands}
compute         s all membrane/shape {compute}
compute         k all membrane/curvature/atom
thermo_style    custom step c_s[*]{array}
thermo_modify   format float %24.17g
dump            atoms all custom 1000000 atoms.dump id x y z c_k[*]
dump_modify     atoms sort id format float %24.17g
{after}
"""


def vector(row):
    return {name: row[f"c_s[{j}]"] for j, name in enumerate(COLUMNS, 1)}


def member(row, i):
    return {name: row[f"c_s[{i}][{j}]"] for j, name in enumerate(COLUMNS, 1)}


def shape(commands, ranks=1, **options):
    return vector(thermo(run(script(commands, **options), ranks=ranks))[-1])


def atoms():
    """Of the last frame that was dumped: x, y, z and the per-atom values, by atom ID."""
    frame = read_dump("atoms.dump")[-1]
    return {i: row[:3] for i, row in frame.items()}, {i: row[3:] for i, row in frame.items()}


def off(by):
    return f"{by:.1e}"


def close(text, value, exact, tolerance):
    error = value / exact - 1.0 if exact else value
    claim(text, abs(error) <= tolerance, f"{value:.10g} against {exact:.10g}: {off(error)}")


def order(errors):
    """Order of convergence from the errors of meshes that halve the edge."""
    return math.log2(abs(errors[0] / errors[1]))


def subtract(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def norm(a):
    return math.sqrt(dot(a, a))


def angle(a, b):
    return math.degrees(math.atan2(norm(cross(a, b)), dot(a, b)))


def read_off(path):
    with open(path) as file:
        words = [word for line in file for word in line.split("#")[0].split()]
    npoints, nfaces = int(words[1]), int(words[2])
    numbers = words[4:]
    points = [tuple(map(float, numbers[3 * i:3 * i + 3])) for i in range(npoints)]
    faces = [tuple(map(int, numbers[3 * npoints + 4 * i + 1:3 * npoints + 4 * i + 4]))
             for i in range(nfaces)]
    return points, faces


# === Integrals, against independent values, all digits shown: area, volume, the integral of
# (1/2)(2H)^2, c0, the integral of (1/2)(2H - c0)^2, Euler characteristic

EXACT = {
    "icosphere_1": (10.48116254, 3.189728044, 25.25117293, 1, 7.536243034, 2),
    "icosphere_2": (12.00468707, 3.910857721, 25.18922129, 1, 6.626411535, 2),
    "octasphere_2": (11.150311, 3.494691309, 25.53033217, 1, 7.415845501, 2),
    "torus_24x12": (13.03023509, 2.168826136, 62.44326346, 2, 10.2207469, 0),
    "bumpy_icosphere_2": (12.59008037, 4.002431217, 29.36923906, 1, 10.08007744, 2),
}
for name, (area, volume, willmore, c0, spontaneous, euler) in EXACT.items():
    file = os.path.join(REFERENCE, name + ".off")
    got = shape(f"create_membrane 1 file {file}", compute="quadrature careful")
    mean = (willmore + 0.5 * c0 * c0 * area - spontaneous) / (2.0 * c0)
    close(f"{name}: area", got["area"], area, 1e-8)
    close(f"{name}: volume", got["volume"], volume, 1e-8)
    close(f"{name}: integral of H", got["mean"], mean, 1e-8)
    close(f"{name}: integral of (1/2)(2H)^2", got["willmore"], willmore, 1e-7)
    close(f"{name}: reduced volume", got["v"], volume / (4 * PI / 3 * (area / 4 / PI) ** 1.5), 1e-8)
    claim(f"{name}: Euler characteristic", got["euler"] == euler, got["euler"])
    default = shape(f"create_membrane 1 file {file}")
    worst = max(abs(default[key] / got[key] - 1) for key in ("area", "volume", "mean", "willmore"))
    claim(f"{name}: the default quadrature is within 1e-4 of careful", worst < 1e-4, off(worst))

# === Torus, R = 1.5, r = 0.5: integrals and curvatures converge

R, r = 1.5, 0.5
errors = {key: [] for key in ("area", "volume", "mean", "willmore", "gyration", "H", "K", "normal")}
for nu, nv in ((24, 16), (48, 32), (96, 64)):
    got = shape(f"create_membrane 1 torus {nu} {nv} {R} {r} interpolate yes", compute="quadrature 12")
    exact = {"area": 4 * PI**2 * R * r, "volume": 2 * PI**2 * R * r * r, "mean": 2 * PI**2 * R,
             "gyration": math.sqrt(R * R + 2 * r * r),
             "willmore": 2 * PI**2 * (R / r)**2 / math.sqrt((R / r)**2 - 1)}
    for key, value in exact.items():
        errors[key].append(got[key] / value - 1)
    worst, on = {"H": 0.0, "K": 0.0, "normal": 0.0}, 0.0
    for row in atoms()[1].values():
        x, y, z = row[POSITION]
        rho = math.hypot(x, y)
        on = max(on, abs(math.hypot(rho - R, z) - r))
        cosine = (rho - R) / r
        normal = (x / rho * cosine, y / rho * cosine, z / r)
        worst["H"] = max(worst["H"], abs(row[H] - 0.5 * (1 / r + cosine / rho)))
        worst["K"] = max(worst["K"], abs(row[K] - cosine / (r * rho)))
        worst["normal"] = max(worst["normal"], norm(subtract(row[NORMAL], normal)))
    for key, value in worst.items():
        errors[key].append(value)
    claim(f"torus {nu}x{nv}: limit positions are the interpolated points", on < 1e-11, off(on))
    claim(f"torus {nu}x{nv}: Euler characteristic 0", got["euler"] == 0)
for key, least in (("area", 3.7), ("volume", 3.7), ("mean", 3.7), ("willmore", 3.7), ("gyration", 3.7),
                   ("H", 1.8), ("K", 1.8), ("normal", 3.7)):
    values = errors[key]
    measured = f"{' '.join(map(off, values))}, order {order(values[-2:]):.2f}"
    claim(f"torus: {key} converges with order {least} or better", order(values[-2:]) > least, measured)
claim("torus 96x64: H is within 0.1 % of 1/r and K within 0.1 % of 1/r^2",
      errors["H"][-1] < 0.002 and errors["K"][-1] < 0.004)

# === Sphere: all the same by symmetry

got = shape("create_membrane 1 sphere 3 1.3 interpolate yes center 0.1 -0.2 0.3",
            compute="quadrature careful")
close("sphere: area", got["area"], 4 * PI * 1.69, 1e-4)
close("sphere: volume", got["volume"], 4 * PI / 3 * 1.3**3, 1e-4)
close("sphere: integral of H", got["mean"], 4 * PI * 1.3, 1e-3)
close("sphere: Willmore energy", got["willmore"], 8 * PI * 1.005338, 1e-6)
close("sphere: reduced volume", got["v"], 1.0, 1e-4)
close("sphere: radius of gyration", got["gyration"], 1.3, 1e-4)
claim("sphere: centre", norm(subtract((got["x"], got["y"], got["z"]), (0.1, -0.2, 0.3))) < 1e-13)
run(script("""
create_membrane 1 sphere 2 1.0
pair_style      helfrich
pair_coeff      1 1 1.0 0.0
""", after="minimize 1e-12 1e-10 2000 5000"))
values = atoms()[1]
radius = sum(norm(row[POSITION]) for row in values.values()) / len(values)
worst = max(abs(row[H] * radius - 1) for row in values.values())
claim("relaxed sphere: H is 1/R within 5 % also at points of valence 5", worst < 0.05, f"{worst:.4f}")
worst = max(norm(subtract(row[NORMAL], [p / norm(row[POSITION]) for p in row[POSITION]]))
            for row in values.values())
claim("relaxed sphere: normals are radial", worst < 2e-3, off(worst))

# === Subdividing the control mesh does not change the limit surface

write_off("tetrahedron.off", *TETRAHEDRON)
MESHES = {"bumpy_icosphere_2": os.path.join(REFERENCE, "bumpy_icosphere_2.off"),
          "octasphere_2": os.path.join(REFERENCE, "octasphere_2.off"),
          "tetrahedron": "tetrahedron.off"}
for n in (3, 5, 8, 16):
    MESHES[f"bipyramid {n}"] = f"bipyramid{n}.off"
    write_off(MESHES[f"bipyramid {n}"], *bipyramid(n))
for name, path in MESHES.items():
    valence = {}
    for face in read_off(path)[1]:
        for v in face:
            valence[v + 1] = valence.get(v + 1, 0) + 1
    got = [shape(f"create_membrane 1 file {path}", compute="quadrature careful")]
    values = [atoms()[1]]
    got.append(shape(f"create_membrane 1 file {path} refine 1", compute="quadrature careful"))
    values.append(atoms()[1])
    for key in ("area", "volume", "mean", "willmore"):
        close(f"{name}: {key} is that of the refined mesh", got[0][key], got[1][key], 1e-6)
    worst = max(largest(subtract(values[0][i][2:8], values[1][i][2:8])) for i in valence)
    claim(f"{name}: limit positions and normals are those of the refined mesh", worst < 1e-12, off(worst))
    regular = [i for i in valence if valence[i] == 6]
    if regular:
        worst = max(largest(subtract(values[0][i][:2], values[1][i][:2])) for i in regular)
        claim(f"{name}: so are H and K where the valence is 6", worst < 1e-10, off(worst))
    lengths = largest(norm(row[NORMAL]) - 1 for row in values[0].values())
    claim(f"{name}: normals have length 1", lengths < 1e-14, off(lengths))
    outward = min(dot(row[NORMAL], row[POSITION]) for row in values[0].values())
    claim(f"{name}: normals point outward", outward > 0, f"{outward:.3f}")

# === Gauss-Bonnet, and the energy of pair style helfrich

gauss = script("""
create_membrane 1 sphere 1 0.7 center -1.5 0 0
create_membrane 1 torus 12 8 0.8 0.3 center 1.5 0 0
create_membrane 1 file bipyramid8.off center 0 0 2
pair_style      helfrich quadrature careful
pair_coeff      1 1 1.0 0.0 kg 1.0
compute         hf all pair helfrich
""", compute="quadrature careful").replace("custom step", "custom step c_hf[*]")
row = thermo(run(gauss + "thermo_modify norm no\nrun 0"))[-1]
close("the integral of K is 2 pi times the Euler characteristic", row["c_hf[2]"],
      2 * PI * row["c_s[6]"], 1e-9)
close("column 5 is the bending energy of pair helfrich for kc = 1", row["c_s[5]"], row["c_hf[1]"], 1e-13)
close("column 1 is its area", row["c_s[1]"], row["c_hf[5]"], 1e-14)
close("column 2 is its volume", row["c_s[2]"], row["c_hf[6]"], 1e-14)

# === The control mesh: edges, angles, folds

points, faces = read_off(MESHES["bumpy_icosphere_2"])
edges, angles, folds, apex = [], [], [], {}
for face in faces:
    for k in range(3):
        a, b, c = (points[face[(k + j) % 3]] for j in range(3))
        edges.append(norm(subtract(b, a)))
        angles.append(angle(subtract(b, a), subtract(c, a)))
        apex[face[k], face[(k + 1) % 3]] = cross(subtract(b, a), subtract(c, a))
folds = [angle(n, apex[b, a]) for (a, b), n in apex.items()]
got = shape(f"create_membrane 1 file {MESHES['bumpy_icosphere_2']}", ranks=2)
for key, value in (("shortest", min(edges)), ("longest", max(edges)), ("angle", min(angles)),
                   ("fold", max(folds))):
    close(f"bumpy_icosphere_2: {key} is that of the mesh", got[key], value, 1e-12)
got = shape("create_membrane 1 file tetrahedron.off")
close("tetrahedron: its edges", got["shortest"], math.sqrt(8), 1e-14)
close("tetrahedron: its angles", got["angle"], 60, 1e-14)
close("tetrahedron: its folds", got["fold"], 180 - math.degrees(math.acos(1 / 3)), 1e-14)

# === Periodic membranes

got = shape("create_membrane 1 plane 12 14", box="block -3 3 -2.5 2.5 -1 2", ranks=2)
close("plane: area is that of the box", got["area"], 30, 1e-14)
claim("plane: no volume, reduced volume or curvature",
      got["volume"] == 0 and got["v"] == 0 and largest((got["mean"], got["willmore"])) < 1e-12)
claim("plane: Euler characteristic 0, no radius of gyration", got["euler"] == 0 and got["gyration"] == 0)
close("plane: height of the centre", got["z"], 0.5, 1e-13)
x, values = atoms()
worst = max(largest(subtract(values[i][POSITION], x[i])) for i in x)
claim("plane: limit positions are the control points", worst < 1e-14, off(worst))
worst = max(largest(row[:2]) + norm(subtract(row[NORMAL], (0, 0, 1))) for row in values.values())
claim("plane: H = K = 0 and the normal is z", worst < 1e-12, off(worst))

got = shape("create_membrane 1 cylinder 40 30 1.2 z interpolate yes", ranks=2)
close("cylinder: area", got["area"], 2 * PI * 1.2 * 6, 1e-4)
close("cylinder: integral of H", got["mean"], 6 * PI, 1e-4)
claim("cylinder: no volume", got["volume"] == 0)
values = atoms()[1].values()
worst = max(max(abs(row[H] * 2.4 - 1), abs(row[K]) * 1.44) for row in values)
claim("cylinder: H is 1/2R and K is 0 within 0.5 %", worst < 5e-3, off(worst))

# === Images of a periodic box

for box in ("block -2 2 -2 2 -2 2", "prism -2 2 -2 2 -2 2 0.7 -0.5 0.9"):
    name = f"{box.split()[0]} box"
    middle = shape("create_membrane 1 sphere 2 1.2 center 0 0 0", box=box)
    values = atoms()[1]
    for ranks in (1, 2):
        corner = shape("create_membrane 1 sphere 2 1.2 center 2 2 2", box=box, ranks=ranks)
        worst = max(abs(corner[key] - middle[key]) for key in COLUMNS[:10])
        claim(f"{name}, {ranks} ranks: a sphere across the corner is one in the middle", worst < 1e-11,
              off(worst))
        worst = abs(corner["gyration"] / middle["gyration"] - 1)
        claim(f"{name}, {ranks} ranks: so is its radius of gyration", worst < 1e-13, off(worst))
        worst = norm(subtract((corner["x"], corner["y"], corner["z"]), (2, 2, 2)))
        claim(f"{name}, {ranks} ranks: its centre is where it was put", worst < 1e-13, off(worst))
        x, there = atoms()
        worst = max(largest(subtract(there[i][:2] + there[i][NORMAL], values[i][:2] + values[i][NORMAL]))
                    for i in x)
        claim(f"{name}, {ranks} ranks: so are H, K and normals", worst < 1e-11, off(worst))
        far = max(norm(subtract(there[i][POSITION], x[i])) for i in x)
        claim(f"{name}, {ranks} ranks: limit positions are near their control points", far < 0.1,
              f"{far:.3f}")

wide = shape("create_membrane 1 sphere 0 1.0")
values = atoms()[1]
tight = shape("create_membrane 1 sphere 0 1.0 center 0.4 0.5 0.6", box="block -1.2 1.2 -1.2 1.2 -1.2 1.2",
              ranks=2)
there = atoms()[1]
worst = max(max(abs(tight[key] - wide[key]) for key in COLUMNS[:10]),
            max(largest(subtract(there[i][:2] + there[i][NORMAL], values[i][:2] + values[i][NORMAL]))
                for i in values))
claim("an icosahedron whose patches span more than half the box is one in a large box", worst < 1e-12,
      off(worst))

moved = thermo(run(script("""
create_membrane 1 sphere 1 1.0
velocity        all set 2.0 -1.0 0.5
fix             1 all nve
timestep        0.01
thermo          100
""", after="run 500"), ranks=2))
worst = max(norm(subtract([row[f"c_s[{j}]"] for j in (11, 12, 13)],
                          [t * row["Step"] * 0.01 for t in (2.0, -1.0, 0.5)])) for row in moved)
claim("the centre follows a membrane around the box", worst < 1e-11 and len(moved) == 6, off(worst))
worst = max(abs(row[f"c_s[{j}]"] - moved[0][f"c_s[{j}]"]) for row in moved for j in range(1, 11))
claim("and nothing else changes", worst < 1e-11, off(worst))

# === Several membranes; groups

SEVERAL = """
create_membrane 1 sphere 1 0.7 center -2 0 0
create_membrane 2 torus 12 8 0.8 0.3 center 1.5 0 0
create_membrane 1 sphere 2 0.5 center 0 0 2 molecule 7
create_membrane 1 sphere 1 0.6 center 0 0 -2 molecule 7
"""
row = thermo(run(script(SEVERAL, rows=3), ranks=2))[-1]
total, rows = vector(row), [member(row, i) for i in (1, 2, 3)]
alone = [shape(line) for line in SEVERAL.strip().splitlines()]
for i in (0, 1):
    worst = max(abs(rows[i][key] - alone[i][key]) for key in COLUMNS)
    claim(f"several membranes: row {i + 1} is the membrane by itself", worst < 1e-12, off(worst))
both = {key: alone[2][key] + alone[3][key] for key in ("area", "volume", "mean", "willmore", "euler")}
worst = max(abs(rows[2][key] - both[key]) for key in both)
claim("several membranes: two surfaces of one molecule are one membrane", worst < 1e-12, off(worst))
claim("several membranes: quality is that of the worst element",
      rows[2]["shortest"] == min(alone[2]["shortest"], alone[3]["shortest"]) and
      rows[2]["fold"] == max(alone[2]["fold"], alone[3]["fold"]))
worst = max(abs(total[key] - sum(row[key] for row in rows)) for key in both)
claim("several membranes: the vector is their sum", worst < 1e-12, off(worst))
claim("several membranes: and has the mean reduced volume",
      abs(total["v"] - sum(row["v"] for row in rows) / 3) < 1e-14, total["v"])
claim("several membranes: and the worst quality",
      total["shortest"] == min(row["shortest"] for row in rows) and
      total["longest"] == max(row["longest"] for row in rows) and
      total["angle"] == min(row["angle"] for row in rows) and
      total["fold"] == max(row["fold"] for row in rows))
centre = [sum(row["area"] * row[k] for row in rows) / total["area"] for k in "xyz"]
claim("several membranes: and the centre of all area", abs(total["x"] - centre[0]) < 1e-13, total["x"])


def about(centre, parts):
    """Radius of gyration of parts together, about a centre."""
    inertia = sum(part["area"] * (part["gyration"]**2 + sum((part[k] - centre[i])**2 for i, k in enumerate("xyz")))
                  for part in parts)
    return math.sqrt(inertia / sum(part["area"] for part in parts))


close("several membranes: and its radius of gyration", total["gyration"], about(centre, alone), 1e-13)
close("several membranes: two surfaces of one molecule have one radius of gyration", rows[2]["gyration"],
      about([rows[2][k] for k in "xyz"], alone[2:]), 1e-13)

GROUPED = """
compute         t {0} membrane/shape
compute         kt {0} membrane/curvature/atom
dump            grouped all custom 1 grouped.dump id mol c_kt[*] c_k[*]
dump_modify     grouped sort id format float %24.17g
thermo_style    custom step c_t[1]{1}
thermo_modify   format float %24.17g
run             0
"""
MORE = SEVERAL + """
create_atoms    2 single 2.5 2.5 2.5
group           torus molecule 2
group           none empty
"""
output = run(script(MORE, after=GROUPED.format("none", "")))
claim("an empty group is warned of and has area 0", "group none has no membrane" in output and
      thermo(output)[-1]["c_t[1]"] == 0)
row = thermo(run(script(MORE, after=GROUPED.format("torus", " c_t[1][1]")), ranks=2))[-1]
claim("a group selects membranes", abs(row["c_t[1][1]"] - alone[1]["area"]) < 1e-12 and
      row["c_t[1]"] == row["c_t[1][1]"])
frame = read_dump("grouped.dump")[-1].values()
claim("per-atom values are 0 outside the group",
      all(largest(row[1:9]) == 0 for row in frame if row[0] != 2))
claim("and those of all inside", all(row[1:9] == row[9:] for row in frame if row[0] == 2))
other = [row[9:] for row in frame if row[0] == 0]
claim("an atom that is not a control point has 0", len(other) == 1 and largest(other[0]) == 0)

# === Rows come and go between runs

rows = thermo(run(script("create_membrane 1 sphere 1 1.0", after="""
run             0
replicate       2 1 1
thermo_style    custom step c_s[*] c_s[2][1] c_s[2][2]
thermo_modify   format float %24.17g
run             0
group           first molecule 1
delete_atoms    group first bond no
thermo_style    custom step c_s[*] c_s[1][1]
thermo_modify   format float %24.17g
run             0
variable        area equal c_s[1][1]
variable        H atom c_k[1]
print           "between runs $(v_area:%.15g)"
""")))
claim("replicate adds a row", rows[1]["c_s[1]"] == 2 * rows[1]["c_s[2][1]"] and
      abs(rows[1]["c_s[2][1]"] - rows[0]["c_s[1]"]) < 1e-13, rows[1]["c_s[1]"])
claim("delete_atoms takes it away", rows[2]["c_s[1]"] == rows[2]["c_s[1][1]"] and
      abs(rows[2]["c_s[1]"] - rows[0]["c_s[1]"]) < 1e-13, rows[2]["c_s[1]"])

run(script(SEVERAL, after="""
fix             1 all nve
velocity        all create 1e-6 4711
fix             scalars all ave/time 1 5 10 c_s[1] c_s[2] file scalars.txt
fix             rows all ave/time 1 5 10 c_s[1] c_s[2] mode vector file rows.txt
fix             columns all ave/time 1 5 10 c_s[*] mode vector file columns.txt
run             10
"""))
with open("scalars.txt") as file:
    scalars = [list(map(float, line.split())) for line in file if line[0] != "#"][-1]
with open("columns.txt") as file:
    columns = [list(map(float, line.split())) for line in file if line[0] != "#"][-3:]
claim("fix ave/time takes the array and the vector",
      [row[0] for row in columns] == [1, 2, 3] and
      abs(sum(row[1] for row in columns) / scalars[1] - 1) < 1e-5 and
      abs(sum(row[2] for row in columns) / scalars[2] - 1) < 1e-5, scalars)

# === Ranks, newton

LAYOUTS = {"2 ranks": (2, "newton on"), "4 ranks": (4, "newton on"), "newton off": (1, "newton off"),
           "4 ranks, newton off": (4, "newton off"), "4 ranks, tiled": (4, "comm_style tiled")}
MOVE = """
set             group all mass 10.0
velocity        all create 0.1 4711 loop geom
velocity        all set 6.0 5.0 4.0 sum yes
fix             move all nve
timestep        0.001
thermo          100
run             200
"""
for name in ("three membranes, one sharing a type", "valence 3", "valence 12", "plane", "torus",
             "tilted box, sphere across its corner"):
    scene = SCENES[name]
    commands = f"{scene.commands}\n{scene.shake(1)}\npair_style helfrich\n" + \
        "".join(f"pair_coeff {i} {i} 10.0 0.0\n" for i in (1, 2)[:scene.types])
    if scene.mesh:
        write_off(*scene.mesh)

    def state(ranks, before):
        rows = thermo(run(script(commands, box=scene.box, before=before, after=MOVE)
                          .replace("custom 1000000", "custom 200"), ranks=ranks))
        return [list(row.values()) for row in rows], atoms()[1]

    reference = state(1, "newton on")
    for layout, how in LAYOUTS.items():
        rows, values = state(*how)
        skip = 10 if not scene.closed else 15    # the centre of a periodic membrane has no place in x, y
        worst = largest((a - b) / max(1, abs(a)) for row, other in zip(reference[0], rows)
                        for a, b in zip(row[:skip], other[:skip]))
        claim(f"{name}, {layout}: the shape is that of 1 rank", worst < 1e-12, off(worst))
        worst = largest((a - b) / max(1, abs(a)) for i in values
                        for a, b in zip(reference[1][i], values[i]))
        claim(f"{name}, {layout}: so are H, K, positions and normals", worst < 1e-10, off(worst))

# === Bad input

PLAIN = """
units           lj
atom_style      {}
region          box block -3 3 -3 3 -3 3
create_box      1 box angle/types 1
{}
"""
error = error_of(PLAIN.format("angle", "compute s all membrane/shape"))
claim("membrane/shape needs atom style membrane_cp",
      "Compute s membrane/shape needs control points: use atom_style membrane_cp" in error, error)
error = error_of(PLAIN.format("angle", "compute s all membrane/curvature/atom"))
claim("so does membrane/curvature/atom", "Compute s membrane/curvature/atom needs control points" in error,
      error)
for arguments, message in (("quadrature 5", "quadrature 5 is not one of 1, 3, 6, 12, careful"),
                           ("quadrature", "compute membrane/shape quadrature"),
                           ("points 6", "Unknown compute membrane/shape keyword points")):
    error = error_of(PLAIN.format("membrane_cp", f"compute s all membrane/shape {arguments}"))
    claim(f"compute membrane/shape {arguments}", message in error, error)
error = error_of(PLAIN.format("membrane_cp", "compute s all membrane/curvature/atom 3"))
claim("compute membrane/curvature/atom 3", "has no arguments, but got: 3" in error, error)
error = error_of(script("create_membrane 1 sphere 1 1.0\ngroup some id 1:12\n"
                        "compute some some membrane/shape"))
claim("a group with part of a membrane",
      "group some has 12 of the 42 control points of membrane 1" in error, error)
for reference in ("c_s[1]", "C_k[1][1]"):
    error = error_of(script("create_membrane 1 sphere 1 1.0", after=f"""
undump          atoms
thermo_style    one
run             0
replicate       2 1 1
variable        v equal {reference}
print           "$(v_v)"
"""))
    claim(f"{reference} after replicate and before a run",
          "atoms were replaced since the last run: use run 0" in error, error)
error = error_of(script("create_membrane 1 sphere 1 1.0").replace(
    "custom step c_s[*]", "custom step c_s[2][1]"))
claim("a row that is not there", "out-of-range" in error, error)

finish()
