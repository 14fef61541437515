#!/usr/bin/env python3
"""Meshes and scenes that are hard on the numerics, for Howto_membrane_accuracy: what holds, what breaks, what
LAMMPS says.

  bench/hard_cases.py [STUDY ...] [--out accuracy] [--steps 1000000]

Studies: meshes, needles, neck, sheets, patches, beside, corner, long; by default all of them, a quarter of an
hour. LMP names another executable than build/lmp. Each writes OUT/hard_STUDY.csv. --steps is the length of
the long runs."""

import argparse
import csv
import math
import os
import re
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
LMP = os.environ.get("LMP", os.path.join(ROOT, "build", "lmp"))
sys.path.insert(0, os.path.join(ROOT, "unittest", "scripts"))
from membrane_scenes import bipyramid    # noqa: E402

def lammps(script, files=None, fetch=None):
    """Run a script in a folder of its own that has these files {name: text}; exit code and output, or with
    fetch what is then in the file of that name."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (files or {}).items():
            with open(os.path.join(folder, name), "w") as file:
                file.write(text)
        with open(os.path.join(folder, "in.study"), "w") as file:
            file.write(script)
        done = subprocess.run([LMP, "-in", "in.study", "-log", "none"], stdin=subprocess.DEVNULL, cwd=folder,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if fetch and not done.returncode:
            with open(os.path.join(folder, fetch)) as file:
                return 0, file.read()
    return done.returncode, done.stdout


def run(script, files=None, fetch=None):
    """Run a script that must succeed."""
    code, output = lammps(script, files, fetch)
    if code:
        sys.exit(f"{script}\n{output[-2000:]}\nthis failed")
    return output


def thermo(output):
    """Rows of all thermo tables as dictionaries."""
    rows, columns = [], None
    for line in output.splitlines():
        words = line.split()
        if words[:1] == ["Step"]:
            columns = words
        elif words[:2] == ["Loop", "time"]:
            columns = None
        elif columns and len(words) == len(columns):
            try:
                rows.append(dict(zip(columns, map(float, words))))
            except ValueError:
                pass    # a warning amid the table
    return rows


def processor_seconds(output, part="Loop"):
    """Per atom and step of the last loop, or of a part of it, or of what is neither Pair nor Modify: Rest.
    Processor time, not wall time: what other programs take meanwhile does not count."""
    loop = re.findall(r"Loop time of (\S+) on \d+ procs for (\d+) steps with (\d+) atoms", output)[-1]
    share = float(re.findall(r"^([\d.]+)% CPU use", output, re.M)[-1]) / 100
    parts = {name: float(wall) for name, wall in
             re.findall(r"^(Pair|Modify)\s*\|\s*\S+\s*\|\s*(\S+)", output, re.M)}
    parts["Loop"] = float(loop[0])
    parts["Rest"] = parts["Loop"] - parts["Pair"] - parts["Modify"]
    return parts[part] * share / int(loop[1]) / int(loop[2])


def write_off(points, faces):
    return (f"OFF\n{len(points)} {len(faces)} 0\n" + "".join("%.17g %.17g %.17g\n" % tuple(p) for p in points) +
            "".join("3 %d %d %d\n" % tuple(f) for f in faces))


def mean(values):
    return sum(values) / len(values)


def spread(values):
    centre = mean(values)
    return math.sqrt(mean([(v - centre) ** 2 for v in values]))


def write(path, head, rows):
    with open(path, "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([head, *rows])
    print(f"wrote {path}", flush=True)


SCENE = """
units           lj
atom_style      membrane_cp
region          box block {box}
create_box      2 box angle/types 1
{create}
set             group all mass 1.0
special_bonds   lj/coul 1 1 1
pair_style      helfrich quadrature {rule}
pair_coeff      * * 1.0 0.0
{coefficients}
compute         hf all pair helfrich
compute         s all membrane/shape
"""
BOX = "-3 3 -3 3 -3 3"
PRINT = "thermo_modify   norm no format float %.17g\n"


def read_off(path):
    with open(path) as file:
        words = [line.split() for line in file if line.strip() and not line.startswith("#")][1:]
    n, m = int(words[0][0]), int(words[0][1])
    return ([[float(x) for x in row[:3]] for row in words[1:n + 1]],
            [[int(i) for i in row[1:4]] for row in words[n + 1:n + m + 1]])


def dumbbell(waist, length=1.5):
    """The icosphere with its waist drawn in."""
    points, faces = read_off(os.path.join(ROOT, "unittest", "meshes", "icosphere_2.off"))
    return [(x * w, y * w, length * z) for x, y, z in points for w in (waist + (1 - waist) * min(1.0, z * z / 0.25),)], faces


def case(create, box=BOX, coefficients="", tiny=1e-6, files=None):
    return dict(create=create, box=box, coefficients=coefficients, tiny=tiny, files=files or {})


def scene(chosen, rule="6"):
    return SCENE.format(rule=rule, **{key: chosen[key] for key in ("create", "box", "coefficients")})


MESHES = {}
for n in (3, 4, 5, 7, 8, 10, 12, 14, 16):
    MESHES[f"valence {n}"] = case("create_membrane 1 file mesh.off refine 2", files={"mesh.off": write_off(*bipyramid(n))})
for ratio in (10, 50):
    MESHES[f"needles, edge ratio {ratio}"] = case(
        "create_membrane 1 plane 8 8\ndisplace_atoms all random 0 0 0.002 1 units box", f"0 {8 / ratio} 0 8 -2 2", tiny=1e-8)
    MESHES[f"flat triangles, base to height {ratio}"] = case(
        "create_membrane 1 plane 8 8\ndisplace_atoms all random 0 0 0.002 1 units box", f"0 8 0 {8 / ratio} -2 2", tiny=1e-8)
MESHES["neck of 1/100 of the radius"] = case("create_membrane 1 file neck.off refine 1",
                                             files={"neck.off": write_off(*dumbbell(0.01))})
MESHES["kc 0.01 and 100 on one sphere"] = case(
    "create_membrane 1 sphere 2 1.0 interpolate yes\nregion half block INF INF INF INF INF 0\nset region half type 2",
    coefficients="pair_coeff 1 1 0.01 0.0\npair_coeff 2 2 100.0 0.0")
MESHES["42 points beside 40962"] = case("create_membrane 1 sphere 6 1.5 center -1 0 0\n"
                                        "create_membrane 2 sphere 1 0.5 center 2 0 0")
MESHES["sheets 1/100 of an edge apart"] = case(
    "create_membrane 1 plane 8 8\ncreate_membrane 2 plane 8 8\ndisplace_atoms all random 0 0 0.05 1 units box\n"
    "group upper type 2\ndisplace_atoms upper move 0 0 0.01 units box", box="0 8 0 6.928203 -2 2")
MESHES["sphere across all corners of the box"] = case("create_membrane 1 sphere 2 1.2 center 3 3 3")


def difference_quotients(chosen):
    """Largest deviation of forces from differences of the energy, over the largest force of three points."""
    tiny = chosen["tiny"]
    script = scene(chosen) + "thermo_style custom step pe\n" + PRINT + "variable n equal count(all)\n"
    for fraction in (0.0, 0.37, 1.0):
        script += f"variable i equal 1+floor({fraction}*(v_n-1))\ngroup one id ${{i}}\n"
        for axis, name in enumerate("xyz"):
            step = ["0"] * 3
            step[axis] = f"{tiny:.17g}"
            back = [("-" + word if word != "0" else word) for word in step]
            there, back = " ".join(step), " ".join(back)
            script += f"""
