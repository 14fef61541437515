"""dump membrane/image draws the limit surface: whole, smooth, in the right colors, on any rank."""
# cost: 15

import glob
import os

from lammps_claims import MPIEXEC, claim, error_of, finish, lammps, run, thermo

RANKS = (1, 2, 4) if MPIEXEC else (1,)

BOX = """
units           lj
atom_style      membrane_cp
region          box {} -2 2 -2 2 -2 2 {}
create_box      3 box angle/types 1
"""
SPHERE = "create_membrane 1 sphere 3 1.0\n"
PLANE = "create_membrane 1 plane 12 14\n"
FORCES = """
pair_style      helfrich
pair_coeff      1*2 1*2 10.0 0.0 tension 0.1
group           membrane type 1 2
fix             1 membrane nve
timestep        0.001
thermo_style    custom step pe ke press
thermo_modify   format float %24.17g
thermo          5
"""
SEEN = " size 200 200 zoom 2 box no 0 "
TOP = SEEN + "view 0 0 up 0 1 0 "


def box(shape="block", tilt=""):
    return BOX.format(shape, tilt)


class Picture:
    """Pixels of a PPM file; (0, 0) is the lower left one. With SEEN, 4 length units are 200 pixels."""

    def __init__(self, path):
        data = open(path, "rb").read()
        words, at = [], 0
        while len(words) < 4:    # magic, width, height, maximum; then one blank
            end = min(data.index(blank, at) for blank in (b" ", b"\n") if blank in data[at:])
            word, at = data[at:end], end + 1
            if word.startswith(b"#"):
                at = data.index(b"\n", end - len(word)) + 1
            elif word:
                words.append(word)
        self.width, self.height = int(words[1]), int(words[2])
        self.data = data[at:]

    def at(self, x, y):
        i = 3 * ((self.height - 1 - y) * self.width + x)
        return tuple(self.data[i:i + 3])

    def pixels(self):
        return [(x, y, self.at(x, y)) for y in range(self.height) for x in range(self.width)]

    def differs_from(self, other):
        """The part of the pixels that differ by more than a shade."""
        differ = sum(max(abs(a - b) for a, b in zip(self.data[i:i + 3], other.data[i:i + 3])) > 3
                     for i in range(0, len(self.data), 3))
        return differ / (self.width * self.height)


def draw(text, arguments="", modify="", diameter="adiam 0.2", **options):
    """The picture of a state, on black so that no part of the surface has its color."""
    run(text + f"write_dump all membrane/image p.ppm type type {diameter} {arguments} "
        f"modify backcolor black {modify}\n", **options)
    return Picture("p.ppm")


BLACK = (0, 0, 0)

# === The surface is whole and smooth

picture = draw(box() + SPHERE, TOP)
claim("the picture has the size asked for", (picture.width, picture.height) == (200, 200))
radius = [(((x - 99.5) ** 2 + (y - 99.5) ** 2) ** 0.5 / 50, color) for x, y, color in picture.pixels()]
inside = [color for r, color in radius if r < 0.97]
claim("a sphere has no holes", BLACK not in inside, len(inside))
claim("nothing is drawn beside it", all(color == BLACK for r, color in radius if r > 1.03))
picture = draw(box() + SPHERE, TOP, "surface molecule")
jumps = [max(abs(a - b) for a, b in zip(picture.at(x, y), picture.at(x + 1, y)))
         for y in range(66, 134) for x in range(66, 134)]
claim("its shading is smooth: neighbouring pixels differ by a few shades of 255", max(jumps) <= 16,
      max(jumps))

for subdivide in (1, 3, 20):
    picture = draw(box() + SPHERE, TOP, f"subdivide {subdivide}")
    inside = [picture.at(x, y) for x, y, _ in picture.pixels()
              if ((x - 99.5) ** 2 + (y - 99.5) ** 2) ** 0.5 < 48]
    claim(f"subdivide {subdivide}: no holes", BLACK not in inside)

for shape, tilt in (("block", ""), ("prism", "1.0 0 0")):
    flat = draw(box(shape, tilt) + PLANE, TOP)
    lit = sum(color != BLACK for _, _, color in flat.pixels())
    claim(f"a periodic plane fills its {shape} box", abs(lit / (200 * 200 / (1.25 ** 2 if tilt else 1))
          - 1) < 0.02, lit)
