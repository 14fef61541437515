"""Bad input gets one LAMMPS error line that names the thing and the cure; what the mesh has, on one rank and on two."""

import concurrent.futures
import os
import subprocess

from lammps_claims import LMP, MPIEXEC, claim, finish, start
from membrane_scenes import bipyramid, write_off

# === Meshes with one thing wrong

OCTAHEDRON = bipyramid(4)


def write_data(path, points, faces, molecule=lambda i: 1, mass=lambda i: 1.0, columns=7):
    with open(path, "w") as file:
        file.write(f"mesh\n\n{len(points)} atoms\n{len(faces)} angles\n1 atom types\n1 angle types\n\n"
                   "-2 2 xlo xhi\n-2 2 ylo yhi\n-2 2 zlo zhi\n\nAtoms\n\n")
        for i, (x, y, z) in enumerate(points, 1):
            words = f"{i} {molecule(i)} 1 {mass(i)} {x} {y} {z}".split()
            file.write(" ".join(words[:columns]) + "\n")
        if faces:
            file.write("\nAngles\n\n")
        for i, face in enumerate(faces, 1):
            file.write(f"{i} 1 {face[0] + 1} {face[1] + 1} {face[2] + 1}\n")


def write_meshes():
    points, faces = OCTAHEDRON
    flipped = [faces[0][::-1]] + faces[1:]
    write_data("good.data", points, faces)
    write_data("flipped.data", points, flipped)
    write_data("inside_out.data", points, [face[::-1] for face in faces])
    write_data("duplicate.data", points, faces + faces[:1])
    write_data("open.data", points, faces[1:])
    write_data("pillow.data", points[:3], [(0, 1, 2), (0, 2, 1)])
    write_data("two_molecules.data", points, faces, molecule=lambda i: 1 if i < 6 else 2)
    write_data("loose.data", points + [(1.5, 1.5, 1.5)], faces)
    write_data("massless.data", points, faces, mass=lambda i: 0.0 if i == 3 else 1.0)
    write_data("negative_mass.data", points, faces, mass=lambda i: -2.5 if i == 3 else 1.0)
    write_data("nan_mass.data", points, faces, mass=lambda i: "nan" if i == 3 else 1.0)
    write_data("columns.data", points, faces, columns=6)
    write_data("nan.data", [(float("nan"), 0.0, 0.0)] + points[1:], faces)
    # a third sheet on the edge 0-1: a fin that is a tetrahedron of its own but for that edge
    fin = points + [(1.5, 1.5, 0.5), (1.5, 1.5, -0.5)]
    write_data("fin.data", fin, faces + [(0, 1, 6), (1, 0, 7), (0, 6, 7), (1, 7, 6)])
    # two octahedra that touch in a point
    other = [(x + 2.0, y, z) for x, y, z in points]
    index = [6, 7, 0, 8, 9, 10]
    write_data("touching.data", points + [p for i, p in enumerate(other) if i != 2],
               faces + [tuple(index[v] for v in face) for face in faces])
    for name, source in {"open": faces[1:], "duplicate": faces + faces[:1]}.items():
        write_off(f"{name}.off", points, source)
    write_off("nan.off", [(float("nan"), 0.0, 0.0)] + points[1:], faces)
    write_off("corner.off", points, faces[1:] + [(0, 1, 17)])
    write_off("unused.off", points + [(1.5, 1.5, 1.5)], faces)
    with open("short.off", "w") as file:
        file.write("OFF\n6 8 0\n1 0 0\n")
    with open("words.off", "w") as file:
        file.write("OFF\n6 8 0\n1 0 zero\n")
    with open("mesh.xyz", "w") as file:
        file.write("6\n\nC 0 0 0\n")
    open("empty.off", "w").close()


# === What to run

HEAD = "units lj\natom_style membrane_cp\n"
BOX = HEAD + "region box block -2 2 -2 2 -2 2\ncreate_box 2 box angle/types 1\n"
OPEN_BOX = HEAD + "boundary f f f\nregion box block -2 2 -2 2 -2 2\ncreate_box 2 box angle/types 1\n"
PAIR = "pair_style helfrich\npair_coeff * * 10.0 0.0\nrun 0\n"


