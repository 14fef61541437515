"""fix hd/lipids: whole lipids on faces, their exchange, and what commands between two runs do to them.

    MEMBRANE_LONG=1    also numbers of lipids over 1e7 moves
"""
# cost: 18
# timeout: 7200

import re
import struct

from lammps_claims import LONG, MPIEXEC, claim, error_of, finish, run, thermo

KINDS = "library A 0.020 0.9 library B 0.031 -0.7 library C 0.026 0.1"
ATOMS = """
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
create_box      1 box angle/types 1
create_membrane 1 sphere 2 1.5
set             type 1 mass 1.0
displace_atoms  all random 0.02 0.02 0.02 4711
pair_style      helfrich
"""
COEFF = "pair_coeff 1 1 20.0 0.05 area 100 init regularize 10 {more} lipids NULL outer A 50 B 30 C 20 inner B 40 A 60 " + KINDS + "\n"
OUTPUT = """
compute         n all membrane/lipids
compute         l all membrane/lipids outer A inner B curvature
compute         s all reduce sum c_l[1] c_l[2] c_l[3] inputs local
compute         q all reduce sumsq c_l[1] c_l[2] c_l[3] inputs local
thermo_style    custom step pe econserve f_x f_x[1] f_x[2] f_x[3] c_n[1] c_n[2] c_n[3] c_n[4] c_n[5] c_n[6] c_s[1] c_s[2] c_s[3] c_q[1] c_q[2] c_q[3]
thermo_modify   norm no format float %.17g
thermo          10
"""
NUMBERS = [f"c_n[{k}]" for k in range(1, 7)]
PLACES = [f"c_{c}[{k}]" for c in "sq" for k in (1, 2, 3)]
MOVES = "diffuse 0.5 flip 0.5 global 0.5 interaction A B 0.3"
RANKS = (1, 2, 4) if MPIEXEC else (1,)


def start(more="", moves=MOVES, integrator="fix i all hd/langevin 1.0 1.0 1.0 4711\n", every=5):
    return (ATOMS + COEFF.format(more=more) + integrator +
            f"fix x all hd/lipids {every} 1.0 99 {moves}\ntimestep 0.001\n" + OUTPUT)


def numbers(row):
    return [row[k] for k in NUMBERS]


def places(row):
    return [row[k] for k in PLACES]


def same_places(row, other, times=1.0):
    return numbers(row) == [times * n for n in numbers(other)] and all(
        abs(a - times * b) < 1e-11 * (1.0 + abs(a)) for a, b in zip(places(row), places(other)))


# === Numbers and curvatures of faces

for ranks in RANKS:
    row = thermo(run(start().replace("random 0.02 0.02 0.02", "move 0 0 0").replace(" 4711\npair_style", "\npair_style") + """
unfix           i
compute         b all membrane/lipids bend outer A
compute         m all reduce ave c_b[1] inputs local
compute         o all reduce sum c_b[2] inputs local
compute         area all membrane/shape
thermo_style    custom step c_m c_o c_n[1] c_area[4] c_area[1]
thermo_modify   norm no format float %.17g
run             0
""", ranks=ranks))[-1]
    exact = 2.0 * row["c_area[4]"] / row["c_area[1]"]
    claim(f"{ranks} rank(s): the mean of bend over equal faces is that of 2H over the surface", abs(row["c_m"] / exact - 1.0) < 2e-3,
          f"{row['c_m']} {exact}")
    claim("    and columns are in the order in which they are asked for", row["c_o"] == row["c_n[1]"], row["c_o"])

first = {}
for ranks in RANKS:
    rows = thermo(run(start(moves="diffuse 0.5 global 0.5 interaction A B 0.3") + "run 50\n", ranks=ranks))
    claim(f"{ranks} rank(s): numbers of all kinds in both leaflets stay, and places do not",
          all(numbers(row) == numbers(rows[0]) for row in rows) and places(rows[0]) != places(rows[-1]), numbers(rows[0]))
    first[ranks] = rows
    same = numbers(rows[0]) == numbers(first[1][0]) and places(rows[1])[:2] == places(first[1][1])[:2]
    claim("  they are those of one rank, and so are the places after two visits", same)

total = sum(numbers(first[1][0])[:3])
for k, part in enumerate((0.5, 0.3, 0.2)):
    claim(f"  the outer leaflet has its part of kind {k + 1}, to one lipid",
          abs(first[1][0][f"c_n[{k + 1}]"] - part * total) <= 1.0, first[1][0][f"c_n[{k + 1}]"])

