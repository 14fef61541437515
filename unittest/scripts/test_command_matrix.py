"""All styles of the package alive in one script, through each LAMMPS command that may stand between two runs.

After the command they go on as in a script that starts there: from a restart file written in its place. A
command is a line below; what single styles do about it is in test_between_runs.py."""
# cost: 55

import os
import sys

from lammps_claims import EXAMPLES, MPIEXEC, claim, finish, lammps, thermo
from membrane_scenes import bipyramid, write_off

sys.path.insert(0, os.path.join(EXAMPLES, "molecules"))
import make_patch    # noqa: E402

RANKS = (1, 2) if MPIEXEC else (1,)
make_patch.finish(make_patch.lattice(6), "m", 6)
with open("m.pdb") as file:    # lipids of four beads: that is faster
    lines = [line for line in file if line[:4] != "ATOM" or line[12:16].split()[0] in ("NC3", "GL1", "C2A", "C4A")]
with open("m.pdb", "w") as file:
    file.writelines(lines)
write_off("irregular.off", *bipyramid(9))

# three vesicles, one for each integrator, of meshes with few regular faces; solvent meets the first two, and particles
# are bound to the first. One of modes
ATOMS = """
units           lj
atom_style      membrane_cp
region          box block -4.5 4.5 -3 3 -3 3
create_box      3 box angle/types 1
create_membrane 1 sphere 1 1.2 center -3.0 0 0 mass 20
create_membrane 1 sphere 1 1.2 center  0.0 0 0 mass 20
create_membrane 1 file irregular.off refine 1 center 3.0 0 0 mass 20
create_membrane 1 sphere 1 0.8 center -1.5 2.0 2.0 molecule 9 mass 20
create_solvent  2 both 3.0 4711 mass 1.0
group           solvent type 2
group           nve molecule 1
group           langevin molecule 2
group           brownian molecule 3
group           modes molecule 9
group           points type 1
group           walls union nve langevin
create_bound    12 3 nve 4711 leaflet both height 0.05 mass 2.0
group           bound type 3
velocity        bound create 1.0 99 loop all
group           breathing subtract all modes
velocity        points create 1.0 88
pair_style      helfrich
"""
COEFF = ("pair_coeff 1 1 10.0 0.1 kg -3.0 tension 0.2 area 30 init area/difference 5 init thickness 0.1 area/local 40 "
         "volume 20 init pressure 0.1 regularize 1.0 leaflets 0.01 &\nlipids NULL outer A 3 B 1 inner A 1 library A 0.04 0.3 "
         "library B 0.06 -0.2\n")
FIXES = """
fix             l points hd/lipids 2 1.0 4711 diffuse 0.5 flip 0.5 global 0.1 interaction A B 0.2
fix             i1 nve hd/nve
fix             i2 langevin hd/langevin 1.0 1.0 1.0 4711
fix             i3 brownian hd/brownian 1.0 4711 gamma_t 50
fix             i4 modes hd/langevin 1.0 1.0 NULL 4711 modes sphere min 0 max 3 relax eta 50
fix             p bound nve
fix             h bound hd/bind nve hold spring 2000 height 0.05 footprint 3 0.2 20.0 0.5 1.0
fix             b breathing hd/tension 2 1.0 4711 xyz pressure 0.1 step 1e-8 burn 0
fix             s solvent srd/mesh 2 walls 1.0 1.0 4711 shift yes 9127 collision {slip}
"""
COMPUTES = """
compute         hf all pair helfrich
compute         t walls hd/temp
compute         bt bound hd/temp
compute         site bound hd/surface/atom h
compute         density bound hd/density h
compute         u nve hd/modes sphere 4
compute         shape points membrane/shape
compute         n points membrane/lipids
compute         k points membrane/curvature/atom
compute         x all property/atom xu yu zu
variable        place atom (c_x[1]+1.7*c_x[2]+2.3*c_x[3]+0.1*vx-0.2*vy)*(1+(id%7))
compute         k2 points reduce sum c_k[1] v_place
compute         b2 bound reduce sum c_site[5] c_site[7] c_site[13]
compute         all all reduce sum v_place
"""
THERMO = """
thermo_style    custom step atoms pe c_hf[1] c_hf[2] c_hf[3] c_hf[4] c_hf[5] c_hf[6] c_t c_u[1] c_shape[1] c_shape[2] &
                c_k2[1] c_k2[2] c_all f_i4[3][4] f_i4[3][6] vol f_b f_b[1] f_s[2] f_s[3] f_s[5] f_s[8] f_s[9] f_s[17] &
                f_h f_h[2] f_h[4] f_h[6] c_bt c_b2[1] c_b2[2] c_b2[3] c_density[1][3] &
                f_l f_l[1] f_l[2] c_n[1] c_n[2]
thermo_modify   norm no format float %24.17g
"""
DUMP = "dump            d points membrane/image 1 {image}.*.ppm type type size 40 40\n"
OUTPUT = THERMO + DUMP + """
thermo          1
timestep        0.002
min_style       membrane
"""
REGROUP = "group breathing clear\ngroup breathing subtract all modes\n"    # the box of modes must not change
RUN = REGROUP + "run 3\n"

