"""Runs a test on a core that no other test has.

    one_core.py COMMAND [ARGUMENTS]

Ranks take turns on it at each message. Spread over cores they would wait for each other while other tests run, two to four times
as long in all. Where all cores are taken, or there is one only, it just runs the command. (CTest's PROCESSOR_AFFINITY does
nothing where CMake was built with the system's libuv.)
"""

import fcntl
import os
import sys
import tempfile

cores = sorted(os.sched_getaffinity(0))
for core in cores if len(cores) > 1 else ():
    lock = os.open(os.path.join(tempfile.gettempdir(), f"membrane-test-{os.getuid()}-core-{core}"), os.O_RDWR | os.O_CREAT, 0o600)
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        os.close(lock)
        continue
    os.set_inheritable(lock, True)    # the command keeps it
    os.sched_setaffinity(0, {core})
    break
os.execvp(sys.argv[1], sys.argv[1:])
