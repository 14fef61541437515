"""Bound particles in the scenes that users have: periodic and triclinic boxes, several membranes, LAMMPS' commands
between two runs, r-RESPA, minimization, deforming boxes; and every wrong input."""
# cost: 30

import math
import re

from lammps_claims import claim, finish, lammps, run, thermo
from membrane_scenes import frames
from spread_and_slope import spread


# === A sheet that continues through a triclinic box, particles that cross its faces, at a height, LJ between them

SHEET = """
units           lj
newton          {newton}
atom_style      membrane_cp
region          box prism 0 10 0 8.66 -4 4 2 0 0
create_box      2 box angle/types 1
create_membrane 1 plane 10 10
set             type 1 mass 1.0
group           mem type 1
create_bound    {n} 2 mem 4711 leaflet {leaflet} height 0.3 min 1.0
group           p type 2
pair_style      hybrid/overlay helfrich lj/cut 1.12246
pair_coeff      1 1 helfrich 20.0 0.0 regularize 10
pair_coeff      * * lj/cut 0.0 1.0
pair_coeff      2 2 lj/cut 1.0 1.0
pair_modify     shift yes
neighbor        0.3 bin
timestep        {dt}
velocity        p create 2.0 99 loop all
fix             1 mem hd/nve tol 1e-12 measure 1.0
fix             2 p nve
fix             b p hd/bind mem hold {hold} leaflet {leaflet} height 0.3
hd_velocity     mem 1.0 12
compute         T all hd/temp
compute         s p hd/surface/atom b
compute         d p hd/density b curvature 1 -1 1
thermo_style    custom step pe etotal press f_b[2] f_b[4] c_d[1][3] c_d[1][4]
thermo_modify   norm no format float %.16g temp T
thermo          {every}
"""


def sheet(n=20, dt=0.004, hold="spring 3000", every=1, newton="on", leaflet="both"):
    return SHEET.format(n=n, dt=dt, hold=hold, every=every, newton=newton, leaflet=leaflet)


for hold in ("spring 3000", "rigid"):
    errors = []
    for dt in (0.004, 0.002):
        n = round(1.0 / dt)
        rows = thermo(run(sheet(dt=dt, hold=hold) + f"run {n}\n"))[-n - 1:]
        errors.append(spread([row["TotEng"] for row in rows]))
    claim(f"triclinic sheet, {hold}: half the step, a quarter of the energy error", 3.0 < errors[0] / errors[1] < 5.0,
          f"{errors[0]:.2e} {errors[1]:.2e}")
    claim("    leaflets keep their particles", rows[-1]["c_d[1][3]"] == rows[0]["c_d[1][3]"] > 0
          and rows[-1]["c_d[1][4]"] == rows[0]["c_d[1][4]"] > 0, f"{rows[-1]['c_d[1][3]']:.0f} {rows[-1]['c_d[1][4]']:.0f}")

ends = {}
for ranks, newton in ((1, "on"), (2, "off"), (4, "on")):
    run(sheet(every=1000, newton=newton) + """
dump            1 all custom 1000 x.dump id xu yu zu ix iy
dump_modify     1 format float %.17g
run             1000
""", ranks=ranks)
    ends[ranks, newton] = frames("x.dump")[-1]
crossed = sum(row[4] != 0 or row[5] != 0 for row in ends[1, "on"] if row[0] > 100)
for key in ((2, "off"), (4, "on")):
    off = max(abs(a - b) for p, q in zip(ends[1, "on"], ends[key]) for a, b in zip(p[:4], q[:4]))
    claim(f"{key[0]} ranks, newton {key[1]}: follow one to 1e-9 over 1000 steps, through the periodic box",
          off < 1e-9 and crossed > 0, f"{off:.1e}, {crossed} particles crossed")

# pressure of a rigid hold at a height: against that of a stiff spring, from the same start

press = {}
for hold in ("rigid correct no", "spring 100000"):
    rows = thermo(run(sheet(dt=2e-4, hold=hold) + "run 2000\n"))[-2000:]
    press[hold] = sum(row["Press"] for row in rows) / len(rows)
