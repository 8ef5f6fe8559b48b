"""A small model, and the command line in this process."""

import bpy
import pytest
from headless.command import QUICK, run_wcd


@pytest.fixture
def model(tmp_path):
    bpy.ops.mesh.primitive_torus_add(major_segments=12, minor_segments=6)
    (tmp_path / "in").mkdir()
    bpy.ops.wm.ply_export(filepath=str(tmp_path / "in" / "ring.ply"))
    return tmp_path / "in" / "ring.ply"


@pytest.fixture
def run():
    """Return a function that runs the command line and returns the status."""
    return lambda *words: run_wcd(*words, *QUICK, "--quiet")
