"""compute hd/modes: plane waves and spherical harmonics of the limit surface."""

import cmath
import math

from lammps_claims import claim, error_of, finish, run, thermo
from lattice_waves import surface
from membrane_scenes import TETRAHEDRON, write_off

ROOT = math.sqrt(0.75)
NX, NY = 16, 18
SHEET = f"block 0 {NX} 0 {NY * ROOT!r} -4 4"
TILTED = f"prism 0 {NX} 0 {NY * ROOT!r} -4 4 1.3 0.9 -0.7"


def script(commands, compute, columns, box=SHEET, before="", after="run 0"):
    return f"""
units           lj
atom_style      membrane_cp
{before}
region          box {box}
create_box      2 box angle/types 1
{commands}
compute         m all hd/modes {compute}
thermo_style    custom step c_m[*] {columns}
thermo_modify   norm no format float %24.17g
{after}
"""


def rows_of(count):
    return " ".join(f"c_m[{i}][{j}]" for i in range(1, count + 1) for j in range(1, 7))


def modes(row, count):
    """{mode numbers: (q or l, real, imaginary, power)}"""
    table = {}
    for i in range(1, count + 1):
        values = [row[f"c_m[{i}][{j}]"] for j in range(1, 7)]
        table[int(values[0]), int(values[1])] = values[2:]
    return table


def plane(commands, nmax, ranks=1, **options):
    """The vector and {(nx, ny): complex amplitude}, |q| and powers checked."""
    count = 2 * nmax * (nmax + 1)
    row = thermo(run(script(commands, f"plane {nmax}", rows_of(count), **options), ranks=ranks))[-1]
    table = modes(row, count)
    assert len(table) == count
    for q, re, im, power in table.values():
        assert abs(power - (re * re + im * im)) <= 1e-15 * power
    return ([row[f"c_m[{i}]"] for i in (1, 2, 3)],
            {numbers: complex(values[1], values[2]) for numbers, values in table.items()},
            {numbers: values[0] for numbers, values in table.items()})


def sphere(commands, lmax, ranks=1, box="block -3 3 -3 3 -3 3", **options):
    """The vector and {(l, m): amplitude}"""
    count = (lmax + 1) ** 2
    row = thermo(run(script(commands, f"sphere {lmax}", rows_of(count), box=box, **options),
                     ranks=ranks))[-1]
    table = modes(row, count)
    assert len(table) == count
    for (l, m), (again, u, zero, power) in table.items():
        assert again == l and zero == 0.0 and abs(power - u * u) <= 1e-15 * power
    return [row[f"c_m[{i}]"] for i in (1, 2, 3, 4)], {key: value[1] for key, value in table.items()}


def differ(a, b):
    return max(abs(a[key] - b[key]) for key in a)


def off(by):
    return f"{by:.1e}"


# === A sheet with one wave in the control points has it in the surface, less what its splines
# smooth away: sinc^2(q.e/2) for each of the three edges e


def wave_vector(nx, ny, tilt=0.0):
    a, b = (NX, 0.0), (tilt, NY * ROOT)
    qx = 2 * math.pi * nx / a[0]
    return qx, (2 * math.pi * ny - qx * b[0]) / b[1]


def response(nx, ny, tilt=0.0):
    qx, qy = wave_vector(nx, ny, tilt)
    half = tilt / NY
    return surface((qx, qy), ((1.0, 0.0), (half + 0.5, ROOT), (half - 0.5, ROOT)))


def wave(nx, ny, amplitude, tilt=0.0):
    """Commands that set z of control points to 2 Re[amplitude exp(i q.r)]."""
    qx, qy = wave_vector(nx, ny, tilt)
    size, phase = cmath.polar(amplitude)
    return f"""
variable        z atom {2 * size!r}*cos({qx!r}*x+({qy!r})*y+({phase!r}))
set             group all z v_z
variable        z delete
"""


PLANE = f"create_membrane 1 plane {NX} {NY}\n"
AMPLITUDE = complex(0.012, -0.007)
flat, none, q = plane(PLANE, 3)
claim("a plane has no waves", max(map(abs, none.values())) < 1e-15, off(max(map(abs, none.values()))))
claim("the vector has height, mean square height and area",
      abs(flat[0]) < 1e-15 and flat[1] < 1e-30 and abs(flat[2] / (NX * NY * ROOT) - 1) < 1e-14)
worst = max(abs(q[n] / math.hypot(*wave_vector(*n)) - 1) for n in q)
claim("column 3 is |q|", worst < 1e-14, off(worst))
claim("rows are half of all modes up to NMAX, row nx (2 NMAX + 1) + ny",
      list(q) == [(0, ny) for ny in (1, 2, 3)] + [(nx, ny) for nx in (1, 2, 3) for ny in range(-3, 4)])