below = draw(box() + PLANE, SEEN + "view 180 0 up 0 1 0")
claim("it has two sides", all(color != BLACK for _, _, color in below.pixels()))

# === On several ranks, before, during and after runs

scene = box() + SPHERE + "create_membrane 2 torus 24 12 1.2 0.4 center 0.7 0.3 1.3 molecule 7\n" \
    "displace_atoms all random 0.02 0.02 0.02 4711 units box\n"
for name, text in {"before any run": scene, "after a run": scene + FORCES + "run 10\n",
                   "plane": box() + PLANE + FORCES + "run 10\n"}.items():
    serial = draw(text, SEEN)
    for ranks in RANKS[1:]:
        part = serial.differs_from(draw(text, SEEN, ranks=ranks))
        claim(f"{name}: the same picture on {ranks} ranks", part < 0.002, part)

DUMP = "dump d all membrane/image 5 d.*.ppm type type" + SEEN + "\ndump_modify d pad 3\n"
for ranks in RANKS[:2]:
    plain = thermo(run(scene + FORCES + "run 20\n", ranks=ranks))
    drawn = thermo(run(scene + FORCES + DUMP + "run 20\n", ranks=ranks))
    claim(f"a run goes on unchanged beside it, {ranks} ranks", plain == drawn and len(plain) == 5)
claim("it writes a file at each multiple of N",
      sorted(glob.glob("d.*.ppm")) == [f"d.{n:03d}.ppm" for n in (0, 5, 10, 15, 20)])
claim("the membrane moves", Picture("d.000.ppm").differs_from(Picture("d.020.ppm")) > 0)
out = run(scene + FORCES + DUMP + "minimize 0 1e-6 10 100\n")
claim("it draws during minimize; the colors are explained once",
      out.count("Dump d colors membranes by mean curvature from") == 1)

# === What is drawn

atoms = scene + "create_atoms 3 single 0.5 -0.5 1.6\nset type 3 mass 1.0\n"
surface, with_atom = draw(scene, SEEN), draw(atoms, SEEN)
claim("plain atoms are drawn beside the surface", 0 < surface.differs_from(with_atom) < 0.02)
points = draw(scene, SEEN, "points yes")
claim("control points only when asked for", points.differs_from(surface) > 0.01)
nothing = draw(scene + "group none empty\n", SEEN)
run(scene + "group two type 2\nwrite_dump two membrane/image p.ppm type type" + SEEN +
    "modify backcolor black\n")
torus = Picture("p.ppm")
part = sum(c != BLACK for _, _, c in torus.pixels()) / sum(c != BLACK for _, _, c in surface.pixels())
claim("a group limits it to faces whose corners are in the group", 0.2 < part < 0.8, part)

half = draw(box() + SPHERE + "region half block INF INF INF INF INF 0\n", TOP, "region half")
full = draw(box() + SPHERE, TOP)
claim("a region cuts the surface open", half.differs_from(full) > 0.1 and half.at(100, 100) != BLACK)
side = draw(box() + SPHERE + "region half block INF INF INF INF INF 0\n",
            SEEN + "view 90 0", "region half")
claim("along a straight line", all(side.at(x, 103) == BLACK for x in range(200)) and
      all(side.at(x, 97) != BLACK for x in range(60, 140)))

across = box() + "create_membrane 1 sphere 3 1.0 center 1.8 0 0\n"
whole, cut = draw(across, TOP), draw(across, TOP, "whole no")
claim("a closed membrane is drawn in one piece", whole.at(10, 100) == BLACK != whole.at(190, 100) and
      draw(across, TOP + "center s 0.9 0.5 0.5").at(150, 100) != BLACK)
claim("whole no cuts it at the box", cut.at(10, 100) != BLACK != cut.at(190, 100))

# === Colors

wheel = box() + "create_membrane 1 torus 48 24 1.2 0.5\n"


def hue(color):
    return color[0] - color[2]


H = draw(wheel, TOP)
outer, inner = H.at(100 + 78, 100), H.at(100 + 40, 100)
claim("H: the outside of a torus is red, the inside blue", hue(outer) > 30 and hue(inner) < -30,
      (outer, inner))