compute         f one reduce sum f{name}
thermo_style    custom step pe c_f
{PRINT}
run             0 post no
displace_atoms  one move {there} units box
run             0 post no
displace_atoms  one move {back} units box
displace_atoms  one move {back} units box
run             0 post no
displace_atoms  one move {there} units box
thermo_style    custom step pe
uncompute       f
"""
        script += "group one delete\n"
    rows = thermo(run(script, chosen["files"]))
    forces = [row["c_f"] for row in rows[0::3]]
    estimates = [(rows[i + 2]["PotEng"] - rows[i + 1]["PotEng"]) / (2 * tiny) for i in range(0, len(rows), 3)]
    return max(abs(a - b) for a, b in zip(forces, estimates)) / max(max(map(abs, forces)), 1e-300)


def conserve(chosen, dt, steps):
    """Spread of the total energy, and the worst residual and the passes of the mass matrix solution."""
    data = thermo(run(scene(chosen) + f"""
fix             1 all hd/nve solver iterative
fix_modify      1 check no
hd_velocity     all 1e-6 4711 tol 1e-13
compute         T all hd/temp
thermo_style    custom step etotal f_1[1] f_1[2]
thermo_modify   temp T
{PRINT}
thermo          1
timestep        {dt!r}
run             {steps}
""", chosen["files"]))
    return (spread([row["TotEng"] for row in data]), max(row["f_1[2]"] for row in data[1:]),
            max(row["f_1[1]"] for row in data[1:]))


MESHES_HEAD = ("case", "edges", "error of forces", "error of quadrature 6", "stability limit",
               "order of the energy error", "residual at tol 1e-10", "passes")


def meshes(_):
    rows = []
    for name, chosen in MESHES.items():
        energies = {rule: thermo(run(scene(chosen, rule) + "thermo_style custom step c_hf[1] c_s[7] c_s[8] c_s[9]\n" +
                                     PRINT + "run 0\n", chosen["files"]))[-1] for rule in ("6", "careful")}
        limit = float(re.search(r"stability limit\s+(\S+)",
                                run(scene(chosen) + "hd_timestep all tol 1e-13\n", chosen["files"]))[1])
        coarse, residual, passes = conserve(chosen, 0.2 * limit, 40)
        fine, _, _ = conserve(chosen, 0.1 * limit, 80)
        last = energies["careful"]
        rows.append((name, f"{last['c_s[7]']:.2g} to {last['c_s[8]']:.2g}", f"{difference_quotients(chosen):.0e}",
                     f"{energies['6']['c_hf[1]'] / last['c_hf[1]'] - 1:.0e}", f"{limit:.2g}",
                     f"{math.log2(coarse / fine):.2f}", f"{residual:.0e}", f"{passes:.0f}"))
        print(" | ".join(rows[-1]), flush=True)
    return rows


# === Scenes over time. Each returns rows (scene, what happens, what LAMMPS says).

def remark(output):
    """The last error, or else the first warning that is not about angles."""
    errors = re.findall(r"^ERROR[^:]*: (.*?)(?: \(src.*)?$", output, re.M)
    warnings = [w for w in re.findall(r"^WARNING: (.*?)(?: \(src.*)?$", output, re.M) if "ngles" not in w]
    return ("error: " + errors[0]) if errors else ("warning: " + warnings[0]) if warnings else "nothing"


KT = 0.05     # kc = 20 kT


def thermal(create, terms, steps, fraction=0.25, before="", files=None, every=200, box=BOX, fix_options="", cutoff="4.0"):
    """A thermal run at a fraction of the stability limit at its start; thermo rows and what is said."""
    start = f"""
