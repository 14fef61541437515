"""The house of design.md, section 2: two storeys, rooms one can read at a sitting, no circles."""

import glob
import os
import re

from lammps_claims import claim, finish

TOP = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
FOLDER = os.path.join(TOP, "src", "MEMBRANE")
MOST_LINES = 500

# CONTRIBUTING.md: beginnings of names by storey and family
FAMILIES = (
    "membrane_",                                                                     # ground floor
    "atom_vec_membrane_cp", "angle_membrane", "mesh_", "create_membrane", "write_membrane",    # mesh
    "compute_membrane_", "pair_helfrich", "helfrich_", "restart_archive",            # surface, energy
    "hd_", "fix_hd_", "compute_hd_", "min_membrane",                                 # motion, minimization
    "bound_", "fix_hd_bound", "fix_hd_bind", "create_bound", "write_bound",                       # bound particles
    "srd_", "fix_srd_mesh", "create_solvent",                                        # solvent
    "molecules_",                                                                    # molecules
    "trial_energy", "box_scaling", "fix_hd_tension",                                        # Monte Carlo
    "dump_membrane_")                                                                # pictures


def read(path):
    with open(path) as file:
        return file.read()


def room_of(name):
    return os.path.splitext(name)[0]


def includes_of(text):
    return re.findall(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', text, re.M)


def circles(graph):
    """Sets of rooms that reach one another [R. Tarjan, SIAM J. Comput. 1, 146 (1972)]."""
    number, lowest, stack, found = {}, {}, [], []

    def visit(room):
        number[room] = lowest[room] = len(number)
        stack.append(room)
        for other in graph[room]:
            if other not in number:
                visit(other)
                lowest[room] = min(lowest[room], lowest[other])
            elif other in stack:
                lowest[room] = min(lowest[room], number[other])
        if lowest[room] == number[room]:
            members = stack[stack.index(room):]
            del stack[stack.index(room):]
            if len(members) > 1:
                found.append(sorted(members))

    for room in sorted(graph):
        if room not in number:
            visit(room)
    return found


files = {os.path.basename(path): read(path) for path in glob.glob(os.path.join(FOLDER, "*.[ch]*"))}
includes = {name: includes_of(text) for name, text in files.items()}

# === Ground floor: plain C++ and Eigen

listed = re.search(r"set\(ground_sources(.*?)\)\n", read(os.path.join(TOP, "CMakeLists.txt")), re.S)
ground = set(re.findall(r"\S+\.cpp", listed.group(1)))
ground |= {name for name in files if name.startswith("membrane_") and name.endswith(".h")}
claim("the ground floor is all there", ground <= set(files), sorted(ground - set(files)))
unlisted = [name for name in files if name.startswith("membrane_") and name not in ground]
claim("files named membrane_* are ground floor", not unlisted, unlisted)
above = [f"{name}: {header}" for name in sorted(ground & set(files)) for header in includes[name]
         if header not in ground and (header.endswith(".h") or header == "mpi.h")]
claim("it includes no header of LAMMPS or of the upper floor", not above, above)

# === Rooms: x.h and x.cpp

graph = {room_of(name): set() for name in files}
for name, headers in includes.items():
    graph[room_of(name)] |= {room_of(header) for header in headers if header in files} - {room_of(name)}
claim("no rooms include one another in a circle", not circles(graph), circles(graph))
homeless = [name for name in sorted(files) if not name.startswith(FAMILIES)]
claim("every file belongs to a family", not homeless, homeless)
long = {name: text.count("\n") for name, text in files.items() if text.count("\n") > MOST_LINES}
claim(f"no file is longer than {MOST_LINES} lines", not long, long)

# === Styles know no styles

STYLE = re.compile(r"^#ifdef [A-Z_]+_CLASS", re.M)
styles = {name for name, text in files.items() if STYLE.search(text)}
known = [f"{name}: {header}" for name in sorted(files) for header in includes[name]
         if header in styles and not (room_of(name) + "_").startswith(room_of(header) + "_")
         and not re.search(rf"class \w+ : public {re.escape(''.join(p.capitalize() for p in room_of(header).split('_')))}\b",
                           files[name], re.I)]
claim("no header of a style is included but by its own parts and by a style that is derived from it", not known, known)

# === Every file includes what it uses: precompiled headers hide what is missing, until a build that has none

def reached(name, seen):
    for header in includes.get(name, ()):
        if header not in seen:
            seen.add(header)
            reached(header, seen)
    return seen


cmake = read(os.path.join(TOP, "CMakeLists.txt"))
hidden = re.search(r"target_precompile_headers\(membrane_styles PRIVATE(.*?)\)", cmake, re.S).group(1)
hidden = re.findall(r"<(\w+)\.h>", hidden)
claim("the list of precompiled headers is read", {"atom", "fix", "modify", "update"} <= set(hidden), hidden)
missing = []
for name in sorted(files):
    if not name.endswith(".cpp"):
        continue
    seen = reached(name, set())
    code = re.sub(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\])*\"", "", files[name], flags=re.S)
    missing += [f"{name}: {header}.h" for header in hidden
                if re.search(rf"\b{header}->", code)
                and not any(other == f"{header}.h" or other.startswith(f"{header}_") for other in seen)]
claim("no file uses a class of LAMMPS whose header it gets by precompiled headers alone", not missing, missing)

# What Eigen declares in Eigen/Core and defines in another header is undefined at the end, for the linker to find
EIGEN = {"Geometry": r"\.cross\(", "LU": r"\.(inverse|determinant|partialPivLu|fullPivLu)\(\)",
         "Cholesky": r"\bLD?LT<|\.ld?lt\(\)", "QR": r"HouseholderQR|HouseholderQr\(", "SVD": r"\b(Jacobi|BDC)SVD\b",
         "Eigenvalues": r"\b\w*EigenSolver\b"}
missing = []
for name in sorted(files):
    seen = reached(name, set()) | set(includes[name])
    code = re.sub(r"//[^\n]*|/\*.*?\*/", "", files[name], flags=re.S)
    missing += [f"{name}: Eigen/{header}" for header, use in EIGEN.items()
                if re.search(use, code) and not {f"Eigen/{header}", "Eigen/Dense"} & seen]
claim("no file uses what it has not included of Eigen", not missing, missing)

# === Tests

scripts = {os.path.basename(path): read(path) for path in glob.glob(os.path.join(TOP, "unittest", "scripts", "test_*.py"))}
unlabelled = [name for name, text in sorted(scripts.items())
              if re.search(r"^from lammps_claims import .*\bLONG\b", text, re.M) and "MEMBRANE_LONG" not in text]
claim("each test with a long form says so with MEMBRANE_LONG, for ./quickstart test long to find it", not unlabelled, unlabelled)

finish()
