"""Bound particles that couple to curvature: energy is kept, ranks and restarts, sorting, alignment.

    MEMBRANE_LONG=1    thirty times the particles
"""
# cost: 20

import math

from lammps_claims import LONG, claim, finish, run, thermo
from membrane_scenes import frames
from spread_and_slope import order, spread

SCENE = """
units           lj
atom_style      membrane_cp
region          box block -8 8 -8 8 -8 8
create_box      2 box angle/types 1
create_membrane 1 sphere 2 3.5 interpolate yes
set             type 1 mass 1.0
group           mem type 1
create_bound    {n} 2 mem 4711 leaflet both
group           p type 2
pair_style      hybrid/overlay helfrich zero 1.0
pair_coeff      1 1 helfrich 20.0 0.0 regularize 10
pair_coeff      * * zero
neighbor        0.5 bin
timestep        {dt}
fix             1 mem hd/nve tol 1e-13 measure 1.0
fix             2 p nve
fix             b p hd/bind mem hold {hold} leaflet both {coupling}
hd_velocity     mem 1.0 12
velocity        p create 1.0 99 loop all
compute         T all hd/temp
thermo_style    custom step pe etotal press f_b f_b[6]
thermo_modify   norm no format float %.16g temp T
thermo          {every}
"""
ISOTROPIC = "footprint 2 2.0 30.0 0.8 1.5"
BAR = "bar 2 2.0 30.0 0.8 10.0 -0.2 1.5"
MILD = "bar 2 0.5 20.0 0.4 5.0 0.0 1.5"


def script(n=10, hold="spring 3000", dt=0.005, every=1, coupling=ISOTROPIC):
    return SCENE.format(n=n, hold=hold, dt=dt, every=every, coupling=coupling)


# === Forces are derivatives of the energy: its error goes as dt^2, and footprints take part in it

for name, coupling in (("isotropic", ISOTROPIC), ("with a director", BAR)):
    steps = [5e-3 / 2**k for k in range(4)]
    errors, share = [], 0.0
    for dt in steps:
        rows = thermo(run(script(dt=dt, coupling=coupling) + f"run {round(1.0 / dt)}\n"))[-round(1.0 / dt) - 1:]
        errors.append(spread([row["TotEng"] for row in rows]))
        share = spread([row["f_b[6]"] for row in rows])
    power = order(steps, errors)
    claim(f"{name}: energy error goes as dt^2 over a factor 8, while footprints exchange much more",
          abs(power - 2) < 0.1 and share > 50 * errors[-1],
          f"order {power:.3f}, errors " + " ".join(f"{e:.2e}" for e in errors) + f", footprints {share:.2f}")

# === Pressure is that of the energy under strain of the box: one central difference

STRAIN = script(every=1) + """
run             5
variable        L equal 16*(1+{e})
change_box      all x final $(-v_L/2) $(v_L/2) y final $(-v_L/2) $(v_L/2) z final $(-v_L/2) $(v_L/2) remap units box
run             0
"""
e = 1e-5
pe = {}
for sign in (1, -1):
    pe[sign] = thermo(run(STRAIN.format(e=sign * e)))[-1]["PotEng"]
row = thermo(run(script(every=1) + "compute V all pressure NULL virial\nthermo_style custom step c_V vol\n"
                 "thermo_modify format float %.16g\nrun 5\n"))[-1]
virial = row["c_V"] * 3 * row["Volume"]
claim("the virial is minus the derivative of the energy by strain", abs(virial + (pe[1] - pe[-1]) / (2 * e)) < 1e-6 * abs(virial),
      f"{virial:.9g} {-(pe[1] - pe[-1]) / (2 * e):.9g}")

# === Virials of atoms: each particle has that of its footprint and spring, which changes nothing else

