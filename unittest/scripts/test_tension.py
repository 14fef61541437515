"""Fix hd/tension: a box that breathes has the distribution that its tension and pressure say.

    MEMBRANE_LONG=1    more samples, a larger sheet, and 1,000,000 steps

An ideal gas and particles on a flat sheet have distributions in closed form; an undulating sheet is compared with the sum
over the waves of its mesh, each as stiff as LAMMPS finds it (doc/src/Derivation_tension.rst).
"""
# cost: 40
# timeout: 14400

import math

from lammps_claims import LONG, claim, finish, run, thermo
from mode_statistics import mean_and_error


def rows_of(path):
    return [list(map(float, line.split()))[1:] for line in open(path) if not line.startswith("#")]


def blocks_of(series, count=20):
    length = len(series) // count
    return [sum(series[i * length:(i + 1) * length]) / length for i in range(count)]


def moments(series):
    """Mean and variance with their errors."""
    mean, error = mean_and_error(blocks_of(series))
    return mean, error, *mean_and_error(blocks_of([(x - mean) ** 2 for x in series]))


def gamma_claims(text, series, shape, scale):
    """Of a density in proportion to x^(shape - 1) exp(-x/scale)."""
    mean, error, variance, scatter = moments(series)
    claim(f"{text}: the mean is that of theory", abs(mean - shape * scale) < 3 * error < 0.06 * shape * scale,
          f"{mean:.2f} +- {error:.2f}, theory {shape * scale:.2f}")
    claim("    and the variance", abs(variance - shape * scale ** 2) < 3 * scatter < 0.3 * shape * scale ** 2,
          f"{variance:.1f} +- {scatter:.1f}, theory {shape * scale ** 2:.1f}")


def kolmogorov_smirnov(a, b):
    """The largest difference of two distributions, in units of what 1 % of pairs of equal ones exceed."""
    everything = sorted([(x, 0) for x in a] + [(x, 1) for x in b])
    below, most = [0, 0], 0.0
    for x, which in everything:
        below[which] += 1
        most = max(most, abs(below[0] / len(a) - below[1] / len(b)))
    return most / (1.628 * math.sqrt(1 / len(a) + 1 / len(b)))


# === N atoms alone: P(V) in proportion to V^N exp(-PV/kT), so <V> = (N + 1) kT/P

N, PRESSURE = 20, 0.02
GAS = """
units           lj
atom_style      atomic
region          b {region}
create_box      1 b
create_atoms    1 random {n} 1234 NULL
mass            1 1.0
pair_style      none
comm_modify     cutoff 2.0
velocity        all create 1.0 87 dist gaussian loop geom
fix             1 all nve
fix             2 all langevin 1.0 1.0 1.0 {seed}
fix             t all hd/tension 2 1.0 {seed} {words} pressure {pressure} attempts 4
variable        v equal vol
fix             a all ave/time 10 1 10 v_v file volume.txt
timestep        0.02
thermo_style    custom step temp vol f_t[*]
thermo_modify   norm no format float %.15g
thermo          1000
run             {steps}
"""
STEPS = 200000 if LONG else 30000
gas = {}
for words in ("xyz momenta keep", "xyz momenta scale", "xy"):
    for ranks in (1,) if words != "xy" else (2,):
        output = run(GAS.format(n=N, pressure=PRESSURE, words=words, seed=4711 + len(words), steps=STEPS,
                                region="block 0 10 0 10 0 10"), ranks=ranks, timeout=14400)
        gas[words] = [row[0] for row in rows_of("volume.txt")][100:]
        gamma_claims(f"gas of {N} atoms, {words}, {ranks} ranks", gas[words], N + 1, 1 / PRESSURE)
rows = thermo(output)
claim("the fix has the mean volume and its error", abs(rows[-1]["f_t[9]"] - (N + 1) / PRESSURE) < 4 * rows[-1]["f_t[10]"] < 100,
      f"{rows[-1]['f_t[9]']:.1f} +- {rows[-1]['f_t[10]']:.1f}")
claim("momenta do not count: the temperature of the gas is that of its bath",
      abs(sum(row["Temp"] for row in rows[1:]) / (len(rows) - 1) - 1) < 0.12 if not LONG else True)
few = [series[::15] for series in (gas["xyz momenta keep"], gas["xyz momenta scale"])]
ratio = kolmogorov_smirnov(*few)
claim("momenta scale and keep give one distribution (Kolmogorov and Smirnov)", ratio < 1.0,
      f"{ratio:.2f} of the 1 % limit, {len(few[0])} samples each")
run(GAS.format(n=N, pressure=PRESSURE, words="xyz", seed=4711, steps=STEPS,
               region="prism 0 10 0 10 0 10 3 2 1"), timeout=14400)
gamma_claims("gas in a tilted box", [row[0] for row in rows_of("volume.txt")][100:], N + 1, 1 / PRESSURE)

# === N particles on a flat sheet that is not sampled itself: P(A) in proportion to A^N exp(SA/kT)