REFIX = "".join(f"unfix {fix}\n" for fix in ("l", "i1", "i2", "i3", "i4", "p", "h", "b", "s")) + FIXES
UNCOMPUTE = "thermo_style one\n" + "".join(f"uncompute {c}\n" for c in ("all", "b2", "k2", "x", "k", "n", "shape", "u", "density", "site", "bt", "t", "hf")) + COMPUTES + THERMO
FOURTH = """
region          gap sphere 0 0 3 1.4
group           gap region gap
group           there subtract gap points
delete_atoms    group there compress no
create_membrane 1 sphere 1 0.8 center 0 0 3 mass 20
group           langevin molecule 4
group           points type 1
group           walls union nve langevin
"""
REPLICATE = """
thermo_style    one
unfix           s
uncompute       b2
uncompute       site
uncompute       density
unfix           h
replicate       1 2 1
region          lower block INF INF INF 3 INF INF
group           lower region lower
group           three type 3
group           bound clear
group           bound intersect three lower
group           nve clear
group           nve molecule 1
group           walls clear
group           walls union nve langevin
""" + "\n".join(FIXES.splitlines()[k] for k in (-3, -1)) + "".join(
    "\n" + line for line in COMPUTES.splitlines() if "compute         site" in line or "density" in line or "b2" in line) + THERMO
COMMANDS = {
    "nothing": "",
    "replicate": REPLICATE,
    "delete_atoms": "delete_atoms group langevin bond no",
    "delete_atoms of solvent": "region corner block 1.5 INF 1.5 INF 1.5 INF\ndelete_atoms region corner",
    "create_membrane": FOURTH,
    "delete_atoms, create_membrane": "delete_atoms group nve bond no\n"
                                     "create_membrane 1 sphere 1 1.0 center -3 0 0 molecule 1 mass 10\ngroup nve molecule 1\n"
                                     "group points type 1\ngroup walls union nve langevin",
    "create_atoms": "create_atoms 2 single 0 2.5 2.5\ncreate_atoms 2 single 1 -2.5 2.5\ngroup solvent type 2",
    "create_bound": "create_bound 5 3 nve 12 height 0.05 mass 2.0\ngroup bound type 3",
    "delete_atoms of bound atoms": "variable odd atom id%2==1\ngroup odd variable odd\n"
                                   "group gone intersect odd bound\ndelete_atoms group gone compress no",
    "write_bound": "write_bound h w.sites",
    "reset_atoms id": "reset_atoms id",
    "reset_atoms id sort": "reset_atoms id sort yes",
    "reset_timestep": "reset_timestep 0",
    "reset_timestep ahead": "reset_timestep 100000",
    "change_box": "change_box all x scale 1.002 y scale 1.003 z scale 1.004 remap",
    "balance": "balance 1.0 shift x 5 1.01",
    "balance rcb": "comm_style tiled\nbalance 1.0 rcb",
    "set": "set type 1 mass 30.0\nset group langevin vx 0.1",
    "displace_atoms": "displace_atoms all move 1.0 0.5 0.2 units box",
    "velocity": "velocity points create 2.0 99",
    "hd_velocity": "hd_velocity langevin 2.0 99",
    "group": "group solvent clear\ngroup solvent type 2\ngroup walls clear\ngroup walls molecule 1",
    "unfix, fix": REFIX,
    "uncompute, compute": UNCOMPUTE,
    "undump, dump": "undump d\n" + DUMP,
    "neigh_modify": "neigh_modify every 2 delay 0 check no\nneighbor 0.5 bin",
    "comm_modify": "comm_modify cutoff 4.5 vel yes",
    "timestep": "timestep 0.001",
    "pair_coeff": COEFF.replace("30 init", "30 12.0").replace("regularize 1.0", "regularize 2.0"),
    "minimize": "minimize 0 0 3 100",
    "minimize in another style": "min_style cg\nminimize 0 0 3 100\nmin_style membrane",
    "hd_timestep": "hd_timestep walls",
    "hd_modes": "hd_modes nve lowest 3 file m.txt mass lumped",
    "write_membrane": "write_membrane w.vtp",
    "membrane_build": "membrane_build patch m.pdb membrane 1 scale 32 format top overwrite yes out m",
    "write_data": "write_data w.data",
    "read_dump": "write_dump all custom r.dump id type x y z ix iy iz modify format float %.17g\ndisplace_atoms points random 0.1 0.1 0.1 77\n"
                 "read_dump r.dump $(step) x y z ix iy iz",
    "rerun": "dump r all custom 1 r.dump id type x y z ix iy iz\ndump_modify r format float %.17g\nrun 1\nundump r\n"
             "rerun r.dump dump x y z ix iy iz",
    "run of no steps": "run 0",
}

