"""fix srd/mesh: a thermal, strongly deforming vesicle in 100,000 solvent atoms for 100,000 steps without
thermostat: nothing crosses, energy does not drift, momentum is kept. Runs with MEMBRANE_LONG=1 only.

The vesicle is flat at first, and four vortices pull it apart. Energy rises by an amount per collision with the surface
that goes as the square of the timestep (doc/src/fix_srd_mesh.rst), so 1e-6 of it is a matter of the timestep."""
# timeout: 7200

import math

from lammps_claims import LONG, claim, finish, run, skip, thermo

if not LONG:
    skip("takes long: set MEMBRANE_LONG=1")
STEPS = 100000

SCRIPT = f"""
units           lj
atom_style      membrane_cp
region          box block -10 10 -10 10 -10 10
create_box      2 box angle/types 1
create_membrane 1 sphere 3 6.0 scale 1 1 0.5
create_atoms    2 random 100000 8341 box
set             type 1 mass 5.0
set             type 2 mass 1.0
group           membrane type 1
group           solvent type 2
variable        ux atom sin(PI*x/10)*cos(PI*y/10)
variable        uy atom -cos(PI*x/10)*sin(PI*y/10)
velocity        solvent create 1.0 4711 loop geom mom yes
velocity        all set v_ux v_uy NULL sum yes
pair_style      helfrich
pair_coeff      1 1 10.0 0.0 area 200.0 init volume 200.0 init
fix             1 membrane hd/nve
fix             2 solvent srd/mesh 400 membrane 1.0 1.0 4711 angle 130 shift yes 9127 velocity keep
compute         T membrane hd/temp
compute         ks solvent ke
compute         s membrane membrane/shape
variable        e equal pe+ke+c_ks
variable        long equal bound(membrane,xmax)-bound(membrane,xmin)
thermo_style    custom step temp pe ke v_e c_ks c_T f_2[1] f_2[2] f_2[3] f_2[4] f_2[5] f_2[6] f_2[7] f_2[8] f_2[9] c_s[3] c_s[9] v_long
thermo_modify   norm no temp T format float %.15g
timestep        0.00025
thermo          500
run             {STEPS}
"""

rows = thermo(run(SCRIPT, timeout=7200))
start, last = rows[0], rows[-1]
claim(f"{STEPS} steps: {last['f_2[2]']:.0f} collisions, no crossing, no rescue", last["f_2[3]"] == last["f_2[4]"] == 0)
claim("the same solvent atoms are inside and outside throughout",
      len({(row["f_2[8]"], row["f_2[9]"]) for row in rows}) == 1, f"{last['f_2[8]']:.0f} and {last['f_2[9]']:.0f}")
momentum = max(abs(row[f"f_2[{k}]"] - start[f"f_2[{k}]"]) for row in rows for k in (5, 6, 7)) / math.sqrt(1e5)
claim("momentum is kept to 1e-10 of sqrt(N m kT)", momentum < 1e-10, f"{momentum:.1e}")

# drift: slope of the energy by least squares, its error from blocks

energies = [row["v_e"] for row in rows[len(rows) // 10:]]
blocks = [sum(part) / len(part) for part in (energies[len(energies) * i // 8:len(energies) * (i + 1) // 8] for i in range(8))]
drift = (sum((i - 3.5) * block for i, block in enumerate(blocks)) / 42.0) * 8 / energies[0]
spread = math.sqrt(sum((e - sum(energies) / len(energies)) ** 2 for e in energies) / len(energies)) / energies[0]
claim("the energy drifts by less than 1e-6 of itself", abs(drift) < 1e-6, f"{drift:.1e}, fluctuation {spread:.1e}")
lengths = [row["v_long"] for row in rows]
claim("the vesicle deforms: its length in x changes by more than a third", max(lengths) > 4 / 3 * min(lengths),
      f"{min(lengths):.1f} to {max(lengths):.1f}")
volumes = [row["c_s[3]"] for row in rows]
print(f"note   reduced volume {min(volumes):.3f} to {max(volumes):.3f}, smallest angle {min(row['c_s[9]'] for row in rows):.1f}, "
      f"temperatures at the end: solvent {last['f_2[1]']:.4f}, membrane {last['c_T']:.4f}")

finish()
