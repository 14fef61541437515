"""A vesicle at the temperature of a bilayer, kc = 20 kT: undulations, pressure and averages.

    MEMBRANE_LONG=1    many more steps, three sizes, three temperatures, with and without tension; mass lumped and vertex,
                       too, of which the first is compared otherwise in test_thermal_deflated.py

All with regularize conformal, which costs no undulation anything; with plain regularize of modulus KR a sphere has the
tension s = 1.1 KR/kc besides (doc/src/pair_helfrich.rst). Theory is that of Milner and Safran for a continuous sphere,
<u_lm^2> = kT/[kc (l-1)(l+2)(l(l+1) + s)], harmonic but for what fluctuations do to kc: all powers grow with the number
N of points as (3/8 pi) kT/kc ln N (doc/src/Derivation_measure.rst), from 642 on to 2,562 by 1.7 % at kc = 10 kT.
162 points are too few for theory beyond l = 4.
"""
# cost: 40
# timeout: 14400

import math

from lammps_claims import LONG, claim, finish, run
from mode_statistics import averages, mean_and_error

BLOCKS = 20
SAMPLING = "hd/langevin {kT} {kT} 1.5 4711 mass sampling"


def vesicle(fix, steps, level=3, kT=0.05, dt=0.35, lmax=8, terms="", equilibrate=400, every=2, shape="", modulus="1.0"):
    """Blocks of <u_lm^2>/kT by l, and blocks of bending energy, area, reduced volume and pressure on the volume."""
    per, points = steps // BLOCKS // every * every, 10 * 4 ** level + 2
    volume = 4 * math.pi / 3
    run(f"""
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
create_box      1 box angle/types 1
create_membrane 1 sphere {level} 1.0 interpolate yes mass {4 * math.pi / points!r}
{shape}
special_bonds   lj/coul 1 1 1
pair_style      helfrich
pair_coeff      1 1 1.0 0.0 volume 1000.0 {volume!r} regularize {modulus} conformal {terms}
compute         m all hd/modes sphere {lmax}
compute         e all pair helfrich
compute         s all membrane/shape
variable        p equal 1000*(c_s[2]/{volume!r}-1)
fix             1 all {fix.format(kT=kT)}
timestep        {dt}
thermo          100000
run             {equilibrate}
reset_timestep  0
fix             a all ave/time {every} {per // every} {per} c_m[6] mode vector file power.txt
fix             b all ave/time {every} {per // every} {per} c_e[1] c_s[1] c_s[3] v_p file rest.txt
run             {BLOCKS * per}
""", timeout=14400)
    power = {l: [sum(block[l * l:(l + 1) ** 2]) / (2 * l + 1) / kT for block in averages("power.txt")]
             for l in range(2, lmax + 1)}
    rows = [list(map(float, line.split()))[1:] for line in open("rest.txt") if not line.startswith("#")]
    return power, dict(zip(("bending", "area", "reduced volume", "pressure"), zip(*rows)))


def theory(l, s=0.0):
    return 1 / ((l - 1) * (l + 2) * (l * (l + 1) + s))


def compare_with_theory(text, power, precision, s=0.0, growth=1.0, highest=8):
    """Within 2 % of theory, or what errors of this run allow: three standard errors of each."""
    ratios = {l: mean_and_error([p / (growth * theory(l, s)) for p in blocks]) for l, blocks in power.items() if l <= highest}
    words = "  ".join(f"{l}: {mean:.3f}({1000 * error:.0f})" for l, (mean, error) in ratios.items())
    claim(f"{text}: powers of l = 2 to {highest} are those of theory to 2 % and three standard errors",
          all(abs(mean - 1) < 0.02 + 3 * error for mean, error in ratios.values()), words)
    weight = sum(error ** -2 for _, error in ratios.values())
    mean = sum(mean / error ** 2 for mean, error in ratios.values()) / weight
    claim(f"{text}: and all together to 2 %", abs(mean - 1) < 0.02 + 2 * weight ** -0.5 < 0.02 + 2 * precision,
          f"{mean:.4f} +- {weight ** -0.5:.4f}")


