"""Energies and forces do not depend on how many ranks share the membranes, nor on how."""

from lammps_claims import MPIEXEC, claim, finish, run, thermo
from membrane_scenes import SCENES, coefficients, largest, read_dump

# A drift carries the membranes through sub-domains and around the periodic box. Balancing comes after
# displace_atoms, which takes its random numbers from the last bits of coordinates.
DYNAMICS = """
run             0 post no
{shake}
{after}
set             group all mass 10.0
velocity        all create 0.1 4711
velocity        all set 6.0 5.0 4.0 sum yes
fix             move all nve
timestep        0.001
compute         eatom all pe/atom
compute         satom all stress/atom NULL pair
dump            state all custom 200 state.dump id fx fy fz c_eatom c_satom[*] xu yu zu
dump_modify     state format float %24.17g sort id
thermo          200
run             200 post no
"""

LAYOUTS = {    # ranks, before the box is made, before the run
    "1 rank": (1, "", ""),
    "1 rank, newton off": (1, "newton off", ""),
    "1 rank, sorted in every step": (1, "atom_modify sort 1 0.3\nneigh_modify every 1 delay 0 check no", ""),
    "2 ranks": (2, "", ""),
    "2 ranks, sorted in every step": (2, "atom_modify sort 1 0.3\nneigh_modify every 1 delay 0 check no", ""),
    "2 ranks, newton off": (2, "newton off", ""),
    "2 ranks, newton off on": (2, "newton off on", ""),
    "2 ranks, newton on off": (2, "newton on off", ""),
    "4 ranks": (4, "", ""),
    "4 ranks, processors 4 1 1": (4, "processors 4 1 1", ""),
    "4 ranks, tiled, balance rcb": (4, "comm_style tiled", "balance 1.0 rcb"),
    "4 ranks, tiled, balance rcb, newton off": (4, "comm_style tiled\nnewton off", "balance 1.0 rcb"),
}


def state(scene, layout):
    ranks, before, after = LAYOUTS[layout]
    script = (scene.setup(before=before) + coefficients("all terms", scene.closed) +
              DYNAMICS.format(shake=scene.shake(3), after=after))
    rows = thermo(run(script, ranks=ranks))[-2:]
    return rows, read_dump("state.dump")


def relative(a, b):
    """Largest difference of two lists relative to the largest element."""
    return largest(x - y for x, y in zip(a, b)) / largest(b)


def column(frame, first, last):
    return [value for row in frame.values() for value in row[first:last]]


def compare(name, scene, layouts):
    reference_rows, reference_frames = state(scene, layouts[0])
    moved = largest(a - b for a, b in zip(column(reference_frames[1], 10, 13),
                                          column(reference_frames[0], 10, 13)))
    claim(f"{name}: the membranes travel far enough to change ranks", moved > 0.5, f"{moved:.2f}")
    for layout in layouts[1:]:
        rows, frames = state(scene, layout)
        for when, energy_limit, force_limit, row, frame, reference_row, reference in (
                ("at the start", 1e-12, 1e-10, rows[0], frames[0], reference_rows[0], reference_frames[0]),
                ("after 200 steps", 1e-10, 1e-8, rows[1], frames[1], reference_rows[1], reference_frames[1])):
            energy = max(abs(row[k] - reference_row[k]) / (1.0 + abs(reference_row[k]))
                         for k in row if k == "PotEng" or k.startswith("c_hf"))
            virial = relative([row[k] for k in ("Pxx", "Pyy", "Pzz", "Pxy", "Pxz", "Pyz")],
                              [reference_row[k] for k in ("Pxx", "Pyy", "Pzz", "Pxy", "Pxz", "Pyz")])
            force = relative(column(frame, 0, 3), column(reference, 0, 3))
            peratom = max(relative(column(frame, 3, 4), column(reference, 3, 4)),
                          relative(column(frame, 4, 10), column(reference, 4, 10)))
            claim(f"{name}, {layout} against {layouts[0]}, {when}: energies and virial agree to "
                  f"{energy_limit:.0e}, forces, per-atom energies and stresses to {force_limit:.0e}",
                  max(energy, virial) < energy_limit and max(force, peratom) < force_limit,
                  f"{energy:.1e} {virial:.1e} {force:.1e} {peratom:.1e}")


if not MPIEXEC:    # one process cannot be cut
    LAYOUTS = {name: layout for name, layout in LAYOUTS.items() if layout[0] == 1}
every_layout = list(LAYOUTS)
compare("three membranes, one sharing a type", SCENES["three membranes, one sharing a type"], every_layout)
compare("tilted box, plane", SCENES["tilted box, plane"], every_layout)
for name in ("sphere across the corner of the box", "cylinder", "valence 12",
             "tilted box, sphere across its corner"):
    compare(name, SCENES[name], [layout for layout in ("1 rank", "1 rank, sorted in every step", "2 ranks", "4 ranks, tiled, balance rcb")
                                        if layout in LAYOUTS])

finish()
