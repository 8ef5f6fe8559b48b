"""Compute in slices of time, so that the window stays alive: one run at a time.

However a run ends, it ends in `stop`.
"""

from __future__ import annotations

import math
import time
from dataclasses import dataclass
from functools import partial
from typing import Any, ClassVar

import bpy

from ...core.steps.job import Job
from ...core.steps.progress import Steps
from ..viewport.viewports import redraw_sidebars

# Seconds of work in a slice; the window takes the user's input after it. Steps end some
# 20 ms late, 75 on a mesh of a million faces.
_SLICE = 0.02
# Seconds between two slices: none, as Blender looks for input and draws anyway.
_PAUSE = 0.001
# Seconds between two updates of the progress, least and most, and how many times longer
# than its drawing: a large scene or a slow display must not slow down the work.
_LOOKS = (0.5, 5.0)
_DRAWING = 20.0


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
        Name of the workspace whose status bar shows the progress.
    shown : float
        When the progress was shown last, by `time.perf_counter`; at first when the
        computation began. To draw a window by software takes a while, so that a quick
        computation shows none.
    look : float
        Seconds until it is shown again; not a number while Blender draws it.
    """

    title: str
    job: Job[Any]
    timer: bpy.types.Timer
    workspace: str
    shown: float
    look: float


# The one computation that is running, for panels and operators. It is not in Blender's
# data, because a file saved meanwhile would remember it.
current: Running | None = None


def busy() -> str | None:
    """Return why nothing can be started now, None if it can."""
    if current is None:
        return None
    return f"{current.title} is running; wait for it, or press Esc"


def is_free(operator: type[bpy.types.Operator], obstacle: str | None) -> bool:
    """Return whether an operator can be called; its button tells of an obstacle."""
    if obstacle:
        operator.poll_message_set(obstacle)
    return obstacle is None


def start(context: bpy.types.Context, title: str, steps: Steps[Any]) -> Running:
    """Start computing in a window; its timer events ask for `advance`."""
    global current
    timer = context.window_manager.event_timer_add(_PAUSE, window=context.window)
    now, name = time.perf_counter(), context.workspace.name
    current = Running(title, Job(steps), timer, name, now, _LOOKS[0])
    return current


def advance(run: Running) -> bool:
    """Compute for a moment; return whether all was done before.

    So the results are written in a step of their own. They wait while the user moves
    something: a step to undo to would hold half of the move.
    """
    if math.isnan(run.look):
        drawn = time.perf_counter() - run.shown
        run.look = min(max(_DRAWING * drawn, _LOOKS[0]), _LOOKS[1])
    if run.job.done:
        if _is_moving():
            return False
        stop()
        return True
    try:
        run.job.advance(_SLICE)
    except BaseException:
        stop()
        raise
    _show(run)
    return False


def _is_moving() -> bool:
    """Return whether the user is moving, turning or scaling something in a window."""
    windows = bpy.context.window_manager.windows
    running = [each for window in windows for each in window.modal_operators]
    steps = [step for each in running for step in (each, *each.macros)]
    return any(step.bl_idname.startswith("TRANSFORM_OT_") for step in steps)


def stop() -> None:
    """End the computation, if any, and remove its traces from the window."""
    global current
    run, current = current, None
    if run is None:
        return
    run.job.cancel()
    bpy.context.window_manager.event_timer_remove(run.timer)
    _show_status(run.workspace, None)
    redraw_sidebars()


def _show(run: Running) -> None:
    """Show the progress, unless it was shown a moment ago."""
    now = time.perf_counter()
    if now < run.shown + run.look:
        return
    run.shown, run.look = now, math.nan
    progress = run.job.progress
    text = f"{run.title}: {progress.stage}, {progress.fraction:.0%}. Esc cancels"
    _show_status(run.workspace, text)
    redraw_sidebars()


def show_hint(name: str, text: str | None) -> None:
    """Show a text in the status bar of a workspace, None for the usual one.

    The progress of a computation stays if there is any.
    """
    if current is None:
        _show_status(name, text)


def _show_status(name: str, text: str | None) -> None:
    """Show a text in the status bar of a workspace; None shows the usual one again.

    That is for all workspaces if none has the name: the user may have renamed it.

    While Blender closes a window it is shown a moment later: the end of an override of
    the context would crash Blender then.
    """
    if bpy.context.window not in (None, *bpy.context.window_manager.windows):
        bpy.app.timers.register(partial(_show_status, name, text))
        return
    workspaces = bpy.data.workspaces
    if name in workspaces:
        there = [workspaces[name]]
    else:
        there = workspaces.values() if text is None else []
    for workspace in there:
        # Blender sets the text of the workspace in the context, not of the one called.
        with bpy.context.temp_override(workspace=workspace):
            workspace.status_text_set(text)


class WCD_OT_cancel(bpy.types.Operator):
    """Stop the computation."""

    bl_idname = "wcd.cancel"
    bl_label = "Cancel Convex Parts"
    bl_description = "Stop computing; the object stays as it was. Esc does the same"
    bl_options: ClassVar[set[str]] = set()

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether anything is running."""
        return is_free(cls, None if current else "Nothing is running that could stop")

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Stop it."""
        stop()
        return {"FINISHED"}