HELD = """
units           lj
atom_style      membrane_cp
region          box block 0 6 0 6.928203230275509 -6 6
create_box      2 box angle/types 1
create_membrane 1 plane 6 8 mass 1.0
group           mem type 1
create_bound    {n} 2 mem 31 mass 1.0
group           p type 2
comm_modify     cutoff 5.0
special_bonds   lj/coul 1 1 1
pair_style      helfrich
pair_coeff      1 1 1.0 0.0
{motion}
fix             t all hd/tension 2 1.0 {seed} {words} tension {tension} attempts 5
variable        a equal lx*ly
fix             a all ave/time 2 1 2 v_a file area.txt
timestep        {dt}
thermo          1000
run             {steps}
"""
COUNT, TENSION = 40, -1.0
STEPS = 60000 if LONG else 8000
LANGEVIN = "fix 2 p nve\nfix 3 p langevin 1.0 1.0 0.5 11\nfix b p hd/bind mem height 0.3 hold "
BROWNIAN = "fix b p hd/bind mem height 0.3 brownian 1.0 1.0 12 hold "
for seed, (name, motion, words, dt) in enumerate((
        ("springs", LANGEVIN + "spring 500.0", "xy", 0.01),
        ("springs, momenta scale", LANGEVIN + "spring 500.0", "xy momenta scale", 0.01),
        ("rigid", LANGEVIN + "rigid correct no", "xy", 0.01), ("springs without inertia", BROWNIAN + "spring 200.0", "xy", 0.002))):
    run(HELD.format(n=COUNT, motion=motion, dt=dt, seed=17 + seed, words=words, tension=TENSION, steps=STEPS), timeout=14400)
    gamma_claims(f"{COUNT} particles on a sheet, {name}", [row[0] for row in rows_of("area.txt")][200:], COUNT + 1,
                 -1 / TENSION)

# === A sheet at kc = 20 kT and a tension of its frame

SHEET = """
units           lj
atom_style      membrane_cp
region          box block 0 {lx} 0 {ly!r} {low} {high}
create_box      1 box angle/types 1
create_membrane 1 plane {nx} {ny} mass {mass!r}
special_bonds   lj/coul 1 1 1
pair_style      helfrich
pair_coeff      1 1 1.0 0.0 regularize 1.0 conformal area {ka} {area!r}
"""
RUN = """
compute         m all hd/modes plane 3
compute         s all membrane/shape
compute         p all pressure NULL virial
variable        a equal lx*ly
variable        frame equal lz*(c_p[3]-0.5*(c_p[1]+c_p[2]))
fix             1 all {fix}
fix             t all hd/tension {every} {kT} 4711 {words} tension {tension}
timestep        {dt}
thermo_style    custom step temp pe c_s[1] c_s[9] v_a lx ly f_t[*]
thermo_modify   norm no format float %.15g
thermo          1000
run             {equilibrate}
reset_timestep  0
fix             a all ave/time 4 1 4 v_a c_s[1] v_frame file area.txt
run             {steps}
"""
KT, KA = 0.05, 5.0
SAMPLING = "hd/langevin {kT} {kT} 1.5 4711 mass sampling"


def scene(size):
    nx, ny = 12 * size, 14 * size
    lx, ly = float(nx), ny * math.sqrt(0.75)
    return dict(nx=nx, ny=ny, lx=lx, ly=ly, low=-10.0 * size, high=10.0 * size, mass=math.sqrt(0.75), ka=KA, area=lx * ly)


def waves(size):
    """Of each wave of the mesh but the mean height: bending energy and membrane area of amplitude 1, to second order."""
    box = scene(size)
    run(SHEET.format(**box) + "write_dump all custom flat.dump id x y z modify sort id format float %.17g\n")
    lines = open("flat.dump").read().splitlines()
    head, points = lines[:9], [line.split() for line in lines[9:]]
    amplitude, frames = 1e-3, []
    for n1 in range(box["nx"]):
        for n2 in range(box["ny"]):
            if (n1, n2) == (0, 0):
                continue
            frames.append([head[0], str(len(frames))] + head[2:])
            for tag, x, y, z in points:
                phase = 2 * math.pi * (n1 * float(x) / box["lx"] + n2 * float(y) / box["ly"])
                frames[-1].append(f"{tag} {x} {y} {amplitude * (math.cos(phase) + math.sin(phase))!r}")
    with open("waves.dump", "w") as file:
        file.write("\n".join("\n".join(frame) for frame in frames) + "\n")
    rows = thermo(run(SHEET.format(**box) + """
compute         e all pair helfrich
compute         s all membrane/shape
thermo_style    custom step c_e[1] c_s[1]
thermo_modify   norm no format float %.17g
thermo          1
rerun           waves.dump dump x y z
""", timeout=14400))
    return [(row["c_e[1]"] / amplitude ** 2, (row["c_s[1]"] - box["area"]) / amplitude ** 2) for row in rows]


def excess(stiffness, tension):
    """Mean and variance of the area of the sheet over that of its frame, by equipartition."""
    shares = [0.5 * KT * area / (energy + tension * area) for energy, area in stiffness]
    return sum(shares), 2 * sum(share * share for share in shares)