rows = thermo(run(start() + "run 50\n"))
pairs = [[row[f"c_n[{k}]"] + row[f"c_n[{k + 3}]"] for k in (1, 2, 3)] for row in rows]
claim("with flips numbers of both leaflets together stay, and those of one do not",
      all(p == pairs[0] for p in pairs) and numbers(rows[0]) != numbers(rows[-1]))

run(start(moves="global 1") + "fix a all ave/time 1 20 20 c_n[1] c_n[2] c_n[3] c_n[4] mode vector file columns.txt\nrun 20\n")
table = [[float(word) for word in line.split()[1:]] for line in open("columns.txt").readlines()[-6:]]
claim("compute: columns of the array over leaflets and kinds, to average",
      len(table) == 6 and [row[0] for row in table] == numbers(first[1][0]) and
      all(abs(sum(row[1] for row in table[k:k + 3]) - 1.0) < 1e-5 for k in (0, 3)) and
      all(abs(row[3]) < 1.0 and abs(row[2] - 2 / 1.5) < 0.2 for row in table if row[0] > 0), table[0])

# === The energy of swaps is that of the membrane, whatever else it has

for more in ("", "leaflets 0.2", "leaflets 0.2 kg -5 volume 10 init"):
    rows = thermo(run(start(more, moves="diffuse 0.5 flip 0.5 global 0.5", integrator="") + "run 20\n"))
    error = max(abs(row["Econserve"] - rows[0]["Econserve"]) for row in rows)
    moved = abs(rows[-1]["PotEng"] - rows[0]["PotEng"])
    claim(f"a membrane at rest{', ' + more if more else ''}: its energy changes by what fix hd/lipids says",
          error < 1e-9 * abs(rows[0]["PotEng"]) + 1e-8 and moved > 0.5, f"{error:.1e} of {moved:.2g}")

rows = thermo(run(start(moves=MOVES, integrator="").replace("f_x[3]", "f_x[3] f_x[4]") + "run 20\n"))
error = max(abs(row["Econserve"] - rows[0]["Econserve"]) for row in rows)
contacts = abs(rows[-1]["f_x[4]"] - rows[0]["f_x[4]"])
claim("  the energy of contacts is no part of it, and has a number of its own",
      error < 1e-9 * abs(rows[0]["PotEng"]) + 1e-8 and contacts > 0.5, f"{error:.1e}, contacts change by {contacts:.2g}")

# === Restart, and commands between two runs

whole = thermo(run(start() + "run 20\nwrite_restart between.restart\nrun 20\n"))
again = start().split("pair_style")[0].split("units")[0] + "read_restart between.restart\n" + start().split("pair_style      helfrich\n")[1].split("\n", 1)[1]
for ranks in RANKS[:2]:
    rows = thermo(run(again + "run 20\n", ranks=ranks))
    if ranks == 1:
        claim("restart: energies and places of all lipids are bitwise those of one run",
              [list(row.values()) for row in rows[-2:]] == [list(row.values()) for row in whole[-2:]],
              f"{rows[-1]['PotEng']:.17g} {whole[-1]['PotEng']:.17g}")
    else:
        claim("restart on two ranks: the same numbers", numbers(rows[0]) == numbers(whole[2]) and
              places(rows[0])[:2] == places(whole[2])[:2])

rows = thermo(run(start() + "run 20\nreplicate 2 1 1\nrun 0\nrun 20\n"))
claim("replicate: copies have the lipids of their original, face by face",
      same_places(rows[3], rows[2], 2.0))
claim("  and twice its energy", abs(rows[3]["PotEng"] - 2.0 * rows[2]["PotEng"]) < 1e-9 * abs(rows[2]["PotEng"]))
claim("  and move on", places(rows[-1]) != places(rows[3]))

rows = thermo(run(start() + "run 20\nreplicate 2 1 1\nwrite_restart copies.restart\nrun 0\n"))
claim("  also if a restart file is written in between", same_places(rows[3], rows[2], 2.0))
rows = thermo(run(again.replace("between", "copies") + "run 0\n"))
claim("  and in that file", same_places(rows[0], whole[2], 2.0))

