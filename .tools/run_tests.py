"""Run all tests, as `make test` does; arguments go to pytest.

Several processes share the tests, file by file: see `pytest_xdist_make_scheduler` in
tests/conftest.py. Each has a Blender of its own.

Blender 4.2 crashes now and then in a process that has loaded hundreds of files, so that
each file of its tests has a process of its own there, one after the other.
"""

import os
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

TESTS = Path(__file__).parents[1] / "tests"
RING = TESTS / "blender"
NOTHING_COLLECTED = 5
# More hardly help: the tests of the zips stay in one process, and take longest.
MOST_PROCESSES = 4


def groups() -> list[list[str]]:
    """Return the arguments of each run of pytest."""
    if version("bpy").startswith("4.2"):
        files = sorted(RING.rglob("test_*.py"))
        return [[str(TESTS), f"--ignore={RING}"], *([str(path)] for path in files)]
    number = min(MOST_PROCESSES, os.cpu_count() or 1)
    # Files start in the order that tests/conftest.py gives them.
    return [[str(TESTS), f"-n{number}", "--dist=loadfile", "--no-loadscope-reorder"]]


def main() -> int:
    """Return 0 if all tests passed."""
    failed = []
    for group in groups():
        command = [sys.executable, "-m", "pytest", *group, *sys.argv[1:]]
        if subprocess.run(command).returncode not in {0, NOTHING_COLLECTED}:
            failed.append(" ".join(group))
    if failed:
        print(f"Failed: {', '.join(failed)}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
