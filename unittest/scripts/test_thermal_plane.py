"""A sheet without tension at the temperature of a bilayer, kc = 20 kT, where without the measure of the mesh it crumples.

    MEMBRANE_LONG=1    many more steps, three sizes, three temperatures, with and without tension
"""
# cost: 30
# timeout: 14400

import math

from lammps_claims import LONG, claim, error_of, finish, run, thermo
from mode_statistics import averages, mean_and_error

BLOCKS, NMAX = 20, 4
FIX = "hd/langevin {kT} {kT} 1.5 4711 mass sampling"


def steepness(size, kT, tension):
    """<(grad h)^2> of a sheet: the sum over its waves, up to a wave vector that differences of sizes do not depend on"""
    lx, ly, top = 12.0 * size, 7.0 * size * math.sqrt(3), 3.0
    total = 0.0
    for nx in range(-int(top * lx / 6), int(top * lx / 6) + 1):
        for ny in range(-int(top * ly / 6), int(top * ly / 6) + 1):
            q2 = (2 * math.pi * nx / lx) ** 2 + (2 * math.pi * ny / ly) ** 2
            if 0 < q2 < top ** 2:
                total += kT / (lx * ly) / (q2 + tension)
    return total


def steeper(size, kT, tension):
    """What waves of this sheet that the smallest has not do to the powers of all (Derivation_measure.rst): kc is
    1 - 3/2 <(grad h)^2> of itself, one-loop order"""
    return 1.5 * (steepness(size, kT, tension) - steepness(1, kT, tension))


def sheet(size, steps, kT=0.05, dt=0.35, tension=0.0, fix=FIX, start=run):
    """{|q h|: blocks of the power over theory, kT/[A (kc q^4 + tension q^2)] and steeper()} of waves up to qh = 1, rows
    of thermo"""
    lx, ly = 12.0 * size, 7.0 * size * math.sqrt(3)
    per = steps // BLOCKS // 2 * 2
    output = start(f"""
units           lj
atom_style      membrane_cp
region          box block 0 {lx} 0 {ly!r} {-10 * size} {10 * size}
create_box      1 box angle/types 1
create_membrane 1 plane {12 * size} {14 * size} mass {math.sqrt(0.75)!r}
special_bonds   lj/coul 1 1 1
pair_style      helfrich
pair_coeff      1 1 1.0 0.0 regularize 1.0 conformal tension {tension}
compute         m all hd/modes plane {NMAX}
compute         s all membrane/shape
compute         p all pressure NULL virial
fix             1 all {fix.format(kT=kT)}
timestep        {dt}
fix             b all ave/time 2 {per // 2} {per} c_p[1] c_p[2]
thermo_style    custom step pe c_s[1] c_s[9] f_b[1] f_b[2]
thermo          {per}
run             {per}
fix             a all ave/time 2 {per // 2} {per} c_m[6] mode vector file power.txt
run             {BLOCKS * per}
""", timeout=14400)
    if start is not run:
        return output
    members, theirs = {}, 1 + steeper(size, kT, tension)
    waves = [(0, ny) for ny in range(1, NMAX + 1)] + \
        [(nx, ny) for nx in range(1, NMAX + 1) for ny in range(-NMAX, NMAX + 1)]
    for i, (nx, ny) in enumerate(waves):
        q = math.hypot(2 * math.pi * nx / lx, 2 * math.pi * ny / ly)
        if q <= 1.0:
            members.setdefault(round(q, 3), []).append((i, kT / (lx * ly) / (q ** 4 + tension * q ** 2) * theirs))
    blocks = averages("power.txt")
    return {q: [sum(block[i] / power for i, power in rows) / len(rows) for block in blocks]
            for q, rows in sorted(members.items())}, thermo(output)[-BLOCKS:]


def claims(text, ratios, precision):
    spectrum = {q: mean_and_error(blocks) for q, blocks in ratios.items()}
    words = "  ".join(f"{q}: {mean:.3f}({1000 * error:.0f})" for q, (mean, error) in spectrum.items())
    claim(f"{text}: powers up to qh = 1 are those of theory to 2 % and three standard errors",
          all(abs(mean - 1) < 0.02 + 3 * error for mean, error in spectrum.values()), words)
    weight = sum(error ** -2 for _, error in spectrum.values())
    mean = sum(mean / error ** 2 for mean, error in spectrum.values()) / weight
    claim(f"{text}: and all together to 2 %", abs(mean - 1) < 0.02 + 2 * weight ** -0.5 < 0.02 + 2 * precision,
          f"{mean:.4f} +- {weight ** -0.5:.4f}")
    return mean, weight ** -0.5