rows = thermo(run(start() + "run 20\nreset_atoms id\nrun 0\nreset_timestep 0\nrun 20\n"))
claim("reset_atoms id: lipids stay on their faces", same_places(rows[3], rows[2]))
claim("reset_timestep: other noise than in the first run", rows[-1]["f_x[1]"] != 2.0 * rows[2]["f_x[1]"] and
      rows[-1]["f_x[3]"] == 8.0 and numbers(rows[4]) == numbers(rows[2]), rows[-1]["f_x[3]"])

TWO = start().replace("create_membrane 1 sphere 2 1.5\n", "create_membrane 1 sphere 2 1.0 center -1.5 0 0\ncreate_membrane 1 sphere 2 1.1 center 1.5 0 0\n")
TWO = TWO.replace("compute         n all", "group second molecule 2\ncompute         n second").replace("compute         l all", "compute         l second")
rows = thermo(run(TWO + "run 20\ngroup first molecule 1\ndelete_atoms group first\nrun 0\nrun 20\n"))
claim("delete_atoms of one of two membranes: the other keeps its lipids",
      same_places(rows[3], rows[2]), numbers(rows[3]))

# === Pictures

def vtp_fields(path):
    text = open(path, "rb").read().decode("latin1")
    return re.findall(r'Name="((?:outer|inner)_\w+)"', text)


output = run(start() + "run 5\nwrite_membrane lipids.vtp subdivide 2\nwrite_membrane lipids.ply subdivide 1\n")
claim("write_membrane: a field for each kind and leaflet",
      vtp_fields("lipids.vtp") == ["outer_A", "outer_B", "outer_C", "inner_A", "inner_B"], vtp_fields("lipids.vtp"))
header, data = open("lipids.ply", "rb").read().split(b"end_header\n")
names = re.findall(rb"property (\w+) (\w+)\n", header.split(b"element face")[0])
size = {b"double": ("d", 8), b"float": ("f", 4), b"int": ("i", 4)}
row = struct.Struct("<" + "".join(size[kind][0] for kind, _ in names))
count = int(re.search(rb"element vertex (\d+)", header)[1])
points = [dict(zip([name.decode() for _, name in names], row.unpack_from(data, i * row.size))) for i in range(count)]
claim("  fractions of a point sum to one, and differ from point to point",
      all(abs(sum(p[f"outer_{k}"] for k in "ABC") - 1.0) < 1e-5 for p in points) and len({p["outer_A"] for p in points}) > 10)
mean = sum(p["outer_A"] for p in points) / count
claim("  and are near the composition", abs(mean - 0.5) < 0.05, mean)

PICTURE = "dump d all membrane/image 5 lipids.*.ppm type type size 100 100 box no 0 axes no 0 0\ndump_modify d surface {} range 0 1\nrun 5\n"
output = run(start() + PICTURE.format("outer A"))
claim("dump membrane/image colors by a kind", "colors membranes by the part of A from 0 to 1" in output and
      len(set(open("lipids.5.ppm", "rb").read())) > 20)

# === Bad input

for text, script in {
        "has no lipids to exchange; say lipids in pair_coeff 1 1":
            start().replace(COEFF.format(more=""), "pair_coeff 1 1 20.0 0.0 regularize 10\n").replace("interaction A B 0.3", ""),
        "interaction: no membrane has the lipid D; they have: A": start(moves="diffuse 1 interaction A D 0.3"),
        "temperature -1.0 must be positive": start().replace("hd/lipids 5 1.0", "hd/lipids 5 -1.0"),
        "N 0 must be a number of steps": start(every=0),
        "seed 0 must be positive": start().replace("1.0 99 ", "1.0 0 "),
        "diffuse -1 must not be negative": start(moves="diffuse -1"),
        "Unknown fix hd/lipids keyword swap; known are: diffuse, flip, global, interaction": start(moves="swap 1"),
        "There are several fixes hd/lipids": start() + "fix y all hd/lipids 5 1.0 99 global 1\n",
        "control points of membrane 1; use a group": start().replace("fix x all", "group some id < 50\nfix x some"),
        "no single lipids are on faces; use fix hd/lipids": start() + "unfix x\nthermo_style custom step c_n[1]\n",
        "no membrane has the lipid D": start().replace("outer A inner B curvature", "outer D inner B curvature"),
        "dump_modify surface outer: no membrane has the lipid D": start() + PICTURE.format("outer D"),
        "dump_modify surface inner: no single lipids are on faces": start().split("fix x")[0] + PICTURE.format("inner A"),
        "Unknown compute membrane/lipids keyword top": start().replace("outer A inner B", "top A"),
}.items():
    line = error_of(script + "run 5\n")
    claim(f"error: ... {text} ...", text in line, "" if text in line else line)

