"""Fix hd/tension beside all that a box can hold: ranks, restarts, solvent, bound particles, other pair styles, errors.

    MEMBRANE_LONG=1    100,000 moves of a cold sheet
"""
# cost: 15
# timeout: 7200

import re

from lammps_claims import LONG, claim, error_of, finish, lammps, run, thermo

BOX = "block 0 12 0 12.124355652982141 -6 6"
SHEET = """
units           lj
atom_style      membrane_cp
newton          {newton}
atom_modify     map array
region          box {box}
create_box      3 box angle/types 1
create_membrane 1 plane 12 14 mass 0.8660254037844386
group           mem type 1
special_bonds   lj/coul 1 1 1
pair_style      helfrich
pair_coeff      1 1 1.0 0.0 regularize 1.0 conformal area 5.0 145.49226783578569
"""
DYNAMICS = """
fix             1 mem hd/langevin 0.05 0.05 1.5 4711 mass sampling
fix             t all hd/tension {every} 0.05 4711 {words}
compute         e all pair helfrich
compute         s mem membrane/shape
timestep        0.3
thermo_style    custom step pe c_e[*] c_s[1] lx ly lz xy press ecouple f_t[*]
thermo_modify   norm no format float %.17g
thermo          50
"""


def scene(words="xy tension 0.05", every=5, newton="on", box=BOX, more=""):
    return SHEET.format(newton=newton, box=box) + more + DYNAMICS.format(every=every, words=words)


def differences(a, b, skip=()):
    return max(abs(a[k] - b[k]) / (1e-6 + abs(b[k])) for k in b if k not in skip)


# === Ranks, newton, tilted boxes, restarts

one = thermo(run(scene() + "run 400\n"))
for ranks, newton in ((4, "on"), (1, "off"), (2, "off")):
    other = thermo(run(scene(newton=newton) + "run 400\n", ranks=ranks))
    error = max(differences(a, b) for a, b in zip(other, one))
    claim(f"{ranks} ranks, newton {newton}: the same decisions and numbers", error < 1e-6 and other[-1]["f_t[1]"] == 80,
          f"{error:.1e}")

output = run(scene() + "run 200\nwrite_restart half\nrun 200\nwrite_dump all custom end.dump id x y z vx vy vz ix iy modify sort id "
             "format float %.17g\n")
through = thermo(output)[-1]
frame = open("end.dump").read()
again = thermo(run("read_restart half\n" + DYNAMICS.format(every=5, words="xy tension 0.05") + "run 200\n"
                   "write_dump all custom again.dump id x y z vx vy vz ix iy modify sort id format float %.17g\n"))[-1]
claim("a restart continues bitwise, with its step, its means and its count",
      open("again.dump").read() == frame and all(again[k] == through[k] for k in again))
rest = run("read_restart half\n" + DYNAMICS.format(every=5, words="xy tension 0.05") + "run 200\n", ranks=2)
claim("on two ranks it continues alike", differences(thermo(rest)[-1], through) < 1e-6)
message = error_of("read_restart half\n" + DYNAMICS.format(every=5, words="x y tension 0.05") + "run 0\n")
claim("of a fix with other directions it does not", "directions" in message, message[:100])

straight = thermo(run(scene(words="xy", every=1) + "run 200\n"))
tilted = thermo(run(scene(words="xy", every=1, box="prism" + BOX[5:] + " 0 0 0") + "run 200\n"))
claim("in a triclinic box without tilt, too", max(differences(a, b, ("Xy",)) for a, b in zip(tilted, straight)) < 1e-6)
sheared = thermo(run(scene(words="xy", every=2, box="prism" + BOX[5:] + " 3 0 0") + "run 400\n"))
claim("a tilt goes with its box", all(abs(row["Xy"] / row["Lx"] - 0.25) < 1e-12 for row in sheared) and
      abs(sheared[-1]["Lx"] - 12) > 1e-3)

# === Between runs

both = run(scene() + """
run             100
reset_timestep  3
run             100
thermo_style    one
unfix           t
run             20
replicate       2 1 1 bond/periodic
set             type 1 mol 1
pair_coeff      1 1 1.0 0.0 regularize 1.0 conformal area 5.0 290.98453567157138
timestep        0.1
fix             t all hd/tension 7 0.05 3 xy
thermo_style    custom step lx f_t[1]
run             70
reset_atoms     id
run             70
""")
rows = thermo(both)
claim("runs go on after reset_timestep, unfix, replicate and reset_atoms", rows[-1]["f_t[1]"] == 20.0 and
      23 < rows[-1]["Lx"] < 25, rows[-1]["Lx"])

