"""Run all tests, as `make test` does; arguments go to pytest.

Several processes share the tests, file by file: see `pytest_xdist_make_scheduler` in
tests/conftest.py. Each has a Blender of its own.

Blender 4.2 crashes now and then in a process that has loaded hundreds of files. So a
process tests a few files there, and several processes run at a time.
"""

import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from importlib.metadata import version
from pathlib import Path

TESTS = Path(__file__).parents[1] / "tests"
RING = TESTS / "blender"
NOTHING_COLLECTED = 5
# Files that a process of Blender 4.2 tests: it loads some 80 files then.
FILES_AT_ONCE = 4
# More hardly help: the tests of the zips stay in one process, and take longest.
MOST_PROCESSES = 4


def in_processes(number: int, *arguments: str) -> list[str]:
    """Return what makes pytest share its tests among processes."""
    # Files start in the order that tests/conftest.py gives them.
    sharing = [f"-n{number}", "--dist=loadfile", "--no-loadscope-reorder"]
    return [str(TESTS), *sharing, *arguments]


def test(arguments: list[str], **options: object) -> subprocess.CompletedProcess:
    """Run pytest, with options of `subprocess.run`."""
    command = [sys.executable, "-m", "pytest", *arguments, *sys.argv[1:]]
    return subprocess.run(command, **options)


def test_files(paths: list[str]) -> subprocess.CompletedProcess:
    """Test a few files, and print all that pytest says at once."""
    run = test(paths, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    print(run.stdout, end="", flush=True)
    return run


def main() -> int:
    """Return 0 if all tests passed."""
    number = min(MOST_PROCESSES, os.cpu_count() or 1)
    if version("bpy").startswith("4.2"):
        runs = [test(in_processes(number, f"--ignore={RING}"))]
        files = sorted(map(str, RING.rglob("test_*.py")))
        starts = range(0, len(files), FILES_AT_ONCE)
        groups = [files[start : start + FILES_AT_ONCE] for start in starts]
        with ThreadPoolExecutor(number) as pool:
            runs += pool.map(test_files, groups)
    else:
        runs = [test(in_processes(number))]
    failed = [run for run in runs if run.returncode not in {0, NOTHING_COLLECTED}]
    for run in failed:
        print(f"Failed: {' '.join(run.args[3:])}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
