"""Scenes that the script tests share: a box with one or more membranes, of all kinds of mesh.

    scene = SCENES["torus"]
    run(scene.setup(quadrature=3) + coefficients("tension") + "run 0\\n" + scene.shake(2) + "\\nrun 0\\n")

setup() ends after pair_style; coordinates are displaced at random once. Some membranes, or some points
of one, are of type 1 and others of type 2. A shake() displaces all again: after a first run it moves
the shape away from references "init".
"""

import math


def write_off(path, points, faces):
    with open(path, "w") as file:
        file.write(f"OFF\n{len(points)} {len(faces)} 0\n")
        for point in points:
            file.write("%.17g %.17g %.17g\n" % tuple(point))
        for face in faces:
            file.write("3 %d %d %d\n" % tuple(face))


def read_off(path):
    """Points and faces."""
    words = [line.split() for line in open(path) if line.strip() and not line.startswith("#")][1:]
    n, m = int(words[0][0]), int(words[0][1])
    return ([[float(x) for x in row[:3]] for row in words[1:n + 1]],
            [[int(i) for i in row[1:4]] for row in words[n + 1:n + m + 1]])


def bipyramid(n):
    """Two poles of valence n over an equator of n points of valence 4."""
    points = [(math.cos(2 * math.pi * i / n), math.sin(2 * math.pi * i / n), 0.0) for i in range(n)]
    points += [(0.0, 0.0, 0.8), (0.0, 0.0, -0.8)]
    faces = [(i, (i + 1) % n, n) for i in range(n)] + [((i + 1) % n, i, n + 1) for i in range(n)]
    return points, faces


TETRAHEDRON = ([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)],
               [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)])


class Scene:
    def __init__(self, commands, box="block -2 2 -2 2 -2 2", noise=0.03, closed=True, types=2,
                 mesh=None):
        self.commands, self.box, self.noise = commands, box, noise
        self.closed, self.types, self.mesh = closed, types, mesh

    def setup(self, quadrature=6, before="", style="helfrich quadrature {}"):
        if self.mesh:
            write_off(*self.mesh)
        shape, *numbers = self.box.split()
        return f"""
units           lj
atom_style      membrane_cp
{before}
region          box {shape} {' '.join(numbers)}
create_box      {self.types} box angle/types 1
{self.commands}
{self.shake(1)}
pair_style      {style.format(quadrature)}
compute         hf all pair helfrich
thermo_style    custom step pe c_hf[*] pxx pyy pzz pxy pxz pyz
thermo_modify   norm no format float %24.17g
"""

    def shake(self, seed):
        return f"displace_atoms  all random {self.noise} {self.noise} {self.noise} {seed} units box"


CORNER = "center 2.0 2.0 2.0"
HALVES = "set group all type/fraction 2 0.5 4711"

SCENES = {
    "sphere": Scene(f"create_membrane 1 sphere 1 1.0\n{HALVES}"),
    "torus": Scene(f"create_membrane 1 torus 12 8 1.1 0.5\n{HALVES}"),
    "cylinder": Scene(f"create_membrane 1 cylinder 8 6 1.0 z\n{HALVES}", closed=False),
    "plane": Scene(f"create_membrane 1 plane 7 8\n{HALVES}", noise=0.1, closed=False),
    "sphere across the corner of the box": Scene(
        f"create_membrane 1 sphere 1 1.2 {CORNER}\n{HALVES}"),
    "two membranes": Scene("create_membrane 1 sphere 1 0.7 center -0.9 0 0\n"
                           "create_membrane 2 sphere 1 0.8 center  1.1 0 0"),
    "three membranes, one sharing a type": Scene(
        "create_membrane 1 sphere 1 0.7 center -0.9 0 -0.5\n"
        "create_membrane 2 sphere 1 0.8 center  1.1 0 0\n"
        "create_membrane 1 torus 8 6 0.6 0.25 center 0 1.5 1.5"),
    "tetrahedron": Scene(f"create_membrane 1 file tetrahedron.off scale 0.8 0.8 0.8\n{HALVES}",
                         mesh=("tetrahedron.off", *TETRAHEDRON)),
    "valence 3": Scene(f"create_membrane 1 file bipyramid3.off refine 1\n{HALVES}",
                       mesh=("bipyramid3.off", *bipyramid(3)), noise=0.02),
    "valence 12": Scene(f"create_membrane 1 file bipyramid12.off refine 1\n{HALVES}",
                        mesh=("bipyramid12.off", *bipyramid(12)), noise=0.01),
    "tilted box, sphere across its corner": Scene(
        f"create_membrane 1 sphere 1 1.2 {CORNER}\n{HALVES}", box="prism -2 2 -2 2 -2 2 0.7 -0.5 0.9"),
    "tilted box, plane": Scene(f"create_membrane 1 plane 7 8\n{HALVES}", noise=0.1, closed=False,
                               box="prism -2 2 -2 2 -2 2 0.7 0 0"),
}

