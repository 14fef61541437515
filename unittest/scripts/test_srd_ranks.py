"""fix srd/mesh on several ranks: the same on any number of them, wherever surface and solvent are and go."""
# cost: 15

from lammps_claims import MPIEXEC, claim, finish, run, thermo
from membrane_scenes import read_dump

# all of it drifts along x by half the box, through its boundary
SCENE = """
units           lj
newton          {newton}
atom_style      membrane_cp
processors      {processors}
region          box block 0 16 0 8 0 8
create_box      2 box angle/types 1
{create}
set             type 1 mass 5.0
group           membrane type 1
group           solvent type 2
velocity        solvent create 1.0 87287 loop geom
velocity        all set 13.0 0.0 0.0 sum yes
pair_style      helfrich
pair_coeff      1 1 20.0 0.0 area 200.0 init volume 200.0 init
fix             1 membrane hd/nve tol 1e-13
fix             2 solvent srd/mesh 5 membrane 1.0 1.0 4711 angle 130 shift yes 9127 measure no velocity keep {args}
{more}
timestep        0.005
thermo_style    custom step f_2[2] f_2[3] f_2[8]
dump            d all custom 120 r.dump id x y z vx vy vz
dump_modify     d sort id format float %.17g
thermo          20
run             120
"""
ONE = "create_membrane 1 sphere 2 2.2 center 6.0 3.0 7.5\n"
THREE = "create_membrane 1 sphere 2 2.4 center 2.0 2.0 2.0\ncreate_membrane 1 sphere 1 1.5 center 15.0 6.0 4.0\n" + \
        "create_membrane 1 sphere 1 1.2 center 2.0 2.0 2.0\n"
ALL, INSIDE = "create_solvent 2 both 8.0 4711 mass 1.0\n", "create_solvent 2 inside 30.0 4711 mass 1.0\n"


class Scene:
    def __init__(self, create, args, more="", processors="* 1 1", ranks=(4,)):
        self.values = dict(create=create, args=args, more=more)
        self.processors, self.ranks = processors, ranks

    def state(self, ranks, newton="on"):
        """Collisions, crossings, atoms inside, and the atoms at the end."""
        text = SCENE.format(newton=newton, processors=self.processors if ranks > 1 else "* * *", **self.values)
        row = thermo(run(text, ranks=ranks))[-1]
        return [row["f_2[2]"], row["f_2[3]"], row["f_2[8]"]], read_dump("r.dump")[-1]


SCENES = {
    "a vesicle": Scene(ONE + ALL, "collision slip", ranks=(2, 4)),
    "a vesicle that does not slip": Scene(ONE + ALL, "collision noslip"),
    "a finer vesicle": Scene(ONE + ALL, "level 1 collision noslip"),
    "impulses on control points": Scene(ONE + ALL, "impulse control collision slip", ranks=(2,)),
    "three vesicles, one within another": Scene(THREE + ALL, "collision noslip", processors="* * 1"),
    "solvent in vesicles alone, and none on other ranks": Scene(THREE + INSIDE, "collision slip", ranks=(2, 4)),
    "sub-domains that move": Scene(ONE + ALL, "collision noslip", "fix 3 all balance 7 1.0 shift x 10 1.05"),
}

for name, scene in SCENES.items():
    counts, atoms = scene.state(1)
    claim(f"{name}: solvent meets the surface and does not cross it", counts[0] > 100 and counts[1] == 0,
          f"{counts[0]:.0f} collisions, {counts[2]:.0f} atoms inside")
    for ranks in scene.ranks:
        newton = "off" if ranks == 2 else "on"
        others, found = scene.state(ranks, newton)
        same = len(found) == len(atoms) and others == counts
        worst = max(abs(a - b) for i in atoms for a, b in zip(atoms[i][3:], found[i][3:])) if same else None
        claim(f"    {ranks} ranks, newton {newton}, agree with 1: as many collisions, and velocities", same and worst < 1e-10,
              (others, worst))

# === Solvent that goes further than LAMMPS looks for, with neighbor lists that are never renewed otherwise

BULK = """
units           lj
newton          {newton}
atom_style      membrane_cp
processors      * 1 1
region          box block 0 16 0 8 0 8
create_box      2 box angle/types 1
create_membrane 1 sphere 1 1.0 center 6.0 3.0 4.0 mass 5.0
group           membrane type 1
create_solvent  2 both 8.0 4711 mass 1.0
group           solvent type 2
velocity        solvent create 1.0 87287 loop geom
neigh_modify    delay 100000 every 100000 check no
pair_style      zero 2.0
pair_coeff      * *
fix             1 membrane setforce 0 0 0
fix             2 solvent srd/mesh {every} NULL 1.0 1.0 4711 angle 130 shift yes 9127 velocity keep
timestep        {dt}
dump            d all custom 120 r.dump id x y z vx vy vz
dump_modify     d sort id format float %.17g
run             120
"""
for every, dt in ((5, 0.02), (20, 0.1)):
    run(BULK.format(newton="on", every=every, dt=dt), ranks=1)
    atoms = read_dump("r.dump")[-1]
    for ranks, newton in ((2, "off"), (4, "on")) if MPIEXEC else ():
        output = run(BULK.format(newton=newton, every=every, dt=dt), ranks=ranks)
        found = read_dump("r.dump")[-1]
        builds = [int(line.split("=")[1]) for line in output.split("\n") if line.startswith("Neighbor list builds")]
        same = len(found) == len(atoms)
        worst = max(abs(a - b) for i in atoms for a, b in zip(atoms[i][3:], found[i][3:])) if same else None
        claim(f"solvent crosses sub-domains between collisions, every {every} steps of {dt}, {ranks} ranks: as on one, handed "
              "on when it has strayed", same and worst < 1e-9 and 0 < builds[-1] < 120, (worst, builds))

finish()
