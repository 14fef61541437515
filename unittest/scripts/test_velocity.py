"""hd_velocity draws velocities from the thermal distribution of the mass matrix."""

import cmath
import math

from lammps_claims import claim, error_of, finish, run, thermo
from membrane_scenes import largest, read_dump

KT = 0.3
VELOCITIES = "write_dump all custom v.dump id x y z vx vy vz modify sort id format float %.17g append yes\n"
SETUP = """
units           {units}
atom_style      membrane_cp
region          box block {box}
create_box      1 box angle/types 1
create_membrane 1 {shape}
set             type 1 mass 2.0
pair_style      helfrich
pair_coeff      1 1 1.0 0.0
{fix}
compute         T all hd/temp
thermo_style    custom step c_T
thermo_modify   format float %.17g
"""
NX = 12
PLANE = dict(units="lj", box=f"0 {NX} 0 {NX * math.sqrt(3) / 2:.17g} -9 9", shape=f"plane {NX} {NX}")
SPHERE = dict(units="lj", box="-2 2 -2 2 -2 2", shape="sphere 3 1.0 center 1.7 1.7 0.3")


def scene(shape, fix="fix 1 all hd/nve"):
    return SETUP.format(**shape, fix=fix)


def draw(script, ranks=1):
    """Frames of {id: [x, y, z, vx, vy, vz]} that the script appends to v.dump, and its output."""
    open("v.dump", "w").close()
    output = run(script, ranks=ranks)
    return read_dump("v.dump"), output


# === Temperature

DRAWS = 20
for mass in ("vertex", "consistent", "lumped"):
    script = scene(SPHERE, f"fix 1 all hd/nve mass {mass}")
    for seed in range(1, DRAWS + 1):
        script += f"hd_velocity all {KT} {seed}\nrun 0 post no\n"
    found = [row["c_T"] for row in thermo(run(script))]
    mean = sum(found) / len(found)
    error = math.sqrt(2.0 / (3 * 642 - 3) / len(found))
    claim(f"mass {mass}: run 0 has the temperature within three standard errors, {3 * error:.2%}",
          len(found) == DRAWS and abs(mean / KT - 1) < 3 * error, f"{mean / KT - 1:+.3%}")
    scatter = math.sqrt(sum((t / mean - 1)**2 for t in found) / (len(found) - 1)) / math.sqrt(2.0 / 1923)
    claim(f"mass {mass}: it scatters as it should", 0.5 < scatter < 1.6, f"{scatter:.2f}")
    row = thermo(run(scene(SPHERE, f"fix 1 all hd/nve mass {mass}") +
                     f"hd_velocity all {KT} 1 scale yes\nrun 0\n"))[-1]
    claim(f"mass {mass}: scale yes makes the temperature exact", abs(row["c_T"] / KT - 1) < 1e-12)

for units, temperature in (("real", 300.0), ("metal", 300.0), ("nano", 300.0)):
    row = thermo(run(scene(dict(SPHERE, units=units)) +
                     f"hd_velocity all {temperature} 5 scale yes\nrun 0\nhd_velocity all 300 5\nrun 0\n"))
    claim(f"units {units}: temperature in kelvin",
          abs(row[-2]["c_T"] / temperature - 1) < 1e-10 and abs(row[-1]["c_T"] / temperature - 1) < 0.15,
          [r["c_T"] for r in row])

# === Equipartition: plane waves of equilateral triangles are the eigenvectors of the mass matrix

RINGS = {    # distance squared: entry of the row, per unit mass of a vertex
    "lumped": {0: 1.0},
    "consistent": {0: 1979 / 7560, 1: 18871 / 181440, 3: 85 / 6048, 4: 31 / 6480, 7: 17 / 181440,
                   9: 1 / 181440},
}
MASK = {0: 0.5, 1: 1 / 12}    # limit positions