# pair_coeff of types 1 and 2; of which every term has its forces
GLOBAL = "area 70.0 9.0 area/local 40.0 area/difference 8.0 2.0 thickness 0.1 volume 60.0 3.0 pressure 1.5"
LIPIDS = "library A 0.65 0.4 library B 0.31 -1.1"
TERMS = {
    "bending": ("10.0 0.0", "15.0 0.0"),
    "spontaneous curvature": ("10.0 0.8", "15.0 -0.4"),
    "Gaussian": ("0.0 0.0 kg 7.0", "0.0 0.0 kg -5.0"),
    "tension": ("0.0 0.0 tension 3.0", "0.0 0.0 tension 5.0"),
    "area": ("0.0 0.0 area 70.0 9.0",) * 2,
    "area/local": ("0.0 0.0 area/local 40.0",) * 2,
    "area/difference": ("0.0 0.0 area/difference 8.0 2.0 thickness 0.1",) * 2,
    "volume": ("0.0 0.0 volume 60.0 3.0",) * 2,
    "pressure": ("0.0 0.0 pressure 1.5",) * 2,
    "regularize": ("10.0 0.0 regularize 0.2", "15.0 0.0 regularize 0.4"),
    "regularize conformal": ("10.0 0.0 regularize 0.2 conformal", "15.0 0.0 regularize 0.4 conformal"),
    "leaflets": (f"10.0 0.8 leaflets 0.02 lipids NULL {LIPIDS} outer A 3 B 1 inner A 1", "15.0 -0.4 leaflets 0.04"),
    "lipids": (f"10.0 0.8 lipids NULL {LIPIDS} outer A 3 B 1 inner A 1", "15.0 0.0"),
    "all terms": (f"10.0 0.8 kg 7.0 tension 3.0 lipids NULL {LIPIDS} outer A 3 B 1 inner A 1 {GLOBAL}",
                  f"15.0 -0.4 kg -5.0 tension 5.0 {GLOBAL}"),
}
NEEDS_CLOSED = ("volume", "pressure")


def coefficients(term, closed=True, style=""):
    """The pair_coeff lines of a term, without what an open membrane cannot have; the style is for hybrid."""
    lines = ""
    for i, text in enumerate(TERMS[term], 1):
        if not closed:
            text = text.replace(" volume 60.0 3.0 pressure 1.5", "")
        lines += f"pair_coeff {i} {i} {style} {text}\n"
    return lines


def terms_of(scene):
    return [term for term in TERMS if scene.closed or term not in NEEDS_CLOSED]


def read_dump(path):
    """The frames of a dump: per frame {atom ID: [other columns]}."""
    frames = []
    with open(path) as file:
        while header := file.readline():
            if header.startswith("ITEM: NUMBER"):
                count = int(file.readline())
            elif header.startswith("ITEM: ATOMS"):
                rows = (file.readline().split() for _ in range(count))
                frames.append({int(row[0]): [float(word) for word in row[1:]] for row in rows})
    return frames


def frames(path):
    """The same as lists of rows, the atom ID first, sorted by it."""
    return [[[i, *frame[i]] for i in sorted(frame)] for frame in read_dump(path)]


def largest(values):
    return max(abs(value) for value in values)
