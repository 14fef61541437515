"""Bound particles in equilibrium: uniform in area, diffusion on a sphere, width of the spring.

    MEMBRANE_LONG=1    forty times the particles
"""
# cost: 25
# timeout: 14400

import math

from lammps_claims import LONG, claim, finish, run, thermo
from membrane_scenes import bipyramid, frames, read_off, write_off

N = 20000 if LONG else 500

# === A frozen surface with uneven triangles: atoms that start in one place come to be uniform in area

SPREAD = """
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
create_box      2 box angle/types 1
create_membrane 1 file uneven.off refine 2
group           mem type 1
{create}
group           p type 2
mass_of_type
timestep        {dt}
{motion}
compute         s p hd/surface/atom b
compute         d p hd/density b
thermo          {steps}
thermo_style    custom step f_b[3] c_d[1][2] f_b[2] f_b[1]
thermo_modify   format float %.16g
dump            1 p custom {steps} x.dump id x y z c_s[1]
dump_modify     1 format float %.17g
run             {steps}
""".replace("mass_of_type\n", "set type 2 mass 1.0\n")
points, faces = bipyramid(7)
write_off("uneven.off", [(1.5 * x, y, 0.6 * z) for x, y, z in points], faces)


def counts(rows, nfaces):
    found = [0] * nfaces
    for row in rows:
        found[int(row[4]) - 1] += 1
    return found


def chi_square(a, b):
    """Of two samples being of one distribution, over bins that are not too small; and its degrees."""
    sums = [(x, y) for x, y in zip(a, b) if x + y >= 10]
    na, nb = sum(x for x, _ in sums), sum(y for _, y in sums)
    ratio = math.sqrt(nb / na)
    return sum((x * ratio - y / ratio)**2 / (x + y) for x, y in sums), len(sums) - 1


BROWNIAN = "fix b p hd/bind mem max 1.0 brownian 1.0 0.2 {seed}"
LANGEVIN = """fix 2 p nve
fix 3 p langevin 1.0 1.0 0.2 {seed}
velocity p create 1.0 77 loop all
fix b p hd/bind mem max 1.0 hold {hold}"""

# placed uniformly by create_bound, and an independent sum of areas: faces in proportion to it

run(SPREAD.format(create=f"create_bound {N} 2 mem 31", motion="fix 2 p nve/noforce\nfix b p hd/bind mem", dt=0.01, steps=1))
uniform = frames("x.dump")[0]
nfaces = max(int(row[4]) for row in uniform)
placed = counts(uniform, nfaces)
for name, motion, dt, steps, seed in (
        ("brownian", BROWNIAN, 0.0005, 12000, 5), ("Langevin, spring", LANGEVIN.replace("{hold}", "spring auto"), 0.005, 4000, 7),
        ("Langevin, rigid", LANGEVIN.replace("{hold}", "rigid"), 0.005, 3000, 9)):
    create = f"create_atoms 2 random {N} 99 spot"
    region = "region spot sphere 1.2 0.2 0.0 0.15\n"
    text = SPREAD.format(create=region + create, motion=motion.format(seed=seed), dt=dt, steps=steps)
    rows = thermo(run(text, timeout=7200))
    end = frames("x.dump")[-1]
    value, degrees = chi_square(placed, counts(end, nfaces))
    claim(f"{name}: atoms that start in one place come to be as uniform as those of create_bound, over faces",
          value < degrees + 4 * math.sqrt(2 * degrees), f"chi^2 {value:.1f} of {degrees}")
    if "rigid" not in name:
        width = rows[-1]["f_b[3]"] * math.sqrt(rows[-1]["f_b[1]"])
        error = 1 / math.sqrt(2 * N)
        expected = 1.0 if name == "brownian" else 1 / math.sqrt(1 - 0.5**2 / 4)    # of velocity Verlet, omega dt = 1/2
        claim(f"{name}: the distance from the surface has the width sqrt(kT/K), within 1 % and three errors",
              abs(width - expected) < 0.01 + 3 * error, f"{width:.4f} +- {error:.4f}, {expected:.4f}")

# === create_bound: moments of area of an ellipsoid, against a sum over a fine tessellation

SHAPE = """
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
create_box      2 box angle/types 1
create_membrane 1 file uneven.off refine 2
group           mem type 1
write_membrane  fine.off subdivide 3
"""
text = SHAPE
run(text, timeout=7200)
xs, fs = read_off("fine.off")
moment, area = [0.0] * 3, 0.0
for a, b, c in fs:
    p, q, r = xs[a], xs[b], xs[c]
    u, v = [y - x for x, y in zip(p, q)], [y - x for x, y in zip(p, r)]
    n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    w = 0.5 * math.sqrt(sum(x * x for x in n))
    area += w
    for k in range(3):
        moment[k] += w * (p[k]**2 + q[k]**2 + r[k]**2 + (p[k] + q[k] + r[k])**2) / 12
