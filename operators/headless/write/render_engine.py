"""Finds out which engine can render pictures on this machine."""

from __future__ import annotations

import subprocess
import sys
from typing import Literal

import bpy

RenderEngine = Literal["BLENDER_WORKBENCH", "CYCLES"]

_TRIAL = """
import bpy
scene = bpy.context.scene
scene.camera = bpy.data.objects.new("Trial", bpy.data.cameras.new("Trial"))
scene.collection.objects.link(scene.camera)
scene.render.engine = "BLENDER_WORKBENCH"
scene.render.resolution_x = scene.render.resolution_y = 16
bpy.ops.render.render()
"""
# A trial that takes longer has failed.
_TRIAL_SECONDS = 120


class EngineTrial:
    """A test render with Workbench, in a process of its own.

    Without OpenGL or Vulkan, Workbench raises no error: it ends the process.
    """

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None

    def engine(self) -> RenderEngine:
        """Wait for the test render; return Workbench if it worked, else Cycles."""
        try:
            works = self.start().wait(timeout=_TRIAL_SECONDS) == 0
        except subprocess.TimeoutExpired:
            works = False
            self.close()
        return "BLENDER_WORKBENCH" if works else "CYCLES"

    def close(self) -> None:
        """Stop the test render if it still runs."""
        if self._process is not None and self._process.poll() is None:
            self._process.kill()
            self._process.wait()

    def start(self) -> subprocess.Popen[bytes]:
        """Start the test render, if it is not; it runs while this process works."""
        if self._process is not None:
            return self._process
        if bpy.app.binary_path:
            command = [bpy.app.binary_path, "--background", "--factory-startup"]
            command += ["--python-exit-code", "1", "--python-expr", _TRIAL]
        else:  # the bpy wheel; -P keeps modules of the current folder out
            command = [sys.executable, "-P", "-c", _TRIAL]
        self._process = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        return self._process
