"""What is hard to minimize. Meshes as they come from other programs: a sphere of meridians and parallels, and a surface
of two holes cut out of voxels. A vesicle that a wall pulls on.

    write_off("sphere.off", *meridian_sphere(32, 15))
    write_off("holes.off", *voxel_surface(two_holes, BOX_OF_TWO_HOLES, (18, 12, 6), slivers=0.5))
"""

import itertools
import math


def meridian_sphere(meridians, parallels):
    """Unit sphere whose poles have the valence `meridians`; meridians * parallels + 2 points."""
    points = [(0.0, 0.0, 1.0)]
    for i in range(1, parallels + 1):
        polar = math.pi * i / (parallels + 1)
        for j in range(meridians):
            around = 2 * math.pi * j / meridians
            points.append((math.sin(polar) * math.cos(around), math.sin(polar) * math.sin(around), math.cos(polar)))
    points.append((0.0, 0.0, -1.0))
    faces = []
    for j in range(meridians):
        def at(i):
            return 1 + i * meridians + j, 1 + i * meridians + (j + 1) % meridians
        faces.append((0, *at(0)))
        faces.append((len(points) - 1, *reversed(at(parallels - 1))))
        for i in range(parallels - 1):
            (a, b), (c, d) = at(i), at(i + 1)
            faces += [(a, c, d), (a, d, b)]
    return points, faces


BOX_OF_TWO_HOLES = ((-2.71, -1.72, -0.73), (2.71, 1.72, 0.73))


def two_holes(x, y, z):
    """Negative inside a figure of eight: two tori that blend."""
    left, right = ((math.hypot(x - centre, y) - 1.0) ** 2 + z * z for centre in (-1.05, 1.05))
    return -math.log(math.exp(-6 * left) + math.exp(-6 * right)) / 6 - 0.21


def voxel_surface(field, box, counts, slivers=0.0):
    """Where a field is zero, by marching tetrahedra, six to a voxel [B. Payne and A. Toga, IEEE Comput. Graph. Appl.
    10, 33, 1990]. Points keep off the ends of the edges they are on by the fraction `slivers`: 0 leaves triangles of
    all shapes, 0.5 gives the staircase of voxels that are either in or out."""
    spacing = [(high - low) / n for low, high, n in zip(*box, counts)]
    value = {corner: field(*(low + step * i for low, step, i in zip(box[0], spacing, corner)))
             for corner in itertools.product(*(range(n + 1) for n in counts))}
    points, faces, number = [], [], {}

    def cut(a, b):
        edge = (a, b) if a < b else (b, a)
        if edge not in number:
            a, b = edge
            t = min(max(value[a] / (value[a] - value[b]), slivers), 1 - slivers)
            number[edge] = len(points)
            points.append(tuple(box[0][k] + spacing[k] * (a[k] + t * (b[k] - a[k])) for k in range(3)))
        return number[edge]

    for voxel in itertools.product(*map(range, counts)):
        for order in itertools.permutations(range(3)):
            corners = [voxel]
            for axis in order:
                corners.append(tuple(i + (k == axis) for k, i in enumerate(corners[-1])))
            inside = [c for c in corners if value[c] < 0]
            outside = [c for c in corners if value[c] >= 0]
            if len(inside) == 2:
                (a, b), (c, d) = inside, outside
                loop = [cut(a, c), cut(a, d), cut(b, d), cut(b, c)]
            else:
                loop = [cut(a, b) for a in inside for b in outside]
            if len(loop) < 3:
                continue
            outward = [spacing[k] * (sum(c[k] for c in outside) / len(outside) -
                                     sum(c[k] for c in inside) / len(inside)) for k in range(3)]
            for i in range(1, len(loop) - 1):
                p, q, r = (points[v] for v in (loop[0], loop[i], loop[i + 1]))
                u, w = [x - y for x, y in zip(q, p)], [x - y for x, y in zip(r, p)]
                normal = (u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0])
                faces.append((loop[0], loop[i], loop[i + 1])
                             if sum(x * y for x, y in zip(normal, outward)) > 0 else (loop[0], loop[i + 1], loop[i]))
    return points, faces


# A vesicle that hangs over a wall with an attraction of this depth: it sinks onto it
WALLED_VESICLE = """
units           lj
atom_style      membrane_cp
boundary        p p f
region          box block -6 6 -6 6 -0.2 12
create_box      1 box angle/types 1
create_membrane 1 sphere 3 3.0 center 0 0 3.9
special_bonds   lj/coul 1 1 1
pair_style      helfrich
pair_coeff      1 1 10.0 0.0 area 500.0 init volume 1.0 init regularize 0.1
compute         e all pair helfrich
compute         s all membrane/shape
fix             wall all wall/lj126 zlo 0.0 {depth} 0.8 2.4
fix_modify      wall energy yes
thermo_style    custom step c_e[1] c_s[9]
thermo_modify   norm no
thermo          10000
min_style       {style}
{more}
minimize        1.0e-9 0.0 {iterations} 20000
"""
