"""The virial of pair helfrich is minus the derivative of its energy as the box and all in it are strained."""

from lammps_claims import claim, finish, run, thermo
from membrane_scenes import SCENES, coefficients, largest, terms_of

COMPONENTS = {"xx": (0, 0), "yy": (1, 1), "zz": (2, 2), "xy": (0, 1), "xz": (0, 2), "yz": (1, 2)}
STRAIN = 3e-4
STEPS = (1, -1, 2, -2)

MEASURE = """
compute         eatom all pe/atom
compute         satom all stress/atom NULL pair
compute         esum all reduce sum c_eatom
compute         ssum all reduce sum c_satom[1] c_satom[2] c_satom[3] c_satom[4] c_satom[5] c_satom[6]
compute         virial all pressure NULL pair
thermo_style    custom step pe c_esum vol c_virial[*] c_ssum[*]
thermo_modify   norm no format float %24.17g
"""


def box_of(scene):
    """Columns are the box vectors; every scene's box reaches from -2 to 2."""
    words = [float(word) for word in scene.box.split()[1:]] + [0.0] * 3
    xy, xz, yz = words[6:9]
    return [[4.0, xy, xz], [0.0, 4.0, yz], [0.0, 0.0, 4.0]]


def change_box(h):
    return (f"change_box all x final -2 {h[0][0] - 2:.17g} y final -2 {h[1][1] - 2:.17g} "
            f"z final -2 {h[2][2] - 2:.17g} xy final {h[0][1]:.17g} xz final {h[0][2]:.17g} "
            f"yz final {h[1][2]:.17g} remap units box\n")


def strained_runs(scene):
    script, h = "", box_of(scene)
    for i, j in COMPONENTS.values():
        for step in STEPS:
            strained = [row[:] for row in h]
            strained[i] = [a + step * STRAIN * b for a, b in zip(h[i], h[j])]
            script += change_box(strained) + "run 0 post no\n"
    return script + change_box(h)


def slope(energies):
    e = dict(zip(STEPS, energies))
    return (8 * (e[1] - e[-1]) - (e[2] - e[-2])) / (12 * STRAIN)


def check(name, scene, terms, ranks=1, **options):
    script = scene.setup(**options) + MEASURE
    if scene.box.startswith("block"):
        script += "change_box all triclinic\n"
    for i, term in enumerate(terms):
        overlay = "hybrid" in options.get("style", "")
        script += (coefficients(term, scene.closed, "helfrich" if overlay else "") +
                   "pair_coeff * * lj/cut 0.0 0.5\n" * overlay + "run 0 post no\n" + scene.shake(i + 1) +
                   "\nrun 0 post no\n" + strained_runs(scene))
    rows = thermo(run(script, ranks=ranks))
    per_term = 2 + len(STEPS) * len(COMPONENTS)
    how = ", ".join([f"{ranks} ranks"] * (ranks > 1) + list(map(str, options.values())))
    name = f"{name} ({how})" if how else name

    virial_error, energy_sum, stress_sum = {}, {}, {}
    for i, term in enumerate(terms):
        _, here, *strained = rows[i * per_term:(i + 1) * per_term]
        virial = [here[f"c_virial[{k}]"] * here["Volume"] for k in range(1, 7)]
        scale = largest(virial)
        energies = [row["PotEng"] for row in strained]
        slopes = [slope(energies[len(STEPS) * k:]) for k in range(6)]
        virial_error[term] = largest(v + s for v, s in zip(virial, slopes)) / scale
        energy_sum[term] = abs(here["c_esum"] - here["PotEng"]) / abs(here["PotEng"])
        stress_sum[term] = largest(here[f"c_ssum[{k}]"] + virial[k - 1] for k in range(1, 7)) / scale

    def worst(what, errors, limit):
        where = max(errors, key=errors.get)
        claim(f"{name}: {what} to {limit:.0e} terms: {len(terms)}", errors[where] < limit,
              f"worst {errors[where]:.1e} ({where})")

    worst("every component of the virial is minus the slope of the energy,", virial_error, 1e-6)
    worst("per-atom energies add up to the energy,", energy_sum, 1e-12)
    worst("per-atom stresses add up to the virial,", stress_sum, 1e-12)


# === Term by term

for name in ("sphere across the corner of the box", "torus", "plane", "tilted box, plane",
             "tilted box, sphere across its corner"):
    check(name, SCENES[name], terms_of(SCENES[name]))

# === All terms together, all scenes

for name, scene in SCENES.items():
    check(name, scene, ["all terms"])
for name in ("sphere across the corner of the box", "tilted box, plane"):
    check(name, SCENES[name], ["all terms"], quadrature=3)
    check(name, SCENES[name], ["all terms"], before="newton off")
    check(name, SCENES[name], ["all terms"], before="newton off", ranks=2)
for newton in ("on", "off", "off on", "on off"):
    check("torus", SCENES["torus"], ["all terms"], before=f"newton {newton}", style="hybrid/overlay helfrich lj/cut 1.0")
    check("sphere across the corner of the box", SCENES["sphere across the corner of the box"], ["all terms"],
          before=f"newton {newton}", style="hybrid/overlay helfrich lj/cut 1.0")

finish()
