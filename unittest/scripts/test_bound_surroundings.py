"""Bound particles on a mesh of which most faces are irregular and which moves; beside solvent; on membranes of two temperatures;
in the trial runs of hd_timestep."""
# cost: 15

import math

from lammps_claims import claim, finish, run, thermo
from membrane_scenes import bipyramid, read_dump, read_off, write_off
from spread_and_slope import spread

# === A vesicle at kc = 20 kT of 30 points, of valences 7, 4 and 6, that undulates: 42 of 56 faces are irregular

points, faces = bipyramid(7)
write_off("uneven.off", [(1.2 * x, y, z) for x, y, z in points], faces)
MOVING = """
units           lj
atom_style      membrane_cp
region          box block -8 8 -8 8 -8 8
create_box      2 box angle/types 1
create_membrane 1 file uneven.off scale 2.5 2.5 2.5 refine 1
set             type 1 mass 2.0
group           mem type 1
create_bound    {n} 2 mem 4711 mass {m}
group           p type 2
pair_style      hybrid/overlay helfrich zero 1.0
pair_coeff      1 1 helfrich 20.0 0.0 regularize 20 conformal volume 100 init
pair_coeff      * * zero
special_bonds   lj/coul 1 1 1
neighbor        0.5 bin
timestep        {dt}
velocity        p create 1.0 99 loop all
{fixes}
compute         T all hd/temp
thermo_style    custom step pe etotal c_T {more}
thermo_modify   norm no format float %.16g temp T
thermo          {every}
"""


def moving(hold, n=10, m=1.0, dt=0.005, every=1, more=""):
    fixes = f"fix 1 mem hd/nve tol 1e-13 measure 1.0\nfix 2 p nve\nfix b p hd/bind mem hold {hold}\nhd_velocity mem 1.0 12"
    return MOVING.format(n=n, m=m, dt=dt, every=every, fixes=fixes, more=more or "f_b[4]")


# curvature diverges at valence 7, so single steps across there are worse than others, and ratios not quite 16

for hold in ("spring 2000", "rigid", "spring 2000 footprint 2 1.0 30.0 0.5 1.8"):
    errors = []
    for dt in (0.004, 0.001):
        steps = round(1.0 / dt)
        rows = thermo(run(moving(hold, dt=dt) + f"run {steps}\n"))[-steps - 1:]
        errors.append(spread([row["TotEng"] for row in rows]))
    claim(f"irregular faces, {hold}: a quarter of the step, a sixteenth of the energy error", 11 < errors[0] / errors[1] < 23,
          f"{errors[0]:.2e} {errors[1]:.2e}, {errors[0] / errors[1]:.1f}")

ends = {}
for ranks in (1, 2):
    run(moving("spring 2000", n=40, every=500) + "run 500\nwrite_dump all custom x.dump id x y z modify format float %.17g\n", ranks=ranks)
    ends[ranks] = read_dump("x.dump")[-1]
off = max(abs(a - b) for i in ends[1] for a, b in zip(ends[1][i], ends[2][i]))
claim("    2 ranks follow one to 1e-9 over 500 steps", off < 1e-9, f"{off:.1e}")

# === There they are uniform in area, at any time on the shape of that time

N, FRAMES, FACES, SUB = 300, 40, 56, 4
text = MOVING.format(n=N, m=1.0, dt=0.01, every=1000, more="c_shape[1]", fixes="""
fix 1 mem hd/langevin 1.0 1.0 1.0 81
fix 2 p nve
fix 3 p langevin 1.0 1.0 0.5 82
fix b p hd/bind mem hold spring auto
hd_velocity mem 1.0 12
compute shape mem membrane/shape
compute s p hd/surface/atom b
""") + f"run 1000\nreset_timestep 0\ndump 1 p custom 200 x.dump id c_s[1]\ndump_modify 1 first no\nrun {200 * FRAMES} every 200 'write_membrane m.*.off subdivide {SUB}'\n"
run(text)


def area(a, b, c):
    u, v = ([q - p for p, q in zip(a, end)] for end in (b, c))
    return 0.5 * math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])


