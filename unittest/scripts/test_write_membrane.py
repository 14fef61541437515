"""write_membrane writes the limit surface, or the control mesh, exactly and from any state."""

import base64
import os
import re
import struct

from lammps_claims import MPIEXEC, claim, error_of, finish, run, thermo

RANKS = (1, 2, 4) if MPIEXEC else (1,)

START = """
units           lj
atom_style      membrane_cp
region          box {region} -3 3 -3 3 -2 2 {tilt}
create_box      2 box angle/types 1
"""
FILES = ("off", "ply", "vtp")


def box(shape="block", tilt=""):
    return START.format(region=shape, tilt=tilt)


SPHERE = "create_membrane 1 sphere 2 1.0\n"
TWO = (SPHERE + "create_membrane 2 torus 24 12 1.5 0.4 center 1.7 0.3 1.3 molecule 7\n"
       "displace_atoms  all random 0.01 0.01 0.01 4711 units box\n")
PLANE = ("create_membrane 1 plane 12 14\ndisplace_atoms all random 0.05 0.05 0.3 4711 units box\n")
FORCES = """
pair_style      helfrich
pair_coeff      * * 10.0 0.0 tension 0.1
fix             1 all nve
timestep        0.001
thermo_style    custom step pe ke press
thermo_modify   format float %24.17g
thermo          5
"""


# === Reading what was written

def read_off(path):
    words = open(path).read().split()
    n, m = int(words[1]), int(words[2])
    numbers = list(map(float, words[4:4 + 3 * n]))
    points = [tuple(numbers[3 * i:3 * i + 3]) for i in range(n)]
    corners = list(map(int, words[4 + 3 * n:]))
    faces = [tuple(corners[4 * i + 1:4 * i + 4]) for i in range(m)]
    return points, faces


def read_ply(path):
    head, body = open(path, "rb").read().split(b"end_header\n", 1)
    names = re.findall(rb"property double (\S+)", head)
    n = int(re.search(rb"element vertex (\d+)", head).group(1))
    m = int(re.search(rb"element face (\d+)", head).group(1))
    rows = [struct.unpack_from(f"<{len(names)}d", body, 8 * len(names) * i) for i in range(n)]
    start = 8 * len(names) * n
    faces = [struct.unpack_from("<3i", body, start + 13 * i + 1) for i in range(m)]
    fields = {name.decode(): [row[k] for row in rows] for k, name in enumerate(names)}
    return [row[:3] for row in rows], faces, fields