# === Commands that are no run leave lipids where they are

HOT = "library A 0.1 0.6 library B 0.1 -0.6"
PLAIN = """
units           lj
atom_style      membrane_cp
region          box block -6 6 -6 6 -6 6
create_box      3 box angle/types 1
create_membrane 1 sphere 2 2.0
special_bonds   lj/coul 1 1 1
group           low id < 80
pair_style      helfrich
pair_coeff      1 1 10.0 0.0 regularize 10 lipids NULL outer A 1 B 1 inner B 1 """ + HOT + """
pair_coeff      2 2 10.0 0.0 regularize 10 lipids NULL outer C 1 inner D 1 library C 0.1 0.2 library D 0.1 -0.3
thermo_modify   norm no format float %.14g
thermo          10
timestep        0.001
"""
EXCHANGE = "fix i all hd/nve\nfix x all hd/lipids 10 1.0 4711 global 1\n"
NUMBERED = """
compute         n all membrane/lipids
variable        sum equal pe+f_x
thermo_style    custom step pe f_x v_sum c_n[1] c_n[2] c_n[3] c_n[4]
thermo_modify   norm no format float %.14g
"""
for ranks in RANKS[:2]:
    rest = "run 50 pre no" if ranks == 1 else "run 50"    # LAMMPS' forces do not go along with atoms to other ranks
    want = thermo(run(PLAIN + EXCHANGE + NUMBERED + f"run 50\n{rest}\n", ranks=ranks))[-1]
    for command in ("write_data x.data", "write_restart x.restart", "hd_timestep all", "hd_modes all lowest 2 file x.txt"):
        got = thermo(run(PLAIN + EXCHANGE + NUMBERED + f"run 50\n{command}\n{rest}\n", ranks=ranks))[-1]
        off = max(abs(got[k] - want[k]) / (1 + abs(want[k])) for k in want)
        claim(f"{ranks} ranks: {command.split()[0]} between two runs changes nothing", off < 1e-9, f"{off:.1e}")
output = run(PLAIN + EXCHANGE + NUMBERED + "run 50\nwrite_data x.data\nwrite_membrane after.vtp\nprint \"now $(c_n[1])\"\n")
claim("    lipids can be written and counted after it", "outer_A" in vtp_fields("after.vtp") and "now " in output)
MODES = PLAIN + EXCHANGE.replace("global 1", "global 1 interaction A B 6") + "run 0\nunfix i\nrun 200\nhd_modes all lowest 1 file {0}\n"
run(MODES.format("with.txt"))
run(MODES.replace("hd_modes", "unfix x\nrun 0\nhd_modes").format("without.txt"))
with_lipids, without = (next(line for line in open(path) if line.split()[1:2] == ["1"]) for path in ("with.txt", "without.txt"))
claim("hd_modes sees the lipids that faces have", with_lipids != without, with_lipids)
FRESH = "thermo_style custom step pe\nthermo_modify norm no format float %.14g\nunfix x\npair_coeff 1 1 10.0 0.0 regularize 10 lipids NULL outer A 1 inner A 1 " + HOT + "\nrun 0\n"
energy = [thermo(run(PLAIN + EXCHANGE + f"run 0\n{command}" + FRESH))[-1]["PotEng"] for command in ("", "write_data x.data\n")]
claim("    and after unfix nothing of them is left", abs(energy[0] / energy[1] - 1) < 1e-12, energy)
kinds = [[row[f"c_n[{k}]"] > 0 for k in (1, 2, 3, 4)] for row in
         (thermo(run(PLAIN + more + "set group all type 2\n" + (EXCHANGE + NUMBERED) * (more == "") + "run 0\n"))[-1]
          for more in ("", EXCHANGE + NUMBERED + "run 50\n"))]
claim("points of another type have the lipids of this type", kinds[0] == kinds[1] == [False, False, True, False], kinds)
rows = thermo(run(PLAIN.replace("id < 80\n", "id < 80\nneigh_modify exclude group low low\n") +
                  EXCHANGE.replace("fix i all hd/nve\n", "") + NUMBERED + "run 50\n"))