PER_ATOM = script(every=1) + """
compute         V all pressure NULL fix
{}
run             5
"""
of_atoms = """compute a all stress/atom NULL fix
compute s all reduce sum c_a[1] c_a[2] c_a[3] c_a[4] c_a[5] c_a[6]
compute m mem reduce sum c_a[1]
thermo_style custom step pe etotal vol c_V[1] c_V[2] c_V[3] c_V[4] c_V[5] c_V[6] c_s[1] c_s[2] c_s[3] c_s[4] c_s[5] c_s[6] c_m
thermo_modify norm no format float %.16g"""
row = thermo(run(PER_ATOM.format(of_atoms), ranks=2))[-1]
plain = thermo(run(PER_ATOM.format("thermo_style custom step pe etotal vol c_V[1] c_V[2] c_V[3]\nthermo_modify norm no format float %.16g"), ranks=2))[-1]
off = max(abs(row[f"c_V[{k}]"] * row["Volume"] + row[f"c_s[{k}]"]) for k in range(1, 7))
claim("virials of atoms sum to that of the pressure", off < 1e-9 * row["Volume"] and row["c_m"] == 0.0, f"{off:.1e} of {row['c_s[1]']:.4f}")
claim("    and nothing else changes", abs(plain["TotEng"] - row["TotEng"]) < 1e-9 and abs(plain["c_V[1]"] - row["c_V[1]"]) < 1e-9,
      f"{plain['TotEng'] - row['TotEng']:.1e}")

# === Ranks and restart

ends = {}
for ranks in (1, 2):
    run(script(n=40, every=500, coupling=MILD) + """
dump            1 all custom 500 x.dump id x y z
dump_modify     1 format float %.17g
run             500
""", ranks=ranks)
    ends[ranks] = frames("x.dump")[-1]
off = max(abs(a - b) for p, q in zip(ends[1], ends[2]) for a, b in zip(p, q))
claim("2 ranks follow one to 1e-9 over 500 steps", off < 1e-9, f"{off:.1e}")

WHOLE = script(n=40, every=100, coupling=MILD + " rotate 1.0 0.1 4")
rows = thermo(run(WHOLE + "run 100\nwrite_restart b.restart\nrun 200\n", ranks=2))
CONTINUED = """
read_restart    b.restart
pair_style      hybrid/overlay helfrich zero 1.0
pair_coeff      1 1 helfrich 20.0 0.0 regularize 10
pair_coeff      * * zero
""" + WHOLE[WHOLE.index("neighbor"):WHOLE.index("hd_velocity")] + WHOLE[WHOLE.index("compute         T"):]
again = thermo(run(CONTINUED + "run 200\n", ranks=2))
claim("a restart continues to 1e-11, directors and their noise included",
      all(abs(a[k] - b[k]) < 1e-11 * (1 + abs(a[k])) for a, b in zip(rows[-2:], again[-2:]) for k in ("TotEng", "f_b[6]")),
      f"{rows[-1]['TotEng']} {again[-1]['TotEng']}")

# === Sorting on a frozen ellipsoid: the distribution over curvatures is Boltzmann's

N = 20000 if LONG else 600
FROZEN = """
units           lj
atom_style      membrane_cp
region          box block -6 6 -6 6 -6 6
create_box      2 box angle/types 1
{create}
group           mem type 1
create_bound    {n} 2 mem 31
group           p type 2
pair_style      helfrich
pair_coeff      1 1 20.0 0.0
timestep        {dt}
{motion}
compute         s p hd/surface/atom b
dump            1 p custom {steps} x.dump id c_s[13] c_s[14] c_s[15] c_s[16]
dump_modify     1 format float %.17g
thermo          {steps}
run             {steps}
"""
ELLIPSOID = "create_membrane 1 sphere 2 2.0 scale 1.6 1 1"
a, kp, c0p, kc = 0.15, 40.0, 1.6, 20.0
COUPLING = f"footprint 2 {a} {kp} {c0p} 0.9"
run(FROZEN.format(create=ELLIPSOID, n=5 * N, dt=0.01, steps=1,    # weighted, few of them count
                  motion=f"fix 2 p nve/noforce\nfix b p hd/bind mem {COUPLING}"))
