"""Computations in slices of time, so that the window stays alive: one at a time.

However a computation ends, it ends in `stop`.
"""

from __future__ import annotations

import time
from typing import Any, ClassVar

import bpy

from ...core.steps.job import Job
from ...core.steps.progress import Steps
from . import current as running
from .current import Running

# Seconds of work in a slice, after which the window takes what the user does; between
# two slices; and between two looks at the progress, as drawing takes time, too. Steps
# end some 20 ms late.
_SLICE = 0.03
_PAUSE = 0.01
_LOOK = 0.2


def busy() -> str | None:
    """Return why nothing can be started just now, None if it can."""
    if running.current is None:
        return None
    return f"{running.current.title} is running; wait for it, or press Esc"


def start(context: bpy.types.Context, title: str, steps: Steps[Any]) -> Running:
    """Start computing in a window; its timer events ask for `advance`."""
    timer = context.window_manager.event_timer_add(_PAUSE, window=context.window)
    running.current = Running(title, Job(steps), timer, context.workspace.name)
    _show(running.current)
    return running.current


def advance(run: Running) -> bool:
    """Compute for a moment; return whether all is done."""
    over = True  # an error is an end, too
    try:
        over = run.job.advance(_SLICE)
    finally:
        if over:
            stop()
    if not over:
        _show(run)
    return over


def stop() -> None:
    """End the computation, if any, and leave nothing of it in the window."""
    run, running.current = running.current, None
    if run is None:
        return
    run.job.cancel()
    bpy.context.window_manager.event_timer_remove(run.timer)
    show_status(run.workspace, None)
    _redraw_sidebars()


def _show(run: Running) -> None:
    now = time.perf_counter()
    if now < run.shown + _LOOK:
        return
    run.shown = now
    progress = run.job.progress
    text = f"{run.title}: {progress.stage}, {progress.fraction:.0%}. Esc cancels"
    show_status(run.workspace, text)
    _redraw_sidebars()


def show_status(name: str, text: str | None) -> None:
    """Show a text in the status bar of a workspace, or what is usually there."""
    workspace = bpy.data.workspaces.get(name)
    if workspace is None:
        return
    # Whichever workspace the method belongs to, it sets the text of the context's.
    with bpy.context.temp_override(workspace=workspace):
        workspace.status_text_set(text)


def _redraw_sidebars() -> None:
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type != "VIEW_3D":
                continue
            for region in area.regions:
                if region.type == "UI":
                    region.tag_redraw()


class WCD_OT_cancel(bpy.types.Operator):
    """Stop the computation."""

    bl_idname = "wcd.cancel"
    bl_label = "Cancel Convex Parts"
    bl_description = "Stop computing; the object stays as it was. So does Esc"
    bl_options: ClassVar[set[str]] = set()

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether there is anything to stop."""
        return running.current is not None

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Stop it."""
        stop()
        return {"FINISHED"}
