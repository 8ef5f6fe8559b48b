"""Every subject, each in a Blender of its own with a window.

BLENDER is the command that starts it: `blender`, or `.tools/blender_window run ROOT`.
"""

import os
import shlex
import subprocess

import pytest
from conftest import ROOT

BLENDER = shlex.split(os.environ.get("BLENDER", ""))
FOLDER = ROOT / "tests" / "window" / "subjects"
# A Blender that hangs is stopped after these.
_MOST_SECONDS = 400
# Subjects that need what another one leaves in build/window/.
AFTER = {"reopened": "save"}
SUBJECTS = sorted({path.stem for path in FOLDER.rglob("*.py")} - {*AFTER.values()})

pytestmark = pytest.mark.skipif(
    not BLENDER, reason="no window: BLENDER names no command that starts Blender"
)


def play(subject):
    drive = [*BLENDER, "--python", "tests/window/drive.py", "--", subject]
    done = subprocess.run(
        drive, cwd=ROOT, capture_output=True, text=True, timeout=_MOST_SECONDS
    )
    print(done.stdout)
    assert done.returncode == 0, done.stdout + done.stderr
    for word in ("Traceback", "Error:"):
        assert word not in done.stdout + done.stderr


@pytest.mark.parametrize("subject", SUBJECTS)
def test_subject(subject):
    if subject in AFTER:
        play(AFTER[subject])
    play(subject)