# === What a move does

rows = thermo(run(scene(every=1) + "unfix 1\nfix 1 mem hd/nve mass lumped measure 0.05\ntimestep 0.05\nrun 400\n"))
start = rows[0]
drift = [abs(row["PotEng"] + row["Ecouple"] - start["PotEng"] - start["Ecouple"]) for row in rows]
claim("ecouple has the energy that moves have given", rows[-1]["Ecouple"] != 0.0)
frozen = thermo(run(SHEET.format(newton="on", box=BOX) + """
displace_atoms  all random 0.05 0.05 0.05 4711
fix             t all hd/tension 1 0.05 4711 xy
thermo_style    custom step pe ecouple
thermo_modify   norm no format float %.15g
thermo          1
run             100
"""))
claim("and where nothing else moves, energy and it together are constant",
      max(abs(row["PotEng"] + row["Ecouple"] - frozen[0]["PotEng"]) for row in frozen) < 1e-9
      and max(abs(row["PotEng"] - frozen[0]["PotEng"]) for row in frozen) > 1e-2)

moved = run(scene(every=1, words="xy volume keep step 0.02 burn 0") + """
compute         p all pair helfrich
run             37
write_data      now.data
""")
now = thermo(moved)[-1]
fresh = thermo(run(SHEET.format(newton="on", box=BOX).split("region")[0] + """
read_data       now.data
special_bonds   lj/coul 1 1 1
pair_style      helfrich
pair_coeff      1 1 1.0 0.0 regularize 1.0 conformal area 5.0 145.49226783578569
compute         e all pair helfrich
thermo_style    custom step pe c_e[*] press vol
thermo_modify   norm no format float %.17g
fix             1 all hd/langevin 0.05 0.05 1.5 4711 mass lumped
run             0
"""))[-1]
claim("energies after moves, accepted or not, are those of the state that is there",
      all(abs(now[k] - fresh[k]) < 1e-9 * (1 + abs(fresh[k])) for k in fresh if k[0] == "c" or k == "PotEng"))
claim("volume keep keeps the volume", abs(now["Lx"] * now["Ly"] * now["Lz"] / (12 * 12.124355652982141 * 12) - 1) < 1e-12)

# === A cold flat sheet

STEPS = 10000 if LONG else 300
for words in ("xy", "xy tension 0.0 volume keep"):
    row = thermo(run(SHEET.format(newton="on", box=BOX) + f"""
fix             1 mem hd/langevin 1e-8 1e-8 1.5 4711 mass sampling
fix             t all hd/tension 1 1e-8 4711 {words} attempts 10
thermo_style    custom step lx ly f_t[*]
thermo_modify   norm no format float %.17g
timestep        0.3
run             {STEPS}
""", timeout=7200))[-1]
    area, variance = 145.49226783578569, 1e-8 * 145.49226783578569 / 5.0
    claim(f"a cold sheet neither grows nor shrinks in {row['f_t[1]']:.0f} moves of {words}",
          abs(row["Lx"] * row["Ly"] / area - 1) < 1e-6 * 20 and abs(row["f_t[6]"] / area - 1) < 5 * row["f_t[7]"] / area < 1e-5
          and abs(row["f_t[8]"] / variance - 1) < 0.25,
          f"{row['f_t[6]'] / area - 1:.1e} +- {row['f_t[7]'] / area:.1e}, variance {row['f_t[8]'] / variance:.3f} of kT A/KA")

# === Without the measure of the mesh

plain = scene(words="xy").replace("mass sampling", "mass sampling measure no")
claim("without the measure a warning says what will happen; test_tension shows it",
      "control points push the box as an ideal gas" in run(plain + "run 1\n"))

# === Solvent

