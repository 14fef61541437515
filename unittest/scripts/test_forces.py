"""Forces of pair helfrich are minus the gradient of its energy: every term, every kind of mesh."""
# cost: 15

from lammps_claims import claim, finish, run, thermo
from membrane_scenes import SCENES, coefficients, largest, read_dump, terms_of

# two fix numdiff extrapolate to a difference of fourth order
STEP = 4e-4
# where curvature is unbounded, leaflets change from one law to another within a narrow band at whose edges third derivatives
# jump: differences with a step h err by h^3 there
STEPS, LIMITS = {"leaflets": 1e-4}, {"leaflets": 1e-7}


def numdiff(points, path, step=STEP):
    return f"""
fix             fine {points} numdiff 1 {step}
fix             coarse {points} numdiff 1 {2 * step}
dump            forces {points} custom 1 {path} id fx fy fz f_fine[*] f_coarse[*]
dump_modify     forces format float %24.17g sort id
"""


def numdiff_error(path):
    """Largest difference between forces and differences of the energy, and the largest force, by frame."""
    errors = []
    for frame in read_dump(path):
        force = [f for row in frame.values() for f in row[0:3]]
        difference = [(4 * row[3 + k] - row[6 + k]) / 3 for row in frame.values() for k in range(3)]
        errors.append((largest(f - d for f, d in zip(force, difference)), largest(force)))
    return errors


def every_term(scene, seed=1):
    """One run a term, at some of the points, and one of all terms, at all points; references
    "init" belong to the shape before the shake."""
    script = "group some id 1:9999:4\n"
    for i, term in enumerate(terms_of(scene)):
        points = "all" if term == "all terms" else "some"
        script += (coefficients(term, scene.closed) + "run 0 post no\n" + scene.shake(seed + i) +
                   numdiff(points, f"forces.{i}.dump", STEPS.get(term, STEP)) + "run 0 post no\n"
                   "undump forces\nunfix fine\nunfix coarse\n")
    return script


def check_with_numdiff(name, scene, ranks=1, **options):
    run(scene.setup(**options) + every_term(scene), ranks=ranks)
    how = ", ".join([f"{ranks} ranks"] * (ranks > 1) + [f"{k} {v}" for k, v in options.items()])
    worst = {}
    for i, term in enumerate(terms_of(scene)):
        (error, scale), = numdiff_error(f"forces.{i}.dump")
        worst[term] = error / scale / LIMITS.get(term, 1e-8) if scale > 1e-3 else float("inf")
    where = max(worst, key=worst.get)
    claim(f"{name}{how and ' (' + how + ')'}: forces of each of {len(worst)} terms agree with fix numdiff to 1e-8, leaflets to 1e-7",
          worst[where] < 1, f"worst {worst[where]:.2g} of this ({where})")


# === fix numdiff, term by term

for name, scene in SCENES.items():
    check_with_numdiff(name, scene)
for name, quadrature in (("sphere", 3), ("plane", 1), ("plane", 3), ("plane", 12)):
    check_with_numdiff(name, SCENES[name], quadrature=quadrature)
for name in ("sphere across the corner of the box", "cylinder"):
    check_with_numdiff(name, SCENES[name], before="newton off")
check_with_numdiff("tilted box, sphere across its corner", SCENES["tilted box, sphere across its corner"],
                   ranks=2, before="newton off")

# === Our own central differences: one motion of all control points at once, a new run for each

MOTION = """
variable        dx atom "x + {h} * sin(1.3*id+0.2)"
variable        dy atom "y + {h} * sin(2.1*id+1.0)"
variable        dz atom "z + {h} * cos(0.7*id)"
set             group all x v_dx y v_dy z v_dz
run             0 post no
"""


def work_error(setup, pair):
    """Relative error of the work of the forces along a motion of all control points."""
    from math import cos, sin
    h = 2e-4
    script = setup + pair + "run 0 post no\n" + scene.shake(7) + f"""
dump            forces all custom 1 motion.dump id fx fy fz
dump_modify     forces format float %24.17g
run             0 post no
undump          forces
""" + "".join(MOTION.format(h=step * h) for step in (1, 1, -3, -1))
    rows = thermo(run(script))
    here, e = rows[-5], [row["PotEng"] for row in rows[-4:]]    # at +1, +2, -1, -2
    slope = (8 * (e[0] - e[2]) - (e[1] - e[3])) / (12 * h)
    work = parts = 0.0
    for i, f in read_dump("motion.dump")[0].items():
        w = [f[0] * sin(1.3 * i + 0.2), f[1] * sin(2.1 * i + 1.0), f[2] * cos(0.7 * i)]
        work += sum(w)
        parts += sum(map(abs, w))
    return abs(work + slope) / parts, here


for name, scene in SCENES.items():
    error, _ = work_error(scene.setup(), coefficients("all terms", scene.closed))
    claim(f"{name}: work along a motion of all points is the loss of energy, to 1e-8", error < 1e-8, f"{error:.1e}")

# === Beside other atoms and other styles

scene = SCENES["sphere"]
solvent = """
create_atoms    3 single  1.35  0.2  0.1
create_atoms    3 single -0.3  -1.3  0.3
create_atoms    3 single  0.1   0.1  0.0
create_atoms    3 single  0.3   0.3  0.5
"""
scene.types, scene.commands = 3, scene.commands + solvent
overlay = """
pair_coeff      1 1 helfrich 10.0 0.8 kg 7.0 tension 3.0 area 70.0 9.0 area/local 40.0 volume 60.0 3.0 pressure 1.5
pair_coeff      2 2 helfrich 15.0 -0.4 kg -5.0 tension 5.0 area 70.0 9.0 area/local 40.0 volume 60.0 3.0 pressure 1.5
pair_coeff      *2 3 lj/cut 0.3 0.35
pair_coeff      3 3 lj/cut 0.3 0.35
pair_coeff      1 2 lj/cut 0.0 0.35
"""
for newton in ("on", "off"):
    for first, second in (("helfrich", "lj/cut 1.0"), ("lj/cut 1.0", "helfrich")):
        setup = scene.setup(style=f"hybrid/overlay {first} {second}", before=f"newton {newton}")
        run(setup + overlay + "run 0 post no\n" + scene.shake(5) + numdiff("all", "solvent.dump") +
            "run 0 post no\n")
        (error, scale), = numdiff_error("solvent.dump")
        claim(f"with solvent, hybrid/overlay {first} {second}, newton {newton}: forces agree with fix numdiff to 1e-8",
              error < 1e-8 * scale, f"{error / scale:.1e}")

finish()
