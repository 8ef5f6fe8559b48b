"""Progress shown at the mouse cursor while Blender waits."""

from __future__ import annotations

from typing import TypeVar

import bpy

from ...core.steps.progress import Progress, Steps, mapped

T = TypeVar("T")


def with_cursor(window_manager: bpy.types.WindowManager, steps: Steps[T]) -> Steps[T]:
    """Pass `steps` on, showing their progress at the mouse cursor."""
    if bpy.app.background:
        return (yield from steps)

    def show(progress: Progress) -> Progress:
        window_manager.progress_update(round(progress.fraction * 100))
        return progress

    window_manager.progress_begin(0, 100)
    try:
        return (yield from mapped(steps, show))
    finally:
        window_manager.progress_end()
