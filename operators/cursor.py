"""Progress shown at the mouse cursor while Blender waits."""

from __future__ import annotations

from typing import TypeVar

import bpy

from ..core.progress import Steps

T = TypeVar("T")


def with_cursor(window_manager: bpy.types.WindowManager, steps: Steps[T]) -> Steps[T]:
    """Pass `steps` on, showing their progress at the mouse cursor."""
    if bpy.app.background:
        return (yield from steps)
    window_manager.progress_begin(0, 100)
    try:
        while True:
            try:
                progress = next(steps)
            except StopIteration as stop:
                value: T = stop.value
                return value
            window_manager.progress_update(round(progress.fraction * 100))
            yield progress
    finally:
        steps.close()
        window_manager.progress_end()