def data(name, pair=PAIR):
    return HEAD + f"read_data {name}.data\n{pair}"


def create(words, box=BOX):
    return box + f"create_membrane {words}\n"


def coeff(words, shape="sphere 1 1.0"):
    return create(f"1 {shape}") + f"pair_style helfrich\npair_coeff {words}\nrun 0\n"


# The mesh and the shape: each rank looks at its part
CASES = [
    # === The mesh, from a data file
    (data("flipped"), "same direction: one of them is flipped"),
    (data("duplicate"), "face 1-2-5 are duplicates; remove one"),
    (data("open"), "is a boundary: a membrane must be closed"),
    (data("fin"), "the mesh is not a manifold"),
    (data("touching"), "form more than one fan"),
    (data("pillow"), "share all three corners"),
    (data("two_molecules"), "joins membranes 1 and 2; control points of one connected surface must have one"),
    (data("loose"), "Atom 7 is of a type with pair helfrich coefficients but is in no face: give it a type"),
    (data("nan"), "instead of 'nan'"),
    (data("inside_out", "pair_style helfrich\npair_coeff * * 10.0 0.0 volume 1.0 init\nrun 0\n"),
     "its faces are inside out; reverse the order"),
    (data("inside_out", "pair_style helfrich\npair_coeff * * 10.0 0.0 volume 1.0 2.0\nrun 0\n"),
     "its faces are inside out; reverse the order"),
    (data("massless"), "Atom 3 in the Atoms section of the data file has mass 0"),
    (data("negative_mass"), "Atom 3 in the Atoms section of the data file has mass -2.5"),
    (data("nan_mass"), "instead of 'nan'"),
    (data("columns"), "Incorrect format in Atoms section of data file"),
    (data("good") + "set atom 3 mol 2\nrun 0\n", "joins membranes"),
    (data("good") + "group one id 3\ndelete_atoms group one compress no\nrun 0\n",
     "Control point 3 is used by a face but is not an atom: delete whole membranes only"),
    (data("good") + "group one id 3\ndelete_atoms group one compress no bond yes\nrun 0\n", "is a boundary"),

    # === The mesh, from a mesh file
    (create("1 file open.off"), "is a boundary"),
    (create("1 file duplicate.off"), "face 0 and face 8 are duplicates; remove one"),
    (create("1 file unused.off"), "vertex 6 is in no face; remove it"),
    (create("1 file corner.off"), "corner.off, line 16: corner 17 is not one of the 6 vertices"),
    (create("1 file nan.off"), "nan.off, line 3: coordinate 'nan' is not finite; correct it"),
    (create("1 file short.off"), "short.off, line 3: the file ends after 1 of 6 vertices"),
    (create("1 file words.off"), "words.off, line 3: 'zero' is not a number"),
    (create("1 file empty.off"), "empty.off: the file is empty"),
    (create("1 file mesh.xyz"), "unknown extension 'xyz'; a mesh file must be named *.off"),
    (create("1 file missing.off"), "missing.off: cannot be opened"),

    # === Coefficients that do not go with the mesh
    (coeff("2 2 10.0 0.0"), "is of a type without coefficients: add a pair_coeff line"),
    (coeff("* * 10.0 0.0 volume 1.0 init", "plane 8 8"), "encloses no volume: remove volume and pressure"),
    (coeff("* * 10.0 0.0 pressure 1.0", "cylinder 8 8 1.0 z"), "encloses no volume: remove volume and pressure"),
    (create("1 sphere 1 1.0") + "set atom 1*5 type 2\npair_style helfrich\npair_coeff 1 1 10.0 0.0 area 1.0 init\n"
     "pair_coeff 2 2 10.0 0.0\nrun 0\n", "Membrane 1 has control points of types with different area"),
    (create("1 sphere 1 1.0") + "set atom 1*5 type 2\npair_style helfrich\n"
     "pair_coeff 1 1 10.0 0.0 area/difference 1.0 init thickness 0.1\n"
     "pair_coeff 2 2 10.0 0.0 area/difference 1.0 init thickness 0.2\nrun 0\n",
     "Membrane 1 has control points of types with different area/difference coefficients"),

    # === The default skin of units si, in a box of some nanometers
    (create("1 sphere 1 50e-9", BOX.replace("units lj", "units si").replace("-2 2 -2 2 -2 2", "-1e-7 1e-7 -1e-7 1e-7 -1e-7 1e-7")) +
     "pair_style helfrich\npair_coeff * * 8e-20 0.0\nrun 0\n", "use the neighbor command with a skin of about an edge"),

    # === Shapes that cannot be, at the start and on the way
    (create("1 sphere 0 3.0"), "create_membrane sphere: an edge spans half the periodic box in"),
    (create("1 sphere 0 3.0 refine 2"), "create_membrane sphere: an edge spans half the periodic box in"),
    (data("good", "change_box all x scale 0.55\n" + PAIR), "spans half the periodic box in x; use a larger box or a finer"),
    (create("1 sphere 1 1.0") + "set group all x 0.0 y 0.0\n" + PAIR, "is not a finite number: control points"),
    (create("1 sphere 1 1.0") + "set group all x 0.0 y 0.0 z 0.0\n" + PAIR, "is not a finite number: control points"),
    (create("1 sphere 1 1.0") + "variable nan atom exp(1000)*0\nset atom 7 y v_nan\n" + PAIR,
     "Control point 7 has a coordinate that is not a finite number"),
    (create("1 sphere 1 1.0") + "set type 1 mass 0.0\n" + PAIR, "Invalid mass"),
    (create("1 sphere 1 1.0") + PAIR + "fix 1 all nve\nvelocity all create 1.0 4711\ntimestep 10\nrun 50\n", "Lost atoms"),
    (create("1 sphere 2 1.0", OPEN_BOX) + PAIR + "velocity all set 10 0 0\nfix 1 all nve\nthermo 10\ntimestep 0.001\n"
     "run 500\n", "unless it left the box, which is not periodic"),
]

