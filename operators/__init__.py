"""What the user can do: the operators, the command line and the public functions.

Nothing is imported before it is used: the public functions work without Blender.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import bpy


def classes() -> tuple[type[bpy.types.Operator], ...]:
    """Return the operators' classes in the order in which they are registered."""
    from . import edit_parts, recut, show_parts, show_sight, use_parts
    from .clear import WCD_OT_clear
    from .decompose import WCD_OT_decompose
    from .hulls import WCD_OT_build_hulls
    from .measure import WCD_OT_measure, WCD_OT_measure_selection
    from .rigid_bodies import WCD_OT_make_rigid
    from .running import modal
    from .show_picture import WCD_OT_show_picture
    from .use_preset import WCD_OT_use_preset

    return (
        WCD_OT_decompose,
        WCD_OT_measure,
        WCD_OT_measure_selection,
        WCD_OT_build_hulls,
        WCD_OT_make_rigid,
        WCD_OT_clear,
        modal.WCD_OT_cancel,
        WCD_OT_use_preset,
        recut.WCD_OT_recut,
        recut.WCD_OT_choose_part_count,
        *use_parts.CLASSES,
        *show_sight.CLASSES,
        WCD_OT_show_picture,
        *edit_parts.CLASSES,
        *show_parts.CLASSES,
    )


def register() -> None:
    """Register the operators, the command, the cache and the table's rows."""
    import bpy

    from . import show_sight
    from .bridge.parts import rows
    from .bridge.work import session_cache
    from .headless import command_line

    for cls in classes():
        bpy.utils.register_class(cls)
    command_line.register()
    session_cache.register()
    show_sight.register()
    rows.register()


def unregister() -> None:
    """Undo `register`; a computation that is running ends."""
    import bpy

    from . import recut, show_sight
    from .bridge.parts import rows
    from .bridge.work import session_cache
    from .headless import command_line
    from .running import modal

    recut.stop()
    modal.stop()
    show_sight.unregister()
    rows.unregister()
    session_cache.unregister()
    command_line.unregister()
    for cls in reversed(classes()):
        bpy.utils.unregister_class(cls)
