"""A vesicle at kc = 20 kT on a mesh of random valences: the averages are those of an icosphere, and of theory.

    MEMBRANE_LONG=1    642 points in place of 162, these as they are and 162 of random valences refined once,
                       regularize of 0.2 to 2 kc, more steps

Averages and their errors are those of compute hd/modes average.
"""
# cost: 60
# timeout: 7200

import math
import os
import random

from lammps_claims import LONG, REFERENCE, claim, finish, run, thermo
from membrane_scenes import read_off, write_off

DEGREES = (2, 3, 4)


def flip_edges(faces, flips, valences):
    """Turns random edges to the other diagonal of their two faces, while valences stay in this range."""
    faces, done = [tuple(face) for face in faces], 0
    beyond = {(f[k], f[(k + 1) % 3]): i for i, f in enumerate(faces) for k in range(3)}
    valence = {}
    for face in faces:
        for v in face:
            valence[v] = valence.get(v, 0) + 1
    while done < flips:
        i, k = random.randrange(len(faces)), random.randrange(3)
        a, b, c = (faces[i][(k + m) % 3] for m in range(3))
        j = beyond[b, a]
        d = next(v for v in faces[j] if v not in (a, b))
        if (c, d) in beyond or (d, c) in beyond or min(valence[a], valence[b]) == min(valences) or \
                max(valence[c], valence[d]) == max(valences):
            continue
        for v, change in ((a, -1), (b, -1), (c, 1), (d, 1)):
            valence[v] += change
        del beyond[a, b], beyond[b, a]
        faces[i], faces[j] = (a, d, c), (b, c, d)
        for n in (i, j):
            for m in range(3):
                beyond[faces[n][m], faces[n][(m + 1) % 3]] = n
        done += 1
    return faces, valence


def smooth(points, faces, passes):
    """Moves points of a sphere to the middle of the faces around them, by area, and back to the sphere."""
    for _ in range(passes):
        sums = [[0.0] * 4 for _ in points]
        for face in faces:
            p = [points[v] for v in face]
            middle = [sum(q[k] for q in p) / 3 for k in range(3)]
            u, w = ([p[m][k] - p[0][k] for k in range(3)] for m in (1, 2))
            area = math.hypot(u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0])
            for v in face:
                for k in range(3):
                    sums[v][k] += area * middle[k]
        points = [tuple(x / math.hypot(*s[:3]) for x in s[:3]) for s in sums]
    return points


def vesicle(mesh, steps, modulus, dt):
    """{l: (power over theory, error)}, smallest angle; mesh: a file and keywords of create_membrane"""
    row = thermo(run(f"""
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
create_box      1 box angle/types 1
create_membrane 1 file {mesh} mass {12.6 / len(points)!r}
special_bonds   lj/coul 1 1 1
pair_style      helfrich
pair_coeff      1 1 1.0 0.0 volume 1000.0 {4 * math.pi / 3!r} regularize {modulus} conformal
min_style       membrane
minimize        0 1e-4 500 5000
fix             1 all hd/langevin 0.05 0.05 3.0 4711 mass sampling
timestep        {dt}
thermo          100000
run             500
compute         a all hd/modes sphere 4 average 2 theory 0.05 1.0 0.0
compute         s all membrane/shape
fix             s all ave/time 10 1 10 c_s[9] file angle.txt
thermo_style    custom step {' '.join(f'c_a[{l - 1}][{j}]' for l in DEGREES for j in (5, 6))}
run             {steps}
""", timeout=7200))[-1]
    angle = min(float(line.split()[1]) for line in open("angle.txt") if line[0] != "#")
    return {l: (row[f"c_a[{l - 1}][5]"], row[f"c_a[{l - 1}][6]"]) for l in DEGREES}, angle


def words(found):
    return "  ".join(f"{l}: {mean:.3f}({1000 * error:.0f})" for l, (mean, error) in found.items())


def refine(points, faces):
    """Each face in four, new points on the sphere."""
    points, middle, finer = list(points), {}, []

    def between(a, b):
        key = min(a, b), max(a, b)
        if key not in middle:
            middle[key] = len(points)
            points.append(tuple(0.5 * (x + y) for x, y in zip(points[a], points[b])))
        return middle[key]

    for a, b, c in faces:
        ab, bc, ca = between(a, b), between(b, c), between(c, a)
        finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return points, finer


def random_mesh(path, points, faces):
    """Of these points on a sphere and twice as many flips; returns how many points have which valence."""
    faces, valence = flip_edges(faces, 2 * len(points), (5, 8))
    write_off(path, smooth(points, faces, 200), faces)
    return {n: list(valence.values()).count(n) for n in sorted(set(valence.values()))}


random.seed(20)
points, faces = read_off(os.path.join(REFERENCE, "icosphere_2.off"))
points = [tuple(x / math.hypot(*p) for x in p) for p in points]
MESHES = {"162 points": "coarse.off"}
counts = random_mesh("coarse.off", points, faces)
if LONG:
    MESHES = {"162 points refined": "coarse.off refine 1", "642 points": "fine.off"}
    points, faces = refine(points, faces)
    points = [tuple(x / math.hypot(*p) for x in p) for p in points]
    counts = random_mesh("fine.off", points, faces)
write_off("regular.off", points, faces)
claim("valences are random", counts.get(6, 0) < 0.6 * len(points) and len(counts) == 4, counts)

STEPS = 30000 if LONG else 8000
TELLING = [l for l in DEGREES if LONG or l < 4]    # 162 points of random valences are too few for l = 4: it has 0.94 of its power
regular, _ = vesicle("regular.off", STEPS, 1.0, 0.3)
for name, mesh in MESHES.items():
    for modulus, dt in ((1.0, 0.3), (0.5, 0.3), (0.2, 0.2), (2.0, 0.2)) if LONG else ((1.0, 0.3),):
        found, angle = vesicle(mesh, STEPS, modulus, dt)
        claim(f"{name}, regularize {modulus}: powers are those of an icosphere to three and a half standard errors",
              all(abs(found[l][0] - regular[l][0]) < 3.5 * math.hypot(found[l][1], regular[l][1]) for l in TELLING),
              f"{words(found)};  {words(regular)}")
        claim("    and those of theory to 2 % and three standard errors",
              all(abs(found[l][0] - 1) < 0.02 + 3 * found[l][1] for l in TELLING))
        claim("    errors are small enough to tell", max(error for _, error in found.values()) < (0.025 if LONG else 0.05))
        claim("    faces stay in shape", angle > 5, f"smallest angle {angle:.1f}")

finish()
