"""Relaxed vesicles have the energies of the axisymmetric minimisers, for each family of shapes.

E/(8 pi kc) at fixed area and volume without spontaneous curvature, from the shape equations of
axisymmetric vesicles."""

import math

from lammps_claims import claim, finish, run, thermo

# family, reduced volume, energy, how a sphere is scaled to start in its basin

SHAPES = [("prolate", 0.90, 1.189644, (1.0, 1.0, 1.7)),
          ("prolate", 0.80, 1.387440, (1.0, 1.0, 2.0)),
          ("oblate", 0.65, 1.826233, (1.0, 1.0, 0.6)),
          ("stomatocyte", 0.55, 1.9839, None)]

RELAX = """
units           lj
atom_style      membrane_cp
region          box block -4 4 -4 4 -4 4
create_box      1 box angle/types 1
{create}
pair_style      helfrich
pair_coeff      1 1 1.0 0.0
compute         e all pair helfrich
thermo_style    custom step c_e[1] c_e[5] c_e[6]
thermo_modify   norm no format float %.15g
run             0 post no
variable        A equal $(c_e[5])
variable        V equal {v}*4*PI/3*(v_A/4/PI)^1.5
variable        area equal $(v_A)
variable        volume equal $(v_V)
min_style       membrane
pair_coeff      1 1 1.0 0.0 area 1.0e4 ${{area}} volume 1.0e4 ${{volume}}
minimize        1.0e-7 0.0 400 4000
variable        area equal $(2*v_A-c_e[5])
variable        volume equal $(2*v_V-c_e[6])
pair_coeff      1 1 1.0 0.0 area 1.0e4 ${{area}} volume 1.0e4 ${{volume}}
minimize        1.0e-8 0.0 600 6000
"""

CONTROL_MESH = """
units           lj
atom_style      membrane_cp
region          box block -4 4 -4 4 -4 4
create_box      1 box angle/types 1
create_membrane 1 sphere 3 1.0
write_membrane  sphere.off subdivide 0
"""


def dent(inner, rim):
    """Push the top of the sphere in: the polar angle becomes arc length along a cup's section."""
    with open("sphere.off") as file:
        lines = file.read().split("\n")
    counts = next(i for i, line in enumerate(lines) if line.split()[:1] and line.split()[0].isdigit())
    points = int(lines[counts].split()[0])
    # section: from the bottom of the pocket up its wall, over the rim, down outside to the south pole
    wall, over = 0.5 * math.pi * inner, math.pi * rim
    outside = 0.5 * math.pi * (inner + 2.0 * rim)
    total = wall + over + outside
    for i in range(counts + 1, counts + 1 + points):
        x, y, z = (float(word) for word in lines[i].split()[:3])
        s = math.acos(max(-1.0, min(1.0, z))) / math.pi * total
        if s < wall:
            a = s / inner
            r, h = inner * math.sin(a), -inner * math.cos(a)
        elif s < wall + over:
            a = (s - wall) / rim
            r, h = inner + rim - rim * math.cos(a), rim * math.sin(a)
        else:
            radius = inner + 2.0 * rim
            a = (s - wall - over) / radius
            r, h = radius * math.cos(a), -radius * math.sin(a)
        along = math.hypot(x, y) or 1.0
        lines[i] = f"{r * x / along:.15g} {r * y / along:.15g} {h:.15g}"
    with open("cup.off", "w") as file:
        file.write("\n".join(lines))


run(CONTROL_MESH)
dent(0.55, 0.25)

for family, v, energy, scale in SHAPES:
    create = "create_membrane 1 file cup.off" if scale is None else \
        "create_membrane 1 sphere 3 1.0 interpolate yes scale {} {} {}".format(*scale)
    row = thermo(run(RELAX.format(create=create, v=v)))[-1]
    area, volume = row["c_e[5]"], row["c_e[6]"]
    reduced = volume / (4 * math.pi / 3 * (area / (4 * math.pi)) ** 1.5)
    ratio = row["c_e[1]"] / (8 * math.pi)
    claim(f"{family} of 642 points: reduced volume {v}", abs(reduced - v) < 2e-4, f"{reduced:.6f}")
    claim(f"{family} at {v}: energy {energy} within 0.5 %", abs(ratio / energy - 1) < 5e-3,
          f"{ratio:.6f}, {100 * (ratio / energy - 1):+.3f} %")

finish()
