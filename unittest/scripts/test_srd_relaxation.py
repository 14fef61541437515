"""fix srd/mesh: undulations of a sheet and of a vesicle relax in solvent as hydrodynamics has it.

Runs start from a thermal membrane that is stretched along a mode. The mean of y(t) y(0) over runs is fitted with
that of linear theory, w(x t), so x is the rate in units of the theoretical one; its error is the jackknife over
runs. doc/src/Howto_srd.rst derives the theory. Units: mass and cell of the solvent, kT. Runs with MEMBRANE_LONG=1
only."""
# timeout: 7200

import cmath
import math

from lammps_claims import LONG, claim, finish, run, skip, thermo
from membrane_scenes import write_off

# === The solvent: viscosity of kinetic theory, speed of sound of an isothermal gas

M, DEGREES, DT = 10, 130, 0.03
F, A = M - 1 + math.exp(-M), math.radians(DEGREES)
ETA = M * (DT / 2 * (5 * M / (F * (2 - math.cos(A) - math.cos(2 * A))) - 1) + F / M * (1 - math.cos(A)) / (18 * DT))
SOUND2 = 1.0

# === Theory: w(t) of a mode that starts at 1 from rest, from its Laplace transform


def inverse_laplace(transform, t, n=20):
    """Talbot's contour with the numbers of Weideman (2006)."""
    total = 0
    for k in range(n):
        th = -math.pi + (2 * k + 1) * math.pi / n
        cot, sin = 1 / cmath.tan(0.6407 * th), cmath.sin(0.6407 * th)
        s = n / t * (0.5017 * th * cot - 0.6122 + 0.2645j * th)
        ds = n / t * (0.5017 * cot - 0.5017 * 0.6407 * th / sin ** 2 + 0.2645j)
        total += cmath.exp(s * t) * transform(s) * ds
    return (total / (1j * n)).real


class Plane:
    """Mode q of sheets at distances L with vertices h apart; stiff = energy per area and amplitude squared, twice."""

    def __init__(self, kc, q, L, h, mass):
        self.q, self.L, self.mass, self.stiff = q, L, mass, kc * q ** 4
        flat = sinc(q * h / 2) * sinc(q * h / 4) ** 2    # a wave that vertices make, of the flat triangles' height
        self.faces = 1 / flat ** 2
        x = q * L
        self.images = (math.sinh(x) + x) / (math.cosh(x) - 1)
        self.rate = kc * q ** 3 / (4 * ETA)

    def mobility(self, s):
        q2, half = self.q ** 2, self.L / 2
        k, p = cmath.sqrt(q2 + M * s / ETA), cmath.sqrt(q2 + M * s / (ETA + M * SOUND2 / s))
        return self.faces * (p / cmath.tanh(p * half) - q2 / (k * cmath.tanh(k * half))) / (2 * M * s)

    def transform(self, s):
        g = self.mobility(s)
        return (1 + g * self.mass * s) / (s + g * (self.stiff + self.mass * s * s))


def sinc(x):
    return math.sin(x) / x


class Sphere:
    """Modes xy, yz, zx of a vesicle of radius R in a periodic cube of edge L with vertices h apart.

    *regularize* K resists gradients of the dilation and, at least on a mesh at rest, shear with the modulus
    4 K/(sqrt(3) h^2)."""

    def __init__(self, kc, R, L, h, mass, K, resists_shear, cutoff=12):
        self.R, self.mass = R, mass
        self.k_n = (24 * kc + 8 / math.sqrt(3) * K) / R ** 4
        self.k_t = 16 * K / (math.sqrt(3) * h * h * R * R) if resists_shear else 0.0
        self.faces = 1 / (1 - h * h / (2 * R * R)) ** 2 / (1 - h * h / (8 * R * R))
        self.rate = 24 * kc / (ETA * R ** 3) * 4 / 35
        shells = {}
        for i in range(cutoff + 1):
            for j in range(cutoff + 1):
                for k in range(cutoff + 1):
                    n = i * i + j * j + k * k
                    if 0 < n <= cutoff ** 2:
                        many = 2 ** ((i > 0) + (j > 0) + (k > 0))
                        x, y = i * i / n, j * j / n
                        across, along = shells.get(n, (0.0, 0.0))
                        shells[n] = (across + many * 15 / (4 * math.pi) * (x + y - 4 * x * y),
                                     along + many * 15 / (4 * math.pi) * x * y)
        self.shells = []
        for n, (across, along) in shells.items():
            k = 2 * math.pi * math.sqrt(n) / L
            x = k * R
            j = (3 / x ** 3 - 1 / x) * math.sin(x) - 3 * math.cos(x) / x ** 2
            slope = 2 * j / x - ((15 / x ** 4 - 6 / x ** 2) * math.sin(x) - (15 / x ** 3 - 1 / x) * math.cos(x))
            a, b = j / x, slope + j / x
            self.shells.append((k * k, across * a * a, across * a * b, across * b * b,
                                along * slope ** 2, along * slope * 6 * a, along * 36 * a * a))
        self.size = (4 * math.pi * R) ** 2 / L ** 3
        rest = 2 * math.pi * cutoff / L * R    # of the sum beyond the cutoff, as an integral
        self.rest_n, self.rest_t = 2 / (math.pi * rest ** 3) * R / ETA, 6 / (math.pi * rest) * R / ETA
        self.images = sum(row[1] / row[0] for row in self.shells) * self.size / R / (4 / 35)

    def transform(self, s):
        nn = nt = tt = 0
        for k2, a, b, c, d, e, f in self.shells:
            bent, squeezed = 1 / (ETA * k2 + M * s), 1 / (ETA * k2 + M * s + M * SOUND2 * k2 / s)
            nn += a * bent + d * squeezed
            nt += b * bent + e * squeezed
            tt += c * bent + f * squeezed
        nn = self.faces * (self.size * nn + self.rest_n)
        nt *= self.size
        tt = self.size * tt + self.rest_t
        inertia = self.mass * s * s
        normal, tangent = self.k_n + inertia, self.k_t + inertia
        a, b, c, d = s + nn * normal, nt * tangent, nt / 6 * normal, s + tt / 6 * tangent
        return ((1 + nn * self.mass * s) * d - b * nt / 6 * self.mass * s) / (a * d - b * c)


