"""Finds out which engine can render on this machine."""

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
_TRIAL_SECONDS = 120


class EngineTrial:
    """Workbench tried out in a process of its own, while this one works.

    Where OpenGL or Vulkan is missing, Workbench does not fail: it ends the process.
    """

    def __init__(self) -> None:
        if bpy.app.binary_path:
            command = [bpy.app.binary_path, "--background", "--factory-startup"]
            command += ["--python-exit-code", "1", "--python-expr", _TRIAL]
        else:  # the bpy wheel; -P: no modules from the current folder
            command = [sys.executable, "-P", "-c", _TRIAL]
        self._process = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )

    def engine(self) -> RenderEngine:
        """Return Workbench if it works here, and Cycles on the CPU if not."""
        try:
            works = self._process.wait(timeout=_TRIAL_SECONDS) == 0
        except subprocess.TimeoutExpired:
            works = False
            self.close()
        return "BLENDER_WORKBENCH" if works else "CYCLES"

    def close(self) -> None:
        """End the trial if it still runs."""
        if self._process.poll() is None:
            self._process.kill()
            self._process.wait()