def read_vtp(path):
    text = open(path).read()
    arrays = {}
    for kind, name, data in re.findall(
            r'type="(\w+)" Name="(\w+)"[^>]*>\s*([A-Za-z0-9+/=]+)\s*</DataArray>', text):
        raw = base64.b64decode(data)
        code = {"Float64": "d", "Int32": "i"}[kind]
        size = struct.unpack_from("<Q", raw)[0] // struct.calcsize(code)
        arrays[name] = struct.unpack_from(f"<{size}{code}", raw, 8)
    points = [arrays["Points"][3 * i:3 * i + 3] for i in range(len(arrays["Points"]) // 3)]
    corners = arrays["connectivity"]
    return points, [corners[3 * i:3 * i + 3] for i in range(len(corners) // 3)], arrays


def distance(a, b):
    return max(abs(x - y) for x, y in zip(a, b))


def longest_edge(points, faces):
    return max(distance(points[f[k]], points[f[k - 1]]) for f in faces for k in range(3))


def contents():
    return {end: open("s." + end, "rb").read() for end in FILES}


# === The surface

out = run(box() + SPHERE + "write_membrane s.off\nwrite_membrane s.ply\nwrite_membrane s.vtp\n")
claim("it says what it wrote", "Wrote the limit surface of the membrane to s.vtp: 2562 points, "
      "5120 triangles" in out)
off, ply, vtp = read_off("s.off"), read_ply("s.ply"), read_vtp("s.vtp")
claim("each face becomes 16 triangles, each point occurs once",
      len(off[0]) == 2562 and len(off[1]) == 5120)
claim("the three formats have the same points and triangles",
      off[0] == list(map(tuple, ply[0])) == list(map(tuple, vtp[0])) and
      off[1] == list(map(tuple, ply[1])) == list(map(tuple, vtp[1])))
names = ["mean_curvature", "gaussian_curvature", "membrane"]
claim("PLY has the fields", list(ply[2])[3:] == names, list(ply[2]))
claim("VTP has the fields", all(name in vtp[2] for name in names), list(vtp[2]))
radius = [sum(x * x for x in p) ** 0.5 for p in off[0]]
mean = sum(vtp[2]["mean_curvature"]) / len(radius)
claim("the mean curvature of a sphere is 1/R", abs(mean * sum(radius) / len(radius) - 1) < 0.01, mean)
gauss = sum(vtp[2]["gaussian_curvature"]) / len(radius)
claim("its Gaussian curvature is 1/R^2", abs(gauss - 1 / radius[0] ** 2) < 0.05, gauss)
claim("the field membrane is the molecule ID", set(vtp[2]["membrane"]) == {1.0})

run(box() + SPHERE + "write_membrane s.ply fields no subdivide 1\n")
claim("fields no leaves them out", list(read_ply("s.ply")[2]) == ["x", "y", "z"])
claim("subdivide 1 has the faces of the control mesh", len(read_ply("s.ply")[1]) == 320)

# === The control mesh goes round

AGAIN = {
    "sphere": (SPHERE, "create_membrane 1 file 1.off\n"),
    "two membranes": (TWO, "create_membrane 1 file 1.off\ncreate_membrane 2 file 7.off molecule 7\n"),
    "periodic plane": (PLANE, "create_membrane 1 file 1.off\n"),
}
for name, (start, again) in AGAIN.items():
    molecules = (1, 7) if "7.off" in again else (1,)
    run(box() + start + "write_membrane a.off subdivide 0\n" +
        "".join(f"write_membrane {m}.off subdivide 0 membrane {m}\n" for m in molecules))
    run(box() + again + "write_membrane b.off subdivide 0\n")
    a, b = read_off("a.off"), read_off("b.off")
    worst = max(distance(p, q) for p, q in zip(a[0], b[0]))
    claim(f"{name}: the control mesh makes the same membrane again",
          a[1] == b[1] and len(a[0]) == len(b[0]) and worst <= 1e-15, worst)

# the points are those of the atoms, modulo the box

run(box() + PLANE + "write_membrane a.off subdivide 0\nwrite_dump all custom a.dump id x y z "
    'modify sort id format float "%.17g"\n')
atoms = [tuple(map(float, line.split()[1:])) for line in open("a.dump").read().split("\n")[9:] if line]
length = (6.0, 6.0, 4.0)
worst = max(abs((x - y) / l - round((x - y) / l))
            for p, q in zip(read_off("a.off")[0], atoms) for x, y, l in zip(p, q, length))
claim("the points of a plane are the atoms, modulo the box", worst < 1e-15, worst)

energies = []
for source in (PLANE, "create_membrane 1 file a.off\n"):
    text = box() + source + FORCES + "run 0\n" + "write_membrane a.off subdivide 0\n"
    energies.append(thermo(run(text))[-1]["PotEng"])
claim("a plane from its own file has the same energy",
      abs(energies[0] / energies[1] - 1) < 1e-12, energies)

# === Periodic membranes

for shape, tilt in (("block", ""), ("prism", "1.5 0 0")):
    run(box(shape, tilt) + PLANE + "write_membrane p.ply\nwrite_membrane p.off\nwrite_membrane p.vtp\n")
    for end, mesh in (("ply", read_ply("p.ply")), ("off", read_off("p.off")), ("vtp", read_vtp("p.vtp"))):
        edge = longest_edge(*mesh[:2])
        claim(f"{shape} box, {end}: no triangle reaches across the box", edge < 0.5, edge)
    inside = all(-3.4 < y < 3.4 for x, y, z in read_ply("p.ply")[0])
    claim(f"{shape} box: the surface lies within the box", inside)

# === Which membranes

run(box() + TWO + "write_membrane all.vtp\nwrite_membrane one.vtp membrane 1\n"
    "write_membrane seven.vtp membrane 7\nwrite_membrane both.vtp membrane 7 membrane 1\n")
whole, one, seven = (read_vtp(name + ".vtp") for name in ("all", "one", "seven"))
claim("all membranes by default", set(whole[2]["membrane"]) == {1.0, 7.0})
claim("membrane 1 is the sphere", len(one[1]) == 16 * 320 and set(one[2]["membrane"]) == {1.0})
claim("membrane 7 is the torus", len(seven[1]) == 16 * 576 and set(seven[2]["membrane"]) == {7.0})
claim("one by one they are the same as together",
      sorted(one[0] + seven[0]) == sorted(whole[0]))
claim("named twice is all of them", open("both.vtp").read() == open("all.vtp").read())

# === Any state, any number of ranks

write = "".join(f"write_membrane s.{end}\n" for end in FILES)
states = {
    "before any run, without pair style": box() + TWO + write,
    "before any run": box() + TWO + FORCES + write,
    "after a run": box() + TWO + FORCES + "run 10\n" + write,
    "after a run and a displacement": box() + TWO + FORCES + "run 10\ngroup g type 1\n"
                                      "displace_atoms g move 2.5 0 0 units box\n" + write,
    "periodic, after a run": box() + PLANE + FORCES + "run 10\n" + write,
}
for name, text in states.items():
    run(text)
    serial = contents()
    for ranks in RANKS[1:]:
        run(text, ranks=ranks)
        if "run 10" in text:    # the run itself differs in the last bit
            new = read_ply("s.ply")
            open("serial.ply", "wb").write(serial["ply"])
            old = read_ply("serial.ply")
            worst = max(distance(p, q) for p, q in zip(new[0], old[0]))
            claim(f"{name}, {ranks} ranks: as on one", new[1] == old[1] and worst < 1e-10, worst)
        else:
            claim(f"{name}, {ranks} ranks: the same files as on one", contents() == serial)

for start in (TWO, PLANE):
    for ranks in RANKS[:2]:
        plain = thermo(run(box() + start + FORCES + "run 20\nrun 20\n", ranks=ranks))
        mixed = thermo(run(box() + start + FORCES + "run 20\nwrite_membrane s.*.vtp\n"
                           "write_membrane s.*.off subdivide 0\nrun 20\n", ranks=ranks))
        claim(f"a run after it goes on unchanged, {ranks} ranks", plain == mixed and len(plain) > 8,
              plain[-1]["PotEng"])
claim("* stands for the timestep", os.path.exists("s.20.vtp") and os.path.exists("s.20.off"))

# === Wrong input

ready = box() + SPHERE
wrong = {
    "write_membrane": "missing",
    "write_membrane s.obj": "extension off, ply, tsi or vtp",
    "write_membrane s": "extension off, ply, tsi or vtp",
    "write_membrane s.d/s": "extension off, ply, tsi or vtp",
    "write_membrane s.vtp subdivide": "missing",
    "write_membrane s.vtp subdivide -1": "between 0 and 256",
    "write_membrane s.vtp subdivide 1000": "between 0 and 256",
    "write_membrane s.vtp subdivide two": "two",
    "write_membrane s.vtp membrane 3": "membrane 3 does not exist",
    "write_membrane s.vtp fields perhaps": "perhaps",
    "write_membrane s.off fields yes": "no place for fields",
    "write_membrane s.vtp colour red": "Unknown write_membrane keyword colour",
    "write_membrane no/such/folder/s.vtp": "cannot be opened for writing",
}
for command, expected in wrong.items():
    error = error_of(ready + command + "\n")
    claim(f"{command}: one clear error", expected.lower() in error.lower(), error)
for ranks in RANKS[1:2]:
    error = error_of(ready + "write_membrane no/such/folder/s.vtp\n", ranks=ranks)
    claim("two ranks stop together", "cannot be opened for writing" in error, error)
error = error_of(box() + "write_membrane s.vtp\n")
claim("no membrane", "finds no membrane" in error, error)
error = error_of("units lj\natom_style atomic\nregion b block 0 1 0 1 0 1\ncreate_box 1 b\n"
                 "write_membrane s.vtp\n")
claim("another atom style", "atom_style membrane_cp" in error, error)
error = error_of("atom_style membrane_cp\nwrite_membrane s.vtp\n")
claim("no box", "create_box" in error, error)

finish()
