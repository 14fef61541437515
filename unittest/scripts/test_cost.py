"""What is not in the scene costs nothing: quadrature points evaluated in a step, c_hf[8], counted."""

from lammps_claims import claim, error_of, finish, run, thermo

SCENE = """
units           lj
atom_style      membrane_cp
region          box block -4 4 -4 4 -4 4
create_box      3 box angle/types 1
{create}
pair_style      helfrich quadrature {rule}
pair_coeff      * * 10.0 0.0 {terms}
compute         hf all pair helfrich
thermo_style    custom step pe c_hf[1] c_hf[5] c_hf[8]
thermo_modify   norm no format float %.16g
{commands}
run             {steps}
"""
# a sheet: all faces regular, so a face has as many points as the rule
SHEET = "create_membrane 1 plane 12 12"
FACES = 2 * 12 * 12
TWO = "create_membrane 1 sphere 2 1.0 center -2 0 0\ncreate_membrane 2 sphere 2 1.0 center 2 0 0"


def rows(create=SHEET, rule=3, terms="", commands="", steps=0, ranks=1):
    return thermo(run(SCENE.format(create=create, rule=rule, terms=terms, commands=commands, steps=steps),
                      ranks=ranks))


def points(**scene):
    return rows(**scene)[-1]["c_hf[8]"]


for rule in (1, 3, 6, 12):
    claim(f"quadrature {rule}: one pass over the faces", points(rule=rule) == rule * FACES)
for terms in ("", "tension 1.0", "kg 2.0", "regularize 0.1"):
    claim(f"'{terms}' needs no second pass", points(terms=terms) == 3 * FACES)
for terms in ("area 10.0 init", "area/local 10.0"):
    claim(f"'{terms}' needs totals first: two passes", points(terms=terms) == 6 * FACES)

# === Frozen parts

FREEZE = """
group           frozen {}
neigh_modify    exclude group frozen frozen
fix             hold frozen setforce 0.0 0.0 0.0
"""
whole = rows(create=TWO)[-1]
for ranks in (1, 2):
    row = rows(create=TWO, commands=FREEZE.format("molecule 2"), ranks=ranks)[-1]
    claim(f"{ranks} rank(s): a frozen membrane costs nothing and has no energy",
          row["c_hf[8]"] == whole["c_hf[8]"] / 2 and abs(row["PotEng"] / whole["PotEng"] - 0.5) < 1e-12,
          row["c_hf[8]"])
row = rows(create=TWO, terms="area 10.0 init volume 10.0 init", commands=FREEZE.format("molecule 2"))[-1]
claim("also with terms of whole membranes", abs(row["c_hf[5]"] / whole["c_hf[5]"] - 0.5) < 1e-12)
error = error_of(SCENE.format(create=TWO, rule=3, terms="area 10.0 init", steps=0,
                              commands=FREEZE.format("id 1:100")))
claim("a part of a membrane with such terms is refused", "area or volume terms need all of it" in error,
      error)

HALF = FREEZE.format("type 2")
MARK = "region half block INF INF -4 0.1 INF INF\nset region half type 2\n"
SHAKE = "displace_atoms all random 0 0 0.05 7\n"
MOVE = ("group free type 1\ndump 1 free custom 1 f.dump id fx fy fz\n"
        "dump_modify 1 format float %.17g sort id\n")


def forces():
    return [line.split() for line in open("f.dump").read().split("ITEM: ATOMS id fx fy fz\n")[1].split("\n")[:-1]]


all_points = points(commands=MARK + SHAKE + MOVE)
before = forces()
some = points(commands=MARK + SHAKE + HALF + MOVE)
after = forces()
claim("half a sheet frozen: fewer points", 0.3 * all_points < some < 0.8 * all_points,
      f"{some:.0f} of {all_points:.0f}")
apart = max(abs(float(a) - float(b)) for p, q in zip(before, after) for a, b in zip(p[1:], q[1:]))
claim("and the same forces on what is free", len(before) == len(after) > 50 and apart < 1e-12, apart)

finish()