def eigenvalue(rings, a, b):
    """Of the row on the wave exp(2 pi i (a x + b n)/NX) over lattice points x = m + n/2, n."""
    total = 0.0
    for m in range(-4, 5):
        for n in range(-4, 5):
            weight = rings.get(m * m + m * n + n * n)
            if weight:
                total += weight * math.cos(2 * math.pi * (a * (m + 0.5 * n) + b * n) / NX)
    return total


def waves(frame):
    """|Fourier coefficient|^2 of the velocities, summed over x, y and z: {(a, b): value}."""
    sites = [(round(2 * x), round(2 * y / math.sqrt(3)), v) for x, y, _, *v in frame.values()]
    phase = [cmath.exp(-1j * math.pi * k / NX) for k in range(2 * NX)]
    result = {}
    for a in range(NX):
        for b in range(NX):
            sums = [0.0, 0.0, 0.0]
            for x, n, v in sites:    # x in half edges
                e = phase[(a * x + 2 * b * n) % (2 * NX)]
                for k in range(3):
                    sums[k] += v[k] * e
            result[a, b] = sum(abs(s)**2 for s in sums)
    return result


def classes(frames, mass):
    """Kinetic energy over kT/2 a degree of freedom, by size of the mass matrix's eigenvalue."""
    bins = {}
    for frame in frames:
        for (a, b), power in waves(frame).items():
            m = eigenvalue(MASK, a, b)**2 if mass == "vertex" else eigenvalue(RINGS[mass], a, b)
            # two real degrees of freedom in +-k, and three components; a vertex has mass 2
            total, count = bins.get(round(m, 9), (0.0, 0))
            bins[round(m, 9)] = (total + 2.0 * m * power / (NX * NX) / KT, count + 3)
    return {m: (total / count, math.sqrt(2.0 / count)) for m, (total, count) in sorted(bins.items())}


SEEDS = 24
for mass in ("vertex", "consistent", "lumped"):
    script = scene(PLANE, f"fix 1 all hd/nve mass {mass}")
    for seed in range(1, SEEDS + 1):
        script += f"hd_velocity all {KT} {seed} mom no\n" + VELOCITIES
    found = classes(draw(script)[0], mass)
    worst = largest((ratio - 1) / error for ratio, error in found.values())
    claim(f"mass {mass}: every wave has kT/2 per degree of freedom, within four standard errors",
          worst < 4.0, f"{worst:.2f} in {len(found)} classes from {min(found):.3f} to {max(found):.3f}")

script = scene(PLANE) + "run 0 post no\n"
for seed in range(1, SEEDS + 1):
    script += f"velocity all create {KT} {seed} dist gaussian mom no\nvelocity all scale {KT} temp T\n" + VELOCITIES
found = classes(draw(script)[0], "vertex")
claim("velocity create has the right temperature in the wrong distribution: long waves have too much, "
      "short ones too little", found[max(found)][0] > 2.5 and found[min(found)][0] < 0.3,
      f"{found[max(found)][0]:.2f} {found[min(found)][0]:.2f}")

# === Momentum, with the limit mask of Loop's weights written down independently


def faces_of(path):
    lines = open(path).read().split("ITEM: ENTRIES")[1].splitlines()[1:]
    return [tuple(map(int, line.split())) for line in lines]


def momenta(frame, faces, mass):
    """Total linear and angular momentum of L^T D L v, and the scale of their terms."""
    ring = {i: set() for i in frame}
    for f in faces:
        for i in range(3):
            ring[f[i]] |= {f[(i + 1) % 3], f[(i + 2) % 3]}
    mask = {}
    for i, around in ring.items():
        n = len(around)
        c = 1 / (1 + 8 / 3 * (5 / 8 - (3 / 8 + math.cos(2 * math.pi / n) / 4)**2))
        mask[i] = {i: c, **{j: (1 - c) / n for j in around}}
    if mass == "lumped":
        mask = {i: {i: 1.0} for i in frame}
    p = {i: [0.0] * 3 for i in frame}
    for row in mask.values():
        for k in range(3):
            w = 2.0 * sum(weight * frame[j][3 + k] for j, weight in row.items())
            for j, weight in row.items():
                p[j][k] += weight * w
    linear, angular, size = [0.0] * 3, [0.0] * 3, 0.0
    for i, q in p.items():
        x = frame[i][:3]
        for k in range(3):
            linear[k] += q[k]
            angular[k] += x[(k + 1) % 3] * q[(k + 2) % 3] - x[(k + 2) % 3] * q[(k + 1) % 3]
            size += abs(q[k])
    return largest(linear) / size, largest(angular) / size