if "without gemmi" in lammps("units real\natom_style membrane_cp\nregion box block 0 1 0 1 0 1\ncreate_box 1 box\n"
                             "membrane_build patch m.pdb out m\n")[1]:
    print("note   the package was compiled without gemmi: no membrane_build")
    del COMMANDS["membrane_build"]

# not in restart files: said again in the script that starts there
SETTINGS = {"neigh_modify", "comm_modify", "timestep"}
# a dump keeps the view of the box that it was made for
OTHER_VIEW = {"replicate", "change_box"}


def start(image, slip, atoms=ATOMS + COEFF):
    return atoms + (FIXES + COMPUTES + OUTPUT).format(image=image, slip=slip)


def difference(rows, others):
    """The largest, relative to the size of the quantity, and what differs."""
    if len(rows) != len(others) or not rows:
        return float("inf"), f"{len(rows)} and {len(others)} rows"
    return max((abs(row[key] - other[key]) / max(1.0, abs(row[key])), key)
               for row, other in zip(rows, others) for key in row)


def last_picture(image):
    steps = [int(file.split(".")[1]) for file in os.listdir(".") if file.startswith(image + ".") and file.endswith(".ppm")]
    with open(f"{image}.{max(steps)}.ppm", "rb") as file:
        return max(steps), file.read()


def error_line(output):
    return next((line for line in output.splitlines() if line.startswith("ERROR")), output[-200:])


for ranks in RANKS:
    slip = ("slip", "noslip")[ranks - 1]
    for name, command in COMMANDS.items():
        for file in os.listdir("."):
            if file.endswith(".ppm"):
                os.remove(file)
        here, before, there = (command.format(image=image, slip=slip) + "\n" for image in "acb")
        code, output = lammps(
            start("a", slip) + RUN + here + "print '=== on'\n" + RUN + "print '=== restart'\nclear\n" +
            start("c", slip) + RUN + before + REGROUP + "write_restart m.restart\nprint '=== anew'\nclear\n" +
            start("b", slip, "read_restart m.restart\n") + (there if name in SETTINGS else "") + RUN, ranks=ranks)
        if not claim(f"{name} on {ranks}: all styles go on", code == 0, error_line(output) if code else ""):
            continue
        _, on, _, anew = map(thermo, output.split("\n=== "))
        error, what = difference(on, anew)
        claim("   ... as they do from a restart", error < 1e-11, f"{error:.1e} {what}")
        if name not in OTHER_VIEW:
            claim("   ... and look alike", last_picture("a") == last_picture("b"))

    grid = f"processors {'1 2 1' if ranks == 2 else '1 1 1'}\n"
    code, output = lammps(start("a", slip) + RUN + "write_restart m.restart\nprint '=== on'\n" + RUN +
                          "print '=== anew'\nclear\n" + grid + start("b", slip, "read_restart m.restart\n") + RUN, ranks=ranks)
    if claim(f"clear, processors on {ranks}: all styles go on", code == 0, error_line(output) if code else ""):
        error, what = difference(*map(thermo, output.split("\n=== ")[1:]))
        claim("   ... as they did before", error < 1e-11, f"{error:.1e} {what}")

# === A restart file on another number of ranks: references and noise are those of before

for ranks in RANKS[1:]:
    for wrote, reads in ((1, ranks), (ranks, 1)):
        _, output = lammps(start("a", "slip") + RUN + "write_restart m.restart\nprint '=== on'\n" + RUN, ranks=wrote)
        code, again = lammps(start("b", "slip", "read_restart m.restart\n") + RUN, ranks=reads)
        if claim(f"restart file of {wrote}, on {reads}: all styles go on", code == 0, error_line(again) if code else ""):
            error, what = difference(thermo(output.split("\n=== ")[-1]), thermo(again))
            claim("   ... as they did before", error < 1e-11, f"{error:.1e} {what}")

finish()
