"""Area difference elasticity: closed forms of sphere and cylinder, several membranes, what it costs."""

import math

from lammps_claims import claim, finish, run, thermo

KD, DA0, D = 7.0, 0.9, 0.05
SCENE = """
units           lj
atom_style      membrane_cp
region          box block -2 2 -2 2 -2 2
create_box      2 box angle/types 1
{membranes}
pair_style      helfrich
{coefficients}
compute         hf all pair helfrich
thermo_style    custom step pe c_hf[1] c_hf[3] c_hf[8] c_hf[9]
thermo_modify   norm no line one format float %.15g
run 0
"""
TERM = f"area/difference {KD} {DA0} thickness {D}"


def energies(membranes, coefficients=f"pair_coeff * * 0.0 0.0 {TERM}", **options):
    return thermo(run(SCENE.format(membranes=membranes, coefficients=coefficients), **options))[-1]


def exact(difference, area):
    return 0.5 * KD * (difference - DA0) ** 2 / (area * D**2)


# The control points of these shapes lie a little beyond the surface: with an edge h the limit surface of a
# sphere has a smaller radius by O(h^2), so errors fall by four with each refinement. The exact integrals on the
# surface itself are tested on the ground floor.
R, L = 1.1, 4.0
for name, membrane, form in (
    ("sphere, 8 pi R D", "create_membrane 1 sphere {} 1.1", exact(8 * math.pi * R * D, 4 * math.pi * R**2)),
    ("cylinder, 2 pi L D", "create_membrane 1 cylinder {} {} 1.1 z", exact(2 * math.pi * L * D, 2 * math.pi * R * L))):
    errors = []
    for level in (2, 3, 4):
        n = 8 * 2 ** (level - 1)
        numbers = (level,) if "sphere" in name else (n, n)
        row = energies(membrane.format(*numbers))
        errors.append(abs(row["c_hf[9]"] / form - 1))
        if abs(row["c_hf[9]"] / row["PotEng"] - 1) > 1e-14:
            claim(f"{name}: it is all of the energy", False, row["PotEng"])
    claim(f"{name}: the energy converges to its closed form", errors[2] < 1e-2 and
          errors[0] > 3 * errors[1] > 9 * errors[2], " ".join(f"{e:.1e}" for e in errors))

# === Each membrane has its own

ONE, TWO = "create_membrane 1 sphere 2 0.7 center -0.9 0 0", "create_membrane 2 sphere 2 0.8 center 0.9 0 0"
alone = [energies(ONE)["c_hf[9]"], energies(TWO)["c_hf[9]"]]
for ranks in (1, 2):
    both = energies(f"{ONE}\n{TWO}", ranks=ranks)["c_hf[9]"]
    claim(f"two membranes have the sum of their energies, {ranks} ranks", abs(both / sum(alone) - 1) < 1e-13, both)
other = "set mol 2 type 2"
row = energies(f"{ONE}\n{TWO}\n{other}", f"pair_coeff 1 1 2.0 0.0 {TERM}\npair_coeff 2 2 2.0 0.0")
claim("a membrane of a type without the term has none", abs(row["c_hf[9]"] / alone[0] - 1) < 1e-13, row["c_hf[9]"])

# === init

row = energies(ONE, f"pair_coeff * * 1.0 0.0 area/difference {KD} init thickness {D}")
claim("init compares with the shape at the start", row["c_hf[9]"] == 0.0, row["c_hf[9]"])

# === Cost

plain = energies(ONE, "pair_coeff * * 1.0 0.0")
claim("a scene without it evaluates no first pass for it",
      energies(ONE, f"pair_coeff * * 1.0 0.0 area/difference 0.0 {DA0} thickness {D}")["c_hf[8]"] == plain["c_hf[8]"])

finish()
