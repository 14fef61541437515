"""Waves on a sheet and oscillations of a sphere have the frequencies of theory with fix hd/nve."""
# cost: 20

import math

from lammps_claims import claim, finish, run, thermo
from lattice_waves import EDGES, dot, inertia, stiffness
from membrane_scenes import write_off

MASSES = ("vertex", "consistent", "lumped")
RULES = (1, 3, 6)


def frequency(q, rule, mass):
    return math.sqrt(stiffness(q, rule) / inertia(q, mass))


# omega/q^2 - 1 at a wavelength along an edge (x) and across (y), computed by others: vertex,
# consistent, lumped mass for each quadrature
REFERENCE = {
    (8, "x", 1): (-1.347168e-02, -1.315491e-02, -8.666126e-02),
    (8, "x", 3): (-2.356871e-04, 8.533390e-05, -7.440723e-02),
    (8, "x", 6): (-2.547561e-04, 6.625872e-05, -7.442488e-02),
    (8, "y", 1): (-1.360754e-02, -1.328070e-02, -8.677720e-02),
    (8, "y", 3): (-1.656475e-04, 1.656471e-04, -7.433242e-02),
    (8, "y", 6): (-1.656475e-04, 1.656471e-04, -7.433242e-02),
    (16, "x", 1): (-3.250323e-03, -3.231442e-03, -2.227992e-02),
    (16, "x", 3): (-1.391322e-05, 5.028885e-06, -1.910530e-02),
    (16, "x", 6): (-1.507119e-05, 3.870891e-06, -1.910643e-02),
    (16, "y", 1): (-3.258641e-03, -3.239607e-03, -2.228792e-02),
    (16, "y", 3): (-9.547943e-06, 9.547953e-06, -1.910086e-02),
    (16, "y", 6): (-9.547943e-06, 9.547953e-06, -1.910086e-02),
}
worst = 0.0
for (wavelength, direction, rule), values in REFERENCE.items():
    size = 2 * math.pi / wavelength
    q = (size, 0.0) if direction == "x" else (0.0, size)
    for mass, value in zip(MASSES, values):
        worst = max(worst, abs(frequency(q, rule, mass) / size**2 - 1 - value))
claim("the lattice sums of this test are those of the reference", worst < 1e-8, f"{worst:.1e}")

# === Waves on a sheet. Rows of points are along x, so across them no wave is 8 or 16 edges long:
# these are compared to the lattice sums.

NX, NY = 16, 18
AMPLITUDE = 1e-6
WAVES = ((1, 0), (2, 0), (0, 1), (0, 2), (1, 1), (2, -1))
NMAX = 2


def wave_vector(nx, ny):
    return 2 * math.pi * nx / NX, 2 * math.pi * ny / (NY * EDGES[1][1])


def row_of(nx, ny):
    return nx * (2 * NMAX + 1) + ny


def sheet(rule, wave, box=""):
    """A sheet at rest with one wave; areas and masses such that rho = 1."""
    qx, qy = wave_vector(*wave)
    return f"""
clear
units           lj
atom_style      membrane_cp
region          box block 0 {NX} 0 {NY * EDGES[1][1]!r} -4 4
create_box      1 box angle/types 1
create_membrane 1 plane {NX} {NY} mass {EDGES[1][1]!r}
pair_style      helfrich quadrature {rule}
pair_coeff      1 1 1.0 0.0 {box}
variable        z atom {AMPLITUDE!r}*cos({qx!r}*x+({qy!r})*y)
set             group all z v_z
variable        z delete
compute         m all hd/modes plane {NMAX}
thermo_style    custom step c_m[{row_of(*wave)}][4] c_m[{row_of(*wave)}][5]
thermo_modify   norm no format float %24.17g
"""


def amplitudes(rows, wave):
    return [row[f"c_m[{row_of(*wave)}][4]"] for row in rows]


# One step of velocity Verlet from rest takes a harmonic mode to 1 - (omega dt)^2/2 times itself,
# exactly and for any dt; omega dt = 1 here

CASES = [(rule, mass, wave) for rule in RULES for mass in MASSES for wave in WAVES]
text = ""
for rule, mass, wave in CASES:
    step = 1 / dot(wave_vector(*wave), wave_vector(*wave))
    text += sheet(rule, wave) + f"fix 1 all hd/nve mass {mass} tol 1e-12\ntimestep {step!r}\nrun 1\n"