# === A uniform shear of the mesh, which undulations make in a box of fixed shape, is none of a fluid

SHEAR = """
units           lj
atom_style      membrane_cp
region          box block 0 12 0 12.124355652982141 -9 9
create_box      1 box angle/types 1
create_membrane 1 plane 12 14 mass 1.0
displace_atoms  all random 0.01 0.01 0.01 4711 units box
special_bonds   lj/coul 1 1 1
pair_style      helfrich
pair_coeff      1 1 0.0 0.0 regularize 1.0 {kind}
compute         e all pair helfrich
thermo_style    custom step c_e[7]
thermo_modify   norm no format float %.15g
run             0
change_box      all x scale 1.05 y scale {y!r} remap units box
run             0
"""
costs = {}
for kind in ("", "conformal"):
    for ranks in (1, 2):
        before, after = (row["c_e[7]"] for row in thermo(run(SHEAR.format(kind=kind, y=1 / 1.05), ranks=ranks)))
        costs[kind, ranks] = after - before
expected = 0.5 * (2 * math.log(1.05)) ** 2 * 2 * 168
claim("without conformal the mesh of a sheet resists uniform shear", abs(costs["", 1] / expected - 1) < 0.1,
      f"{costs['', 1]:.3f}, expected {expected:.3f}")
claim("with conformal it does not, but for the tenth that is as without it",
      abs(costs["conformal", 1] / costs["", 1] - 0.1) < 0.02, f"{costs['conformal', 1]:.4f}")
claim("on two ranks likewise", abs(costs["conformal", 2] / costs["conformal", 1] - 1) < 1e-8)

# === Spectra

ratios, rows = sheet(2, 40000 if LONG else 4200)
claims("672 points", ratios, 0.01)

# what holds the frame: the virial, and the kinetic energy of equilibrium. That of the energy is zero, and the measure takes
# out 3/2 kT N/A

KT, AREA, HEIGHT = 0.05, 12 * 2 * 14 * math.sqrt(3), 40.0
tensions = [-0.5 * (row["f_b[1]"] + row["f_b[2]"]) * HEIGHT - 672 * KT / AREA for row in rows]
mean, error = mean_and_error(tensions)
gas = 1.5 * KT * 672 / AREA
claim("the frame of a sheet without tension has next to none, where the measure takes out that of a gas",
      abs(mean) < 0.03 * gas + 3 * error, f"{mean:.5f}({error:.5f}) of {gas:.4f}")
claim("faces stay in shape", min(row["c_s[9]"] for row in rows) > 15, min(row["c_s[9]"] for row in rows))

ratios, _ = sheet(1, 20000 if LONG else 12000, tension=0.5)
claims("168 points with tension 0.5", ratios, 0.012)

message = sheet(2, 6000, fix=FIX + " measure no", start=error_of)
claim("without the measure the same sheet crumples, and the run stops", "moved further" in message or
      "lost its shape" in message or "collapse" in message or "would have torn the mesh" in message, message[:100])

if LONG:
    bare = {}
    for size, steps in ((1, 40000), (2, 40000), (4, 20000)):
        for inverse in (10, 20, 50):
            for tension in (0.0, 0.5):
                few = size == 1 and inverse == 10 and tension == 0.0    # waves, for the growth below
                ratios, _ = sheet(size, steps * 4 if few else steps, kT=1 / inverse, dt=0.35 if inverse > 10 else 0.25,
                                  tension=tension)
                mean, error = claims(f"{168 * size ** 2} points, kc = {inverse} kT, tension {tension}", ratios, 0.01)
                factor = 1 + steeper(size, 1 / inverse, tension)
                bare[size, inverse, tension] = mean * factor, error * factor
    (large, error), (small, too) = bare[4, 10, 0.0], bare[1, 10, 0.0]
    error, expected = math.hypot(error, too), 3 / (4 * math.pi * 10) * math.log(4)
    claim("at kc = 10 kT powers over kT/(A kc q^4) grow with the sheet as 3 kT/(4 pi kc) ln L",
          abs(large - small - expected) < 3 * error < 0.02, f"{large - small:.4f} +- {error:.4f}, expected {expected:.4f}")

finish()