units           lj
atom_style      membrane_cp
region          box block {box}
create_box      2 box angle/types 1
{create}
special_bonds   lj/coul 1 1 1
comm_modify     cutoff {cutoff}
pair_style      helfrich
pair_coeff      * * 1.0 0.0 {terms}
compute         hf all pair helfrich
compute         s all membrane/shape
compute         T all hd/temp
fix             1 all hd/langevin {KT} {KT} 0.2 4711 measure no {fix_options}
"""
    limit = float(re.search(r"stability limit\s+(\S+)", run(start + "hd_timestep all\n", files))[1])
    _, output = lammps(start + before + f"""
thermo_style    custom step pe c_T c_hf[1] c_s[1] c_s[2] c_s[7] c_s[8] c_s[9]
thermo_modify   norm no
thermo          {every}
timestep        {fraction * limit!r}
run             {steps}
""", files)
    return thermo(output), remark(output), limit


def ended(rows, steps):
    last = rows[-1]["Step"]
    return f"runs all {steps} steps" if last >= steps else f"stops after step {last:.0f}"


TOTALS = "area 100.0 init volume 100.0 init"


def needles(_):
    rows = []
    for name, create in (("ellipsoid 4 x 1 x 0.4", "create_membrane 1 sphere 2 1.0 scale 2 0.5 0.2"),
                         ("pancake 50 : 1", "create_membrane 1 sphere 2 1.0 scale 1 1 0.02"),
                         ("torus, faces of 2 degrees", "create_membrane 1 torus 8 16 1.5 0.3")):
        for terms in ("", "regularize 0.5"):
            data, says, limit = thermal(create, f"{TOTALS} {terms}", 20000)
            if not data:
                rows.append((f"{name}, thermal, {terms or 'no regularize'}", "does not start", says))
                continue
            angle = min(row["c_s[9]"] for row in data)
            rows.append((f"{name}, thermal, {terms or 'no regularize'}", f"{ended(data, 20000)} at a quarter of the limit; "
                         f"smallest angle {data[0]['c_s[9]']:.1f} to {data[-1]['c_s[9]']:.1f}, least {angle:.1f}", says))
    return rows


def neck(_):
    """Two spheres are the shape without bending energy for c0 = 2 sqrt(2)/R at v = 1/sqrt(2): the neck closes."""
    rows = []
    for rule, terms in (("6", ""), ("6", "regularize 0.01"), ("12", "regularize 0.01")):
        area, volume = 4 * math.pi, 4 * math.pi / 3 * math.sqrt(0.5)
        code, output = lammps(f"""
