"""What the user can do: the operators, the settings and the command line.

Nothing is imported here at module level: the package loads without Blender.
"""

from __future__ import annotations

import atexit
from typing import Any


def _classes() -> tuple[Any, ...]:
    """Return the classes that Blender is to know."""
    from . import hulls, measure, scene_settings, show_parts, use_parts
    from .decompose import WCD_OT_clear, WCD_OT_decompose
    from .editing import edit_parts, rename_parts
    from .recut import WCD_OT_choose_part_count, WCD_OT_recut
    from .running.modal import WCD_OT_cancel
    from .show_picture import WCD_OT_show_picture
    from .viewport import choose_parts, pick_parts, show_sight

    return (
        *scene_settings.CLASSES,
        WCD_OT_decompose,
        *measure.CLASSES,
        *hulls.CLASSES,
        WCD_OT_clear,
        WCD_OT_cancel,
        WCD_OT_recut,
        WCD_OT_choose_part_count,
        *use_parts.CLASSES,
        *show_sight.CLASSES,
        *choose_parts.CLASSES,
        *pick_parts.CLASSES,
        WCD_OT_show_picture,
        *edit_parts.CLASSES,
        *rename_parts.CLASSES,
        *show_parts.CLASSES,
    )


def _modules() -> tuple[Any, ...]:
    """Return the modules that have something to register besides classes, in order."""
    from . import scene_settings
    from .bridge.parts import rows
    from .headless import command_line

    return scene_settings, command_line, rows


def _computing() -> tuple[Any, ...]:
    """Return the modules that hold what was computed until they `stop`."""
    from . import recut
    from .bridge.work import session_cache
    from .running import ahead

    return session_cache, recut, ahead


def _watchers() -> tuple[Any, ...]:
    """Return the modules whose `HANDLERS` Blender calls, until they `stop`."""
    from .bridge.parts import renaming
    from .running import joins, refine
    from .viewport import picking, show_sight, shown_figures, shown_parts

    shown = show_sight, shown_parts, shown_figures, picking
    return *_computing(), refine, joins, renaming, *shown


def _let_go() -> None:
    """Let go of what was computed: Blender calls a ray tree that is left an error."""
    for module in reversed(_computing()):
        module.stop()


def register() -> None:
    """Register the operators, the settings, the command and the table's rows."""
    from .bridge.registering import register_class
    from .bridge.watching import watch

    for cls in _classes():
        register_class(cls)
    for module in _modules():
        module.register()
    for module in _watchers():
        watch(module.HANDLERS)
    atexit.register(_let_go)  # Blender counts its memory when Python ends


def stop() -> None:
    """End what runs, and forget all but what is in Blender's data."""
    from .bridge.work import libraries
    from .running import modal

    modal.stop()
    libraries.stop()
    for module in reversed(_watchers()):
        module.stop()


def unregister() -> None:
    """Undo `register`; a computation that is running ends."""
    import bpy

    from .bridge.watching import unwatch

    atexit.unregister(_let_go)
    for module in reversed(_watchers()):
        unwatch(module.HANDLERS)
    stop()
    for module in reversed(_modules()):
        module.unregister()
    for cls in reversed(_classes()):
        bpy.utils.unregister_class(cls)