K = draw(wheel, TOP, "surface K")
claim("K likewise", hue(K.at(178, 100)) > 20 and hue(K.at(140, 100)) < -20)
ranged = draw(wheel, TOP, "range -10 10")
claim("range sets the values at the ends: all of it is gray", max(
    abs(hue(c)) for _, _, c in ranged.pixels()) < 60)
mapped = draw(wheel, TOP, "smap min max cf 0.0 2 min green max yellow")
claim("smap sets the colors", all(c[2] < c[1] for _, _, c in mapped.pixels()
                                  if c != BLACK and sum(c) < 600))
mapped = draw(wheel, TOP, "smap -1 1 sa 1.0 1 purple")
claim("smap takes every style of color map", hue(mapped.at(178, 100)) != hue(outer))
kind = draw(scene, SEEN, "surface type acolor 1 lime acolor 2 blue")
colors = [c for _, _, c in kind.pixels() if c != BLACK]
claim("type: the colors of the types", any(c[1] > 3 * c[2] for c in colors) and
      any(c[2] > 3 * c[1] for c in colors))
molecule = draw(scene, SEEN, "surface molecule")
claim("molecule: another color for each membrane",
      any(hue(c) > 40 for _, _, c in molecule.pixels()) and
      any(hue(c) < -20 for _, _, c in molecule.pixels()))

# === dump image's own options

for options in ("fsaa no", "fsaa yes", "ssao yes 4711 0.6", "fsaa yes ssao yes 4711 0.6", "shiny 1.0",
                "axes yes 0.5 0.02 box yes 0.02", "subbox yes 0.01", "center d 0.4 0.5 0.5",
                "view 30 v_phi", "zoom 1.1 up 1 0 0"):
    picture = draw(scene + "variable phi equal 20\n", SEEN + options)
    lit = sum(c != BLACK for _, _, c in picture.pixels())
    claim(f"{options}: draws a picture", (picture.width, picture.height) == (200, 200) and lit > 4000,
          lit)
smooth, rough = draw(box() + SPHERE, TOP), draw(box() + SPHERE, TOP + "fsaa no")
claim("fsaa leaves the picture in its place", 0 < smooth.differs_from(rough) < 0.05,
      smooth.differs_from(rough))
dark = draw(scene, SEEN + "ssao yes 4711 0.8")
claim("ssao darkens hollows", sum(sum(c) for _, _, c in dark.pixels()) <
      sum(sum(c) for _, _, c in draw(scene, SEEN).pixels()))

for end, magic in (("png", b"\x89PNG"), ("jpg", b"\xff\xd8")):
    code, out = lammps(scene + f"write_dump all membrane/image p.{end} type type\n")
    if "not included" not in out:
        claim(f"{end} files", code == 0 and open("p." + end, "rb").read(9).startswith(magic))

# === Wrong input

dump = "dump d all membrane/image 5 d.*.ppm type type\n"
wrong = {
    "dump d all membrane/image 5 d.*.ppm type": "dump image",
    "dump d all membrane/image 5 d.*.ppm type type colour red": "colour",
    "dump d all membrane/image 5 d.*.tga type type": "writes JPEG, PNG and PPM",
    dump + "dump_modify d surface J": "not one of H, K, type, molecule",
    dump + "dump_modify d surface": "missing",
    dump + "dump_modify d range 1 0": "must be the larger",
    dump + "dump_modify d range 1": "missing",
    dump + "dump_modify d range red": "red",
    dump + "dump_modify d subdivide 0": "auto or between 1 and 256",
    dump + "dump_modify d points perhaps": "perhaps",
    dump + "dump_modify d whole perhaps": "perhaps",
    dump + "dump_modify d smap min max": "dump",
    dump + "dump_modify d colours H": "colours",
    "dump d all membrane/image 5 d.ppm type type\nrun 0": "one snapshot per file",
}
for command, expected in wrong.items():
    error = error_of(scene + command + "\n")
    claim(f"{command.splitlines()[-1]}: one clear error", error != "" and
          (expected.lower() in error.lower() or "illegal" in error.lower()), error)
error = error_of("units lj\natom_style atomic\nregion b block 0 1 0 1 0 1\ncreate_box 1 b\n" + dump)
claim("another atom style", "atom_style membrane_cp" in error, error)

finish()