units           lj
atom_style      membrane_cp
region          box block {BOX}
create_box      1 box angle/types 1
create_membrane 1 file neck.off refine 1
special_bonds   lj/coul 1 1 1
comm_modify     cutoff 2.0
pair_style      helfrich quadrature {rule}
pair_coeff      1 1 1.0 {2 * math.sqrt(2)!r} area 1000.0 {area!r} volume 1000.0 {volume!r} {terms}
compute         hf all pair helfrich
compute         c all membrane/curvature/atom
compute         s all membrane/shape quadrature careful
variable        r atom sqrt(c_c[3]^2+c_c[4]^2)+10*(abs(c_c[5])>0.3)
compute         neck all reduce min v_r
thermo_style    custom step c_hf[1] c_neck c_s[3] c_s[5] c_s[7] c_s[9] c_s[4] c_s[1]
thermo_modify   norm no
thermo          100
min_style       membrane
minimize        0 0 2000 20000
""", {"neck.off": write_off(*dumbbell(0.3, 1.4))})
        data = thermo(output)
        last, c0 = data[-1], 2 * math.sqrt(2)
        careful = last["c_s[5]"] - 2 * c0 * last["c_s[4]"] + 0.5 * c0 ** 2 * last["c_s[1]"]
        rows.append((f"neck that closes, quadrature {rule}, {terms or 'no regularize'}",
                     f"radius {data[0]['c_neck']:.3f} to {last['c_neck']:.3f}; shortest edge {last['c_s[7]']:.3f}; "
                     f"energy {last['c_hf[1]'] / 8 / math.pi:.4f} of 8 pi kc by the rule, {careful / 8 / math.pi:.4f} "
                     f"by careful; smallest angle {last['c_s[9]']:.1f}", remark(output)))
    return rows


def sheets(_):
    """Two thermal sheets a third of an edge apart, without and with a repulsion of their control points."""
    rows = []
    width = 12 * math.sqrt(0.75)
    for name, style, coefficients in (
            ("no interaction", "helfrich", "pair_coeff * * 1.0 0.0 regularize 0.5"),
            ("soft repulsion of control points", "hybrid/overlay helfrich soft 1.0",
             "pair_coeff * * helfrich 1.0 0.0 regularize 0.5\npair_coeff 1 2 soft 0.5 1.0\n"
             "pair_coeff 1 1 soft 0.0 0.1\npair_coeff 2 2 soft 0.0 0.1")):
        script = f"""
