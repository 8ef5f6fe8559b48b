"""What is computed while the window stays alive: known to panels and operators.

Kept here and not in Blender's data: a file saved meanwhile would remember it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import bpy

from ...core.steps.job import Job


@dataclass
class Running:
    """A computation that goes on in a window.

    Attributes
    ----------
    title : str
        What is done, as its button says it.
    job : Job
    timer : bpy.types.Timer
        Calls for the job's next slice.
    workspace : str
        Name of the workspace in whose status bar the progress is shown.
    shown : float
        When that was, by `time.perf_counter`.
    """

    title: str
    job: Job[Any]
    timer: bpy.types.Timer
    workspace: str
    shown: float = -math.inf


# The one computation that is running.
current: Running | None = None