def breathe(size, tension, steps, fix=SAMPLING, dt=0.35, every=4, words="xy", **options):
    return run(SHEET.format(**scene(size)) +
               RUN.format(fix=fix.format(kT=KT), kT=KT, tension=tension, dt=dt, every=every, words=words, steps=steps,
                          equilibrate=1500 * size * size), timeout=14400, **options)


def sheet_claims(text, size, tension, stiffness, output):
    frame, membrane, virial = zip(*rows_of("area.txt"))
    area0 = scene(size)["area"]
    mean, error, variance, scatter = moments(membrane)
    expected = area0 * (1 + tension / KA * (1 - excess(stiffness, tension)[0] / area0))
    claim(f"{text}: the area of the membrane is A0 (1 + S/KA <A_f/A>)", abs(mean - expected) < 3 * error < 0.003 * area0,
          f"{mean:.3f} +- {error:.3f}, theory {expected:.3f}")
    claim("    and its variance kT A0/KA", abs(variance - KT * area0 / KA) < 3 * scatter < 0.6 * KT * area0 / KA,
          f"{variance:.3f} +- {scatter:.3f}, theory {KT * area0 / KA:.3f}")
    mean, error, variance, scatter = moments([m - f for f, m in zip(frame, membrane)])
    expected, spread = excess(stiffness, tension)
    claim("    the frame is smaller by the sum over waves, to 2 %", abs(mean - expected) < 3 * error + 0.02 * expected,
          f"{mean:.4f} +- {error:.4f}, theory {expected:.4f}")
    claim("    and the variance of the difference is theirs, to 5 %",
          abs(variance - spread) < 3 * scatter + 0.05 * spread, f"{variance:.4f} +- {scatter:.4f}, theory {spread:.4f}")
    mean, error, _, _ = moments(virial)
    claim("    the virial's tension of the frame is the one asked for", abs(mean - tension) < 3 * error < 0.3 * KT,
          f"{mean / KT:.3f} +- {error / KT:.3f} kT/h^2, asked for {tension / KT:.0f}")
    last = thermo(output)[-1]
    mean, error, variance, scatter = moments(frame)
    claim("    the fix has the mean area of the frame, its error and its variance",
          abs(last["f_t[6]"] - mean) < 3 * (error + last["f_t[7]"]) and 0.3 < last["f_t[7]"] / error < 3
          and abs(last["f_t[8]"] - variance) < 3 * scatter + 0.05 * variance,
          f"{last['f_t[6]']:.3f} +- {last['f_t[7]']:.3f} ({mean:.3f} +- {error:.3f})")
    claim("    acceptance is what was asked for, 0.4", abs(last["f_t[2]"] - 0.4) < 0.12, f"{last['f_t[2]']:.3f}")


stiffness = waves(1)
for tension in (0.0, KT) if LONG else (KT,):
    output = breathe(1, tension, 100000 if LONG else 10000)
    sheet_claims(f"168 points, frame tension {tension / KT:.0f} kT/h^2", 1, tension, stiffness, output)
breathe(1, 0.0, 4000, fix=SAMPLING + " measure no")
_, membrane, _ = zip(*rows_of("area.txt"))
mean, error, _, _ = moments(membrane)
area, gas = scene(1)["area"], 1.5 * 168 * KT / scene(1)["area"]
claim("without the measure the membrane is stretched by the tension of a gas of its points, 3/2 kT N/A, and not at rest",
      abs(mean / area - 1 - gas / KA) < 3 * error / area + 0.1 * gas / KA and mean > area + 10 * error,
      f"{mean:.3f} +- {error:.3f}, at rest {area:.3f}, stretched {area * (1 + gas / KA):.3f}")
output = breathe(1, 0.0, 100000 if LONG else 1500, words="x y")
ratios = [row["Lx"] / row["Ly"] * math.sqrt(0.75) * 14 / 12 for row in thermo(output)]
claim("x and y free of each other: a sheet without shear modulus may change its frame's shape, and does",
      max(ratios) - min(ratios) > 0.01, f"{min(ratios):.3f} to {max(ratios):.3f}")
if LONG:
    output = breathe(1, KT, 300000, fix="hd/langevin {kT} {kT} 20.0 4711 mass lumped", dt=0.05, words="xy momenta scale")
    sheet_claims("with momenta of the mesh, scaled", 1, KT, stiffness, output)
    stiffness = waves(2)
    for tension in (0.0, KT):
        sheet_claims(f"672 points, frame tension {tension / KT:.0f} kT/h^2", 2, tension, stiffness,
                     breathe(2, tension, 100000))
    rows = thermo(breathe(1, 0.0, 1000000))
    claim("1,000,000 steps: the frame stays in bounds", all(0.94 < row["v_a"] / scene(1)["area"] < 1.04 for row in rows),
          f"{min(row['v_a'] for row in rows):.1f} to {max(row['v_a'] for row in rows):.1f}")

finish()
