"""hd_timestep finds the stability limit, leaves no trace, and the integrators stop beyond the limit."""
# cost: 15

import math
import re

from lammps_claims import claim, error_of, finish, lammps, run, thermo

PLANE = """
units           lj
atom_style      membrane_cp
region          box block 0 {lx:.17g} 0 {ly:.17g} -9 9
create_box      1 box angle/types 1
create_membrane 1 plane 12 12
set             type 1 mass {mass:.17g}
pair_style      helfrich quadrature {quadrature}
pair_coeff      1 1 {kc} 0.0 {terms}
"""
SPHERE = """
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
create_box      1 box angle/types 1
create_membrane 1 sphere {level} 1.0 interpolate yes center 2.5 0 0
set             type 1 mass {mass:.17g}
pair_style      helfrich
pair_coeff      1 1 10.0 0.0 area 1000.0 init volume 1000.0 init
compute         T all hd/temp
thermo_style    custom step pe ke etotal c_T press
thermo_modify   temp T norm no format float %.17g
"""


def plane(h=1.0, kc=1.0, rho=1.0, quadrature=6, terms=""):
    """Equilateral triangles of edge h; the mass of a vertex is rho times its area."""
    return PLANE.format(lx=12 * h, ly=12 * h * math.sqrt(3) / 2, mass=rho * h * h * math.sqrt(3) / 2,
                        kc=kc, quadrature=quadrature, terms=terms)


def sphere(level):
    """Of density 1 per area."""
    return SPHERE.format(level=level, mass=4 * math.pi / (10 * 4**level + 2))


def number(name, output):
    return float(re.findall(rf"^ *{name} +([\d.e+-]+)", output, re.MULTILINE)[-1])


# === Largest frequencies, against Fourier analysis of the infinite lattice

H, KC, RHO = 0.7, 3.0, 2.0
for quadrature, mass, exact in (
        (1, "vertex", 5.45000), (1, "consistent", 7.65259), (1, "lumped", 2.30940),
        (3, "vertex", 10.00000), (3, "consistent", 18.04387), (3, "lumped", 3.07920),
        (6, "vertex", 9.79796), (6, "consistent", 17.67931), (6, "lumped", 3.07920)):
    output = run(plane(H, KC, RHO, quadrature) + f"hd_timestep all mass {mass}\n")
    found = number("largest frequency", output) * H**2 * math.sqrt(RHO / KC)
    limit = number("stability limit", output) / H**2 * math.sqrt(KC / RHO)
    claim(f"plane, quadrature {quadrature}, mass {mass}: largest frequency and limit as on the "
          "infinite lattice", abs(found / exact - 1) < 1e-5 and abs(limit * exact / 2 - 1) < 1e-5,
          f"{found:.5f} {exact:.5f}")

output = run(plane(10.0, 1.0, 5.0).replace("units           lj", "units           metal") +
             "hd_timestep all\n")
EV = 1.602176634e-19 / 1.66053906660e-27 * 1e-4    # in (g/mol) (Angstrom/ps)^2
exact = 9.79796 * math.sqrt(EV / 5.0) / 100
claim("units metal: frequency per picosecond", abs(number("largest frequency", output) / exact - 1) < 1e-5,
      f"{number('largest frequency', output)} {exact:.6g}")

# === Periods of modes

TENSION = 4.0
output = run(plane(0.5, 2.0, 3.0, terms=f"tension {TENSION}") + "hd_timestep all mode wavelength 3.2\n")
q = 2 * math.pi / 3.0    # two waves in the box
exact = 2 * math.pi / math.sqrt((2.0 * q**4 + TENSION * q**2) / 3.0)
found = number("period of wavelength 3", output)
claim("a wavelength that does not fit is told", "the one of 3 is nearest to 3.2" in output)
claim("plane: the period of a wave that fits into the box", abs(found / exact - 1) < 2e-3,
      f"{found} {exact:.6g}")
for degree in (2, 3, 4, 5):
    output = run(sphere(3) + f"hd_timestep all mode degree {degree}\n")
    l = degree
    exact = 2 * math.pi / math.sqrt(10.0 * (l - 1) * l * (l + 1) * (l + 2))
    found = number(f"period of degree {degree}", output)
    claim(f"sphere: the period of degree {degree} within 2 % of theory at 642 points",
          abs(found / exact - 1) < 0.02, f"{found} {exact:.6g}")

# === Ranks

limits = [number("stability limit", run(sphere(2) + "displace_atoms all random 0.02 0.02 0.02 1\n"
                                        "hd_timestep all\n", ranks=ranks)) for ranks in (1, 2, 4)]