sums = [row["v_sum"] for row in rows]
claim("faces that neigh_modify leaves out cost their lipids nothing", max(sums) - min(sums) < 1e-9 * abs(sums[0]) + 1e-9, sums)
OTHER = PLAIN.replace("create_membrane 1 sphere 2 2.0", "create_membrane 1 sphere 2 2.0 center -3 0 0\ncreate_membrane 2 sphere 2 2.0 center 3 0 0")
OTHER += """
pair_coeff      3 3 10.0 0.0
region          up block INF INF INF INF 0 INF
group           first molecule 1
group           second molecule 2
group           cap region up
group           top intersect cap second
set             group top type 3
compute         e all pe/atom
compute         its second reduce sum c_e
thermo_style    custom step c_its
thermo_modify   norm no format float %.14g
run             0
fix             x first hd/lipids 10 1.0 4711 global 1
run             0
"""
its = [row["c_its"] for row in thermo(run(OTHER))]
claim("the energy of another membrane, part of which has lipids, stays what it is", abs(its[0] / its[1] - 1) < 1e-12, its)

RAMP = start(integrator="fix i all hd/langevin 1.0 1.1 1.0 4711\n") + "run 20\n"
said = [run(script + "run 5\n").count("they need one temperature") for script in (RAMP, start())]
claim("a temperature that is ramped away from that of lipids is told once", said == [1, 0], said)

# === Bound particles make room for themselves

CROWDED = """
units           lj
atom_style      membrane_cp
region          box block -8 8 -8 8 -8 8
create_box      2 box angle/types 1
create_membrane 1 sphere 2 3.5 interpolate yes
set             type 1*2 mass 1.0
group           mem type 1
{bound}
pair_style      hybrid/overlay helfrich zero 1.0
pair_coeff      1 1 helfrich 20.0 0.0 regularize 10 lipids NULL outer A 3 B 1 inner A 1 library A 0.04 0.0 library B 0.06 0.0
pair_coeff      * * zero
neighbor        0.5 bin
fix             1 mem hd/langevin 1.0 1.0 1.0 4711
{hold}
fix             x mem hd/lipids 10 1.0 99 global 1
compute         n mem membrane/lipids
compute         l mem membrane/lipids outer A outer B inner A
compute         e mem reduce min c_l[1] c_l[3] inputs local
thermo_style    custom step c_n[1] c_n[2] c_n[3] c_n[4] c_e[1] c_e[2]
run             0
"""
FOOTPRINTS = 20, 1.3
hold = f"group points type 2\nfix p points nve\nfix b points hd/bind mem footprint 2 {FOOTPRINTS[1]} 30.0 0.0 1.0"


def area_of_lipids(row):
    return 0.04 * row["c_n[1]"] + 0.06 * row["c_n[2]"], 0.04 * row["c_n[3]"]


free = thermo(run(CROWDED.format(bound="", hold="")))[-1]
for ranks in RANKS[:2]:
    row = thermo(run(CROWDED.format(bound=f"create_bound {FOOTPRINTS[0]} 2 mem 4711", hold=hold), ranks=ranks))[-1]
    less = [a - b for a, b in zip(area_of_lipids(free), area_of_lipids(row))]
    claim(f"{ranks} rank(s): lipids and footprints together have the area of each leaflet, to a lipid of each kind",
          all(abs(area - FOOTPRINTS[0] * FOOTPRINTS[1]) < 0.1 for area in less), less)
    claim("    in the proportions of the composition", abs(row["c_n[1]"] - 3 * row["c_n[2]"]) <= 4, (row["c_n[1]"], row["c_n[2]"]))
    claim("    and faces under particles have none", free["c_e[1]"] > 0 and free["c_e[2]"] > 0 and row["c_e[1]"] == row["c_e[2]"] == 0,
          (free["c_e[1]"], row["c_e[1]"]))
message = error_of(CROWDED.format(bound="create_bound 40 2 mem 4711", hold=hold.replace("1.3", "5.0")))
claim("error: footprints that take all of a membrane", "leave no room for lipids on the membrane of atom" in message, message)

if LONG:
    rows = thermo(run(start(moves="diffuse 50 global 40") + "run 5000\n"))
    claim("numbers stay over 1e7 moves", all(numbers(row) == numbers(rows[0]) for row in rows) and
          rows[-1]["f_x[1]"] > 1e7, rows[-1]["f_x[1]"])

finish()