for nx, ny in ((1, 0), (2, 0), (0, 1), (0, 2), (1, 1), (2, -1), (3, 3)):
    vector, h, q = plane(PLANE + wave(nx, ny, AMPLITUDE), 3)
    expected = AMPLITUDE * response(nx, ny)
    worst = abs(h[nx, ny] / expected - 1)
    wavelength = 2 * math.pi / q[nx, ny]
    claim(f"wave ({nx}, {ny}) of {wavelength:.1f} edges has its amplitude",
          worst < 1.5 * wavelength**-6, f"within {off(worst)}")
    worst = max(abs(h[n]) for n in h if n != (nx, ny)) / abs(expected)
    claim(f"wave ({nx}, {ny}) is alone", worst < 2e-3, off(worst))
    exact = 2 * abs(expected) ** 2
    claim(f"wave ({nx}, {ny}) has twice its power in the mean square height",
          abs(vector[1] / exact - 1) < 1e-3, off(vector[1] / exact - 1))
for tilt_box, name in ((SHEET, "box"), (TILTED, "tilted box")):
    tilt = 1.3 if tilt_box == TILTED else 0.0
    _, h, q = plane(PLANE + wave(1, -2, AMPLITUDE, tilt), 3, box=tilt_box)
    expected = AMPLITUDE * response(1, -2, tilt)
    worst = abs(h[1, -2] / expected - 1)
    claim(f"{name}: a wave in a direction of its own", worst < 3e-5, off(worst))
    worst = abs(q[1, -2] / math.hypot(*wave_vector(1, -2, tilt)) - 1)
    claim(f"{name}: its |q|", worst < 1e-14, off(worst))

# === Where the sheet is in the box, and which way it faces, do not matter

UP = PLANE + wave(1, -2, AMPLITUDE, 1.3) + "displace_atoms all move 0.0 0.0 {} units box\n"
_, middle, _ = plane(UP.format(0.0), 3, box=TILTED)
for ranks in (1, 2):
    # the heights straddle the boundary in z, and LAMMPS wraps them
    vector, across, _ = plane(UP.format(4.0), 3, box=TILTED, ranks=ranks)
    claim(f"{ranks} ranks: a sheet across the boundary in z is one in the middle",
          differ(across, middle) < 1e-14 and abs(vector[0] - 4.0) < 1e-13, off(differ(across, middle)))
STRIPPED = UP.format(4.0) + "run 0\nset group all image 0 0 0\n"
vector, stripped, _ = plane(STRIPPED, 3, box=TILTED)
same = max(abs(abs(stripped[n]) - abs(middle[n])) for n in middle)
claim("also without image flags", same < 1e-14, off(same))

# === Sphere


def harmonic(l, m):
    """LAMMPS formula of Y_lm of atoms, for the few that follow."""
    r = "sqrt(x*x+y*y+z*z)"
    table = {(1, 0): (3, 4, "z", 1), (1, 1): (3, 4, "x", 1), (1, -1): (3, 4, "y", 1),
             (2, 0): (5, 16, "(3*z*z-v_r*v_r)", 2), (2, 1): (15, 4, "x*z", 2),
             (2, -1): (15, 4, "y*z", 2), (2, 2): (15, 16, "(x*x-y*y)", 2), (2, -2): (15, 4, "x*y", 2),
             (3, 0): (7, 16, "z*(5*z*z-3*v_r*v_r)", 3), (3, -2): (105, 4, "x*y*z", 3),
             (3, 3): (35, 32, "x*(x*x-3*y*y)", 3), (4, 4): (315, 256, "(x^4-6*x*x*y*y+y^4)", 4)}
    a, b, form, power = table[l, m]
    return r, f"sqrt({a}/{b}/PI)*{form}/v_r^{power}"


def bump(l, m, u):
    r, y = harmonic(l, m)
    return f"""
variable        r atom {r}
variable        s atom 1.0+{u!r}*{y}
variable        px atom x*v_s
variable        py atom y*v_s
variable        pz atom z*v_s
set             group all x v_px y v_py z v_pz
"""