class Curve:
    """w(t), from a table."""

    def __init__(self, theory, end, n=100):
        self.step, self.values = end / n, [1.0]
        self.values += [inverse_laplace(theory.transform, i * self.step) for i in range(1, n + 1)]

    def __call__(self, t):
        i = min(int(t / self.step), len(self.values) - 2)
        return self.values[i] + (t / self.step - i) * (self.values[i + 1] - self.values[i])


def exponential(rate):
    return lambda t: math.exp(-rate * t)


def fitted(times, mean, curve):
    """The x of w(x t) nearest to the mean in squares, relative to its start."""
    def badness(x):
        return sum((y / mean[0] - curve(x * t)) ** 2 for t, y in zip(times, mean))
    low, high = 0.4, 1.8
    for _ in range(40):    # golden section
        a, b = high - 0.618 * (high - low), low + 0.618 * (high - low)
        low, high = (low, b) if badness(a) < badness(b) else (a, high)
    return (low + high) / 2


def measured(runs, times, curve):
    n = len(runs)
    runs = [[y * run[0] for y in run] for run in runs]
    total = [sum(column) for column in zip(*runs)]
    x = fitted(times, total, curve)
    left_out = [fitted(times, [y - z for y, z in zip(total, one)], curve) for one in runs]
    return x, math.sqrt((n - 1) / n * sum((y - x) ** 2 for y in left_out))


# === Scenes. The fixes take out the measure of the mesh, so the frame has no tension, see the Howto

COMMON = """
units           lj
atom_style      membrane_cp
region          box block {box}
create_box      2 box angle/types 1
special_bonds   lj/coul 1 1 1
comm_modify     cutoff 7.0
{create}
group           membrane type 1
pair_style      helfrich
pair_coeff      1 1 {kc} 0.0 regularize {regularize} {hold}
fix             1 membrane hd/langevin 1.0 1.0 1.0 {seed}
timestep        {DT}
thermo          0
run             1000
unfix           1
reset_timestep  0
fix             start membrane store/state 0 x y z
variable        X atom f_start[1]
variable        Y atom f_start[2]
variable        Z atom f_start[3]
{displace}
create_solvent  2 both {M} {seed}
group           solvent type 2
pair_coeff      1 1 {kc} 0.0 regularize {regularize}
fix             1 membrane hd/nve
fix             2 solvent srd/mesh 1 membrane 1.0 1.0 {seed} angle {DEGREES} shift yes {seed} tstat yes
compute         u membrane hd/modes {modes}
thermo_style    custom step {columns} f_2[3]
thermo_modify   norm no format float %.12g
thermo          {every}
run             {steps}
"""

PLANE = dict(box="0 16 0 7 0 16", create="create_membrane 1 plane 12 6 mass 10", modes="plane 1",
             hold="", columns="c_u[3][4]",
             displace="""variable zz atom v_Z+{amplitude}*cos(2*PI*v_X/16)
set             group membrane z v_zz""")

SPHERE = dict(box="-8 8 -8 8 -8 8", create="create_membrane 1 file sphere.off interpolate yes mass 10",
              modes="sphere 2", hold="volume 100.0 init", columns="c_u[5][4] c_u[6][4] c_u[8][4] c_u[1]",
              displace="""variable f atom 1+{amplitude}*sqrt(1.25/PI)*(v_X*v_Y+v_Y*v_Z+v_Z*v_X)/(v_X^2+v_Y^2+v_Z^2)
variable        xx atom v_f*v_X
variable        yy atom v_f*v_Y
variable        zz atom v_f*v_Z
set             group membrane x v_xx y v_yy z v_zz""")


def rows_of(scene, amplitude, **values):
    scene = dict(scene, displace=scene["displace"].format(amplitude=amplitude))
    output = run(COMMON.format(M=M, DEGREES=DEGREES, DT=DT, **scene, **values))
    rows = [row for row in thermo(output) if "f_2[3]" in row]
    if any(row["f_2[3]"] for row in rows):
        claim("nothing passes the membrane", False)
    return rows