# Commands: all ranks read the same line, so these run on one
COMMANDS = [
    # === atom_style
    ("atom_style membrane_cp triangles 1\n", "Unknown atom_style membrane_cp argument triangles; the only one is: faces"),
    ("atom_style membrane_cp faces\n", "the only one is: faces TYPES"),
    (BOX.replace("membrane_cp", "membrane_cp faces 3") + "create_membrane 1 sphere 1 1.0\n" + PAIR,
     "Numeric index 3 is out of bounds (1-1)"),
    ("atom_style molecular\nregion box block -2 2 -2 2 -2 2\ncreate_box 1 box angle/types 1\nmass 1 1.0\n" + PAIR,
     "Pair style helfrich needs control points: use atom_style membrane_cp"),
    ("atom_style molecular\nregion box block -2 2 -2 2 -2 2\ncreate_box 1 box angle/types 1\n"
     "create_membrane 1 sphere 1 1.0\n", "create_membrane needs control points: use atom_style membrane_cp"),

    # === create_membrane
    (HEAD + "create_membrane 1 sphere 1 1.0\n", "create_membrane needs a box: use create_box first"),
    ("dimension 2\n" + BOX.replace("-2 2 -2 2 -2 2", "-2 2 -2 2 -0.1 0.1") + "create_membrane 1 sphere 1 1.0\n",
     "create_membrane needs dimension 3"),
    (create("1 sphere 1 1.0", BOX.replace("angle/types 1", "")), "needs an angle type for its faces: add angle/types 1"),
    (create("3 sphere 1 1.0"), "create_membrane type 3 is not one of the 2 atom types"),
    (create("0 sphere 1 1.0"), "create_membrane type 0 is not one of the 2 atom types"),
    (create("1 sphere 1"), "missing argument"),
    (create("1 sphere one 1.0"), "Expected integer parameter instead of 'one'"),
    (create("1 sphere -1 1.0"), "icosphere level -1 must be between"),
    (create("1 sphere 40 1.0"), "icosphere level 40 must be between"),
    (create("1 sphere 1 -1.0"), "radius must be a positive length"),
    (create("1 sphere 1 0.0"), "radius must be a positive length"),
    (create("1 cube 1 1.0"), "Unknown create_membrane shape cube; known are: sphere, plane"),
    (create("1 plane 8 7"), "even number of rows, at least 4, not 7"),
    (create("1 plane 2 2"), "at least 4 points in a row, not 2"),
    (create("1 plane 8 8", OPEN_BOX), "create_membrane plane needs a box that is periodic in x and y"),
    (create("1 plane 8 8 scale 2 1 1"), "create_membrane plane spans the box: it cannot be scaled"),
    (create("1 cylinder 8 8 1.0 w"), "create_membrane cylinder axis w is not x, y or z"),
    (create("1 cylinder 8 7 1.0 z"), "even number of rings, at least 4, not 7"),
    (create("1 cylinder 4 8 1.9 z"), "create_membrane cylinder: an edge spans half the periodic box in"),
    (create("1 sphere 1 1.0 center 1e20 0 0"), "boxes away in x; use scale and center"),
    (create("1 cylinder 8 8 1.0 z", OPEN_BOX), "create_membrane cylinder needs a box that is periodic in z"),
    (create("1 torus 8 7 1.0 0.4"), "even number of points around its tube, at least 4, not 7"),
    (create("1 torus 8 8 0.4 1.0"), "tube radius of a torus must be smaller"),
    (create("1 sphere 1 3.0", OPEN_BOX), "is outside the box, which is not periodic in"),
    (create("1 sphere 1 1.0 colour red"), "Unknown create_membrane keyword colour; known are: center, scale"),
    (create("1 sphere 1 1.0 scale 1 1"), "missing argument"),
    (create("1 sphere 1 1.0 scale 1 1 0"), "create_membrane scale 0 must be positive"),
    (create("1 sphere 1 1.0 center 0 0 a"), "instead of 'a'"),
    (create("1 sphere 1 1.0 refine -1"), "create_membrane refine -1 must be between 0 and 10"),
    (create("1 sphere 1 1.0 molecule 0"), "create_membrane molecule 0 must be positive"),
    (create("1 sphere 1 1.0 mass 0"), "create_membrane mass 0 must be positive"),
    (create("1 sphere 1 1.0 face/type 2"), "create_membrane face/type 2 is not one of the 1 angle types"),

    # === pair_style, pair_coeff
    (create("1 sphere 1 1.0") + "pair_style helfrich quadrature 5\n",
     "pair_style helfrich quadrature 5 is not one of 1, 3, 6, 12, careful"),
    (create("1 sphere 1 1.0") + "pair_style helfrich quadrature\n", "missing argument"),
    (create("1 sphere 1 1.0") + "pair_style helfrich points 3\n", "Unknown pair_style helfrich keyword points"),
    (create("1 sphere 1 1.0") + "pair_style helfrich\nrun 0\n", "All pair coeffs are not set"),
    (coeff("1 1 10.0"), "missing argument"),
    (coeff("1 2 10.0 0.0"), "so give the same type twice"),
    (coeff("3 3 10.0 0.0"), "Numeric index 3 is out of bounds (1-2)"),
    (coeff("1 1 ten 0.0"), "instead of 'ten'"),
    (coeff("1 1 nan 0.0"), "instead of 'nan'"),
    (coeff("1 1 -10.0 0.0"), "pair_coeff helfrich bending modulus -10.0 is negative"),
    (coeff("1 1 10.0 0.0 area -1.0 init"), "pair_coeff helfrich area modulus -1.0 is negative"),
    (coeff("1 1 10.0 0.0 area 1.0 0.0"), "pair_coeff helfrich reference area 0.0 must be positive or init"),
    (coeff("1 1 10.0 0.0 area 1.0"), "missing argument"),
    (coeff("1 1 10.0 0.0 volume 1.0 first"), "instead of 'first'"),
    (coeff("1 1 10.0 0.0 area/difference 1.0 init"), "missing argument"),
    (coeff("1 1 10.0 0.0 area/difference -1.0 init thickness 1.0"), "area/difference modulus -1.0 is negative"),
    (coeff("1 1 10.0 0.0 area/difference 1.0 first thickness 1.0"), "instead of 'first'"),
    (coeff("1 1 10.0 0.0 area/difference 1.0 init 1.0 pressure"),
     "pair_coeff helfrich area/difference: 1.0 must be thickness and a length"),
    (coeff("1 1 10.0 0.0 area/difference 1.0 init thickness 0.0"),
     "pair_coeff helfrich area/difference thickness 0.0 must be positive"),
    (coeff("1 1 10.0 0.0 leaflets 0.0"), "leaflets 0.0: the distance from the mid-plane must be positive"),
    (coeff("1 1 10.0 0.0 leaflets 1.1"), "is curved with a radius near this distance or below: use a smaller one"),
    (coeff("1 1 10.0 0.0 lipids"), "missing argument"),
    (coeff("1 1 10.0 0.0 lipids NULL library A 1 0 outer A 1"), "the inner leaflet has no lipids"),
    (coeff("1 1 10.0 0.0 lipids NULL library A 1 0 outer A 1 inner B 1"), "unknown lipid B; known are: A"),
    (coeff("1 1 10.0 0.0 lipids NULL library A 1 0 outer A 0 inner A 1"), "outer leaflet: the parts of a leaflet are all"),
    (coeff("1 1 10.0 0.0 lipids NULL library A 1 0 outer A -1 inner A 1"), "parts of lipid A must not be negative"),
    (coeff("1 1 10.0 0.0 lipids NULL library A 0 0 outer A 1 inner A 1"), "area of lipid A must be positive"),
    (coeff("1 1 10.0 0.0 lipids NULL library A 1 0 outer A 1 inner A 1 library A 1 0.1"),
     "lipid A has area 1 and curvature 0.10000000000000001 here but area 1 and curvature 0 elsewhere"),
    (coeff("1 1 10.0 0.0 lipids nowhere.membrane outer A 1 inner A 1"), "cannot open file nowhere.membrane"),
    (coeff("1 1 10.0 0.0 stiffness 1.0"), "Unknown pair_coeff helfrich keyword stiffness; known are: kg, leaflets, tension"),
]