SPHERE = "create_membrane 1 sphere 3 1.3 interpolate yes\n"
vector, rest = sphere(SPHERE, 4)
claim("sphere: mean radius", abs(vector[0] / 1.3 - 1) < 1e-4, vector[0])
claim("sphere: centre", max(map(abs, vector[1:])) < 1e-14, vector[1:])
worst = max(map(abs, rest.values()))
claim("sphere: no harmonics up to l = 4", worst < 1e-12, off(worst))
U = 1e-3
for l, m in ((2, 0), (2, 1), (2, -1), (2, 2), (2, -2), (3, 0), (3, -2), (3, 3), (4, 4)):
    _, u = sphere(SPHERE + bump(l, m, U), 4)
    # the control points' harmonic is smoothed by l(l+1) h^2/(8 R^2) or so in the surface
    smooth = 1 - u[l, m] / U
    claim(f"sphere: Y_{l},{m} of the control points is in the surface, smoothed",
          0 < smooth < 0.004 * l * (l + 1), off(smooth))
    worst = max(abs(u[n]) for n in u if n != (l, m)) / U
    claim(f"sphere: Y_{l},{m} is alone", worst < 3e-3, off(worst))
for m in (0, 1, -1):
    vector, u = sphere(SPHERE + bump(1, m, U), 4)
    shift = vector[1 + (2, 0, 1)[(0, 1, -1).index(m)]] / 1.3 / (U * math.sqrt(3 / 4 / math.pi))
    claim(f"sphere: Y_1,{m} is a shift of the centre, and not in the modes",
          abs(shift - 1) < 0.01 and max(map(abs, u.values())) < 2e-6, f"{shift - 1:.1e}")
for place in ("center 3 3 3", "center -2.2 0.1 2.9"):
    there, moved = sphere(SPHERE.strip() + f" {place}\n", 4, ranks=2)
    claim(f"sphere across the box, {place}: the same", differ(moved, rest) < 1e-13,
          off(differ(moved, rest)))
    worst = max(abs(c - float(w)) for c, w in zip(there[1:], place.split()[1:]))
    claim(f"sphere across the box, {place}: centre", worst < 1e-13, off(worst))

# === Ranks, newton; other membranes and atoms do not matter

OTHERS = """
create_membrane 1 sphere 2 1.0 center 0 0 0
create_membrane 2 sphere 1 0.6 center 1.9 1.9 1.9
create_atoms    2 single -2.5 -2.5 -2.5
set             type 2 mass 1.0
displace_atoms  all random 0.03 0.03 0.03 4711 units box
"""
SHEETS = f"create_membrane 1 plane {NX} {NY}\ndisplace_atoms all random 0.1 0.1 0.2 99 units box\n"
_, reference, _ = plane(SHEETS, 5)
_, lone = sphere("create_membrane 1 sphere 2 1.0\n"
                 "displace_atoms all random 0.03 0.03 0.03 4711 units box\n", 8)
LAYOUTS = {"2 ranks": (2, ""), "4 ranks": (4, ""), "newton off": (1, "newton off"),
           "4 ranks, newton off, tiled": (4, "newton off\ncomm_style tiled")}
for name, (ranks, before) in LAYOUTS.items():
    worst = differ(plane(SHEETS, 5, ranks=ranks, before=before)[1], reference)
    claim(f"plane, {name}: the same amplitudes", worst < 1e-14, off(worst))
    worst = differ(sphere("create_membrane 1 sphere 2 1.0\n"
                          "displace_atoms all random 0.03 0.03 0.03 4711 units box\n", 8,
                          ranks=ranks, before=before)[1], lone)
    claim(f"sphere, {name}: the same amplitudes", worst < 1e-13, off(worst))

GROUPED = """
group           first molecule 1
compute         g first hd/modes sphere 8
thermo_style    custom step c_g[1] {}
thermo_modify   format float %24.17g
run             0
"""
several = f"""
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
create_box      2 box angle/types 1
{OTHERS}
""" + GROUPED.format(" ".join(f"c_g[{i}][4]" for i in range(1, 82)))
row = thermo(run(several, ranks=2))[-1]
worst = max(abs(row[f"c_g[{i}][4]"] - u) for i, u in enumerate(lone.values(), 1))
claim("a group selects one of several membranes", worst < 1e-13, off(worst))

# === Output: fix ave/time, quadrature, a moving membrane

run(script(PLANE + wave(1, 0, AMPLITUDE), "plane 2", "c_m[5][4]", after="""
fix             1 all nve
fix             2 all ave/time 2 5 10 c_m[1] c_m[2] c_m[3] c_m[6] mode vector file modes.txt
fix             3 all ave/time 2 5 10 c_m[1] c_m[2] c_m[3] file vector.txt
run             10
"""))
with open("modes.txt") as file:
    table = [list(map(float, line.split())) for line in file if line[0] != "#"][-12:]
claim("fix ave/time mode vector takes the columns",
      [row[0] for row in table] == list(range(1, 13)) and table[4][1:3] == [1, 0] and
      abs(table[4][4] / abs(AMPLITUDE * response(1, 0)) ** 2 - 1) < 1e-5, table[4])
