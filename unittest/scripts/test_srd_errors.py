"""fix srd/mesh and create_solvent: wrong input gets one line that names the thing and the cure; what can be
handled is."""

import math

from lammps_claims import claim, error_of, finish, run, thermo

BOX = """
units           lj
atom_style      membrane_cp
boundary        {boundary}
region          box block -4 4 -4 4 -4 4
create_box      3 box angle/types 1
"""
VESICLE = "create_membrane 1 sphere 2 2.5\nset type 1 mass 5.0\n"
SHEET = "create_membrane 1 plane 8 8\nset type 1 mass 5.0\n"
SOLVENT = "create_atoms 2 random 2000 8341 box\nset type 2 mass 1.0\n"
GROUPS = "group membrane type 1\ngroup solvent type 2\n"
PAIR = "pair_style helfrich\npair_coeff 1 1 20.0 0.0\n"
NVE = "fix 1 membrane hd/nve\n"
REST = "thermo_style custom step temp f_2[*]\ntimestep 0.01\n"
LINE = "fix 2 solvent srd/mesh 10 membrane 1.0 1.0 4711 angle 130 shift yes 9127\n"


def scene(fix=LINE, membrane=VESICLE, solvent=SOLVENT, integrator=NVE, more="", boundary="p p p", rest=REST):
    return (BOX.format(boundary=boundary) + membrane + solvent + GROUPS + PAIR + integrator + fix + more + rest +
            "run 20\n")


def with_args(args, word=""):
    return scene(fix=LINE.rstrip() + f" {args}\n")


for name, script, words in (
        ("no solvent", scene(solvent=""), ["no solvent in group solvent", "create_solvent"]),
        ("a group of membranes that is not there", scene(fix=LINE.replace(" membrane ", " vesicle ")),
         ["no group vesicle", "NULL"]),
        ("solvent that is membrane, too", scene(fix=LINE.replace("solvent", "all")),
         ["also moved by fix 2", "use groups without common atoms"]),
        ("N of zero", scene(fix=LINE.replace("mesh 10", "mesh 0")), ["N 0 must be positive"]),
        ("a negative temperature", scene(fix=LINE.replace("1.0 1.0", "-1.0 1.0")), ["temperature -1.0 must be positive"]),
        ("a cell of no size", scene(fix=LINE.replace("1.0 1.0", "1.0 0.0")), ["0.0 must be positive"]),
        ("an angle beyond 180", scene(fix=LINE.replace("130", "190")), ["angle 190", "between 0 and 180"]),
        ("an unknown method", with_args("method dpd"), ["method dpd is not"]),
        ("an unknown collision", with_args("collision rough"), ["collision rough is not"]),
        ("an unknown keyword", with_args("viscosity 3"), ["Unknown fix srd/mesh keyword viscosity; known are"]),
        ("a keyword without value", with_args("collision"), ["collision"]),
        ("two thermostats", with_args("method at+a tstat yes"), ["is a thermostat"]),
        ("a grid of fixed place with a short free path",
         scene(fix=LINE.replace(" shift yes 9127", "").replace("mesh 10", "mesh 1")), ["mean free path", "use shift yes"]),
        ("solvent with another integrator", scene(more="fix 3 solvent nve\n"), ["moves its solvent itself"]),
        ("two fixes around one membrane", scene(
            solvent=SOLVENT + "create_atoms 3 random 500 77 box\nset type 3 mass 1.0\n",
            more="group second type 3\n" + LINE.replace("fix 2 solvent", "fix 4 second")),
         ["one fix must have all solvent"]),
        ("a level that is too fine", with_args("level 9"), ["level 9 is not between 0 and 4"]),
        ("a finer surface with impulses on control points", with_args("level 1 impulse control"), ["leave out level"]),
        ("a membrane without momenta", scene(integrator="fix 1 membrane hd/brownian 1.0 4711 gamma_t 1.0\n"),
         ["knows no momenta", "hd/nve"]),
        ("a mass matrix without point masses", scene(integrator="fix 1 membrane hd/nve mass lumped\n"),
         ["use mass vertex"]),
        ("r-RESPA", scene(rest=REST + "run_style respa 2 2 bond 1 pair 2\n"), ["run_style respa"]),
        ("a wall where the box is periodic", with_args("wall/velocity zhi 1 0 0"), ["the box is periodic there"]),
        ("a wall that moves off", scene(membrane="", integrator="", boundary="p p f",
                                        fix="fix 2 solvent srd/mesh 10 NULL 1.0 1.0 4711 wall/velocity zhi 0 0 1\n"),
         ["move along itself only"]),
        ("inside of a membrane that is open", scene(membrane=SHEET, solvent="create_solvent 2 inside 5.0 8341\n"),
         ["no closed membrane"]),
        ("solvent that flies off", scene(rest="variable f equal exp(800*step/5)\nfix 3 solvent addforce v_f 0 0\n" + REST),
         ["solvent atom", "flies off", "use a shorter timestep"]),
        ("solvent of negative density", scene(solvent="create_solvent 2 inside -5.0 8341\n"),
         ["density -5.0 must be positive"]),
        ("a side that is none", scene(solvent="create_solvent 2 above 5.0 8341\n"), ["above is not inside, outside or both"])):
    if name == "inside of a membrane that is open":
        script = script.replace("-4 4 -4 4 -4 4", f"-4 4 {-2 * math.sqrt(3)!r} {2 * math.sqrt(3)!r} -4 4")
    error = error_of(script)
    claim(f"{name}: an error of one line", all(word in error for word in words), error)

# === What can be handled is: solvent on the surface itself, cells larger than a sub-domain

on_surface = SOLVENT + "".join(f"create_atoms 2 single {x:.6f} {y:.6f} {z:.6f}\n" for x, y, z in (
    (2.5 * math.sin(0.1 * i) * math.cos(2.4 * i), 2.5 * math.sin(0.1 * i) * math.sin(2.4 * i), 2.5 * math.cos(0.1 * i))
    for i in range(30))) + "set type 2 mass 1.0\n"
for ranks in (1, 4):
    rows = thermo(run(scene(solvent=on_surface), ranks=ranks))
    claim(f"solvent on the surface at the start is put on a side and stays there, {ranks} rank(s)",
          rows[0]["f_2[8]"] + rows[0]["f_2[9]"] == 2030 and rows[-1]["f_2[8]"] == rows[0]["f_2[8]"] and
          rows[-1]["f_2[3]"] == rows[0]["f_2[3]"], f'{rows[-1]["f_2[8]"]:.0f} inside, {rows[-1]["f_2[9]"]:.0f} outside')
large = LINE.replace("1.0 1.0", "1.0 4.0")
one, four = (thermo(run(scene(fix=large, solvent="create_solvent 2 both 4.0 8341\n"), ranks=ranks))[-1] for ranks in (1, 4))
apart = max(abs(one[key] - four[key]) for key in ("Temp", "f_2[1]", "f_2[5]", "f_2[6]", "f_2[7]"))
claim("cells as large as a sub-domain: four ranks do what one does", apart < 1e-9, f"{apart:.1e}")

finish()