SOLVENT = """
units           lj
atom_style      membrane_cp
region          box block 0 12 0 12.124355652982141 -6 6
create_box      2 box angle/types 1
create_membrane 1 plane 12 14 mass 4.0
create_atoms    2 random 6000 8341 box
set             type 2 mass 1.0
group           mem type 1
group           sol type 2
velocity        sol create 1.0 4711 loop geom mom yes
velocity        mem set 0 0 0
special_bonds   lj/coul 1 1 1
pair_style      helfrich
pair_coeff      1 1 20.0 0.0 regularize 20 conformal area 100 145.492
fix             1 mem hd/nve
fix             2 sol srd/mesh 20 mem 1.0 1.0 4711 angle 130 shift yes 9127 velocity keep cubic warn 0.9
fix             t all hd/tension {every} 1.0 99 xy volume keep tension 0.0 step 0.01 burn 50
compute         s mem membrane/shape
variable        a equal lx*ly
variable        below atom "type==2 && z<0"
thermo_style    custom step pe vol v_a c_s[1] f_2[1] f_2[2] f_2[3] f_2[4] f_2[5] f_2[6] f_2[7] f_t[1] f_t[2] f_t[3]
thermo_modify   norm no format float %.15g
timestep        0.005
thermo          100
run             {steps}
"""
for ranks, every, steps in ((1, 10, 2000), (2, 5, 600)):
    rows = thermo(run(SOLVENT.format(every=every, steps=steps), ranks=ranks))
    last = rows[-1]
    text = f"a sheet in solvent on {ranks} ranks, volume keep"
    claim(f"{text}: nothing crosses in {last['f_2[2]']:.0f} collisions", last["f_2[3]"] == last["f_2[4]"] == 0 < last["f_2[2]"])
    claim("    momentum is kept", max(abs(row[f"f_2[{k}]"]) for row in rows for k in (5, 6, 7)) < 1e-10)
    claim("    and the volume, so the density", abs(last["Volume"] / rows[0]["Volume"] - 1) < 1e-12)
    claim("    while the box breathes, by steps of a sensible acceptance",
          abs(last["f_t[3]"] - 1) > 1e-4 and (steps < 1000 or last["f_t[2]"] > 0.2), f"{last['f_t[2]']:.2f}")

# === A vesicle that does not go with the box, and particles with a pair style of their own

rows = thermo(run("""
units           lj
atom_style      membrane_cp
region          box block -5 5 -5 5 -5 5
create_box      2 box angle/types 1
create_membrane 1 sphere 2 2.0 mass 0.3
region          out sphere 0 0 0 3.2 side out
create_atoms    2 random 60 8341 out overlap 0.9 maxtry 1000
set             type 2 mass 1.0
group           mem type 1
group           gas type 2
special_bonds   lj/coul 1 1 1
pair_style      hybrid/overlay helfrich lj/cut 1.12246
pair_coeff      1 1 helfrich 20.0 0.0 regularize 20 conformal area 100 init volume 100 init
pair_coeff      * * lj/cut 0.0 1.0
pair_coeff      2 2 lj/cut 1.0 1.0
pair_modify     shift yes
fix             1 mem hd/langevin 1.0 1.0 1.5 4711 mass lumped
fix             2 gas nve
fix             3 gas langevin 1.0 1.0 0.5 4711
fix             t gas hd/tension 5 1.0 4711 xyz pressure 0.1
compute         s mem membrane/shape
thermo_style    custom step pe vol c_s[1] c_s[2] f_t[*]
thermo_modify   norm no format float %.15g
thermo          100
timestep        0.004
run             2000
"""))
claim("a vesicle that is not in the group keeps its size while the box of a gas finds its own",
      max(abs(row["c_s[2]"] / rows[0]["c_s[2]"] - 1) for row in rows) < 0.05 and abs(rows[-1]["Volume"] / 1000 - 1) > 0.02
      and rows[-1]["f_t[2]"] > 0.2, f"volume {rows[-1]['Volume']:.0f}, acceptance {rows[-1]['f_t[2]']:.2f}")

# In the corner of a box that stretches around them, a vesicle and the atoms that are bound to it stay as they are