for k in range(3):
    values = [row[1 + k]**2 for row in uniform]
    mean = sum(values) / len(values)
    error = math.sqrt(sum((v - mean)**2 for v in values)) / len(values)
    claim(f"create_bound: mean square of {'xyz'[k]} is that of the area, within three errors",
          abs(mean - moment[k] / area) < 3 * error + 2e-3 * moment[k] / area, f"{mean:.4f} +- {error:.4f}, {moment[k] / area:.4f}")

# === Diffusion on a sphere: <P_l(cos theta)> = exp(-l(l+1) D t/R^2), all atoms and time origins

SPHERE = """
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
create_box      2 box angle/types 1
create_membrane 1 sphere 2 2.0 interpolate yes
group           mem type 1
create_bound    {n} 2 mem 4 mass {m}
group           p type 2
timestep        {dt}
{motion}
thermo          1000
dump            1 p custom {every} x.dump id x y z
dump_modify     1 format float %.9g
run             {steps}
"""
P = {1: lambda c: c, 2: lambda c: 1.5 * c * c - 0.5, 3: lambda c: 2.5 * c**3 - 1.5 * c}


def decays(dt, every):
    """D from the decay of P_l, with its error, for l = 1, 2, 3."""
    units = []
    for frame in frames("x.dump"):
        units.append([[x / math.sqrt(sum(y * y for y in row[1:4])) for x in row[1:4]] for row in frame])
    result = {}
    for l in (1, 2, 3):
        lag = 2 if l == 1 else 1
        means = []
        for a, b in list(zip(units, units[lag:])):
            values = [P[l](p[0] * q[0] + p[1] * q[1] + p[2] * q[2]) for p, q in zip(a, b)]
            means.append(sum(values) / len(values))
        mean = sum(means) / len(means)
        error = math.sqrt(sum((m - mean)**2 for m in means) / len(means) / max(1, len(means) // lag - 1))
        rate = -math.log(mean) * 4.0 / (l * (l + 1) * lag * every * dt)
        result[l] = rate, error / mean * 4.0 / (l * (l + 1) * lag * every * dt)
    return result


D = 0.1
for name, motion, dt, m, every in (
        ("brownian", f"fix b p hd/bind mem brownian 1.0 {D} 8", 0.005, 1.0, 600),
        ("Langevin", "fix 2 p nve\nfix 3 p langevin 1.0 1.0 0.02 5\nvelocity p create 1.0 77 loop all\n"
                     "fix b p hd/bind mem", 0.005, 0.2, 600)):
    run(SPHERE.format(n=N, m=m, motion=motion, dt=dt, every=every, steps=10 * every), timeout=7200)
    for l, (value, error) in decays(dt, every).items():
        claim(f"{name}: P_{l} decays at l(l+1)D/R^2, within 2 % and three errors", abs(value / D - 1) < 0.02 + 3 * error / D,
              f"D {value:.5f} +- {error:.5f}, {D}")

# === Overdamped on a membrane that moves: the gas of particles presses on the area the same, whatever its drag is against

if LONG:
    MOVING = """
units           lj
atom_style      membrane_cp
region          box block -8 8 -8 8 -8 8
create_box      2 box angle/types 1
create_membrane 1 sphere 1 1.9 interpolate yes
group           mem type 1
create_bound    {n} 2 mem 4711
group           p type 2
special_bonds   lj/coul 1 1 1
pair_style      helfrich
pair_coeff      1 1 20.0 0.0 regularize 10 volume 50 init
timestep        0.001
fix             1 mem hd/brownian 1.0 {seed} gamma_t 1.0 mass lumped
{bind}
compute         hf all pair helfrich
thermo          100000
run             5000
fix             a all ave/time 10 500 5000 c_hf[5] file area.dat
run             150000
"""

    def area(n, seed, friction):
        bind = f"fix b p hd/bind mem brownian 1.0 1.0 {seed} friction {friction}" if n else ""
        run(MOVING.format(n=n, seed=seed, bind=bind), timeout=6000)
        values = [float(line.split()[1]) for line in open("area.dat") if not line.startswith("#")]
        mean = sum(values) / len(values)
        return mean, math.sqrt(sum((v - mean)**2 for v in values) / len(values) / (len(values) - 1))

    (a0, e0), (a1, e1), (a2, e2) = area(0, 6, ""), area(20, 7, "bath"), area(20, 8, "membrane")
    claim("drag against the bath and against the membrane: the same area, within three errors",
          abs(a1 - a2) < 3 * math.hypot(e1, e2), f"{a1:.4f} +- {e1:.4f}, {a2:.4f} +- {e2:.4f}")
    claim("    and more than without particles", a2 - a0 > 5 * math.hypot(e0, e2), f"{a0:.4f} +- {e0:.4f}")

finish()