claim("the pressure of a rigid hold is that of a stiff spring, within 2 %",
      abs(press["rigid correct no"] / press["spring 100000"] - 1) < 0.02, str(press))

# === LAMMPS' commands between two runs leave the energy alone; that all goes on as from a restart is in test_command_matrix.py

AFTER = ("reset_timestep 0", "reset_atoms id", "reset_atoms id sort yes", "balance 1.0 shift x 5 1.01", "group more id 1:20",
         "neigh_modify every 2", "comm_modify cutoff 6.0", "displace_atoms all move 3.3 2.2 0.1", "velocity p scale 1.0",
         "reset_atoms mol all", "change_box all z final -5 5 units box")
rows = thermo(run(sheet(every=5) + "run 5\nrun 0\n" + "".join(f"{command}\nrun 0\n" for command in AFTER) + "run 20\n", ranks=2))
base, after = rows[2]["PotEng"], rows[3:3 + len(AFTER)]
for command, row in zip(AFTER, after):
    claim(f"{command}: the same energy, all bound", abs(row["PotEng"] - base) < 1e-9 * abs(base) and row["f_b[2]"] == 20,
          f"{row['PotEng'] - base:.1e}")
rows = thermo(run(sheet(every=5) + "run 5\ndelete_atoms group p\nrun 5\n", ranks=2))
claim("delete_atoms of all particles leaves none", rows[-1]["f_b[2]"] == 0)
rows = thermo(run(sheet(every=5) + "run 5\ngroup half id 101:110\ndelete_atoms group half compress no\nrun 5\n", ranks=2))
claim("delete_atoms of some leaves the others", rows[-1]["f_b[2]"] == 10)
rows = thermo(run(sheet(n=10, every=5) + "run 5\ncreate_bound 10 2 mem 3 leaflet out height 0.3 min 0.9\nset type 2 mass 1.0\n"
                  "group p type 2\nrun 5\n", ranks=2))
claim("atoms that join the group are bound when the next run begins", rows[-1]["f_b[2]"] == 20)
rows = thermo(run(sheet(every=5) + "run 5\nunfix b\nfix b p hd/bind mem hold spring 3000 leaflet both height 0.3\nrun 5\n"))
claim("unfix, and bound again", rows[-1]["f_b[2]"] == 20)
rows = thermo(run(sheet(every=5).replace("thermo_style    custom step pe etotal press f_b[2] f_b[4] c_d[1][3] c_d[1][4]",
                                         "thermo_style custom step pe etotal") + "run 5\nuncompute s\nuncompute d\nunfix b\nrun 50\n"))
claim("unfix releases", True)

# === Two membranes, one in the other; r-RESPA; minimization; a box that is deformed

NESTED = """
units           lj
atom_style      membrane_cp
region          box block -5 5 -5 5 -5 5
create_box      2 box angle/types 1
create_membrane 1 sphere 2 2.0
create_membrane 1 sphere 2 3.0
group           inner molecule 1
group           outer molecule 2
set             type 1 mass 1.0
{particles}
group           p type 2
set             type 2 mass 1.0
pair_style      hybrid/overlay helfrich zero 1.0
pair_coeff      1 1 helfrich 20.0 0.0 regularize 1
pair_coeff      * * zero
timestep        0.002
group           mem type 1
"""
OUTER = NESTED.format(particles="create_bound 10 2 outer 5") + "fix 1 mem hd/nve\nfix 2 p nve\n"
rows = thermo(run(OUTER + "fix b p hd/bind outer\ncompute s p hd/surface/atom b\ncompute r p reduce min c_s[1]\n"
                  "thermo_style custom step c_r f_b[2]\nrun 10\n", ranks=2))
claim("a membrane is named by its group", rows[-1]["c_r"] > 320 and rows[-1]["f_b[2]"] == 10)

