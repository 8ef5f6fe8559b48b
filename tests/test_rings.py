"""What a missing Blender means for each ring, wherever the checkout is."""

import os
import shutil
import subprocess
import sys

import pytest
from conftest import HAS_BLENDER, ROOT

SKIPPED = "import pytest\n\ndef test_{}():\n    pytest.skip('no disk')\n"


@pytest.mark.skipif(not HAS_BLENDER, reason="bpy cannot be imported")
def test_skips_fail_in_rings_with_blender_alone(tmp_path):
    """The folder of the checkout may have the name of a ring."""
    checkout = tmp_path / "blender" / "package"
    tests = checkout / "tests"
    for name in ("core", "blender", "package", "support"):
        (tests / name).mkdir(parents=True)
        (tests / name / f"test_{name}.py").write_text(SKIPPED.format(name))
    (checkout / "__init__.py").touch()
    shutil.copy(ROOT / "pyproject.toml", checkout)
    shutil.copy(ROOT / "tests" / "conftest.py", tests)
    shutil.copy(ROOT / "tests" / "support" / "checkout.py", tests / "support")
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-v", "-p", "no:cacheprovider", "tests"],
        cwd=checkout,
        env={**os.environ, "WCD_REQUIRE_BLENDER": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    lines = [line for line in done.stdout.splitlines() if "::" in line and "%" in line]
    said = [line.split()[:2] for line in lines]
    assert [(test.rpartition("::")[2], outcome) for test, outcome in said] == [
        ("test_package", "FAILED"),
        ("test_blender", "FAILED"),
        ("test_core", "SKIPPED"),
        ("test_support", "SKIPPED"),
    ], done.stdout + done.stderr
