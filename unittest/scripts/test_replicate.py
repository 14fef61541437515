"""replicate between runs, when LAMMPS replaces the atom style and the mesh: membranes move on as they did alone."""

from lammps_claims import claim, finish, run, thermo

SCENE = """
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
create_box      1 box angle/types 1
create_membrane 1 sphere 2 1.6
set             type 1 mass 1.0
displace_atoms  all random 0.03 0.03 0.03 4711
pair_style      helfrich
pair_coeff      1 1 10.0 0.0 area 100 32.0 volume 100 17.0 regularize 5
velocity        all create 0.2 99
timestep        0.0005
"""
OUTPUT = """
compute         T all hd/temp {mass}
variable        x equal x[17]
variable        vy equal vy[101]
thermo_style    custom step pe c_T[1] c_T[2] c_T[3] v_x v_vy
thermo_modify   norm no format float %.17g
thermo          30
"""
FIXES = {
    "hd/nve solver iterative": "",
    "hd/nve solver direct": "",
    "hd/nve mass consistent": "mass consistent",
    "hd/nve mass lumped": "mass lumped",
    "hd/langevin 0.5 0.5 0.3 4711": "",
    "hd/langevin 0.5 0.5 0.3 4711 scale 1 2.0 tally yes": "",
    "hd/brownian 0.5 4711 gamma_t 20": "",
}


def extensive(row):
    return [row["PotEng"], row["c_T[1]"], row["c_T[2]"], row["c_T[3]"]]


def difference(row, reference, times):
    return max(abs(a - times * b) / (1.0 + abs(times * b))
               for a, b in zip(extensive(row), extensive(reference)))


# === Energy and motion before and after. Atom IDs of the first copy are those of the original, and so is noise

for fix, mass in FIXES.items():
    start = SCENE + f"fix 1 all {fix}\n" + OUTPUT.format(mass=mass) + "run 30\n"
    _, alone, *_, alone_later = thermo(run(start + "run 30\n"))
    for ranks in (1, 2, 4) if fix in ("hd/nve solver iterative", "hd/brownian 0.5 4711 gamma_t 20") else (1, 2):
        _, one, many, later = thermo(run(start + "replicate 2 1 1\nrun 30\n", ranks=ranks))
        error = max(difference(one, alone, 1), difference(many, one, 2))
        claim(f"fix {fix}, {ranks} rank(s): two membranes have twice the energies of one right after replicate",
              error < 1e-11, f"{error:.1e}")
        error = max(abs(later[k] - alone_later[k]) for k in ("v_x", "v_vy"))
        claim("  and the first moves on as it does alone", error < 1e-8 and abs(later["v_x"] - one["v_x"]) > 1e-5,
              f"{error:.1e}")
        if "nve" in fix:
            error = difference(later, alone_later, 2)
            claim("  and so does the second", error < 1e-10, f"{error:.1e}")

# === Styles from before replicate are the same as styles from after, without any run in between

for fix in ("hd/nve", "hd/langevin 0.5 0.5 0.3 4711", "hd/brownian 0.5 4711 gamma_t 20"):
    styles, repeat = f"fix 1 all {fix}\n" + OUTPUT.format(mass=""), "replicate 2 2 1\n"
    before = run(SCENE + styles + repeat + "run 30\n")
    after = run(SCENE + repeat + styles + "run 30\n")
    claim(f"fix {fix} from before replicate does what one from after does",
          len(thermo(before)) == 2 and thermo(before) == thermo(after))
rows = thermo(run(SCENE + OUTPUT.format(mass="") + "run 0\nreplicate 2 1 1\nrun 0\n"))
claim("compute hd/temp without an integrator counts all membranes", difference(rows[1], rows[0], 2) < 1e-12)

# === A group of one of two membranes

TWO = SCENE.replace("-3 3 -3 3 -3 3", "-3 3 -3 3 -3 9").replace(
    "set             type", "create_membrane 1 sphere 2 1.6 center 0 0 6\nset             type")
rows = thermo(run(TWO + "group lower molecule 1\nfix 1 lower hd/nve\n" + OUTPUT.format(mass="") +
                  "variable n equal count(lower)\n"
                  "thermo_style custom step pe c_T[1] c_T[2] c_T[3] v_n v_x\n"
                  "thermo_modify norm no format float %.17g\nrun 30\nreplicate 1 2 1\nrun 30\n",
                  ranks=2))
claim("copies of a membrane are of its group and move with it",
      rows[-1]["v_n"] == 2 * rows[0]["v_n"] and rows[-1]["v_x"] != rows[1]["v_x"] and
      difference(rows[2], rows[1], 2) < 1e-12)

# === Commands


def limit(output):
    return float(next(line for line in output.splitlines() if "stability limit" in line).split()[-1])


START = SCENE + "fix 1 all hd/nve\n" + OUTPUT.format(mass="") + "run 30\n"
single, double = (limit(run(START + line + "hd_timestep all\n")) for line in ("", "replicate 2 1 1\nrun 0\n"))
claim("hd_timestep after replicate finds the same limit", abs(single / double - 1.0) < 1e-3, f"{single} {double}")
row = thermo(run(START + "replicate 2 1 1\nhd_velocity all 0.3 1234 scale yes\nrun 0\n"))[-1]
points = 2 * 162
kinetic = sum(row[f"c_T[{k}]"] for k in (1, 2, 3))
claim("hd_velocity right after replicate gives all membranes the temperature",
      abs(kinetic / ((3 * points - 3) * 0.3) - 1.0) < 1e-12, kinetic)

finish()