TOPOLOGY = """
compute         faces all property/local aatom1 aatom2 aatom3
run             0 post no
write_dump      all local faces.dump c_faces[1] c_faces[2] c_faces[3]
"""
UNWRAPPED = VELOCITIES.replace("x y z", "xu yu zu")
for mass in ("vertex", "lumped"):
    (both, linear, neither, scaled), _ = draw(
        scene(SPHERE, f"fix 1 all hd/nve mass {mass}") + TOPOLOGY +
        f"hd_velocity all {KT} 1 mom yes rot yes\n" + UNWRAPPED + f"hd_velocity all {KT} 1\n" + UNWRAPPED +
        f"hd_velocity all {KT} 1 mom no\n" + UNWRAPPED +
        f"hd_velocity all {KT} 1 rot yes scale yes\n" + UNWRAPPED)
    faces = faces_of("faces.dump")
    found = momenta(both, faces, mass)
    claim(f"mass {mass}, mom yes rot yes: momentum and angular momentum vanish, across the corner of "
          "the box", max(found) < 1e-14, "{:.1e} {:.1e}".format(*found))
    found = momenta(scaled, faces, mass)
    claim(f"mass {mass}: and stay so with scale yes", max(found) < 1e-14, "{:.1e} {:.1e}".format(*found))
    found = momenta(linear, faces, mass)
    claim(f"mass {mass}: by default momentum vanishes and angular momentum does not",
          found[0] < 1e-14 and found[1] > 1e-4, "{:.1e} {:.1e}".format(*found))
    found = momenta(neither, faces, mass)
    claim(f"mass {mass}, mom no: neither does", min(found) > 1e-4, "{:.1e} {:.1e}".format(*found))

row = thermo(run(scene(SPHERE) + "compute_modify T extra/dof 6\n"
                 f"hd_velocity all {KT} 1 rot yes scale yes\nrun 0\n"))[-1]
claim("rot yes takes three more degrees of freedom", abs(row["c_T"] / KT - 1) < 1e-12)

# === Which mass, which ranks, which atoms

(implicit, explicit, other), _ = draw(scene(SPHERE, "fix 1 all hd/nve mass consistent") +
    f"hd_velocity all {KT} 1\n" + VELOCITIES + f"hd_velocity all {KT} 1 mass consistent solver direct\n" +
    VELOCITIES + f"hd_velocity all {KT} 1 mass lumped\n" + VELOCITIES)


def difference(a, b):
    return largest(p - q for i in a for p, q in zip(a[i][3:], b[i][3:])) / largest(
        p for row in b.values() for p in row[3:])


claim("the mass is that of the integrator of these atoms, unless stated",
      difference(implicit, explicit) < 1e-8 and difference(other, explicit) > 0.1,
      f"{difference(implicit, explicit):.1e}")
(part, whole), _ = draw(scene(SPHERE, "group these id 1:642\nfix 1 all hd/nve mass lumped") +
    f"hd_velocity these {KT} 1\n" + VELOCITIES + f"hd_velocity these {KT} 1 mass lumped\n" + VELOCITIES)