# a membrane that grows: its stencils reach beyond the ghosts of a rank
GROWTH = (BOX.replace("-2 2", "-5 5") + "create_membrane 1 sphere 2 1.0 center 0 0 0\n" + PAIR + """
variable        vx atom 10*x
variable        vy atom 10*y
variable        vz atom 10*z
velocity        all set v_vx v_vy v_vz
fix             1 all nve
timestep        0.001
run             200
""", "which is beyond the communication cutoff 1.23607; raise it with comm_modify cutoff")


def errors(number, ranks, script):
    """The exit code and all error lines."""
    path = f"in.{number}.{ranks}"
    with open(path, "w") as file:
        file.write(script)
    command = ([MPIEXEC, "-n", str(ranks)] if ranks > 1 else []) + [LMP, "-in", path, "-log", "none"]
    try:
        code, output = start(command, timeout=60)
    except subprocess.TimeoutExpired:
        return 0, ["no end after a minute"]
    lines = [line for line in output.splitlines() if line.startswith("ERROR")]
    return code, lines or output.splitlines()[-20:]


def check(number, ranks, script, fragment):
    """One error line, or one from each rank that met with trouble of its own ("ERROR on proc")."""
    code, lines = errors(number, ranks, script)
    one = len(lines) == 1 or len(lines) <= ranks and all("on proc" in line for line in lines)
    crashed = code < 0 or code > 128
    return code != 0 and not crashed and one and all(fragment in line for line in lines), lines


write_meshes()
ranks = (1, 2) if MPIEXEC else (1,)
tasks = [(n, *case) for case in CASES for n in ranks] + [(1, *case) for case in COMMANDS]
tasks += [(2, *GROWTH)] * bool(MPIEXEC)
tasks = [(number, *task) for number, task in enumerate(tasks)]
with concurrent.futures.ThreadPoolExecutor(2) as pool:
    for (number, n, _, fragment), (good, lines) in zip(tasks, pool.map(lambda task: check(*task), tasks)):
        claim(f"{n} rank(s):", good, lines[0] if good else f"expected: {fragment}; got: " + " | ".join(lines))

finish()