claim("1, 2 and 4 ranks find the same limit", max(limits) / min(limits) - 1 < 2e-6, limits)

# === No trace, once coordinates are wrapped into the box, as each start of a run does

STATE = "write_dump all custom {} id x y z ix iy iz vx vy vz modify sort id format float %.17g\n"
HISTORY = sphere(2) + """
fix 1 all hd/langevin 0.01 0.01 1.0 4711 measure no
timestep 0.0005
{early}
hd_velocity all 0.01 4711 mom no
run 60 post no
write_restart   wrap.restart
{before}
{probe}
{after}
write_data      end.data
print           "pe $(pe) press $(press) dt $(dt) time $(time)"
run             60 post no
"""


def history(early="", probe="", ranks=1):
    fill = dict(early=early, probe=probe, before=STATE.format("before.dump"),
                after=STATE.format("after.dump"))
    output = run(HISTORY.format(**fill) + STATE.format("end.dump"), ranks=ranks)
    return [open(name, "rb").read() for name in
            ("before.dump", "after.dump", "end.dump")], output


for ranks in (1, 2):
    plain, plain_output = history(ranks=ranks)
    probed, output = history(probe="hd_timestep all mode degree 2", ranks=ranks)
    early, _ = history(early="hd_timestep all", ranks=ranks)
    claim(f"{ranks} rank(s): the state after the command is that of before, bit by bit",
          probed[0] == probed[1] == plain[0])
    claim(f"{ranks} rank(s): a trajectory goes on as if nothing had happened, bit by bit",
          probed[2] == plain[2])
    claim(f"{ranks} rank(s): nor does it notice the command before the first run", early == plain)
    energy = [list(map(float, re.findall(r"^pe (\S+) press (\S+) dt (\S+) time (\S+)", text,
                                         re.MULTILINE)[0])) for text in (plain_output, output)]
    claim(f"{ranks} rank(s): energy, pressure and time keep their values",
          all(abs(a - b) <= 1e-12 * abs(a) for a, b in zip(*energy)), energy)

for more in ("", " mass lumped"):
    script = f"""
units           lj
atom_style      membrane_cp
region          box block -6 6 -6 6 -6 6
create_box      1 box angle/types 1
create_membrane 1 sphere 2 2.0 scale 1 1 1.05
pair_style      helfrich
pair_coeff      1 1 20.0 0.0 regularize 20.0 conformal
fix             1 all hd/nve{more}
compute         T all hd/temp
thermo_style    custom step pe c_T etotal
thermo_modify   norm no format float %.14g temp T
timestep        0.001
run             100
{{}}run             100 pre no
"""
    plain, after = (thermo(run(script.format(command)))[-1]["TotEng"] for command in ("", "hd_timestep all\n"))
    claim(f"hd/nve{more}: a run without setup goes on as if there had been no hd_timestep", abs(after / plain - 1) < 1e-12, (plain, after))

# === The recommended step

relaxed = sphere(2) + "min_style membrane\nminimize 0 1e-8 100 1000\nreset_timestep 0\n"
for wanted in (1e-3, 1e-5):
    output = run(relaxed + f"""
hd_velocity     all 0.001 4711
fix             1 all hd/nve
hd_timestep     all error {wanted} set yes
print           "recommended timestep of now $(dt)"
thermo          1
run             $(floor(0.065/dt))
""")
    rows = thermo(output)
    rows = rows[max(i for i, row in enumerate(rows) if row["Step"] == 0):]
    mean = sum(row["TotEng"] for row in rows) / len(rows)
    spread = math.sqrt(sum((row["TotEng"] - mean)**2 for row in rows) / len(rows))
    found = spread / (sum(row["KinEng"] for row in rows) / len(rows))
    dt, limit = number("recommended timestep", output), number("stability limit", output)
    claim(f"an energy error of {wanted} is met within a factor 2", wanted / 2 < found < 2 * wanted,
          f"{found:.2e}, step {dt}, {dt / limit:.3f} of the limit")
    claim("set yes sets the timestep", number("recommended timestep of now", output) == dt)

output = run(relaxed + "hd_timestep all error 0.9\n")
claim("the recommended step is never beyond half the limit",
      0.45 < number("recommended timestep", output) / number("stability limit", output) <= 0.5)

# === Beyond the limit