with open("vector.txt") as file:
    values = [list(map(float, line.split())) for line in file if line[0] != "#"][-1]
claim("fix ave/time takes the vector", abs(values[3] / (NX * NY * ROOT) - 1) < 1e-5, values)

output = thermo(run(script(PLANE + wave(3, 3, AMPLITUDE), "plane 3 quadrature careful",
                           "c_m[24][4] c_m[24][5]")))[-1]
worst = abs(complex(output["c_m[24][4]"], output["c_m[24][5]"]) / AMPLITUDE / response(3, 3) - 1)
claim("quadrature careful is exact", worst < 1e-12, off(worst))

rows = thermo(run(script(PLANE + wave(1, 0, AMPLITUDE), "plane 2", "c_m[5][6]", after="""
velocity        all set 2.0 -1.0 3.0
fix             1 all nve
timestep        0.01
thermo          50
run             500
run             500
"""), ranks=2))
worst = max(abs(row["c_m[1]"] - 3.0 * row["Step"] * 0.01) for row in rows)
claim("the height follows a sheet through the box", worst < 1e-11 and len(rows) == 22, off(worst))
worst = max(abs(row["c_m[5][6]"] / rows[0]["c_m[5][6]"] - 1) for row in rows)
claim("and its modes stay", worst < 1e-9, off(worst))

# === Bad input


def refuses(text, commands, compute, expected, box=SHEET, after="run 0", ranks=2):
    line = error_of(script(commands, compute, "", box=box, after=after), ranks=ranks)
    claim(f"{text}: refused on {ranks} ranks", all(word in line for word in expected), line)


BALL = "create_membrane 1 sphere 2 1.0\n"
BOX = "block -3 3 -3 3 -3 3"
refuses("no shape", PLANE, "", ["missing", "compute hd/modes"], ranks=1)
refuses("no number", PLANE, "plane", ["missing", "compute hd/modes"], ranks=1)
refuses("an unknown shape", PLANE, "torus 3", ["torus", "plane, sphere"], ranks=1)
refuses("NMAX 0", PLANE, "plane 0", ["plane 0", "between 1 and"], ranks=1)
refuses("LMAX not a number", BALL, "sphere many", ["many"], box=BOX, ranks=1)
refuses("an unknown keyword", PLANE, "plane 2 rule 3", ["rule", "quadrature"], ranks=1)
refuses("a keyword without value", PLANE, "plane 2 quadrature", ["missing", "quadrature"], ranks=1)
refuses("an unknown quadrature", PLANE, "plane 2 quadrature 5", ["quadrature 5", "careful"], ranks=1)
refuses("plane of a sphere", BALL, "plane 2", ["closed", "hd/modes sphere"], box=BOX)
refuses("sphere of a plane", PLANE, "sphere 2", ["continues through", "hd/modes plane"])
refuses("sphere of a torus", "create_membrane 1 torus 24 16 1.5 0.5\n", "sphere 2",
        ["handles", "Euler characteristic 0"], box=BOX)
refuses("plane of a cylinder", "create_membrane 1 cylinder 20 20 1.0 z\n", "plane 2",
        ["projected area", "in x and y"], box=BOX)
refuses("two membranes", "create_membrane 1 sphere 1 0.7 center -1 0 0\n"
        "create_membrane 1 sphere 1 0.7 center 1 0 0\n", "sphere 2",
        ["more than one", "group one molecule 1"], box=BOX)
refuses("no membrane", "", "sphere 2", ["no membrane", "after create_membrane"], box=BOX)
refuses("part of a membrane", BALL + "region half block 0 3 -3 3 -3 3\ngroup half region half\n"
        "compute h half hd/modes sphere 2\n", "sphere 2", ["half", "of the 162", "group that has all"],
        box=BOX, after="thermo_style custom step c_h[1]\nrun 0")
write_off("reversed.off", TETRAHEDRON[0], [face[::-1] for face in TETRAHEDRON[1]])
refuses("faces inside out", "create_membrane 1 file reversed.off\n", "sphere 2",
        ["inside out", "reverse"], box=BOX)
refuses("a banana", "create_membrane 1 sphere 3 1.0 scale 2.0 0.4 0.4\nvariable z atom z+0.8*x*x\n"
        "set group all z v_z\n", "sphere 2", ["solid angle", "too far from a sphere"],
        box="block -3 3 -3 3 -5 5")
line = error_of("units lj\natom_style angle\nregion box block -1 1 -1 1 -1 1\n"
                "create_box 1 box angle/types 1\ncompute m all hd/modes plane 2\n")
claim("another atom style", "atom_style membrane_cp" in line, line)

finish()