uniform = [row[1] for row in frames("x.dump")[-1]]
run(FROZEN.format(create=ELLIPSOID, n=N, dt=0.02, steps=2000,
                  motion=f"""fix 2 p nve
fix 3 p langevin 1.0 1.0 0.4 5
velocity p create 1.0 77 loop all
fix b p hd/bind mem {COUPLING}"""))
found = [row[1] for row in frames("x.dump")[-1]]
weight = [math.exp(-a * (kp / 2 * (h - c0p)**2 - kc / 2 * h * h)) for h in uniform]


def mean_error(values, weights):
    total = sum(weights)
    mean = sum(w * v for v, w in zip(values, weights)) / total
    return mean, math.sqrt(sum((w * (v - mean))**2 for v, w in zip(values, weights))) / total


expected, de = mean_error(uniform, weight)
measured, dm = mean_error(found, [1.0] * len(found))
flat, _ = mean_error(uniform, [1.0] * len(uniform))
claim("sorting: the mean curvature of footprints is that of the Boltzmann distribution, within three errors",
      abs(measured - expected) < 3 * math.hypot(de, dm) and abs(measured - flat) > 10 * dm,
      f"{measured:.4f} +- {dm:.4f}, {expected:.4f} +- {de:.4f}; uniform {flat:.4f}")
middle = sorted(uniform)[len(uniform) // 2]
high = sum(h > middle for h in found) / sum(h <= middle for h in found)
high_expected = sum(w for h, w in zip(uniform, weight) if h > middle) / sum(w for h, w in zip(uniform, weight) if h <= middle)
def ratio_error(ratio, weights):
    """Of the sum of weights above the middle over that below."""
    parts = ([w for h, w in weights if h > middle], [w for h, w in weights if h <= middle])
    return ratio * math.sqrt(sum(sum(w * w for w in part) / sum(part)**2 for part in parts))


error = math.hypot(ratio_error(high, [(h, 1.0) for h in found]), ratio_error(high_expected, list(zip(uniform, weight))))
claim("    and the ratio of densities on its halves too", abs(high - high_expected) < 3 * error,
      f"{high:.3f} {high_expected:.3f} +- {error:.3f}")

# === Alignment on a frozen torus, by the energy of the angle; the director goes round at one place

TORUS = "create_membrane 1 torus 40 16 4.0 1.0"
k_par, c_par, a = 12.0, 1.0, 0.5
run(FROZEN.format(create=TORUS, n=N, dt=0.02, steps=400,
                  motion=f"fix 2 p nve/noforce\nfix b p hd/bind mem bar 2 {a} {k_par} {c_par} 0 0 0.8 rotate 1.0 0.5 3")
    .replace("id c_s[13]", "id c_s[13] c_s[5]").replace("id c_s[13] c_s[5]", "id c_s[13]")
    .replace("c_s[14] c_s[15] c_s[16]", "x y z c_s[14] c_s[15] c_s[16]"))
along, expected = [], []
for _, h, x, y, z, tx, ty, tz in frames("x.dump")[-1]:
    rho = math.hypot(x, y)
    around = (-y / rho, x / rho, 0.0)    # the long way, with the curvature cos(theta)/rho; the other has 1
    c = tx * around[0] + ty * around[1]
    along.append(1 - 2 * c * c)           # cos of twice the angle from the short way
    small, big = h - 1.0, 1.0
    num = den = 0.0
    for k in range(180):
        phi = math.pi * (k + 0.5) / 180
        curvature = big * math.cos(phi)**2 + small * math.sin(phi)**2
        w = math.exp(-a * k_par / 2 * (curvature - c_par)**2)
        num += w * math.cos(2 * phi)
        den += w
    expected.append(num / den)
measured, dm = mean_error(along, [1.0] * len(along))
theory = sum(expected) / len(expected)
claim("directors on a tube: the mean of cos 2 phi is that of exp(-E/kT), within three errors and 2 %",
      abs(measured - theory) < 3 * dm + 0.02 * theory, f"{measured:.4f} +- {dm:.4f}, {theory:.4f}")

finish()