def compare(text, one, other):
    """Means of two runs within 3.5 standard errors of each other."""
    for key in one:
        (a, da), (b, db) = mean_and_error(one[key]), mean_and_error(other[key])
        claim(f"{text}: {key}", abs(a - b) < 3.5 * math.hypot(da, db), f"{a:.5f}({da:.5f}) {b:.5f}({db:.5f})")


def means(power, rest):
    """What two ways of sampling must agree on."""
    return {**{f"l = {l}": power[l] for l in (2, 3, 4)}, **{k: rest[k] for k in ("bending", "area", "reduced volume")}}



# === With the measure and without it, 642 points

power, rest = vesicle(SAMPLING, 40000 if LONG else 3200)
compare_with_theory("642 points", power, 0.01)
pressure, error = mean_and_error(rest["pressure"])
claim("the volume needs next to no pressure: 6 kT/(3 V), as the virial theorem says",
      abs(pressure - 0.1 / (4 * math.pi / 3)) < 4 * error, f"{pressure:.3f}({error:.3f})")

power, rest = vesicle(SAMPLING + " measure no", 20000 if LONG else 2800)
off = {l: mean_and_error([p / theory(l) for p in power[l]]) for l in (3, 4, 5)}
claim("without the measure powers of l = 3, 4, 5 are 24, 17 and 13 % too high, to first order",
      all(mean - 3 * error > 1.08 for mean, error in off.values()) and off[3][0] > 1.15,
      " ".join(f"{mean:.3f}({1000 * error:.0f})" for mean, error in off.values()))
pressure, error = mean_and_error(rest["pressure"])
claim("and control points press as an ideal gas, 3 N kT/(3 V)",
      abs(pressure - 642 * 0.05 / (4 * math.pi / 3)) < 4 * error + 0.1, f"{pressure:.3f}({error:.3f})")

# === Other ways to the same averages, 162 points

LENGTH = 40000 if LONG else 4500
coarse = means(*vesicle(SAMPLING, LENGTH, level=2))
compare("hd/langevin and hd/brownian with mass sampling agree", coarse,
        means(*vesicle("hd/brownian {kT} 4713 mass sampling", LENGTH, level=2, dt=0.2)))

if LONG:
    for level, steps in ((3, 40000), (4, 20000)):
        for inverse in (10, 20, 50):
            for s, terms in ((0.0, ""), (2.0, "tension 2.0")):
                power, _ = vesicle(SAMPLING, steps, level=level, kT=1 / inverse, dt=0.35 if inverse > 10 else 0.25, terms=terms)
                growth = 1 + 3 / (4 * math.pi * inverse) * math.log(2 ** (level - 3))    # beyond 642 points
                compare_with_theory(f"{10 * 4 ** level + 2} points, kc = {inverse} kT, s = {s}", power, 0.008, s, growth)
    for level, steps in ((3, 100000), (4, 60000)):    # the longest timestep, which has an error with less friction
        power, _ = vesicle(SAMPLING.replace("1.5", "1"), steps, level=level, dt=0.8)
        compare_with_theory(f"{10 * 4 ** level + 2} points, timestep 0.8, damp 1", power, 0.004, 0.0,
                            1 + 3 / (4 * math.pi * 20) * math.log(2 ** (level - 3)))
    for modulus in ("0.5", "2.0"):
        other = means(*vesicle(SAMPLING, LENGTH, level=2, dt=0.3, modulus=modulus))
        bending = [mean_and_error(scene["bending"])[0] for scene in (coarse, other)]
        compare(f"regularize {modulus} in place of 1", {key: coarse[key] for key in coarse if key != "bending"}, other)
        # most of it is that of waves at the limit of the mesh, which are not free of what keeps faces in shape
        claim(f"regularize {modulus} in place of 1: bending to 1 %", abs(bending[1] / bending[0] - 1) < 0.01, bending)
    for mass, dt, equilibrate in (("lumped", 0.008, 4000), ("vertex", 0.003, 8000)):
        slow = vesicle(f"hd/langevin {{kT}} {{kT}} 0.1 4712 mass {mass}", 400000, level=2, dt=dt, every=10, equilibrate=equilibrate)
        compare(f"mass sampling and {mass} agree", coarse, means(*slow))

finish()