units           lj
atom_style      membrane_cp
region          box block 0 12 0 {width!r} -6 6
create_box      2 box angle/types 1
create_membrane 1 plane 12 12 mass {math.sqrt(0.75)!r}
create_membrane 2 plane 12 12 mass {math.sqrt(0.75)!r}
group           upper type 2
displace_atoms  upper move 0 0 0.3 units box
special_bonds   lj/coul 1 1 1
comm_modify     cutoff 5.0
pair_style      {style}
{coefficients}
neigh_modify    delay 0 every 1 check yes
group           lower type 1
fix             1 all hd/langevin {KT} {KT} 3.0 4711 measure no
compute         m1 lower hd/modes plane 1
compute         m2 upper hd/modes plane 1
variable        gap equal c_m2[1]-c_m1[1]
thermo_style    custom step pe v_gap
thermo_modify   norm no
thermo          200
timestep        0.05
dump            1 all custom 1000 sheets.dump id type x y z
run             20000
"""
        code, output = lammps(script)
        data = thermo(output)
        crossed = 0
        if not code:
            frames = run(script, fetch="sheets.dump").split("ITEM: ATOMS")[1:]
            crossed = max(crossings(frame, 12.0, width) for frame in frames)
        gaps = [row["v_gap"] for row in data]
        rows.append((f"two sheets, {name}", f"{ended(data, 20000)}; mean gap {gaps[0]:.2f}, later {min(gaps):.2f} to "
                     f"{max(gaps):.2f}; at most {crossed} of 144 points beyond the other sheet", remark(output)))
    return rows


def crossings(frame, lx, ly):
    """Points of type 1 above the nearest point of type 2 in the plane."""
    atoms = [[float(word) for word in line.split()] for line in frame.splitlines()[1:] if len(line.split()) == 5]
    lower, upper = ([a[2:] for a in atoms if a[1] == kind] for kind in (1, 2))

    def apart(a, b):
        x, y = a[0] - b[0], a[1] - b[1]
        return (x - lx * round(x / lx)) ** 2 + (y - ly * round(y / ly)) ** 2

    return sum(a[2] > min(upper, key=lambda b: apart(a, b))[2] for a in lower)


def patches(_):
    """kc of 0.01 and 100 on halves of a vesicle: relaxation, and a thermal run."""
    rows = []
    for name, coefficients in (("kc = 1", "pair_coeff 1 1 1.0 0.0 {0}\npair_coeff 2 2 1.0 0.0 {0}"),
                               ("kc = 0.01 and 100", "pair_coeff 1 1 0.01 0.0 {0}\npair_coeff 2 2 100.0 0.0 {0}")):
        chosen = case("create_membrane 1 sphere 2 1.0 interpolate yes scale 1 1 1.3\n"
                      "region half block INF INF INF INF INF 0\nset region half type 2",
                      coefficients=coefficients.format("area 1000.0 init volume 1000.0 init regularize 1.0"))
        output = run(scene(chosen) + "thermo_style custom step pe c_hf[1] c_s[3] c_s[9]\n" + PRINT +
                     "min_style membrane\nminimize 0 1e-5 5000 50000\nhd_timestep all\n")
        data = thermo(output)
        iterations, evaluations = re.findall(r"force evaluations = (\d+) (\d+)", output)[0]
        rows.append((f"prolate vesicle, {name}, relaxed", f"{iterations} iterations, {evaluations} evaluations, "
                     f"{re.findall('Stopping criterion = (.*)', output)[0]}; bending energy {data[0]['c_hf[1]']:.3f} to "
                     f"{data[-1]['c_hf[1]']:.3f}; stability limit {re.findall(r'stability limit +(.*)', output)[0]}",
                     remark(output)))
    return rows


def beside(_):
    """42 points beside 40,962: does either know of the other, and who pays?"""
    both = ("create_membrane 1 sphere 6 1.5 center -1 0 0", "create_membrane 2 sphere 1 0.5 center 2 0 0")
    results = {}
    for name, create in (("both", "\n".join(both)), ("large", both[0]), ("small", both[1])):
        chosen = case(create, coefficients="pair_coeff * * 1.0 0.0 area 10.0 init volume 10.0 init")
        output = run(scene(chosen) + f"""
