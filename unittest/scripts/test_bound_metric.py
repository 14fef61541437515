"""Where heavy bound particles are found on a fluctuating membrane: uniform in area on springs and, with the correction,
rigid; without it in proportion to sqrt(det(1 + m S)) = exp(F/kT). The mean of F, with MEMBRANE_LONG=1."""
# cost: 1

import math

from lammps_claims import LONG, claim, finish, run, skip

if not LONG:
    skip("long statistics only")

SCENE = """
units           lj
atom_style      membrane_cp
region          box block -8 8 -8 8 -8 8
create_box      2 box angle/types 1
create_membrane 1 sphere 1 3.5 interpolate yes
group           mem type 1
create_bound    10 2 mem 4711 mass 10
group           p type 2
special_bonds   lj/coul 1 1 1
pair_style      helfrich
pair_coeff      1 1 20.0 0.0 volume 10 init regularize 10 conformal
timestep        0.04
fix             1 mem hd/langevin 1.0 1.0 2.0 {seed} mass lumped
fix             2 p nve
fix             3 p langevin 1.0 1.0 10.0 {seed}
fix             b p hd/bind mem leaflet out hold {hold}
hd_velocity     mem 1.0 12
velocity        p create 1.0 99 loop all
thermo          0
run             2000 post no
variable        i loop {n}
label           again
run             100 post no
unfix           b
fix             b p hd/bind mem leaflet out hold rigid correct yes
run             0 post no
print           "$(f_b)" append F.dat screen no
unfix           b
fix             b p hd/bind mem leaflet out hold {hold}
next            i
jump            SELF again
"""


def samples(hold, seed, n=1500):
    open("F.dat", "w").close()
    run(SCENE.format(hold=hold, seed=seed, n=n), timeout=6000)
    return [float(line) for line in open("F.dat")]


def mean(values, blocks=25):
    size = len(values) // blocks
    means = [sum(values[i * size:(i + 1) * size]) / size for i in range(blocks)]
    average = sum(means) / blocks
    return average, math.sqrt(sum((x - average)**2 for x in means) / blocks / (blocks - 1))


spring = samples("spring auto", 13)
a, da = mean(spring)
weights = [math.exp(f - a) for f in spring]
predicted = sum(w * f for w, f in zip(weights, spring)) / sum(weights)
b, db = mean(samples("rigid correct yes", 12))
c, dc = mean(samples("rigid correct no", 11))
claim("rigid with correction is as uniform as springs, within three errors", abs(b - a) < 3 * math.hypot(da, db),
      f"{b:.4f} +- {db:.4f}, {a:.4f} +- {da:.4f}")
claim("without it, in proportion to sqrt(det(1 + m S)), within three errors", abs(c - predicted) < 3 * math.hypot(da, dc),
      f"{c:.4f} +- {dc:.4f}, {predicted:.4f}")
claim("    which is not uniform", c - a > 3 * math.hypot(da, dc), f"{c - a:.4f} +- {math.hypot(da, dc):.4f}")
finish()