RESPA = sheet(dt=0.004, leaflet="out").replace("pair_modify     shift yes", "pair_modify     shift yes\nrun_style respa 2 2 pair 2")
n = 250
for level in (1, 2):
    rows = thermo(run(RESPA + f"fix_modify b respa {level}\nrun {n}\n"))[-n - 1:]
    energy = [row["TotEng"] for row in rows]
    claim(f"r-RESPA, the spring on level {level}: the energy is kept", spread(energy) < 0.5, f"{spread(energy):.2e}")

text = run(sheet(every=100) + "run 100\nmin_style cg\nminimize 0 1e-6 200 2000\n")
rows = thermo(text)
claim("minimization goes on with bound particles", rows[-1]["f_b[2]"] == 20 and rows[-1]["PotEng"] < rows[-2]["PotEng"]
      and rows[-1]["f_b[4]"] < 0.05, f"{rows[-2]['PotEng']:.4f} to {rows[-1]['PotEng']:.4f}, off by {rows[-1]['f_b[4]']:.1e}")

DRAGGED = sheet(every=100).replace("fix             1 mem hd/nve tol 1e-12 measure 1.0", "fix 1 mem hd/brownian 1.0 5 gamma_t 1000")
DRAGGED = DRAGGED.replace("fix             2 p nve\n", "").replace(" leaflet both height 0.3\nhd", " leaflet both height 0.3 brownian 1.0 0.01 5 friction membrane\nhd")
rows = thermo(run(DRAGGED + "run 100\nmin_style cg\nminimize 0 1e-6 200 2000\n"))
claim("    and with drag against the membrane, of which a minimization knows nothing",
      rows[-1]["PotEng"] < rows[-2]["PotEng"] and rows[-1]["f_b[4]"] < 0.05, f"{rows[-2]['PotEng']:.4f} to {rows[-1]['PotEng']:.4f}")

rows = thermo(run(sheet(every=50) + "fix d all deform 1 x erate 0.02 xy erate 0.01 remap x\nrun 500\n", ranks=2))
claim("a box that is deformed: all stay bound", rows[-1]["f_b[2]"] == 20 and max(r["f_b[4]"] for r in rows) < 0.3,
      f"at most {max(r['f_b[4]'] for r in rows):.3f} off")

# === The gas of particles presses on a flat frozen sheet by N kT/A

