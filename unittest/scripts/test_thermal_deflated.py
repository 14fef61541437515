"""A vesicle of reduced volume 0.65 at kc = 20 kT, where shapes go from oblate to prolate: mass sampling gives the averages and
fluctuations that mass lumped does. The integral of H and the radius of gyration of the surface tell these shapes apart;
that of control points would also tell how they are spread over the surface, which is slow and no property of a membrane.

    MEMBRANE_LONG=1    twenty times the steps
"""
# cost: 50
# timeout: 7200

import math

from lammps_claims import LONG, claim, finish, run
from mode_statistics import mean_and_error

BLOCKS = 40
NAMES = ("integral of H", "radius of gyration", "area", "volume", "reduced volume", "bending energy")


def vesicle(fix, dt, steps, every, equilibrate):
    """{quantity: (blocks of its mean, blocks of its variance)}, what was printed"""
    output = run(f"""
units           lj
atom_style      membrane_cp
region          box block -4 4 -4 4 -4 4
create_box      1 box angle/types 1
create_membrane 1 sphere 2 1.0 scale 0.6 0.6 2.0 mass {4 * math.pi / 162!r}
special_bonds   lj/coul 1 1 1
pair_style      helfrich
pair_coeff      1 1 1.0 0.0 area 200 {4 * math.pi!r} volume 200 {0.578 * 4 * math.pi / 3!r} regularize 1.0 conformal
min_style       membrane
minimize        0 1e-4 500 5000
compute         s all membrane/shape
compute         e all pair helfrich
fix             1 all {fix}
timestep        {dt}
thermo          1000000
run             {equilibrate}
reset_timestep  0
fix             a all ave/time {every} 1 {every} c_s[4] c_s[14] c_s[1] c_s[2] c_s[3] c_e[1] file series.txt format " %.12g"
run             {steps}
""", timeout=7200)
    rows = [list(map(float, line.split()))[1:] for line in open("series.txt") if not line.startswith("#")]
    length = len(rows) // BLOCKS
    result = {}
    for name, series in zip(NAMES, zip(*rows)):
        middle = sum(series) / len(series)
        blocks = [series[i * length:(i + 1) * length] for i in range(BLOCKS)]
        result[name] = ([sum(block) / length for block in blocks],
                        [sum((x - middle) ** 2 for x in block) / length for block in blocks])
    return result, output


def mean_and_largest_error(blocks):
    """Errors from so few blocks scatter, and those of variances are small where these are: the largest of blocks one by one,
    in twos and in fours."""
    grouped = [[sum(blocks[i:i + k]) / k for i in range(0, len(blocks), k)] for k in (1, 2, 4)]
    return mean_and_error(blocks)[0], max(mean_and_error(group)[1] for group in grouped)


def compare(one, other):
    for name in NAMES:
        for kind, a, b in zip(("mean", "variance"), one[name], other[name]):
            (a, da), (b, db) = mean_and_largest_error(a), mean_and_largest_error(b)
            claim(f"mass sampling and lumped agree: {kind} of the {name}", abs(a - b) < 3.5 * math.hypot(da, db),
                  f"{a:.5g}({da:.1g}) {b:.5g}({db:.1g})")


SCALE = 20 if LONG else 1
lumped, _ = vesicle("hd/langevin 0.05 0.05 0.5 4711 mass lumped", 0.009, 40000 * SCALE, 10, 4000)
sampling, output = vesicle("hd/langevin 0.05 0.05 3.0 4712 mass sampling", 0.3, 22000 * SCALE, 5, 1000)
compare(sampling, lumped)
v, error = mean_and_error(sampling["reduced volume"][0])
claim("the reduced volume is 0.65", abs(v - 0.65) < 0.01, f"{v:.4f}({error:.4f})")
curvature, error = mean_and_error(sampling["integral of H"][0])
spread, its_error = mean_and_error(sampling["integral of H"][1])
claim("the run is long enough to tell: the integral of H to 0.3 % and its variance to a third",
      error < 0.003 * curvature and its_error < spread / 3, f"{curvature:.4f}({error:.4f}), variance {spread:.2e}({its_error:.1e})")
print("       the reference was taken anew", output.count("taken anew"), "times")

finish()
