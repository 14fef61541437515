"""fix srd/mesh: a membrane that hd/nve moves, without a noise of its own, takes the temperature of the solvent
around it, and has the undulations of theory: in equilibrium they do not depend on what surrounds it.

A sheet of 8 x 8 points, kc = 200 kT, in a periodic box of solvent with the only thermostat. Theory for the sheet is
that of the discrete system without solvent, as in test_spectrum_plane.py, and without tension: fix srd/mesh takes
out the measure of the mesh (doc/src/Derivation_measure.rst), which would stretch the sheet in its frame. A wave moves
the solvent within 1/q on its two sides,

    w^2 = kc q^4/(rho_s + 2 rho/q),

and forgets in some 2 (rho_s + 2 rho/q)/(4 eta q), 4 time units for the longest wave: the run has hundreds of
these, with MEMBRANE_LONG=1 thousands. Without slip the points of the membrane take part in collisions of cells, and
so in the thermostat. With slip they only meet solvent that bounces off along the normal: then the temperature of
motion across the sheet is compared, since motion along it has nothing but bending to exchange energy with, and
takes far longer than this run to reach equilibrium.

The membrane meets solvent in the middle of steps, where its velocities have the temperature of the solvent and from
where positions have their exact distribution at the ends; there, where temperature is measured, velocities are
smaller by (w dt)^2/4 of their energy. On average over all waves of the sheet in vacuum that is 0.32 % across it and
0.24 % along it at this timestep, a tenth of its limit; with velocities on time it would be 0 here and as much too hot in
the middle. The temperature that is measured is compared with what that leaves. Energy is forgotten within 5 time units, a
block has 50, so errors from blocks are right; trajectories depend on the machine, so a claim holds for 99.9 % of them.

    MEMBRANE_LONG=1    eight times as long, and collision slip, too, three times that
"""
# cost: 80
# timeout: 7200

import math

from lammps_claims import LONG, claim, finish, run
from lattice_waves import EDGES, dot, inertia, stiffness, surface
from mode_statistics import averages, compare, mean_and_error

BLOCKS, EVERY, STEPS = 32, 25, (100000 if LONG else 12500)    # of a block
N, NMAX, HEIGHT, KC, M, VERTEX_MASS, DT = 8, 2, 6, 200.0, 5, 10.0, 0.004
WIDTH, DEPTH = N, N * EDGES[1][1]
AREA = WIDTH * DEPTH
DEVIATIONS = 3.6    # 99.9 % of Student's distribution with 31 degrees of freedom
WAVES = [(0, ny) for ny in range(1, NMAX + 1)] + [(nx, ny) for nx in range(1, NMAX + 1) for ny in range(-NMAX, NMAX + 1)]

# The edge of cells is 1 but 0.99 along y, so the sheet can be regular. Of the membrane's degrees of freedom,
# the momentum of all takes the part 3 m/(total mass)
POINTS = N * N
TOTAL = POINTS * VERTEX_MASS + round(M * AREA * HEIGHT)
SCRIPT = f"""
units           lj
atom_style      membrane_cp
region          box block 0 {WIDTH} 0 {DEPTH!r} 0 {HEIGHT}
create_box      2 box angle/types 1
create_membrane 1 plane {N} {N} mass {VERTEX_MASS}
create_solvent  2 both {M} 8341
group           membrane type 1
group           solvent type 2
special_bonds   lj/coul 1 1 1
pair_style      helfrich
pair_coeff      1 1 {KC} 0.0 regularize {0.5 * KC}
fix             1 membrane hd/nve
fix             srd solvent srd/mesh 25 membrane 1.0 1.0 4711 angle 130 shift yes 9127 tstat yes cubic error 0.02 &
                collision {{collision}}
compute         m membrane hd/modes plane {NMAX}
compute         T membrane hd/temp
compute_modify  T extra/dof {3 * POINTS * VERTEX_MASS / TOTAL!r}
variable        across equal c_T[3]/{POINTS - POINTS * VERTEX_MASS / TOTAL!r}
thermo_style    custom step c_T f_srd[1] f_srd[3]
thermo_modify   norm no
timestep        {DT}
thermo          {STEPS}
run             {2 * STEPS}
reset_timestep  0
fix             a all ave/time {EVERY} {STEPS // EVERY} {STEPS} c_m[6] mode vector file power.txt
fix             t all ave/time {EVERY} {STEPS // EVERY} {STEPS} c_T v_across f_srd[1] f_srd[3] file temperature.txt
run             {{steps}}
"""


def expected(wave):
    q = (2 * math.pi * wave[0] / WIDTH, 2 * math.pi * wave[1] / DEPTH)
    size = math.hypot(*q)
    return surface(q) ** 2 / (AREA * KC * stiffness(q, 6))


def middle_of_step(across):
    """Mean of (w dt)^2/4 over the waves of the sheet in vacuum, those across it or all. Along it a face has the energy
    KR/2 |grad u|^2 for *regularize KR*, on the lattice KR 8/3 sum (1 - cos q.e)."""
    waves = [(2 * math.pi * nx / WIDTH, 2 * math.pi * ny / DEPTH) for nx in range(N) for ny in range(N)]
    bending = [EDGES[1][1] * KC * stiffness(q, 6) for q in waves]    # of a control point, EDGES[1][1] its area
    sliding = [0.5 * KC * 8 / 3 * sum(1 - math.cos(dot(q, e)) for e in EDGES) for q in waves]
    total = [b if across else (b + 2 * s) / 3 for b, s in zip(bending, sliding)]
    masses = [VERTEX_MASS * inertia(q, "vertex") for q in waves]
    return sum(k / m for k, m in zip(total, masses)) / len(waves) * DT * DT / 4


# with slip waves relax slowly and one component of three counts: it takes three times as long for errors of 0.15 %

for collision, component, blocks in (("noslip", 0, BLOCKS), ("slip", 1, 3 * BLOCKS)):
    if collision == "slip" and not LONG:
        continue
    run(SCRIPT.format(collision=collision, steps=blocks * STEPS), timeout=7200)
    rows = [[float(word) for word in line.split()[1:]] for line in open("temperature.txt") if not line.startswith("#")]
    membrane, solvent = (mean_and_error([row[k] for row in rows]) for k in (component, 2))
    difference = mean_and_error([row[component] / row[2] - 1 for row in rows])
    measured = f"membrane {membrane[0]:.4f} +- {membrane[1]:.4f}, solvent {solvent[0]:.4f} +- {solvent[1]:.4f}"
    along = "across the sheet, " if component else ""
    later = middle_of_step(across=component == 1)
    off = (difference[0] + later / (1 + later)) / difference[1]
    claim(f"{collision}: {along}membrane and solvent have the same temperature in the middle of steps",
          abs(off) < DEVIATIONS and difference[1] < 0.0025,
          f"{measured}; in the middle of steps {100 * later:.2f} % higher, and then {off:+.2f} standard errors apart")
    claim("    and no solvent has crossed", rows[-1][3] == 0.0)
    powers, groups = averages("power.txt"), {}
    for i, wave in enumerate(WAVES):
        size = math.hypot(2 * math.pi * wave[0] / WIDTH, 2 * math.pi * wave[1] / DEPTH)
        groups.setdefault(f"qh = {size:.3f}", []).append((i, expected(wave)))
    spectrum = {key: mean_and_error([sum(block[i] / power for i, power in members) / len(members) for block in powers])
                for key, members in sorted(groups.items())}
    compare(f"{collision}, sheet in solvent", spectrum, 0.005 if LONG else 0.01)

finish()