CORNER = """
units           lj
atom_style      membrane_cp
region          box {box}
create_box      3 box angle/types 1
create_membrane 1 sphere 2 2.0 center 5 5 5
create_atoms    2 random 40 8341 box
group           mem type 1
group           gas type 2
create_bound    40 3 mem 4711
group           pro type 3
special_bonds   lj/coul 1 1 1
pair_style      hybrid/overlay helfrich zero 1.0
pair_coeff      1 1 helfrich 20.0 0.0
pair_coeff      * * zero
fix             1 gas nve
velocity        gas create 1.0 4711
fix             b pro hd/bind mem hold spring 100
fix             t gas hd/tension 2 1.0 4711 x y z pressure 0.04
compute         s mem membrane/shape
thermo_style    custom step pe c_s[1] c_s[2] f_b[2] f_b[4] f_t[2] vol
thermo_modify   norm no format float %.15g
thermo          100
timestep        0.005
run             400
"""
for name, box, ranks in (("", "block -5 5 -5 5 -5 5", 1), (", two ranks", "block -5 5 -5 5 -5 5", 2),
                         (", triclinic", "prism -5 5 -5 5 -5 5 1.5 -0.8 0.6", 1)):
    output = run(CORNER.format(box=box), ranks=ranks)
    rows = thermo(output)
    worst = max(abs(row[k] / rows[0][k] - 1) for row in rows for k in ("PotEng", "c_s[1]", "c_s[2]"))
    claim(f"a vesicle across the sides of a box that passes over it stays whole{name}", worst < 1e-9, f"{worst:.1e}")
    claim("  and what is bound to it stays on it", max(row["f_b[4]"] for row in rows) < 1e-6 and rows[-1]["f_b[2]"] == 40,
          max(row["f_b[4]"] for row in rows))
    claim("  while the box changes", abs(rows[-1]["Volume"] / 1000 - 1) > 0.02, rows[-1]["Volume"])
claim("no warning where all particles that move are in the group", "push" not in output and "as a gas" not in output)
output = run(CORNER.format(box="block -5 5 -5 5 -5 5").replace("fix             t gas", "group some id 191:202\nfix t some")
             .replace("run             400", "run 0"))
claim("a warning counts particles outside the group that move", "Fix hd/tension: 28 particles that move are not in its group some" in output,
      re.findall(r"\d+ particles that move", output))

# === All attempts of a visit together stay within the skin

LISTS = """
units           lj
atom_style      atomic
region          box block 0 9 0 9 0 9
create_box      1 box
create_atoms    1 random 100 8341 box overlap 0.95 maxtry 5000
mass            * 1
pair_style      lj/cut 2.5
pair_coeff      * * 1.0 1.0
fix             1 all nve
fix             2 all langevin 1.5 1.5 1.0 4711
velocity        all create 1.5 4711
fix             t all hd/tension 5 1.5 99 x pressure 0.2 step 0.05 attempts 20
timestep        0.004
thermo_style    custom step pe
thermo_modify   norm no format float %.12g
thermo          5
dump            d all custom 5 lists.dump id type x y z
dump_modify     d format float %.17g
run             1500
unfix           t
undump          d
rerun           lists.dump first 5 dump x y z box yes
"""
rows = thermo(run(LISTS))
moved, again = rows[1:301], rows[301:]
worst = max(abs(a["PotEng"] - b["PotEng"]) for a, b in zip(moved, again))
claim("energies after many attempts are those with new neighbor lists", len(moved) == len(again) == 300 and
      all(a["Step"] == b["Step"] for a, b in zip(moved, again)) and worst < 1e-6, f"{worst:.1e}")

# === Bad input

def says(text, words, script):
    message = error_of(script)
    claim(f"error: {text}", words in message, message[:160])