claim("so it is for another group of the same atoms", part == whole)
for shape, mass in ((SPHERE, "vertex"), (SPHERE, "consistent"), (PLANE, "vertex")):
    rotation = "yes" if shape is SPHERE else "no"
    script = scene(shape, f"fix 1 all hd/nve mass {mass} tol 1e-13") + \
        f"hd_velocity all {KT} 1 rot {rotation} scale yes\n" + VELOCITIES
    frames = [draw(script, ranks)[0][0] for ranks in (1, 2, 4)]
    worst = max(difference(frame, frames[0]) for frame in frames[1:])
    claim(f"{shape['shape'].split()[0]}, mass {mass}: 1, 2 and 4 ranks draw the same velocities",
          worst < 1e-11, f"{worst:.1e}")
(first, second), _ = draw(scene(SPHERE) + f"hd_velocity all {KT} 1\n" + VELOCITIES + "reset_timestep 77\n"
                          f"hd_velocity all {KT} 2\nhd_velocity all {KT} 1\n" + VELOCITIES)
claim("the same seed gives the same velocities, at any step", first == second)
(rest,), _ = draw(scene(SPHERE) + "hd_velocity all 1 1\nhd_velocity all 0 1\n" + VELOCITIES)
claim("at T = 0 nothing moves", all(v == 0.0 for row in rest.values() for v in row[3:]))
TWO = scene(SPHERE, "create_membrane 1 sphere 1 0.4 center -1 -1 -1\nset type 1 mass 2.0\n"
            "group one molecule 1\ngroup two molecule 2\n")
(before, after), _ = draw(TWO + f"hd_velocity one {KT} 1\n" + VELOCITIES + f"hd_velocity two {KT} 2\n" +
                          VELOCITIES)
moved = [i for i in before if before[i] != after[i]]
claim("atoms of other groups keep their velocities", moved == list(range(643, 685)), len(moved))

# === Bad input

for commands, expected in (
        ("hd_velocity all 1", "Illegal hd_velocity command: missing argument(s)"),
        ("hd_velocity nobody 1 1", "Could not find hd_velocity group ID nobody"),
        ("hd_velocity all -1 1", "hd_velocity temperature -1 must not be negative"),
        ("hd_velocity all nan 1", "Expected floating point parameter instead of 'nan'"),
        ("hd_velocity all 1 0", "hd_velocity seed 0 must be positive"),
        ("hd_velocity all 1 -5", "hd_velocity seed -5 must be positive"),
        ("hd_velocity all 1 x", "Expected integer parameter"),
        ("group some id 1:100\nhd_velocity some 1 1",
         "hd_velocity: group some has 100 of the 642 control points of membrane 1"),
        ("group none empty\nhd_velocity none 1 1", "hd_velocity: group none has no control points"),
        ("hd_velocity all 1 1 mass heavy", "hd_velocity mass heavy is not vertex, consistent, lumped or sampling"),
        ("hd_velocity all 1 1 tol 7", "hd_velocity tol 7 must be between 1e-14 and 1e-2"),
        ("hd_velocity all 1 1 mass lumped solver direct", "mass lumped needs no solver"),
        ("hd_velocity all 1 1 loop geom", "Unknown hd_velocity keyword loop"),
        ("hd_velocity all 1 1 rot", "Illegal hd_velocity rot command: missing argument(s)"),
        ("hd_velocity all 1 1 mom maybe", "Expected boolean parameter")):
    line = error_of(scene(SPHERE) + commands + "\n")
    claim(f"{commands!r} is refused", expected in line, line)
line = error_of(scene(PLANE) + "hd_velocity all 1 1 rot yes\n")
claim("rot yes on a periodic plane is refused", "cannot rotate; use rot no" in line, line)
line = error_of(TWO + "fix 1 one hd/nve\nfix 2 two hd/nve mass lumped\nhd_velocity all 1 1\n")
claim("two masses at once are refused", "fixes 1 and 2 move atoms of the group with different mass" in line, line)
line = error_of("atom_style membrane_cp\nhd_velocity all 1 1\n")
claim("without a box it is refused", "use it after create_membrane" in line, line)
line = error_of("region b block 0 1 0 1 0 1\ncreate_box 1 b\nhd_velocity all 1 1\n")
claim("without control points it is refused", "use atom_style membrane_cp" in line, line)

finish()