for fix, scene in (("hd/nve", ""), ("hd/nve mass consistent", ""), ("hd/nve mass lumped", ""),
                   ("hd/langevin 1e-4 1e-4 1.0 4711 measure no", ""),
                   ("hd/brownian 1e-4 4711 gamma_t 0.1 measure no", "")):
    # so cold that the motion stays linear: close to the limit larger waves find steps too long that it allows
    scene = relaxed + f"fix 1 all {fix}\nhd_velocity all 1e-6 4711\nhd_timestep all\n"
    limit = number("stability limit", run(scene))
    code, output = lammps(scene + f"thermo 1\ntimestep {1.2 * limit}\nrun 1000\n")
    errors = [line for line in output.splitlines() if line.startswith("ERROR")]
    stated = re.findall(r"timestep (\S+) is beyond the stability limit of about (\S+);", "".join(errors))
    steps = len(thermo(output))
    claim(f"fix {fix}: a timestep of 1.2 times the limit stops, and the message has the limit",
          code != 0 and len(stated) == 1 and abs(float(stated[0][1]) / limit - 1) < 0.1,
          f"{stated} {limit} after {steps} steps; {errors}")
    claim(f"fix {fix}: there was a warning before", f"of about {stated[0][1] if stated else ''}; hd_timestep"
          in output.split("ERROR")[0])
    code, output = lammps(scene + f"timestep {0.9 * limit}\nrun 2000\n")
    claim(f"fix {fix}: 0.9 times the limit runs 2000 steps without complaint",
          code == 0 and "Loop time" in output and "stability limit of" not in output)

scene = relaxed + "hd_velocity all 1e-4 4711\nfix 1 all hd/nve\n"
two = error_of(scene + "timestep 0.1\nrun 1000\n", ranks=2)
claim("two ranks stop too", "is beyond the stability limit of about 0.005" in two, two)
no = error_of(scene + "fix_modify 1 check no\ntimestep 0.1\nrun 1000\n")
claim("fix_modify check no: the message goes without the limit",
      "timestep 0.1 is too long; hd_timestep" in no, no)
short = error_of(scene + "timestep 0.1\nrun 100\n")
claim("so it does in a short run", "timestep 0.1 is too long; hd_timestep" in short, short)
scene += "timestep 0.001\nthermo 1\n"
ends = []
for check in ("yes", "no"):
    output = run(scene + f"fix_modify 1 check {check}\nrun 300\n" + STATE.format("end.dump"))
    ends.append((thermo(output), open("end.dump").read()))
claim("the check at the start of a run leaves no trace, bit by bit", ends[0] == ends[1])

# === Bad input

for commands, expected in (
        ("hd_timestep", "Illegal hd_timestep command: missing argument(s)"),
        ("hd_timestep nobody", "Could not find hd_timestep group ID nobody"),
        ("group some id 1:100\nhd_timestep some", "hd_timestep: group some has 100 of the 162 control points"),
        ("group none empty\nhd_timestep none", "hd_timestep: group none has no control points"),
        ("hd_timestep all error 0", "hd_timestep error 0 must be between 0 and 1"),
        ("hd_timestep all error 2", "hd_timestep error 2 must be between 0 and 1"),
        ("hd_timestep all mass heavy", "hd_timestep mass heavy is not vertex, consistent, lumped or sampling"),
        ("hd_timestep all tol 1", "hd_timestep tol 1 must be between 1e-14 and 1e-2"),
        ("hd_timestep all mode degree 1", "hd_timestep mode degree 1 must be 2 or more"),
        ("hd_timestep all mode degree", "Illegal hd_timestep mode command: missing argument(s)"),
        ("hd_timestep all mode wavelength -1", "hd_timestep mode wavelength -1 must be positive"),
        ("hd_timestep all mode wavelength 0.01", "is shorter than two edges"),
        ("hd_timestep all mode wavelength 1", "has no membrane that continues through the box"),
        ("hd_timestep all mode octave 1", "hd_timestep mode octave is not degree or wavelength"),
        ("hd_timestep all wrong yes", "Unknown hd_timestep keyword wrong"),
        ("pair_style none\nhd_timestep all", "hd_timestep needs forces: use pair_style helfrich"),
        ("pair_coeff 1 1 0 0\nhd_timestep all", "nothing resists displacements"),
        ("fix 1 all hd/nve\nfix_modify 1 check perhaps", "Expected boolean parameter")):
    line = error_of(sphere(2) + commands + "\n")
    claim(f"{commands!r} is refused", expected in line, line)
line = error_of("atom_style membrane_cp\nhd_timestep all\n")
claim("without a box it is refused", "use it after create_membrane" in line, line)
line = error_of("region b block 0 1 0 1 0 1\ncreate_box 1 b\nhd_timestep all\n")
claim("without control points it is refused", "use atom_style membrane_cp" in line, line)

finish()