group           small type 2
group           large type 1
compute         w small membrane/shape
fix             1 all hd/nve
{'hd_timestep all' if name == 'both' else ''}
{'hd_timestep large' if name == 'both' else ''}
{'hd_timestep small' if name == 'both' else ''}
thermo_style    custom step c_w[1] c_w[5]
{PRINT}
thermo          100
timestep        1e-6
run             100
""")
        count = {"both": 41004, "large": 40962, "small": 42}[name]
        results[name] = (processor_seconds(output) * count, thermo(output)[-1], output)
    limits = re.findall(r"stability limit\s+(\S+)", results["both"][2])
    apart = abs(results["both"][1]["c_w[5]"] / results["small"][1]["c_w[5]"] - 1)
    ratio = results["both"][0] / (results["large"][0] + results["small"][0])
    return [("42 points beside 40962", f"a step takes {ratio:.2f} of the two alone; after 100 steps the small membrane is "
             f"what it is alone to {apart:.0e}; stability limits {limits[0]} of both, {limits[1]} and {limits[2]} of each: "
             "the finer mesh decides", remark(results["both"][2]))]


def corner(_):
    """A sphere across all corners of the box, and the same in its middle."""
    last = {}
    for where in ("0 0 0", "3 3 3"):
        chosen = case(f"create_membrane 1 sphere 2 1.2 scale 1 1 1.3 center {where}",
                      coefficients="pair_coeff * * 1.0 0.0 area 10.0 init volume 10.0 init regularize 0.1")
        output = run(scene(chosen) + f"""
fix             1 all hd/nve tol 1e-13
fix             2 all momentum 1 linear 1 1 1
thermo_style    custom step pe c_s[1] c_s[2]
{PRINT}
thermo          1000
timestep        0.002
run             5000
""")
        last[where] = thermo(output)
    a, b = last["0 0 0"], last["3 3 3"]
    return [("a sphere across all corners of the box", f"energies are those in the middle of the box to "
             f"{max(abs(x['PotEng'] / y['PotEng'] - 1) for x, y in zip(a, b)):.0e} over 5000 steps, volumes to "
             f"{max(abs(x['c_s[2]'] / y['c_s[2]'] - 1) for x, y in zip(a, b)):.0e}", remark(output))]


def long(steps):
    """Thermal runs of a small vesicle and a sheet, kc = 20 kT."""
    rows = []
    width = 12 * math.sqrt(0.75)
    vesicle = ("vesicle of 162 points", "create_membrane 1 sphere 2 1.0 interpolate yes mass 0.0776", BOX, TOTALS, 162)
    sheet = ("sheet of 144 points", f"create_membrane 1 plane 12 12 mass {math.sqrt(0.75)!r}",
             f"0 12 0 {width!r} -6 6", "", 144)
    for name, create, box, terms, points in (vesicle, sheet):
        for extra in ("", "regularize 0.1", "regularize 0.5"):
            data, says, limit = thermal(create, f"{terms} {extra}", steps, box=box, every=max(1, steps // 500),
                                        fix_options="tol 1e-8")
            text = f"{ended(data, steps)}; smallest angle, least {min(row['c_s[9]'] for row in data):.1f}"
            if data[-1]["Step"] >= steps:
                half = len(data) // 2
                energies = [mean([row["c_hf[1]"] for row in part]) / points / KT for part in (data[20:half], data[half:])]
                text += (f"; temperature {mean([row['c_T'] for row in data[20:]]) / KT:.3f} of the bath's; bending energy "
                         f"{energies[0]:.3f} kT a point in the first half, {energies[1]:.3f} in the second")
            rows.append((f"{name}, {extra or 'no regularize'}, {steps} steps", text, says))
            print(" | ".join(rows[-1]), flush=True)
    return rows


STUDIES = {study.__name__: study for study in (meshes, needles, neck, sheets, patches, beside, corner, long)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("studies", nargs="*", metavar="STUDY", default=list(STUDIES))
    parser.add_argument("--out", default=".")
    parser.add_argument("--steps", type=int, default=1000000)
    options = parser.parse_args()
    for name in options.studies:
        if name not in STUDIES:
            sys.exit(f"there is no study {name}; there are {' '.join(STUDIES)}")
    os.makedirs(options.out, exist_ok=True)
    for name in options.studies:
        rows = STUDIES[name](options.steps)
        head = MESHES_HEAD if name == "meshes" else ("scene", "what happens", "what LAMMPS says")
        for row in rows if name not in ("meshes", "long") else ():
            print(" | ".join(row), flush=True)
        write(os.path.join(options.out, f"hard_{name}.csv"), head, rows)


if __name__ == "__main__":
    main()
