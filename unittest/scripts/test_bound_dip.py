"""A bound particle bends a tense sheet, by the curvature of its footprint or by a force: heights against linear theory,
doc/src/Derivation_footprint.rst. With moduli kc of membrane and footprint alike the energy is linear in the footprint's curvature,
and the height at r from the particle, over the mean, is that of a screened charge smeared over the footprint,

  h(r) = a c0/A sum_{q != 0} w(q) cos(q.r)/(q^2 + sigma/kc),  w(q) = 384 J_4(q rho)/(q rho)^4,

or under a force f  h(r) = f/A sum_{q != 0} cos(q.r)/(kc q^4 + sigma q^2)."""
# cost: 10

import math

from lammps_claims import claim, finish, run, thermo
from membrane_scenes import read_dump

N, KC, AREA, RHO, K = 24, 20.0, 3.0, 3.0, 50.0
HEIGHT = N * math.sqrt(3) / 2

SHEET = f"""
units           lj
atom_style      membrane_cp
region          box block 0 {N} 0 {HEIGHT:.17g} -6 6
create_box      3 box angle/types 1
create_membrane 1 plane {N} {N}
set             type 1 mass 1.0
create_atoms    2 single {N / 2 + 0.21} {HEIGHT / 2 + 0.13} 0
create_atoms    3 single {N / 2 + 2.21} {HEIGHT / 2 + 0.13} 0
create_atoms    3 single {N / 2 + 0.21} {HEIGHT / 2 + 4.13} 0
create_atoms    3 single {N / 2 - 7.79} {HEIGHT / 2 + 6.13} 0
set             type 2*3 mass 1.0
group           mem type 1
group           protein type 2
group           p type 2 3
pair_style      hybrid/overlay helfrich zero 1.0
pair_coeff      1 1 helfrich {KC} 0.0 tension {{sigma}} regularize 1
pair_coeff      * * zero
neighbor        0.3 bin
fix             b p hd/bind mem hold spring {K} {{words}}
variable        points equal count(mem)
{{pull}}
compute         z all reduce ave z
thermo_style    custom step pe f_b f_b[4]
thermo_modify   norm no
thermo          1000
min_style       membrane
min_modify      dmax 0.1
minimize        0 1e-9 3000 30000
write_dump      all custom x.dump id type x y z modify format float %.17g
"""


def bessel4(x):
    """J_4(x), by its integral: exact to rounding for this many points while x is less than half of them."""
    n = 400
    return sum(math.cos(4 * t - x * math.sin(t)) for t in (math.pi * (k + 0.5) / n for k in range(n))) / n


def waves(most):
    for m in range(-most, most + 1):
        for n in range(-most, most + 1):
            if m or n:
                yield 2 * math.pi * m / N, 2 * math.pi * n / HEIGHT


def of_footprint(c0, sigma):
    """Amplitudes by wave vector."""
    return {q: AREA * c0 / (N * HEIGHT) * 384 * bessel4(math.hypot(*q) * RHO) / (math.hypot(*q) * RHO)**4 /
            (q[0]**2 + q[1]**2 + sigma / KC) for q in waves(20)}


def of_force(f, sigma):
    return {q: f / (N * HEIGHT) / (KC * (q[0]**2 + q[1]**2)**2 + sigma * (q[0]**2 + q[1]**2)) for q in waves(60)}


def height(amplitudes, dx, dy):
    return sum(h * math.cos(q[0] * dx + q[1] * dy) for q, h in amplitudes.items())


def heights(sigma, words, pull=""):
    """Of the particle and of tracers, over the mean: (dx, dy, z) each, the particle first."""
    rows = thermo(run(SHEET.format(sigma=sigma, words=words, pull=pull)))
    atoms = read_dump("x.dump")[-1]
    mean = [row[3] for row in atoms.values() if row[0] == 1]
    mean = sum(mean) / len(mean)
    x = next(row for row in atoms.values() if row[0] == 2)
    found = [(row[1] - x[1], row[2] - x[2], row[3] - mean) for row in atoms.values() if row[0] > 1]
    return sorted(found, key=lambda place: math.hypot(*place[:2])), rows[-1]["PotEng"]


C0, F = 0.02, 0.2
for sigma in (2.0, 20.0):
    found, _ = heights(sigma, f"footprint 2 {AREA} {KC} {C0} {RHO}")
    theory = [height(of_footprint(C0, sigma), dx, dy) for dx, dy, _ in found]
    off = [abs(z - h) / theory[0] for (_, _, z), h in zip(found, theory)]
    claim(f"tension {sigma:g}: the bump of a footprint is that of linear theory within 0.3 %, at four distances", max(off) < 3e-3,
          " ".join(f"{math.hypot(*place[:2]):.2f}: {place[2]:.6f} {h:.6f};" for place, h in zip(found, theory)))

    found, _ = heights(sigma, "", f"fix f protein addforce 0 0 {F}\nfix g mem addforce 0 0 $(-{F}/v_points)\n"
                       "fix_modify f energy yes\nfix_modify g energy yes")
    found[0] = (0.0, 0.0, found[0][2] - F / K)    # where it would be without the spring's give
    theory = [height(of_force(F, sigma), dx, dy) for dx, dy, _ in found]
    # a limit surface with edges of 1 gives way to a point by a little less, whatever the tension

    off = [abs(z - h) * KC / F for (_, _, z), h in zip(found, theory)]
    claim("    and so is the height to which a force pulls a particle, within 0.003 f edge^2/kc", max(off) < 3e-3,
          " ".join(f"{math.hypot(*place[:2]):.2f}: {place[2]:.6f} {h:.6f};" for place, h in zip(found, theory)))

finish()