found = read_dump("x.dump")[:FRAMES]
blocks, share, large = [], 0.0, None
for k, frame in enumerate(found):
    xs, tris = read_off(f"m.{200 * (k + 1)}.off")
    sizes = [area(*(xs[v] for v in tri)) for tri in tris]
    per = len(sizes) // FACES
    of_face = [sum(sizes[f * per:(f + 1) * per]) for f in range(FACES)]
    if not large:
        large = set(sorted(range(FACES), key=lambda f: of_face[f])[FACES // 2:])
    expected = sum(of_face[f] for f in large) / sum(of_face)
    blocks.append(sum(int(row[0]) - 1 in large for row in frame.values()) / N - expected)
    share += expected / FRAMES
mean = sum(blocks) / len(blocks)
error = spread(blocks) / math.sqrt(len(blocks) - 1)
claim("particles of a bath are uniform in area on the irregular mesh that moves, within three errors", abs(mean) < 3 * error < 0.03,
      f"in the larger half of the faces {mean:+.4f} +- {error:.4f} more than by area, {share:.4f}")

# === Two membranes at two temperatures: the correction of a rigid hold has that of its own

TWINS = """
units           lj
atom_style      membrane_cp
region          box block -6 6 -3 3 -3 3
create_box      2 box angle/types 1
create_membrane 1 sphere 1 2.0 center -3 0 0
create_membrane 1 sphere 1 2.0 center 3 0 0
set             type 1 mass 1.0
group           cold molecule 1
group           hot molecule 2
create_atoms    2 single -2 1 1.2
create_atoms    2 single -2 -1 1.2
create_atoms    2 single 4 1 1.2
create_atoms    2 single 4 -1 1.2
set             type 2 mass 5.0
region          left block INF 0 INF INF INF INF
group           left region left
group           two type 2
group           near intersect two left
group           far subtract two near
pair_style      helfrich
pair_coeff      1 1 20.0 0.0 regularize 10
timestep        0.001
fix             1 cold hd/langevin 1.0 1.0 1.0 81
fix             2 hot hd/langevin 3.0 3.0 1.0 82
fix             3 two nve
fix             c near hd/bind cold max 1 hold rigid
fix             h far hd/bind hot max 1 hold rigid
thermo_style    custom step f_c f_h
thermo_modify   norm no format float %.16g
run             0
"""
row = thermo(run(TWINS))[-1]
claim("two membranes at 1 and 3: corrections are in proportion", abs(row["f_h"] - 3 * row["f_c"]) < 1e-9 < 0.1 < row["f_c"],
      f"{row['f_c']} {row['f_h']}")

# === Solvent streams past bound particles, and its bath is theirs through the membrane

SOLVENT = """
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
create_box      3 box angle/types 1
create_membrane 1 sphere 1 1.8 mass 20
create_solvent  2 both 5.0 4711 mass 1.0
group           mem type 1
group           solvent type 2
create_bound    12 3 mem 4711 mass 10
group           p type 3
velocity        solvent create 1.0 7 loop all
velocity        p create {warm} 8 loop all
special_bonds   lj/coul 1 1 1
pair_style      helfrich
pair_coeff      1 1 20.0 0.0 regularize 10 volume 100 init
fix             1 mem hd/nve tol 1e-12
fix             2 p nve
fix             b p hd/bind mem hold spring 3000
fix             s solvent srd/mesh 10 mem 1.0 1.0 4711 shift yes 9127 {tstat} collision noslip
timestep        0.004
compute         T p temp
variable        px equal f_s[5]+mass(p)*vcm(p,x)
variable        py equal f_s[6]+mass(p)*vcm(p,y)
variable        pz equal f_s[7]+mass(p)*vcm(p,z)
thermo_style    custom step etotal f_b[2] f_b[4] c_T v_px v_py v_pz f_b
thermo_modify   norm no format float %.16g lost error
thermo          20
run             {steps}
"""
rows = thermo(run(SOLVENT.format(tstat="", warm=1.0, steps=400), ranks=2))
off = max(abs(row[k] - rows[0][k]) for row in rows for k in ("v_px", "v_py", "v_pz"))
claim("solvent, membrane and bound particles together keep their momentum", off < 1e-7, f"{off:.1e}, {rows[0]['v_px']:.3f}")
claim("    none is lost, none off by half an edge", all(row["f_b[2]"] == 12 for row in rows) and max(row["f_b[4]"] for row in rows) < 0.3,
      f"{max(row['f_b[4]'] for row in rows):.3f}")
rows = thermo(run(SOLVENT.format(tstat="tstat yes", warm=2.0, steps=10000)))[100:]
values = [row["f_b"] / 6.0 for row in rows]    # a half kT for each of 12 springs
blocks = [sum(values[i * len(values) // 10:(i + 1) * len(values) // 10]) / (len(values) // 10) for i in range(10)]
mean, error = sum(values) / len(values), spread(blocks) / 3.0
claim("springs between particles and membrane come to the temperature of the solvent, within three errors", abs(mean - 1.0) < 3 * error < 0.3,
      f"{mean:.3f} +- {error:.3f}; particles along the surface {rows[-1]['c_T']:.2f}")

# === The trial runs of hd_timestep renew neighbor lists where other atoms are near

TRIALS = """
units           lj
atom_style      membrane_cp
region          box block -8 8 -8 8 -8 8
create_box      2 box angle/types 1
create_membrane 1 sphere 2 3.5 interpolate yes
set             type 1 mass 1.0
group           mem type 1
create_bound    100 2 mem 4711 mass 1.0 min 0.5
group           p type 2
pair_style      hybrid/overlay helfrich lj/cut 1.0
pair_coeff      1 1 helfrich 20.0 0.0 regularize 10
pair_coeff      * * lj/cut 0.0 1.0
pair_coeff      2 2 lj/cut 1.0 0.5
neighbor        {skin} bin
fix             1 mem hd/nve measure 1.0
fix             2 p nve
fix             b p hd/bind mem hold spring 3000
hd_velocity     mem 1.0 12
velocity        p create 1.0 99 loop all
thermo_style    custom step pe
thermo_modify   norm no format float %.16g
run             0
hd_timestep     mem
run             0
"""
tables = {}
for skin in (3.0, 0.01):
    text = run(TRIALS.format(skin=skin))
    tables[skin] = text[text.index("trial step"):text.index("present timestep")]
    rows = thermo(text)
claim("hd_timestep finds the same with a skin that atoms leave in each step", tables[3.0] == tables[0.01], tables[0.01].split("\n")[2])
claim("    and leaves all where it was", abs(rows[-1]["PotEng"] - rows[0]["PotEng"]) < 1e-9, f"{rows[0]['PotEng']}")

finish()