def icosphere(n, radius):
    """Points and faces of an icosahedron with edges divided by n, on a sphere."""
    g = (1 + math.sqrt(5)) / 2
    corners = [p for a in (-1, 1) for b in (-g, g) for p in ((0, a, b), (a, b, 0), (b, 0, a))]
    points, index, faces = [], {}, []

    def vertex(p):
        key = tuple(round(x, 6) for x in p)
        if key not in index:
            size = math.sqrt(sum(x * x for x in p))
            index[key] = len(points)
            points.append([radius * x / size for x in p])
        return index[key]

    near = [[sum((x - y) ** 2 for x, y in zip(p, q)) < 4.1 for q in corners] for p in corners]
    for a in range(12):
        for b in range(a):
            for c in range(b):
                if near[a][b] and near[b][c] and near[a][c]:
                    p, q, r = corners[a], corners[b], corners[c]
                    volume = sum(p[i] * (q[i - 2] * r[i - 1] - q[i - 1] * r[i - 2]) for i in range(3))
                    if volume < 0:
                        q, r = r, q
                    at = {(i, j): vertex([(p[k] * (n - i - j) + q[k] * i + r[k] * j) / n for k in range(3)])
                          for i in range(n + 1) for j in range(n + 1 - i)}
                    for i in range(n):
                        for j in range(n - i):
                            faces.append((at[i, j], at[i + 1, j], at[i, j + 1]))
                            if i + j < n - 1:
                                faces.append((at[i + 1, j], at[i + 1, j + 1], at[i, j + 1]))
    return points, faces


def percent(x, error):
    return f"{100 * (x - 1):+.1f} +- {100 * error:.1f} %"


def report(name, theory, runs, times, formula, within=0.1):
    """Claims about runs against all of linear theory, and against the formula for an incompressible fluid without
    inertia, with its factors for periodic images and for flat faces."""
    curve = Curve(theory, 2 * times[-1])
    x, error = measured(runs, times, curve)
    claim(f"{name}: the rate is that of linear theory within {100 * within:.0f} %", abs(x - 1) < within and error < 0.07,
          percent(x, error))
    factor = theory.images * theory.faces
    expected = fitted(times, [curve(t) for t in times], exponential(theory.rate * factor))
    y, error = measured(runs, times, exponential(theory.rate * factor))
    claim(f"    and {formula}, times {theory.images:.3f} for periodic images and {theory.faces:.3f} for flat faces, "
          f"within {100 * within:.0f} %", abs(y - 1) < within, f"{percent(y, error)}, linear theory {100 * (expected - 1):+.1f} %")
    print(f"note      relative to the formula alone: {percent(factor * y, factor * error)}")


if __name__ == "__main__":
    if not LONG:
        skip("takes long: set MEMBRANE_LONG=1")
    COUNT = {"vesicle": 96, "sheet": 256}

    # === A vesicle, prolate and oblate in turn: what is of second order in the amplitude drops out

    R, L, kc, regularize, amplitude, count = 5.0, 16.0, 60.0, 6.0, 0.25, 362
    area = 4 * math.pi * R * R
    write_off("sphere.off", *icosphere(6, R))
    theory, stiff = (Sphere(kc, R, L, math.sqrt(area / count * 2 / math.sqrt(3)), 10 * count / area, regularize, shear)
                     for shear in (False, True))
    runs, radii = [], []
    for i in range(COUNT["vesicle"]):
        rows = rows_of(SPHERE, (-1) ** i * amplitude, seed=4711 + i, kc=kc, regularize=regularize, every=25,
                       steps=round(1.2 / theory.rate / DT))
        runs.append([sum(row[f"c_u[{k}][4]"] for k in (5, 6, 8)) / math.sqrt(3) for row in rows])
        radii += [row["c_u[1]"] for row in rows]
    times = [row["Step"] * DT for row in rows]
    report("vesicle", theory, runs, times, "24 kc/(eta R^3) 4/35", within=0.15)
    x, error = measured(runs, times, Curve(stiff, 2 * times[-1]))
    claim("    which is that of a fluid membrane: a mesh with the shear modulus that it has at rest has this rate within 7 %",
          abs(x - 1) < 0.07 and error < 0.04, percent(x, error))
    radius = sum(radii) / len(radii)
    claim("    and its mean radius is that of the start within 1 %", abs(radius / R - 1) < 0.01, f"{radius:.3f}")

    # === A sheet

    kc, amplitude, q, count, area = 45.0, 0.64, 2 * math.pi / 16, 72, 16 * 7
    theory = Plane(kc, q, 16, 16 / 12, 10 * count / area)
    runs = []
    for i in range(COUNT["sheet"]):
        rows = rows_of(PLANE, amplitude, seed=4711 + i, kc=kc, regularize=10, every=50,
                       steps=round(1.5 / theory.rate / DT))
        runs.append([row["c_u[3][4]"] for row in rows])
    report("sheet", theory, runs, [row["Step"] * DT for row in rows], "1/tau = kc q^3/(4 eta)")

    finish()