BASE = SHEET.format(newton="on", box=BOX)
LANGEVIN = "fix 1 mem hd/langevin 0.05 0.05 1.5 4711 mass sampling\n"
for text, words, script in (
        ("temperature 0", "must be positive", "fix t all hd/tension 5 0.0 1 xy\n"),
        ("no direction", "which directions", "fix t all hd/tension 5 0.05 1 tension 0.0\n"),
        ("a direction twice", "x is said twice", "fix t all hd/tension 5 0.05 1 xy x\n"),
        ("nothing is left to keep the volume", "leave one direction out", "fix t all hd/tension 5 0.05 1 xyz volume keep\n"),
        ("an unknown word", "known are", "fix t all hd/tension 5 0.05 1 xy stiff 3\n"),
        ("a step of 0", "must be positive", "fix t all hd/tension 5 0.05 1 xy step 0\n"),
        ("an acceptance of 1", "between 0 and 1", "fix t all hd/tension 5 0.05 1 xy accept 1.0\n"),
        ("tension where the sheet does not move", "neither of them moves",
         "fix t all hd/tension 5 0.05 1 z tension 1.0\nrun 0\n"),
        ("two fixes for one box", "change box parameter",
         "fix t all hd/tension 5 0.05 1 xy\nfix u all hd/tension 5 0.05 2 xy\nrun 0\n"),
        ("another temperature", "one temperature", LANGEVIN + "fix t all hd/tension 5 0.06 1 xy\nrun 1\n"),
        ("a ramp away from the temperature", "they need one temperature",
         LANGEVIN.replace("0.05 0.05", "0.05 0.06") + "fix t all hd/tension 5 0.05 1 xy\nrun 10\n"),
        ("scaled velocities that mean nothing", "use momenta keep",
         LANGEVIN + "fix t all hd/tension 5 0.05 1 xy momenta scale\nrun 0\n"),
        ("a part of a sheet", "partly in its group", "region r block 0 6 0 6 -1 1\ngroup part region r\n"
         "fix t part hd/tension 5 0.05 1 xy\nrun 0\n"),
        ("a sheet that does not go with its box", "must go with", "group no empty\n"
         "fix t no hd/tension 5 0.05 1 xy\nrun 0\n"),
        ("bound atoms that stay behind their membrane", "would tear it off",
         "create_bound 9 2 mem 31 mass 1.0\ngroup p type 2\nfix 2 p nve\nfix b p hd/bind mem\n"
         "fix t mem hd/tension 5 0.05 1 xy\nrun 0\n"),
        ("a box that has got walls", "not periodic in z", LANGEVIN +
         "fix t all hd/tension 5 0.05 1 xyz\nrun 1\nchange_box all boundary p p f\nrun 1\n"),
        ("a fix that counts steps by its calls", "after a trial move is not known", LANGEVIN +
         "fix s all smd cvel 1 0.1 tether NULL NULL 4 0\nfix t all hd/tension 5 0.05 1 xy\nrun 1\n"),
        ("run_style respa", "respa", LANGEVIN.replace("langevin 0.05 0.05 1.5 4711 mass sampling", "nve") +
         "fix t all hd/tension 5 0.05 1 xy\nrun_style respa 2 2\nrun 0\n"),
        ("fix npt on control points", "use fix hd/langevin and fix hd/tension",
         "fix 1 all npt temp 1 1 1 x 0 0 1\nrun 0\n"),
        ("fix nph on control points", "use fix hd/langevin and fix hd/tension", "fix 1 all nph x 0 0 1\nrun 0\n")):
    says(text, words, BASE + script)
says("a box that nothing holds", "nothing holds it", """
units           lj
region          b block 0 10 0 10 0 10
create_box      1 b
create_atoms    1 random 20 1234 NULL
mass            1 1.0
pair_style      none
comm_modify     cutoff 2.0
fix             1 all nve
fix             t all hd/tension 1 1.0 4711 x y z attempts 20 step 0.1 burn 0
run             100000
""")
says("a direction that is not periodic", "not periodic in z", BASE.replace("newton", "boundary p p f\nnewton") +
     "fix t all hd/tension 5 0.05 1 xyz\n")
VESICLE = """
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
create_box      1 box angle/types 1
create_membrane 1 sphere 2 2.0
special_bonds   lj/coul 1 1 1
pair_style      helfrich
pair_coeff      1 1 1.0 0.0 regularize 1.0 conformal
"""
says("tension without a sheet", "continues through the box in two directions", VESICLE +
     "fix t all hd/tension 5 0.05 1 xy tension 1.0\nrun 0\n")
says("solvent that does not go with the box", "needs all solvent and all membranes",
     SOLVENT.format(every=5, steps=10).replace("fix             t all", "fix             t mem"))
says("a box too small for a mesh that does not go with it", "half the periodic box",
     VESICLE.replace("sphere 2 2.0", "sphere 1 2.0").replace("-3 3 -3 3 -3 3", "-2.2 2.2 -2.2 2.2 -2.2 2.2")
     .replace("create_box      1", "create_box      2") + "create_atoms 2 single 0 0 0\nset type 2 mass 1.0\ngroup g type 2\n"
     "fix 1 g nve\nfix t g hd/tension 1 0.05 1 xyz pressure 50 attempts 20\nrun 100\n")

finish()
