"""What every script test needs: run LAMMPS on an input script, and state claims about the result.

    from lammps_claims import claim, finish, run, thermo

    row = thermo(run("...", ranks=2))[-1]
    claim("energy does not drift", abs(row["TotEng"] - 1.0) < 1e-6, row["TotEng"])
    finish()

Each claim is printed on a line of its own; finish() ends the test, failed if a claim was.
"""

import glob
import os
import re
import subprocess
import sys
import tempfile

LMP = os.environ["LMP"]
LMP_PLAIN = os.environ["LMP_PLAIN"]
PLUGIN = os.environ["PLUGIN"]
MPIEXEC = os.environ["MPIEXEC"]
REFERENCE = os.environ["REFERENCE"]
EXAMPLES = os.environ["EXAMPLES"]
LONG = bool(os.environ.get("MEMBRANE_LONG"))    # many more samples, for ./quickstart test long
SLOWNESS = int(os.environ.get("MEMBRANE_SLOWNESS", 1))    # of an lmp with sanitizers, see ../CMakeLists.txt
REPORTS = "**/sanitizer.*"                      # what these found

_made = _failed = 0
for _report in glob.glob(REPORTS, recursive=True):
    os.remove(_report)


def claim(text, holds, measured=""):
    """State a claim, whether it holds, and the number it rests on."""
    global _made, _failed
    _made += 1
    _failed += not holds
    print("ok    " if holds else "FAILED", text, measured, flush=True)
    return holds


def finish():
    if not _made:
        print("FAILED no claim was made")
    for report in glob.glob(REPORTS, recursive=True):
        with open(report, errors="replace") as file:
            claim("the sanitizers find nothing", False, file.read())
    sys.exit(0 if _made and not _failed else 1)


def skip(reason):
    print("skipped:", reason)
    sys.exit(1 if _failed else 77)


def lammps(script, ranks=1, args=(), lmp=LMP, env=None, timeout=600):
    """Run an input script; return (exit code, everything that LAMMPS printed)."""
    if ranks > 1 and not MPIEXEC:
        print(f"note   this LAMMPS has no MPI: 1 rank in place of {ranks}, on no grid of processors")
        script = re.sub("^ *processors .*$", "", script, flags=re.M)
    with open("in.test", "w") as file:
        file.write(script)
    command = [MPIEXEC, "-n", str(ranks)] if MPIEXEC and ranks > 1 else []
    command += [lmp, "-in", "in.test", "-log", "log.test", *map(str, args)]
    return start(command, timeout, env)


def start(command, timeout, env=None):
    """Run a command; return (exit code, everything that it printed)."""
    # Open MPI removes its folder below /tmp at the end if it is empty, while another run may be about to use it
    with tempfile.TemporaryDirectory(prefix="ompi") as folder:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, timeout=SLOWNESS * timeout,
                              env={**os.environ, "OMPI_MCA_orte_tmpdir_base": folder, **(env or {})})
    return done.returncode, done.stdout


def run(script, **options):
    """Run an input script that must succeed; return what LAMMPS printed."""
    code, output = lammps(script, **options)
    if code != 0:
        print(output)
        print(f"FAILED LAMMPS ended with exit code {code}")
        sys.exit(1)
    return output


def error_of(script, **options):
    """Run an input script that must stop with a LAMMPS error; return the error line, or ''."""
    code, output = lammps(script, **options)
    lines = [line for line in output.splitlines() if line.startswith("ERROR")]
    return lines[0] if code != 0 and lines else ""


def thermo(output):
    """Rows of all thermo tables (thermo_modify line one) as dictionaries."""
    rows, columns = [], None
    for line in output.splitlines():
        words = line.split()
        if words[:1] == ["Step"]:
            columns = words
        elif words[:2] == ["Loop", "time"]:
            columns = None
        elif columns and len(words) == len(columns):
            try:
                rows.append(dict(zip(columns, map(float, words))))
            except ValueError:
                pass    # a warning amid the table
    return rows
