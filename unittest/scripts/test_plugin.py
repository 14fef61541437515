"""membraneplugin.so gives a LAMMPS without the package all that a LAMMPS with it has."""

import os
import shutil

from lammps_claims import LMP_PLAIN, PLUGIN, claim, error_of, finish, run, thermo

MEMBRANE = """
units           lj
atom_style      membrane_cp
region          box block -3 3 -3 3 -3 3
create_box      1 box angle/types 1
create_membrane 1 sphere 2 1.0
set             type 1 mass 1.0
pair_style      helfrich
pair_coeff      1 1 10.0 0.0 area 100.0 init
compute         shape all membrane/shape
thermo_style    custom step pe c_shape[1] c_shape[2]
thermo_modify   format float %20.15g
run             0
write_membrane  surface.off
"""

LOAD = f"plugin load {PLUGIN}\n"


def numbers(output):
    return [list(row.values()) for row in thermo(output)]


def plain(script, **options):
    return run(script, lmp=LMP_PLAIN, **options)


built_in = numbers(run(MEMBRANE))
claim("the script prints a thermo row", len(built_in) == 1, built_in)

error = error_of(MEMBRANE, lmp=LMP_PLAIN)
claim("without plugin, LAMMPS does not know the package", "membrane_cp" in error, error)

loaded = numbers(plain(LOAD + MEMBRANE))
claim("plugin load gives the numbers of the compiled-in package", loaded == built_in, loaded)

again = numbers(plain(LOAD + MEMBRANE + "clear\n" + LOAD + MEMBRANE))
claim("it can be loaded again after clear", again == 2 * built_in, again)

os.makedirs("plugins", exist_ok=True)
shutil.copy(PLUGIN, "plugins")
auto = numbers(plain(MEMBRANE + "clear\n" + MEMBRANE, env={"LAMMPS_PLUGIN_PATH": "plugins"}))
claim("LAMMPS_PLUGIN_PATH gives them with no plugin command, also after clear",
      auto == 2 * built_in, auto)

both = run(LOAD + MEMBRANE)
claim("a LAMMPS that has the package says so and goes on",
      "nothing to load" in both and numbers(both) == built_in)

unloaded = error_of(LOAD + MEMBRANE + "plugin clear\nrun 0\n", lmp=LMP_PLAIN)
claim("plugin clear ends in an error message, not a crash", unloaded != "", unloaded)

finish()