GAS = """
units           lj
atom_style      membrane_cp
region          box block 0 10 0 8.66 -4 4
create_box      2 box angle/types 1
create_membrane 1 plane 10 10
group           mem type 1
create_bound    500 2 mem 4711
group           p type 2
timestep        0.005
fix             2 p nve
fix             3 p langevin 1.5 1.5 0.5 77
velocity        p create 1.5 99 loop all
fix             b p hd/bind mem hold {hold}
compute         T p temp
compute         P all pressure T
variable        gas equal (c_P[1]+c_P[2])/2*vol/500
thermo_style    custom step c_T v_gas c_P[3] f_b[3]
thermo_modify   norm no format float %.16g
thermo          10
run             4000
"""
for hold in ("spring auto", "rigid"):
    rows = thermo(run(GAS.format(hold=hold)))[40:]
    values = [row["v_gas"] for row in rows]
    mean = sum(values) / len(values)
    blocks = [sum(values[i * len(values) // 12:(i + 1) * len(values) // 12]) / (len(values) // 12) for i in range(12)]
    error = spread(blocks) / math.sqrt(11)
    claim(f"{hold}: bound particles press on the area like an ideal gas, within three errors",
          abs(mean - 1.5) < 3 * error + 0.005 and error < 0.02, f"{mean:.4f} +- {error:.4f}, 1.5")
    if hold == "rigid":
        temperature = sum(row["c_T"] for row in rows) / len(rows)
        claim("    two directions of motion count in the temperature", abs(temperature - 1.5) < 0.03, f"{temperature:.3f}")

# === Rigid holds begin a run where they hold, whatever commands have done

calm, rows = (thermo(run(sheet(hold="rigid") + "run 5\n" + move + "run 5\n")) for move in ("", "displace_atoms p move 0.02 0.01 0.15\n"))
off = max(abs(a["TotEng"] - b["TotEng"]) for a, b in zip(calm, rows))
claim("atoms that have been displaced are taken back, and not thrown", off < 0.02 and max(row["f_b[4]"] for row in rows) < 1e-9,
      f"{off:.4f}")

# === Springs for the timestep of mass sampling

SOFT = """
units           lj
atom_style      membrane_cp
region          box block 0 12 0 12.124355652982141 -6 6
create_box      3 box angle/types 1
create_membrane 1 plane 12 14 mass 0.8660254037844386
group           mem type 1
pair_style      hybrid/overlay helfrich zero 1.0
pair_coeff      1 1 helfrich 1.0 0.0 regularize 1.0 conformal
pair_coeff      * * zero
create_bound    10 2 mem 4711
group           pro type 2
fix             1 mem hd/langevin 0.05 0.05 1.5 4711 mass sampling
fix             2 pro nve
fix             4 pro langevin 0.05 0.05 1.5 99
fix             3 pro hd/bind mem
timestep        {dt}
thermo_style    custom step f_3[3] f_3[4]
run             {n}
"""
said = re.search(r"WARNING: Fix hd/bind spring \S+ the temperature takes .* with a timestep of (\S+) at most", run(SOFT.format(dt=0.3, n=0)))
claim("a spring too soft for its temperature is told when a run begins", said is not None)
output = run(SOFT.format(dt=said[1], n=2000))
row = thermo(output)[-1]
claim("    the timestep in the warning does", "the temperature takes" not in output and row["f_3[4]"] < 0.45, (said[1], row))

# === Wrong input: one line, the thing and the cure


def fails(text, *words):
    code, output = lammps(text)
    error = next((line for line in output.split("\n") if line.startswith("ERROR")), "no error")
    claim(f"{' '.join(words)[:60]}", code != 0 and all(word in error for word in words), error[:150])


PLAIN = NESTED.format(particles="create_bound 10 2 outer 5") + "fix 1 mem hd/nve\nfix 2 p nve\n"
fails(PLAIN + "fix b p hd/bind nobody\nrun 0\n", "Could not find", "nobody")
fails(PLAIN + "fix b p hd/bind outer hold glue\nrun 0\n", "hold glue", "spring or rigid")
fails(PLAIN + "fix b p hd/bind outer hold spring -1\nrun 0\n", "spring -1", "positive")
fails(PLAIN + "fix b p hd/bind outer height -1\nrun 0\n", "height -1", "negative")
fails(PLAIN + "fix b p hd/bind outer leaflet up\nrun 0\n", "leaflet up", "in, out or both")
fails(PLAIN + "fix b p hd/bind outer brownian 1.0 0 5\nrun 0\n", "diffusion coefficient 0", "positive")
fails(PLAIN + "fix b p hd/bind outer brownian 1.0 3um2/s 5\nrun 0\n", "units lj", "um2/s")
fails(PLAIN + "fix b p hd/bind outer sticky yes\nrun 0\n", "Unknown", "sticky", "known are")
fails(PLAIN + "fix b p hd/bind outer correct yes\nrun 0\n", "correct", "rigid")
fails(PLAIN + "fix b p hd/bind outer hold rigid correct yes\nrun 10\n", "correct yes", "temperature")
fails(PLAIN + "fix b p hd/bind outer hold rigid brownian 1.0 1.0 5\nrun 10\n", "brownian", "spring")
fails(PLAIN + "fix b p hd/bind outer friction water\nrun 10\n", "friction water", "bath or membrane")
fails(PLAIN + "fix b p hd/bind outer friction membrane\nrun 10\n", "friction membrane", "add brownian")
fails(PLAIN + "unfix 2\nfix b p hd/bind outer brownian 1 1 5 friction membrane\nrun 10\n", "friction membrane", "hd/brownian")
fails(PLAIN + "fix b p hd/bind outer max -2\nrun 0\n", "max -2", "positive")
fails(PLAIN + "fix b p hd/bind inner\nrun 0\n", "max is", "place it closer")
fails(PLAIN + "fix b all hd/bind outer\nrun 0\n", "is a control point")
fails(PLAIN + "fix b p hd/bind outer\nfix c p hd/bind outer\nrun 0\n", "bound by fix", "common")
fails(PLAIN + "fix b p hd/bind outer\nfix 3 p nve\nrun 10\n", "more than one fix")
fails(PLAIN.replace("fix 2 p nve\n", "") + "fix b p hd/bind outer hold rigid\nfix 2 p nve\nrun 10\n", "must come after fix 2")
fails(NESTED.format(particles="create_bound 10 2 outer 5") + "fix 2 p nve\nfix b p hd/bind outer hold rigid\nfix 1 mem hd/nve\nrun 10\n",
      "must come after fix 1")
BODY = PLAIN.replace("fix 2 p nve\n", "")
fails(BODY + "fix 2 p rigid single\nfix b p hd/bind outer\nrun 1\n", "must come after fix b", "define it later")
fails(BODY + "fix b p hd/bind outer hold rigid\nfix 2 p rigid single\nrun 1\n", "holds its atoms, too", "hold spring")
fails(NESTED.format(particles="change_box all boundary f f f\nchange_box all x final -3.3 3.3\ncreate_bound 90 2 outer 5 height 0.4"),
      "outside the box", "enlarge")
fails(PLAIN + "fix b p hd/bind outer hold spring 1e8\nrun 10\n", "unstable", "at most")
fails(PLAIN + "fix b p hd/bind outer footprint 2 0 1 1 1\nrun 0\n", "area 0", "positive")
fails(PLAIN + "fix b p hd/bind outer footprint 2 1e4 1 1 1\nrun 0\n", "larger than")
fails(PLAIN + "fix b p hd/bind outer footprint 9 1 1 1 1\nrun 0\n", "type 9 does not exist")
fails(PLAIN + "fix b p hd/bind outer bar 2 1 0 1 0 1 1\nrun 0\n", "no direction")
fails(PLAIN + "fix b p hd/bind outer rotate 1 0 5\nrun 0\n", "rotate", "positive")
fails(PLAIN + "fix b p hd/bind outer footprint 2 1 1 1 0.01\nrun 0\n", "radius", "larger")
fails(PLAIN.replace("pair_coeff      * * zero", "pair_coeff      * * zero\npair_coeff 2 2 helfrich 1 0") +
      "fix b p hd/bind outer\nrun 0\n", "Atom", "helfrich")
TWINS = NESTED.replace("sphere 2 2.0", "sphere 2 1.2 center -2 0 0").replace("sphere 2 3.0", "sphere 2 1.2 center 2 0 0")
fails(TWINS.format(particles="create_atoms 2 single 0 0 0") + "fix b p hd/bind mem max 2\nrun 0\n", "equally near")
fails(NESTED.format(particles="create_bound 10 2 outer 5 min 9"), "only", "room")
fails(NESTED.format(particles="create_bound 10 7 outer 5"), "type 7")
fails(NESTED.format(particles="create_bound 10 2 outer 5 colour red"), "Unknown", "colour")
fails(PLAIN + "compute s p hd/surface/atom nofix\nrun 0\n", "no fix hd/bind", "nofix")
fails(PLAIN + "fix b p hd/bind outer\ncompute d p hd/density b curvature 0 1 2\nrun 0\n", "bins 0")
fails(PLAIN + "fix b p hd/bind outer hold rigid\nminimize 0 0 1 1\n", "rigid", "minimization")
text = lammps(PLAIN.replace("fix 2 p nve\n", "") + "fix b p hd/bind outer\nrun 10\n")[1]
claim("particles that nothing moves are warned of", "not moved by any fix" in text)
fails(PLAIN + "fix b p hd/bind outer hold spring 5\nvelocity p create 900.0 4\nrun 200\n", "off its place", "shorter timestep")

finish()