rows = thermo(run(text))
claim("every case ran", len(rows) == 2 * len(CASES), len(rows))
worst, published = {}, 0.0
for i, (rule, mass, wave) in enumerate(CASES):
    q = wave_vector(*wave)
    before, after = amplitudes(rows[2 * i:2 * i + 2], wave)
    omega = math.sqrt(2 * (1 - after / before)) * dot(q, q)
    error = omega / frequency(q, rule, mass) - 1
    worst[rule, mass] = max(worst.get((rule, mass), 0.0), abs(error))
    if wave[1] == 0:
        value = REFERENCE[NX // wave[0], "x", rule][MASSES.index(mass)]
        off = omega / dot(q, q) - 1 - value
        published = max(published, abs(off))
        claim(f"wave of {NX // wave[0]} edges along x, quadrature {rule}, mass {mass}: omega/q^2 - 1",
              abs(off) < 1e-6, f"{omega / dot(q, q) - 1:.6e} against {value:.6e}")
for (rule, mass), error in worst.items():
    claim(f"quadrature {rule}, mass {mass}: omega of all waves is the lattice's", error < 1e-8,
          f"within {error:.1e}")

# === A wave with tension

tension = 0.7
for wave in WAVES[:2]:
    q2 = dot(wave_vector(*wave), wave_vector(*wave))
    theory = math.sqrt(q2 * q2 + tension * q2)
    text = sheet(6, wave, f"tension {tension}") + f"fix 1 all hd/nve\ntimestep {1 / theory!r}\nrun 1\n"
    before, after = amplitudes(thermo(run(text)), wave)
    omega = math.sqrt(2 * (1 - after / before)) * theory
    claim(f"wave of {NX // wave[0]} edges with tension: omega^2 = (kc q^4 + sigma q^2)/rho",
          abs(omega / theory - 1) < 3e-4, f"{omega / theory - 1:.1e}")

# === Three periods: h((n+k) dt) + h((n-k) dt) = 2 cos(k omega' dt) h(n dt), with
# sin(omega' dt/2) = omega dt/2 for the leapfrog's frequency omega'

STEP, EVERY, STEPS = 0.02, 10, 1600
for mass in MASSES:
    wave = (2, 0)
    rows = thermo(run(sheet(6, wave) + f"fix 1 all hd/nve mass {mass}\ntimestep {STEP}\n"
                      f"thermo {EVERY}\nrun {STEPS}\n"))
    h = amplitudes(rows, wave)
    k = 20
    middle = range(k, len(h) - k)
    cosine = (sum(h[n] * (h[n + k] + h[n - k]) for n in middle) /
              (2 * sum(h[n] ** 2 for n in middle)))
    measured = math.acos(cosine) / (k * EVERY * STEP)
    omega = 2 / STEP * math.sin(0.5 * measured * STEP)
    value = REFERENCE[8, "x", 6][MASSES.index(mass)]
    off = omega / dot(wave_vector(*wave), wave_vector(*wave)) - 1 - value
    periods = omega * STEP * STEPS / 2 / math.pi
    claim(f"{periods:.1f} periods of a wave of 8 edges, mass {mass}: omega/q^2 - 1", abs(off) < 1e-7,
          f"{value + off:.7e} against {value:.7e}")
    still = max(abs(row[f"c_m[{row_of(*wave)}][5]"]) for row in rows) / h[0]
    claim(f"mass {mass}: a standing wave stays where it is", still < 1e-9, f"{still:.1e}")

# === A sphere: all harmonics of l = 2..5 at once, on a relaxed mesh. Theory is for one mass per area:
# the points' masses are in proportion to the area around them.


def read_data(path):
    """Points and faces of a data file."""
    section, points, faces = "", {}, []
    with open(path) as file:
        for line in file:
            words = line.split("#")[0].split()
            if words[:1] in (["Atoms"], ["Angles"], ["Velocities"]):
                section = words[0]
            elif words and section == "Atoms":
                points[int(words[0])] = [float(word) for word in words[4:7]]
            elif words and section == "Angles":
                faces.append(tuple(int(word) - 1 for word in words[2:5]))
    return [points[i] for i in sorted(points)], faces


def areas(points, faces):
    """A third of the faces around each point."""
    total = [0.0] * len(points)
    for face in faces:
        a, b, c = (points[v] for v in face)
        u, v = [y - x for x, y in zip(a, b)], [y - x for x, y in zip(a, c)]
        n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        for corner in face:
            total[corner] += math.hypot(*n) / 6
    return total


def harmonics(point, lmax):
    """Real orthonormal Y_lm in the direction of a point, without the phase (-1)^m."""
    r = math.hypot(*point)
    x, y, z = (c / r for c in point)
    table, sectoral = {}, math.sqrt(1 / (4 * math.pi))
    for m in range(lmax + 1):
        sectoral *= math.sqrt((2 * m + 1) / (2 * m)) if m else 1
        turn = complex(x, y) ** m
        last, value = 0.0, sectoral
        for l in range(m, lmax + 1):
            if l > m:
                a = math.sqrt((4 * l * l - 1) / (l * l - m * m))
                b = math.sqrt(((l - 1) ** 2 - m * m) / (4 * (l - 1) ** 2 - 1)) if l > m + 1 else 0
                last, value = value, a * (z * value - b * last)
            table[l, m] = value * turn.real * (math.sqrt(2) if m else 1)
            if m:
                table[l, -m] = value * turn.imag * math.sqrt(2)
    return table


def frequency_of(t, u, guess):
    """omega of the best u = a cos(omega t) + b by golden section within 10 % of a guess."""
    def misfit(omega):
        c = [math.cos(omega * time) for time in t]
        n, sc, su = len(t), sum(c), sum(u)
        a = (n * sum(map(float.__mul__, c, u)) - sc * su) / (n * sum(x * x for x in c) - sc * sc)
        b = (su - a * sc) / n
        return sum((y - a * x - b) ** 2 for x, y in zip(c, u))
    low, high, golden = 0.9 * guess, 1.1 * guess, 0.5 * (math.sqrt(5) - 1)
    for _ in range(40):
        left, right = high - golden * (high - low), low + golden * (high - low)
        if misfit(left) < misfit(right):
            high = right
        else:
            low = left
    return 0.5 * (low + high)


LMAX, U = 5, 1e-5
KEYS = [(l, m) for l in range(2, LMAX + 1) for m in range(-l, l + 1)]


def vesicle(shape, c0, terms):
    return f"""
units           lj
atom_style      membrane_cp
region          box block -2 2 -2 2 -2 2
create_box      1 box angle/types 1
create_membrane 1 {shape}
pair_style      helfrich
pair_coeff      1 1 1.0 {c0} {terms}
compute         s all membrane/shape
thermo_modify   norm no format float %24.17g
"""


def oscillate(c0, modulus, level=4, step=5e-4, steps=2000, tolerance=0.01):
    area, volume = 4 * math.pi, 4 * math.pi / 3
    terms = f"area {modulus} {area!r} volume {modulus} {volume!r}"
    run(vesicle(f"sphere {level} 1.0 interpolate yes", c0, terms) +
        "min_style membrane\nminimize 0 0 30 2000\nwrite_data relaxed.data nocoeff\n")
    points, faces = read_data("relaxed.data")
    excited = []
    for point in points:
        table = harmonics(point, LMAX)
        stretch = 1 + U * sum(table[l, m] * (1 if (l + m) % 3 else -1) for l, m in KEYS)
        excited.append([stretch * c for c in point])
    write_off("excited.off", excited, faces)
    mass = areas(points, faces)
    with open("mass.txt", "w") as file:
        file.write(f"{len(points)}\n" + "".join(f"{i} {m!r}\n" for i, m in enumerate(mass, 1)))
    columns = " ".join(f"c_m[{l * l + l + m + 1}][4]" for l, m in KEYS)
    rows = thermo(run(vesicle("file excited.off", c0, terms) + f"""
variable        mass atomfile mass.txt
set             group all mass v_mass
compute         m all hd/modes sphere {LMAX}
thermo_style    custom step c_s[1] c_m[1] {columns}
thermo_modify   norm no format float %24.17g
fix             1 all hd/nve
timestep        {step!r}
thermo          {steps // 80}
run             {steps}
"""))
    t = [row["Step"] * step for row in rows]
    R, A = rows[0]["c_m[1]"], rows[0]["c_s[1]"]
    sigma = modulus * (A - area) / area
    s = sigma * R**2 - 2 * c0 * R + 0.5 * (c0 * R) ** 2
    for l in range(2, LMAX + 1):
        theory = math.sqrt((l - 1) * (l + 2) * (l * (l + 1) + s) / (sum(mass) / A) / R**4)
        errors = [frequency_of(t, [row[f"c_m[{l * l + l + m + 1}][4]"] for row in rows], theory) / theory - 1
                  for m in range(-l, l + 1)]
        mean = sum((1 + error) ** 2 for error in errors) / len(errors) - 1
        claim(f"sphere of {len(points)} points, c0 = {c0}, s = {s:.3f}: omega_{l}^2 is that of theory",
              max(abs((1 + error) ** 2 - 1) for error in errors) < tolerance,
              f"mean {mean:.1e}, worst {max(map(abs, errors)) * 2:.1e}")


oscillate(0.0, 10.0)
oscillate(1.0, 100.0)

finish()
