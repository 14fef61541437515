"""fix srd/mesh: viscosity against kinetic theory, Galilean invariance.

A helical wave v = A (sin kz, cos kz, 0), which heats the fluid evenly, decays as exp(-nu k^2 t). Its two
amplitudes u follow u(t + s) = r u(t) + noise, so r is the regression over many decays from fresh
thermal states; its error is the jackknife over the decays. Runs with MEMBRANE_LONG=1 only."""
# timeout: 7200

import math

from lammps_claims import LONG, claim, finish, run, skip

if not LONG:
    skip("takes long: set MEMBRANE_LONG=1")
MORE = 12

SCRIPT = """
units           lj
atom_style      membrane_cp
region          box block 0 8 0 8 0 {L}
create_box      1 box angle/types 1
create_solvent  1 both {M} 8341
group           solvent type 1
fix             srd solvent srd/mesh 1 NULL 1.0 1.0 4711 {args}
variable        phase atom 2*PI*(z-{drift}*step*dt)/{L}
variable        s atom sin(v_phase)
variable        c atom cos(v_phase)
variable        us atom 2*(vx-{U})*v_s
variable        uc atom 2*(vy-{U})*v_c
variable        vs atom vx+0.5*v_s
variable        vc atom vy+0.5*v_c
compute         u all reduce ave v_us v_uc
thermo_style    custom step c_u[*] f_srd[1] f_srd[10]
thermo_modify   norm no format float %.12g
thermo          0
timestep        {dt}
run             0
label           again
variable        i loop {decays}
velocity        solvent create 1.0 $(4711+v_i) dist gaussian mom yes
velocity        solvent set v_vs v_vc NULL sum no
velocity        solvent set {U} {U} {drift} sum yes
run             10 post no
""" + 4 * "run {every} pre no post no\n" + """
next            i
jump            SELF again
"""


def viscosity(M, dt, L, decays, args, formula, boost=(0.0, 0.0)):
    """Viscosity, its error, temperature, and the fix's formula."""
    rate = formula / M * (2 * math.pi / L) ** 2
    every = max(1, round(0.5 / (rate * dt)))
    output = run(SCRIPT.format(M=M, dt=dt, L=L, decays=decays, args=args, every=every, U=boost[0], drift=boost[1]),
                 timeout=1800)
    groups, table = [], []
    for line in output.splitlines():
        words = line.split()
        if words[:1] == ["Step"]:
            table = []
        elif words[:2] == ["Loop", "time"]:
            steps = table[-1][0] - table[0][0]
            if steps == 10:
                groups.append([])
            elif steps == every:
                groups[-1].append(table)
        elif len(words) == 5 and words[0].isdigit() and words[1][-1].isdigit():
            table.append([float(word) for word in words])
    products = [sum(pair[0][k] * pair[1][k] for pair in group for k in (1, 2)) for group in groups]
    squares = [sum(pair[0][k] ** 2 for pair in group for k in (1, 2)) for group in groups]
    r = sum(products) / sum(squares)
    left_out = [(sum(products) - p) / (sum(squares) - s) for p, s in zip(products, squares)]
    n = len(groups)
    error = math.sqrt((n - 1) / n * sum((x - r) ** 2 for x in left_out))
    scale = M / (every * dt * (2 * math.pi / L) ** 2)
    weights = [(pair[0][1] ** 2 + pair[0][2] ** 2, pair) for group in groups for pair in group]
    temperature = sum(w * (pair[0][3] + pair[1][3]) / 2 for w, pair in weights) / sum(w for w, pair in weights)
    return -math.log(r) * scale, error / r * scale, temperature, groups[0][0][0][4]


def theory(M, degrees, kT, dt):
    """Mass and cell are units."""
    a, f = math.radians(degrees), M - 1 + math.exp(-M)
    kinetic = kT * dt / 2 * (5 * M / (f * (2 - math.cos(a) - math.cos(2 * a))) - 1)
    return M * (kinetic + f / M * (1 - math.cos(a)) / (18 * dt))


# === Viscosity: the wave heats the solvent by 4 %, so theory is that of the temperature measured

SETS = ((10, 130, 0.1, 24, 40, 8.700), (5, 130, 0.1, 24, 60, 3.961), (10, 90, 0.1, 24, 40, 5.426),
        (10, 90, 1.0, 64, 15, 4.759))
for M, degrees, dt, L, decays, formula in SETS:
    eta, error, temperature, reported = viscosity(M, dt, L, decays * MORE, f"angle {degrees} shift yes 9127", formula)
    name = f"{M} atoms a cell, {degrees} degrees, mean free path {dt}"
    claim(f"{name}: the fix reports the viscosity of kinetic theory", abs(reported - formula) < 5e-4, reported)
    ratio = eta / theory(M, degrees, temperature, dt)
    error /= eta
    claim(f"{name}: the viscosity is that within 2 %", abs(ratio - 1) < 0.02 and error < 0.01,
          f"{eta:.3f}, {100 * (ratio - 1):+.2f} +- {100 * error:.2f} %, T {temperature:.3f}")

eta, error, temperature, reported = viscosity(10, 0.1, 24, 15 * MORE, "method at+a shift yes 9127", 4.226)
claim("at+a: the viscosity is that of its formula within 6 %", abs(eta / reported - 1) < 0.06,
      f"{eta:.3f} +- {error:.3f}, formula {reported:.3f}")

# === Galilean invariance: 0.5 cells a step sideways, and along the wave

for shift in ("yes 9127", "no"):
    results = [viscosity(10, 0.1, 16, 20 * MORE, f"angle 130 shift {shift}", 8.7, boost)
               for boost in ((0.0, 0.0), (5.0, 5.0))]
    ratio = results[1][0] / results[0][0]
    error = ratio * math.hypot(*(r[1] / r[0] for r in results))
    measured = f"{results[0][0]:.3f} at rest, {results[1][0]:.3f} moving, ratio {ratio:.3f} +- {error:.3f}"
    if shift == "no":
        claim("without shift a moving fluid has another viscosity (more than 10 %)", abs(ratio - 1) > 0.1 + 3 * error,
              measured)
    else:
        claim("with shift a moving fluid has the same viscosity within three errors", abs(ratio - 1) < 3 * error < 0.06,
              measured)

finish()
