"""Run all tests, as `make test` does; arguments go to pytest.

Blender 4.2 crashes now and then in a process that has loaded hundreds of files, so that
each file of its tests has a process of its own there.
"""

import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

TESTS = Path(__file__).parents[1] / "tests"
RING = TESTS / "blender"
NOTHING_COLLECTED = 5


def main() -> int:
    """Return 0 if all tests passed."""
    groups = [[str(TESTS)]]
    if version("bpy").startswith("4.2"):
        groups = [[str(TESTS), f"--ignore={RING}"]]
        groups += [[str(path)] for path in sorted(RING.rglob("test_*.py"))]
    failed = []
    for group in groups:
        command = [sys.executable, "-m", "pytest", *group, *sys.argv[1:]]
        if subprocess.run(command).returncode not in {0, NOTHING_COLLECTED}:
            failed.append(" ".join(group))
    if failed:
        print(f"Failed: {', '.join(failed)}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
